"""dither_limit_on_rig.py SPOOLFLOW MODEL.json PRESET FOLDER [sine|square] [Hz ...]: at which amplitude of the coil current
dither brings the flow ripple to its limit, as `analyse --dither` predicts it and on the virtual rig, under the position control.
Runs SPOOLFLOW; its files go to FOLDER. The spool rests at three openings under four pressure differences; ripple is half of
peak to peak at the dither's frequency in the rig's true flow, the largest of all rests, and the coil current the median over
them. Printed for each frequency: the predicted amplitude, and the rig's between the largest that kept the limit and the
smallest that broke it, in 10 % steps; their ratio is what the recommendation must keep in reserve."""

import csv
import json
import math
import pathlib
import subprocess
import sys

spoolflow, model, preset, folder = sys.argv[1:5]
shape = sys.argv[5] if len(sys.argv) > 5 else "sine"
frequencies = [float(f) for f in sys.argv[6:]] or [80, 120, 160, 200, 240]
folder = pathlib.Path(folder)
folder.mkdir(parents=True, exist_ok=True)
POSITIONS = [40, 60, 80]  # percent of the stroke
LEVELS = [14, 18, 24, 29] if "10" in preset else [20, 35, 50, 65]  # bar
HOLD_S, LAST_S, RATE_HZ = 1.0, 0.5, 2500
STEP = 1.1


def columns(file):
    with open(file) as lines:
        rows = csv.reader(lines)
        names = next(rows)
        return dict(zip(names, zip(*[[float(x) if x else math.nan for x in row] for row in rows])))


def at_frequency(time_s, values, frequency_hz):
    """Amplitude of the part at that frequency, over whole periods."""
    whole = math.floor((time_s[-1] - time_s[0]) * frequency_hz) / frequency_hz
    part = [(t, v) for t, v in zip(time_s, values) if t - time_s[0] < whole - 1e-9]
    mean = sum(v for _, v in part) / len(part)
    a = sum((v - mean) * math.cos(2 * math.pi * frequency_hz * t) for t, v in part)
    b = sum((v - mean) * math.sin(2 * math.pi * frequency_hz * t) for t, v in part)
    return 2 * math.hypot(a, b) / len(part)


def predicted():
    scenario, out = folder / "points.toml", folder / "predicted.json"
    scenario.write_text(f"[points]\npositions_percent = {POSITIONS}\npressure_differences_bar = {LEVELS}\n")
    subprocess.run([spoolflow, "analyse", model, "--dither", "--dither-shape", shape, "--scenario", scenario, "--json", out],
                   check=True, stdout=subprocess.DEVNULL)
    return json.load(open(out))


def predicted_limit_A(study, limit, frequency_Hz):
    """Smallest amplitude at which a point's ripple reaches the limit; the largest there is where none does."""
    near = min({e[1] for e in study["points"][0]["effects"]}, key=lambda f: abs(f - frequency_Hz))
    least = math.inf
    for point in study["points"]:
        at = sorted((e[0], e[5]) for e in point["effects"] if e[1] == near)
        least = min([least] + [a for a, ripple in at if ripple > limit])
    return (least, True) if least < math.inf else (max(e[0] for e in study["points"][0]["effects"]), False)


def on_rig(set_A, frequency_Hz):
    scenario, run, truth_file = folder / "run.toml", folder / "run.csv", folder / "run.truth.csv"
    scenario.write_text(f"""protocol = "pressure_steps"
valve = "{preset}"
seed = 11
[run]
positions_percent = {POSITIONS}
pressure_differences_bar = {LEVELS}
hold_s = {HOLD_S}
[run.conditions]
sample_rate_Hz = {RATE_HZ}
[electronics.dither]
amplitude_A = {set_A:.4f}
frequency_Hz = {frequency_Hz}
shape = "{shape}"
""")
    subprocess.run([spoolflow, "simulate", scenario, "-o", run, "--truth", truth_file, "--quiet"], check=True)
    truth = columns(truth_file)
    time_s, coils, ripple = truth["time_s"], [], 0
    start_s, before = 0.5, 0
    for percent in POSITIONS:
        start_s += abs(percent - before) / 50 + 1
        before = percent
        for _ in LEVELS:
            end = round((start_s + HOLD_S) * RATE_HZ)
            part = slice(end - round(LAST_S * RATE_HZ), end - 3)
            coils.append(at_frequency(time_s[part], truth["current_A"][part], frequency_Hz))
            ripple = max(ripple, at_frequency(time_s[part], truth["flow_L_min"][part], frequency_Hz))
            start_s += HOLD_S
    return sorted(coils)[len(coils) // 2], ripple


full_scale = 60000 * json.load(open(model))["valve"]["rated_flow_m3_per_s"]
limit = 0.005 * full_scale
study = predicted()
for frequency_Hz in frequencies:
    predicted_A, reached = predicted_limit_A(study, limit, frequency_Hz)
    kept, broken, set_A = None, None, predicted_A
    for _ in range(9):
        coil_A, ripple = on_rig(min(set_A, 1.0), frequency_Hz)
        if ripple > limit:
            broken = (coil_A, ripple)
            if kept:
                break
            set_A /= STEP
        else:
            kept = (coil_A, ripple)
            if broken or set_A >= 1.0 or coil_A > 1.3 * predicted_A:
                break
            set_A *= STEP
    text = lambda pair: f"{pair[0]:.3f} A ({pair[1]:.3f} L/min)" if pair else "-"
    print(f"{preset}, {shape}, {frequency_Hz:.0f} Hz: limit {limit:.2f} L/min predicted at {predicted_A:.3f} A{'' if reached else ' or more'}; rig "
          f"keeps it at {text(kept)}, breaks it at {text(broken)}", flush=True)
