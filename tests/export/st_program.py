#!/usr/bin/env python3
"""st_program.py SPOOLFLOW MODEL.json: the function block of `export st`, run by an interpreter of the Structured Text that it
uses, answers as `estimate --estimator condensed` does, over the whole map, beyond its ends and where samples are missing.
Standard library only."""
import csv
import math
import pathlib
import re
import subprocess
import sys
import tempfile

TOKEN = re.compile(r"\s*(:=|<>|<=|>=|\.\.|[-+*/<>=(),;:\[\]]|\d+\.\d+(?:[eE][-+]?\d+)?|\d+|[A-Za-z_]\w*)")
WORDS = {"AND": " and ", "OR": " or ", "NOT": " not ", "TRUE": "True", "FALSE": "False", ":=": "=", "=": "==", "<>": "!="}
FUNCTIONS = {"LIMIT": lambda low, value, high: max(low, min(value, high)), "MIN": min, "MAX": max, "SQRT": math.sqrt,
             "TRUNC": int}
NOTHING = {"REAL": 0.0, "DINT": 0, "BOOL": False}


class Block:
    """One instance of a function block."""

    def __init__(self, text):
        text = re.sub(r"\(\*.*?\*\)", " ", text, flags=re.S)
        body = re.fullmatch(r"\s*FUNCTION_BLOCK\s+\w+(.*)END_FUNCTION_BLOCK\s*", text, re.S)[1]
        self.values, self.constants = {}, set()
        for kind, section in re.findall(r"\bVAR(\w*(?: CONSTANT)?)\b(.*?)END_VAR", body, re.S):
            for declaration in section.split(";"):
                if declaration.strip():
                    self.declare(declaration, "CONSTANT" in kind)
        self.tokens = TOKEN.findall(re.sub(r"\bVAR\w*(?: CONSTANT)?\b.*?END_VAR", "", body, flags=re.S))
        self.place = 0
        lines = self.statements("", ())
        assert self.place == len(self.tokens), self.tokens[self.place:][:9]
        source = "def run(v, f):\n" + "\n".join(" " + line for line in lines or ["pass"])
        names = {}
        exec(compile(source, "block", "exec"), names)
        self.run = names["run"]

    def declare(self, declaration, constant):
        names, kind, value = re.fullmatch(r"\s*([\w\s,]+?)\s*:\s*(.+?)\s*(?::=\s*(.*))?", declaration, re.S).groups()
        for name in re.split(r"\s*,\s*", names):
            if kind.startswith("ARRAY"):
                first, last = map(int, re.search(r"\[(\d+)\.\.(\d+)\]", kind).groups())
                numbers = re.split(r"\s*,\s*", value.strip(" []\n"))
                assert first == 0 and len(numbers) == last + 1 and all("." in number for number in numbers)
                self.values[name] = [float(number) for number in numbers]
            else:
                self.values[name] = NOTHING[kind] if value is None else type(NOTHING[kind])(
                    value == "TRUE" if kind == "BOOL" else float(value))
            if constant:
                self.constants.add(name)

    def next(self):
        self.place += 1
        return self.tokens[self.place - 1]

    def statements(self, indent, ends):
        out = []
        while self.place < len(self.tokens) and self.tokens[self.place] not in ends:
            word = self.next()
            if word == "IF":
                out += self.branches(indent)
            elif word == "RETURN":
                out.append(indent + "return")
            else:
                assert word in self.values and word not in self.constants, word
                assert self.next() == ":="
                out.append(f"{indent}v['{word}'] = {self.expression(';')}")
                continue
            assert self.next() == ";"
        return out or [indent + "pass"]

    def branches(self, indent):
        out, keyword = [], "if"
        while True:
            out.append(f"{indent}{keyword} {self.expression('THEN')}:")
            out += self.statements(indent + " ", ("ELSIF", "ELSE", "END_IF"))
            word = self.next()
            if word == "ELSE":
                out.append(indent + "else:")
                out += self.statements(indent + " ", ("END_IF",))
                word = self.next()
            if word == "END_IF":
                return out
            keyword = "elif"

    def expression(self, end):
        out = ""
        while (token := self.next()) != end:
            if token in WORDS:
                out += WORDS[token]
            elif token in FUNCTIONS:
                out += f"f['{token}']"
            elif re.match(r"[A-Za-z_]", token):
                assert token in self.values, token
                out += f"v['{token}']"
            else:
                out += token
        return out

    def step(self, **inputs):
        self.values.update(inputs)
        self.run(self.values, FUNCTIONS)
        return self.values


def samples():
    """Time [s], current [A], position [m]; None where missing. Over all of both axes and beyond them."""
    for k in range(7000):
        current = 1.5 * (1 - math.cos(k / 97))  # to 3 A
        position = 1.3e-3 * (1 - math.cos(k / 611)) - (1e-5 if k < 6000 else 2.7e-3)
        yield k * 1e-3, None if 3000 <= k < 3050 else current, None if 4000 <= k < 4600 else position


def main(spoolflow, model):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        subprocess.run([spoolflow, "export", "st", model, "-o", folder / "valve.st"], check=True)
        block = Block((folder / "valve.st").read_text(encoding="ascii"))
        with open(folder / "run.csv", "w", encoding="ascii") as out:
            out.write("time_s,current_A,position_m,oil_temperature_C\n")
            for time_s, current, position in samples():
                cells = ("" if value is None else repr(value) for value in (current, position))
                out.write(f"{time_s:.3f},{','.join(cells)},45\n")
        subprocess.run([spoolflow, "estimate", model, folder / "run.csv", "--estimator", "condensed", "-o", folder / "flow.csv", "-q"],
                       check=True)
        with open(folder / "flow.csv", encoding="ascii") as lines:
            answers = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    seen, before_s = set(), 0.0
    for (time_s, current, position), answer in zip(samples(), answers, strict=True):
        missing = current is None or position is None
        block.step(TimeStep=time_s - before_s, Missing=missing, Current=math.nan if current is None else current,
                   Position=math.nan if position is None else position)
        before_s = time_s
        values = block.values
        status = "|".join(name for name, here in (("closed", values["Closed"]), ("outside_force_map", values["OutsideForceMap"]),
                                                  ("outside_flow_force_map", values["OutsideFlowForceMap"]),
                                                  ("other_direction", values["OtherDirection"]),
                                                  ("sample_missing", values["SampleMissing"]), ("time_fault", values["TimeFault"]))
                          if here)
        seen.add(status)
        assert status == (answer["status"] or ""), (time_s, status, answer)
        for column, name, scale in (("flow_L_min", "Flow", 60000), ("flow_lower_L_min", "FlowLower", 60000),
                                    ("flow_upper_L_min", "FlowUpper", 60000), ("pressure_difference_bar", "PressureDifference", 1e-5),
                                    ("magnetic_force_N", "MagneticForce", 1), ("flow_force_N", "FlowForce", 1)):
            mine, theirs = values[name] * scale, float(answer[column])
            held_elsewhere = missing and position is not None and name in ("FlowLower", "FlowUpper")  # opens further there
            good = abs(mine - theirs) < 2e-3 + 1e-4 * abs(theirs) or (held_elsewhere and abs(mine) >= abs(theirs) - 2e-3)
            assert good or math.isnan(theirs), (time_s, name, mine, theirs)
    wanted = {"", "closed", "outside_force_map", "outside_flow_force_map",
              "closed|outside_force_map|other_direction", "sample_missing"}
    assert wanted <= seen, wanted - seen


if __name__ == "__main__":
    main(*sys.argv[1:])
