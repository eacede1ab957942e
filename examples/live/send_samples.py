#!/usr/bin/env python3
"""Sends a recording to `spoolflow live` as datagrams, as a valve's electronics would (layout: docs/live.md).

    send_samples.py RUN.csv VALVE [HOST:PORT=127.0.0.1:7700] [--speed 1.0]

RUN.csv has the columns time_s, current_A, position_mm and perhaps voltage_V, oil_temperature_C.
"""
import argparse
import csv
import math
import os
import socket
import statistics
import struct
import time
import zlib

CHANNELS = [  # column, bit, to SI
    ("current_A", 0, lambda value: value),
    ("voltage_V", 1, lambda value: value),
    ("position_mm", 2, lambda value: 1e-3 * value),
    ("oil_temperature_C", 3, lambda value: value + 273.15),
]


def datagram(valve, session, sequence, time_ns, period_ns, mask, samples):
    """One block of samples; each is a list of SI values in the order of the bits of `mask`."""
    header = struct.pack("<4sBBHIHHQqI32s", b"SFLW", 1, 0, mask, session, len(samples), 0, sequence, time_ns, period_ns,
                         valve.encode())
    body = header + b"".join(struct.pack(f"<{len(sample)}f", *sample) for sample in samples)
    return body + struct.pack("<I", zlib.crc32(body))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("recording")
    parser.add_argument("valve")
    parser.add_argument("address", nargs="?", default="127.0.0.1:7700")
    parser.add_argument("--speed", type=float, default=1.0)
    parser.add_argument("--block", type=int, default=10, help="samples in a datagram")
    asked = parser.parse_args()
    host, _, port = asked.address.rpartition(":")
    if not host or not port.isdigit():
        parser.error(f"{asked.address} is no address with a port; write it as 127.0.0.1:7700")
    if len(asked.valve.encode()) > 32:
        parser.error(f"the id {asked.valve} has {len(asked.valve.encode())} bytes; a valve's has up to 32")
    if asked.speed <= 0 or not 1 <= asked.block <= 1000:
        parser.error(f"--speed {asked.speed:g} must be above 0, --block {asked.block} 1 to 1000")
    try:
        with open(asked.recording, newline="") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    except OSError as failure:
        parser.error(f"{asked.recording}: cannot be read: {failure.strerror}; check the path")
    missing = [name for name in ("time_s", "current_A", "position_mm") if not rows or name not in rows[0]]
    if missing or len(rows) < 2:
        parser.error(f"{asked.recording}: lacks {', '.join(missing) or 'samples'}; needed are time_s, current_A and position_mm "
                     "over two samples at least")
    present = [channel for channel in CHANNELS if channel[0] in rows[0]]
    mask = sum(1 << bit for _, bit, _ in present)
    number = lambda text: float(text) if text else math.nan
    try:
        times = [float(row["time_s"]) for row in rows]
        samples = [[to_si(number(row[name])) for name, _, to_si in present] for row in rows]
    except (TypeError, ValueError) as failure:
        parser.error(f"{asked.recording}: {failure}; a cell is a number, or empty where it is missing")
    period_s = statistics.median(late - early for early, late in zip(times, times[1:]))
    uneven = next((k for k in range(1, len(times)) if abs(times[k] - times[k - 1] - period_s) > 0.5 * period_s), None)
    if uneven is not None or period_s <= 0:
        parser.error(f"{asked.recording}, sample {(uneven or 1) + 1}: is {times[uneven or 1] - times[(uneven or 1) - 1]:g} s from the one "
                     f"before, others {period_s:g} s; a datagram's samples are evenly apart: send the parts one by one")
    period_ns = round(1e9 * (times[-1] - times[0]) / (len(times) - 1))

    out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    session = int.from_bytes(os.urandom(4), "little")
    begin = time.monotonic()
    for first in range(0, len(samples), asked.block):
        block = samples[first:first + asked.block]
        due = begin + (times[first + len(block) - 1] - times[0]) / asked.speed
        time.sleep(max(0.0, due - time.monotonic()))
        out.sendto(datagram(asked.valve, session, first, round(1e9 * times[first]), period_ns, mask, block),
                   (host, int(port)))
    print(f"{len(samples)} samples sent")


if __name__ == "__main__":
    main()
