# SPDX-License-Identifier: GPL-3.0-or-later
"""The C library and the VTK filters yield the same bytes: TestAgainstFilters.py LIBRARY EXAMPLE [N]

LIBRARY is the C library, EXAMPLE the program of Examples/contour.c. Compares all arrays of N
of the random combinations of inputs and options that fingerprint.py has.
"""

import ctypes
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from scatteredisopoints import (
    vtkIsopointSplatPolygons,
    vtkScatteredIsopointFilter,
    vtkScatteredIsosurfaceFilter,
)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkPolyData

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "Examples"), str(ROOT / "Testing/Python")]
import contour_ctypes as contour  # noqa: E402
import fingerprint  # noqa: E402

TYPES = [np.float32, np.float64, np.int8, np.uint8, np.int16, np.uint16, np.int32, np.uint32,
         np.int64, np.uint64]
(POINTS, ISOVALUES, NORMALS, GRADIENTS, ORDERS, EDGES, PARAMETERS, TRIANGLES, RADII, AXES, POLYGONS,
 SPLAT_VERTICES, SPLAT_NORMALS, SPLAT_POINTS, SPLAT_TRIANGLES) = range(15)
POINT_ARRAYS = {"Normals": NORMALS, "Gradients": GRADIENTS, "ProjectionOrder": ORDERS,
                "Radius": RADII}
CELL_ARRAYS = {"SplatAxis": AXES, "SplatPolygon": POLYGONS}


def check(condition, message):
    if not condition:
        sys.exit("failed: " + message)


def as_array(numbers):
    """An isopoint_array of a NumPy array with any strides, which has to outlive it."""
    rows = numbers.reshape(len(numbers), -1)
    return contour.Array(rows.ctypes.data, TYPES.index(rows.dtype), rows.shape[1], len(rows),
                         rows.strides[0], rows.strides[1])


def numbers_of(array):
    if array.count == 0:
        return np.empty((0, array.components), TYPES[array.type])
    size = array.count * array.components * np.dtype(TYPES[array.type]).itemsize
    numbers = np.frombuffer(ctypes.string_at(array.data, size), TYPES[array.type])
    return numbers.reshape(array.count, array.components)


def options_of(filter_):
    names = {"projection": "Projection", "normal_method": "NormalMethod", "drop_gaps": "DropGaps",
             "compute_normals": "ComputeNormals", "compute_gradients": "ComputeGradients",
             "compute_projection_orders": "ComputeProjectionOrders",
             "output_points_precision": "OutputPointsPrecision", "angle": "Angle",
             "minimum_spacing": "MinimumSpacing", "number_of_neighbors": "NumberOfNeighbors",
             "compute_splats": "ComputeSplats", "regularize": "Regularize"}
    options = {option: getattr(filter_, "Get" + name)() for option, name in names.items()
               if hasattr(filter_, "Get" + name)}
    options["triangles"] = int(isinstance(filter_, vtkScatteredIsosurfaceFilter))
    return options


def same(name, ours, theirs):
    theirs = theirs.reshape(len(theirs), -1) if len(theirs) else theirs.reshape(0, ours.shape[1])
    check(ours.dtype == theirs.dtype and ours.shape == theirs.shape and
          ours.tobytes() == theirs.tobytes(),
          f"{name}: {ours.dtype} {ours.shape}, the filter's {theirs.dtype} {theirs.shape}")


def compare_splats(extractor, surface, output, scale):
    """The mesh of splats, and the arrays at its vertices."""
    polygons = vtkIsopointSplatPolygons()
    polygons.SetInputData(output)
    polygons.SetRadiusScale(scale)
    polygons.Update()
    mesh = polygons.GetOutputDataObject(0)
    extractor.check(extractor.library.isopoint_make_splat_mesh(surface, ctypes.c_double(scale)))
    if mesh.GetNumberOfPoints() == 0:
        check(extractor.array(surface, SPLAT_VERTICES).count == 0, "no splats")
        return
    points = mesh.GetPointData()
    for name, ours, theirs in (
            ("vertices", SPLAT_VERTICES, mesh.GetPoints().GetData()),
            ("vertex normals", SPLAT_NORMALS, points.GetNormals()),
            ("triangles", SPLAT_TRIANGLES, mesh.GetPolys().GetConnectivityArray()),
            ("vertex points", SPLAT_POINTS, points.GetArray("vtkOriginalPointIds"))):
        ours = numbers_of(extractor.array(surface, ours))
        theirs = vtk_to_numpy(theirs).reshape(ours.shape)
        if theirs.dtype == np.int32:
            theirs = theirs.astype(np.int64)  # VTK stores cells in either
        same(f"{name} at scale {scale}", ours, theirs)
    vectors = np.ascontiguousarray(vtk_to_numpy(output.GetPointData().GetArray("vectors")))
    means = np.empty((mesh.GetNumberOfPoints(), 3))
    extractor.check(extractor.library.isopoint_average_at_splat_vertices(
        surface, ctypes.byref(as_array(vectors)), means.ctypes.data_as(ctypes.c_void_p)))
    same("means", means, vtk_to_numpy(points.GetArray("vectors")))


def compare(library, number, filter_class):
    """@returns the number of points; None if the input is not one cloud"""
    filter_, _ = fingerprint.configured(number, filter_class)
    data = filter_.GetInputDataObject(0, 0)
    if not isinstance(data, vtkPolyData):
        return None
    filter_.SetContourBlocks(False)
    filter_.Update()
    output = filter_.GetOutputDataObject(0)

    extractor = contour.Extractor(library)
    ghosts = data.GetPointData().GetArray(vtkDataSetAttributes.GhostArrayName())
    arrays = data.GetPointData()
    positions = vtk_to_numpy(data.GetPoints().GetData())
    values = vtk_to_numpy(arrays.GetArray("values"))
    excluded = vtk_to_numpy(ghosts) if ghosts else None
    extractor.set_samples(as_array(positions), as_array(values),
                          None if excluded is None else as_array(excluded))
    isovalues = [filter_.GetValue(i) for i in range(filter_.GetNumberOfContours())]
    surface = extractor.extract(isovalues, **options_of(filter_))

    count = output.GetNumberOfPoints()
    check(extractor.array(surface, ISOVALUES).count == count, f"{count} points")
    if count:
        same("points", numbers_of(extractor.array(surface, POINTS)),
             vtk_to_numpy(output.GetPoints().GetData()))
    for names, attributes in ((POINT_ARRAYS, output.GetPointData()),
                              (CELL_ARRAYS, output.GetCellData())):
        for name, id_ in names.items():
            theirs = attributes.GetArray(name)
            ours = numbers_of(extractor.array(surface, id_))
            same(name, ours, vtk_to_numpy(theirs) if theirs else ours[:0])
    scalars = output.GetPointData().GetArray("values")
    if scalars:
        ours = numbers_of(extractor.array(surface, ISOVALUES))
        same("isovalues", ours.astype(vtk_to_numpy(scalars).dtype), vtk_to_numpy(scalars))
    triangles = numbers_of(extractor.array(surface, TRIANGLES))
    same("triangles", triangles,
         vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3))
    for name in ("vectors", "counts"):
        theirs = vtk_to_numpy(output.GetPointData().GetArray(name))
        of_samples = np.ascontiguousarray(vtk_to_numpy(arrays.GetArray(name)))
        ours = np.empty(theirs.shape, theirs.dtype)
        extractor.check(library.isopoint_interpolate(
            surface, ctypes.byref(as_array(of_samples)), ours.ctypes.data_as(ctypes.c_void_p)))
        check(ours.tobytes() == theirs.tobytes(), name)
    library.isopoint_get_unprojected_count.restype = ctypes.c_int64
    check(library.isopoint_get_unprojected_count(surface) ==
          filter_.GetNumberOfUnprojectedPoints(), "unprojected points")
    options = options_of(filter_)
    if options.get("compute_splats") and options["compute_normals"] and count:
        for scale in (1.0, 0.4):
            compare_splats(extractor, surface, output, scale)
    library.isopoint_destroy_surface(surface)
    extractor.close()
    return count


def compare_example(program):
    """The triangles of the example in C."""
    random = np.random.default_rng(1)
    positions = random.random((20000, 3)).astype(np.float32)
    values = np.sin(7 * positions[:, 0]) + np.cos(5 * positions[:, 1]) + positions[:, 2]
    samples = np.column_stack([positions, values]).astype(np.float32)
    with tempfile.TemporaryDirectory() as folder:
        samples.tofile(folder + "/samples")
        subprocess.run([program, folder + "/samples", "0.5", folder + "/surface.ply"], check=True)
        content = pathlib.Path(folder, "surface.ply").read_bytes()
    data, points = vtkPolyData(), vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(samples[:, :3]), deep=True))
    data.SetPoints(points)
    data.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(samples[:, 3]), deep=True))
    filter_ = vtkScatteredIsosurfaceFilter()
    filter_.SetInputData(data)
    filter_.SetValue(0, 0.5)
    filter_.Update()
    output = filter_.GetOutput()
    vertices = np.hstack([vtk_to_numpy(output.GetPoints().GetData()),
                          vtk_to_numpy(output.GetPointData().GetNormals())]).astype("<f4")
    corners = vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    faces = np.empty(len(corners), [("count", "u1"), ("ids", "<i4", 3)])
    faces["count"], faces["ids"] = 3, corners
    check(len(corners) > 3000, f"{len(corners)} triangles")
    check(content.split(b"end_header\n", 1)[1] == vertices.tobytes() + faces.tobytes(),
          "the example's triangles")


def main(path, program, count=60):
    library = contour.load(path)
    points = [compare(library, number, filter_class) for number in range(int(count))
              for filter_class in (vtkScatteredIsopointFilter, vtkScatteredIsosurfaceFilter)]
    compared = [number for number in points if number is not None]
    check(sum(number > 0 for number in compared) > len(points) // 4, f"{compared}")
    compare_example(program)
    print(f"{len(compared)} combinations, {sum(compared)} points: the same bytes")


if __name__ == "__main__":
    main(*sys.argv[1:])
