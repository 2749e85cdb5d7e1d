# SPDX-License-Identifier: GPL-3.0-or-later
"""All ranks yield together the triangles that one process does:
mpirun -n N pvbatch --symmetric TestRanksTriangles.py FOLDER"""

import re
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_STRING
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkMultiBlockDataSet
from scatteredisopoints import vtkScatteredIsosurfaceFilter

from TestRanks import RANK, RANKS, SIZE, RanksTestCase, cloud, described, gather, main, poly_data, run
from TestRanks import ranks_of

GHOSTS = vtkDataSetAttributes.GhostArrayName()
ARRAYS = dict(ComputeGradients=1, ComputeProjectionOrders=1)


def surface(data, controller, levels=0, values=(0.3,), **options):
    isosurface = vtkScatteredIsosurfaceFilter()
    isosurface.SetController(controller)
    isosurface.SetInputData(data)
    isosurface.SetNumberOfContours(len(values))
    for i, value in enumerate(values):
        isosurface.SetValue(i, value)
    for name, value in options.items():
        getattr(isosurface, "Set" + name)(value)
    isosurface.UpdatePiece(RANK if controller else 0, SIZE if controller else 1, levels)
    return isosurface


def corners(output):
    """The points of each triangle."""
    if output.GetNumberOfPolys() == 0:
        return np.zeros((0, 3), int)
    return vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def triangles(output):
    """What the arrays are, and one byte string for each triangle: all that its points have."""
    kinds, rows = described(output)
    return kinds, [b"#".join(rows[i] for i in triangle) for triangle in corners(output)]


class RanksTrianglesTest(RanksTestCase):
    def same_triangles(self, output, expected):
        self.same(output, expected, triangles)

    def dealt(self, points, deal):
        """This rank's samples, and those of all ranks in their order."""
        owner = ranks_of(points, deal)
        order = np.argsort(owner, kind="stable")
        points, owner = points[order], owner[order]
        numbers = np.arange(len(points))
        return poly_data(points[owner == RANK], numbers[owner == RANK]), poly_data(points, numbers)

    def check(self, points, deal, **options):
        mine, whole = self.dealt(points, deal)
        result = surface(mine, RANKS, **options)
        self.same_triangles(result.GetOutput(), lambda: surface(whole, None, **options).GetOutput())
        return result, whole

    def test_deals(self):
        for deal in ("even", "first", "last", "round robin", "spatial"):
            with self.subTest(deal=deal):
                self.check(cloud("uniform", 4000, 1), deal, **ARRAYS)

    def test_clouds_and_options(self):
        for kind in ("lattice", "duplicates", "clusters", "lines"):
            for options in (dict(Projection=0), dict(DropGaps=0, **ARRAYS),
                            dict(NormalMethod=1), dict(values=(0.1, -0.5, 1.1))):
                with self.subTest(kind=kind, options=options):
                    self.check(cloud(kind, 2000, 2), "round robin", **options)

    def test_counts_are_those_of_one_process(self):
        for options in ({}, dict(Projection=0)):
            result, whole = self.check(cloud("uniform", 3000, 3), "even", **options)
            expected = surface(whole, None, **options)
            self.assertEqual(result.GetNumberOfUnprojectedPoints(),
                             expected.GetNumberOfUnprojectedPoints())
            if options:
                self.assertGreater(expected.GetNumberOfUnprojectedPoints(), 0)

    def test_points_of_warnings_are_counted_once(self):
        points = cloud("uniform", 3000, 9)
        values = np.random.default_rng(9).normal(size=len(points))  # no fit holds
        mine, whole = self.dealt(points, "even")
        owner = np.sort(ranks_of(points, "even"))

        def warnings(data, chosen, controller, levels):
            vtk_to_numpy(data.GetPointData().GetArray("value"))[:] = values[chosen]
            texts = []

            def note(_caller, _event, text):
                texts.append(re.search(r"\d+ of \d+ points", text).group())

            note.CallDataType = VTK_STRING
            isosurface = vtkScatteredIsosurfaceFilter()
            isosurface.SetController(controller)
            isosurface.SetInputData(data)
            isosurface.SetValue(0, 0.1)
            isosurface.AddObserver("WarningEvent", note)
            isosurface.UpdatePiece(RANK if controller else 0, SIZE if controller else 1, levels)
            return texts

        for levels in (0, 3):
            parts = gather(warnings(mine, owner == RANK, RANKS, levels))
            if RANK == 0:
                self.assertEqual(sum(parts, []), warnings(whole, owner >= 0, None, 0))
                self.assertEqual(len(parts[0]), 1)

    def test_ghosts_are_rings_of_other_ranks(self):
        mine, _ = self.dealt(cloud("uniform", 3000, 4), "round robin")
        without = surface(mine, RANKS, **ARRAYS).GetOutput()
        self.assertFalse(without.GetPointData().HasArray(GHOSTS))
        self.assertFalse(without.GetCellData().HasArray(GHOSTS))
        output = surface(mine, RANKS, levels=2, **ARRAYS).GetOutput()
        if SIZE == 1:
            self.assertEqual(triangles(output), triangles(without))
            return
        cells = vtk_to_numpy(output.GetCellData().GetArray(GHOSTS))
        points = vtk_to_numpy(output.GetPointData().GetArray(GHOSTS))
        count = without.GetNumberOfPolys()
        self.assertFalse(cells[:count].any())
        self.assertTrue((cells[count:] == vtkDataSetAttributes.DUPLICATECELL).all())
        self.assertEqual(len(points), output.GetNumberOfPoints())
        output.GetPointData().RemoveArray(GHOSTS)
        kinds, rows = triangles(output)
        self.assertEqual((kinds, rows[:count]), triangles(without))
        # Each point is no duplicate on one rank.
        owned = [row for row, isGhost in zip(described(output)[1], points) if not isGhost]
        parts = gather((rows[:count], rows[count:], owned))
        if RANK == 0:
            everything = {row: rank for rank, part in enumerate(parts) for row in part[0]}
            for rank, (_, ghosts, _) in enumerate(parts):
                self.assertGreater(len(ghosts), 10)
                self.assertTrue(all(everything.get(row, rank) != rank for row in ghosts))
            everyone = [row for part in parts for row in part[2]]
            self.assertEqual(len(everyone), len(set(everyone)))

    def test_blocks(self):
        def blocks(selections):
            result = vtkMultiBlockDataSet()
            for i, (points, numbers) in enumerate(selections):
                result.SetBlock(i, poly_data(points, numbers))
            return result

        clouds = [cloud("uniform", 1500, 5), cloud("clusters", 1500, 6)]
        numbers = np.arange(1500)
        mine = np.sort(ranks_of(clouds[0], "even")) == RANK
        result = surface(blocks([(points[mine], numbers[mine]) for points in clouds]), RANKS,
                         ContourBlocks=1).GetOutputDataObject(0)
        whole = surface(blocks([(points, numbers) for points in clouds]), None,
                        ContourBlocks=1).GetOutputDataObject(0)
        for i in range(2):
            self.same_triangles(result.GetBlock(i), lambda: whole.GetBlock(i))

    def test_further_isovalues(self):
        mine, whole = self.dealt(cloud("uniform", 3000, 7), "even")
        isosurface = vtkScatteredIsosurfaceFilter()
        isosurface.SetController(RANKS)
        isosurface.SetInputData(mine)
        for values in ((0.2,), (-0.4, 0.9), (0.2,)):
            run(isosurface, values)
            self.same_triangles(
                isosurface.GetOutput(), lambda: surface(whole, None, values=values).GetOutput())

    def test_an_abort_on_one_rank_ends_the_update_of_all(self):
        mine, _ = self.dealt(cloud("uniform", 20000, 8), "even")
        isosurface = vtkScatteredIsosurfaceFilter()
        isosurface.SetController(RANKS)
        isosurface.SetInputData(mine)
        if RANK == SIZE - 1:
            isosurface.AddObserver("ProgressEvent", lambda *_: isosurface.SetAbortExecute(1))
        self.assertEqual(run(isosurface).GetOutput().GetNumberOfPoints(), 0)


if __name__ == "__main__":
    main()
