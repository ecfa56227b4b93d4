"""The swinging cantilever of [D 8.4] against a converged reference (tests/data/reference).

The error of a run is the relative L2 norm over 0..1 s of the path of one material point in the plane of motion,
sqrt(sum |x - x_ref|^2 / sum |x_ref - X|^2), at the reference's times. The point is the upper corner of the free end, or
for Voronoi particles the centre of the cell at that corner, where the reference has it (4, 8, 16 per metre).
"""

import functools
import math
import pathlib
import unittest

import modes
import runs

REFERENCE = runs.read_csv(pathlib.Path(__file__).resolve().parents[1] / "data/reference/cantilever.csv")[0]
CASE = "cantilever/cantilever.toml"
CONSERVING = ("delaunay", "consistent", "variational")
VARIANTS = [(formulation, jitter) for formulation in CONSERVING for jitter in (0.0, 0.2)]
BOUNDS = {"delaunay": 0.022, "consistent": 0.042, "variational": 0.06}  # at 8 per metre
# Largest errors of the path that are allowed to other integrations, regular and with 20% jitter.
INTEGRATED = {("delaunay", "cell", 8): (0.022, 0.006), ("consistent", "cell", 8): (0.006, 0.022),
              ("consistent", "second-order", 8): (0.005, 0.005), ("consistent", "second-order", 4): (0.01, 0.01),
              ("variational", "cell", 8): (0.006, 0.008), ("variational", "cell", 4): (0.025, 0.04)}
CELL_CENTRES = {4: "in8", 8: "in16", 16: "in32"}


def settings(formulation, per_metre, jitter, end=1.0):
    values = {"body.0.particles.spacing": 1.0 / per_metre, "body.0.particles.jitter": jitter, "time.end": end}
    if formulation == "delaunay":
        return values
    inside = 0.5 / per_metre
    values["probe.1.at"] = [6.0 - inside, 0.5 - inside, 0.5 - inside]
    return values | {"method.formulation": "voronoi", "method.boundary": formulation}


@functools.cache
def result(formulation, per_metre, jitter):
    return runs.run(CASE, settings(formulation, per_metre, jitter))


@functools.cache
def integrated_error(formulation, integration, per_metre, jitter):
    """Error of the path, with the default step."""
    more = modes.method(formulation, integration) | {"time.step": "auto-spectral", "time.safety": 0.8}
    history = runs.run(CASE, settings(formulation, per_metre, jitter) | more).history
    return path_error(history, formulation, per_metre)


def point(formulation, per_metre):
    """The probe and the reference's point that are compared."""
    if formulation == "delaunay" or per_metre not in CELL_CENTRES:
        return "corner", "corner_top"
    return "corner_cell", CELL_CENTRES[per_metre]


def deviations(history, formulation, per_metre, end=1.0):
    """Rows t, x1 - x1_ref, x3 - x3_ref, and the way |x_ref - X| of the reference."""
    probe, name = point(formulation, per_metre)
    x1, x3 = REFERENCE["x1_" + name], REFERENCE["x3_" + name]
    rows = []
    for t, r1, r3 in zip(REFERENCE["t"], x1, x3):
        if t <= min(end, history["t"][-1]) + 1e-9:
            ours = [runs.interpolate(t, history["t"], history[f"{probe}.{axis}"]) for axis in "xz"]
            rows.append((t, ours[0] - r1, ours[1] - r3, math.hypot(r1 - x1[0], r3 - x3[0])))
    return rows


def path_error(history, formulation, per_metre):
    rows = deviations(history, formulation, per_metre)
    return math.sqrt(sum(a * a + b * b for _, a, b, _ in rows) / sum(way * way for *_, way in rows))


def rms_height(history, formulation, per_metre):
    """Root mean square error of x3 over 0..1 s (m)."""
    rows = deviations(history, formulation, per_metre)
    return math.sqrt(sum(b * b for _, _, b, _ in rows) / len(rows))


def contact_share(history, t=0.5):
    """Part of the strain energy that is in the bonds, at largest deflection."""
    contact, internal = (runs.interpolate(t, history["t"], history[name]) for name in ("contact", "internal"))
    return contact / (contact + internal)


def highest(history):
    """Largest x3 of the corner and its time."""
    return max(zip(history["corner.z"], history["t"]))


@functools.cache
def quasi_static_run():
    """Message and last row's time of the run that does not survive."""
    process, folder = runs.execute(CASE, settings("quasi-static", 8, 0.2))
    return process, runs.read_csv(pathlib.Path(folder) / "history.csv")[0]["t"][-1]


class Cantilever(unittest.TestCase):
    def for_each_variant(self, check, per_metre=8):
        for formulation, jitter in VARIANTS:
            with self.subTest(formulation=formulation, jitter=jitter):
                check(formulation, jitter, result(formulation, per_metre, jitter).history)

    def test_path_at_8_per_metre(self):
        def check(formulation, _, h):
            self.assertLess(path_error(h, formulation, 8), BOUNDS[formulation])

        self.for_each_variant(check)

    def test_largest_deflection(self):
        """Reference: 3.397 m at 0.459 s; in the paper it comes near 0.5 s."""

        def check(_formulation, _jitter, h):
            height, time = highest(h)
            self.assertAlmostEqual(height, 3.397, delta=0.15)
            self.assertAlmostEqual(time, 0.46, delta=0.02)

        self.for_each_variant(check)

    def test_errors_fall_with_the_spacing(self):
        def check(formulation, jitter, h):
            coarse, fine = (path_error(result(formulation, n, jitter).history, formulation, n) for n in (2, 8))
            self.assertLess(fine, coarse / 2.5)
            if formulation == "consistent":
                middle = path_error(h, formulation, 4)
                self.assertLess(middle, coarse / 1.7)
                self.assertLess(fine, middle / 2.5)

        self.for_each_variant(check, 4)

    def test_delaunay_is_too_stiff_at_2_per_metre(self):
        """[D 8.4]: at the lowest density the period is somewhat too small; from 4 per metre on results agree."""
        self.assertLess(highest(result("delaunay", 2, 0.0).history)[1], 0.44)
        self.assertLess(path_error(result("delaunay", 4, 0.0).history, "delaunay", 4), 0.03)

    def test_bonds_hold_little_energy_and_less_as_the_spacing_falls(self):
        def check(formulation, jitter, h):
            coarse, fine = (contact_share(result(formulation, n, jitter).history) for n in (2, 8))
            self.assertLess(contact_share(h), coarse)
            self.assertLess(fine, contact_share(h))
            self.assertLess(fine, 0.02)

        self.for_each_variant(check, 4)

    def test_energy(self):
        """[V 43] leaves the wall's part out of the gradient, so its energy errs a little on irregular particles."""

        def check(formulation, jitter, h):
            bound = 5e-3 if formulation == "variational" and jitter > 0.0 else 1e-4
            self.assertLess(max(map(abs, h["energy_error"])), bound)

        self.for_each_variant(check)

    def test_quasi_static_fails_on_irregular_particles(self):
        """Its forces at free boundaries keep neither angular momentum nor energy; before 1 s a cell is inverted."""
        process, stopped = quasi_static_run()
        self.assertEqual(process.returncode, 5, process.stderr)
        self.assertIn("inverted", process.stderr)
        self.assertGreater(stopped, 0.3)
        self.assertLess(stopped, 1.0)

    def test_integrations(self):
        for method, bounds in INTEGRATED.items():
            for jitter, bound in zip((0.0, 0.2), bounds):
                with self.subTest(method=method, jitter=jitter):
                    self.assertLess(integrated_error(*method, jitter), bound)

    def test_record(self):
        rows = []
        for (formulation, integration, n), bounds in INTEGRATED.items():
            for jitter, bound in zip((0.0, 0.2), bounds):
                error = integrated_error(formulation, integration, n, jitter)
                name = f"{formulation}, {integration}, {n} per metre, jitter {jitter:g}: error of the path"
                rows.append((name, "ours", None, error, bound))
        for n in (2, 4, 8):
            for formulation, jitter in VARIANTS:
                h = result(formulation, n, jitter).history
                name = f"{formulation}, {n} per metre, jitter {jitter:g}"
                bound = BOUNDS[formulation] if n == 8 else None
                rows.append((f"{name}: error of the path", "[D 8.4]", None, path_error(h, formulation, n), bound))
                if n == 8:
                    rows += [(f"{name}: RMS error of x3 [m]", "[D 8.4]", None, rms_height(h, formulation, n), None),
                             (f"{name}: share of the bonds at 0.5 s", "[D 8.4]", None, contact_share(h), None)]
        time = highest(result("delaunay", 8, 0.0).history)[1]
        rows.append(("delaunay, 8 per metre: time of largest deflection [s]", "[D 8.4]", 0.5, time, None))
        stopped = quasi_static_run()[1]
        rows.append(("quasi-static, 8 per metre, jitter 0.2: stops at [s]", "[D 8.4]", None, stopped, None))
        runs.record("cantilever", rows)


if __name__ == "__main__":
    runs.main()
