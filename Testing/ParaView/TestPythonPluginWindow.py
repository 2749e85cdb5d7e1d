# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin in Python in ParaView's window: TestPythonPluginWindow.py LIBRARY PACKAGE PARAVIEW"""

import os
import pathlib
import sys

from playing import ADVANCED, APPLY, FOLDER, check, choose, expect, play, set_property
from python_site import python_alone

# Python 3.11 lacks what ParaView 5.11 calls for plugins in Python.
CUSTOMIZED = """
import inspect
if not hasattr(inspect, "getargspec"):
    inspect.getargspec = inspect.getfullargspec
"""


def main(library, package, paraview):
    folder = pathlib.Path(FOLDER)
    site = python_alone(folder, library, package)
    (site / "sitecustomize.py").write_text(CUSTOMIZED)
    os.environ["PYTHONPATH"] = str(site)
    plugin = str(site / "scatteredisopoints/paraview/scattered_isopoints.py")
    state = str(folder / "state.pvsm")
    shown, _ = play(paraview, plugin, [
        choose("Scattered Isosurface"), expect("DropGaps", "visible", "true"),
        set_property("Projection", "Quadratic fit"), set_property("DropGaps", "false"),
        set_property("Regularize", "false"), APPLY,
        ADVANCED, expect("KeepTree", "visible", "true")],
        f"isopoints.Isosurfaces = [150.0]\nsimple.SaveState({state!r})\nsimple.SetActiveSource(wavelet)\n"
        "simple.SetActiveSource = lambda _: None")
    check(shown == {"ScatteredIsopoints1": [1, "Surface"], "ScatteredIsosurface1": [1, "Surface"]},
          f"both surfaces are shown: {shown}")
    shown, said = play(paraview, plugin, [APPLY], (
        "simple.ResetSession()\n"
        f"simple.LoadState({state!r})\n"
        "view = simple.GetActiveView()\n"
        "isopoints = simple.FindSource('ScatteredIsopoints1')\n"
        "print('loaded:', list(isopoints.Isosurfaces), flush=True)"))
    check("loaded: [150.0]" in said and shown.get("ScatteredIsopoints1") == [1, "Surface"],
          f"the state is loaded: {shown}")


if __name__ == "__main__":
    main(*sys.argv[1:])
