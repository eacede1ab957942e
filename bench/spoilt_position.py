#!/usr/bin/env python3
"""What a position costs that is recorded more coarsely than on the bench.

    bench/spoilt_position.py build/release MODEL.json RUN.csv TRUE_FLOW.csv

Adds noise to the position of RUN.csv, or rounds it, estimates with BUILD's `spoolflow`, and prints for each the 95th percentile
of the errors against the true flow, in percent of the model's rated flow, the share of the samples in the 95 % band, its mean
width, and what is doubted. RUN.csv needs a column position_mm, TRUE_FLOW.csv the flow in L/min in its second one, at the same times.
Standard library only.
"""
import csv
import json
import pathlib
import random
import subprocess
import sys
import tempfile

NOISE_UM = (1.0, 1.5, 2.0, 3.0)
STEPS_UM = (1.0, 2.0, 3.0, 5.0, 10.0)


def fail(message):
    sys.exit(f"spoilt_position: {message}")


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return rows[0], rows[1:]


def spoilt(rows, column, change):
    return [row[:column] + ([f"{change(float(row[column])):.6f}"] if row[column] else [""]) + row[column + 1:] for row in rows]


def judged(command, model, header, rows, truth_L_min, rated_L_min, folder):
    recording, answer = folder / "run.csv", folder / "estimate.csv"
    with open(recording, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([header, *rows])
    done = subprocess.run([command, "estimate", model, recording, "-o", answer, "-q"], stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        fail(done.stderr.strip())
    _, estimates = table(answer)
    numbers = [[float(value) if value else float("nan") for value in row[1:4]] for row in estimates]
    errors = sorted(abs(row[0] - true) for row, true in zip(numbers, truth_L_min))
    within = sum(row[1] <= true <= row[2] for row, true in zip(numbers, truth_L_min))
    width = sum(row[2] - row[1] for row in numbers) / len(numbers)
    doubts = [line.split("doubt: ", 1)[1].split(": ", 1)[1] for line in done.stderr.splitlines() if "doubt: " in line]
    return (100 * errors[int(0.95 * len(errors))] / rated_L_min, 100 * within / len(numbers), 100 * width / rated_L_min,
            doubts[0].split(",")[0] if doubts else "")


def main(arguments):
    if len(arguments) != 4:
        fail(__doc__.split("\n\n")[1].strip())
    command = pathlib.Path(arguments[0]) / "bin" / "spoolflow"
    if not command.exists():
        fail(f"{command}: is not built")
    model = arguments[1]
    rated_L_min = 60000 * json.loads(pathlib.Path(model).read_text(encoding="utf-8"))["valve"]["rated_flow_m3_per_s"]
    header, rows = table(arguments[2])
    if "position_mm" not in header:
        fail(f"{arguments[2]}: has no column position_mm")
    column = header.index("position_mm")
    truth_L_min = [float(row[1]) for row in table(arguments[3])[1]]
    if len(truth_L_min) != len(rows):
        fail(f"{arguments[3]}: has {len(truth_L_min)} rows, {arguments[2]} has {len(rows)}")
    numbers = random.Random(1)
    cases = [("as recorded", lambda x: x)]
    cases += [(f"noise of {um} um more", lambda x, um=um: x + numbers.gauss(0, 1e-3 * um)) for um in NOISE_UM]
    cases += [(f"in steps of {um} um", lambda x, um=um: 1e-3 * um * round(x / (1e-3 * um))) for um in STEPS_UM]
    print("| position | p95 [% FS] | in the band [%] | mean width [% FS] | doubted |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        for what, change in cases:
            p95, within, width, doubt = judged(command, model, header, spoilt(rows, column, change), truth_L_min, rated_L_min,
                                               pathlib.Path(name))
            print(f"| {what} | {p95:.2f} | {within:.1f} | {width:.2f} | {doubt} |", flush=True)


main(sys.argv[1:])
