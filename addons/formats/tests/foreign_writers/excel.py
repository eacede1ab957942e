"""excel.py COMMAND MODEL FOLDER: workbooks by openpyxl, as a program for sheets writes them and as its writer for large ones does,
read by `inspect` and `estimate` beside the same numbers in a CSV file."""
import csv
import datetime
import json
import math
import subprocess
import sys
from pathlib import Path

try:
    import openpyxl
    from openpyxl.utils import datetime as excel_time
except ImportError:
    print("SKIPPED: python3-openpyxl is not installed")
    sys.exit(77)

command, model, folder = sys.argv[1], sys.argv[2], Path(sys.argv[3])
folder.mkdir(parents=True, exist_ok=True)
SAMPLES = 3000
NAMES = ["time_s", "current_A", "voltage_V", "position_mm", "oil_temperature_C"]


def sample(k):
    opening = 0.5 - 0.5 * math.cos(2 * math.pi * k / 1500)
    return [k / 1000, round(0.2 + 1.6 * opening, 4), round(1 + 8 * opening, 3), round(2.1 * opening, 4), 40 + k / 1000]


ROWS = [sample(k) for k in range(SAMPLES)]
ROWS[700][2] = None  # a sample is missing


def run(*arguments):
    done = subprocess.run([command, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, (arguments, done.stderr)
    return done.stdout


def estimate(name, *options):
    out = folder / f"{name}.estimate.csv"
    run("estimate", "-q", model, folder / name, *options, "-o", out)
    return out.read_bytes()


def refused(name, words):
    done = subprocess.run([command, "inspect", folder / name], capture_output=True, text=True)
    assert done.returncode == 2 and words in done.stderr, (name, done.returncode, done.stderr)


with open(folder / "run.csv", "w", newline="") as file:
    out = csv.writer(file)
    out.writerow(NAMES)
    out.writerows([["" if value is None else repr(value) for value in row] for row in ROWS])
expected = estimate("run.csv")

# As a person keeps it: a page about the run, a title, units below the names, a column of remarks.
book = openpyxl.Workbook()
book.active.title = "About"
for line in ("Valve", "A 17"), ("Samples", SAMPLES):
    book.active.append(line)
sheet = book.create_sheet("Run")
sheet.append(["Monday, warm oil"])
sheet.append([])
sheet.append([name.rsplit("_", 1)[0] for name in NAMES] + ["remark"])
sheet.append([name.rsplit("_", 1)[1] for name in NAMES])
for k, row in enumerate(ROWS):
    sheet.append(row + (["louder here"] if k == 900 else []))
sheet.freeze_panes = "A5"
book.create_sheet("Empty")
book.save(folder / "kept.xlsx")
assert estimate("kept.xlsx") == expected
seen = json.loads(run("inspect", "--json", folder / "kept.xlsx"))
assert seen["format"] == "Excel" and seen["samples"] == SAMPLES, seen
assert [each["missing"] for each in seen["channels"] if each["channel"] == "voltage"] == [1], seen

# The writer for large sheets, which knows no size before it has written all; every text inline or shared as it likes.
book = openpyxl.Workbook(write_only=True)
sheet = book.create_sheet("Run")
sheet.append(NAMES)
for row in ROWS:
    sheet.append(row)
book.save(folder / "large.xlsx")
assert estimate("large.xlsx") == expected

# Dates for the time, in both of Excel's systems.
for epoch in (excel_time.WINDOWS_EPOCH, excel_time.MAC_EPOCH):
    book = openpyxl.Workbook()
    book.epoch = epoch
    sheet = book.active
    sheet.append(["clock", *NAMES[1:]])
    begin = datetime.datetime(2026, 11, 23, 11, 59, 58)
    for row in ROWS:
        sheet.append([begin + datetime.timedelta(milliseconds=round(1000 * row[0])), *row[1:]])
    book.save(folder / "dated.xlsx")
    (folder / "map.toml").write_text('[channels]\ntime = { column = "clock", unit = "s" }\n' + "".join(
        f'{name.rsplit("_", 1)[0]} = {{ column = "{name}", unit = "{name.rsplit("_", 1)[1]}" }}\n' for name in NAMES[1:]))
    assert estimate("dated.xlsx", "--channels", folder / "map.toml") == expected, epoch

# What it writes of a formula has no result.
book = openpyxl.load_workbook(folder / "large.xlsx")
book["Run"]["B2"] = "=0.2"
book.save(folder / "formula.xlsx")
refused("formula.xlsx", "'Run'!B2: is a formula whose result the file does not hold")
book = openpyxl.load_workbook(folder / "large.xlsx")
book["Run"]["D17"] = "open"
book.save(folder / "text.xlsx")
refused("text.xlsx", "'Run'!D17: 'open' is not a number")
print(f"{SAMPLES} samples by openpyxl {openpyxl.__version__}: the bytes of the CSV's estimate")
