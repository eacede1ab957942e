"""What the commands do, from Python: the same figures, the same words, and Ctrl-C stops it."""
import json
import os
import pathlib
import signal
import threading
import unittest

import numpy as np

import examples
import spoolflow

QUICK = """[points]
positions_percent = [50]
[monte_carlo]
trials = 100
[map]
positions = 2
pressure_differences = 2
[study]
skip = true
"""
RAMP = """protocol = "ramps"
valve = "size_6"
seed = 3
[run]
pressure_differences_bar = [60]
rate_percent_per_s = 100
"""


class Work(examples.InAFolder):
    def test_validate_has_the_figures_of_the_command(self):
        page, figures = self.folder / "page.html", self.folder / "figures.json"
        shares = []
        found = spoolflow.validate(examples.model(), examples.RAMP, report=page, units=["m3/h"], progress=shares.append)
        found.save(figures)
        self.assertEqual(figures.read_text(), examples.command("validate", "-q", examples.MODEL, examples.RAMP, "--json", "-"))
        self.assertIn("</html>", page.read_text())
        self.assertEqual(shares, sorted(shares))
        self.assertEqual(shares[-1], 1)
        self.assertIn("95 % of the observer's errors lie within", found.verdict)
        self.assertEqual(repr(found), f"<Validation: {found.verdict}>")
        row = found.table()[-1]
        self.assertEqual((row["run"], row["estimator"]), ("ramp_60bar", "observer"))
        self.assertEqual(row["p95_percent_FS"], found.runs[0].estimators[-1].error.all.p95.percent_FS)
        self.assertEqual(found.to_dict()["version"], json.loads(figures.read_text())["version"])

    def test_runs_are_judged_with_the_words_of_the_command(self):
        run = spoolflow.read_recording(examples.RAMP)
        table = {"time_s": run.time_s, "current_A": run.current_A, "position_m": run.position_m, "U_coil_V": run.voltage_V,
                 "oil_temperature_K": run.oil_temperature_K, "flow_reference_m3_per_s": run.flow_reference_m3_per_s}
        file = self.written("short.csv", "time_s,current_A,U_coil_V,position_mm,oil_temperature_C,flow_reference_L_min\n" + "".join(
            f"{k / 1000},1,{3 + k % 3 / 1000},1,50,20\n" for k in range(200)))
        for judge in (spoolflow.validate, spoolflow.monitor):
            for given, called in ((table, "the run"), (file, str(file))):
                with self.assertWarnsRegex(UserWarning, f"^{called}: column 'U_coil_V' is not read: if it is voltage"):
                    judge(examples.model(), given)
        with self.assertRaisesRegex(spoolflow.Error, r"^recordings\[1\]: holds the same as recordings\[0\], and counts once"):
            spoolflow.monitor(examples.model(), [dict(run), dict(run)])
        stuck = {**run, "current_A": np.full(run.samples, 1.0)}
        with self.assertWarnsRegex(UserWarning, "^doubt: the run: current stands still .*; what is raised may be the recording's"):
            spoolflow.monitor(examples.model(), stuck)

    def test_monitor_has_the_figures_of_the_command_and_goes_on_from_a_baseline(self):
        healthy = self.folder / "healthy.json"
        found = spoolflow.monitor(examples.MODEL, [examples.RAMP, examples.DUTY])
        self.assertEqual(found.ne107, "good")
        found.save(healthy)
        said = examples.command("monitor", "-q", examples.MODEL, examples.RAMP, examples.DUTY, "--json", "-")
        self.assertEqual(healthy.read_text(), said)
        later = spoolflow.monitor(examples.model(), examples.DUTY, baseline=healthy)
        self.assertEqual(later.indicators[0].name, "friction_ratio")
        self.assertIn("NE 107 good", repr(later))

    def test_analyse_has_the_figures_of_the_command(self):
        scenario, figures = self.written("scenario.toml", QUICK), self.folder / "figures.json"
        found = spoolflow.analyse(examples.model(), scenario)
        found.save(figures)
        self.assertEqual(figures.read_text(),
                         examples.command("analyse", "-q", examples.MODEL, "--scenario", scenario, "--json", "-"))
        self.assertEqual(len(found.points), 6)  # three levels of pressure for each estimator
        self.assertIn("Improve", repr(found))

    def test_validate_shows_others_beside_it(self):
        page, figures = self.folder / "page.html", self.folder / "other.json"
        other = examples.command("validate", "-q", examples.MODEL, examples.RAMP, "--json", "-")
        figures.write_text(other)
        spoolflow.validate(examples.model(), examples.RAMP, report=page, compare=figures)
        examples.command("validate", "-q", examples.MODEL, examples.RAMP, "--report", self.folder / "its.html", "--compare", figures)
        self.assertEqual(page.read_text(), (self.folder / "its.html").read_text())
        with self.assertRaisesRegex(spoolflow.Error, "^compare: others are shown in the report"):
            spoolflow.validate(examples.model(), examples.RAMP, compare=[figures])

    def test_analyse_goes_along_a_run(self):
        scenario, figures = self.written("scenario.toml", QUICK), self.folder / "figures.json"
        head = examples.ramp()
        run = self.folder / "run.csv"
        columns = np.column_stack([head[name][:3000] for name in ("time_s", "current_A", "voltage_V", "position_m", "oil_temperature_K")])
        np.savetxt(run, columns, "%.9g", ",", header="time_s,current_A,voltage_V,position_m,oil_temperature_K", comments="")
        found = spoolflow.analyse(examples.model(), scenario, recording=run)
        found.save(figures)
        self.assertEqual(figures.read_text(), examples.command(
            "analyse", "-q", examples.MODEL, "--scenario", scenario, "--recording", run, "--json", "-"))
        self.assertIn("run", found)

    def test_analyse_advises_how_to_dither(self):
        scenario, figures = self.written("scenario.toml", QUICK), self.folder / "figures.json"
        page = self.folder / "page.html"
        advice = spoolflow.analyse(examples.model(), scenario, dither=True, ripple_limit_percent=0.3, report=page)
        advice.save(figures)
        arguments = ("analyse", "-q", examples.MODEL, "--scenario", scenario, "--dither", "--ripple-limit", "0.3")
        self.assertEqual(figures.read_text(), examples.command(*arguments, "--json", "-"))
        self.assertEqual(examples.command(*arguments).splitlines()[0], advice.verdict)
        self.assertIn("</html>", page.read_text())
        for words, more in (("dither_shape: saw not in", {"dither_shape": "saw"}), ("samples: has no meaning", {"samples": 8}),
                            ("ripple_limit_percent: Value 0 not in", {"ripple_limit_percent": 0})):
            with self.assertRaisesRegex(spoolflow.Error, "^" + words):
                spoolflow.analyse(examples.model(), scenario, dither=True, **more)

    def test_doubts_about_a_run_are_those_of_the_command(self):
        self.assertEqual(examples.model().doubts_about(examples.ramp()), [])
        columns = {name: examples.ramp()[name] for name in ("time_s", "current_A", "voltage_V", "position_m", "oil_temperature_K")}
        columns["position_m"] = 2 * columns["position_m"]
        run = self.folder / "run.csv"
        np.savetxt(run, np.column_stack(list(columns.values())), "%.9g", ",", header=",".join(columns), comments="")
        said = json.loads(examples.command("estimate", "-q", examples.MODEL, run, "-o", self.folder / "out.csv", "--json", "-"))
        doubts = examples.model().doubts_about(spoolflow.read_recording(run))
        self.assertEqual(doubts, said["recordings"][0]["doubts"])
        self.assertEqual(len(doubts), 1)

    def test_monitor_writes_the_model_of_a_worn_valve(self):
        press = examples.EXAMPLES / "live" / "size_6.json"
        worn = self.written("worn.toml", RAMP.replace("seed = 3", "seed = 101").replace("[60]", "[40, 60]").replace("100", "20")
                            + "[wear]\nfriction_factor = 1.8\n")
        run, mine, its = (self.folder / name for name in ("run.csv", "mine.json", "its.json"))
        examples.command("simulate", "-q", worn, "-o", run)
        found = spoolflow.monitor(press, run, adapt=mine)
        self.assertIn("friction", [each.cause for each in found.causes])
        examples.command("monitor", "-q", press, run, "--adapt", its, "--json", self.folder / "condition.json")
        self.assertEqual([line for line in mine.read_text().splitlines() if "created" not in line],
                         [line for line in its.read_text().splitlines() if "created" not in line])
        self.assertEqual(spoolflow.load_model(mine).name, spoolflow.load_model(press).name)

    def test_monitor_corrects_nothing_of_a_healthy_valve(self):
        with self.assertRaisesRegex(spoolflow.Error, "nothing to correct"):
            spoolflow.monitor(examples.MODEL, examples.RAMP, adapt=self.folder / "model.json")
        self.assertFalse((self.folder / "model.json").exists())

    def test_simulate_makes_the_recording_of_the_command(self):
        scenario, written = self.written("ramp.toml", RAMP), self.folder / "ramp.csv"
        run = spoolflow.simulate(scenario, truth=True)
        examples.command("simulate", "-q", scenario, "-o", written)
        read = spoolflow.read_recording(written)
        self.assertEqual(sorted(read), sorted(run))
        np.testing.assert_allclose(run.current_A, read.current_A, atol=0.51e-5)
        np.testing.assert_allclose(run.flow_reference_m3_per_s, read.flow_reference_m3_per_s, atol=0.51e-3 / 60000)
        self.assertEqual(len(run.truth["flow_L_min"]), run.samples)

    def test_many_valves_at_once_answer_as_each_alone(self):
        run = examples.ramp()
        runs = [{name: column[start:start + 20000 - 700 * start // 1000] for name, column in run.items()}
                for start in range(0, 11000, 1000)]
        for estimator in ("condensed", "observer"):
            together = spoolflow.estimate_many(examples.model(), runs, estimator=estimator)
            for mine, answer in list(zip(runs, together))[::3]:
                alone = examples.model().estimate(mine, estimator=estimator)
                self.assertEqual(answer.flow_m3_per_s.dtype, np.float64)
                np.testing.assert_array_equal(answer.flow_m3_per_s, alone.flow_m3_per_s)
                np.testing.assert_array_equal(answer.flow_upper_m3_per_s, alone.flow_upper_m3_per_s)
                np.testing.assert_array_equal(answer.status, alone.status)

    def test_refuses_in_the_words_of_the_command(self):
        campaign = self.written("campaign.toml", "[valve]\nname = \"A\"\nrated_flow_L_min = -3\n")
        text = self.written("run.csv", "time_s,current_A,position_mm\n0,1,1\n0.1,oops,1\n")
        with self.assertRaises(spoolflow.Error) as caught:
            spoolflow.calibrate(campaign)
        self.assertEqual(str(caught.exception),
                         examples.refusal("calibrate", campaign, "-o", self.folder / "model.json"))
        with self.assertRaises(spoolflow.Error) as caught:
            spoolflow.validate(examples.model(), [text])
        self.assertEqual(str(caught.exception), examples.refusal("validate", examples.MODEL, text))
        for words, work in (
            ("no recording is given", lambda: spoolflow.validate(examples.model(), [])),
            ("estimator: best not in", lambda: spoolflow.validate(examples.model(), [text], estimator="best")),
            ("reference_lag_s: Value 11", lambda: spoolflow.validate(examples.model(), [text], reference_lag_s=11)),
            ("false_alarms_per_year: Value 0", lambda: spoolflow.monitor(examples.model(), text, false_alarms_per_year=0)),
            ("samples: Value 1 not in range 2 to 65536", lambda: spoolflow.analyse(examples.model(), samples=1)),
            ("direction: c not in", lambda: spoolflow.analyse(examples.model(), direction="c")),
            ("2 models and 1 runs", lambda: spoolflow.estimate_many([examples.model()] * 2, [examples.ramp()])),
            (r"runs\[0\]: position_m is missing",
             lambda: spoolflow.estimate_many(examples.model(), [{"time_s": [0], "current_A": [0]}])),
        ):
            with self.assertRaisesRegex(spoolflow.Error, "^" + words):
                work()


class Interruption(examples.InAFolder):
    def setUp(self):
        super().setUp()
        before = signal.signal(signal.SIGALRM, signal.default_int_handler)  # as Ctrl-C, but at a time of ours
        self.addCleanup(signal.signal, signal.SIGALRM, before)
        self.addCleanup(signal.setitimer, signal.ITIMER_REAL, 0)

    def test_stops_an_estimate_within_its_arrays(self):
        run = {name: np.tile(column, 40) for name, column in examples.ramp().items()}
        run["time_s"] = np.arange(len(run["time_s"])) * 1e-3
        sensor = examples.model().sensor()
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        with self.assertRaises(KeyboardInterrupt):
            sensor.estimate(run)
        self.assertLess(sensor.time_s, run["time_s"][-1])  # and goes on from there

    def test_stops_a_calibration(self):
        shares = []

        def report(step, share):
            if not shares:
                signal.setitimer(signal.ITIMER_REAL, 0.2)
            shares.append(share)

        with self.assertRaises(KeyboardInterrupt):
            spoolflow.calibrate(examples.EXAMPLES / "valve_a" / "campaign.toml", progress=report)
        self.assertLess(shares[-1], 1)

    def test_stops_a_study_of_minutes(self):
        signal.setitimer(signal.ITIMER_REAL, 0.5)
        with self.assertRaises(KeyboardInterrupt):
            spoolflow.analyse(examples.model(), self.written("scenario.toml", QUICK.replace("true", "false")), samples=1024)

    def test_an_exception_of_progress_goes_through(self):
        def report(share):
            raise LookupError("enough")

        with self.assertRaisesRegex(LookupError, "enough"):
            spoolflow.validate(examples.model(), examples.RAMP, progress=report)

    def test_the_threads_are_those_of_this_kind_of_machine(self):
        self.assertEqual(len(os.listdir("/proc/self/task")), 1)  # CMakeLists.txt leaves NumPy none


class InterruptionBesideThreads(Interruption):
    """As with a NumPy that starts threads, or in a notebook: another process reads the recordings."""

    def setUp(self):
        super().setUp()
        over = threading.Event()
        thread = threading.Thread(target=over.wait)
        thread.start()
        self.addCleanup(thread.join)
        self.addCleanup(over.set)

    def test_the_threads_are_those_of_this_kind_of_machine(self):
        self.assertGreater(len(os.listdir("/proc/self/task")), 1)

    def test_progress_is_that_of_one_thread(self):
        shares = []
        judged = spoolflow.validate(examples.model(), examples.RAMP, progress=shares.append)
        self.assertEqual(shares, sorted(shares))
        self.assertGreater(len(shares), 1)
        self.assertEqual(shares[-1], 1)
        self.assertIn("95 % of the observer's errors lie within", judged.verdict)

    def test_an_interruption_leaves_no_process_behind(self):
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with self.assertRaises(KeyboardInterrupt):
            spoolflow.calibrate(examples.EXAMPLES / "valve_a" / "campaign.toml")
        self.assertEqual(pathlib.Path("/proc/thread-self/children").read_text(), "")


if __name__ == "__main__":
    examples.ramp()
    unittest.main()
