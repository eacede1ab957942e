#!/usr/bin/python3
"""TDMS and MDF 4 files as other projects write them, against the same samples as CSV: what `estimate` makes of both.

    foreign_measurement_files.py COMMAND MODEL.json RECORDING.csv NPTDMS_FOLDER ASAMDF_FOLDER

The folders hold the sources of npTDMS and of asammdf (7.4, whose compiled part must have been built), which Debian does not have;
NumPy, pandas, lz4, lxml, canmatrix and numexpr are Debian's. One line a file; the exit status shows whether all could be read and
none differs by more than its numbers' resolution makes.
"""
import csv
import pathlib
import subprocess
import sys
import tempfile
import warnings

import numpy as np

CHANNELS = {"position_mm": ("position", "mm"), "current_A": ("current", "A"), "voltage_V": ("voltage", "V"),
            "oil_temperature_C": ("oil temperature", "degC")}
SAMPLES = 20000


def columns_of(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    numbers = np.array([[float(cell) if cell else np.nan for cell in row] for row in rows[1:SAMPLES + 1]])
    return {name: numbers[:, k] for k, name in enumerate(rows[0])}


def write_csv(path, columns):
    with open(path, "w") as file:
        file.write("time [s]," + ",".join(f"{name} [{unit}]" for name, unit in CHANNELS.values()) + "\n")
        for row in zip(columns["time_s"], *(columns[name] for name in CHANNELS)):
            file.write(",".join("" if np.isnan(cell) else repr(float(cell)) for cell in row) + "\n")


def write_mdf(folder, columns):
    """Yields each file with the largest difference of the flow [L/min] that its numbers may make."""
    from asammdf import MDF, Signal
    time = columns["time_s"]

    def signal(name, samples=None, step=1, **more):
        samples = columns[name] if samples is None else samples
        return Signal(samples=samples[::step], timestamps=time[::step], name=CHANNELS[name][0], unit=CHANNELS[name][1], **more)

    def saved(name, signals, version="4.10", compression=0, fragment=0, limit=1e-9):
        measurement = MDF(version=version)
        if fragment:
            measurement.configure(write_fragment_size=fragment)
        for group in signals:
            measurement.append(group, common_timebase=True)
        measurement.save(folder / name, overwrite=True, compression=compression)
        measurement.close()
        return folder / name, limit

    plain = [[signal(name) for name in CHANNELS]]
    rates = [[signal(name, step=100 if "oil" in name else 1)] for name in CHANNELS]
    for version in ("4.00", "4.10", "4.11", "4.20"):
        yield saved(f"version_{version}.mf4", plain, version)
        yield saved(f"transposed_{version}.mf4", plain, version, compression=2)
        single = [[signal(name, columns[name].astype(np.float32)) for name in CHANNELS]]
        yield saved(f"single_in_pieces_{version}.mf4", single, version, 1, 30000, 1e-3)
        yield saved(f"rates_{version}.mf4", rates, version, compression=1)
    yield saved("highest_byte_first.mf4", [[signal(name, columns[name].astype(">f8")) for name in CHANNELS]])
    milli = np.round(1000 * columns["current_A"]).astype(np.int16)
    others = [signal(name) for name in CHANNELS if name != "current_A"]
    table = {"interpolation": True}
    for k, point in enumerate(np.linspace(-100, 4000, 5)):
        table |= {f"raw_{k}": float(point), f"phys_{k}": float(point) / 1000}
    for name, conversion in {"linear": {"a": 1e-3, "b": 0.0}, "rational": dict(P1=0, P2=1, P3=0, P4=0, P5=0, P6=1000),
                             "table": table}.items():
        yield saved(f"{name}.mf4", [others + [signal("current_A", milli, conversion=conversion)]], limit=0.05)
    states = (np.arange(len(time)) // 1000 % 2).astype(np.uint8)
    texts = {"val_0": 0, "val_1": 1, "text_0": b"off", "text_1": b"on"}
    yield saved("texts_beside.mf4", [plain[0] + [Signal(samples=states, timestamps=time, name="state", conversion=texts)]])


def write_tdms(folder, columns):
    from nptdms import ChannelObject, RootObject, TdmsWriter
    time = columns["time_s"]
    step = float(time[1] - time[0])
    wave = {"wf_increment": step, "wf_start_offset": float(time[0]), "wf_samples": 1}

    def channel(name, part=slice(None), kind=np.float64, **more):
        return ChannelObject("bench", CHANNELS[name][0], columns[name][part].astype(kind),
                             properties={"unit_string": CHANNELS[name][1], **more})

    def saved(name, segments, limit=1e-3, **how):
        with TdmsWriter(str(folder / name), **how) as writer:
            for segment in segments:
                writer.write_segment([RootObject(properties={"name": "run"})] + segment)
        return folder / name, limit

    pieces = [slice(k, k + 1000) for k in range(0, len(time), 1000)]
    waves = [channel(name, **wave) for name in CHANNELS]
    yield saved("time.tdms", [[ChannelObject("bench", "time", time, properties={"unit_string": "s"})] + [channel(name) for name in CHANNELS]], 1e-9)
    yield saved("waveforms.tdms", [waves])
    yield saved("version_4713.tdms", [waves], version=4713)
    yield saved("with_index.tdms", [waves], index_file=True)
    yield saved("segments.tdms", [[channel(name, part, **wave) for name in CHANNELS] for part in pieces])
    yield saved("single.tdms", [[channel(name, part, np.float32, **wave) for name in CHANNELS] for part in pieces])
    stamps = np.datetime64("2026-01-01T10:00:00.000000") + np.round(1e6 * time).astype("timedelta64[us]")
    yield saved("time_stamps.tdms", [[ChannelObject("bench", "time", stamps)] + [channel(name) for name in CHANNELS]])
    slow = {"unit_string": "degC", "wf_increment": 100 * step, "wf_start_offset": float(time[0])}
    yield saved("rates.tdms", [[channel(name, **wave) for name in CHANNELS if "oil" not in name] +
                               [ChannelObject("slow", "oil temperature", columns["oil_temperature_C"][::100], properties=slow)]])
    scale = {"NI_Number_Of_Scales": 1, "NI_Scale[0]_Scale_Type": "Linear", "NI_Scale[0]_Linear_Slope": 1e-3,
             "NI_Scale[0]_Linear_Y_Intercept": 0.0, "NI_Scale[0]_Linear_Input_Source": 0xFFFFFFFF, "NI_Scaling_Status": "unscaled"}
    milli = ChannelObject("bench", "current", np.round(1000 * columns["current_A"]).astype(np.int16),
                          properties={"unit_string": "A", **wave, **scale})
    yield saved("scaled.tdms", [[channel(name, **wave) for name in CHANNELS if name != "current_A"] + [milli]], 0.05)


def estimated(command, model, recording, out):
    said = subprocess.run([command, "estimate", model, str(recording), "-o", str(out), "-q"], capture_output=True, text=True)
    if said.returncode != 0:
        raise RuntimeError(said.stderr.strip())
    return np.genfromtxt(out, delimiter=",", names=True)["flow_L_min"]


def main():
    command, model, recording = sys.argv[1:4]
    folders = [pathlib.Path(folder) for folder in sys.argv[4:6]]
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        facts = scratch / "nptdms-0.dist-info"  # npTDMS asks for its own version
        facts.mkdir()
        (facts / "METADATA").write_text("Metadata-Version: 2.1\nName: nptdms\nVersion: 0\n")
        sys.path[:0] = [str(folders[0]), str(folders[1] / "src"), str(scratch)]
        warnings.simplefilter("ignore")
        columns = columns_of(recording)
        write_csv(scratch / "all.csv", columns)
        wanted = estimated(command, model, scratch / "all.csv", scratch / "wanted.csv")
        failed = 0
        for file, limit in [*write_mdf(scratch, columns), *write_tdms(scratch, columns)]:
            try:
                flow = estimated(command, model, file, scratch / "flow.csv")
                difference = np.nanmax(np.abs(flow - wanted)) if len(flow) == len(wanted) else np.inf
                if "rates" in file.name:
                    limit = 0.05  # a slow temperature is drawn straight between its samples
                result = f"{difference:.2g} L/min"
                failed += difference > limit
            except RuntimeError as error:
                result = str(error)
                failed += 1
            print(f"{file.name:28} {result}", flush=True)
    print(f"{failed} of the files are not as the CSV")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
