"""The bending column of Aguirre, Gil, Bonet and Arranz Carreno (2014) with nu = 0.45, against spectral elements
(tests/data/reference/bending_column.csv, scripts/spectral_column.py). The error is that of test_cantilever.py.
"""

import functools
import math
import pathlib
import unittest

import modes
import runs

CASE = "bending-column/bending-column.toml"
REFERENCE = runs.read_csv(pathlib.Path(__file__).resolve().parents[1] / "data/reference/bending_column.csv")[0]
CELL_CENTRES = {4: "in8", 8: "in16"}
# Formulation, integration, particles per metre: largest error of the path.
BOUNDS = {("consistent", "nodal", 4): 0.075, ("consistent", "cell", 4): 0.045, ("consistent", "second-order", 4): 0.03,
          ("consistent", "cell", 8): 0.006}


@functools.cache
def history(formulation, integration, per_metre):
    inside = 0.5 / per_metre
    return runs.run(CASE, modes.method(formulation, integration) | {
        "body.0.particles.spacing": 1.0 / per_metre, "probe.1.at": [6.0 - inside, 0.5 - inside, 0.5 - inside]}).history


def path_error(formulation, integration, per_metre):
    """Relative L2 norm over 0..1 s of the path of the corner, or of the centre of the cell there, in the plane of motion."""
    h = history(formulation, integration, per_metre)
    probe, name = ("corner", "corner") if formulation == "delaunay" else ("corner_cell", CELL_CENTRES[per_metre])
    x1, x3 = REFERENCE["x1_" + name], REFERENCE["x3_" + name]
    errors = ways = 0.0
    for t, r1, r3 in zip(REFERENCE["t"], x1, x3):
        ours = [runs.interpolate(t, h["t"], h[f"{probe}.{axis}"]) for axis in "xz"]
        errors += (ours[0] - r1) ** 2 + (ours[1] - r3) ** 2
        ways += (r1 - x1[0]) ** 2 + (r3 - x3[0]) ** 2
    return math.sqrt(errors / ways)


class BendingColumn(unittest.TestCase):
    def test_path(self):
        for method, bound in BOUNDS.items():
            with self.subTest(method=method):
                self.assertLess(path_error(*method), bound)

    def test_integrations_are_ordered(self):
        nodal, cell, quadratic = (path_error("consistent", i, 4) for i in ("nodal", "cell", "second-order"))
        self.assertLess(cell, nodal)
        self.assertLess(quadratic, cell)

    def test_largest_deflection(self):
        """Reference: 3.379 m at 0.45 s."""
        h = history("consistent", "second-order", 4)
        height, time = max(zip(h["corner.z"], h["t"]))
        self.assertAlmostEqual(height, 3.379, delta=0.04)
        self.assertAlmostEqual(time, 0.45, delta=0.01)

    def test_energy(self):
        for method in BOUNDS:
            self.assertLess(max(map(abs, history(*method)["energy_error"])), 1e-4)

    def test_record(self):
        runs.record("bending-column", [
            (f"{', '.join(method[:2])}, {method[2]} per metre: error of the path", "spectral elements", None, path_error(*method),
             bound) for method, bound in BOUNDS.items()])


if __name__ == "__main__":
    runs.main()
