# SPDX-License-Identifier: GPL-3.0-or-later
"""Data sets that are read through their methods yield what the compiled filters make of them."""

import os
import pickle
import signal
import unittest
import warnings

import numpy as np
from scatteredisopoints import Samples, contour, contouring
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkBitArray, vtkMath, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import (
    VTK_EMPTY_CELL, VTK_TETRA, vtkAMRBox, vtkAMRUtilities, vtkCellArray, vtkHyperTreeGrid,
    vtkImageData, vtkMultiBlockDataSet, vtkOverlappingAMR, vtkPartitionedDataSet,
    vtkPartitionedDataSetCollection, vtkPolyData, vtkRectilinearGrid, vtkStructuredGrid, vtkTable,
    vtkUniformGrid, vtkUnstructuredGrid)

RANDOM = np.random.default_rng(1)


def add_arrays(data, positions, attributes, dtype=np.float64):
    """Distances from the middle, and further arrays."""
    middle = np.nanmean(positions, axis=0)
    values = np.linalg.norm(positions - middle, axis=1).astype(dtype)
    for name, numbers in (("distance", values), ("place", positions),
                          ("count", np.arange(len(positions), dtype=np.int32)), ("short", values[:1])):
        array = numpy_to_vtk(np.ascontiguousarray(numbers), deep=True)
        array.SetName(name)
        attributes.AddArray(array)
    attributes.SetActiveVectors("place")
    ids = numpy_to_vtk(np.arange(len(positions), dtype=np.int64), deep=True)
    ids.SetName("ids")
    attributes.SetPedigreeIds(ids)
    return float(np.nanmedian(values))


def add_ghosts(attributes, count, bits):
    ghosts = numpy_to_vtk(RANDOM.choice(np.array([0] * 9 + bits, np.uint8), count), deep=True)
    ghosts.SetName("vtkGhostType")
    attributes.AddArray(ghosts)


def points_of(positions):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(positions, deep=True))
    return points


def cloud(count=3000, dtype=np.float64):
    data = vtkPolyData()
    data.SetPoints(points_of(RANDOM.random((count, 3)).astype(dtype)))
    return data


def image():
    data = vtkImageData()
    data.SetExtent(-3, 12, 2, 15, 5, 19)
    data.SetSpacing(0.1, 0.07, 0.13)
    data.SetOrigin(1e3, -3.3, 0.7)
    matrix = np.eye(3)
    vtkMath.QuaternionToMatrix3x3((0.5, 0.1, 0.7, 0.3), matrix)
    if hasattr(data, "SetDirectionMatrix"):
        data.SetDirectionMatrix(*matrix.ravel())
    return data


def flat_image():
    data = vtkImageData()
    data.SetDimensions(40, 30, 1)
    return data


def rectilinear():
    data = vtkRectilinearGrid()
    data.SetDimensions(12, 13, 14)
    for count, set_ in ((12, data.SetXCoordinates), (13, data.SetYCoordinates), (14, data.SetZCoordinates)):
        set_(numpy_to_vtk(np.cumsum(RANDOM.random(count)).astype(np.float32), deep=True))
    return data


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


def centers(data):
    """Centers of cells, NaN of empty ones."""
    found = []
    for i in range(data.GetNumberOfCells()):
        bounds = np.reshape(data.GetCell(i).GetBounds(), (3, 2))
        is_empty = data.GetCell(i).GetNumberOfPoints() == 0
        found.append([np.nan] * 3 if is_empty else bounds.mean(axis=1))
    return np.array(found)


def prepared(data, of_cells, ghosts):
    """A data set with arrays, and an isovalue for them."""
    positions = (centers(data) if of_cells
                 else np.array([data.GetPoint(i) for i in range(data.GetNumberOfPoints())]))
    isovalue = add_arrays(data, positions, data.GetCellData() if of_cells else data.GetPointData())
    if "points" in ghosts:
        add_ghosts(data.GetPointData(), data.GetNumberOfPoints(), [1, 2])
    if "cells" in ghosts:
        add_ghosts(data.GetCellData(), data.GetNumberOfCells(), [1, 8, 32, 32])
    return data, isovalue


class DataSetsTest(unittest.TestCase):
    def same(self, data, values, isovalues, **options):
        """Compares what Samples and the filter yield."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            ours = Samples(data, values).contour(isovalues, **options)
            theirs = contouring.compiled_filters().filtered(
                data, values, isovalues, options.pop("triangles", False), None, None, options)
        np.testing.assert_array_equal(ours.points, theirs.points)
        self.assertEqual(set(ours.arrays), set(theirs.arrays))
        for name, array in theirs.arrays.items():
            self.assertEqual(ours.arrays[name].dtype, array.dtype, name)
            np.testing.assert_array_equal(ours.arrays[name], array, name)
        self.same_data(ours.polydata, theirs.polydata)
        return len(ours)

    def same_data(self, ours, theirs):
        self.assertEqual(ours.GetNumberOfPoints(), theirs.GetNumberOfPoints())
        for cells in ("GetVerts", "GetPolys"):
            found, expected = getattr(ours, cells)(), getattr(theirs, cells)()
            self.assertEqual(found.GetNumberOfCells(), expected.GetNumberOfCells())
            if expected.GetNumberOfCells():
                np.testing.assert_array_equal(vtk_to_numpy(found.GetConnectivityArray()),
                                              vtk_to_numpy(expected.GetConnectivityArray()))
        for attributes in ("GetPointData", "GetCellData"):
            found, expected = getattr(ours, attributes)(), getattr(theirs, attributes)()
            for i in range(expected.GetNumberOfArrays()):
                name = expected.GetArrayName(i)
                array, other = found.GetArray(name), expected.GetArray(i)
                np.testing.assert_array_equal(vtk_to_numpy(array), vtk_to_numpy(other), name)
            for kind in range(6):
                active = expected.GetAttribute(kind) and expected.GetAttribute(kind).GetName()
                self.assertEqual(found.GetAttribute(kind) and found.GetAttribute(kind).GetName(), active)

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
            self.same(data, "distance", [isovalue, 0.2], triangles=True, regularize=False)
            self.same(data, "count", [700.5, 20.5], compute_gradients=True)
            data.GetPointData().SetActiveScalars("distance")
            self.same(data, None, [isovalue], projection="no_projection")
            self.same(data, RANDOM.random(3000), [0.5])

    def test_composites(self):
        first, isovalue = prepared(cloud(), False, "points")
        second, _ = prepared(image(), False, "")
        third, _ = prepared(cloud(2000, np.float32), False, "")
        third.GetPointData().RemoveArray("count")
        without = cloud(100)
        blocks = vtkMultiBlockDataSet()
        nested = vtkMultiBlockDataSet()
        nested.SetBlock(0, third)
        nested.SetBlock(2, without)
        blocks.SetBlock(0, first)
        blocks.SetBlock(1, nested)
        blocks.SetBlock(3, second)
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

    def test_levels_of_an_amr(self):
        levels = amr()
        vtkAMRUtilities.BlankCells(levels)
        self.assertGreater(self.same(levels, "distance", [0.3]), 100)

    def test_arrays_of_other_layouts(self):
        data, isovalue = prepared(cloud(), False, "")
        bits = vtkBitArray()
        bits.SetName("bits")
        for i in range(3000):
            bits.InsertNextValue(i % 3 == 0)
        data.GetPointData().AddArray(bits)
        words = vtkStringArray()
        words.SetName("words")
        words.SetNumberOfValues(3000)
        data.GetPointData().AddArray(words)
        ours = Samples(data, "distance").contour(isovalue)
        self.assertEqual(set(np.unique(ours.arrays["bits"])), {0, 1})
        self.assertNotIn("words", ours.arrays)
        with self.assertRaisesRegex(TypeError, '"words" holds no numbers'):
            Samples(data, "words")
        with self.assertRaisesRegex(ValueError, '"place" has 3 components'):
            Samples(data, "place")
        with self.assertRaisesRegex(ValueError, '"short" has 1 values for 3000 points'):
            Samples(data, "short")

    def test_arrays_that_are_reallocated(self):
        data, isovalue = prepared(cloud(), False, "")
        samples = Samples(data, "distance")
        expected = samples.contour(isovalue)
        data.GetPointData().GetArray("place").Squeeze()
        same = samples.contour(isovalue)
        np.testing.assert_array_equal(same.arrays["place"], expected.arrays["place"])
        data.GetPointData().GetArray("place").InsertNextTuple3(0.0, 0.0, 0.0)
        with self.assertRaisesRegex(ValueError, "place of the data set have changed from 3000 to 3001"):
            samples.contour(isovalue)
        data.GetPoints().Reset()
        with self.assertRaisesRegex(ValueError, "positions of the data set have changed"):
            samples.replace_values(np.zeros(3000))

    def test_malformed_data(self):
        data = polygons()
        data.SetPoints(None)
        array = numpy_to_vtk(np.zeros(data.GetNumberOfCells()), deep=True)
        array.SetName("of cells")
        data.GetCellData().AddArray(array)
        with self.assertRaisesRegex(ValueError, "cells, but no points"):
            Samples(data, "of cells")

    def test_names_that_meet(self):
        data, isovalue = prepared(cloud(), False, "")
        array = numpy_to_vtk(np.arange(3000.0), deep=True)
        array.SetName("values")
        data.GetPointData().AddArray(array)
        with self.assertWarnsRegex(RuntimeWarning, 'replace the array "values"'):
            Samples(data, np.arange(3000.0)).contour(isovalue + 7)

    def test_field_data_are_copied(self):
        data, isovalue = prepared(cloud(), False, "")
        time = numpy_to_vtk(np.array([1.5]), deep=True)
        time.SetName("TimeValue")
        data.GetFieldData().AddArray(time)
        for surface in (Samples(data, "distance").contour(isovalue), contour(data, "distance", isovalue)):
            copied = surface.polydata.GetFieldData().GetArray("TimeValue")
            self.assertEqual(copied.GetValue(0), 1.5)

    def test_the_compiled_path_keeps_its_promises(self):
        data, isovalue = prepared(cloud(50000), False, "")

        def fail(_fraction):
            raise InterruptedError

        with self.assertRaises(InterruptedError):
            contour(data, "distance", isovalue, progress=fail)
        for options in (dict(angle=None), dict(triangles="no"), dict(drop_gaps="maybe"),
                        dict(triangles=True, regularize="maybe")):
            with self.assertRaisesRegex(ValueError, "cannot be"):
                contour(data, "distance", isovalue, **options)
        surface = contour(data, "distance", isovalue)
        again = pickle.loads(pickle.dumps(surface))
        np.testing.assert_array_equal(again.points, surface.points)

        def interrupt(_fraction):
            os.kill(os.getpid(), signal.SIGINT)

        signal.signal(signal.SIGINT, signal.default_int_handler)
        with self.assertRaises(KeyboardInterrupt):
            contour(data, "distance", isovalue, progress=interrupt)

    def test_threads_of_data_sets(self):
        data, isovalue = prepared(cloud(), False, "")
        self.assertEqual(contour(data, "distance", isovalue, threads=1).points.tobytes(),
                         contour(data, "distance", isovalue).points.tobytes())

    def test_what_has_no_samples(self):
        for data, remedy in ((vtkTable(), "convert it to points first"),
                             (vtkHyperTreeGrid(), "vtkHyperTreeGridCellCenters")):
            with self.assertRaisesRegex(TypeError, remedy):
                Samples(data)
        for data in (vtkPolyData(), vtkMultiBlockDataSet()):
            with self.assertRaisesRegex(ValueError, "no points or cells"):
                Samples(data, "distance")
        data, _ = prepared(cloud(), False, "")
        with self.assertRaisesRegex(ValueError, 'named "speed". The point arrays are: distance, place'):
            Samples(data, "speed")
        with self.assertRaisesRegex(ValueError, "no active point scalars"):
            Samples(cloud())
        with self.assertRaisesRegex(ValueError, "99 values for a data set of 3000 points"):
            Samples(data, np.zeros(99))
        with self.assertRaisesRegex(TypeError, "give its name"):
            Samples(vtkMultiBlockDataSet(), np.zeros(99))
        with self.assertRaisesRegex(TypeError, "add them to the data set"):
            Samples(data, "distance").contour(0.3, arrays={"other": np.zeros(3000)})


def amr():
    """Two levels around the middle of the unit cube, the finer one over a part of the coarser."""
    levels = vtkOverlappingAMR()
    levels.Initialize(2, [1, 1])
    levels.SetOrigin([0.0, 0.0, 0.0])
    levels.SetGridDescription(8)  # VTK_XYZ_GRID
    for level, (spacing, low, cells) in enumerate(((0.1, 0, 10), (0.05, 6, 8))):
        grid = vtkUniformGrid()
        grid.SetOrigin(*3 * [low * spacing])
        grid.SetSpacing(*3 * [spacing])
        grid.SetDimensions(*3 * [cells + 1])
        places = centers(grid)
        array = numpy_to_vtk(np.linalg.norm(places - 0.5, axis=1), deep=True)
        array.SetName("distance")
        grid.GetCellData().AddArray(array)
        levels.SetSpacing(level, 3 * [spacing])
        levels.SetAMRBox(level, 0, vtkAMRBox(*3 * [low], *3 * [low + cells - 1]))
        levels.SetDataSet(level, 0, grid)
        levels.SetRefinementRatio(level, 2)
    return levels


if __name__ == "__main__":
    unittest.main()
