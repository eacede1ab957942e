#!/usr/bin/env python3
"""What a step costs wherever it runs, beside what was wanted: one table in Markdown, printed in one run.

    ninja -C build/release benchmarks && python3 bench/limits.py build/release

Calibrates examples/valve_a, then runs the benches of BUILD one after the other, each in its own process; `live` with 2000
valves and a fleet of 100 where BUILD has the add-ons. Times are of this machine and this moment: what else runs meanwhile
makes them longer. Standard library only.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

PROJECT = pathlib.Path(__file__).resolve().parent.parent
EXAMPLES = PROJECT / "examples" / "valve_a"
MACHINE_VALVE = PROJECT / "examples" / "live" / "size_6.json"


def fail(message):
    sys.exit(f"limits: {message}")


class Build:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not (self.folder / "bin" / "spoolflow").exists():
            fail(f"{folder}: holds no bin/spoolflow; build it with `ninja -C {folder} benchmarks`")

    def run(self, program, *arguments):
        """What the program prints; exit status 1 says that a wish was not met."""
        path = self.folder / program
        if not path.exists():
            fail(f"{path}: is not built; run `ninja -C {self.folder} benchmarks`")
        done = subprocess.run([path, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
        if done.returncode > 1:
            fail(f"{path}: ended with exit status {done.returncode}:\n{done.stderr}")
        return done.stdout


def number(pattern, text):
    found = re.search(pattern, text, re.MULTILINE | re.DOTALL)
    return float(found.group(1)) if found else None


def shown(value, digits=0):
    return "not measured" if value is None else f"{value:.{digits}f}"


def row(what, now, beside, wanted):
    print(f"| {what} | {now} | {beside} | {wanted} |", flush=True)


def mean_and_largest(block):
    found = re.search(r"instructions a step.*?\n  \S.*?\s(\d+)\s+(\d+)\n", block, re.DOTALL)
    return " / ".join(found.groups()) if found else "not measured"


def cortex_m(build, model):
    text = build.run("bench/cortex_m_cost", model, EXAMPLES / "duty_cycle_1.h5")
    part = {}
    for block in text.split("\n\n"):
        if block.startswith("Cortex-M4F, "):
            part[block.split(", ")[1].split(":")[0]] = block
    for estimator, wanted in (("observer", "1000 / 1500"), ("condensed", "")):
        block = part.get(estimator, "")
        row(f"Cortex-M4F, {estimator}, mean / largest step [instructions]", mean_and_largest(block), "", wanted)
        longest = number(r"longest way through the code (\d+) instructions", block)
        row(f"Cortex-M4F, {estimator}, longest way through the code [instructions]", shown(longest), "", "")
    for core in ("Cortex-M3", "Cortex-M0+"):
        for estimator in ("observer", "condensed"):
            block = next((block for block in text.split("\n\n") if block.startswith(f"{core}, {estimator}")), "")
            row(f"{core} without a floating-point unit, {estimator}, mean / largest step [instructions]", mean_and_largest(block), "", "")
    block = part.get("observer", "")
    state, flash = number(r"state (\d+) bytes", block), number(r"tables (\d+) bytes", block)
    row("state / flash of the observer on it [bytes]", f"{shown(state)} / {shown(flash)}", "", "1024 / -")


def host(build):
    # Processor time, the median of repetitions that take turns: a machine that is slower for a while is so for all.
    text = build.run("bench/sensor_bench", "--benchmark_min_time=0.1", "--benchmark_repetitions=15",
                     "--benchmark_enable_random_interleaving=true", "--benchmark_report_aggregates_only=true")
    ns = {name: number(rf"^{name}_median\s+[\d.]+ ns\s+([\d.]+) ns", text)
          for name in ("observer_step", "plain_eigen_filter", "condensed_step", "plain_lower_bound_maps")}
    row("host, double, observer [ns a step]", shown(ns["observer_step"]),
        f"four-state Eigen filter without maps {shown(ns['plain_eigen_filter'])}", "120 where the filter takes 59")
    row("host, double, condensed [ns a step]", shown(ns["condensed_step"], 1),
        f"maps by `lower_bound` {shown(ns['plain_lower_bound_maps'], 1)}", "")


def parsing(build, model, folder):
    recording = folder / "run.csv"
    build.run("bin/spoolflow", "simulate", EXAMPLES.parent / "scenarios" / "ramp.toml", "-o", recording, "-q")
    text = build.run("bench/estimate_throughput", model, recording)
    plain = number(r"^plain parse.*?([\d.]+) MiB/s", text)
    row("`estimate` of CSV over `from_chars` alone [share of its pace]", shown(number(r"^ratio\s+([\d.]+)", text), 2),
        f"plain parse {shown(plain)} MiB/s", "1.1")


def analysis(build, model, folder):
    before, begun = os.times(), time.monotonic()
    build.run("bin/spoolflow", "analyse", model, "--report", folder / "analysis.html", "-q")
    after = os.times()
    processor_s = after.children_user + after.children_system - before.children_user - before.children_system
    row("`analyse` with defaults [s]", shown(time.monotonic() - begun), f"{processor_s:.0f} processor s", 60)


def rig(build):
    text = build.run("bench/rig_speed", "1")
    times = [float(x) for x in re.findall(r"([\d.]+) times real time", text)]
    slower = number(r"is ([\d.]+) times faster than CVODE", text)
    row("virtual rig, closed loop [times real time, a core]", f"{min(times):.0f} to {max(times):.0f}" if times else "not measured",
        f"CVODE at equal error {shown(slower, 1)} times slower", "")
    at_once = [float(x) for x in re.findall(r"at once +([\d.]+) x real time", text)]
    row("virtual rig, valves at once in registers [times real time, a core]",
        f"{min(at_once):.0f} to {max(at_once):.0f}" if at_once else "not measured", "one after the other as above", "")


def live(build):
    if not (build.folder / "bin" / "spoolflow-live").exists():
        return
    text = build.run("bench/live_load", build.folder / "bin" / "spoolflow", MACHINE_VALVE, "2000", "60")
    late_ms, cores = number(r"99 % ([\d.]+) ms", text), number(r"live took ([\d.]+) cores", text)
    row("`live`, 2000 valves at 1 kHz, 99 % of answers within [ms]", shown(late_ms), f"{shown(cores, 2)} cores", 100)


def fleet(build):
    reference = build.folder / "addons" / "fleet" / "tests" / "reference" / "fleet_reference"
    if not reference.exists():
        return
    done = subprocess.run(["/usr/bin/python3", PROJECT / "bench" / "fleet_load.py", build.folder / "bin" / "spoolflow", reference,
                           PROJECT / "examples", "cluster", "100", "180", "2"], stdout=subprocess.PIPE, text=True, check=False)
    alone, replicated = number(r"one process ([\d.]+)", done.stdout), number(r"fleet ([\d.]+) M", done.stdout)
    row("fleet of three servers, replicated [million samples a second]", shown(replicated, 2), f"one process {shown(alone, 2)}", 1.5)


def main(arguments):
    if len(arguments) != 1:
        fail(__doc__.split("\n\n")[1].strip())
    build = Build(arguments[0])
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        model = folder / "valve_a.json"
        begun = time.monotonic()
        build.run("bin/spoolflow", "calibrate", EXAMPLES / "campaign.toml", "-o", model, "-q")
        calibrated_s = time.monotonic() - begun
        print("| what | now | beside it | wanted |\n|---|---|---|---|")
        row("`calibrate` of examples/valve_a [s]", shown(calibrated_s, 1), "", 4)
        cortex_m(build, model)
        host(build)
        parsing(build, model, folder)
        analysis(build, model, folder)
        rig(build)
        live(build)
        fleet(build)


main(sys.argv[1:])
