# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin in ParaView: a pipeline from a file to a picture, as a user's script builds it."""

import sys

import numpy as np
from paraview import simple

from scripting import (
    SPLATS, check, contoured, load, look, make_view, number_of_points, path_of, pixels, run, shown, table_of_points,
    updated)


def read_cloud():
    """A file of random samples in a cube: their distances from its middle, and "gaps", the same with 400 NaN."""
    positions = np.random.default_rng(1).random((40000, 3)) * 2.0 - 1.0
    distances = np.linalg.norm(positions, axis=1)
    gaps = np.where(np.arange(40000) % 100 == 0, np.nan, distances)
    points = table_of_points(**dict(zip("xyz", positions.T)), r=distances, gaps=gaps)
    simple.SaveData(path_of("cloud.vtp"), proxy=points, DataMode="Binary")
    return simple.OpenDataFile(path_of("cloud.vtp"))


def isovalues_and_counters():
    """Counters are properties of both filters. They count what the last update did."""
    for kind in ("ScatteredIsopoints", "ScatteredIsosurface"):
        counted = contoured(READER, "gaps", 0.5, kind=kind)
        counted.Isosurfaces = [0.5, 0.75]
        for projection in ("None", "Cubic fit", "None"):
            counted.Projection = projection
            points = number_of_points(updated(counted))
            check(counted.PointData["gaps"].GetRange() == (0.5, 0.75), "both isovalues")
            check(counted.NumberOfSkippedSamples == 400, "skipped samples")
            unprojected = counted.NumberOfUnprojectedPoints
            check((unprojected == points) == (projection == "None"),
                  f"{unprojected} points unprojected of {points} by {projection}")
        for name in ("NumberOfSkippedSamples", "NumberOfUnprojectedPoints"):
            check(counted.SMProxy.GetProperty(name).GetPanelVisibility() == "default", name)


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
run(isovalues_and_counters, picture)
