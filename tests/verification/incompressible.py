"""Runs of examples/nearly-incompressible and what is measured of them: errors against mixed finite elements
(scripts/mixed_elements.py prints the references), roughness of the pressure, steps."""

import collections
import itertools
import math

import runs

FOLDER = "nearly-incompressible/"
MEMBRANE = {0.45: 31.33e-6, 0.49: 29.98e-6, 0.499: 29.65e-6, 0.4999: 29.62e-6}  # rise of the middle of the right side [m]
PUNCH = {0.45: (0.3675e-3, 2105.0), 0.49: (0.7366e-3, 2800.0), 0.499: (0.8739e-3, 3058.0),
         0.4999: (0.8894e-3, 3087.0)}  # rise of the corner [m], force [N]
BULGE = {0.45: 0.1947e-6, 0.49: 0.2230e-6, 0.499: 0.2303e-6, 0.4999: 0.2310e-6}  # of the free side [m]

Measured = collections.namedtuple("Measured", "errors roughness steps")


def roughness(frame, spacing):
    """The rms of the pressure less the mean over the neighbours, relative to the rms of the pressure."""
    reach = 1.35 * spacing
    places = list(zip(*(frame[f"reference_position_{c}"] for c in "xyz")))
    pressure, volume = frame["pressure"], frame["volume"]
    boxes = collections.defaultdict(list)
    for a, place in enumerate(places):
        boxes[tuple(math.floor(x / reach) for x in place)].append(a)
    rough = whole = 0.0
    for box, inside in boxes.items():
        around = [b for shift in itertools.product((-1, 0, 1), repeat=3)
                  for b in boxes.get(tuple(i + s for i, s in zip(box, shift)), ())]
        for a in inside:
            near = [b for b in around if b != a and math.dist(places[a], places[b]) < reach]
            mean = sum(volume[b] * pressure[b] for b in near) / sum(volume[b] for b in near)
            rough += volume[a] * (pressure[a] - mean) ** 2
            whole += volume[a] * pressure[a] ** 2
    return math.sqrt(rough / whole)


def run(case, poisson, integration, volumetric, end, settings):
    return runs.run(FOLDER + case, {
        "material.0.poisson": poisson, "method.integration": integration, "method.volumetric": volumetric,
        "output.fields.cells": False, "output.fields.format": "csv", "output.fields.every": end,
        "output.fields.quantities": ["pressure", "volume"], **settings})


def membrane(poisson, integration, volumetric, spacing=2e-3):
    """Error of the rise."""
    r = run("cook.toml", poisson, integration, volumetric, "80 ms", {"body.0.particles.spacing": spacing})
    error = (r.history["C.y"][-1] - 0.052) / MEMBRANE[poisson] - 1.0
    return Measured((error,), roughness(r.frame(), spacing), r.summary["steps"])


def punch(poisson, integration, volumetric, across=21):
    """Errors of the rise of the corner and of the force; `across` the block, a multiple of 21."""
    r = run("punch.toml", poisson, integration, volumetric, "1 s",
            {"body.0.particles.counts": [across, 11 * across // 21, 1]})
    rise, force = PUNCH[poisson]
    errors = (r.history["corner.y"][-1] - 0.5) / rise - 1.0, abs(r.history["punch.fy"][-1]) / force - 1.0
    return Measured(errors, roughness(r.frame(), 1.0 / across), r.summary["steps"])


def punch_in_space(poisson, integration, volumetric, side=17):
    """Error of the bulge; `side` particles a side."""
    r = run("punch-in-space.toml", poisson, integration, volumetric, "100 us",
            {"body.0.particles.counts": [side, side, side]})
    error = (r.history["side.x"][-1] - 1e-3) / BULGE[poisson] - 1.0
    return Measured((error,), roughness(r.frame(), 1e-3 / (side - 1)), r.summary["steps"])
