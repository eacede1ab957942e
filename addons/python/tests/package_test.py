"""The package itself: what it documents, its types, and what works where pandas and Matplotlib are."""
import ast
import importlib.util
import inspect
import os
import pathlib
import subprocess
import sys
import unittest

import numpy as np

import examples
import spoolflow
from spoolflow import _native

HAS_PANDAS = importlib.util.find_spec("pandas") is not None
HAS_MATPLOTLIB = importlib.util.find_spec("matplotlib") is not None
FOLDER = pathlib.Path(spoolflow.__file__).parent


class Package(unittest.TestCase):
    def test_documents_everything_it_offers(self):
        self.assertIn(spoolflow.__version__, examples.command("--version"))
        for name in spoolflow.__all__:
            offered = getattr(spoolflow, name)
            if name.startswith("__") or name == "Status":
                continue
            self.assertTrue(inspect.getdoc(offered), name)
            members = vars(offered).items() if inspect.isclass(offered) else ()
            for member, value in members:
                if inspect.isfunction(value) and not member.startswith("_"):
                    self.assertTrue(inspect.getdoc(value), f"{name}.{member}")
                    self.assertIn("return", value.__annotations__, f"{name}.{member} has no type")

    def test_has_a_stub_of_what_is_compiled(self):
        self.assertTrue((FOLDER / "py.typed").exists())
        stub = ast.parse((FOLDER / "_native.pyi").read_text())
        declared = {}
        for node in stub.body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                declared[node.name] = {each.name for each in getattr(node, "body", []) if isinstance(each, ast.FunctionDef)}
            elif isinstance(node, ast.AnnAssign):
                declared[node.target.id] = set()
        there = {name for name in dir(_native) if not name.startswith("_")} | {"__version__"}
        self.assertEqual(set(declared), there)
        for name in ("Model", "Recording", "Sensor", "Answer"):
            members = {member for member in dir(getattr(_native, name)) if not member.startswith("_")}
            self.assertEqual({member for member in declared[name] if not member.startswith("_")}, members)

    def test_status_has_the_names_of_the_command(self):
        word = spoolflow.Status.closed | spoolflow.Status.time_fault
        self.assertEqual(_native.status_text(int(word)), "closed|time_fault")
        self.assertEqual({status.name for status in spoolflow.Status(int(word))}, {"closed", "time_fault"})

    def test_import_needs_neither_pandas_nor_matplotlib(self):
        code = ("import sys; sys.modules['pandas'] = sys.modules['matplotlib'] = None\n"
                "import spoolflow\n"
                "answer = spoolflow.load_model(sys.argv[1]).estimate(time_s=[0], current_A=[0], position_m=[0])\n"
                "for work in (answer.to_pandas, answer.plot):\n"
                "    try: work()\n"
                "    except ImportError as said: print(said)\n")
        done = subprocess.run([sys.executable, "-c", code, examples.MODEL], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.splitlines(), [
            "to_pandas() needs pandas; install it (Debian: python3-pandas), or use the arrays",
            "plot() needs Matplotlib; install it (Debian: python3-matplotlib), or use the arrays"])


@unittest.skipUnless(HAS_PANDAS, "pandas is not installed (python3-pandas)")
class Tables(examples.InAFolder):
    def test_have_the_columns_of_the_command(self):
        import pandas

        target = self.folder / "estimate.csv"
        examples.command("estimate", "-q", examples.MODEL, examples.RAMP, "-o", target)
        written = pandas.read_csv(target, keep_default_na=False)
        table = examples.model().estimate(examples.ramp()).to_pandas()
        self.assertEqual(list(table), [*written, "spring_force_N", "faulty"])
        np.testing.assert_allclose(table.flow_L_min, written.flow_L_min, atol=0.5001e-6)
        self.assertEqual(list(table.status), list(written.status))

    def test_give_samples_and_take_figures(self):
        table = examples.ramp().to_pandas()
        estimate = examples.model().estimate(table)
        np.testing.assert_array_equal(estimate.flow_m3_per_s, examples.model().estimate(examples.ramp()).flow_m3_per_s)
        judged = spoolflow.validate(examples.model(), examples.RAMP).to_pandas()
        self.assertEqual(list(judged.estimator), ["condensed", "observer"])
        condition = spoolflow.monitor(examples.model(), examples.RAMP).to_pandas()
        self.assertEqual(condition.name[0], "friction_ratio")


@unittest.skipUnless(HAS_MATPLOTLIB, "Matplotlib is not installed (python3-matplotlib)")
class Pictures(unittest.TestCase):
    def test_are_drawn_with_their_units(self):
        os.environ["MPLBACKEND"] = "agg"
        run = examples.ramp()
        axes = examples.model().estimate(run).plot(reference_m3_per_s=run.flow_reference_m3_per_s)
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("time [s]", "flow rate [L/min]"))
        self.assertEqual(run.plot("position_m").get_ylabel(), "position_m")
        self.assertIn("% of full scale", spoolflow.validate(examples.model(), examples.RAMP).plot().get_xlabel())
        self.assertIn("95 % uncertainties", spoolflow.monitor(examples.model(), examples.RAMP).plot().get_xlabel())


if __name__ == "__main__":
    examples.ramp()
    unittest.main()
