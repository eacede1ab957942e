#!/usr/bin/python3
"""fleet_load.py COMMAND REFERENCE EXAMPLES single|cluster VALVES SECONDS WORKERS: samples a second through a fleet on
loopback, from the store of a site to committed rows, servers and site included, and the same blocks in one process
without servers. Then, in real time, how long after a block was closed it is committed. `cluster`: three NATS servers, three replicas, a synchronous standby. At 1 kHz, blocks of a second."""
import os
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "addons", "fleet", "tests"))
from fleet import make_recordings, outbox, reach, computed, record_offline, site, write_site  # noqa: E402
from servers import make_certificates  # noqa: E402
from whole_fleet import Fleet  # noqa: E402

COMMAND, REFERENCE, EXAMPLES = (os.path.abspath(path) for path in sys.argv[1:4])
KIND, (VALVES, SECONDS, WORKERS) = sys.argv[4], map(int, sys.argv[5:8])
MODEL = os.path.join(EXAMPLES, "live", "size_6.json")


def written(postgres):
    return int(postgres.ask("SELECT pg_wal_lsn_diff(pg_current_wal_lsn(), '0/0')::bigint")[0])


folder = tempfile.mkdtemp(prefix="spoolflow-fleet-load-")
os.chmod(folder, 0o755)
fleet = None
try:
    make_recordings(COMMAND, folder, SECONDS)
    if KIND == "single":
        make_certificates(folder)
    write_site(folder, MODEL, VALVES, 1.0, with_login=KIND == "single")
    record_offline(COMMAND, folder, "nats://127.0.0.1:1", VALVES, 1000 * SECONDS)
    waiting = outbox(folder)[0]
    samples = 1000 * SECONDS * VALVES
    size = os.path.getsize(os.path.join(folder, "site.sqlite"))
    begin = time.monotonic()
    computed(COMMAND, REFERENCE, folder, MODEL)
    alone_s = time.monotonic() - begin
    fleet = Fleet(COMMAND, folder, KIND)
    fleet.setup()
    for _ in range(WORKERS):
        fleet.start_worker()
    time.sleep(4)  # the partitions are spread
    before = written(fleet.postgres)
    begin = time.monotonic()
    with site(COMMAND, folder, fleet.servers()):
        reach(fleet, waiting, 600)
        fleet_s = time.monotonic() - begin
    wal = written(fleet.postgres) - before
    rows = fleet.postgres.ask("SELECT pg_database_size('postgres')")[0]
    print(f"{KIND}, {VALVES} valves, {WORKERS} workers, {os.cpu_count()} cores: {samples} samples in {waiting} blocks")
    print(f"one process {samples / alone_s / 1e6:.2f} M samples/s; fleet {samples / fleet_s / 1e6:.3f} M samples/s "
          f"({fleet_s:.1f} s)")
    print(f"write-ahead log {wal / waiting / 1e3:.1f} kB a block; database {int(rows) / 1e6:.0f} MB; site's store "
          f"{size / samples:.1f} bytes a sample")

    # The same valves in real time, in a store of their own.
    fleet.stop()
    fleet = None
    os.remove(os.path.join(folder, "site.sqlite"))
    for name in os.listdir(folder):
        if os.path.isdir(os.path.join(folder, name)):
            shutil.rmtree(os.path.join(folder, name))
    write_site(folder, MODEL, VALVES, 1.0, speed=1.0, with_login=KIND == "single")
    fleet = Fleet(COMMAND, folder, KIND)
    fleet.setup()
    for _ in range(WORKERS):
        fleet.start_worker()
    time.sleep(4)
    seen = {}
    with site(COMMAND, folder, fleet.servers()):
        end = time.monotonic() + min(SECONDS, 30)
        while time.monotonic() < end:
            for row in fleet.postgres.ask("SELECT valve, block, extract(epoch FROM committed) * 1000 - wall_ms FROM coverage"):
                valve, block, late_ms = row.split("|")
                if int(block) > 3:  # the first wait for the model
                    seen[valve, block] = float(late_ms)
            time.sleep(0.05)
    late = sorted(seen.values())
    print(f"in real time, {len(late)} blocks: committed {late[len(late) // 2]:.0f} ms after they were closed (median), "
          f"{late[len(late) * 99 // 100]:.0f} ms (99th percentile)")
finally:
    if fleet:
        fleet.stop()
    shutil.rmtree(folder)
