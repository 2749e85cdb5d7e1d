# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes and reads data sets and pictures of VTK, runs filters, and compares their outputs."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_STRING, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import (
    vtkAMRBox, vtkCompositeDataSet, vtkMultiBlockDataSet, vtkOverlappingAMR, vtkPolyData, vtkUniformGrid)
from vtkmodules.vtkIOImage import vtkPNGReader


def named(name, values):
    if len(values) and isinstance(values[0], str):
        array = vtkStringArray()
        for value in values:
            array.InsertNextValue(value)
    else:
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    return array


def points_of(positions):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(positions), deep=True))
    return points


def cloud_of(positions, values=None, name="values"):
    data = vtkPolyData()
    data.SetPoints(points_of(positions))
    if values is not None:
        data.GetPointData().SetScalars(named(name, values))
    return data


def positions_in(data):
    return np.array([data.GetPoint(i) for i in range(data.GetNumberOfPoints())])


def centers_in(data):
    """The centers of cells that are boxes, NaN of empty cells."""
    cells = (data.GetCell(i) for i in range(data.GetNumberOfCells()))  # each may be the same object
    return np.array([np.reshape(cell.GetBounds(), (3, 2)).mean(axis=1) if cell.GetNumberOfPoints() else [np.nan] * 3
                     for cell in cells])


def blocks_of(*blocks):
    data = vtkMultiBlockDataSet()
    for i, block in enumerate(blocks):
        data.SetBlock(i, block)
    return data


def amr_of(name, values_of, boxes, is_here=lambda number: True):
    """Boxes (level, lowest index of a cell, cells along an edge) with values of their cells' centers. The coarsest
    cells have edges of length 0.1. Boxes that are not here have no data."""
    levels, counts = vtkOverlappingAMR(), [0] * (1 + max(level for level, _, _ in boxes))
    levels.Initialize(len(counts), [sum(box[0] == level for box in boxes) for level in range(len(counts))])
    levels.SetOrigin([0.0, 0.0, 0.0])
    levels.SetGridDescription(8)  # VTK_XYZ_GRID
    for number, (level, low, cells) in enumerate(boxes):
        spacing, index = 0.1 / 2**level, counts[level]
        counts[level] += 1
        levels.SetSpacing(level, 3 * [spacing])
        levels.SetAMRBox(level, index, vtkAMRBox(3 * [low], 3 * [low + cells - 1]))
        levels.SetRefinementRatio(level, 2)
        if is_here(number):
            grid = set_all(
                vtkUniformGrid(), Origin=3 * [low * spacing], Spacing=3 * [spacing], Dimensions=3 * [cells + 1])
            grid.GetCellData().AddArray(named(name, values_of(centers_in(grid))))
            levels.SetDataSet(level, index, grid)
    return levels


def leaves_of(data, **options):
    """The data sets of a composite in order, or the data set itself."""
    if not isinstance(data, vtkCompositeDataSet):
        return [data]
    iterator, found = data.NewIterator(), []
    iterator.SetSkipEmptyNodes(options.get("skips_empty", True))
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        found.append(iterator.GetCurrentDataObject())
        iterator.GoToNextItem()
    return found


def names_of(data):
    """The names of all blocks of a composite, those of inner nodes too. None stands for a block without a name."""
    iterator, found = data.NewIterator(), []
    iterator.SkipEmptyNodesOff()
    if hasattr(iterator, "VisitOnlyLeavesOff"):
        iterator.VisitOnlyLeavesOff()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        is_named = iterator.HasCurrentMetaData()
        found.append(iterator.GetCurrentMetaData().Get(vtkCompositeDataSet.NAME()) if is_named else None)
        iterator.GoToNextItem()
    return found


def as_array(image):
    """A picture as an array, its first row at the bottom."""
    width, height, _ = image.GetDimensions()
    scalars = vtk_to_numpy(image.GetPointData().GetScalars())
    return scalars.reshape(height, width, -1)[..., :3].astype(float)


def read_image(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    return as_array(reader.GetOutput())


def psnr(a, b):
    """Peak signal to noise ratio in decibels."""
    error = np.mean((a - b) ** 2)
    return np.inf if error == 0 else 10 * np.log10(255**2 / error)


def set_all(instance, **properties):
    """Calls the methods Set... of an object; a tuple has several arguments."""
    for name, value in properties.items():
        getattr(instance, "Set" + name)(*(value if isinstance(value, tuple) else (value,)))
    return instance


def configured(kind, data, isovalues=(), **properties):
    filter_ = set_all(kind(), InputDataObject=data)
    for i, isovalue in enumerate(isovalues):
        filter_.SetValue(i, isovalue)
    return set_all(filter_, **properties)


def updated(*arguments, **properties):
    filter_ = configured(*arguments, **properties)
    filter_.Update()
    return filter_


def observed(filter_):
    """The texts of a filter's events, as they arrive."""
    texts = {"ErrorEvent": [], "WarningEvent": [], "MessageEvent": []}
    for event, list_ in texts.items():
        def note(_caller, _event, text, list_=list_):
            list_.append(text)
        note.CallDataType = VTK_STRING
        filter_.AddObserver(event, note)
    return texts


def assert_same(test, ours, theirs):
    """Checks that leaves have the same class, points, cells, arrays and active arrays, and blocks the same names."""
    test.assertEqual(ours.GetClassName(), theirs.GetClassName())
    if isinstance(theirs, vtkCompositeDataSet):
        pair = [leaves_of(each, skips_empty=False) for each in (ours, theirs)]
        test.assertEqual(*([leaf is None for leaf in leaves] for leaves in pair))
        test.assertEqual(*map(names_of, (ours, theirs)))
        for leaves in zip(*pair):
            if leaves[0] is not None:
                assert_same(test, *leaves)
        return
    test.assertEqual(ours.GetNumberOfPoints(), theirs.GetNumberOfPoints())
    test.assertEqual(ours.GetNumberOfCells(), theirs.GetNumberOfCells())
    arrays = []
    if theirs.IsA("vtkPointSet") and theirs.GetNumberOfPoints():
        arrays.append([data.GetPoints().GetData() for data in (ours, theirs)])
    else:
        np.testing.assert_array_equal(*map(positions_in, (ours, theirs)))
    if theirs.IsA("vtkPolyData"):
        for kind in ("GetVerts", "GetLines", "GetPolys"):
            pair = [getattr(data, kind)() for data in (ours, theirs)]
            test.assertEqual(*(cells.GetNumberOfCells() for cells in pair), kind)
            if pair[1].GetNumberOfCells():
                arrays.append([cells.GetConnectivityArray() for cells in pair])
    for kind in ("GetPointData", "GetCellData"):
        found, expected = getattr(ours, kind)(), getattr(theirs, kind)()
        names = [expected.GetArrayName(i) for i in range(expected.GetNumberOfArrays()) if expected.GetArray(i)]
        test.assertEqual({found.GetArrayName(i) for i in range(found.GetNumberOfArrays()) if found.GetArray(i)},
                         set(names))
        arrays += [[data.GetArray(name) for data in (found, expected)] for name in names]
        for i in range(6):
            active = [data.GetAttribute(i) and data.GetAttribute(i).GetName() for data in (found, expected)]
            test.assertEqual(*active)
    for pair in arrays:
        ours, theirs = map(vtk_to_numpy, pair)
        test.assertEqual(ours.dtype, theirs.dtype, pair[1].GetName())
        test.assertEqual(ours.shape, theirs.shape, pair[1].GetName())
        test.assertEqual(ours.tobytes(), theirs.tobytes(), pair[1].GetName())
