# SPDX-License-Identifier: GPL-3.0-or-later
"""Isosurfaces directly from scattered samples.

contour() takes and returns NumPy arrays, or data sets of VTK and PyVista; body() gives the closed surface of all
samples, slice_samples() gives slices, and probe() and gradient() interpolate samples at places; Samples keeps the tree
between calls. All only need NumPy.
load_plugin() serves scripts of ParaView, ray_trace() makes ray-traced pictures by Mitsuba. With the project's VTK
modules, the package also has their classes.
"""

from __future__ import annotations

import importlib
import importlib.util
import sys
from typing import TYPE_CHECKING, Any

from . import _library
# Type checkers take only names imported as themselves for exported.
from ._functions import body as body
from ._functions import contour as contour
from ._functions import gradient as gradient
from ._functions import probe as probe
from ._functions import slice_samples as slice_samples
from ._interpolator import Interpolator as Interpolator
from ._isosurface import Isosurface as Isosurface
from ._measures import Piece as Piece
from ._ray_tracing import ray_trace as ray_trace
from ._samples import Samples as Samples
from .plugin import load_plugin as load_plugin

__version__ = _library.version().decode()

# What needs VTK, and the modules that have it. Each may be missing, and is imported on demand.
_COMPILED = ("vtkScatteredIsopointFilters", "vtkScatteredIsopointRendering")
_MODULES = {
    **dict.fromkeys(("vtkIsopointSplatPolygons", "vtkScatteredBodyFilter", "vtkScatteredGradientFilter",
                     "vtkScatteredGridFilter", "vtkScatteredIsopointFilter", "vtkScatteredIsosurfaceFilter",
                     "vtkScatteredLineFilter", "vtkScatteredProbeFilter", "vtkScatteredSliceFilter"),
                    (*_COMPILED, "_vtk")),
    **dict.fromkeys(("vtkIsopointPolygonMapper", "vtkIsopointSplatMapper",
                     "vtkScatteredAlgorithm", "vtkScatteredContourFilter", "vtkScatteredSurfaceFilter"), _COMPILED)}

if TYPE_CHECKING:
    _any: Any = None
    vtkIsopointPolygonMapper = vtkIsopointSplatMapper = _any
    vtkIsopointSplatPolygons = vtkScatteredAlgorithm = vtkScatteredBodyFilter = vtkScatteredContourFilter = _any
    vtkScatteredGradientFilter = vtkScatteredGridFilter = vtkScatteredIsopointFilter = vtkScatteredLineFilter = _any
    vtkScatteredIsosurfaceFilter = vtkScatteredProbeFilter = vtkScatteredSliceFilter = vtkScatteredSurfaceFilter = _any
else:
    def __getattr__(name):
        if name == "__all__":
            return ["Interpolator", "Isosurface", "Piece", "Samples", "body", "contour", "gradient", "load_plugin",
                    "probe", "ray_trace", "slice_samples", *_found()]
        if name not in _MODULES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        for module in map(_module, _MODULES[name]):
            if hasattr(module, name):
                return getattr(module, name)
        # "from scatteredisopoints import ..." replaces the text of an AttributeError; hasattr() raises all others.
        is_import = sys._getframe(1).f_code.co_name == "_handle_fromlist"  # of importlib
        kind = ImportError if is_import else AttributeError
        if "_vtk" in _MODULES[name] and importlib.util.find_spec("vtkmodules") is None:
            raise kind(f"{name} needs VTK: pip install vtk")
        raise kind(f"{name} needs classes that are compiled for this interpreter's VTK: build this"
                   " project's source with VTK (cmake --preset vtk) or ParaView (cmake --preset release).")

    def __dir__():
        return sorted({*globals(), *_found()})


def _found() -> list[str]:
    """The names of _MODULES that are there."""
    return [name for name, modules in _MODULES.items() if any(hasattr(_module(each), name) for each in modules)]


def _module(module: str) -> Any:
    """A module of this package, or None if what it needs is not there for this interpreter: VTK, or
    compiled classes for it."""
    try:
        return importlib.import_module(f".{module}", __name__)
    except ImportError:
        return None
