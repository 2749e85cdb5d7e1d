# SPDX-License-Identifier: GPL-3.0-or-later
"""Fields over the cube [-1, 1]^3 whose isosurfaces are known exactly, and ways to sample that cube.

Positions are arrays of shape (count, 3). The fields without jumps are those of
Testing/Cxx/AnalyticFields.h, where these are described.
"""

from collections import namedtuple

import numpy as np

# value(positions): the field. feet(positions): the nearest points of the isosurface and the normals
# there, towards decreasing values, as an array (count, k, 3): several at edges, zeros elsewhere.
Surface = namedtuple("Surface", "value isovalue feet")


def length(vectors):
    return np.linalg.norm(vectors, axis=-1)


def unit(vectors):
    return vectors / np.maximum(length(vectors), 1e-300)[..., None]


def dots(a, b):
    return (a * b).sum(axis=-1)[..., None]


def _onto(value, gradient, isovalue, positions):
    """Newton's method along the gradient, in short steps."""
    longest = 0.1
    for _ in range(30):
        slope = gradient(positions)
        size = (isovalue - value(positions)) / np.maximum(length(slope), 1e-6)
        positions = positions + np.clip(size, -longest, longest)[:, None] * unit(slope)
        if np.abs(size).max(initial=0) < 1e-14:
            break
    return positions


def _smooth(value, gradient, isovalue):
    """Feet by steps along the surface, of positions nearer to it than its radius of curvature."""

    def feet(positions):
        foot = best = _onto(value, gradient, isovalue, positions)
        for _ in range(30):
            normal = unit(gradient(foot))
            along = positions - foot
            along = along - dots(along, normal) * normal
            foot = _onto(value, gradient, isovalue, foot + 0.7 * along)
            nearer = length(positions - foot) < length(positions - best)
            best = np.where(nearer[:, None], foot, best)
        return best, -unit(gradient(best))[:, None]

    return Surface(value, isovalue, feet)


def _radial(value, radii, isovalue, sides):
    """A function of the distance to the center; normals of spheres outwards (1) or inwards (-1)."""

    def feet(positions):
        outwards = unit(positions)
        nearest = np.abs(length(positions)[:, None] - radii).argmin(axis=1)
        normals = np.array(sides)[nearest, None] * outwards
        return np.array(radii)[nearest, None] * outwards, normals[:, None]

    return Surface(lambda positions: value(length(positions)), isovalue, feet)


def sphere(_):
    return _radial(lambda r: r, [0.7], 0.7, [-1])


def torus(_):
    def on_circle(positions):
        return 0.6 * unit(positions * [1, 1, 0])

    def feet(positions):
        center = on_circle(positions)
        outwards = unit(positions - center)
        return center + 0.25 * outwards, -outwards[:, None]

    def value(positions):
        x, y, z = positions.T
        return np.hypot(np.hypot(x, y) - 0.6, z)

    return Surface(value, 0.25, feet)


def gyroid(_):
    def value(positions):
        return (np.sin(np.pi * positions) * np.cos(np.pi * np.roll(positions, -1, 1))).sum(axis=1)

    def gradient(positions):
        sine, cosine = np.sin(np.pi * positions), np.cos(np.pi * positions)
        return np.pi * (cosine * np.roll(cosine, -1, 1) - sine * np.roll(sine, -2, 1))

    return _smooth(value, gradient, 0.0)


def gaussian_mixture(_):
    centers = np.array([[0, 0.1, 0], [0.4, 0.3, 0.1], [-0.4, 0.2, 0.3],
                        [0.1, -0.5, -0.2], [-0.2, 0, -0.45], [0.35, -0.2, 0.4]])
    widths = np.array([0.35, 0.2, 0.22, 0.25, 0.18, 0.2])
    weights = np.array([1, 0.8, 0.9, 0.7, 0.9, 0.8])

    def bells(positions):
        offsets = positions[:, None] - centers
        return offsets, weights * np.exp(-0.5 * (length(offsets) / widths) ** 2)

    def gradient(positions):
        offsets, parts = bells(positions)
        return -((parts / widths**2)[..., None] * offsets).sum(axis=1)

    return _smooth(lambda positions: bells(positions)[1].sum(axis=1), gradient, 0.5)


def marschner_lobb(_):
    """The test signal of [ML94]: the graph of a function of the distance to the axis, in ripples."""
    def ripple(r):
        return np.cos(12 * np.pi * np.cos(0.5 * np.pi * r))

    def height(r):
        return 2 / np.pi * np.arcsin(0.25 * ripple(r))

    def value(positions):
        radial = 0.25 * (1 + ripple(np.hypot(positions[:, 0], positions[:, 1])))
        return (1 - np.sin(0.5 * np.pi * positions[:, 2]) + radial) / 2.5

    def nearest(r, z):
        """The distance to the axis at the foot."""
        def distance(s):
            return np.hypot(s - r, height(s) - z)

        # The foot is no farther than the graph at the position's own r.
        reach, parts = distance(r), 200
        best = r
        for part in np.arange(-parts, parts + 1) / parts:
            s = np.maximum(r + part * reach, 0)
            best = np.where(distance(s) < distance(best), s, best)
        lower, upper = best - reach / parts, best + reach / parts
        for _ in range(40):
            third = (upper - lower) / 3
            is_lower = distance(lower + third) < distance(upper - third)
            lower, upper = np.where(is_lower, lower, lower + third), np.where(is_lower, upper - third, upper)
        return np.maximum(0.5 * (lower + upper), 0)

    def feet(positions):
        own = np.hypot(positions[:, 0], positions[:, 1])
        away = unit(positions * [1, 1, 0])
        r = nearest(own, positions[:, 2])
        slope = np.sin(12 * np.pi * np.cos(0.5 * np.pi * r)) * 6 * np.pi**2 * np.sin(0.5 * np.pi * r)
        axis = np.array([0, 0, 1])
        foot = r[:, None] * away + height(r)[:, None] * axis
        upwards = 0.5 * np.pi * np.cos(0.5 * np.pi * foot[:, 2])
        return foot, unit(upwards[:, None] * axis - 0.25 * slope[:, None] * away)[:, None]

    return Surface(value, 0.5, feet)


_CUBE_AXES = np.array([[24, -32, 30], [40, 30, 0], [-18, 24, 40]]) / 50


def cube(_):
    half = 0.5

    def feet(positions):
        along = positions @ _CUBE_AXES.T
        foot = np.clip(along, -half, half)
        row, face = np.arange(len(along)), np.abs(along).argmax(axis=1)
        foot[row, face] = np.where(along[row, face] < 0, -half, half)
        towards = -np.sign(foot) * (np.abs(foot) == half)
        return foot @ _CUBE_AXES, towards[:, :, None] * _CUBE_AXES

    return Surface(lambda positions: np.abs(positions @ _CUBE_AXES.T).max(axis=1), half, feet)


def two_sheets(spacing):
    """Two spheres, two spacings apart, with a crease between them."""
    middle = 0.65
    radii = [middle - spacing, middle + spacing]
    return _radial(lambda r: np.abs(r - middle), radii, spacing, [1, -1])


def two_balls(_):
    """The distance to the nearer of two centers: two balls that meet in a concave crease."""
    centers, radius = np.array([[-0.35, 0.05, 0.02], [0.35, -0.05, -0.02]]), 0.42
    axis = unit(centers[1] - centers[0])
    ring = np.sqrt(radius**2 - length(centers[0]) ** 2)

    def feet(positions):
        heights = dots(positions, axis)
        rims = ring * unit(positions - heights * axis)
        outwards = unit(rims[:, None] - centers)
        for i, side in enumerate((-1, 1)):
            ball = centers[i] + radius * unit(positions - centers[i])
            on_ball = (side * dots(ball, axis) >= 0) & (side * heights >= 0)
            rims = np.where(on_ball, ball, rims)
            outwards = np.where(on_ball[..., None], unit(positions - centers[i])[:, None], outwards)
        return rims, -outwards

    def value(positions):
        return length(positions[:, None] - centers).min(axis=1)

    return Surface(value, radius, feet)


def step(_):
    """A jump from 0 to 1 across a sphere."""
    return _radial(lambda r: (r > 0.7) * 1.0, [0.7], 0.5, [-1])


def smooth_step(spacing):
    """A rise within about one spacing, as at the surfaces of scanned bodies."""
    return _radial(lambda r: 0.5 + 0.5 * np.tanh((r - 0.7) / (0.5 * spacing)), [0.7], 0.5, [-1])


def plane_step(_):
    normal = unit(np.array([3.0, 1.0, 2.0]))

    def feet(positions):
        foot = positions - (positions @ normal - 0.1)[:, None] * normal
        return foot, np.broadcast_to(-normal, (len(foot), 1, 3))

    return Surface(lambda positions: (positions @ normal > 0.1) * 1.0, 0.5, feet)


def uniform(count, random):
    return 2 * random.random((count, 3)) - 1


def clustered(count, random):
    """Seven tenths in twelve clouds, the others anywhere."""
    positions, centers = uniform(2 * count, random), uniform(12, random)
    center = centers[random.integers(0, len(centers), len(positions))]
    in_cloud = random.random((len(positions), 1)) < 0.7
    positions = np.where(in_cloud, center + 0.15 * random.normal(size=positions.shape), positions)
    return positions[(np.abs(positions) <= 1).all(axis=1)][:count]


def lattice(count, _):
    nodes = np.linspace(-1, 1, round(count ** (1 / 3)))
    return np.stack(np.meshgrid(nodes, nodes, nodes, indexing="ij"), axis=-1).reshape(-1, 3)


def jittered(count, random):
    cell = 2 / round(count ** (1 / 3))
    positions = lattice(count, random) * (1 - 0.5 * cell)
    return positions + 0.4 * cell * uniform(len(positions), random)


def slices(ratio):
    """Samples in planes whose distance is a multiple of that of the samples within them."""

    def sampling(count, random):
        planes = round((count / ratio**2) ** (1 / 3))
        positions = uniform(count, random)
        positions[:, 2] = (2 * random.integers(0, planes, count) + 1) / planes - 1
        return positions

    return sampling


def lines(count, random):
    """Samples on lines that are four times as far apart as the samples along them."""
    per_line = round((16 * count) ** (1 / 3))
    places = uniform(count // per_line, random)
    heights = (np.arange(per_line) + random.random((len(places), 1))) * 2 / per_line - 1
    return np.column_stack((np.repeat(places[:, :2], per_line, axis=0), heights.ravel()))
