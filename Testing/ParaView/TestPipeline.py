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


def values_at_places():
    """From points, without any choice but where."""
    line = updated(simple.ScatteredLine(Input=READER))
    chart = simple.Show(line, simple.CreateView("XYChartView"))
    check(str(chart.XArrayName).strip("'") == "arc_length", "arc_length is the axis")
    length = line.PointData["arc_length"].GetRange()[1]
    check(np.isclose(length, 2 * np.sqrt(3), rtol=1e-3), f"the line is a diagonal of the bounds, not {length} long")
    grid = simple.ScatteredGrid(Input=READER, SamplingDimensions=[30, 30, 30])
    isosurface = updated(simple.Contour(Input=grid, ContourBy=["POINTS", "r"], Isosurfaces=[1.2]))
    reached = np.abs(isosurface.GetDataInformation().GetBounds())
    check((reached < 1.0).all() and (reached > 0.9).all(), f"a contour of the grid ends within the samples: {reached}")
    check(number_of_points(isosurface) > 500, "points of this contour")
    gradient = updated(simple.ScatteredGradient(Input=READER))
    check(list(gradient.ScalarArray)[1] in ("r", "gaps"), "the array of the gradient")
    check(gradient.PointData["Gradient"].GetNumberOfComponents() == 3, "its gradient")
    probe = updated(
        simple.ScatteredProbe(Samples=READER, DestinationMesh=simple.Sphere(Radius=0.5, ThetaResolution=50)))
    least, greatest = probe.PointData["r"].GetRange()
    check(0.499 < least < greatest < 0.501, f"distances on a sphere: {least}, {greatest}")
    check(probe.NumberOfSamples == 40000, "counters")


def slices():
    """A plane in the middle by default; other functions, offsets, and their pictures."""
    sliced = updated(simple.ScatteredSlice(Input=READER))
    check(sliced.SliceType.GetXMLName() == "Plane" and list(sliced.SliceType.Normal) == [1, 0, 0], "the default plane")
    check(np.isclose(sliced.PointData["r"].GetRange()[1], 2**0.5, rtol=0.02), "distances up to the corners")
    view = make_view(300)
    display = simple.Show(sliced, view)
    simple.ColorBy(display, ("POINTS", "r"))
    view.CameraPosition, view.CameraFocalPoint, view.CameraParallelProjection = [5, 0, 0], [0, 0, 0], 1
    view.CameraParallelScale = 1.25
    is_background = (pixels(view) == [0, 0, 255]).all(axis=2)
    check(not is_background[35:265, 35:265].any(), "no hole and no frayed rim")
    check(is_background[:25].all() and is_background[:, :25].all(), "nothing outside")
    sliced.SliceOffsetValues = [-0.5, 0.5]
    bounds = updated(sliced).GetDataInformation().GetBounds()
    check(np.allclose(bounds[:2], [-0.5, 0.5], atol=1e-5), f"both offsets: {bounds}")
    sliced.SliceOffsetValues = [0.0]
    for kind, options, least, greatest in (("Sphere", dict(Radius=0.5), 0.499, 0.501),
                                           ("Cylinder", dict(Radius=0.5), 0.499, 1.12),
                                           ("Box", dict(Position=[-0.5] * 3, Length=[1, 1, 1]), 0.49, 0.87)):
        sliced.SliceType = kind
        for name, value in options.items():
            setattr(sliced.SliceType, name, value)
        found = updated(sliced).PointData["r"].GetRange()
        check(least < found[0] < found[1] < greatest, f"distances on a {kind}: {found}")
    check(sliced.NumberOfSamples == 40000, "counters")


def bodies():
    """The body of all samples, its pieces and its area, by ParaView's filters."""
    body = updated(simple.ScatteredBody(Input=READER))
    check(body.NumberOfSamples == 40000 and number_of_points(body) > 100, "points on the border of the samples")
    area = updated(simple.IntegrateVariables(Input=body)).CellData["Area"].GetRange()[0]
    check(23.5 < area < 27, f"the area of a cube of side 2: {area}")
    pieces = updated(simple.Connectivity(Input=body))
    check(pieces.PointData["RegionId"].GetRange() == (0.0, 0.0), "one piece")


load(sys.argv[1])
READER = read_cloud()
run(isovalues_and_counters, picture, slices, bodies, values_at_places)
