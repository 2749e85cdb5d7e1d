# SPDX-License-Identifier: GPL-3.0-or-later
"""contour() yields what the filters do, for arrays and for data sets. TestPackage.py has what needs no VTK."""

import pickle
import unittest
import warnings
from decimal import Decimal
from fractions import Fraction

import numpy as np
import scatteredisopoints
from scatteredisopoints import (
    Samples, body, contour, slice_samples, vtkScatteredIsopointFilter, vtkScatteredIsosurfaceFilter)
from vtk_data import assert_same, blocks_of, centers_in, cloud_of, named, updated
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkTable


def samples(count=5000, dtype=np.float64):
    positions = np.random.default_rng(1).random((count, 3)).astype(dtype)
    return positions, np.linalg.norm(positions - 0.5, axis=1).astype(dtype)


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
    def same(self, result, data, isovalues=(0.3,), kind=vtkScatteredIsopointFilter, **properties):
        """The same bytes as a filter's output."""
        output = updated(kind, data, isovalues, **properties).GetOutput()
        assert_same(self, result.polydata, output)
        self.assertGreater(len(result), 100)
        expected = vtk_to_numpy(output.GetPoints().GetData())
        self.assertEqual((result.points.dtype, result.points.tobytes()), (expected.dtype, expected.tobytes()))
        attributes = output.GetPointData()
        names = {attributes.GetArrayName(i) for i in range(attributes.GetNumberOfArrays())}
        self.assertEqual(set(result.arrays), names)
        for name, array in result.arrays.items():
            self.assertEqual(array.tobytes(), vtk_to_numpy(attributes.GetArray(name)).tobytes(), name)
        for name, property_, width in (("Normals", result.normals, (3,)), ("Radius", result.radii, ())):
            shape = None if property_ is None else property_.shape
            self.assertEqual(shape, (len(result), *width) if attributes.HasArray(name) else None)
        if kind is vtkScatteredIsopointFilter:
            self.assertIsNone(result.triangles)
        else:
            corners = vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)
            np.testing.assert_array_equal(result.triangles, corners)

    def test_arrays_and_options(self):
        for dtype in (np.float32, np.float64):
            positions, values = samples(7000, dtype)
            data = cloud_of(positions, values)
            self.same(contour(positions, values, 0.3), data)
            for options, properties in (
                    (dict(projection="quadratic_fit", drop_gaps=True, compute_gradients=True, compute_normals=False),
                     dict(Projection=2, DropGaps=True, ComputeGradients=1, ComputeNormals=0)),
                    (dict(projection=None), dict(Projection=0)),
                    (dict(normal_method="normals_from_planes"), dict(NormalMethod=1))):
                self.same(contour(positions, values, 0.3, **options), data, **properties)
            for regularize in (True, False):
                result = contour(positions, values, (0.2, 0.3), triangles=True, regularize=regularize)
                self.same(result, data, (0.2, 0.3), vtkScatteredIsosurfaceFilter, Regularize=regularize)
                self.assertGreater(len(result.triangles), 1000)

    def test_bodies(self):
        positions, values = samples(7000, np.float64)
        number = np.arange(len(values), dtype=np.int32)
        exact = dict(triangles=True, regularize=False, projection=None)
        body = contour(positions, -values, -0.55, capping=True, arrays={"number": number}, **exact)
        self.same(contour(positions, -values, -0.55, capping=True, **exact), cloud_of(positions, -values), [-0.55],
                  vtkScatteredIsosurfaceFilter, Capping=True, Regularize=False, Projection=0)
        sides = np.concatenate([np.roll(body.triangles, -corner, 1)[:, :2] for corner in range(3)])
        self.assertEqual(len(np.unique(sides, axis=0)), len(sides))
        self.assertEqual({*map(tuple, sides)}, {*map(tuple, sides[:, ::-1])})
        caps = body.cell_arrays["IsCap"]
        np.testing.assert_array_equal(body.polydata.GetCellData().GetArray("IsCap"), caps)
        self.assertTrue(0 < caps.sum() < len(caps))
        of_caps, of_isosurface = (np.unique(body.triangles[caps == kind]) for kind in (1, 0))
        at_samples = np.setdiff1d(of_caps, of_isosurface)
        found = body.arrays["number"][at_samples]
        np.testing.assert_array_equal(body.points[at_samples], positions[found])
        np.testing.assert_array_equal(body.arrays["values"][at_samples], -values[found])
        self.assertEqual(set(body.arrays["values"][of_isosurface]), {-0.55})
        large = 2**53 + 1 + 2 * number.astype(np.int64)
        data = cloud_of(positions, -values)
        data.GetPointData().AddArray(named("large", large))
        for result in (contour(positions, -values, -0.55, capping=True, arrays={"large": large}, **exact),
                       contour(data, None, -0.55, capping=True, **exact)):
            np.testing.assert_array_equal(result.arrays["large"][at_samples], large[found])
        for wrong, text in ((dict(projection="CREASE_FIT"), "capping has no creases. Set projection to the cubic fit"),
                            (dict(compute_gradients=True), "capping has no gradients. Set compute_gradients off"),
                            (dict(normal_method="normals_from_field"), "no normals from the field. Set normal_method")):
            with self.assertRaisesRegex(ValueError, text):
                contour(positions, -values, -0.55, capping=True, **{**exact, **wrong})
        self.assertEqual(len(contour(positions, -values, -0.55, **exact).cell_arrays), 0)
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # vertices at samples need no fit
            whole = contour(positions, -values, (-np.inf, -0.55), triangles=True, capping=True)
        self.same(whole, cloud_of(positions, -values), [-np.inf, -0.55], vtkScatteredIsosurfaceFilter, Capping=True)

    def test_pieces(self):
        """A hollow ball and a droplet, by arrays and by a data set."""
        positions = np.random.default_rng(4).random((60000, 3))
        distance = np.linalg.norm(positions - 0.35, axis=1)
        far = np.linalg.norm(positions - 0.8, axis=1)
        values = np.maximum(np.minimum(0.3 - distance, distance - 0.1), 0.09 - far)
        data = cloud_of(positions, values)
        hollow = np.maximum(0.3 - distance, np.minimum(0.15 - far, far - 0.07))
        ball, = contour(positions, hollow, 0.0, triangles=True, capping=True, minimum_piece_size=0.3).pieces
        self.assertAlmostEqual(ball.volume, 4 / 3 * np.pi * 0.3**3, 2)  # neither the shell nor its bubble
        for of, threads in ((positions, values), None), ((data, None), None), ((data, None), 2):
            whole = contour(*of, 0.0, triangles=True, capping=True, threads=threads)
            radii = np.array([0.3, 0.1, 0.09])
            np.testing.assert_allclose([piece.area for piece in whole.pieces], 4 * np.pi * radii**2, rtol=0.05)
            volumes = np.array([piece.volume for piece in whole.pieces])
            np.testing.assert_allclose(volumes, 4 / 3 * np.pi * radii**3 * [1, -1, 1], rtol=0.08)
            self.assertAlmostEqual(whole.volume, volumes.sum(), 12)
            self.assertEqual([piece.isovalue for piece in whole.pieces], [0.0] * 3)
            sides = np.concatenate([np.roll(whole.triangles, -corner, 1)[:, :2] for corner in range(3)])
            for ends in sides.T:  # each piece has its own points
                pieces_of = np.full(len(whole), -1)
                pieces_of[ends] = np.tile(whole.region_ids, 3)
                np.testing.assert_array_equal(pieces_of[ends], np.tile(whole.region_ids, 3))
            large = contour(*of, 0.0, triangles=True, capping=True, minimum_piece_size=0.2, threads=threads)
            self.assertEqual([piece.volume > 0 for piece in large.pieces], [True, False])
        for of, threads in ((positions, -distance), None), ((cloud_of(positions, -distance), None), None):
            several = contour(*of, (-0.2, -0.3, 5.0), triangles=True, capping=True, threads=threads)
            np.testing.assert_allclose(several.volume, 4 / 3 * np.pi * np.array([0.3, 0.2, 0.0])**3, rtol=0.03)
            np.testing.assert_allclose(several.area, 4 * np.pi * np.array([0.3, 0.2, 0.0])**2, rtol=0.03)
        slab = positions[np.abs(positions[:, 0] - 0.5) > 0.1]  # pieces of caps alone
        bodies = contour(cloud_of(slab, slab[:, 0]), None, [-np.inf, 0.55], triangles=True, capping=True)
        self.assertEqual([piece.isovalue for piece in bodies.pieces].count(0.55), 1)
        np.testing.assert_allclose(bodies.volume, [0.8, 0.4], rtol=0.05)
        large = contour(positions * 2.0**400, values, 0.0, triangles=True, capping=True)
        with self.assertWarnsRegex(RuntimeWarning, "beyond the range of float64: choose another unit of length"):
            self.assertFalse(np.isfinite(large.volume))
        self.assertAlmostEqual(large.area / 2.0**800, whole.area, 12)
        with self.assertWarnsRegex(RuntimeWarning, "Not every edge has exactly two triangles, so there is no volume"):
            self.assertTrue(np.isnan(contour(positions, distance, 0.5, triangles=True).volume))
        inwards = 0.3 - np.abs(positions - 0.5).max(axis=1)
        cube = contour(positions, inwards, 0.0, triangles=True, projection="CREASE_FIT")
        self.assertEqual(len(cube.pieces), 1)  # though points on creases are repeated
        self.assertAlmostEqual(cube.volume, 0.216, 3)
        flat = np.array([[1, 3, 0], [3, 1, 2], [0, 2, 2], [2, 0, 3.0]])  # merging alone would turn it inside out
        self.assertGreater(contour(flat, [1, 1, 4, 4], 3.5, triangles=True, capping=True).volume, 0)
        again = pickle.loads(pickle.dumps(cube))
        self.assertEqual(again.pieces, cube.pieces)
        ball, = contour(positions, np.minimum(distance, far + 0.06), 0.2, triangles=True, minimum_piece_size=0.9).pieces
        self.assertLess(ball.volume, 0)  # without caps a size counts, but no sign
        for name, text in (("area", "area"), ("volume", "volume"), ("pieces", "pieces"), ("region_ids", "pieces")):
            with self.assertRaisesRegex(ValueError, f"Points have no {text}: extract triangles"):
                getattr(contour(positions, distance, 0.2), name)
        with self.assertRaisesRegex(ValueError, "minimum_piece_size is 2, which is out of range"):
            contour(positions, distance, 0.2, triangles=True, minimum_piece_size=2.0)

    def test_bodies_of_positions(self):
        positions = np.random.default_rng(5).random((20000, 3))
        number = np.arange(len(positions))
        data = cloud_of(positions, number.astype(float))
        distance = np.linalg.norm(positions - 0.5, axis=1)
        whole = body(positions, arrays={"number": number})
        np.testing.assert_array_equal(whole.points, positions[whole.arrays["number"]])
        self.assertTrue(0.98 < whole.volume < 1)
        self.assertEqual(len(whole.pieces), 1)
        of_data = body(data)
        for array, other in ((whole.points, of_data.points), (whole.triangles, of_data.triangles)):
            np.testing.assert_array_equal(array, other)
        self.assertEqual(set(of_data.cell_arrays), set())
        samples = Samples(positions, distance)
        samples.contour(0.3)
        np.testing.assert_array_equal(samples.body().triangles, whole.triangles)
        np.testing.assert_array_equal(samples.contour(0.3).points, contour(positions, distance, 0.3).points)
        hull = body(positions[np.abs(positions[:, 0] - 0.5) > 0.2], drop_gaps=False)
        self.assertEqual(len(hull.pieces), 1)
        self.assertEqual(len(body(positions[np.abs(positions[:, 0] - 0.5) > 0.2]).pieces), 2)
        with self.assertWarnsRegex(RuntimeWarning, "No body: the samples are in one plane. Add samples beside it."):
            self.assertEqual(body(positions * [1, 1, 0]).volume, 0.0)
        with self.assertRaisesRegex(TypeError, "unknown option capping: there are drop_gaps"):
            body(positions, capping=True)

    def test_bodies_have_no_webs(self):
        """A tank of water with a valley between two crests, whose walls have nothing behind them."""
        spacing = 0.02
        axes = [np.arange(0, end, spacing) for end in (2, 0.4, 1)]
        water = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
        water += np.random.default_rng(8).normal(0, 0.1 * spacing, water.shape)
        x, z = water[:, 0], water[:, 2]
        water = water[z < 0.6 + 0.075 * np.cos(np.pi * x) + 0.0433 * np.cos(2 * np.pi * x)]
        surface = body(water)
        centers = surface.points[surface.triangles].mean(axis=1)
        near = np.array([np.sqrt(((water - center) ** 2).sum(axis=1).min()) for center in centers])
        self.assertLess(near.max(), 3 * spacing)

    def test_curves_have_too_many_tetrahedra(self):
        t = np.linspace(0, 1, 3000)
        curve = np.column_stack([t, t**2, t**3])
        samples = Samples(curve, t)
        for call in (lambda: body(curve), lambda: samples.contour(0.5, triangles=True)):
            with self.assertRaisesRegex(ValueError, "tetrahedra .more than 4000000 for 3000 samples.*curves.* points"
                                                    ".*probe.*average.*radial basis functions"):
                call()
        self.assertGreater(len(samples.contour(0.5).points), 0)
        self.assertGreater(len(body(curve[::10]).points), 0)

    def test_layers_and_lines_have_bodies(self):
        """Two layers of a lattice far apart, as of a simulation one cell thick, and wells."""
        axes = np.arange(0, 1.001, 0.02), np.arange(0, 0.6, 0.02), [0, 0.25]
        layers = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
        self.assertAlmostEqual(body(layers).volume, 0.25 * 0.58)
        section = slice_samples(layers, "z", (0, 0, 0.125))
        self.assertAlmostEqual(section.area, 0.58, 6)
        random = np.random.default_rng(5)
        wells = np.repeat(100 * random.random((6, 2)), 40, axis=0)
        wells = np.column_stack([wells, np.tile(np.arange(40.0), 6)]) + random.normal(0, 0.02, (240, 3))
        self.assertGreater(body(wells).volume, 0.99 * body(wells, drop_gaps=False).volume)

    def test_gradient_direction(self):
        """The body at or below the isovalue is that of the negated values, which only the values at points show."""
        positions, _ = samples(7000, np.float64)
        distance = np.linalg.norm(positions - 0.4, axis=1)
        kept = Samples(positions, distance)
        before = kept.contour(0.3)
        for values, dtype in ((distance, np.float64), (distance.astype(np.float32), np.float32),
                              (np.rint(100 * distance).astype(np.uint8), np.int64)):
            scale = 100.0 if values.dtype == np.uint8 else 1.0
            levels = [0.3 * scale, 0.2 * scale, 5.0 * scale]
            for options in (dict(triangles=True, capping=True), dict(triangles=True, compute_gradients=True), {}):
                found = contour(positions, values, levels, gradient_direction="ascent", **options)
                negated = contour(positions, -values.astype(dtype), [-level for level in levels], **options)
                self.assertEqual(found.arrays.keys(), negated.arrays.keys())
                for name, array in found.arrays.items():
                    sign = -1 if name in ("values", "Gradients") else 1
                    np.testing.assert_array_equal(array, sign * negated.arrays[name])
                np.testing.assert_array_equal(found.points, negated.points)
                self.assertEqual(found.arrays["values"].dtype, negated.arrays["values"].dtype)
                if found.are_triangles:
                    np.testing.assert_array_equal(found.triangles, negated.triangles)
            bodies = contour(positions, values, levels[:2], gradient_direction="ascent", triangles=True, capping=True)
            np.testing.assert_allclose(bodies.volume, 4 / 3 * np.pi * np.array([0.2, 0.3])**3, rtol=0.05)
            self.assertEqual([piece.isovalue for piece in bodies.pieces], levels[:2])
        outwards = kept.contour(0.3, gradient_direction="ascent", compute_gradients=True)
        self.assertTrue((np.sum(outwards.normals * (outwards.points - 0.4), axis=1) > 0).all())
        self.assertTrue((np.sum(outwards.arrays["Gradients"] * outwards.normals, axis=1) > 0).all())
        np.testing.assert_array_equal(kept.contour(0.3).points, before.points)
        self.assertGreater(contour(cloud_of(positions, distance), None, 0.3, gradient_direction="ascent",
                                   triangles=True).volume, 0)
        with self.assertWarnsRegex(RuntimeWarning, "^The array is from 0.0.* to .*: no isosurface at 3"):
            kept.contour(3.0, gradient_direction="ascent")
        with self.assertWarnsRegex(RuntimeWarning, "^The array is from .*: no isosurface at 3"):
            kept.contour(3.0)
        with self.assertWarnsRegex(RuntimeWarning, '^"f" is from 0.0.*: no isosurface at 3'):
            contour(cloud_of(positions, distance, "f"), "f", 3.0, gradient_direction="ascent")
        apart = np.vstack([positions, positions + 100.0])
        with self.assertWarnsRegex(RuntimeWarning, "No isosurface at 0.5: all of it is"):
            contour(apart, np.repeat([0.0, 1.0], len(positions)), 0.5, triangles=True, gradient_direction="ascent")
        np.testing.assert_array_equal(kept.contour(0.3, gradient_direction="ASCENT").points, outwards.points)
        with self.assertRaisesRegex(ValueError, "gradient_direction cannot be 'up': it is \"descent\" or"):
            kept.contour(0.3, gradient_direction="up")
        with self.assertRaisesRegex(TypeError, "unknown option gradient_directions: did you mean gradient_direction?"):
            kept.contour(0.3, gradient_directions="ascent")

    def test_gradient_direction_of_wide_integers(self):
        """Integers of 8 bytes, NumPy's default, count as rounded as others do."""
        positions, distance = samples(4000)
        rounded = np.rint(30 * distance)
        expected = contour(positions, rounded.astype(np.int32), 9, gradient_direction="ascent")
        for values in (rounded.astype(np.int64), rounded.astype(np.uint64)):
            found = contour(positions, values, 9, gradient_direction="ascent")
            by_hand = contour(positions, -rounded.astype(np.int64), -9)
            for other in (expected, by_hand):
                self.assertEqual(found.points.tobytes(), other.points.tobytes())
                self.assertEqual(found.normals.tobytes(), other.normals.tobytes())
        ends = np.array([np.iinfo(np.int64).min, np.iinfo(np.int64).max])[(distance > 0.3).astype(int)]
        for values in (ends, np.where(distance > 0.3, np.uint64(2**64 - 1), np.uint64(0))):
            middle = 0 if values.dtype == np.int64 else 2.0**63
            found = contour(positions, values, middle, gradient_direction="ascent", projection=None)
            negated = contour(positions, -values.astype(np.float64), -middle, projection=None)
            self.assertGreater(len(found), 100)
            self.assertEqual(found.points.tobytes(), negated.points.tobytes())

    def test_arrays_of_other_types(self):
        positions, values = samples()
        for dtype in (np.int16, np.uint16, np.int32, np.int64, np.uint64):
            whole = np.rint(1000 * values).astype(dtype)
            self.same(contour(positions, whole, 300.5), cloud_of(positions, whole), [300.5])
        lattice = np.stack(np.meshgrid(*3 * [np.arange(9)]), -1).reshape(-1, 3)
        distance = np.linalg.norm(lattice - 4.0, axis=1)
        self.same(contour(lattice, distance, 2.5), cloud_of(lattice.astype(float), distance), [2.5])

    def test_masked_values_of_data_sets(self):
        """They are left out, and integers count as rounded."""
        positions, values = samples()
        is_masked = np.arange(len(values)) % 7 == 0
        numbers = np.ma.masked_array((20 * values).astype(np.int32), is_masked)
        data, kept = cloud_of(positions), contour(positions[~is_masked], numbers.compressed(), 6.5)
        with self.assertWarnsRegex(RuntimeWarning, "715 of 5000 values are masked"):
            result = contour(data, numbers, 6.5)
        self.assertEqual(result.points.tobytes(), kept.points.tobytes())
        self.assertEqual(data.GetPointData().GetNumberOfArrays(), 0)

    def test_data_are_copies(self):
        """VTK writes into read-only memory."""
        result = contour(*samples(), 0.3, triangles=True)
        area, points, data = result.area, result.points.copy(), result.polydata
        self.assertIs(data, result.polydata)
        for array in (data.GetPoints().GetData(), data.GetPointData().GetArray("values")):
            vtk_to_numpy(array)[:] = 7.0
        np.testing.assert_array_equal(result.points, points)
        self.assertEqual(set(result.arrays["values"]), {0.3})
        result.points = 2 * points
        self.assertAlmostEqual(result.area / area, 4)
        self.assertEqual(result.polydata.GetPoint(0), tuple(2 * points[0]))
        self.assertIsNone(result.polydata.GetPointData().GetNormals())

    def test_data_sets(self):
        positions, values = samples()
        data = cloud_of(positions, values, "distance")
        blocks = blocks_of(data)
        for source, array in ((data, None), (data, "distance"), (Wrapper(data), "distance"),
                              (FormerWrapper(data), None), (blocks, "distance")):
            self.same(contour(source, array, 0.3), data if source is not blocks else blocks)
        other = contour(data, 2 * values, 0.6)
        np.testing.assert_array_equal(other.points, contour(positions, 2 * values, 0.6).points)
        self.assertFalse(data.GetPointData().HasArray("values"))

    def test_cells_of_an_image(self):
        image = vtkImageData()
        image.SetDimensions(12, 12, 12)
        centers = centers_in(image)
        values = np.linalg.norm(centers - 5.5, axis=1)
        expected = contour(centers, values, 3.0)
        self.assertGreater(len(expected), 100)
        image.GetCellData().AddArray(named("distance", values))
        for array in (values, "distance"):
            np.testing.assert_allclose(contour(image, array, 3.0).points, expected.points)

    def test_wrong_arguments(self):
        positions, values = samples(100)
        data = cloud_of(positions, values)
        for arguments, options, error, text in (
                ((data, values[:99]), {}, ValueError, "99 values.*100"), ((data, "speed"), {}, ValueError, "speed"),
                *(((vtkTable(), each), {}, TypeError, "A vtkTable has no samples: convert it to points")
                  for each in (None, values)),
                ((data, values, 0.3), dict(angle=200.0), ValueError, "[aA]ngle is 200"),
                ((data, None, 0.3), dict(arrays={"other": values}), TypeError, "add them"),
                ((positions, values), dict(arrays={3: values}), TypeError, "mapping"),
                *(((positions, values), options, ValueError, "cannot be|out of range") for options in (
                    dict(projection="NORMALS_FROM_PLANES"), dict(normal_method="CUBIC_FIT"), dict(projection=99),
                    dict(projection="update"), dict(angle="CUBIC_FIT")))):
            with self.subTest(options=options, text=text), self.assertRaisesRegex(error, text):
                contour(*arguments, *([0.3] if len(arguments) == 2 else []), **options)

    def test_isovalues(self):
        positions, values = samples()
        data = cloud_of(positions, values)
        for isovalues, expected in (((x for x in (0.3, 0.2)), (0.2, 0.3)), ({0.2, 0.3}, (0.2, 0.3)),
                                    (np.float32([0.25]), (0.25,)), ([Fraction(1, 4), Decimal("0.3")], (0.25, 0.3)),
                                    (np.ma.masked_array([0.2, 0.3], [True, False]), (0.3,))):
            self.same(contour(positions, values, isovalues), data, expected)
        for arguments in ((positions, values), (data, None)):
            with self.assertWarnsRegex(RuntimeWarning, "No isosurface: there are no isovalues. Set one."):
                self.assertEqual(len(contour(*arguments, range(1, 0))), 0)
        for wrong in (True, [True, False], {0.3: 1}, "0.3", None, [2**64, None]):
            with self.assertRaisesRegex(TypeError, "isovalues are"):
                contour(positions, values, wrong)
        for great in (3 * 10**20, [3 * 10**20, 2.5e20]):
            self.same(contour(positions, 1e21 * values, great), cloud_of(positions, 1e21 * values),
                      np.atleast_1d(great).astype(float).tolist())
        with self.assertRaisesRegex(ValueError, "isovalues are beyond the range of float64"):
            contour(positions, values, 2**1100)
        for call in body, slice_samples:
            with self.assertRaisesRegex(TypeError, "arrays are a mapping of names, which are strings"):
                call(positions, arrays={1: values})
        with self.assertWarnsRegex(RuntimeWarning, "no isosurface at .* Choose isovalues between"):
            contour(positions, values, values.max(), triangles=True)
        with self.assertWarnsRegex(RuntimeWarning, "Choose isovalues less than"):
            contour(positions, values, values.max(), triangles=True, capping=True)
        with self.assertWarnsRegex(RuntimeWarning, "No body: the samples are in one plane. Add"):
            contour(positions * [1, 1, 0], values, -np.inf, triangles=True, capping=True)

    def test_isovalues_in_gaps_and_others(self):
        positions, values = samples(3000)
        apart, steps = np.vstack([positions, positions + 100.0]), np.r_[values, values + 50.0]
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            contour(apart * [1, 1, 0], steps, [0.4, 25.0], triangles=True)
            contour(apart, steps, [25.0, 70.0], triangles=True)
        texts = [str(each.message) for each in caught]
        self.assertRegex("\n".join(texts), "at 25: all of it is in gaps")
        self.assertRegex("\n".join(texts), "The array is from .*: no isosurface at 70")

    def test_arrays_that_are_not_finite(self):
        positions, values = samples()
        part = {"part": np.where(positions[:, 0] < 0.5, np.nan, values)}
        for call in (lambda: contour(positions, values, 0.3, arrays=part), lambda: body(positions, arrays=part),
                     lambda: slice_samples(positions, arrays=part, interpolation="linear")):
            with self.assertWarnsRegex(RuntimeWarning, '"part" is not finite at [0-9]+ of [0-9]+ points'):
                call()

    def test_tensors(self):
        positions, _ = samples()
        tensors = np.einsum("ni,nj->nij", positions, positions)
        section = slice_samples(positions, "z", arrays={"tensors": tensors}, interpolation="linear")
        self.assertEqual(section.arrays["tensors"].shape, (len(section), 3, 3))
        found = vtk_to_numpy(section.polydata.GetPointData().GetArray("tensors"))
        np.testing.assert_array_equal(found, section.arrays["tensors"].reshape(-1, 9))
        points = contour(*samples(), 0.3, arrays={"tensors": tensors, "numbers": tensors.reshape(-1, 9)})
        for surface in (points, points.splats()):
            expected = surface.arrays["numbers"].reshape(-1, 3, 3)
            np.testing.assert_array_equal(surface.arrays["tensors"], expected)

    def test_all_compiled_classes_are_exported(self):
        modules = map(scatteredisopoints._module, scatteredisopoints._COMPILED)
        classes = {name for module in modules for name in dir(module) if name.startswith("vtk")}
        self.assertEqual(classes, {name for name in scatteredisopoints.__all__ if name.startswith("vtk")})

    def test_warnings_are_those_of_python(self):
        positions, values = samples()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            contour(positions, values, 0.3)
        positions[:, 2] = 0.0
        with self.assertWarnsRegex(RuntimeWarning, "one plane"):
            contour(positions, values, 0.5, triangles=True)


if __name__ == "__main__":
    unittest.main()
