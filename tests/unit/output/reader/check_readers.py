"""Opens the files of write_samples with VTK's readers and compares what they see with what was written."""
import json
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

SKIPPED = 77
try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
    from vtkmodules.vtkIOHDF import vtkHDFReader
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    import numpy as np
except ImportError as error:
    print(f"skipped: {error} (Debian: python3-vtk9 and python3-numpy)")
    sys.exit(SKIPPED)

F = np.array([[1.3, 0.2, 0.0], [0.1, 1.1, 0.0], [0.0, 0.0, 0.9]])
STRESS = np.array([3e6, 1e6, 0.0, 1e6, -2e6, 5e5, 0.0, 5e5, 4e6])
SHIFT = np.array([0.5, -0.25, 2.0])
X = np.array([[0.25 + 0.5 * (i & 1), 0.25 + 0.5 * (i >> 1 & 1), 0.25 + 0.5 * (i >> 2)] for i in range(8)])
COMPONENTS = {
    "reference_position": 3, "position": 3, "displacement": 3, "velocity": 3, "force": 3, "internal_force": 3,
    "contact_force": 3, "external_force": 3, "deformation_gradient": 9, "first_piola_kirchhoff": 9,
    "cauchy_stress": 9, "von_mises": 1, "pressure": 1, "volume": 1, "J": 1, "mass": 1, "energy_density": 1, "plastic_strain": 1, "plastic_strain": 1,
    "body": 1, "material": 1, "particle_id": 1,
}


def opened(reader, path):
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def check_quantities(data, count):
    names = {data.GetArrayName(i) for i in range(data.GetNumberOfArrays())}
    assert names == set(COMPONENTS), names ^ set(COMPONENTS)
    for name, components in COMPONENTS.items():
        array = data.GetArray(name)
        assert array.GetNumberOfComponents() == components, name
        assert array.GetNumberOfTuples() == count, name
    values = {name: vtk_to_numpy(data.GetArray(name)) for name in COMPONENTS}
    assert np.array_equal(values["reference_position"], X)
    assert np.abs(values["position"] - (X @ F.T + SHIFT)).max() < 1e-15
    assert np.array_equal(values["deformation_gradient"], np.tile(F.ravel(), (count, 1)))
    assert np.abs(values["cauchy_stress"] - STRESS).max() < 1e-8
    assert np.array_equal(values["velocity"][:, 0], 1.0 + np.arange(8))
    assert np.array_equal(values["particle_id"], np.arange(8))
    assert values["body"].dtype == np.int32


def check_time(grid, time):
    assert grid.GetFieldData().GetArray("TimeValue").GetValue(0) == time


def check_particles(grid, time):
    assert (grid.GetNumberOfPoints(), grid.GetNumberOfCells()) == (8, 8)
    assert all(grid.GetCellType(i) == 1 and grid.GetCell(i).GetPointId(0) == i for i in range(8))
    assert np.abs(vtk_to_numpy(grid.GetPoints().GetData()) - (X @ F.T + SHIFT)).max() < 1e-15
    check_quantities(grid.GetPointData(), 8)
    check_time(grid, time)


def check_mixed(grid, time):
    """Positions and deformation gradients in double, stresses in single precision."""
    points = vtk_to_numpy(grid.GetPoints().GetData())
    assert np.abs(points - (X @ F.T + SHIFT)).max() < 1e-15
    data = grid.GetPointData()
    assert {data.GetArrayName(i) for i in range(data.GetNumberOfArrays())} == set(COMPONENTS)
    stress, gradient = vtk_to_numpy(data.GetArray("cauchy_stress")), vtk_to_numpy(data.GetArray("deformation_gradient"))
    assert stress.dtype == np.float32 and np.abs(stress - STRESS).max() < 1e-7 * np.abs(STRESS).max()
    assert gradient.dtype == np.float64 and np.array_equal(gradient, np.tile(F.ravel(), (8, 1)))
    check_time(grid, time)


def cell_volumes(grid):
    sizes = vtkCellSizeFilter()
    sizes.SetInputData(grid)
    sizes.Update()
    return vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Volume"))


def check_polyhedra(grid, time):
    assert (grid.GetNumberOfPoints(), grid.GetNumberOfCells()) == (64, 8)
    assert all(grid.GetCellType(i) == 42 and grid.GetCell(i).GetNumberOfFaces() == 6 for i in range(8))
    check_quantities(grid.GetCellData(), 8)
    volumes = cell_volumes(grid)
    assert np.abs(volumes - 0.125 * np.linalg.det(F)).max() < 1e-14, volumes
    check_time(grid, time)


def check_tetrahedra(grid, time):
    assert (grid.GetNumberOfPoints(), grid.GetNumberOfCells()) == (8, 2)
    assert all(grid.GetCellType(i) == 10 for i in range(2))
    check_quantities(grid.GetPointData(), 8)
    volumes = cell_volumes(grid)
    expected = np.linalg.det(F) * np.array([np.linalg.det(X[[1, 2, 4]] - X[0]), np.linalg.det(X[[2, 1, 7]] - X[3])]) / 6
    assert np.abs(np.abs(volumes) - np.abs(expected)).max() < 1e-14, (volumes, expected)
    check_time(grid, time)


def series_frames(folder, name):
    with open(os.path.join(folder, name)) as file:
        return [(entry["name"], entry["time"]) for entry in json.load(file)["files"]]


def pvd_frames(folder, name):
    sets = ElementTree.parse(os.path.join(folder, name)).getroot().find("Collection")
    return [(entry.get("file"), float(entry.get("timestep"))) for entry in sets]


def check_series(folder, frames, reader, check):
    assert [time for _, time in frames] == [0.0, 0.25, 0.5], frames
    for name, time in frames:
        path = os.path.join(folder, name)
        assert reader().CanReadFile(path), name
        check(opened(reader(), path), time)
        print("read", path)


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, folder], check=True)
        check_series(folder, series_frames(folder, "fields.hdf.series"), vtkHDFReader, check_particles)
        check_series(folder, pvd_frames(folder, "fields.pvd"), vtkXMLUnstructuredGridReader, check_particles)
        check_series(folder, pvd_frames(folder, "cells.pvd"), vtkXMLUnstructuredGridReader, check_polyhedra)
        mixed = os.path.join(folder, "mixed")
        check_series(mixed, series_frames(mixed, "fields.hdf.series"), vtkHDFReader, check_mixed)
        tetrahedra = os.path.join(folder, "tetrahedra")
        check_series(tetrahedra, pvd_frames(tetrahedra, "cells.pvd"), vtkXMLUnstructuredGridReader, check_tetrahedra)
        for name, _ in series_frames(folder, "fields.csv.series"):
            table = np.genfromtxt(os.path.join(folder, name), delimiter=",", names=True, deletechars="")
            assert len(table) == 8
            difference = table["displacement_x[m]"] - (X @ F.T + SHIFT - X)[:, 0]
            assert np.abs(difference).max() < 1e-15


if __name__ == "__main__":
    main(sys.argv[1])
