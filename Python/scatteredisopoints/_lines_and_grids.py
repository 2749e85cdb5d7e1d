# SPDX-License-Identifier: GPL-3.0-or-later
"""Points along lines, and of uniform grids."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

MOST_POINTS = 2**31 - 1
"""Of a grid."""


def line_between(begin: np.ndarray, end: np.ndarray, resolution: int) -> tuple[np.ndarray, np.ndarray]:
    """The ends of the pieces of a line, shape (resolution + 1, 3), and their distances from its begin. The bytes are
    those of the compiled filter."""
    shares = np.arange(resolution + 1) / resolution
    most = np.abs(end - begin).max()
    x, y, z = (end - begin) / (most if most > 0.0 else 1.0)  # scaled, as std::hypot() does it
    length = most * math.sqrt(x * x + y * y + z * z)
    return (1.0 - shares[:, None]) * begin + shares[:, None] * end, shares * length


def lattice(axes: list[np.ndarray]) -> np.ndarray:
    """All positions with these coordinates, x fastest."""
    z, y, x = np.meshgrid(*axes[::-1], indexing="ij")
    return np.stack([x, y, z], axis=-1).reshape(-1, 3)


def check_size(given: str, counts: Any, remedy: str) -> None:
    """Raises ValueError for more points, along three axes, than a grid has."""
    size = np.prod(np.asarray(counts, dtype=float))
    if not size <= MOST_POINTS:
        raise ValueError(f"{given} would give {size:.3g} points, and a grid has at most {MOST_POINTS}: choose {remedy}")


def box_of(bounds: Any) -> np.ndarray:
    """Bounds in the shape (3, 2)."""
    try:
        box = np.array(bounds, dtype=float)
    except (TypeError, ValueError):
        box = np.empty(0)
    if box.shape != (6,) or not np.isfinite(box).all() or np.any(box[::2] > box[1::2]):
        shown = box.tolist() if box.size else repr(bounds)
        raise ValueError(f"bounds cannot be {shown}: give three ascending pairs of finite numbers")
    return box.reshape(3, 2)


def grid_in(box: np.ndarray, dimensions: Any, spacing: Any) -> dict[str, Any]:
    """The dimensions, spacing and origin of a grid in bounds, given by its numbers of points or by their distances.
    Axes without length have a point."""
    if (dimensions is None) == (spacing is None):
        raise TypeError("to_grid() takes either dimensions or spacing")
    sizes = box[:, 1] - box[:, 0]
    name, given = ("spacing", spacing) if dimensions is None else ("dimensions", dimensions)
    try:
        wanted = np.broadcast_to(np.asarray(given, dtype=float), 3)
    except (TypeError, ValueError):
        raise ValueError(f"{name} cannot be {given!r}: one number, or three") from None
    if dimensions is None:
        if not np.all((wanted > 0) & np.isfinite(wanted)):
            raise ValueError(f"spacing cannot be {spacing!r}: it is finite, and greater than 0")
        counts = np.ceil(sizes / wanted * (1 - 1e-12)) + 1
    else:
        if not np.all((wanted >= 1) & (wanted == np.rint(wanted))):
            raise ValueError(f"dimensions cannot be {dimensions!r}: they are whole numbers, 1 or more")
        counts = np.where(sizes > 0, wanted, 1)
        box = np.where(counts[:, None] > 1, box, box.mean(axis=1, keepdims=True))
        wanted = np.where(counts > 1, sizes / np.maximum(counts - 1, 1), 1)
    check_size(f"{name} {given!r}", counts, "a greater spacing, or smaller bounds" if dimensions is None else
               "fewer, or smaller bounds")
    return dict(dimensions=counts.astype(int).tolist(), spacing=wanted.tolist(), origin=box[:, 0].tolist())
