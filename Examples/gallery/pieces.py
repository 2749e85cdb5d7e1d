# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces of an isosurface, colored by their volume: drops among 200,000 random samples."""

import numpy as np
import pyvista as pv
from scatteredisopoints import contour

random = np.random.default_rng(8)
cloud = pv.PolyData(random.uniform(0, 1, (200_000, 3)))
depths = [1 - np.linalg.norm(cloud.points - center, axis=1) / radius
          for center, radius in zip(random.uniform(0.1, 0.9, (40, 3)), random.uniform(0.03, 0.09, 40))]
cloud["inside"] = np.max(depths, axis=0)

surface = contour(cloud, "inside", 0.0, triangles=True)
volumes = np.array([piece.volume for piece in surface.pieces])
print(f"{len(volumes)} pieces, volumes {volumes.min():.2e} to {volumes.max():.2e}")
mesh = surface.polydata
mesh.cell_data["volume"] = volumes[surface.region_ids]

plotter = pv.Plotter(off_screen=True, window_size=(480, 400))
plotter.add_mesh(mesh, scalars="volume", cmap="viridis", show_scalar_bar=False)
plotter.add_mesh(cloud.outline(), color="gray")
plotter.camera_position = [(2.7, -1.9, 2.0), (0.5, 0.5, 0.5), (0, 0, 1)]
plotter.screenshot("pieces.png")
