#!/usr/bin/env python3
"""What strokes are worth whose ends the sensor alone sees (ends = "stalled"), beside marks of the true ends.

    stalled_strokes_on_rig.py OUT [--spoolflow PROGRAM] [SEED ...]

A rig valve drawn from its series is calibrated by its own campaign, healthy and then worn as in references_on_rig.py. Each stroke is a run of its
own: a cylinder goes from its middle to its end, stands there against the pressure, and the valve closes; the runs make one recording. The
length that is stated is the one that the oil has filled. Prints what `recalibrate` finds by true marks, and by stalled ends. Standard
library only.
"""
import pathlib
import random
import sys

import references_on_rig as rig

STROKES, AREA_CM2, FALLEN = 20, 40.0, 0.15
LOAD = ('[plant.load]\nkind = "cylinder"\ncylinder_stroke_m = 1.3\npiston_area_B_m2 = 0.004\ncylinder_mass_kg = 800\ncylinder_drag_N_s_per_m = 8000\n'
        'return_to_tank = true\n')


def one_stroke(spoolflow, folder, quality, seed, draw):
    """Lines of the recording, and when the piston came to stand [s] after how much oil [L]; nothing where it did not."""
    supply_bar = draw.uniform(35, 70)
    scenario = folder / "stroke.toml"
    scenario.write_text(f'protocol = "ramps"\nvalve = "{quality}.toml"\nseed = {seed}\n[run]\npressure_differences_bar = [{supply_bar:.1f}]\n'
                        f'rate_percent_per_s = {draw.uniform(15, 80):.1f}\npeak_percent = {draw.uniform(45, 90):.1f}\nhold_s = {draw.uniform(6, 10):.1f}\n'
                        f'[run.conditions]\nsupply_pressure_bar = {supply_bar:.1f}\n{LOAD}')
    file, truth = folder / "stroke.csv", folder / "stroke.truth.csv"
    rig.must(spoolflow, "simulate", scenario, "-o", file, "--truth", truth, "-q")
    times, flow, pressure_bar, position_mm = rig.columns(truth, "time_s", "flow_L_min", "pressure_difference_bar", "position_mm")
    filled, most = 0.0, 0.0
    lines = [line for line in file.read_text().splitlines() if not line.startswith("#")]
    for k in range(1, len(times)):
        filled += max(0.0, flow[k]) / 60 * (times[k] - times[k - 1])
        most = max(most, pressure_bar[k])
        if position_mm[k] > 0.4 and pressure_bar[k] < FALLEN * most:
            return lines, times[-1], times[k], filled
    return lines, times[-1], None, filled


def make(spoolflow, folder, quality, seed):
    recording = folder / f"{quality}_stalls.csv"
    if recording.exists():
        return
    draw, rows, marks, begin_s = random.Random(seed), [], [], 0.0
    for k in range(STROKES):
        lines, lasts_s, stands_s, filled = one_stroke(spoolflow, folder, quality, 100 * seed + k, draw)
        rows += lines[:1] if not rows else []
        for line in lines[1:]:
            time, rest = line.split(",", 1)
            rows.append(f"{float(time) + begin_s:.4f},{rest}")
        if stands_s:
            marks.append((begin_s, begin_s + stands_s, filled))
        begin_s += lasts_s + 0.001
    litres = sum(filled for _, _, filled in marks) / len(marks)
    (folder / f"{quality}_true_ends.csv").write_text("begin_s,end_s\n" + "".join(f"{begin:.4f},{end:.4f}\n" for begin, end, _ in marks))
    for ends, how in (("true", f'ends = "marks"\nmarks = "{quality}_true_ends.csv"'), ("stalled", 'ends = "stalled"')):
        (folder / f"{quality}_{ends}.toml").write_text(
            f'[[reference]]\nkind = "stroke"\nname = "boom"\nrecording = "{recording.name}"\n{how}\narea_cm2 = {AREA_CM2:g}\n'
            f'length_mm = {1e4 * litres / AREA_CM2:.2f}\n[[reference]]\nkind = "closed"\nrecording = "{quality}_closed.csv"\n')
    recording.write_text("\n".join(rows) + "\n")


def main(arguments):
    spoolflow = rig.option(arguments, "--spoolflow", "build/release/bin/spoolflow")
    if not arguments:
        sys.exit("stalled_strokes_on_rig.py OUT [--spoolflow PROGRAM] [SEED ...]")
    for seed in [int(word) for word in arguments[1:]] or (7301, 5101):
        folder = pathlib.Path(arguments[0]) / f"{seed}"
        folder.mkdir(parents=True, exist_ok=True)
        for quality, wear in (("fresh", ""), ("worn", rig.WORN)):
            (folder / f"{quality}.toml").write_text(rig.base_of(seed) + wear)
            rig.calibrate(spoolflow, folder, "fresh", "model.json")
            rig.record(spoolflow, folder, seed, quality, judging=0)
            make(spoolflow, folder, quality, seed)
            for ends in ("true", "stalled"):
                model = folder / f"{quality}_{ends}.model.json"
                model.unlink(missing_ok=True)
                _, text = rig.call(spoolflow, "recalibrate", folder / "model.json", folder / f"{quality}_stalls.csv", folder / f"{quality}_closed.csv",
                                   "--references", folder / f"{quality}_{ends}.toml", "-o", model)
                print(f"{seed} {quality} {ends} ends\n  " + text.strip().split("\n\n")[0].replace("\n", "\n  "), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
