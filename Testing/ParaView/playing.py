# SPDX-License-Identifier: GPL-3.0-or-later
"""Plays a user's mouse events to ParaView's window, where a script reports what is shown."""

import json
import os
import subprocess
import sys
import tempfile
import threading
from xml.sax.saxutils import quoteattr

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

_temporary = tempfile.TemporaryDirectory()  # removed when the script ends
FOLDER = _temporary.name

PANEL = "pqClientMainWindow/propertiesDock/propertiesPanel/"
FRAME = PANEL + "scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/PropertiesFrame/"


def check(condition, message):
    if not condition:
        sys.exit("failed: " + message)


def event(item, command, arguments=""):
    return f"<pqevent object='{item}' command='{command}' arguments={quoteattr(arguments)} />"


def choose(name):
    return event("pqClientMainWindow/menubar/menuFilters/Alphabetical", "activate", name)


def set_property(name, value):
    kind = "CheckBox" if value in ("true", "false") else "ComboBox"
    command = "set_boolean" if kind == "CheckBox" else "set_string"
    return event(f"{FRAME}ProxyPanel/{name}/{kind}", command, value)


def expect_of(item, state, value):
    return f"<pqcheck object='{item}' property='{state}' arguments={quoteattr(value)} />"


def expect(name, state, value):
    """That the row of a property is in a state: "enabled" or "visible"."""
    return expect_of(f"{FRAME}ProxyPanel/{name}", state, value)


APPLY = event(PANEL + "Accept", "activate")
ADVANCED = event(PANEL + "SearchBox/AdvancedButton", "set_boolean", "true")


def play(paraview, plugin, events, more="", meanwhile=None, possible=True):
    """Plays events, while another thread may do something with the process.
    @returns what is shown afterwards, by the names of the pipeline's items, and what was printed"""
    folder = tempfile.mkdtemp(dir=FOLDER)
    script, played = os.path.join(folder, "script.py"), os.path.join(folder, "events.xml")
    with open(script, "w", encoding="utf-8") as file:
        file.write(SCRIPT.format(plugin=plugin, more=more))
    with open(played, "w", encoding="utf-8") as file:
        file.write("<?xml version='1.0' ?><pqevents>" + "".join(events) + "</pqevents>")
    with subprocess.Popen(
            [paraview, "--dr", "--script=" + script, "--test-script=" + played, "--exit"],
            env=dict(os.environ, HOME=folder, XDG_RUNTIME_DIR=folder), stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, universal_newlines=True) as process:
        if meanwhile:
            threading.Thread(target=meanwhile, args=[process], daemon=True).start()
        try:
            said, _ = process.communicate(timeout=300)
        except subprocess.TimeoutExpired:
            process.kill()
            print(process.communicate()[0])
            sys.exit("failed: ParaView waits, in a dialog if an event could not be played")
    print(said)
    check(("Success =  true" in said) == possible,
          "events could not be played" if possible else "events could be played")
    reports = [line[6:] for line in said.splitlines() if line.startswith("shown:")]
    check(reports, "nothing was reported")
    return json.loads(reports[-1]), said
