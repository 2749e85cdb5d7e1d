# SPDX-License-Identifier: GPL-3.0-or-later
"""What filters leave of isopoints is drawn as splats too, unless it became a mesh."""

import os
import sys

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

from scripting import FOLDER, check, covered, look, make_view, pixels

RADIUS = 7.3


def ball():
    image = simple.Wavelet(WholeExtent=[-10, 10] * 3)
    distance = simple.Calculator(Input=image, ResultArrayName="r", Function="mag(coords)")
    distance.UpdatePipeline()
    return simple.ScatteredIsopoints(
        Input=distance, ContourBy=["POINTS", "r"], Isosurfaces=[RADIUS])


def picture(view, source):
    display = simple.Show(source, view)
    kind = str(display.Representation).strip("'")
    simple.ColorBy(display, None)
    display.DiffuseColor = display.AmbientColor = [1.0, 1.0, 0.0]
    image = pixels(view)
    simple.Hide(source, view)
    return kind, image


def is_drawn(image):
    """The share of the ball's left and right half that is drawn, and how much more light its upper
    half has than the lower one."""
    seen = covered(image)
    half = np.pi * (150 * RADIUS / 10.0) ** 2 / 2
    left, right = seen[:, :150].sum() / half, seen[:, 150:].sum() / half
    upper, lower = image[200, 120:180, 0].mean(), image[100, 120:180, 0].mean()
    return left, right, upper - lower


def filters(isopoints):
    clip = simple.Clip(Input=isopoints)
    clip.ClipType.Origin = [0.0, 0.0, 0.0]
    clip.ClipType.Normal = [1.0, 0.0, 0.0]
    threshold = simple.Threshold(Input=isopoints, Scalars=["POINTS", "r"])
    threshold.LowerThreshold, threshold.UpperThreshold = RADIUS - 1, RADIUS + 1
    calculator = simple.Calculator(Input=isopoints, ResultArrayName="k", Function="coordsX")
    transform = simple.Transform(Input=isopoints)
    transform.Transform.Rotate = [0.0, 90.0, 0.0]
    mask = simple.MaskPoints(Input=isopoints, OnRatio=1)
    group = simple.GroupDatasets(Input=[isopoints])
    simple.SelectPoints("r>0", isopoints)
    selection = simple.ExtractSelection(Input=isopoints)
    of_clip = simple.Threshold(Input=clip, Scalars=["POINTS", "r"])
    of_clip.LowerThreshold, of_clip.UpperThreshold = RADIUS - 1, RADIUS + 1
    return {"Threshold": threshold, "Calculator": calculator, "Transform": transform,
            "Mask Points": mask, "Group Datasets": group, "Extract Selection": selection,
            "Clip": clip, "Threshold of Clip": of_clip}


def triangles_of(source):
    """The corners of all triangles with their normals, as a set of byte strings, and their number."""
    polygons = simple.IsopointSplatPolygons(Input=source)
    polygons.UpdatePipeline()
    output = servermanager.Fetch(polygons)
    leaves = [output]
    if output.IsA("vtkMultiBlockDataSet"):
        leaves = [output.GetBlock(i) for i in range(output.GetNumberOfBlocks())]
    rows = []
    for leaf in leaves:
        corners = vtk_to_numpy(leaf.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        places = vtk_to_numpy(leaf.GetPoints().GetData())[corners].reshape(-1, 9)
        normals = vtk_to_numpy(leaf.GetPointData().GetNormals())[corners].reshape(-1, 9)
        rows += [row.tobytes() for row in np.hstack([places, normals])]
    simple.Delete(polygons)
    return set(rows), len(rows)


def number_of_points(source):
    return source.GetDataInformation().GetNumberOfPoints()


def splats_stay(isopoints):
    """Where filters keep cells, the points that remain have the same triangles as before."""
    clip = simple.Clip(Input=isopoints)
    clip.ClipType.Normal = [1.0, 0.0, 0.0]
    threshold = simple.Threshold(Input=isopoints, Scalars=["POINTS", "RTData"])
    low, high = isopoints.PointData["RTData"].GetRange()
    threshold.LowerThreshold, threshold.UpperThreshold = (low + high) / 2, high
    group = simple.GroupDatasets(Input=[threshold, clip])
    simple.SelectCells("id<300", isopoints)
    selection = simple.ExtractSelection(Input=isopoints)
    kept = {
        "Clip": clip, "Threshold": threshold, "cells": selection,
        "Append Datasets": simple.AppendDatasets(Input=[threshold, clip]),
        "Merge Blocks": simple.MergeBlocks(Input=group), "Group Datasets": group,
        "Redistribute": simple.RedistributeDataSet(Input=isopoints),
        "Extract Surface": simple.ExtractSurface(Input=clip),
    }
    for extension, source in (("vtp", isopoints), ("vtu", clip), ("vtm", group)):
        path = os.path.join(FOLDER, "points." + extension)
        simple.SaveData(path, proxy=source, DataMode="Binary")
        kept[extension] = simple.OpenDataFile(path)
    everything, _ = triangles_of(isopoints)
    for name, source in kept.items():
        source.UpdatePipeline()
        some, count = triangles_of(source)
        check(100 < number_of_points(source) and some <= everything, f"{name}: the same triangles")
        check(5.5 < count / number_of_points(source) < 6.5, f"{name}: {count} triangles")
    check(triangles_of(kept["Redistribute"])[0] == everything, "all triangles redistributed")
    check(triangles_of(kept["vtp"])[0] == everything, "all triangles of the file")
    simple.SelectPoints("id<300", isopoints)
    for source in (simple.MaskPoints(Input=isopoints, OnRatio=2),
                   simple.ExtractSelection(Input=isopoints)):
        source.UpdatePipeline()
        radii = vtk_to_numpy(servermanager.Fetch(source).GetPointData().GetArray("Radius"))
        check(triangles_of(source)[1] == 8 * np.count_nonzero(radii), "octagons")
    simple.ClearSelection(isopoints)
    return kept


def shapes_are_hidden(isopoints, kept):
    """From menus of arrays, and from tables of points."""
    for source in (isopoints, kept["Clip"], kept["Append Datasets"], kept["vtp"]):
        check(not any("Splat" in name for name in source.PointData.keys()), "arrays of points")
        check({"SplatAxis", "SplatPolygon"} <= set(source.CellData.keys()), "arrays of cells")
        offered = simple.Threshold(Input=source)
        menu = offered.SMProxy.GetProperty("SelectInputScalars").FindDomain("vtkSMArrayListDomain")
        names = {menu.GetString(i) for i in range(menu.GetNumberOfStrings())}
        names.discard("Normals")  # later versions of ParaView offer vectors too
        check(names == {"RTData", "Radius", "r"}, f"arrays offered by a filter: {names}")
    path = os.path.join(FOLDER, "points.csv")
    simple.SaveData(path, proxy=isopoints)
    with open(path, encoding="utf-8") as file:
        head = file.readline()
    check("Radius" in head and "Splat" not in head, f"columns of a table: {head}")


def main(plugin):
    simple.LoadPlugin(plugin)
    simple._DisableFirstRenderCameraReset()
    view = make_view(300)
    look(view, 50.0, 10.0)
    isopoints = ball()
    for name, source in filters(isopoints).items():
        kind, image = picture(view, source)
        check(kind == "Isopoint Splats", f"{name} is shown as {kind}")
        left, right, light = is_drawn(image)
        print(f"{name}: left {left:.3f}, right {right:.3f}, light {light:.0f}")
        check(0.95 < left < 1.1, f"{name}: the left half")
        check(0.95 < right < 1.1 or ("Clip" in name and right < 0.15), f"{name}: the right half")
        check(light > 20, f"{name}: lit from above")
    shapes_are_hidden(isopoints, splats_stay(isopoints))
    for source in (simple.Delaunay3D(Input=isopoints), simple.Sphere(), simple.Slice(Input=isopoints)):
        kind = str(simple.Show(source, view).Representation).strip("'")
        check(kind == "Surface", "meshes are drawn as they are")
    check("Slice" in isopoints.__doc__, "help says that points cannot be sliced")


main(sys.argv[1])
print("passed")
