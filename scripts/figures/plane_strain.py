#!/usr/bin/python3
"""Pictures of the plane-strain example and of the two bodies: runs them and draws shapes.png of each.

    TESSERA=build/release/bin/tessera scripts/figures/plane_strain.py
"""

import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tests" / "verification"))

import runs  # noqa: E402

FRAMES = {"output.fields.format": "vtu", "output.fields.cells": True}


def render(output, frames, *options):
    command = [sys.executable, str(HERE / "render.py"), str(output), *map(str, frames), "--edges"]
    subprocess.run(command + [str(option) for option in options], check=True)


def first_and_last(case):
    cells = sorted(runs.run(case, FRAMES).folder.glob("cells_*.vtu"))
    return [cells[0], cells[-1]]


def draw_membrane():
    render(runs.EXAMPLES / "plane-strain/shapes.png", first_and_last("plane-strain/cook.toml"), "--size", 800, 460,
           "--from", 0, 0, 1, "--up", 0, 1, 0, "--scale", 1e-3, "--title", "von Mises stress [kPa]", "--range", 0, 120,
           "--labels", "before", "30 kPa")


def draw_two_bodies():
    render(runs.EXAMPLES / "two-bodies/shapes.png", first_and_last("two-bodies/two-bodies.toml"), "--size", 860, 380,
           "--from", 1, -2, 0.8, "--scale", 1e-3, "--title", "von Mises stress [kPa]", "--range", 0, 160,
           "--labels", "before", "at rest")


if __name__ == "__main__":
    draw_membrane()
    draw_two_bodies()
