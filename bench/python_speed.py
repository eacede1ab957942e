#!/usr/bin/env python3
"""A million samples in arrays through the Python package, beside the library called from C++.

    PYTHONPATH=build/release/python /usr/bin/python3 bench/python_speed.py build/release/bench/estimate_in_memory MODEL.json RECORDING

The recording is repeated until it has 1e6 samples. Both end with a million answers in memory that was allocated for them, in
large pages; what the library takes where it keeps none, as in `spoolflow estimate`, stands beside it. They take turns, round after
round; of each the least processor time counts: who else uses the machine disturbs it less than the time of the clock.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np

import spoolflow

SAMPLES = 1_000_000
ROUNDS = 7
LARGE_PAGES = {"GLIBC_TUNABLES": "glibc.malloc.hugetlb=1"}


def main(in_memory, model_file, recording_file):
    model = spoolflow.load_model(model_file)
    run = spoolflow.read_recording(recording_file)
    names = ("current_A", "voltage_V", "position_m", "oil_temperature_K")
    samples = {name: np.ascontiguousarray(np.resize(run[name], SAMPLES)) for name in names if name in run}
    samples["time_s"] = np.arange(SAMPLES) * float(np.median(np.diff(run.time_s)))
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "run.csv"
        np.savetxt(file, np.column_stack(list(samples.values())), fmt="%.9g", delimiter=",", header=",".join(samples),
                   comments="")
        fastest = {estimator: [float("inf")] * 3 for estimator in model.estimators}
        for _ in range(ROUNDS):
            said = subprocess.run([in_memory, model_file, file, "1"], stdout=subprocess.PIPE, text=True, check=True,
                                  env=os.environ | LARGE_PAGES).stdout
            for line in said.splitlines():
                estimator, *seconds = line.split()
                for k, each in enumerate(seconds):
                    fastest[estimator][k] = min(fastest[estimator][k], float(each))
            for estimator in model.estimators:
                begun = time.process_time()
                model.estimate(samples, estimator=estimator)
                fastest[estimator][2] = min(fastest[estimator][2], time.process_time() - begun)
    print(f"{SAMPLES} samples, least processor time of {ROUNDS} rounds")
    for estimator, (library_s, keeping_none_s, python_s) in fastest.items():
        print(f"{estimator:10} library {library_s:.3f} s (keeping none {keeping_none_s:.3f} s), Python {python_s:.3f} s, "
              f"ratio {python_s / library_s:.3f} (wanted: at most 1.10)")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
