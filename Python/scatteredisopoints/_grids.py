# SPDX-License-Identifier: GPL-3.0-or-later
"""Grids in bounds, and derivatives as vtkGradientFilter names and orders them."""

from __future__ import annotations

from typing import Any, Callable

import numpy as np
import pyvista as pv


def grid_in(box: np.ndarray, dimensions: Any, spacing: Any) -> pv.ImageData:
    """A grid in bounds, given by its numbers of points or by their distances. Axes without length have a point."""
    if (dimensions is None) == (spacing is None):
        raise TypeError("to_grid() takes either dimensions or spacing")
    sizes = box[:, 1] - box[:, 0]
    if not np.all(sizes >= 0):
        raise ValueError(f"bounds are {box.ravel().tolist()}, not ascending pairs of numbers")
    name, given = ("spacing", spacing) if dimensions is None else ("dimensions", dimensions)
    try:
        wanted = np.broadcast_to(np.asarray(given, dtype=float), 3)
    except (TypeError, ValueError):
        raise ValueError(f"{name} cannot be {given!r}: one number, or three") from None
    if dimensions is None:
        if not np.all(wanted > 0):
            raise ValueError(f"spacing cannot be {spacing!r}: it is greater than 0")
        counts = np.ceil(sizes / wanted * (1 - 1e-12)) + 1
    else:
        if not np.all((wanted >= 1) & (wanted == np.rint(wanted))):
            raise ValueError(f"dimensions cannot be {dimensions!r}: they are whole numbers, 1 or more")
        counts = np.where(sizes > 0, wanted, 1)
        box = np.where(counts[:, None] > 1, box, box.mean(axis=1, keepdims=True))
        wanted = np.where(counts > 1, sizes / np.maximum(counts - 1, 1), 1)
    return pv.ImageData(dimensions=counts.astype(int).tolist(), spacing=wanted.tolist(), origin=box[:, 0].tolist())


def derivatives(gradients: np.ndarray) -> dict[str, Callable[[], np.ndarray]]:
    """Functions that compute what vtkGradientFilter does, by names of PyVista, from gradients of shape (n, c, 3)."""
    def of(component: int, axis: int) -> np.ndarray:
        return gradients[:, component, axis]

    return {
        "gradient": lambda: gradients.reshape(len(gradients), -1),
        "divergence": lambda: np.trace(gradients, axis1=1, axis2=2),
        "vorticity": lambda: np.stack([of(2, 1) - of(1, 2), of(0, 2) - of(2, 0), of(1, 0) - of(0, 1)], axis=-1),
        "qcriterion": lambda: -0.5 * np.einsum("nij,nji->n", gradients, gradients)}
