# SPDX-License-Identifier: GPL-3.0-or-later
"""Isopoints that have passed filters are drawn as splats too, unless a filter made a mesh of them."""

import sys

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

from scripting import (
    SPLATS, ball, check, covered, leaves_of, load, look, make_view, number_of_points, offered_arrays, path_of, pixels,
    representation_of, run, shown, updated)

RADIUS = 7.3


def within(source, array, low, high):
    return simple.Threshold(Input=source, Scalars=["POINTS", array], LowerThreshold=low, UpperThreshold=high)


def clipped(source):
    clip = simple.Clip(Input=source)
    clip.ClipType.Origin = [0.0, 0.0, 0.0]
    clip.ClipType.Normal = [1.0, 0.0, 0.0]
    return clip


def filters_are_drawn():
    simple.SelectPoints("r>0", BALL)
    transform = simple.Transform(Input=BALL)
    transform.Transform.Rotate = [0.0, 90.0, 0.0]
    half = np.pi * (150 * RADIUS / 10.0) ** 2 / 2
    for name, source in {
            "Threshold": within(BALL, "r", RADIUS - 1, RADIUS + 1), "Transform": transform, "Clip": clipped(BALL),
            "Calculator": simple.Calculator(Input=BALL, ResultArrayName="k", Function="coordsX"),
            "Mask Points": simple.MaskPoints(Input=BALL, OnRatio=1),
            "Group Datasets": simple.GroupDatasets(Input=[BALL]),
            "Extract Selection": simple.ExtractSelection(Input=BALL),
            "Threshold of Clip": within(clipped(BALL), "r", RADIUS - 1, RADIUS + 1)}.items():
        display = shown(source, VIEW, [1.0, 1.0, 0.0])
        check(representation_of(display) == SPLATS, f"{name} is shown as {display.Representation}")
        image = pixels(VIEW)
        simple.Hide(source, VIEW)
        left, right = (part.sum() / half for part in np.hsplit(covered(image), 2))
        light = image[200, 120:180, 0].mean() - image[100, 120:180, 0].mean()
        print(f"{name}: left {left:.3f}, right {right:.3f}, light {light:.0f}")
        check(0.95 < left < 1.1, f"{name}: the left half")
        check(0.95 < right < 1.1 or ("Clip" in name and right < 0.15), f"{name}: the right half")
        check(light > 20, f"{name}: lit from above")


def triangles_of(source):
    """The corners of all triangles with their normals, shape (n, 18), in the order of the first numbers."""
    polygons = updated(simple.IsopointSplatPolygons(Input=source))
    rows = [np.empty((0, 18))]
    for leaf in leaves_of(polygons):
        corners = vtk_to_numpy(leaf.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        both = [vtk_to_numpy(array)[corners].reshape(-1, 9)
                for array in (leaf.GetPoints().GetData(), leaf.GetPointData().GetNormals())]
        rows.append(np.hstack(both))
    simple.Delete(polygons)
    together = np.concatenate(rows)
    return together[np.argsort(together[:, 0])]


def are_among(some, others):
    """Whether each of these triangles is one of the others. Where corners meet, all lie where one of them lies, so that
    they differ by rounding if some of the points are missing."""
    near = 1e-6 * np.abs(others).max()
    begins, ends = (np.searchsorted(others[:, 0], some[:, 0] + shift) for shift in (-near, near))
    return all((np.abs(others[begin:end] - row) <= near).all(axis=1).any()
               for row, begin, end in zip(some, begins, ends))


def visible_points(data):
    """Points that others hide have no radius."""
    return np.count_nonzero(vtk_to_numpy(data.GetPointData().GetArray("Radius")))


def splats_stay():
    """Where filters keep cells, the points that remain have the same triangles as before."""
    low, high = BALL.PointData["RTData"].GetRange()
    clip, threshold = clipped(BALL), within(BALL, "RTData", (low + high) / 2, high)
    group = simple.GroupDatasets(Input=[threshold, clip])
    simple.SelectCells("id<300", BALL)
    kept = {
        "Clip": clip, "Threshold": threshold, "cells": simple.ExtractSelection(Input=BALL),
        "Append Datasets": simple.AppendDatasets(Input=[threshold, clip]),
        "Merge Blocks": simple.MergeBlocks(Input=group), "Group Datasets": group,
        "Redistribute": simple.RedistributeDataSet(Input=BALL), "Extract Surface": simple.ExtractSurface(Input=clip)}
    for extension, source in (("vtp", BALL), ("vtu", clip), ("vtm", group)):
        path = path_of("points." + extension)
        simple.SaveData(path, proxy=source, DataMode="Binary")
        kept[extension] = simple.OpenDataFile(path)
    everything = triangles_of(BALL)
    for name, source in kept.items():
        some = triangles_of(updated(source))
        count = len(some)
        check(100 < number_of_points(source) and are_among(some, everything), f"{name}: the same triangles")
        visible = sum(map(visible_points, leaves_of(source)))
        check(5.5 < count / visible < 6.5, f"{name}: {count} triangles of {visible} points")
        check(name not in ("Redistribute", "vtp") or are_among(everything, some), f"{name}: all triangles")
    simple.SelectPoints("id<300", BALL)
    for source in (simple.MaskPoints(Input=BALL, OnRatio=2), simple.ExtractSelection(Input=BALL)):
        leaf, = leaves_of(updated(source))
        check(len(triangles_of(source)) == 8 * visible_points(leaf), "octagons")
    simple.ClearSelection(BALL)
    shapes_are_hidden([BALL, kept["Clip"], kept["Append Datasets"], kept["vtp"]])


def shapes_are_hidden(sources):
    """Menus of arrays and tables of points do not show the arrays of shapes."""
    for source in sources:
        check(not any("Splat" in name for name in source.PointData.keys()), "arrays of points")
        check({"SplatAxis", "SplatPolygon"} <= set(source.CellData.keys()), "arrays of cells")
        names = set(offered_arrays(simple.Threshold(Input=source)))
        names.discard("Normals")  # later versions of ParaView offer vectors too
        check(names == {"RTData", "Radius", "r"}, f"arrays offered by a filter: {names}")
    simple.SaveData(path_of("points.csv"), proxy=BALL)
    with open(path_of("points.csv"), encoding="utf-8") as file:
        head = file.readline()
    check("Radius" in head and "Splat" not in head, f"columns of a table: {head}")


def first_points_may_come_late():
    """Filters of empty isopoints show splats as soon as there are points, unless the user chose something else. The
    points may come in an update of the filters or of the view."""
    simple.HideAll(VIEW)
    for update in (lambda source: None, updated):
        isopoints = ball(10, 100.0)
        transform = simple.Transform(Input=isopoints)
        sources = {
            "Transform": transform, "Threshold": within(transform, "r", RADIUS - 1, RADIUS + 1),
            "Delaunay": simple.Delaunay3D(Input=isopoints), "chosen": simple.Transform(Input=isopoints)}
        displays = {name: shown(source, VIEW, [1.0, 1.0, 0.0]) for name, source in sources.items()}
        displays["chosen"].Representation = "Points"
        check(not covered(pixels(VIEW)).any(), "nothing yet")
        for name in list(displays)[1:]:
            displays[name].Visibility = 0
        isopoints.Isosurfaces = [RADIUS]
        update(sources["Transform"])
        part = covered(pixels(VIEW)).sum() / (np.pi * (150 * RADIUS / 10.0) ** 2)
        check(0.95 < part < 1.1, f"the picture shows {part:.3f} of the ball")
        for display in displays.values():
            display.Visibility = 1
        simple.Render(VIEW)
        found = {name: representation_of(display) for name, display in displays.items()}
        check(found == {"Transform": SPLATS, "Threshold": SPLATS, "Delaunay": "Surface",
                        "chosen": "Points"}, f"shown as {found}")
        for source in [*sources.values(), isopoints]:
            simple.Delete(source)


def meshes_are_drawn_as_they_are():
    for source in (simple.Delaunay3D(Input=BALL), simple.Sphere(), simple.Slice(Input=BALL)):
        check(representation_of(simple.Show(source, VIEW)) == "Surface", "a mesh")
    check("Slice" in BALL.__doc__, "help says that points cannot be sliced")


load(sys.argv[1])
VIEW = make_view(300)
look(VIEW, 50.0, 10.0)
BALL = ball(10, RADIUS)
run(filters_are_drawn, splats_stay, first_points_may_come_late, meshes_are_drawn_as_they_are)
