# SPDX-License-Identifier: GPL-3.0-or-later
"""Traces and states: TestStates.py PLUGIN PVBATCH

A trace loads the plugin automatically. States of ParaView load it from PV_PLUGIN_PATH, and in a second
run nothing is lost: neither what the filters compute nor how it is drawn."""

import os
import shutil
import subprocess
import sys

from paraview import simple, smstate, smtrace

from scripting import FOLDER, check

# What each of them has to be followed by, to be compared.
REPORT = """
from paraview import simple
shown = []
for (name, _), source in sorted(simple.GetSources().items()):
    source.UpdatePipeline()
    shown.append((name, source.GetDataInformation().GetNumberOfPoints()))
for display in simple.GetActiveView().Representations:
    if hasattr(display, "Representation"):
        shown.append((str(display.Representation).strip("'"), display.Visibility))
print("found:", shown, flush=True)
"""


def build():
    wavelet = simple.Wavelet()
    wavelet.UpdatePipeline()
    # A trace of a script has what properties are as filters are created.
    isopoints = simple.ScatteredIsopoints(
        Input=wavelet, Isosurfaces=[200.0], Projection="Cubic fit with creases", DropGaps=1)
    isopoints.UpdatePipeline()
    view = simple.CreateView("RenderView")
    simple.Show(isopoints, view)
    simple.Show(simple.Clip(Input=isopoints), view)
    simple.Hide(isopoints, view)
    simple.Show(simple.ScatteredIsosurface(Input=wavelet), view)
    simple.Render(view)


def run(pvbatch, text, **environment):
    """What a script that was saved finds in a process of its own."""
    path = os.path.join(FOLDER, "saved.py")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text + REPORT)
    done = subprocess.run([pvbatch, path], env=dict(os.environ, **environment), check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
    found = [line for line in done.stdout.splitlines() if line.startswith("found:")]
    check(len(found) == 1, "the script failed:\n" + text + done.stdout)
    return found[0], done.stdout


def main(plugin, pvbatch):
    simple.LoadPlugin(plugin)
    smtrace.start_trace(preamble="")
    build()
    trace = smtrace.stop_trace()
    state = smstate.get_state()
    saved = os.path.join(FOLDER, "state.pvsm")
    simple.SaveState(saved)

    with_path = {"PV_PLUGIN_PATH": os.path.dirname(plugin)}
    expected, output = run(pvbatch, trace)
    print(expected)
    check("('Isopoint Splats', 0), ('Isopoint Splats', 1), ('Surface', 1)" in expected, expected)
    for text in (trace, state, f"from paraview import simple\nsimple.LoadState({saved!r})\n"):
        found, output = run(pvbatch, text, **with_path)
        check("ERR|" not in output, output)
        counts = [line.split(", ('Isopoint Splats'")[0] for line in (found, expected)]
        check(counts[0] == counts[1], f"{found} instead of {expected}")
        check(found.count("('Isopoint Splats', 1)") == 1, found)
    # A second copy of the plugin, as of another build, does not end the program.
    copy = shutil.copy(plugin, FOLDER)
    found, _ = run(
        pvbatch, f"from paraview.simple import *\nLoadPlugin({copy!r})\n" + state, **with_path)
    check("('ScatteredIsopoints1', 1449)" in found and "('Isopoint Splats', 1)" in found, found)
    for text, name in ((trace, "trace"), (state, "state")):
        check("NumberOf" not in text, f"a {name} does not set counters")


main(*sys.argv[1:])
print("passed")
