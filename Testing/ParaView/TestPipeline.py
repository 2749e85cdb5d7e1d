# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin in ParaView: a pipeline from a file to a picture, as a user's script builds it."""

import os
import sys

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from scripting import FOLDER, check, look, make_view, pixels

def write_cloud(path):
    positions = np.random.default_rng(1).random((40000, 3)) * 2.0 - 1.0
    points = vtkPoints()
    points.SetData(numpy_to_vtk(positions, deep=True))
    data = vtkPolyData()
    data.SetPoints(points)
    distances = np.linalg.norm(positions, axis=1)
    gaps = np.where(np.arange(40000) % 100 == 0, np.nan, distances)
    for name, values in (("noise", positions[:, 0]), ("r", distances), ("gaps", gaps)):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(path)
    writer.SetDataModeToBinary()
    writer.SetInputData(data)
    check(writer.Write() == 1, "writing " + path)


def check_counters(reader):
    """They are properties of both filters, and those of the last update."""
    for create in (simple.ScatteredIsopoints, simple.ScatteredIsosurface):
        counted = create(Input=reader, ContourBy=["POINTS", "gaps"], Isosurfaces=[0.5])
        for projection in ("None", "Cubic fit", "None"):
            counted.Projection = projection
            counted.UpdatePipeline()
            points = counted.GetDataInformation().GetNumberOfPoints()
            check(counted.NumberOfSkippedSamples == 400, "skipped samples")
            unprojected = counted.NumberOfUnprojectedPoints
            check((unprojected == points) == (projection == "None"),
                  f"{unprojected} points unprojected of {points} by {projection}")
        for name in ("NumberOfSkippedSamples", "NumberOfUnprojectedPoints"):
            check(counted.SMProxy.GetProperty(name).GetPanelVisibility() == "default", name)
        simple.Delete(counted)


def check_triangles(reader):
    """The other filter, with filters of meshes behind it, as a user's script would have them."""
    surface = simple.ScatteredIsosurface(Input=reader)
    surface.ContourBy = ["POINTS", "r"]
    surface.Isosurfaces = [0.5, 0.75]
    surface.UpdatePipeline()
    information = surface.GetDataInformation().DataInformation
    check(information.GetNumberOfCells() > information.GetNumberOfPoints(), "triangles")
    check(list(surface.PointData["r"].GetRange()) == [0.5, 0.75], "the isovalues of triangles")
    check("Radius" not in surface.PointData.keys(), "no radii")
    edges = simple.FeatureEdges(Input=surface)
    edges.FeatureEdges = 0
    edges.UpdatePipeline()
    check(edges.GetDataInformation().GetNumberOfCells() == 0, "two closed surfaces")
    surface.Isosurfaces = [0.75]
    sizes = simple.IntegrateVariables(Input=surface)
    sizes.UpdatePipeline()
    area = sizes.CellData["Area"].GetRange()[0]
    check(abs(area / (4.0 * np.pi * 0.75**2) - 1.0) < 0.005, f"the area {area}")
    view = simple.CreateView("RenderView")
    check(simple.Show(surface, view).Representation == "Surface", "the default representation")
    simple.Delete(view)


def main(plugin):
    simple.LoadPlugin(plugin)
    cloud = os.path.join(FOLDER, "cloud.vtp")
    write_cloud(cloud)

    reader = simple.OpenDataFile(cloud)
    isopoints = simple.ScatteredIsopoints(Input=reader)
    isopoints.ContourBy = ["POINTS", "r"]
    isopoints.Isosurfaces = [0.5, 0.75]
    isopoints.UpdatePipeline()
    check(isopoints.Angle == 54.7, "the default angle")
    check(list(isopoints.PointData["r"].GetRange()) == [0.5, 0.75], "the isovalues")
    check(isopoints.PointData["Normals"].GetNumberOfComponents() == 3, "normals")
    check(isopoints.PointData["Radius"].GetRange()[1] > 0.0, "radii")
    check(isopoints.PointData["noise"] is not None, "other arrays")
    check_counters(reader)

    check_triangles(reader)

    view = make_view(300)
    isopoints.Isosurfaces = [0.75]
    display = simple.Show(isopoints, view)
    check(display.Representation == "Isopoint Splats", "the default representation")
    simple.ColorBy(display, None)
    display.DiffuseColor = display.AmbientColor = [1.0, 1.0, 1.0]
    look(view, 5.0, 1.0)

    image = pixels(view)
    rows, columns = np.mgrid[0:300, 0:300]
    distance = np.hypot(rows - 149.5, columns - 149.5) / 150.0
    background = (image == [0, 0, 255]).all(axis=2)
    check(background[distance > 0.95].all(), "nothing far outside the sphere")
    check(not background[distance < 0.74].any(), "no hole in the sphere")


main(sys.argv[1])
print("passed")
