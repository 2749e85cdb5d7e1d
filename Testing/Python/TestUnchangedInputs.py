# SPDX-License-Identifier: GPL-3.0-or-later
"""No filter changes its input, at its first update or at a later one with another property."""

import unittest

import numpy as np
from scatteredisopoints import (
    vtkIsopointSplatPolygons,
    vtkScatteredIsopointFilter,
    vtkScatteredIsosurfaceFilter,
)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet,
    vtkDataObject,
    vtkDataSetAttributes,
    vtkImageData,
    vtkMultiBlockDataSet,
    vtkPartitionedDataSetCollection,
    vtkPolyData,
)

# For each filter a property, and the values of the updates.
CHANGES = {
    vtkScatteredIsopointFilter: ("SetAngle", (54.7, 50.0, 60.0)),
    vtkScatteredIsosurfaceFilter: ("SetProjection", (3, 0, 1)),
    vtkIsopointSplatPolygons: ("SetRadiusScale", (1.0, 2.0, 0.5)),
}


def named(name, values):
    array = numpy_to_vtk(np.asarray(values), deep=True)
    array.SetName(name)
    return array


def add_fields(data):
    data.GetFieldData().AddArray(named("TimeValue", [0.25]))
    names = vtkStringArray()
    names.SetName("origin")
    names.InsertNextValue("a reader")
    data.GetFieldData().AddArray(names)


def add_arrays(data):
    """Values, normals and ghosts of the points, and fields."""
    count = data.GetNumberOfPoints()
    places = np.array([data.GetPoint(i) for i in range(count)])
    data.GetPointData().SetScalars(named("f", np.linalg.norm(places - 0.5, axis=1) - 0.3))
    data.GetPointData().SetNormals(named("n", places.astype(np.float32)))
    ghosts = vtkUnsignedCharArray()
    ghosts.SetName(vtkDataSetAttributes.GhostArrayName())
    for i in range(count):
        ghosts.InsertNextValue(1 if i % 50 == 0 else 0)
    data.GetPointData().AddArray(ghosts)
    add_fields(data)
    return data


def cloud(seed):
    points = vtkPoints()
    points.SetData(named("places", np.random.default_rng(seed).random((2000, 3))))
    data = vtkPolyData()
    data.SetPoints(points)
    return add_arrays(data)


def image():
    data = vtkImageData()
    data.SetDimensions(12, 12, 12)
    data.SetSpacing(0.09, 0.09, 0.09)
    return add_arrays(data)


def blocks():
    data = vtkMultiBlockDataSet()
    data.SetBlock(0, cloud(1))
    data.SetBlock(2, image())
    data.GetMetaData(0).Set(vtkCompositeDataSet.NAME(), "left")
    add_fields(data)
    return data


def collection():
    data = vtkPartitionedDataSetCollection()
    data.SetPartition(0, 0, cloud(1))
    data.SetPartition(1, 0, cloud(2))
    add_fields(data)
    return data


def content(data):
    """All that a data object holds, as values that can be compared."""
    if data is None:
        return None
    result = [data.GetClassName()]
    for association in range(vtkDataObject.NUMBER_OF_ASSOCIATIONS):
        attributes = data.GetAttributesAsFieldData(association)
        for i in range(attributes.GetNumberOfArrays() if attributes else 0):
            array = attributes.GetAbstractArray(i)
            values = (
                [array.GetValue(k) for k in range(array.GetNumberOfValues())]
                if isinstance(array, vtkStringArray)
                else vtk_to_numpy(array).tobytes()
            )
            result.append((association, array.GetName(), array.GetNumberOfTuples(), values))
    if isinstance(data, vtkCompositeDataSet):
        iterator = data.NewIterator()
        iterator.SkipEmptyNodesOff()
        iterator.InitTraversal()
        while not iterator.IsDoneWithTraversal():
            name = data.GetMetaData(iterator).Get(vtkCompositeDataSet.NAME())
            result.append((name, content(iterator.GetCurrentDataObject())))
            iterator.GoToNextItem()
    else:
        result.append([data.GetPoint(i) for i in range(data.GetNumberOfPoints())])
        result.append(data.GetNumberOfCells())
    return result


class UnchangedInputs(unittest.TestCase):
    def test_every_filter_and_input(self):
        for filter_class, (method, values) in CHANGES.items():
            for make in (lambda: cloud(1), image, blocks, collection):
                data = make()
                before = content(data)
                self.assertIn("TimeValue", str(before))
                contour = filter_class()
                contour.SetInputDataObject(data)
                for update, value in enumerate(values):
                    with self.subTest(filter_class.__name__, data=data.GetClassName(), update=update):
                        getattr(contour, method)(value)
                        contour.Update()
                        output = contour.GetOutputDataObject(0)
                        self.assertGreater(output.GetNumberOfElements(vtkDataObject.POINT), 0)
                        self.assertEqual(content(data), before)
                output.Initialize()
                self.assertEqual(content(data), before)


if __name__ == "__main__":
    unittest.main(verbosity=2)
