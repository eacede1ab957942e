#!/usr/bin/env python3
"""measurement_files.py COMMAND [SAMPLES [ROUNDS]]: what reading costs of the same table (five channels, doubles) in each format that is
read: processor time of `inspect` with its child, the least of ROUNDS, and how much longer than HDF5 it takes."""
import csv
import os
import resource
import struct
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import h5py
import numpy as np

command = sys.argv[1]
samples = int(sys.argv[2]) if len(sys.argv) > 2 else 1_000_000
rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 5
NAMES = ["time_s", "current_A", "voltage_V", "position_mm", "oil_temperature_C"]
random = np.random.default_rng(1)
time = np.arange(samples) / 1000
opening = 0.5 - 0.5 * np.cos(2 * np.pi * time / 1.5)
TABLE = np.column_stack([time, 0.2 + 1.6 * opening, 1 + 8 * opening, 2.1 * opening, np.full(samples, 40.0)])
TABLE[:, 1:] += random.normal(0, 1e-3, (samples, 4))
TABLE = np.round(TABLE, 4)


def write_csv(file):
    with open(file, "w", newline="") as out:
        rows = csv.writer(out)
        rows.writerow(NAMES)
        rows.writerows(TABLE.tolist())


def write_hdf5(file):
    with h5py.File(file, "w") as out:
        for k, name in enumerate(NAMES):
            out[name] = TABLE[:, k]


def write_tdms(file):
    def text(words):
        return struct.pack("<I", len(words)) + words.encode()

    objects = b"".join(text(f"/'rig'/'{name}'") + struct.pack("<IIIQI", 20, 10, 1, samples, 0) for name in NAMES)
    metadata = struct.pack("<I", len(NAMES)) + objects
    raw = TABLE.T.tobytes()
    head = b"TDSm" + struct.pack("<IIQQ", 0xE, 4713, len(metadata) + len(raw), len(metadata))
    Path(file).write_bytes(head + metadata + raw)


def write_mdf4(file):
    out = bytearray(b"MDF     4.10    ".ljust(64, b"\0"))

    def block(name, links, data):
        out.extend(b"\0" * (-len(out) % 8))
        out.extend(name + struct.pack(f"<4xQQ{len(links)}Q", 24 + 8 * len(links) + len(data), len(links), *links) + data)
        return len(out) - 24 - 8 * len(links) - len(data)

    block(b"##HD", [0] * 6, bytes(32))
    channel = 0
    for k in reversed(range(5)):
        name = block(b"##TX", [], NAMES[k].encode() + b"\0")
        channel = block(b"##CN", [channel, 0, name, 0, 0, 0, 0, 0],
                        struct.pack("<4B4I52x", 2 if k == 0 else 0, k == 0, 4, 0, 8 * k, 64, 0, 0))
    group = block(b"##CG", [0, channel, 0, 0, 0, 0], struct.pack("<QQ8xII", 0, samples, 40, 0))
    data = block(b"##DT", [], TABLE.tobytes())
    out[88:96] = struct.pack("<Q", block(b"##DG", [0, group, data, 0], bytes(8)))
    Path(file).write_bytes(out)


def write_xlsx(file):
    office = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as book:
        book.writestr("_rels/.rels", f'<Relationships><Relationship Id="a" Type="{office}/officeDocument" Target="xl/workbook.xml"/></Relationships>')
        book.writestr("xl/_rels/workbook.xml.rels", f'<Relationships><Relationship Id="a" Type="{office}/worksheet" Target="sheet.xml"/></Relationships>')
        book.writestr("xl/workbook.xml", f'<workbook xmlns:r="{office}"><sheets><sheet name="Run" r:id="a"/></sheets></workbook>')
        with book.open("xl/sheet.xml", "w", force_zip64=True) as sheet:
            sheet.write(b"<worksheet><sheetData><row>")
            sheet.write("".join(f'<c t="inlineStr"><is><t>{name}</t></is></c>' for name in NAMES).encode() + b"</row>")
            for k, row in enumerate(TABLE.tolist()):
                cells = "".join(f'<c r="{letter}{k + 2}"><v>{value!r}</v></c>' for letter, value in zip("ABCDE", row))
                sheet.write(f'<row r="{k + 2}">{cells}</row>'.encode())
            sheet.write(b"</sheetData></worksheet>")


FORMATS = {"CSV": ("csv", write_csv), "HDF5": ("h5", write_hdf5), "TDMS": ("tdms", write_tdms), "MDF 4": ("mf4", write_mdf4)}
if samples < 1_048_576:
    FORMATS["Excel"] = ("xlsx", write_xlsx)


def processor_time(file):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([command, "inspect", "-q", file], stdout=subprocess.DEVNULL, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


with tempfile.TemporaryDirectory() as folder:
    files = {}
    for name, (suffix, write) in FORMATS.items():
        files[name] = os.path.join(folder, f"run.{suffix}")
        write(files[name])
    least = {name: min(processor_time(file) for _ in range(rounds)) for name, file in files.items()}
    print(f"{samples} samples of {len(NAMES)} channels, `inspect`, least of {rounds} rounds")
    for name, file in files.items():
        print(f"{name:6} {os.path.getsize(file) / 1e6:7.1f} MB  {least[name]:6.3f} s  {1e9 * least[name] / samples:6.0f} ns a sample  "
              f"{least[name] / least['HDF5']:5.2f} of HDF5")
