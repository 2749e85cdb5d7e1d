# SPDX-License-Identifier: GPL-3.0-or-later
"""Data sets that are read through their methods yield what the compiled filters make of them."""

import unittest
import warnings

import numpy as np
from filter_testing import ANY, chosen
from scatteredisopoints import (
    Samples, body, contour, slice_samples, vtkScatteredBodyFilter, vtkScatteredIsopointFilter,
    vtkScatteredIsosurfaceFilter, vtkScatteredSliceFilter)
from scatteredisopoints._options import number_of, property_name
from vtk_data import (
    amr_of, assert_same, blocks_of, centers_in, cloud_of, configured, named, observed, points_of, positions_in,
    set_all)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkBitArray, vtkMath
from vtkmodules.vtkCommonDataModel import (
    VTK_EMPTY_CELL, VTK_TETRA, vtkAMRUtilities, vtkCellArray, vtkCylinder, vtkHyperTreeGrid, vtkImageData,
    vtkMultiBlockDataSet, vtkPartitionedDataSet, vtkPartitionedDataSetCollection, vtkPlane, vtkPolyData,
    vtkRectilinearGrid, vtkStructuredGrid, vtkTable, vtkUnstructuredGrid)
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkCutter, vtkDelaunay3D

RANDOM = np.random.default_rng(1)


def add_arrays(positions, attributes):
    """Distances from the middle, and further arrays. @returns an isovalue"""
    values = np.linalg.norm(positions - np.nanmean(positions, axis=0), axis=1)
    for name, numbers in (("distance", values), ("place", positions),
                          ("count", np.arange(len(positions), dtype=np.int32)), ("short", values[:1])):
        attributes.AddArray(named(name, numbers))
    attributes.SetActiveVectors("place")
    attributes.SetPedigreeIds(named("ids", np.arange(len(positions))))
    return float(np.nanmedian(values))


def cloud(count=3000, dtype=np.float64):
    return cloud_of(RANDOM.random((count, 3)).astype(dtype))


def image():
    data = set_all(vtkImageData(), Extent=(-3, 12, 2, 15, 5, 19), Spacing=(0.1, 0.07, 0.13), Origin=(1e3, -3.3, 0.7))
    matrix = np.eye(3)
    vtkMath.QuaternionToMatrix3x3((0.5, 0.1, 0.7, 0.3), matrix)
    if hasattr(data, "SetDirectionMatrix"):
        data.SetDirectionMatrix(*matrix.ravel())
    return data


def flat_image():
    return set_all(vtkImageData(), Dimensions=(40, 30, 1))


def rectilinear():
    return set_all(vtkRectilinearGrid(), Dimensions=(12, 13, 14), **{
        axis + "Coordinates": numpy_to_vtk(np.cumsum(RANDOM.random(count)).astype(np.float32), deep=True)
        for axis, count in (("X", 12), ("Y", 13), ("Z", 14))})


def structured(dimensions=(11, 12, 13)):
    data = vtkStructuredGrid()
    data.SetDimensions(*dimensions)
    z, y, x = np.meshgrid(*(np.arange(float(count)) for count in dimensions[::-1]), indexing="ij")
    positions = np.stack([x.ravel(), y.ravel(), z.ravel()], axis=-1)
    data.SetPoints(points_of(positions + 0.2 * RANDOM.random(positions.shape)))
    return data


def tetrahedra(dtype=np.float32):
    data = vtkUnstructuredGrid()
    data.SetPoints(points_of(RANDOM.random((900, 3)).astype(dtype)))
    data.Allocate(3000)
    for corners in RANDOM.integers(0, 900, (3000, 4)):
        data.InsertNextCell(VTK_TETRA, 4, corners.tolist())
        if corners[0] % 50 == 0:
            data.InsertNextCell(VTK_EMPTY_CELL, 0, [])
    return data


def polygons():
    data = cloud(900, np.float32)
    for set_, size in ((data.SetVerts, 1), (data.SetLines, 2), (data.SetPolys, 3)):
        cells = vtkCellArray()
        for corners in RANDOM.integers(0, 900, (800, size)):
            cells.InsertNextCell(size, corners.tolist())
        set_(cells)
    return data


def prepared(data, of_cells=False, ghosts=""):
    """A data set with arrays, and an isovalue for them."""
    points, cells = data.GetPointData(), data.GetCellData()
    isovalue = add_arrays(centers_in(data) if of_cells else positions_in(data), cells if of_cells else points)
    for kind, attributes, count, bits in (("points", points, data.GetNumberOfPoints(), [1, 2]),
                                          ("cells", cells, data.GetNumberOfCells(), [1, 8, 32, 32])):
        if kind in ghosts:
            marks = RANDOM.choice(np.array([0] * 9 + bits, np.uint8), count)
            attributes.AddArray(named("vtkGhostType", marks))
    return data, isovalue


class DataSetsTest(unittest.TestCase):
    def same(self, data, values, isovalues, triangles=False, **options):
        """Compares what Samples and the filter yield."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            ours = Samples(data, values).contour(isovalues, triangles=triangles, **options)
        filter_ = configured(
            vtkScatteredIsosurfaceFilter if triangles else vtkScatteredIsopointFilter, data, isovalues,
            **{property_name(name): number_of(name, value, 0) for name, value in options.items()})
        observed(filter_)
        if values is not None:
            chosen(filter_, values, ANY)
        filter_.Update()
        assert_same(self, ours.polydata, filter_.GetOutput())
        return len(ours)

    def test_all_kinds_of_data(self):
        for make in (image, flat_image, rectilinear, structured, lambda: structured((9, 1, 10)),
                     tetrahedra, lambda: tetrahedra(np.float64), polygons):
            for of_cells in (False, True):
                for ghosts in ("", "points", "cells", "points cells"):
                    data, isovalue = prepared(make(), of_cells, ghosts)
                    with self.subTest(kind=data.GetClassName(), of_cells=of_cells, ghosts=ghosts):
                        count = self.same(data, "distance", [isovalue])
                        self.assertGreater(count, 10)

    def test_clouds(self):
        for dtype in (np.float32, np.float64):
            data, isovalue = prepared(cloud(dtype=dtype), False, "points")
            self.same(data, "distance", [isovalue, 0.2], triangles=True)
            exact = dict(triangles=True, regularize=False)
            self.same(data, "distance", [isovalue, 0.2], **exact)
            self.same(data, "distance", [isovalue, 0.2], capping=True, projection=None, **exact)
            self.same(data, "count", [700.5, 20.5], compute_gradients=True)
            data.GetPointData().SetActiveScalars("distance")
            self.same(data, None, [isovalue], projection="no_projection")

    def test_positions_that_are_integers(self):
        positions = np.floor(40 * RANDOM.random((3000, 3)))
        values = np.linalg.norm(positions - 20, axis=1)
        for kinds in (("i4",), ("u1",), ("i1", "f4"), ("i8", "f8")):
            blocks = [cloud_of(positions.astype(kind), values) for kind in kinds]
            for triangles in (False, True):
                self.assertGreater(self.same(blocks_of(*blocks), "values", [12.3], triangles=triangles), 100)
            self.assertGreater(len(contour(blocks[0], "values", 12.3, threads=1).splats()), 1000)

    def test_composites(self):
        first, isovalue = prepared(cloud(), ghosts="points")
        second, _ = prepared(image())
        third, _ = prepared(cloud(2000, np.float32))
        third.GetPointData().RemoveArray("count")
        without = cloud(100)
        blocks = blocks_of(first, blocks_of(third, None, without), None, second)
        self.assertGreater(self.same(blocks, "distance", [isovalue]), 100)
        with self.assertWarnsRegex(RuntimeWarning, "100 points or cells are left out"):
            Samples(blocks, "distance").contour(isovalue)
        parts = vtkPartitionedDataSet()
        parts.SetPartition(0, first)
        parts.SetPartition(1, third)
        collection = vtkPartitionedDataSetCollection()
        collection.SetPartitionedDataSet(0, parts)
        for data in (parts, collection):
            self.assertGreater(self.same(data, "distance", [isovalue]), 100)

    def test_isovalues_are_named_like_the_first_active_scalars_with_a_name(self):
        blocks = vtkMultiBlockDataSet()
        for i, name in enumerate((None, "second", "third")):
            block = cloud(1000)
            scalars = numpy_to_vtk(np.linspace(0.0, 1.0, 1000))
            scalars.SetName(name)
            block.GetPointData().SetScalars(scalars)
            blocks.SetBlock(i, block)
        self.assertIn("second", Samples(blocks).contour(0.5).arrays)

    def test_levels_of_an_amr(self):
        levels = amr_of("distance", lambda p: np.linalg.norm(p - 0.5, axis=1), ((0, 0, 10), (1, 6, 8)))
        vtkAMRUtilities.BlankCells(levels)
        self.assertGreater(self.same(levels, "distance", [0.3]), 100)

    def test_arrays_of_other_layouts(self):
        data, isovalue = prepared(cloud())
        bits = vtkBitArray()
        bits.SetName("bits")
        for i in range(3000):
            bits.InsertNextValue(i % 3 == 0)
        data.GetPointData().AddArray(bits)
        data.GetPointData().AddArray(named("words", ["word"] * 3000))
        ours = Samples(data, "distance").contour(isovalue)
        self.assertEqual(set(np.unique(ours.arrays["bits"])), {0, 1})
        self.assertNotIn("words", ours.arrays)
        for name, error, reason in (("words", TypeError, "numbers"), ("place", ValueError, "3 components"),
                                    ("short", ValueError, "1 values for 3000")):
            with self.assertRaisesRegex(error, name + ".*" + reason):
                Samples(data, name)

    def test_arrays_that_are_reallocated(self):
        data, isovalue = prepared(cloud())
        samples = Samples(data, "distance")
        expected = samples.contour(isovalue)
        data.GetPointData().GetArray("place").Squeeze()
        same = samples.contour(isovalue)
        np.testing.assert_array_equal(same.arrays["place"], expected.arrays["place"])
        data.GetPointData().GetArray("place").InsertNextTuple3(0.0, 0.0, 0.0)
        with self.assertRaisesRegex(ValueError, "place.*changed.*3000.*3001"):
            samples.contour(isovalue)
        data.GetPoints().Reset()
        with self.assertRaisesRegex(ValueError, "positions.*changed"):
            samples.replace_values(np.zeros(3000))

    def test_results_share_their_memory(self):
        """Outputs of filters take the arrays of results, which only those have, without a copy."""
        data, isovalue = prepared(cloud())
        surface = contour(data, "distance", isovalue)
        shared, copy = surface._into_polydata(), surface.polydata
        for name in (None, *surface.arrays):
            memory, copied = (vtk_to_numpy(each.GetPointData().GetArray(name) if name else each.GetPoints().GetData())
                              for each in (shared, copy))
            ours = surface.arrays[name] if name else surface.points
            self.assertTrue(np.shares_memory(memory, ours), name)
            self.assertFalse(np.shares_memory(copied, ours), name)

    def test_malformed_data(self):
        data = polygons()
        data.SetPoints(None)
        data.GetCellData().AddArray(named("of cells", np.zeros(data.GetNumberOfCells())))
        with self.assertRaisesRegex(ValueError, "no points"):
            Samples(data, "of cells")

    def test_names_that_meet(self):
        data, isovalue = prepared(cloud())
        data.GetPointData().AddArray(named("values", np.arange(3000.0)))
        with self.assertWarnsRegex(RuntimeWarning, 'replace.*"values"'):
            Samples(data, np.arange(3000.0)).contour(isovalue + 7)

    def test_field_data_are_copied(self):
        data, isovalue = prepared(cloud())
        data.GetFieldData().AddArray(named("TimeValue", [1.5]))
        for surface in (Samples(data, "distance").contour(isovalue), contour(data, "distance", isovalue)):
            copied = surface.polydata.GetFieldData().GetArray("TimeValue")
            self.assertEqual(copied.GetValue(0), 1.5)

    def test_what_has_no_samples(self):
        data, _ = prepared(cloud())
        for arguments, error, text in (
                ((vtkTable(),), TypeError, "convert.*points"), ((vtkHyperTreeGrid(),), TypeError, "CellCenters"),
                ((vtkPolyData(), "distance"), ValueError, "no points"),
                ((vtkMultiBlockDataSet(), "distance"), ValueError, "no points"),
                ((data, "speed"), ValueError, 'speed.*distance, place'), ((cloud(),), ValueError, "active.*scalars"),
                ((vtkPolyData(), np.zeros(5)), ValueError, "no points"),
                ((data, np.zeros(99)), ValueError, "99 values.*3000"),
                ((data, np.zeros((7, 3))), ValueError, r"\(7, 3\)"),
                ((vtkMultiBlockDataSet(), np.zeros(99)), TypeError, "name")):
            with self.subTest(text), self.assertRaisesRegex(error, text):
                Samples(*arguments)
        with self.assertRaisesRegex(TypeError, "add them to the data set"):
            Samples(data, "distance").contour(0.3, arrays={"other": np.zeros(3000)})

class Slices(unittest.TestCase):
    def test_linear_slices_are_those_of_the_delaunay_tetrahedralization(self):
        """The vertices and, up to diagonals, the polygons of vtkCutter."""
        for seed in range(50):
            random = np.random.default_rng(seed)
            positions, plane = random.random((150, 3)), vtkPlane()
            plane.SetNormal(random.normal(size=3))
            plane.SetOrigin(0.5, 0.5, 0.5)
            data = cloud_of(positions)
            data.GetPointData().AddArray(named("sum", positions @ [1, 2, 3]))
            tetrahedra = set_all(vtkDelaunay3D(), InputData=data, Tolerance=0, Offset=1e5)
            cutter = set_all(vtkCutter(), InputConnection=tetrahedra.GetOutputPort(), CutFunction=plane,
                             GenerateTriangles=False, OutputPointsPrecision=1)
            cutter.Update()
            expected = cutter.GetOutput()
            sliced = slice_samples(data, arrays="sum", function=plane, interpolation="linear", drop_gaps=False,
                                   regularize=False)
            distances = np.linalg.norm(positions_in(expected)[:, None] - sliced.points, axis=2)
            vertices = distances.argmin(axis=1)
            self.assertEqual(sorted(vertices), list(range(len(sliced))))
            self.assertLess(distances.min(axis=1).max(), 1e-12)
            np.testing.assert_allclose(sliced.arrays["sum"], sliced.points @ [1, 2, 3])
            triangles = set(map(frozenset, sliced.triangles.tolist()))
            for i in range(expected.GetNumberOfCells()):
                cell = expected.GetCell(i).GetPointIds()
                a, b, c, *d = (vertices[cell.GetId(k)] for k in range(cell.GetNumberOfIds()))
                cuts = [{frozenset((a, b, c)), *(frozenset((a, c, each)) for each in d)},
                        {frozenset((a, b, *d)), frozenset((b, c, *d))}]
                found = [cut for cut in cuts if cut <= triangles]
                self.assertEqual(len(found), 1)
                triangles -= found[0]
            self.assertEqual(triangles, set())

    def test_functions_of_vtk(self):
        data = cloud(20000, np.float32)
        turned = vtkTransform()
        turned.RotateX(30)
        for transform in (None, turned):
            cylinder = set_all(vtkCylinder(), Center=(0.5, 0.5, 0.5), Radius=0.3, Transform=transform)
            sliced = slice_samples(data, function=cylinder)
            self.assertGreater(len(sliced), 300)
            self.assertLess(max(abs(cylinder.FunctionValue(point)) for point in sliced.points.tolist()), 1e-6)
            plane = set_all(vtkPlane(), Origin=(0.2, 0.4, 0.6), Normal=(0, 0, 1), Transform=transform)
            sliced = slice_samples(data, function=plane, offsets=0.05)
            self.assertLess(max(abs(plane.FunctionValue(point) - 0.05) for point in sliced.points.tolist()), 1e-6)

    def test_the_filter_has_the_same_bytes(self):
        for data in (prepared(cloud(dtype=np.float32))[0], prepared(cloud())[0], prepared(image())[0]):
            center = data.GetCenter()
            for function in (set_all(vtkPlane(), Normal=(1, 2, 3), Origin=center),
                             set_all(vtkCylinder(), Center=center, Radius=data.GetLength() / 8)):
                for interpolation, regularize in ((0, True), (1, False)):
                    filtered = set_all(vtkScatteredSliceFilter(), InputDataObject=data, CutFunction=function,
                                       Interpolation=interpolation, Regularize=regularize)
                    filtered.Update()
                    sliced = slice_samples(data, function=function, regularize=regularize,
                                           interpolation=("fits", "linear")[interpolation])
                    self.assertGreater(len(sliced), 100)
                    assert_same(self, filtered.GetOutput(), sliced.polydata)

    def test_all_arrays_of_points_or_cells(self):
        data, _ = prepared(image())
        sliced = slice_samples(data, normal=(1, 2, 3))
        self.assertEqual(set(sliced.arrays), {"distance", "place", "count", "ids"})
        self.assertEqual(sliced.polydata.GetPointData().GetPedigreeIds().GetName(), "ids")
        np.testing.assert_allclose(sliced.arrays["place"], sliced.points, atol=1e-9)
        self.assertEqual(set(slice_samples(data, arrays=["place"]).arrays), {"place"})
        self.assertEqual(set(Samples(data, "distance").slice("y").arrays), set(sliced.arrays))
        of_cells, _ = prepared(image(), of_cells=True)
        self.assertEqual(set(slice_samples(of_cells).arrays), set(sliced.arrays))
        filtered = set_all(vtkScatteredBodyFilter(), InputDataObject=of_cells)
        filtered.Update()
        assert_same(self, filtered.GetOutput(), body(of_cells).polydata)


if __name__ == "__main__":
    unittest.main()
