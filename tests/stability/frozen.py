"""The files of the release, and what a program makes of them."""
import contextlib
import csv
import lzma
import io
import pathlib
import subprocess
import tempfile

RELEASE = pathlib.Path(__file__).resolve().parent / "release"
#: A valve of one direction from force benches, one from a flow bench, a type, a unit of it, a whole valve.
MODELS = ("full", "flow_bench", "type", "unit", "whole")
EACH = 125  # rows of an estimate are kept in these distances


@contextlib.contextmanager
def unpacked():
    """A folder with the models and runs."""
    with tempfile.TemporaryDirectory() as folder:
        for file in RELEASE.glob("*.xz"):
            (pathlib.Path(folder) / file.stem).write_bytes(lzma.decompress(file.read_bytes()))
        yield pathlib.Path(folder)


def estimated(spoolflow, folder, model, estimator):
    """Rows of ESTIMATE.csv; raises with the program's words where it refuses."""
    run = "whole_run.csv" if model == "whole" else "run.csv"
    done = subprocess.run([spoolflow, "estimate", "-q", folder / f"{model}.json", folder / run, "--estimator", estimator, "-o", "-"],
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{model}: exit status {done.returncode}: {done.stderr}")
    return list(csv.DictReader(io.StringIO(done.stdout)))


def rows_kept(rows):
    return [(number, row) for number, row in enumerate(rows) if number % EACH == EACH - 1]
