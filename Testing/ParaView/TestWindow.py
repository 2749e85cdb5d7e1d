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

APPLY = ("propertiesDock/propertiesPanel/Accept", "")


def check(condition, message):
    if not condition:
        sys.exit("failed: " + message)


def menu(name):
    return "menubar/menuFilters/Alphabetical", name


def play(paraview, plugin, events, more=""):
    """What is shown after the events, by the names of the pipeline's items."""
    folder = tempfile.mkdtemp()
    script, played = os.path.join(folder, "script.py"), os.path.join(folder, "events.xml")
    with open(script, "w", encoding="utf-8") as file:
        file.write(SCRIPT.format(plugin=plugin, more=more))
    with open(played, "w", encoding="utf-8") as file:
        file.write("<?xml version='1.0' ?><pqevents>")
        for item, arguments in events:
            file.write(f"<pqevent object='pqClientMainWindow/{item}' command='activate'"
                       f" arguments='{arguments}' />")
        file.write("</pqevents>")
    done = subprocess.run(
        [paraview, "--dr", "--script=" + script, "--test-script=" + played, "--exit"],
        env=dict(os.environ, HOME=folder, XDG_RUNTIME_DIR=folder), stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, universal_newlines=True, check=False)
    print(done.stdout)
    check("Success =  true" in done.stdout, "events could not be played")
    reports = [line[6:] for line in done.stdout.splitlines() if line.startswith("shown:")]
    check(reports, "nothing was reported")
    return json.loads(reports[-1])


def main(plugin, paraview):
    splats = "Isopoint Splats"
    events = []
    names = ["Clip", "Threshold", "Calculator", "Transform"]
    for name in names:
        events += [menu(name), APPLY]
    shown = play(paraview, plugin, events)
    print(shown)
    check(shown.pop(names[-1] + "1") == [1, splats], "the last filter's output as splats")
    check(sorted(shown) == sorted(["ScatteredIsopoints1", "Calculator1", "Clip1", "Threshold1"]),
          "all filters")
    check(all(each == [0, splats] for each in shown.values()), "inputs are hidden")
    shown = play(paraview, plugin, [menu("Clip"), APPLY],
                 "simple.GetDisplayProperties(isopoints, view).Opacity = 0.5")
    check(all(visible for visible, _ in shown.values()), "translucent inputs stay")


main(*sys.argv[1:])
print("passed")
