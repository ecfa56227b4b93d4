"""Linear modes at rest: frequencies of a beam, six zero modes of free bodies, no mode that grows."""

import functools
import unittest

import modes
import runs

# Largest relative errors at 4 particles per metre: free bending, free torsion, clamped bending; regular, 20% jitter.
BEAM_BOUNDS = {
    ("delaunay", "nodal"): ((0.022, 0.016, 0.002), (0.031, 0.024, 0.013)),
    ("consistent", "nodal"): ((0.028, 0.032, 0.028), (0.041, 0.016, 0.043)),
    ("delaunay", "cell"): ((0.007, 0.017, 0.030), (0.004, 0.008, 0.017)),
    ("consistent", "cell"): ((0.007, 0.080, 0.008), (0.008, 0.065, 0.009)),
    ("consistent", "second-order"): ((0.004, 0.047, 0.004), (0.004, 0.059, 0.003)),
    ("variational", "nodal"): ((0.028, 0.032, 0.028), (0.064, 0.015, 0.065)),
}
POTENTIALS = [("delaunay", "nodal"), ("consistent", "nodal"), ("variational", "nodal"), ("delaunay", "cell"),
              ("consistent", "cell"), ("variational", "cell"), ("consistent", "second-order")]
CUBE = "spinning-cube/spinning-cube.toml"
ROUND_OFF = 1e-4  # frequency of a zero mode over the highest


@functools.cache
def beam_errors(formulation, integration, condition, jitter):
    settings = modes.method(formulation, integration) | modes.beam(condition, 4, jitter)
    found = modes.program(modes.BEAM, modes.ENOUGH[condition], settings)
    return modes.errors(found, condition)


def three_errors(formulation, integration, jitter):
    free, fixed = (beam_errors(formulation, integration, condition, jitter) for condition in ("free", "fixed"))
    return free["bending"], free["torsion"], fixed["bending"]


class Beam(unittest.TestCase):
    def test_frequencies(self):
        for (formulation, integration), bounds in BEAM_BOUNDS.items():
            for jitter, limits in zip((0.0, 0.2), bounds):
                with self.subTest(formulation=formulation, integration=integration, jitter=jitter):
                    for error, limit in zip(three_errors(formulation, integration, jitter), limits):
                        self.assertLess(abs(error), limit)

    def test_record(self):
        rows = []
        for (formulation, integration), bounds in BEAM_BOUNDS.items():
            for jitter, limits in zip((0.0, 0.2), bounds):
                names = ("free bending", "free torsion", "clamped bending")
                for name, error, limit in zip(names, three_errors(formulation, integration, jitter), limits):
                    rows.append((f"{formulation}, {integration}, jitter {jitter:g}, 4 per metre: error of {name}",
                                 "spectral elements", 0, error, limit))
        runs.record("modes", rows)


class FreeCubes(unittest.TestCase):
    def test_six_zero_modes_and_none_that_grows(self):
        for formulation, integration in POTENTIALS:
            for poisson in (0.3, 0.49):
                for seed in (1, 2):
                    with self.subTest(formulation=formulation, integration=integration, poisson=poisson, seed=seed):
                        self.check(modes.program(CUBE, modes.RIGID + 2, modes.method(formulation, integration) | {
                            "body.0.particles.spacing": 0.25, "body.0.particles.jitter": 0.25,
                            "body.0.particles.seed": seed, "material.0.poisson": poisson}))

    def check(self, found):
        omega = [modes.frequency(m) / found["largest_omega"] for m in found["modes"]]
        self.assertEqual(found["negative"], 0)
        self.assertLess(found["asymmetry"], 1e-9)
        self.assertLess(max(map(abs, omega[:modes.RIGID])), ROUND_OFF)
        self.assertGreater(omega[modes.RIGID], 100.0 * ROUND_OFF)

    def test_the_force_without_a_potential_fails(self):
        """[V 42] at free boundaries: an unsymmetric stiffness with too few zero modes, which this test would show."""
        found = modes.program(CUBE, modes.RIGID + 2, modes.method("quasi-static") | {
            "body.0.particles.spacing": 0.25, "body.0.particles.jitter": 0.25})
        self.assertGreater(found["asymmetry"], 1e-3)


if __name__ == "__main__":
    runs.main()
