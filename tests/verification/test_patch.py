"""Patch tests A, B, C of [D 8.1] and [V 6.1], and ours on a block with a re-entrant edge.

A linear field must come out whatever the arrangement of the particles. A: forces vanish in it. B: it follows from the
displacement of the boundary. C: it follows from its tractions. Errors of B and C are of single particles, at rest.
"""

import functools
import os
import pathlib
import tempfile
import unittest

import runs

EXACT = "exact"  # name of the reference in the case files
ROUND_OFF = 1e-14  # of the size of the body: allowed error of the displacement
FORCE_BOUND = 1e-10  # of the largest force on a piece of the boundary
# Folder: size [m], spacing [m], settings of the formulations that must pass.
CASES = {
    "patch-delaunay": (0.01, 0.01 / 3.0, {"delaunay": {}}),
    "patch-voronoi": (1.0, 1.0 / 3.0, {name: {"method.boundary": name} for name in ("consistent", "quasi-static")}),
    "patch-l-block": (10.0, 1.0, {"consistent": {}, "delaunay": {"method.formulation": "delaunay"},
                                  "quasi-static": {"method.boundary": "quasi-static"}}),
}
# Forces of quasi-static at loaded faces have no potential, and the long block flutters unless it is damped more.
DAMPED = {("patch-l-block", "quasi-static", "c"): {"time.damping": 4.0, "time.end": 200.0}}
VARIATIONAL = {"method.boundary": "variational"}
WILD = {"body.0.particles.jitter": 0.4, "body.0.particles.seed": 3}
PUBLISHED = {"patch-delaunay": ("[D Table 1]", "2.8e-11 N", "8.4e-16 mm", "2.7e-15 mm"),
             "patch-voronoi": ("[V Table 1]", "1.6e-10 N", "3.1e-16 mm", "2.1e-16 mm"),
             "patch-l-block": ("ours", None, None, None)}
VARIANTS = [(folder, name) for folder, (_, _, passing) in CASES.items() for name in passing]


@functools.cache
def result(folder, name, test, wild=False):
    settings = CASES[folder][2].get(name, VARIATIONAL)
    more = DAMPED.get((folder, name, test), {}) | (WILD if wild else {})
    return runs.run(f"{folder}/{test}.toml", settings | more)


def error(r):
    """Largest error of the displacement of a particle (m)."""
    return r.summary["errors"][EXACT]["displacement_max"]


def residual(r):
    """Largest force on a particle that is free to move (N)."""
    return r.summary["max_force_residual"]


def largest_boundary_force(r, spacing):
    """Force (N) on a face of one spacing squared across an axis, where the stress is largest."""
    frame = r.frame()
    columns = [[frame[f"first_piola_kirchhoff_{i}{j}"] for i in "xyz"] for j in "xyz"]
    tractions = [sum(c * c for c in T) ** 0.5 for P in columns for T in zip(*P)]
    return spacing**2 * max(tractions)


@functools.cache
def exact_state_of_test_c():
    """Runs [V]'s test C with the full load on the exact field at once, for its forces."""
    text = (runs.EXAMPLES / "patch-voronoi/c.toml").read_text().replace("min(t/5, 1)", "1")
    field = text[text.index("[[reference]]"):].split("displacement = ")[1]
    with tempfile.TemporaryDirectory() as folder:
        case = pathlib.Path(folder, "c.toml")
        case.write_text(f"{text}\n[[initial]]\ndisplacement = {field}")
        return {name: runs.run(os.fspath(case), {"method.boundary": name, "time.end": 0})
                for name in ("consistent", "quasi-static", "variational")}


class Patch(unittest.TestCase):
    def for_each_variant(self, check):
        for folder, name in VARIANTS:
            with self.subTest(case=folder, formulation=name):
                check(folder, name, *CASES[folder][:2])

    def test_a(self):
        """The forces of the exact field vanish."""

        def check(folder, name, size, spacing):
            for wild in (False, True):
                r = result(folder, name, "a", wild)
                self.assertLess(error(r), 1e-15 * size)
                self.assertGreater(largest_boundary_force(r, spacing), 100.0)
                self.assertLess(residual(r), FORCE_BOUND * largest_boundary_force(r, spacing))

        self.for_each_variant(check)

    def test_b(self):
        """The particles follow the boundary."""

        def check(folder, name, size, _spacing):
            self.assertLess(error(result(folder, name, "b")), ROUND_OFF * size)

        self.for_each_variant(check)

    def test_c(self):
        """The particles follow the tractions."""

        def check(folder, name, size, _spacing):
            for wild in (False, True) if (folder, name, "c") not in DAMPED else (False,):
                self.assertLess(error(result(folder, name, "c", wild)), ROUND_OFF * size)

        self.for_each_variant(check)

    def test_variational_passes_a_and_b(self):
        a, b = (result("patch-voronoi", "variational", test) for test in "ab")
        self.assertLess(residual(a), FORCE_BOUND * largest_boundary_force(a, 1.0 / 3.0))
        self.assertLess(error(b), ROUND_OFF)

    def test_variational_fails_c(self):
        """A known failure, on regular particles too: [V 43] spreads the stress at a loaded face over the neighbours,
        while its traction acts on the one particle [V 35]."""
        for off in variational_errors_of_test_c():
            self.assertGreater(off, 1e-4)
            self.assertLess(off, 1e-2)

    def test_forces_of_test_c_at_the_exact_field(self):
        states = exact_state_of_test_c()
        scale = largest_boundary_force(states["consistent"], 1.0 / 3.0)
        for name in ("consistent", "quasi-static"):
            self.assertLess(residual(states[name]), FORCE_BOUND * scale)
        self.assertGreater(residual(states["variational"]), 0.1 * scale)


@functools.cache
def variational_errors_of_test_c():
    """On the example's particles, and on regular ones (m)."""
    regular = runs.run("patch-voronoi/c.toml", VARIATIONAL | {"body.0.particles.jitter": 0})
    return error(result("patch-voronoi", "variational", "c")), error(regular)


def rows_of(folder, name):
    """Rows of the table of results for the three tests of a formulation."""
    size, spacing, _ = CASES[folder]
    source, *published = PUBLISHED[folder]
    a, b, c = (result(folder, name, test) for test in "abc")
    force = FORCE_BOUND * largest_boundary_force(a, spacing)
    limit = f"{1e3 * ROUND_OFF * size:.2g} mm"
    return [(f"{name}, test A: largest force", source, published[0], f"{residual(a):.2g} N", f"{force:.2g} N"),
            (f"{name}, test B: largest error", source, published[1], f"{1e3 * error(b):.2g} mm", limit),
            (f"{name}, test C: largest error", source, published[2], f"{1e3 * error(c):.2g} mm", limit)]


def known_failure():
    force = residual(exact_state_of_test_c()["variational"])
    irregular, regular = variational_errors_of_test_c()
    return [("variational, test C: largest force at the exact field (known failure)", "[V 43]", None,
             f"{force:.3g} N", None),
            ("variational, test C: largest error (known failure)", "[V 43]", None, f"{1e3 * irregular:.2g} mm",
             None),
            ("variational, test C on regular particles: largest error (known failure)", "[V 43]", None,
             f"{1e3 * regular:.2g} mm", None)]


def tearDownModule():
    for folder, (_, _, passing) in CASES.items():
        rows = [row for name in passing for row in rows_of(folder, name)]
        runs.record(folder, rows + (known_failure() if folder == "patch-voronoi" else []))


if __name__ == "__main__":
    runs.main()
