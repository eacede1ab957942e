#!/usr/bin/env python3
"""What references in the field are worth on worn rig valves: makes recordings, recalibrates, judges by the true flow.

    references_on_rig.py OUT [--tuning] [--spoolflow PROGRAM] [--in-valve PROGRAM] [SEED ...]

A valve drawn from its series is calibrated by its own campaign, then worn: edges that pass some 10 % more, friction + 30 %, zero + 15 um. It makes 20
strokes of a cylinder (as many as the recording has, 17 at the least), whose ends are marked in a file, and three seconds of the closed valve; ramps and duty cycles judge, six
of each together, for one alone depends on whether its spool hangs once more or less. The cylinder is filled by the true flow of the recording, and by
nothing else of it; then with a leaking seal, another consumer, or an area that is wrong in references.toml. --tuning makes the valves on which constants
are chosen; without it others, on which no constant depends. The worn valve is also calibrated again on its bench, and its references'
model with the true friction and zero: no reference brings more. --in-valve: the program references_in_valve; its findings are printed, too. What is there
already is not made again. Printed are 95 % of the errors in % of full scale, the same over the fresh valve's, and the share in the band. Standard library only.
"""
import functools
import json
import pathlib
import subprocess
import sys

SETS = {"tuning": (1913, 5101, 5102, 6201, 6202, 7301, 7302, 7303, 9401, 9402, 9403, 9404, 9405), "judged": (9411, 9412, 9413, 9414, 9415, 9421, 9422, 9423)}
TRUE_WEAR = {"friction_ratio": 1.3, "position_zero_m": 15e-6}  # as in WORN
WORN = ("[wear]\nfriction_factor = 1.3\nedge_rounding_m = 10e-6\n[plant.edge_PB]\nnotch_width_m = 1.2e-3\n"
        "[instruments.lvdt]\nzero_offset_m = 15e-6\n")
STROKES = ("duty_cycle", "duration_s = 170\nlowest_percent = 8\nhighest_percent = 92\nslowest_percent_per_s = 10\n"
           "fastest_percent_per_s = 110\nlongest_hold_s = 4\nlowest_pressure_bar = 18\nhighest_pressure_bar = 62\n"
           "longest_pressure_hold_s = 9\n")
JUDGED = {"ramps": ("ramps", "pressure_differences_bar = [34, 57]\nrate_percent_per_s = 7\npeak_percent = 97\nhold_s = 3\n"),
          "duty": ("duty_cycle", "duration_s = 40\nlowest_percent = 14\nhighest_percent = 97\nslowest_percent_per_s = 8\n"
                   "fastest_percent_per_s = 260\nlongest_hold_s = 2.4\nlowest_pressure_bar = 12\nhighest_pressure_bar = 66\n"
                   "longest_pressure_hold_s = 4.5\n")}
CLOSED = ("duty_cycle", "duration_s = 3\nlowest_percent = 0\nhighest_percent = 0\n")
REPEATS = 6  # of each run that judges
AREA_CM2, LENGTH_MM, MOST_STROKES, LEAST_STROKES, RETURN_S = 40.0, 650.0, 20, 17, 0.4
# Case: (leakage of the seal [L/min], every third stroke also feeds so much [L/min], stated area over the real one)
CASES = {"right": (0, 0, 1), "seal 1 L/min": (1, 0, 1), "consumer": (0, 6, 1)}
CASES |= {f"area {percent:+d} %": (0, 0, 1 + percent / 100) for percent in (2, -2, 5, 10, 15, -15)}


def call(*command):
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def must(*command):
    status, text = call(*command)
    if status:
        sys.exit(f"references_on_rig: {' '.join(map(str, command))}: {text.strip()}")


def columns(path, *names):
    with open(path) as file:
        rows = (line.rstrip("\n").split(",") for line in file if not line.startswith("#"))
        head = next(rows)
        at = [head.index(name) for name in names]
        return list(zip(*([float(row[k]) for k in at] for row in rows)))


def base_of(seed):
    return f'preset = "size_6"\n[spread]\namount = 1\nseed = {seed}\n'


def calibrate(spoolflow, folder, quality, model):
    """The valve of a quality on its bench."""
    if not (folder / model).exists():
        must(spoolflow, "campaign", folder / f"{quality}.toml", "-o", folder / f"{quality}_campaign", "--calibration-only", "-q")
        must(spoolflow, "calibrate", folder / f"{quality}_campaign" / "campaign.toml", "-o", folder / model, "-q")


def repeated(run):
    """Names of a run that judges."""
    return [f"{run}{k or ''}" for k in range(REPEATS)]


def record(spoolflow, folder, seed, quality, month=0, judging=REPEATS):
    """Strokes and the closed valve, of each month others, and so many of each run that judges, always the same."""
    for number, (name, (protocol, run)) in enumerate({"strokes": STROKES, **JUDGED, "closed": CLOSED}.items()):
        for k, stem in enumerate(repeated(f"{quality}_{name}")[:judging] if name in JUDGED else [f"{quality}_{name}"]):
            if (folder / f"{stem}.csv").exists():
                continue
            scenario = folder / f"{stem}.toml"
            drawn = seed * 10 + number + 100000 * k + (0 if name in JUDGED else 1000 * month)
            scenario.write_text(f'protocol = "{protocol}"\nvalve = "{quality}.toml"\nseed = {drawn}\n[run]\n{run}')
            must(spoolflow, "simulate", scenario, "-o", folder / f"{stem}.csv", "--truth", folder / f"{stem}.truth.csv", "-q")


def make(spoolflow, out, seed):
    folder = out / f"{seed}"
    folder.mkdir(parents=True, exist_ok=True)
    for quality, wear, model in (("fresh", "", "model.json"), ("worn", WORN, "worn_model.json")):
        if not (folder / f"{quality}.toml").exists():
            (folder / f"{quality}.toml").write_text(base_of(seed) + wear)
        calibrate(spoolflow, folder, quality, model)
        record(spoolflow, folder, seed, quality)


@functools.lru_cache(maxsize=100)
def flows(folder, run):
    return columns(folder / f"{run}.truth.csv", "time_s", "flow_L_min")


def mark(folder, quality, case):
    """The cylinder's strokes by what the valve passed, and references.toml beside them."""
    leakage, consumer, stated = CASES[case]
    times, flow = flows(folder, f"{quality}_strokes")
    volume = AREA_CM2 * LENGTH_MM / 1e4  # L
    marks, filled, begin, wait = [], 0.0, None, 1.0
    for k in range(1, len(times)):
        if begin is None and times[k] >= wait:
            begin, filled = times[k], 0.0
        if begin is None:
            continue
        other = consumer if len(marks) % 3 == 1 else 0
        filled += max(0.0, flow[k] - leakage - other) / 60 * (times[k] - times[k - 1])
        if filled >= volume:
            marks.append((begin, times[k]))
            begin, wait = None, times[k] + RETURN_S
    if len(marks) < LEAST_STROKES:
        sys.exit(f"references_on_rig: {folder}: {len(marks)} strokes in the recording; {LEAST_STROKES} are wanted")
    stem = case.replace(" ", "_").replace("/", "_per_").replace("%", "percent")
    rows = "".join(f"{begin:.4f},{end:.4f}\n" for begin, end in marks[:MOST_STROKES])
    (folder / f"{quality}_{stem}.csv").write_text("begin_s,end_s\n" + rows)
    file = folder / f"{quality}_{stem}.references.toml"
    file.write_text(f'[[reference]]\nkind = "stroke"\nname = "boom"\nrecording = "{quality}_strokes.csv"\nends = "marks"\nmarks = "{quality}_{stem}.csv"\n'
                    f'area_cm2 = {AREA_CM2 * stated:g}\nlength_mm = {LENGTH_MM:g}\n[[reference]]\nkind = "closed"\n'
                    f'recording = "{quality}_closed.csv"\n')
    return file


def judged(spoolflow, folder, model, run):
    """95 % of the errors of all recordings of this run [% FS], the largest, the share in the band."""
    full = json.loads(model.read_text())["valve"]["rated_flow_m3_per_s"] * 60000
    errors, inside = [], 0
    for stem in repeated(run):
        if not (folder / f"{stem}.csv").exists():
            continue
        out = folder / f"estimate_{model.stem}_{stem}.csv"
        must(spoolflow, "estimate", model, folder / f"{stem}.csv", "-o", out, "-q")
        found, low, high = columns(out, *(f"flow{part}_L_min" for part in ("", "_lower", "_upper")))
        out.unlink()
        _, truth = flows(folder, stem)
        errors += [abs(f - q) for f, q in zip(found, truth)]
        inside += sum(a <= q <= b for a, b, q in zip(low, high, truth))
    errors.sort()
    return 100 * errors[int(0.95 * len(errors))] / full, 100 * errors[-1] / full, inside / len(errors)


def with_wear(spoolflow, model, wear, out):
    """The model with these parts of its wear replaced: a state of its log to which it goes back."""
    content = json.loads(model.read_text())
    log = content["provenance"]["adaptations"]
    last = log[-1]["wear"]
    entry = {"tool": "references_on_rig", "created": log[-1]["created"], "adapted_from": log[-1]["adapted_from"], "files": [], "corrections": [],
             "reasons": []}
    log += [entry | {"wear": last | wear}, entry | {"wear": last}]
    given = out.with_suffix(".given.json")
    given.write_text(json.dumps(content))
    out.unlink(missing_ok=True)
    must(spoolflow, "recalibrate", given, "--back-to", sum("wear" in each for each in log) - 1, "-o", out)
    given.unlink()
    return out


def shown(figures, fresh):
    return f"{figures[0]:5.2f} (x {figures[0] / fresh[0]:.2f}), {100 * figures[2]:5.1f} %"


def print_judged(spoolflow, folder, seed, quality, case, model, fresh):
    figures = [f"{run} {shown(judged(spoolflow, folder, model, f'{quality}_{run}'), fresh[run])}" for run in JUDGED]
    print(f"{seed} {quality:6} {case:20}", *figures, flush=True)


def print_cases(spoolflow, in_valve, folder, seed, quality, fresh):
    for case in CASES:
        references = mark(folder, quality, case)
        model = folder / f"{references.stem}.model.json"
        model.unlink(missing_ok=True)
        recordings = folder / f"{quality}_strokes.csv", folder / f"{quality}_closed.csv"
        status, text = call(spoolflow, "recalibrate", folder / "model.json", *recordings, "--references", references, "-o", model)
        (folder / f"{references.stem}.txt").write_text(text)
        if status:
            print(f"{seed} {quality:6} {case:20} refused: {text.strip().splitlines()[-1][:150]}", flush=True)
        else:
            print_judged(spoolflow, folder, seed, quality, case, model, fresh)
        if in_valve:
            print(f"{seed} {quality:6} {case + ', in valve':20}", call(in_valve, folder / "model.json", references, *recordings)[1].strip(), flush=True)
        if case == "right" and quality == "worn" and status == 0:
            true = with_wear(spoolflow, model, TRUE_WEAR, folder / "true_friction_and_zero.json")
            print_judged(spoolflow, folder, seed, quality, "true friction, zero", true, fresh)


def option(arguments, name, default):
    if name not in arguments:
        return default
    at = arguments.index(name)
    value = arguments[at + 1]
    del arguments[at:at + 2]
    return value


def main(arguments):
    spoolflow = option(arguments, "--spoolflow", "build/release/bin/spoolflow")
    in_valve = option(arguments, "--in-valve", "")
    which = "tuning" if "--tuning" in arguments else "judged"
    places = [argument for argument in arguments if not argument.startswith("--")]
    if not places:
        sys.exit("references_on_rig.py OUT [--tuning] [--spoolflow PROGRAM] [--in-valve PROGRAM] [SEED ...]")
    out = pathlib.Path(places[0]) / which
    for seed in [int(word) for word in places[1:]] or SETS[which]:
        make(spoolflow, out, seed)
        folder = out / f"{seed}"
        fresh = {run: judged(spoolflow, folder, folder / "model.json", f"fresh_{run}") for run in JUDGED}
        for quality in ("fresh", "worn"):
            print_judged(spoolflow, folder, seed, quality, "without references", folder / "model.json", fresh)
            if quality == "worn":
                print_judged(spoolflow, folder, seed, quality, "calibrated again", folder / "worn_model.json", fresh)
            print_cases(spoolflow, in_valve, folder, seed, quality, fresh)


if __name__ == "__main__":
    main(sys.argv[1:])
