"""Two cantilevers of different stiffness under gravity, against Timoshenko's beam."""

import unittest

import runs

CASE = "two-bodies/two-bodies.toml"
LENGTH, THICKNESS, LOAD = 1.0, 0.2, 1000.0 * 9.81  # m, m, weight per volume [N/m3]
YOUNG = {"stiff": 20e6, "soft": 5e6}
WEIGHT = LOAD * LENGTH * THICKNESS**2


def timoshenko(young):
    """Sag of the tip [m]: bending, and shear with the factor 5/6 and G = E/2."""
    return 1.5 * LOAD * LENGTH**4 / (young * THICKNESS**2) + 3.0 * LOAD * LENGTH**2 / (5.0 * 0.5 * young)


class Sagged:
    def __init__(self, layers):
        counts = [5 * layers, layers, layers]
        self.result = runs.run(CASE, {
            "body.0.particles.counts": counts, "body.1.particles.counts": counts, "output.fields.cells": False})
        history = self.result.history
        self.sag = {body: 0.1 - history[f"{body} tip.z"][-1] for body in YOUNG}
        self.still = {body: abs(history[f"{body} tip.z"][-1] - history[f"{body} tip.z"][-11]) for body in YOUNG}
        self.clamp = {body: history[f"{body} clamp.fz"][-1] for body in YOUNG}
        self.error = {body: self.sag[body] / timoshenko(young) - 1.0 for body, young in YOUNG.items()}


class TwoBodies(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.coarse, cls.fine = Sagged(4), Sagged(6)

    @classmethod
    def tearDownClass(cls):
        rows = [(f"sag of the {body} beam, six layers, over Timoshenko's", "beam theory", 1.0,
                 1.0 + cls.fine.error[body], "1 +- 0.04") for body in YOUNG]
        rows.append(("stiff beam, order from four and six layers", "", 2.0, cls.order(), ">= 1.8"))
        runs.record("two-bodies", rows)

    @classmethod
    def order(cls):
        return runs.order(cls.coarse.error["stiff"], cls.fine.error["stiff"], 1.5)

    def test_sag_as_timoshenko_says(self):
        for body in YOUNG:
            with self.subTest(body=body):
                self.assertLess(abs(self.fine.error[body]), 0.04)

    def test_converges(self):
        self.assertGreater(self.order(), 1.8)
        # What is left when the error falls with the square of the spacing: nothing.
        limit = (9.0 * self.fine.error["stiff"] - 4.0 * self.coarse.error["stiff"]) / 5.0
        self.assertLess(abs(limit), 0.005)

    def test_each_body_has_its_own_material(self):
        ratio = self.fine.sag["soft"] / self.fine.sag["stiff"]
        self.assertAlmostEqual(ratio, YOUNG["stiff"] / YOUNG["soft"], delta=0.1)

    def test_clamps_carry_the_weights(self):
        for body in YOUNG:
            with self.subTest(body=body):
                self.assertAlmostEqual(self.fine.clamp[body] / -WEIGHT, 1.0, delta=1e-4)

    def test_comes_to_rest(self):
        for body in YOUNG:
            with self.subTest(body=body):
                self.assertLess(self.fine.still[body], 1e-4 * self.fine.sag[body])
        self.assertLess(abs(self.fine.result.summary["energy"]["relative_error"]), 1e-6)


if __name__ == "__main__":
    runs.main()
