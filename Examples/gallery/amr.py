# SPDX-License-Identifier: GPL-3.0-or-later
"""Cells of an adaptive grid, of three sizes: one closed surface without cracks, from their centers."""

import numpy as np
import pyvista as pv


def centers(lower, size, depth):
    """Centers and sizes of cells that are refined near a sphere."""
    center = lower + size / 2
    if depth > 0 and abs(np.linalg.norm(center) - 0.7) < size / depth:
        corners = lower + size / 2 * np.array(np.meshgrid(*3 * [[0, 1]])).reshape(3, -1).T
        return [cell for corner in corners for cell in centers(corner, size / 2, depth - 1)]
    return [(*center, size)]


coarse = np.array(np.meshgrid(*3 * [np.arange(-1, 1, 0.25)])).reshape(3, -1).T
cells = np.array([cell for lower in coarse for cell in centers(lower, 0.25, 2)])
cloud = pv.PolyData(cells[:, :3])
cloud["size"] = cells[:, 3]
cloud["distance"] = np.linalg.norm(cloud.points, axis=1) + 0.1 * np.sin(9 * cloud.points[:, 2])

surface = cloud.scattered.contour([0.7], "distance")

plotter = pv.Plotter(off_screen=True, window_size=(480, 400))
plotter.add_mesh(surface.clip("-y"), color="tan", smooth_shading=True)
layer = cloud.clip("z", origin=(0, 0, 0)).clip("-z", origin=(0, 0, -0.13))
cubes = layer.glyph(geom=pv.Cube(), scale="size", orient=False, factor=0.9)
plotter.add_mesh(cubes, scalars="size", cmap="viridis_r", show_scalar_bar=False)
plotter.camera_position = [(1.2, -3.4, 3), (0, 0, 0), (0, 0, 1)]
plotter.screenshot("amr.png")
