#!/usr/bin/python3
"""Pictures of the examples of relaxed particles, of power cells, of simple shapes and of a surface file: runs them and draws
shapes.png of each (lever.png of the lever).

    TESSERA=build/release/bin/tessera scripts/figures/particles.py [NAME ...]
"""

import subprocess
import sys

import plane_strain


def draw_bracket():
    plane_strain.render(plane_strain.runs.EXAMPLES / "relaxed-bracket/shapes.png",
                        plane_strain.first_and_last("relaxed-bracket/relaxed-bracket.toml"), "--size", 860, 480,
                        "--from", 0.6, -0.5, 1, "--up", 0, 1, 0, "--scale", 1e-6, "--title", "von Mises stress [MPa]",
                        "--range", 0, 3, "--labels", "before", "30 N")


def draw_packing():
    plane_strain.render(plane_strain.runs.EXAMPLES / "polydisperse/shapes.png",
                        plane_strain.first_and_last("polydisperse/polydisperse.toml"), "--size", 860, 460,
                        "--from", 1, -1.6, 0.7, "--quantity", "volume", "--scale", 1e9, "--title",
                        "volume before loading [mm3]", "--labels", "before", "squeezed")


def render_last(picture, case, *options):
    """The last frame, without edges: the facets of curved sides would hide it."""
    frame = plane_strain.first_and_last(case)[-1]
    command = [sys.executable, str(plane_strain.HERE / "render.py"), str(plane_strain.runs.EXAMPLES / picture), str(frame)]
    command += ["--scale", "1e-6", "--title", "von Mises stress [MPa]"]
    subprocess.run(command + [str(option) for option in options], check=True)


def draw_lever():
    render_last("odd-solid/lever.png", "odd-solid/odd-solid.toml", "--size", 700, 560, "--from", 1, -1.6, 1.2,
                "--range", 0, 3, "--zoom", 1.25)


def draw_gear():
    render_last("stl-part/shapes.png", "stl-part/stl-part.toml", "--size", 700, 520, "--from", 0.3, -0.6, 1,
                "--up", 0, 1, 0, "--range", 0, 1)


DRAWN = {"bracket": draw_bracket, "packing": draw_packing, "lever": draw_lever, "gear": draw_gear}

if __name__ == "__main__":
    for name in sys.argv[1:] or DRAWN:
        DRAWN[name]()
