# SPDX-License-Identifier: GPL-3.0-or-later
"""Computes isopoints of samples and renders them: demo.py PLUGIN, for pvbatch. Writes isopoints.vtp and
isosurface.png.

The environment names the file (ISOPOINTS_FILE, in any format that ParaView reads), the array
(ISOPOINTS_ARRAY) and the isovalue (ISOPOINTS_ISOVALUE). If splats leave holes between the samples,
triangles.vtp and triangles.png are written as well. By default the samples are random positions in a
cube of side 200, with the distance to its center as values, so that errors are known; comparison.png is
written too. If ISOPOINTS_FILTER is "triangles", writes triangles.vtp and isosurface.png instead.
"""

import os
import sys
import tempfile
import time

import numpy as np
from paraview import simple
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter

SIDE = 200.0
RADIUS = 70.0
SAMPLE_COUNT = 1_000_000


def say(message):
    """Prints at once. pvbatch's own sys.stdout is shown only at the end."""
    print(message, file=sys.__stdout__, flush=True)


def fail(message):
    sys.exit("demo: " + message)


def sphere_samples():
    """Random samples of the distance to the center of a cube."""
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
    """The point data of a file, with blocks merged and cell data at the cells' centers."""
    if not os.path.isfile(path):
        fail("there is no file " + path)
    try:
        finite = np.isfinite(float(isovalue))
    except ValueError:
        finite = False
    if not finite:
        fail("the isovalue " + isovalue + " is not a finite number")
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
            path + " contains no points that ParaView can read. Debian's ParaView cannot read VTK XML"
            " files with appended data: write them with inline data (SetDataModeToBinary)."
        )
    if array not in source.PointData.keys():
        if array not in source.CellData.keys():
            fail(
                "%s has no array named %s; its point arrays are %s, its cell arrays are %s"
                % (path, array, source.PointData.keys(), source.CellData.keys())
            )
        source = simple.CellCenters(Input=source)
        source.UpdatePipeline()
    return source


def producer_of(data):
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source


def on_a_grid(source, array, isovalue):
    """The alternative without isopoints: resampling to a grid of 100^3 nodes, ParaView's default."""
    grid = simple.PointVolumeInterpolator(Input=source, Source="Bounded Volume")
    grid.Kernel = "LinearKernel"
    grid.Kernel.KernelFootprint = "N Closest"
    grid.Source.Resolution = [100, 100, 100]
    contour = simple.Contour(Input=grid)
    contour.ContourBy = ["POINTS", array]
    contour.Isosurfaces = [isovalue]
    return contour


def show(source, view, representation):
    display = simple.Show(source, view)
    display.SetRepresentationType(representation)
    if representation == "Point Gaussian":
        display.ShaderPreset = "Plain circle"
        display.ScaleByArray = 1
        display.SetScaleArray = ["POINTS", "Radius"]
        display.UseScaleFunction = 0
        display.GaussianRadius = 1.0
        display.Emissive = 0
    display.ColorArrayName = ["POINTS", ""]
    display.DiffuseColor = display.AmbientColor = [0.85, 0.72, 0.5]


def look(view, bounds):
    """Places the camera obliquely above, with these bounds in view: the same for all pictures compared."""
    view.ResetCamera(bounds)
    camera = view.GetActiveCamera()
    camera.Elevation(25)
    camera.Azimuth(35)
    camera.OrthogonalizeViewUp()
    view.ResetCamera(bounds)
    camera.Zoom(1.2)


def picture(source, representation, path, size, bounds):
    view = simple.CreateView("RenderView")
    view.ViewSize = size
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    show(source, view, representation)
    look(view, bounds)
    simple.SaveScreenshot(path, view, ImageResolution=size)
    simple.Delete(view)


def compare(pictures, bounds, path):
    """Writes pictures of pairs (source, representation) side by side, from one camera."""
    parts = []
    with tempfile.TemporaryDirectory() as folder:
        for i, (source, representation) in enumerate(pictures):
            say("  " + source.GetXMLLabel() + ", " + representation)
            part = os.path.join(folder, "%d.png" % i)
            picture(source, representation, part, [500, 500], bounds)
            reader = vtkPNGReader()
            reader.SetFileName(part)
            reader.Update()
            image = reader.GetOutput()
            width, height, _ = image.GetDimensions()
            scalars = vtk_to_numpy(image.GetPointData().GetScalars())
            parts.append(scalars.reshape(height, width, -1))
    row = np.concatenate(parts, axis=1)
    image = vtkImageData()
    image.SetDimensions(row.shape[1], row.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(row.reshape(-1, row.shape[2]), deep=True))
    writer = vtkPNGWriter()
    writer.SetInputData(image)
    writer.SetFileName(path)
    writer.Write()


def contoured(source, array, isovalue, is_mesh):
    """The updated filter."""
    filter_ = (simple.ScatteredIsosurface if is_mesh else simple.ScatteredIsopoints)(Input=source)
    filter_.ContourBy = ["POINTS", array]
    filter_.Isosurfaces = [isovalue]

    def warn(_, __, text):
        say("warning: " + text.split("): ", 1)[-1].strip())  # without the names of the source file and object

    warn.CallDataType = "string0"
    filter_.GetClientSideObject().AddObserver("WarningEvent", warn)
    start = time.perf_counter()
    filter_.UpdatePipeline()
    seconds = time.perf_counter() - start
    output = filter_.GetClientSideObject().GetOutputDataObject(0)
    say("samples           %d" % source.GetDataInformation().GetNumberOfPoints())
    if is_mesh:
        say("triangles         %d" % output.GetNumberOfPolys())
    say("%s         %d" % ("vertices " if is_mesh else "isopoints", output.GetNumberOfPoints()))
    say("seconds           %.3f" % seconds)
    return filter_


def draw(surface, is_mesh, path, bounds):
    """Writes a surface and its picture. @returns the names of the files"""
    name = "triangles.vtp" if is_mesh else "isopoints.vtp"
    simple.SaveData(name, proxy=surface, DataMode="Binary")
    say("drawing " + path)
    picture(surface, "Surface" if is_mesh else "Isopoint Splats", path, [1000, 800], bounds)
    return [name, path]


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

    is_mesh = os.environ.get("ISOPOINTS_FILTER") == "triangles"
    isopoints = contoured(source, array, float(isovalue), is_mesh)
    output = isopoints.GetClientSideObject().GetOutputDataObject(0)
    if output.GetNumberOfPoints() == 0:
        limits = source.PointData[array].GetRange()
        fail("there are no isopoints: the values of %s range from %g to %g" % (array, *limits))
    if not path:
        positions = vtk_to_numpy(output.GetPoints().GetData()).astype(float)
        deviation = np.abs(np.linalg.norm(positions - 0.5 * SIDE, axis=1) - RADIUS)
        say("largest deviation %.5f" % deviation.max())
        say("mean deviation    %.5f" % deviation.mean())

    bounds = output.GetBounds()
    written = draw(isopoints, is_mesh, "isosurface.png", bounds)
    isopoints.SMProxy.UpdatePropertyInformation()
    if not is_mesh and isopoints.SMProxy.GetProperty("AreSplatsApart").GetElement(0):
        say("isosurface.png shows splats, which leave holes between these samples; triangles.png will show triangles")
        triangles = contoured(source, array, float(isovalue), True)
        written += draw(triangles, True, "triangles.png", bounds)
    if not path and not is_mesh:
        say(
            "drawing comparison.png: from left to right splats, Point Gaussian, and Contour of the samples"
            " resampled to a grid of 100^3 nodes"
        )
        compare(
            (
                (isopoints, "Isopoint Splats"),
                (isopoints, "Point Gaussian"),
                (on_a_grid(source, array, isovalue), "Surface"),
            ),
            bounds,
            "comparison.png",
        )
        written.append("comparison.png")
    say("written:")
    for name in written:
        say("  " + os.path.abspath(name))


if __name__ == "__main__":
    main(sys.argv[1])
