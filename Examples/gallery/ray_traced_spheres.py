# SPDX-License-Identifier: GPL-3.0-or-later
"""A glass sphere and a mirror, ray-traced from the splats of two million random samples."""

import numpy as np
import pyvista as pv
from scatteredisopoints import contour, ray_trace


def sphere(center, seed):
    """Stands for your samples: the distance from a center at random places."""
    offsets = np.random.default_rng(seed).uniform(-1.2, 1.2, (1_000_000, 3))
    return contour(offsets + center, np.linalg.norm(offsets, axis=1), 1.0).splats().to_pyvista()


plotter = pv.Plotter(off_screen=True, window_size=(640, 400), lighting="none")
smooth = {"pbr": True, "roughness": 0.0, "smooth_shading": True}
plotter.add_mesh(sphere([1.15, 0.0, 1.0], 1), color=(1.0, 0.8, 0.25), metallic=1.0, **smooth)
glass = plotter.add_mesh(sphere([-1.15, -0.3, 1.0], 2), color=(0.85, 0.95, 0.9), metallic=0.0, opacity=0.0, **smooth)
glass.prop.SetBaseIOR(1.5)

floor = pv.Plane(i_size=16, j_size=16, i_resolution=24, j_resolution=24)
row, column = np.divmod(np.arange(24 * 24), 24)
floor.cell_data["tiles"] = np.array([[225, 220, 210], [120, 60, 50]], np.uint8)[(row + column) % 2]
plotter.add_mesh(floor, scalars="tiles", rgb=True)

plotter.add_light(pv.Light(position=(-3, -5, 8), intensity=0.9))
plotter.set_background((0.85, 0.9, 0.95), top=(0.25, 0.45, 0.75))
plotter.camera_position = [(0, -7.5, 2.3), (0, 0, 0.85), (0, 0, 1)]
ray_trace(plotter, "ray_traced_spheres.png", samples=64, light_angle=5.0)
