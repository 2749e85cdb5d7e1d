# SPDX-License-Identifier: GPL-3.0-or-later
"""A grid for volume rendering: smoke of 100,000 random samples."""

import numpy as np
import pyvista as pv

random = np.random.default_rng(4)
cloud = pv.PolyData(random.uniform((-1, -1, 0), (1, 1, 3), (100_000, 3)))
x, y, z = cloud.points.T
x, y = x - 0.3 * np.sin(2 * z), y - 0.3 * np.cos(3 * z)
cloud["smoke"] = np.exp(-(x**2 + y**2) / (0.02 + 0.06 * z)) * (0.5 + 0.5 * np.sin(7 * z + 6 * x) ** 2)

grid = cloud.scattered.to_grid(dimensions=(60, 60, 90), outside=0)

plotter = pv.Plotter(off_screen=True, window_size=(480, 400))
plotter.add_volume(grid, scalars="smoke", cmap="bone_r", shade=True, opacity=[0, 0.2, 0.6, 0.9, 1],
                   show_scalar_bar=False)
plotter.camera_position = [(5, -3.5, 2.5), (0, 0, 1.4), (0, 0, 1)]
plotter.screenshot("grid.png")
