#!/usr/bin/python3
"""report_blocks_test.py COMMAND EXAMPLES: the blocks of a site that sends summaries, read by Python alone, hold what stands in
the site's own store."""
import json
import os
import shutil
import struct
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from block_reader import read_block  # noqa: E402
from fleet import blocks_of, make_recordings, reports_of_the_site, site  # noqa: E402
from servers import until  # noqa: E402

COMMAND, EXAMPLES = (os.path.abspath(path) for path in sys.argv[1:3])
SECONDS = 65


def bits(value):
    return "" if value != value else "\\x" + struct.pack(">d", value).hex()


def lines_of(valve, blocks):
    """In the form of reports_of_the_site()."""
    name, alarms = f"yard/{valve}", {}
    for block in blocks:
        if block["summary"]["samples"]:
            row = block["summary"]
            figures = (row[key] for key in ("time_s", "flow_min", "flow_mean", "flow_max", "lower_min", "upper_max", "energy_J"))
            yield "|".join(["second", name, str(block["wall_ms"]), str(row["samples"]), *map(bits, figures), str(row["status"])])
        for one in block["indicators"]:
            yield "|".join(["indicator", name, str(block["wall_ms"]), one["name"], one["state"],
                            *(bits(one[key]) for key in ("value", "uncertainty_95", "baseline"))])
        for one in block["events"]:
            yield "|".join(["event", name, str(one["wall_ms"]), one["kind"], one["text"]])
        alarms.update({one["id"]: one for one in block["alarms"]})
    for one in alarms.values():
        yield "|".join(["alarm", name, *(str(one[key]) for key in ("id", "cause", "sign", "raised_ms", "gone_ms", "times", "text"))])
    yield "|".join(["state", name, str(blocks[-1]["samples"]), bits(blocks[-1]["energy_J"])])


class ReportBlocks(unittest.TestCase):
    def test_blocks_hold_what_the_store_has(self):
        folder = tempfile.mkdtemp(prefix="spoolflow-fleet-reports-")
        self.addCleanup(shutil.rmtree, folder)
        make_recordings(COMMAND, folder, SECONDS)
        text = ('[store]\nfile = "site.sqlite"\n[alarms]\nraised_after_s = 0\ngone_after_s = 0\n'
                '[fleet]\nsite = "yard"\nsends = "summaries"\n')
        for k, name in enumerate(("sound", "worn")):
            text += (f'[[valve]]\nid = "v{k}"\nmodel = "{EXAMPLES}/live/size_6.json"\n'
                     f'source = {{ kind = "replay", recording = "{name}.csv", speed = 20 }}\n')
        with open(os.path.join(folder, "site.toml"), "w", encoding="utf-8") as file:
            file.write(text)
        with site(COMMAND, folder, "nats://127.0.0.1:1") as live:
            until(lambda: all(one["samples"] == 1000 * SECONDS for one in json.loads(live.ask("/api/v1/valves")[2])["valves"]),
                  60, "recordings that are worked on")
            output = json.loads(live.ask("/api/v1/site")[2])["outputs"]["fleet"]
            self.assertEqual((output["connected"], output["sent"]), (0, 0))
            self.assertGreater(output["waiting"], 1)
            self.assertIn("cannot be reached", output["trouble"])
            self.assertIn('\nspoolflow_output_failing{output="fleet"} 1\n', live.ask("/metrics")[2])
        found = []
        for valve in ("v0", "v1"):
            blocks = [read_block(block) for block in blocks_of(folder, valve)]
            self.assertEqual([block["number"] for block in blocks], list(range(1, len(blocks) + 1)))
            self.assertEqual({block["valve"] for block in blocks}, {f"yard/{valve}"})
            found += lines_of(valve, blocks)
        expected = reports_of_the_site(folder)
        self.assertEqual(sorted(found), expected)
        for kind in ("second", "indicator", "event", "alarm", "state"):
            self.assertTrue(any(line.startswith(kind + "|") for line in expected), kind)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
