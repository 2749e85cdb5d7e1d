# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples for the scripts of the documents: `samples`, and the same in the file samples.vtp."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

positions = np.random.default_rng(1).uniform(-1.0, 1.0, (20_000, 3))
points = vtkPoints()
points.SetData(numpy_to_vtk(positions, deep=True))
density = numpy_to_vtk(np.linalg.norm(positions, axis=1), deep=True)
density.SetName("density")
samples = vtkPolyData()
samples.SetPoints(points)
samples.GetPointData().SetScalars(density)

writer = vtkXMLPolyDataWriter()
writer.SetFileName("samples.vtp")
writer.SetDataModeToBinary()
writer.SetInputData(samples)
writer.Write()
