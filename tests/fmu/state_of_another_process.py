#!/usr/bin/env python3
"""state_of_another_process.py SPOOLFLOW MODEL.json: a state that one process has serialized goes on in another one.

Of sensor and virtual valve, by FMI 2.0 and 3.0: a first process steps for half a second, serializes its state into a file and
goes on for half a second more. A second process, which has unpacked the FMU elsewhere, reads the file and gives every
following answer to the bit. A third one begins without the state and does not. Standard library only.
"""
import ctypes as c
import math
import pathlib
import subprocess
import sys
import tempfile
import zipfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "ci"))
import fmu_answers  # noqa: E402

KEPT_AT, END = 500, 1000  # steps of 1 ms


def sensor_inputs(time_s):
    opening = 0.5 - 0.5 * math.cos(2 * math.pi * 1.7 * time_s)
    return {"current": 1.4 * opening, "voltage": 6.0 * opening, "position": 1.5e-3 * opening, "oil_temperature": 320 + time_s}


def state_name(fmu):
    return "FMUstate" if fmu.two else "FMUState"


def serialized(fmu):
    state, size = c.c_void_p(), c.c_size_t()
    fmu.call("Get" + state_name(fmu), c.byref(state))
    fmu.call(f"Serialized{state_name(fmu)}Size", state, c.byref(size))
    room = (c.c_char * size.value)()
    fmu.call("Serialize" + state_name(fmu), state, room, size)
    fmu.call("Free" + state_name(fmu), c.byref(state))
    return bytes(room)


def restore(fmu, kept):
    state = c.c_void_p()
    fmu.call(("DeSerialize" if fmu.two else "Deserialize") + state_name(fmu), kept, c.c_size_t(len(kept)), c.byref(state))
    fmu.call("Set" + state_name(fmu), state)
    fmu.call("Free" + state_name(fmu), c.byref(state))


def answers(fmu, first):
    """All outputs after each step from `first` on, a line each, to the last bit."""
    inputs = fmu_answers.course_of_valve if "position_set" in fmu.variables else sensor_inputs
    outputs = {kind: [name for name, (_, its, causality) in fmu.variables.items() if causality == "output" and its == kind]
               for kind in ("Real", "Integer", "Boolean")}
    for k in range(first, END):
        fmu.set(inputs(k * 1e-3))
        fmu.step(k * 1e-3, 1e-3)
        values = [value for kind, names in outputs.items() if names for value in fmu.get(kind, names)]
        yield " ".join(value.hex() if isinstance(value, float) else str(value) for value in values)


def process(part, folder, state):
    fmu = fmu_answers.Fmu(folder)
    fmu.start([])
    if part != "second":
        fmu.call("ExitInitializationMode")
    if part == "first":
        run = answers(fmu, 0)
        for _ in range(KEPT_AT):
            next(run)
        state.write_bytes(serialized(fmu))
        print(*run, sep="\n")
        return
    if part == "second":
        restore(fmu, state.read_bytes())
    else:  # begins where the kept run went on, without what it knew
        fmu.step(0, KEPT_AT * 1e-3)
    print(*answers(fmu, KEPT_AT), sep="\n")


def said_by(part, fmu, folder, state):
    place = folder / part
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(place)
    run = subprocess.run([sys.executable, __file__, part, place, state], stdout=subprocess.PIPE, text=True, check=True)
    return run.stdout.splitlines()


def main():
    spoolflow, model = sys.argv[1:]
    for what in (model, "size_6"):
        for version in "23":
            with tempfile.TemporaryDirectory() as name:
                folder = pathlib.Path(name)
                subprocess.run([spoolflow, "export", "fmu", what, "--fmi", version, "-o", folder / "x.fmu"], check=True)
                first, second, third = (said_by(part, folder / "x.fmu", folder, folder / "state")
                                        for part in ("first", "second", "third"))
                size = (folder / "state").stat().st_size
            assert len(first) == END - KEPT_AT and len(set(first)) > 100, "the answers do not move"
            differing = [k for k, (one, other) in enumerate(zip(first, second, strict=True)) if one != other]
            assert not differing, f"{what}, FMI {version}: answer {differing[0]} after the state differs: {first[differing[0]]}, {second[differing[0]]}"
            assert third != first, "the state does not matter"
            print(f"{pathlib.Path(what).name}, FMI {version}: {len(first)} answers after a state of {size} bytes are the same to the bit")


if __name__ == "__main__":
    if len(sys.argv) == 4 and sys.argv[1] in ("first", "second", "third"):
        process(sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]))
    else:
        main()
