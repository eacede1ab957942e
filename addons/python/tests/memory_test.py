"""Runs in memory: tables of pandas, dictionaries and recordings give what their files give, in any unit that files take."""
import importlib.util
import json
import unittest

import numpy as np

import examples
import spoolflow

HAS_PANDAS = importlib.util.find_spec("pandas") is not None
HAS_XARRAY = importlib.util.find_spec("xarray") is not None
SENSED = ("time_s", "current_A", "voltage_V", "position_m", "oil_temperature_K")


def without_names(figures):
    """But for which file it was: its name and checksum, wherever they stand."""
    def rest(part):
        if isinstance(part, dict):
            return {key: rest(value) for key, value in part.items() if key not in ("file", "name", "sha256", "recording", "run")}
        return [rest(value) for value in part] if isinstance(part, list) else part
    return rest(json.loads(json.dumps(figures.to_dict())))


def head(count=4000):
    return {name: np.array(examples.ramp()[name][:count]) for name in SENSED}


class Memory(examples.InAFolder):
    def test_is_judged_as_its_file(self):
        by_file = spoolflow.validate(examples.model(), examples.RAMP)
        self.assertEqual(spoolflow.validate(examples.model(), examples.ramp()), by_file)  # with what the calibration knows of it
        shares = []
        found = spoolflow.validate(examples.model(), dict(examples.ramp()), progress=shares.append)
        self.assertEqual(found.runs[0].estimators, by_file.runs[0].estimators)
        self.assertEqual(found.runs[0].file, "run_1.csv")
        self.assertEqual(shares[-1], 1)
        self.assertEqual(spoolflow.validate(examples.model(), examples.ramp()[:]).runs[0].file, "ramp_60bar.csv")

    def test_is_monitored_as_its_file_beside_files(self):
        by_file = spoolflow.monitor(examples.model(), [examples.DUTY, examples.RAMP])
        found = spoolflow.monitor(examples.model(), [examples.DUTY, examples.ramp()])
        self.assertEqual(without_names(found), without_names(by_file))
        self.assertEqual(found.indicators[0], by_file.indicators[0])

    def test_is_refused_under_the_name_that_it_was_given_by(self):
        run = dict(examples.ramp())
        without = {name: column for name, column in run.items() if name != "current_A"}
        with self.assertRaisesRegex(spoolflow.Error, "^the run: .*current"):
            spoolflow.validate(examples.model(), without)
        with self.assertRaisesRegex(spoolflow.Error, r"^recordings\[1\]"):
            spoolflow.validate(examples.model(), [examples.RAMP, {**run, "position_m": run["position_m"] * 1e3}])
        text = dict(head(), current_A=["much"] * 4000)
        with self.assertRaisesRegex(spoolflow.Error, "current_A.*no number"):
            spoolflow.monitor(examples.model(), text)

    def test_takes_every_unit_that_files_take(self):
        run, expected = head(), examples.model().estimate(head())
        other = {"Time [ms]": 1e3 * run["time_s"], "current (mA)": 1e3 * run["current_A"], "voltage_mV": 1e3 * run["voltage_V"],
                 "position_um": 1e6 * run["position_m"], "oil_temperature_\u00b0C": run["oil_temperature_K"] - 273.15,
                 "remark": "of the press line", "operator": ["anna"] * 4000}
        found = examples.model().estimate(other)
        np.testing.assert_allclose(found.flow_m3_per_s, expected.flow_m3_per_s, rtol=1e-6, atol=1e-12)
        by_name = examples.model().estimate(time_ms=1e3 * run["time_s"], current_A=run["current_A"], voltage_V=run["voltage_V"],
                                            position_mm=1e3 * run["position_m"], oil_temperature_K=run["oil_temperature_K"])
        np.testing.assert_allclose(by_name.flow_m3_per_s, expected.flow_m3_per_s, rtol=1e-6, atol=1e-12)
        with self.assertRaisesRegex(spoolflow.Error, "position_bar|position"):
            examples.model().estimate({**run, "position_bar": run["position_m"]})

    def test_goes_through_a_channel_map(self):
        run = dict(examples.ramp())
        run["LVDT"] = 1e3 * run.pop("position_m")
        channels = {"position": {"column": "LVDT", "unit": "mm"}}
        found = spoolflow.validate(examples.model(), run, channels=channels)
        plain = spoolflow.validate(examples.model(), examples.ramp())
        self.assertAlmostEqual(found.runs[0].estimators[-1].error.all.p95.percent_FS,
                               plain.runs[0].estimators[-1].error.all.p95.percent_FS, places=9)

    def test_is_cut_by_samples_and_by_time(self):
        ramp = examples.ramp()
        part = ramp[100:200]
        self.assertEqual((part.samples, part.file), (100, ramp.file))
        np.testing.assert_array_equal(part.current_A, ramp.current_A[100:200])
        self.assertEqual(ramp.between(1.0, 2.0).time_s[[0, -1]].tolist(), [1.0, 1.999])
        self.assertEqual(ramp[ramp.time_s < 0.5].samples, 500)
        estimate = examples.model().estimate(ramp)
        np.testing.assert_array_equal(estimate[100:200].flow_m3_per_s, estimate.flow_m3_per_s[100:200])
        self.assertEqual(len(estimate.between(1.0, 2.0)), 1000)
        self.assertFalse(estimate[~estimate.faulty].faulty.any())
        with self.assertRaisesRegex(TypeError, "columns are attributes"):
            estimate["flow_L_min"]
        later = spoolflow.monitor(examples.model(), ramp[:30000])
        self.assertEqual(later.ne107, "good")

    def test_models_compare_by_what_they_say(self):
        model = examples.model()
        again = spoolflow.load_model(examples.MODEL)
        self.assertEqual(model, again)
        self.assertEqual(len({model, again}), 1)
        text = self.folder / "later.json"
        text.write_text(model._kept.text.replace(model.provenance["created"], "2031-01-01T00:00:00Z"))
        self.assertEqual(spoolflow.load_model(text), model)
        self.assertNotEqual(model.in_environment("machine"), model)
        self.assertNotEqual(model, 7)

    def test_is_judged_in_its_machine_as_by_the_command(self):
        target = self.folder / "estimate.csv"
        file = self.written("line.toml", "[environment]\nkind = \"machine\"\nvibration_g = 1.0\n")
        examples.command("estimate", "-q", examples.MODEL, examples.RAMP, "-o", target, "--environment", file)
        upper = np.loadtxt(target, delimiter=",", skiprows=1, usecols=3)
        for environment in (file, {"kind": "machine", "vibration_g": 1.0}):
            found = examples.model().estimate(examples.ramp(), environment=environment)
            np.testing.assert_allclose(found.flow_upper_L_min, upper, atol=0.51e-6)
        named = examples.model().in_environment("machine", vibration_g=1.0).estimate(examples.ramp())
        np.testing.assert_array_equal(named.flow_upper_m3_per_s, found.flow_upper_m3_per_s)
        wide = spoolflow.validate(examples.model(), examples.RAMP, environment="machine")
        narrow = spoolflow.validate(examples.model(), examples.RAMP)
        wider, narrower = (each.runs[0].estimators[-1].error.all.band_mean_width.L_min for each in (wide, narrow))
        self.assertGreater(wider, 1.1 * narrower)
        with self.assertRaisesRegex(spoolflow.Error, "^environment, line .*'wind'"):
            examples.model().in_environment(wind=3)


@unittest.skipUnless(HAS_PANDAS, "pandas is not installed (python3-pandas)")
class Tables(examples.InAFolder):
    def test_of_pandas_are_judged_as_their_file(self):
        table = examples.ramp().to_pandas()
        by_file = spoolflow.validate(examples.model(), examples.RAMP)
        self.assertEqual(spoolflow.validate(examples.model(), table).runs[0].estimators, by_file.runs[0].estimators)
        self.assertEqual(without_names(spoolflow.monitor(examples.model(), table)),
                         without_names(spoolflow.monitor(examples.model(), examples.RAMP)))

    def test_with_an_index_of_instants_or_times_give_it_back(self):
        import pandas

        run, expected = head(), examples.model().estimate(head())
        table = pandas.DataFrame(run).drop(columns="time_s")
        begin = pandas.Timestamp("2026-11-26T10:00:00", tz="Europe/Vienna")
        for index in (pandas.to_timedelta(run["time_s"], unit="s"), begin + pandas.to_timedelta(run["time_s"], unit="s"),
                      pandas.DatetimeIndex(begin.tz_localize(None) + pandas.to_timedelta(run["time_s"], unit="s"))):
            indexed = table.set_index(index)
            found = examples.model().estimate(indexed)
            np.testing.assert_allclose(found.time_s, run["time_s"], atol=1e-9)
            np.testing.assert_allclose(found.flow_m3_per_s, expected.flow_m3_per_s, rtol=1e-6, atol=1e-12)
            self.assertTrue(found.to_pandas().index.equals(index))
            self.assertEqual(found[10:20].to_pandas().index[0], index[10])
        column = pandas.DataFrame(run).assign(time=index).drop(columns="time_s")
        np.testing.assert_allclose(examples.model().estimate(column.rename(columns={"time": "time_s"})).time_s, run["time_s"],
                                   atol=1e-9)

    def test_with_a_column_of_instants_have_the_time(self):
        import pandas

        run, expected = head(), examples.model().estimate(head())
        table = pandas.DataFrame(run).drop(columns="time_s")
        for begin in (pandas.Timestamp("2026-11-26T10:00:00", tz="Europe/Vienna"), pandas.Timestamp("2026-11-26")):
            instants = begin + pandas.to_timedelta(pandas.Series(run["time_s"]), unit="s")
            for name in ("time", "timestamp"):
                found = examples.model().estimate(table.assign(**{name: instants}))
                np.testing.assert_allclose(found.time_s, run["time_s"], atol=1e-9)
                np.testing.assert_allclose(found.flow_m3_per_s, expected.flow_m3_per_s, rtol=1e-6, atol=1e-12)

    def test_one_after_the_other_go_on_from_the_first_ones_time(self):
        import pandas

        run = head()
        table = pandas.DataFrame(run).drop(columns="time_s")
        table = table.set_index(pandas.Timestamp("2026-11-26", tz="UTC") + pandas.to_timedelta(run["time_s"], unit="s"))
        expected = examples.model().estimate(table)
        sensor = examples.model().sensor()
        for again in range(2):
            pieces = [sensor.estimate(table[k:k + 700]) for k in range(0, len(table), 700)]
            np.testing.assert_array_equal(np.concatenate([piece.flow_m3_per_s for piece in pieces]), expected.flow_m3_per_s)
            np.testing.assert_array_equal(np.concatenate([piece.status for piece in pieces]), expected.status)
            self.assertEqual(sensor.time_s, expected.time_s[-1])
            sensor.reset()  # as new, its clock too

    def test_with_a_column_twice_are_refused(self):
        import pandas

        table = examples.ramp()[:100].to_pandas()
        with self.assertRaisesRegex(spoolflow.Error, "^column current_A stands twice; keep one of them"):
            examples.model().estimate(pandas.concat([table, table[["current_A"]]], axis=1))

    def test_with_missing_values_of_pandas_have_missing_samples(self):
        import pandas

        table = pandas.DataFrame(head()).convert_dtypes()
        table.loc[50, "current_A"] = pandas.NA
        said = examples.model().estimate(table).status
        self.assertTrue(said[50] & spoolflow.Status.sample_missing)
        self.assertFalse(said[49] & spoolflow.Status.sample_missing)

    def test_have_every_column(self):
        table = examples.model().estimate(head()).to_pandas()
        for name in ("spring_force_N", "faulty", "status", "pressure_difference_bar"):
            self.assertIn(name, table)
        figures = spoolflow.validate(examples.model(), examples.RAMP).to_pandas()
        self.assertIn("error_moving_p95_percent_FS", figures)
        self.assertGreater(figures.error_all_largest_percent_FS[1], figures.error_all_p95_percent_FS[1])

    @unittest.skipUnless(HAS_XARRAY, "xarray is not installed (python3-xarray)")
    def test_of_xarray_have_units_and_come_back(self):
        recording = examples.ramp()[:4000].to_xarray()
        self.assertEqual(recording["position_m"].attrs["units"], "m")
        self.assertEqual(recording["flow_reference_m3_per_s"].attrs["units"], "m3/s")
        estimate = examples.model().estimate(recording)
        np.testing.assert_array_equal(estimate.flow_m3_per_s, examples.model().estimate(head()).flow_m3_per_s)
        instants = np.datetime64("2026-11-26") + (1e9 * recording["time_s"].values).round().astype("timedelta64[ns]")
        by_instants = examples.model().estimate(recording.rename(time_s="time").assign_coords(time=instants))
        np.testing.assert_allclose(by_instants.flow_m3_per_s, estimate.flow_m3_per_s, rtol=1e-6, atol=1e-12)
        answers = estimate.to_xarray()
        self.assertEqual(answers["flow_L_min"].attrs["units"], "L/min")
        self.assertEqual(float(answers["flow_L_min"].sel(time_s=1.0)), float(estimate.flow_L_min[1000]))


if __name__ == "__main__":
    examples.ramp()
    unittest.main()
