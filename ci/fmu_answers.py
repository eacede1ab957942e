#!/usr/bin/env python3
"""fmu_answers.py FMU_FOLDER ANSWERS.csv STEP_ms [RECORDING.csv [FLAG…]]: what an unpacked FMU answers over a run.

Drives the FMU's shared library for this machine as an importer does, by FMI 2.0 or 3.0, and writes all outputs after every
communication step. Inputs of the sensor come from RECORDING.csv, a row each millisecond, 20 s of it; FLAGs are boolean
parameters to set to false. Inputs of the virtual valve are a triangle in position with steps in pressure difference, 5 s.
Needs nothing but Python's standard library.
"""
import csv
import ctypes as c
import math
import pathlib
import sys
import xml.etree.ElementTree as xml

SENSOR_COLUMNS = {"current": ("current_A", 1, 0), "voltage": ("voltage_V", 1, 0), "position": ("position_mm", 1e-3, 0),
                  "oil_temperature": ("oil_temperature_C", 1, 273.15)}
SENSOR_RUN_s, VALVE_RUN_s = 20, 5


class Callbacks2(c.Structure):
    LOG = c.CFUNCTYPE(None, c.c_void_p, c.c_char_p, c.c_int, c.c_char_p, c.c_char_p)
    _fields_ = [("logger", LOG), ("allocate", c.c_void_p), ("free", c.c_void_p), ("finished", c.c_void_p), ("environment", c.c_void_p)]


LOG3 = c.CFUNCTYPE(None, c.c_void_p, c.c_int, c.c_char_p, c.c_char_p)


class Fmu:
    """One instance of either version. Every call must be answered by OK."""

    def __init__(self, folder):
        root = xml.parse(folder / "modelDescription.xml").getroot()
        self.two = root.get("fmiVersion") == "2.0"
        self.variables = {}
        for each in root.find("ModelVariables"):
            kind = each[0].tag if self.two else {"Float64": "Real", "Int32": "Integer"}.get(each.tag, each.tag)
            self.variables[each.get("name")] = (int(each.get("valueReference")), kind, each.get("causality"))
        name = root.find("CoSimulation").get("modelIdentifier")
        self.library = c.CDLL(str(folder / "binaries" / ("linux64" if self.two else "x86_64-linux") / (name + ".so")))
        resources = str(folder.resolve() / "resources")
        if self.two:
            self.callbacks = Callbacks2(logger=Callbacks2.LOG(lambda *said: print(said[4].decode(), file=sys.stderr)))
            make = self.library.fmi2Instantiate
            arguments = (b"instance", 1, root.get("guid").encode(), ("file://" + resources).encode(), c.byref(self.callbacks), 0, 0)
        else:
            self.callbacks = LOG3(lambda *said: print(said[3].decode(), file=sys.stderr))
            make = self.library.fmi3InstantiateCoSimulation
            make.argtypes = [c.c_char_p, c.c_char_p, c.c_char_p, c.c_bool, c.c_bool, c.c_bool, c.c_bool, c.c_void_p, c.c_size_t,
                             c.c_void_p, LOG3, c.c_void_p]
            arguments = (b"instance", root.get("instantiationToken").encode(), (resources + "/").encode(), False, False, False, False,
                         None, 0, None, self.callbacks, None)
        make.restype = c.c_void_p
        self.instance = make(*arguments)
        if not self.instance:
            sys.exit("the FMU refuses to be made")

    def call(self, name, *arguments):
        status = getattr(self.library, ("fmi2" if self.two else "fmi3") + name)(c.c_void_p(self.instance), *arguments)
        if status != 0:
            sys.exit(f"{name} answers {status}")

    def start(self, flags):
        for flag in flags:
            self.call("SetBoolean", *self.reference([flag]), *self.values((c.c_int if self.two else c.c_bool) * 1, [0]))
        if self.two:
            self.call("SetupExperiment", 0, c.c_double(0), c.c_double(0), 0, c.c_double(0))
            self.call("EnterInitializationMode")
        else:
            self.call("EnterInitializationMode", c.c_bool(False), c.c_double(0), c.c_double(0), c.c_bool(False), c.c_double(0))

    def reference(self, names):
        return (c.c_uint * len(names))(*(self.variables[name][0] for name in names)), c.c_size_t(len(names))

    def values(self, kind, values=()):
        """As arguments: FMI 3.0 also wants their number."""
        numbers = kind(*values)
        return (numbers,) if self.two else (numbers, c.c_size_t(len(numbers)))

    def step(self, time_s, step_s):
        more = () if self.two else tuple(c.byref(c.c_bool()) for _ in range(3)) + (c.byref(c.c_double()),)
        self.call("DoStep", c.c_double(time_s), c.c_double(step_s), *((1,) if self.two else (c.c_bool(True),)), *more)

    def set(self, values):
        self.call("SetReal" if self.two else "SetFloat64", *self.reference(list(values)), *self.values(c.c_double * len(values), values.values()))

    def get(self, kind, names):
        type_of = {"Real": c.c_double, "Integer": c.c_int, "Boolean": c.c_int if self.two else c.c_bool}[kind]
        function = kind if self.two else {"Real": "Float64", "Integer": "Int32"}.get(kind, kind)
        values = self.values(type_of * len(names))
        self.call("Get" + function, *self.reference(names), *values)
        return [int(value) if kind != "Real" else value for value in values[0]]


def recorded_inputs(recording):
    rows = list(csv.DictReader(open(recording, newline="")))[:SENSOR_RUN_s * 1000]
    columns = {name: [float(row[column]) * scale + offset for row in rows] for name, (column, scale, offset) in SENSOR_COLUMNS.items()}
    return lambda time_s: {name: values[min(round(time_s * 1000), len(rows) - 1)] for name, values in columns.items()}


def course_of_valve(time_s):
    position_m = 2e-3 * (1 - abs(math.fmod(time_s, 4) / 2 - 1)) * (-1 if time_s > 4 else 1)
    return {"position_set": position_m, "pressure_difference_set": 20e5 + 20e5 * math.floor(time_s), "oil_temperature_set": 323.15,
            "ambient_temperature": 298.15}


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    fmu, step_s = Fmu(pathlib.Path(sys.argv[1])), float(sys.argv[3]) * 1e-3
    recording, flags = sys.argv[4:5], sys.argv[5:]
    inputs = recorded_inputs(recording[0]) if recording else course_of_valve
    outputs = {kind: [name for name, (_, its, causality) in fmu.variables.items() if causality == "output" and its == kind]
               for kind in ("Real", "Integer", "Boolean")}
    outputs = {kind: names for kind, names in outputs.items() if names}
    fmu.start(flags)
    fmu.set(inputs(0))
    fmu.call("ExitInitializationMode")
    with open(sys.argv[2], "w", newline="") as out:
        write = csv.writer(out, lineterminator="\n")
        write.writerow(["time", *(name for names in outputs.values() for name in names)])
        for k in range(round((SENSOR_RUN_s if recording else VALVE_RUN_s) / step_s)):
            fmu.set(inputs(k * step_s))
            fmu.step(k * step_s, step_s)
            write.writerow([f"{(k + 1) * step_s:.9g}", *(value for kind, names in outputs.items() for value in fmu.get(kind, names))])
    fmu.call("Terminate")


if __name__ == "__main__":
    main()
