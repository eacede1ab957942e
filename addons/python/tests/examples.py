"""What the tests of the Python package share: the command, the example model and recordings, a folder that goes away."""
import os
import pathlib
import subprocess
import tempfile
import unittest

import spoolflow

PROGRAM = os.environ["SPOOLFLOW"]
MODEL = os.environ["SPOOLFLOW_MODEL"]
EXAMPLES = pathlib.Path(os.environ["SPOOLFLOW_EXAMPLES"])
RAMP = EXAMPLES / "valve_a" / "ramp_60bar.h5"
DUTY = EXAMPLES / "valve_a" / "duty_cycle_1.h5"


def command(*arguments, **options):
    """What the command said on standard output; fails where it fails."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, check=True, text=True, **options)
    return done.stdout


def refusal(*arguments):
    """What the command said on standard error, without its own name, and that it was the input's fault."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 2, done
    return done.stderr.strip().split(": ", 1)[1]


class InAFolder(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = pathlib.Path(kept.name)

    def written(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path


_kept = {}


def model():
    if "model" not in _kept:
        _kept["model"] = spoolflow.load_model(MODEL)
    return _kept["model"]


def ramp():
    if "ramp" not in _kept:
        _kept["ramp"] = spoolflow.read_recording(RAMP)
    return _kept["ramp"]
