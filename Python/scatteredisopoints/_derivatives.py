# SPDX-License-Identifier: GPL-3.0-or-later
"""Derivatives as vtkGradientFilter defines and orders them."""

from __future__ import annotations

import numpy as np


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
