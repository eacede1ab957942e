"""The walk of docs/python.md and the lines of README.md, as they stand, in a folder that has the examples beside it."""
import os
import pathlib
import re
import subprocess
import sys
import unittest

import examples

ROOT = examples.EXAMPLES.parent


class Walk(examples.InAFolder):
    def setUp(self):
        super().setUp()
        os.symlink(examples.EXAMPLES, self.folder / "examples")
        (self.folder / "model.json").write_bytes(pathlib.Path(examples.MODEL).read_bytes())

    def said_by(self, page):
        blocks = re.findall(r"^ *```python\n(.*?)^ *```", page.read_text(), re.MULTILINE | re.DOTALL)
        self.assertEqual(len(blocks), 1, page)
        lines = blocks[0].splitlines()
        indent = len(lines[0]) - len(lines[0].lstrip())
        done = subprocess.run([sys.executable, "-W", "error", "-c", "\n".join(line[indent:] for line in lines)],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        return done.stdout

    def test_of_the_page_ends_with_a_verdict_and_a_report(self):
        said = self.said_by(ROOT / "docs" / "python.md")
        self.assertIn("<Estimate of 60", said)
        self.assertIn("95 % of the observer's errors lie within", said)
        self.assertIn("</html>", (self.folder / "report.html").read_text())

    def test_of_the_readme_works(self):
        self.assertIn("95 % of the observer's errors lie within", self.said_by(ROOT / "README.md"))


if __name__ == "__main__":
    unittest.main()
