# SPDX-License-Identifier: GPL-3.0-or-later
"""No filter changes its input, at its first update or at a later one with another property."""

import itertools
import unittest

import numpy as np
import scatteredisopoints
from scatteredisopoints import _vtk
from vtk_data import blocks_of, cloud_of, configured, leaves_of, named, names_of, positions_in
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet, vtkDataObject, vtkDataSetAttributes, vtkImageData, vtkPartitionedDataSetCollection)

# For each filter a property, and the values of the updates.
CHANGES = {
    "vtkScatteredIsopointFilter": ("SetAngle", (54.7, 50.0, 60.0)),
    "vtkScatteredIsosurfaceFilter": ("SetProjection", (3, 0, 1)),
    "vtkIsopointSplatPolygons": ("SetRadiusScale", (1.0, 2.0, 0.5)),
}


def add_arrays(data):
    """Adds values, normals and ghosts of the points, and field data."""
    if not isinstance(data, vtkCompositeDataSet):
        places = positions_in(data)
        ghosts = (np.arange(len(places)) % 50 == 0).astype(np.uint8)
        data.GetPointData().SetScalars(named("f", np.linalg.norm(places - 0.5, axis=1) - 0.3))
        data.GetPointData().SetNormals(named("n", places.astype(np.float32)))
        data.GetPointData().AddArray(named(vtkDataSetAttributes.GhostArrayName(), ghosts))
    for name, value in (("TimeValue", 0.25), ("origin", "a reader")):
        data.GetFieldData().AddArray(named(name, [value]))
    return data


def cloud(seed=1):
    return add_arrays(cloud_of(np.random.default_rng(seed).random((2000, 3))))


def image():
    data = vtkImageData()
    data.SetDimensions(12, 12, 12)
    data.SetSpacing(0.09, 0.09, 0.09)
    return add_arrays(data)


def blocks():
    data = blocks_of(cloud(), None, image())
    data.GetMetaData(0).Set(vtkCompositeDataSet.NAME(), "left")
    return add_arrays(data)


def collection():
    data = vtkPartitionedDataSetCollection()
    for i in range(2):
        data.SetPartition(i, 0, cloud(i))
    return add_arrays(data)


def content(data):
    """All that a data object holds, as values that can be compared."""
    if data is None:
        return None
    result = [data.GetClassName()]
    for association in range(vtkDataObject.NUMBER_OF_ASSOCIATIONS):
        attributes = data.GetAttributesAsFieldData(association)
        for i in range(attributes.GetNumberOfArrays() if attributes else 0):
            array = attributes.GetAbstractArray(i)
            is_text = isinstance(array, vtkStringArray)
            values = ([array.GetValue(k) for k in range(array.GetNumberOfValues())] if is_text
                      else vtk_to_numpy(array).tobytes())
            result.append((association, array.GetName(), array.GetNumberOfTuples(), values))
    if isinstance(data, vtkCompositeDataSet):
        return [result, names_of(data), [content(leaf) for leaf in leaves_of(data, skips_empty=False)]]
    return [result, positions_in(data).tolist(), data.GetNumberOfCells()]


class UnchangedInputs(unittest.TestCase):
    def test_every_filter_and_input(self):
        for module, name in itertools.product((scatteredisopoints, _vtk), CHANGES):
            filter_class, (method, values) = getattr(module, name), CHANGES[name]
            for make in (cloud, image, blocks, collection):
                data = make()
                before = content(data)
                self.assertIn("TimeValue", str(before))
                self.assertEqual("left" in str(before), make is blocks)
                contour = configured(filter_class, data)
                for update, value in enumerate(values):
                    with self.subTest(filter_class, data=data.GetClassName(), update=update):
                        getattr(contour, method)(value)
                        contour.Update()
                        output = contour.GetOutputDataObject(0)
                        self.assertGreater(output.GetNumberOfElements(vtkDataObject.POINT), 0)
                        self.assertEqual(content(data), before)
                output.Initialize()
                self.assertEqual(content(data), before)


if __name__ == "__main__":
    unittest.main(verbosity=2)
