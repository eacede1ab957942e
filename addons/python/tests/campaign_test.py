"""Campaigns of the virtual rig and exports, beside those of the command."""
import filecmp
import os
import unittest

import numpy as np

import examples
import spoolflow

SMALL = """hysteresis = "preisach"
[campaign]
oil_temperatures_C = [40]
pressure_differences_bar = [20, 50]
ramps_pressures_bar = [50]
duty_cycle_s = 2
dithered_duty_s = 2
ramp_rate_percent_per_s = 100
"""


class Campaigns(examples.InAFolder):
    def test_to_files_and_in_memory_are_those_of_the_command(self):
        valve = self.written("small.toml", SMALL)
        shares = []
        listing = spoolflow.campaign(valve, self.folder / "mine", calibration_only=True, truth=True, progress=shares.append)
        simulated = spoolflow.simulate_campaign(valve, calibration_only=True)
        examples.command("campaign", "-q", valve, "-o", self.folder / "its", "--calibration-only", "--truth")
        self.assertEqual(listing, str(self.folder / "mine" / "campaign.toml"))
        files = sorted(os.listdir(self.folder / "its"))
        self.assertEqual(sorted(os.listdir(self.folder / "mine")), files)
        self.assertEqual([*simulated], [name for name in files if name.endswith(".csv")])
        self.assertGreater(len(simulated), 3)
        for name in files:
            if name != "truth":
                self.assertTrue(filecmp.cmp(self.folder / "mine" / name, self.folder / "its" / name, shallow=False), name)
        self.assertEqual(filecmp.dircmp(self.folder / "mine" / "truth", self.folder / "its" / "truth").diff_files, [])
        self.assertEqual(shares, sorted(shares))
        with open(listing) as file:
            self.assertEqual(simulated.text, file.read())
        for name, run in simulated.items():
            read = spoolflow.read_recording(self.folder / "its" / name)
            self.assertIsNone(run.truth)
            np.testing.assert_allclose(run.position_m, read.position_m, atol=0.51e-6)

    def test_refuse_in_the_words_of_the_command(self):
        valve = self.written("valve.toml", "hysteresis = \"round\"\n")
        with self.assertRaises(spoolflow.Error) as caught:
            spoolflow.simulate_campaign(valve)
        self.assertEqual(str(caught.exception), examples.refusal("campaign", valve, "-o", self.folder / "out"))
        with self.assertRaisesRegex(spoolflow.Error, "^workers: Value -1"):
            spoolflow.simulate_campaign("size_6", workers=-1)

    def test_replace_their_like_alone(self):
        valve = self.written("small.toml", SMALL)
        bench = self.folder / "bench"
        bench.mkdir()
        (bench / "spring.csv").write_text("time_s,position_mm\n")
        with self.assertRaises(spoolflow.Error) as caught:
            spoolflow.campaign(valve, bench, calibration_only=True)
        self.assertEqual(str(caught.exception), examples.refusal("campaign", valve, "-o", bench, "--calibration-only"))
        self.assertEqual(os.listdir(bench), ["spring.csv"])
        self.assertEqual((bench / "spring.csv").read_text(), "time_s,position_mm\n")

    def test_a_failure_to_store_goes_through(self):
        valve = self.written("small.toml", SMALL)
        (self.folder / "full").mkdir(mode=0o755)
        os.makedirs(self.folder / "full" / "spring.csv")  # no file can have that name
        with self.assertRaises((spoolflow.Error, OSError)):
            spoolflow.campaign(valve, self.folder / "full", calibration_only=True)


class Exports(examples.InAFolder):
    def setUp(self):
        super().setUp()
        before = os.environ.get("SOURCE_DATE_EPOCH")
        os.environ["SOURCE_DATE_EPOCH"] = "1763900000"
        self.addCleanup(lambda: os.environ.pop("SOURCE_DATE_EPOCH") if before is None
                        else os.environ.update(SOURCE_DATE_EPOCH=before))

    def test_are_the_bytes_of_the_command(self):
        mine, its = self.folder / "mine", self.folder / "its"
        spoolflow.export_parameters(examples.model(), mine)
        examples.command("export", "parameters", examples.MODEL, "-o", its)
        self.assertEqual(mine.read_bytes(), its.read_bytes())
        spoolflow.export_parameters(examples.MODEL, mine, sensors="condensed")
        self.assertLess(mine.stat().st_size, its.stat().st_size)
        for model, fmi in ((examples.model(), 2), ("size_6", 3)):
            spoolflow.export_fmu(model, mine, fmi=fmi)
            examples.command("export", "fmu", model if model == "size_6" else examples.MODEL, "-o", its, "--fmi", fmi)
            self.assertEqual(mine.read_bytes(), its.read_bytes(), model)

    def test_cpp_spares_what_somebody_changed(self):
        folder = self.folder / "firmware"
        files = spoolflow.export_cpp(examples.model(), folder)
        examples.command("export", "cpp", examples.MODEL, "-o", self.folder / "its")
        for name in files:
            self.assertEqual((folder / name).read_bytes(), (self.folder / "its" / name).read_bytes(), name)
        self.assertEqual(spoolflow.export_cpp(examples.model(), folder), files)  # nobody changed anything
        changed = folder / "valve_model.hpp"
        changed.write_text(changed.read_text() + "// mine\n")
        with self.assertRaises(spoolflow.Error) as caught:
            spoolflow.export_cpp(examples.model(), folder)
        self.assertIn("valve_model.hpp: it was changed since it was exported", str(caught.exception))

    def test_refuse_what_there_is_not(self):
        for words, work in (
            ("direction: the model of .* knows direction b alone, not a", lambda: spoolflow.export_cpp(examples.model(), "x", direction="a")),
            ("direction: c not in", lambda: spoolflow.export_parameters(examples.model(), "x", direction="c")),
            ("sensors: both not in", lambda: spoolflow.export_parameters(examples.model(), "x", sensors="both")),
            ("fmi: 1 not in", lambda: spoolflow.export_fmu(examples.model(), "x", fmi=1)),
            ("direction: a: a virtual valve has no direction", lambda: spoolflow.export_fmu("size_6", "x", direction="a")),
        ):
            with self.assertRaisesRegex(spoolflow.Error, "^" + words):
                work()
        self.assertFalse(os.path.exists("x"))


if __name__ == "__main__":
    unittest.main()
