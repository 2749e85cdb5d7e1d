# SPDX-License-Identifier: GPL-3.0-or-later
"""VTK classes that extract isosurfaces from scattered samples and render them as splats, and
contour(), which takes and returns NumPy arrays; for ParaView's scripts load_plugin()."""

from .vtkScatteredIsopointFilters import *  # noqa: F401,F403
from .vtkScatteredIsopointRendering import *  # noqa: F401,F403
from .contouring import Isosurface, contour  # noqa: F401
from .plugin import load_plugin  # noqa: F401
