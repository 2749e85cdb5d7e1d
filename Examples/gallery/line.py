# SPDX-License-Identifier: GPL-3.0-or-later
"""A plot over a line, beside the exact values: 30,000 random samples of a wave."""

import matplotlib.pyplot as plt
import numpy as np
import pyvista as pv


def wave(points):
    radius = np.linalg.norm(points, axis=1)
    return np.cos(12 * radius) * np.exp(-2 * radius)


cloud = pv.PolyData(np.random.default_rng(3).uniform(-1, 1, (30_000, 3)))
cloud["wave"] = wave(cloud.points)

line = cloud.scattered.sample_over_line((-1.2, 0, 0), (1.2, 0, 0), resolution=300)

figure, axes = plt.subplots(figsize=(4.8, 3.2), dpi=100, layout="constrained")
axes.plot(line["Distance"], line["wave"], linewidth=5, color="orange", label="from samples")
axes.plot(line["Distance"], wave(line.points), linewidth=1, color="black", label="exact")
axes.set(xlabel="distance", ylabel="wave")
axes.legend()
figure.savefig("line.png")
