"""Free bodies keep their momenta: the beam of [D 8.3], the L-shaped block of [V 6.3] and a spinning cube.

Changes are the largest over the history (of the L-block: after its loads have gone, t >= 5 s) and relative
  - of linear momentum to sqrt(2 m E_kin), which is not below sum m |v|, with the largest kinetic energy;
  - of angular momentum to its own magnitude;
  - of energy to the largest total energy.
"""

import functools
import math
import unittest

import modes
import runs

MASS = {"free-beam": 6600.0, "l-block": 117e3, "spinning-cube": 1000.0}
LOADED_UNTIL = {"free-beam": 0.0, "l-block": 5.0, "spinning-cube": 0.0}
CONSERVING = ("delaunay", "consistent", "variational")
INTEGRATED = (("delaunay", "cell"), ("consistent", "cell"), ("variational", "cell"), ("consistent", "second-order"))
MOMENTUM_BOUND = 1e-12
ENERGY_BOUND = 1e-3


@functools.cache
def history(case, formulation, jitter=0.2, safety=0.3, integration="nodal"):
    settings = {"body.0.particles.jitter": jitter, "time.safety": safety} | modes.method(formulation, integration)
    return runs.run(f"{case}/{case}.toml", settings).history


def vectors(h, kind, first):
    return [tuple(h[kind + axis][i] for axis in "xyz") for i in range(first, len(h["t"]))]


def first_free_row(case, h):
    return next(i for i, t in enumerate(h["t"]) if t >= LOADED_UNTIL[case])


def largest_change(values):
    return max(math.dist(v, values[0]) for v in values)


def total_energy(h):
    return [sum(e) for e in zip(h["kinetic"], h["internal"], h["contact"])]


def linear_change(case, h):
    first = first_free_row(case, h)
    return largest_change(vectors(h, "p", first)) / math.sqrt(2.0 * MASS[case] * max(h["kinetic"][first:]))


def angular_change(case, h):
    l = vectors(h, "l", first_free_row(case, h))
    return largest_change(l) / math.hypot(*l[0])


def energy_change(case, h):
    energy = total_energy(h)[first_free_row(case, h):]
    return max(abs(e - energy[0]) for e in energy) / max(energy)


def ledger_error(h):
    """Energy in the body minus work of the loads, against the largest energy; the bodies start without strain."""
    energy = total_energy(h)
    return max(abs(e - w - energy[0]) for e, w in zip(energy, h["external_work"])) / max(energy)


class FreeBodies:
    """What every case shows; the classes below say which."""

    case = ""

    def test_momenta(self):
        for formulation in CONSERVING:
            for jitter in (0.0, 0.2):
                with self.subTest(formulation=formulation, jitter=jitter):
                    h = history(self.case, formulation, jitter)
                    self.assertLess(linear_change(self.case, h), MOMENTUM_BOUND)
                    self.assertLess(angular_change(self.case, h), MOMENTUM_BOUND)
                    self.assertLess(energy_change(self.case, h), ENERGY_BOUND)
                    self.assertLess(ledger_error(h), ENERGY_BOUND)

    def test_momenta_with_other_integrations(self):
        for formulation, integration in INTEGRATED:
            with self.subTest(formulation=formulation, integration=integration):
                h = history(self.case, formulation, integration=integration)
                self.assertLess(linear_change(self.case, h), MOMENTUM_BOUND)
                self.assertLess(angular_change(self.case, h), MOMENTUM_BOUND)
                self.assertLess(energy_change(self.case, h), ENERGY_BOUND)

    def test_energy_error_falls_with_the_square_of_the_step(self):
        for formulation in CONSERVING:
            with self.subTest(formulation=formulation):
                ratio = energy_change(self.case, history(self.case, formulation)) / energy_change(
                    self.case, history(self.case, formulation, safety=0.15))
                self.assertGreater(ratio, 3.5)
                self.assertLess(ratio, 4.6)

    def test_quasi_static_forces_do_not_keep_angular_momentum(self):
        """On regular particles, where the runs last: [V 42] at free boundaries has no potential."""
        h = history(self.case, "quasi-static", 0.0)
        self.assertLess(linear_change(self.case, h), MOMENTUM_BOUND)
        self.assertGreater(angular_change(self.case, h), 1e-4)

    def rows(self, source, published):
        """Rows of the table of results."""
        rows = []
        for formulation in CONSERVING:
            h = history(self.case, formulation)
            linear, angular, energy = (f(self.case, h) for f in (linear_change, angular_change, energy_change))
            ratio = energy / energy_change(self.case, history(self.case, formulation, safety=0.15))
            rows += [
                (f"{formulation}: relative change of linear momentum", source, published, linear, MOMENTUM_BOUND),
                (f"{formulation}: relative change of angular momentum", source, published, angular, MOMENTUM_BOUND),
                (f"{formulation}: relative change of energy", source, None, energy, ENERGY_BOUND),
                (f"{formulation}: its ratio to that with half the step (4: second order)", source, None, ratio, None),
            ]
        angular = angular_change(self.case, history(self.case, "quasi-static", 0.0))
        rows.append(("quasi-static, regular: relative change of angular momentum", source, None, angular, None))
        return rows


class FreeBeam(FreeBodies, unittest.TestCase):
    case = "free-beam"

    def test_initial_momenta_of_the_paper(self):
        """[D 8.3]: p1 = 8.802e4 kg m/s, l2 = 2.972e5 kg m2/s with masses at the vertices; exact 8.8e4 and 2.97e5."""
        h = history(self.case, "delaunay", 0.0)
        self.assertAlmostEqual(h["px"][0], 8.802e4, delta=5.0)
        self.assertAlmostEqual(h["ly"][0], 2.972e5, delta=50.0)
        for name in ("py", "pz", "lx"):
            self.assertLess(abs(h[name][0]), 1e-9)
        for formulation in ("consistent", "variational"):
            h = history(self.case, formulation, 0.0)
            self.assertAlmostEqual(h["px"][0], 8.8e4, delta=20.0)
            self.assertAlmostEqual(h["ly"][0], 2.97e5, delta=200.0)

    def test_record(self):
        h = history(self.case, "delaunay", 0.0)
        p, l = (largest_change(vectors(h, kind, 0)) for kind in "pl")
        runs.record(self.case, [
            ("delaunay, regular: p1 at the start [kg m/s]", "[D 8.3]", "8.802e4", f"{h['px'][0]:.4e}", None),
            ("delaunay, regular: l2 at the start [kg m2/s]", "[D 8.3]", "2.972e5", f"{h['ly'][0]:.4e}", None),
            ("delaunay, regular: change of linear momentum [kg m/s]", "[D 8.3]", 1e-10, p, MOMENTUM_BOUND * h["px"][0]),
            ("delaunay, regular: change of angular momentum [kg m2/s]", "[D 8.3]", 1e-9, l,
             MOMENTUM_BOUND * h["ly"][0]),
            *self.rows("[D 8.3]", None)])


class LBlock(FreeBodies, unittest.TestCase):
    case = "l-block"

    def test_momenta_that_the_loads_leave(self):
        """Opposite tractions leave no linear momentum; l tends to (3.91, 2.13, -1.36)e5 with the spacing (README)."""
        for formulation, bound in (("delaunay", 0.01), ("consistent", 0.01), ("variational", 0.04)):
            with self.subTest(formulation=formulation):
                h = history(self.case, formulation)
                self.assertLess(largest_change(vectors(h, "p", 0)), 1e-6)
                l = vectors(h, "l", first_free_row(self.case, h))[0]
                self.assertLess(math.dist(l, (3.91e5, 2.13e5, -1.363e5)) / math.hypot(*l), bound)

    def test_record(self):
        rows = []
        for formulation in CONSERVING:
            l = math.hypot(*vectors(history(self.case, formulation), "l", 0)[-1])
            rows.append((f"{formulation}: angular momentum after the loads [kg m2/s]", "[V 6.3]", None, l, None))
        runs.record(self.case, rows + self.rows("[V 6.3]", "constant"))


class SpinningCube(FreeBodies, unittest.TestCase):
    case = "spinning-cube"

    def test_angular_momentum_of_a_rigid_cube(self):
        """m / 6 times omega = (20, 20, 10) rad/s; collected masses miss some per cent of the inertia."""
        for formulation in CONSERVING:
            l = vectors(history(self.case, formulation), "l", 0)[0]
            for ours, rigid in zip(l, (1e4 / 3, 1e4 / 3, 5e3 / 3)):
                self.assertLess(abs(ours / rigid - 1.0), 0.04)

    def test_record(self):
        runs.record(self.case, self.rows("own case", None))


if __name__ == "__main__":
    runs.main()
