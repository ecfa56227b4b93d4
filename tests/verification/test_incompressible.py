"""Nearly incompressible solids: Cook's membrane in plane strain with the mean change of volume and without, against mixed
finite elements (scripts/mixed_elements.py), and how much the pressure alternates between neighbours."""

import math
import unittest

import runs

COOK = "nearly-incompressible/cook.toml"
RISE = {0.45: 31.33e-6, 0.499: 29.65e-6}  # of the middle of the right side [m], converged
SPACING = 2e-3


def roughness(frame):
    """The rms of the pressure less the mean over the neighbours, relative to the rms of the pressure."""
    places = list(zip(frame["reference_position_x"], frame["reference_position_y"]))
    pressure, volume = frame["pressure"], frame["volume"]
    rough = whole = 0.0
    for a, (x, y) in enumerate(places):
        near = [b for b, (u, v) in enumerate(places) if b != a and math.hypot(u - x, v - y) < 1.35 * SPACING]
        mean = sum(volume[b] * pressure[b] for b in near) / sum(volume[b] for b in near)
        rough += volume[a] * (pressure[a] - mean) ** 2
        whole += volume[a] * pressure[a] ** 2
    return math.sqrt(rough / whole)


def membrane(poisson, volumetric):
    return runs.run(COOK, {"material.0.poisson": poisson, "method.volumetric": volumetric, "output.fields.cells": False,
                           "output.fields.format": "csv", "output.fields.every": "80 ms",
                           "output.fields.quantities": ["pressure", "volume"]})


class NearlyIncompressible(unittest.TestCase):
    rows = []

    @classmethod
    def tearDownClass(cls):
        runs.record("nearly-incompressible", cls.rows)

    def test_neither_locks_nor_alternates(self):
        for poisson, converged in RISE.items():
            with self.subTest(poisson=poisson):
                averaged, standard = membrane(poisson, "averaged"), membrane(poisson, "standard")
                error = (averaged.history["C.y"][-1] - 0.052) / converged - 1.0
                rough = roughness(averaged.frame())
                self.rows.append((f"Cook's membrane, nu = {poisson}: error of the rise, averaged", "mixed finite elements",
                                  0.0, error, "<= 0.03"))
                self.rows.append((f"the same: roughness of the pressure, averaged over standard", "", None,
                                  rough / roughness(standard.frame()), "<= 0.3"))
                self.assertLess(abs(error), 0.03)
                self.assertLess(rough, 0.2)
                self.assertLess(rough, 0.3 * roughness(standard.frame()))
                self.assertLess(averaged.summary["steps"], standard.summary["steps"])


if __name__ == "__main__":
    runs.main()
