"""Models of valves, types and units from recordings in memory."""
import tomllib
import unittest
import warnings

import numpy as np

import examples
import spoolflow


class Calibration(examples.InAFolder):
    def setUp(self):
        super().setUp()
        warnings.simplefilter("ignore")

    def test_from_a_dict_with_tables_is_that_of_the_campaigns_file(self):
        with open(examples.EXAMPLES / "valve_a" / "campaign.toml", "rb") as file:
            campaign = tomllib.load(file)
        for entry in campaign["recording"]:
            path = examples.EXAMPLES / "valve_a" / entry["file"]
            run = spoolflow.read_recording(path, entry.pop("channels", None), stroke_m=campaign["valve"]["stroke_mm"] / 1e3)
            entry["file"] = dict(run)
        model = spoolflow.calibrate(campaign)
        expected = examples.model()
        self.assertEqual((model.name, model.estimators), (expected.name, expected.estimators))
        np.testing.assert_allclose(model.estimate(examples.ramp()).flow_m3_per_s, expected.estimate(examples.ramp()).flow_m3_per_s,
                                   rtol=1e-9, atol=1e-12)

    def test_of_a_type_and_of_its_unit(self):
        simulated = spoolflow.simulate_campaign("size_6", calibration_only=True)
        campaign = tomllib.loads(simulated.text)
        for entry in campaign["recording"]:
            entry["file"] = simulated[entry["file"]]
        type_model = spoolflow.calibrate(campaign, as_type=True)
        self.assertIsNotNone(type_model.type)
        self.assertEqual(type_model.type["of"], "type")
        strokes = self.written("strokes.toml", """protocol = "unpressurised_strokes"
valve = "size_6"
seed = 1
""")
        unit = {"name": "serial 17", "recording": [{"protocol": "unpressurised_strokes", "file": spoolflow.simulate(strokes).to_pandas()}]}
        path = self.folder / "type.json"
        type_model.save(path)
        models = [spoolflow.calibrate(unit, type=each) for each in (type_model, path)]
        self.assertEqual(models[0].name, "serial 17")
        self.assertEqual(models[0].type["of"], "unit")
        run = spoolflow.simulate(self.written("ramp.toml", """protocol = "ramps"
valve = "size_6"
seed = 1
[run]
pressure_differences_bar = [60]
rate_percent_per_s = 50
"""))
        answers = [model.estimate(run) for model in (*models, type_model)]
        np.testing.assert_array_equal(answers[0].flow_m3_per_s, answers[1].flow_m3_per_s)
        width = [float(np.mean(each.flow_upper_m3_per_s - each.flow_lower_m3_per_s)) for each in answers]
        self.assertLess(width[0], width[2])  # strokes show part of what the type leaves open

    def test_refuses_what_contradicts_itself(self):
        campaign = str(examples.EXAMPLES / "valve_a" / "campaign.toml")
        for words, work in (
            ("as_type makes a type's model", lambda: spoolflow.calibrate(campaign, as_type=True, type=examples.MODEL)),
            ("2 campaigns are given", lambda: spoolflow.calibrate([campaign, campaign], as_type=True)),
            ("3 campaigns are given", lambda: spoolflow.calibrate([campaign] * 3)),
            ("report shows one campaign", lambda: spoolflow.calibrate(campaign, type=examples.MODEL, report="page.html")),
            ("campaign, line [0-9]+: unknown key 'stroke' in .valve.",
             lambda: spoolflow.calibrate({"valve": {"name": "A", "rated_flow_L_min": 80, "stroke": 2},
                                          "recording": [{"protocol": "spring", "file": examples.RAMP}]})),
        ):
            with self.assertRaisesRegex(spoolflow.Error, "^" + words):
                work()


if __name__ == "__main__":
    examples.ramp()
    unittest.main()
