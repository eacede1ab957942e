#!/usr/bin/env python3
"""What `spoolflow monitor` reports of valves of the virtual rig with one fault each, judged with the model of the healthy valve.

    python3 bench/monitor_on_rig.py build/release/bin/spoolflow OUT [VALVE ...]

For each VALVE (PRESET or PRESET:SEED, drawn from a series) the healthy campaign is measured and calibrated once, and
kept in OUT; then each fault runs through five triangles at five pressure differences (235 s, ten strokes), and the
healthy valve through operation with and without dither and loads. Prints one line a run: NE 107, causes with odds.
Everything is simulated.
"""
import json
import os
import subprocess
import sys

LEVELS = {"size_6": (30, 40, 50, 60, 70), "fast_dither": (30, 40, 50, 60, 70), "size_10": (12, 16, 20, 25, 30)}
SPRINGS = {"size_6": (9, 12000), "size_10": (16, 14000), "fast_dither": (12, 36000)}
SUPPLY_bar = {"size_6": 72, "fast_dither": 72, "size_10": 32}


def faults(preset):
    preload, rate = SPRINGS[preset]

    def spring(share, rate_share):
        return {f"plant.spring_{s}": {"preload_N": preload * (1 - share), "rate_N_per_m": rate * (1 - rate_share)} for s in "ab"}

    out = {"healthy": {}}
    out |= {f"friction +{p} %": {"wear": {"friction_factor": 1 + p / 100}} for p in (20, 30, 40, 50)}
    out |= {f"edge {r} um": {"wear": {"edge_rounding_m": r * 1e-6}} for r in (15, 25, 35, 45)}
    out |= {f"spring -{p} %": spring(p / 100, 0.55 * p / 100) for p in (4, 6, 8, 11)}
    out |= {f"turns {p} %": {"wear": {"shorted_turns_fraction": p / 100}} for p in (2, 3, 4)}
    out |= {f"zero {z} um": {"instruments.lvdt": {"zero_offset_m": z * 1e-6}} for z in (-25, -15, 15, 25)}
    out["worn"] = {"wear": {"friction_factor": 1.5, "edge_rounding_m": 30e-6}}
    return out


def operation(preset):
    low, high = LEVELS[preset][-1] * 0.12, LEVELS[preset][-1]
    duty = {"duration_s": 60, "lowest_pressure_bar": low, "highest_pressure_bar": high}
    supply = {"supply_pressure_bar": SUPPLY_bar[preset]}
    dither = {"electronics.dither": {"amplitude_A": 0.1, "frequency_Hz": 120}}
    quiet = {"electronics.dither": {"amplitude_A": 0, "frequency_Hz": 120}}
    out = {}
    for name, shaken in (("", quiet), (" dithered", dither)):
        out["duty" + name] = ("duty_cycle", {"run": duty} | shaken)
        for load in ("orifice", "motor"):
            out[load + name] = ("duty_cycle", {"run": {"duration_s": 60}, "run.conditions": supply,
                                               "plant.load": {"kind": load, "return_to_tank": True}} | shaken)
    return out


def toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    return json.dumps(value)


def write_scenario(path, preset, seed, protocol, tables):
    lines = [f"protocol = {toml(protocol)}", f"valve = {toml(preset)}", f"seed = {seed or 1}"]
    if seed:
        tables = tables | {"spread": {"amount": 1}}
    for table, values in tables.items():
        lines += [f"[{table}]"] + [f"{key} = {toml(value)}" for key, value in values.items()]
    with open(path, "w") as file:
        file.write("\n".join(lines) + "\n")


def main():
    spoolflow, folder, valves = sys.argv[1], sys.argv[2], sys.argv[3:] or ["size_6:201", "size_10:202", "fast_dither:203"]

    def run(*arguments):
        subprocess.run([spoolflow, *arguments], check=True, stdout=subprocess.DEVNULL)

    for valve in valves:
        preset, _, seed = valve.partition(":")
        seed = int(seed or 0)
        home = os.path.join(folder, valve.replace(":", "_"))
        os.makedirs(home, exist_ok=True)
        model = os.path.join(home, "model.json")
        if not os.path.exists(model):
            file = os.path.join(home, "valve.toml")
            with open(file, "w") as out:
                out.write(f'preset = "{preset}"\n' + (f"seed = {seed}\n[spread]\namount = 1\n" if seed else ""))
            run("campaign", file, "-o", os.path.join(home, "campaign"), "-q")
            run("calibrate", os.path.join(home, "campaign", "campaign.toml"), "-o", model, "-q")
        ramps = {"run": {"pressure_differences_bar": list(LEVELS[preset])}, "electronics.dither": {"amplitude_A": 0}}
        runs = {name: ("ramps", ramps | tables) for name, tables in faults(preset).items()}
        runs |= {"healthy, " + name: what for name, what in operation(preset).items()}
        for name, (protocol, tables) in runs.items():
            stem = os.path.join(home, name.replace(" ", "_").replace("%", "").replace(",", ""))
            if not os.path.exists(stem + ".csv"):
                write_scenario(stem + ".toml", preset, seed, protocol, tables)
                run("simulate", stem + ".toml", "-o", stem + ".csv", "-q")
            run("monitor", model, stem + ".csv", "--json", stem + ".json", "-q")
            with open(stem + ".json") as file:
                condition = json.load(file)
            causes = ", ".join(f"{c['cause']} ({c['odds']:.3g})" for c in condition["causes"])
            print(f"{valve:<16} {name:<26} {condition['ne107']:<5} {causes}", flush=True)


if __name__ == "__main__":
    main()
