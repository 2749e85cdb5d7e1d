# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures triangles against Contour of the meshes that their samples come from: gaps.py FOLDER

FOLDER has the data sets as docs/testing.md, "Real files", has them; those that are missing are left out.
The package scatteredisopoints has to be found (PYTHONPATH). Prints for each isovalue, as shares of the area of
Contour, with and without the triangles in gaps (DropGaps): *off*, the area of triangles that is farther from
Contour than half a spacing, and *uncovered*, the area of Contour that is farther than that from the triangles.
The spacing of a place is the median distance of the sample nearest to it to the twelve nearest of that.
"""

import os
import sys

import numpy as np
from scatteredisopoints import contour
from scipy.spatial import cKDTree
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkCommonDataModel import vtkStaticCellLocator
from vtkmodules.vtkFiltersCore import (
    vtkCellCenters,
    vtkCellDataToPointData,
    vtkContourFilter,
    vtkTriangleFilter,
)
from vtkmodules.vtkIOXML import vtkXMLGenericDataObjectReader

# file, array of points or cells, isovalues
DATA = [
    ("multiblock/bluntfin.vts", "Density", (1.2, 1.0, 0.5, 3.0)),
    ("unstructured/disk_out_ref.vtu", "Temp", (400.0, 600.0)),
    ("unstructured/disk_out_ref.vtu", "Pres", (0.01, 0.02)),
    ("unstructured/can.vtu", "EQPS", (0.5, 0.7, 1.0)),
    ("unstructured/can.vtu", "VEL", (3600.0, 4500.0)),
    ("unstructured/fea_bracket_kiefer.vtu", "von_Mises_psi", (1.0, 5.0, 10.0)),
    ("multiblock/multicomb_0.vts", "Density", (0.28, 0.4)),
    ("multiblock/multicomb_1.vts", "Density", (0.28, 0.4)),
    ("multiblock/multicomb_2.vts", "Density", (0.28, 0.4)),
]

PLACES = 20000  # on each surface


def with_lengths(data, array):
    """Gives vectors way to their lengths."""
    for attributes in (data.GetPointData(), data.GetCellData()):
        vectors = attributes.GetArray(array)
        if vectors and vectors.GetNumberOfComponents() > 1:
            lengths = numpy_to_vtk(np.linalg.norm(vtk_to_numpy(vectors), axis=1), deep=True)
            lengths.SetName(array)
            attributes.AddArray(lengths)  # in its place
    return data


def output_of(algorithm, data):
    algorithm.SetInputData(data)
    algorithm.Update()
    return algorithm.GetOutput()


def read(path, array):
    """The samples, and the mesh with the array at its points."""
    reader = vtkXMLGenericDataObjectReader()
    reader.SetFileName(path)
    reader.Update()
    mesh = with_lengths(reader.GetOutput(), array)
    if mesh.GetPointData().HasArray(array):
        return mesh, mesh
    return output_of(vtkCellCenters(), mesh), output_of(vtkCellDataToPointData(), mesh)


def mesh_surface(mesh, array, isovalue):
    surface = vtkContourFilter()
    surface.SetInputArrayToProcess(0, 0, 0, 0, array)
    surface.SetValue(0, isovalue)
    triangles = vtkTriangleFilter()
    triangles.PassVertsOff()
    triangles.PassLinesOff()
    return output_of(triangles, output_of(surface, mesh))


def corners_of(surface):
    """The positions of the corners, shape (triangles, 3, 3)."""
    if surface.GetNumberOfPolys() == 0:
        return np.zeros((0, 3, 3))
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    return points[vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)]


def areas_of(corners):
    return np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2


def places_on(corners):
    """Places that are evenly distributed on triangles."""
    random = np.random.default_rng(1)
    areas = np.cumsum(areas_of(corners))
    chosen = corners[np.searchsorted(areas, random.random(PLACES) * areas[-1])]
    u, v = random.random((2, PLACES, 1))
    root = np.sqrt(u)
    return (1 - root) * chosen[:, 0] + root * (1 - v) * chosen[:, 1] + root * v * chosen[:, 2]


def far_area(surface, other, tree, spacings):
    """The area of a surface that is farther than half a spacing from another one."""
    corners = corners_of(surface)
    area = areas_of(corners).sum()
    if area == 0 or other.GetNumberOfPolys() == 0:
        return area
    places = places_on(corners)
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


def main(folder):
    print("| data | isovalue | off: all | without gaps | uncovered: all | without gaps |")
    print("|---|---|---|---|---|---|")
    for name, array, isovalues in DATA:
        path = os.path.join(folder, name)
        if not os.path.exists(path):
            continue
        samples, mesh = read(path, array)
        positions = [samples.GetPoint(i) for i in range(samples.GetNumberOfPoints())]
        tree = cKDTree(np.unique(positions, axis=0))
        spacings = np.median(tree.query(tree.data, 13)[0][:, 1:], axis=1)
        for isovalue in isovalues:
            truth = mesh_surface(mesh, array, isovalue)
            area = areas_of(corners_of(truth)).sum()
            found = [
                contour(samples, array, isovalue, triangles=True, projection="NO_PROJECTION", drop_gaps=drops,
                        regularize=False).polydata
                for drops in (False, True)
            ]
            off = [far_area(surface, truth, tree, spacings) for surface in found]
            uncovered = [far_area(truth, surface, tree, spacings) for surface in found]
            cells = [f"{100 * share / area:.2f} %" for share in off + uncovered]
            print(f"| {os.path.basename(name)}, {array} | {isovalue:g} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) != 2 or not os.path.isdir(sys.argv[1]):
        sys.exit(__doc__)
    main(sys.argv[1])
