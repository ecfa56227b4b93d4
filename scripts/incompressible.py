#!/usr/bin/python3
"""What examples/nearly-incompressible/README.md says of the mean change of volume: errors, roughness of the pressure, steps and
processor seconds for each size, Poisson's ratio and integration.

    TESSERA=build/release/bin/tessera scripts/incompressible.py RUNS [CASE ...]

RUNS is a folder that keeps what was measured; what is there already is used again. A CASE is membrane, punch or punch_in_space
(default all: about three quarters of an hour on one core). Rows: size, Poisson's ratio, integration, volumetric, errors (membrane: of the rise;
punch: of the rise and the force; punch_in_space: of the bulge), roughness, steps, seconds.
"""

import json
import pathlib
import resource
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests" / "verification"))

import incompressible  # noqa: E402

ALL = tuple(incompressible.MEMBRANE)  # Poisson's ratios
NODAL = (("nodal", "standard"), ("nodal", "averaged"))
METHODS = (*NODAL, ("cell", "averaged"))
VORONOI = (*METHODS, ("second-order", "averaged"))
# Case: size, Poisson's ratios, methods.
PLAN = {"membrane": ((4e-3, ALL, NODAL), (2e-3, ALL, VORONOI), (1e-3, ALL[:3], NODAL)),
        "punch": ((21, ALL, NODAL), (42, ALL, VORONOI), (63, ALL, VORONOI), (84, ALL[:2], VORONOI)),
        "punch_in_space": ((7, ALL[:3], NODAL), (13, ALL[:3], NODAL), (17, ALL, METHODS))}


def seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def measured(kept, case, size, poisson, method):
    """[errors, roughness, steps, seconds], measured once."""
    path = kept / f"{case}-{size:g}-{poisson:g}-{'-'.join(method)}.json"
    if not path.exists():
        before = seconds()
        m = getattr(incompressible, case)(poisson, *method, size)
        kept.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps([m.errors, m.roughness, m.steps, seconds() - before]))
    return json.loads(path.read_text())


def main():
    kept = pathlib.Path(sys.argv[1])
    for case in sys.argv[2:] or PLAN:
        print(case)
        for size, ratios, methods in PLAN[case]:
            for poisson in ratios:
                for method in methods:
                    errors, roughness, steps, cost = measured(kept, case, size, poisson, method)
                    print(f"{size:g}", poisson, *method, *(f"{100 * e:+.2f}%" for e in errors), f"{roughness:.3f}", steps,
                          f"{cost:.0f}", flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    main()
