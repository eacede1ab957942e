#!/usr/bin/env python3
"""Runs the sensor's FMUs in independent importers and holds them against `spoolflow estimate`.

    foreign_importers.py MODEL.json RECORDING.csv [SECONDS=20] [SPOOLFLOW=build/release/bin/spoolflow]

Exports the sensor's FMU by FMI 2.0 and 3.0, has each importer check it where it can, and runs the first SECONDS of the
recording through it at several communication steps. One line a run: the largest difference to `estimate` in flow and
band, in parts of full scale (half of the last digit of estimate's CSV is among it), and how many rows differ in status.
Exit status 1 where a difference is above 1e-6, a status differs, or an importer finds a problem; 2 where no importer is
installed.

Importers: FMPy (the package fmpy of this Python; numpy is needed in any case) and fmusim (a command on PATH). What is
missing is said. RECORDING.csv has time_s, current_A, voltage_V, position_mm, oil_temperature_C, a row each millisecond.
"""
import csv
import html
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

import numpy as np

SAMPLE_STEP_s = 1e-3
COMMUNICATION_STEPS_s = [1e-3, 4e-3, 0.4e-3, 0.7e-3]
INPUTS = ["current", "voltage", "position", "oil_temperature"]  # of the FMU, SI
COLUMNS = ["current_A", "voltage_V", "position_mm", "oil_temperature_C"]
OUTPUTS = ["flow", "flow_lower", "flow_upper"]
LIMIT = 1e-6  # of full scale


def read_columns(file, names):
    with open(file, newline="") as lines:
        rows = csv.DictReader(lines)
        missing = [name for name in names if name not in rows.fieldnames]
        if missing:
            sys.exit(f"{file}: no column {', '.join(missing)}; there are {', '.join(rows.fieldnames)}")
        return {name: np.array(column) for name, column in zip(names, zip(*([row[name] for name in names] for row in rows)))}


def to_si(column, values):
    return {"position_mm": lambda v: v * 1e-3, "oil_temperature_C": lambda v: v + 273.15}.get(column, lambda v: v)(values)


def seen_by_sensor(time, columns, step):
    """Inputs at each sample: importers set them at communication points, interpolated between rows, and hold them."""
    since = time - time[0]
    points = time[0] + np.floor(since / step + 1e-6) * step
    return {name: np.interp(points, time, values) for name, values in columns.items()}


def write_columns(path, time_name, time, columns):
    with open(path, "w", newline="") as out:
        write = csv.writer(out)
        write.writerow([time_name, *columns])
        write.writerows(zip(time.tolist(), *(values.tolist() for values in columns.values())))


def estimate(spoolflow, model, folder, time, columns):
    recording, result = folder / "held.csv", folder / "estimate.csv"
    write_columns(recording, "time_s", time, columns)
    subprocess.run([spoolflow, "estimate", model, recording, "-o", result, "--quiet"], check=True)
    columns = read_columns(result, ["flow_L_min", "flow_lower_L_min", "flow_upper_L_min", "status"])
    return np.array([columns[name].astype(float) / 60000 for name in list(columns)[:3]]), columns["status"]


def status_names(fmu):
    """Names of the status bits, from the FMU's own documentation page."""
    page = zipfile.ZipFile(fmu).read("documentation/index.html").decode()
    return {int(bit): html.unescape(name) for bit, name in re.findall(r"<tr><td>(\d+)</td><td>(\w+)</td></tr>", page)}


def fmpy_run(fmu, step, time, inputs, folder):
    import fmpy
    table = np.rec.fromarrays([time, *inputs.values()], names=["time", *inputs])
    result = fmpy.simulate_fmu(str(fmu), start_time=time[0], stop_time=time[-1], output_interval=step, input=table,
                               output=[*OUTPUTS, "status"])
    return result["time"], np.array([result[name] for name in OUTPUTS]), result["status"].astype(int)


def fmpy_problems(fmu):
    from fmpy.validation import validate_fmu
    return validate_fmu(str(fmu))


def fmusim_run(fmu, step, time, inputs, folder):
    table, out = folder / "inputs.csv", folder / "outputs.csv"
    write_columns(table, "time", time, inputs)
    recorded = [word for name in [*OUTPUTS, "status"] for word in ("--output-variable", name)]
    subprocess.run(["fmusim", "--interface-type", "cs", "--start-time", repr(float(time[0])), "--stop-time",
                    repr(float(time[-1])), "--output-interval", repr(step), "--input-file", table, "--output-file", out,
                    *recorded, fmu], check=True, stdout=subprocess.DEVNULL)
    columns = read_columns(out, ["time", *OUTPUTS, "status"])
    return (columns["time"].astype(float), np.array([columns[name].astype(float) for name in OUTPUTS]),
            columns["status"].astype(int))


def importers():
    try:
        import fmpy
        yield f"FMPy {fmpy.__version__}", fmpy_run, fmpy_problems
    except ImportError:
        print("FMPy is missing (pip install fmpy): not run")
    if shutil.which("fmusim"):
        said = subprocess.run(["fmusim", "--version"], capture_output=True, text=True).stdout
        yield "fmusim " + "".join(re.findall(r"\d+\.\d+\.\d+", said)[:1]), fmusim_run, lambda fmu: []
    else:
        print("fmusim is missing (a command of modelica/Reference-FMUs): not run")


def main():
    if not 3 <= len(sys.argv) <= 5:
        sys.exit(__doc__)
    model, recording = sys.argv[1:3]
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 20
    built = pathlib.Path(__file__).parent.parent / "build/release/bin/spoolflow"
    spoolflow = sys.argv[4] if len(sys.argv) > 4 else str(built)
    full_scale = json.load(open(model))["valve"]["rated_flow_m3_per_s"]
    text = read_columns(recording, ["time_s", *COLUMNS])
    time = text.pop("time_s").astype(float)
    asked = time - time[0] <= seconds
    time = time[asked]
    columns = {name: values.astype(float)[asked] for name, values in text.items()}
    inputs = {name: to_si(column, columns[column]) for name, column in zip(INPUTS, COLUMNS)}
    installed, failed = list(importers()), False
    if not installed:
        sys.exit(2)
    print(f"{len(time)} rows of {recording}")
    print("importer        FMI  step     steps  largest difference [full scale]      status differs")
    with tempfile.TemporaryDirectory(prefix="foreign_importers_") as name:
        folder = pathlib.Path(name)
        for version in ("2", "3"):
            fmu = folder / f"sensor{version}.fmu"
            subprocess.run([spoolflow, "export", "fmu", model, "-o", fmu, "--fmi", version], check=True)
            names = status_names(fmu)
            for who, run, problems in installed:
                for problem in problems(fmu):
                    print(f"{who}: {problem}")
                    failed = True
                for step in COMMUNICATION_STEPS_s:
                    expected, status = estimate(spoolflow, model, folder, time, seen_by_sensor(time, columns, step))
                    times, flows, bits = run(fmu, step, time, inputs, folder)
                    # What can be read at a communication point answers the last sample before it.
                    rows = np.ceil((times - time[0]) / SAMPLE_STEP_s - 1e-6).astype(int) - 1
                    answered = rows >= 0
                    rows = rows[answered]
                    differences = np.abs(flows[:, answered] - expected[:, rows]).max(axis=1) / full_scale
                    words = {value: "|".join(word for bit, word in names.items() if value & bit) for value in set(bits)}
                    wrong = sum(words[value] != status[row] for value, row in zip(bits[answered], rows))
                    failed = failed or not differences.max() <= LIMIT or wrong > 0 or len(rows) < 2
                    print(f"{who:<15} {version}.0  {step * 1e3:.1f} ms {len(rows):7}  flow {differences[0]:.1e} lower "
                          f"{differences[1]:.1e} upper {differences[2]:.1e}  {wrong}", flush=True)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
