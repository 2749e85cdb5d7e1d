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
from paraview.vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

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
    return producer_of(samples)


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


def disks(isopoints, corners=8):
    """The isopoints' splats as polygons, each with the normal of its isopoint."""
    data = isopoints.GetPointData()
    centers = vtk_to_numpy(isopoints.GetPoints().GetData()).astype(np.float32)
    normals = vtk_to_numpy(data.GetNormals())
    radii = vtk_to_numpy(data.GetArray("Radius"))
    # Any axis that is not nearly the normal gives a first direction across it.
    axes = np.eye(3, dtype=np.float32)[np.argmin(np.abs(normals), axis=1)]
    first = np.cross(normals, axes)
    first *= (radii / np.linalg.norm(first, axis=1))[:, None]
    second = np.cross(normals, first)
    angles = 2.0 * np.pi * np.arange(corners, dtype=np.float32) / corners
    positions = (
        centers[:, None]
        + np.cos(angles)[None, :, None] * first[:, None]
        + np.sin(angles)[None, :, None] * second[:, None]
    ).reshape(-1, 3)

    points = vtkPoints()
    points.SetData(numpy_to_vtk(positions, deep=True))
    polygons = vtkCellArray()
    polygons.SetData(
        numpy_to_vtkIdTypeArray(np.arange(0, len(positions) + 1, corners), deep=True),
        numpy_to_vtkIdTypeArray(np.arange(len(positions)), deep=True),
    )
    result = vtkPolyData()
    result.SetPoints(points)
    result.SetPolys(polygons)
    result.GetPointData().SetNormals(
        numpy_to_vtk(np.repeat(normals, corners, axis=0), deep=True)
    )
    return result


def producer_of(data):
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source


def show(isopoints, path):
    """Renders the isopoints' splats as lit disks, seen from an angle."""
    view = simple.CreateView("RenderView")
    view.ViewSize = [1000, 800]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    display = simple.Show(producer_of(disks(isopoints)), view)
    display.Representation = "Surface"
    display.DiffuseColor = display.AmbientColor = [0.85, 0.72, 0.5]
    simple.ResetCamera(view)
    camera = view.GetActiveCamera()
    camera.Elevation(25)
    camera.Azimuth(35)
    camera.OrthogonalizeViewUp()
    simple.ResetCamera(view)
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
    show(output, "isosurface.png")
    print("wrote isopoints.vtp and isosurface.png")


if __name__ == "__main__":
    main(sys.argv[1])
