# SPDX-License-Identifier: GPL-3.0-or-later
"""Traces and states: TestStates.py PLUGIN PVBATCH

A trace loads the plugin automatically. States of ParaView load it from PV_PLUGIN_PATH, and in a second
run nothing is lost: neither what the filters compute nor how it is drawn."""

import os
import shutil
import sys

from paraview import simple, smstate, smtrace

from playing import run_script
from scripting import FOLDER, check, path_of

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
    view = simple.CreateView("RenderView")
    simple.Show(isopoints, view)
    simple.Show(simple.Clip(Input=isopoints), view)
    simple.Hide(isopoints, view)
    simple.Show(simple.ScatteredIsosurface(Input=wavelet), view)
    simple.Show(simple.ScatteredGrid(Input=wavelet, SamplingDimensions=[8, 9, 10]), view)
    simple.Show(simple.ScatteredGradient(Input=wavelet), view)
    simple.Show(simple.ScatteredProbe(Samples=wavelet, DestinationMesh=simple.Sphere()), view)
    simple.ScatteredLine(Input=wavelet, Resolution=30)
    simple.Render(view)


def isopoints_of_a_file():
    """Splats of points that no filter of the plugin makes here."""
    display = simple.Show(simple.XMLPolyDataReader(FileName=[path_of("isopoints.vtp")]))
    display.SplatRadiusScale = 0.5


def polygons_of_a_file():
    simple.IsopointSplatPolygons(Input=simple.XMLPolyDataReader(FileName=[path_of("isopoints.vtp")]))


def polygons_later():
    """A part of a trace, without its beginning."""
    smtrace.reset_trace_output()
    polygons_of_a_file()


def others_load_it_too():
    """Each trace loads the plugin once, before it uses anything of it."""
    simple.SaveData(path_of("isopoints.vtp"), simple.FindSource("ScatteredIsopoints1"), DataMode="Binary")
    for act, expected in ((isopoints_of_a_file, "'Isopoint Splats', 1"), (polygons_of_a_file, "IsopointSplatPolygons1"),
                          (polygons_later, "IsopointSplatPolygons1")):
        for source in simple.GetSources().values():
            simple.Delete(source)
        smtrace.start_trace(preamble="")
        act()
        trace = smtrace.stop_trace()
        check(trace.count("LoadPlugin(") == 1, trace)
        (found,), _ = run_script(pvbatch, "from paraview.simple import *\n" * (act is polygons_later) + trace + REPORT)
        check(expected in found, f"{found} instead of {expected}")


plugin, pvbatch = sys.argv[1:]
simple.LoadPlugin(plugin)
smtrace.start_trace(preamble="")
build()
trace, state = smtrace.stop_trace(), smstate.get_state()
simple.SaveState(path_of("state.pvsm"))

with_path = {"PV_PLUGIN_PATH": os.path.dirname(plugin)}
(expected,), _ = run_script(pvbatch, trace + REPORT)
print(expected)
check("('Isopoint Splats', 0), ('Isopoint Splats', 1), ('Surface', 1)" in expected, expected)
loaded = f"from paraview import simple\nsimple.LoadState({path_of('state.pvsm')!r})\n"
for text in (trace, state, loaded):
    (found,), output = run_script(pvbatch, text + REPORT, **with_path)
    check("ERR|" not in output, output)
    counts = [line.split(", ('Isopoint Splats'")[0] for line in (found, expected)]
    check(counts[0] == counts[1], f"{found} instead of {expected}")
    check(found.count("('Isopoint Splats', 1)") == 1, found)
# A second copy of the plugin, as of another build, does not end the program.
copy = shutil.copy(plugin, FOLDER)
(found,), _ = run_script(pvbatch, f"from paraview.simple import *\nLoadPlugin({copy!r})\n{state}{REPORT}", **with_path)
check("('ScatteredIsopoints1', 1449)" in found and "('Isopoint Splats', 1)" in found, found)
check("NumberOf" not in trace + state, "they do not set counters")
others_load_it_too()
print("passed")
