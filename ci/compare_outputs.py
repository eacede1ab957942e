#!/usr/bin/env python3
"""compare_outputs.py A B [--tolerance RELATIVE]: what differs between two folders that `ci/outputs.sh make` wrote.

One paragraph a file that differs: for each column of a CSV, each path of a JSON file and each packed column of a page the
number of values that differ and the largest difference; else the first lines that differ. Exit status 0 where nothing does, 1
where anything does, 2 where there is nothing to compare.

Numbers may differ by RELATIVE of their magnitude (of a column: of its largest); by nothing where it is not given.

Left out: dates; version texts; checksums of a model whose content is equal; the order of the files of a folder; fields that name
source files in an FMU's description. Sources that an FMU or a C++ folder carries along are listed in the last lines and
count as equal: what they do is compared as answers.
"""
import argparse
import base64
import csv
import difflib
import hashlib
import json
import math
import pathlib
import re
import sys

MOST_LISTED = 8  # paths, columns or lines of one file
SHOWN = 110  # letters of a line
CARRIED_SOURCES = re.compile(r"(?:^|/)(?:sources|cpp/spoolflow)/")
NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
PACKED = re.compile(r'\{"offset":([^,]+),"scale":([^,]+),"values":"([^"]*)"\}')
LEFT_OUT = [(re.compile(r"\d{4}-\d\d-\d\d(?:[T ]\d\d:\d\d(?::\d\d)?(?:Z| UTC)?)?"), "<date>"),
            (re.compile(r"\b(spoolflow|version) \d+\.\d+\.\d+[\w.+-]*"), r"\1 <version>"),
            (re.compile(r'^\s*<(?:File|SourceFile) name="[^"]*"/>\n', re.M), "")]


class Difference:
    """Of a list of numbers: how many differ, and the largest difference with its pair."""

    def __init__(self, tolerance):
        self.tolerance, self.count, self.of, self.absolute, self.relative, self.pair = tolerance, 0, 0, 0.0, 0.0, None

    def add(self, a, b, scale=None):
        self.of += 1
        if a == b or (a != a and b != b):
            return
        size = scale if scale is not None else max(abs(a), abs(b))
        away = abs(a - b) if math.isfinite(a) and math.isfinite(b) else math.inf
        if away <= self.tolerance * size:
            return
        self.count += 1
        if self.pair is None or away > self.absolute:
            self.absolute, self.pair = away, (a, b)
        self.relative = max(self.relative, away / max(abs(a), abs(b)) if away < math.inf else math.inf)

    def __str__(self):
        return (f"{self.count} of {self.of} numbers, by {self.absolute:.3g} at most ({self.pair[0]:.9g} -> {self.pair[1]:.9g}), "
                f"by {self.relative:.3g} of their size at most")


def at_most(listed, what):
    return listed[:MOST_LISTED] + ([f"and {len(listed) - MOST_LISTED} more {what}"] if len(listed) > MOST_LISTED else [])


def shortened(text, place):
    """The part of a line about `place`."""
    first = max(0, min(place - SHOWN // 2, len(text) - SHOWN))
    return ("…" if first else "") + text[first:first + SHOWN] + ("…" if first + SHOWN < len(text) else "")


def first_difference(a, b):
    return next((k for k, (x, y) in enumerate(zip(a, b)) if x != y), min(len(a), len(b)))


def differing_pair(a, b):
    place = first_difference(a, b)
    return [f"- {shortened(a, place)}", f"+ {shortened(b, place)}"]


def text_differences(a, b, tolerance):
    """Of two texts, by lines. Lines that differ in numbers alone are listed together."""
    a, b = a.splitlines(), b.splitlines()
    numbers, listed, more = Difference(tolerance), [], 0
    at = None
    for tag, a0, a1, b0, b1 in difflib.SequenceMatcher(None, a, b, autojunk=False).get_opcodes() if len(a) + len(b) < 20000 \
            else [("replace", 0, len(a), 0, len(b))]:
        if tag == "equal":
            continue
        for k in range(max(a1 - a0, b1 - b0)):
            x, y = (a[a0 + k] if a0 + k < a1 else None), (b[b0 + k] if b0 + k < b1 else None)
            if x == y:
                continue
            if x is not None and y is not None and NUMBER.sub("#", x) == NUMBER.sub("#", y):
                before = numbers.count
                for p, q in zip(NUMBER.findall(x), NUMBER.findall(y)):
                    numbers.add(float(p), float(q))
                if at is None and numbers.count > before:
                    at = [f"line {a0 + k + 1}:"] + differing_pair(x, y)
                continue
            more += 1
            if more > MOST_LISTED // 2:
                continue
            listed += [f"line {a0 + k + 1}:"] + (differing_pair(x, y) if x is not None and y is not None else
                                              [("- " if y is None else "+ ") + shortened(y if x is None else x, 0)])
    if more > MOST_LISTED // 2:
        listed.append(f"and {more - MOST_LISTED // 2} more lines")
    if numbers.count:
        listed += [str(numbers), *(at or [])]
    return listed


def as_number(text):
    try:
        return float(text)
    except ValueError:
        return None


def csv_differences(a, b, tolerance):
    a, b = list(csv.reader(a.splitlines())), list(csv.reader(b.splitlines()))
    if not a or not b or a[0] != b[0]:
        return ["other columns:", *differing_pair(",".join(a[0] if a else []), ",".join(b[0] if b else []))]
    listed = [] if len(a) == len(b) else [f"{len(a) - 1} rows -> {len(b) - 1} rows"]
    rows = [(x, y) for x, y in zip(a[1:], b[1:])]
    if any(len(x) != len(y) for x, y in rows):
        return listed + ["rows of other lengths"]
    for k, column in enumerate(a[0]):
        differing = [(row, x[k], y[k]) for row, (x, y) in enumerate(rows) if x[k] != y[k]]
        if not differing:
            continue
        numbers = Difference(tolerance)
        scale = max((abs(n) for x, _ in rows if (n := as_number(x[k])) is not None and math.isfinite(n)), default=0.0)
        words = []
        for row, x, y in differing:
            p, q = as_number(x), as_number(y)
            if p is None or q is None:
                words.append((row, x, y))
            else:
                numbers.add(p, q, scale)
        numbers.of = len(rows)
        if numbers.count:
            listed.append(f"{column}: {numbers}")
        if words:
            row, x, y = words[0]
            listed.append(f"{column}: {len(words)} of {len(rows)} rows; first row {row + 1}: {x!r} -> {y!r}")
    return listed


def json_differences(a, b, tolerance):
    numbers, others = {}, []

    def walk(a, b, path):
        if isinstance(a, dict) and isinstance(b, dict):
            for key in [*a, *(key for key in b if key not in a)]:
                if key in a and key in b:
                    walk(a[key], b[key], f"{path}.{key}")
                else:
                    others.append(f"{path}.{key} {'is new' if key in b else 'is gone'}")
            if list(a) != list(b) and set(a) == set(b):
                others.append(f"{path}: keys in another order")
        elif isinstance(a, list) and isinstance(b, list):
            if len(a) != len(b):
                others.append(f"{path}: {len(a)} -> {len(b)} entries")
            for x, y in zip(a, b):
                walk(x, y, path + "[]")
        elif all(isinstance(each, (int, float)) and not isinstance(each, bool) for each in (a, b)):
            numbers.setdefault(path, Difference(tolerance)).add(a, b)
        elif a != b:
            inner = text_differences(a, b, tolerance) if isinstance(a, str) and isinstance(b, str) else [f"{a!r} -> {b!r}"]
            inner = [line for line in inner if line != "line 1:"]
            if inner:
                others.append("\n        ".join([f"{path}:", *inner]))

    walk(json.loads(a), json.loads(b), "")
    numbers = [f"{path}: {difference}" for path, difference in numbers.items() if difference.count]
    return at_most(numbers, "paths of numbers") + at_most(others, "other paths")


def unpacked(offset, scale, codes):
    """Values of a page's packed column (spoolflow/report, packed numbers)."""
    data = base64.b64decode(codes)
    codes = [int.from_bytes(data[k:k + 2], "little", signed=True) for k in range(0, len(data), 2)]
    return [math.nan if code == -32768 else offset + scale * code for code in codes]


def html_differences(a, b, tolerance):
    columns = [PACKED.findall(page) for page in (a, b)]
    listed = []
    if len(columns[0]) != len(columns[1]):
        listed.append(f"{len(columns[0])} -> {len(columns[1])} packed columns")
    for k, (x, y) in enumerate(zip(*columns)):
        if x == y:
            continue
        p, q = (unpacked(float(offset), float(scale), codes) for offset, scale, codes in (x, y))
        if len(p) != len(q):
            listed.append(f"packed column {k}: {len(p)} -> {len(q)} values")
            continue
        difference = Difference(tolerance)
        # A packed value is right to half a code; where any difference is let pass, so is one code.
        code = (float(x[1]) + float(y[1])) / 2 if tolerance else 0
        for v, w in zip(p, q):
            difference.add(v, v if abs(v - w) <= 1.5 * code else w)
        if difference.count:
            listed.append(f"packed column {k}: {difference}")
    listed = at_most(listed, "packed columns")
    lines = [re.sub(r"(?=<)", "\n", PACKED.sub("packed column", page)) for page in (a, b)]
    return listed + text_differences(*lines, tolerance)


class Folders:
    def __init__(self, a, b, tolerance):
        self.folders, self.tolerance = (a, b), tolerance
        self.files = [{str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()} for folder in (a, b)]
        self.known_sums = []

    def text(self, which, name):
        data = (self.folders[which] / name).read_bytes()
        try:
            text = data.decode()
        except UnicodeDecodeError:
            return None
        for pattern, stands_for in LEFT_OUT:
            text = pattern.sub(stands_for, text)
        for sums, stands_for in self.known_sums:
            text = text.replace(sums[which], stands_for)
        return text

    def know_models(self):
        """Checksums of models that are equal but for what is left out count as the same."""
        for name in sorted(self.files[0] & self.files[1]):
            if name.endswith("model.json") and self.text(0, name) == self.text(1, name):
                self.known_sums.append(([hashlib.sha256((folder / name).read_bytes()).hexdigest() for folder in self.folders], f"<sum of {name}>"))

    def differences(self, name):
        if (self.folders[0] / name).read_bytes() == (self.folders[1] / name).read_bytes():
            return []
        a, b = self.text(0, name), self.text(1, name)
        if a is None or b is None:
            return [f"bytes differ ({(self.folders[0] / name).stat().st_size} -> {(self.folders[1] / name).stat().st_size})"]
        if a == b:
            return []
        kind = {".csv": csv_differences, ".json": json_differences, ".html": html_differences}.get(pathlib.Path(name).suffix, text_differences)
        try:
            return kind(a, b, self.tolerance)
        except ValueError:  # JSON that is none
            return text_differences(a, b, self.tolerance)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("a", type=pathlib.Path)
    arguments.add_argument("b", type=pathlib.Path)
    arguments.add_argument("--tolerance", type=float, default=0.0)
    asked = arguments.parse_args()
    folders = Folders(asked.a, asked.b, asked.tolerance)
    if not folders.files[0] or not folders.files[1]:
        sys.exit(2)
    folders.know_models()
    differing, carried = 0, []
    for name in sorted(folders.files[0] | folders.files[1]):
        if CARRIED_SOURCES.search(name):
            if name not in folders.files[0] or name not in folders.files[1] or folders.text(0, name) != folders.text(1, name):
                carried.append(name)
            continue
        if name not in folders.files[1]:
            listed = ["is gone"]
        elif name not in folders.files[0]:
            listed = ["is new"]
        else:
            listed = folders.differences(name)
        if listed:
            differing += 1
            print(f"{name}\n    " + "\n    ".join(listed), flush=True)
    both = len(folders.files[0] & folders.files[1])
    if carried:
        print(f"sources carried along differ, which counts as equal: {len(carried)} files, {carried[0]} the first")
    print(f"{both} files in both; {differing} differ" if differing else f"{both} files, equal")
    sys.exit(1 if differing else 0)


if __name__ == "__main__":
    main()
