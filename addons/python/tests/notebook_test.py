"""The notebook of examples/: runs from bench recordings to a judged sensor, and gives what is stored in it."""
import json
import os
import pathlib
import re
import shutil
import unittest

import examples
import notebook

NAME = "from_recordings_to_a_sensor.ipynb"


def without_numbers(text):
    """Other processors may differ in a last digit."""
    return re.sub(r"[-+]?[0-9][0-9.]*(e[-+]?[0-9]+)?", "#", re.sub(" +", " ", text))


class Notebook(examples.InAFolder):
    def test_gives_what_is_stored_in_it_and_makes_the_commands_model(self):
        shutil.copytree(examples.EXAMPLES / "notebook", self.folder / "notebook")
        os.symlink(examples.EXAMPLES / "valve_a", self.folder / "valve_a")
        with open(self.folder / "notebook" / NAME, encoding="utf-8") as file:
            kept = json.load(file)
        self.assertEqual(kept["nbformat"], 4)
        code = [cell for cell in kept["cells"] if cell["cell_type"] == "code"]
        names = {"__name__": "__main__"}
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(self.folder / "notebook")
        for number, cell in enumerate(code, 1):
            self.assertEqual(cell["execution_count"], number, "stored by notebook.py --write")
            given = notebook.run_cell("".join(cell["source"]), names, number)
            self.assertEqual(without_numbers(notebook.text_of(given)), without_numbers(notebook.text_of(cell["outputs"])))
        # The model is the command's but for the time of its making, and answers alike.
        by_command = json.loads(pathlib.Path(examples.MODEL).read_text())
        by_notebook = json.loads(names["model"]._kept.text)
        for model in (by_command, by_notebook):
            del model["provenance"]["created"]
        self.assertEqual(by_notebook, by_command)


if __name__ == "__main__":
    unittest.main()
