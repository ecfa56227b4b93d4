"""Laws of materials under uniaxial stress against closed forms: forces at the largest stretch, on the way back, and flow."""

import math
import unittest

import runs

AREA = 4e-4  # of a bar [m2]
YOUNG, POISSON = 1e6, 0.4
SHEAR = YOUNG / 2 / (1 + POISSON)
LAME = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
BULK = YOUNG / 3 / (1 - 2 * POISSON)
YIELD, HARDENING = 1e5, 2e5


def root(f, a, b):
    """Where f changes its sign between a and b."""
    for _ in range(100):
        m = (a + b) / 2
        a, b = (a, m) if f(a) * f(m) <= 0 else (m, b)
    return (a + b) / 2


def neo_hookean(stretch):
    def stress(along, width):
        return (LAME * math.log(stretch * width ** 2) - SHEAR) / along + SHEAR * along

    return stress(stretch, root(lambda w: stress(w, w), 0.3, 1.5))


def kirchhoff(stretch):
    return stretch * YOUNG * (stretch ** 2 - 1) / 2


def ogden(stretch, terms):
    def kirchhoff_stresses(width):
        J = stretch * width ** 2
        stresses = [BULK / 2 * (J ** 2 - 1)] * 2
        for mu, alpha in terms:
            along, across = ((length / J ** (1 / 3)) ** alpha for length in (stretch, width))
            mean = (along + 2 * across) / 3
            stresses = [stresses[0] + mu * (along - mean), stresses[1] + mu * (across - mean)]
        return stresses

    width = root(lambda w: kirchhoff_stresses(w)[1], 0.3, 1.5)
    return kirchhoff_stresses(width)[0] / stretch


def plastic(stretch):
    return (YIELD + HARDENING * math.log(stretch)) / (1 + HARDENING / YOUNG) / stretch


LAWS = {
    "neo-hookean": neo_hookean,
    "kirchhoff": kirchhoff,
    "mooney": lambda l: ogden(l, [(250e3, 2.0), (-107142.857142857, -2.0)]),
    "ogden": lambda l: ogden(l, [(400e3, 1.5), (-57142.857142857143, -2.0)]),
    "plastic": plastic,
}
FLOW = math.log(1.4) - 1.4 * plastic(1.4) / YOUNG  # plastic strain at the largest stretch


class Laws(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.result = runs.run("laws/laws.toml", {"output.fields.cells": False})
        cls.rows = []

    @classmethod
    def tearDownClass(cls):
        runs.record("laws", cls.rows)

    def force(self, law, time):
        history = self.result.history
        return -runs.interpolate(time, history["t"], history[f"{law}.fz"])

    def test_largest_stretch(self):
        for law, stress in LAWS.items():
            with self.subTest(law=law):
                ratio = self.force(law, 0.5) / (AREA * stress(1.4))
                self.rows.append((f"{law}: force at 40% over the closed form", "", 1.0, ratio, "1 +- 0.001"))
                self.assertAlmostEqual(ratio, 1.0, delta=1e-3)

    def test_way_back(self):
        """Elastic bars take the same force at 20%; the plastic one is off by its flow and must be pushed."""
        for law, stress in LAWS.items():
            with self.subTest(law=law):
                force = AREA * stress(1.2) if law != "plastic" else AREA * YOUNG * (math.log(1.2) - FLOW) / 1.2
                self.assertAlmostEqual(self.force(law, 0.75), force, delta=2e-3 * AREA * stress(1.4))

    def test_flow(self):
        history = self.result.history
        self.assertAlmostEqual(max(history["flow.plastic_strain"]), FLOW, delta=2e-3 * FLOW)
        self.assertAlmostEqual(history["dissipated"][-1], YIELD * FLOW * AREA * 0.06, delta=0.01 * YIELD * FLOW * AREA * 0.06)

    def test_ledger(self):
        self.assertLess(max(map(abs, self.result.history["energy_error"])), 5e-5)


if __name__ == "__main__":
    runs.main()
