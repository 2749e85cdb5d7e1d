# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines, grids in bounds, and the names of derivatives."""

from __future__ import annotations

import math
import operator
from typing import Any

import numpy as np
import pyvista as pv

from ._cuts import three_numbers
from ._derivatives import DERIVATIVES
from ._options import switch

MOST_POINTS = 2**31 - 1
"""Of a grid."""


def line_between(pointa: Any, pointb: Any, resolution: Any) -> tuple[pv.PolyData, np.ndarray]:
    """A line of double precision, and the distances of its points from the first one."""
    begin, end = three_numbers("pointa", pointa), three_numbers("pointb", pointb)
    if not hasattr(resolution, "__index__") or operator.index(resolution) < 1:
        raise ValueError(f"resolution cannot be {resolution!r}: it is a whole number, 1 or more")
    shares = np.linspace(0, 1, operator.index(resolution) + 1)
    points = (1 - shares[:, None]) * begin + shares[:, None] * end
    return pv.PolyData(points, lines=[len(points), *range(len(points))]), shares * math.dist(begin, end)


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


def grid_in(box: np.ndarray, dimensions: Any, spacing: Any) -> pv.ImageData:
    """A grid in bounds, given by its numbers of points or by their distances. Axes without length have a point."""
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
    if not np.prod(counts) <= MOST_POINTS:
        raise ValueError(f"{name} {given!r} would give {np.prod(counts):.3g} points, and a grid has at most"
                         f" {MOST_POINTS}: choose {'a greater spacing' if dimensions is None else 'fewer'}, or smaller"
                         " bounds")
    return pv.ImageData(dimensions=counts.astype(int).tolist(), spacing=wanted.tolist(), origin=box[:, 0].tolist())


def names_of_derivatives(*flags: Any) -> dict[str, str]:
    """The names of the arrays with DERIVATIVES, in this order: of each, True stands for its own name, None and False
    for none. Raises ValueError for other values, and for equal names."""
    named: dict[str, str] = {}
    for derivative, flag in zip(DERIVATIVES, flags):
        name = flag if isinstance(flag, str) else derivative if flag is not None and switch(derivative, flag) else None
        if name == "":
            raise ValueError(f'{derivative} cannot be "": give the name of its array, or True')
        for other in (other for other in named if named[other] == name):
            raise ValueError(f'{other} and {derivative} cannot both be named "{name}": give each its own name')
        if name is not None:
            named[derivative] = name
    return named
