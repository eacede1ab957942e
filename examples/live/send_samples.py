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
    host, port = asked.address.rsplit(":", 1)

    with open(asked.recording, newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    present = [channel for channel in CHANNELS if channel[0] in rows[0]]
    mask = sum(1 << bit for _, bit, _ in present)
    times = [float(row["time_s"]) for row in rows]
    period_ns = round(1e9 * (times[-1] - times[0]) / (len(times) - 1))
    number = lambda text: float(text) if text else math.nan
    samples = [[to_si(number(row[name])) for name, _, to_si in present] for row in rows]

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
