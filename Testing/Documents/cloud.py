# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples for the scripts of the documents, by PyVista: `cloud`, and the same in the file samples.vtp."""
import numpy as np
import pyvista as pv

cloud = pv.PolyData(np.random.default_rng(1).uniform(-1.0, 1.0, (20_000, 3)))
cloud["density"] = np.linalg.norm(cloud.points, axis=1)
cloud.save("samples.vtp")
