# SPDX-License-Identifier: GPL-3.0-or-later
"""PyVista's accessor, found through the installed package: on vtk, and on cvista."""

import gc
import unittest
import warnings
import weakref

import numpy as np
import pyvista as pv
from scatteredisopoints import _pyvista, contour


def cloud(count=20000):
    data = pv.PolyData(np.random.default_rng(1).random((count, 3)))
    data["distance"] = np.linalg.norm(data.points - 0.5, axis=1)
    data["place"] = data.points
    data["count"] = np.arange(count)
    data.set_active_scalars("distance")
    return data


def grid():
    data = pv.ImageData(dimensions=(30, 31, 32), spacing=(0.07, 0.14, 0.21), origin=(1, 2, 3))
    data["distance"] = np.linalg.norm(data.points - data.center, axis=1)
    data.cell_data["of cells"] = np.linalg.norm(data.cell_centers().points - data.center, axis=1)
    return data


class Accessor(unittest.TestCase):
    def test_nothing_has_to_be_imported(self):
        names = [accessor.name for accessor in pv.registered_accessors()]
        self.assertIn("scattered", dir(cloud()) + names)

    def test_triangles(self):
        data = cloud()
        surface = data.scattered.contour([0.3], "distance")
        self.assertIs(type(surface), pv.PolyData)
        self.assertTrue(surface.is_manifold)
        self.assertAlmostEqual(surface.volume / (4 / 3 * np.pi * 0.3**3), 1.0, delta=0.01)
        self.assertEqual(surface.active_scalars_name, "distance")
        self.assertEqual(set(surface.array_names), {"distance", "place", "count", "Normals"})
        np.testing.assert_allclose(surface["place"], surface.points, atol=5e-3)
        for options in ({}, {"regularize": False}):
            surface = data.scattered.contour([0.3], "distance", **options)
            expected = contour(np.asarray(data.points), np.asarray(data["distance"]), 0.3, triangles=True, **options)
            np.testing.assert_array_equal(surface.points, expected.points)
            np.testing.assert_array_equal(surface.regular_faces, expected.triangles)

    def test_isopoints_and_splats(self):
        isopoints = cloud().scattered.contour([0.3], triangles=False)
        self.assertEqual(isopoints.n_verts, isopoints.n_points)
        self.assertLessEqual({"Normals", "Radius"}, set(isopoints.point_data))
        splats = isopoints.scattered.splats()
        self.assertAlmostEqual(splats.area / (4 * np.pi * 0.3**2), 1.0, delta=0.02)
        outwards = np.einsum("ij,ij->i", splats.point_normals, splats.points - 0.5)
        self.assertLess(outwards.max(), 0.0)  # to decreasing values
        half = isopoints.threshold((-1.0, 0.5), scalars="place", component_mode="component", component=0)
        part = half.scattered.splats()
        self.assertAlmostEqual(part.area / splats.area, 0.5, delta=0.03)
        octagons = pv.PolyData(isopoints.points)
        for name in ("Normals", "Radius"):
            octagons.point_data[name] = isopoints.point_data[name]
        visible = np.count_nonzero(octagons["Radius"])
        self.assertLess(visible, isopoints.n_points)  # some are hidden behind close ones
        self.assertEqual(octagons.scattered.splats().n_cells, 6 * visible)
        with self.assertRaisesRegex(ValueError, "no normals"):
            cloud().scattered.splats()

    def test_numbers_of_isosurfaces(self):
        data = cloud()
        surface = data.scattered.contour(5, rng=(0.1, 0.5))
        np.testing.assert_allclose(np.unique(surface["distance"]), np.linspace(0.1, 0.5, 5))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # corners of the cube have gaps
            surface = data.scattered.contour()
        inner = np.linspace(data["distance"].min(), data["distance"].max(), 12)[1:-1]
        self.assertLessEqual(set(np.unique(surface["distance"])), set(inner))
        self.assertEqual(len(np.unique(data.scattered.contour(3, "count")["count"])), 3)
        with self.assertRaisesRegex(ValueError, "rng has two values"):
            data.scattered.contour(3, rng=(1, 2, 3))
        with self.assertRaisesRegex(ValueError, "rng has two values"):
            data.scattered.contour(3, rng=5)

    def test_all_kinds_of_data(self):
        image = grid()
        for data in (image, image.cast_to_rectilinear_grid(), image.cast_to_structured_grid(),
                     image.cast_to_unstructured_grid(), pv.MultiBlock([image]),
                     pv.MultiBlock([None, pv.MultiBlock([image, cloud()])]),
                     pv.PartitionedDataSet([image])):
            with self.subTest(type(data).__name__):
                if not isinstance(data, pv.DataSet):
                    with warnings.catch_warnings():
                        warnings.simplefilter("ignore")  # of blocks without the array
                        self.assertGreater(data.scattered.contour([1.0], "of cells").n_points, 1000)
                    continue
                self.assertGreater(data.scattered.contour([1.0], "distance").n_points, 1000)
                of_cells = data.scattered.contour([1.0], "of cells")
                np.testing.assert_allclose(of_cells.points.mean(axis=0), data.center, atol=1e-2)
                self.assertEqual(data.scattered.contour([1.0], data["distance"]).n_points,
                                 data.scattered.contour([1.0], "distance").n_points)

    def test_preference(self):
        data = grid()
        data.cell_data["distance"] = data.cell_data["of cells"] + 0.1
        of_points = data.scattered.contour([1.0], "distance")
        of_cells = data.scattered.contour([1.1], "distance", preference="cell")
        self.assertNotEqual(of_points.n_points, of_cells.n_points)
        self.assertEqual(of_cells.n_points, data.scattered.contour([1.0], "of cells").n_points)
        with self.assertRaisesRegex(ValueError, "preference cannot be 'both'"):
            data.scattered.contour([1.0], preference="both")

    def test_ghosts_are_left_out(self):
        data = cloud()
        hidden = data.points[:, 0] > 0.5
        data.point_data["vtkGhostType"] = np.where(hidden, 2, 0).astype(np.uint8)
        surface = data.scattered.contour([0.3], "distance")
        self.assertLess(surface.bounds[1], 0.52)
        for data in (grid(), grid().cast_to_structured_grid()):
            hidden = data.cell_centers().points[:, 0] > data.center[0]
            data.cell_data["vtkGhostType"] = np.where(hidden, 32, 0).astype(np.uint8)
            surface = data.scattered.contour([1.0], "distance")
            self.assertAlmostEqual(surface.bounds[1], data.center[0], delta=0.1)

    def test_changes_are_noticed(self):
        data = cloud()
        samples = self.samples_of(data)
        self.assertIs(self.samples_of(data, 0.2), samples)
        data["distance"][:100] = 5.0
        self.assertIs(self.samples_of(data), samples)  # only values are replaced
        changed = data.scattered.contour([0.3])
        self.assertEqual(changed.n_points, contour(
            np.asarray(data.points), np.asarray(data["distance"]), 0.3, triangles=True).points.shape[0])
        blocks = pv.MultiBlock([data])
        before = blocks.scattered.contour([0.3], "distance").n_points
        data.points[:, 0] *= 2.0
        self.assertNotEqual(blocks.scattered.contour([0.3], "distance").n_points, before)

        axes = grid().cast_to_rectilinear_grid()
        before = axes.scattered.contour([1.0], "distance").bounds
        axes.GetXCoordinates().SetValue(19, 50.0)
        axes.GetXCoordinates().Modified()
        self.assertNotEqual(axes.scattered.contour([1.0], "distance").bounds, before)
        moved = pv.PolyData(data.points + 5)
        moved.GetPointData().ShallowCopy(data.GetPointData())
        blocks.SetBlock(0, moved)
        self.assertGreater(blocks.scattered.contour([0.3], "distance").center[2], 5)

    def samples_of(self, data, isovalue=0.3):
        data.scattered.contour([isovalue])
        return next(reversed(_pyvista._kept.values()))[2]

    def test_few_trees_are_kept(self):
        trees = [weakref.ref(self.samples_of(cloud(2000))) for _ in range(6)]
        self.assertLessEqual(sum(tree() is not None for tree in trees), _pyvista.MOST_KEPT)
        gc.collect()
        self.assertEqual(sum(tree() is not None for tree in trees), 0)

    def test_threads_and_freed_trees(self):
        data = cloud()
        expected = data.scattered.contour([0.3], threads=1)
        self.assertIn(id(data), _pyvista._kept)
        for _ in range(2):
            np.testing.assert_array_equal(data.scattered.contour([0.3], keep_tree=False).points, expected.points)
            self.assertNotIn(id(data), _pyvista._kept)
        with self.assertRaisesRegex(ValueError, "threads are 0"):
            data.scattered.contour([0.3], threads=0)
        points = data.scattered.contour([0.3], triangles=False)
        np.testing.assert_array_equal(points.scattered.splats(threads=1).points, points.scattered.splats().points)
        with self.assertRaisesRegex(ValueError, "threads are 0"):
            points.scattered.splats(threads=0)

    def test_splats_of_other_data(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            empty = cloud().scattered.contour([99.0], triangles=False)
        for data in (empty, pv.PolyData()):
            self.assertEqual(data.scattered.splats().n_points, 0)
        isopoints = cloud().scattered.contour([0.3], triangles=False)
        points = isopoints.cast_to_pointset()
        self.assertGreater(points.scattered.splats().n_cells, 1000)
        with self.assertRaisesRegex(TypeError, "combine"):
            pv.MultiBlock([isopoints]).scattered.splats()

    def test_active_scalars_of_composites(self):
        blocks = pv.MultiBlock([pv.PolyData(), pv.PolyData(np.zeros((1, 3))), cloud()])
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of the point without them
            self.assertGreater(blocks.scattered.contour([0.3]).n_points, 100)

    def test_what_has_no_samples(self):
        data = cloud()
        for source, arguments, options, error, text in (
                (pv.Table(np.zeros((3, 2))), [], {}, TypeError, "Table"), (data, ["speed"], {}, ValueError, "speed"),
                (data, ["place"], {}, ValueError, "3 components"),
                (data, [np.zeros(3)], {}, ValueError, "3 values.*20000"),
                (pv.PolyData(data.points), [], {}, ValueError, "scalars"), (data, [], dict(gaps=1), TypeError, "gaps"),
                (data, [], dict(arrays={"a": data["count"]}), TypeError, "add them to the data set")):
            with self.assertRaisesRegex(error, text):
                source.scattered.contour([0.3], *arguments, **options)

    def test_data_of_contour(self):
        surface = contour(cloud(), "distance", 0.3)
        self.assertIs(type(surface.polydata), pv.PolyData)
        points = surface.points
        points[0] = 7.0
        self.assertEqual(surface.polydata.points[0].tolist(), [7.0, 7.0, 7.0])
        self.assertGreater(surface.splats().polydata.n_cells, 1000)


if __name__ == "__main__":
    unittest.main()
