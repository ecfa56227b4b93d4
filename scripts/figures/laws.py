#!/usr/bin/python3
"""Picture of examples/laws: force over stretch of the five bars.

    TESSERA=build/release/bin/tessera scripts/figures/laws.py
"""

import math
import pathlib
import sys

import gnuplot

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tests" / "verification"))

import runs  # noqa: E402

BARS = {"neo-hookean": "neo-hookean", "kirchhoff": "saint-venant-kirchhoff", "mooney": "mooney-rivlin", "ogden": "ogden",
        "plastic": "j2-plasticity"}


def stretch(t):
    """Of bars of 60 mm, as the case moves their ends."""
    return 1 + 0.012 * (1 - math.cos(2 * math.pi * t)) / 0.06


def main():
    h = runs.run("laws/laws.toml", {}).history
    blocks, curves = {}, []
    for i, (bar, law) in enumerate(BARS.items()):
        # The force that pulls the bar: against that on the tool, along z.
        blocks[f"b{i}"] = [[stretch(t), -f] for t, f in zip(h["t"], h[bar + ".fz"])]
        dash = " dashtype 2" if bar == "ogden" else ""  # its curve nearly covers that of mooney-rivlin
        curves.append(f"$b{i} with lines linewidth 1.5 linecolor {i + 1}{dash} title '{law}'")
    gnuplot.plot(runs.EXAMPLES / "laws/forces.png", blocks, f"""set xlabel 'stretch'
set ylabel 'force [N]'
set key top left
plot {", ".join(curves)}""", size=(640, 420))


if __name__ == "__main__":
    main()
