# SPDX-License-Identifier: GPL-3.0-or-later
"""Isosurfaces straight from scattered samples, as VTK classes."""

from .vtkScatteredIsopointFilters import *  # noqa: F401,F403
from .vtkScatteredIsopointRendering import *  # noqa: F401,F403
