#!/usr/bin/python3
"""Picture of examples/bending-column: paths.png, and the table of errors on stdout.

    TESSERA=build/release/bin/tessera scripts/figures/bending_column.py

takes about two minutes.
"""

import pathlib
import sys

import gnuplot

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tests" / "verification"))

import runs  # noqa: E402
import test_bending_column as case  # noqa: E402

DRAWN = [("consistent", "nodal", 4), ("consistent", "cell", 4), ("consistent", "second-order", 4), ("consistent", "cell", 8)]


def main():
    blocks = {"reference": list(zip(case.REFERENCE["t"], case.REFERENCE["x3_corner"]))}
    curves = ["$reference with lines linecolor 'black' linewidth 2 title 'spectral elements'"]
    for i, method in enumerate(DRAWN):
        h = case.history(*method)
        blocks[f"m{i}"] = list(zip(h["t"], h["corner.z"]))
        curves.append(f"$m{i} with lines linecolor {i + 1} title '{method[1]}, {method[2]} per metre'")
        print(*method, f"{100 * case.path_error(*method):.2f}%", flush=True)
    gnuplot.plot(runs.EXAMPLES / "bending-column/paths.png", blocks, f"""set xlabel 't [s]'
set ylabel 'height of the corner [m]'
set xrange [0:1]
set key bottom left
set yrange [-1:4.5]
plot {", ".join(curves)}""", size=(720, 420))


if __name__ == "__main__":
    main()
