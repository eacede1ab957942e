#!/usr/bin/python3
"""mended_store_test.py COMMAND EXAMPLES: the store's file cut off and deleted under a running program: it goes on
answering and keeping, and reports what it did on page, metrics and standard error."""
import json
import os
import shutil
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from served import Live  # noqa: E402

COMMAND, EXAMPLES = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])


class MendedStore(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="spoolflow-mended-")
        shutil.copy(os.path.join(EXAMPLES, "live", "size_6.json"), os.path.join(self.folder, "model.json"))
        with open(os.path.join(self.folder, "site.toml"), "w", encoding="utf-8") as site:
            site.write('[page]\nlisten = "127.0.0.1:0"\n[[valve]]\nid = "r"\nmodel = "model.json"\n'
                       'source = { kind = "rig" }\n')
        self.store = os.path.join(self.folder, "site.sqlite")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def live(self):
        return Live(COMMAND, self.folder, "site.toml", "--store", "site.sqlite")

    def answer_of(self, live, path):
        return json.loads(live.ask(path)[2])

    def samples(self, live):
        return self.answer_of(live, "/api/v1/valves")["valves"][0]["samples"]

    def until(self, true):
        for _ in range(600):
            if true():
                return
            time.sleep(0.1)
        self.fail("in a minute it did not come true")

    def test_cut_off_then_deleted(self):
        with self.live() as live:
            self.until(lambda: os.path.getsize(self.store) > 0 and self.samples(live) > 2000)
            self.assertIsNone(self.answer_of(live, "/api/v1/site")["store_mended"])
            os.truncate(self.store, 0)
            self.until(lambda: self.answer_of(live, "/api/v1/site")["store_mended"] is not None)
            text = self.answer_of(live, "/api/v1/site")["store_mended"]["text"]
            self.assertIn("set aside", text)
            self.assertTrue([name for name in os.listdir(self.folder) if name.startswith("site.sqlite.damaged-")])
            self.assertIn(text, [event["text"] for event in self.answer_of(live, "/api/v1/events")["events"]])
            self.assertIn("spoolflow_store_mended_total 1", live.ask("/metrics")[2])
            os.remove(self.store)
            self.until(lambda: "was deleted" in self.answer_of(live, "/api/v1/site")["store_mended"]["text"])
            before = self.samples(live)
            self.until(lambda: self.samples(live) > before + 1500)
            self.until(lambda: self.answer_of(live, "/api/v1/site")["store_trouble"] == "")
            self.assertIn("spoolflow_store_failing 0", live.ask("/metrics")[2])
            self.assertIn("set aside", live.heard())
            before = self.samples(live)
        with self.live() as live:
            self.assertGreaterEqual(self.samples(live), before)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
