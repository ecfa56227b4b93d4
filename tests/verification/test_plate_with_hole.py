"""A plate with a hole under tension: Kirsch's closed solution (1898), and a strip of finite width (Howland 1930, Heywood)."""

import functools
import math
import unittest

import runs

RADIUS, TENSION = 0.1, 10e6
WIDTH = 10 * RADIUS  # of the strip [m]
FIELDS = {"output.fields.format": "csv", "output.fields.quantities": ["displacement", "stress"]}
SPACINGS = (0.04, 0.02, 0.01)
# A quarter of the strip, 2 m long, under uniform tension.
STRIP = {"body.0.shape.difference.0.box.max": [1.0, 0.5 * WIDTH, 0.01],
         "boundary.1.stress": [["10e6*min(t/2e-3, 1)^2*(3 - 2*min(t/2e-3, 1))", 0, 0], [0, 0, 0], [0, 0, 0]],
         "time.end": 4e-3, "time.damping": 12000}
BOUNDS = {0.04: 0.018, 0.02: 0.006, 0.01: 0.0016}  # of the relative L2 error of the displacements


def heywood(hole_over_width):
    """Largest stress over the mean stress of the whole section; 3 for a wide strip."""
    rest = 1.0 - hole_over_width
    return (2.0 + rest**3) / rest


@functools.cache
def result(case, spacing):
    """None where this build cannot make the body."""
    process, folder = runs.execute("plate-with-hole/plate.toml", FIELDS | (STRIP if case == "strip" else {}) | {
        "body.0.particles.spacing": spacing})
    if "TESSERA_WITH_CGAL" in process.stderr:
        return None
    if process.returncode != 0:
        raise AssertionError(f"{case} {spacing}: {process.stderr.strip()}")
    return runs.Result(folder)


def shapes(x, y):
    """1 and the functions of x and y by which Kirsch's stress along the tension falls with (a/r)^2 and (a/r)^4; their
    sum is 3 at the side of the hole (0, a)."""
    r2 = x * x + y * y
    q, c2, c4 = RADIUS**2 / r2, (x * x - y * y) / r2, 1.0 - 8.0 * (x * y / r2) ** 2
    return 1.0, -q * (1.5 * c2 + c4), 1.5 * q * q * c4


def ligament(r, spacing):
    """x, y and stress over tension of the particles beside the ligament x = 0, up to three radii."""
    frame = r.frame()
    rows = zip(frame["reference_position_x"], frame["reference_position_y"], frame["cauchy_stress_xx"])
    return [(x, y, s / TENSION) for x, y, s in rows if x < 0.6 * spacing and y < 3 * RADIUS]


def stress_error(rows):
    """Root mean square, in tensions."""
    return math.sqrt(sum((s - sum(shapes(x, y))) ** 2 for x, y, s in rows) / len(rows))


def solve(M, b):
    """Gauss with pivots."""
    n = len(b)
    A = [list(row) + [v] for row, v in zip(M, b)]
    for i in range(n):
        p = max(range(i, n), key=lambda k: abs(A[k][i]))
        A[i], A[p] = A[p], A[i]
        for k in range(i + 1, n):
            A[k] = [a - A[k][i] / A[i][i] * c for a, c in zip(A[k], A[i])]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (A[i][n] - sum(A[i][k] * x[k] for k in range(i + 1, n))) / A[i][i]
    return x


def concentration(rows):
    """The stress at the side of the hole over the tension: particles carry the mean over their cells, none lies there. So
    the three functions are fitted by least squares, each with a factor of its own."""
    terms = [shapes(x, y) for x, y, _ in rows]
    M = [[sum(t[i] * t[j] for t in terms) for j in range(3)] for i in range(3)]
    b = [sum(t[i] * s for t, (_, _, s) in zip(terms, rows)) for i in range(3)]
    return sum(c * f for c, f in zip(solve(M, b), shapes(0.0, RADIUS)))


def error(r):
    return r.summary["errors"]["Kirsch"]["displacement_l2"]


class PlateWithHole(unittest.TestCase):
    def setUp(self):
        if result("kirsch", 0.04) is None:
            self.skipTest("built without CGAL's booleans")

    def test_displacements(self):
        for spacing in SPACINGS:
            self.assertLess(error(result("kirsch", spacing)), BOUNDS[spacing])

    def test_they_converge(self):
        for coarse, fine in zip(SPACINGS, SPACINGS[1:]):
            self.assertGreater(runs.order(error(result("kirsch", coarse)), error(result("kirsch", fine))), 1.5)

    def test_stress_along_the_ligament(self):
        rows = ligament(result("kirsch", 0.01), 0.01)
        self.assertLess(stress_error(rows), 0.035)
        self.assertLess(stress_error(rows), 0.3 * stress_error(ligament(result("kirsch", 0.04), 0.04)))

    def test_concentration_is_three(self):
        self.assertAlmostEqual(concentration(ligament(result("kirsch", 0.02), 0.02)), 3.0, delta=0.1)
        self.assertAlmostEqual(concentration(ligament(result("kirsch", 0.01), 0.01)), 3.0, delta=0.1)

    def test_finite_width_raises_it(self):
        """Howland's table has 3.14 for a hole of a fifth of the width, Heywood's formula 3.14."""
        expected = heywood(2 * RADIUS / WIDTH)
        self.assertAlmostEqual(expected, 3.14, delta=0.005)
        self.assertAlmostEqual(heywood(0.0), 3.0)
        ours = concentration(ligament(result("strip", 0.02), 0.02))
        self.assertAlmostEqual(ours, expected, delta=0.08)
        self.assertGreater(ours, concentration(ligament(result("kirsch", 0.02), 0.02)) + 0.08)

    def test_energy(self):
        for case in ("kirsch", "strip"):
            self.assertLess(abs(result(case, 0.02).summary["energy"]["relative_error"]), 1e-5)


def tearDownModule():
    if result("kirsch", 0.04) is None:
        return
    rows = [(f"spacing {h:g} m: relative L2 error of the displacements", "Kirsch", 0, f"{error(result('kirsch', h)):.3g}",
             f"{BOUNDS[h]:g}") for h in SPACINGS]
    for case, h, source, value in (("kirsch", 0.02, "Kirsch", 3.0), ("kirsch", 0.01, "Kirsch", 3.0),
                                   ("strip", 0.02, "Howland, Heywood", 3.14)):
        rows.append((f"{case}, spacing {h:g} m: stress at the hole over the tension", source, value,
                     f"{concentration(ligament(result(case, h), h)):.3f}", "0.1" if case == "kirsch" else "0.08"))
    runs.record("plate-with-hole", rows)


if __name__ == "__main__":
    runs.main()
