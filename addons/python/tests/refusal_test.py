"""Input that cannot be used: an exception with the words of the command line, or one that names the argument."""
import copy
import pathlib
import unittest

import numpy as np

import examples
import spoolflow
from spoolflow import _native
from spoolflow.columns import of_one_coil_or_both


class Coils(unittest.TestCase):
    """Whose current and voltage a sensor gets, as the command takes them from recordings."""

    NEEDED = {"time_s": 1, "position_m": 2}

    def columns(self, direction, **given):
        return of_one_coil_or_both({**self.NEEDED, **given}, direction)

    def test_of_a_whole_valve_are_both_or_the_active_one(self):
        both = self.columns("both", current_a_A=3, current_b_A=4, voltage_a_V=5, voltage_b_V=6, voltage_V=7, pressure_p_Pa=8)
        self.assertEqual(both, {**self.NEEDED, "current_A": 4, "current_a_A": 3, "voltage_V": 6, "voltage_a_V": 5,
                                "pressure_p_Pa": 8})
        self.assertEqual(self.columns("both", current_A=3, voltage_V=4), {**self.NEEDED, "current_A": 3, "voltage_V": 4})
        with self.assertRaisesRegex(spoolflow.Error, "the model is of a whole valve and needs the currents of both coils"):
            self.columns("both", current_a_A=3)
        with self.assertRaisesRegex(spoolflow.Error, "^current_a_A is given beside current_A, which is the active coil's; give"):
            self.columns("both", current_a_A=3, current_A=4)

    def test_of_one_direction_are_its_own(self):
        whole_run = {"current_a_A": 3, "current_b_A": 4, "voltage_a_V": 5, "voltage_b_V": 6, "pressure_p_Pa": 8}
        self.assertEqual(self.columns("b", **whole_run), {**self.NEEDED, "current_A": 4, "voltage_V": 6})
        self.assertEqual(self.columns("b", current_A=1, **whole_run), {**self.NEEDED, "current_A": 1, "voltage_V": 6})
        with self.assertRaisesRegex(spoolflow.Error, "current_A is missing"):
            self.columns("a", **whole_run)


class Refusal(examples.InAFolder):
    def assert_refused(self, words, work):
        with self.assertRaises(spoolflow.Error) as caught:
            work()
        self.assertEqual(str(caught.exception), words)
        self.assertIsInstance(caught.exception, ValueError)

    def test_has_the_words_of_the_command_line(self):
        run = self.written("run.csv", "time_s,current_A,position_mm\n0,1,1\n0.1,oops,1\n")
        gone = self.folder / "gone.csv"
        nowhere = self.folder / "nowhere.json"
        torn = self.written("torn.json", pathlib.Path(examples.MODEL).read_text()[:5000])
        empty = self.written("empty.json", "")
        target = self.folder / "estimate.csv"
        for recording in (run, gone):
            self.assert_refused(examples.refusal("estimate", examples.MODEL, recording, "-o", target),
                                lambda: spoolflow.read_recording(recording))
        for model in (nowhere, torn, empty, self.folder):
            self.assert_refused(examples.refusal("estimate", model, examples.RAMP, "-o", target),
                                lambda: spoolflow.load_model(model))

    def test_of_a_channel_map_names_file_and_line(self):
        channels = self.written("map.toml", "[channels]\ntime = { column = \"t\", unit = \"ms\" }\ncurent = \"I\"\n")
        run = self.written("run.csv", "t,I\n0,1\n")
        self.assert_refused(examples.refusal("inspect", run, "--channels", channels),
                            lambda: spoolflow.read_recording(run, channels))

    def test_of_arrays_names_the_argument(self):
        estimate = examples.model().estimate
        time = np.arange(10.0)
        for words, samples in (
            ("position_m is missing", {"time_s": time, "current_A": time}),
            ("current_A: has 9 samples and time_s has 10", {"time_s": time, "current_A": time[:9], "position_m": time}),
            ("voltage_V: has 3 samples", {"time_s": time, "current_A": time, "position_m": time, "voltage_V": [1, 2, 3]}),
            ("current_A: holds what is no number", {"time_s": time, "current_A": ["a"] * 10, "position_m": time}),
            ("current_A: holds what is no number", {"time_s": time, "current_A": time * 1j, "position_m": time}),
            ("position_m: has 2 dimensions", {"time_s": time, "current_A": time, "position_m": time.reshape(5, 2)}),
        ):
            with self.assertRaisesRegex(spoolflow.Error, "^" + words):
                estimate(**samples)
        with self.assertRaisesRegex(spoolflow.Error, r"read a file by spoolflow.read_recording\(path\)"):
            estimate("run.csv")
        with self.assertRaisesRegex(spoolflow.Error, "either a recording or arrays"):
            estimate(examples.ramp(), current_A=time)
        with self.assertRaisesRegex(spoolflow.Error, r"estimator: best not in \{condensed,observer\}"):
            estimate(examples.ramp(), estimator="best")

    def test_of_an_argument_that_nothing_reads_names_it(self):
        time = np.arange(10.0) * 1e-3
        needed = {"time_s": time, "current_A": 0 * time, "position_m": 0 * time}
        model = examples.model()
        for work in (model.estimate, model.sensor().estimate, model.doubts_about):
            with self.assertRaisesRegex(spoolflow.Error, "^volage_V: is no channel .*; did you mean voltage_V?"):
                work(**needed, volage_V=time)
        with self.assertRaisesRegex(spoolflow.Error, "^enviroment: .*; did you mean environment?"):
            model.estimate(**needed, enviroment="machine")
        with self.assertRaisesRegex(spoolflow.Error, "have a meaning beside dither=True alone"):
            spoolflow.analyse(model, ripple_limit_percent=1)
        for stroke_m in (-1e-3, 0, 2.4, float("nan")):
            with self.assertRaisesRegex(spoolflow.Error, f"^stroke_m: Value {stroke_m} not in range"):
                spoolflow.read_recording(examples.RAMP, stroke_m=stroke_m)
        with self.assertRaisesRegex(spoolflow.Error, "^stroke_m: '2.4' is text"):
            spoolflow.read_recording(examples.RAMP, stroke_m="2.4")
        with self.assertRaisesRegex(spoolflow.Error, "^type: a type's model or its file is needed, and this is a int"):
            spoolflow.calibrate(examples.EXAMPLES / "valve_a" / "campaign.toml", type=3)
        with self.assertRaisesRegex(spoolflow.Error, "^as_type: True or False is needed, not 'yes'"):
            spoolflow.calibrate(examples.EXAMPLES / "valve_a" / "campaign.toml", as_type="yes")

    def test_of_times_that_are_text_names_what_makes_instants(self):
        text = ["2026-01-01 00:00:00.000", "2026-01-01 00:00:00.001"]
        for name in ("time", "time_s"):
            with self.assertRaisesRegex(spoolflow.Error, f"^{name}: holds text, such as '2026-01-01 .*pandas.to_datetime"):
                examples.model().estimate({name: np.array(text, dtype=object), "current_A": [0, 0], "position_m": [0, 0]})

    def test_says_which_columns_of_a_table_may_be_meant(self):
        run = examples.ramp()
        table = {"time_s": run.time_s, "current_A": run.current_A, "position_m": run.position_m, "U_coil_V": run.voltage_V,
                 "remark": np.zeros(run.samples)}
        file = self.written("run.csv", "time_s,current_A,position_mm,U_coil_V\n0,1,1,5\n0.001,1,1,5\n")
        for given in (table, spoolflow.read_recording(file)):
            with self.assertWarnsRegex(UserWarning, "column 'U_coil_V' is not read: if it is voltage, name it voltage_<unit>"):
                examples.model().estimate(given)

    def test_of_arrays_in_other_units_has_the_words_for_recordings(self):
        run = examples.ramp()
        columns = {name: np.array(run[name]) for name in ("time_s", "current_A", "position_m", "oil_temperature_K")}
        estimate = examples.model().estimate
        for name, factor, offset, words in (
            ("position_m", 1e3, 0, "beyond -0.1 to 0.1 m .* is its unit mm"),
            ("current_A", 1e3, 0, "beyond -50 to 50 A .* is its unit mA instead"),
            ("oil_temperature_K", 1, -273.15, "oil is between -60 and 200 degC.* is its unit C or degF instead"),
            ("time_s", 1e3, 0, "the samples are 1 s apart.* is the unit of time ms instead of s"),
        ):
            with self.assertRaisesRegex(spoolflow.Error, f"^the run,.*column '{name}': .*{words}"):
                estimate(**{**columns, name: columns[name] * factor + offset})
        with self.assertRaisesRegex(spoolflow.Error, "^the run, column 'time_s': the time runs backwards from sample to sample"):
            estimate(**{name: column[::-1] for name, column in columns.items()})
        wild = dict(columns, position_m=columns["position_m"].copy())
        wild["position_m"][500] = 17  # a single one is the sensor's to judge
        self.assertTrue(estimate(**wild).status[500] & spoolflow.Status.position_fault)

    def test_of_port_pressures_in_bar_has_the_words_for_recordings(self):
        time = np.arange(2000) * 1e-3
        ports = [f"pressure_{port}_Pa" for port in "pabt"]

        def checked(*pressures):
            _native.check_units({"time_s": time, "current_A": 0 * time, "position_m": 0 * time,
                                 **{name: value + 0 * time for name, value in zip(ports, pressures)}})

        checked(60e5, 30e5, 30e5, 2e3)  # a return line is nearly without pressure
        checked(60e5, 0, 0, 0)
        with self.assertRaisesRegex(spoolflow.Error, "^the run, column 'pressure_p_Pa': channel pressure_p carries a signal but "
                                    "never exceeds 60 Pa .* is its unit bar or"):
            checked(60, 30, 30, 0)

    def test_of_a_step_names_the_argument(self):
        sensor = examples.model().sensor()
        for words, sample in (
            ("current_A: is no number but a str", {"time_s": 0, "current_A": "x", "position_m": 1e-3}),
            ("time_s: holds 3 numbers, where a step takes one", {"time_s": np.zeros(3), "current_A": 1, "position_m": 1e-3}),
        ):
            with self.assertRaisesRegex(spoolflow.Error, "^" + words):
                sensor.step(**sample)

    def test_of_a_copy_says_that_two_would_share_the_memory(self):
        for copied in (copy.copy, copy.deepcopy):
            with self.assertRaises(TypeError):
                copied(examples.model().sensor())

    def test_of_a_missing_file_is_also_that_of_python(self):
        gone = self.folder / "gone"
        campaign = {"valve": {"name": "A", "rated_flow_L_min": 80, "stroke_mm": 2.4},
                    "recording": [{"protocol": "spring", "file": gone}]}
        for work in (lambda: spoolflow.read_recording(gone), lambda: spoolflow.load_model(gone), lambda: spoolflow.inspect(gone),
                     lambda: spoolflow.validate(examples.model(), gone), lambda: spoolflow.validate(gone, examples.RAMP),
                     lambda: spoolflow.validate(examples.model(), examples.RAMP, requirements=gone),
                     lambda: spoolflow.monitor(examples.model(), [examples.RAMP, gone]),
                     lambda: spoolflow.monitor(examples.model(), examples.RAMP, baseline=gone),
                     lambda: spoolflow.read_recording(examples.RAMP, gone), lambda: spoolflow.simulate(gone),
                     lambda: spoolflow.calibrate(gone), lambda: spoolflow.calibrate(campaign),
                     lambda: examples.model().in_environment(gone)):
            with self.assertRaises(FileNotFoundError) as caught:
                work()
            self.assertIsInstance(caught.exception, spoolflow.Error)
            self.assertEqual(caught.exception.filename, str(gone))
            self.assertIn("gone", str(caught.exception))

    def test_is_never_without_words(self):
        model, ramp = examples.model(), examples.ramp()
        for work in (lambda: spoolflow.load_model(""), lambda: spoolflow.read_recording(""), lambda: spoolflow.calibrate(""),
                     lambda: spoolflow.calibrate([]), lambda: spoolflow.calibrate({}), lambda: spoolflow.validate(model, {}),
                     lambda: spoolflow.validate(model, []), lambda: spoolflow.validate(model, [""]), lambda: spoolflow.monitor(model, 7),
                     lambda: spoolflow.inspect(""), lambda: spoolflow.simulate(""), lambda: model.estimate(),
                     lambda: model.estimate({}), lambda: model.estimate(7), lambda: model.save(""), lambda: ramp[[10**9]],
                     lambda: model.estimate(ramp, estimator=""), lambda: spoolflow.validate("", examples.RAMP),
                     lambda: model.in_environment(wind=3), lambda: model.in_environment({"vibration_g": -1}),
                     lambda: spoolflow.validate(model, ramp, report=""), lambda: spoolflow.campaign("", self.folder)):
            with self.assertRaises(Exception) as caught:
                work()
            self.assertGreater(len(str(caught.exception).strip()), 10, repr(caught.exception))

    def test_of_a_channel_that_is_not_there_lists_those_that_are(self):
        with self.assertRaisesRegex(KeyError, "curent_A: no such channel; the recording has time_s, current_A"):
            examples.ramp()["curent_A"]

    def test_leaves_no_half_written_model(self):
        with self.assertRaisesRegex(spoolflow.Error, "cannot be written: No such file"):
            examples.model().save(self.folder / "nowhere" / "model.json")
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
