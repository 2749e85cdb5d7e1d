# SPDX-License-Identifier: GPL-3.0-or-later
"""The ParaView plugin that is installed together with this package."""

from __future__ import annotations

from typing import Any, Optional

from ._paths import PLUGIN


def load_plugin(namespace: Optional[dict[str, Any]] = None) -> None:
    """
    Loads the plugin into ParaView, and into the server if there is one, where it has to be under
    the same path. paraview.simple then has ScatteredIsopoints and ScatteredIsosurface. Does nothing
    if it is loaded.

    Parameters
    ----------
    namespace
        Where these are to be as well: globals() after `from paraview.simple import *`.

    Raises
    ------
    RuntimeError
        If there is no plugin, as in a build without ParaView, or it cannot be loaded.
    """
    if not PLUGIN.exists():
        raise RuntimeError(f"There is no {PLUGIN}: build and install with ParaView")
    from paraview import servermanager, simple

    tracker = servermanager.vtkPVPluginTracker.GetInstance()
    loaded = (tracker.GetPluginName(i) for i in range(tracker.GetNumberOfPlugins())
              if tracker.GetPluginLoaded(i))
    if "ScatteredIsopoints" not in loaded:
        simple.LoadPlugin(str(PLUGIN), remote=False)
    if not hasattr(simple, "ScatteredIsopoints"):  # the server has not loaded it
        simple.LoadPlugin(str(PLUGIN), remote=True)
    if namespace is not None:
        for name in ("ScatteredIsopoints", "ScatteredIsosurface"):
            namespace[name] = getattr(simple, name)
