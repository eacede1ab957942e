#!/usr/bin/python3
"""fleet_growth.py COMMAND REPORT_LOAD EXAMPLES single|cluster SECONDS VALVES:WORKERS…: what a fleet costs whose sites estimate by
themselves and send a report of each valve a second. A line in Markdown for each pair: reports committed, how late, rows, write-ahead log, and the
processor time of each kind of server and of the workers. Everything on loopback; on Linux alone."""
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "addons", "fleet", "tests"))
from servers import make_certificates, until  # noqa: E402
from whole_fleet import Fleet  # noqa: E402

COMMAND, LOAD, EXAMPLES = (os.path.abspath(path) for path in sys.argv[1:4])
KIND, SECONDS = sys.argv[4], int(sys.argv[5])
MODEL = os.path.join(EXAMPLES, "live", "size_6.json")
TICK = os.sysconf("SC_CLK_TCK")


def processes():
    """Processor time in s so far, by what a process belongs to; PostgreSQL's by its own children, which may have ended."""
    out = {"postgres": 0.0, "nats-server": 0.0, "spoolflow": 0.0}
    for number in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{number}/stat", encoding="utf-8") as file:
                name, _, rest = file.read().partition(" (")[2].rpartition(") ")
        except OSError:
            continue
        if name in out:
            fields = rest.split()
            out[name] += sum(int(fields[k]) for k in (11, 12, 13, 14)) / TICK  # its own and of children that ended
    return out


def written(postgres):
    return int(postgres.ask("SELECT pg_wal_lsn_diff(pg_current_wal_lsn(), '0/0')::bigint")[0])


def rows(postgres):
    return int(postgres.ask("SELECT (SELECT count(*) FROM second) + (SELECT count(*) FROM indicator)")[0])


def measure(valves, workers):
    folder = tempfile.mkdtemp(prefix="spoolflow-fleet-growth-")
    os.chmod(folder, 0o755)
    if KIND == "single":
        make_certificates(folder)
    fleet = Fleet(COMMAND, folder, "cluster" if KIND == "cluster" else "plain")
    try:
        fleet.setup()
        for _ in range(workers):
            fleet.start_worker()
        owned = "SELECT count(*) FROM partition WHERE lease_until > now()"
        until(lambda: fleet.postgres.ask(owned) == ["16"], 60, "partitions that are owned")
        time.sleep(1)
        log, size = written(fleet.postgres), int(fleet.postgres.ask("SELECT pg_database_size('postgres')")[0])
        before, begin = processes(), time.monotonic()
        load = subprocess.Popen([LOAD, f"nats://127.0.0.1:{fleet.nats_ports[0]}", MODEL, str(valves), str(SECONDS)],
                                stdout=subprocess.PIPE, text=True)
        late, wanted = [], valves * SECONDS
        sampled = threading.Event()

        def look():
            while not sampled.wait(1.0):
                late.extend(float(row) for row in fleet.postgres.ask(
                    "SELECT extract(epoch FROM committed) * 1000 - wall_ms FROM coverage WHERE block > 5"))
        looking = threading.Thread(target=look)
        looking.start()
        said = load.communicate()[0].strip()
        covered = 0
        try:
            for _ in range(3 * SECONDS):
                covered = int(fleet.postgres.ask("SELECT coalesce(sum(block), 0) FROM coverage")[0])
                if covered >= wanted:
                    break
                time.sleep(0.5)
        finally:
            sampled.set()
            looking.join()
        took = time.monotonic() - begin
        after = processes()
        cores = {name: (after[name] - before[name]) / took for name in after}
        late.sort()
        log = written(fleet.postgres) - log
        size = int(fleet.postgres.ask("SELECT pg_database_size('postgres')")[0]) - size
        median, most = (late[len(late) // 2], late[len(late) * 99 // 100]) if late else (float("nan"),) * 2
        print(f"| {valves} | {workers} | {covered} of {wanted} in {took:.0f} s | {median:.0f} ms, {most:.0f} ms | "
              f"{rows(fleet.postgres) / took:.0f} | {log / took / 1e6:.2f} MB, {log / wanted:.0f} B a report | "
              f"{size / wanted:.0f} B | {cores['postgres']:.2f}, {cores['nats-server']:.2f}, {cores['spoolflow']:.2f} | {said} |",
              flush=True)
    finally:
        fleet.stop()
        shutil.rmtree(folder)


print("| valves | workers | reports committed | after they were made: median, 99 % | rows a second | write-ahead log a second | database a report | "
      "cores of PostgreSQL, NATS, workers | sender |\n|---|---|---|---|---|---|---|---|---|")
for pair in sys.argv[6:]:
    measure(*map(int, pair.split(":")))
