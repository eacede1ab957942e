#!/usr/bin/env python3
"""Makes a frozen set of recordings of rig valves on which the sensor is judged: clean runs, and one effect of real machines at a time.

    judging_set.py OUT [--tuning] [--seed N] [--quick] [--list] [--spoolflow PROGRAM]

Each valve is measured by its own campaign and calibrated; then it runs programmes of other seeds, pressures and speeds than
those of campaign, documents and tests. OUT gets VALVE/campaign, VALVE/model.json, VALVE/PROGRAMME.EFFECT.csv, the true flow beside it, and
set.json, by which judge.py finds them and knows that nothing has changed. An OUT that holds a set is left alone; a making that was
stopped goes on.

--tuning makes the other set: other valves, programmes, sizes of effects and seeds, on which constants may be chosen. Nobody
looks at the judged set while choosing. --seed N makes a set that nobody has seen: the same programmes and effects with other
noise and courses, all valves drawn of their series. --quick makes one valve of the set, --list prints the runs and makes nothing. With the
same program the same bytes come out. Standard library only.
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys

# The seeds, once: a valve's place in its series, and noise and course of each valve's programmes, follow from them by counting. An
# effect's run has the seed of the clean one.
SEED = {"judged": 7041, "tuning": 1913}

# Valve: (preset, what it is beside, programmes on which each effect is judged). `drawn` is one of a series, `worn` one of a series
# that was measured and calibrated after years.
VALVES = {
    "judged": {"size_6": ("size_6", "", ("ramp", "duty", "duty_dither")),
               "size_6_worn": ("size_6", "worn", ("ramp", "duty_dither")),
               "size_10": ("size_10", "", ("ramp", "duty")),
               "size_10_drawn": ("size_10", "drawn", ("duty_dither",)),
               "fast_dither": ("fast_dither", "", ("duty",)),
               "whole_size_6": ("whole_size_6", "", ("duty",))},
    "tuning": {"size_6_drawn": ("size_6", "drawn", ("ramp", "duty", "duty_dither")),
               "fast_dither_drawn": ("fast_dither", "drawn", ("duty",)),
               "whole_size_6": ("whole_size_6", "", ("duty",))},
}
QUICK = {"judged": "size_6_worn", "tuning": "size_6_drawn"}
WEAR = "[wear]\nedge_rounding_m = 18e-6\nfriction_factor = 1.6\nspring_relaxation = 0.03\n"
HIGHEST_BAR = {"size_6": 70, "size_10": 30, "fast_dither": 70, "whole_size_6": 70}  # of the calibration
STROKE_M = {"size_6": 2.4e-3, "size_10": 3.5e-3, "fast_dither": 1.0e-3, "whole_size_6": 2.4e-3}

# Pressures are shares of the calibration's highest. Dither: amplitude [A], frequency [Hz], shape.
PROGRAMMES = {
    "judged": {
        "ramp": dict(protocol="ramps", levels=(0.67,), rate_percent_per_s=7, peak_percent=97, hold_s=3),
        "slide": dict(protocol="ramps", levels=(0.41, 0.74, 0.93), rate_percent_per_s=16, peak_percent=94, hold_s=1),
        "slide_dither": dict(protocol="ramps", levels=(0.52, 0.86), rate_percent_per_s=13, peak_percent=94, hold_s=1,
                             dither=(0.12, 215, "sine")),
        "duty": dict(protocol="duty_cycle", duration_s=36, lowest_percent=14, highest_percent=97, slowest_percent_per_s=8,
                     fastest_percent_per_s=260, longest_hold_s=2.4, pressures=(0.16, 0.95), longest_pressure_hold_s=4.5),
        "duty_dither": dict(protocol="duty_cycle", duration_s=36, lowest_percent=12, highest_percent=95,
                            slowest_percent_per_s=11, fastest_percent_per_s=220, longest_hold_s=3.2, pressures=(0.14, 0.96),
                            longest_pressure_hold_s=5, dither=(0.11, 122, "square")),
        "orifice_dither": dict(protocol="duty_cycle", duration_s=30, lowest_percent=14, highest_percent=95,
                               slowest_percent_per_s=12, fastest_percent_per_s=150, longest_hold_s=2.5, pressures=(0.5, 0.5),
                               longest_pressure_hold_s=5, dither=(0.09, 148, "sine"), supply=0.93),
        "sine": dict(protocol="sine", centre_percent=52, amplitude_percent=21, frequency_start_Hz=0.3, frequency_end_Hz=6,
                     sweep_s=24, level=0.63),
        "steps": dict(protocol="steps", positions_percent=(35, 88, 22, 71, 47, 97, 18, 62, 0), hold_s=1.3, level=0.81),
        "rest": dict(protocol="pressure_steps", positions_percent=(34, 63, 92), levels=(0.25, 0.8, 0.45, 0.92, 0.6), hold_s=1.8),
        "fast": dict(protocol="fast_motion", duration_s=6, lowest_percent=18, highest_percent=92, slowest_percent_per_s=150,
                     fastest_percent_per_s=3000, longest_hold_s=0.25, pressures=(0.3, 0.95), longest_pressure_hold_s=1.5),
    },
    "tuning": {
        "ramp": dict(protocol="ramps", levels=(0.8,), rate_percent_per_s=6, peak_percent=100, hold_s=4),
        "slide": dict(protocol="ramps", levels=(0.5, 0.85), rate_percent_per_s=18, peak_percent=97, hold_s=1.5),
        "slide_dither": dict(protocol="ramps", levels=(0.45, 0.9), rate_percent_per_s=15, peak_percent=97, hold_s=1.5,
                             dither=(0.11, 195, "square")),
        "duty": dict(protocol="duty_cycle", duration_s=36, lowest_percent=12, highest_percent=98, slowest_percent_per_s=12,
                     fastest_percent_per_s=210, longest_hold_s=2.8, pressures=(0.13, 0.98), longest_pressure_hold_s=5.5),
        "duty_dither": dict(protocol="duty_cycle", duration_s=36, lowest_percent=12, highest_percent=98,
                            slowest_percent_per_s=14, fastest_percent_per_s=190, longest_hold_s=2.8, pressures=(0.13, 0.98),
                            longest_pressure_hold_s=5.5, dither=(0.10, 132, "sine")),
        "orifice_dither": dict(protocol="duty_cycle", duration_s=30, lowest_percent=12, highest_percent=97,
                               slowest_percent_per_s=14, fastest_percent_per_s=170, longest_hold_s=2.8, pressures=(0.5, 0.5),
                               longest_pressure_hold_s=5, dither=(0.10, 126, "square"), supply=1.0),
        "sine": dict(protocol="sine", centre_percent=56, amplitude_percent=17, frequency_start_Hz=0.2, frequency_end_Hz=8,
                     sweep_s=24, level=0.75),
        "steps": dict(protocol="steps", positions_percent=(50, 20, 80, 40, 95, 65, 25, 0), hold_s=1.4, level=0.7),
        "rest": dict(protocol="pressure_steps", positions_percent=(45, 75, 98), levels=(0.3, 0.95, 0.5, 0.7, 0.2), hold_s=1.9),
        "fast": dict(protocol="fast_motion", duration_s=6, lowest_percent=15, highest_percent=95, slowest_percent_per_s=120,
                     fastest_percent_per_s=3500, longest_hold_s=0.3, pressures=(0.3, 1.0), longest_pressure_hold_s=2),
    },
}

# Effect: what it changes in the programme, and lines of the scenario (docs/rig.md, "What machines do to it"); {V4} is the speed of
# 4 %/s in m/s.
HLP32 = "[plant.oil]\nviscosity_40C_m2_per_s = 32e-6\nviscosity_100C_m2_per_s = 5.4e-6\ndensity_15C_kg_per_m3 = {}\n"
HLP68 = "[plant.oil]\nviscosity_40C_m2_per_s = 68e-6\nviscosity_100C_m2_per_s = 8.7e-6\ndensity_15C_kg_per_m3 = {}\n"
EFFECTS = {
    "judged": {
        "above": (dict(scale=(1.02, 1.15)), ""),
        "far_above": (dict(scale=(1.45, 1.6)), ""),
        "below": (dict(scale=(0.045, 0.13)), ""),
        "end": ({}, "[machine.actuator_end]\nstands_s = 4\nbegin_s = 9\nevery_s = 13\n"),
        "silt": (dict(longest_hold_s=7), "[plant.spool_friction]\nsilt_factor = 1.9\nsilt_rest_s = 3\n"),
        "friction": ({}, "[plant.spool_friction]\nwear_factor = 1.4\n"),
        "ripple": ({}, "[machine.ripple]\namplitude_bar = 2\nfrequency_Hz = 263\nsecond_amplitude_bar = 0.7\n"
                       "second_frequency_Hz = 29\n"),
        "pwm": ({}, "[machine.pwm]\nshare = 0.05\nfrequency_Hz = 1523\n"),
        "vibration": ({}, "[machine.vibration]\nacceleration_g = 1.7\nfrequency_Hz = 47\n"),
        "oil": (dict(temperatures=(46, 52)), HLP68.format(884) + "[instruments.thermometer]\ntime_constant_s = 20\noffset_K = -4\n"),
        "position": ({}, "[instruments.lvdt]\ngain_error = -0.015\nzero_offset_m = 15e-6\n"),
        "leakage": ({}, "[plant.supply]\nback_pressure_Pa = 10e5\ntank_pressure_Pa = 10e5\n[plant.edge_PB]\n"
                        "scratch_m3_per_s_Pa = 7e-13\n[plant.edge_PA]\nscratch_m3_per_s_Pa = 7e-13\n"),
        "falling": ({}, "[plant.spool_friction]\nfalls_to = 0.55\nfalls_from_m_per_s = {V4}\nfalls_until_m_per_s = {V18}\n"),
        "spikes": ({}, "[machine.spikes]\nshare = 0.001\nheight_A = 0.8\n"),
    },
    "tuning": {
        "above": (dict(scale=(1.05, 1.12)), ""),
        "far_above": (dict(scale=(1.8, 2.0)), ""),
        "below": (dict(scale=(0.05, 0.14)), ""),
        "end": ({}, "[machine.actuator_end]\nstands_s = 5\nbegin_s = 7\nevery_s = 15\n"),
        "silt": (dict(longest_hold_s=9), "[plant.spool_friction]\nsilt_factor = 2\nsilt_rest_s = 5\n"),
        "friction": ({}, "[plant.spool_friction]\nwear_factor = 1.5\n"),
        "ripple": ({}, "[machine.ripple]\namplitude_bar = 3\nfrequency_Hz = 225\nsecond_amplitude_bar = 1\nsecond_frequency_Hz = 25\n"),
        "pwm": ({}, "[machine.pwm]\nshare = 0.08\nfrequency_Hz = 2019\n"),
        "vibration": ({}, "[machine.vibration]\nacceleration_g = 0.9\nfrequency_Hz = 35\n"),
        "oil": (dict(temperatures=(45, 55)), HLP32.format(862) + "[instruments.thermometer]\ntime_constant_s = 15\noffset_K = 5\n"),
        "position": ({}, "[instruments.lvdt]\ngain_error = 0.02\nzero_offset_m = 18e-6\n"),
        "leakage": ({}, "[plant.supply]\nback_pressure_Pa = 12e5\ntank_pressure_Pa = 12e5\n[plant.edge_PB]\n"
                        "scratch_m3_per_s_Pa = 8.3e-13\n[plant.edge_PA]\nscratch_m3_per_s_Pa = 8.3e-13\n"),
        "falling": ({}, "[plant.spool_friction]\nfalls_to = 0.6\nfalls_from_m_per_s = {V5}\nfalls_until_m_per_s = {V20}\n"),
        "spikes": ({}, "[machine.spikes]\nshare = 0.0005\nheight_A = 1\n"),
    },
}
# What a user of that machine would declare of it (docs/environment.md), beside kind = "machine"; {bar} is the highest pressure of the
# valve's calibration. Effects that are missing have nothing beside.
DECLARED = {
    "judged": {"far_above": "highest_pressure_bar = {bar} * 1.6", "friction": "friction_percent = 45", "ripple": "ripple_bar = 2.7",
               "pwm": "pwm_ripple_percent = 5", "vibration": "vibration_g = 1.7", "oil": "viscosity_percent = 50",
               "position": "position_gain_percent = 1.5", "leakage": "leakage_L_min = 0.4", "falling": "friction_percent = 45",
               "silt": "friction_percent = 90"},
    "tuning": {"far_above": "highest_pressure_bar = {bar} * 2", "friction": "friction_percent = 50", "ripple": "ripple_bar = 4",
               "pwm": "pwm_ripple_percent = 8", "vibration": "vibration_g = 0.9", "oil": "viscosity_percent = 50",
               "position": "position_gain_percent = 2", "leakage": "leakage_L_min = 0.4", "falling": "friction_percent = 40",
               "silt": "friction_percent = 100"},
    "shared": {"silt": "friction_percent = 100", "ripple": "ripple_bar = 4", "pwm": "pwm_ripple_percent = 8",
               "vibration03": "vibration_g = 0.9", "otheroil": "viscosity_percent = 50", "lvdtgain": "position_gain_percent = 2"},
}
NO_RUN_KEYS = ("protocol", "levels", "level", "pressures", "dither", "supply", "scale", "temperatures")


def declared(which, effect, preset):
    """Text of the environment that a user of that machine would declare."""
    line = DECLARED[which].get(effect, "")
    if "{bar}" in line:
        key, value = line.split(" = ")
        bar, times = value.split(" * ")
        line = f"{key} = {float(bar.format(bar=HIGHEST_BAR[preset])) * float(times):g}"
    return f'[environment]\nkind = "machine"\n{line}\n'


def toml(value):
    return "[" + ", ".join(map(str, value)) + "]" if isinstance(value, (tuple, list)) else str(value)


def scaled(shares, scale):
    """Shares of the highest pressure, squeezed between the effect's where it has some."""
    if scale is None:
        return list(shares)
    return [scale[0] + (scale[1] - scale[0]) * share for share in shares]


def scenario(which, valve, programme, effect, seed):
    """Text of one run's scenario file."""
    preset = VALVES[which][valve][0]
    bar, whole = HIGHEST_BAR[preset], preset.startswith("whole")
    changes, lines = EFFECTS[which][effect] if effect != "clean" else ({}, "")
    of = dict(PROGRAMMES[which][programme], **{key: value for key, value in changes.items()
                                               if key in PROGRAMMES[which][programme] or key in NO_RUN_KEYS})
    run = {key: value for key, value in of.items() if key not in NO_RUN_KEYS}
    scale = of.get("scale")
    if "levels" in of:
        run["pressure_differences_bar"] = [round(bar * share, 2) for share in scaled(of["levels"], scale)]
    if "level" in of:
        run["pressure_difference_bar"] = round(bar * scaled((of["level"],), scale)[0], 2)
    if "pressures" in of:
        run["lowest_pressure_bar"], run["highest_pressure_bar"] = (round(bar * share, 2) for share in scale or of["pressures"])
    if whole and of["protocol"] in ("duty_cycle", "fast_motion"):
        run["lowest_percent"] = -run["highest_percent"]
    if whole and of["protocol"] == "ramps":
        run["second_peak_percent"] = -run["peak_percent"]
    start_C, end_C = of.get("temperatures", (50, 50))
    conditions = {"oil_temperature_start_C": start_C, "oil_temperature_end_C": end_C}
    if "supply" in of:
        conditions["supply_pressure_bar"] = round(bar * of["supply"], 2)
        lines += "[plant.load]\nkind = \"orifice\"\nreturn_to_tank = " + ("false" if whole else "true") + "\n"
    amplitude_A, frequency_Hz, shape = of.get("dither", (0, 120, "sine"))
    text = f'protocol = "{of["protocol"]}"\nvalve = "valve.toml"\nseed = {seed}\n[run]\n'
    text += "".join(f"{key} = {toml(value)}\n" for key, value in run.items())
    text += "[run.conditions]\n" + "".join(f"{key} = {value}\n" for key, value in conditions.items())
    text += f'[electronics.dither]\namplitude_A = {amplitude_A}\nfrequency_Hz = {frequency_Hz}\nshape = "{shape}"\n'
    for percent_per_s in (4, 5, 18, 20):
        lines = lines.replace("{V%d}" % percent_per_s, f"{percent_per_s / 100 * STROKE_M[preset]:.4g}")
    return text + lines


def planned(which, quick):
    """Every run: valve, programme, effect, seed."""
    runs = []
    for number, (valve, (preset, _, judged_on)) in enumerate(VALVES[which].items()):
        if quick and valve != QUICK[which]:
            continue
        pairs = [(programme, "clean") for programme in PROGRAMMES[which]]
        pairs += [(programme, effect) for effect in EFFECTS[which] for programme in judged_on]
        for programme, effect in pairs:
            seed = SEED[which] + 1000 * (number + 1) + list(PROGRAMMES[which]).index(programme)
            runs.append((valve, programme, effect, seed))
    return runs


def call(*command):
    done = subprocess.run([str(part) for part in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"judging_set: {' '.join(str(part) for part in command)}: {done.stderr.strip()}")


def make_model(spoolflow, folder, which, valve):
    """The valve's file, its campaign, its model."""
    preset, beside, _ = VALVES[which][valve]
    if (folder / "model.json").exists():
        return
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    spread = f"[spread]\namount = 1\nseed = {SEED[which] + list(VALVES[which]).index(valve)}\n" if beside else ""
    (folder / "valve.toml").write_text(f'preset = "{preset}"\n{spread}{WEAR if beside == "worn" else ""}')
    call(spoolflow, "campaign", folder / "valve.toml", "-o", folder / "campaign", "--calibration-only", "-q")
    call(spoolflow, "calibrate", folder / "campaign" / "campaign.toml", "-o", folder / "model.json", "-q")


def make_run(spoolflow, folder, name, text):
    """One recording, and of the truth beside it time and flow alone."""
    file, truth = folder / f"{name}.csv", folder / f"{name}.all_truth.csv"
    if file.exists() and not truth.exists():
        return
    (folder / f"{name}.toml").write_text(text)
    call(spoolflow, "simulate", folder / f"{name}.toml", "-o", file, "--truth", truth, "-q")
    with open(truth) as rows, open(folder / f"{name}.true_flow.csv", "w") as out:
        rows = (line.rstrip("\n").split(",") for line in rows if not line.startswith("#"))
        head = next(rows)
        at = head.index("flow_L_min")
        out.write("time_s,flow_L_min\n")
        out.writelines(f"{row[0]},{row[at]}\n" for row in rows)
    truth.unlink()


def sha256(file):
    return hashlib.sha256(file.read_bytes()).hexdigest()


def option(arguments, name, otherwise=None):
    if name not in arguments:
        return otherwise
    at = arguments.index(name)
    if at + 1 == len(arguments):
        sys.exit(f"{pathlib.Path(sys.argv[0]).stem}: {name} needs a value")
    value = arguments[at + 1]
    del arguments[at:at + 2]
    return value


def main(arguments):
    spoolflow = option(arguments, "--spoolflow", "build/release/bin/spoolflow")
    seed = option(arguments, "--seed")
    which = "tuning" if "--tuning" in arguments else "judged"
    places = [argument for argument in arguments if not argument.startswith("--")]
    unknown = [argument for argument in arguments if argument.startswith("--") and argument not in ("--tuning", "--quick", "--list")]
    if len(places) != 1 or unknown:
        sys.exit("judging_set.py OUT [--tuning] [--seed N] [--quick] [--list] [--spoolflow PROGRAM]")
    if seed:
        if not seed.isdigit():
            sys.exit(f"judging_set: --seed {seed}: give a whole number, 0 or more")
        SEED[which] = int(seed)
        VALVES[which] = {valve: (preset, beside or "drawn", judged_on) for valve, (preset, beside, judged_on) in VALVES[which].items()}
    runs = planned(which, "--quick" in arguments)
    if "--list" in arguments:
        print(f"{which} set, seeds from {SEED[which]}: {len(runs)} runs")
        print("\n".join(f"{valve:16} {programme:14} {effect:10} seed {seed}" for valve, programme, effect, seed in runs))
        return
    out = pathlib.Path(places[0])
    if (out / "set.json").exists():
        sys.exit(f"judging_set: {out} holds a set already; it is made once: judge by it, or choose another folder")
    valves = list(dict.fromkeys(valve for valve, *_ in runs))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count() or 1) as workers:
        list(workers.map(lambda valve: make_model(spoolflow, out / valve, which, valve), valves))
        list(workers.map(lambda run: make_run(spoolflow, out / run[0], f"{run[1]}.{run[2]}", scenario(which, *run)), runs))
    entries = [{"valve": valve, "programme": programme, "effect": effect, "seed": seed, "model": f"{valve}/model.json",
                "recording": f"{valve}/{programme}.{effect}.csv", "truth": f"{valve}/{programme}.{effect}.true_flow.csv"}
               for valve, programme, effect, seed in runs]
    hashes = {name: sha256(out / name) for entry in entries for name in (entry["model"], entry["recording"], entry["truth"])}
    (out / "set.json").write_text(json.dumps({"set": which, "runs": entries, "sha256": hashes}, indent=1) + "\n")
    print(f"{out}: {len(runs)} runs of {len(valves)} valves, the {which} set")


if __name__ == "__main__":
    main(sys.argv[1:])
