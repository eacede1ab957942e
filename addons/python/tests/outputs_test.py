"""Estimates as files, channel maps as dicts, and what a file holds."""
import os
import shutil
import stat
import threading
import unittest

import numpy as np

import examples
import spoolflow


class Outputs(examples.InAFolder):
    def test_are_those_of_the_command_in_every_format(self):
        run = examples.ramp()
        estimate = spoolflow.load_model(examples.MODEL).estimate(run)
        for suffix in ("csv", "parquet", "h5", "mat"):
            ours, theirs = self.folder / f"ours.{suffix}", self.folder / f"theirs.{suffix}"
            ours.write_text("of an earlier run")
            estimate.write(ours)
            examples.command("estimate", "-q", examples.MODEL, examples.RAMP, "-o", theirs)
            if suffix == "csv":  # the others hold valve and estimator, too
                self.assertEqual(ours.read_bytes(), theirs.read_bytes())
            self.assertAlmostEqual(ours.stat().st_size, theirs.stat().st_size, delta=5000)
        for suffix in ("h5", "mat"):
            back = spoolflow.read_recording(self.folder / f"ours.{suffix}")
            np.testing.assert_array_equal(back.time_s, estimate.time_s)
            np.testing.assert_allclose(back["flow_m3_per_s"], estimate.flow_m3_per_s, rtol=1e-15)
        self.assertEqual(len(os.listdir(self.folder)), 8)

    def test_leave_nothing_where_they_cannot_be_written(self):
        estimate = spoolflow.load_model(examples.MODEL).estimate(time_s=[0], current_A=[0], position_m=[0])
        with self.assertRaisesRegex(spoolflow.Error, r"\.xlsx is no format that is written here"):
            estimate.write(self.folder / "flow.xlsx")
        with self.assertRaisesRegex(spoolflow.Error, "nowhere/flow.h5: cannot be written: No such file or directory"):
            estimate.write(self.folder / "nowhere" / "flow.h5")
        self.assertEqual(os.listdir(self.folder), [])


    def test_leave_links_pipes_devices_and_rights_as_they_are(self):
        estimate = spoolflow.load_model(examples.MODEL).estimate(time_s=[0], current_A=[0], position_m=[0])
        kept = self.written("kept.csv", "old")
        kept.chmod(0o600)
        link, pipe = self.folder / "link.csv", self.folder / "pipe.csv"
        link.symlink_to("kept.csv")
        estimate.write(link)
        self.assertTrue(link.is_symlink())
        self.assertTrue(kept.read_text().startswith("time_s,"))
        self.assertEqual(stat.S_IMODE(kept.stat().st_mode), 0o600)
        os.mkfifo(pipe)
        read = []
        reader = threading.Thread(target=lambda: read.append(pipe.read_text()))
        reader.start()
        estimate.write(pipe)
        reader.join()
        self.assertEqual(read, [kept.read_text()])
        self.assertTrue(pipe.is_fifo())
        with self.assertRaisesRegex(spoolflow.Error, "cannot be written: it is a folder; name a file in it"):
            spoolflow.load_model(examples.MODEL).save(self.folder)

    def test_are_no_inputs(self):
        run, model = self.folder / "run.h5", self.folder / "model.json"
        shutil.copy(examples.RAMP, run)
        shutil.copy(examples.MODEL, model)
        before = run.read_bytes(), model.read_bytes()
        read = spoolflow.read_recording(run)
        for work in (lambda: spoolflow.validate(model, run, report=run), lambda: spoolflow.validate(model, run, report=model),
                     lambda: spoolflow.validate(model, read, report=run), lambda: spoolflow.monitor(model, run, adapt=model),
                     lambda: spoolflow.analyse(model, recording=run, report=run)):
            with self.assertRaisesRegex(spoolflow.Error, "this call also uses .*, which is the same file; name another"):
                work()
        with self.assertRaisesRegex(spoolflow.Error, "this call also uses .*both.html"):
            spoolflow.monitor(model, run, adapt=self.folder / "both.html", report=self.folder / "both.html")
        with self.assertRaisesRegex(spoolflow.Error, "the folder .*nowhere does not exist; create it or name another"):
            spoolflow.validate(model, run, report=self.folder / "nowhere" / "report.html")
        self.assertEqual((run.read_bytes(), model.read_bytes()), before)


class ChannelMaps(examples.InAFolder):
    def setUp(self):
        super().setUp()
        self.run_file = self.written("rig.csv", "t [ms];I_coil [mA];LVDT\n0;1500;5\n10;1500;5\n20;1600;5\n")
        self.channels = {"time_s": "t [ms]", "current_A": "I_coil [mA]",
                         "position": {"column": "LVDT", "unit": "V", "scale": 0.24, "offset": -0.6, "to": "mm"}}

    def test_may_be_dicts(self):
        run = spoolflow.read_recording(self.run_file, self.channels)
        self.assertEqual(run.time_s.tolist(), [0.0, 0.01, 0.02])
        self.assertEqual(run.current_A.tolist(), [1.5, 1.5, 1.6])
        np.testing.assert_allclose(run.position_m, 0.6e-3)

    def test_are_refused_in_the_words_of_a_file(self):
        for channels, words in (({"curent_A": "I_coil [mA]"}, "^channels, line 2: unknown channel 'curent_A'"),
                                ({**self.channels, "position": "LVDT"}, "the unit of channel position is given neither"),
                                ({"time": {"column": "t [ms]", "gain": 2}}, "gain"), ({}, "table of channels is empty")):
            with self.assertRaisesRegex(spoolflow.Error, words):
                spoolflow.read_recording(self.run_file, channels)
        with self.assertRaisesRegex(TypeError, "time: a column's name or a dict is needed, not int"):
            spoolflow.read_recording(self.run_file, {"time": 1})

    def test_are_proposed_by_what_is_seen_of_a_file(self):
        seen = spoolflow.inspect(self.run_file)
        self.assertEqual(seen["columns"], ["t [ms]", "I_coil [mA]", "LVDT"])
        self.assertEqual(seen["proposed_map"]["current"], {"column": "I_coil [mA]", "unit": "mA"})
        seen = spoolflow.inspect(self.run_file, self.channels)
        self.assertEqual((seen["samples"], seen["end_s"]), (3, 0.02))
        current = {each["channel"]: each for each in seen["channels"]}["current"]
        self.assertEqual((current["lowest"], current["highest"], current["unit"], current["missing"]), (1.5, 1.6, "A", 0))

    def test_inspected_files_of_HDF5_give_the_figures_of_the_command(self):
        import json
        expected = json.loads(examples.command("inspect", "-q", "--json", examples.RAMP))
        self.assertEqual(spoolflow.inspect(examples.RAMP), expected)


if __name__ == "__main__":
    examples.ramp()  # while there is one thread
    unittest.main()
