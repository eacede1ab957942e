#!/usr/bin/env python3
"""Both sensors against the true flow: a table in Markdown, one row a run.

true_flow.py SPOOLFLOW MODEL.json RECORDING.csv TRUTH.csv [RECORDING.csv TRUTH.csv ...]

Estimates each recording with both sensors and compares with TRUTH.csv (time_s and a column flow_L_min, or flow_..._L_min
of `simulate --truth`) at the same time stamps. Figures are in percent of the model's rated flow: 95th percentile and largest
size of the error; of the observer's 95 % band the share of samples inside and its mean width over the RMS error.
Standard library only.
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile


def fail(message):
    sys.exit(f"true_flow: {message}")


def columns(path, names):
    with open(path, newline="") as file:
        rows = csv.reader(line for line in file if not line.startswith("#"))
        head = next(rows)
        for name in names:
            if name not in head:
                fail(f"{path}: no column {name!r}; it has {', '.join(head)}")
        at = [head.index(name) for name in names]
        return [[float(row[k]) if row[k] else math.nan for k in at] for row in rows]


def true_flow(path):
    with open(path, newline="") as file:
        head = next(csv.reader(line for line in file if not line.startswith("#")))
    flows = [name for name in head if name.startswith("flow") and name.endswith("L_min")]
    if not flows:
        fail(f"{path}: no column flow_L_min; it has {', '.join(head)}")
    return [row[0] for row in columns(path, [flows[0]])]


def figures(spoolflow, model, recording, truth, estimator, full_scale):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "estimate.csv"
        subprocess.run([spoolflow, "estimate", model, recording, "-o", out, "--estimator", estimator, "-q"], check=True)
        rows = columns(out, ["flow_L_min", "flow_lower_L_min", "flow_upper_L_min"])
    if len(rows) != len(truth):
        fail(f"{recording}: {len(rows)} estimates for {len(truth)} true flows; give the truth of the same run")
    errors = sorted(abs(row[0] - q) for row, q in zip(rows, truth))
    rms = math.sqrt(sum(e * e for e in errors) / len(errors))
    inside = sum(row[1] <= q <= row[2] for row, q in zip(rows, truth)) / len(rows)
    width = sum(row[2] - row[1] for row in rows) / len(rows)
    percent = 100 / full_scale
    return errors[int(0.95 * len(errors))] * percent, errors[-1] * percent, 100 * inside, width / rms


def main(arguments):
    if len(arguments) < 4 or len(arguments) % 2:
        fail(__doc__.split("\n\n")[1])
    spoolflow, model, *files = arguments
    full_scale = 60000 * json.load(open(model))["valve"]["rated_flow_m3_per_s"]
    print("| run | condensed: p95 / max | observer: p95 / max | inside the 95 % band | mean band width / RMS error |")
    print("|---|---|---|---|---|")
    for recording, truth_file in zip(files[::2], files[1::2]):
        truth = true_flow(truth_file)
        condensed = figures(spoolflow, model, recording, truth, "condensed", full_scale)
        observer = figures(spoolflow, model, recording, truth, "observer", full_scale)
        print(f"| {pathlib.Path(recording).stem} | {condensed[0]:.1f} / {condensed[1]:.0f} | "
              f"{observer[0]:.2f} / {observer[1]:.1f} | {observer[2]:.1f} % | {observer[3]:.1f} |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
