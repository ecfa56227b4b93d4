"""Nearly incompressible solids: Cook's membrane in plane strain and the punch of [D] with the mean change of volume and without,
against mixed finite elements, and how much the pressure alternates between neighbours."""

import unittest

import incompressible
import runs


class NearlyIncompressible(unittest.TestCase):
    rows = []

    @classmethod
    def tearDownClass(cls):
        runs.record("nearly-incompressible", cls.rows)

    def check(self, what, averaged):
        error = averaged.errors[0]
        self.rows.append((f"{what}, averaged", "mixed finite elements", 0.0, error, "<= 0.03"))
        self.assertLess(abs(error), 0.03)

    def test_neither_locks_nor_alternates(self):
        for poisson in (0.45, 0.499):
            with self.subTest(poisson=poisson):
                averaged, standard = (incompressible.membrane(poisson, "nodal", v) for v in ("averaged", "standard"))
                self.check(f"Cook's membrane, nu = {poisson}: error of the rise", averaged)
                self.rows.append((f"the same: roughness of the pressure, averaged over standard", "", None,
                                  averaged.roughness / standard.roughness, "<= 0.3"))
                self.assertLess(averaged.roughness, 0.2)
                self.assertLess(averaged.roughness, 0.3 * standard.roughness)
                self.assertLess(averaged.steps, standard.steps)

    def test_nor_with_several_points_a_cell(self):
        averaged = incompressible.membrane(0.49, "cell", "averaged")
        self.check("Cook's membrane, nu = 0.49, cell: error of the rise", averaged)
        self.assertLess(averaged.roughness, 0.12)

    def test_punch_in_space(self):
        averaged = incompressible.punch_in_space(0.49, "nodal", "averaged")
        self.check("punch of [D], nu = 0.49: error of the bulge", averaged)
        self.assertLess(averaged.roughness, 0.16)


if __name__ == "__main__":
    runs.main()
