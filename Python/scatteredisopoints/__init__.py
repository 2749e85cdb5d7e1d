# SPDX-License-Identifier: GPL-3.0-or-later
"""Isosurfaces directly from scattered samples.

contour() takes and returns NumPy arrays, or data sets of VTK and PyVista; Samples keeps the tree between
isovalues. Both only need NumPy. With the project's VTK modules, the package also has their classes; with
its ParaView plugin, load_plugin() and ray_trace().
"""

from __future__ import annotations

import importlib
from typing import Any

from . import _library
from ._isosurface import Isosurface
from ._samples import Samples
from .contouring import contour
from .plugin import load_plugin

__version__ = _library.version().decode()

# Modules of compiled classes; each may be missing. They load VTK, so they are imported on demand.
_COMPILED = ("vtkScatteredIsopointFilters", "vtkScatteredIsopointRendering",
             "vtkScatteredIsopointRayTracing")

_NAMES = ["Isosurface", "Samples", "contour", "load_plugin"]


def __getattr__(name: str) -> Any:
    if name == "__all__":
        return _NAMES + _classes()
    if name.startswith("vtk") or name == "ray_trace":
        modules = ["ray_tracing"] if name == "ray_trace" else [*_COMPILED, "_vtk"]
        for module in map(_module, modules):
            if hasattr(module, name):
                return getattr(module, name)
        raise AttributeError(f"There is no {name} here: install VTK (pip install vtk), or build this"
                             " project with VTK, as its docs/installing.md says.")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *_classes()})


def _classes() -> list[str]:
    """All compiled classes, and ray_trace() if there is a ray tracer."""
    names = [name for module in map(_module, _COMPILED) for name in dir(module)
             if name.startswith("vtk")]
    if not names:
        names = [name for name in dir(_module("_vtk")) if name.startswith(("vtkScattered", "vtkIsopoint"))]
    return names + ["ray_trace"] * any("RayTracer" in name for name in names)


def _module(module: str) -> Any:
    """A module of this package, or None if what it needs is not there for this interpreter: VTK, or
    compiled classes for it."""
    try:
        return importlib.import_module(f".{module}", __name__)
    except ImportError:
        return None
