#!/usr/bin/python3
"""stability_test.py SPOOLFLOW SOURCE FIRMWARE: what the release promised (docs/stability.md) holds for its files and names."""
import csv
import json
import pathlib
import signal
import sqlite3
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from frozen import MODELS, RELEASE, estimated, unpacked  # noqa: E402
from names import all_names  # noqa: E402

SPOOLFLOW, SOURCE, FIRMWARE = sys.argv[1:4]
FREEZE = "tests/stability/freeze.py SPOOLFLOW SOURCE"


class Models(unittest.TestCase):
    def test_of_every_kind_are_read_and_estimate_as_they_did(self):
        kept = {}
        with open(RELEASE / "estimates.csv", newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                kept.setdefault((row["model"], row["estimator"]), []).append(row)
        self.assertEqual({model for model, _ in kept}, set(MODELS))
        with unpacked() as folder:
            for (model, estimator), expected in kept.items():
                full_scale = 6e4 * json.loads((folder / f"{model}.json").read_text())["valve"]["rated_flow_m3_per_s"]
                rows = estimated(SPOOLFLOW, folder, model, estimator)
                self.assertGreaterEqual(len(expected), 8)
                for row in expected:
                    made = rows[int(row["row"])]
                    for key in ("flow_L_min", "flow_lower_L_min", "flow_upper_L_min"):
                        self.assertAlmostEqual(float(made[key]), float(row[key]), delta=1e-4 * full_scale, msg=f"{model}, {estimator}, row "
                                               f"{row['row']}, {key}: where the sensor estimates better, `{FREEZE} --estimates` and the changelog")
                    self.assertEqual(made["status"], row["status"], f"{model}, {estimator}, row {row['row']}")

    def test_of_a_later_version_are_refused_with_both_versions(self):
        with unpacked() as folder:
            later = (folder / "full.json").read_text().replace('"version":1,', '"version":2,', 1)
            (folder / "full.json").write_text(later)
            with self.assertRaisesRegex(AssertionError, "(?s)exit status 2: .*full.json.*version 2.*version 1"):
                estimated(SPOOLFLOW, folder, "full", "observer")


class Pages(unittest.TestCase):
    def test_answer_in_the_firmware_of_the_release_or_are_refused_with_the_way_out(self):
        shown = subprocess.run([SPOOLFLOW, "inspect", RELEASE / "page.bin"], capture_output=True, text=True)
        with unpacked() as folder:
            stepped = subprocess.run([FIRMWARE, RELEASE / "page.bin", folder / "run.csv"], capture_output=True, text=True)
        if shown.returncode != 0:
            self.assertEqual((shown.returncode, stepped.returncode), (2, 3), shown.stderr + stepped.stderr)
            self.assertRegex(shown.stdout + shown.stderr, "layout.*export")
            return
        self.assertEqual(stepped.returncode, 0, stepped.stdout[-200:])
        flows = [6e4 * float(line.split()[0]) for line in stepped.stdout.splitlines()]
        with open(RELEASE / "estimates.csv", newline="", encoding="utf-8") as file:
            expected = [row for row in csv.DictReader(file) if (row["model"], row["estimator"]) == ("full", "observer")]
        for row in expected:  # in single precision, of a valve of 80 L/min
            self.assertAlmostEqual(flows[int(row["row"])], float(row["flow_L_min"]), delta=2e-3 * 80, msg=row["row"])


class Stores(unittest.TestCase):
    def test_are_read_and_go_on(self):
        with unpacked() as folder:
            store = folder / "site.sqlite"
            database = sqlite3.connect(store)
            database.executescript((folder / "store.sql").read_text())
            before, = database.execute("SELECT count(*) FROM event").fetchone()
            database.close()
            (folder / "model.json").write_bytes((folder / "full.json").read_bytes())
            (folder / "site.toml").write_text('[page]\nlisten = "127.0.0.1:0"\n' + "".join(
                f'[[valve]]\nid = "press_{k}"\nmodel = "model.json"\nsource = {{ kind = "rig" }}\n' for k in (1, 2)))
            self.assertEqual(self.history(store), (RELEASE / "history.csv").read_text().splitlines())
            live = subprocess.Popen([SPOOLFLOW, "live", folder / "site.toml", "--store", store], stderr=subprocess.PIPE, text=True)
            said = ""
            for line in live.stderr:
                said += line
                if "page at" in line:
                    break
            live.send_signal(signal.SIGTERM)
            said += live.communicate(timeout=60)[1]
            self.assertEqual(live.returncode, 0, said)
            kept = (RELEASE / "history.csv").read_text().splitlines()
            self.assertEqual(self.history(store)[:len(kept)], kept)
            database = sqlite3.connect(store)
            after, = database.execute("SELECT count(*) FROM event").fetchone()
            self.assertEqual(database.execute("SELECT cause, sign FROM alarm").fetchall()[0], ("no_samples", "C"))
            database.close()
            self.assertGreater(after, before)  # it has said that it began

    @staticmethod
    def history(store):
        return subprocess.run([SPOOLFLOW, "history", store, "--valve", "press_1", "-o", "-"], check=True, capture_output=True,
                              text=True).stdout.splitlines()


class Names(unittest.TestCase):
    def test_of_the_release_are_all_there(self):
        with unpacked() as folder:
            now = set(all_names(SPOOLFLOW, SOURCE, folder))
        kept = (RELEASE / "names.txt").read_text(encoding="utf-8").splitlines()
        self.assertGreater(len(kept), 900)
        self.assertEqual([name for name in kept if name not in now], [], "names of the release that are gone")

        kinds = {name.split()[0] for name in kept}
        self.assertEqual(kinds, {"command", "c", "python", "live", "fleet", "estimate", "validate", "monitor", "metric", "channel", "unit", "fmu"})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
