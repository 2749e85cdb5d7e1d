# SPDX-License-Identifier: GPL-3.0-or-later
"""Every kind of data that ParaView offers to the filter, through the plugin: what the property
panel lists, and that the surface is where Contour's is."""

import sys

import numpy as np
from paraview import simple

from scripting import (
    check, contoured, distance_in, load, number_of_points, offered_arrays, positions, table_of_points, updated)


load(sys.argv[1])
points = distance_in(simple.Wavelet())
samples = np.random.default_rng(3).random((20000, 3)) * 2.0 - 1.0
columns = dict(zip("xyz", samples.T), r=np.linalg.norm(samples, axis=1))
parts = [simple.ExtractSubset(Input=points, VOI=[*x, -10, 10, -10, 10]) for x in ((-10, 0), (0, 10))]
surfaces = []
for what, source, association, radius, tolerance in (
        ("image, point data", points, "POINTS", 7.05, 0.1),
        ("image, cell data", simple.PointDatatoCellData(Input=points), "CELLS", 7.05, 0.3),
        ("table", table_of_points(**columns), "POINTS", 0.7, 0.02),
        ("blocks", simple.GroupDatasets(Input=parts), "POINTS", 7.05, 0.1)):
    surface = contoured(updated(source), "r", radius, association)
    surfaces.append(surface)
    check("r" in offered_arrays(surface), f"{what}: listed among {offered_arrays(surface)}")
    found = np.linalg.norm(positions(surface), axis=1)
    check(len(found) > 300 and np.abs(found - radius).max() < tolerance, f"{what}: {len(found)} points on the sphere")

alone, together = surfaces[0], surfaces[-1]
found = positions(together)
check(len(np.unique(found, axis=0)) == len(found), "no point of the doubled faces is doubled")
together.ContourBlocks = 1
information = updated(together).GetDataInformation()
check(information.DataInformation.IsCompositeDataSet(), "block by block is composite")
check(information.GetNumberOfPoints() > number_of_points(alone), "each block has the shared face")

trees = updated(simple.HyperTreeGridRandom(Dimensions=[7, 7, 7], MaxDepth=3, Seed=7))
leaves = contoured(trees, "Depth", 1.5, "CELLS")
check("Depth" in offered_arrays(leaves) and number_of_points(leaves) > 100, "leaves of a hyper tree grid")
check(leaves.PointData["Depth"].GetRange() == (1.5, 1.5), "the isovalue on leaves")
