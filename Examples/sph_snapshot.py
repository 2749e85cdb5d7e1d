# SPDX-License-Identifier: GPL-3.0-or-later
"""Particles in NumPy arrays as the surface of a liquid: python3 sph_snapshot.py

Needs the compiled classes, as in the Debian package, and the interpreter that they were built for."""

import numpy as np
from scatteredisopoints import contour, vtkIsopointSplatMapper
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderWindow, vtkRenderer, vtkWindowToImageFilter

# Stands for your snapshot: a drop above a basin, particles a little off a lattice, and their density.
random = np.random.default_rng(1)
lattice = np.stack(np.meshgrid(*3 * [np.linspace(-1, 1, 70)], indexing="ij"), -1).reshape(-1, 3)
positions = lattice + random.normal(0, 0.004, lattice.shape)
height = 0.12 * np.cos(9 * np.hypot(positions[:, 0], positions[:, 1])) - 0.5
drop = 0.35 - np.linalg.norm(positions - [0, 0, 0.35], axis=1)
density = 500 + 4000 * np.maximum(drop, height - positions[:, 2]).clip(-0.12, 0.12)

liquid = contour(positions, density, 500.0)

mapper = vtkIsopointSplatMapper()
mapper.SetInputData(liquid.polydata)
mapper.ScalarVisibilityOff()
actor = vtkActor()
actor.SetMapper(mapper)
actor.GetProperty().SetColor(0.3, 0.55, 0.8)
renderer = vtkRenderer()
renderer.SetBackground(1, 1, 1)
renderer.AddActor(actor)
window = vtkRenderWindow()
window.SetOffScreenRendering(True)
window.SetSize(600, 400)
window.AddRenderer(renderer)
camera = renderer.GetActiveCamera()
camera.SetPosition(2.5, -3.5, 2.2)
camera.SetViewUp(0, 0, 1)
renderer.ResetCamera()
camera.Zoom(1.4)
image = vtkWindowToImageFilter()
image.SetInput(window)
writer = vtkPNGWriter()
writer.SetInputConnection(image.GetOutputPort())
writer.SetFileName("sph_snapshot.png")
writer.Write()
