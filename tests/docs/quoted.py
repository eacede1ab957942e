#!/usr/bin/python3
"""quoted.py PAGE ROOT: each code block of a page under a line "From `FILE`:" stands in that file, line by line.

A line "..." of a block leaves lines out; lines may be indented otherwise.
"""
import pathlib
import re
import sys


def lines_of(text):
    return [" ".join(line.split()) for line in text.splitlines() if line.strip()]


def stands_in(block, source):
    """Whether the parts of a block, between its "...", follow one another in the source."""
    begin = 0
    for part in "\n".join(block).split("\n...\n"):
        part = part.split("\n")
        places = [k for k in range(begin, len(source) - len(part) + 1) if source[k:k + len(part)] == part]
        if not places:
            return part
        begin = places[0] + len(part)
    return None


def main(page, root):
    text = pathlib.Path(page).read_text(encoding="utf-8")
    quotes = re.findall(r"From `([^`]+)`:\n\n```\w+\n(.*?)```", text, re.DOTALL)
    if not quotes:
        sys.exit(f"{page}: quotes nothing")
    for name, block in quotes:
        missing = stands_in(lines_of(block), lines_of((pathlib.Path(root) / name).read_text(encoding="utf-8")))
        if missing:
            sys.exit(f"{page}: not in {name}:\n" + "\n".join(missing))


main(*sys.argv[1:])
