# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders an isosurface of random samples of a gyroid with VTK alone. Writes splats.png.

Needs the compiled classes, as in the Debian package, and the interpreter that they were built for."""

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, registers the rendering classes
from scatteredisopoints import vtkIsopointSplatMapper, vtkScatteredIsopointFilter
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkRenderer,
    vtkRenderWindow,
    vtkWindowToImageFilter,
)

positions = np.random.default_rng(1).uniform(-1, 1, (300_000, 3))
x, y, z = 4.0 * positions.T
values = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
points = vtkPoints()
points.SetData(numpy_to_vtk(positions, deep=True))
samples = vtkPolyData()
samples.SetPoints(points)
samples.GetPointData().SetScalars(numpy_to_vtk(values, deep=True))

isopoints = vtkScatteredIsopointFilter()
isopoints.SetInputData(samples)
isopoints.SetValue(0, 0.0)

mapper = vtkIsopointSplatMapper()
mapper.SetInputConnection(isopoints.GetOutputPort())
mapper.ScalarVisibilityOff()
actor = vtkActor()
actor.SetMapper(mapper)
actor.GetProperty().SetColor(0.85, 0.72, 0.5)
renderer = vtkRenderer()
renderer.AddActor(actor)
renderer.SetBackground(1, 1, 1)
renderer.GetActiveCamera().SetPosition(3, -4, 3)
renderer.ResetCamera()
window = vtkRenderWindow()
window.SetSize(600, 600)
window.SetOffScreenRendering(1)
window.AddRenderer(renderer)
window.Render()

picture = vtkWindowToImageFilter()
picture.SetInput(window)
writer = vtkPNGWriter()
writer.SetFileName("splats.png")
writer.SetInputConnection(picture.GetOutputPort())
writer.Write()
