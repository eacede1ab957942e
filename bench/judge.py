#!/usr/bin/env python3
"""Judges `spoolflow estimate` against the true flow, run by run: one table in Markdown, and pooled lines by effect and programme.

    judge.py OUT [OPTIONS]                                  # a set of judging_set.py
    judge.py --shared ../shared MODEL_A.json [NAME=MODEL.json ...] [OPTIONS]

--environment NAME|FILE  handed to `estimate`; `declared` is what a user of that machine would declare of the row's effect
--calibrate DIR          by models that the program calibrates from the set's campaigns into DIR/VALVE.json, unless they are
                         there; otherwise by those that the set was made with
--json FILE              the same figures, and every status, to FILE
--before FILE            figures that --json wrote: p95 and width are printed over those as well
--quick                  every sixth run
--only TEXT              rows whose "valve run effect" hold TEXT
--spoolflow PROGRAM      default build/release/bin/spoolflow

Rows of --shared: runs of valve A, its effects, and the sister valves by A's model, or by that of S1=MODEL.json; the whole
valve by W=MODEL.json. The first column says whether constants may be chosen on the row (tuning) or not (judged). Figures are in
percent of the model's rated flow: 95th percentile and largest size of the error, share of samples in the 95 % band, its mean
width; whether the run holds: 92 % in the band, or half of the samples outside have a status or the run a finding that names the effect; then each
status with its share of all samples and, in brackets, of those outside the band, and what is doubted of the run. A sample
without an answer is outside, its error counts as 100 %. Standard library only.
"""
import concurrent.futures
import hashlib
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import judging_set

STEP = 0.01  # % of full scale: bins in which errors are counted
BINS = 20000
RUN = ("set", "valve", "programme", "effect")  # identifies a run
VALVE_A = ("ramp_60bar", "ramps_30_to_70bar", "temperature_sweep", "duty_cycle_1", "motor_load", "fast_10kHz",
           "ramp_60bar_dither", "orifice_duty_dither")
SISTERS = ("ramps_30_to_40bar", "duty_cycle_1", "orifice_duty_dither")
WHOLE = ("both_ramps_60bar", "both_duty_1")
# What names an effect: limits and faults of the status; the effects of the shared recordings have names of their own.
NAMED = {"above": ("outside_flow_force_map",), "far_above": ("outside_flow_force_map", "current_saturated"),
         "below": ("outside_flow_force_map",), "spikes": ("current_fault",), "silt": ("current_saturated",)}
NAMED |= {"highdp01": NAMED["above"]}
# And the findings about a whole run that do: what shakes the spool, what beats in the current.
FOUND = {"vibration": "shakes", "vibration03": "shakes", "ripple": "shakes", "pwm": "beats"}


def fail(message):
    sys.exit(f"judge: {message}")


class Figures:
    """Errors and band of one run, or of several together."""

    def __init__(self):
        self.errors = {}  # bin -> count
        self.samples = self.inside = self.largest = self.width = 0
        self.status, self.outside = {}, {}

    def add(self, flow, lower, upper, truth, status, percent):
        answered = not (math.isnan(flow) or math.isnan(lower) or math.isnan(upper))
        error = abs(flow - truth) * percent if answered else 100.0
        within = answered and lower <= truth <= upper
        bin_ = min(int(error / STEP), BINS)
        self.errors[bin_] = self.errors.get(bin_, 0) + 1
        self.samples += 1
        self.inside += within
        self.largest = max(self.largest, error)
        self.width += (upper - lower) * percent if answered else 200.0
        if status:
            self.status[status] = self.status.get(status, 0) + 1
            if not within:
                self.outside[status] = self.outside.get(status, 0) + 1

    def merge(self, other):
        for mine, its in ((self.errors, other.errors), (self.status, other.status), (self.outside, other.outside)):
            for key, count in its.items():
                mine[key] = mine.get(key, 0) + count
        self.samples += other.samples
        self.inside += other.inside
        self.width += other.width
        self.largest = max(self.largest, other.largest)

    def p95(self):
        left = 0.95 * self.samples
        for bin_ in sorted(self.errors):
            left -= self.errors[bin_]
            if left < 0:
                return (bin_ + 0.5) * STEP
        return self.largest

    def shares(self, counts, of):
        names = {}
        for words, count in counts.items():
            for name in words.split("|"):
                names[name] = names.get(name, 0) + count
        return {name: round(100 * count / of, 2) for name, count in sorted(names.items()) if of}

    def named(self, effect):
        """Share of the samples outside whose status names the effect [%]."""
        count = sum(count for words, count in self.outside.items() if set(words.split("|")) & set(NAMED.get(effect, ())))
        return round(100 * count / max(1, self.samples - self.inside), 1)

    def row(self):
        return {"samples": self.samples, "p95": round(self.p95(), 2), "max": round(self.largest, 1),
                "in_band": round(100 * self.inside / self.samples, 1), "width": round(self.width / self.samples, 2),
                "status": self.shares(self.status, self.samples),
                "status_outside": self.shares(self.outside, self.samples - self.inside)}


def number(text):
    return float(text) if text else math.nan


def rows_of(path):
    with open(path, encoding="utf-8") as file:
        rows = (line.rstrip("\n").split(",") for line in file if not line.startswith("#"))
        head = next(rows)
        yield head
        yield from rows


def environment_for(environment, run, folder):
    if environment != "declared":
        return [] if environment is None else ["--environment", environment]
    preset = judging_set.VALVES.get(run["declared_by"], {}).get(run["valve"], ("",))[0]
    file = pathlib.Path(folder) / "declared.toml"
    file.write_text(judging_set.declared(run["declared_by"], run["effect"], preset), encoding="utf-8")
    return ["--environment", file]


def judged(run, spoolflow, environment):
    """Figures of one run and what is doubted of it."""
    full_scale = 60000 * json.loads(pathlib.Path(run["model"]).read_text(encoding="utf-8"))["valve"]["rated_flow_m3_per_s"]
    with tempfile.TemporaryDirectory() as folder:
        out, summary = pathlib.Path(folder) / "estimate.csv", pathlib.Path(folder) / "summary.json"
        command = [spoolflow, "estimate", run["model"], run["recording"], "-o", out, "--json", summary, "-q",
                   *environment_for(environment, run, folder)]
        done = subprocess.run([str(part) for part in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                              check=False)
        if done.returncode != 0:
            return run, None, done.stderr.strip()
        doubts = json.loads(summary.read_text(encoding="utf-8"))["recordings"][0]["doubts"]
        estimates, truth = rows_of(out), rows_of(run["truth"])
        head = next(estimates)
        flow, lower, upper, status = (head.index(name) for name in ("flow_L_min", "flow_lower_L_min", "flow_upper_L_min", "status"))
        true = next(truth).index("flow_L_min")
        figures = Figures()
        for row, true_row in zip(estimates, truth, strict=True):
            figures.add(number(row[flow]), number(row[lower]), number(row[upper]), number(true_row[true]), row[status],
                        100 / full_scale)
    return run, figures, [doubt.removeprefix(f"{pathlib.Path(run['recording']).name}: ") for doubt in doubts]


def set_runs(folder):
    folder = pathlib.Path(folder)
    try:
        about = json.loads((folder / "set.json").read_text(encoding="utf-8"))
    except FileNotFoundError:
        fail(f"{folder} holds no set.json; make a set by bench/judging_set.py {folder}")
    for name, wanted in about["sha256"].items():
        file = folder / name
        if not file.exists() or hashlib.sha256(file.read_bytes()).hexdigest() != wanted:
            fail(f"{file} is not the file that the set was made with; make the set again in another folder")
    files = ("model", "recording", "truth")
    return [dict(entry, set=about["set"], declared_by=about["set"], **{key: folder / entry[key] for key in files}) for entry in about["runs"]]


def calibrated_again(runs, folder, spoolflow):
    """The runs by models of this program."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)

    def calibrate(valve, campaign):
        if not (folder / f"{valve}.json").exists():
            done = subprocess.run([spoolflow, "calibrate", str(campaign), "-o", str(folder / f"{valve}.json"), "-q"],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
            if done.returncode != 0:
                fail(f"{campaign}: {done.stderr.strip()}")
    campaigns = {run["valve"]: run["model"].parent / "campaign" / "campaign.toml" for run in runs}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as workers:
        list(workers.map(calibrate, campaigns, campaigns.values()))
    return [dict(run, model=folder / f"{run['valve']}.json") for run in runs]


def shared_runs(shared, model_a, models):
    recordings = pathlib.Path(shared) / "recordings"
    if not recordings.is_dir():
        fail(f"{recordings} is not there; give the folder of the shared recordings")
    runs = []

    def add(set_, valve, folder, programme, effect, model):
        runs.append({"set": set_, "declared_by": "shared", "valve": valve, "programme": programme, "effect": effect, "model": model,
                     "recording": recordings / folder / f"{programme}.csv",
                     "truth": recordings / folder / "true_flow" / f"{programme}.csv"})
    for programme in VALVE_A:
        add("tuning", "A", "valve_a", programme, "clean", model_a)
    for effect in sorted(path.name for path in (recordings / "effects_on_a").iterdir()):
        for file in sorted((recordings / "effects_on_a" / effect).glob("*.csv")):
            add("tuning", "A", f"effects_on_a/{effect}", file.stem, effect, model_a)
    for sister in ("S1", "S2"):
        for programme in SISTERS:
            add("judged", sister, f"sisters_of_a/{sister}", programme, "clean", models.get(sister, model_a))
    for programme in WHOLE if "W" in models else ():
        add("tuning", "W", "valve_w", programme, "clean", models["W"])
    return runs


def words(row, doubts):
    outside = row["status_outside"]
    kept = [name for name in {**row["status"], **outside} if row["status"].get(name, 0) >= 0.5 or outside.get(name, 0) >= 5]
    status = [f"{name} {row['status'].get(name, 0):.0f} ({outside.get(name, 0):.0f})" for name in kept]
    return ", ".join(status + [f"doubt: {doubt.split(',')[0]}" for doubt in doubts])


def holds(row, named, effect, doubts):
    found = effect in FOUND and any(FOUND[effect] in doubt for doubt in doubts)
    return "band" if row["in_band"] >= 92 else "named" if named >= 50 or found else "no"


def line(*cells):
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def pooled(results):
    """Rows of several runs together: each effect, each programme of clean runs, everything."""
    groups = {}
    for run, figures, doubts in results:
        keys = [("all runs", run["set"]), ("effect " + run["effect"], run["set"])]
        if run["effect"] == "clean":
            keys.append(("clean " + run["programme"], run["set"]))
        for key in keys:
            group = groups.setdefault(key, {"figures": Figures(), "runs": []})
            group["figures"].merge(figures)
            row = figures.row()
            group["runs"].append(dict(row, holds=holds(row, figures.named(run["effect"]), run["effect"], doubts)))
    out = []
    for (name, set_), group in sorted(groups.items()):
        runs = group["runs"]
        out.append(dict(group["figures"].row(), set=set_, group=name, runs=len(runs),
                        largest_p95=max(run["p95"] for run in runs), least_in_band=min(run["in_band"] for run in runs),
                        runs_hold=sum(run["holds"] != "no" for run in runs),
                        runs_93_to_98_5=sum(93 <= run["in_band"] <= 98.5 for run in runs)))
    return out


def over_before(row, run, before):
    """Cells of p95 and width over those of the same run before."""
    if before is None:
        return []
    earlier = before.get(tuple(run[key] for key in RUN))
    return ["-", "-"] if earlier is None else [f"{row[key] / max(earlier[key], STEP):.2f}" for key in ("p95", "width")]


def report(results, environment, before):
    print(f"environment: {environment or 'as the model has it'}\n")
    print(line("set", "valve", "run", "effect", "p95 % FS", "max % FS", "in band %", "mean width % FS",
               *(("p95 / before", "width / before") if before is not None else ()), "holds",
               "status: share % (of samples outside %); doubts"))
    print("|---" * (12 if before is not None else 10) + "|")
    for run, figures, doubts in results:
        row = figures.row()
        print(line(run["set"], run["valve"], run["programme"], run["effect"], row["p95"], row["max"], row["in_band"], row["width"],
                   *over_before(row, run, before), holds(row, figures.named(run["effect"]), run["effect"], doubts), words(row, doubts)))
    print("\nPooled over all samples; the worst of the runs; runs that hold, and those with 93 to 98.5 % in the band.\n")
    print(line("set", "pooled", "runs", "p95 % FS", "largest p95", "max % FS", "in band %", "least in band %", "mean width % FS",
               "runs that hold", "93 to 98.5 %"))
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    groups = pooled(results)
    for group in groups:
        print(line(*(group[key] for key in ("set", "group", "runs", "p95", "largest_p95", "max", "in_band", "least_in_band", "width",
                                            "runs_hold", "runs_93_to_98_5"))))
    return groups


def flag(arguments, name):
    if name not in arguments:
        return False
    arguments.remove(name)
    return True


def main(arguments):
    environment, to_json = judging_set.option(arguments, "--environment"), judging_set.option(arguments, "--json")
    only, shared = judging_set.option(arguments, "--only"), judging_set.option(arguments, "--shared")
    spoolflow = judging_set.option(arguments, "--spoolflow", "build/release/bin/spoolflow")
    before, models = judging_set.option(arguments, "--before"), judging_set.option(arguments, "--calibrate")
    if before is not None:
        rows = json.loads(pathlib.Path(before).read_text(encoding="utf-8"))["runs"]
        before = {tuple(row[key] for key in RUN): row for row in rows}
    quick = flag(arguments, "--quick")
    if not arguments or arguments[0].startswith("--") or (shared is None and len(arguments) != 1):
        fail(__doc__.split("\n\n")[1])
    if shared is None:
        runs = set_runs(arguments[0])
    else:
        runs = shared_runs(shared, arguments[0], dict(argument.split("=", 1) for argument in arguments[1:]))
    if quick:
        runs = runs[::6]
    if only:
        runs = [run for run in runs if only in f"{run['valve']} {run['programme']} {run['effect']}"]
    if models is not None:
        if shared is not None:
            fail("--calibrate is of sets; give --shared the models")
        runs = calibrated_again(runs, models, spoolflow)
    if not runs:
        fail(f"no row holds {only!r}")
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as workers:
        results = list(workers.map(judged, runs, [spoolflow] * len(runs), [environment] * len(runs)))
    for run, figures, error in results:
        if figures is None:
            fail(f"{run['recording']}: {error}")
    groups = report(results, environment, before)
    if to_json:
        rows = [dict(figures.row(), named_outside=figures.named(run["effect"]), doubts=doubts, **{key: run[key] for key in RUN})
                for run, figures, doubts in results]
        pathlib.Path(to_json).write_text(json.dumps({"environment": environment, "runs": rows, "pooled": groups}, indent=1) + "\n",
                                         encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
