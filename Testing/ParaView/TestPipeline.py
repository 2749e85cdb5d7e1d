# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin in ParaView: a pipeline from a file to a picture, as a user's script builds it."""

import sys

import numpy as np
from paraview import simple

from scripting import (
    SPLATS, check, contoured, load, look, make_view, number_of_points, path_of, pixels, run, shown, updated)


def read_cloud():
    """Of a file with random samples in a cube: their distances from its middle, "gaps" with 400 NaN."""
    positions = np.random.default_rng(1).random((40000, 3)) * 2.0 - 1.0
    distances = np.linalg.norm(positions, axis=1)
    gaps = np.where(np.arange(40000) % 100 == 0, np.nan, distances)
    table = np.column_stack([positions, positions[:, 0], distances, gaps])
    np.savetxt(path_of("cloud.csv"), table, delimiter=",", header="x,y,z,noise,r,gaps", comments="")
    points = simple.TableToPoints(Input=simple.CSVReader(FileName=[path_of("cloud.csv")]))
    points.XColumn, points.YColumn, points.ZColumn = "x", "y", "z"
    simple.SaveData(path_of("cloud.vtp"), proxy=points, DataMode="Binary")
    return simple.OpenDataFile(path_of("cloud.vtp"))


def isopoints():
    surface = contoured(READER, "r", 0.5)
    surface.Isosurfaces = [0.5, 0.75]
    arrays = updated(surface).PointData
    check(surface.Angle == 54.7, "the default angle")
    check(list(arrays["r"].GetRange()) == [0.5, 0.75], "the isovalues")
    check(arrays["Normals"].GetNumberOfComponents() == 3, "normals")
    check(arrays["Radius"].GetRange()[1] > 0.0, "radii")
    check(arrays["noise"] is not None, "other arrays")


def counters():
    """They are properties of both filters, and those of the last update."""
    for kind in ("ScatteredIsopoints", "ScatteredIsosurface"):
        counted = contoured(READER, "gaps", 0.5, kind=kind)
        for projection in ("None", "Cubic fit", "None"):
            counted.Projection = projection
            points = number_of_points(updated(counted))
            check(counted.NumberOfSkippedSamples == 400, "skipped samples")
            unprojected = counted.NumberOfUnprojectedPoints
            check((unprojected == points) == (projection == "None"),
                  f"{unprojected} points unprojected of {points} by {projection}")
        for name in ("NumberOfSkippedSamples", "NumberOfUnprojectedPoints"):
            check(counted.SMProxy.GetProperty(name).GetPanelVisibility() == "default", name)


def triangles():
    """The other filter, with filters of meshes behind it, as a user's script would have them."""
    surface = contoured(READER, "r", 0.5, kind="ScatteredIsosurface")
    surface.Isosurfaces = [0.5, 0.75]
    information = updated(surface).GetDataInformation()
    check(information.GetNumberOfCells() > information.GetNumberOfPoints(), "triangles")
    check(list(surface.PointData["r"].GetRange()) == [0.5, 0.75], "the isovalues of triangles")
    check("Radius" not in surface.PointData.keys(), "no radii")
    edges = updated(simple.FeatureEdges(Input=surface, FeatureEdges=0))
    check(edges.GetDataInformation().GetNumberOfCells() == 0, "two closed surfaces")
    surface.Isosurfaces = [0.75]
    area = updated(simple.IntegrateVariables(Input=surface)).CellData["Area"].GetRange()[0]
    check(abs(area / (4.0 * np.pi * 0.75**2) - 1.0) < 0.005, f"the area {area}")
    check(simple.Show(surface, simple.CreateView("RenderView")).Representation == "Surface", "the default")


def picture():
    view = make_view(300)
    display = shown(contoured(READER, "r", 0.75), view, [1.0, 1.0, 1.0])
    check(display.Representation == SPLATS, "the default representation")
    look(view, 5.0, 1.0)
    rows, columns = np.mgrid[0:300, 0:300]
    distance = np.hypot(rows - 149.5, columns - 149.5) / 150.0
    background = (pixels(view) == [0, 0, 255]).all(axis=2)
    check(background[distance > 0.95].all(), "nothing far outside the sphere")
    check(not background[distance < 0.74].any(), "no hole in the sphere")


load(sys.argv[1])
READER = read_cloud()
run(isopoints, counters, triangles, picture)
