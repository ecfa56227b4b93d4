"""Closed solutions of linear elasticity on curved solids: Lame's sphere and cylinder, Saint-Venant's elliptic bar."""

import functools
import unittest

import runs

# Errors of the displacements (relative, L2) on two spacings, and what they may be.
BOUNDS = {
    "thick-walled/sphere": {"voronoi": (0.2, 0.1, 0.045), "delaunay": (0.2, 0.1, 0.022)},
    "thick-walled/cylinder": {"voronoi": (0.2, 0.1, 0.030), "delaunay": (0.1, 0.05, 0.0025)},
    "torsion-bar/torsion-bar": {"voronoi": (0.05, 0.1 / 3, 0.0010), "delaunay": (0.05, 0.1 / 3, 0.0030)},
}
TORQUE = 3866.5  # of the bar [N m]


@functools.cache
def result(case, formulation, spacing):
    """None where this build cannot make the body."""
    process, folder = runs.execute(f"{case}.toml", {"method.formulation": formulation, "body.0.particles.spacing": spacing})
    if "TESSERA_WITH_CGAL" in process.stderr:
        return None
    if process.returncode != 0:
        raise AssertionError(f"{case}: {process.stderr.strip()}")
    return runs.Result(folder)


def error(r):
    return next(iter(r.summary["errors"].values()))["displacement_l2"]


def available():
    """Case, formulation, results on the coarse and on the fine spacing, spacings' ratio, bound."""
    for case, formulations in BOUNDS.items():
        for formulation, (coarse, fine, bound) in formulations.items():
            r = [result(case, formulation, spacing) for spacing in (coarse, fine)]
            if r[0] is not None:
                yield case, formulation, r, coarse / fine, bound


class Elasticity(unittest.TestCase):
    def setUp(self):
        if result("thick-walled/sphere", "voronoi", 0.2) is None:
            self.skipTest("built without CGAL's booleans and meshes")

    def test_errors(self):
        for case, formulation, (_, fine), _, bound in available():
            self.assertLess(error(fine), bound, (case, formulation))
            self.assertLess(abs(fine.summary["energy"]["relative_error"]), 1e-5)

    def test_convergence(self):
        for case, formulation, (coarse, fine), ratio, _ in available():
            self.assertGreater(runs.order(error(coarse), error(fine), ratio), 1.4, (case, formulation))

    def test_torque(self):
        for formulation in ("voronoi", "delaunay"):
            r = result("torsion-bar/torsion-bar", formulation, 0.1 / 3)
            self.assertAlmostEqual(-r.history["tool.tz"][-1] / TORQUE, 1.0, delta=0.01)
            self.assertLess(abs(r.history["tool.fx"][-1]), 1e-2)


def tearDownModule():
    rows = []
    for case, formulation, (_, fine), _, bound in available():
        rows.append((f"{case.split('/')[1]}, {formulation}: relative L2 error", "closed solution", 0, f"{error(fine):.3g}",
                     f"{bound:g}"))
    if rows:
        runs.record("elasticity", rows)


if __name__ == "__main__":
    runs.main()
