#!/usr/bin/python3
"""mended_store_test.py COMMAND EXAMPLES: a site whose store is deleted, and then cut off, while it sends. Of the deleted one nothing is lost; of the
one that was cut off the fleet reports which blocks are lost, and everything else is there once."""
import json
import os
import re
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from fleet import make_recordings, outbox, site, write_site  # noqa: E402
from servers import until  # noqa: E402
from whole_fleet import Fleet, WithAFleet  # noqa: E402

COMMAND, EXAMPLES = (os.path.abspath(path) for path in sys.argv[1:3])
SECONDS, VALVES, SPEED = 70, 2, 3
MODEL = os.path.join(EXAMPLES, "live", "size_6.json")


class MendedStore(WithAFleet):
    def committed(self):
        return dict(line.split("|") for line in self.fleet.postgres.ask(
            "SELECT id, block FROM coverage JOIN valve ON valve = number"))

    def mended(self, live, words):
        def is_mended():
            mending = json.loads(live.ask("/api/v1/site")[2])["store_mended"]
            return mending is not None and words in mending["text"]
        until(is_mended, 30, f"a store that {words}")

    def test_a_site_sends_on_from_a_store_that_was_mended(self):
        make_recordings(COMMAND, self.folder, SECONDS)
        write_site(self.folder, MODEL, VALVES, 0.1, speed=SPEED)
        store = os.path.join(self.folder, "site.sqlite")
        fleet = self.fleet = Fleet(COMMAND, self.folder, "cluster")
        fleet.setup()
        fleet.start_worker()
        with site(COMMAND, self.folder, fleet.servers()) as live:
            until(lambda: len(self.committed()) == VALVES and all(int(n) > 50 for n in self.committed().values()), 60,
                  "blocks of a store that is whole")
            os.remove(store)
            self.mended(live, "was deleted")
            self.assertEqual(self.fleet.postgres.ask("SELECT count(*) FROM event WHERE text LIKE '%are lost%'"), ["0"])
            before = self.committed()
            until(lambda: all(int(self.committed()[valve]) > int(before[valve]) + 50 for valve in before), 60,
                  "blocks of a store that is written again")
            for gate in fleet.gates:
                gate.close()
            cut_off = outbox(self.folder)[1]
            until(lambda: all(number > cut_off[valve] + 60 for valve, number in outbox(self.folder)[1].items()), 60, "blocks that wait")
            os.truncate(store, 0)
            self.mended(live, "was cut off")
            for gate in fleet.gates:
                gate.open = True

            def over():
                valves = json.loads(live.ask("/api/v1/valves")[2])["valves"]
                return all(one["samples"] == 1000 * SECONDS for one in valves) and outbox(self.folder)[0] == 0
            until(over, 120, "a site that has heard of all")
            output = json.loads(live.ask("/api/v1/site")[2])["outputs"]["fleet"]
            self.assertEqual((output["connected"], output["waiting"], output["trouble"]), (1, 0, ""))
            newest = outbox(self.folder)[1]
        for worker in fleet.workers:
            worker.end()
        self.assertEqual(self.committed(), {f"hall/{valve}": str(number) for valve, number in newest.items()})
        for valve, number in newest.items():
            with self.subTest(valve=valve):
                numbers = [int(n) for n in self.fleet.postgres.ask(
                    f"SELECT block FROM second JOIN valve ON valve = number WHERE id = 'hall/{valve}' ORDER BY block")]
                events = self.fleet.postgres.ask(
                    f"SELECT text FROM event WHERE valve = 'hall/{valve}' AND text LIKE 'blocks%lost%' ORDER BY id")
                reported = [tuple(map(int, re.match("blocks ([0-9]+) to ([0-9]+) are lost", text).groups())) for text in events]
                self.assertGreater(sum(last - first + 1 for first, last in reported), 10)
                lost = {n for first, last in reported for n in range(first, last + 1)}
                self.assertEqual(sorted([*numbers, *lost]), list(range(1, number + 1)))  # each once, or reported as lost


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
