#!/usr/bin/python3
"""Pictures of examples/twisting-column: bodies.png and twist.png, and the largest twist on stdout.

    TESSERA=build/release/bin/tessera scripts/figures/twisting_column.py
"""

import pathlib
import subprocess
import sys

import gnuplot

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tests" / "verification"))

import runs  # noqa: E402
from test_twisting_column import CASE, twist  # noqa: E402

EXAMPLE = runs.EXAMPLES / "twisting-column"
TIMES = (0, 0.025, 0.05, 0.075, 0.1, 0.15, 0.2)  # of the pictures [s]
DENSITIES = (2, 4, 8)


def draw_bodies():
    result = runs.run(CASE, {"output.fields": '{ format = "vtu", cells = true, every = 0.025 }', "time.end": 0.2})
    frames = [str(result.folder / f"cells_{round(t / 0.025):06d}.vtu") for t in TIMES]
    command = [sys.executable, str(HERE / "render.py"), str(EXAMPLE / "bodies.png"), *frames, "--edges", "--from", "1",
               "-2", "0.5", "--scale", "1e-6", "--title", "von Mises stress [MPa]", "--range", "0", "14", "--size", "1100",
               "640", "--labels", *(f"{t:g} s" for t in TIMES)]
    subprocess.run(command, check=True)


def draw_twist():
    blocks, plots = {}, []
    for poisson, dash in ((0.3, 1), (0.45, 2)):
        for i, n in enumerate(DENSITIES):
            h = runs.run(CASE, {"material.0.poisson": poisson, "body.0.particles.spacing": 1.0 / n}).history
            angles = twist(h)
            print(f"nu {poisson} {n}/m: {max(angles):.1f} degrees at {h['t'][angles.index(max(angles))]:.3f} s, "
                  f"height of the end {min(h['end.z']):.3f} to {max(h['end.z']):.3f} m")
            block = f"p{n}_{round(100 * poisson)}"
            blocks[block] = [(t, a, z) for t, a, z in zip(h["t"], angles, h["end.z"])]
            plots.append((block, f"with lines linecolor {i + 1} dashtype {dash} title 'ν = {poisson}, {n} per metre'"))
    curves = [", ".join(f"${block} using 1:{column} {style}" for block, style in plots) for column in (2, 3)]
    gnuplot.plot(EXAMPLE / "twist.png", blocks, f"""set multiplot layout 1,2
set xlabel 't [s]'
set key bottom left
set ylabel 'twist of the free end [degrees]'
plot {curves[0]}
set key off
set ylabel 'height of the free end [m]'
plot {curves[1]}
unset multiplot""", size=(1100, 420))


if __name__ == "__main__":
    draw_bodies()
    draw_twist()
