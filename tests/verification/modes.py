"""Linear modes of the beam of [D 8.4] at rest: what modes_program finds, by name, and converged references.

The references are those of 6 m x 1 m x 1 m, E = 17 MPa, nu = 0.3, rho = 1100 kg/m3, from spectral elements, converged to the
digits shown.
"""

import json
import math
import os
import pathlib
import subprocess

import runs

PROGRAM = os.environ.get("TESSERA_MODES", str(pathlib.Path(runs.TESSERA).with_name("modes_program")))
BEAM = "cantilever/cantilever.toml"
REFERENCE = {"free": {"bending": 20.432, "torsion": 37.07, "second bending": 49.65},
             "fixed": {"bending": 3.456, "torsion": 18.59, "second bending": 19.386}}  # [rad/s]
RIGID = 6  # modes of a free body
ENOUGH = {"free": RIGID + 7, "fixed": 7}  # modes to ask for


def method(formulation, integration="nodal"):
    """Settings that choose a formulation by its name (voronoi ones by their boundary's)."""
    kind = {"method.formulation": "delaunay"} if formulation == "delaunay" else {
        "method.formulation": "voronoi", "method.boundary": formulation}
    return kind | {"method.integration": integration}


def beam(condition, per_metre, jitter):
    """Settings of the beam, "free" or "fixed" at one end."""
    return {"boundary.0.condition": condition, "body.0.particles.spacing": 1.0 / per_metre,
            "body.0.particles.jitter": jitter}


def program(case, wanted, settings):
    """What modes_program prints."""
    values = [f"{key}={value if isinstance(value, str) else json.dumps(value)}" for key, value in settings.items()]
    process = subprocess.run([PROGRAM, str(runs.EXAMPLES / case), str(wanted), *values], capture_output=True, text=True,
                             check=False)
    if process.returncode != 0:
        raise AssertionError(f"{case} {settings}: {process.stderr.strip()}")
    return json.loads(process.stdout)


def frequency(mode):
    """Angular frequency [rad/s]; negative for a mode that grows."""
    return math.copysign(math.sqrt(abs(mode["omega2"])), mode["omega2"])


def with_motion_inside(mode):
    """Angular frequency if the cells' inner motion had its inertia, to first order [rad/s]."""
    return frequency(mode) / math.sqrt(1.0 + mode["inside"])


def by_name(found, condition, measure=frequency):
    """First and second bending (mean of the two directions) and torsion of the beam [rad/s]."""
    elastic = found["modes"][RIGID if condition == "free" else 0:]
    torsion = [measure(m) for m in elastic if m["around"] > 0.8]
    bending = [measure(m) for m in elastic if m["around"] <= 0.8 and m["along"] < 0.8]
    return {"bending": (bending[0] + bending[1]) / 2.0, "torsion": torsion[0],
            "second bending": (bending[2] + bending[3]) / 2.0}


def errors(found, condition, measure=frequency):
    """Relative errors of the angular frequencies."""
    ours = by_name(found, condition, measure)
    return {name: ours[name] / reference - 1.0 for name, reference in REFERENCE[condition].items()}


def relative_step(found):
    """Largest stable step at rest in units of the shortest branch over the wave speed."""
    return found["stable_step"] / found["travel_time"]
