# SPDX-License-Identifier: GPL-3.0-or-later
"""Gradients at the samples: the field of two charges as arrows on an isosurface of their potential."""

import numpy as np
import pyvista as pv

cloud = pv.PolyData(np.random.default_rng(5).uniform(-1.5, 1.5, (80_000, 3)))
x, y, z = cloud.points.T
cloud["potential"] = sum(1 / np.sqrt(0.05 + (x - a) ** 2 + y**2 + z**2) for a in (-0.6, 0.6))

fields = cloud.scattered.compute_derivative("potential")
fields["field"] = -fields["gradient"]
surface = fields.scattered.contour([2.6], "potential")
surface["strength"] = np.linalg.norm(surface["field"], axis=1)
arrows = surface.glyph(orient="field", scale="strength", factor=0.12, tolerance=0.05)

plotter = pv.Plotter(off_screen=True, window_size=(480, 400))
plotter.add_mesh(surface, scalars="strength", cmap="plasma", smooth_shading=True, show_scalar_bar=False)
plotter.add_mesh(arrows, color="gray")
plotter.camera_position = [(1, -5, 2), (0, 0, 0), (0, 0, 1)]
plotter.camera.zoom(1.1)
plotter.screenshot("gradient.png")
