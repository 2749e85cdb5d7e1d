# SPDX-License-Identifier: GPL-3.0-or-later
"""What the filters that interpolate, derive and slice samples promise, as compiled classes and as classes in Python:
samples, places, null points, arrays, messages, kept trees. TestPythonFilters.py compares the bytes of both."""

import errno
import gc
import unittest
import weakref

import numpy as np
import scatteredisopoints
from filter_testing import (
    CELLS, DUPLICATE_POINT, HIDDEN, HIDDEN_POINT, POINTS, FilterTests, add, chosen, cloud, every_grid, image, places_of,
    values_in, with_field, with_ghosts)
from scatteredisopoints import _vtk
from vtk_data import (
    assert_same, blocks_of, cloud_of, leaves_of, named, observed, positions_in, set_all)
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import VTK_DOUBLE, vtkBitArray, vtkIdList
from vtkmodules.vtkCommonDataModel import (
    vtkBox, vtkImplicitBoolean, vtkMultiBlockDataSet, vtkPlane, vtkPolyData, vtkSphere, vtkTable)
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline, vtkTrivialProducer
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkAssignAttribute

NAMES = ("Probe", "Line", "Grid", "Gradient", "Slice")


def some_places(count=200):
    return cloud_of(np.random.default_rng(5).uniform(-0.9, 0.9, (count, 3)))


def names_in(attributes):
    return [attributes.GetArrayName(i) for i in range(attributes.GetNumberOfArrays())]


class TimeSource(VTKPythonAlgorithmBase):
    """Samples whose values are the time."""

    def __init__(self):
        super().__init__(nInputPorts=0, outputType="vtkPolyData")

    def RequestInformation(self, _request, _inputs, outputs):
        info = outputs.GetInformationObject(0)
        info.Set(vtkStreamingDemandDrivenPipeline.TIME_STEPS(), [1.0, 2.0, 4.0], 3)
        info.Set(vtkStreamingDemandDrivenPipeline.TIME_RANGE(), [1.0, 4.0], 2)
        return 1

    def RequestData(self, _request, _inputs, outputs):
        time = outputs.GetInformationObject(0).Get(vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP())
        self.GetOutputData(outputs, 0).ShallowCopy(add(cloud(100), POINTS, "time", np.full(100, time)))
        return 1


class PlaceFilters(FilterTests):
    """The tests. Subclasses have the classes."""

    def new(self, name, data, **properties):
        """A filter on samples."""
        filter_ = getattr(self.module, f"vtkScattered{name}Filter")()
        if name == "Probe":
            filter_.SetSourceData(data)
        else:
            filter_.SetInputData(data)
        if name == "Slice":
            filter_.SetCutFunction(set_all(vtkPlane(), Normal=(0, 0, 1), Origin=(0, 0, 0.1)))
        if name == "Grid":
            filter_.SetSamplingDimensions(9, 8, 7)
        return set_all(filter_, **properties)

    def probe(self, data, places, **properties):
        return set_all(self.new("Probe", data, **properties), InputData=places)

    def output(self, filter_):
        """The output of an update without an error."""
        texts = observed(filter_)
        filter_.Modified()
        filter_.Update()
        filter_.RemoveAllObservers()
        self.assertEqual((texts["ErrorEvent"], filter_.GetErrorCode()), ([], 0))
        return filter_.GetOutputDataObject(0)

    def assert_error(self, filter_, *words):
        self.assert_one(self.texts_of(filter_, "ErrorEvent"), *words)
        self.assertEqual(filter_.GetErrorCode(), errno.EINVAL)
        self.assertEqual(filter_.GetOutputDataObject(0).GetNumberOfElements(POINTS), 0)
        self.assertEqual((filter_.GetNumberOfSamples(), filter_.GetNumberOfSkippedSamples()), (0, 0))

    # Samples

    def test_samples_of_every_kind_are_one_cloud(self):
        places = some_places()
        for association in (POINTS, CELLS):
            for grid in every_grid():
                add(grid, association, "f", np.cos(places_of(grid, association) @ [2.0, 3.0, 1.0]))
                same = cloud_of(places_of(grid, association))
                add(same, POINTS, "f", vtk_to_numpy(grid.GetAttributes(association).GetArray("f")))
                with self.subTest(grid.GetClassName(), association=association):
                    for name in ("Line", "Grid", "Slice"):
                        found, expected = (self.output(self.new(name, data)) for data in (grid, same))
                        self.assertGreater(expected.GetNumberOfPoints(), 20)
                        assert_same(self, found, expected)
                    assert_same(self, *(self.output(self.probe(data, places)) for data in (grid, same)))

    def test_blocks_and_ghosts(self):
        places, blocks = some_places(), self.blocks()
        for block in blocks:
            block.GetCellData().Initialize()
        together = cloud_of(np.concatenate([positions_in(block) for block in blocks]))
        add(together, POINTS, "f", np.concatenate([values_in(block, "f") for block in blocks]))
        expected = self.output(self.probe(together, places))
        for tree in self.trees(blocks):
            assert_same(self, self.output(self.probe(tree, places)), expected)
            assert_same(self, self.output(self.new("Slice", tree)), self.output(self.new("Slice", together)))
        plain, marked = cloud(1000), cloud(1003)
        with_ghosts(marked, POINTS, 1000 * [0] + [DUPLICATE_POINT, HIDDEN_POINT, 0])
        marked.GetPoints().SetPoint(1002, np.inf, 0, 0)
        for point in range(1000):
            marked.GetPoints().SetPoint(point, plain.GetPoint(point))
        for name in ("distance", "x", "position"):
            vtk_to_numpy(marked.GetPointData().GetArray(name))[:1000] = values_in(plain, name)
        filters = [self.probe(data, places) for data in (marked, plain)]
        assert_same(self, *map(self.output, filters))
        self.assertEqual([(each.GetNumberOfSamples(), each.GetNumberOfSkippedSamples()) for each in filters],
                         [(1003, 3), (1000, 0)])
        self.assert_one(self.texts_of(self.probe(marked, places), "MessageEvent"),
                        "Skipped 3 of 1003 samples: 1 not finite, 2 excluded. Values there are those of")

    def test_arrays_of_all_blocks(self):
        places, blocks = some_places(), self.blocks()
        for i, block in enumerate(blocks):
            positions = positions_in(block)
            block.GetPointData().SetScalars(named("several types", positions[:, 0].astype(("f4", "f8", "f8")[i])))
            block.GetPointData().SetPedigreeIds(named("ids", np.arange(len(positions))))
            add(block, POINTS, "names", len(positions) * ["name"] if i else np.arange(len(positions)))
            add(block, POINTS, "short", np.zeros(2))
            add(block, POINTS, "shapes", positions[:, :1 + i % 2])
            if i == 1:
                add(block, POINTS, "somewhere", positions[:, 0])
        filter_ = self.probe(blocks_of(*blocks), places)
        self.assert_one(self.texts_of(filter_, "MessageEvent"), 'Left out of the output: "names", "shapes", "short",'
                        ' "somewhere". Only arrays of numbers')
        attributes = filter_.GetOutput().GetPointData()
        self.assertEqual(names_in(attributes), ["f", "several types", "ids", "vtkValidPointMask"])
        self.assertEqual(attributes.GetPedigreeIds().GetName(), "ids")
        self.assertEqual(attributes.GetScalars().GetName(), "several types")
        self.assertEqual(self.texts_of(filter_, "MessageEvent"), [], "not repeated while it lasts")

    def test_nearest_arrays_and_the_range_of_integers(self):
        """Ids, text and listed arrays are those of the nearest sample. Other integers stay within the range of the
        samples, which numbers without a pattern leave, in slices rounded."""
        random, count = np.random.default_rng(3), 1500
        samples = cloud(count)
        attributes, positions = samples.GetPointData(), positions_in(samples)
        ids = numpy_to_vtkIdTypeArray(2**60 + random.permutation(count), deep=True)  # not held by double
        ids.SetName("of type")
        attributes.AddArray(ids)
        attributes.SetGlobalIds(named("global", random.permutation(count)))
        attributes.SetPedigreeIds(named("pedigree", random.permutation(count).astype(np.int32)))
        steps = np.sign(positions) * np.rint(1000 * np.abs(positions)**0.2)
        for name, numbers in (("material", random.integers(0, 9, (count, 2))), ("real", random.random(count)),
                              ("text", [f"sample {i}" for i in range(count)]), ("lines", steps[:, 0].astype(np.int16)),
                              ("pairs", steps[:, 1:].astype(np.int64)), ("as real", steps[:, 0])):
            attributes.AddArray(named(name, numbers))
        # What is hidden takes no part, nor does it widen the range.
        with_ghosts(samples, POINTS, [0, 0, 0, 0, HIDDEN_POINT])
        used = np.arange(count) % 5 < 4
        values_in(samples, "lines")[~used] = 32000
        copied = ["of type", "global", "pedigree", "material", "real"]
        text = [] if self.differs("String arrays are left out.") else ["text"]
        filters = [self.new(name, samples, Interpolation=interpolation) for name, interpolation in (
            ("Line", 0), ("Line", 1), ("Grid", 0), ("Slice", 0), ("Slice", 1), ("Slice", 2))]
        filters.append(self.probe(samples, some_places(), NullPointsStrategy=2))
        spheres = self.new("Slice", samples, CutFunction=set_all(vtkSphere(), Radius=0.6))
        is_beyond = False
        for filter_ in (*filters, spheres):
            self.assertEqual(filter_.GetNumberOfNearestArrays(), 0)
            for name in ("material", "real", "material", "nowhere"):
                filter_.AddNearestArray(name)
            self.assertEqual([filter_.GetNearestArray(i) for i in range(-1, 4)],
                             [None, "material", "real", "nowhere", None])
            if "Line" in filter_.GetClassName() or "Line" in type(filter_).__name__:
                set_all(filter_, Point1=(-0.8, -0.8, -0.8), Point2=(0.8, 0.7, 0.9))
            output = self.output(filter_)
            found, places = output.GetPointData(), positions_in(output)
            self.assertGreater(len(places), 100)
            distances = np.where(used, np.linalg.norm(places[:, None] - positions, axis=-1), np.inf)
            nearest = distances.argmin(axis=1)
            is_slice = filter_.GetNumberOfInputPorts() == 1 and hasattr(filter_, "SetCutFunction")
            for name in copied:
                array = found.GetArray(name)
                self.assertEqual(array.GetDataType(), attributes.GetArray(name).GetDataType(), name)
                np.testing.assert_array_equal(vtk_to_numpy(array), values_in(samples, name)[nearest])
            for name in text:
                array = found.GetAbstractArray(name)
                self.assertEqual([array.GetValue(i) for i in range(len(places))], [f"sample {i}" for i in nearest])
            self.assertIsNone(found.GetGlobalIds())
            self.assertEqual(found.GetPedigreeIds().GetName(), "pedigree")
            for name in ("lines", "pairs"):
                array, numbers = vtk_to_numpy(found.GetArray(name)), values_in(samples, name)[used]
                self.assertEqual(found.GetArray(name).GetDataType(),
                                 attributes.GetArray(name).GetDataType() if is_slice else VTK_DOUBLE)
                self.assertTrue((array >= numbers.min(axis=0)).all() and (array <= numbers.max(axis=0)).all(), name)
            real, limited = vtk_to_numpy(found.GetArray("as real")), steps[used, 0]
            beyond = (real < limited.min()) | (real > limited.max())
            if is_slice and filter_.GetInterpolation() != 2:
                np.testing.assert_allclose(vtk_to_numpy(found.GetArray("lines"))[~beyond], real[~beyond], atol=20)
            is_beyond |= beyond.any()
            filter_.ClearNearestArrays()
            self.assertEqual(filter_.GetNumberOfNearestArrays(), 0)
        self.assertTrue(is_beyond, "no number would leave the range")
        probed = self.probe(samples, cloud_of([[9.0, 9, 9]]))
        found = self.output(probed).GetPointData()
        self.assertEqual(found.GetArray("of type").GetTuple1(0), 0)
        for name in text:
            self.assertEqual(found.GetAbstractArray(name).GetValue(0), "")

    # Places

    def test_places_of_every_kind(self):
        samples = cloud(1000)
        for grid in every_grid():
            with_ghosts(with_field(grid), POINTS, [1] + 728 * [0])
            expected = self.output(self.probe(samples, cloud_of(positions_in(grid))))
            filter_ = self.probe(samples, grid)
            found = self.output(filter_)
            with self.subTest(grid.GetClassName()):
                self.assertEqual(found.GetClassName(), grid.GetClassName())
                np.testing.assert_array_equal(values_in(found), values_in(expected))
                self.assertEqual(names_in(found.GetPointData()),
                                 ["vtkGhostType", "distance", "x", "position", "vtkValidPointMask"])
                self.assertEqual(found.GetPointData().GetScalars().GetName(), "distance")
                self.assertEqual(names_in(found.GetCellData()), [])
                set_all(filter_, PassPointArrays=True, PassCellArrays=True)
                found = self.output(filter_)
                self.assertTrue(found.GetPointData().HasArray("f") and found.GetCellData().HasArray("f"))
        one, other = some_places(), some_places(7)
        one.GetFieldData().AddArray(named("TimeValue", [1.5]))
        found = self.output(self.probe(samples, blocks_of(one, None, vtkTable(), other)))
        leaves = leaves_of(found, skips_empty=False)
        self.assertEqual([leaf is None for leaf in leaves], [False, True, True, False])
        for leaf, places in ((leaves[0], one), (leaves[3], other)):
            assert_same(self, leaf, self.output(self.probe(samples, places)))
        self.assertEqual(leaves[0].GetFieldData().GetArray(0).GetValue(0), 1.5)

    def test_null_points_follow_the_strategy(self):
        samples = cloud(1000, kind=np.float32)
        add(samples, POINTS, "int", (np.arange(1000) % 50).astype(np.int32))
        add(samples, POINTS, "wide", np.append(2**60 + 1, np.arange(1, 1000)))
        bits = vtkBitArray()
        for i in range(1000):
            bits.InsertNextValue(i % 2)
        bits.SetName("bit")
        samples.GetPointData().AddArray(bits)
        samples.GetPointData().GetArray("position").SetComponentName(2, "up")
        places = cloud_of(np.array([[9, 9, 9], samples.GetPoint(0), [np.nan, 0, 0]]))
        filter_ = self.probe(samples, places)
        found = self.output(filter_).GetPointData()
        mask = found.GetArray("vtkValidPointMask")
        self.assertEqual((mask.GetClassName(), [mask.GetTuple1(i) for i in range(3)]), ("vtkCharArray", [0, 1, 0]))
        self.assertEqual(found.GetArray("int").GetDataType(), VTK_DOUBLE)
        self.assertEqual(found.GetArray("position").GetComponentName(2), "up")
        self.assertTrue(np.isnan(vtk_to_numpy(found.GetArray("position"))[[0, 2]]).all())

        set_all(filter_, Interpolation=filter_.NEAREST, NullPointsStrategy=filter_.NULL_VALUE, NullValue=-1e12)
        found = self.output(filter_).GetPointData()
        self.assertFalse(found.HasArray("vtkValidPointMask"))
        for name, outside in (("distance", -1e12), ("int", 0), ("wide", -1e12), ("bit", 0)):
            array, given = found.GetArray(name), samples.GetPointData().GetArray(name)
            self.assertEqual(array.GetDataType(), given.GetDataType())
            self.assertAlmostEqual(array.GetTuple1(0) / (outside or 1), outside != 0, places=6)
            self.assertEqual(array.GetValue(1), given.GetValue(0))

        set_all(filter_, Interpolation=filter_.BLEND, NullPointsStrategy=filter_.CLOSEST_POINT,
                MarkBlankPointsAndCells=True)
        found = self.output(filter_).GetPointData()
        self.assertGreater(found.GetArray("distance").GetTuple1(0), 1)
        self.assertEqual(vtk_to_numpy(found.GetArray("vtkGhostType")).tolist(), [HIDDEN_POINT, 0, HIDDEN_POINT])
        self.assertEqual((set_all(filter_, NullPointsStrategy=7).GetNullPointsStrategy(),
                          set_all(filter_, Interpolation=-3).GetInterpolation()), (2, 0))

    def test_lines(self):
        samples = cloud(1000)
        line = self.output(self.new("Line", samples, Point1=(-1.5, 0, 0.25), Point2=(1.5, 0, 0.25), Resolution=12))
        self.assertEqual((line.GetNumberOfPoints(), line.GetCell(0).GetNumberOfPoints()), (13, 13))
        np.testing.assert_allclose(values_in(line, "arc_length"), 0.25 * np.arange(13))
        np.testing.assert_allclose(positions_in(line)[:, 0], -1.5 + 0.25 * np.arange(13))
        places = cloud_of(positions_in(line))
        np.testing.assert_array_equal(values_in(line), values_in(self.output(self.probe(samples, places))))
        self.assertEqual(values_in(line, "vtkValidPointMask")[[0, 6]].tolist(), [0, 1])
        filter_ = self.new("Line", samples)
        filter_.UpdatePiece(1, 2, 0)
        self.assertEqual(filter_.GetOutput().GetNumberOfPoints(), 0)
        self.assert_error(self.new("Line", samples, Point2=(1, np.inf, 0)), "ends of the line are not finite")

    def test_own_arrays_stay(self):
        samples, places = cloud(1000), some_places()
        for name in ("arc_length", "mask"):
            add(samples, POINTS, name, np.full(1000, -5.0))
        filter_ = self.new("Line", samples, Resolution=10, ValidPointsMaskArrayName="mask")
        self.assert_one(self.texts_of(filter_, "MessageEvent"), 'Left out of the output: "arc_length", "mask". The')
        np.testing.assert_allclose(values_in(filter_.GetOutput(), "arc_length"), np.linspace(0, np.sqrt(3), 11))
        self.assertEqual(filter_.GetOutput().GetPointData().GetArray("mask").GetClassName(), "vtkCharArray")
        filter_ = self.probe(samples, places, ValidPointsMaskArrayName="mask")
        self.assert_one(self.texts_of(filter_, "MessageEvent"), 'Left out of the output: "mask". The')
        set_all(filter_, NullPointsStrategy=filter_.NULL_VALUE, NullValue=-5)
        np.testing.assert_allclose(values_in(self.output(filter_), "mask"), -5)

    def test_grids(self):
        samples = cloud(1000)
        samples.GetPoints().SetPoint(0, np.inf, 0, 0)
        samples.GetPoints().SetPoint(1, 50, 0, 0)
        with_ghosts(samples, POINTS, [0, HIDDEN_POINT] + 998 * [0])
        filter_ = self.new("Grid", samples, SamplingDimensions=(6, 5, 4))
        whole = self.output(filter_).NewInstance()
        whole.ShallowCopy(filter_.GetOutput())
        self.assertEqual(whole.GetDimensions(), (6, 5, 4))
        positions = positions_in(samples)[2:]
        np.testing.assert_allclose(np.reshape(whole.GetBounds(), (3, 2)), [*zip(positions.min(axis=0),
                                                                               positions.max(axis=0))], rtol=1e-14)
        at = self.output(self.probe(samples, cloud_of(positions_in(whole))))
        outside = values_in(at, "vtkValidPointMask") == 0
        self.assertTrue(outside.any())
        np.testing.assert_array_equal(values_in(whole, "vtkGhostType"), HIDDEN_POINT * outside)
        np.testing.assert_array_equal(values_in(whole)[~outside], values_in(at)[~outside])
        ids, corners = vtkIdList(), []
        for cell in range(whole.GetNumberOfCells()):
            whole.GetCellPoints(cell, ids)
            corners.append([ids.GetId(k) for k in range(8)])
        np.testing.assert_array_equal(vtk_to_numpy(whole.GetCellData().GetArray("vtkGhostType")),
                                      HIDDEN * outside[np.array(corners)].any(axis=1))
        cells = 0
        for piece in range(3):  # boxes with the same values
            filter_.UpdatePiece(piece, 3, 0)
            box = filter_.GetOutput()
            cells += box.GetNumberOfCells()
            same = [whole.FindPoint(place) for place in positions_in(box)]
            np.testing.assert_array_equal(values_in(box), values_in(whole)[same])
        self.assertEqual(cells, whole.GetNumberOfCells())

        # An axis without length has one layer, also for the next update.
        vtk_to_numpy(samples.GetPoints().GetData())[:, 2] = 3
        samples.GetPoints().Modified()
        filter_.UpdatePiece(0, 1, 0)
        filter_.Update()
        self.assertEqual((filter_.GetOutput().GetDimensions(), filter_.GetOutput().GetBounds()[4]), ((6, 5, 1), 3))
        set_all(filter_, UseInputBounds=False, SamplingBounds=(0, 1, 1, 0, 0, 1))
        self.assert_error(filter_, "ascending")
        set_all(filter_, SamplingBounds=(0, 1, 0, 1, 3, 3), SamplingDimensions=(3, -1, 1))
        self.assert_error(filter_, "dimension is negative")
        set_all(filter_, SamplingDimensions=(3, 2, 1), Spacing=(0, 0, -1))
        self.assert_error(filter_, "spacing is negative")
        filter_.SetSpacing(0, 0, 0)
        filter_.SetSamplingDimensions(3, 2, 1)
        self.assertEqual(self.output(filter_).GetNumberOfPoints(), 6)
        self.assert_error(self.new("Grid", with_ghosts(cloud(10), POINTS, [HIDDEN_POINT])), "All samples are hidden")
        self.assert_error(self.new("Grid", cloud(10), SamplingDimensions=3 * (100000,)), "Reduce the sampling dim")

    def test_voxels_are_cubes_unless_numbers_of_points_are_given(self):
        """The spacing is that of the longest side in 99 parts, or given; the image may end beyond the bounds."""
        samples = cloud_of(np.vstack([np.zeros(3), np.random.default_rng(2).random((50, 3)), np.ones(3)])
                           * (1, 0.5, 0.26), np.arange(52.0))
        for options, extent, spacing in (
                (dict(), (99, 50, 26), 3 * (1 / 99,)), (dict(Spacing=3 * (0.1,)), (10, 5, 3), 3 * (0.1,)),
                (dict(Spacing=(0.25, 0.1, 0.26), SamplingDimensions=(0, 3, 0)), (4, 2, 1), (0.25, 0.25, 0.26))):
            filter_ = self.new("Grid", samples, **dict(dict(SamplingDimensions=(0, 0, 0)), **options))
            filter_.UpdateInformation()
            announced = filter_.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT())
            self.assertEqual(announced[1::2], extent)
            if options:
                image = self.output(filter_)
                self.assertEqual(image.GetExtent()[1::2], extent)
                np.testing.assert_allclose(image.GetSpacing(), spacing, rtol=1e-15)
                np.testing.assert_allclose(image.GetOrigin(), 3 * [0], atol=1e-15)

    def test_images_have_the_extent_that_they_announce(self):
        """Filters downstream then do not ask for one that is outside, nor for an update without a change."""
        flat = cloud_of(np.random.default_rng(2).random((50, 3)) * (2, 1, 0), np.arange(50.0))
        # Samples in use that end before others do.
        hidden = with_ghosts(cloud(50), POINTS, [HIDDEN_POINT, HIDDEN_POINT] + 48 * [0])
        hidden.GetPoints().SetPoint(0, 2, 2, 2)
        hidden.GetPoints().Modified()
        centers = image(6)
        add(centers, CELLS, "f", np.arange(216.0))
        for data, options in ((flat, dict(SamplingDimensions=(5, 4, 3))), (flat, dict(Spacing=3 * (0.5,))),
                              (flat, {}), (hidden, {}), (hidden, dict(Spacing=3 * (0.1,))),
                              (centers, dict(Spacing=3 * (0.1,)))):
            producer = vtkTrivialProducer()
            producer.SetOutput(data)
            filter_ = self.new("Grid", data, **dict(dict(SamplingDimensions=(0, 0, 0), Interpolation=4), **options))
            filter_.SetInputConnection(producer.GetOutputPort())
            errors = observed(filter_.GetExecutive())["ErrorEvent"]
            after = vtkAssignAttribute()
            after.Assign("SCALARS", "SCALARS", "POINT_DATA")  # does nothing
            after.SetInputConnection(filter_.GetOutputPort())
            after.Update()
            updated_at = filter_.GetOutput().GetUpdateTime()
            after.UpdateWholeExtent()
            self.assertEqual(after.GetOutput().GetExtent(), filter_.GetOutput().GetExtent())
            self.assertEqual(filter_.GetOutput().GetUpdateTime(), updated_at)
            self.assertEqual(errors, [])
            if "Spacing" in options:
                self.assertEqual(filter_.GetOutput().GetSpacing(), options["Spacing"])

    def test_grids_have_the_chosen_arrays(self):
        samples = cloud_of(np.random.default_rng(2).random((50, 3)), np.arange(50.0), "values")
        samples.GetPointData().AddArray(named("other", np.arange(50.0)))
        filter_ = self.new("Grid", samples, MarkBlankPointsAndCells=0)
        for names in (["values"], ["other"], ["values", "other"], []):  # the former scalars do not stay
            filter_.ClearArrays()
            for name in names:
                filter_.AddArray(name)
            self.assertEqual(sorted(names_in(self.output(filter_).GetPointData())),
                             sorted(names or ["values", "other"]))
        filter_.AddArray("nothing")
        self.assert_error(filter_, "none of the chosen arrays")

    def test_pieces_of_flat_grids(self):
        samples = cloud(1000)
        vtk_to_numpy(samples.GetPoints().GetData())[:, 2] = 3
        filter_ = self.new("Grid", samples, SamplingDimensions=(6, 5, 40))
        cells = []
        for piece in range(3):
            filter_.UpdatePiece(piece, 3, 0)
            self.assertEqual(filter_.GetErrorCode(), 0)
            cells.append(filter_.GetOutput().GetNumberOfCells())
        self.assertEqual(sum(cells), 20)

    def test_time_steps_are_those_of_the_source(self):
        filter_ = self.probe(cloud(), some_places(1))
        source = TimeSource()
        filter_.SetSourceConnection(source.GetOutputPort())
        filter_.UpdateInformation()
        info = filter_.GetOutputInformation(0)
        self.assertEqual(info.Length(vtkStreamingDemandDrivenPipeline.TIME_STEPS()), 3)
        for time in (2.0, 4.0):
            filter_.UpdateTimeStep(time)
            np.testing.assert_allclose(values_in(filter_.GetOutput(), "time"), time)

    # Derivatives

    def test_gradients_of_affine_vectors_are_exact(self):
        matrix = np.array([[2.0, -3, 5], [7, 11, -13], [-17, 19, 23]])
        samples = cloud(500)
        add(samples, POINTS, "v", positions_in(samples) @ matrix.T)
        samples.GetPoints().SetPoint(7, np.nan, 0, 0)
        filter_ = chosen(
            self.new("Gradient", samples, ComputeDivergence=1, ComputeVorticity=1, ComputeQCriterion=1), "v")
        filter_.SetInterpolation(filter_.AFFINE)
        found = self.output(filter_)
        for name, expected in (("Gradients", matrix.ravel()), ("Divergence", 36), ("Vorticity", [32, 22, 10]),
                               ("Q-criterion", -0.5 * (4 + 121 + 529) + 21 + 85 + 247)):
            numbers = values_in(found, name)
            self.assertTrue(np.isnan(numbers[7]).all())
            np.testing.assert_allclose(np.delete(numbers, 7, axis=0), np.broadcast_to(
                expected, (499, *numbers.shape[1:])), atol=1e-8)
        self.assertFalse(samples.GetPointData().HasArray("Gradients"))
        self.assert_error(chosen(filter_, "x"), "need vectors, but the array has 1 component.")
        self.assert_error(chosen(filter_, "none"), 'no point array named "none"', "distance, x, position, v")
        set_all(filter_, ComputeDivergence=0, ComputeVorticity=0, ComputeQCriterion=0, ResultArrayName="grad")
        np.testing.assert_allclose(values_in(self.output(chosen(filter_, "x")), "grad")[8], [1, 0, 0], atol=1e-8)

    def test_gradients_belong_to_the_samples(self):
        for grid in every_grid():
            for association in (POINTS, CELLS):
                add(grid, association, "f", np.cos(places_of(grid, association) @ [2.0, 3.0, 1.0]))
                numbers = vtk_to_numpy(grid.GetAttributes(association).GetArray("f"))
                same = cloud_of(places_of(grid, association), numbers)
                found = self.output(chosen(self.new("Gradient", grid), "f", association))
                self.assertEqual(found.GetClassName(), grid.GetClassName())
                np.testing.assert_array_equal(
                    vtk_to_numpy(found.GetAttributes(association).GetArray("Gradients")),
                    values_in(self.output(self.new("Gradient", same)), "Gradients"))
        # All blocks with the array are one cloud; the others stay as they are.
        samples, table = cloud(1000), vtkTable()
        halves = [cloud_of(positions_in(samples)[i::2], values_in(samples)[i::2], "distance") for i in (0, 1)]
        bare = cloud_of(positions_in(samples))
        filter_ = chosen(self.new("Gradient", blocks_of(halves[0], None, table, bare, halves[1])), "distance")
        self.assert_one(self.texts_of(filter_, "MessageEvent"), 'Skipped 1000 of 2000 samples: in blocks without "dist')
        leaves = leaves_of(filter_.GetOutputDataObject(0), skips_empty=False)
        self.assertEqual([leaf and leaf.GetClassName() for leaf in leaves],
                         ["vtkPolyData", None, "vtkTable", "vtkPolyData", "vtkPolyData"])
        self.assertEqual(names_in(leaves[3].GetPointData()), [])
        whole = values_in(self.output(self.new("Gradient", samples)), "Gradients")
        for i, leaf in ((0, leaves[0]), (1, leaves[4])):
            np.testing.assert_allclose(values_in(leaf, "Gradients"), whole[i::2], atol=1e-9)
        add(bare, POINTS, "distance", positions_in(bare))
        self.assert_error(chosen(self.new("Gradient", blocks_of(halves[0], bare)), "distance"),
                          "different numbers of components")

    def test_gradients_that_are_not_there(self):
        samples = cloud(1000)
        are_right = values_in(samples, "x") > 0
        for are_hidden, event in ((are_right | True, "WarningEvent"), (are_right, "MessageEvent")):
            filter_ = self.new("Gradient", with_ghosts(samples, POINTS, (HIDDEN_POINT * are_hidden).tolist()))
            texts = self.texts_of(filter_, event)
            lacking = np.isnan(values_in(filter_.GetOutput(), "Gradients")).any(axis=1).sum()
            self.assertGreater(lacking, 100)
            self.assert_one(texts, f"{lacking} of 1000 points have no gradient: no samples around are in use")
        self.assert_one(self.texts_of(self.new("Gradient", cloud_of(positions_in(samples), np.full(1000, np.nan)))),
                        "1000 of 1000 points have no gradient: no samples around are in use and have finite values.")

    def test_names_of_derivatives(self):
        samples = cloud(500)
        filter_ = chosen(self.new("Gradient", samples, ComputeDivergence=1), "position")
        for name in ("", "vtkGhostType", "Gradients"):
            self.assert_error(set_all(filter_, DivergenceArrayName=name), f'cannot have the name "{name}"')
        set_all(filter_, DivergenceArrayName="d")
        np.testing.assert_allclose(values_in(self.output(filter_), "d"), 3, atol=1e-8)
        set_all(filter_, ComputeDivergence=0, ComputeGradient=0)
        self.assertEqual(names_in(self.output(filter_).GetPointData()), ["distance", "x", "position"])
        expected = values_in(self.output(self.new("Gradient", samples)), "Gradients").copy()
        samples.GetPointData().GetScalars().SetName(None)
        np.testing.assert_array_equal(values_in(self.output(self.new("Gradient", samples)), "Gradients"), expected)

    # Slices

    def test_slices_of_functions(self):
        samples = cloud(3000)
        add(samples, POINTS, "byte", np.rint(100 + 100 * values_in(samples, "x")).astype(np.uint8))
        add(samples, POINTS, "Normals", positions_in(samples))
        for function in (set_all(vtkPlane(), Normal=(1, 2, 3)), set_all(vtkSphere(), Radius=0.6)):
            for interpolation in (0, 1):
                filter_ = self.new("Slice", samples, CutFunction=function, Interpolation=interpolation, Value=(1, 0.05))
                found = self.output(filter_)
                places = positions_in(found)
                distances = np.array([function.FunctionValue(place) for place in places])
                np.testing.assert_allclose(np.minimum(abs(distances), abs(distances - 0.05)), 0, atol=1e-12)
                np.testing.assert_allclose(values_in(found, "position"), places, atol=1e-12)
                self.assertEqual(values_in(found, "byte").dtype, np.uint8)
                self.assertLess(np.abs(values_in(found, "byte") - (100 + 100 * places[:, 0])).max(), 1.5)
                self.assertEqual(found.GetPointData().GetScalars().GetName(), "distance")
                self.assertIsNone(found.GetPointData().GetNormals(), "an array like others")
                self.assertEqual(filter_.GetNumberOfExtractedPoints(), len(places))
                self.assertGreater(len(places), 200)

    def test_changes_of_the_function_are_noticed(self):
        samples, plane = cloud(), set_all(vtkPlane(), Normal=(0, 0, 1))
        filter_ = self.new("Slice", samples, CutFunction=plane)
        for height in (0.0, 0.3):
            plane.SetOrigin(0, 0, height)
            filter_.Update()
            np.testing.assert_allclose(positions_in(filter_.GetOutput())[:, 2], height, atol=1e-14)
        filter_.SetCutFunction(set_all(vtkPlane(), Normal=(1, 0, 0)))
        filter_.Update()
        before = filter_.GetMTime()
        plane.SetOrigin(0, 0, 0.5)
        self.assertEqual(filter_.GetMTime(), before, "it is another one's")
        np.testing.assert_allclose(positions_in(filter_.GetOutput())[:, 0], 0, atol=1e-14)
        filter_.SetCutFunction(plane)
        consumer = self.new("Line", None)
        consumer.SetInputConnection(filter_.GetOutputPort())  # the pipeline alone keeps the filter
        del filter_
        gc.collect()
        for height in (0.2, 0.4):
            plane.SetOrigin(0, 0, height)
            consumer.Update()
            np.testing.assert_allclose(positions_in(consumer.GetInput())[:, 2], height, atol=1e-14)

    def test_empty_slices(self):
        samples = cloud(500)
        self.assert_error(self.new("Slice", samples, CutFunction=None), "no cut function")
        filter_ = self.new("Slice", samples, Value=(0, 9.0))
        self.assert_one(self.texts_of(filter_), "No slice: all samples are on one side of it.")
        self.assertEqual(names_in(filter_.GetOutput().GetPointData()), ["distance", "x", "position"])
        apart = cloud(500)
        vtk_to_numpy(apart.GetPoints().GetData())[250:] += [0, 0, 50]
        self.assert_one(self.texts_of(self.new("Slice", apart, Value=(0, 20.0))), "in gaps", "Turn DropGaps off")
        vtk_to_numpy(apart.GetPoints().GetData())[:, 0] = 0
        self.assert_one(self.texts_of(self.new("Slice", apart)), "in one plane")
        vtk_to_numpy(apart.GetPoints().GetData())[:, 2] = 0.1
        for function in (vtkImplicitBoolean(), set_all(vtkPlane(), Normal=(0, 0, 1), Origin=(0, 0, 0.1))):
            self.assert_one(self.texts_of(self.new("Slice", apart, CutFunction=function)), "the same at all samples")
        least = set_all(vtkPlane(), Normal=(0, 0, 1), Origin=(0, 0, -1))
        self.assert_one(self.texts_of(self.new("Slice", image(), CutFunction=least)), "count as above it")
        self.assert_one(self.texts_of(self.new("Slice", samples, NumberOfContours=0)), "no offsets")
        for data, event in ((samples, "WarningEvent"), (image(), "MessageEvent")):
            box = set_all(vtkBox(), Bounds=data.GetBounds())  # ParaView's default
            filter_ = self.new("Slice", data, CutFunction=box)
            self.assert_one(self.texts_of(filter_, event), "no sample is beyond it")
            box.SetBounds(3 * (-0.5, 0.5))
            self.assertEqual(self.texts_of(filter_, event), [])
        blocks = [add(cloud(500, seed), POINTS, str(seed), np.zeros(500)) for seed in (1, 2)]
        for interpolation in (0, 1):
            filter_ = self.new("Slice", blocks_of(*blocks), Interpolation=interpolation)
            self.assert_one(self.texts_of(filter_, "MessageEvent"), 'Left out of the output: "1", "2". Only arrays')
        self.assert_error(self.new("Slice", samples, Value=(0, np.nan)), "not a number")

    def test_pieces_of_slices(self):
        filter_ = self.new("Slice", cloud(3000))
        self.output(filter_)
        self.assert_pieces(filter_)

    def test_functions_within_functions(self):
        plane, transform = set_all(vtkPlane(), Normal=(0, 0, 1)), vtkTransform()
        plane.SetTransform(transform)
        filter_ = self.new("Slice", cloud(), CutFunction=plane)
        filter_.Update()
        transform.Translate(0, 0, 0.25)
        filter_.Update()
        if self.differs(
                "Slices: call `Modified()` after changes of the function's transform, or of functions within it."):
            np.testing.assert_allclose(positions_in(filter_.GetOutput())[:, 2], 0, atol=1e-14)
            updated_again(filter_)
        np.testing.assert_allclose(positions_in(filter_.GetOutput())[:, 2], -0.25, atol=1e-14)

    def test_functions_that_are_not_finite(self):
        filter_ = self.new("Slice", cloud(500), CutFunction=set_all(vtkSphere(), Radius=np.nan))
        self.assert_error(filter_, "The cut function is not finite at 500 of 500 samples.")
        for name, numbers, word in (("Normal", (0, np.nan, 1), "not finite"), ("Normal", (0, 0, 0), "zero"),
                                    ("Origin", (np.inf, 0, 0), "not finite")):
            plane = set_all(vtkPlane(), Normal=(1, 0, 0))
            getattr(plane, f"Set{name}")(numbers)
            self.assert_error(self.new("Slice", cloud(500), CutFunction=plane), "of the plane is", word)

    # Messages

    def test_messages_name_what_is_missing(self):
        samples, places = cloud(1000), some_places(2)
        away = cloud_of(positions_in(places) + [9, 0, 0])
        self.assert_one(self.texts_of(self.probe(samples, away)), "All 2 points are outside of the samples")
        self.assertEqual(self.texts_of(self.probe(samples, away, NullPointsStrategy=2)), [])
        bare = cloud_of(positions_in(samples))
        filter_ = self.probe(bare, places)
        self.assert_one(self.texts_of(filter_), "have no arrays")
        self.assertEqual(names_in(filter_.GetOutput().GetPointData()), ["vtkValidPointMask"])
        flat = cloud_of(positions_in(samples) * [1, 1, 0], values_in(samples))
        self.assert_one(self.texts_of(self.probe(flat, places), "MessageEvent"), "At 2 of 2 points", "in a plane")
        for lacking in flat, cloud_of([[1.0, 2.0, 3.0]], [4.0]):
            self.assert_one(self.texts_of(self.new("Gradient", lacking)), "gradients have no part across")
        nowhere = cloud_of(np.full((5, 3), np.nan), np.zeros(5))
        self.assert_one(self.texts_of(self.probe(nowhere, places)),
                        "Skipped 5 of 5 samples: not finite. There are no values.")
        hidden = with_ghosts(cloud(5), POINTS, [HIDDEN_POINT])
        for strategy in range(3):
            self.assert_one(self.texts_of(self.probe(hidden, places, NullPointsStrategy=strategy)),
                            "All samples are excluded. Include some.")
        different = blocks_of(*(add(bare, POINTS, name, np.zeros(1000)) for bare, name in (
            (cloud_of(positions_in(samples)), "a"), (cloud_of(positions_in(samples) + 2), "b"))))
        for filter_ in (self.probe(different, places), self.new("Line", different), self.new("Grid", different)):
            texts = observed(filter_)
            filter_.Update()
            self.assertEqual(texts["WarningEvent"], [])
            self.assert_one(texts["MessageEvent"], 'Left out of the output: "a", "b". Only arrays')
        for name in NAMES:
            for data in (vtkPolyData(), blocks_of(vtkPolyData(), vtkTable()), vtkMultiBlockDataSet()):
                filter_ = self.new(name, data)
                self.assert_error(set_all(filter_, InputData=places) if name == "Probe" else filter_, "no points")
        self.assert_error(self.new("Gradient", bare), "active point scalars")
        self.assertEqual(self.output(self.probe(samples, vtkPolyData())).GetNumberOfPoints(), 0)

    # Updates

    def test_kept_trees_follow_the_samples(self):
        samples, places = cloud(1000), some_places()
        for name in NAMES:
            filter_ = self.new(name, samples)
            if name == "Probe":
                filter_.SetInputData(places)

            def change():
                values_in(samples)[3] += 20
                samples.GetPointData().GetScalars().Modified()

            def move():
                vtk_to_numpy(samples.GetPoints().GetData())[:, 0] *= 0.75
                samples.GetPoints().Modified()

            for step in (lambda: None, change, move, filter_.KeepTreeOff, filter_.KeepTreeOn):
                step()
                filter_.Update()
                fresh = self.new(name, samples)
                if name == "Probe":
                    fresh.SetInputData(places)
                with self.subTest(name, step=step.__name__):
                    self.assertEqual(filter_.GetErrorCode(), 0)
                    assert_same(self, filter_.GetOutputDataObject(0), self.output(fresh))

    def test_aborts(self):
        """One leaves nothing, and the next update is complete. Progress rises."""
        samples = cloud(50000)
        for name in NAMES:
            filter_ = self.new(name, samples)
            if name == "Probe":
                filter_.SetInputData(samples)
            texts, fractions = observed(filter_), []
            observer = filter_.AddObserver("ProgressEvent", lambda caller, _: caller.SetAbortExecute(1))
            filter_.Update()
            self.assertEqual((filter_.GetErrorCode(), texts["ErrorEvent"]), (0, []))
            self.assertEqual(filter_.GetOutputDataObject(0).GetNumberOfElements(POINTS), 0)
            filter_.RemoveObserver(observer)
            filter_.SetAbortExecute(0)
            filter_.AddObserver("ProgressEvent", lambda caller, _, to=fractions: to.append(caller.GetProgress()))
            self.assertGreater(updated_again(filter_).GetNumberOfElements(POINTS), 100)
            self.assertEqual(fractions, sorted(fractions))
            self.assertGreater(len(fractions), 3)

    def test_whole_inputs_are_taken(self):
        """A structured output asks for no part of structured samples."""
        samples = image(10)
        add(samples, POINTS, "f", np.cos(positions_in(samples) @ [2.0, 3.0, 1.0]))
        producer = vtkTrivialProducer()
        producer.SetOutput(samples)
        producer.SetWholeExtent(samples.GetExtent())
        filter_ = self.new("Grid", cloud(), SamplingDimensions=(4, 3, 3))
        filter_.SetInputConnection(producer.GetOutputPort())
        filter_.UpdatePiece(0, 2, 0)
        self.assertEqual(filter_.GetNumberOfSamples(), 11**3)
        self.assertLess(filter_.GetOutput().GetNumberOfPoints(), 36)

    def test_filters_die(self):
        gc.disable()
        try:
            function = vtkPlane()
            for name in NAMES:
                filter_ = self.new(name, cloud())
                set_all(filter_, **dict(InputData=some_places()) if name == "Probe" else
                        dict(CutFunction=function) if name == "Slice" else {})
                filter_.Update()
                died, output = weakref.ref(filter_), filter_.GetOutputDataObject(0)
                del filter_
                self.assertIsNone(died(), name)
                self.assertGreater(output.GetNumberOfElements(POINTS), 100)
            function.SetOrigin(1, 2, 3)  # nobody is there to be told
        finally:
            gc.enable()


def updated_again(filter_):
    filter_.Modified()
    filter_.Update()
    return filter_.GetOutputDataObject(0)


class PlaceFiltersInPython(PlaceFilters, unittest.TestCase):
    module = _vtk


@unittest.skipIf(scatteredisopoints.vtkScatteredProbeFilter is _vtk.vtkScatteredProbeFilter, "it is not compiled")
class CompiledPlaceFilters(PlaceFilters, unittest.TestCase):
    module = scatteredisopoints


if __name__ == "__main__":
    unittest.main()
