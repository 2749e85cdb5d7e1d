# SPDX-License-Identifier: GPL-3.0-or-later
"""The ParaView plugins that are installed together with this package."""

from __future__ import annotations

from typing import Any, Optional

from ._paths import PLUGIN, PYTHON_PLUGIN

PROXIES = ("ScatteredIsopoints", "ScatteredIsosurface", "IsopointSplatPolygons", "ScatteredProbe", "ScatteredLine",
           "ScatteredGrid", "ScatteredGradient", "ScatteredSlice", "ScatteredBody")
"""The names of the filters in ParaView."""


def loaded_plugins() -> set[str]:
    """The names of the plugins that ParaView has loaded."""
    from paraview.modules.vtkRemotingCore import vtkPVPluginTracker  # servermanager would make a session of its own

    tracker = vtkPVPluginTracker.GetInstance()
    return {tracker.GetPluginName(i) for i in range(tracker.GetNumberOfPlugins())
            if tracker.GetPluginLoaded(i)}


def load_plugin(namespace: Optional[dict[str, Any]] = None) -> None:
    """Loads the plugin into ParaView, and into a connected server, where it must have the same path.

    Loads the compiled plugin if this package was built with ParaView, otherwise the plugin in Python.
    paraview.simple then has ScatteredIsopoints, ScatteredIsosurface, IsopointSplatPolygons, ScatteredProbe,
    ScatteredLine, ScatteredGrid, ScatteredGradient, ScatteredSlice and ScatteredBody. Does nothing if the plugin is
    loaded.

    Parameters
    ----------
    namespace
        Another namespace for these: globals() after `from paraview.simple import *`.

    Raises
    ------
    ImportError
        If this is not ParaView's Python.
    RuntimeError
        If the plugin cannot be loaded.
    """
    import inspect

    from paraview import simple

    if not hasattr(inspect, "getargspec"):  # ParaView 5.11 calls it, Python 3.11 lacks it
        setattr(inspect, "getargspec", inspect.getfullargspec)
    path = PLUGIN if PLUGIN.exists() else PYTHON_PLUGIN
    if not {"ScatteredIsopoints", "ScatteredIsopointsPython"} & loaded_plugins():
        simple.LoadPlugin(str(path), remote=False)
    if not hasattr(simple, PROXIES[0]):  # the server has not loaded it
        simple.LoadPlugin(str(path), remote=True)
    if namespace is not None:
        for name in PROXIES:
            namespace[name] = getattr(simple, name)
