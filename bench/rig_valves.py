#!/usr/bin/env python3
"""Both sensors on the virtual rig's presets against the true flow: a table in Markdown, one row a run, one column a preset.

rig_valves.py SPOOLFLOW FOLDER [size_6 size_10 fast_dither] [-k KEY=VALUE]

Calibrates each preset from its own campaign (seed 1) and judges the model on runs of another seed, made in FOLDER/PRESET;
runs that are there already are taken as they are. Each cell: 95th percentile of the condensed sensor; 95th percentile and
largest error of the observer in percent of the rated flow; the share of samples inside its 95 % band; the band's mean
width over the RMS error. -k sets one number of each model's observer before it is judged. Standard library only.
"""
import concurrent.futures
import json
import pathlib
import subprocess
import sys

from true_flow import figures, true_flow

SEED = 2
RAMP_BAR = {"size_10": 25}
DITHER = "[electronics.dither]\namplitude_A = {}\nfrequency_Hz = {}\n"
RUNS = {  # name: (row, protocol, lines of [run], (amplitude, frequency) of dither or none at all)
    "ramp": ("ramp at 60 (size_10: 25) bar, no dither", "ramps", "pressure_differences_bar = [{ramp_bar}]", (0, 140)),
    "ramp_dither": ("the same with 0.10 A at 140 Hz", "ramps", "pressure_differences_bar = [{ramp_bar}]", (0.1, 140)),
    "duty": ("duty cycle, no dither", "duty_cycle", "", (0, 110)),
    "duty_dither": ("the same with 0.10 A at 110 Hz", "duty_cycle", "", (0.1, 110)),
    "sweep": ("sine sweep to 8 Hz", "sine", "frequency_start_Hz = 0.1\nfrequency_end_Hz = 8\nsweep_s = 40", (0, 110)),
    "fast": ("fast motion, 10 kHz", "fast_motion", "", (0, 110)),
}


def run(*command):
    subprocess.run([str(part) for part in command], check=True)


def judged(spoolflow, folder, preset, changes):
    folder = folder / preset
    if not (folder / "campaign" / "campaign.toml").exists():
        run(spoolflow, "campaign", preset, "-o", folder / "campaign", "--calibration-only", "-q")
    file = folder / "model.json"
    run(spoolflow, "calibrate", folder / "campaign" / "campaign.toml", "-o", file, "-q")
    model = json.loads(file.read_text())
    for key, value in changes:
        if key not in model["observer"]:
            sys.exit(f"rig_valves: {key!r} is no number of the observer; docs/formats/parameters.md lists them")
        model["observer"][key] = float(value)
    if changes:
        file.write_text(json.dumps(model))
    full_scale = 60000 * model["valve"]["rated_flow_m3_per_s"]
    cells = {}
    for name, (_, protocol, lines, (amplitude_A, frequency_Hz)) in RUNS.items():
        scenario, recording, truth = folder / f"{name}.toml", folder / f"{name}.csv", folder / f"{name}.truth.csv"
        if not truth.exists():
            scenario.write_text(f'protocol = "{protocol}"\nvalve = "{preset}"\nseed = {SEED}\n[run]\n'
                                + lines.format(ramp_bar=RAMP_BAR.get(preset, 60)) + "\n"
                                + DITHER.format(amplitude_A, frequency_Hz))
            run(spoolflow, "simulate", scenario, "-o", recording, "--truth", truth, "-q")
        flow = true_flow(truth)
        condensed = figures(spoolflow, file, recording, flow, "condensed", full_scale)
        observer = figures(spoolflow, file, recording, flow, "observer", full_scale)
        cells[name] = (f"{condensed[0]:.1f}, {observer[0]:.2f} / {observer[1]:.1f}, {observer[2]:.1f} %, "
                       f"{observer[3]:.1f}")
    return cells


def main(arguments):
    changes = []
    while "-k" in arguments:
        at = arguments.index("-k")
        changes.append(arguments[at + 1].split("="))
        del arguments[at:at + 2]
    if len(arguments) < 2:
        sys.exit(f"rig_valves: {__doc__.split(chr(10) + chr(10))[1]}")
    spoolflow, folder = arguments[0], pathlib.Path(arguments[1])
    presets = arguments[2:] or ["size_6", "size_10", "fast_dither"]
    for preset in presets:
        (folder / preset).mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(2) as workers:
        columns = list(workers.map(lambda preset: judged(spoolflow, folder, preset, changes), presets))
    print("| run | " + " | ".join(presets) + " |")
    print("|---" * (len(presets) + 1) + "|")
    for name, (row, *_) in RUNS.items():
        print(f"| {row} | " + " | ".join(column[name] for column in columns) + " |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
