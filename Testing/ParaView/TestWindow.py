# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin in ParaView's window: TestWindow.py PLUGIN PARAVIEW

Events as of a user's mouse are played to the window, in which a script reports what is shown."""

import json
import os
import subprocess
import sys
import tempfile

# Runs in the window. It reports at each picture, the last time at the end.
SCRIPT = """
import json
from paraview import simple
simple.LoadPlugin({plugin!r}, ns=globals())
wavelet = simple.Wavelet()
wavelet.UpdatePipeline()
isopoints = ScatteredIsopoints(Input=wavelet)
isopoints.UpdatePipeline()
view = simple.GetActiveViewOrCreate("RenderView")
simple.Show(isopoints, view)
{more}
simple.SetActiveSource(isopoints)

def report(*_):
    shown = dict()
    for (name, _), source in simple.GetSources().items():
        display = view.SMProxy.FindRepresentation(source.SMProxy, 0)
        if display:
            display = simple.servermanager._getPyProxy(display)
            shown[name] = [display.Visibility, str(display.Representation).strip("'")]
    print("shown:" + json.dumps(shown), flush=True)

view.GetRenderWindow().AddObserver("EndEvent", report)
"""

PANEL = "pqClientMainWindow/propertiesDock/propertiesPanel/"
FRAME = PANEL + "scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/PropertiesFrame/"


def check(condition, message):
    if not condition:
        sys.exit("failed: " + message)


def event(item, command, arguments=""):
    return f"<pqevent object='{item}' command='{command}' arguments='{arguments}' />"


def choose(name):
    return event("pqClientMainWindow/menubar/menuFilters/Alphabetical", "activate", name)


def set_property(name, value):
    kind = "CheckBox" if value in ("true", "false") else "ComboBox"
    command = "set_boolean" if kind == "CheckBox" else "set_string"
    return event(f"{FRAME}ProxyPanel/{name}/{kind}", command, value)


def expect(name, state, value):
    """That the row of a property is in a state: "enabled" or "visible"."""
    return f"<pqcheck object='{FRAME}ProxyPanel/{name}' property='{state}' arguments='{value}' />"


APPLY = event(PANEL + "Accept", "activate")
ADVANCED = event(PANEL + "SearchBox/AdvancedButton", "set_boolean", "true")


def play(paraview, plugin, events, more=""):
    """What is shown after the events, by the names of the pipeline's items."""
    folder = tempfile.mkdtemp()
    script, played = os.path.join(folder, "script.py"), os.path.join(folder, "events.xml")
    with open(script, "w", encoding="utf-8") as file:
        file.write(SCRIPT.format(plugin=plugin, more=more))
    with open(played, "w", encoding="utf-8") as file:
        file.write("<?xml version='1.0' ?><pqevents>" + "".join(events) + "</pqevents>")
    done = subprocess.run(
        [paraview, "--dr", "--script=" + script, "--test-script=" + played, "--exit"],
        env=dict(os.environ, HOME=folder, XDG_RUNTIME_DIR=folder), stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, universal_newlines=True, check=False)
    print(done.stdout)
    check("Success =  true" in done.stdout, "events could not be played")
    reports = [line[6:] for line in done.stdout.splitlines() if line.startswith("shown:")]
    check(reports, "nothing was reported")
    return json.loads(reports[-1])


def inputs_are_hidden(plugin, paraview):
    splats = "Isopoint Splats"
    events = []
    names = ["Clip", "Threshold", "Calculator", "Transform"]
    for name in names:
        events += [choose(name), APPLY]
    shown = play(paraview, plugin, events)
    print(shown)
    check(shown.pop(names[-1] + "1") == [1, splats], "the last filter's output as splats")
    check(sorted(shown) == sorted(["ScatteredIsopoints1", "Calculator1", "Clip1", "Threshold1"]),
          "all filters")
    check(all(each == [0, splats] for each in shown.values()), "inputs are hidden")
    shown = play(paraview, plugin, [choose("Clip"), APPLY],
                 "simple.GetDisplayProperties(isopoints, view).Opacity = 0.5")
    check(all(visible for visible, _ in shown.values()), "translucent inputs stay")


def rows_follow_others(plugin, paraview):
    """What has no effect is grayed out or hidden."""
    counters = ("NumberOfSkippedSamples", "NumberOfUnprojectedPoints")
    for name in ("Scattered Isopoints", "Scattered Isosurface"):
        events = [choose(name), *(expect(counter, "enabled", "false") for counter in counters)]
        events += [expect("DropGaps", "visible", "true"), ADVANCED,
                   expect("KeepTree", "visible", "true"), expect("ContourBlocks", "visible", "false"),
                   expect("NormalMethod", "enabled", "true")]
        points = name == "Scattered Isopoints"
        if points:
            events += [expect("NumberOfNeighbors", "enabled", "true"),
                       expect("MinimumSpacing", "enabled", "true"),
                       set_property("Projection", "Linear fit"),
                       expect("MinimumSpacing", "enabled", "false")]
        events += [set_property("ComputeNormals", "false"), expect("NormalMethod", "enabled", "false"),
                   APPLY]
        play(paraview, plugin, events, "isopoints = wavelet")
    play(paraview, plugin,
         [choose("Scattered Isopoints"), ADVANCED, expect("ContourBlocks", "visible", "true"), APPLY],
         "isopoints = simple.GroupDatasets(Input=[wavelet])\nisopoints.UpdatePipeline()")


def main(plugin, paraview):
    inputs_are_hidden(plugin, paraview)
    rows_follow_others(plugin, paraview)


main(*sys.argv[1:])
print("passed")
