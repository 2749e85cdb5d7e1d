# SPDX-License-Identifier: GPL-3.0-or-later
"""PyVista's accessor, found through the installed package: on vtk, and on cvista."""

import doctest
import gc
import pathlib
import re
import unittest
import warnings
import weakref
from unittest import mock

import numpy as np
import pyvista as pv
from scatteredisopoints import Samples, _arrays, _pyvista, body, contour, gradient, probe, slice_samples


def cloud(count=20000):
    data = pv.PolyData(np.random.default_rng(1).random((count, 3)))
    data["distance"] = np.linalg.norm(data.points - 0.5, axis=1)
    data["place"] = data.points
    data["count"] = np.arange(count)
    data.set_active_scalars("distance")
    return data


def grid(dimensions=(30, 31, 32)):
    data = pv.ImageData(dimensions=dimensions, spacing=(0.07, 0.14, 0.21), origin=(1, 2, 3))
    data["distance"] = np.linalg.norm(data.points - data.center, axis=1)
    data.cell_data["of cells"] = np.linalg.norm(data.cell_centers().points - data.center, axis=1)
    return data


class Warned(unittest.TestCase):
    def caught(self, call):
        """Messages of warnings, all of this file, and a result."""
        with warnings.catch_warnings(record=True) as caught:  # assertWarns() imports what cvista lacks
            warnings.simplefilter("always")
            found = call()
        self.assertEqual({each.filename for each in caught} - {__file__}, set())
        return [str(each.message) for each in caught], found


class Accessor(Warned):
    def test_nothing_has_to_be_imported(self):
        names = [accessor.name for accessor in pv.registered_accessors()]
        self.assertIn("scattered", dir(cloud()) + names)
        self.assertRegex(repr(cloud().scattered), "^<scattered of a PolyData: body, compute_deriv.*, contour, ")

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
        with self.assertRaisesRegex(ValueError, "no normals: extract them with compute_normals"):
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
        for wrong in ((1, 2, 3), 5, ("a", "b")):
            with self.assertRaisesRegex(ValueError, "rng has two values"):
                data.scattered.contour(3, rng=wrong)
        with self.assertRaisesRegex(ValueError, "^isosurfaces cannot be -1: give their number, 0 or more, or a list"):
            data.scattered.contour(-1)
        with self.assertRaisesRegex(TypeError, "^isosurfaces are missing"):
            data.scattered.contour(None)
        data["wide"] = (2.2 * data["distance"] - 1) * 1.7e308
        for rng in (None, (-1.7e308, 1.7e308)):
            messages, surface = self.caught(lambda: data.scattered.contour(3, "wide", rng=rng))
            self.assertNotRegex(" ".join(messages), "overflow|invalid")
            self.assertGreater(surface.n_points, 1000)
        data["gaps"] = np.full(data.n_points, np.nan)
        self.assertRegex(self.caught(lambda: data.scattered.contour(3, "gaps"))[0][0], "^Skipped 20000 of 20000")
        data.point_data["vtkGhostType"] = np.full(data.n_points, 2, np.uint8)
        self.assertEqual(self.caught(lambda: data.scattered.contour(3))[0], ["All samples are excluded. Include some."])

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
        of_cells = data.scattered.contour([1.1], "distance", preference="CELL")
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
        for time in (1.0, 2.0):
            blocks.add_field_data([time], "time")
            self.assertEqual(blocks.scattered.contour([0.3], "distance").field_data["time"], [time])
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

    def test_changes_in_memory_are_noticed(self):
        """VTK has no notice of what NumPy writes into shared memory."""
        image = grid((10, 11, 12))
        curved = image.cast_to_structured_grid()
        for data, name in ((cloud(2000), "distance"), (pv.MultiBlock([cloud(2000), cloud(10)]), "distance"),
                           (image, "of cells"), (curved.copy(), "of cells"), (pv.MultiBlock([curved]), "of cells"),
                           (image.cast_to_rectilinear_grid(), "distance")):
            block = data[0] if isinstance(data, pv.MultiBlock) else data
            memory = [np.asarray(block[name])]
            if not isinstance(block, pv.ImageData):
                memory.append(_arrays.as_numpy(block.GetXCoordinates() if isinstance(block, pv.RectilinearGrid) else
                                               block.GetPoints().GetData()))
            where = np.asarray(block.center) + np.random.default_rng(2).uniform(-0.1, 0.1, (20, 3))
            level, association = np.median(memory[0]), "cell" if name == "of cells" else "point"
            for call in (lambda each: each.scattered.contour([level], name),
                         lambda each: each.scattered.contour([level], name, triangles=False),
                         lambda each: each.scattered.slice("x", where[0], scalars=name),
                         lambda each: each.scattered.body(name, preference=association),
                         lambda each: each.scattered.probe(where, name),
                         lambda each: each.scattered.to_grid(4, scalars=name)):
                for array in memory:
                    call(data)
                    before = call(data)
                    array *= 1.0 + 2.0**-5
                    found, expected = call(data), call(data.copy())
                    np.testing.assert_array_equal(found.points, expected.points)
                    np.testing.assert_array_equal(found[name], expected[name])
                    self.assertFalse(found.points.tobytes() == before.points.tobytes()
                                     and found[name].tobytes() == before[name].tobytes())

    def test_changes_of_cells_are_noticed(self):
        """Cells are samples at their centers."""
        tetrahedra = grid((10, 11, 12)).to_tetrahedra()
        for data in (tetrahedra, pv.Sphere(), pv.MultiBlock([tetrahedra.copy()])):
            block = data[0] if isinstance(data, pv.MultiBlock) else data
            block.cell_data["number"] = np.arange(block.n_cells)
            cells = block.GetPolys() if isinstance(block, pv.PolyData) else block.GetCells()
            corners = _arrays.as_numpy(cells.GetConnectivityArray())
            data.scattered.body("number", preference="cell")
            before = data.scattered.body("number", preference="cell")
            corners[:] = corners[::-1].copy()
            found, expected = (each.scattered.body("number", preference="cell") for each in (data, data.copy()))
            np.testing.assert_array_equal(found.points, expected.points)
            self.assertFalse(np.array_equal(found.points, before.points))

    def test_calls_meanwhile(self):
        """A call on another array, as of another thread, leaves a call its array."""
        data = cloud()
        data["doubled"] = 2 * data["distance"]
        expected = data.scattered.contour([0.3], "distance")
        extract = Samples._extract

        def meanwhile(*arguments, **options):
            with mock.patch.object(Samples, "_extract", extract):
                data.scattered.contour([0.4], "doubled")
            return extract(*arguments, **options)

        with mock.patch.object(Samples, "_extract", meanwhile):
            np.testing.assert_array_equal(data.scattered.contour([0.3], "distance").points, expected.points)

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
        for threads in (1, None):
            data.scattered.contour([0.3], threads=threads)
            self.assertEqual(_pyvista._kept[id(data)][2]._threads, threads)
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
                (data, [], dict(progress=True), TypeError, "unknown option progress: did you mean progress_bar"),
                (data, [], dict(arrays={"a": data["count"]}), TypeError, "add them to the data set")):
            with self.assertRaisesRegex(error, text):
                source.scattered.contour([0.3], *arguments, **options)

    def test_data_of_contour(self):
        surface = contour(cloud(), "distance", 0.3, triangles=True)
        self.assertIs(type(surface.polydata), pv.PolyData)
        self.assertGreater(contour(cloud(), "distance", 0.3).splats().polydata.n_cells, 1000)
        points = surface.points.copy()
        for data in (surface.polydata, surface.to_pyvista(), cloud().scattered.contour([0.3])):
            before = data.area, data["distance"].max()
            data.points *= 2
            data["distance"] += 1
            self.assertEqual((data.area, data["distance"].max()), (4 * before[0], before[1] + 1))
        np.testing.assert_array_equal(surface.points, points)
        self.assertEqual(set(surface.arrays["distance"]), {0.3})

    def test_surfaces_of_arrays_become_data_of_pyvista(self):
        data = cloud(3000)
        surface = contour(np.asarray(data.points), np.asarray(data["distance"]), 0.3, triangles=True)
        with (mock.patch.object(pv.PolyData, "save", autospec=True) as save,
              self.assertRaisesRegex(OSError, "a.vtp cannot be written")):
            surface.save("a.vtp")  # cvista may lack writers
        for found in (surface.to_pyvista(), save.call_args.args[0]):
            np.testing.assert_array_equal(found.points, surface.points)
            np.testing.assert_array_equal(found.regular_faces, surface.triangles)
            np.testing.assert_array_equal(found["Normals"], surface.normals)
        text = (pathlib.Path(__file__).parents[2] / "docs/python.md").read_text()
        call, = re.findall(r"^hot\S*\.smooth_taubin\(.*?\)", text, re.MULTILINE)
        with mock.patch.object(pv.PolyData, "smooth_taubin") as smooth:  # cvista may lack it
            self.assertIs(eval(call, {"hot": surface}), smooth.return_value)


class Probing(Warned):
    """Values at places; affine fields are exact."""

    @staticmethod
    def plane(places):
        return places @ [1.0, 2.0, 3.0]

    def cloud(self):
        data = cloud(5000)
        data.clear_data()
        data["plane"], data["place"] = self.plane(data.points), data.points
        data["number"] = np.arange(5000, dtype=np.int32)
        data.GetPointData().SetPedigreeIds(pv.convert_array(np.arange(5000), "ids"))
        return data

    def test_points_and_data_sets(self):
        data, inside = self.cloud(), np.random.default_rng(2).uniform(0.2, 0.8, (50, 3))
        image = pv.ImageData(dimensions=(3, 4, 5), spacing=(0.1, 0.1, 0.1), origin=(0.3, 0.3, 0.3))
        image["own"] = np.arange(60)
        for where, kind in ((inside, pv.PolyData), (inside.tolist(), pv.PolyData), (image, pv.ImageData)):
            found = data.scattered.probe(where, outside=None)
            self.assertIs(type(found), kind)
            np.testing.assert_allclose(found["plane"], self.plane(found.points), atol=1e-6)
            np.testing.assert_allclose(found["place"], found.points, atol=1e-6)
            self.assertEqual(set(found.array_names) - {"own"}, {"plane", "place", "number", "ids"})
            nearest = np.linalg.norm(found.points[:, None] - data.points, axis=-1).argmin(axis=1)
            np.testing.assert_array_equal(found["ids"], nearest)
        self.assertIn("own", found.array_names)
        self.assertEqual(image.array_names, ["own"])
        found = data.scattered.probe(inside, ["place", "plane"], gradient=True, outside=None)
        np.testing.assert_allclose(found["place_gradient"], np.tile(np.eye(3).ravel(), (50, 1)), atol=1e-5)
        np.testing.assert_allclose(found["plane_gradient"], np.tile([1, 2, 3], (50, 1)), atol=1e-5)
        np.testing.assert_array_equal(data.scattered.probe(inside, data["plane"])["values"],
                                      data.scattered.probe(inside, "plane")["plane"])
        self.assertEqual(data.scattered.probe(inside, "number", method="NEAREST")["number"].dtype, np.int32)
        self.assertTrue(np.isnan(data.scattered.probe([[9, 9, 9]], "plane")["plane"][0]))
        nothing = data.scattered.probe(np.zeros((0, 3)), "place", gradient=True)
        self.assertEqual({name: nothing[name].shape for name in nothing.array_names},
                         {"place": (0, 3), "place_gradient": (0, 9)})
        np.testing.assert_array_equal(probe(data, "plane", image), data.scattered.probe(image, "plane")["plane"])
        self.assertEqual(gradient(data, ["place"])["place"].shape, (5000, 3, 3))
        self.assertAlmostEqual(float(Samples(data, "plane").interpolator("place")(0.4, 0.5, 0.6)[2]), 0.6, places=6)

    def test_a_data_set_at_its_own_points(self):
        data = pv.ImageData(dimensions=(12, 12, 12), spacing=(0.1, 0.1, 0.1), origin=(0.3, 0.7, 0.9))
        data["x"] = data.points[:, 0]
        data = data.rotate_z(30).rotate_x(17)
        self.assertTrue(np.isfinite(data.scattered.probe(data, "x")["x"]).all())

    def test_blocks_with_different_arrays(self):
        data, other = self.cloud(), self.cloud()
        other.points[:, 0] += 1
        other.point_data.remove("number")
        other["plane"], other["own"] = other["plane"].astype("f4"), other["plane"]
        blocks, where = pv.MultiBlock([data, other]), np.array([[0.5, 0.5, 0.5], [1.5, 0.5, 0.5]])
        text = '^Left out are "plane", "number", "own": not all blocks have these arrays with the same type'
        for call, expected in ((lambda: blocks.scattered.probe(where), {"place", "ids"}),
                               (lambda: blocks.scattered.sample_over_line(*where, 5), {"place", "ids", "Distance"}),
                               (lambda: blocks.scattered.slice("z"), {"place", "ids"}),
                               (lambda: slice_samples(blocks, normal="z").polydata, {"place", "ids"})):
            (message,), found = self.caught(call)
            self.assertRegex(message, text)
            self.assertEqual(set(found.array_names), expected)
        self.assertEqual(self.caught(lambda: blocks.scattered.probe(where, "place"))[0], [])
        both = pv.PartitionedDataSet([data, other])
        self.assertEqual(both.scattered.to_grid(3, scalars="place").bounds, blocks.bounds)
        np.testing.assert_allclose(both.scattered.slice("x", scalars="place").points[:, 0], blocks.center[0], atol=1e-6)
        self.assertGreater(min(each.n_points for each in both.scattered.slice_orthogonal(scalars="place")), 100)
        (message,), found = self.caught(lambda: blocks.scattered.probe(where, ["number", "plane"]))
        self.assertRegex(message, "5000 points or cells are left out")
        mixed = grid()
        mixed["a"], mixed.cell_data["b"] = np.ones(mixed.n_points), np.ones(mixed.n_cells)
        for source, names, text in (
                (blocks, ["number", "own"], '^The arrays "number", "own" are in different blocks.* separate calls'),
                (mixed, ["a", "b"], '^The arrays "a", "b" are in different blocks, or some are of points and others'),
                (blocks, ["place", "speed", "own"], 'no point or cell array named "speed". Choose'),
                (blocks, "plane", 'Left out are "plane": not all blocks .* Convert it'),
                (pv.PolyData(data.points), None, "no point or cell array of numbers. There are no arrays")):
            for call in (lambda: source.scattered.probe(where, names),
                         lambda: probe(source, names, where) if names else source.scattered.probe(where)):
                with self.subTest(text), self.assertRaisesRegex(ValueError, text):
                    call()

    def test_arrays_of_equal_names(self):
        data = self.cloud()
        data["plane_gradient"], data["Distance"] = np.full(5000, 7.0), np.full(5000, 7.0)
        inside = [[0.4, 0.5, 0.5], [0.6, 0.5, 0.5]]
        names = ["plane", "plane_gradient"]
        (message,), found = self.caught(lambda: data.scattered.probe(inside, names, gradient=True))
        self.assertRegex(message, '^The computed array "plane_gradient" replaces the array of this name: rename that')
        self.assertEqual(found["plane_gradient"].shape, (2, 3))
        (message,), found = self.caught(lambda: data.scattered.sample_over_line(*inside, 1))
        self.assertRegex(message, '"Distance" replaces')
        np.testing.assert_allclose(found["Distance"], [0, 0.2])
        (message,), found = self.caught(lambda: data.scattered.compute_derivative("plane", gradient="plane"))
        self.assertRegex(message, '"plane" replaces')
        self.assertEqual(found["plane"].shape, (5000, 3))
        self.assertEqual(self.caught(lambda: data.scattered.sample_over_line(*inside, 1, "plane"))[0], [])
        for names, text in ((dict(gradient="x", divergence="x"), 'gradient and divergence .* named "x"'),
                            (dict(divergence="gradient"), 'gradient and divergence .* named "gradient"'),
                            (dict(gradient=""), 'gradient cannot be "": give'), (dict(vorticity=2), "vorticity")):
            with self.subTest(text), self.assertRaisesRegex(ValueError, text):
                data.scattered.compute_derivative("place", **names)

    def test_cells_ghosts_and_composites(self):
        data = grid()
        data.cell_data["plane"] = self.plane(data.cell_centers().points)
        data["plane"] = -self.plane(data.points)
        where = data.center + np.random.default_rng(2).uniform(-0.5, 0.5, (50, 3))
        for preference, factor in (("cell", 1), ("point", -1)):
            found = data.scattered.probe(where, "plane", preference=preference)
            np.testing.assert_allclose(found["plane"], factor * self.plane(where))
        self.assertEqual(set(data.scattered.probe(where, preference="cell").array_names), {"of cells", "plane"})
        blocks = pv.MultiBlock([data.extract_subset((0, 15, 0, 30, 0, 31)), data.extract_subset((15, 29, 0, 30, 0, 31)),
                                cloud(10)])
        (message,), found = self.caught(lambda: blocks.scattered.probe(where, "plane"))
        self.assertRegex(message, "^10 points or cells are left out: ")
        np.testing.assert_allclose(found["plane"], -self.plane(where))
        hidden = data.points[:, 0] > data.center[0] + 0.1
        data.point_data["plane"][hidden] = 1e9
        data.point_data["vtkGhostType"] = np.where(hidden, 2, 0).astype(np.uint8)
        data.point_data["plane"][np.argmax(hidden)] = np.nan
        self.assertEqual(self.caught(lambda: data.scattered.probe(where, "plane"))[0], [])
        data.point_data["distance"][np.argmin(hidden)] = np.nan
        self.assertRegex(self.caught(lambda: data.scattered.probe(where, "distance"))[0][0], '^1 of .* of "distance"')
        found = data.scattered.probe(where - np.array([0.45, 0, 0]), "plane")
        np.testing.assert_allclose(found["plane"], -self.plane(found.points), rtol=1e-6)

    def test_lines_and_grids(self):
        data = self.cloud()
        line = data.scattered.sample_over_line((0.2, 0.3, 0.4), (0.7, 0.6, 0.5), 100, "plane", outside=None)
        self.assertEqual(line.n_points, 101)
        self.assertAlmostEqual(line["Distance"].max(), 0.35**0.5, places=6)
        np.testing.assert_allclose(line["plane"], self.plane(line.points), atol=1e-6)
        self.assertEqual(set(line.array_names), {"plane", "Distance"})
        far = pv.PolyData(data.points + np.array([1e7, 0, 0]))
        far["x"] = data.points[:, 0]
        line = far.scattered.sample_over_line((1e7 + 0.2, 0.5, 0.5), (1e7 + 0.8, 0.5, 0.5), 50)
        np.testing.assert_allclose(line["x"], np.linspace(0.2, 0.8, 51), atol=1e-6)
        np.testing.assert_allclose(line["Distance"], np.linspace(0, 0.6, 51), atol=1e-8)
        bounds, box = (0.2, 0.8, 0.2, 0.8, 0.5, 0.5), np.reshape(data.bounds, (3, 2))
        for arguments, dimensions, spacing in (
                (dict(dimensions=11), (11, 11, 11), np.ptp(box, axis=1) / 10),
                (dict(dimensions=(3, 4, 1)), (3, 4, 1), (np.ptp(box[0]) / 2, np.ptp(box[1]) / 3, 1)),
                (dict(dimensions=7, bounds=bounds), (7, 7, 1), (0.1, 0.1, 1)),
                (dict(spacing=0.1, bounds=bounds), (7, 7, 1), (0.1, 0.1, 0.1)),
                (dict(spacing=(0.25, 0.2, 9), bounds=bounds), (4, 4, 1), (0.25, 0.2, 9))):
            found = data.scattered.to_grid(**arguments, scalars="plane")
            self.assertEqual(found.dimensions, dimensions)
            np.testing.assert_allclose(found.spacing, spacing, rtol=1e-6)
            inside = np.isfinite(found["plane"])
            self.assertGreater(inside.mean(), 0.25)
            np.testing.assert_allclose(found["plane"][inside], self.plane(found.points[inside]), atol=1e-6)
        self.assertAlmostEqual(data.scattered.to_grid((3, 4, 1), scalars="plane").origin[2], box[2].mean(), places=6)
        for arguments, error, text in (
                ({}, TypeError, "either dimensions"), (dict(dimensions=3, spacing=1), TypeError, "either dimensions"),
                *((dict(spacing=each), ValueError, "spacing") for each in (0, np.inf, "a")),
                *((dict(dimensions=each), ValueError, "dimensions") for each in (1.5, (1, 2))),
                (dict(spacing=1e-12), ValueError, "1e-12 would give 9.99e[+]35 points, .* 2147483647: choose a gr"),
                (dict(dimensions=[10**10, 1, 1]), ValueError, "would give 1e[+]10 points, .* choose fewer"),
                (dict(dimensions=3, methods="CUBIC"), TypeError, "did you mean method?"),
                *((dict(dimensions=3, bounds=bounds), ValueError, "^bounds cannot be .*: give three ascending pairs")
                  for bounds in ((1, 0, 0, 1, 0, 1), (0, np.inf, 0, 1, 0, 1), (0, 1, 0, 1, 0), "all"))):
            with self.subTest(text), self.assertRaisesRegex(error, text):
                data.scattered.to_grid(**arguments)
        for arguments, text in ((((0.2, 0.5), (1, 1, 1)), "^pointa cannot be .* three finite numbers"),
                                (((0, 0, 0), (1, 1, np.nan)), "^pointb cannot"),
                                (((0, 0, 0), (1, 1, 1), 0), "^resolution cannot be 0: it is a whole number, 1 or more"),
                                (((0, 0, 0), (1, 1, 1), 1.5), "^resolution cannot be 1.5")):
            with self.subTest(text), self.assertRaisesRegex(ValueError, text):
                data.scattered.sample_over_line(*arguments)

    def test_derivatives_are_those_of_vtk(self):
        """VTK's central differences are exact for fields of degree two on a grid, inside."""
        data = grid()
        x, y, z = (data.points - data.center).T
        data["flow"] = np.stack([y * z, x * x, x * y + z], axis=1)
        chosen = dict(divergence=True, vorticity="spin", qcriterion=True)
        expected = data.compute_derivative("flow", **chosen)
        found = data.scattered.compute_derivative("flow", method="QUADRATIC", **chosen)
        inside = (np.abs(data.points - data.center) < 0.7).all(axis=1)
        for name in ("gradient", "divergence", "spin", "qcriterion"):
            self.assertEqual(found[name].shape, expected[name].shape)
            np.testing.assert_allclose(found[name][inside], expected[name][inside], atol=1e-9)
        self.assertNotIn("gradient", data.array_names)
        of_cells = data.scattered.compute_derivative("of cells", gradient="slope")
        self.assertEqual(of_cells.cell_data["slope"].shape, (data.n_cells, 3))
        with self.assertRaisesRegex(ValueError, '^divergence and qcriterion cannot .* "distance" has 1 component:'):
            data.scattered.compute_derivative("distance", divergence=True, qcriterion=True)

    def test_slices_have_the_parameters_of_pyvista(self):
        data = self.cloud()
        data.points[:, 0] *= 2
        data["place"], data["plane"] = data.points, self.plane(data.points)
        sliced = data.scattered.slice()
        self.assertIs(type(sliced), pv.PolyData)
        self.assertTrue(sliced.is_all_triangles)
        self.assertEqual(set(sliced.array_names), {"place", "plane", "number", "ids"})
        np.testing.assert_allclose(sliced.points[:, 0], data.center[0], atol=1e-6)
        np.testing.assert_allclose(sliced["plane"], self.plane(sliced.points), atol=1e-5)
        self.assertEqual(data.scattered.slice("-z", (0, 0, 0.25), scalars="plane").array_names, ["plane"])
        contoured = data.scattered.slice("z", contour=True, scalars="plane")
        self.assertGreater(contoured.n_lines, 10)
        slices = data.scattered.slice_orthogonal(x=1.5, interpolation="linear")
        self.assertEqual(slices.keys(), ["YZ", "XZ", "XY"])
        np.testing.assert_allclose(slices["YZ"].points[:, 0], 1.5, atol=1e-6)
        np.testing.assert_allclose(slices["XY"].points[:, 2], data.center[2], atol=1e-6)
        ball = data.scattered.slice_implicit(lambda points: np.linalg.norm(points - data.center, axis=1) - 0.3)
        self.assertTrue(ball.is_manifold)
        far = pv.PolyData(np.vstack([data.points, [[np.inf, 0.5, 0.5]]]))
        for call in (lambda: far.scattered.slice("z"), far.scattered.slice_orthogonal):
            (message,), found = self.caught(call)
            self.assertRegex(message, "^Skipped 1 of 5001 samples: not finite")
        np.testing.assert_allclose(found["XY"].points[:, 2], data.center[2], atol=1e-6)
        with self.assertRaisesRegex(ValueError, "contour=True needs an array of numbers"):
            far.scattered.slice("z", contour=True)
        for call, error in ((lambda: data.scattered.slice(plane=pv.Plane()), TypeError),
                            (lambda: data.scattered.slice(offset=1), TypeError),
                            (lambda: data.scattered.slice(contour="all"), ValueError),
                            (lambda: data.scattered.slice_implicit(None), TypeError)):
            with self.assertRaises(error):
                call()

    def test_bodies_and_slices_need_no_arrays(self):
        positions = np.random.default_rng(1).random((3000, 3))
        bare = pv.PolyData(positions)
        surface = bare.scattered.body()
        self.assertTrue(surface.is_manifold and 0.9 < surface.volume < 1)
        np.testing.assert_array_equal(surface.points, body(positions).points)
        self.assertEqual(bare.scattered.body(preference="cell").n_points, surface.n_points)  # vertex cells
        self.assertGreater(bare.scattered.slice("x").n_points, 100)
        self.assertGreater(pv.MultiBlock([bare, bare.translate((2, 0, 0))]).scattered.body().n_points, surface.n_points)
        named = bare.translate((3, 0, 0))
        named["a"] = named.points[:, 0]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # not all blocks have the array
            both = pv.MultiBlock([bare, named]).scattered.body()
        self.assertGreater(both.volume, 1.95 * surface.volume)
        grid = pv.ImageData(dimensions=(5, 6, 7))
        self.assertAlmostEqual(grid.scattered.body().volume, 4 * 5 * 6)
        grid.cell_data["number"] = np.arange(grid.n_cells)
        self.assertAlmostEqual(grid.scattered.body().volume, 3 * 4 * 5)
        with self.assertRaisesRegex(ValueError, "no point or cell array of numbers"):
            bare.scattered.probe(positions)

    def test_docstrings(self):
        runner = doctest.DocTestRunner()
        for test in doctest.DocTestFinder().find(_pyvista.ScatteredAccessor, "scattered", globs={}):
            runner.run(test)
        self.assertGreater(runner.tries, 5)
        self.assertEqual(runner.failures, 0)

    def test_samples_are_kept(self):
        data, inside = self.cloud(), [[0.5, 0.5, 0.5]]
        with mock.patch.object(Samples, "_load", autospec=True, side_effect=Samples._load) as load:
            for _ in range(2):
                self.assertAlmostEqual(data.scattered.probe(inside, "plane")["plane"][0], 3, places=5)
            self.assertEqual(load.call_count, 1)
            data["plane"] = 2 * data["plane"]
            self.assertAlmostEqual(data.scattered.probe(inside, "plane")["plane"][0], 6, places=5)
            self.assertGreater(data.scattered.contour([6], "plane").n_points, 100)

    def test_text_is_left_out(self):
        data, text = self.cloud(), 'Left out are "words": they hold no numbers.'
        data["words"] = ["word"] * data.n_points
        where = [[0.4, 0.5, 0.5], [0.6, 0.5, 0.5]]
        for source in (data, pv.MultiBlock([data, data.translate((2, 0, 0))])):
            for call in (lambda: source.scattered.contour([3], "plane"), lambda: source.scattered.body(),
                         lambda: source.scattered.probe(where), lambda: source.scattered.slice("x"),
                         lambda: source.scattered.sample_over_line(*where, 5), lambda: contour(source, "plane", 3)):
                self.assertIn(text, self.caught(call)[0])
            for call in (lambda: source.scattered.slice("x", scalars="plane"), lambda: source.scattered.body("plane"),
                         lambda: source.scattered.probe(where, "plane")):
                self.assertNotIn(text, self.caught(call)[0])
        self.assertEqual(data.scattered.probe([0.4, 0.5, 0.5], "plane").n_points, 1)
        self.assertEqual(data.scattered.probe([], "plane").n_points, 0)

    def test_unknown_options(self):
        """The message has the names of this call."""
        data = self.cloud()
        for call, names in (
                (lambda: data.scattered.slice(q=1), "drop_gaps interpolation offsets scalars preference threads"),
                (lambda: data.scattered.slice_orthogonal(q=1), "interpolation x y z"),
                (lambda: data.scattered.slice_implicit(len, q=1), "interpolation implicit_function"),
                (lambda: data.scattered.body(q=1), "minimum_piece_size scalars"),
                (lambda: data.scattered.to_grid(3, q=1), "method spacing scalars"),
                (lambda: data.scattered.sample_over_line(*[[0, 0, 0]] * 2, q=1), "method resolution"),
                (lambda: data.scattered.contour([3], "plane", q=1), "isosurfaces rng capping"),
                (lambda: slice_samples(data, q=1), "arrays interpolation function"),
                (lambda: body(data, q=1), "arrays threads"),
                (lambda: contour(data, "plane", 3, q=1), "isovalues arrays drop_gaps")):
            with self.assertRaisesRegex(TypeError, "unknown option q: there are ") as caught:
                call()
            listed = str(caught.exception).partition(": there are ")[2].split(", ")
            self.assertEqual(set(names.split()) - set(listed), set())
        for call, text in ((lambda: data.scattered.slice(interpolate="linear"), "did you mean interpolation?"),
                           (lambda: data.scattered.contour([3], "plane", values=1), "did you mean scalars?")):
            with self.assertRaisesRegex(TypeError, text):
                call()

    def test_wrong_choices(self):
        data = self.cloud()
        data["words"] = ["word"] * data.n_points
        for call, error, text in (
                (lambda: data.scattered.probe([[0, 0, 0]], "plan"), ValueError, 'named "plan".*plane'),
                (lambda: data.scattered.probe([[0, 0, 0]], ["plane", "words"]), TypeError,
                 r'"words" holds no numbers.* the point arrays are: .*plane, .*words \(text\)'),
                (lambda: data.scattered.probe([[0, 0, 0]], nearest_arrays="words"), ValueError,
                 "nearest_arrays cannot have 'words': the array holds no numbers"),
                (lambda: data.scattered.probe([[0, 0, 0]], "plane", preference="both"), ValueError, "preference"),
                (lambda: data.scattered.probe([[0, 0, 0]], np.zeros(7)), ValueError, "7 values for a data set"),
                (lambda: data.scattered.probe(pv.MultiBlock([data])), TypeError, "pass its blocks"),
                (lambda: data.scattered.probe(pv.Table({"a": np.ones(1)})), TypeError, r"no points .* shape \(n, 3\)"),
                (lambda: probe(data, "plane", pv.MultiBlock([data])), TypeError, "no points of its own: pass its bl"),
                (lambda: data.scattered.probe(pv.SphereSource()), TypeError, r"SphereSource.* give its GetOutput"),
                (lambda: contour(pv.SphereSource(), "plane", 1), TypeError, r"call Update\(\) and give its GetO"),
                (lambda: pv.PolyData().scattered.to_grid(3), ValueError, "input has no points"),
                (lambda: pv.MultiBlock([]).scattered.to_grid(3), ValueError, "input has no points"),
                (lambda: data.scattered.compute_derivative(["plane"]), TypeError, "one array"),
                (lambda: pv.Table({"a": np.ones(1)}).scattered.probe([[0, 0, 0]]), TypeError, "has no samples"),
                (lambda: pv.PolyData().scattered.probe([[0, 0, 0]]), ValueError, "no points")):
            with self.subTest(text), self.assertRaisesRegex(error, text):
                call()


if __name__ == "__main__":
    unittest.main()
