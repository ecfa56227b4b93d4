#!/usr/bin/python3
"""Pictures of the examples of relaxed particles and of power cells: runs them and draws shapes.png of each.

    TESSERA=build/release/bin/tessera scripts/figures/particles.py
"""

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


if __name__ == "__main__":
    draw_bracket()
    draw_packing()
