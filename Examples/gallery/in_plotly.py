# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles in plotly, with NumPy alone: two isosurfaces of 100,000 random samples. Needs plotly and kaleido."""

import numpy as np
import plotly.graph_objects as go
from scatteredisopoints import Samples

positions = np.random.default_rng(10).uniform(-2, 2, (100_000, 3))
x, y, z = positions.T
samples = Samples(positions, (np.sqrt(x**2 + y**2) - 1.2) ** 2 + z**2)

figure = go.Figure(layout=dict(width=480, height=400, margin=dict.fromkeys("lrtb", 0), showlegend=False))
for isovalue, color, opacity in ((0.04, "firebrick", 1.0), (0.25, "lightblue", 0.3)):
    surface = samples.contour(isovalue, triangles=True)
    figure.add_mesh3d(**dict(zip("xyz", surface.points.T)), **dict(zip("ijk", surface.triangles.T)), color=color,
                      opacity=opacity, lighting=dict(ambient=0.5, diffuse=0.6))
figure.update_scenes(aspectmode="data", xaxis_visible=False, yaxis_visible=False, zaxis_visible=False,
                     camera_eye=dict(x=0.9, y=-1.1, z=1.0))
figure.write_image("in_plotly.png")
