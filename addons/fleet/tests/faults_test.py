#!/usr/bin/python3
"""faults_test.py COMMAND REFERENCE EXAMPLES single|cluster [SEED…] [--show] [--large]: a fleet whose parts are killed, stopped and cut off one
after another while blocks are on their way; what it has kept must be, bit for bit, what one process without servers
computes from the same blocks. `single`: one NATS server and one PostgreSQL server. `cluster`: three NATS servers with
three replicas, a primary and a synchronous standby that takes over. Without a seed there are two, 1 and 2. --large: 200 valves and
ten minutes of samples, or VALVES,SECONDS as --large=50,100, in blocks of a second; of disk 20 bytes a sample are used."""
import json
import os
import random
import subprocess
import sys
import time
import unittest
import urllib.request

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from block_reader import read_block  # noqa: E402
from fleet import (Watch, blocks_of, compared, kept, make_recordings, outbox, reach, computed, record_offline,  # noqa: E402
                   reports_of_the_fleet, reports_of_the_site, site, write_reporting_site, write_site)
from servers import make_certificates, refused_by_nats, until  # noqa: E402
from whole_fleet import Fleet, WithAFleet  # noqa: E402

COMMAND, REFERENCE, EXAMPLES = (os.path.abspath(path) for path in sys.argv[1:4])
KIND, SEEDS = sys.argv[4], [int(seed) for seed in sys.argv[5:] if not seed.startswith("--")] or [1, 2]
SHOWS = "--show" in sys.argv
LARGE = [option.partition("=")[2] or "200,600" for option in sys.argv if option.startswith("--large")]
VALVES, SECONDS = map(int, LARGE[0].split(",")) if LARGE else (6, 70)
BLOCK_S = 1.0 if LARGE else 0.1
PATIENCE = max(1.0, VALVES * SECONDS / 5000)  # of what takes longer the more samples there are
MODEL = os.path.join(EXAMPLES, "live", "size_6.json")


class Faults(WithAFleet):
    def setUp(self):
        super().setUp()
        self.done = False

    def tearDown(self):
        if self.fleet and not self.done:
            self.fleet.show_logs()
        super().tearDown()

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

    def look_at_rights(self, port):
        """A site publishes only its own blocks, receives only what is sent to it, and nobody comes in without a name."""
        for user, line, refused in (("hall", "PUB spoolflow.block.3.hall 0\r\n", False),
                                    ("hall", "PUB spoolflow.block.3.other 0\r\n", True),
                                    ("hall", "PUB spoolflow.coverage.hall 0\r\n", True),
                                    ("hall", "SUB spoolflow.coverage.hall 1", False),
                                    ("hall", "SUB spoolflow.coverage.other 1", True),
                                    ("hall", "SUB spoolflow.> 1", True),
                                    ("hall", "PUB $JS.API.STREAM.DELETE.spoolflow 0\r\n", True),
                                    ("worker", "PUB $JS.API.STREAM.DELETE.spoolflow 0\r\n", True),
                                    ("worker", "PUB spoolflow.coverage.hall 0\r\n", False),
                                    (None, "SUB spoolflow.coverage.hall 1", True),
                                    ("stranger", "SUB spoolflow.coverage.hall 1", True)):
            self.assertEqual(refused_by_nats(port, user, line), refused, (user, line))

    def look_at_logins(self, fleet):
        """What no other try helps is refused at once, with one line and exit status 2; the right ones come in by TLS."""
        with open(os.path.join(self.folder, "fleet.toml"), encoding="utf-8") as file:
            text = file.read()
        stranger = os.path.join(self.folder, "stranger.pem")
        with open(os.path.join(self.folder, "wrong.password"), "w", encoding="utf-8") as file:
            file.write("wrong\n")
        root = os.path.join(self.folder, "authority.pem")

        def refused(what, *changes, command="worker"):
            changed = text
            for before, after in changes:
                self.assertIn(before, changed)
                changed = changed.replace(before, after)
            with open(os.path.join(self.folder, "wrong.toml"), "w", encoding="utf-8") as file:
                file.write(changed)
            done = subprocess.run([COMMAND, *command.split(), "wrong.toml"], cwd=self.folder, text=True, capture_output=True,
                                  timeout=60)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
            self.assertIn(what, done.stderr)
        for command in ("worker", "fleet --status", "fleet"):
            refused("PostgreSQL refuses the login", ("user=postgres", "user=nobody_here"), command=command)
        refused("password authentication failed", ("user=postgres", "user=secret password=wrong"))
        refused("no password supplied", ("user=postgres", "user=secret"))
        refused('database "none"', ("dbname=postgres", "dbname=none"))
        refused("rejects connection", ("user=postgres", "user=worker_1"), ("sslmode=verify-full", "sslmode=disable"))
        refused("certificate", (f"sslrootcert={root}", f"sslrootcert={stranger}"))
        refused("Authorization Violation", ("worker.password", "wrong.password"))
        refused("refuses this user or its TLS", ('authority = "authority.pem"', 'authority = "stranger.pem"'))
        version = fleet.postgres.ask("SELECT value FROM setting WHERE name = 'version'")[0]
        fleet.postgres.ask("UPDATE setting SET value = '99' WHERE name = 'version'")
        for command in ("worker", "fleet --status", "fleet --setup", "fleet"):
            refused("of version 99, this program knows version 5; use a newer program", command=command)
        fleet.postgres.ask(f"UPDATE setting SET value = '{version}' WHERE name = 'version'")
        self.assertEqual(fleet.postgres.ask("SELECT count(*) FROM worker"), ["0"])

    def acknowledge_on_the_page(self, fleet):
        """What somebody has seen on the fleet's page reaches the worker that has the valve."""
        fleet.postgres.ask("CREATE ROLE page LOGIN IN ROLE spoolflow_page")
        with open(os.path.join(self.folder, "fleet.toml"), encoding="utf-8") as file:
            text = file.read()
        with open(os.path.join(self.folder, "page.toml"), "w", encoding="utf-8") as file:
            file.write(text.replace("user=postgres", "user=page") + '[page]\nlisten = "127.0.0.1:0"\n')
        page = subprocess.Popen([COMMAND, "fleet", "page.toml"], cwd=self.folder, text=True, stderr=subprocess.PIPE)
        try:
            address = page.stderr.readline().split("page at ")[1].split("/ ;")[0]

            def ask(path, data=None):
                with urllib.request.urlopen(address + path, data, 60) as answer:
                    return json.loads(answer.read())
            valves = ask("/api/v1/valves")["valves"]
            self.assertEqual([one["id"] for one in valves], sorted(f"hall/v{k}" for k in range(VALVES)))
            self.assertEqual({one["series"] for one in valves}, {"NG6 4/3 proportional, virtual"})
            self.assertTrue(any(one["unit"] for series in ask("/api/v1/series")["series"] for one in series["indicators"]))
            alarm = ask("/api/v1/alarms")["alarms"][0]
            self.assertIsNone(alarm["acknowledged"])
            fleet.start_worker()
            self.assertEqual(ask(f"/api/v1/alarms/{alarm['key']}/acknowledge", b"{}")["acknowledged_by"], "local")
            taken = (f"SELECT acknowledged_by FROM alarm JOIN acknowledgement USING (valve) WHERE valve = '{alarm['valve']}' "
                     f"AND id = {alarm['id']} AND taken_block > 0")
            until(lambda: fleet.postgres.ask(taken) == ["local"], 90, "an acknowledgement that the worker has taken")
        finally:
            page.terminate()
            self.assertEqual(page.wait(30), 0)
            page.stderr.close()

    def send_reports(self, fleet, chance):
        """A site that sends what it made of its samples: the fleet has the rows of its store, whatever is killed."""
        inner = write_reporting_site(self.folder, MODEL)
        with site(COMMAND, inner, fleet.servers().replace("nats://", "tls://")) as live:
            for fault in (fleet.kill_worker_and_start_it_again, fleet.delete_the_stream, fleet.kill_nats, fleet.kill_postgres):
                time.sleep(1.5)
                fault(chance)

            def over():
                valves = json.loads(live.ask("/api/v1/valves")[2])["valves"]
                return all(one["samples"] == 1000 * SECONDS for one in valves) and outbox(inner)[0] == 0
            until(over, 180, "a site whose reports are committed")
            time.sleep(2)  # in which what was sent twice would come
            until(lambda: reports_of_the_fleet(fleet.postgres) == reports_of_the_site(inner), 90,
                  "rows of the fleet that are those of the site")
        lines = reports_of_the_site(inner)
        for kind in ("second", "indicator", "event", "alarm", "state"):
            self.assertTrue(any(line.startswith(kind + "|") for line in lines), kind)

    def test_nothing_is_lost_or_taken_twice(self):
        for seed in SEEDS:
            with self.subTest(seed=seed):
                try:
                    self.once(random.Random(seed))
                finally:
                    self.tearDown()
                    self.setUp()

    def once(self, chance):
        begin = time.monotonic()

        def show(text):
            if SHOWS:
                print(f"{time.monotonic() - begin:5.1f} s  {text}", flush=True)
        show(f"two recordings are made, and {VALVES} valves of a site work through them while no server is there")
        make_recordings(COMMAND, self.folder, SECONDS)
        if KIND == "single":
            make_certificates(self.folder)
        write_site(self.folder, MODEL, VALVES, BLOCK_S, with_login=KIND == "single")
        record_offline(COMMAND, self.folder, "nats://127.0.0.1:1", VALVES, 1000 * SECONDS, 120 * PATIENCE)
        waiting, newest, totals = outbox(self.folder)
        self.assertEqual(waiting, sum(newest.values()))
        self.look_at_blocks(newest["v0"])
        expected = computed(COMMAND, REFERENCE, self.folder, MODEL)
        for kind in ("second", "indicator", "event", "alarm", "model_in_force"):  # there is something of each to lose
            self.assertTrue(any(line.startswith(kind + "|") for line in expected), kind)

        show(f"{waiting} blocks wait in the site's store; servers and two workers start")
        fleet = self.fleet = Fleet(COMMAND, self.folder, KIND)
        self.assertIn('publish: ["spoolflow.block.*.hall"', fleet.setup().stdout)
        if fleet.rights:
            self.look_at_rights(fleet.nats_ports[0])
            self.look_at_logins(fleet)
        for _ in range(2):
            fleet.start_worker()
        faults = [fleet.kill_worker_and_start_it_again, fleet.kill_worker_and_start_another,
                  fleet.stop_worker_until_others_have_its_valves, fleet.kill_nats, fleet.delete_the_stream,
                  fleet.cut_the_site_off, fleet.kill_postgres, fleet.start_another_worker, fleet.complain_to_the_site]
        chance.shuffle(faults)
        with site(COMMAND, self.folder, fleet.servers()) as live:
            show(f"the site sends; its page is at http://127.0.0.1:{live.port}/")
            watch = Watch(fleet)
            for k, fault in enumerate(faults):
                reach(fleet, waiting * (k + chance.random()) / (len(faults) + 2), 90 * PATIENCE)
                if k > 0:
                    show(f"  since then {watch.lap()}")
                show(fault.__name__.replace("_", " "))
                watch.begin_fault()
                fault(chance)
            reach(fleet, waiting, 90 * PATIENCE)
            show(f"  since then {watch.lap()}")
            show(f"in all {watch.end()}")
            until(lambda: outbox(self.folder)[0] == 0, 90 * PATIENCE, "a site that has heard of all")
        def status():
            return subprocess.run([COMMAND, "fleet", "--status", "fleet.toml"], cwd=self.folder, text=True,
                                  capture_output=True)
        until(lambda: "(nobody)" not in status().stdout, 90, "partitions that have owners")
        asked = status()
        self.assertEqual((asked.returncode, asked.stderr), (0, ""))
        show("all is committed:\n" + asked.stdout)
        for worker in fleet.workers:
            worker.end()

        self.assertEqual(compared(kept(fleet.postgres)), compared(expected))
        for valve, (samples, energy) in totals.items():  # and those of the site itself
            row = fleet.postgres.ask(
                f"SELECT samples, energy_J FROM state JOIN valve ON valve = number WHERE id = 'hall/{valve}'")
            self.assertEqual(row, [f"{samples}|{json.dumps(energy)}"])
        if KIND == "single":
            self.acknowledge_on_the_page(fleet)
            self.send_reports(fleet, chance)
        self.done = True
        show(f"nothing was lost and nothing taken twice: {len(expected)} rows are those of one process, bit for bit")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
