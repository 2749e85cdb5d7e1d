# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin in ParaView's window: TestWindow.py PLUGIN PARAVIEW"""

import os
import re
import subprocess
import sys
import time

from mouse import Mouse
from playing import (
    ADVANCED, APPLY, FOLDER, FRAME, check, choose, event, expect, expect_of, play, set_property)


def inputs_are_hidden(plugin, paraview):
    splats = "Isopoint Splats"
    events = []
    names = ["Clip", "Threshold", "Calculator", "Transform"]
    for name in names:
        events += [choose(name), APPLY]
    shown, _ = play(paraview, plugin, events)
    print(shown)
    check(shown.pop(names[-1] + "1") == [1, splats], "the last filter's output as splats")
    check(sorted(shown) == sorted(["ScatteredIsopoints1", "Calculator1", "Clip1", "Threshold1"]),
          "all filters")
    check(all(each == [0, splats] for each in shown.values()), "inputs are hidden")
    shown, _ = play(paraview, plugin, [choose("Clip"), APPLY],
                    "simple.GetDisplayProperties(isopoints, view).Opacity = 0.5")
    check(all(visible for visible, _ in shown.values()), "translucent inputs stay")


def rows_follow_others(plugin, paraview):
    """What has no effect is grayed out or hidden."""
    for name in ("Scattered Isopoints", "Scattered Isosurface"):
        events = [choose(name), expect("DropGaps", "visible", "true"), ADVANCED,
                   expect("KeepTree", "visible", "true"), expect("ContourBlocks", "visible", "false"),
                   expect("NormalMethod", "enabled", "true")]
        points = name == "Scattered Isopoints"
        if not points:
            events += [expect("Regularize", "visible", "true")]
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


def counters_are_texts(plugin, paraview):
    """Counts and what they are a part of, of each update, in labels; one of the wavelet's 9261 samples
    is not finite."""
    more = """
isopoints = simple.ProgrammableFilter(Input=wavelet, CopyArrays=1, Script='''
import numpy as np
values = np.array(inputs[0].PointData["RTData"])
values[0] = np.nan
output.PointData.append(values, "RTData")
''')
isopoints.UpdatePipeline()
"""
    panel = f"{FRAME}ProxyPanel/isopoint_counts/"
    for name in ("Scattered Isopoints", "Scattered Isosurface"):
        _, said = play(paraview, plugin, [
            choose(name), expect_of(panel + "NumberOfSkippedSamples", "text", ""),
            expect_of(panel + "NumberOfDroppedInGaps", "text", ""),
            expect_of(f"{FRAME}ProxyPanel/1QWidget3/1QLabel0", "text", "<html><b>Last Update</b></html>"),
            APPLY,
            expect_of(panel + "NumberOfSkippedSamples", "text", "1 of 9261")], more)
        # Splats are too coarse for this field, as a message says.
        others = [line for line in said.splitlines() if "Splats do not meet" not in line]
        check(not any(word in line for line in others for word in ("WARN", "Warning")),
              "no message without a problem")


def help_is_at_labels(plugin, paraview):
    """The first label of the panel."""
    play(paraview, plugin, [
        choose("Scattered Isopoints"),
        expect_of(f"{FRAME}ProxyPanel/1QLabel0", "toolTip",
                  '<html><head/><body><p align="justify">The scalar, at points or cells, whose isosurfaces '
                  "are extracted. By default the active scalars, unless there are none or they are "
                  "constant or ids: then the first array in the list that is neither constant nor "
                  "ids.</p></body></html>")])


def is_5_13_or_later(paraview):
    """Whether it is ParaView 5.13 or later, where the search and labels are other widgets."""
    version = subprocess.run([paraview, "--version"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                             universal_newlines=True, check=True).stdout
    return tuple(map(int, re.search(r"(\d+)\.(\d+)", version).groups())) >= (5, 13)


def search_events(paraview, words):
    """That type words into the dialog of the search. @returns also its button for what was found"""
    opened = event("pqClientMainWindow/menubar/menuFilters", "activate", "Search...\tCtrl+Space")
    if is_5_13_or_later(paraview):
        dialog = "pqClientMainWindow/QuickLaunchDialogExtended/"
        return [opened, event(dialog + "Request", "set_string", words)], dialog + "CreateProxy"
    dialog = "pqClientMainWindow/QuickLaunchDialog"
    key_press = 6
    return [opened] + [event(dialog, "keyEvent", f"{key_press}:{ord(key)}:0:{key.lower()}:0:1")
                       for key in words.upper()], dialog + "/selection"


def search_finds_the_filters_by_contour(plugin, paraview):
    for name in ("Isopoints", "Isosurface"):
        events, button = search_events(paraview, f"contour {name}")
        events += [expect_of(button, "text", f"Scattered {name} (contour)"), event(button, "activate"), APPLY]
        shown, _ = play(paraview, plugin, events, "isopoints = wavelet")
        check(len(shown) == 2, f"{name} were created")


def an_empty_slice_is_explained(plugin, paraview):
    advice = "the triangles of Scattered Isosurface"
    _, said = play(paraview, plugin, [choose("Slice"), APPLY])
    check(said.count(advice) == 1, "it is said once what to slice")
    _, said = play(paraview, plugin, [choose("Slice"), APPLY], "isopoints = wavelet")
    check(advice not in said, "a slice of a grid is no reason")


def isovalues_follow_the_array(plugin, paraview):
    """In the panel, before anything is applied."""
    more = """
isopoints = simple.Calculator(Input=wavelet, ResultArrayName="small", Function="RTData / 1000")
isopoints.UpdatePipeline()
"""
    array = event(f"{FRAME}ProxyPanel/SelectInputScalars/ComboBox", "set_string", "small")
    _, said = play(paraview, plugin, [choose("Scattered Isopoints"), array, APPLY], more)
    check("No isosurface" not in said, "the isovalue is in the range of the array")


def pictures_are_traced(plugin, paraview):
    """By an entry of the menu, with a button that stops it; an empty view is not."""
    path = os.path.join(FOLDER, "traced.png")
    options = "pqClientMainWindow/RayTracingOptions/"
    panel = options + "scrollArea/qt_scrollarea_viewport/Container/ProxyWidget/"
    samples = panel + "SamplesPerPixel/IntRangeWidget/"
    label = panel + ("LightAngleLabel" if is_5_13_or_later(paraview) else "1QLabel2")
    choose_file = [
        event("pqClientMainWindow/menubar/menu_File", "activate", "actionExportRayTracedPicture"),
        event("pqClientMainWindow/FileExportDialog", "filesSelected", path)]
    for count, meanwhile in (("2000", stop_tracing), ("1", None)):
        play(paraview, plugin, [
            *choose_file, expect_of(samples + "Slider", "maximum", "256"),
            expect_of(label, "toolTip", '<html><head/><body><p align="justify">The apparent size '
                      "of lights, in degrees. Larger lights cast softer shadows.</p></body></html>"),
            event(samples + "LineEdit", "set_string", count),
            event(options + "widget/OKButton", "activate")], meanwhile=meanwhile)
        check(os.path.exists(path) == (not meanwhile), f"{count} samples: stopped or written")
    play(paraview, plugin, choose_file, "simple.Hide(isopoints, view)", possible=False)


def stop_tracing(paraview):
    """Clicks at the button in the lower right corner of the dialog while rays are traced."""
    mouse = Mouse()
    while paraview.poll() is None:
        mouse.click("Ray Tracing", 50, 25)
        time.sleep(0.2)


# Selects points in three steps, and tells at each picture what of them a filter has.
SELECTS = """
simple.Render(view)
width, height = view.ViewSize
for low, high, modifier in ((0.4, 0.5, None), (0.5, 0.6, "ADD"), (0.45, 0.55, "SUBTRACT")):
    simple.SelectSurfacePoints(
        View=view, Rectangle=[int(low * width), 0, int(high * width), height], Modifier=modifier)
of_script = simple.ExtractSelection(Input=isopoints)
of_script.UpdatePipeline()
expected = of_script.GetDataInformation().GetNumberOfPoints()
simple.Delete(of_script)
simple.Show(isopoints, view)

def tell(*_):
    extract = simple.FindSource("ExtractSelection1")
    if extract:
        active = isopoints.SMProxy.GetSelectionInput(0).GetProperty("Input")
        kinds = [active.GetProxy(i).GetProperty("ContainingCells").GetElement(0)
                 for i in range(active.GetNumberOfProxies())]
        info = extract.GetDataInformation()
        print("extracted:", expected == info.GetNumberOfPoints() == info.GetNumberOfCells() > 20,
              sorted(extract.CellData.keys()), kinds, flush=True)

view.GetRenderWindow().AddObserver("EndEvent", tell)
"""


def selected_points_keep_their_shapes(plugin, paraview):
    """Extract Selection has the vertices of points; the active selection can be added to as before."""
    shown, said = play(paraview, plugin, [choose("ExtractSelection"), APPLY], SELECTS)
    check(shown["ExtractSelection1"] == [1, "Isopoint Splats"], "the selection as splats")
    last = [line for line in said.splitlines() if line.startswith("extracted:")][-1]
    check(last == "extracted: True ['SplatAxis', 'SplatPolygon'] [0, 0, 0]", last)
    # Where nothing is selected, nothing is extracted.
    twice = [choose("ExtractSelection"), APPLY, choose("ExtractSelection"), APPLY]
    shown, _ = play(paraview, plugin, twice, SELECTS)
    check("ExtractSelection2" in shown, "an extract of an extract")
    shown, _ = play(paraview, plugin, [choose("ExtractSelection"), APPLY])
    check("ExtractSelection1" in shown, "an extract of nothing")


def main(plugin, paraview):
    inputs_are_hidden(plugin, paraview)
    rows_follow_others(plugin, paraview)
    counters_are_texts(plugin, paraview)
    help_is_at_labels(plugin, paraview)
    search_finds_the_filters_by_contour(plugin, paraview)
    an_empty_slice_is_explained(plugin, paraview)
    isovalues_follow_the_array(plugin, paraview)
    selected_points_keep_their_shapes(plugin, paraview)
    pictures_are_traced(plugin, paraview)


main(*sys.argv[1:])
print("passed")
