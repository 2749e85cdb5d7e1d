# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures triangles against Contour of the meshes that their samples come from: domain.py FOLDER

FOLDER has the data sets as docs/testing.md, "Real files", has them. The package scatteredisopoints has to be
found (PYTHONPATH). Prints for each data set, with all triangles and without those in gaps, as shares of the
area of Contour: *off*, the area of triangles that is farther from Contour than half a spacing, and *uncovered*,
the area of Contour that is farther than that from the triangles. The spacing of a place is the median
distance of the sample nearest to it to its twelve nearest ones.
"""

import os
import sys

import numpy as np
from scatteredisopoints import contour
from scipy.spatial import cKDTree
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIdList
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticCellLocator
from vtkmodules.vtkFiltersCore import (
    vtkAppendPolyData,
    vtkArrayCalculator,
    vtkCellCenters,
    vtkCellDataToPointData,
    vtkContourFilter,
    vtkTriangleFilter,
)
from vtkmodules.vtkIOXML import vtkXMLGenericDataObjectReader

# file, array (of points, or of cells), isovalues
DATA = [
    ("multiblock/bluntfin.vts", "Density", (1.2, 1.0, 0.5, 3.0)),
    ("unstructured/disk_out_ref.vtu", "Temp", (400.0, 600.0)),
    ("unstructured/disk_out_ref.vtu", "Pres", (0.01, 0.02)),
    ("unstructured/can.vtu", "EQPS", (0.1, 0.2, 0.5, 1.0)),
    ("unstructured/can.vtu", "VEL", (3600.0, 4500.0)),
    ("unstructured/fea_bracket_kiefer.vtu", "von_Mises_psi", (1.0, 5.0, 10.0)),
    ("multiblock/multicomb_0.vts", "Density", (0.28, 0.4)),
    ("multiblock/multicomb_1.vts", "Density", (0.28, 0.4)),
    ("multiblock/multicomb_2.vts", "Density", (0.28, 0.4)),
]

PLACES = 100000  # on each surface


def magnitude(data, array):
    """Gives vectors way to their lengths."""
    for attributes in (data.GetPointData(), data.GetCellData()):
        vectors = attributes.GetArray(array)
        if vectors and vectors.GetNumberOfComponents() > 1:
            lengths = np.linalg.norm(vtk_to_numpy(vectors).astype(float), axis=1)
            values = vtkDoubleArray()
            values.SetName(array)
            values.SetNumberOfTuples(len(lengths))
            for i, length in enumerate(lengths):
                values.SetValue(i, length)
            attributes.RemoveArray(array)
            attributes.AddArray(values)
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
    mesh = magnitude(reader.GetOutput(), array)
    if mesh.GetPointData().HasArray(array):
        return mesh, mesh
    return output_of(vtkCellCenters(), mesh), output_of(vtkCellDataToPointData(), mesh)


def mesh_surface(mesh, array, isovalue):
    surface = vtkContourFilter()
    surface.SetInputData(mesh)
    surface.SetInputArrayToProcess(0, 0, 0, 0, array)
    surface.SetValue(0, isovalue)
    triangles = vtkTriangleFilter()
    triangles.PassVertsOff()
    triangles.PassLinesOff()
    triangles.SetInputConnection(surface.GetOutputPort())
    triangles.Update()
    return triangles.GetOutput()


def corners_of(surface):
    """The positions of the corners, shape (triangles, 3, 3)."""
    if surface.GetNumberOfPolys() == 0:
        return np.zeros((0, 3, 3))
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    return points[vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)]


def area_of(corners):
    return np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2


def places_on(corners, random):
    """Places that are evenly distributed on triangles."""
    areas = np.cumsum(area_of(corners))
    chosen = corners[np.searchsorted(areas, random.random(PLACES) * areas[-1])]
    u, v = random.random((2, PLACES, 1))
    root = np.sqrt(u)
    return (1 - root) * chosen[:, 0] + root * (1 - v) * chosen[:, 1] + root * v * chosen[:, 2]


def far_share(corners, other, tree, spacings, random):
    """The share of the area of some triangles that is farther than half a spacing from a surface."""
    if len(corners) == 0:
        return 0.0
    if other.GetNumberOfPolys() == 0:
        return 1.0
    places = places_on(corners, random)
    reach = spacings[tree.query(places)[1]] / 2
    locator = vtkStaticCellLocator()
    locator.SetDataSet(other)
    locator.BuildLocator()
    from vtkmodules.vtkCommonCore import reference
    closest = [0.0, 0.0, 0.0]
    cell, sub, distance = reference(0), reference(0), reference(0.0)
    far = 0
    for place, most in zip(places, reach):
        locator.FindClosestPoint(place, closest, cell, sub, distance)
        far += distance.get() > most * most
    return far / len(places)


def main(folder):
    print("| data | isovalue | off, all | without gaps | uncovered, all | without gaps |")
    print("|---|---|---|---|---|---|")
    for name, array, isovalues in DATA:
        samples, mesh = read(os.path.join(folder, name), array)
        positions = np.array([samples.GetPoint(i) for i in range(samples.GetNumberOfPoints())])
        tree = cKDTree(np.unique(positions, axis=0))
        spacings = np.median(tree.query(tree.data, 13)[0][:, 1:], axis=1)
        for isovalue in isovalues:
            truth = mesh_surface(mesh, array, isovalue)
            true_corners = corners_of(truth)
            true_area = area_of(true_corners).sum()
            off, uncovered = [], []
            for gaps in ([0.0, 1.0] if len(sys.argv) < 3 else [float(a) for a in sys.argv[2:]]):
                found = contour(samples, array, isovalue, triangles=True, gap_factor=gaps, projection="NO_PROJECTION").polydata
                random = np.random.default_rng(1)
                corners = corners_of(found)
                off.append(far_share(corners, truth, tree, spacings, random) * area_of(corners).sum() / true_area)
                uncovered.append(far_share(true_corners, found, tree, spacings, random))
            print(f"| {name}, {array} | {isovalue:g} | " + " | ".join(f"{100 * x:.2f} %" for x in off + uncovered) + " |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1])
