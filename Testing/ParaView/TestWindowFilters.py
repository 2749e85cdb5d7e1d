# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters for values at places in ParaView's window: TestWindowFilters.py PLUGIN PARAVIEW PVBATCH [MPIEXEC...]

A user applies each filter, drags its widget, undoes and redoes that, and saves data and the state. The saved data are
the same for undone and redone changes, and in plain pvbatch by the trace and by the state, on one and on three
ranks."""

import json
import re
import sys

import numpy as np

from playing import (
    APPLY, FOLDER, FRAME, LOAD, SCRIPT, VIEWS, WINDOW, check, choose, event, play_script, run, run_script, set_property,
    version_of)

PLUGIN, PARAVIEW, PVBATCH, *RANKS = sys.argv[1:]
INPUTS = WINDOW + "SelectInputDialog/"
LINEAR = [set_property("Interpolation", "Linear fit")]
UNDO, REDO = (event(WINDOW + "menubar/menu_Edit", "activate", "actionEdit" + name) for name in ("Undo", "Redo"))

# A cube of samples with two time steps. Its diagonal (1, 1, 1) is upright in the middle of the view, from 0.21 to 0.79
# of the height.
SAMPLES = """
from paraview import smtrace
simple.Delete(wavelet)
smtrace.start_trace(preamble="")
{before}
table = simple.CSVReader(FileName={files})
samples = simple.TableToPoints(Input=table, XColumn="x", YColumn="y", ZColumn="z")
simple.Show(samples, view)
view.CameraParallelProjection, view.CameraParallelScale = 1, 1.5
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [4.5, -3.5, 0.5], 3 * [0.5], [1, 1, 1]
active = samples
{after}
simple.SetActiveSource(active)
view.GetRenderWindow().AddObserver(
    "EndEvent", lambda *_: print("trace:" + json.dumps(smtrace.get_current_trace_output()), flush=True))
"""
# Follows a trace or a state.
SAVES = """
from paraview import simple
simple.SaveData({path!r}, proxy=simple.FindSource({name!r}))
"""


def write_samples():
    """@returns the names of the files of two time steps"""
    places = np.random.default_rng(3).random((2000, 3))
    paths = []
    for step in range(2):
        paths.append(str(FOLDER / f"samples.{step}.csv"))
        np.savetxt(paths[-1], np.column_stack([places, (1 + step) * np.sin(3 * places).sum(axis=1)]), "%.17g", ",",
                   header="x,y,z,value", comments="")
    return paths


def dragged(frame, *places):
    """Presses the left button at the first place, moves to the others, and releases it at the last. The places are
    shares of the width and the height of a view."""
    view = VIEWS + f"Frame.{frame}/CentralWidgetFrame/Viewport/1QVTKOpenGLNativeWidget0"
    at = [f"({x},{y}," for x, y in places]
    return [event(view, "mouseMove", at[0] + "0,0,0)"), event(view, "mousePress", at[0] + "1,1,0)"),
            *(event(view, "mouseMove", each + "0,1,0)") for each in at[1:]),
            event(view, "mouseRelease", at[-1] + "1,0,0)")]


def saved(name):
    return [event(WINDOW + "menubar/menu_File", "activate", "actionFileSaveData"),
            event(WINDOW + "FileSaveDialog", "filesSelected", str(FOLDER / (name + ".csv"))),
            event(WINDOW + "WriterSettingsDialog/widget/OKButton", "activate")]


def read_table(name):
    """The points that no other rank has too."""
    table = np.genfromtxt(FOLDER / (name + ".csv"), delimiter=",", names=True, deletechars="")
    return table[table["vtkGhostType"] != 1] if "vtkGhostType" in table.dtype.names else table


def equal(table, other):
    """Whether tables have the same rows. Ranks write their parts one after another, and images share points."""
    rows = [np.unique(np.nan_to_num([each[name] for name in sorted({*each.dtype.names} - {"vtkGhostType"})], nan=-1e9),
                      axis=1) for each in (table, other)]
    return np.array_equal(*rows)


def play_samples(events, before="", after=""):
    """Plays events to a window where scripts do something before and after they show the samples."""
    script = SCRIPT.format(load=LOAD.format(plugin=PLUGIN),
                           more=SAMPLES.format(files=write_samples(), before=before, after=after))
    shown, said = play_script([PARAVIEW, "--dr"], script, events)
    check(not re.search("ERR|WARN", said), said)
    return shown, said


def use(name, change, chosen=(), before="", after="", again=None):
    """A user applies a filter, changes it, undoes and redoes that, and saves the state. Scripts of pvbatch repeat that.
    @param again the events of the change after it was undone, if they differ
    @returns the output shown, and the data before and after the change"""
    state = str(FOLDER / "state.pvsm")
    # Saving data clears what can be redone.
    shown, said = play_samples([
        choose(name), *chosen, APPLY, *saved("first"), *change, APPLY, UNDO, *saved("undone"), *(again or change),
        APPLY, UNDO, REDO, *saved("changed"),
        event(WINDOW + "menubar/menu_File", "activate", "actionFileSaveServerState"),
        event(WINDOW + "FileSaveServerStateDialog", "filesSelected", state)], before, after)
    first, undone, changed = map(read_table, ("first", "undone", "changed"))
    check(equal(first, undone), "undo")
    check(not equal(first, changed), "redo")

    trace = json.loads([line[6:] for line in said.splitlines() if line.startswith("trace:")][-1])
    trace = re.sub(r'cSVReader1\.Preview = """.*?"""', "", trace, flags=re.DOTALL)  # ParaView 6.1 cannot set it
    loaded = f"from paraview import simple\nsimple.LoadPlugin({PLUGIN!r})\nsimple.LoadState({state!r})\n"
    commands = [(trace, []), (trace, RANKS), (loaded, [])]
    if version_of(PARAVIEW) < (6,):  # ParaView 6.1 loads no state at all on several ranks
        commands.append((loaded, RANKS))
    for text, command in commands:
        (FOLDER / "again.csv").unlink(missing_ok=True)
        run_script([*command, PVBATCH], text + SAVES.format(path=str(FOLDER / "again.csv"), name=name + "1"))
        check(equal(changed, read_table("again")), f"the same by {' '.join([*command, 'pvbatch'])}: {text}")
    return shown, first, changed


def slices_follow_the_plane():
    """The left button pushes the plane from x = 0.5 along its normal. The samples are hidden."""
    shown, first, moved = use("ScatteredSlice", dragged(0, (0.5, 0.42), (0.53, 0.4), (0.56, 0.38)))
    check(shown == {"ScatteredSlice1": [1, "Surface"], "TableToPoints1": [0, "Surface"]}, str(shown))
    for table, least, most in ((first, 0.499, 0.501), (moved, 0.6, 0.8)):
        x = table["Points:0"]
        check(len(x) > 100 and np.ptp(x) == 0 and least < x[0] < most, str(x))


def plots_follow_the_end_of_the_line():
    """The plot is beside the view of the samples, where the left button moves the end of the line from a corner to a
    place between the corners."""
    places = (0.5, 0.789), (0.5, 0.7), (0.5, 0.6)
    # ParaView 6.1 also takes back the view of the plot, as that of Plot Over Line.
    again = dragged(0, *places) if version_of(PARAVIEW) >= (6,) else None
    shown, first, moved = use("ScatteredLine", dragged(1, *places), again=again)
    check(shown == {"TableToPoints1": [1, "Surface"]}, str(shown))
    for table, least, most in ((first, 0, 0.01), (moved, 0.2, 0.5)):
        x, y = table["Points:0"], table["Points:1"]
        check(len(x) == 1001 and least < x[0] < most and x[-1] > 0.99 and np.allclose(x, y, atol=0.02), str(x))
        inside = table["vtkValidPointMask"] == 1
        check(inside.sum() > 600 and np.ptp(table["arc_length"]) > 0.8, "values along the line")


def images_fill_the_bounds():
    dimensions = [event(FRAME + f"SamplingDimensions/LineEdit{i}", "set_string", str(9 + i)) for i in range(3)]
    shown, first, _ = use("ScatteredGrid", LINEAR, dimensions)
    check(shown["ScatteredGrid1"][0] and len(first) == 9 * 10 * 11, str(shown))


def gradients_are_at_the_samples():
    shown, first, _ = use("ScatteredGradient", LINEAR)
    check(shown["ScatteredGradient1"][0] and len(first) == 2000, str(shown))
    errors = first["Gradient:0"] - 3 * np.cos(3 * first["Points:0"])
    check(np.sqrt(np.mean(errors ** 2)) < 0.1, "the gradient of a sum of sines")


# The edges of the cube: the samples around its middle, and around those of its sides, have larger values.
FRAME_OF_CUBE = """
active = simple.Clip(Input=samples, ClipType="Scalar", Scalars=["POINTS", "value"], Value=1.7)
simple.Show(active, view)
"""


def bodies_become_hulls():
    """Points of both are samples."""
    shown, body, hull = use("ScatteredBody", [set_property("DropGaps", "false")], after=FRAME_OF_CUBE)
    check(shown["ScatteredBody1"] == [1, "Surface"], str(shown))
    check(50 < len(hull) < len(body), f"{len(body)} points of the body, {len(hull)} of its hull")
    check(np.allclose(body["value"], sum(np.sin(3 * body[f"Points:{i}"]) for i in range(3)), atol=1e-3), "values")


def probes_ask_for_their_places():
    """A dialog asks for the data set of the places."""
    shown, first, _ = use("ScatteredProbe", LINEAR, [
        event(INPUTS + "buttonFrame/Source", "set_boolean", "true"),
        event(INPUTS + "pipelineView", "currentChanged", "/0:0/0:0|0"),
        event(INPUTS + "buttonBox/1QPushButton0", "activate")], "simple.Sphere(Center=3 * [0.5], Radius=0.4)")
    check(shown["ScatteredProbe1"][0] and len(first) == 50 and all(first["vtkValidPointMask"] == 1), str(shown))


# Moves the slice of the second time step, whose values are twice as large.
MOVING_SLICE = """
active = ScatteredSlice(Input=samples)
simple.Show(active, view)
track = simple.GetAnimationTrack("ContourValues", index=0, proxy=active)
track.KeyFrames = [simple.CompositeKeyFrame(KeyTime=time, KeyValues=[offset]) for time, offset in ((0, -0.2), (1, 0.3))]
simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
"""


def time_moves_slices():
    play_samples([*saved("first"), event(WINDOW + "VCRToolbar/1QToolButton5", "activate"), *saved("changed")],
                 after=MOVING_SLICE)
    for name, place, factor in (("first", 0.3, 1), ("changed", 0.8, 2)):
        table = read_table(name)
        check(np.allclose(table["Points:0"], place, atol=1e-3), f"{name}: {table['Points:0'][:3]}")
        expected = factor * sum(np.sin(3 * table[f"Points:{i}"]) for i in range(3))
        check(len(table) > 100 and np.mean(np.abs(table["value"] - expected)) < 0.01, f"{name}: values of the step")


run(slices_follow_the_plane, plots_follow_the_end_of_the_line, images_fill_the_bounds, gradients_are_at_the_samples,
    bodies_become_hulls, probes_ask_for_their_places, time_moves_slices)
