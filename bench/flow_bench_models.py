#!/usr/bin/env python3
"""Models of a judging set's valves from a flow bench alone, made on the virtual rig.

    flow_bench_models.py SET OUT [--spoolflow PROGRAM] [--only VALVE]

Each valve of SET (judging_set.py) is measured on a flow bench into OUT/VALVE, and calibrated into OUT/VALVE.json; what is there
already is kept. Then

    judge.py SET --json force.json --only clean
    judge.py SET --calibrate OUT --before force.json --only clean

prints 95th percentile and largest error, share in the band and width beside those of the models from force benches. Standard library
only.
"""
import concurrent.futures
import pathlib
import subprocess
import sys

from judging_set import option


def run(*command):
    done = subprocess.run([str(part) for part in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    return None if done.returncode == 0 else done.stderr.strip()


def made(spoolflow, valve, out):
    """Why the valve's model could not be made; None where it was."""
    bench, model = out / valve.name, out / f"{valve.name}.json"
    if not (bench / "campaign.toml").exists():
        failure = run(spoolflow, "campaign", valve / "valve.toml", "--bench", "flow", "--calibration-only", "-q", "-o", bench)
        if failure:
            return failure
    return None if model.exists() else run(spoolflow, "calibrate", "-q", bench / "campaign.toml", "-o", model)


def main(arguments):
    spoolflow = option(arguments, "--spoolflow", "build/release/bin/spoolflow")
    only = option(arguments, "--only", "")
    if len(arguments) != 2:
        sys.exit(f"flow_bench_models: {__doc__.split(chr(10) + chr(10))[1]}")
    folder, out = (pathlib.Path(each) for each in arguments)
    valves = sorted(file.parent for file in folder.glob("*/valve.toml") if only in file.parent.name)
    if not valves:
        sys.exit(f"flow_bench_models: {folder} holds no VALVE/valve.toml; give the folder of a set made by bench/judging_set.py")
    out.mkdir(parents=True, exist_ok=True)
    failed = False
    with concurrent.futures.ThreadPoolExecutor(2) as workers:
        for valve, failure in zip(valves, workers.map(lambda valve: made(spoolflow, valve, out), valves)):
            print(f"{valve.name}: {failure or out / (valve.name + '.json')}", flush=True)
            failed = failed or failure is not None
    sys.exit(failed)


if __name__ == "__main__":
    main(sys.argv[1:])
