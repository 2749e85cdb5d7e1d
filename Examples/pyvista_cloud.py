# SPDX-License-Identifier: GPL-3.0-or-later
"""Isosurface of a point cloud
==============================

Contour samples that have no mesh, such as particles or readings of sensors, as PyVista contours grids.
Writes pyvista_cloud.png.

Needs the Python package and PyVista 0.48 or later, in any Python.
"""

# %%
# Stands for your file: a temperature at 200,000 places around two hot spots.
import numpy as np
import pyvista as pv

random = np.random.default_rng(1)
cloud = pv.PolyData(random.normal(size=(200_000, 3)))
x, y, z = cloud.points.T
cloud["temperature"] = sum(
    80 / (1 + 3 * ((x - place) ** 2 + y**2 + z**2)) for place in (-0.8, 0.8)
) + 5 * np.sin(8 * x) * np.sin(8 * y) * np.sin(8 * z)
cloud["height"] = z

# %%
# Where ``scatteredisopoints`` is installed, each data set has the accessor ``scattered``. Nothing has to be
# imported, and no grid is made.
surface = cloud.scattered.contour([40.0], "temperature")
print(surface)

# %%
# The second surface reuses the tree of the first, and is faster.
inner = cloud.scattered.contour([60.0], "temperature")

# %%
# Arrays of the cloud are interpolated on the surfaces.
clipped = surface.clip("-y", origin=(0, 0, 0))
plotter = pv.Plotter(off_screen=True, window_size=(800, 440))
plotter.add_mesh(clipped, scalars="height", cmap="viridis", smooth_shading=True, ambient=0.3,
                 show_scalar_bar=False)
plotter.add_mesh(inner, color="orangered", smooth_shading=True, ambient=0.2)
plotter.add_points(cloud.points[:8000], color="gray", point_size=3, opacity=0.3)
plotter.camera_position = [(0.9, -3.0, 1.5), (0, 0, 0), (0, 0, 1)]
plotter.screenshot("pyvista_cloud.png")
