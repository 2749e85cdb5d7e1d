# SPDX-License-Identifier: GPL-3.0-or-later
"""Areas, volumes and connected pieces of triangles."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np


class Piece(NamedTuple):
    """A connected component of a surface."""

    isovalue: float
    area: float
    """In the square of the unit of positions."""
    volume: float
    """Enclosed, in the cube of the unit of positions. With capping: positive for bodies and droplets, negative for
    bubbles, the inner borders of bodies. Without: negative if normals point inward. NaN unless each edge has exactly
    two triangles."""


class Measures(NamedTuple):
    pieces: tuple[Piece, ...]
    """Largest area first."""
    region_ids: np.ndarray
    """The piece of each triangle."""


def measure(points: np.ndarray, triangles: np.ndarray, isovalues: np.ndarray, joins_equal: bool) -> Measures:
    """O(n log n). The isovalues are those of the points.

    Points at equal positions are one if `joins_equal`: those on creases are repeated for their normals.
    """
    if len(triangles) == 0:
        return Measures((), np.empty(0, np.int64))
    numbers = triangles.astype(np.int64)
    if joins_equal:
        _, firsts, places = np.unique(points, axis=0, return_index=True, return_inverse=True)
        numbers = firsts[places.reshape(-1)][numbers]
    roots = _roots(numbers, len(points))[numbers[:, 0]]
    firsts, regions = np.unique(roots, return_inverse=True)
    regions = regions.reshape(-1)
    # From a point of the piece, so that no digits are lost.
    a, b, c = (points[numbers[:, i]].astype(np.float64) - points[firsts[regions]] for i in range(3))
    scale = 2.0 ** np.frexp(max(np.abs(each).max() for each in (a, b, c)))[1]
    a, b, c = a / scale, b / scale, c / scale
    normals = np.cross(b - a, c - a)
    with np.errstate(over="ignore"):
        areas = np.bincount(regions, 0.5 * np.linalg.norm(normals, axis=1)) * scale * scale
        volumes = np.bincount(regions, np.einsum("ij,ij->i", a, normals) / 6.0) * scale * scale * scale
    volumes[np.bincount(regions, ~_are_closed(numbers, len(points))) > 0] = math.nan
    order = np.argsort(-areas, kind="stable")
    places = np.empty(len(order), np.int64)
    places[order] = np.arange(len(order))
    numbers_of_pieces = np.stack([isovalues[firsts], areas, volumes], 1)[order]
    return Measures(tuple(Piece(*each) for each in numbers_of_pieces.tolist()), places[regions])


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
    starts, ends = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    keys, opposite = starts * count + ends, ends * count + starts
    ordered = np.sort(keys)
    found = np.searchsorted(ordered, opposite, "right") - np.searchsorted(ordered, opposite, "left")
    own = np.searchsorted(ordered, keys, "right") - np.searchsorted(ordered, keys, "left")
    return ((found == 1) & (own == 1)).reshape(-1, 3).all(axis=1)
