# SPDX-License-Identifier: GPL-3.0-or-later
"""The water level at two gauges over time, from the positions of particles alone: waves in a tank."""

import numpy as np
import pyvista as pv

spacing = 0.02
lattice = np.stack(np.meshgrid(*(np.arange(0, end, spacing) for end in (2, 0.4, 1)), indexing="ij"), -1).reshape(-1, 3)
particles = lattice + np.random.default_rng(8).normal(0, 0.1 * spacing, lattice.shape)
gauges = {(0.1, 0.2): "steelblue", (1.3, 0.2): "darkorange"}


def surface_at(x, time):
    return 0.6 + 0.15 * np.cos(np.pi * x) * np.cos(time) + 0.05 * np.cos(2 * np.pi * x) * np.sin(2 * time)


chart = pv.Chart2D(x_label="time", y_label="level")
chart.y_range = (0.3, 0.9)
times = np.linspace(0, 2 * np.pi, 25)
levels = {gauge: [] for gauge in gauges}
for time in times:
    water = pv.PolyData(particles[particles[:, 2] < surface_at(particles[:, 0], time)])
    body = water.scattered.body()
    for (x, y), found in levels.items():
        crossings, _ = body.ray_trace((x, y, -1), (x, y, 2))  # of a vertical line
        found.append(crossings[:, 2].max())
for (x, y), color in gauges.items():
    chart.line(times, surface_at(x, times), color=color, width=1.0)
    chart.scatter(times, levels[x, y], color=color, size=6)

plotter = pv.Plotter(shape=(1, 2), off_screen=True, window_size=(960, 400))
plotter.add_mesh(body, color="lightblue", smooth_shading=False)
for (x, y), color in gauges.items():
    plotter.add_mesh(pv.Line((x, y, 0), (x, y, 0.9)), color=color, line_width=4)
plotter.camera_position = [(1.6, -3.6, 2.0), (1, 0.2, 0.35), (0, 0, 1)]
plotter.subplot(0, 1)
plotter.add_chart(chart)
plotter.screenshot("water_level.png")
error = np.abs([np.subtract(levels[x, y], surface_at(x, times)) for x, y in levels]).mean()
print(f"mean error: {error / spacing:.2f} spacings")
