#!/usr/bin/env python3
"""Whether `spoolflow monitor` raises friction + 50 % from four ordinary runs of two to four minutes, and nothing on the healthy valve.

    friction_in_four_runs.py OUT [SEED ...] [--spoolflow PROGRAM]

A `size_6` valve drawn from its series by each seed is calibrated by its own campaign; then it runs, healthy and with friction + 50 %, through triangles at
five pressure differences, slow triangles at three, and two duty cycles, which are judged together, without a baseline. Prints NE 107 and causes
with their odds; ends with 1 where one valve is judged wrongly. What is there already is not made again. Everything is simulated. Standard library only.
"""
import json
import pathlib
import sys

import references_on_rig as rig

SEEDS = (1913, 5102, 6202, 7301, 7302, 9401)
DUTY = ("lowest_pressure_bar = 15\nhighest_pressure_bar = 62\nlongest_hold_s = 3\nlongest_pressure_hold_s = 6\nslowest_percent_per_s = 10\n"
        "duration_s = 150\n")
RUNS = {"triangles": ("ramps", "pressure_differences_bar = [30, 40, 50, 60, 70]\n"),
        "slow": ("ramps", "pressure_differences_bar = [60, 45, 60]\nrate_percent_per_s = 5\n"),
        "duty_wide": ("duty_cycle", DUTY + "lowest_percent = 8\nhighest_percent = 92\nfastest_percent_per_s = 110\n"),
        "duty_narrow": ("duty_cycle", DUTY + "lowest_percent = 15\nhighest_percent = 80\nfastest_percent_per_s = 60\n")}
VALVES = {"healthy": "", "friction": "[wear]\nfriction_factor = 1.5\n"}


def recorded(spoolflow, folder, seed, valve):
    out = []
    for number, (name, (protocol, run)) in enumerate(RUNS.items()):
        file, scenario = folder / f"{valve}_{name}.csv", folder / f"{valve}_{name}.toml"
        if not file.exists():
            scenario.write_text(f'protocol = "{protocol}"\nvalve = "{valve}.toml"\nseed = {10 * seed + number}\n[run]\n{run}')
            rig.must(spoolflow, "simulate", scenario, "-o", file, "-q")
        out.append(file)
    return out


def main(arguments):
    spoolflow = rig.option(arguments, "--spoolflow", "build/release/bin/spoolflow")
    if not arguments:
        sys.exit("friction_in_four_runs.py OUT [SEED ...] [--spoolflow PROGRAM]")
    wrong = False
    for seed in [int(word) for word in arguments[1:]] or SEEDS:
        folder = pathlib.Path(arguments[0]) / f"{seed}"
        folder.mkdir(parents=True, exist_ok=True)
        for valve, wear in VALVES.items():
            (folder / f"{valve}.toml").write_text(rig.base_of(seed) + wear)
        rig.calibrate(spoolflow, folder, "healthy", "model.json")
        for valve in VALVES:
            condition = folder / f"{valve}.json"
            rig.must(spoolflow, "monitor", folder / "model.json", *recorded(spoolflow, folder, seed, valve), "--json", condition, "-q")
            found = json.loads(condition.read_text())
            causes = [(each["cause"], each["odds"]) for each in found["causes"]]
            ratio = next(each["value"] for each in found["indicators"] if each["name"] == "friction_ratio")
            right = causes == [] if valve == "healthy" else causes[:1] != [] and causes[0][0] == "friction"
            wrong = wrong or not right
            shown = ", ".join(f"{cause} ({odds:.3g})" for cause, odds in causes)
            print(f"{seed:6} {valve:9} {found['ne107']:5} friction ratio {ratio:.2f}  {shown}{'' if right else '  WRONG'}", flush=True)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main(sys.argv[1:])
