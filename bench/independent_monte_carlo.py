#!/usr/bin/env python3
"""Holds the budget of `spoolflow analyse` against Monte Carlo made from outside the program.

Perturbs the CSV input of `spoolflow estimate` and the tables of the model file; needs nothing but the Python standard
library. Two comparisons:

    independent_monte_carlo.py points SPOOLFLOW MODEL.json ANALYSIS.json
        condensed sensor at each point of ANALYSIS.json: one CSV row a trial, errors of forces as the current that
        balances them (by the analysis' own sensitivities to current and force)
    independent_monte_carlo.py run SPOOLFLOW MODEL.json ANALYSIS.json RECORDING.csv [TRIALS]
        observer along the recording that ANALYSIS.json was made with (--recording): whole replays; the lines
        pressure_belief and oil_viscosity cannot be perturbed from outside and are left out of both sides; of the
        noises, of which the recording holds one already, both sides take the half that the program adds
"""
import copy
import csv
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

noise_share = 0.5
folder = pathlib.Path(tempfile.mkdtemp(prefix="independent_monte_carlo_"))


def drawn(lines, correlations):
    errors = {}
    for name, line in lines.items():
        u = line["standard_uncertainty"]
        errors[name] = {"normal": lambda: random.gauss(0, u), "rectangular": lambda: random.uniform(-1, 1) * u * 3**0.5,
                        "two-point": lambda: random.choice((-1, 1)) * u}[line["distribution"]]()
    for c in correlations:
        one, other, r = lines[c["one"]], lines[c["other"]], c["coefficient"]
        if one["standard_uncertainty"] > 0:
            errors[c["other"]] = (r * errors[c["one"]] / one["standard_uncertainty"] * other["standard_uncertainty"]
                                  + math.sqrt(1 - r * r) * random.gauss(0, other["standard_uncertainty"]))
    return errors


def flows(spoolflow, model, recording, estimator):
    rows = subprocess.run([spoolflow, "estimate", model, recording, "-o", "-", "--estimator", estimator, "-q"],
                          capture_output=True, text=True, check=True).stdout.splitlines()
    column = rows[0].split(",").index("flow_L_min")
    return [float(row.split(",")[column]) for row in rows[1:]]


def deviation(values):
    mean = sum(values) / len(values)
    return math.sqrt(sum((v - mean) ** 2 for v in values) / (len(values) - 1))


def points(spoolflow, model, analysis, trials=20000):
    recording = str(folder / "trials.csv")
    for point in analysis["points"]:
        if point["estimator"] != "condensed" or not point["inside_maps"]:
            continue
        lines = {line["quantity"]: line for line in point["budget"]}
        slope = {name: line["sensitivity_L_min_per_unit"] for name, line in lines.items()}
        forces = ("magnetic_force_map", "magnetic_load_cell", "magnetic_hysteresis", "flow_force_map", "axial_load_cell",
                  "friction", "spring")
        added = ("flow_map", "flow_meter", "oil_density", "oil_viscosity", "oil_temperature")
        beside = []
        with open(recording, "w", encoding="ascii") as out:
            out.write("time_s,current_A,position_mm\n")
            for k in range(trials):
                e = drawn(lines, point["correlations"])
                force_mA = sum(slope[q] * e[q] for q in forces) / slope["current_offset"]
                current_A = (point["current_A"] * (1 + e["current_gain"] / 100)
                             + 1e-3 * (e["current_offset"] + e["current_noise"] + force_mA))
                position_mm = (point["position_reading_mm"] * (1 + e["position_gain"] / 100)
                               + 1e-3 * (e["position_zero"] + e["position_noise"]))
                out.write(f"{k * 1e-3:.4f},{current_A:.9g},{position_mm:.9g}\n")
                beside.append(sum(slope[q] * e[q] for q in added))
        found = sorted(a + b for a, b in zip(flows(spoolflow, model, recording, "condensed"), beside))
        own = point["monte_carlo"]
        print(f"{point['position_mm']:.2f} mm {point['pressure_difference_bar']:3.0f} bar: budget "
              f"{point['combined_standard_L_min']:.3f} L/min; own trials {own['standard_deviation_L_min']:.3f} "
              f"[{own['lower_L_min']:.2f}, {own['upper_L_min']:.2f}]; independent {deviation(found):.3f} "
              f"[{found[int(0.025 * trials)]:.2f}, {found[int(0.975 * trials)]:.2f}]; independent over own "
              f"{deviation(found) / own['standard_deviation_L_min']:.3f}")


def changed(values, gain, offset=0.0):
    return [changed(v, gain, offset) for v in values] if isinstance(values, list) else gain * values + offset


def disturb_model(model, e):
    def change(key, gain, offset=0.0):
        table = model["observer"][key]
        if isinstance(table, dict):
            table["values"] = changed(table["values"], gain, offset)
        else:
            model["observer"][key] = changed(table, gain, offset)

    axial = 1 + e["axial_load_cell"] / 100
    change("magnetic_force_N", 1 + e["magnetic_load_cell"] / 100, e["magnetic_force_map"])
    change("spring_force_N", axial, e["spring"])
    change("flow_force_N", axial, e["flow_force_map"])
    change("conductance_m3_per_s_sqrt_Pa", (1 + e["flow_meter"] / 100) * (1 - e["oil_density"] / 200))
    change("spool_friction_N", 1 + e["friction"] / 100)
    change("armature_friction_N", 1 + e["friction"] / 100)
    return model


def run(spoolflow, model, analysis, recording, trials=40):
    result = next(r for r in analysis["run"]["results"] if r["estimator"] == "observer")
    lines = {line["quantity"]: line for line in result["budget"]}
    left_out = ("pressure_belief", "oil_viscosity")
    correlations = next(p for p in analysis["points"] if p["estimator"] == "observer" and p["inside_maps"])["correlations"]
    with open(recording, encoding="ascii") as source:
        head, *rows = list(csv.reader(source))
    rows = [[float(cell) for cell in row] for row in rows]
    column = {name: head.index(name) for name in ("current_A", "position_mm", "voltage_V", "oil_temperature_C")}
    place = {round(row[head.index("time_s")], 6): k for k, row in enumerate(rows)}
    watched = [place[round(instant[0], 6)] for instant in result["course"]][::10]
    with open(model, encoding="utf-8") as source:
        nominal = json.load(source)
    answers = []
    for _ in range(trials):
        e = drawn(lines, correlations)
        with open(folder / "model.json", "w", encoding="utf-8") as out:
            json.dump(disturb_model(copy.deepcopy(nominal), e), out)
        with open(folder / "run.csv", "w", encoding="ascii") as out:
            out.write(",".join(head) + "\n")
            for row in rows:
                read = list(row)
                noise_mA = random.gauss(0, noise_share * lines["current_noise"]["standard_uncertainty"])
                noise_um = random.gauss(0, noise_share * lines["position_noise"]["standard_uncertainty"])
                read[column["current_A"]] = (row[column["current_A"]] * (1 + e["current_gain"] / 100)
                                             + 1e-3 * (e["current_offset"] + e["magnetising_current"] + noise_mA))
                read[column["position_mm"]] = (row[column["position_mm"]] * (1 + e["position_gain"] / 100)
                                               + 1e-3 * (e["position_zero"] + noise_um))
                read[column["voltage_V"]] += 1e-3 * e["voltage_offset"]
                read[column["oil_temperature_C"]] += e["oil_temperature"]
                out.write(",".join(f"{value:.9g}" for value in read) + "\n")
        answer = flows(spoolflow, str(folder / "model.json"), str(folder / "run.csv"), "observer")
        answers.append([answer[k] + e["flow_map"] for k in watched])
    variances = [deviation([answer[j] for answer in answers]) ** 2 for j in range(len(watched))]
    independent = math.sqrt(sum(variances) / len(variances))
    kept = sum(line["share"] * (noise_share**2 if name.endswith("noise") else 1)
               for name, line in lines.items() if name not in left_out)
    budget = result["combined_standard_rms_L_min"] * math.sqrt(kept)
    print(f"{trials} replays, {len(watched)} instants, root mean square: independent {independent:.4f} L/min, budget "
          f"without {' and '.join(left_out)} {budget:.4f} L/min; independent over budget {independent / budget:.3f}")


def main(arguments):
    if len(arguments) < 4 or arguments[0] not in ("points", "run"):
        sys.exit(__doc__)
    random.seed(3)
    spoolflow, model = arguments[1:3]
    with open(arguments[3], encoding="utf-8") as source:
        analysis = json.load(source)
    if arguments[0] == "points":
        points(spoolflow, model, analysis)
    else:
        run(spoolflow, model, analysis, arguments[4], *(int(n) for n in arguments[5:6]))


main(sys.argv[1:])
