"""Writes the files of this folder: `python3 write.py`, with VTK and meshio installed."""

import itertools
from pathlib import Path

import meshio
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk

FOLDER = Path(__file__).parent
TYPES = ["i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"]


def arrays(count):
    """Arrays of all types, with values that are exact in each."""
    index = numpy.arange(count)
    points = numpy.stack([0.5 * index, index % 7 - 3.0, numpy.zeros(count)], axis=1)
    values = {name: (index - 3 if name[0] in "if" else index + 3).astype(name) for name in TYPES}
    values["velocity [m/s]"] = numpy.stack([0.25 * index, -index, index % 3], axis=1).astype("f4")
    return points, values


def grid(kind, count, few=False):
    points, values = arrays(count)
    data = kind()
    places = vtk.vtkPoints()
    places.SetDataTypeToDouble()
    places.SetData(numpy_to_vtk(points, deep=True))
    data.SetPoints(places)
    cells = vtk.vtkCellArray()
    for index in range(count):
        cells.InsertNextCell(1, [index])
    if kind is vtk.vtkPolyData:
        data.SetVerts(cells)
    else:
        data.SetCells(vtk.VTK_VERTEX, cells)
    for name, array in values.items():
        if few and name not in ("u1", "i8", "velocity [m/s]"):
            continue
        array = numpy_to_vtk(array, deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    of_cells = numpy_to_vtk(numpy.arange(count) + 1000.0, deep=True)
    of_cells.SetName("of_cells")
    data.GetCellData().AddArray(of_cells)
    return data


def xml(name, data, mode, compressor, header, order="little"):
    polygonal = isinstance(data, vtk.vtkPolyData)
    writer = vtk.vtkXMLPolyDataWriter() if polygonal else vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(FOLDER / name))
    writer.SetInputData(data)
    if mode == "ascii":
        writer.SetDataModeToAscii()
    elif mode == "inline":
        writer.SetDataModeToBinary()
    else:
        writer.SetDataModeToAppended()
        writer.SetEncodeAppendedData(mode == "base64")
    getattr(writer, f"SetCompressorTypeTo{compressor}")()
    writer.SetBlockSize(256)
    getattr(writer, f"SetHeaderTypeTo{header}")()
    getattr(writer, f"SetByteOrderTo{order.title()}Endian")()
    assert writer.Write() == 1


def legacy(name, data, binary, version):
    polygonal = isinstance(data, vtk.vtkPolyData)
    writer = vtk.vtkPolyDataWriter() if polygonal else vtk.vtkUnstructuredGridWriter()
    writer.SetFileName(str(FOLDER / name))
    writer.SetInputData(data)
    writer.SetFileVersion(version)
    (writer.SetFileTypeToBinary if binary else writer.SetFileTypeToASCII)()
    assert writer.Write() == 1


small = grid(vtk.vtkUnstructuredGrid, 7)
large = grid(vtk.vtkUnstructuredGrid, 36, few=True)
polygonal = grid(vtk.vtkPolyData, 7)
xml("vtk-ascii.vtu", small, "ascii", "None", "UInt32")
for mode, header in itertools.product(["inline", "raw", "base64"], ["UInt32", "UInt64"]):
    bits = header[4:]
    order = "big" if bits == "32" else "little"
    xml(f"vtk-{mode}-{bits}.vtu", small, mode, "None", header, order)
    xml(f"vtk-{mode}-zlib-{bits}.vtu", large, mode, "ZLib", header, order)
xml("vtk-polygonal.vtp", polygonal, "raw", "ZLib", "UInt64")
tiny = grid(vtk.vtkUnstructuredGrid, 7, few=True)
xml("vtk-lz4.vtu", tiny, "inline", "LZ4", "UInt32")
default = vtk.vtkXMLUnstructuredGridWriter()
default.SetFileName(str(FOLDER / "vtk-default.vtu"))
default.SetInputData(small)
assert default.Write() == 1

for polygonal_data, binary, version in itertools.product([False, True], [False, True], [42, 51]):
    data = grid(vtk.vtkPolyData if polygonal_data else vtk.vtkUnstructuredGrid, 7)
    attributes = data.GetPointData()
    attributes.SetActiveScalars("f8")
    attributes.SetActiveVectors("velocity [m/s]")
    tensors = numpy_to_vtk(numpy.arange(63.0).reshape(7, 9), deep=True)
    tensors.SetName("stress")
    attributes.SetTensors(tensors)
    normals = numpy_to_vtk(numpy.arange(21.0).reshape(7, 3) / 4, deep=True)
    normals.SetName("normal")
    for component, axis in enumerate("xyz"):
        normals.SetComponentName(component, axis)
    attributes.SetNormals(normals)
    kind, form = "polygonal" if polygonal_data else "grid", "binary" if binary else "ascii"
    legacy(f"vtk-{kind}-{form}-{version}.vtk", data, binary, version)

points, values = arrays(7)
mesh = meshio.Mesh(points, [("vertex", numpy.arange(7).reshape(-1, 1))], point_data=values)
meshio.write(FOLDER / "meshio-default.vtu", mesh)
meshio.write(FOLDER / "meshio-ascii.vtu", mesh, binary=False)
meshio.write(FOLDER / "meshio-inline.vtu", mesh, compression=None)
meshio.write(FOLDER / "meshio-lzma.vtu", mesh, compression="lzma")
points, values = arrays(36)
few = {name: values[name] for name in ("u1", "i8", "velocity [m/s]")}
mesh = meshio.Mesh(points, [("vertex", numpy.arange(36).reshape(-1, 1))], point_data=few)
meshio.write(FOLDER / "meshio-blocks.vtu", mesh)
points, values = arrays(7)
values["velocity"] = values.pop("velocity [m/s]")
mesh = meshio.Mesh(points, [("vertex", numpy.arange(7).reshape(-1, 1))], point_data=values)
for version, binary in itertools.product(["4.2", "5.1"], [False, True]):
    name = f"meshio-{'binary' if binary else 'ascii'}-{version.replace('.', '')}.vtk"
    meshio.vtk.write(FOLDER / name, mesh, fmt_version=version, binary=binary)
print("VTK", vtk.vtkVersion.GetVTKVersion(), "meshio", meshio.__version__)
