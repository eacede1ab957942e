#!/usr/bin/python3
"""faults_test.py COMMAND REFERENCE EXAMPLES single|cluster [SEED…]: a fleet whose parts are killed, stopped and cut off one
after another while blocks are on their way; what it has kept must be, bit for bit, what one process without servers
reckons from the same blocks. `single`: one NATS server and one PostgreSQL server. `cluster`: three NATS servers with
three replicas, a primary and a synchronous standby that takes over."""
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from block_reader import read_block  # noqa: E402
from fleet import (Worker, blocks_of, compared, kept, make_recordings, outbox, reach, record_offline, site,  # noqa: E402
                   write_fleet, write_site)
from servers import Gate, Nats, Postgres, ask_nats, free_ports, until  # noqa: E402

COMMAND, REFERENCE, EXAMPLES = (os.path.abspath(path) for path in sys.argv[1:4])
KIND, SEEDS = sys.argv[4], [int(seed) for seed in sys.argv[5:]] or [1]
VALVES, SECONDS, BLOCK_S = 6, 70, 0.1
MODEL = os.path.join(EXAMPLES, "live", "size_6.json")


class Fleet:
    """Servers, workers, and how each of them is hurt."""

    def __init__(self, folder, kind):
        self.folder, self.running = folder, []
        count = 3 if kind == "cluster" else 1
        ports = free_ports(2 * count + 2)
        self.nats_ports, routes, postgres_ports = ports[:count], ports[count:2 * count], ports[2 * count:]
        self.postgres = self.started(Postgres(folder, postgres_ports[0]))
        self.standby = None
        if kind == "cluster":
            self.standby = self.started(Postgres(folder, postgres_ports[1], "standby", self.postgres))
            self.postgres.ask("ALTER SYSTEM SET synchronous_standby_names = 'standby'")
            self.postgres.ask("SELECT pg_reload_conf()")
            until(lambda: self.postgres.ask("SELECT sync_state FROM pg_stat_replication") == ["sync"], 20, "a standby")
        else:
            postgres_ports = postgres_ports[:1]
        self.nats = [self.started(Nats(folder, port, k, routes if count > 1 else ()))
                     for k, port in enumerate(self.nats_ports)]
        self.gates = [self.started(Gate(port)) for port in self.nats_ports]
        write_fleet(folder, self.nats_ports, postgres_ports, count)
        self.workers = []

    def started(self, one):
        self.running.append(one)
        return one

    def servers(self):
        """As the site reaches them."""
        return "nats://" + ",".join(f"127.0.0.1:{gate.port}" for gate in self.gates)

    def setup(self):
        done = []

        def made():
            done.append(subprocess.run([COMMAND, "fleet", "--setup", "fleet.toml"], cwd=self.folder, text=True,
                                       capture_output=True))
            return done[-1].returncode == 0
        until(made, 30, "a fleet that is set up")
        return done[-1]

    def start_worker(self):
        worker = Worker(COMMAND, self.folder, f"worker_{len(self.workers)}")
        self.workers.append(self.started(worker))

    def stop(self):
        for one in reversed(self.running):
            one.stop()

    # What may happen to it, each with the state in which blocks go on.

    def kill_worker_and_start_it_again(self, chance):
        worker = chance.choice(self.workers)
        worker.kill()
        worker.start()

    def kill_worker_and_start_another(self, chance):
        worker = self.workers.pop(chance.randrange(len(self.workers)))
        worker.kill()
        self.start_worker()

    def stop_worker_until_others_have_its_valves(self, chance):
        worker = chance.choice(self.workers)
        worker.signal(signal.SIGSTOP)
        owned = f"SELECT count(*) FROM partition WHERE owner LIKE '{worker.name}-%'"
        until(lambda: self.postgres.ask(owned) == ["0"], 20, "partitions that were taken over")
        worker.signal(signal.SIGCONT)

    def kill_nats(self, chance):
        server = chance.choice(self.nats)
        server.kill()
        time.sleep(chance.uniform(0, 1))
        server.start()

    def delete_the_stream(self, _):
        # A cluster may be without a leader for a while.
        until(lambda: '"success":true' in ask_nats(self.nats_ports[0], "$JS.API.STREAM.DELETE.spoolflow"), 30,
              "a stream that is deleted")

    def cut_the_site_off(self, chance):
        for gate in self.gates:
            gate.close()
        time.sleep(chance.uniform(1, 3))
        for gate in self.gates:
            gate.open = True

    def kill_postgres(self, _):
        self.postgres.kill()
        if self.standby:
            self.standby.promote()
            self.postgres, self.standby = self.standby, None
        else:
            self.postgres.restart()

    def start_another_worker(self, _):
        self.start_worker()


class Faults(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="spoolflow-fleet-")
        os.chmod(self.folder, 0o755)
        self.fleet = None

    def tearDown(self):
        if self.fleet:
            self.fleet.stop()
        shutil.rmtree(self.folder)

    def expected(self):
        version = subprocess.run([COMMAND, "--version"], text=True, capture_output=True, check=True).stdout.strip()
        done = subprocess.run([REFERENCE, version, "site.sqlite", MODEL, "0", "0.05"], cwd=self.folder, text=True,
                              capture_output=True, check=True)
        return done.stdout.splitlines()

    def look_at_blocks(self, newest):
        """By Python alone: numbers, times, and values near those of the recording."""
        blocks = [read_block(one) for one in blocks_of(self.folder, "v0")]
        self.assertEqual([block["number"] for block in blocks], list(range(1, newest + 1)))
        times = [time_s for block in blocks for time_s in block["time_s"]]
        currents = [value for block in blocks for value in block["current_A"]]
        self.assertEqual(len(times), 1000 * SECONDS)
        with open(os.path.join(self.folder, "sound.csv"), encoding="utf-8") as file:
            header = next(file).strip().split(",")
            for k, line in enumerate(file):
                row = dict(zip(header, line.split(",")))
                self.assertLess(abs(times[k] - float(row["time_s"])), 1e-9)
                self.assertLess(abs(currents[k] - float(row["current_A"])), 8e-6)

    def test_nothing_is_lost_or_taken_twice(self):
        for seed in SEEDS:
            with self.subTest(seed=seed):
                self.once(random.Random(seed))
                self.tearDown()
                self.setUp()

    def once(self, chance):
        begin = time.monotonic()
        make_recordings(COMMAND, self.folder, SECONDS)
        write_site(self.folder, MODEL, VALVES, BLOCK_S)
        record_offline(COMMAND, self.folder, "nats://127.0.0.1:1", VALVES, 1000 * SECONDS)
        waiting, newest, totals = outbox(self.folder)
        self.assertEqual(waiting, sum(newest.values()))
        self.look_at_blocks(newest["v0"])
        expected = self.expected()
        for kind in ("second", "indicator", "event", "alarm", "model_in_force"):  # there is something of each to lose
            self.assertTrue(any(line.startswith(kind + "|") for line in expected), kind)

        fleet = self.fleet = Fleet(self.folder, KIND)
        self.assertIn('publish: ["spoolflow.block.*.hall"', fleet.setup().stdout)
        for _ in range(2):
            fleet.start_worker()
        faults = [fleet.kill_worker_and_start_it_again, fleet.kill_worker_and_start_another,
                  fleet.stop_worker_until_others_have_its_valves, fleet.kill_nats, fleet.delete_the_stream,
                  fleet.cut_the_site_off, fleet.kill_postgres, fleet.start_another_worker]
        chance.shuffle(faults)
        with site(COMMAND, self.folder, fleet.servers()):
            for k, fault in enumerate(faults):
                reach(fleet, waiting * (k + chance.random()) / (len(faults) + 2))
                if sys.stdout.isatty() or "-v" in os.environ.get("SPOOLFLOW_FLEET", ""):
                    print(f"{time.monotonic() - begin:.1f} s: {fault.__name__}", flush=True)
                fault(chance)
            reach(fleet, waiting)
            until(lambda: outbox(self.folder)[0] == 0, 30, "a site that has heard of all")
        status = subprocess.run([COMMAND, "fleet", "--status", "fleet.toml"], cwd=self.folder, text=True,
                                capture_output=True, check=True).stdout
        self.assertNotIn("(nobody)", status)
        for worker in fleet.workers:
            worker.end()

        self.assertEqual(compared(kept(fleet.postgres)), compared(expected))
        for valve, (samples, energy) in totals.items():  # and those of the site itself
            row = fleet.postgres.ask(
                f"SELECT samples, energy_J FROM state JOIN valve ON valve = number WHERE id = 'hall/{valve}'")
            self.assertEqual(row, [f"{samples}|{json.dumps(energy)}"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
