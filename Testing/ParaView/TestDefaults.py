# SPDX-License-Identifier: GPL-3.0-or-later
"""What the filters do as they come: the array, the isovalue and what is computed by default."""

import os
import sys

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringArray, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet

from scripting import FOLDER, check


def filters():
    return simple.ScatteredIsopoints, simple.ScatteredIsosurface


def lattice(association, **arrays):
    """A lattice with arrays of points or cells, in their order, named here by functions."""
    image = vtkImageData()
    image.SetDimensions(*([13] * 3 if association == "CELLS" else [12] * 3))
    places = np.stack(np.meshgrid(*3 * [np.arange(12.0)], indexing="ij"), -1).reshape(-1, 3)
    attributes = image.GetCellData() if association == "CELLS" else image.GetPointData()
    for name, function in arrays.items():
        values = numpy_to_vtk(np.ascontiguousarray(function(places)), deep=True)
        values.SetName(name)
        attributes.AddArray(values)
    return image


def produced(data):
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source


def distance(places):
    return np.linalg.norm(places - 5.6, axis=1)


def number(value):
    return lambda places: np.full(len(places), value)


def first_array_with_a_range():
    """As in an AMR, whose first array is the number of a block."""
    for association in ("POINTS", "CELLS"):
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, lattice(association, BlockId=number(0), distance=distance, z=distance))
        for create in filters():
            isopoints = create(Input=produced(blocks))
            chosen = list(isopoints.ContourBy)
            check(chosen == [association, "distance"], f"not constant: {chosen}")
            low, high = distance(np.zeros((1, 3)))[0], distance(np.full((1, 3), 6.0))[0]
            check(len(isopoints.Isosurfaces) == 1 and high < isopoints.Isosurfaces[0] < low,
                  f"an isovalue within the range: {isopoints.Isosurfaces}")
            isopoints.UpdatePipeline()
            check(isopoints.GetDataInformation().GetNumberOfPoints() > 100, "points")


def ids_and_ghosts_come_last():
    """As in finite elements, where ids are the first arrays by name."""
    for association in ("POINTS", "CELLS"):
        arrays = dict(GlobalElementId=lambda p: np.arange(len(p)), Nodes=lambda p: np.arange(len(p)),
                      Pedigree=lambda p: np.arange(len(p)), stress=distance,
                      vtkGhostType=lambda p: (p[:, 0] < 2).astype(np.uint8))
        data = lattice(association, **arrays)
        attributes = data.GetCellData() if association == "CELLS" else data.GetPointData()
        attributes.SetActiveGlobalIds("Nodes")
        attributes.SetActivePedigreeIds("Pedigree")
        for create in filters():
            chosen = list(create(Input=produced(data)).ContourBy)
            check(chosen == [association, "stress"], f"no ids: {chosen}")


def offered(isopoints):
    arrays = isopoints.SMProxy.GetProperty("SelectInputScalars").FindDomain("vtkSMArrayListDomain")
    return [arrays.GetString(i) for i in range(arrays.GetNumberOfStrings())]


def arrays_without_isosurfaces_are_not_offered():
    """Strings, ghost marks, and arrays without a number."""
    for association in ("POINTS", "CELLS"):
        ghosts = dict(vtkGhostType=lambda p: (p[:, 0] < 2).astype(np.uint8))
        data = lattice(association, **ghosts, none=number(np.nan), some=lambda p: np.where(
            p[:, 0] < 2, np.nan, distance(p)))
        names = vtkStringArray()
        names.SetName("names")
        names.SetNumberOfValues(12**3)
        attributes = data.GetCellData() if association == "CELLS" else data.GetPointData()
        attributes.AddArray(names)
        for create in filters():
            isopoints = create(Input=produced(data))
            check(offered(isopoints) == ["some"], f"offered: {offered(isopoints)}")
            check(isopoints.ContourBy[1] == "some", "the default is among them")
            without = create(Input=produced(lattice(association, **ghosts)))
            check(not offered(without) and not without.ContourBy[1], "no ghost marks")
            check("load point or cell arrays in the reader" in messages_of(without.UpdatePipeline),
                  "what to do without arrays")


def messages_of(function):
    """What is reported meanwhile."""
    usual, collecting = vtkOutputWindow.GetInstance(), vtkStringOutputWindow()
    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkOutputWindow.SetInstance(collecting)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    try:
        function()
    finally:
        vtkOutputWindow.SetInstance(usual)
        vtkLogger.SetStderrVerbosity(verbosity)
    return collecting.GetOutput()


def triangles_are_saved_as_stl():
    """Isopoints have none, which is said."""
    source = produced(lattice("POINTS", distance=distance))
    for create, words in zip(filters(), ("Save Scattered Isosurface", "")):
        isopoints = create(Input=source)
        isopoints.UpdatePipeline()
        said = messages_of(lambda: simple.SaveData(os.path.join(FOLDER, "surface.stl"), isopoints))
        check(words in said and bool(said) == bool(words), f"said of {isopoints}: {said}")


def active_scalars_come_first_unless_constant():
    data = lattice("POINTS", BlockId=number(0), first=distance, second=distance)
    data.GetPointData().SetActiveScalars("second")
    check(simple.ScatteredIsopoints(Input=produced(data)).ContourBy[1] == "second", "active")
    data.GetPointData().SetActiveScalars("BlockId")
    check(simple.ScatteredIsopoints(Input=produced(data)).ContourBy[1] == "first", "constant")
    constant = lattice("POINTS", BlockId=number(0))
    check(simple.ScatteredIsopoints(Input=produced(constant)).ContourBy[1] == "BlockId", "alone")


def input_matters_rather_than_the_active_source():
    named = produced(lattice("POINTS", named=distance))
    other = produced(lattice("POINTS", other=distance))
    for create in filters():
        simple.SetActiveSource(other)
        chosen = list(create(Input=named).ContourBy)
        check(chosen == ["POINTS", "named"], f"the array of the input: {chosen}")
        both = produced(lattice("POINTS", first=distance, named=distance))
        simple.SetActiveSource(named)
        check(create(Input=both).ContourBy[1] == "first", "the first array of the input")
        simple.SetActiveSource(named)
        chosen = create(Input=both, ContourBy=["POINTS", "named"]).ContourBy[1]
        check(chosen == "named", "an array that is given")
        kept = create(Input=named, ContourBy=["POINTS", "named"])
        kept.Input = both
        check(kept.ContourBy[1] == "named", "a choice that both inputs have")


def isovalue_follows_the_array():
    """As long as nobody has chosen one."""
    data = lattice("POINTS", first=distance, large=lambda p: 1000 * distance(p))
    for create in filters():
        isopoints = create(Input=produced(data))
        first = isopoints.Isosurfaces[0]
        isopoints.ContourBy = ["POINTS", "large"]
        check(np.isclose(isopoints.Isosurfaces[0], 1000 * first), "the middle of the other range")
        isopoints.UpdatePipeline()
        check(isopoints.GetDataInformation().GetNumberOfPoints() > 100, "points")
        isopoints.ContourBy = ["POINTS", "first"]
        check(isopoints.Isosurfaces[0] == first, "and back")
        isopoints.Isosurfaces = [4.25]
        isopoints.ContourBy = ["POINTS", "large"]
        check(list(isopoints.Isosurfaces) == [4.25], "a choice stays")
        isopoints.Isosurfaces = [3000.0, 4000.0]
        isopoints.ContourBy = ["POINTS", "first"]
        check(list(isopoints.Isosurfaces) == [3000.0, 4000.0], "several stay")
        given = create(Input=produced(data), ContourBy=["POINTS", "large"], Isosurfaces=[first])
        check(list(given.Isosurfaces) == [first], "one that is given with the array stays")


def panel():
    for create in filters():
        drop_gaps = create(Input=simple.Wavelet()).SMProxy.GetProperty("DropGaps")
        check(drop_gaps.GetPanelVisibility() == "default", "DropGaps")
        check(drop_gaps.GetElement(0) == 1, "gaps are dropped")
    points, triangles = (create(Input=simple.Wavelet()).SMProxy.GetProperty("Regularize")
                         for create in filters())
    check(points is None and triangles.GetPanelVisibility() == "default", "Regularize")
    check(triangles.GetElement(0) == 1, "triangles are regularized")


def main(plugin):
    simple.LoadPlugin(plugin)
    first_array_with_a_range()
    ids_and_ghosts_come_last()
    arrays_without_isosurfaces_are_not_offered()
    triangles_are_saved_as_stl()
    active_scalars_come_first_unless_constant()
    input_matters_rather_than_the_active_source()
    isovalue_follows_the_array()
    panel()


main(sys.argv[1])
print("passed")
