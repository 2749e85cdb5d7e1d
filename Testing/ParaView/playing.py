# SPDX-License-Identifier: GPL-3.0-or-later
"""Plays a user's mouse events to ParaView's window, where a script reports what is shown; and the Python package
without compiled classes, as the wheel has it."""

import ctypes
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading
from xml.sax.saxutils import quoteattr

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "Python"))
from checking import check, run  # noqa: E402, F401

# Runs in the window. It reports at each picture, the last time at the end.
LOAD = "simple.LoadPlugin({plugin!r}, ns=globals())"
SCRIPT = """
import json
from paraview import simple
{load}
wavelet = simple.Wavelet()
wavelet.UpdatePipeline()
view = simple.GetActiveViewOrCreate("RenderView")
{more}

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
ISOPOINTS = """
isopoints = ScatteredIsopoints(Input=wavelet)
isopoints.UpdatePipeline()
simple.Show(isopoints, view)
{more}
simple.SetActiveSource(isopoints)
"""

_temporary = tempfile.TemporaryDirectory()  # removed when the script ends
FOLDER = pathlib.Path(_temporary.name)

WINDOW = "pqClientMainWindow/"
VIEWS = WINDOW + "centralwidget/MultiViewWidget/CoreWidget/qt_tabwidget_stackedwidget/MultiViewWidget1/Container/"
PANEL = WINDOW + "propertiesDock/propertiesPanel/"
_FRAMES = PANEL + "scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/"
FRAME, DISPLAY = (_FRAMES + name + "Frame/ProxyPanel/" for name in ("Properties", "Display"))


def event(item, command, arguments=""):
    return f"<pqevent object='{item}' command='{command}' arguments={quoteattr(arguments)} />"


def choose(name):
    return event(WINDOW + "menubar/menuFilters/Alphabetical", "activate", name)


def set_property(name, value):
    kind, command = ("CheckBox", "set_boolean") if value in ("true", "false") else ("ComboBox", "set_string")
    return event(f"{FRAME}{name}/{kind}", command, value)


def set_isovalue(value):
    table = FRAME + "ContourValues/ScalarValueList/Table"
    return [event(table, "edit", "0.0"), event(table, "editAccepted", f"0.0,{value}")]


def set_radius_scale(value):
    return event(DISPLAY + "SplatRadiusScale/DoubleLineEdit0", "set_string", value)


def expect_of(item, state, value):
    return f"<pqcheck object='{item}' property='{state}' arguments={quoteattr(value)} />"


def expect(name, state, value="true"):
    """Checks that the row of a property is in a state: "enabled" or "visible"."""
    return expect_of(FRAME + name, state, value)


def version_of(paraview):
    """The numbers of a version, such as (5, 11, 0)."""
    said = subprocess.run([paraview, "--version"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return tuple(map(int, re.search(r"(\d+)\.(\d+)\.(\d+)", said.stdout).groups()))


def search(paraview, words, *found, are_all=True):
    """Types words into the quick search. Creates the first of the filters that it finds, which have these names there.
    Since 5.13 it searches help too: only the first name is compared.
    @param are_all whether these are all that it finds"""
    is_5_13 = version_of(paraview) >= (5, 13)
    dialog = WINDOW + ("QuickLaunchDialogExtended/" if is_5_13 else "QuickLaunchDialog")
    button = dialog + ("CreateProxy" if is_5_13 else "/selection")
    key_press = 6
    typed = [event(dialog + "Request", "set_string", words)] if is_5_13 else [
        event(dialog, "keyEvent", f"{key_press}:{ord(key)}:0:{key.lower()}:0:1") for key in words.upper()]
    return [event(WINDOW + "menubar/menuFilters", "activate", "Search...\tCtrl+Space"), *typed,
            *([] if is_5_13 else [*[expect_of(dialog + "/options", "count", str(len(found)))] * are_all, *(
                expect_of(dialog + "/options", "modelItemData", f"{row}.0,{name}") for row, name in enumerate(found))]),
            expect_of(button, "text", found[0]), event(button, "activate")]


APPLY = event(PANEL + "Accept", "activate")
ADVANCED = event(PANEL + "SearchBox/AdvancedButton", "set_boolean", "true")


def play(paraview, plugin, events, more="", meanwhile=None, possible=True):
    """Plays events to a window that shows isopoints of a wavelet, while another thread may do something with the
    process.
    @returns what is shown afterwards, by the names of the pipeline's items, and what was printed"""
    script = SCRIPT.format(load=LOAD.format(plugin=plugin), more=ISOPOINTS.format(more=more))
    return play_script([paraview, "--dr"], script, events, meanwhile=meanwhile, possible=possible)


def play_script(command, script, events, meanwhile=None, possible=True, home=None, **environment):
    """play() with the whole script. @param home the folder of the user's settings, by default a new one"""
    folder = tempfile.mkdtemp(dir=FOLDER)
    home = home or folder
    paths = os.path.join(folder, "script.py"), os.path.join(folder, "events.xml")
    pathlib.Path(paths[0]).write_text(script)
    pathlib.Path(paths[1]).write_text("<?xml version='1.0' ?><pqevents>" + "".join(events) + "</pqevents>")
    with subprocess.Popen(
            [*command, "--script=" + paths[0], "--test-script=" + paths[1], "--exit"],
            env=dict(os.environ, HOME=home, XDG_RUNTIME_DIR=home, **environment), stdout=subprocess.PIPE,
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
    check(("Success =  true" in said) == possible, f"events could{' not' * possible} be played")
    check(process.returncode == (0 if possible else 1), f"the window closes: {process.returncode}")
    reports = [line[6:] for line in said.splitlines() if line.startswith("shown:")]
    check(reports, "nothing was reported")
    return json.loads(reports[-1]), said


class _ButtonEvent(ctypes.Structure):
    _fields_ = [(name, getattr(ctypes, "c_" + kind)) for name, kind in (
        ("type", "int"), ("serial", "ulong"), ("send_event", "int"), ("display", "void_p"), ("window", "ulong"),
        ("root", "ulong"), ("subwindow", "ulong"), ("time", "ulong"), ("x", "int"), ("y", "int"), ("x_root", "int"),
        ("y_root", "int"), ("state", "uint"), ("button", "uint"), ("same_screen", "int"))
        ] + [("padding", ctypes.c_long * 24)]


class _WindowAttributes(ctypes.Structure):
    _fields_ = [(name, getattr(ctypes, "c_" + kind)) for name, kind in (
        ("x", "int"), ("y", "int"), ("width", "int"), ("height", "int"), ("border_width", "int"), ("depth", "int"),
        ("visual", "void_p"), ("root", "ulong"), ("class", "int"), ("bit_gravity", "int"), ("win_gravity", "int"),
        ("backing_store", "int"), ("backing_planes", "ulong"), ("backing_pixel", "ulong"), ("save_under", "int"),
        ("colormap", "ulong"), ("map_installed", "int"), ("map_state", "int"), ("all_event_masks", "long"),
        ("your_event_mask", "long"), ("do_not_propagate_mask", "long"), ("override_redirect", "int"),
        ("screen", "void_p"))]


class Mouse:
    """Looks for windows of other programs and clicks in them, through the X server."""

    def __init__(self):
        self._x = ctypes.CDLL("libX11.so.6")
        self._x.XOpenDisplay.restype = ctypes.c_void_p
        self._x.XDefaultRootWindow.restype = ctypes.c_ulong
        self._display = ctypes.c_void_p(self._x.XOpenDisplay(None))
        self._root = ctypes.c_ulong(self._x.XDefaultRootWindow(self._display))
        # A window may be closed while it is looked at.
        self._ignore = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)(lambda *_: 0)
        self._x.XSetErrorHandler(self._ignore)

    def _windows(self):
        """The windows of the screen. No window manager puts windows into others here."""
        ids, children, count = ctypes.c_ulong(), ctypes.POINTER(ctypes.c_ulong)(), ctypes.c_uint()
        self._x.XQueryTree(self._display, self._root, *2 * [ctypes.byref(ids)], ctypes.byref(children),
                           ctypes.byref(count))
        windows = [ctypes.c_ulong(child) for child in children[:count.value]]
        self._x.XFree(children)
        return windows

    def _find(self, title):
        """The window with this title, or None."""
        for window in self._windows():
            name = ctypes.c_char_p()
            if self._x.XFetchName(self._display, window, ctypes.byref(name)) and name.value == title.encode():
                return window
        return None

    def sizes_of_tips(self):
        """The widths and heights of tooltips and menus: windows that no window manager moves."""
        found = []
        for window in self._windows():
            state = _WindowAttributes()
            self._x.XGetWindowAttributes(self._display, window, ctypes.byref(state))
            if state.override_redirect and state.map_state:
                found.append((state.width, state.height))
        return found

    def move(self, x, y):
        """Moves the pointer to a place of the screen."""
        self._x.XWarpPointer(self._display, ctypes.c_ulong(), self._root, 0, 0, 0, 0, x, y)
        self._x.XFlush(self._display)

    def click(self, title, right, bottom):
        """Clicks in the window with this title, so many pixels from its lower right corner."""
        window = self._find(title)
        if window is None:
            return
        # The root, the place, the size, and the border and depth.
        found = ctypes.c_ulong(), *(ctypes.c_int() for _ in range(2)), *(ctypes.c_uint() for _ in range(4))
        self._x.XGetGeometry(self._display, window, *map(ctypes.byref, found))
        width, height = found[3].value, found[4].value
        for kind, state in ((4, 0), (5, 1 << 8)):  # press and release
            sent = _ButtonEvent(type=kind, display=self._display, window=window, root=self._root, state=state, button=1,
                                x=width - right, y=height - bottom, same_screen=1)
            self._x.XSendEvent(self._display, window, 1, 0, ctypes.byref(sent))
        self._x.XFlush(self._display)


def python_alone(library, package):
    """@returns a folder to import a copy of the package from, and the plugin there"""
    copy = FOLDER / "site/scatteredisopoints"
    shutil.copytree(package, copy, ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    (copy / "_paths.py").write_text(
        f"from pathlib import Path\nLIBRARY = {library!r}\nPLUGIN = Path('nothing')\n"
        "PYTHON_PLUGIN = Path(__file__).parent / 'paraview/scattered_isopoints.py'\n")
    return FOLDER / "site", str(copy / "paraview/scattered_isopoints.py")


def run_script(pvbatch, text, **environment):
    """@param pvbatch the program, or a list of it and of what starts it
    @returns the lines that begin with "found:", and what a script of pvbatch printed"""
    (FOLDER / "script.py").write_text(text)
    command = [pvbatch] if isinstance(pvbatch, str) else pvbatch
    done = subprocess.run([*command, str(FOLDER / "script.py")], env=dict(os.environ, **environment), check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    check(done.returncode == 0 and "Traceback" not in done.stdout, f"{text}{done.stdout}")
    return [line for line in done.stdout.splitlines() if line.startswith("found:")], done.stdout
