#!/usr/bin/env python3
"""estimate.py MODEL.json < recording.csv: the flow rate of a whole recording by the C interface, with nothing but ctypes.

The recording has columns time_s, current_A, position_mm and, better also, voltage_V and oil_temperature_C. The library is
found by the system, or named by the environment variable SPOOLFLOW_LIBRARY.
"""
import csv
import ctypes
import os
import sys
from ctypes import POINTER, c_char_p, c_double, c_int, c_size_t, c_uint32, c_void_p

BEST = 0  # enum spoolflow_estimator
OK = 0  # enum spoolflow_result


class Inputs(ctypes.Structure):
    _fields_ = [(name, POINTER(c_double)) for name in
                ("time_s", "current_A", "voltage_V", "position_m", "oil_temperature_K")]


class Outputs(ctypes.Structure):
    _fields_ = [(name, POINTER(c_double)) for name in
                ("flow_m3_per_s", "flow_lower_m3_per_s", "flow_upper_m3_per_s", "pressure_difference_Pa",
                 "magnetic_force_N", "spring_force_N", "flow_force_N", "friction_force_N")
                ] + [("status", POINTER(c_uint32))]


library = ctypes.CDLL(os.environ.get("SPOOLFLOW_LIBRARY", "libspoolflow.so.1"))
library.spoolflow_create.argtypes = [c_char_p, c_int, POINTER(c_void_p), c_char_p, c_size_t]
library.spoolflow_step_arrays.argtypes = [c_void_p, c_size_t, POINTER(Inputs), POINTER(Outputs)]
library.spoolflow_destroy.argtypes = [c_void_p]
library.spoolflow_destroy.restype = None
library.spoolflow_status_text.argtypes = [c_uint32, c_char_p, c_size_t]
library.spoolflow_status_text.restype = c_size_t


def number(text):
    try:
        return float(text)
    except ValueError:
        return float("nan")


def main():
    sensor, message = c_void_p(), ctypes.create_string_buffer(512)
    if library.spoolflow_create(os.fsencode(sys.argv[1]), BEST, ctypes.byref(sensor), message, len(message)) != OK:
        sys.exit(message.value.decode())

    rows = list(csv.DictReader(sys.stdin))

    def column(header, scale=1.0, offset=0.0):
        """The column in SI units, or a null pointer where the recording does not have it."""
        if not rows or header not in rows[0]:
            return POINTER(c_double)()
        return (c_double * len(rows))(*(number(row[header]) * scale + offset for row in rows))

    def pointer(values):
        return ctypes.cast(values, POINTER(c_double))

    inputs = Inputs(*(pointer(values) for values in
                      (column("time_s"), column("current_A"), column("voltage_V"), column("position_mm", 1e-3),
                       column("oil_temperature_C", offset=273.15))))
    flow, lower, upper = ((c_double * len(rows))() for _ in range(3))
    status = (c_uint32 * len(rows))()
    outputs = Outputs(flow_m3_per_s=flow, flow_lower_m3_per_s=lower, flow_upper_m3_per_s=upper, status=status)
    if library.spoolflow_step_arrays(sensor, len(rows), ctypes.byref(inputs), ctypes.byref(outputs)) != OK:
        sys.exit("the recording must have the columns time_s, current_A and position_mm")
    library.spoolflow_destroy(sensor)

    print("time_s,flow_L_min,flow_lower_L_min,flow_upper_L_min,status")
    names = ctypes.create_string_buffer(256)
    for k, row in enumerate(rows):
        library.spoolflow_status_text(status[k], names, len(names))
        print(f"{number(row['time_s']):.6f},{flow[k] * 60000:.6f},{lower[k] * 60000:.6f},{upper[k] * 60000:.6f},"
              f"{names.value.decode()}")


if __name__ == "__main__":
    main()
