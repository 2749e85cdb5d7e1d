# SPDX-License-Identifier: GPL-3.0-or-later
"""Every kind of data that ParaView offers to the filter, through the plugin: what the property
panel lists, and that the surface is where Contour's is."""

import os
import sys

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

from scripting import FOLDER, check

def contoured(source, association, array, isovalue):
    source.UpdatePipeline()
    isopoints = simple.ScatteredIsopoints(Input=source)
    domain = isopoints.SMProxy.GetProperty("SelectInputScalars").GetDomain("array_list")
    listed = [domain.GetString(i) for i in range(domain.GetNumberOfStrings())]
    check(array in listed, "%s is listed among %s" % (array, listed))
    isopoints.ContourBy = [association, array]
    isopoints.Isosurfaces = [isovalue]
    isopoints.UpdatePipeline()
    return isopoints


def positions(proxy):
    data = servermanager.Fetch(proxy)
    return vtk_to_numpy(data.GetPoints().GetData()) if data.GetNumberOfPoints() else np.empty((0, 3))


def distances(proxy):
    return np.linalg.norm(positions(proxy), axis=1)


def add_distance(source, association):
    calculator = simple.Calculator(Input=source)
    calculator.AttributeType = association
    calculator.ResultArrayName = "r"
    calculator.Function = "sqrt(coordsX^2+coordsY^2+coordsZ^2)"
    return calculator


def table_of_points():
    path = os.path.join(FOLDER, "samples.csv")
    samples = np.random.default_rng(3).random((20000, 3)) * 2.0 - 1.0
    table = np.column_stack([samples, np.linalg.norm(samples, axis=1)])
    np.savetxt(path, table, delimiter=",", header="x,y,z,r", comments="")
    reader = simple.CSVReader(FileName=[path])
    return simple.TableToPoints(Input=reader, XColumn="x", YColumn="y", ZColumn="z")


def check_shell(isopoints, radius, tolerance, what):
    found = distances(isopoints)
    check(len(found) > 300, what + ": points")
    check(np.abs(found - radius).max() < tolerance, what + ": all on the sphere")


def main(plugin):
    simple.LoadPlugin(plugin)
    wavelet = simple.Wavelet()
    points = add_distance(wavelet, "Point Data")
    check_shell(contoured(points, "POINTS", "r", 7.05), 7.05, 0.1, "image, point data")

    cells = simple.PointDatatoCellData(Input=points)
    check_shell(contoured(cells, "CELLS", "r", 7.05), 7.05, 0.3, "image, cell data")

    table = table_of_points()
    check_shell(contoured(table, "POINTS", "r", 0.7), 0.7, 0.02, "table")

    half = simple.ExtractSubset(Input=points, VOI=[-10, 0, -10, 10, -10, 10])
    other = simple.ExtractSubset(Input=points, VOI=[0, 10, -10, 10, -10, 10])
    blocks = simple.GroupDatasets(Input=[half, other])
    together = contoured(blocks, "POINTS", "r", 7.05)
    check_shell(together, 7.05, 0.1, "blocks")
    alone = contoured(points, "POINTS", "r", 7.05)
    check(len(np.unique(positions(together), axis=0)) == len(positions(together)),
          "no point of the doubled faces is doubled")
    together.ContourBlocks = 1
    together.UpdatePipeline()
    information = together.GetDataInformation()
    check(information.DataInformation.IsCompositeDataSet(), "block by block is composite")
    check(information.GetNumberOfPoints() > len(distances(alone)), "each block has the shared face")

    trees = simple.HyperTreeGridRandom(Dimensions=[7, 7, 7], MaxDepth=3, Seed=7)
    leaves = contoured(trees, "CELLS", "Depth", 1.5)
    check(len(distances(leaves)) > 100, "leaves of a hyper tree grid")
    check((leaves.PointData["Depth"].GetRange()) == (1.5, 1.5), "the isovalue on leaves")


main(sys.argv[1])
print("passed")
