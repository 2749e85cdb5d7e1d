# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures triangles against Contour of the meshes that their samples come from: gaps.py FOLDER

FOLDER is the folder of docs/testing.md, "Real files". Missing data sets are skipped.
The package scatteredisopoints has to be found (PYTHONPATH). Prints for each isovalue, as shares of the area of
Contour, with and without the triangles in gaps (DropGaps): *off*, the area of triangles that is farther from
Contour than half a spacing, and *uncovered*, the area of Contour that is farther than that from the triangles.
The spacing of a place is the median distance of the sample nearest to it to the twelve nearest of that.
"""

import os
import sys

import common
import numpy as np
from scatteredisopoints import contour
from scipy.spatial import cKDTree
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkCommonDataModel import vtkStaticCellLocator
from vtkmodules.vtkFiltersCore import vtkCellCenters, vtkCellDataToPointData, vtkContourFilter

# file, array of points or cells, isovalues
DATA = [
    ("multiblock/bluntfin.vts", "Density", (1.2, 1.0, 0.5, 3.0)),
    ("unstructured/disk_out_ref.vtu", "Temp", (400.0, 600.0)),
    ("unstructured/disk_out_ref.vtu", "Pres", (0.01, 0.02)),
    ("unstructured/can.vtu", "EQPS", (0.5, 0.7, 1.0)),
    ("unstructured/can.vtu", "VEL", (3600.0, 4500.0)),
    ("unstructured/fea_bracket_kiefer.vtu", "von_Mises_psi", (1.0, 5.0, 10.0)),
    *((f"multiblock/multicomb_{i}.vts", "Density", (0.28, 0.4)) for i in range(3)),
]
PLACES = 20000  # on each surface


def read(path, array):
    """The samples, and the mesh with the array at its points; vectors give way to their lengths."""
    mesh = common.read(path)
    for attributes in (mesh.GetPointData(), mesh.GetCellData()):
        vectors = attributes.GetArray(array)
        if vectors and vectors.GetNumberOfComponents() > 1:
            lengths = numpy_to_vtk(np.linalg.norm(vtk_to_numpy(vectors), axis=1), deep=True)
            lengths.SetName(array)
            attributes.AddArray(lengths)  # in its place
    if mesh.GetPointData().HasArray(array):
        return mesh, mesh
    return common.output_of(vtkCellCenters(), mesh), common.output_of(vtkCellDataToPointData(), mesh)


def far_area(surface, other, tree, spacings):
    """The area of a surface that is farther than half a spacing from another one."""
    corners = common.corners_of(surface)
    area = common.areas_of(corners).sum()
    if area == 0 or other.GetNumberOfPolys() == 0:
        return area
    chosen, weights = common.random_places(corners, PLACES, np.random.default_rng(1))
    places = common.placed(weights, corners[chosen])
    reaches = spacings[tree.query(places)[1]] / 2
    locator = vtkStaticCellLocator()
    locator.SetDataSet(other)
    locator.BuildLocator()
    closest, cell, part, square = [0.0] * 3, reference(0), reference(0), reference(0.0)
    far = 0
    for place, reach in zip(places, reaches):
        locator.FindClosestPoint(place, closest, cell, part, square)
        far += square.get() > reach * reach
    return area * far / PLACES


if len(sys.argv) != 2 or not os.path.isdir(sys.argv[1]):
    sys.exit(__doc__)
common.print_head("data", "isovalue", "off: all", "without gaps", "uncovered: all", "without gaps")
for name, array, isovalues in DATA:
    path = os.path.join(sys.argv[1], name)
    if not os.path.exists(path):
        continue
    samples, mesh = read(path, array)
    tree = cKDTree(np.unique(common.positions_of(samples), axis=0))
    spacings = np.median(tree.query(tree.data, 13)[0][:, 1:], axis=1)
    for isovalue in isovalues:
        contouring = vtkContourFilter()
        contouring.SetInputArrayToProcess(0, 0, 0, 0, array)
        truth = common.output_of(contouring, mesh, isovalue)
        area = common.areas_of(common.corners_of(truth)).sum()
        found = [contour(samples, array, isovalue, triangles=True, projection="NO_PROJECTION", drop_gaps=drops,
                         regularize=False).polydata for drops in (False, True)]
        shares = [far_area(surface, truth, tree, spacings) for surface in found]
        shares += [far_area(truth, surface, tree, spacings) for surface in found]
        common.print_row(f"{os.path.basename(name)}, {array}", f"{isovalue:g}",
                         *(f"{100 * share / area:.2f} %" for share in shares))
