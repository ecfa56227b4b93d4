"""Relaxed particles in an odd solid, and power cells of particles of different sizes, against what is known of them."""

import json
import math
import subprocess
import unittest

import runs

LENGTH, AREA, YOUNG, POISSON, SQUEEZED = 0.1, 0.01, 1e6, 0.3, 0.8
LOAD = 0.1e6 * 300e-6  # on the end of the bracket's arm [N]


def wall_force():
    """One-dimensional compression of the neo-Hookean solid [D 51-53] [N]."""
    mu, lame = YOUNG / (2 * (1 + POISSON)), YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
    return -AREA * (mu * (SQUEEZED - 1 / SQUEEZED) + lame * math.log(SQUEEZED) / SQUEEZED)


class PowerCells(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.result = runs.run("polydisperse/polydisperse.toml")

    def test_compression_is_homogeneous(self):
        self.assertLess(self.result.summary["errors"]["uniform"]["displacement_max"], 1e-13 * LENGTH)
        self.assertLess(max(self.result.summary["identities"].values()), 1e-13)

    def test_force_is_the_closed_form(self):
        self.assertAlmostEqual(self.result.history["top.fz"][-1] / wall_force(), 1.0, delta=1e-12)

    def test_cells_are_as_large_as_particles(self):
        volume = self.result.summary["quality"]["volume"]
        self.assertAlmostEqual(volume["mean"], LENGTH**3 / 400, delta=1e-18)
        self.assertGreater(volume["max"] / volume["min"], 8.0)


class Relaxed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.result = runs.run("relaxed-bracket/relaxed-bracket.toml")

    def test_foot_carries_the_load(self):
        last = {c: self.result.history[f"foot.f{c}"][-1] for c in "xyz"}
        self.assertAlmostEqual(last["y"], -LOAD, delta=2e-4 * LOAD)
        self.assertLess(math.hypot(last["x"], last["z"]), 1e-3 * LOAD)

    def test_no_particle_spoils_the_step(self):
        quality = self.result.summary["quality"]
        self.assertEqual(quality["few"], 0)
        self.assertGreater(quality["shortest_steps"][0]["share"], 0.6)
        self.assertGreater(quality["volume"]["max"] / quality["volume"]["min"], 20.0)

    def test_check_tells_the_same(self):
        case = runs.EXAMPLES / "relaxed-bracket/relaxed-bracket.toml"
        found = subprocess.run([runs.TESSERA, "check", str(case), "--json"], capture_output=True, text=True, check=True)
        self.assertEqual(json.loads(found.stdout)["quality"], self.result.summary["quality"])


if __name__ == "__main__":
    runs.main()
