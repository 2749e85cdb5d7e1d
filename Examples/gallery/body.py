# SPDX-License-Identifier: GPL-3.0-or-later
"""A closed body, ready for a mesh generator or a printer, and its volume: the dense part of a ball of samples."""

import numpy as np
import pyvista as pv

places = np.random.default_rng(7).uniform(-1, 1, (200_000, 3))
cloud = pv.PolyData(places[np.linalg.norm(places, axis=1) < 1])
x, y, z = cloud.points.T
cloud["density"] = np.sin(5 * x) * np.cos(5 * y) + np.sin(5 * y) * np.cos(5 * z) + np.sin(5 * z) * np.cos(5 * x)

body = cloud.scattered.contour([0.3], "density", capping=True)
body.save("body.stl")
print(f"closed: {body.is_manifold}, volume: {body.volume:.3f}")

plotter = pv.Plotter(off_screen=True, window_size=(480, 400))
plotter.add_mesh(body, scalars="IsCap", cmap=["tan", "steelblue"], show_scalar_bar=False)
plotter.camera_position = [(3, 2.3, 1.8), (0, 0, 0), (0, 0, 1)]
plotter.screenshot("body.png")
