"""A valve that passes more oil than its model says: files, dictionaries and tables move the model as the command does."""
import json
import unittest

import numpy as np

import examples
import spoolflow

PRESS = examples.EXAMPLES / "live" / "size_6.json"
SCENARIO = """protocol = "ramps"
valve = "size_6"
seed = 101
[run]
pressure_differences_bar = [40, 60]
rate_percent_per_s = 40
"""
METER = {"kind": "meter", "uncertainty_percent": 1, "zero_uncertainty_L_min": 0.1, "interval_s": 2}
TOML = '[[reference]]\nkind = "meter"\nuncertainty_percent = 1\nzero_uncertainty_L_min = 0.1\ninterval_s = 2\n'


class Recalibration(examples.InAFolder):
    @classmethod
    def setUpClass(cls):
        cls.kept = {}

    def wider(self):
        """A run whose meter reads 12 % more than the valve passed, as of an edge that is wider."""
        if not self.kept:
            run = dict(spoolflow.simulate(self.written("ramps.toml", SCENARIO)))
            run["flow_reference_m3_per_s"] = 1.12 * run["flow_reference_m3_per_s"]
            self.kept.update(run)
        return dict(self.kept)

    def csv(self, run):
        path = self.folder / "monday.csv"
        np.savetxt(path, np.column_stack(list(run.values())), "%.9g", ",", header=",".join(run), comments="")
        return path

    def test_moves_the_model_of_a_file_as_the_command_does(self):
        run, references, out = self.csv(self.wider()), self.written("meter.toml", TOML), self.folder / "moved.json"
        examples.command("recalibrate", "-q", PRESS, run, "--references", references, "-o", out)
        moved = spoolflow.recalibrate(PRESS, run, references)
        self.assertEqual(moved.wear_states, spoolflow.load_model(out).wear_states)
        apart = []
        for model in (moved, spoolflow.load_model(out)):
            provenance = model.provenance
            provenance.pop("created")
            provenance["adaptations"][-1].pop("created")
            apart.append(provenance)
        self.assertEqual(*apart)
        self.assertGreater(moved.wear_states[-1]["edge_width"], 0.05)
        self.assertIn("edge width +", " ".join(moved.provenance["adaptations"][-1]["reasons"]))
        with self.assertRaisesRegex(spoolflow.Error, "has already moved this model"):
            spoolflow.recalibrate(spoolflow.load_model(out), run, references)
        self.assertEqual(len(spoolflow.recalibrate(moved.gone_back(0), run, references).wear_states), 4)

    def test_dictionaries_and_arrays_say_the_same_as_files(self):
        run = self.wider()
        by_files = spoolflow.recalibrate(PRESS, self.csv(run), self.written("meter.toml", TOML))
        for references in (METER, [METER], {"reference": [METER]}, {**METER, "recording": 0}):
            moved = spoolflow.recalibrate(spoolflow.load_model(PRESS), run, references)
            self.assertAlmostEqual(moved.wear_states[-1]["edge_width"], by_files.wear_states[-1]["edge_width"], places=4)

    def test_goes_back_to_the_model_as_calibrated(self):
        before = spoolflow.load_model(PRESS)
        moved = spoolflow.recalibrate(before, self.wider(), METER)
        back = moved.gone_back(0)
        self.assertEqual([state["edge_width"] for state in back.wear_states],
                         [0, moved.wear_states[-1]["edge_width"], 0])
        first = {name: column[:3000] for name, column in self.wider().items()}
        np.testing.assert_allclose(back.estimate(first).flow_m3_per_s, before.estimate(first).flow_m3_per_s, rtol=1e-6, atol=1e-10)
        self.assertIn("in 30 days: edge width", moved.drift)
        self.assertIsNone(before.drift)
        self.assertEqual([before.wear_states[0]["friction_ratio"], len(before.wear_states)], [1, 1])
        with self.assertRaisesRegex(spoolflow.Error, "no state 5"):
            moved.gone_back(5)

    def test_strokes_are_marked_by_a_table_or_by_rows(self):
        run = self.wider()
        flow, time = run["flow_reference_m3_per_s"], run["time_s"]
        filled = np.cumsum(flow) * (time[1] - time[0])
        ends = np.searchsorted(filled, np.linspace(0.05, 0.95, 13) * filled[-1])
        area_cm2 = (filled[ends[1]] - filled[ends[0]]) / 0.5 * 1e4
        stroke = {"kind": "stroke", "name": "boom", "recording": 0, "ends": "marks", "area_cm2": area_cm2, "length_mm": 500}
        rows = [(time[a], time[b]) for a, b in zip(ends, ends[1:])]
        table = {"begin_s": np.array([row[0] for row in rows]), "end_s": np.array([row[1] for row in rows])}
        widths = [spoolflow.recalibrate(PRESS, run, {**stroke, "marks": marks}).wear_states[-1]["edge_width"] for marks in (rows, table)]
        self.assertEqual(widths[0], widths[1])
        self.assertGreater(widths[0], 0.05)
        with self.assertRaisesRegex(spoolflow.Error, r"^references\[0\]: marks, line 3: 0.* no interval after the one before it"):
            spoolflow.recalibrate(PRESS, run, {**stroke, "marks": [(1, 2), (0.5, 3)]})

    def test_refuses_in_words_that_name_what_was_given(self):
        run = self.wider()
        for words, recordings, references in (
            ("references, line 2: kind = ", run, {"kind": "gauge"}),
            (r"references, line 1: meter 1 is of the recording tuesday.csv, and given are run_1.csv", run, {**METER, "recording": "tuesday.csv"}),
            (r"references\[0\]: recording 1 is not given; there are 0 to 0", run, {**METER, "recording": 1}),
            ("no recording is given", [], METER),
            ("references, line 1: names no references", run, []),
            (r"references\[0\]: marks are rows of begin_s", run, {"kind": "pump", "marks": [1, 2], "displacement_cm3": 20}),
            (r"references\[0\]: marks have no column end_s", run, {"kind": "pump", "marks": {"begin_s": [1]}, "displacement_cm3": 20}),
            ("the run: has 99 samples", {name: column[:99] for name, column in run.items()}, METER),
        ):
            with self.assertRaisesRegex(spoolflow.Error, "^" + words):
                spoolflow.recalibrate(PRESS, recordings, references)
        with self.assertRaises(FileNotFoundError):
            spoolflow.recalibrate(PRESS, run, self.folder / "missing.toml")
        missing = self.written("tuesday.toml", TOML + 'recording = "tuesday.csv"\n')
        with self.assertRaises(spoolflow.Error) as caught:
            spoolflow.recalibrate(PRESS, self.csv(run), missing)
        self.assertEqual(str(caught.exception), examples.refusal("recalibrate", PRESS, self.csv(run), "--references", missing, "-o", self.folder / "m.json"))


if __name__ == "__main__":
    unittest.main()
