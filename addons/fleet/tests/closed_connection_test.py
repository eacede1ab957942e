#!/usr/bin/python3
"""closed_connection_test.py COMMAND REFERENCE EXAMPLES: NATS servers complain to a site and to its only worker of what they were sent, behind which the
library closes a connection for good. Both make another; nothing is lost and nothing taken twice."""
import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from fleet import compared, kept, outbox, reach, site  # noqa: E402
from servers import until  # noqa: E402
from whole_fleet import Fleet, WithAFleet  # noqa: E402

COMMAND, REFERENCE, EXAMPLES = (os.path.abspath(path) for path in sys.argv[1:4])
SECONDS, VALVES = 70, 2
MODEL = os.path.join(EXAMPLES, "live", "size_6.json")


class ClosedConnection(WithAFleet):
    def test_blocks_go_on_by_another_connection(self):
        waiting, expected = self.blocks_that_wait(COMMAND, REFERENCE, MODEL, VALVES, SECONDS)
        fleet = self.fleet = Fleet(COMMAND, self.folder, "cluster")
        fleet.setup()
        file = os.path.join(self.folder, "fleet.toml")  # the worker comes through the gates, too
        with open(file, encoding="utf-8") as before:
            text = before.read()
        for port, gate in zip(fleet.nats_ports, fleet.gates):
            text = text.replace(f"127.0.0.1:{port}", f"127.0.0.1:{gate.port}")
        with open(file, "w", encoding="utf-8") as now:
            now.write(text)
        fleet.start_worker()
        with site(COMMAND, self.folder, fleet.servers()):
            for share in (0.2, 0.5):
                reach(fleet, share * waiting)
                fleet.complain_to_the_site(None)
            reach(fleet, waiting, 60)
            until(lambda: outbox(self.folder)[0] == 0, 30, "a site that has heard of all")
        fleet.workers[0].end()
        self.assertEqual(compared(kept(fleet.postgres)), compared(expected))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
