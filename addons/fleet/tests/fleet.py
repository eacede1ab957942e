"""Sites and workers of a fleet on loopback, and what they must have kept."""
import json
import os
import re
import signal
import sqlite3
import struct
import subprocess
import sys
import threading
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "live", "tests"))
from served import Live  # noqa: E402
from servers import until  # noqa: E402


class Worker:
    def __init__(self, command, folder, name):
        self.name, self.log = name, os.path.join(folder, f"{name}.log")
        with open(os.path.join(folder, "fleet.toml"), encoding="utf-8") as file:
            text = file.read()
        self.file = os.path.join(folder, f"{name}.toml")
        with open(self.file, "w", encoding="utf-8") as file:
            # In the database with the rights of a worker alone.
            file.write(re.sub(r'name = ".*"', f'name = "{name}"', text).replace("user=postgres", "user=worker_1"))
        self.command = command
        self.start()

    def start(self):
        with open(self.log, "a", encoding="utf-8") as log:
            self.process = subprocess.Popen([self.command, "worker", self.file], stderr=log)

    def kill(self):
        self.process.kill()
        self.process.wait()

    def stop(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGCONT)
            self.kill()

    def signal(self, number):
        self.process.send_signal(number)

    def end(self):
        self.process.send_signal(signal.SIGTERM)
        status = self.process.wait(timeout=60)
        with open(self.log, encoding="utf-8") as log:
            assert status == 0, f"{self.name} ended with {status}: {log.read()[-2000:]}"


def make_recordings(command, folder, seconds):
    """Two valves of a series: a sound one, and one that is worn."""
    for name, seed, wear in (("sound", 3, ""), ("worn", 4, "[wear]\nedge_rounding_m = 60e-6\nfriction_factor = 3\n")):
        scenario = os.path.join(folder, f"{name}.toml")
        with open(scenario, "w", encoding="utf-8") as file:
            length = f"[run]\nduration_s = {seconds}\n" if seconds > 100 else ""
            file.write(f'protocol = "duty_cycle"\nvalve = "size_6"\nseed = {seed}\n{wear}{length}')
        recording = os.path.join(folder, f"{name}.csv")
        subprocess.run([command, "simulate", "-q", scenario, "-o", recording], check=True)
        with open(recording, encoding="utf-8") as file:
            lines = [line for _, line in zip(range(1 + 1000 * seconds), file)]
        if wear:  # and its position is not measured for a third of the time, which makes alarms
            at = lines[0].strip().split(",").index("position_mm")
            for k in range(len(lines) // 4, 7 * len(lines) // 12):
                row = lines[k].split(",")
                lines[k] = ",".join([*row[:at], "", *row[at + 1:]])
        with open(recording, "w", encoding="utf-8") as file:
            file.writelines(lines)


def login(folder, user):
    """Of somebody whose password is the name."""
    with open(os.path.join(folder, f"{user}.password"), "w", encoding="utf-8") as file:
        file.write(user + "\n")
    return f'user = "{user}"\npassword_file = "{user}.password"\n'


def write_site(folder, model, valves, block_s, speed=0, with_login=False):
    text = f'[store]\nfile = "site.sqlite"\n[fleet]\nsite = "hall"\nblock_s = {block_s}\n'
    if with_login:
        text += login(folder, "hall") + 'authority = "authority.pem"\n'
    for k in range(valves):
        text += (f'[[valve]]\nid = "v{k}"\nmodel = "{model}"\n'
                 f'source = {{ kind = "replay", recording = "{("sound", "worn")[k % 2]}.csv", speed = {speed} }}\n')
    with open(os.path.join(folder, "site.toml"), "w", encoding="utf-8") as file:
        file.write(text)


def write_reporting_site(folder, model):
    """A site that estimates by itself and sends what it made of its samples; in a folder of its own."""
    inner = os.path.join(folder, "yard")
    os.makedirs(inner)
    text = (f'[store]\nfile = "site.sqlite"\n[alarms]\nraised_after_s = 0\ngone_after_s = 0\n'
            f'[fleet]\nsite = "yard"\nsends = "summaries"\n{login(inner, "yard")}authority = "../authority.pem"\n')
    for k in range(2):
        text += (f'[[valve]]\nid = "v{k}"\nmodel = "{model}"\n'
                 f'source = {{ kind = "replay", recording = "../{("sound", "worn")[k % 2]}.csv", speed = 10 }}\n')
    with open(os.path.join(inner, "site.toml"), "w", encoding="utf-8") as file:
        file.write(text)
    return inner


def reports_of_the_site(folder):
    """What its own store has, in the form of reports_of_the_fleet()."""
    def bits(value):
        return "" if value is None else "\\x" + struct.pack(">d", value).hex()
    store = sqlite3.connect(f"file:{folder}/site.sqlite?mode=ro", uri=True, timeout=10)
    lines = []
    for row in store.execute("SELECT id, wall_ms, samples, time_s, flow_min, flow_mean, flow_max, lower_min, upper_max, "
                             "energy_J, status FROM second JOIN valve ON valve = number"):
        lines.append("|".join(["second", "yard/" + row[0], str(row[1]), str(row[2]), *map(bits, row[3:10]), str(row[10])]))
    for row in store.execute("SELECT id, wall_ms, name, state, value, uncertainty_95, baseline FROM indicator JOIN valve ON "
                             "valve = number"):
        lines.append("|".join(["indicator", "yard/" + row[0], str(row[1]), row[2], row[3], *map(bits, row[4:])]))
    for row in store.execute("SELECT valve, wall_ms, kind, text FROM event WHERE valve != ''"):
        lines.append("|".join(["event", "yard/" + row[0], str(row[1]), row[2], row[3]]))
    for row in store.execute("SELECT valve, id, cause, sign, raised_ms, gone_ms, times, text FROM alarm"):
        lines.append("|".join(["alarm", "yard/" + row[0], *map(str, row[1:])]))
    for row in store.execute("SELECT id, samples, energy_J FROM state JOIN valve ON valve = number"):
        lines.append("|".join(["state", "yard/" + row[0], str(row[1]), bits(row[2])]))
    store.close()
    return sorted(lines)


def reports_of_the_fleet(postgres):
    return sorted(line for sql in (
        "SELECT 'second', id, wall_ms, samples, float8send(time_s), float8send(flow_min), float8send(flow_mean), "
        "float8send(flow_max), float8send(lower_min), float8send(upper_max), float8send(energy_J), status FROM second "
        "JOIN valve ON valve = number WHERE id LIKE 'yard/%'",
        "SELECT 'indicator', id, wall_ms, name, state, float8send(value), float8send(uncertainty_95), float8send(baseline) "
        "FROM indicator JOIN valve ON valve = number WHERE id LIKE 'yard/%'",
        "SELECT 'event', valve, wall_ms, kind, text FROM event WHERE valve LIKE 'yard/%'",
        "SELECT 'alarm', valve, id - (1::bigint << 40), cause, sign, raised_ms, gone_ms, times, text FROM alarm WHERE valve "
        "LIKE 'yard/%'",
        "SELECT 'state', id, samples, float8send(energy_J) FROM state JOIN valve ON valve = number WHERE id LIKE 'yard/%'"
    ) for line in postgres.ask(sql))


def write_fleet(folder, nats_ports, postgres_ports, replicas, with_login=False):
    servers = ",".join(f"127.0.0.1:{port}" for port in nats_ports)
    hosts, ports = ",".join(["127.0.0.1"] * len(postgres_ports)), ",".join(map(str, postgres_ports))
    with open(os.path.join(folder, "fleet.toml"), "w", encoding="utf-8") as file:
        file.write(f'sites = ["hall", "yard"]\n[nats]\nservers = "nats://{servers}"\nreplicas = {replicas}\n'
                   + (login(folder, "worker") + 'authority = "authority.pem"\n' if with_login else "") +
                   f'[postgresql]\nconnection = "host={hosts} port={ports} user=postgres dbname=postgres '
                   + (f"sslmode=verify-full sslrootcert={folder}/authority.pem " if with_login else "") +
                   f'target_session_attrs=read-write"\n[worker]\nname = "w"\nlease_s = 3\ncommit_s = 0.3\n'
                   f'[alarms]\nraised_after_s = 0\ngone_after_s = 0.05\n')


def site(command, folder, servers):
    return Live(command, folder, "site.toml", "--listen", "127.0.0.1:0", "--publish", servers)


def record_offline(command, folder, servers, valves, samples, seconds=120):
    """The site works through its recordings while no server is there: all blocks stay in its store."""
    with site(command, folder, servers) as live:
        def done():
            answer = json.loads(live.ask("/api/v1/valves")[2])["valves"]
            return len(answer) == valves and all(one["samples"] == samples for one in answer)
        until(done, seconds, "recordings that are worked on")


def outbox(folder):
    """Blocks that wait, and the newest number of each valve."""
    store = sqlite3.connect(f"file:{folder}/site.sqlite?mode=ro", uri=True, timeout=10)
    waiting = store.execute("SELECT count(*) FROM outbox").fetchone()[0]
    newest = dict(store.execute("SELECT valve, number FROM outbox_position"))
    totals = {row[0]: row[1:] for row in store.execute(
        "SELECT id, samples, energy_J FROM state JOIN valve ON state.valve = valve.number")}
    store.close()
    return waiting, newest, totals


def blocks_of(folder, valve):
    store = sqlite3.connect(f"file:{folder}/site.sqlite?mode=ro", uri=True, timeout=10)
    blocks = [row[0] for row in store.execute("SELECT block FROM outbox WHERE valve = ? ORDER BY number", (valve,))]
    store.close()
    return blocks


QUERIES = (
    "SELECT 'second', id, session, block, wall_ms, float8send(time_s), samples, float8send(flow_min), "
    "float8send(flow_mean), float8send(flow_max), float8send(lower_min), float8send(upper_max), float8send(energy_J), "
    "status FROM second JOIN valve ON valve = number ORDER BY id, session, block",
    "SELECT 'indicator', id, session, block, wall_ms, name, float8send(value), float8send(uncertainty_95), "
    "float8send(baseline), state FROM indicator JOIN valve ON valve = number",
    "SELECT 'event', valve, wall_ms, float8send(time_s), kind, text FROM event ORDER BY valve, id",
    "SELECT 'model_in_force', id, session, from_block, sha256 FROM model_in_force JOIN valve ON valve = number",
    "SELECT 'coverage', id, session, block, wall_ms, minute, model FROM coverage JOIN valve ON valve = number",
    "SELECT 'state', id, next, samples, float8send(energy_J) FROM state JOIN valve ON valve = number",
    "SELECT 'alarm', valve, id, cause, sign, raised_ms, gone_ms, times, float8send(time_s), text FROM alarm")


def kept(postgres):
    """All rows of the fleet, as fleet_reference prints them; events of each valve in their order."""
    return [line for query in QUERIES for line in postgres.ask(query)]


def compared(lines):
    """In an order of their own, but for events, whose order within a valve counts."""
    events = [line for line in lines if line.startswith("event|")]
    of_valves = sorted(events, key=lambda line: line.split("|")[1])  # stable
    return sorted(line for line in lines if not line.startswith("event|")) + of_valves


class Watch:
    """For how long the blocks of a valve stood at most while others of it waited, and for how long behind the last fault."""

    def __init__(self, fleet):
        self.fleet, self.moved, self.ended = fleet, {}, False
        self.all, self.lapped, self.fault = (0.0, 0.0), (0.0, 0.0), time.monotonic()
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def run(self):
        while not self.ended:
            time.sleep(0.1)
            try:
                rows = self.fleet.postgres.ask("SELECT id, block FROM coverage JOIN valve ON valve = number")
            except RuntimeError:
                continue
            now = time.monotonic()
            for row in rows:
                valve, block = row.split("|")
                before, since = self.moved.get(valve, (block, now))
                if before != block:
                    stood = (now - since, now - max(since, self.fault))
                    self.all, self.lapped = (tuple(map(max, longest, stood)) for longest in (self.all, self.lapped))
                    since = now
                self.moved[valve] = (block, since)

    @staticmethod
    def text_of(stood):
        return f"no valve stood longer than {stood[0]:.1f} s, {stood[1]:.1f} s behind the last fault"

    def lap(self):
        """The longest of what ended since a fault began."""
        return self.text_of(self.lapped)

    def begin_fault(self):
        self.lapped, self.fault = (0.0, 0.0), time.monotonic()

    def end(self):
        self.ended = True
        self.thread.join()
        return self.text_of(self.all)


def computed(command, reference, folder, model):
    """What one process makes of the blocks that wait in the site's store."""
    version = subprocess.run([command, "--version"], text=True, capture_output=True, check=True).stdout.strip()
    done = subprocess.run([reference, version, "site.sqlite", model, "0", "0.05"], cwd=folder, text=True,
                          capture_output=True, check=True)
    return done.stdout.splitlines()


def progress(postgres):
    try:
        return int(postgres.ask("SELECT coalesce(sum(block), 0) FROM coverage")[0])
    except RuntimeError:
        return -1


def reach(fleet, blocks, seconds=90):
    """When so many blocks are committed, on the server that is the primary then."""
    end = time.monotonic() + seconds
    while True:
        now = progress(fleet.postgres)
        if now >= blocks:
            return now
        if time.monotonic() > end:
            raise AssertionError(f"{now} of {blocks} blocks after {seconds} s")
        time.sleep(0.05)
