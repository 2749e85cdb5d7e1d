# SPDX-License-Identifier: GPL-3.0-or-later
"""The filter's properties in scripts that use VTK's Python interface."""

import unittest

from scatteredisopoints import vtkScatteredIsopointFilter
from vtkmodules.vtkCommonDataModel import vtkImageData


class FilterTest(unittest.TestCase):
    def test_defaults_and_properties(self):
        isopoints = vtkScatteredIsopointFilter()
        self.assertEqual(isopoints.GetAngle(), 54.7)
        self.assertEqual(isopoints.GetNumberOfNeighbors(), 12)
        self.assertEqual(isopoints.GetProjection(), isopoints.CUBIC_FIT)
        self.assertEqual(isopoints.GetNumberOfContours(), 1)
        self.assertEqual(isopoints.GetValue(0), 0.0)
        for name in ("ComputeNormals", "ComputeSplats", "ComputeScalars", "KeepTree"):
            self.assertEqual(getattr(isopoints, "Get" + name)(), 1)
            getattr(isopoints, name + "Off")()
            self.assertEqual(getattr(isopoints, "Get" + name)(), 0)
        self.assertEqual(isopoints.GetMinimumSpacing(), 0.0)
        isopoints.SetMinimumSpacing(2.0)
        self.assertEqual(isopoints.GetMinimumSpacing(), 1.0)
        isopoints.SetMinimumSpacing(-1.0)
        self.assertEqual(isopoints.GetMinimumSpacing(), 0.0)
        isopoints.SetNumberOfNeighbors(1)
        self.assertEqual(isopoints.GetNumberOfNeighbors(), 3)
        isopoints.GenerateValues(3, 0.0, 1.0)
        self.assertEqual([isopoints.GetValue(i) for i in range(3)], [0.0, 0.5, 1.0])

    def test_without_isovalues_the_output_is_empty(self):
        image = vtkImageData()
        image.SetDimensions(5, 5, 5)
        image.AllocateScalars(10, 1)  # VTK_FLOAT
        isopoints = vtkScatteredIsopointFilter()
        isopoints.SetNumberOfContours(0)
        isopoints.SetInputData(image)
        isopoints.Update()
        self.assertEqual(isopoints.GetOutput().GetNumberOfPoints(), 0)

    def test_prints(self):
        self.assertIn("Angle: 54.7", str(vtkScatteredIsopointFilter()))


if __name__ == "__main__":
    unittest.main(verbosity=2)
