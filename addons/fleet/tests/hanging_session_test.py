#!/usr/bin/python3
"""hanging_session_test.py COMMAND REFERENCE EXAMPLES: a process of PostgreSQL that serves a partition hangs for good, while its machine keeps the
line open. The worker reports it, leaves it, and the partition goes on; nothing is lost and nothing taken twice."""
import os
import random
import signal
import sys
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from fleet import compared, kept, outbox, progress, reach, site  # noqa: E402
from servers import until  # noqa: E402
from whole_fleet import Fleet, WithAFleet  # noqa: E402

COMMAND, REFERENCE, EXAMPLES = (os.path.abspath(path) for path in sys.argv[1:4])
SECONDS, VALVES = 70, 2
MODEL = os.path.join(EXAMPLES, "live", "size_6.json")
AT_REST = ("SELECT pid FROM pg_stat_activity JOIN partition ON application_name = 'spoolflow partition ' || number "
           "WHERE state = 'idle' AND number IN (SELECT partition FROM valve)")


class HangingSession(WithAFleet):
    def setUp(self):
        super().setUp()
        self.halted = []

    def tearDown(self):
        for pid in self.halted:
            os.kill(pid, signal.SIGKILL)
        super().tearDown()

    def halt_a_session(self):
        """One that is in no transaction: what a transaction holds is nobody else's before it has ended."""
        for pid in map(int, self.fleet.postgres.ask(AT_REST)):
            os.kill(pid, signal.SIGSTOP)
            if self.fleet.postgres.ask(f"SELECT state FROM pg_stat_activity WHERE pid = {pid}") == ["idle"]:
                self.halted.append(pid)
                return True
            os.kill(pid, signal.SIGCONT)
        return False

    def test_the_partition_goes_on_with_another_session(self):
        waiting, expected = self.blocks_that_wait(COMMAND, REFERENCE, MODEL, VALVES, SECONDS)
        fleet = self.fleet = Fleet(COMMAND, self.folder, "cluster")
        fleet.setup()
        fleet.start_worker()
        with site(COMMAND, self.folder, fleet.servers()):
            reach(fleet, 0.1 * waiting * random.random())
            until(self.halt_a_session, 20, "a session at rest")
            reach(fleet, waiting, 120)
            until(lambda: outbox(self.folder)[0] == 0, 30, "a site that has heard of all")
        self.assertEqual(progress(fleet.postgres), waiting)
        with open(fleet.workers[0].log, encoding="utf-8") as log:
            self.assertIn("PostgreSQL has not answered for 20 s", log.read())
        time.sleep(1)
        fleet.workers[0].end()
        self.assertEqual(compared(kept(fleet.postgres)), compared(expected))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
