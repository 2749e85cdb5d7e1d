# SPDX-License-Identifier: GPL-3.0-or-later
"""The main job in one script, for pvbatch: samples in, isopoints.vtp and isosurface.png out.

Without arguments it makes its own samples: random positions in a cube of side 200, the value being
the distance to the centre, so that the true surface is known. With ISOPOINTS_FILE, ISOPOINTS_ARRAY and
ISOPOINTS_ISOVALUE in the environment it takes anything that ParaView reads.
"""

import os
import sys
import time

import numpy as np
from paraview import simple
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

SIDE = 200.0
RADIUS = 70.0
SAMPLE_COUNT = 1_000_000


def fail(message):
    sys.exit("demo: " + message)


def sphere_samples():
    """Random samples of the distance to the centre of a cube."""
    positions = np.random.default_rng(1).random((SAMPLE_COUNT, 3), dtype=np.float32) * SIDE
    distances = np.linalg.norm(positions - 0.5 * SIDE, axis=1)
    points = vtkPoints()
    points.SetData(numpy_to_vtk(positions, deep=True))
    samples = vtkPolyData()
    samples.SetPoints(points)
    scalars = numpy_to_vtk(distances.astype(np.float32), deep=True)
    scalars.SetName("distance")
    samples.GetPointData().SetScalars(scalars)
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(samples)
    return source


def file_samples(path, array, isovalue):
    """The point data of a file, blocks merged and cell data moved to the cells' centres."""
    if not os.path.isfile(path):
        fail("there is no file " + path)
    try:
        finite = np.isfinite(float(isovalue))
    except ValueError:
        finite = False
    if not finite:
        fail("the isovalue " + isovalue + " is not a number")
    try:
        source = simple.OpenDataFile(path)
    except RuntimeError:
        fail("ParaView has no reader for " + path)
    source.UpdatePipeline()
    if source.GetDataInformation().DataInformation.IsCompositeDataSet():
        source = simple.MergeBlocks(Input=source)
        source.UpdatePipeline()
    if source.GetDataInformation().GetNumberOfPoints() == 0:
        fail(
            path + " was read as empty. Debian's ParaView reads no VTK XML file with appended"
            " data: write it with inline data (SetDataModeToBinary)."
        )
    if array not in source.PointData.keys():
        if array not in source.CellData.keys():
            fail(
                "%s has no array named %s; its point arrays are %s, its cell arrays %s"
                % (path, array, source.PointData.keys(), source.CellData.keys())
            )
        source = simple.CellCenters(Input=source)
        source.UpdatePipeline()
    return source


def point_size(view, radii):
    """The pixels that nearly all splats are wide, seen at the distance of the view's centre."""
    camera = view.GetActiveCamera()
    seen_height = 2.0 * camera.GetDistance() * np.tan(np.radians(0.5 * camera.GetViewAngle()))
    width = 2.0 * np.percentile(radii, 90) * view.ViewSize[1] / seen_height
    return float(np.clip(width, 3.0, 40.0))


def light_both_sides(view):
    """A light over the viewer's shoulder and its opposite, for normals that point away."""
    view.UseLight = 0
    for side in (1.0, -1.0):
        light = simple.AddLight(view=view)
        light.Coords = "Camera"
        light.Position = [-0.4 * side, 0.5 * side, 1.0 * side]
        light.FocalPoint = [0.0, 0.0, 0.0]


def show(isopoints, path):
    """Renders the isopoints as points lit by their normals and as wide as their splats."""
    view = simple.CreateView("RenderView")
    view.ViewSize = [1000, 800]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    light_both_sides(view)
    display = simple.Show(isopoints, view)
    display.Representation = "Surface"
    simple.ColorBy(display, None)
    display.DiffuseColor = display.AmbientColor = [0.85, 0.72, 0.5]
    simple.ResetCamera(view)
    camera = view.GetActiveCamera()
    camera.Elevation(25)
    camera.Azimuth(35)
    camera.OrthogonalizeViewUp()
    simple.ResetCamera(view)
    radii = isopoints.GetClientSideObject().GetOutput().GetPointData().GetArray("Radius")
    display.PointSize = point_size(view, vtk_to_numpy(radii))
    simple.SaveScreenshot(path, view)


def main(plugin):
    simple.LoadPlugin(plugin)
    path = os.environ.get("ISOPOINTS_FILE")
    if path:
        array = os.environ["ISOPOINTS_ARRAY"]
        isovalue = os.environ["ISOPOINTS_ISOVALUE"]
        source = file_samples(path, array, isovalue)
    else:
        array, isovalue = "distance", RADIUS
        source = sphere_samples()
        source.UpdatePipeline()

    isopoints = simple.ScatteredIsopoints(Input=source)
    isopoints.ContourBy = ["POINTS", array]
    isopoints.Isosurfaces = [float(isovalue)]
    start = time.perf_counter()
    isopoints.UpdatePipeline()
    seconds = time.perf_counter() - start

    output = isopoints.GetClientSideObject().GetOutput()
    count = output.GetNumberOfPoints()
    print("samples          %d" % source.GetDataInformation().GetNumberOfPoints())
    print("isopoints        %d" % count)
    print("seconds          %.3f" % seconds)
    if count == 0:
        limits = source.PointData[array].GetRange()
        fail("no isopoints: the values of %s lie within %g and %g" % (array, *limits))
    if not path:
        positions = vtk_to_numpy(output.GetPoints().GetData()).astype(float)
        deviation = np.abs(np.linalg.norm(positions - 0.5 * SIDE, axis=1) - RADIUS)
        print("largest deviation %.5f" % deviation.max())
        print("mean deviation    %.5f" % deviation.mean())

    simple.SaveData("isopoints.vtp", proxy=isopoints, DataMode="Binary")
    show(isopoints, "isosurface.png")
    print("wrote isopoints.vtp and isosurface.png")


if __name__ == "__main__":
    main(sys.argv[1])
