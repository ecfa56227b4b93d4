"""The twisting column of Aguirre, Gil, Bonet and Arranz Carreno (2014): largest twist of the free end and its time.

The references are what runs with up to 32 particles per metre approach (examples/twisting-column/README.md).
"""

import functools
import math
import unittest

import modes
import runs

CASE = "twisting-column/twisting-column.toml"
LARGEST_TWIST = {0.3: 322.0, 0.45: 338.5}  # degrees
# Formulation, integration, particles per metre.
METHODS = [("delaunay", "nodal", 4), ("consistent", "nodal", 4), ("variational", "nodal", 4), ("delaunay", "cell", 8),
           ("consistent", "cell", 8), ("consistent", "second-order", 8)]


def twist(history):
    """Angle by which the free end has turned [degrees], unwrapped."""
    angles, turns = [], 0
    for x, y, cx, cy in zip(*(history[name] for name in ("corner.x", "corner.y", "end.x", "end.y"))):
        angle = math.degrees(math.atan2(y - cy, x - cx)) - 45.0
        if angles:
            turns = round((angles[-1] - angle) / 360.0)
        angles.append(angle + 360.0 * turns)
    return angles


@functools.cache
def result(method, poisson):
    return runs.run(CASE, modes.method(*method[:2]) | {
        "material.0.poisson": poisson, "body.0.particles.spacing": 1.0 / method[2], "time.end": 0.12})


def largest_twist(method, poisson):
    return max(twist(result(method, poisson).history))


class TwistingColumn(unittest.TestCase):
    rows = []

    @classmethod
    def tearDownClass(cls):
        runs.record("twisting-column", cls.rows)

    def test_largest_twist(self):
        for method in METHODS:
            for poisson, reference in LARGEST_TWIST.items():
                with self.subTest(method=method, poisson=poisson):
                    ours = largest_twist(method, poisson)
                    name = f"{', '.join(method[:2])}, {method[2]} per metre, nu = {poisson:g}: largest twist [degrees]"
                    self.rows.append((name, "own, up to 32 per metre", reference, ours, "3%"))
                    self.assertLess(abs(ours / reference - 1.0), 0.03)

    def test_the_axis_stays_straight_where_the_particles_are_regular(self):
        for method in METHODS:
            if method[0] != "delaunay":  # the split of regular cells into tetrahedra favours one diagonal
                h = result(method, 0.3).history
                self.assertLess(max(map(math.hypot, h["end.x"], h["end.y"])), 0.02)

    def test_energy(self):
        for method in METHODS:
            self.assertLess(max(map(abs, result(method, 0.3).history["energy_error"])), 5e-3)


if __name__ == "__main__":
    runs.main()
