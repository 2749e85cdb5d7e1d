# SPDX-License-Identifier: GPL-3.0-or-later
"""Blocks contoured separately on several ranks:
mpirun -n N pvbatch --symmetric TestRanksBlocks.py"""

import unittest

import numpy as np
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet, vtkMultiBlockDataSet, vtkMultiPieceDataSet, vtkPartitionedDataSet,
    vtkPartitionedDataSetCollection, vtkPolyData)

from TestRanks import (
    FILTERS, RANK, RANKS, SIZE, RanksTestCase, blocks_of, contour, described, field, gather, main,
    owners, poly_data, run, uniform)
from vtk_data import amr_of

COUNT = 5  # of blocks


def tree(leaves):
    """Two levels, with names; leaf 0 stands beside the inner tree."""
    inner = vtkMultiBlockDataSet()
    for i, leaf in enumerate(leaves[1:]):
        inner.SetBlock(2 * i, leaf)  # with gaps
        inner.GetMetaData(2 * i).Set(vtkCompositeDataSet.NAME(), f"leaf {i + 1}")
    outer = blocks_of(leaves[0], inner)
    outer.GetMetaData(1).Set(vtkCompositeDataSet.NAME(), "inner")
    return outer


def partitions(leaves, kind=vtkPartitionedDataSet):
    result = kind()
    while leaves and leaves[-1] is None:
        leaves = leaves[:-1]  # the ranks have different numbers of pieces
    for i, leaf in enumerate(leaves):
        result.SetPartition(i, leaf)
    return result


def collection(leaves):
    result = vtkPartitionedDataSetCollection()
    for i, leaf in enumerate(leaves):
        result.SetPartitionedDataSet(i, partitions([leaf]))
        result.GetMetaData(i).Set(vtkCompositeDataSet.NAME(), f"set {i}")
    return result


def pieces_in_blocks(leaves):
    return blocks_of(partitions(leaves, vtkMultiPieceDataSet))


def leaves_of(output, name=""):
    """(names on the way, leaf) of each leaf that is not null, in order."""
    for kind, count, child in (
            (vtkPartitionedDataSetCollection, "GetNumberOfPartitionedDataSets", "GetPartitionedDataSet"),
            (vtkPartitionedDataSet, "GetNumberOfPartitions", "GetPartitionAsDataObject"),
            (vtkMultiBlockDataSet, "GetNumberOfBlocks", "GetBlock")):
        if isinstance(output, kind):
            break
    else:
        return [(name, output)] if output is not None else []
    found = []
    for i in range(getattr(output, count)()):
        data = output.GetMetaData(i) if output.HasMetaData(i) else None
        own = data.Get(vtkCompositeDataSet.NAME()) if data else None
        found += leaves_of(getattr(output, child)(i), f"{name}/{i} {own}")
    return found


def by_themselves(data, controller, **options):
    return contour(data, controller, ContourBlocks=1, **options)


class RanksBlocksTest(RanksTestCase):
    def same_leaves(self, output, expected):
        """Compares, on rank 0, the leaves of all ranks' outputs with those of one."""
        parts = gather([(name,) + described(leaf) for name, leaf in leaves_of(output)])
        failure = ""
        if RANK == 0:
            whole = [(name,) + described(leaf) for name, leaf in leaves_of(expected())]
            names = [leaf[0] for leaf in whole]
            if any([leaf[0] for leaf in part] != names for part in parts):
                failure = f"leaves {[[leaf[0] for leaf in part] for part in parts]} not {names}"
            for i, (name, kinds, rows) in enumerate(whole):
                found = [part[i] for part in parts] if not failure else []
                if any(leaf[1] != kinds for leaf in found):
                    failure = f"arrays of {name}: {[leaf[1] for leaf in found]}, not {kinds}"
                elif not failure and sorted(sum((leaf[2] for leaf in found), [])) != sorted(rows):
                    failure = f"points of {name}"
            if not any(leaf[2] for leaf in whole):
                failure = "no points to compare"
        self.assertEqual(failure, "")

    def dealt(self, seed):
        """The leaves of all ranks together and this rank's, null where it has no samples."""
        whole, mine = [], []
        for number in range(COUNT):
            points = uniform(400 + 300 * number, seed + number)
            owner = owners(len(points))
            if number == 1:
                owner[:] = SIZE - 1  # on one rank alone
            numbers = np.flatnonzero(owner == RANK)
            whole.append(poly_data(points, np.arange(len(points))))
            mine.append(poly_data(points[numbers], numbers) if len(numbers) else None)
        return whole, mine

    def same_output(self, mine, whole, **options):
        """@returns the filters"""
        pair = by_themselves(mine, RANKS, **options), by_themselves(whole, None, **options)
        self.assertEqual(*(each.GetOutputDataObject(0).GetClassName() for each in pair))
        self.same_leaves(pair[0].GetOutputDataObject(0), lambda: pair[1].GetOutputDataObject(0))
        for count in ("SkippedSamples", "UnprojectedPoints"):
            self.assertEqual(*(getattr(each, "GetNumberOf" + count)() for each in pair))
        return pair

    def test_every_composite(self):
        whole, mine = self.dealt(11)
        for make in (tree, partitions, collection, pieces_in_blocks):
            for kind in FILTERS:
                with self.subTest(make=make.__name__, kind=kind):
                    output = self.same_output(make(mine), make(whole), kind=kind)[0].GetOutputDataObject(0)
                    self.assertEqual(output.GetClassName(), make(mine).GetClassName())

    def test_a_rank_may_have_no_blocks_at_all(self):
        whole, _ = self.dealt(12)
        whole[1] = None
        self.same_output(tree(whole) if RANK == 0 else vtkMultiBlockDataSet(), tree(whole))

    def test_trees_are_kept(self):
        whole, mine = self.dealt(13)
        isopoints, alone = self.same_output(tree(mine), tree(whole))
        for value in (0.1, 0.6):
            run(isopoints, (value,))
            self.same_leaves(isopoints.GetOutputDataObject(0),
                             lambda: run(alone, (value,)).GetOutputDataObject(0))  # noqa: B023
        isopoints.SetContourBlocks(0)
        alone.SetContourBlocks(0)
        # The samples have another order, on which the last bits depend.
        counts = gather(run(isopoints, (0.6,)).GetOutput().GetNumberOfPoints())
        if RANK == 0:
            self.assertEqual(sum(counts), run(alone, (0.6,)).GetOutput().GetNumberOfPoints())

    def test_blocks_without_the_array_are_counted(self):
        whole, mine = self.dealt(14)
        for leaves in (whole, mine):
            if leaves[2]:
                leaves[2].GetPointData().RemoveArray("value")
        self.same_output(tree(mine), tree(whole))

    def test_boxes_of_an_amr(self):
        """Boxes are on one rank each, as readers deal them out."""
        def amr(is_here):
            return amr_of("value", field, ((0, 0, 9), (1, 0, 8), (1, 8, 8), (1, 4, 8)), is_here)

        self.same_output(amr(lambda number: number % SIZE == RANK), amr(lambda _: True), cells="value")

    @unittest.skipIf(SIZE == 1, "one rank has one structure")
    def test_different_trees_are_one_error(self):
        _, mine = self.dealt(15)
        for other in (tree(mine[:3]), collection(mine), poly_data(uniform(9, 1), np.arange(9)),
                      tree([tree(mine)] + mine[1:])):
            data = tree(mine) if RANK == 0 else other
            self.check_one_error(data, ContourBlocks=1)
        self.check_one_error(tree(mine), ContourBlocks=RANK % 2)
        self.check_one_error(tree(COUNT * [vtkPolyData()]), ContourBlocks=1)


if __name__ == "__main__":
    main()
