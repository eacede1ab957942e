#!/usr/bin/python3
"""footprint.py SPOOLFLOW MODEL.json WHOLE.json SOURCES [--write] [CORE…]: flash, RAM and worst-case stack of both sensors on each core; of a whole valve on
the first.

The step of an exported model is linked as firmware links it. Stack is the deepest way through all calls of the linked code, the
compiler's library and libm with it: the frames that the machine code opens, which for functions of the sensor must be those
that the compiler states (-fcallgraph-info=su). Fails where docs/embedded.md has other rows than those of the named cores
(default: all) or names other cores than `export c`; --write renews the table. Needs arm-none-eabi-g++.
"""
import functools
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = """#include "valve_model.hpp"
static valve_model::{state} state;
extern "C" [[gnu::flatten]] const spoolflow::sensor::Estimate<float>& sensor_step(const valve_model::Sample& sample) {{
  return step(valve_model::{parameters}, state, sample);
}}
"""
SENSORS = {"observer": ("State", "observer"), "condensed": ("CondensedState", "condensed")}
WHOLE = ", whole valve"
OPTIONS = ("-std=c++17 -O2 -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics -ffunction-sections -fdata-sections "
           "-fno-tree-loop-distribute-patterns -fcallgraph-info=su -nostartfiles -nostdlib -Wl,--gc-sections -Wl,-e,sensor_step -I.").split()
HEADING = "| core | sensor | flash, code and tables | RAM | worst-case stack |\n|---|---|---|---|---|\n"


def said(*command, folder):
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stderr[:2000]}")
    return done.stdout


def registers(text):
    """How many words a list like "r4-r7, lr" has; a d register has two."""
    count = 0
    for part in text.split(","):
        first, _, last = part.strip().partition("-")
        number = int(last[1:]) - int(first[1:]) + 1 if last else 1
        count += number * (2 if first.startswith("d") else 1)
    return count


def opened_by(operation, operands, word_at):
    """Bytes that an instruction takes from the stack."""
    if operation in ("push", "vpush") or operation.startswith(("stmdb", "vstmdb", "vpush")):
        if operation.startswith(("stmdb", "vstmdb")) and not operands.startswith("sp!"):
            return 0
        return 4 * registers(operands[operands.index("{") + 1:operands.index("}")])
    amount = re.match(r"sp,(?: sp,)? #(\d+)", operands)
    if operation.startswith("sub") and operands.startswith("sp,"):
        return int(amount[1])  # an amount in a register has no match and ends the test
    if operation.startswith("str") and (below := re.search(r"\[sp, #-(\d+)\]!", operands)):
        return int(below[1])
    if operation.startswith("add") and (by := re.match(r"sp, (?:sp, )?(r\d+)$", operands)):
        return max(0, -word_at(by[1]))
    return 0


def functions_of(disassembly):
    """By name: bytes of stack that its own instructions take, and the functions that it calls or ends in."""
    words = {int(place, 16): int(word, 16) for place, word in re.findall(r"^ *([0-9a-f]+):\t[0-9a-f ]+\t\.word\t0x([0-9a-f]+)", disassembly, re.M)}
    functions, name, loaded = {}, "", {}
    for line in disassembly.splitlines():
        if begin := re.match(r"[0-9a-f]+ <([^>]+)>:", line):
            name, loaded = begin[1], {}
            functions[name] = [0, set()]
        instruction = re.match(r" *[0-9a-f]+:\t[0-9a-f ]+\t(\S+)\t?([^@;]*)(.*)", line)
        if not instruction or not name:
            continue
        operation, operands, comment = (part.strip() for part in instruction.groups())
        if operation.startswith("ldr") and (literal := re.search(r"\(?([0-9a-f]+) <", comment)) and "[pc" in operands:
            word = words.get(int(literal[1], 16), 0)
            loaded[operands.split(",")[0]] = word - (word >> 31 << 32)
        functions[name][0] += opened_by(operation, operands, loaded.__getitem__)
        if operation == "blx" and re.match(r"r\d", operands):
            sys.exit(f"{name} calls what only runs can say")
        target = re.search(r"<([^>+]+)>$", operands)
        if target and target[1] != name and re.match(r"(b|bl|blx|b\w\w)(\.[nw])?$|cbn?z$", operation):
            functions[name][1].add(target[1])
    return functions


def deepest(functions, entry):
    @functools.cache
    def below(name):
        own, callees = functions[name]
        return own + max(map(below, callees), default=0)  # a circle of calls ends in RecursionError
    return below(entry)


def check_frames(functions, stated):
    """What the machine code opens is what the compiler says of the same function."""
    own = 0
    for name, size, kind in re.findall(r'node: \{ title: "([^"]+)" label: "[^"]*\\n(\d+) bytes \((\w+)\)', stated):
        if kind != "static":
            sys.exit(f"{name}: its stack depends on data")
        if name in functions:
            own += 1
            if functions[name][0] != int(size):
                sys.exit(f"{name}: the code opens {functions[name][0]} bytes of stack, the compiler states {size}")
    if own == 0:
        sys.exit("no function has a frame that the compiler states")


def measured(folder, sensor, flags):
    state, parameters = SENSORS[sensor]
    (folder / "step.cpp").write_text(SOURCE.format(state=state, parameters=parameters))
    hard = "-mfloat-abi=hard" in flags
    said("arm-none-eabi-g++", *flags, *OPTIONS, "step.cpp", "-o", "step.elf", *(() if hard else ("-lm", "-lc")), "-lgcc", folder=folder)
    text, data, bss = map(int, said("arm-none-eabi-size", "step.elf", folder=folder).splitlines()[1].split()[:3])
    functions = functions_of(said("arm-none-eabi-objdump", "-d", "step.elf", folder=folder))
    check_frames(functions, (folder / "step.elf-step.ci").read_text())
    return text + data, data + bss, deepest(functions, "sensor_step")


def main(spoolflow, model, whole, sources, *more):
    sources = pathlib.Path(sources)
    page = sources / "docs" / "embedded.md"
    cores = dict(re.findall(r'\{"(cortex-[^"]+)", "([^"]+)"\}', (sources / "spoolflow/export/c_folder.cpp").read_text()))
    asked = [core for core in more if core != "--write"] or list(cores)
    keys = [(core, valve, sensor) for core in cores for valve in ("", WHOLE) for sensor in SENSORS if not valve or core == next(iter(cores))]
    rows = {}
    for file, valve in ((model, ""), (whole, WHOLE)):
        with tempfile.TemporaryDirectory() as name:
            subprocess.run([spoolflow, "export", "cpp", file, "-o", name], check=True)
            for core, its_valve, sensor in keys:
                if core in asked and its_valve == valve:
                    flash, ram, stack = measured(pathlib.Path(name), sensor, cores[core].split())
                    rows[core, valve, sensor] = f"| {core} | {sensor}{valve} | {flash} | {ram} | {stack} |"
                    print(rows[core, valve, sensor])
    text = page.read_text()
    begin = text.index(HEADING) + len(HEADING)
    table = text[begin:text.index("\n\n", begin)]
    if "--write" in more:
        page.write_text(text.replace(HEADING + table, HEADING + "\n".join(rows[key] for key in keys)))
        return
    there = table.splitlines()
    if [row.split(" | ")[:2] for row in there] != [[f"| {core}", sensor + valve] for core, valve, sensor in keys]:
        sys.exit(f"{page}: the table names other cores than `export c --target`: {', '.join(cores)}")
    missing = [row for row in rows.values() if row not in there]
    if missing:
        sys.exit(f"{page} is not what is measured; `{sys.argv[0]} SPOOLFLOW MODEL WHOLE SOURCES --write` renews it:\n" + "\n".join(missing))


if __name__ == "__main__":
    main(*sys.argv[1:])
