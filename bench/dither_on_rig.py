"""dither_on_rig.py SPOOLFLOW MODEL.json PRESET FOLDER [-v]: the dither motion and the flow ripple that `analyse --dither` predicts
beside those of the virtual rig's truth, while the spool rests under random steps of the pressure difference. Runs
SPOOLFLOW; its files go to FOLDER. Settings: the recommended one, and half and one and a half times its amplitude. Printed:
medians over all rests of half of peak to peak, the rig's at the dither's frequency; the spool "holds" where it gives way
elastically only. -v prints every rest."""

import csv
import json
import math
import pathlib
import random
import subprocess
import sys

spoolflow, model, preset, folder = sys.argv[1:5]
folder = pathlib.Path(folder)
folder.mkdir(parents=True, exist_ok=True)
POSITIONS = [40, 60, 80]  # percent of the stroke
HOLD_S, TOLD_S = 1.5, 0.5
MOVES_UM = 3  # more is no elastic motion


def columns(file):
    with open(file) as lines:
        rows = csv.reader(lines)
        names = next(rows)
        return dict(zip(names, zip(*[[float(x) if x else math.nan for x in row] for row in rows])))


def predicted(points_bar=None):
    out = folder / "predicted.json"
    command = [spoolflow, "analyse", model, "--dither", "--json", out]
    if points_bar:
        scenario = folder / "points.toml"
        scenario.write_text(f"[points]\npositions_percent = {POSITIONS}\npressure_differences_bar = {points_bar}\n")
        command += ["--scenario", scenario]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return json.load(open(out))


def at_frequency(time_s, values, frequency_hz):
    """Amplitude of the part at that frequency, over whole periods."""
    whole = math.floor((time_s[-1] - time_s[0]) * frequency_hz) / frequency_hz
    part = [(t, v) for t, v in zip(time_s, values) if t - time_s[0] < whole]
    mean = sum(v for _, v in part) / len(part)
    a = sum((v - mean) * math.cos(2 * math.pi * frequency_hz * t) for t, v in part)
    b = sum((v - mean) * math.sin(2 * math.pi * frequency_hz * t) for t, v in part)
    return 2 * math.hypot(a, b) / len(part)


def interpolated(effects, amplitude_A, frequency_Hz, column):
    near = min({e[1] for e in effects}, key=lambda f: abs(f - frequency_Hz))
    at = sorted((e[0], e[column]) for e in effects if e[1] == near)
    for (x0, y0), (x1, y1) in zip(at, at[1:]):
        if x0 <= amplitude_A <= x1:
            return y0 + (y1 - y0) * (amplitude_A - x0) / (x1 - x0)
    return math.nan


def simulated(name, set_A, frequency_Hz, levels_bar):
    scenario = folder / f"{name}.toml"
    scenario.write_text(f"""protocol = "pressure_steps"
valve = "{preset}"
seed = 11
[run]
positions_percent = {POSITIONS}
pressure_differences_bar = {levels_bar}
hold_s = {HOLD_S}
[run.conditions]
sample_rate_Hz = 10000
[electronics.dither]
amplitude_A = {set_A}
frequency_Hz = {frequency_Hz}
""")
    run, truth = folder / f"{name}.csv", folder / f"{name}.truth.csv"
    subprocess.run([spoolflow, "simulate", scenario, "-o", run, "--truth", truth, "--quiet"], check=True)
    return columns(truth)


def rests(truth, levels_bar):
    """Stretches at the end of each hold: position, level, samples."""
    time_s = truth["time_s"]
    rate = round(1 / (time_s[1] - time_s[0]))
    start_s, before = 0.5, 0
    for percent in POSITIONS:
        start_s += abs(percent - before) / 50 + 1
        before = percent
        for level in levels_bar:
            end = round((start_s + HOLD_S) * rate)
            yield percent, level, slice(end - round(TOLD_S * rate), end - 5)
            start_s += HOLD_S


def median(values):
    values = sorted(values)
    return values[len(values) // 2] if values else math.nan


draw = random.Random(5)
levels = [round(draw.uniform(*((8, 30) if preset == "size_10" else (15, 70))), 1) for _ in range(6)]
study = predicted(sorted(set(levels)))
best = predicted()["recommended"]
print(f"{preset}: recommended {best['amplitude_A']:.3f} A at {best['frequency_Hz']:.0f} Hz; levels {levels} bar")
settings = [(share * best["amplitude_A"], best["frequency_Hz"]) for share in (1, 0.5, 1.5)]
for k, (wanted_A, frequency_Hz) in enumerate(settings):
    # The coil gets less than what is set: set so that it gets what is wanted, once around.
    truth = simulated(f"first_{k}", wanted_A, frequency_Hz, levels[:1])
    first = [at_frequency(truth["time_s"][s], truth["current_A"][s], frequency_Hz) for _, _, s in rests(truth, levels[:1])]
    set_A = round(min(wanted_A * wanted_A / median(first), 1.0), 3)
    truth = simulated(f"setting_{k}", set_A, frequency_Hz, levels)
    rows = []
    for percent, level, stretch in rests(truth, levels):
        time_s = truth["time_s"][stretch]
        coil_A = at_frequency(time_s, truth["current_A"][stretch], frequency_Hz)
        point = min(study["points"], key=lambda p: abs(p["pressure_difference_bar"] - level)
                    + 100 * abs(p["position_mm"] / study["points"][0]["position_mm"] * POSITIONS[0] - percent))
        rig_um = 1e3 * at_frequency(time_s, truth["position_mm"][stretch], frequency_Hz)
        rig_flow = at_frequency(time_s, truth["flow_L_min"][stretch], frequency_Hz)
        rig_N = at_frequency(time_s, truth["magnetic_force_N"][stretch], frequency_Hz)
        at_coil = lambda column: interpolated(point["effects"], coil_A, frequency_Hz, column)
        rows.append((coil_A, at_coil(4), rig_um, at_coil(5), rig_flow, at_coil(2), rig_N, percent, level))
    if "-v" in sys.argv:
        for r in rows:
            print("     ", *(f"{x:8.3f}" for x in r))
    still, moving = [r for r in rows if r[2] <= MOVES_UM], [r for r in rows if r[2] > MOVES_UM]
    print(f"set {set_A:5.3f} A, {frequency_Hz:3.0f} Hz, coil {median([r[0] for r in rows]):5.3f} A | moves at {len(moving)} of {len(rows)} rests, "
          f"predicted at {sum(r[1] > MOVES_UM for r in rows)}, alike at {sum((r[1] > MOVES_UM) == (r[2] > MOVES_UM) for r in rows)}")
    for name, part in (("holds", still), ("moves", moving)):
        if part:
            m = [median([r[c] for r in part]) for c in range(7)]
            w = [max(r[c] for r in part) for c in range(7)]
            print(f"  {name}: motion predicted {m[1]:6.2f}, rig {m[2]:6.2f} um; flow ripple predicted {m[3]:6.3f}, rig {m[4]:6.3f} L/min (largest "
                  f"{w[3]:6.3f}, {w[4]:6.3f}); half swing predicted {m[5]:5.2f}, rig {m[6]:5.2f} N")
