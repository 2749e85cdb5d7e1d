# SPDX-License-Identifier: GPL-3.0-or-later
"""Areas, volumes and connected pieces of triangles."""

from __future__ import annotations

import math
from typing import NamedTuple, Optional

import numpy as np


class Piece(NamedTuple):
    """A connected piece of a surface."""

    isovalue: float
    area: float
    """In the square of the unit of positions."""
    volume: float
    """Enclosed, in the cube of the unit of positions: positive for bodies and droplets, negative for bubbles, the
    inner borders of bodies. NaN if the piece is open."""


class Measures(NamedTuple):
    pieces: list[Piece]
    """Largest area first."""
    region_ids: np.ndarray
    """The piece of each triangle."""


def measure(points: np.ndarray, triangles: np.ndarray, isovalues: Optional[np.ndarray]) -> Measures:
    """O(n log n). The isovalue of a piece is the least at its points, NaN if they are None."""
    if len(triangles) == 0:
        return Measures([], np.empty(0, np.int64))
    roots = _roots(triangles, len(points))[triangles[:, 0]]
    firsts, regions = np.unique(roots, return_inverse=True)
    regions = regions.reshape(-1)
    # From a point of the piece, so that no digits are lost.
    a, b, c = (points[triangles[:, i]].astype(np.float64) - points[firsts[regions]] for i in range(3))
    normals = np.cross(b - a, c - a)
    areas = np.bincount(regions, 0.5 * np.linalg.norm(normals, axis=1))
    volumes = np.bincount(regions, np.einsum("ij,ij->i", a, normals) / 6.0)
    volumes[np.bincount(regions, ~_are_closed(triangles, len(points))) > 0] = math.nan
    levels = np.full(len(firsts), math.nan if isovalues is None else math.inf)
    if isovalues is not None:
        np.minimum.at(levels, regions, isovalues[triangles].min(axis=1))
    order = np.argsort(-areas, kind="stable")
    places = np.empty(len(order), np.int64)
    places[order] = np.arange(len(order))
    return Measures([Piece(*map(float, each)) for each in zip(levels[order], areas[order], volumes[order])],
                    places[regions])


def _roots(triangles: np.ndarray, count: int) -> np.ndarray:
    """The lowest point that each point is connected with."""
    parents = np.arange(count)
    while True:
        around = parents[triangles]
        lowest = around.min(axis=1)
        if (around == lowest[:, None]).all():
            return parents
        for i in range(3):
            np.minimum.at(parents, around[:, i], lowest)
        while (parents != parents[parents]).any():
            parents = parents[parents]


def _are_closed(triangles: np.ndarray, count: int) -> np.ndarray:
    """Whether each triangle has, at each side, exactly one other in the opposite direction."""
    starts, ends = triangles.astype(np.int64).ravel(), np.roll(triangles.astype(np.int64), -1, axis=1).ravel()
    keys, opposite = starts * count + ends, ends * count + starts
    ordered = np.sort(keys)
    found = np.searchsorted(ordered, opposite, "right") - np.searchsorted(ordered, opposite, "left")
    own = np.searchsorted(ordered, keys, "right") - np.searchsorted(ordered, keys, "left")
    return ((found == 1) & (own == 1)).reshape(-1, 3).all(axis=1)
