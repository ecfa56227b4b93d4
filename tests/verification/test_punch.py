"""The punches of [V] section 6.4 (Voronoi) and [D] section 8.5 (Delaunay).

Hourglassing is measured by the part of the displacement that alternates from particle to particle. On the bond from a to b
the local displacement u_ab = x_ab - (F_a + F_b)/2 X_ab vanishes for linear motion on any arrangement; where displacements
+h, -h, +h alternate along a line, F sees nothing, and u_ab is -2h, +2h, -2h. So

    h_a = |u_ba - u_ac| / 4     for neighbours b, a, c in a line of the lattice

is the amplitude of alternation at a; its root mean square over all lines, in spacings, is what is bounded. The same run
without contact stiffness must exceed the bound, or else it would bound nothing.
"""

import math
import unittest

import runs

VORONOI = "punch-voronoi/punch.toml"
COUNTS = (21, 11, 3)
AMPLITUDE = {15: 0.02, 30: 0.04}  # largest rms amplitude of alternation, in spacings
JITTER = 0.25
MOTION = ["reference_position", "position", "deformation_gradient", "J"]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def vectors(frame, name):
    return list(zip(*(frame[f"{name}_{axis}"] for axis in "xyz")))


def tensors(frame, name):
    return list(zip(*(frame[f"{name}_{i}{j}"] for i in "xyz" for j in "xyz")))


def local_displacement(X, x, F, a, b):
    """u_ab in units of the bond's length."""
    branch = [q - p for p, q in zip(X[a], X[b])]
    mean = [0.5 * (p + q) for p, q in zip(F[a], F[b])]
    affine = [dot(mean[3 * i : 3 * i + 3], branch) for i in range(3)]
    return [(q - p - y) / math.hypot(*branch) for p, q, y in zip(x[a], x[b], affine)]


def lines(counts):
    """Triples of particles that follow each other along the three directions of a lattice (x runs fastest)."""
    nx, ny, nz = counts
    strides = (1, nx, nx * ny)
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                a = i + nx * (j + ny * k)
                for place, count, stride in zip((i, j, k), counts, strides):
                    if 0 < place < count - 1:
                        yield a - stride, a, a + stride


def alternation(frame, counts):
    """Root mean square amplitude of the alternating displacement, in spacings."""
    X, x = vectors(frame, "reference_position"), vectors(frame, "position")
    F = tensors(frame, "deformation_gradient")
    squares = []
    for b, a, c in lines(counts):
        before, after = local_displacement(X, x, F, b, a), local_displacement(X, x, F, a, c)
        squares.append(sum((p - q) ** 2 for p, q in zip(before, after)) / 16.0)
    return math.sqrt(sum(squares) / len(squares))


class Punched:
    """A run of the Voronoi punch with its frames at 15% and 30%."""

    def __init__(self, boundary="consistent", jitter=0.0, seed=1, contact=1.0):
        self.result = runs.run(VORONOI, {
            "method.boundary": boundary, "body.0.particles.jitter": jitter, "body.0.particles.seed": seed,
            "material.0.contact.normal": contact, "material.0.contact.tangential": contact,
            "output.fields.format": "csv", "output.fields.cells": False, "output.fields.every": "0.75 s",
            "output.fields.quantities": MOTION})
        self.frames = {15: self.result.frame(1), 30: self.result.frame(2)}
        self.alternation = {percent: alternation(frame, COUNTS) for percent, frame in self.frames.items()}
        self.smallest_J = min(min(frame["J"]) for frame in self.frames.values())
        energy = self.result.summary["energy"]
        self.contact_share = energy["contact"] / (energy["contact"] + energy["internal"])
        self.energy_error = abs(energy["relative_error"])
        self.force = 1e-3 * self.result.history["punch.fy"][-1]


# (boundary, jitter, seed); the regular arrangement is the same for consistent and variational.
VARIANTS = (("consistent", 0.0, 1), ("quasi-static", 0.0, 1), ("consistent", JITTER, 1), ("consistent", JITTER, 2),
            ("consistent", JITTER, 3), ("variational", JITTER, 1), ("quasi-static", JITTER, 1))


class VoronoiPunch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.runs = {variant: Punched(*variant) for variant in VARIANTS}

    @classmethod
    def tearDownClass(cls):
        everything = cls.runs.values()
        regular = cls.runs["consistent", 0.0, 1]
        J = min(run.smallest_J for run in everything)
        alternating = "regular and irregular, three boundary treatments, largest"
        runs.record("punch-voronoi", [
            ("hourglass amplitude at 15% [spacings], " + alternating, "[V] 6.4", "no pattern",
             max(run.alternation[15] for run in everything), AMPLITUDE[15]),
            ("hourglass amplitude at 30% [spacings], " + alternating, "[V] 6.4", "no pattern",
             max(run.alternation[30] for run in everything), AMPLITUDE[30]),
            ("smallest J", "[V] 6.4", None, J, "> 0.5"),
            ("contact share of the elastic energy at 30%, regular", "[V] 6.4", None, regular.contact_share, 0.1),
            ("force on the punch at 30% [kN], regular", "[V] 6.4", None, regular.force, None)])

    def test_has_no_hourglass_pattern(self):
        for variant, run in self.runs.items():
            for percent, bound in AMPLITUDE.items():
                with self.subTest(variant=variant, percent=percent):
                    self.assertLess(run.alternation[percent], bound)

    def test_the_measure_finds_the_pattern_of_a_run_without_contact_stiffness(self):
        loose = Punched(contact=0.0)
        for percent, bound in AMPLITUDE.items():
            self.assertGreater(loose.alternation[percent], 5.0 * bound)

    def test_no_cell_is_near_collapse(self):
        for variant, run in self.runs.items():
            with self.subTest(variant=variant):
                self.assertGreater(run.smallest_J, 0.5)

    def test_bonds_hold_little_of_the_energy(self):
        for variant, run in self.runs.items():
            with self.subTest(variant=variant):
                self.assertLess(run.contact_share, 0.1)

    def test_the_energy_ledger_closes(self):
        for variant, run in self.runs.items():
            if variant[0] == "consistent":
                with self.subTest(variant=variant):
                    self.assertLess(run.energy_error, 1e-9)

    def test_boundary_treatments_and_arrangements_agree_on_the_force(self):
        regular = self.runs["consistent", 0.0, 1].force
        for variant, run in self.runs.items():
            with self.subTest(variant=variant):
                self.assertAlmostEqual(run.force / regular, 1.0, delta=0.04)

    def test_a_regular_arrangement_keeps_its_symmetry(self):
        history = self.runs["consistent", 0.0, 1].result.history
        self.assertLess(max(map(abs, history["punch.fx"])), 1e-9 * max(history["punch.fy"]))


DELAUNAY = "punch-delaunay/punch.toml"
DENSITIES = (3, 6, 9, 12)  # per mm
QUICK = 2.5e-4  # a quarter of the time of the case file [s]


def smooth_step(s):
    return 0.5 * s**3 * (10.0 - 15.0 * s + 6.0 * s**2)


class Pressed:
    """A run of the quarter of [D] section 8.5 in the time `end`."""

    def __init__(self, density, formulation="delaunay", end=QUICK):
        count = density + 1 if formulation == "delaunay" else density
        s = f"(t/{end})"
        self.result = runs.run(DELAUNAY, {
            "method.formulation": formulation, "body.0.particles.counts": [count] * 3, "time.end": end,
            "boundary.2.displacement": [0, 0, f"-0.5e-3 * {s}^3 * (10 - 15*{s} + 6*{s}^2)"],
            "output.fields.cells": False, "output.fields.format": "csv", "output.fields.every": end,
            "output.fields.quantities": MOTION, "output.history.every": end / 200})
        self.count = count
        history = self.result.history
        self.depth = [smooth_step(t / end) for t in history["t"]]
        self.forces = [4.0 * f for f in history["punch.fz"]]
        self.kinetic_share = max(
            kinetic / (internal + contact)
            for depth, kinetic, internal, contact in zip(self.depth, *(history[n] for n in ("kinetic", "internal", "contact")))
            if depth > 0.02)

    def force(self, depth):
        return runs.interpolate(depth, self.depth, self.forces)


class DelaunayPunch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.runs = {density: Pressed(density) for density in DENSITIES}
        cls.voronoi = {density: Pressed(density, "voronoi") for density in (6, 12)}

    @classmethod
    def tearDownClass(cls):
        rows = [(f"force at 0.5 mm, {density} per mm [N]", "[D] 8.5, figure 11", None, run.forces[-1], None)
                for density, run in cls.runs.items()]
        rows.append(("hourglass amplitude at 0.5 mm, 12 per mm [spacings]", "[D] 8.5", "no pattern",
                     cls.hourglass(cls.runs[12]), AMPLITUDE[30]))
        rows.append(("force at 0.1 mm extrapolated to no spacing, delaunay over voronoi", "", None,
                     cls.limit(cls.runs, 0.1) / cls.limit(cls.voronoi, 0.1), "1 +- 0.02"))
        runs.record("punch-delaunay", rows)

    @staticmethod
    def hourglass(run):
        return alternation(run.result.frame(-1), [run.count] * 3)

    @staticmethod
    def limit(family, depth):
        """The force at no spacing: next to the punch's edge errors are of first order in the spacing."""
        return 2.0 * family[12].force(depth) - family[6].force(depth)

    def test_curves_converge(self):
        """The force falls with the spacing, about in proportion: spacings change by 1/6, 1/18, 1/36 mm, so each change of
        the force is about 1/3 and then 1/2 of the one before."""
        for depth in (0.05, 0.1, 0.2, 0.3, 0.4, 0.5):
            with self.subTest(depth=depth):
                changes = [self.runs[a].force(depth) - self.runs[b].force(depth) for a, b in zip(DENSITIES, DENSITIES[1:])]
                self.assertGreater(changes[2], 0.0)
                self.assertLess(changes[1], 0.4 * changes[0])
                self.assertLess(changes[2], 0.6 * changes[1])
                self.assertLess(changes[2], 0.06 * self.runs[12].force(depth))

    def test_both_formulations_converge_to_the_same_force(self):
        for depth in (0.05, 0.1):
            with self.subTest(depth=depth):
                self.assertAlmostEqual(self.limit(self.runs, depth) / self.limit(self.voronoi, depth), 1.0, delta=0.02)

    def test_the_time_of_loading_does_not_matter(self):
        slow = Pressed(6, end=2.0 * QUICK)
        quick = self.runs[6]
        largest = max(abs(quick.force(d) - slow.force(d)) for d in (0.01 * i for i in range(2, 51)))
        self.assertLess(largest, 1e-3 * quick.forces[-1])
        for run in self.runs.values():
            self.assertLess(run.kinetic_share, 5e-3)

    def test_has_no_hourglass_pattern(self):
        """With 3 per mm the punch covers a single spacing, and nothing is smooth over three particles."""
        for density in (6, 9, 12):
            with self.subTest(density=density):
                self.assertLess(self.hourglass(self.runs[density]), AMPLITUDE[30])

    def test_the_energy_ledger_closes(self):
        for density, run in self.runs.items():
            with self.subTest(density=density):
                self.assertLess(abs(run.result.summary["energy"]["relative_error"]), 1e-6)


if __name__ == "__main__":
    runs.main()
