# SPDX-License-Identifier: GPL-3.0-or-later
"""Vortices by the Q-criterion, colored by the sense of their rotation: velocities at 80,000 random places."""

import numpy as np
import pyvista as pv

cloud = pv.PolyData(np.random.default_rng(6).uniform(0, 2 * np.pi, (80_000, 3)))
x, y, z = cloud.points.T
cloud["velocity"] = np.column_stack([
    np.sin(x) * np.cos(y) * np.cos(z), -np.cos(x) * np.sin(y) * np.cos(z), 0.1 * np.sin(2 * z)])

flow = cloud.scattered.compute_derivative("velocity", vorticity=True, qcriterion=True)
vortices = flow.scattered.contour([0.35], "qcriterion")

plotter = pv.Plotter(off_screen=True, window_size=(480, 400))
plotter.add_mesh(vortices, scalars="vorticity", component=2, cmap="coolwarm", smooth_shading=True,
                 show_scalar_bar=False)
plotter.add_mesh(cloud.outline(), color="gray")
plotter.camera_position = [(15, -11, 12), (np.pi, np.pi, np.pi), (0, 0, 1)]
plotter.screenshot("q_criterion.png")
