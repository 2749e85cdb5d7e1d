# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters under MPI: all ranks yield together what one process does.

    mpirun -n N pvbatch --symmetric TestRanks.py

Testing/Cxx/TestRanks*.cxx tests clouds, options and deals of samples on ranks that are threads.
This is about what VTK's data and controllers add: arrays, blocks, pieces, ghosts, messages."""

import errno
import os
import pickle
import re
import sys
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkStringArray, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (
    vtkDataObject, vtkDataSetAttributes, vtkImageData, vtkPlane, vtkPolyData, vtkSphere)
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from scatteredisopoints import (
    vtkScatteredBodyFilter, vtkScatteredGradientFilter, vtkScatteredGridFilter, vtkScatteredIsopointFilter,
    vtkScatteredIsosurfaceFilter, vtkScatteredLineFilter, vtkScatteredProbeFilter, vtkScatteredSliceFilter)

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../Python"))
from vtk_data import blocks_of, centers_in, cloud_of, named, set_all  # noqa: E402

RANKS = vtkMultiProcessController.GetGlobalController()
RANK = RANKS.GetLocalProcessId()
SIZE = RANKS.GetNumberOfProcesses()
FILTERS = (vtkScatteredIsopointFilter, vtkScatteredIsosurfaceFilter)
GHOSTS = vtkDataSetAttributes.GhostArrayName()
ALL_ARRAYS = dict(ComputeGradients=1, ComputeProjectionOrders=1)


def field(points):
    x, y, z = points.T
    return np.sin(7 * x) + np.cos(5 * y + x) + np.sin(6 * z - 2 * y)


def uniform(count, seed):
    return np.random.default_rng(seed).random((count, 3))


def owners(count):
    """The rank of each sample, in ascending order. The first rank has most samples, the second few."""
    share = np.arange(count) / count
    return np.minimum((SIZE * np.where(share < 0.6, 0.1 * share, share)).astype(int), SIZE - 1)


def poly_data(points, numbers, values=None):
    """A vtkPolyData of points with arrays of several kinds."""
    result = cloud_of(points.astype(np.float32))
    if len(points) == 0:
        return result
    attributes = result.GetPointData()
    for name, array in (
            ("value", field(points).astype(np.float32) if values is None else values),
            ("vector", np.cross(points, [1.0, 2.0, 3.0])), ("short", (1000 * np.nan_to_num(points)).astype(np.int16)),
            ("long", numbers.astype(np.int64) * 3000000000 - 7), ("with names", points[:, :2]),
            ("name", [f"sample {number}" for number in numbers])):
        attributes.AddArray(named(name, array))
    for i, name in enumerate(("first", "second")):
        attributes.GetArray("with names").SetComponentName(i, name)
    ids = numpy_to_vtkIdTypeArray(2**60 + 5 * numbers.astype(np.int64), deep=True)  # not held by double
    ids.SetName("pedigree")
    attributes.SetPedigreeIds(ids)
    attributes.SetActiveScalars("value")
    return result


def described_points(output):
    """What the arrays are, and one byte string for each point: position and all arrays, those of its
    vertex among them."""
    count = output.GetNumberOfPoints()
    kinds = []
    columns = []
    arrays = [(data.GetAbstractArray(i), data.IsArrayAnAttribute(i))
              for data in (output.GetPointData(), output.GetCellData())
              for i in range(data.GetNumberOfArrays())
              if data.IsA("vtkPointData") or data.GetArrayName(i) != GHOSTS]
    if output.GetPoints():
        arrays.append((output.GetPoints().GetData(), -1))
    for array, attribute in arrays:
        kinds.append((array.GetName() or "", array.GetDataType(), array.GetNumberOfComponents(),
                      array.GetComponentName(0) or "", attribute))
        if isinstance(array, vtkStringArray):
            columns.append([array.GetValue(j).encode() for j in range(count)])
        else:
            values = vtk_to_numpy(array).reshape(count, array.GetNumberOfComponents())
            columns.append([values[j].tobytes() for j in range(count)])
    rows = [b"|".join(row) for row in zip(*columns)] if count else []
    return sorted(map(repr, kinds)), rows


def described(output):
    """The same for each triangle, by its points, where there are triangles."""
    kinds, rows = described_points(output)
    if output.GetNumberOfPolys() > 0:
        corners = vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        rows = [b"#".join(rows[i] for i in triangle) for triangle in corners]
    return kinds, rows


def watched(isopoints, watch, events=("ErrorEvent", "WarningEvent", "MessageEvent")):
    """Calls watch(text) for each error, warning and message."""
    def note(_object, _event, text):
        watch(text)

    note.CallDataType = "string0"
    for event in events:
        isopoints.AddObserver(event, note)


def configured(data, controller, kind=FILTERS[0], watch=None, cells=None, **options):
    isopoints = set_all(kind(), Controller=controller, InputData=data)
    if cells:
        isopoints.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, cells)
    if watch:
        watched(isopoints, watch)
    return set_all(isopoints, **options)


def contour(data, controller, kind=FILTERS[0], values=(0.3,), levels=0, **options):
    """A filter that has been updated."""
    return run(configured(data, controller, kind, **options), values, levels)


def run(isopoints, values, levels=0):
    isopoints.SetNumberOfContours(len(values))
    for i, value in enumerate(values):
        isopoints.SetValue(i, value)
    if isopoints.GetController():
        isopoints.UpdatePiece(RANK, SIZE, levels)
    else:
        isopoints.Update()
    return isopoints


def gather(value):
    """The values of all ranks, on rank 0."""
    tag = 1
    if RANK > 0:
        message = np.frombuffer(pickle.dumps(value), np.uint8)
        RANKS.Send(numpy_to_vtk(message, deep=True), 0, tag)
        return None
    values = [value]
    for rank in range(1, SIZE):
        message = vtkUnsignedCharArray()
        RANKS.Receive(message, rank, tag)
        values.append(pickle.loads(vtk_to_numpy(message).tobytes()))
    return values


class RanksTestCase(unittest.TestCase):
    def same(self, output, expected, describe=described):
        """Compares, on rank 0, all ranks' outputs with one, which is called for there."""
        parts = gather(describe(output))
        failure = ""
        if RANK == 0:
            kinds, rows = describe(expected())
            found = sorted(row for part in parts for row in part[1])
            if any(part[0] != kinds for part in parts):
                failure = f"arrays {[part[0] for part in parts]} instead of {kinds}"
            elif not rows:
                failure = "nothing to compare"
            elif found != sorted(rows):
                failure = f"{len(found)} rows instead of {len(rows)}, or others"
        self.assertEqual(failure, "")

    def check_one_error(self, data, **options):
        """Expects the first rank to report an error, the others none, and all to be without output."""
        errors = []
        result = contour(data, RANKS, watch=errors.append, **options)
        self.assertEqual(result.GetOutputDataObject(0).GetNumberOfElements(vtkDataObject.POINT), 0)
        counts = gather((len(errors), result.GetErrorCode()))
        if RANK == 0:
            invalid = errno.EINVAL  # which all ranks tell
            self.assertEqual(counts, [(1, invalid)] + (SIZE - 1) * [(0, invalid)])


class RanksTest(RanksTestCase):
    def dealt(self, points, values=None):
        """This rank's samples, and those of all ranks in their order."""
        numbers = np.arange(len(points))
        mine = owners(len(points)) == RANK
        own = values[mine] if values is not None else None
        return poly_data(points[mine], numbers[mine], own), poly_data(points, numbers, values)

    def check(self, data, **options):
        mine, whole = data
        result = contour(mine, RANKS, **options)
        expected = contour(whole, None, **options)
        self.same(result.GetOutput(), expected.GetOutput)
        self.assertEqual(result.GetNumberOfSkippedSamples(), expected.GetNumberOfSkippedSamples())
        self.assertEqual(result.GetNumberOfUnprojectedPoints(), expected.GetNumberOfUnprojectedPoints())

    def test_arrays_of_every_kind(self):
        for kind in FILTERS:
            self.check(self.dealt(uniform(3000, 1)), kind=kind, values=(0.1, 1.1), **ALL_ARRAYS)
        self.check(self.dealt(uniform(3000, 1)), kind=FILTERS[1], Regularize=0, **ALL_ARRAYS)

    def test_deals_and_counts(self):
        """All samples on the last rank, and samples that are skipped."""
        points, skipped = uniform(1500, 2), uniform(2000, 4)
        numbers = np.arange(len(points))
        mine = numbers[: len(points) if RANK == SIZE - 1 else 0]
        skipped[::7, 1] = np.nan
        for kind in FILTERS:
            self.check((poly_data(points[mine], mine), poly_data(points, numbers)), kind=kind)
            self.check(self.dealt(skipped), kind=kind, Projection=0)

    def test_integers_are_rounded_values(self):
        points = uniform(3000, 6)
        self.check(self.dealt(points, np.rint(20 * field(points)).astype(np.int32)), values=(6.1,))

    def test_further_isovalues_and_values(self):
        """Further updates are right even if some ranks have dropped their trees."""
        points = uniform(3000, 5)
        for kind in FILTERS:
            mine, whole = self.dealt(points)
            isopoints = contour(mine, RANKS, kind, KeepTree=RANK != 1)
            for values in ((-0.4, 0.9), (0.2,)):
                run(isopoints, values)
                self.same(isopoints.GetOutput(), lambda: contour(whole, None, kind, values).GetOutput())
            for data, chosen in ((mine, owners(len(points)) == RANK), (whole, slice(None))):
                array = data.GetPointData().GetArray("value")
                vtk_to_numpy(array)[:] = field(points[chosen][:, ::-1])
                array.Modified()
                data.Modified()
            run(isopoints, (0.3,))
            self.same(isopoints.GetOutput(), lambda: contour(whole, None, kind).GetOutput())

    def same_arrays(self, output, expected, rows=slice(None)):
        """Compares each rank's arrays with its own expectation, reports on rank 0."""
        def values_of(array):
            return (np.array([array.GetValue(i) for i in range(array.GetNumberOfValues())], object)
                    if isinstance(array, vtkStringArray) else vtk_to_numpy(array))

        found, wanted = ({data.GetArrayName(i): values_of(data.GetAbstractArray(i))[chosen].tolist()
                          for i in range(data.GetNumberOfArrays())}
                         for data, chosen in ((output.GetPointData(), slice(None)), (expected.GetPointData(), rows)))
        found, wanted = (repr(each) for each in (found, wanted))  # NaN equals NaN
        all_same = gather((found == wanted, found[:1000]))
        if RANK == 0:
            self.assertTrue(all(same for same, _ in all_same), all_same)

    def test_values_at_places(self):
        """Each rank has its own samples, or none, and its own places, or none."""
        points = uniform(3000, 8)
        for chosen in (owners(len(points)), np.full(len(points), SIZE - 1)):
            numbers = np.arange(len(points))
            mine = chosen == RANK
            data, whole = poly_data(points[mine], numbers[mine]), poly_data(points, numbers)
            places = cloud_of(1.2 * uniform(0 if RANK == 1 else 500, RANK) - 0.1)
            for options in (dict(), dict(Interpolation=4, NullPointsStrategy=2), dict(Interpolation=1)):
                here, alone = (set_all(vtkScatteredProbeFilter(), InputData=places, SourceData=source,
                                       Controller=controller, **options)
                               for source, controller in ((data, RANKS), (whole, None)))
                for each in (here, alone):
                    each.AddNearestArray("vector")
                here.UpdatePiece(RANK, SIZE, 0)
                alone.Update()
                self.same_arrays(here.GetOutput(), alone.GetOutput())
                self.assertEqual(here.GetNumberOfSamples(), 3000)
            here, alone = (set_all(vtkScatteredGradientFilter(), InputData=source, Controller=controller)
                           for source, controller in ((data, RANKS), (whole, None)))
            for each in (here, alone):
                each.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "vector")
                each.ComputeVorticityOn()
            here.UpdatePiece(RANK, SIZE, 0)
            alone.Update()
            self.same_arrays(here.GetOutput(), alone.GetOutput(), mine) if mine.any() else gather((True, []))
            here, alone = (set_all(vtkScatteredLineFilter(), InputData=source, Controller=controller, Resolution=50)
                           for source, controller in ((data, RANKS), (whole, None)))
            here.UpdatePiece(RANK, SIZE, 0)
            alone.Update()
            self.same_arrays(here.GetOutput(), alone.GetOutput(), slice(None if RANK == 0 else 0))
            here, alone = (set_all(vtkScatteredGridFilter(), InputData=source, Controller=controller)
                           for source, controller in ((data, RANKS), (whole, None)))
            for each in (here, alone):
                each.SetSamplingDimensions(8, 9, 10)
            here.UpdatePiece(RANK, SIZE, 0)
            alone.Update()
            output, image = here.GetOutput(), alone.GetOutput()
            rows = [image.FindPoint(output.GetPoint(i)) for i in range(output.GetNumberOfPoints())]
            self.same_arrays(output, image, rows)

    def test_slices(self):
        """All triangles, with the arrays at their corners, are those of one process."""
        points = uniform(3000, 9)
        numbers, mine = np.arange(len(points)), owners(len(points)) == RANK
        data, whole = poly_data(points[mine], numbers[mine]), poly_data(points, numbers)
        for function in (set_all(vtkPlane(), Normal=(1, 2, 3), Origin=(0.5, 0.5, 0.4)),
                         set_all(vtkSphere(), Center=(0.5, 0.5, 0.5), Radius=0.3)):
            for options in (dict(), dict(Interpolation=1, Regularize=0)):
                here, alone = (set_all(vtkScatteredSliceFilter(), InputData=source, CutFunction=function,
                                       Controller=controller, **options)
                               for source, controller in ((data, RANKS), (whole, None)))
                here.UpdatePiece(RANK, SIZE, 0)
                alone.Update()
                found, (_, expected) = gather(described(here.GetOutput())[1]), described(alone.GetOutput())
                if RANK == 0:
                    self.assertGreater(len(expected), 100)
                    self.assertEqual(sorted(sum(found, [])), sorted(expected))

    def test_bodies(self):
        points = uniform(3000, 9)
        points[:, 0] += points[:, 0] > 0.5  # two bodies
        numbers, mine = np.arange(len(points)), owners(len(points)) == RANK
        data, whole = poly_data(points[mine], numbers[mine]), poly_data(points, numbers)
        for options in (dict(), dict(MinimumPieceSize=0.99), dict(DropGaps=0)):
            here, alone = (set_all(vtkScatteredBodyFilter(), InputData=source, Controller=controller, **options)
                           for source, controller in ((data, RANKS), (whole, None)))
            here.UpdatePiece(RANK, SIZE, 0)
            alone.Update()
            found, (_, expected) = gather(described(here.GetOutput())[1]), described(alone.GetOutput())
            if RANK == 0:
                self.assertGreater(len(expected), 50)
                self.assertEqual(sorted(sum(found, [])), sorted(expected))

    @unittest.skipIf(SIZE == 1, "one rank has one set of options")
    def test_different_options_are_an_error(self):
        samples = cloud_of(uniform(100, RANK))
        for filter_, verb in (
                (set_all(vtkScatteredProbeFilter(), InputData=cloud_of(uniform(5, 1)), SourceData=samples,
                         Interpolation=RANK), "probe"),
                *((set_all(vtkScatteredSliceFilter(), InputData=samples, CutFunction=function), "slice")
                  for function in (
                    set_all(vtkSphere(), Center=(0.5, 0.5, 0.5), Radius=0.3 + 1e-6 * RANK),
                    set_all(vtkPlane(), Normal=(1, 2 + RANK, 3)), set_all(vtkPlane(), Origin=(0, 0, 0.1 * RANK))))):
            errors = []
            filter_.SetController(RANKS)
            watched(filter_, errors.append)
            filter_.UpdatePiece(RANK, SIZE, 0)
            counts = gather((len(errors), filter_.GetErrorCode(), filter_.GetOutput().GetNumberOfPoints()))
            if RANK == 0:
                self.assertEqual(counts, [(1, errno.EINVAL, 0)] + (SIZE - 1) * [(0, errno.EINVAL, 0)])
                self.assertIn(f"or {verb} each rank's samples separately", errors[0])

    def test_blocks_and_cells(self):
        """The cells of several images on each rank form one cloud."""
        def image(number):
            result = set_all(vtkImageData(), Dimensions=(6, 7, 8), Spacing=(0.1, 0.5 / 6, 0.5 / 7), Origin=(
                0.5 * (number % 2), 0.5 * (number // 2 % 2), 0.5 * (number // 4)))
            result.GetCellData().AddArray(named("value", field(centers_in(result))))
            return result

        mine = [number for number in range(8) if number * SIZE // 8 == RANK]
        self.check((blocks_of(*map(image, mine)), blocks_of(*map(image, range(8)))), cells="value")

    def test_pieces_of_an_image(self):
        """Consecutive pieces share points. These count once."""
        def positions(controller, piece, pieces):
            image = vtkRTAnalyticSource()
            image.SetWholeExtent(-9, 8, -7, 9, -8, 8)
            isopoints = vtkScatteredIsopointFilter()
            isopoints.SetController(controller)
            isopoints.SetInputConnection(image.GetOutputPort())
            isopoints.SetValue(0, 150.0)
            isopoints.UpdatePiece(piece, pieces, 0)
            # The samples have another order, on which the last bits depend.
            found = vtk_to_numpy(isopoints.GetOutput().GetPoints().GetData())
            return [tuple(position) for position in np.round(found, 4) + 0.0]

        parts = gather(positions(RANKS, RANK, SIZE))
        if RANK == 0:
            self.assertEqual(sorted(sum(parts, [])), sorted(positions(None, 0, 1)))

    def test_ghosts_for_what_follows(self):
        """Ghosts follow the rank's own points or triangles of an isovalue, which are those without ghosts."""
        for kind, values in zip(FILTERS, ((0.1, 0.5), (0.3,))):
            data = poly_data(uniform(3000 // SIZE, 10 + RANK), np.arange(3000 // SIZE))
            isopoints = contour(data, RANKS, kind, values, **ALL_ARRAYS)
            without = vtkPolyData()
            without.ShallowCopy(isopoints.GetOutput())
            self.assertFalse(without.GetPointData().HasArray(GHOSTS))
            isopoints.Modified()
            # One rank that asks for ghosts gives them to all.
            isopoints.UpdatePiece(RANK, SIZE, 1 if RANK == SIZE - 1 else 0)
            output = isopoints.GetOutput()
            # Nothing is computed again for fewer levels.
            time = output.GetMTime()
            isopoints.UpdatePiece(RANK, SIZE, 0)
            self.assertEqual(output.GetMTime(), time)
            if SIZE == 1:
                self.assertEqual(described(output), described(without))
                continue
            self.check_ghosts(output, without)

    def check_ghosts(self, output, without):
        count = without.GetNumberOfCells()
        cells = vtk_to_numpy(output.GetCellData().GetArray(GHOSTS))
        self.assertFalse(cells[:count].any())
        self.assertTrue((cells[count:] == vtkDataSetAttributes.DUPLICATECELL).all())
        points = vtk_to_numpy(output.GetPointData().GetArray(GHOSTS))
        self.assertTrue(np.isin(points, (0, vtkDataSetAttributes.DUPLICATEPOINT)).all())
        output.GetPointData().RemoveArray(GHOSTS)
        kinds, rows = described(output)
        self.assertEqual((kinds, rows[:count]), described(without))
        # Each point is no duplicate on one rank.
        owned = [row for row, ghost in zip(described_points(output)[1], points) if not ghost]
        parts = gather((rows[:count], rows[count:], owned))
        if RANK == 0:
            everything = {row: rank for rank, part in enumerate(parts) for row in part[0]}
            for rank, (_, ghosts, _) in enumerate(parts):
                self.assertGreater(len(ghosts), 10)
                self.assertEqual(len(set(ghosts)), len(ghosts))
                self.assertTrue(all(everything.get(row, rank) != rank for row in ghosts))
            everyone = [row for part in parts for row in part[2]]
            self.assertEqual(len(everyone), len(set(everyone)))

    def test_ghosts_are_left_out(self):
        points = uniform(2000, 6)
        points = points[np.argsort(points[:, 0])]
        owner = np.minimum((SIZE * points[:, 0]).astype(int), SIZE - 1)
        near = (owner != RANK) & (np.abs(points[:, 0] * SIZE - RANK - 0.5) < 0.7)
        chosen = np.flatnonzero((owner == RANK) | near)
        data = poly_data(points[chosen], chosen)
        data.GetPointData().AddArray(named(GHOSTS, near[chosen].astype(np.uint8)))  # DUPLICATEPOINT is 1
        # Ids differ where ghosts stand between.
        self.same(contour(data, RANKS).GetOutput(),
                  lambda: contour(poly_data(points, np.arange(len(points))), None).GetOutput(),
                  lambda output: ("", vtk_to_numpy(output.GetPoints().GetData()).tolist()))

    def test_errors_of_one_rank_end_the_update_of_all(self):
        points = uniform(500, 7)
        numbers = np.arange(500)
        good = poly_data(points, numbers)
        bad = poly_data(points, numbers, np.cross(points, [1.0, 2.0, 3.0]))
        for rank in range(SIZE):
            self.check_one_error(bad if rank == RANK else good)
        self.check_one_error(good, Angle=200.0)
        self.check_one_error(vtkPolyData())
        self.check_one_error(poly_data(points[:0], numbers[:0]))
        if SIZE > 1:
            self.check_one_error(good, Angle=10.0 + RANK)
            self.check_one_error(good, cells="missing" if RANK else None)
        self.check(self.dealt(uniform(1000, 7)))

    def test_warnings_are_of_all_samples_and_come_once(self):
        points = uniform(2000, 4)
        mine, _ = self.dealt(points)
        least, most = field(points).min(), field(points).max()
        for value, bad, expected in (
                (9.0, 0, f'"value" is from {least:.6g} to {most:.6g}: no isosurface at 9.'),
                (0.3, 3, f"Skipped {3 * SIZE} of {2000 + 10 * SIZE} samples: not finite.")):
            values = np.full(10, 0.25, np.float32)
            values[:bad] = np.nan
            blocks = blocks_of(mine, poly_data(uniform(10, 20 + RANK), np.arange(10), values))
            texts = []
            contour(blocks, RANKS, values=(value,), watch=texts.append)
            everything = gather(texts)
            if RANK == 0:
                self.assertEqual([len(each) for each in everything], [1] + (SIZE - 1) * [0])
                self.assertIn(expected, everything[0][0])

    def test_points_of_warnings_are_counted_once(self):
        """Ghosts and vertices of several ranks are not counted again."""
        noise = np.random.default_rng(9).normal(size=3000)  # no fit holds
        mine, whole = self.dealt(uniform(3000, 9), noise)

        def counts(data, controller, levels):
            texts = []
            contour(data, controller, FILTERS[1], (0.1,), levels, watch=texts.append)
            return [re.search(r"\d+ of \d+ points", text).group() for text in texts]

        for levels in (0, 3):
            parts = gather(counts(mine, RANKS, levels))
            if RANK == 0:
                self.assertEqual(sum(parts, []), counts(whole, None, 0))
                self.assertEqual(len(parts[0]), 1)

    def test_without_a_controller_a_rank_does_not_wait_for_others(self):
        data = poly_data(uniform(2000, 11), np.arange(2000))
        for kind in FILTERS:
            self.assertIsNone(kind().GetController())
            if RANK == SIZE - 1:
                self.assertGreater(contour(data, None, kind).GetOutput().GetNumberOfPoints(), 100)
            alone = kind()
            for is_global, controller in ((True, RANKS), (False, None)):
                alone.SetUseGlobalController(is_global)
                self.assertIs(alone.GetController(), controller)

    def test_pieces_without_a_controller(self):
        """Each rank yields a piece of its own samples' surface; the first one warns of that."""
        data = poly_data(uniform(2000, 11), np.arange(2000))
        for kind in FILTERS:
            texts = []
            isopoints = configured(data, None, kind)
            watched(isopoints, texts.append, ["ErrorEvent", "WarningEvent"])
            for value in (0.3, 0.4):
                isopoints.SetValue(0, value)
                isopoints.UpdatePiece(RANK, SIZE, 0)
                self.same(isopoints.GetOutput(), lambda: contour(data, None, kind, (value,)).GetOutput())  # noqa: B023
            self.assertEqual(["SetController()" in text for text in texts], [True] if RANK == 0 and SIZE > 1 else [])

    def test_an_abort_on_one_rank_ends_the_update_of_all(self):
        data = poly_data(uniform(20000, 8), np.arange(20000))
        for kind in FILTERS:
            texts = []
            isopoints = configured(data, RANKS, kind)
            isopoints.AddObserver("ErrorEvent", lambda *_: texts.append(""))  # noqa: B023
            if RANK == SIZE - 1:
                isopoints.AddObserver(
                    "ProgressEvent", lambda *_: isopoints.SetAbortExecute(1))  # noqa: B023
            run(isopoints, (0.3,))
            self.assertEqual(isopoints.GetOutput().GetNumberOfPoints(), 0)
            self.assertEqual((texts, isopoints.GetErrorCode()), ([], 0))
            isopoints.RemoveAllObservers()
            isopoints.SetAbortExecute(0)
            isopoints.Modified()
            counts = gather(run(isopoints, (0.3,)).GetOutput().GetNumberOfPoints())
            if RANK == 0:
                self.assertGreater(sum(counts), 1000)


def main():
    program = unittest.main(argv=sys.argv[:1], exit=False, failfast=True, verbosity=2 if RANK == 0 else 0)
    if not program.result.wasSuccessful():
        print(f"ERROR: rank {RANK}", flush=True)
        os._exit(1)  # the other ranks may wait for this one, which ends them


if __name__ == "__main__":
    main()
