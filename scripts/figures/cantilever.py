#!/usr/bin/python3
"""Pictures of examples/cantilever: paths.png, convergence.png and bodies.png, and the table of errors on stdout.

    TESSERA=build/release/bin/tessera scripts/figures/cantilever.py RUNS

RUNS is a folder that keeps the runs; what is there already is used again. All of them take about a quarter of an hour.
"""

import math
import pathlib
import shutil
import subprocess
import sys

import gnuplot

HERE = pathlib.Path(__file__).resolve().parent
EXAMPLE = HERE.parents[1] / "examples" / "cantilever"
sys.path.insert(0, str(HERE.parents[1] / "tests" / "verification"))

import runs  # noqa: E402
import test_cantilever as case  # noqa: E402

DENSITIES = (2, 4, 8, 16)
# RMS error of x3 over 0..1 s at 8 per metre, of other methods (see the README).
SPH, HEXAHEDRA = 0.34, 0.028


def history(store, formulation, per_metre, jitter, more=None):
    """History of a run, which may have stopped early; made unless the store has it."""
    folder = store / f"{formulation}-{per_metre}-{jitter:g}{'-' + '-'.join(more) if more else ''}"
    if not (folder / "summary.json").exists():
        _, made = runs.execute(case.CASE, case.settings(formulation, per_metre, jitter) | (more or {}))
        shutil.rmtree(folder, ignore_errors=True)
        shutil.move(made, folder)
    return runs.read_csv(folder / "history.csv")[0]


def draw_paths(store):
    """Height of the corner at 8 per metre, and how far each is from the reference."""
    variants = {name: history(store, name, 8, 0.2) for name in (*case.CONSERVING, "quasi-static")}
    blocks = {"reference": list(zip(case.REFERENCE["t"], case.REFERENCE["x3_corner_top"]))}
    curves = ["$reference with lines linecolor 'black' linewidth 2 title 'reference'"]
    errors = []
    for i, (name, h) in enumerate(variants.items()):
        block = name.replace("-", "_")
        blocks[block] = list(zip(h["t"], h["corner.z"]))
        blocks[f"{block}_error"] = [(t, b) for t, _, b, _ in case.deviations(h, name, 8)]
        curves.append(f"${block} with lines linecolor {i + 1} title '{name}'")
        errors.append(f"${block}_error with lines linecolor {i + 1} notitle")
    levels = [f"{value} with lines dashtype {dash} linecolor rgb '#999999' notitle"
              for level, dash in ((SPH, 2), (HEXAHEDRA, 3)) for value in (level, -level)]
    gnuplot.plot(EXAMPLE / "paths.png", blocks, f"""set multiplot layout 1,2
set xlabel 't [s]'
set xrange [0:1]
set key top right
set ylabel 'x_3 of the corner [m]'
set yrange [-1.5:4.5]
plot {", ".join(curves)}
set ylabel 'error of x_3 [m]'
set yrange [-0.45:0.45]
set label 1 'RMS of total-Lagrangian SPH, {SPH} m' at 0.03,{SPH + 0.03} textcolor rgb '#777777'
set label 2 'RMS of explicit C3D8, {HEXAHEDRA} m' at 0.03,{-HEXAHEDRA - 0.07} textcolor rgb '#777777'
plot {", ".join(levels + errors)}
unset multiplot""", size=(1100, 420))


def draw_convergence(store):
    blocks, curves = {}, []
    for i, name in enumerate(case.CONSERVING):
        for jitter, dash, marker in ((0.0, 1, 7), (0.2, 2, 6)):
            errors = [(1.0 / n, case.path_error(history(store, name, n, jitter), name, n)) for n in DENSITIES]
            block = f"{name}_{int(10 * jitter)}"
            blocks[block] = errors
            label = f"{name}, {'20% jitter' if jitter else 'regular'}"
            style = f"linespoints linecolor {i + 1} dashtype {dash} pointtype {marker}"
            curves.append(f"${block} using 1:(100*$2) with {style} title '{label}'")
    gnuplot.plot(EXAMPLE / "convergence.png", blocks, f"""set logscale xy
set xrange [0.05:0.6]
set yrange [0.3:50]
set xtics ('1/16' 0.0625, '1/8' 0.125, '1/4' 0.25, '1/2' 0.5)
set xlabel 'spacing [m]'
set ylabel 'error of the path over 0..1 s [%]'
set key outside right center
plot {", ".join(curves)}, 180*x*x with lines linecolor rgb '#999999' dashtype 3 title 'second order'""", size=(820, 420))


def draw_bodies(store):
    """[D] Fig. 9: shape and stress at 0.5 s for four densities."""
    more = {"time.end": 0.5, "output.fields.format": "vtu", "output.fields.every": 0.5}
    frames = []
    for n in DENSITIES:
        folder = store / f"shape-{n}"
        if not folder.exists():
            shutil.move(runs.run(case.CASE, case.settings("delaunay", n, 0.0) | more).folder, folder)
        frames.append(str(folder / "fields_000001.vtu"))
    command = [sys.executable, str(HERE / "render.py"), str(EXAMPLE / "bodies.png"), *frames, "--layout", "grid"]
    command += ["--radius", *(f"{0.5 / n:g}" for n in DENSITIES), "--scale", "1e-6", "--title", "von Mises stress [MPa]"]
    command += ["--range", "0", "3", "--from", "0.3", "-1", "0.25", "--size", "840", "540", "--labels",
                *(f"{n} per metre" for n in DENSITIES)]
    subprocess.run(command, check=True)


def print_table(store):
    for formulation, jitter in case.VARIANTS:
        for n in DENSITIES:
            h = history(store, formulation, n, jitter)
            print(f"{formulation:12} {jitter:3} {n:3}/m  path {100 * case.path_error(h, formulation, n):6.2f} %"
                  f"  x3 {case.rms_height(h, formulation, n):.4f} m  bonds {100 * case.contact_share(h):5.2f} %"
                  f"  energy {max(map(abs, h['energy_error'])):.1e}")


def main():
    store = pathlib.Path(sys.argv[1])
    store.mkdir(parents=True, exist_ok=True)
    draw_paths(store)
    draw_convergence(store)
    draw_bodies(store)
    print_table(store)


if __name__ == "__main__":
    main()
