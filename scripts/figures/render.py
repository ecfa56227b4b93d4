#!/usr/bin/python3
"""Pictures of bodies from the .vtu frames of a run (output.fields = { format = "vtu", cells = true }).

    render.py OUT.png FRAME.vtu ... [--layout row|column|grid|scene] [--columns N]
              [--quantity von_mises --scale 1e-3 --title "..."] [--range LO HI] [--labels "t = 0 s" ...] [--from X Y Z]
              [--up X Y Z] [--size W H] [--edges] [--radius R ...] [--zoom Z]

cells_*.vtu show the outside of the body, fields_*.vtu a sphere of radius R for every particle (one R, or one a frame). Each
frame has its own panel, or with --layout scene all stand together where they are in space. Needs python3-vtk9 and a
display; without one it starts itself again under xvfb-run (package xvfb).
"""

import argparse
import math
import os
import shutil
import sys

import vtk

# Blue over pale yellow to red; light enough everywhere for dark edges to show.
COLOURS = ((0.27, 0.46, 0.71), (0.57, 0.77, 0.87), (0.99, 0.97, 0.75), (0.98, 0.65, 0.38), (0.84, 0.19, 0.15))
INK = (0.1, 0.1, 0.1)


def read_frame(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    if grid.GetNumberOfPoints() == 0:
        raise SystemExit(f"{path}: no points; is it a .vtu frame?")
    return grid


def values(grid, quantity):
    """The array of that name, of points or of cells, and which of the two."""
    for data, where in ((grid.GetPointData(), "point"), (grid.GetCellData(), "cell")):
        if data.HasArray(quantity):
            return data.GetArray(quantity), where
    raise SystemExit(f"no {quantity!r} in the frame; add it to output.fields.quantities")


def scaled(grid, quantity, factor):
    """Makes the quantity (or its magnitude) times a factor what is shown of the frame; returns its range."""
    source, where = values(grid, quantity)
    array = vtk.vtkDoubleArray()
    array.SetName("shown")
    for i in range(source.GetNumberOfTuples()):
        entry = source.GetTuple(i)
        array.InsertNextValue(factor * (entry[0] if len(entry) == 1 else math.hypot(*entry)))
    data = grid.GetPointData() if where == "point" else grid.GetCellData()
    data.AddArray(array)
    data.SetActiveScalars("shown")
    return array.GetRange()


def colour_map(limits):
    table = vtk.vtkColorTransferFunction()
    for i, colour in enumerate(COLOURS):
        table.AddRGBPoint(limits[0] + (limits[1] - limits[0]) * i / (len(COLOURS) - 1), *colour)
    return table


def surface(grid):
    outside = vtk.vtkDataSetSurfaceFilter()
    outside.SetInputData(grid)
    outside.Update()
    return outside.GetOutput()


def spheres(grid, radius):
    sphere = vtk.vtkSphereSource()
    sphere.SetRadius(radius)
    sphere.SetThetaResolution(14)
    sphere.SetPhiResolution(14)
    glyphs = vtk.vtkGlyph3D()
    glyphs.SetSourceConnection(sphere.GetOutputPort())
    glyphs.SetInputData(grid)
    glyphs.ScalingOff()
    glyphs.Update()
    return glyphs.GetOutput()


def body_actor(grid, table, radius=None, edges=False):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(spheres(grid, radius) if radius else surface(grid))
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetAmbient(0.25)
    actor.GetProperty().SetDiffuse(0.8)
    if edges:
        actor.GetProperty().EdgeVisibilityOn()
        actor.GetProperty().SetEdgeColor(0.15, 0.15, 0.15)
        actor.GetProperty().SetLineWidth(0.6)
    return actor


def text_style(prop, size):
    prop.SetColor(*INK)
    prop.SetFontFamilyToArial()
    prop.SetFontSize(size)
    prop.BoldOff()
    prop.ItalicOff()
    prop.ShadowOff()


def caption(text, size=18):
    actor = vtk.vtkTextActor()
    actor.SetInput(text)
    text_style(actor.GetTextProperty(), size)
    actor.GetTextProperty().SetJustificationToCentered()
    actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    actor.SetPosition(0.5, 0.03)
    return actor


def legend(table, title):
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle(title)
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.4g")
    bar.SetOrientationToHorizontal()
    bar.SetPosition(0.3, 0.05)
    bar.SetPosition2(0.4, 0.9)
    bar.SetBarRatio(0.2)
    bar.SetTextPositionToPrecedeScalarBar()
    bar.UnconstrainedFontSizeOn()
    for prop in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text_style(prop, 16)
    return bar


def bounds_of(grids):
    """The box around all frames: what every panel shows, so that sizes can be compared."""
    box = vtk.vtkBoundingBox()
    for grid in grids:
        box.AddBounds(grid.GetBounds())
    bounds = [0.0] * 6
    box.GetBounds(bounds)
    return bounds


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return tuple(p / math.hypot(*a) for p in a)


def screen_axes(direction, up):
    """Unit vectors to the right and upwards in the picture."""
    right = unit(cross(up, direction))
    return right, unit(cross(direction, right))


def half_extent(bounds, axis):
    """Half the size of the box along a direction."""
    return 0.5 * sum(abs(axis[i]) * (bounds[2 * i + 1] - bounds[2 * i]) for i in range(3))


def centre_of(bounds):
    return [0.5 * (bounds[2 * i] + bounds[2 * i + 1]) for i in range(3)]


def aim(renderer, bounds, direction, up, zoom, aspect):
    """Parallel projection in which the box just fits into a panel of that ratio of width to height."""
    right, top = screen_axes(direction, up)
    centre = centre_of(bounds)
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(*centre)
    camera.SetPosition(*(c + d for c, d in zip(centre, unit(direction))))
    camera.SetViewUp(*top)
    camera.ParallelProjectionOn()
    renderer.ResetCamera(bounds)
    camera.SetParallelScale(1.15 / zoom * max(half_extent(bounds, top), half_extent(bounds, right) / aspect))


def note(text, grid, bounds, direction, up):
    """A caption in space, below one of several bodies."""
    top = screen_axes(direction, up)[1]
    own = grid.GetBounds()
    depth = dot(centre_of(own), top) - dot(centre_of(bounds), top) + half_extent(bounds, top)
    actor = vtk.vtkBillboardTextActor3D()
    actor.SetInput(text)
    text_style(actor.GetTextProperty(), 16)
    actor.GetTextProperty().SetJustificationToCentered()
    actor.GetTextProperty().SetVerticalJustificationToTop()
    actor.SetPosition(*(c - depth * t for c, t in zip(centre_of(own), top)))
    return actor


def panels(count, layout, columns, legend_share):
    """Viewports (x0, y0, x1, y1) of the frames, above the strip of the legend."""
    columns = {"row": count, "column": 1, "grid": columns or math.ceil(math.sqrt(count)), "scene": 1}[layout]
    rows = math.ceil(count / columns)
    height = (1.0 - legend_share) / rows
    places = [divmod(i, columns) for i in range(count)]
    return [(c / columns, 1.0 - (r + 1) * height, (c + 1) / columns, 1.0 - r * height) for r, c in places]


def renderer_in(window, viewport):
    renderer = vtk.vtkRenderer()
    renderer.SetViewport(*viewport)
    renderer.SetBackground(1, 1, 1)
    window.AddRenderer(renderer)
    return renderer


def render(output, grids, *, layout="row", columns=None, quantity="von_mises", scale=1.0, title="", limits=None,
           labels=(), direction=(0, -1, 0), up=(0, 0, 1), size=(1200, 500), edges=False, radius=None, zoom=1.0):
    """Draws frames (vtkUnstructuredGrid) into a PNG."""
    ranges = [scaled(grid, quantity, scale) for grid in grids]
    table = colour_map(limits or (min(r[0] for r in ranges), max(r[1] for r in ranges)))
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(*size)
    window.SetMultiSamples(8)
    strip = 80 / size[1]
    renderer_in(window, (0, 0, 1, 1))  # white behind panels that stay empty
    bounds = bounds_of(grids)
    radii = {id(grid): radius[min(i, len(radius) - 1)] if radius else None for i, grid in enumerate(grids)}
    groups = [grids] if layout == "scene" else [[grid] for grid in grids]
    for i, (group, viewport) in enumerate(zip(groups, panels(len(groups), layout, columns, strip))):
        renderer = renderer_in(window, viewport)
        for grid in group:
            renderer.AddActor(body_actor(grid, table, radii[id(grid)], edges))
        if layout == "scene":
            for grid, text in zip(grids, labels):
                renderer.AddViewProp(note(text, grid, bounds, direction, up))
        elif i < len(labels):
            renderer.AddViewProp(caption(labels[i]))
        width, height = ((viewport[k + 2] - viewport[k]) * size[k] for k in range(2))
        aim(renderer, bounds, direction, up, zoom, width / height)
    renderer_in(window, (0, 0, 1, strip)).AddViewProp(legend(table, title or quantity))
    window.Render()
    picture = vtk.vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(str(output))
    writer.SetCompressionLevel(9)
    writer.SetInputConnection(picture.GetOutputPort())
    writer.Write()


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("output")
    parser.add_argument("frames", nargs="+")
    parser.add_argument("--layout", choices=("row", "column", "grid", "scene"), default="row")
    parser.add_argument("--columns", type=int, help="of the grid")
    parser.add_argument("--quantity", default="von_mises")
    parser.add_argument("--scale", type=float, default=1.0, help="factor of the quantity, as in 1e-3 for kPa")
    parser.add_argument("--title", default="")
    parser.add_argument("--range", dest="limits", type=float, nargs=2)
    parser.add_argument("--labels", nargs="*", default=[])
    parser.add_argument("--from", dest="direction", type=float, nargs=3, default=(0, -1, 0), help="where the eye is")
    parser.add_argument("--up", type=float, nargs=3, default=(0, 0, 1))
    parser.add_argument("--size", type=int, nargs=2, default=(1200, 500))
    parser.add_argument("--edges", action="store_true")
    parser.add_argument("--radius", type=float, nargs="+", help="draw spheres of this radius at the particles")
    parser.add_argument("--zoom", type=float, default=1.0)
    return parser.parse_args()


def require_display():
    """VTK's window needs an X server, even for a picture that nobody sees."""
    if os.environ.get("DISPLAY"):
        return
    if shutil.which("xvfb-run") is None:
        raise SystemExit("no display; install the package xvfb")
    os.execvp("xvfb-run", ["xvfb-run", "-a", sys.executable, *sys.argv])


def main():
    require_display()
    options = vars(arguments())
    grids = [read_frame(path) for path in options.pop("frames")]
    render(options.pop("output"), grids, **options)


if __name__ == "__main__":
    main()
