#!/usr/bin/python3
"""rows.py: two recordings in the folder of work: run.csv, long enough for several row groups, and gaps.csv, which begins before zero and
has samples without values and without times."""
import math

with open("run.csv", "w", encoding="utf-8") as long, open("gaps.csv", "w", encoding="utf-8") as gaps:
    for file in (long, gaps):
        file.write("time_s,current_A,position_mm,oil_temperature_C\n")
    for k in range(150_000):
        swing = math.sin(0.004 * k)
        sample = f"{1.2 + 0.5 * swing:.4f},{1.1 + 0.9 * swing:.5f},50\n"
        long.write(f"{1e-3 * k:.3f},{sample}")
        if k < 20_000:
            time = "" if k % 5000 == 4000 else f"{1e-3 * k - 2.5:.3f}"
            gaps.write(f"{time},,,50\n" if k % 700 == 69 else f"{time},{sample}")
