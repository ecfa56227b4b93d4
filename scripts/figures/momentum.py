#!/usr/bin/python3
"""Pictures of the free bodies: runs their examples, draws bodies.png and momenta.png of each.

    TESSERA=build/release/bin/tessera scripts/figures/momentum.py [CASE ...]
"""

import math
import pathlib
import subprocess
import sys

import gnuplot

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tests" / "verification"))

import runs  # noqa: E402

# Frames to draw (times, s), how to look at them, end of the loads (s), and stress range (kPa).
CASES = {
    "free-beam": {
        "times": (0, 0.5, 1, 1.5, 2), "every": 0.5, "loaded": 0, "range": (0, 80),
        "look": ["--layout", "scene", "--size", "1200", "400"],
    },
    "l-block": {
        "times": (0, 2.5, 5, 10, 20, 30, 40, 55), "every": 2.5, "loaded": 5, "range": (0, 20),
        "look": ["--layout", "grid", "--columns", "4", "--size", "1000", "680",
                 "--from", "0.3", "-0.2", "1", "--up", "0", "1", "0"],
    },
    "spinning-cube": {
        "times": (0, 0.05, 0.1, 0.15, 0.2), "every": 0.05, "loaded": 0, "range": (0, 200),
        "look": ["--layout", "row", "--size", "1200", "380", "--from", "1", "-2", "1"],
    },
}


def draw_bodies(case, result):
    plan = CASES[case]
    frames = [str(result.folder / f"cells_{round(t / plan['every']):06d}.vtu") for t in plan["times"]]
    output = runs.EXAMPLES / case / "bodies.png"
    command = [sys.executable, str(HERE / "render.py"), str(output), *frames, "--edges", *plan["look"]]
    command += ["--scale", "1e-3", "--title", "von Mises stress [kPa]", "--range", *map(str, plan["range"])]
    command += ["--labels", *(f"{t:g} s" for t in plan["times"])]
    subprocess.run(command, check=True)


def momenta(history):
    """Rows of t, p, l and of the components' changes since the end of the loads."""
    names = [kind + axis for kind in "pl" for axis in "xyz"]
    return [[t, *(history[n][i] for n in names)] for i, t in enumerate(history["t"])]


def changes(rows, since):
    """Amounts of change, gaps where there is none (the axis is logarithmic)."""
    start = next(row for row in rows if row[0] >= since)
    return [[row[0], *(abs(a - b) or None for a, b in zip(row[1:], start[1:]))] for row in rows if row[0] > since]


def curves(name, scale, style):
    labels = ("p_1", "p_2", "p_3", "l_1", "l_2", "l_3")
    return ", ".join(f"${name} using 1:(${i + 2}*{scale:g}) with {style} linecolor {i + 1} title '{label}'"
                     for i, label in enumerate(labels))


def draw_momenta(case, result):
    rows = momenta(result.history)
    largest = max(abs(v) for row in rows for v in row[1:])
    power = 3 * math.floor(math.log10(largest) / 3)
    change = changes(rows, CASES[case]["loaded"])
    # What is smaller than round-off of the largest by far is zero, and would take most of a logarithmic axis.
    lowest = 1e-8 * max(v for row in change for v in row[1:] if v)
    commands = f"""set multiplot layout 1,2
set xlabel 't [s]'
set key outside top center horizontal maxrows 1
set ylabel 'momentum [10^{power} kg m/s, 10^{power} kg m^2/s]'
plot {curves('all', 10.0**-power, 'lines linewidth 1.5')}
set key off
set logscale y
set yrange [{lowest:g}:*]
set format y '10^{{%L}}'
set ylabel 'change [kg m/s, kg m^2/s]'
plot {curves('change', 1, 'points pointtype 7 pointsize 0.3')}
unset multiplot"""
    blocks = {"all": rows, "change": change}
    gnuplot.plot(runs.EXAMPLES / case / "momenta.png", blocks, commands)


def draw(case):
    settings = {"output.fields.format": "vtu", "output.fields.cells": True, "output.fields.every": CASES[case]["every"]}
    result = runs.run(f"{case}/{case}.toml", settings)
    draw_bodies(case, result)
    draw_momenta(case, result)


if __name__ == "__main__":
    for name in sys.argv[1:] or CASES:
        draw(name)
