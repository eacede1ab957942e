#!/usr/bin/env python3
"""What strokes of a cylinder both ways are worth on whole valves of the rig that wore, judged by the true flow.

    references_of_whole_valve.py OUT [--spoolflow PROGRAM] [SEED ...]

A `whole_size_6` drawn from its series is calibrated by its own campaign, then worn: notches of all edges 11 % wider, edges rounded by
10 um, friction + 30 %, zero + 15 um. 20 strokes of 0.8 L in each direction are marked within 300 s of operation, by the true flow and by
nothing else of it; four duty cycles and four ramps through both directions judge. Constants may be chosen on the seeds 8801 to 8835, none
was on 8841 to 8846. Printed are 95 % of the errors in % of full scale, the same over the fresh valve's, and the share in the band; of the
worn valve also what `recalibrate` says. What is there already is not made again. Standard library only.
"""
import pathlib
import sys

import references_on_rig as rig

SEEDS = {"tuning": (8801, 8802, 8811, 8812, 8813, 8821, 8822, 8823, 8824, 8831, 8832, 8833, 8834, 8835), "judged": range(8841, 8847)}
WORN = ("[wear]\nfriction_factor = 1.3\nedge_rounding_m = 10e-6\n" +
        "".join(f"[plant.edge_{edge}]\nnotch_width_m = {width}\n" for edge, width in
                (("PB", "1.2e-3"), ("PA", "1.2e-3"), ("AT", "1.2e-3"), ("BT", "1.18e-3"))) +
        "[instruments.lvdt]\nzero_offset_m = 15e-6\n")
STROKES = ("duration_s = 300\nlowest_percent = -92\nhighest_percent = 92\nslowest_percent_per_s = 10\nfastest_percent_per_s = 110\n"
           "longest_hold_s = 4\nlowest_pressure_bar = 18\nhighest_pressure_bar = 62\nlongest_pressure_hold_s = 9\n")
DUTY = ("duration_s = 40\nlowest_percent = -97\nhighest_percent = 97\nslowest_percent_per_s = 8\nfastest_percent_per_s = 260\n"
        "longest_hold_s = 2.4\nlowest_pressure_bar = 12\nhighest_pressure_bar = 66\nlongest_pressure_hold_s = 4.5\n")
RAMP = "pressure_differences_bar = [34, 57]\nrate_percent_per_s = 7\npeak_percent = {}\nhold_s = 3\n"
# Names by which references_on_rig.judged() finds the recordings of a run: the name, then 1, 2, ...
RUNS = {"strokes": ("duty_cycle", STROKES)}
RUNS |= {f"duty{k or ''}": ("duty_cycle", DUTY) for k in range(4)}
RUNS |= {f"ramps{k or ''}": ("ramps", RAMP.format(97 if k % 2 == 0 else -97)) for k in range(4)}
AREA_CM2, LENGTH_MM, COUNT = 40, 200, 20
OPEN_MM, REST_S, RETURN_S = 0.15, 0.05, 0.3  # beyond the overlap; after it opens; between strokes


def record(spoolflow, folder, seed, quality):
    for number, (name, (protocol, run)) in enumerate(RUNS.items()):
        stem = folder / f"{quality}_{name}"
        if stem.with_suffix(".csv").exists():
            continue
        stem.with_suffix(".toml").write_text(f'protocol = "{protocol}"\nvalve = "{quality}.toml"\nseed = {seed * 100 + number}\n[run]\n{run}')
        rig.must(spoolflow, "simulate", stem.with_suffix(".toml"), "-o", stem.with_suffix(".csv"), "--truth", stem.with_suffix(".truth.csv"), "-q")


def mark(folder, quality):
    """Strokes within times in which one direction is open, and references.toml beside them."""
    rows = rig.columns(folder / f"{quality}_strokes.truth.csv", "time_s", "flow_L_min", "position_mm")
    marks = {1: [], -1: []}
    side, begin, wait, filled, last = 0, None, 0.0, 0.0, 0.0
    for time, flow, position in zip(*rows):
        now = 1 if position > OPEN_MM else -1 if position < -OPEN_MM else 0
        if now != side:
            side, begin, wait = now, None, time + REST_S
        if begin is not None:
            filled += side * flow / 60 * (time - last)
            if filled >= AREA_CM2 * LENGTH_MM / 1e4:
                marks[side].append(f"{begin:.4f},{time:.4f}\n")
                begin, wait = None, time + RETURN_S
        elif side and time >= wait:
            begin, filled = time, 0.0
        last = time
    file = folder / f"{quality}.references.toml"
    file.write_text("")
    for direction, seen in zip("ba", marks.values()):
        (folder / f"{quality}_{direction}.csv").write_text("begin_s,end_s\n" + "".join(seen[:COUNT]))
        with file.open("a") as out:
            out.write(f'[[reference]]\nkind = "stroke"\nname = "boom {direction}"\ndirection = "{direction}"\nends = "marks"\n'
                      f'marks = "{quality}_{direction}.csv"\narea_cm2 = {AREA_CM2}\nlength_mm = {LENGTH_MM}\n')
    return file


def main(arguments):
    spoolflow = rig.option(arguments, "--spoolflow", "build/release/bin/spoolflow")
    if not arguments:
        sys.exit("references_of_whole_valve.py OUT [--spoolflow PROGRAM] [SEED ...]")
    for seed in [int(word) for word in arguments[1:]] or [*SEEDS["tuning"], *SEEDS["judged"]]:
        folder = pathlib.Path(arguments[0]) / f"{seed}"
        folder.mkdir(parents=True, exist_ok=True)
        base = f'preset = "whole_size_6"\n[spread]\namount = 1\nseed = {seed}\n'
        for quality, wear in (("fresh", ""), ("worn", WORN)):
            (folder / f"{quality}.toml").write_text(base + wear)
            record(spoolflow, folder, seed, quality)
        rig.calibrate(spoolflow, folder, "fresh", "model.json")
        fresh = {run: rig.judged(spoolflow, folder, folder / "model.json", f"fresh_{run}") for run in rig.JUDGED}
        for quality in ("fresh", "worn"):
            rig.print_judged(spoolflow, folder, seed, quality, "without references", folder / "model.json", fresh)
            model = folder / f"{quality}_moved.json"
            model.unlink(missing_ok=True)
            status, text = rig.call(spoolflow, "recalibrate", folder / "model.json", folder / f"{quality}_strokes.csv", "--references",
                                    mark(folder, quality), "-o", model)
            if status:
                print(f"{seed} {quality:6} refused: {text.strip().splitlines()[-1][:180]}", flush=True)
                continue
            if quality == "worn":
                print(*(line for line in text.splitlines() if line.startswith("P to")), sep="\n")
            rig.print_judged(spoolflow, folder, seed, quality, "after 20 strokes", model, fresh)


if __name__ == "__main__":
    main(sys.argv[1:])
