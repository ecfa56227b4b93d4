"""Every example with the step of the papers (auto, safety 0.3) and with the spectral one (the default): the same
results with fewer steps, for less than two evaluations of the forces in a hundred steps.

`test_time_step.py --table` prints the table of docs/performance.md.
"""

import functools
import sys
import unittest

import runs

BY_BONDS = {"time.step": "auto", "time.safety": 0.3}
SPECTRAL = {"time.step": "auto-spectral", "time.safety": 0.8}
SHORT = 300  # steps; shorter runs take the fewest evaluations of an estimate, whatever their share
FEWEST = 6
# How far a probe may move, relative to its largest value so far. A beam that swings freely at large strains adds up the
# error of its phase.
PROBES = {"cantilever/cantilever.toml": 5e-4, "twisting-column/twisting-column.toml": 1.5e-3,
          "bending-column/bending-column.toml": 5e-4}
# Runs of few long waves, which need short steps to be accurate: their case files ask for "auto".
WAVES = {"swinging-cube-delaunay/swinging-cube.toml": 0.02, "swinging-cube-voronoi/swinging-cube.toml": 0.02}
# Errors of the spacing, hardly of the step, against closed solutions.
AT_REST = {"thick-walled/sphere.toml": 1e-5, "thick-walled/cylinder.toml": 1e-5, "torsion-bar/torsion-bar.toml": 1e-5,
           "plate-with-hole/plate.toml": 1e-5}
ENERGY = {"spinning-cube/spinning-cube.toml": 1e-3, "twisting-column/twisting-column.toml": 3e-4,
          "swinging-cube-delaunay/swinging-cube.toml": 1e-3, "swinging-cube-voronoi/swinging-cube.toml": 4e-3}


@functools.cache
def moving_cases():
    cases = (str(path.relative_to(runs.EXAMPLES)) for path in sorted(runs.EXAMPLES.glob("*/*.toml")))
    moving = [case for case in cases if "end = 0\n" not in (runs.EXAMPLES / case).read_text()]
    return [case for case in moving if can_be_built(case)]


def can_be_built(case):
    """Some shapes need a component that a build may lack."""
    if "difference" not in (runs.EXAMPLES / case).read_text():
        return True
    return "TESSERA_WITH_CGAL" not in runs.execute(case, {"time.end": 0})[0].stderr


@functools.cache
def result(case, spectral):
    return runs.run(case, SPECTRAL if spectral else BY_BONDS)


def share_of_evaluations(summary):
    return summary["step_control"]["evaluations"] / summary["steps"]


def share_of_wall_time(summary):
    wall = summary["wall_seconds"]
    return wall["time_step"] / (wall["time_step"] + wall["steps"])


def probe_change(case):
    """Largest difference of a probe's last value, relative to its largest value."""
    old, new = result(case, False).history, result(case, True).history
    probes = [name for name in old if "." in name]
    groups = {}
    for name in probes:
        groups.setdefault(name.rsplit(".", 1)[0], []).append(name)
    changes = [0.0]
    for names in groups.values():
        scale = max(abs(v) for name in names for v in old[name])
        changes += [abs(new[name][-1] - old[name][-1]) / scale for name in names]
    return max(changes)


def displacement_error(case, spectral):
    errors = result(case, spectral).summary["errors"]
    return max((e["displacement_l2"] for e in errors.values()), default=None)


class SpectralSteps(unittest.TestCase):
    def test_fewer(self):
        for case in moving_cases():
            with self.subTest(case=case):
                old, new = (result(case, spectral).summary["steps"] for spectral in (False, True))
                self.assertLess(new, 0.75 * old)

    def test_cost(self):
        """Counted, not timed."""
        for case in moving_cases():
            with self.subTest(case=case):
                summary = result(case, True).summary
                allowed = max(FEWEST, 0.02 * summary["steps"])
                self.assertLessEqual(summary["step_control"]["evaluations"], allowed)

    def test_energy(self):
        for case in moving_cases():
            with self.subTest(case=case):
                summary = result(case, True).summary
                self.assertLess(abs(summary["energy"]["relative_error"]), ENERGY.get(case, 1e-4))

    def test_probes(self):
        for case in moving_cases():
            with self.subTest(case=case):
                self.assertLess(probe_change(case), PROBES.get(case, 1e-5))

    def test_displacement_errors(self):
        for case in moving_cases():
            old, new = displacement_error(case, False), displacement_error(case, True)
            if old is None:
                continue
            with self.subTest(case=case):
                allowed = {**WAVES, **AT_REST}
                self.assertLess(new, old * (1 + allowed[case]) if case in allowed else 1e-11)


def print_table():
    print("| example | steps: auto | auto-spectral | evaluations for the step | energy error: auto | auto-spectral |"
          " change of the result |\n|---|---|---|---|---|---|---|")
    for case in moving_cases():
        old, new = (result(case, spectral).summary for spectral in (False, True))
        errors = [displacement_error(case, spectral) for spectral in (False, True)]
        has_probes = any("." in name for name in result(case, True).history)
        change = f"probes {probe_change(case):.0e}" if has_probes else ""
        if errors[0] is not None:
            change = f"error {errors[0]:.2g} to {errors[1]:.2g}"
        print(f"| {case.removesuffix('.toml')} | {old['steps']} | {new['steps']} | "
              f"{new['step_control']['evaluations']} ({100 * share_of_evaluations(new):.1f}%, "
              f"wall {100 * share_of_wall_time(new):.1f}%) | {abs(old['energy']['relative_error']):.0e} | "
              f"{abs(new['energy']['relative_error']):.0e} | {change} |")


if __name__ == "__main__":
    if sys.argv[1:] == ["--table"]:
        print_table()
    else:
        runs.main()
