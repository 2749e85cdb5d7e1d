# SPDX-License-Identifier: GPL-3.0-or-later
"""The ParaView plugins that are installed together with this package."""

from __future__ import annotations

from typing import Any, Optional

from ._paths import PLUGIN, PYTHON_PLUGIN

_PROXIES = ("ScatteredIsopoints", "ScatteredIsosurface", "IsopointSplatPolygons")


def loaded_plugins() -> set[str]:
    """The names of the plugins that ParaView has loaded."""
    from paraview import servermanager

    tracker = servermanager.vtkPVPluginTracker.GetInstance()
    return {tracker.GetPluginName(i) for i in range(tracker.GetNumberOfPlugins())
            if tracker.GetPluginLoaded(i)}


def load_plugin(namespace: Optional[dict[str, Any]] = None) -> None:
    """
    Loads the plugin into ParaView, and into the server if there is one, where it has to be under
    the same path: the compiled one if this package was built with ParaView, otherwise that in
    Python. paraview.simple then has ScatteredIsopoints, ScatteredIsosurface and
    IsopointSplatPolygons. Does nothing if it is loaded.

    Parameters
    ----------
    namespace
        Where these are to be as well: globals() after `from paraview.simple import *`.

    Raises
    ------
    ImportError
        If this is not the Python of ParaView.
    RuntimeError
        If the plugin cannot be loaded.
    """
    import inspect

    from paraview import simple

    if not hasattr(inspect, "getargspec"):  # which ParaView 5.11 calls, and Python 3.11 lacks
        setattr(inspect, "getargspec", inspect.getfullargspec)
    path = PLUGIN if PLUGIN.exists() else PYTHON_PLUGIN
    if not {"ScatteredIsopoints", "ScatteredIsopointsPython"} & loaded_plugins():
        simple.LoadPlugin(str(path), remote=False)
    if not hasattr(simple, _PROXIES[0]):  # the server has not loaded it
        simple.LoadPlugin(str(path), remote=True)
    if namespace is not None:
        for name in _PROXIES:
            namespace[name] = getattr(simple, name)
