#!/usr/bin/python3
"""faults_test.py COMMAND REFERENCE EXAMPLES: a fleet whose parts are killed one after another while blocks are on their
way; what it has kept must be, bit for bit, what one process without servers reckons from the same blocks."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from block_reader import read_block  # noqa: E402
from fleet import (Worker, compared, kept, make_recordings, outbox, reach, record_offline, site, write_fleet,  # noqa: E402
                   write_site)
from servers import Nats, Postgres, free_ports, until  # noqa: E402

COMMAND, REFERENCE, EXAMPLES = (os.path.abspath(path) for path in sys.argv[1:4])
VALVES, SECONDS, BLOCK_S = 6, 90, 0.25


class Faults(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="spoolflow-fleet-")
        os.chmod(self.folder, 0o755)
        self.running = []

    def tearDown(self):
        for one in reversed(self.running):
            one.stop() if hasattr(one, "stop") else one.kill()
        shutil.rmtree(self.folder)

    def expected(self):
        version = subprocess.run([COMMAND, "--version"], text=True, capture_output=True, check=True).stdout.strip()
        done = subprocess.run([REFERENCE, version, "site.sqlite", self.model, "0", "0.05"], cwd=self.folder, text=True,
                              capture_output=True, check=True)
        return done.stdout.splitlines()

    def test_nothing_is_lost_or_taken_twice(self):
        folder = self.folder
        self.model = os.path.join(EXAMPLES, "live", "size_6.json")
        nats_port, postgres_port = free_ports(2)
        servers = f"nats://127.0.0.1:{nats_port}"
        make_recordings(COMMAND, folder, SECONDS)
        write_site(folder, self.model, VALVES, BLOCK_S)
        write_fleet(folder, [nats_port], [postgres_port], 1)
        record_offline(COMMAND, folder, servers, VALVES, 1000 * SECONDS)
        waiting, newest, totals = outbox(folder)
        self.assertEqual(waiting, sum(newest.values()))
        expected = self.expected()

        postgres = Postgres(folder, postgres_port)
        self.running.append(postgres)
        nats = Nats(folder, nats_port)
        self.running.append(nats)
        done = subprocess.run([COMMAND, "fleet", "--setup", "fleet.toml"], cwd=folder, text=True, capture_output=True,
                              check=True)
        self.assertIn('publish: ["spoolflow.block.*.hall"', done.stdout)
        workers = [Worker(COMMAND, folder, name) for name in ("first", "second")]
        self.running += workers
        with site(COMMAND, folder, servers):
            reach(postgres, waiting * 10 // 100)
            workers[0].kill()
            reach(postgres, waiting * 30 // 100)
            workers[0].start()
            nats.kill()
            nats.start()
            reach(postgres, waiting * 50 // 100)
            postgres.kill()
            postgres.restart()
            reach(postgres, waiting * 75 // 100)
            workers[1].kill()
            reach(postgres, waiting)
            until(lambda: outbox(folder)[0] == 0, 30, "a site that has heard of all")
        for worker in workers[:1]:
            worker.end()

        self.assertEqual(compared(kept(postgres)), compared(expected))
        for valve, (samples, energy) in totals.items():  # and those of the site itself
            row = postgres.ask(f"SELECT samples, energy_J FROM state JOIN valve ON valve = number WHERE id = 'hall/{valve}'")
            self.assertEqual(row, [f"{samples}|{energy!r}"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
