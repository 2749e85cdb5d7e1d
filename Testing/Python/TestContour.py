# SPDX-License-Identifier: GPL-3.0-or-later
"""contour() yields what the filters do, for arrays of every kind and for data sets."""

import unittest
import warnings

import numpy as np
from scatteredisopoints import (
    Isosurface, contour, vtkScatteredIsopointFilter, vtkScatteredIsosurfaceFilter)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkImageData, vtkMultiBlockDataSet, vtkPolyData, vtkTable)


def samples(count=5000, dtype=np.float64):
    positions = np.random.default_rng(1).random((count, 3)).astype(dtype)
    return positions, np.linalg.norm(positions - 0.5, axis=1).astype(dtype)


def as_data(positions, values, name="values"):
    data = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(positions, deep=True))
    data.SetPoints(points)
    array = numpy_to_vtk(values, deep=True)
    array.SetName(name)
    data.GetPointData().SetScalars(array)
    return data


def filtered(data, isovalues, kind=vtkScatteredIsopointFilter, **properties):
    isopoints = kind()
    isopoints.SetInputData(data)
    for i, isovalue in enumerate(isovalues):
        isopoints.SetValue(i, isovalue)
    for name, value in properties.items():
        getattr(isopoints, "Set" + name)(value)
    isopoints.Update()
    return isopoints.GetOutput()


class Wrapper:
    """An object that holds a data set, as those of vedo do."""

    def __init__(self, data):
        self.dataset = data


class FormerWrapper:
    def __init__(self, data):
        self.data = data

    def polydata(self):
        return self.data


class ContourTest(unittest.TestCase):
    def same(self, result: Isosurface, output):
        """The same bytes as a filter's output."""
        self.assertEqual(len(result), output.GetNumberOfPoints())
        expected = vtk_to_numpy(output.GetPoints().GetData())
        self.assertEqual(result.points.dtype, expected.dtype)
        self.assertEqual(result.points.tobytes(), expected.tobytes())
        attributes = output.GetPointData()
        self.assertEqual(len(result.arrays), attributes.GetNumberOfArrays())
        for name, array in result.arrays.items():
            self.assertEqual(array.tobytes(), vtk_to_numpy(attributes.GetArray(name)).tobytes(), name)

    def test_points_are_those_of_the_filter(self):
        for dtype in (np.float32, np.float64):
            positions, values = samples(dtype=dtype)
            result = contour(positions, values, 0.3)
            self.same(result, filtered(as_data(positions, values), [0.3]))
            self.assertGreater(len(result), 300)
            self.assertEqual(result.normals.shape, (len(result), 3))
            self.assertEqual(result.radii.shape, (len(result),))
            self.assertIsNone(result.triangles)

    def test_triangles_are_those_of_the_filter(self):
        positions, values = samples(7000)
        result = contour(positions, values, (0.2, 0.3), triangles=True)
        output = filtered(as_data(positions, values), [0.2, 0.3], vtkScatteredIsosurfaceFilter)
        self.same(result, output)
        corners = vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        np.testing.assert_array_equal(result.triangles, corners)
        self.assertGreater(len(corners), 1000)
        self.assertIsNone(result.radii)

    def test_options_are_properties(self):
        positions, values = samples()
        result = contour(positions, values, 0.3, projection="quadratic_fit", drop_gaps=True,
                         compute_gradients=True, compute_normals=False)
        self.same(result, filtered(as_data(positions, values), [0.3], Projection=2, DropGaps=True,
                                   ComputeGradients=1, ComputeNormals=0))
        self.assertIsNone(result.normals)
        self.same(contour(positions, values, 0.3, projection=None),
                  filtered(as_data(positions, values), [0.3], Projection=0))
        result = contour(positions, values, 0.3, triangles=True, regularize=False)
        self.same(result, filtered(
            as_data(positions, values), [0.3], vtkScatteredIsosurfaceFilter, Regularize=0))
        with self.assertRaisesRegex(TypeError, "unknown option regularize"):
            contour(positions, values, 0.3, regularize=False)
        with self.assertRaisesRegex(TypeError, "unknown option gap; there are .*drop_gaps"):
            contour(positions, values, 0.3, gap=2)
        with self.assertRaisesRegex(TypeError, "unknown option angle"):
            contour(positions, values, 0.3, triangles=True, angle=30.0)
        with self.assertRaisesRegex(ValueError, "projection cannot be 'cubes'"):
            contour(positions, values, 0.3, projection="cubes")

    def test_arrays_of_every_layout(self):
        positions, values = samples()
        expected = contour(positions, values, 0.3)
        read_only = positions.copy()
        read_only.flags.writeable = False
        for place, value in (
                (np.asfortranarray(positions), values),
                (positions.astype(">f8"), values.astype(">f8")),
                (np.repeat(positions, 2, axis=0)[::2], np.repeat(values, 3)[::3]),
                (positions.tolist(), values.tolist()),
                (read_only, values[:, None]),
                (positions.astype(np.longdouble), values)):
            self.same(contour(place, value, 0.3), expected.polydata)

    def test_arrays_of_other_types(self):
        positions, values = samples()
        whole = np.rint(1000 * values)
        for dtype in (np.int16, np.uint16, np.int32, np.int64, np.uint64):
            data = as_data(positions, whole.astype(dtype))
            self.same(contour(positions, whole.astype(dtype), 300.5), filtered(data, [300.5]))
        lattice = np.stack(np.meshgrid(*3 * [np.arange(9)]), -1).reshape(-1, 3)
        distance = np.linalg.norm(lattice - 4.0, axis=1)
        self.same(contour(lattice, distance, 2.5), filtered(as_data(lattice.astype(float), distance), [2.5]))
        self.assertGreater(len(contour(positions, values > 0.3, 0.5)), 100)
        self.assertGreater(len(contour(positions, values.astype(np.float16), 0.3)), 100)

    def test_masked_samples_are_left_out(self):
        positions, values = samples()
        isMasked = np.arange(len(values)) % 7 == 0
        for kind in (np.float64, np.int32):
            numbers = (1000 * values).astype(kind)
            with self.assertWarnsRegex(RuntimeWarning, "Skipped 715 of 5000 samples: not finite"):
                result = contour(positions, np.ma.masked_array(numbers, isMasked), 300.5)
            kept = contour(positions[~isMasked], numbers[~isMasked].astype(float), 300.5)
            self.assertEqual(result.points.tobytes(), kept.points.tobytes())

    def test_memory_is_shared(self):
        positions, values = samples()
        result = contour(positions, values, 0.3)
        points = result.points
        points[0] = 7.0
        self.assertEqual(result.polydata.GetPoint(0), (7.0, 7.0, 7.0))
        del result  # the memory lives on
        self.assertEqual(points[0].tolist(), [7.0, 7.0, 7.0])

    def test_further_arrays_are_interpolated(self):
        positions, values = samples()
        result = contour(positions, values, 0.3, arrays={"place": positions, "double": 2 * values},
                         projection="NO_PROJECTION")
        np.testing.assert_allclose(result.arrays["place"], result.points, atol=1e-12)
        np.testing.assert_allclose(result.arrays["double"], 0.6, atol=1e-12)

    def test_data_sets(self):
        positions, values = samples()
        data = as_data(positions, values, "distance")
        expected = filtered(data, [0.3])
        self.same(contour(data, isovalues=0.3), expected)
        self.same(contour(data, "distance", 0.3), expected)
        self.same(contour(Wrapper(data), "distance", 0.3), expected)
        self.same(contour(FormerWrapper(data), None, 0.3), expected)
        other = contour(data, 2 * values, 0.6)
        np.testing.assert_array_equal(other.points, contour(positions, 2 * values, 0.6).points)
        self.assertFalse(data.GetPointData().HasArray("values"))
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, data)
        self.same(contour(blocks, "distance", 0.3), filtered(blocks, [0.3]))

    def test_cells_of_an_image(self):
        image = vtkImageData()
        image.SetDimensions(12, 12, 12)
        centers = np.array([np.mean(np.reshape(image.GetCell(i).GetBounds(), (3, 2)), axis=1)
                            for i in range(image.GetNumberOfCells())])
        values = np.linalg.norm(centers - 5.5, axis=1)
        expected = contour(centers, values, 3.0)
        self.assertGreater(len(expected), 100)
        np.testing.assert_allclose(contour(image, values, 3.0).points, expected.points)
        array = numpy_to_vtk(values, deep=True)
        array.SetName("distance")
        image.GetCellData().AddArray(array)
        np.testing.assert_allclose(contour(image, "distance", 3.0).points, expected.points)

    def test_wrong_arguments(self):
        positions, values = samples(100)
        for arguments, error, text in (
                ((positions[:, :2], values), ValueError, r"\(100, 2\), not \(n, 3\).*append zeros"),
                ((positions.ravel(), values), ValueError, r"\(300,\), not \(n, 3\)"),
                ((positions, values[:99]), ValueError, r"values have the shape \(99,\), not \(100,\)"),
                ((positions, positions), ValueError, r"values have the shape \(100, 3\)"),
                ((positions, None), TypeError, "values are missing"),
                ((positions * 1j, values), TypeError, "positions are of the type complex128"),
                ((positions, ["a"] * 100), TypeError, "values are of the type"),
                ((as_data(positions, values), values[:99]), ValueError, "99 values for a data set of 100"),
                ((as_data(positions, values), "speed"), ValueError, "speed"),
                ((vtkTable(), None), RuntimeError, "vtkTable"),
                ((positions[:0], values[:0]), ValueError, "no points"),
                ((positions, values, np.nan), ValueError, "not a number")):
            with self.subTest(text=text), self.assertRaisesRegex(error, text):
                contour(*arguments)
        for source in (positions, as_data(positions, values)):
            with self.assertRaisesRegex(ValueError, r"[aA]ngle is 200, which is out of range"):
                contour(source, values, 0.3, angle=200.0)
        with self.assertRaisesRegex(ValueError, "other have the shape"):
            contour(positions, values, 0.3, arrays={"other": values[:3]})
        for arrays in ([values], {3: values}):
            with self.assertRaisesRegex(TypeError, "a mapping of names"):
                contour(positions, values, 0.3, arrays=arrays)
        with self.assertRaisesRegex(TypeError, "give its name"):
            contour(vtkTable(), values, 0.3)
        with self.assertRaisesRegex(TypeError, "add them to the data set"):
            contour(as_data(positions, values), None, 0.3, arrays={"other": values})

    def test_isovalues(self):
        positions, values = samples()
        expected = contour(positions, values, [0.2, 0.3]).polydata
        for isovalues in ((x for x in (0.3, 0.2)), {0.2, 0.3}, range(1, 0), np.float32([0.2])):
            if not isinstance(isovalues, (range, np.ndarray)):
                self.same(contour(positions, values, isovalues), expected)
            else:
                contour(positions, values, isovalues)
        masked = np.ma.masked_array([0.2, 0.3], [True, False])
        self.same(contour(positions, values, masked), contour(positions, values, 0.3).polydata)
        for isovalues in (None, "0.3"):
            with self.assertRaisesRegex(TypeError, "not numbers"):
                contour(positions, values, isovalues)

    def test_constants_belong_to_their_properties(self):
        positions, values = samples(500)
        for options in (dict(projection="NORMALS_FROM_PLANES"), dict(normal_method="CUBIC_FIT"),
                        dict(projection=99), dict(projection="update"), dict(angle="CUBIC_FIT")):
            with self.subTest(options=options), self.assertRaisesRegex(
                    ValueError, "cannot be|out of range"):
                contour(positions, values, 0.3, **options)
        contour(positions, values, 0.3, normal_method="normals_from_planes")

    def test_warnings_are_those_of_python(self):
        positions, values = samples()
        with self.assertWarnsRegex(RuntimeWarning, 'computed array "Normals" replaces'):
            contour(positions, values, 0.3, arrays={"Normals": positions})
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            contour(positions, values, 0.3)

    def test_a_plane_has_no_triangles(self):
        positions, values = samples(500)
        positions[:, 2] = 0.0
        with self.assertWarnsRegex(RuntimeWarning, "in one plane"):
            contour(positions, values, 0.5, triangles=True)

    def test_a_surface_without_points(self):
        positions, values = samples(100)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of the isovalue
            result = contour(positions, values, 99.0)
            surface = contour(positions, values, 99.0, triangles=True)
        self.assertEqual(len(result), 0)
        self.assertIsNone(result.triangles)
        self.assertEqual(result.points.shape, (0, 3))
        self.assertEqual(surface.triangles.shape, (0, 3))


if __name__ == "__main__":
    unittest.main()
