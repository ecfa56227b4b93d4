#!/usr/bin/python3
"""Pictures of the two punches: runs their examples, draws shapes.png and force.png of each, and docs/images/punch.png.

    TESSERA=build/release/bin/tessera scripts/figures/punch.py [voronoi] [delaunay]
"""

import pathlib
import subprocess
import sys

import gnuplot
import vtk

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tests" / "verification"))

import runs  # noqa: E402

FRAMES = {"output.fields.format": "vtu", "output.fields.cells": True}
JITTER = {"body.0.particles.jitter": 0.25}
BOUNDARIES = ("consistent", "variational", "quasi-static")


def read(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def joined(reference, frame):
    """The frame with each vertex at the mean of where the cells that meet there in the reference put it: cells move by
    their own mean deformation, so their vertices differ a little."""
    meeting = {}
    for i in range(reference.GetNumberOfPoints()):
        meeting.setdefault(tuple(round(x, 7) for x in reference.GetPoint(i)), []).append(i)
    for points in meeting.values():
        places = [frame.GetPoint(i) for i in points]
        mean = [sum(x) / len(places) for x in zip(*places)]
        for i in points:
            frame.GetPoints().SetPoint(i, mean)
    return frame


def join(folder, number):
    """Writes the joined cells of a frame beside it; returns the file."""
    writer = vtk.vtkXMLUnstructuredGridWriter()
    output = folder / f"joined_{number:06d}.vtu"
    writer.SetFileName(str(output))
    writer.SetInputData(joined(read(folder / "cells_000000.vtu"), read(folder / f"cells_{number:06d}.vtu")))
    writer.Write()
    return output


def render(output, frames, *options):
    command = [sys.executable, str(HERE / "render.py"), str(output), *map(str, frames), "--edges"]
    subprocess.run(command + [str(option) for option in options], check=True)


def draw_voronoi_shapes():
    """15% and 30%, regular and irregular, as in [V] figure 10; the last one also opens the README."""
    frames = []
    for settings in ({}, JITTER):
        result = runs.run("punch-voronoi/punch.toml", {**FRAMES, "output.fields.every": "0.75 s", **settings})
        frames += [join(result.folder, number) for number in (1, 2)]
    look = ("--quantity", "pressure", "--scale", 1e-3, "--title", "pressure [kPa]", "--range", -200, 800, "--up", 0, 1, 0)
    labels = ("regular, 15%", "regular, 30%", "irregular, 15%", "irregular, 30%")
    render(runs.EXAMPLES / "punch-voronoi/shapes.png", frames, *look, "--layout", "grid", "--size", 740, 560,
           "--from", 0.15, 0.25, 1, "--labels", *labels)
    render(ROOT / "docs/images/punch.png", frames[-1:], *look, "--size", 860, 500, "--zoom", 1.08, "--from", 0.25, 0.35, 1)


def voronoi_curve(settings):
    """Rows of the indentation [% of the height] and the force [kN]."""
    history = runs.run("punch-voronoi/punch.toml", {"output.fields.cells": False, **settings}).history
    return [[20.0 * t, 1e-3 * f] for t, f in zip(history["t"], history["punch.fy"])]


def line(block, colour, title, dash=1):
    return f"${block} using 1:2 with lines linecolor {colour} dashtype {dash} linewidth 1.5 title '{title}'"


def draw_voronoi_force():
    blocks, lines = {}, []
    for i, boundary in enumerate(BOUNDARIES):
        for dash, (name, settings) in enumerate((("regular", {}), ("irregular", JITTER)), 1):
            blocks[f"b{i}{dash}"] = voronoi_curve({"method.boundary": boundary, **settings})
            lines.append(line(f"b{i}{dash}", i + 1, f"{boundary}, {name}", dash))
    blocks["fine"] = voronoi_curve({"body.0.particles.counts": [42, 22, 6]})
    lines.append(line("fine", 6, "consistent, half the spacing", 4))
    commands = f"""set xlabel 'indentation [% of the height]'
set ylabel 'force on the punch [kN]'
set key top left
plot [0:30] [0:] {", ".join(lines)}"""
    gnuplot.plot(runs.EXAMPLES / "punch-voronoi/force.png", blocks, commands, (800, 480))


DENSITIES = (3, 6, 9, 12)  # per mm


def delaunay_run(density, formulation, settings):
    vertices = density + 1 if formulation == "delaunay" else density
    counts = {"body.0.particles.counts": [vertices] * 3, "method.formulation": formulation}
    return runs.run("punch-delaunay/punch.toml", {**counts, **settings})


def indentation(s):
    """The smooth step of the case file [mm], at a share s of the time."""
    return 0.5 * s**3 * (10.0 - 15.0 * s + 6.0 * s**2)


def delaunay_curve(result):
    """Rows of the indentation [mm] and the force on the whole punch [N], four times that of the quarter."""
    history = result.history
    return [[indentation(t / history["t"][-1]), 4.0 * f] for t, f in zip(history["t"], history["punch.fz"])]


def draw_delaunay():
    """Shapes as in [D] figure 10, curves as in its figure 11."""
    frames, blocks, lines = [], {}, []
    for i, density in enumerate(DENSITIES):
        result = delaunay_run(density, "delaunay", FRAMES)
        frames.append(sorted(result.folder.glob("cells_*.vtu"))[-1])
        blocks[f"d{density}"] = delaunay_curve(result)
        lines.append(line(f"d{density}", i + 1, f"delaunay, {density} per mm"))
    for i, density in enumerate(DENSITIES):
        blocks[f"v{density}"] = delaunay_curve(delaunay_run(density, "voronoi", {"output.fields.cells": False}))
        lines.append(line(f"v{density}", i + 1, f"voronoi, {density} per mm", 2))
    render(runs.EXAMPLES / "punch-delaunay/shapes.png", frames, "--layout", "grid", "--size", 560, 540, "--zoom", 0.92,
           "--from", -1, -1.7, 0.7, "--scale", 1e-6, "--title", "von Mises stress [MPa]", "--range", 0, 150,
           "--labels", *(f"{density} per mm" for density in DENSITIES))
    commands = f"""set xlabel 'indentation [mm]'
set ylabel 'force on the punch [N]'
set key top left
plot [0:0.5] [0:] {", ".join(lines)}"""
    gnuplot.plot(runs.EXAMPLES / "punch-delaunay/force.png", blocks, commands, (800, 480))


if __name__ == "__main__":
    chosen = sys.argv[1:] or ["voronoi", "delaunay"]
    if "voronoi" in chosen:
        draw_voronoi_shapes()
        draw_voronoi_force()
    if "delaunay" in chosen:
        draw_delaunay()
