# SPDX-License-Identifier: GPL-3.0-or-later
"""All ranks yield together what one process does: mpirun -n N pvbatch --symmetric TestRanks.py"""

import os
import sys
import tempfile
import unittest

import numpy as np
from vtkmodules.numpy_interface import dataset_adapter as dsa
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdTypeArray, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import (
    vtkDataObject, vtkDataSetAttributes, vtkImageData, vtkMultiBlockDataSet, vtkPolyData)
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from scatteredisopoints import vtkScatteredIsopointFilter

RANKS = vtkMultiProcessController.GetGlobalController()
RANK = RANKS.GetLocalProcessId()
SIZE = RANKS.GetNumberOfProcesses()

# How many of n samples each rank gets, and the order in which they are dealt out.
DEALS = ("even", "first", "last", "skewed", "round robin", "spatial")


def ranks_of(points, deal):
    count = len(points)
    number = np.arange(count)
    if deal == "even":
        return number * SIZE // max(count, 1)
    if deal == "first":
        return np.zeros(count, int)
    if deal == "last":
        return np.full(count, SIZE - 1)
    if deal == "skewed":
        return np.minimum((SIZE * (number / max(count, 1)) ** 4).astype(int), SIZE - 1)
    if deal == "round robin":
        return number % SIZE
    return np.minimum((SIZE * np.clip(points[:, 0], 0, 1)).astype(int), SIZE - 1)


def field(points):
    x, y, z = points.T
    return np.sin(7 * x) + np.cos(5 * y + x) + np.sin(6 * z - 2 * y)


def cloud(kind, count, seed):
    random = np.random.default_rng(seed)
    points = random.random((count, 3))
    if kind == "lattice":
        side = int(round(count ** (1 / 3)))
        points = np.stack(np.meshgrid(*3 * [np.arange(side)], indexing="ij"), -1).reshape(-1, 3) / side
    elif kind == "duplicates":
        points = np.round(20 * points) / 20
    elif kind == "clusters":
        points = 0.5 + (points - 0.5) * 10.0 ** (-3 * random.random((count, 1)))
    elif kind == "lines":
        points[:, 1] = np.round(4 * points[:, 1]) / 4
        points[:, 2] = np.round(4 * points[:, 2]) / 4
    return points


def poly_data(points, numbers, dtype=np.float32):
    """A vtkPolyData of points with arrays of several kinds."""
    result = vtkPolyData()
    place = vtkPoints()
    place.SetData(numpy_to_vtk(points.astype(dtype), deep=True))
    result.SetPoints(place)
    if len(points) == 0:
        return result

    def add(name, values):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        result.GetPointData().AddArray(array)
        return array

    add("value", field(points).astype(dtype))
    add("vector", np.cross(points, [1.0, 2.0, 3.0]))
    add("short", (1000 * np.nan_to_num(points)).astype(np.int16))
    add("long", numbers.astype(np.int64) * 3000000000 - 7)
    tensor = add("with names", points[:, :2].copy())
    tensor.SetComponentName(0, "first")
    tensor.SetComponentName(1, "second")
    names = vtkStringArray()
    names.SetName("name")
    for number in numbers:
        names.InsertNextValue("sample %d" % number)
    result.GetPointData().AddArray(names)
    ids = vtkIdTypeArray()
    ids.SetName("pedigree")
    for number in numbers:
        ids.InsertNextValue(int(number) * 5)
    result.GetPointData().SetPedigreeIds(ids)
    result.GetPointData().SetActiveScalars("value")
    return result


def described(output):
    """What the arrays are, and one byte string for each point: position and all arrays."""
    count = output.GetNumberOfPoints()
    kinds = []
    columns = []
    arrays = [output.GetPointData().GetAbstractArray(i)
              for i in range(output.GetPointData().GetNumberOfArrays())]
    if output.GetPoints():
        arrays.append(output.GetPoints().GetData())
    for i, array in enumerate(arrays):
        kinds.append((array.GetName() or "", array.GetDataType(), array.GetNumberOfComponents(),
                      array.GetComponentName(0) or "",
                      output.GetPointData().IsArrayAnAttribute(i) if i + 1 < len(arrays) else -1))
        if isinstance(array, vtkStringArray):
            columns.append([array.GetValue(j).encode() for j in range(count)])
        else:
            values = vtk_to_numpy(array).reshape(count, array.GetNumberOfComponents())
            columns.append([values[j].tobytes() for j in range(count)])
    rows = [b"|".join(row) for row in zip(*columns)] if count else []
    return sorted(map(repr, kinds)), rows


def contour(data, controller, values=(0.3,), watch=None, **options):
    isopoints = vtkScatteredIsopointFilter()
    isopoints.SetController(controller)
    isopoints.SetInputData(data)
    return run(isopoints, values, watch, **options)


def run(isopoints, values=(0.3,), watch=None, **options):
    isopoints.SetNumberOfContours(len(values))
    for i, value in enumerate(values):
        isopoints.SetValue(i, value)
    for name, value in options.items():
        getattr(isopoints, "Set" + name)(value)
    if watch is not None:
        isopoints.AddObserver("ErrorEvent", lambda *_: watch.append("error"))
    isopoints.Update()
    return isopoints


def gather(value):
    """The values of all ranks, on rank 0."""
    import pickle
    name = f"{SHARED}/{gather.count}.{RANK}"
    gather.count += 1
    with open(name, "wb") as file:
        pickle.dump(value, file)
    RANKS.Barrier()
    if RANK > 0:
        return None
    values = []
    for rank in range(SIZE):
        with open(name[:-1] + str(rank), "rb") as file:
            values.append(pickle.load(file))
    return values


gather.count = 0

ALL_ARRAYS = dict(ComputeGradients=1,
                  ComputeProjectionOrders=1)
POINTS_ALONE = dict(Projection=0, ComputeNormals=0, ComputeSplats=0)


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

    def errors(self, data, **options):
        """The number of errors of each rank, on rank 0."""
        watch = []
        result = contour(data, RANKS, watch=watch, **options)
        self.assertEqual(result.GetOutputDataObject(0).GetNumberOfElements(vtkDataObject.POINT), 0)
        return gather(len(watch))

    def check_one_error(self, data, **options):
        counts = self.errors(data, **options)
        if RANK == 0:
            self.assertEqual(counts, [1] + (SIZE - 1) * [0])


class RanksTest(RanksTestCase):
    def check(self, points, deal, dtype=np.float32, **options):
        owner = ranks_of(points, deal)
        order = np.argsort(owner, kind="stable")  # one rank's samples after the other's
        points, owner = points[order], owner[order]
        numbers = np.arange(len(points))
        mine = owner == RANK
        result = contour(poly_data(points[mine], numbers[mine], dtype), RANKS, **options)
        self.same(result.GetOutput(),
                  lambda: contour(poly_data(points, numbers, dtype), None, **options).GetOutput())
        return result

    def test_deals(self):
        for deal in DEALS:
            with self.subTest(deal=deal):
                self.check(cloud("uniform", 4000, 1), deal, **ALL_ARRAYS)

    def test_clouds(self):
        for kind in ("lattice", "duplicates", "clusters", "lines"):
            for dtype in (np.float32, np.float64):
                with self.subTest(kind=kind, dtype=dtype):
                    self.check(cloud(kind, 3000, 2), "round robin", dtype, **ALL_ARRAYS)

    def test_options(self):
        points = cloud("uniform", 3000, 3)
        for options in (
                POINTS_ALONE, dict(Projection=0), dict(Projection=1), dict(Projection=2),
                dict(Projection=4, **ALL_ARRAYS), dict(NormalMethod=1), dict(DropGaps=1),
                dict(MinimumSpacing=0.5), dict(Angle=20.0), dict(values=(0.1, -0.5, 1.1)),
                dict(OutputPointsPrecision=1), dict(ComputeScalars=0), dict(KeepTree=0)):
            with self.subTest(options=options):
                self.check(points, "skewed", **options)

    def test_more_ranks_than_samples(self):
        points = np.array([[0.0, 0.0, 0.0], [1.0, 0.2, 0.1]])
        self.check(points, "last", values=(float(field(points).mean()),))

    def test_counts_are_summed(self):
        points = cloud("uniform", 2000, 4)
        points[::7, 1] = np.nan
        result = self.check(points, "even", **POINTS_ALONE)
        self.assertEqual(result.GetNumberOfSkippedSamples(), len(points[::7]))
        total = sum(gather(result.GetOutput().GetNumberOfPoints()) or [0])
        if RANK == 0:
            self.assertEqual(result.GetNumberOfUnprojectedPoints(), total)

    def test_further_isovalues_and_values(self):
        points = cloud("uniform", 3000, 5)
        owner = np.sort(ranks_of(points, "even"))
        mine = owner == RANK
        numbers = np.arange(len(points))
        data = poly_data(points[mine], numbers[mine])
        whole = poly_data(points, numbers)
        isopoints = vtkScatteredIsopointFilter()
        isopoints.SetInputData(data)
        for values in ((0.2,), (-0.4, 0.9), (0.2,)):
            run(isopoints, values)
            self.same(isopoints.GetOutput(), lambda: contour(whole, None, values).GetOutput())
        for object, selection in ((data, mine), (whole, numbers >= 0)):
            array = object.GetPointData().GetArray("value")
            vtk_to_numpy(array)[:] = field(points[selection][:, ::-1])
            array.Modified()
            object.Modified()
        run(isopoints)
        self.same(isopoints.GetOutput(), lambda: contour(whole, None).GetOutput())

    def test_a_rank_may_have_dropped_its_tree(self):
        points = cloud("uniform", 3000, 9)
        numbers = np.arange(len(points))
        mine = np.sort(ranks_of(points, "even")) == RANK
        data = poly_data(points[mine], numbers[mine])
        whole = poly_data(points, numbers)
        isopoints = vtkScatteredIsopointFilter()
        isopoints.SetInputData(data)
        isopoints.SetKeepTree(RANK > 0)
        for values in ((0.2,), (-0.4, 0.9)):
            run(isopoints, values)
            self.same(isopoints.GetOutput(), lambda: contour(whole, None, values).GetOutput())

    def test_integers_are_rounded_values(self):
        points = cloud("uniform", 3000, 6)
        numbers = np.arange(len(points))
        mine = ranks_of(points, "last") == RANK

        def rounded(selection):
            data = poly_data(points[selection], numbers[selection])
            values = np.rint(20 * field(points[selection])).astype(np.int32)
            array = numpy_to_vtk(values, deep=True)
            array.SetName("value")
            data.GetPointData().SetScalars(array)
            return data

        result = contour(rounded(mine), RANKS, (6.1,))
        self.same(result.GetOutput(),
                  lambda: contour(rounded(numbers >= 0), None, (6.1,)).GetOutput())

    def test_blocks_and_cells(self):
        """Cells of images, several on each rank, as one cloud."""
        def image(number):
            result = vtkImageData()
            result.SetDimensions(6, 7, 8)
            result.SetOrigin(0.5 * (number % 2), 0.5 * (number // 2 % 2), 0.5 * (number // 4))
            result.SetSpacing(0.1, 0.5 / 6, 0.5 / 7)
            corners = dsa.WrapDataObject(result)
            centers = np.array([np.mean(np.reshape(result.GetCell(i).GetBounds(), (3, 2)), axis=1)
                                for i in range(result.GetNumberOfCells())])
            corners.CellData.append(field(centers), "value")
            return result

        def blocks(numbers):
            result = vtkMultiBlockDataSet()
            for i, number in enumerate(numbers):
                result.SetBlock(i, image(number))
            return result

        def prepared(data, controller):
            isopoints = vtkScatteredIsopointFilter()
            isopoints.SetController(controller)
            isopoints.SetInputData(data)
            isopoints.SetInputArrayToProcess(
                0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, "value")
            return run(isopoints)

        mine = [number for number in range(8) if number * SIZE // 8 == RANK]
        self.same(prepared(blocks(mine), RANKS).GetOutput(),
                  lambda: prepared(blocks(range(8)), None).GetOutput())

    def test_pieces_of_an_image(self):
        """Consecutive pieces both have the points between them, which count once."""
        def isopoints_of_image(controller, piece, pieces):
            image = vtkRTAnalyticSource()
            image.SetWholeExtent(-9, 8, -7, 9, -8, 8)
            isopoints = vtkScatteredIsopointFilter()
            isopoints.SetController(controller)
            isopoints.SetInputConnection(image.GetOutputPort())
            isopoints.SetValue(0, 150.0)
            isopoints.UpdatePiece(piece, pieces, 0)
            return isopoints

        isopoints = isopoints_of_image(RANKS, RANK, SIZE)
        # The samples have another order, on which the last bits depend.
        parts = gather(vtk_to_numpy(isopoints.GetOutput().GetPoints().GetData()).tolist())
        if RANK == 0:
            whole = isopoints_of_image(None, 0, 1).GetOutput()
            expected = vtk_to_numpy(whole.GetPoints().GetData()).tolist()
            self.assertEqual(sorted(tuple(np.round(p, 4) + 0.0) for part in parts for p in part),
                             sorted(tuple(np.round(p, 4) + 0.0) for p in expected))

    def with_ghosts(self, data, controller, piece, pieces, levels, values=(0.1, 0.5)):
        isopoints = vtkScatteredIsopointFilter()
        isopoints.SetController(controller)
        isopoints.SetInputData(data)
        for i, value in enumerate(values):
            isopoints.SetValue(i, value)
        for name, value in ALL_ARRAYS.items():
            getattr(isopoints, "Set" + name)(value)
        isopoints.UpdatePiece(piece, pieces, levels)
        return isopoints

    def test_ghosts_for_what_follows(self):
        """They stand behind the rank's own points, which are those without ghosts."""
        points = cloud("uniform", 3000, 9)
        owner = np.sort(ranks_of(points, "round robin"))
        numbers = np.arange(len(points))
        mine = poly_data(points[owner == RANK], numbers[owner == RANK])
        without = self.with_ghosts(mine, RANKS, RANK, SIZE, 0)
        name = vtkDataSetAttributes.GhostArrayName()
        self.assertFalse(without.GetOutput().GetPointData().HasArray(name))
        self.assertFalse(without.GetOutput().GetCellData().HasArray(name))
        isopoints = self.with_ghosts(mine, RANKS, RANK, SIZE, 1)
        self.assertEqual(isopoints.GetNumberOfUnprojectedPoints(),
                         without.GetNumberOfUnprojectedPoints())
        # Nothing is computed again for fewer levels.
        time = isopoints.GetOutput().GetMTime()
        isopoints.UpdatePiece(RANK, SIZE, 0)
        self.assertEqual(isopoints.GetOutput().GetMTime(), time)
        output = isopoints.GetOutput()
        if SIZE == 1:
            self.assertEqual(described(output), described(without.GetOutput()))
            return
        count = without.GetOutput().GetNumberOfPoints()
        ghosts = vtk_to_numpy(output.GetPointData().GetArray(name))
        self.assertEqual(len(ghosts), output.GetNumberOfPoints())
        self.assertFalse(ghosts[:count].any())
        self.assertTrue((ghosts[count:] == vtkDataSetAttributes.DUPLICATEPOINT).all())
        cells = vtk_to_numpy(output.GetCellData().GetArray(name))
        self.assertFalse(cells[:count].any())
        self.assertTrue((cells[count:] == vtkDataSetAttributes.DUPLICATECELL).all())
        output.GetPointData().RemoveArray(name)
        kinds, rows = described(output)
        self.assertEqual((kinds, rows[:count]), described(without.GetOutput()))
        parts = gather((rows[:count], rows[count:]))
        if RANK == 0:
            everything = {row: rank for rank, part in enumerate(parts) for row in part[0]}
            for rank, (_, found) in enumerate(parts):
                self.assertGreater(len(found), 20)
                self.assertEqual(len(set(found)), len(found))
                self.assertTrue(all(everything.get(row, rank) != rank for row in found))

    @unittest.skipIf(SIZE == 1, "one rank has no ghosts")
    def test_one_rank_that_asks_for_ghosts_gives_them_to_all(self):
        data = poly_data(cloud("uniform", 2000, 10 + RANK), np.arange(2000))
        isopoints = self.with_ghosts(data, RANKS, RANK, SIZE, 1 if RANK == SIZE - 1 else 0)
        self.assertTrue(isopoints.GetOutput().GetPointData().HasArray(
            vtkDataSetAttributes.GhostArrayName()))

    def test_ghosts_are_left_out(self):
        points = cloud("uniform", 2000, 6)
        owner = ranks_of(points, "spatial")
        order = np.argsort(owner, kind="stable")
        points, owner = points[order], owner[order]
        numbers = np.arange(len(points))
        mine = owner == RANK
        near = ~mine & (np.abs(points[:, 0] * SIZE - RANK - 0.5) < 0.7)
        chosen = mine | near
        data = poly_data(points[chosen], numbers[chosen])
        ghosts = numpy_to_vtk(near[chosen].astype(np.uint8), deep=True)  # DUPLICATEPOINT is 1
        ghosts.SetName(vtkDataSetAttributes.GhostArrayName())
        data.GetPointData().AddArray(ghosts)
        whole = poly_data(points, numbers)
        self.same_positions(contour(data, RANKS).GetOutput(), lambda: contour(whole, None).GetOutput())

    def same_positions(self, output, expected):
        """Ids differ where ghosts stand between, and so does the order in which points are dealt."""
        parts = gather(vtk_to_numpy(output.GetPoints().GetData()).tolist())
        if RANK == 0:
            wanted = vtk_to_numpy(expected().GetPoints().GetData()).tolist()
            self.assertEqual(sorted(point for part in parts for point in part), sorted(wanted))

    def test_errors_of_one_rank_end_the_update_of_all(self):
        points = cloud("uniform", 500, 7)
        good = poly_data(points, np.arange(500))
        bad = poly_data(points, np.arange(500))
        bad.GetPointData().SetActiveScalars("vector")
        bad.GetPointData().RemoveArray("value")
        vector = bad.GetPointData().GetArray("vector")
        vector.SetName("value")
        for rank in range(SIZE):
            self.check_one_error(bad if rank == RANK else good)
        self.check_one_error(good, Angle=200.0)
        if SIZE > 1:
            self.check_one_error(good, Angle=10.0 + RANK)
            self.assertEqual(self.errors_with_array(good, "value" if RANK else "missing"), 1)
        self.check_one_error(vtkPolyData())
        self.check_one_error(poly_data(points[:0], points[:0]))
        self.check(points, "even")

    def test_warnings_are_of_all_samples_and_come_once(self):
        points = cloud("uniform", 2000, 4)
        owner = np.sort(ranks_of(points, "skewed"))
        data = poly_data(points[owner == RANK], np.flatnonzero(owner == RANK))
        for values, bad, expected in (
                ((9.0,), 0, f"No isosurface at 9: \"value\" is from"
                 f" {field(points).min():.6g} to {field(points).max():.6g}."),
                ((0.3,), 3, f"Skipped {3 * SIZE} of {2000 + 10 * SIZE} samples: not finite.")):
            more = poly_data(cloud("uniform", 10, 20 + RANK), np.arange(10))
            vtk_to_numpy(more.GetPointData().GetArray("value"))[:] = 0.25
            vtk_to_numpy(more.GetPointData().GetArray("value"))[:bad] = np.nan
            blocks = vtkMultiBlockDataSet()
            blocks.SetBlock(0, data)
            blocks.SetBlock(1, more)
            isopoints = vtkScatteredIsopointFilter()
            isopoints.SetInputData(blocks)
            isopoints.SetInputArrayToProcess(0, 0, 0, 0, "value")
            warnings = []

            def warned(_object, _event, message, warnings=warnings):
                warnings.append(message)

            warned.CallDataType = "string0"
            isopoints.AddObserver("WarningEvent", warned)
            isopoints.AddObserver("MessageEvent", warned)
            run(isopoints, values)
            everything = gather(warnings)
            if RANK == 0:
                self.assertEqual([len(each) for each in everything], [1] + (SIZE - 1) * [0])
                self.assertIn(expected, everything[0][0])

    def errors_with_array(self, data, name):
        """How many errors all ranks report together; on the others than rank 0, the expected one."""
        watch = []
        isopoints = vtkScatteredIsopointFilter()
        isopoints.SetInputData(data)
        isopoints.SetInputArrayToProcess(0, 0, 0, 0, name)
        run(isopoints, watch=watch)
        counts = gather(len(watch))
        return sum(counts) if RANK == 0 else 1

    def test_an_abort_on_one_rank_ends_the_update_of_all(self):
        data = poly_data(cloud("uniform", 20000, 8), np.arange(20000))
        isopoints = vtkScatteredIsopointFilter()
        isopoints.SetInputData(data)
        watch = []
        if RANK == SIZE - 1:
            isopoints.AddObserver("ProgressEvent", lambda *_: isopoints.SetAbortExecute(1))
        run(isopoints, watch=watch)
        self.assertEqual(isopoints.GetOutput().GetNumberOfPoints(), 0)
        self.assertEqual(watch, [])
        isopoints.RemoveAllObservers()
        isopoints.SetAbortExecute(0)
        isopoints.Modified()
        isopoints.Update()
        counts = gather(isopoints.GetOutput().GetNumberOfPoints())
        if RANK == 0:
            self.assertGreater(sum(counts), 1000)


SHARED = sys.argv.pop(1) if len(sys.argv) > 1 and "/" in sys.argv[1] else tempfile.gettempdir()

def main():
    program = unittest.main(
        argv=sys.argv[:1], exit=False, failfast=True, verbosity=2 if RANK == 0 else 0)
    if not program.result.wasSuccessful():
        print(f"ERROR: rank {RANK}", flush=True)
        os._exit(1)  # the other ranks may wait for this one, which ends them


if __name__ == "__main__":
    main()
