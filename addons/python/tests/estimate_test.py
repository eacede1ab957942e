"""The flow rate from arrays: the numbers of `spoolflow estimate`, without copies, step by step as at once."""
import csv
import pickle
import threading
import sys
import tracemalloc
import unittest

import numpy as np

import examples
import spoolflow


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def written(value, decimals):
    """As ESTIMATE.csv holds it."""
    text = f"{value:.{decimals}f}".rstrip("0").rstrip(".")
    return 0.0 if text in ("-0", "") else float(text)


class Estimate(examples.InAFolder):
    def assert_same(self, estimate, rows):
        self.assertEqual(len(estimate), len(rows))
        columns = {
            "time_s": (estimate.time_s, 6),
            "flow_L_min": (estimate.flow_L_min, 6),
            "flow_lower_L_min": (estimate.flow_lower_L_min, 6),
            "flow_upper_L_min": (estimate.flow_upper_L_min, 6),
            "pressure_difference_bar": (estimate.pressure_difference_bar, 4),
            "magnetic_force_N": (estimate.magnetic_force_N, 3),
            "flow_force_N": (estimate.flow_force_N, 3),
            "friction_force_N": (estimate.friction_force_N, 3),
        }
        for name, (column, decimals) in columns.items():
            self.assertEqual([float(row[name]) for row in rows], [written(value, decimals) for value in column.tolist()],
                             name)
        self.assertEqual([row["status"] for row in rows], estimate.status_texts)

    def test_has_every_digit_of_the_command(self):
        for estimator in ("condensed", "observer"):
            target = self.folder / "estimate.csv"
            examples.command("estimate", "-q", examples.MODEL, examples.RAMP, "-o", target, "--estimator", estimator)
            self.assert_same(examples.model().estimate(examples.ramp(), estimator=estimator), rows_of(target))

    def test_step_by_step_is_the_same_as_at_once(self):
        run = examples.ramp()
        count = 3000
        at_once = examples.model().estimate({name: run[name][:count] for name in run})
        sensor = examples.model().sensor()
        for k in range(count):
            answer = sensor.step(time_s=run.time_s[k], current_A=run.current_A[k], voltage_V=run.voltage_V[k],
                                 position_m=run.position_m[k], oil_temperature_K=run.oil_temperature_K[k])
            self.assertEqual(answer.flow_m3_per_s, at_once.flow_m3_per_s[k])
            self.assertEqual(answer.status, at_once.status[k])
        self.assertIn("L/min", repr(answer))

    def test_in_pieces_is_the_same_as_at_once(self):
        run = examples.ramp()
        at_once = examples.model().estimate(run)
        sensor = examples.model().sensor()
        pieces = [sensor.estimate({name: part for name, part in zip(run, parts)})
                  for parts in zip(*(np.array_split(column, 5) for column in run.values()))]
        np.testing.assert_array_equal(np.concatenate([piece.flow_upper_m3_per_s for piece in pieces]),
                                      at_once.flow_upper_m3_per_s)
        self.assertEqual(sensor.time_s, run.time_s[-1])
        sensor.reset()
        self.assertTrue(np.isnan(sensor.time_s))
        np.testing.assert_array_equal(sensor.estimate(run).flow_m3_per_s, at_once.flow_m3_per_s)

    def test_takes_arrays_where_they_are_and_copies_others(self):
        model, run = examples.model(), examples.ramp()
        needed = {name: np.tile(run[name], 6) for name in ("current_A", "voltage_V", "position_m", "oil_temperature_K")}
        needed["time_s"] = np.arange(len(needed["current_A"])) * 1e-3
        size = needed["time_s"].nbytes
        model.estimate(time_s=[0], current_A=[0], position_m=[0])  # what is made once

        def most_memory(samples):
            tracemalloc.start()
            estimate = model.estimate(**samples)
            peak = tracemalloc.get_traced_memory()[1]
            tracemalloc.stop()
            self.assertEqual(np.shares_memory(estimate.time_s, samples["time_s"]), samples["time_s"].dtype == np.float64)
            return peak

        # Answers of this length but for the status are not memory of NumPy's own: what else it allocates are copies.
        self.assertLess(most_memory(needed), size)
        self.assertGreater(most_memory({name: array.astype(np.float32) for name, array in needed.items()}), 5 * size)

    def test_lists_slices_and_masked_values_are_converted(self):
        run = examples.ramp()
        names = ("time_s", "current_A", "position_m")
        expected = examples.model().estimate({name: run[name][::50].copy() for name in names})
        sliced = examples.model().estimate({name: run[name][::50] for name in names})
        listed = examples.model().estimate(**{name: run[name][::50].tolist() for name in names})
        np.testing.assert_array_equal(sliced.flow_m3_per_s, expected.flow_m3_per_s)
        np.testing.assert_array_equal(listed.flow_m3_per_s, expected.flow_m3_per_s)
        masked = {name: np.ma.MaskedArray(run[name][:100]) for name in names}
        masked["current_A"][50] = np.ma.masked
        said = examples.model().estimate(masked).status
        self.assertTrue(said[50] & spoolflow.Status.sample_missing)
        self.assertFalse(said[49] & spoolflow.Status.sample_missing)

    def test_a_sample_that_is_missing_is_held_and_said(self):
        run = {name: column[:2000].copy() for name, column in examples.ramp().items()}
        run["position_m"][1000:1010] = np.nan
        estimate = examples.model().estimate(run)
        self.assertEqual(estimate.flow_m3_per_s[1005], estimate.flow_m3_per_s[999])
        self.assertTrue(estimate.faulty[1000:1010].all())
        self.assertEqual(estimate.share_with(spoolflow.Status.sample_missing), 10 / 2000)

    def test_no_samples_are_no_answers(self):
        estimate = examples.model().estimate(time_s=[], current_A=[], position_m=[])
        self.assertEqual(len(estimate), 0)
        self.assertIn("no samples", repr(estimate))

    def test_other_threads_run_meanwhile(self):
        run = examples.ramp()
        before = sys.getswitchinterval()
        sys.setswitchinterval(1000)  # nobody is made to give the interpreter away
        self.addCleanup(sys.setswitchinterval, before)
        counted, over = [0], threading.Event()
        begun = threading.Event()

        def count():
            begun.set()
            while not over.is_set():
                counted[0] += 1
                over.wait(0.0005)

        thread = threading.Thread(target=count)
        thread.start()
        begun.wait()
        until_then = counted[0]
        examples.model().estimate(run)
        self.assertGreater(counted[0], until_then)
        over.set()
        thread.join()

    def test_a_model_has_a_description_and_travels(self):
        model = examples.model()
        self.assertIn("80 L/min", repr(model))
        self.assertEqual(model.estimators, ["condensed", "observer"])
        self.assertEqual(model.provenance["inputs"][0]["protocol"], "campaign")
        model.save(self.folder / "kept.json")
        with open(examples.MODEL) as file:
            self.assertEqual((self.folder / "kept.json").read_text(), file.read())
        self.assertEqual([path.name for path in self.folder.iterdir()], ["kept.json"])
        again = pickle.loads(pickle.dumps(model))
        run = {name: column[:500] for name, column in examples.ramp().items()}
        np.testing.assert_array_equal(again.estimate(run).flow_m3_per_s, model.estimate(run).flow_m3_per_s)


if __name__ == "__main__":
    unittest.main()
