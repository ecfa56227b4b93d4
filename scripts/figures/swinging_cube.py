#!/usr/bin/python3
"""Pictures of examples/swinging-cube-*: errors.png and bodies.png, and the tables of errors on stdout.

    TESSERA=build/release/bin/tessera scripts/figures/swinging_cube.py ERRORS.json

ERRORS.json keeps the errors of runs; what is there already is used again. All of them take about a quarter of an hour.
"""

import json
import pathlib
import shutil
import subprocess
import sys

import gnuplot

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tests" / "verification"))

import runs  # noqa: E402
import test_swinging_cube as case  # noqa: E402

SPACINGS = (4, 8, 16, 32, 64)
SMALL = 0.01  # of the papers' amplitude
# Curves of each example: formulation, jitter, factor of the amplitude.
CURVES = {
    "swinging-cube-delaunay": [("delaunay", j, f) for f in (1.0, SMALL) for j in case.JITTERS],
    "swinging-cube-voronoi": [("consistent", j, f) for f in (1.0, SMALL) for j in case.JITTERS]
    + [("variational", j, 1.0) for j in case.JITTERS],
}
FRAMES = {"output.fields": '{format = "vtu", cells = true, quantities = ["von_mises"]}', "time.end": 0}


class Errors:
    """Errors of runs, kept in a file."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        self.known = json.loads(self.path.read_text()) if self.path.exists() else {}

    def get(self, formulation, jitter, per_metre, factor):
        key = f"{formulation} {jitter:g} {per_metre} {factor:g}"
        if key not in self.known:
            self.known[key] = case.error(formulation, jitter, per_metre, factor)
            self.path.write_text(json.dumps(self.known, indent=1) + "\n")
        return self.known[key]


def spacings_of(formulation, factor):
    """The corner that [V 43] makes unstable spoils the finest spacing; small amplitudes matter only there."""
    if formulation == "variational":
        return SPACINGS[:-1]
    return SPACINGS if factor == 1.0 else SPACINGS[-2:]


def curve(errors, formulation, jitter, factor):
    return [(1.0 / n, errors.get(formulation, jitter, n, factor)) for n in spacings_of(formulation, factor)]


def print_table(name, points):
    orders = ["", *(f" ({runs.order(a[1], b[1]):.2f})" for a, b in zip(points, points[1:]))]
    print(name, *(f"1/{1 / h:.0f}: {e:.2e}{o}" for (h, e), o in zip(points, orders)), sep=" | ")


def draw_errors(example, errors):
    blocks, plots = {}, []
    for formulation, jitter, factor in CURVES[example]:
        points = curve(errors, formulation, jitter, factor)
        block = f"{formulation}_{case.JITTERS.index(jitter)}{'_small' if factor != 1.0 else ''}"
        print_table(f"{example}, {formulation}, jitter {jitter:g}, amplitude x {factor:g}", points)
        blocks[block] = points
        colour = 1 + case.JITTERS.index(jitter)
        title = f"{formulation}, jitter {jitter:g}" if factor == 1.0 else f"hundredth of the amplitude, {jitter:g}"
        style = {("variational", 1.0): "dashtype 3 pointtype 4", (formulation, SMALL): "dashtype 2 pointtype 6"}.get(
            (formulation, factor), "pointtype 7")
        plots.append(f"${block} with linespoints linecolor {colour} {style} title '{title}'")
    scale = 0.6 * blocks[next(iter(blocks))][0][1] * SPACINGS[0] ** 2
    plots.append(f"{scale}*x**2 with lines linecolor rgb '#888888' title 'slope 2'")
    gnuplot.plot(ROOT / "examples" / example / "errors.png", blocks, f"""set logscale xy
set xlabel 'spacing [m]'
set ylabel 'relative L_2 error of the displacement'
set format y '10^{{%L}}'
set xtics ('1/64' 1/64., '1/32' 1/32., '1/16' 1/16., '1/8' 1/8., '1/4' 1/4.)
set xrange [1/80.:1/3.2]
set grid
set key outside right center
plot {", ".join(plots)}
""", size=(900, 480))


def draw_bodies(example):
    """The initial state at 1/8 m, coloured by the von Mises stress, as in [V] figure 4."""
    files, folders = [], []
    for jitter in case.JITTERS:
        result = runs.run(f"{example}/swinging-cube.toml", FRAMES | {"body.0.particles.jitter": jitter})
        files.append(sorted(result.folder.glob("cells_*.vtu"))[-1])
        folders.append(result.folder)
    labels = [f"jitter {jitter:g}" for jitter in case.JITTERS]
    subprocess.run([sys.executable, HERE / "render.py", ROOT / "examples" / example / "bodies.png", *files, "--edges",
                    "--scale", "1e-3", "--title", "von Mises stress [kPa]", "--labels", *labels,
                    "--from", "1.3", "2", "1.2", "--size", "840", "390", "--range", "0", "20",
                    "--zoom", "0.88"], check=True)
    for folder in folders:
        shutil.rmtree(folder)


def main():
    errors = Errors(sys.argv[1])
    for example in CURVES:
        draw_bodies(example)
        draw_errors(example, errors)


if __name__ == "__main__":
    main()
