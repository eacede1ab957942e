#!/usr/bin/env python3
"""Judges clean runs of a judging set's valves at other sampling rates than its 1 kHz: the same scenarios, by the set's models.

    sampling_rates.py SET OUT [--spoolflow PROGRAM] [--rates 500,2000,5000,10000]

SET is made by judging_set.py. OUT gets VALVE.PROGRAMME.RATE.csv with the truth beside it; what is there already is kept. Prints a line a
run: 95th percentile and largest size of the error, share in the band, its mean width, in percent; then each rate pooled.
Standard library only.
"""
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys

import judge
from judging_set import option

PROGRAMMES = ("ramp", "duty")


def judged(job):
    spoolflow, folder, out, valve, programme, rate = job
    place = folder / valve
    recording, truth = (out / f"{valve}.{programme}.{rate}{suffix}.csv" for suffix in ("", ".truth"))
    if not truth.exists():
        text = (place / f"{programme}.clean.toml").read_text(encoding="utf-8")
        text = text.replace('valve = "valve.toml"', f"valve = {json.dumps(str(place.resolve() / 'valve.toml'))}")
        text = text.replace("[run.conditions]\n", f"[run.conditions]\nsample_rate_Hz = {rate}\n")
        scenario = recording.with_suffix(".toml")
        scenario.write_text(text, encoding="utf-8")
        done = subprocess.run([spoolflow, "simulate", str(scenario), "-o", str(recording), "--truth", str(truth), "-q"],
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f"sampling_rates: {done.stderr.strip()}")
    run = {"model": place / "model.json", "recording": recording, "truth": truth, "effect": "clean", "valve": valve, "declared_by": "judged"}
    _, figures, said = judge.judged(run, spoolflow, None)
    if figures is None:
        raise SystemExit(f"sampling_rates: {recording}: {said}")
    return valve, programme, rate, figures


def cells(figures):
    row = figures.row()
    return [row[key] for key in ("p95", "max", "in_band", "width")]


def main(arguments):
    spoolflow = option(arguments, "--spoolflow", "build/release/bin/spoolflow")
    rates = [int(rate) for rate in option(arguments, "--rates", "500,2000,5000,10000").split(",")]
    if len(arguments) != 2:
        sys.exit(f"sampling_rates: {__doc__.split(chr(10) + chr(10))[1]}")
    folder, out = (pathlib.Path(each) for each in arguments)
    valves = sorted(file.parent.name for file in folder.glob("*/valve.toml"))
    if not valves:
        sys.exit(f"sampling_rates: {folder} holds no VALVE/valve.toml; give the folder of a set made by bench/judging_set.py")
    out.mkdir(parents=True, exist_ok=True)
    jobs = [(spoolflow, folder, out, valve, programme, rate) for valve in valves for programme in PROGRAMMES for rate in rates]
    pooled = {rate: judge.Figures() for rate in rates}
    print(judge.line("valve", "run", "Hz", "p95 % FS", "max % FS", "in band %", "mean width % FS"))
    print("|---" * 7 + "|")
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as workers:
        for valve, programme, rate, figures in workers.map(judged, jobs):
            print(judge.line(valve, programme, rate, *cells(figures)), flush=True)
            pooled[rate].merge(figures)
    for rate, figures in pooled.items():
        print(judge.line("all", "pooled", rate, *cells(figures)))


if __name__ == "__main__":
    main(sys.argv[1:])
