"""Recordings as arrays in SI units."""
import pickle
import threading
import unittest

import numpy as np

import examples
import spoolflow


class Changed(unittest.TestCase):
    """What a script does to a recording counts for all that is made of it."""

    def test_arrays_count_in_files_work_too(self):
        run = spoolflow.read_recording(examples.RAMP)
        self.assertIsNotNone(run.whole_file())
        run.current_A[:] *= 1.05
        self.assertIsNone(run.whole_file())
        judged = [spoolflow.validate(examples.model(), given).runs[0].estimators[-1].error.all.p95.percent_FS
                  for given in (run, dict(run), pickle.loads(pickle.dumps(run)), examples.RAMP)]
        self.assertEqual(judged[:1] * 2, judged[1:3])
        self.assertGreater(judged[0], 2 * judged[3])
        again = pickle.loads(pickle.dumps(examples.ramp()))
        again.current_A[:] *= 1.05  # the recording's memory there, too
        p95 = spoolflow.validate(examples.model(), again).runs[0].estimators[-1].error.all.p95.percent_FS
        self.assertEqual(p95, judged[0])

    def test_arrays_are_not_replaced_in_silence(self):
        run = examples.ramp()
        for name in ("current_A", "pressure_p_Pa"):
            with self.assertRaisesRegex(AttributeError, f"^{name}: a recording's array is not replaced"):
                setattr(run, name, run.current_A)
        run.remark = "kept"


class Recording(examples.InAFolder):
    def test_of_none_of_its_samples_is_refused_with_its_span(self):
        run = examples.ramp()
        for chosen in (lambda: run[run.time_s > 1e9], lambda: run.between(2, 1), lambda: run[5:5]):
            with self.assertRaisesRegex(spoolflow.Error, r"none of its \d+ samples is chosen; it goes from 0 to .* s$"):
                chosen()

    def test_is_in_SI_whatever_the_file_is_in(self):
        run = spoolflow.read_recording(self.written(
            "run.csv", "time_ms,current_mA,position_mm,oil_temperature_C,flow_reference_L_min,test\n"
            "0,1500,1.25,40,60,1\n1,1600,,40,60,1\n"))
        self.assertEqual(list(run), ["time_s", "current_A", "position_m", "oil_temperature_K", "flow_reference_m3_per_s",
                                     "test"])
        self.assertEqual(run.current_A[0], 1.5)
        self.assertEqual(run["position_m"][0], 1.25e-3)
        self.assertTrue(np.isnan(run.position_m[1]))
        self.assertEqual(run.missing_values, 1)
        self.assertAlmostEqual(run.oil_temperature_K[0], 313.15)
        self.assertAlmostEqual(run.flow_reference_m3_per_s[0], 1e-3)
        self.assertEqual(run.samples, 2)
        self.assertIn("2 samples, 0 to 0.001 s", repr(run))
        with self.assertRaisesRegex(AttributeError, "voltage_V: no such channel; the recording has time_s, current_A"):
            run.voltage_V

    def test_is_named_by_text_bytes_or_a_path_alike(self):
        path = self.written("run.csv", "time_s,current_A,position_mm\n0,1,1\n0.001,1,1\n")
        for name in (path, str(path), bytes(path)):
            self.assertEqual(spoolflow.read_recording(name).file, str(path))
            estimate = examples.model().estimate(spoolflow.read_recording(name))
            estimate.write(bytes(self.folder / "estimate.csv"))
            self.assertTrue((self.folder / "estimate.csv").read_text().startswith("time_s,flow_L_min"))

    def test_is_read_through_a_channel_map(self):
        run = self.written("rig.csv", "t;I_sol [mA];LVDT\n0;1500;5\n10;1500;5\n")
        channels = self.written("map.toml", """[channels]
time     = { column = "t", unit = "ms" }
current  = { column = "I_sol [mA]", unit = "mA" }
position = { column = "LVDT", unit = "V", scale = 0.24, offset = -0.6, to = "mm" }
""")
        read = spoolflow.read_recording(run, channels)
        self.assertEqual(read.current_A.tolist(), [1.5, 1.5])
        np.testing.assert_allclose(read.position_m, 0.6e-3)

    def test_gives_its_own_memory(self):
        current = examples.ramp().current_A
        self.assertFalse(current.flags.owndata)
        self.assertTrue(np.shares_memory(current, examples.ramp().current_A))

    def test_outlives_the_recording_it_is_of(self):
        current = spoolflow.read_recording(examples.DUTY)["current_A"]
        np.testing.assert_array_equal(current, spoolflow.read_recording(examples.DUTY)["current_A"])

    def test_of_HDF5_is_the_same_where_this_process_has_threads(self):
        over = threading.Event()
        thread = threading.Thread(target=over.wait)
        thread.start()
        self.addCleanup(thread.join)
        self.addCleanup(over.set)
        beside = spoolflow.read_recording(examples.RAMP)
        self.assertEqual(list(beside), list(examples.ramp()))
        for name, column in beside.items():
            np.testing.assert_array_equal(column, examples.ramp()[name])
        self.assertEqual(beside.file, str(examples.RAMP))
        torn = self.folder / "torn.h5"
        torn.write_bytes(examples.RAMP.read_bytes()[:5000])
        with self.assertRaises(spoolflow.Error) as caught:
            spoolflow.read_recording(torn)
        self.assertEqual(str(caught.exception),
                         examples.refusal("estimate", examples.MODEL, torn, "-o", self.folder / "e.csv"))


if __name__ == "__main__":
    examples.ramp()  # while there is one thread
    unittest.main()
