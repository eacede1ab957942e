#!/usr/bin/env python3
"""A year of a rig valve in minutes: wear that goes on, and references from time to time.

    references_over_a_year.py OUT [--seed 8101] [--healthy] [--spoolflow PROGRAM]

A valve drawn from its series is calibrated by its own campaign. In twelve months friction rises by 30 %, notches widen from 1.08 to 1.2 mm, edges are
rounded by 10 um and the position's zero drifts by 15 um, evenly; --healthy: nothing changes, and what the model becomes is all that is printed. Each month 20 strokes of a cylinder and the closed valve
move the model on, each from the one of the month before. Printed are, each month, 95 % of the errors in % of full scale and the share in the band on ramps and a
duty cycle, with the model as calibrated and as moved; what was found beside the truth; and the drift by all looks. What is there already is not made again.
Standard library only.
"""
import json
import os
import pathlib
import re
import sys

import references_on_rig as rig

MONTHS, MONTH_S, CALIBRATED_S = 12, 30 * 86400, 1767225600  # 2026-01-01


def wear_of(share):
    return (f"[wear]\nfriction_factor = {1 + 0.3 * share:g}\nedge_rounding_m = {10e-6 * share:g}\n[plant.edge_PB]\n"
            f"notch_width_m = {1.08e-3 + 0.12e-3 * share:g}\n[instruments.lvdt]\nzero_offset_m = {15e-6 * share:g}\n")


def found(model):
    adaptations = json.loads(model.read_text())["provenance"].get("adaptations", [])
    wear = adaptations[-1]["wear"] if adaptations else {"edge_width": 0, "friction_ratio": 1, "position_zero_m": 0}
    return f"{100 * wear['edge_width']:+5.1f} % {100 * (wear['friction_ratio'] - 1):+4.0f} % {1e6 * wear['position_zero_m']:+5.1f} um"


def main(arguments):
    spoolflow = rig.option(arguments, "--spoolflow", "build/release/bin/spoolflow")
    seed = int(rig.option(arguments, "--seed", 8101))
    healthy = "--healthy" in arguments
    places = [argument for argument in arguments if not argument.startswith("--")]
    if len(places) != 1:
        sys.exit("references_over_a_year.py OUT [--seed 8101] [--healthy] [--spoolflow PROGRAM]")
    folder = pathlib.Path(places[0]) / f"{'healthy' if healthy else 'worn'}_{seed}"
    folder.mkdir(parents=True, exist_ok=True)
    os.environ["SOURCE_DATE_EPOCH"] = str(CALIBRATED_S)
    (folder / "fresh.toml").write_text(rig.base_of(seed))
    rig.calibrate(spoolflow, folder, "fresh", "month_0.json")
    model, drift = folder / "month_0.json", ""
    judged = "" if healthy else "as calibrated: ramps, duty        as moved: ramps, duty             "
    print(f"month  {judged}edge width, friction, zero found", flush=True)
    for month in range(MONTHS + 1):
        quality = f"month_{month}"
        (folder / f"{quality}.toml").write_text(rig.base_of(seed) + ("" if healthy else wear_of(month / MONTHS)))
        rig.record(spoolflow, folder, seed, quality, month, 0 if healthy else 1)
        if month > 0:
            os.environ["SOURCE_DATE_EPOCH"] = str(CALIBRATED_S + month * MONTH_S)
            references = rig.mark(folder, quality, "right")
            moved = folder / f"moved_{month}.json"
            moved.unlink(missing_ok=True)
            status, text = rig.call(spoolflow, "recalibrate", model, folder / f"{quality}_strokes.csv", folder / f"{quality}_closed.csv",
                                    "--references", references, "-o", moved)
            (folder / f"{quality}.txt").write_text(text)
            drift = "".join(re.findall(r"^drift .*$", text, re.M)) or drift
            if status == 0:
                model = moved
            else:
                print(f"{month:5}  refused: {text.strip().splitlines()[-1]}", flush=True)
        if healthy:
            print(f"{month:5}  {found(model)}", flush=True)
            continue
        figures = [[rig.judged(spoolflow, folder, which, f"{quality}_{run}") for run in rig.JUDGED] for which in (folder / "month_0.json", model)]
        shown = ["; ".join(f"{p95:5.2f}, {100 * share:5.1f} %" for p95, _, share in pair) for pair in figures]
        print(f"{month:5}  {shown[0]}  {shown[1]}  {found(model)}", flush=True)
    print(drift)


if __name__ == "__main__":
    main(sys.argv[1:])
