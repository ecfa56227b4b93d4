#!/usr/bin/python3
"""What examples/nearly-incompressible/README.md says of the mean change of volume: errors, roughness of the pressure, steps and
seconds for each Poisson's ratio and integration.

    TESSERA=build/release/bin/tessera scripts/incompressible.py [CASE ...]

A CASE is membrane, punch or punch_in_space (default all: about an hour and a half on one core).
"""

import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests" / "verification"))

import incompressible  # noqa: E402

SIZES = {"membrane": 2e-3, "punch": 63, "punch_in_space": 17}

if __name__ == "__main__":
    for case in sys.argv[1:] or SIZES:
        print(f"{case}, {SIZES[case]}: Poisson's ratio, integration, volumetric, errors, roughness, steps, seconds")
        for poisson in incompressible.MEMBRANE:
            for integration, volumetric in (("nodal", "standard"), ("nodal", "averaged"), ("cell", "averaged")):
                start = time.monotonic()
                m = getattr(incompressible, case)(poisson, integration, volumetric, SIZES[case])
                print(poisson, integration, volumetric, *(f"{100 * e:+.2f}%" for e in m.errors), f"{m.roughness:.3f}", m.steps,
                      f"{time.monotonic() - start:.0f}", flush=True)
