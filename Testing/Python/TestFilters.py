# SPDX-License-Identifier: GPL-3.0-or-later
"""What the filters promise, of the compiled classes and of those in Python: inputs, arrays, ghosts, messages, pieces.

Each test runs for both, or for those in Python alone where no others are installed. docs/python.md lists the
differences; tests that follow one say so by differs(). TestPythonFilters.py compares the bytes of both.
"""

import errno
import gc
import re
import unittest
import weakref
from unittest import mock

import numpy as np
import scatteredisopoints
from filter_testing import (
    ANY, CELLS, DIFFERENCES, DOCUMENT, DUPLICATE, DUPLICATE_POINT, HIDDEN, HIDDEN_POINT, POINTS, REFINED, FilterTests,
    add, chosen, cloud, every_grid, image, places_of, values_in, with_field, with_ghosts)
from scatteredisopoints import _library, _vtk
from vtk_data import (
    assert_same, blocks_of, centers_in, cloud_of, configured, leaves_of, named, observed, positions_in, set_all,
    updated)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_DOUBLE
from vtkmodules.vtkCommonDataModel import (
    VTK_EMPTY_CELL, VTK_HEXAHEDRON, VTK_TETRA, VTK_VERTEX, vtkHyperTreeGrid, vtkMultiBlockDataSet, vtkPolyData,
    vtkTable, vtkUnstructuredGrid)


class Filters(FilterTests):
    """The tests. Subclasses have the classes."""

    @property
    def kinds(self):
        return self.module.vtkScatteredIsopointFilter, self.module.vtkScatteredIsosurfaceFilter

    def contour(self, data, association=POINTS, kind=0, isovalue=0.2, **properties):
        """The filter of an array f, which is updated without an error."""
        filter_ = chosen(configured(self.kinds[kind], data, [isovalue], **properties), "f", association)
        texts = observed(filter_)
        filter_.Update()
        self.assertEqual(texts["ErrorEvent"], [])
        return filter_

    def assert_samples(self, data, association, kept=None, asked=None):
        """A data set yields what a cloud of its samples yields, of which those not kept are counted."""
        places = places_of(data, association)
        kept = np.ones(len(places), bool) if kept is None else kept
        values = vtk_to_numpy(data.GetAttributes(association).GetArray("f"))
        expected = self.contour(cloud_of(places[kept], values[kept], "f")).GetOutput()
        found = self.contour(data, association if asked is None else asked)
        self.assertGreater(expected.GetNumberOfPoints(), 20)
        assert_same(self, found.GetOutput(), expected)
        self.assertEqual(found.GetNumberOfSkippedSamples(), np.count_nonzero(~kept))

    # Inputs

    def test_points_and_cells_of_every_data_set(self):
        for association in (POINTS, CELLS):
            for grid in every_grid():
                with self.subTest(grid.GetClassName(), association=association):
                    with_field(grid, association)
                    self.assert_samples(grid, association)
                    if association == CELLS:
                        grid.GetPointData().RemoveArray("f")
                    self.assert_samples(grid, association, asked=ANY)

    def test_positions_of_every_type(self):
        positions = np.floor(np.random.default_rng(1).uniform(0, 40, (3000, 3)))
        values = np.linalg.norm(positions - 20, axis=1)
        expected = self.contour(cloud_of(positions, values, "f"), isovalue=12.3).GetOutput()
        self.assertEqual(expected.GetPoints().GetDataType(), VTK_DOUBLE)
        for kind in ("i1", "u1", "i2", "i4", "i8"):
            assert_same(self, self.contour(cloud_of(positions.astype(kind), values, "f"), isovalue=12.3).GetOutput(),
                        expected)

    def test_cells_of_different_types(self):
        grid = set_all(vtkUnstructuredGrid(), Points=cloud(400).GetPoints())
        for i, (kind, size) in enumerate(100 * [(VTK_TETRA, 4), (VTK_HEXAHEDRON, 8), (VTK_VERTEX, 1)]):
            grid.InsertNextCell(kind, size, [(i * 13 + corner * 29) % 400 for corner in range(size)])
        grid.InsertNextCell(VTK_EMPTY_CELL, 0, [])
        positions = positions_in(grid)
        centers = [positions[[ids.GetId(k) for k in range(ids.GetNumberOfIds())]].mean(axis=0)
                   for ids in (grid.GetCell(i).GetPointIds() for i in range(300))]
        values = np.append(np.cos(np.array(centers) @ [2.0, 3.0, 1.0]), 0.0)
        found = self.contour(add(grid, CELLS, "f", values), CELLS)
        self.assertEqual((found.GetNumberOfSamples(), found.GetNumberOfSkippedSamples()), (301, 1))
        expected = self.contour(cloud_of(np.array(centers), values[:-1], "f"))
        np.testing.assert_allclose(positions_in(found.GetOutput()), positions_in(expected.GetOutput()), atol=1e-12)

    def test_an_array_is_that_of_its_association(self):
        """A name stands for no array of the others; without a name it is the active array."""
        data = with_field(image())
        data.GetCellData().RemoveArray("f")
        filter_ = chosen(configured(self.kinds[0], data, [0.2]), "f", CELLS)
        self.assert_one(self.texts_of(filter_, "ErrorEvent"), 'cell array named "f"', "point arrays are: f;")
        data.GetCellData().SetScalars(named("g", np.cos(places_of(data, CELLS) @ [2.0, 3.0, 1.0])))
        expected = self.contour(cloud_of(centers_in(data), vtk_to_numpy(data.GetCellData().GetScalars()), "f"))
        filter_ = chosen(configured(self.kinds[0], data, [0.2]), "", CELLS)
        filter_.Update()
        np.testing.assert_array_equal(positions_in(filter_.GetOutput()), positions_in(expected.GetOutput()))

    def test_arrays_may_be_removed_and_added_again(self):
        data = with_field(image())
        array = data.GetPointData().GetArray("f")
        filter_ = self.contour(data)
        texts, count = observed(filter_), filter_.GetOutput().GetNumberOfPoints()
        data.GetPointData().RemoveArray("f")
        filter_.Update()
        self.assertEqual((filter_.GetOutput().GetNumberOfPoints(), len(texts["ErrorEvent"])), (0, 1))
        data.GetPointData().AddArray(array)
        filter_.Update()
        self.assertEqual((filter_.GetOutput().GetNumberOfPoints(), len(texts["ErrorEvent"])), (count, 1))

    def test_hyper_tree_grids(self):
        filter_ = configured(self.kinds[0], vtkHyperTreeGrid())
        if self.differs("Hyper tree grids are no input."):
            with self.assertRaisesRegex(TypeError, "vtkHyperTreeGridCellCenters"):
                scatteredisopoints.Samples(vtkHyperTreeGrid())
        else:
            self.assert_one(self.texts_of(filter_, "ErrorEvent"), "no points or cells")

    # Composites

    def cloud_of_all(self, blocks, association=POINTS):
        return cloud_of(np.concatenate([places_of(block, association) for block in blocks]), np.concatenate(
            [vtk_to_numpy(block.GetAttributes(association).GetArray("f")) for block in blocks]), "f")

    def test_all_blocks_form_one_cloud(self):
        blocks = self.blocks()
        for association in (POINTS, CELLS):
            expected = self.contour(self.cloud_of_all(blocks, association)).GetOutput()
            self.assertGreater(expected.GetNumberOfPoints(), 20)
            for tree in self.trees(blocks):
                assert_same(self, self.contour(tree, association).GetOutput(), expected)

    def test_each_block_keeps_its_place(self):
        blocks = self.blocks()
        for kind in (0, 1):
            alone = [self.contour(block, kind=kind).GetOutput() for block in blocks]
            for tree in self.trees(blocks):
                output = self.contour(tree, kind=kind, ContourBlocks=True).GetOutputDataObject(0)
                self.assertEqual(output.GetClassName(), tree.GetClassName())
                leaves = leaves_of(tree, skips_empty=False)
                places = [leaf is not None and leaf.IsA("vtkDataSet") for leaf in leaves]
                found = leaves_of(output, skips_empty=False)
                self.assertEqual([leaf is not None for leaf in found], places)
                for leaf, expected in zip(filter(None, found), alone):
                    assert_same(self, leaf, expected)

    def test_only_arrays_of_all_blocks_are_in_the_output(self):
        blocks = self.blocks()
        for i, block in enumerate(blocks):
            places = positions_in(block)
            add(block, POINTS, "everywhere", 2 * places[:, 0])
            add(block, POINTS, "names", len(places) * ["name"])
            add(block, POINTS, "short", np.zeros(2))
            add(block, POINTS, "of several types", np.zeros(len(places), (np.int32, np.int32, np.float64)[i]))
            if i == 1:
                add(block, POINTS, "somewhere", places[:, 0])
        output = self.contour(self.trees(blocks)[0], Projection=0).GetOutput()
        arrays = output.GetPointData()
        names = {arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())}
        texts = set() if self.differs("String arrays are left out.") else {"names"}
        self.assertEqual(names, {"f", "everywhere", "Normals", "Radius"} | texts)
        np.testing.assert_allclose(values_in(output, "everywhere"), 2 * positions_in(output)[:, 0], atol=1e-14)

    def test_mixed_types_of_values(self):
        """Isovalues are float only if all values are; values of integers and floats lose nothing."""
        positions = positions_in(cloud(3000))
        values = np.rint(20 * np.linalg.norm(positions, axis=1))
        for kinds, kind in ((("f4", "f4"), "f4"), (("i2", "f4"), "f8"), (("f4", "f8"), "f8"), (("i2", "u1"), "f8")):
            blocks = [cloud_of(positions[part], values[part].astype(each), "f")
                      for part, each in zip((slice(1500), slice(1500, None)), kinds)]
            output = self.contour(blocks_of(*blocks), isovalue=14.5).GetOutput()
            self.assertEqual(values_in(output, "f").dtype, kind)
            whole = cloud_of(positions, values.astype("f4" if "f" in "".join(kinds) else "i4"), "f")
            np.testing.assert_array_equal(
                positions_in(output), positions_in(self.contour(whole, isovalue=14.5).GetOutput()))

    def test_blocks_without_the_array_are_counted(self):
        blocks = self.blocks()
        count = blocks[1].GetNumberOfPoints()
        blocks[1].GetPointData().RemoveArray("f")
        for by_block in (False, True):
            filter_ = self.contour(self.trees(blocks)[1], ContourBlocks=by_block)
            self.assertEqual(filter_.GetNumberOfSkippedSamples(), count)
            self.assertEqual(filter_.GetNumberOfSamples(), 3 * count)
            if by_block:
                found = leaves_of(filter_.GetOutputDataObject(0), skips_empty=False)
                self.assertEqual([leaf is not None for leaf in found], [True, False, False, True, False])
            self.assert_one(self.texts_of(configured(
                self.kinds[0], self.trees(blocks)[1], [0.2], ContourBlocks=by_block, InputArrayToProcess=(
                    0, 0, 0, POINTS, "f")), "MessageEvent"), str(count), "blocks")
        for block in (blocks[0], blocks[2]):
            block.GetPointData().RemoveArray("f")
        for by_block in (False, True):
            filter_ = chosen(configured(self.kinds[0], self.trees(blocks)[1], ContourBlocks=by_block), "f")
            self.assert_one(self.texts_of(filter_, "ErrorEvent"), '"f"', "cell arrays are: f")
            self.assertEqual(filter_.GetOutputDataObject(0).IsA("vtkMultiBlockDataSet"), int(by_block))
            self.assertEqual(filter_.GetErrorCode(), errno.EINVAL)

    def test_each_step_is_as_if_computed_alone(self):
        """A kept filter yields what a new one does after any change."""
        blocks = self.blocks()

        def change_values():
            values = values_in(blocks[1], "f")
            values[::3] = 0.8 * values[::3] - 0.05
            blocks[1].GetPointData().GetArray("f").Modified()

        def move():
            vtk_to_numpy(blocks[2].GetPoints().GetData())[:, 1] *= 1.25
            blocks[2].GetPoints().Modified()

        def hide():
            with_ghosts(blocks[0], POINTS, 30 * [1] + 95 * [0])

        def blank():  # in place
            blocks[0].GetPointData().GetArray("vtkGhostType").SetValue(60, HIDDEN_POINT)

        steps = (lambda: None, change_values, move, hide, blank, blocks.reverse, blocks.pop)
        for by_block in (False, True):
            blocks[:] = self.blocks()
            kept = self.contour(self.trees(blocks)[0], ContourBlocks=by_block)
            for step in steps:
                step()
                kept.SetInputDataObject(self.trees(blocks)[0])
                kept.Update()
                fresh = self.contour(self.trees(blocks)[0], ContourBlocks=by_block)
                with self.subTest(step.__name__, by_block=by_block):
                    self.assertEqual(kept.GetNumberOfSkippedSamples(), fresh.GetNumberOfSkippedSamples())
                    assert_same(self, kept.GetOutputDataObject(0), fresh.GetOutputDataObject(0))

    def test_field_data_of_composites_change(self):
        blocks = blocks_of(cloud(500), cloud(300))
        filter_ = configured(self.kinds[0], blocks, [0.7])
        for change, expected in (
                (lambda: blocks.GetFieldData().AddArray(named("TimeValue", [1.5])), 1.5),
                (lambda: blocks.GetFieldData().AddArray(named("TimeValue", [2.5])), 2.5),
                (lambda: filter_.SetInputDataObject(blocks_of(*leaves_of(blocks))), None),
                (lambda: filter_.SetInputDataObject(blocks), 2.5)):
            change()
            blocks.Modified()
            filter_.Update()
            found = filter_.GetOutput().GetFieldData().GetArray("TimeValue")
            self.assertEqual(found and found.GetValue(0), expected)

    def test_polygons_of_blocks(self):
        """Leaves that are no data sets have none."""
        isopoints = updated(self.kinds[0], cloud(), [0.7]).GetOutput()
        output = updated(self.module.vtkIsopointSplatPolygons, blocks_of(isopoints, vtkTable())).GetOutputDataObject(0)
        first, second = leaves_of(output, skips_empty=False)
        self.assertGreater(first.GetNumberOfPolys(), isopoints.GetNumberOfPoints())
        self.assertIsNone(second)

    def test_blocks_without_normals_empty_no_others(self):
        """Each problem is one warning for all blocks."""
        isopoints = updated(self.kinds[0], cloud(), [0.7]).GetOutput()
        isopoints.GetFieldData().AddArray(named("TimeValue", [1.5]))
        expected = updated(self.module.vtkIsopointSplatPolygons, isopoints).GetOutput()
        bare = [cloud_of(positions_in(isopoints)) for _ in range(2)]
        bare[0].GetFieldData().AddArray(isopoints.GetFieldData().GetArray(0))
        filter_ = configured(self.module.vtkIsopointSplatPolygons, blocks_of(bare[0], isopoints, bare[1]))
        texts = observed(filter_)
        filter_.Update()
        self.assertEqual((texts["ErrorEvent"], filter_.GetErrorCode()), ([], 0))
        self.assert_one(texts["WarningEvent"], "normals")
        first, second, _ = leaves_of(filter_.GetOutputDataObject(0))
        assert_same(self, second, expected)
        self.assertEqual(first.GetFieldData().GetArray("TimeValue").GetValue(0), 1.5)
        is_octahedra = not self.differs("`vtkIsopointSplatPolygons`: points without normals have no polygons.")
        self.assertEqual(first.GetNumberOfPolys() > 0, is_octahedra)
        filter_.SetInputDataObject(blocks_of(*bare))
        filter_.Update()
        self.assertEqual(len(texts["ErrorEvent"]), int(not is_octahedra))
        self.assert_one(texts["WarningEvent"][:-1] if is_octahedra else texts["WarningEvent"], "normals")

    def test_radius_scales_that_draw_nothing(self):
        """A negative one counts as 0. The filter works again with another one."""
        isopoints = updated(self.kinds[0], cloud(), [0.7]).GetOutput()
        isopoints.GetFieldData().AddArray(named("TimeValue", [1.5]))
        filter_ = configured(self.module.vtkIsopointSplatPolygons, isopoints)
        texts = observed(filter_)
        for scale in (0.0, -1.0, np.nan, np.inf, 1.0):
            filter_.SetRadiusScale(scale)
            filter_.Update()
            output = filter_.GetOutput()
            with self.subTest(scale=scale):
                self.assertEqual((filter_.GetErrorCode(), output.GetNumberOfPoints() > 0), (0, scale == 1.0))
                self.assertEqual(output.GetFieldData().GetArray("TimeValue").GetValue(0), 1.5)
                self.assertEqual(filter_.GetRadiusScale() == 0.0, scale <= 0)
        self.assertEqual(texts["ErrorEvent"], [])
        self.assert_one(texts["WarningEvent"], "The radius scale -1 is negative: nothing is drawn. Set it to 1 for"
                        " splats that close the surface.")

    # Arrays

    def test_arrays_of_the_output(self):
        data = cloud(3000)
        for kind in ("i1", "u2", "i4", "i8", "f4"):
            add(data, POINTS, kind, np.rint(100 * values_in(data, "x")).astype(kind))
        add(data, POINTS, "words", [str(i) for i in range(3000)])
        data.GetPointData().SetVectors(named("vectors", 2 * positions_in(data)))
        data.GetPointData().SetPedigreeIds(named("pedigree", np.arange(3000)))
        data.GetPointData().SetGlobalIds(named("global", np.arange(3000)))
        data.GetFieldData().AddArray(named("TimeValue", [1.5]))
        for kind in self.kinds:
            output = updated(
                kind, data, [0.7], Projection=0, ComputeGradients=True, ComputeProjectionOrders=True).GetOutput()
            arrays, x = output.GetPointData(), positions_in(output)[:, 0]
            names = {arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())}
            expected = {"distance", "x", "position", "i1", "u2", "i4", "i8", "f4", "vectors", "pedigree", "Normals",
                        "Gradients", "ProjectionOrder"} | ({"Radius"} if kind is self.kinds[0] else set())
            self.assertEqual(names, expected | (set() if self.differs("String arrays are left out.") else {"words"}))
            self.assertEqual((arrays.GetScalars().GetName(), arrays.GetNormals().GetName()), ("distance", "Normals"))
            self.assertEqual(arrays.GetVectors().GetName(), "vectors")
            self.assertEqual(arrays.GetPedigreeIds().GetName(), "pedigree")
            np.testing.assert_allclose(values_in(output, "position"), positions_in(output), atol=1e-12)
            for name in ("i1", "i4", "i8"):
                self.assertEqual(values_in(output, name).dtype, name)
            self.assertLess(np.abs(values_in(output, "i4") - 100 * x).max(), 1.5)
            self.assertTrue(np.isin(values_in(output, "pedigree"), np.arange(3000)).all())
            self.assertEqual(output.GetFieldData().GetArray("TimeValue").GetValue(0), 1.5)
            self.assertEqual(np.unique(values_in(output)), [0.7])
        bare = updated(self.kinds[0], data, [0.7], ComputeScalars=False, ComputeNormals=False, ComputeSplats=False)
        for name in ("distance", "Normals", "Radius"):
            self.assertFalse(bare.GetOutput().GetPointData().HasArray(name))
        add(data, POINTS, "Normals", positions_in(data))
        given = updated(self.kinds[0], data, [0.7], ComputeNormals=False, ComputeSplats=False).GetOutput()
        self.assertIsNone(given.GetPointData().GetNormals(), "an array like others")

    # Ghosts

    def test_points_of_ghost_cells_only_are_left_out(self):
        """Which points of each row along x are samples if the cells of the row have these ghost bits."""
        for bits, of_points, kept in (
                (5 * [0] + 3 * [DUPLICATE], None, 6 * [True] + 3 * [False]),
                ([DUPLICATE, HIDDEN, 0, 0, 0, 0, DUPLICATE, REFINED], None, [False] * 2 + [True] * 5 + [False] * 2),
                (4 * [0] + 4 * [REFINED], None, 5 * [True] + 4 * [False]),
                # A ghost array of the points determines the duplicates.
                ([DUPLICATE] * 2 + 3 * [0] + [DUPLICATE] + 2 * [HIDDEN],
                 [DUPLICATE_POINT, 0, 0, 0, 0, HIDDEN_POINT, 0, 0, 0],
                 [False] + 4 * [True] + [False, True] + 2 * [False])):
            for grid in every_grid():
                with_ghosts(with_field(grid), CELLS, bits)
                if of_points:
                    with_ghosts(grid, POINTS, of_points)
                with self.subTest(grid.GetClassName(), bits=bits):
                    self.assert_samples(grid, POINTS, np.resize(kept, grid.GetNumberOfPoints()))

    def test_ghost_cells_are_left_out(self):
        for bit in (DUPLICATE, HIDDEN, REFINED):
            for grid in every_grid():
                with_ghosts(with_field(grid, CELLS), CELLS, [0, 0, bit, 0, 0])
                with self.subTest(grid.GetClassName(), bit=bit):
                    self.assert_samples(grid, CELLS, np.arange(grid.GetNumberOfCells()) % 5 != 2)
        box = with_field(image(), CELLS)
        kept = [box.GetCell(i).GetPointIds().IsId(100) < 0 for i in range(box.GetNumberOfCells())]
        with_ghosts(box, POINTS, 100 * [0] + [HIDDEN_POINT] + 628 * [0])
        self.assert_samples(box, CELLS, np.array(kept))

    # Messages

    def test_each_cause_is_one_warning(self):
        def outside(data, filter_):
            values_in(data)[:2] = 0.03125, 7.5
            set_all(filter_, NumberOfContours=3)
            for i, isovalue in enumerate((8.25, 0.5, -1.0)):
                filter_.SetValue(i, isovalue)

        def in_gaps(data, filter_):
            places = vtk_to_numpy(data.GetPoints().GetData())
            values_in(data)[:] = places[:, 0] = places[:, 0] + np.where(places[:, 0] < 0, 0, 50)
            data.GetPoints().Modified()
            set_all(filter_, Value=(0, 25.0), DropGaps=True)

        def ghost(data, filter_):
            with_ghosts(data, POINTS, [0, 0, 0, DUPLICATE_POINT] + 1996 * [0])
            values_in(data)[3:5] = 9.0, 7.5
            filter_.SetValue(0, 8.125)

        def fine(data, filter_):
            values_in(data)[:] = 300 + 1e-5 * (np.arange(2000) % 5)
            filter_.SetValue(0, 300.0001)

        for change, words in (
                (outside, ("-1, 8.25", '"distance"', "0.03125", "7.5", "Choose")),
                (in_gaps, ("25", "gaps", "DropGaps")), (ghost, ("8.125", " 7.5")), (fine, ("300.0001", "300.00004")),
                (lambda data, _: values_in(data).fill(0.7), ('"distance"', "0.7", "Choose another array")),
                (lambda data, _: values_in(data).fill(np.nan), ("2000 of 2000", "not finite", "Choose another array"))):
            for kind in self.kinds:
                data = cloud()
                filter_ = configured(kind, data, [0.7])
                self.assertEqual(self.texts_of(filter_), [])
                change(data, filter_)
                data.GetPointData().GetScalars().Modified()
                with self.subTest(change=change.__name__, words=words):
                    self.assert_one(self.texts_of(filter_), *words)
                    if change is in_gaps:
                        set_all(filter_, UsePanelNames=True, Value=(0, 24.5))
                        self.assert_one(self.texts_of(filter_), "24.5", "Turn Drop Gaps off")
                    self.assertEqual(self.texts_of(filter_), [], "the same again")
                    self.assertEqual(filter_.GetOutput().GetNumberOfPoints() > 0, change is outside)

    def test_planes_and_noise_are_explained(self):
        data = cloud(500)
        vtk_to_numpy(data.GetPoints().GetData())[:, 2] = 0
        data.GetPoints().Modified()
        self.assert_one(self.texts_of(configured(self.kinds[0], data, [0.7])), "No fit", "plane", "Projection")
        self.assert_one(self.texts_of(configured(self.kinds[1], data, [0.7])), "plane", "Delaunay 2D")
        data = cloud(4000)
        values_in(data)[:] = np.random.default_rng(2).random(4000)
        filter_ = configured(self.kinds[0], data, [0.7])
        texts, count = self.texts_of(filter_), filter_.GetOutput().GetNumberOfPoints()
        self.assert_one(texts, "No fit", f"{filter_.GetNumberOfUnprojectedPoints()} of {count}", "Projection")
        self.assertEqual(filter_.GetNumberOfExtractedPoints(), count)
        set_all(filter_, Projection=0, ComputeSplats=False)
        self.assertEqual(self.texts_of(filter_), [])

    def test_skipped_samples_are_noted(self):
        data = cloud(500)
        values_in(data)[5] = np.nan
        data.GetPoints().SetPoint(6, np.inf, 0, 0)
        filter_ = configured(self.kinds[0], data, [0.7])
        self.assert_one(self.texts_of(filter_, "MessageEvent"), "2 of 500", "not finite")
        self.assertEqual((filter_.GetNumberOfSkippedSamples(), filter_.GetNumberOfSamples()), (2, 500))
        self.assertEqual(self.texts_of(configured(self.kinds[0], data, [0.7])), [], "a note is no warning")
        with_ghosts(data, POINTS, [0, 0, 0, DUPLICATE_POINT] + 496 * [0])
        texts = self.texts_of(configured(self.kinds[0], data, [0.7]), "MessageEvent")
        self.assert_one(texts, "3 of 500", "2 not finite", "1 excluded")
        hidden = with_ghosts(cloud(500), POINTS, [HIDDEN_POINT])
        self.assert_one(self.texts_of(configured(self.kinds[0], hidden, [0.7])), "All samples are excluded.")
        other = cloud_of(positions_in(cloud(30)))
        for by_block in (False, True):
            texts = self.texts_of(configured(
                self.kinds[0], blocks_of(data, other, cloud(400)), [0.7], ContourBlocks=by_block), "MessageEvent")
            if self.differs("Isosurfaces: samples of blocks without the array have a message of their own."):
                self.assert_one(texts[:1], "3 of 900", "2 not finite")
                self.assert_one(texts[1:], "30 points")
            else:
                self.assert_one(texts, "33 of 930", "2 not finite", "30 in blocks", '"distance"')

    def test_messages_of_blocks_are_those_of_the_whole(self):
        """An isovalue that one block has is not missing; one between the blocks is not in gaps."""
        distant = cloud(400)
        values_in(distant)[:] += 100
        for isovalues, words in (([0.7, 100.7], None), ([50.0], ("50", "ContourBlocks")), ([999.0], ("999", "Choose"))):
            for kind in self.kinds:
                texts = self.texts_of(configured(
                    kind, blocks_of(cloud(400), distant), isovalues, ContourBlocks=True, DropGaps=False))
                with self.subTest(isovalues=isovalues):
                    self.assert_one(texts, *words) if words else self.assertEqual(texts, [])

    def test_a_cause_is_reported_once_while_it_lasts(self):
        """Figures change with each time step."""
        for kind in self.kinds:
            data = cloud(500)
            filter_ = configured(kind, data, [9.0])
            texts = observed(filter_)
            for step in range(5):
                values_in(data)[7 + step] = np.nan
                values_in(data)[100] = 2.0 + 0.1 * step
                data.GetPointData().GetScalars().Modified()
                filter_.Update()
            other = cloud(500)
            other.GetPointData().GetScalars().SetName("other")
            filter_.SetInputDataObject(other)
            filter_.Update()
            self.assertEqual([len(list_) for list_ in texts.values()], [0, 2, 1])

    def test_a_warning_is_repeated_when_its_cause_changes(self):
        data = cloud(500)
        for name in ("one", "two"):
            add(data, POINTS, name, np.full(500, 2.0))
        filter_ = configured(self.kinds[0], data)
        for isovalue in (9.125, 0.7, 9.125, 8.125):
            filter_.SetValue(0, isovalue)
            if isovalue > 1:
                self.assert_one(self.texts_of(filter_), str(isovalue))
            self.assertEqual(self.texts_of(filter_), [])
        filter_.SetInputDataObject(cloud(400))
        self.assert_one(self.texts_of(filter_), "8.125")
        filter_.SetInputDataObject(data)
        for name in ("one", "two"):
            self.assert_one(self.texts_of(chosen(filter_, name)), f'"{name}"', "2")

    def test_splats_stay_apart_where_samples_are_too_few(self):
        data = cloud(5000)
        filter_ = updated(self.kinds[0], data, [0.0])
        for scale, are_apart in ((1, False), (12, True), (1, False)):
            x, y, z = scale * vtk_to_numpy(data.GetPoints().GetData()).T
            values_in(data)[:] = np.sin(x) + np.sin(y + z)
            values = data.GetPointData().GetArray("distance")
            values.Modified()
            filter_.Update()
            self.assertEqual(filter_.AreSplatsApart(), are_apart, scale)

    def test_each_invalid_use_is_one_error(self):
        data = cloud(500)
        add(data, POINTS, "names", 500 * ["name"])
        add(data, POINTS, "short", np.zeros(7))
        unloaded = with_ghosts(image(), POINTS, [0])
        without_points = set_all(vtkUnstructuredGrid())
        without_points.InsertNextCell(VTK_EMPTY_CELL, 0, [])
        add(without_points, CELLS, "x", np.zeros(1))
        vectors = cloud_of(positions_in(data), positions_in(data), "distance")
        offer = "distance, x, position, names, short"
        for use, words in (
                (lambda f: chosen(f, "g"), ("no point array", '"g"', "Choose", offer)),
                (lambda f: chosen(f, "g", CELLS), ("no cell array", '"g"', offer)),
                (lambda f: chosen(f, "g", ANY), ("point or cell array", '"g"', offer)),
                (lambda f: chosen(f, "", CELLS), ("active cell scalars", offer)),
                (lambda f: chosen(f, "short"), ('"short"', "7 values for 500 points", offer)),
                (lambda f: chosen(f, "position"), ('"position"', "3 components", "magnitude")),
                (lambda f: chosen(f, "names"), ('"names"', "no numbers", offer)),
                (lambda f: f.SetAngle(-1.0), ("Angle", "-1", "0 to 180")),
                (lambda f: f.SetAngle(180.5), ("Angle", "180.5", "0 to 180")),
                (lambda f: f.SetAngle(np.nan), ("Angle", "nan", "0 to 180")),
                (lambda f: f.SetValue(1, np.nan), ("not a number", "Choose")),
                (lambda f: f.SetInputDataObject(unloaded), ("load", "reader")),
                (lambda f: f.SetInputDataObject(vtkPolyData()), ("no points",)),
                (lambda f: f.SetInputDataObject(blocks_of(data, vectors)), ('"distance"', "3 components")),
                (lambda f: f.SetInputDataObject(blocks_of(vtkPolyData(), vtkTable())), ("no points",)),
                (lambda f: f.SetInputDataObject(vtkMultiBlockDataSet()), ("no points",)),
                (lambda f: chosen(set_all(f, InputDataObject=without_points), "x", CELLS), ("cells, but no points",))):
            for by_block in (False, True):
                filter_ = configured(self.kinds[0], data, [0.7], ContourBlocks=by_block)
                values_in(data)[0] = np.nan
                filter_.Update()
                self.assertEqual(filter_.GetNumberOfSkippedSamples(), 1)
                use(filter_)
                with self.subTest(words=words, by_block=by_block):
                    self.assert_one(self.texts_of(filter_, "ErrorEvent"), *words)
                    self.assertEqual(filter_.GetErrorCode(), errno.EINVAL)
                    self.assertEqual(filter_.GetOutputDataObject(0).GetNumberOfElements(POINTS), 0)
                    self.assertEqual([getattr(filter_, "GetNumberOf" + name)() for name in (
                        "SkippedSamples", "Samples", "ExtractedPoints")], [0, 0, 0])

    def test_curves_have_too_many_tetrahedra(self):
        t = np.linspace(0, 1, 3000)
        data = cloud_of(np.column_stack([t, t**2, t**3]), t, "distance")
        filter_ = configured(self.kinds[1], data, [0.5])
        self.assert_one(self.texts_of(filter_, "ErrorEvent"), "too many tetrahedra", "curves", "points", "probe",
                        "average", "radial basis functions")
        self.assertEqual(filter_.GetErrorCode(), errno.EINVAL)
        self.assertEqual(filter_.GetOutputDataObject(0).GetNumberOfElements(POINTS), 0)

    # Pieces

    def test_pieces(self):
        for kind in self.kinds:
            self.assert_pieces(updated(kind, cloud(3000), [0.7]))

    # Lives

    def test_filters_die(self):
        """Neither a filter nor its tree outlives its last reference, although its output does."""
        isopoints = updated(self.kinds[0], cloud(), [0.7]).GetOutput()
        polygons = self.module.vtkIsopointSplatPolygons
        gc.disable()
        try:
            for kind, data, properties in (
                    (self.kinds[0], cloud(), dict(Value=(0, 0.7))), (self.kinds[1], cloud(), dict(Value=(0, 0.7))),
                    (self.kinds[0], blocks_of(cloud(), cloud(300)), dict(Value=(0, 0.7), ContourBlocks=True)),
                    (polygons, isopoints, {}), (polygons, blocks_of(isopoints, isopoints), {})):
                filter_ = updated(kind, data, **properties)
                died, output = weakref.ref(filter_), filter_.GetOutputDataObject(0)
                del filter_
                self.assertIsNone(died(), kind)
                self.assertGreater(output.GetNumberOfElements(POINTS), 100)
        finally:
            gc.enable()

    def test_inputs_and_trees_die(self):
        """A filter keeps no former input alive, and no tree of a block that is gone."""
        alive = set()

        def watched_cloud():
            data = cloud(300)
            for watched in (data, data.GetPoints().GetData()):
                number = watched.GetAddressAsString("")
                alive.add(number)
                watched.AddObserver("DeleteEvent", lambda *_, number=number: alive.remove(number))
            return data

        gc.disable()
        try:
            for kind in self.kinds:
                filter_ = updated(kind, watched_cloud(), [0.7])
                filter_.SetInputDataObject(watched_cloud())
                self.assertLessEqual(len(alive), 3)  # the tree may keep the former positions until the update
                filter_.Update()
                self.assertEqual(len(alive), 2)
                for count in (20, 1):
                    filter_.SetInputDataObject(blocks_of(*(watched_cloud() for _ in range(count))))
                    filter_.ContourBlocksOn()
                    filter_.Update()
                    self.assertEqual(len(alive), 2 * count)
                del filter_
                self.assertEqual(alive, set())
        finally:
            gc.enable()

    # Degenerate clouds

    def test_few_samples(self):
        largest = np.finfo(float).max
        for samples, isovalue, points in (
                ([(1, 2, 3, 0.5)], 0.5, []), ([(0, 0, 0, 1), (4, 0, 0, 3)], 1.5, [(1, 0, 0)]),
                ([(0, 1, 0, 0), (2, 0, 0, 2), (2, 2, 0, 2)], 1.0, [(1, 0.5, 0), (1, 1.5, 0)]),
                ([(0, 0, 0, 0), (1, 0, 0, 1), (2, 0, 0, 2)], 1.0, [(1, 0, 0)]),
                ([(0, 0, 0, 1), (-0.0, 0, -0.0, 3), (1, 0, 0, -2)], 0.0, [(0.5, 0, 0)]),
                ([(0, 0, 0, -largest), (1, 0, 0, largest)], 0.0, [(0.5, 0, 0)])):
            samples = np.array(samples, float)
            output = self.contour(cloud_of(samples[:, :3], samples[:, 3], "f"), isovalue=isovalue).GetOutput()
            self.assertEqual(sorted(map(tuple, positions_in(output))), points)

    def test_clouds_without_a_surface(self):
        data = cloud()
        coincident = cloud_of(np.ones((2000, 3)), values_in(data), "f")
        whole = cloud_of(positions_in(data), values_in(data), "f")
        constant = cloud_of(positions_in(data), np.full(2000, 5.0), "f")
        for data, isovalue in ((coincident, 0.7), (constant, 5.0), (constant, 4.9), (whole, np.inf), (whole, -np.inf),
                               (whole, 1e300)):
            for kind in (0, 1):
                filter_ = self.contour(data, kind=kind, isovalue=isovalue)
                self.assertEqual(filter_.GetOutput().GetNumberOfPoints(), 0)
                self.assertTrue(filter_.GetOutput().GetPointData().HasArray("Normals"))
        empty = configured(self.kinds[0], whole)
        empty.SetNumberOfContours(0)
        self.assert_one(self.texts_of(empty), "No isosurface: there are no isovalues.")

    def test_scales(self):
        positions = positions_in(cloud())
        values = np.linalg.norm(positions, axis=1)
        expected = positions_in(self.contour(cloud_of(positions, values, "f"), isovalue=0.7).GetOutput())
        self.assertGreater(len(expected), 200)
        for scale in (2.0**-100, 2.0**30, 2.0**100):
            found = self.contour(cloud_of(scale * positions, values, "f"), isovalue=0.7).GetOutput()
            np.testing.assert_array_equal(positions_in(found), scale * expected)


class FiltersInPython(Filters, unittest.TestCase):
    module = _vtk

    def test_time_steps_do_not_grow(self):
        """One tree and one surface of the library are alive, whichever step it is."""
        alive = set()

        class Counted(_library.Surface):
            def __init__(self, pointer):
                super().__init__(pointer)
                alive.add(pointer)
                weakref.finalize(self, alive.remove, pointer)

        data, numbers = cloud(300), set()
        with mock.patch.object(_library, "Surface", Counted), mock.patch.object(
                _library, "create_extractor", wraps=_library.create_extractor) as create:
            filters = [configured(kind, data, [0.7]) for kind in self.kinds]
            filters.append(_vtk.vtkIsopointSplatPolygons())
            filters[2].SetInputConnection(filters[0].GetOutputPort())
            for _ in range(200):
                values_in(data)[:] *= 1.0001
                data.GetPointData().GetScalars().Modified()
                for filter_ in filters:
                    filter_.Update()
                numbers.add(len(alive))
            self.assertEqual(create.call_count, 2)
        self.assertEqual(numbers, {3})

    @unittest.skipUnless(DOCUMENT.exists(), "there is no document")
    def test_differences_are_documented(self):
        text = re.sub(r"\s+", " ", DOCUMENT.read_text())
        self.assertEqual([difference for difference in DIFFERENCES if f"- {difference}" not in text], [])


@unittest.skipIf(scatteredisopoints.vtkScatteredIsopointFilter is _vtk.vtkScatteredIsopointFilter, "it is not compiled")
class CompiledFilters(Filters, unittest.TestCase):
    module = scatteredisopoints


if __name__ == "__main__":
    unittest.main()
