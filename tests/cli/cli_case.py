"""A small case and how the program is called with it. Needs TESSERA_PROGRAM; standard library only."""

import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = os.environ.get("TESSERA_PROGRAM", "tessera")
DONE, USAGE, INPUT, GEOMETRY = 0, 2, 3, 4

# Line numbers in the messages below count from the first line of this text.
CASE = """\
title = "Block"
[[body]]
name = "block"
shape = { box = { min = [0, 0, 0], max = [1, 1, 1] } }
particles = { counts = [3, 3, 3], jitter = 0.2, seed = 3 }
material = "rubber"
[[material]]
name = "rubber"
young = "1 MPa"
poisson = 0.3
density = "1000 kg/m3"
[[boundary]]
where = "-x"
condition = "fixed"
[[boundary]]
where = "+x"
displacement = ["0.01*t", "free", "free"]
[time]
end = "10 ms"
[output]
fields = { format = "csv", every = "5 ms" }
history = { every = "1 ms" }
[[probe]]
name = "grip"
type = "reaction"
where = "+x"
"""

SECOND_BODY = """\
[[body]]
name = "other"
shape = { box = { min = [0.5, 0, 0], max = [9, 1, 1] } }
particles = { counts = [2, 2, 2] }
material = "rubber"
"""


class CliTest(unittest.TestCase):
    """A folder of its own for every test, in which the program is called."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, text, name="case.toml"):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return name

    def call(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=240)

    def check_fails(self, status, *parts, arguments):
        """The program ends with `status` and one line on standard error that holds all `parts`."""
        result = self.call(*arguments)
        self.assertEqual(result.returncode, status, result.stderr)
        lines = [line for line in result.stderr.splitlines() if not line.startswith("tessera: note:")]
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertTrue(lines[0].startswith("tessera: "), lines[0])
        for part in parts:
            self.assertIn(part, lines[0])
        self.assertNotIn("\033", result.stderr)
        return result
