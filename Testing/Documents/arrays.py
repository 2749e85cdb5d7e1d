# SPDX-License-Identifier: GPL-3.0-or-later
"""What the documents' examples call positions and values: samples of a sphere."""
import numpy as np

positions = np.random.default_rng(1).random((5000, 3))
values = np.linalg.norm(positions - 0.5, axis=1)
