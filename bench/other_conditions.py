#!/usr/bin/env python3
"""Judges clean runs of a judging set's valves under another condition than the set's 1 kHz or 50 degC: the same scenarios.

    other_conditions.py SET OUT --rates 500,2000,5000,10000 [--models DIR] [--spoolflow PROGRAM]
    other_conditions.py SET OUT --oil 0,15,80,90 [--models DIR] [--spoolflow PROGRAM]

SET is made by judging_set.py; --rates in Hz, --oil in degC. DIR holds VALVE.json (judge.py --calibrate); without it the set's models
count. OUT gets VALVE.PROGRAMME.CONDITION.csv with the truth beside it; what is there already is kept. Prints a line a run: 95th
percentile and largest size of the error, share in the band, its mean width, in percent; then each condition pooled. Standard library only.
"""
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys

import judge
from judging_set import option

PROGRAMMES = ("ramp", "duty")


def under_rate(text, rate):
    return text.replace("[run.conditions]\n", f"[run.conditions]\nsample_rate_Hz = {rate}\n")


def under_oil(text, temperature):
    return re.sub(r"(oil_temperature_(?:start|end)_C) = .*", rf"\1 = {temperature}", text)


def judged(job):
    spoolflow, folder, out, models, valve, programme, change, value = job
    place = folder / valve
    recording, truth = (out / f"{valve}.{programme}.{value}{suffix}.csv" for suffix in ("", ".truth"))
    if not truth.exists():
        text = (place / f"{programme}.clean.toml").read_text(encoding="utf-8")
        text = change(text.replace('valve = "valve.toml"', f"valve = {json.dumps(str(place.resolve() / 'valve.toml'))}"), value)
        scenario = recording.with_suffix(".toml")
        scenario.write_text(text, encoding="utf-8")
        done = subprocess.run([spoolflow, "simulate", str(scenario), "-o", str(recording), "--truth", str(truth), "-q"],
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f"other_conditions: {done.stderr.strip()}")
    model = pathlib.Path(models) / f"{valve}.json" if models else place / "model.json"
    run = {"model": model, "recording": recording, "truth": truth, "effect": "clean", "valve": valve, "declared_by": "judged"}
    _, figures, said = judge.judged(run, spoolflow, None)
    if figures is None:
        raise SystemExit(f"other_conditions: {recording}: {said}")
    return valve, programme, value, figures


def cells(figures):
    row = figures.row()
    return [row[key] for key in ("p95", "max", "in_band", "width")]


def main(arguments):
    spoolflow, models = option(arguments, "--spoolflow", "build/release/bin/spoolflow"), option(arguments, "--models")
    rates, oil = option(arguments, "--rates"), option(arguments, "--oil")
    if len(arguments) != 2 or bool(rates) == bool(oil):
        sys.exit(f"other_conditions: {__doc__.split(chr(10) + chr(10))[1]}")
    change, unit, values = (under_rate, "Hz", rates) if rates else (under_oil, "degC", oil)
    values = values.split(",")
    folder, out = (pathlib.Path(each) for each in arguments)
    valves = sorted(file.parent.name for file in folder.glob("*/valve.toml"))
    if not valves:
        sys.exit(f"other_conditions: {folder} holds no VALVE/valve.toml; give the folder of a set made by bench/judging_set.py")
    out.mkdir(parents=True, exist_ok=True)
    jobs = [(spoolflow, folder, out, models, valve, programme, change, value)
            for valve in valves for programme in PROGRAMMES for value in values]
    pooled = {value: judge.Figures() for value in values}
    print(judge.line("valve", "run", unit, "p95 % FS", "max % FS", "in band %", "mean width % FS"))
    print("|---" * 7 + "|")
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as workers:
        for valve, programme, value, figures in workers.map(judged, jobs):
            print(judge.line(valve, programme, value, *cells(figures)), flush=True)
            pooled[value].merge(figures)
    for value, figures in pooled.items():
        print(judge.line("all", "pooled", value, *cells(figures)))


if __name__ == "__main__":
    main(sys.argv[1:])
