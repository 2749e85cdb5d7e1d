# SPDX-License-Identifier: GPL-3.0-or-later
"""An isosurface: a gyroid in 150,000 random samples of a ball."""

import numpy as np
import pyvista as pv

places = np.random.default_rng(1).uniform(-6, 6, (300_000, 3))
cloud = pv.PolyData(places[np.linalg.norm(places, axis=1) < 6])
x, y, z = cloud.points.T
cloud["gyroid"] = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
cloud["distance"] = np.linalg.norm(cloud.points, axis=1)

surface = cloud.scattered.contour([0.0], "gyroid")

plotter = pv.Plotter(off_screen=True, window_size=(480, 400))
plotter.add_mesh(surface, scalars="distance", cmap="viridis", smooth_shading=True, show_scalar_bar=False)
plotter.camera_position = [(18, 14, 13), (0, 0, 0), (0, 0, 1)]
plotter.screenshot("isosurface.png")
