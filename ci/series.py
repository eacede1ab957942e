#!/usr/bin/env python3
"""series.py SERIES.json: the table of docs/type_and_unit.md from `spoolflow analyse TYPE --series N --json SERIES.json`. Exit status 1 where the
band of a type holds 93 % of the samples of too few units, or where measured minutes are refused or bring models whose bands do not."""
import json
import pathlib
import sys

LEAST = {"type": 95, "minute": 90}  # units [%] whose band holds 93 %, on each run
MOST_REFUSED = 0.02

study = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
failed = False
for known in study["over_units"]:
    by, units = known["known_by"], known["units"]
    print(f"{by}: {units} units, {known['refused']} refused")
    failed |= by in LEAST and known["refused"] > MOST_REFUSED * (units + known["refused"])
    for name, run in known["runs"].items() if units else ():
        error, band, held = run["p95_percent_FS"], run["in_band_percent"], run["units_holding_93_percent"]
        print(f"  {name:<16} {error['median']:.2f} ({error['low_5']:.2f} to {error['high_95']:.2f}) / {band['median']:.1f} / {held:.0f}")
        failed |= held < LEAST.get(by, 0)
sys.exit(failed)
