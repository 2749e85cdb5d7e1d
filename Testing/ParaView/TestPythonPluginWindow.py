# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin in Python in ParaView's window: TestPythonPluginWindow.py LIBRARY PACKAGE PARAVIEW"""

import os
import sys

from playing import (
    ADVANCED, APPLY, FOLDER, SCRIPT, check, choose, expect, play, play_script, python_alone, set_property)

library, package, paraview = sys.argv[1:]
site, plugin = python_alone(library, package)
# Python 3.11 lacks what ParaView 5.11 calls for plugins in Python.
(site / "sitecustomize.py").write_text(
    "import inspect\nif not hasattr(inspect, 'getargspec'):\n    inspect.getargspec = inspect.getfullargspec\n")
os.environ["PYTHONPATH"] = str(site)
state = str(FOLDER / "state.pvsm")
shown, _ = play(paraview, plugin, [
    choose("Scattered Isosurface"), expect("DropGaps", "visible"),
    set_property("Projection", "Quadratic fit"), set_property("DropGaps", "false"),
    set_property("Regularize", "false"), APPLY, ADVANCED, expect("KeepTree", "visible")],
    f"isopoints.Isosurfaces = [150.0]\nsimple.SaveState({state!r})\nsimple.SetActiveSource(wavelet)\n"
    "simple.SetActiveSource = lambda _: None")
check(shown == {"ScatteredIsopoints1": [1, "Surface"], "ScatteredIsosurface1": [1, "Surface"]},
      f"both surfaces are shown: {shown}")
shown, said = play(paraview, plugin, [APPLY], (
    f"simple.ResetSession()\nsimple.LoadState({state!r})\nview = simple.GetActiveView()\n"
    "isopoints = simple.FindSource('ScatteredIsopoints1')\n"
    "print('loaded:', list(isopoints.Isosurfaces), flush=True)"))
check("loaded: [150.0]" in said and shown.get("ScatteredIsopoints1") == [1, "Surface"], f"the state is loaded: {shown}")

# Loaded before there is a window.
shown, said = play_script([paraview, "--dr"], SCRIPT.format(
    load="print('sessions:', len(simple.servermanager.Connections), flush=True)",
    more="simple.SetActiveSource(wavelet)"),
    [choose("Scattered Isosurface"), APPLY], PV_PLUGIN_PATH=os.path.dirname(plugin))
check("sessions: 1" in said and shown.get("ScatteredIsosurface1") == [1, "Surface"], f"one session: {shown}")
