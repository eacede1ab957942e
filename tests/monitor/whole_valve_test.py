#!/usr/bin/python3
"""whole_valve_test.py COMMAND VALVE: a whole valve of the virtual rig, judged by the model of its own campaign: as it is
it raises nothing; with the zero of its position sensor 40 um off either way it reports that."""
import json
import os
import subprocess
import sys
import tempfile
import unittest

COMMAND, VALVE = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])

SCENARIO = """protocol = "ramps"
valve = "{valve}"
seed = 3
[run]
pressure_differences_bar = [30, 60]
second_peak_percent = -100
rate_percent_per_s = 20
pause_s = 1
hold_s = 1
[instruments.lvdt]
zero_offset_m = {zero_m}
[wear]
friction_factor = {friction}
"""


class WholeValve(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="spoolflow-whole-")
        cls.run_command("campaign", VALVE, "-o", "bench", "--calibration-only", "-q")
        cls.run_command("calibrate", "bench/campaign.toml", "-o", "model.json", "-q")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def run_command(cls, *arguments):
        subprocess.run([COMMAND, *arguments], cwd=cls.folder.name, check=True, stdout=subprocess.DEVNULL)

    def judged(self, zero_m, friction=1):
        with open(os.path.join(self.folder.name, "run.toml"), "w", encoding="utf-8") as file:
            file.write(SCENARIO.format(valve=VALVE, zero_m=zero_m, friction=friction))
        self.run_command("simulate", "run.toml", "-o", "run.csv", "-q")
        self.run_command("monitor", "model.json", "run.csv", "--json", "run.json", "-q")
        with open(os.path.join(self.folder.name, "run.json"), encoding="utf-8") as file:
            out = json.load(file)
        centre = [one for one in out["indicators"] if one["name"] == "centre_position"]
        self.assertEqual(len(centre), 1)
        return out, centre[0]

    def test_healthy(self):
        out, centre = self.judged(0)
        self.assertEqual((out["ne107"], out["causes"], centre["state"]), ("good", [], "good"))
        self.assertLess(abs(centre["value"]), 10e-6)

    def test_zero_drifted(self):
        for zero_m in (40e-6, -40e-6):
            out, centre = self.judged(zero_m)
            self.assertEqual((out["ne107"], centre["state"]), ("S", "raised"))
            self.assertEqual([one["cause"] for one in out["causes"]], ["position_sensor"])
            self.assertLess(abs(centre["value"] - zero_m), centre["uncertainty_95"])

    def test_more_friction_is_no_shifted_zero(self):
        out, centre = self.judged(0, friction=2)
        self.assertEqual((out["ne107"], out["causes"][0]["cause"], centre["state"]), ("M", "friction", "good"))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
