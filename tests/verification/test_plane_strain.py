"""Plane strain: Cook's membrane against linear elasticity, and dimension = 2 against a slab in three dimensions.

The reference 23.9642 F / (E t) is that of plane stress with nu = 1/3, which is plane strain with nu = 1/4 and 15/16 of E.
"""

import unittest

import runs

COOK = "plane-strain/cook.toml"
SLAB = "plane-strain/slab.toml"
EDGE = 0.016  # loaded side [m]
SMALL, LARGE = 100.0, 30e3  # tractions [Pa]


def rise(case, settings):
    """How far C has risen at the end [m], and the result."""
    result = runs.run(case, {"output.fields.cells": False, **settings})
    return result.history["C.y"][-1] - 0.052, result


def small_load(spacing):
    """The rise under the small load over that of linear elasticity."""
    traction = [0, f"{SMALL}*min(t/0.02, 1)"]
    height, _ = rise(COOK, {"boundary.1.traction": traction, "body.0.particles.spacing": spacing})
    return height / (23.9642 * SMALL * EDGE / 1e6)


class PlaneStrain(unittest.TestCase):
    rows = []

    @classmethod
    def tearDownClass(cls):
        runs.record("plane-strain", cls.rows)

    def test_approaches_linear_elasticity_under_a_small_load(self):
        coarse, fine = small_load("4 mm") - 1.0, small_load("2 mm") - 1.0
        self.rows.append(("Cook's membrane, spacing 2 mm: error of the rise", "converged finite elements", 0.0, fine,
                          "<= 0.02"))
        self.rows.append(("Cook's membrane, order from 4 and 2 mm", "", 2.0, runs.order(coarse, fine), ">= 1.6"))
        self.assertLess(abs(fine), 0.02)
        self.assertGreater(runs.order(coarse, fine), 1.6)

    def test_equals_a_slab_in_three_dimensions(self):
        flat, result = rise(COOK, {})
        solid, _ = rise(SLAB, {})
        self.rows.append(("Cook's membrane, large load: rise in 2D over that of the slab", "", 1.0, flat / solid,
                          "1 +- 0.001"))
        self.assertAlmostEqual(flat / solid, 1.0, delta=1e-3)
        self.assertAlmostEqual(flat, 9.64e-3, delta=0.05e-3)  # far from linear: 11.5 mm
        self.assertLess(max(map(abs, result.history["pz"])), 1e-12)

    def test_boundary_treatments_agree(self):
        consistent, _ = rise(COOK, {})
        for boundary in ("variational", "quasi-static"):
            with self.subTest(boundary=boundary):
                other, _ = rise(COOK, {"method.boundary": boundary})
                self.assertAlmostEqual(other / consistent, 1.0, delta=0.03)

    def test_comes_to_rest(self):
        _, result = rise(COOK, {})
        energy = result.summary["energy"]
        self.assertLess(energy["kinetic"], 1e-9 * energy["internal"])
        self.assertLess(abs(energy["relative_error"]), 1e-6)


if __name__ == "__main__":
    runs.main()
