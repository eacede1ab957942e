#!/usr/bin/env python3
"""freeze.py SPOOLFLOW SOURCE MADE: writes tests/stability/release again, once a major version: NAME.json and whole_run.csv, ramp.csv of
MADE become small models and runs; estimates, page and names are of SPOOLFLOW. With `--estimates` or `--names` in the place of
MADE only these: after a change that betters estimates (the changelog says so), or that adds names."""
import csv
import json
import lzma
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "fuzz"))
from names import all_names  # noqa: E402
from frozen import MODELS, RELEASE, estimated, rows_kept, unpacked  # noqa: E402

COLUMNS = ("time_s", "current_A", "current_a_A", "current_b_A", "voltage_V", "voltage_a_V", "voltage_b_V", "position_mm", "oil_temperature_C",
           "flow_reference_L_min", "pressure_difference_bar")


def pack(name, text):
    (RELEASE / name).write_bytes(lzma.compress(text.encode(), preset=9 | lzma.PRESET_EXTREME))


def freeze_models(made):
    from small_model import small
    for name in MODELS:
        model = json.loads((made / f"{name}.json").read_text(encoding="utf-8"))
        pack(f"{name}.json.xz", json.dumps(small(model), separators=(",", ":")))
    for run, source, begin, step in (("run", "ramp", 2500, 2), ("whole_run", "whole_run", 5000, 4)):  # of 1 kHz
        with open(made / f"{source}.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))[begin:begin + 1250 * step:step]
        names = [name for name in COLUMNS if name in rows[0]]
        lines = [",".join(names)] + [",".join(f"{float(row[name]):.5g}" if name != "time_s" else row[name] for name in names) for row in rows]
        pack(f"{run}.csv.xz", "\n".join(lines) + "\n")


def freeze_estimates(spoolflow):
    with unpacked() as folder, open(RELEASE / "estimates.csv", "w", encoding="utf-8") as out:
        out.write("model,estimator,row,flow_L_min,flow_lower_L_min,flow_upper_L_min,status\n")
        for name in MODELS:
            for estimator in ("condensed", "observer"):
                for number, row in rows_kept(estimated(spoolflow, folder, name, estimator)):
                    flows = ",".join(row[key] for key in ("flow_L_min", "flow_lower_L_min", "flow_upper_L_min"))
                    out.write(f"{name},{estimator},{number},{flows},{row['status']}\n")


def freeze_page(spoolflow):
    with unpacked() as folder, tempfile.TemporaryDirectory() as made:
        page = pathlib.Path(made) / "page.bin"
        subprocess.run([spoolflow, "export", "parameters", folder / "full.json", "--sensors", "observer", "-o", page], check=True,
                       env={"SOURCE_DATE_EPOCH": "1700000000", "PATH": "/usr/bin:/bin"})
        (RELEASE / "page.bin").write_bytes(page.read_bytes())


def freeze_names(spoolflow, source):
    with unpacked() as folder:
        names = sorted(set(all_names(spoolflow, source, folder)))
    (RELEASE / "names.txt").write_text("\n".join(names) + "\n", encoding="utf-8")


if __name__ == "__main__":
    spoolflow, source, what = sys.argv[1:4]
    if what not in ("--estimates", "--names"):
        freeze_models(pathlib.Path(what))
        freeze_page(spoolflow)
    if what != "--names":
        freeze_estimates(spoolflow)
    if what != "--estimates":
        freeze_names(spoolflow, source)
