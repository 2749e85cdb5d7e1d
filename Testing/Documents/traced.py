# SPDX-License-Identifier: GPL-3.0-or-later
"""What scripts about ray tracing in the documents start from: a renderer that shows splats."""

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, the factories
from scatteredisopoints import contour, vtkIsopointSplatMapper
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

positions = np.random.default_rng(1).uniform(-1, 1, (20_000, 3))
mapper = vtkIsopointSplatMapper()
mapper.SetInputData(contour(positions, np.linalg.norm(positions, axis=1), 0.7).polydata)
mapper.ScalarVisibilityOff()
actor = vtkActor()
actor.SetMapper(mapper)
renderer = vtkRenderer()
renderer.AddActor(actor)
renderer.ResetCamera()
