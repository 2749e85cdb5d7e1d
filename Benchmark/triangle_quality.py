# SPDX-License-Identifier: GPL-3.0-or-later
"""Number, shape, topology and accuracy of triangles, without and with Regularize.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 Benchmark/triangle_quality.py \\
        --file FILE ARRAY ISOVALUE

Prints two rows of a Markdown table for each cloud: random samples of the distance to the center of a cube, without
and with noise; the plane and a wave on a curvilinear grid around a post; and the points of files of VTK. A triangle
is inverted if its normal looks against the sum of its corners' directions against the gradient. Borders are edges of
one triangle, branches those of more than two. Errors are distances from the sphere, at random places of all
triangles, in mean spacings. Processor seconds are those of one extraction.
"""

import time

import common
import numpy as np
from scatteredisopoints import contour
from vtkmodules.util.numpy_support import vtk_to_numpy

RADIUS = 60.0


def grid_around_a_post(rings=40, spokes=48, layers=16, growth=30.0):
    """Positions of a curvilinear grid; the last ring is growth times as wide as the first one."""
    widths = 0.02 * growth ** (np.arange(rings - 1) / (rings - 2))
    radii = 1 + np.concatenate([[0], np.cumsum(widths)])
    angles = 2 * np.pi / spokes * np.arange(spokes)
    height, angle, radius = np.meshgrid(np.linspace(0, 4, layers), angles, radii, indexing="ij")
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), height], -1).reshape(-1, 3)


def clouds(options):
    """Yields name, positions, values, isovalue, and the mean spacing where the surface is the sphere."""
    for millions in options.samples:
        for name, positions, values in common.spheres(millions):
            yield f"{name}, {millions:g} M", positions, values, RADIUS, common.SIDE / len(values) ** (1 / 3)
    grid = grid_around_a_post()
    x, y, z = grid.T
    yield "grid around a post: plane", grid, 0.3 * x + 0.2 * y + z, 2.03, None
    yield "grid around a post: wave", grid, z + 0.4 * np.sin(1.1 * x) * np.cos(0.7 * y), 2.03, None
    for path, array, isovalue in options.file:
        blocks = common.leaves_of(common.read(path))
        values = [vtk_to_numpy(block.GetPointData().GetArray(array)) for block in blocks]
        positions = np.concatenate(list(map(common.positions_of, blocks)))
        yield common.name_of(path), positions, np.concatenate(values), float(isovalue), None


def smallest_angles(corners):
    """Of each triangle, in degrees."""
    angles = []
    for corner in range(3):
        a, b = (corners[:, (corner + step) % 3] - corners[:, corner] for step in (1, 2))
        angles.append(np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), (a * b).sum(axis=1)))
    return np.degrees(np.min(angles, axis=0))


def inverted(corners, gradients):
    """The number of triangles that look along the gradients at their corners, shape (triangles, 3, 3)."""
    lengths = np.linalg.norm(gradients, axis=2, keepdims=True)
    directions = -(gradients / np.where(lengths > 0, lengths, 1)).sum(axis=1)
    return np.count_nonzero((common.normals_of(corners) * directions).sum(axis=1) <= 0)


def topology(surface):
    """Euler number, components, edges of one triangle, and edges of more than two."""
    edges = np.sort(np.asarray(surface.triangles)[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    unique, counts = np.unique(edges, axis=0, return_counts=True)
    euler = len(surface.points) - len(unique) + len(surface.triangles)
    return euler, len(surface.pieces), np.count_nonzero(counts == 1), np.count_nonzero(counts > 2)


def print_row(name, positions, values, isovalue, spacing, isopoints, regularize):
    begin = time.process_time()
    surface = contour(positions, values, isovalue, triangles=True, compute_gradients=True, regularize=regularize)
    seconds = time.process_time() - begin
    triangles = np.asarray(surface.triangles)
    corners = np.asarray(surface.points, dtype=float)[triangles]
    angles, distances = smallest_angles(corners), ""
    if spacing:
        weights = np.random.default_rng(1).dirichlet((1, 1, 1), len(corners))
        error = np.abs(np.linalg.norm(common.placed(weights, corners), axis=1) - RADIUS) / spacing
        distances = f"{error.mean():.4f} / {error.max():.3f}"
    common.print_row(
        name, f"{isopoints:,}", "on" if regularize else "off", f"{len(surface.points):,}",
        f"{np.percentile(angles, 5):.1f} / {np.median(angles):.1f}", f"{100 * (angles < 10).mean():.2f}",
        inverted(corners, np.asarray(surface.arrays["Gradients"])[triangles]), *topology(surface),
        distances, f"{seconds:.2f}")


parser = common.parser_of(__doc__)
common.add_numbers(parser, samples=[1.0])
common.add_files(parser, "FILE", "ARRAY", "ISOVALUE")
common.print_head(
    "cloud", "isopoints", "Regularize", "vertices", "smallest angle, 5 % / median", "below 10 degrees, %", "inverted",
    "Euler number", "components", "borders", "branches", "mean / largest error", "processor s")
for name, *of_cloud in clouds(parser.parse_args()):
    isopoints = len(contour(*of_cloud[:3]).points)
    for regularize in False, True:
        print_row(name, *of_cloud, isopoints, regularize)
