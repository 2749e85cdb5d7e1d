# SPDX-License-Identifier: GPL-3.0-or-later
"""Derivatives as vtkGradientFilter defines and orders them."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._options import switch


def _divergence(of: np.ndarray) -> np.ndarray:
    return of[:, 0, 0] + of[:, 1, 1] + of[:, 2, 2]


def _vorticity(of: np.ndarray) -> np.ndarray:
    return np.stack([of[:, 2, 1] - of[:, 1, 2], of[:, 0, 2] - of[:, 2, 0], of[:, 1, 0] - of[:, 0, 1]], axis=-1)


def _q_criterion(of: np.ndarray) -> np.ndarray:
    xx, yy, zz = (of[:, i, i] for i in range(3))
    xy, xz, yz = (of[:, i, j] * of[:, j, i] for i, j in ((0, 1), (0, 2), (1, 2)))
    return -0.5 * (xx * xx + yy * yy + zz * zz) - (xy + xz + yz)


# In the order of operations of the compiled filter, for the same bytes.
DERIVATIVES = {
    "gradient": lambda gradients: gradients.reshape(len(gradients), -1),
    "divergence": _divergence,
    "vorticity": _vorticity,
    "qcriterion": _q_criterion}
"""Functions of gradients of shape (n, c, 3), by names of PyVista. All but the gradient need vectors."""


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
