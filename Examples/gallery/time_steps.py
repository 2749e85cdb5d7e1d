# SPDX-License-Identifier: GPL-3.0-or-later
"""A time series of fixed sensors: later steps keep the search structure of the first."""

import numpy as np
import pyvista as pv
from scatteredisopoints import Samples

positions = np.random.default_rng(9).uniform(-1, 1, (60_000, 3))
x, y, z = positions.T
samples = None
plotter = pv.Plotter(off_screen=True, window_size=(600, 200), shape=(1, 3), border=False)
for step in range(3):
    place = 0.18 + 0.14 * step
    values = sum(np.exp(-8 * ((x - a) ** 2 + y**2 + z**2)) for a in (-place, place))
    if samples is None:
        samples = Samples(positions, values)
    else:
        samples.replace_values(values)
    surface = samples.contour(0.6, triangles=True)
    plotter.subplot(0, step)
    plotter.add_mesh(pv.wrap(surface.polydata), color="teal", smooth_shading=True)
    plotter.camera_position = [(0, -3.5, 1), (0, 0, 0), (0, 0, 1)]
plotter.screenshot("time_steps.png")
