# SPDX-License-Identifier: GPL-3.0-or-later
"""VTK classes that extract isosurfaces from scattered samples and render them as splats; contour(),
which takes and returns NumPy arrays; load_plugin() and ray_trace() for ParaView's scripts."""

from .vtkScatteredIsopointFilters import *  # noqa: F401,F403
from .vtkScatteredIsopointRendering import *  # noqa: F401,F403
try:
    from .vtkScatteredIsopointRayTracing import *  # noqa: F401,F403
    from .ray_tracing import ray_trace  # noqa: F401
except ModuleNotFoundError:  # built without Embree
    pass
from .contouring import Isosurface, contour  # noqa: F401
from .plugin import load_plugin  # noqa: F401
