# SPDX-License-Identifier: GPL-3.0-or-later
"""Slices that end where the samples end: the temperature around two sources, in a ball of random sensors."""

import numpy as np
import pyvista as pv

places = np.random.default_rng(2).uniform(-1, 1, (120_000, 3))
cloud = pv.PolyData(places[np.linalg.norm(places, axis=1) < 1])
x, y, z = cloud.points.T
cloud["temperature"] = np.exp(-8 * ((x - 0.4) ** 2 + y**2 + z**2)) + 0.7 * np.exp(-20 * ((x + 0.4) ** 2 + y**2 + z**2))

slices = cloud.scattered.slice_orthogonal(x=0.4, y=0, z=-0.3)

plotter = pv.Plotter(off_screen=True, window_size=(480, 400))
plotter.add_mesh(slices, scalars="temperature", cmap="plasma", lighting=False, show_scalar_bar=False)
plotter.add_points(cloud.points[::40], color="gray", point_size=2)
plotter.camera_position = [(2.2, -3.2, 1.6), (0, 0, 0), (0, 0, 1)]
plotter.screenshot("slice.png")
