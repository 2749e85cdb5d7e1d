# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin in ParaView's window: TestWindow.py PLUGIN PARAVIEW PVBATCH FILTER_XML"""

import json
import re
import sys
import time
import xml.etree.ElementTree as ElementTree

import playing
from playing import (
    ADVANCED, APPLY, FOLDER, FRAME, LOAD, SCRIPT, VIEWS, WINDOW, Mouse, check, choose, event, expect, expect_of,
    play_script, run, run_script, search, set_isovalue, set_property, set_radius_scale)

PLUGIN, PARAVIEW, PVBATCH, FILTER_XML = sys.argv[1:]
NAMES = "Scattered Isopoints", "Scattered Isosurface"
SPLATS = "Isopoint Splats"
WAVELET = "isopoints = wavelet"  # in place of isopoints as the input of filters


def play(events, more="", **options):
    return playing.play(PARAVIEW, PLUGIN, events, more, **options)


# Since 5.13 labels are other widgets; since 6 help has another frame.
IS_5_13, IS_6 = (playing.version_of(PARAVIEW) >= version for version in ((5, 13), (6,)))


def inputs_are_hidden():
    names = ["Clip", "Threshold", "Calculator", "Transform"]
    shown, _ = play([each for name in names for each in (choose(name), APPLY)])
    check(shown.pop("Transform1") == [1, SPLATS], "the last filter's output as splats")
    check(shown == {name: [0, SPLATS] for name in ("ScatteredIsopoints1", "Calculator1", "Clip1", "Threshold1")},
          f"inputs are hidden: {shown}")
    shown, _ = play([choose("Clip"), APPLY], "simple.GetDisplayProperties(isopoints, view).Opacity = 0.5")
    check(all(visible for visible, _ in shown.values()), "translucent inputs stay")


def rows_follow_others():
    """Rows of properties without effect are grayed out or hidden."""
    for name, own in zip(NAMES, (
            [expect("NumberOfNeighbors", "enabled")],
            [expect("Regularize", "visible")])):
        play([choose(name), expect("DropGaps", "visible"), expect("isopoint_counts", "visible", "false"), ADVANCED,
              expect("KeepTree", "visible"),
              expect("ContourBlocks", "visible", "false"), expect("NormalMethod", "enabled"), *own,
              set_property("ComputeNormals", "false"), expect("NormalMethod", "enabled", "false"), APPLY], WAVELET)
    play([choose(NAMES[0]), ADVANCED, expect("ContourBlocks", "visible"), APPLY],
         "isopoints = simple.GroupDatasets(Input=[wavelet])\nisopoints.UpdatePipeline()")


def counters_are_texts():
    """Labels show counts of the last update with their totals. One of the wavelet's 9261 samples is not finite."""
    more = """
isopoints = simple.ProgrammableFilter(Input=wavelet, CopyArrays=1, Script='''
import numpy as np
values = np.array(inputs[0].PointData["RTData"])
values[0] = np.nan
output.PointData.append(values, "RTData")
''')
isopoints.UpdatePipeline()
"""
    samples, skipped, dropped = (FRAME + "isopoint_counts/NumberOf" + name
                                 for name in ("Samples", "SkippedSamples", "DroppedInGaps"))
    for name in NAMES:
        _, said = play([choose(name), ADVANCED, expect_of(samples, "text", ""), expect_of(skipped, "visible", "false"),
                        expect_of(dropped, "text", ""), APPLY, expect_of(samples, "text", "9261"),
                        expect_of(skipped, "text", "1"), expect_of(skipped, "visible", "true")], more)
        check(not re.search("WARN|Warning", others_of(said)), "no message without a problem")


def others_of(said):
    """Without the message that splats are too coarse for this field."""
    return "\n".join(line for line in said.splitlines() if "Splats do not meet" not in line)


def expect_help(label, xml, name):
    """That a label has the text that a property has in the XML."""
    text = ElementTree.parse(xml).find(f".//*[@name='{name}']/Documentation").text
    before, after = ("<table width='500'><tr><td>", "</td></tr></table>") if IS_6 else ('<p align="justify">', "</p>")
    return expect_of(label, "toolTip", f"<html><head/><body>{before}{' '.join(text.split())}{after}</body></html>")


def help_is_at_labels():
    play([choose(NAMES[0]), expect_help(FRAME + "1QLabel0", FILTER_XML, "SelectInputScalars")])


def derivatives_of_vectors_are_for_vectors():
    """Their rows are gray while a scalar is chosen."""
    more = """
isopoints = simple.Calculator(Input=wavelet, ResultArrayName="velocity", Function="coordsX*jHat-coordsY*iHat")
isopoints.UpdatePipeline()
"""
    rows = "ComputeDivergence", "ComputeVorticity", "ComputeQCriterion"
    choose_array = [event(FRAME + "SelectInputScalars/ComboBox", "set_string", name) for name in ("velocity", "RTData")]
    play([choose("ScatteredGradient"),
          choose_array[0], *(expect(row, "enabled") for row in rows), expect("ComputeGradient", "enabled"),
          choose_array[1], *(expect(row, "enabled", "false") for row in rows), expect("ComputeGradient", "enabled"),
          choose_array[0], set_property("ComputeVorticity", "true"), APPLY], more)


COLORS = """
isopoints = simple.PointDatatoCellData(Input=wavelet)
display = simple.Show(isopoints, view)
display.Representation = "Surface"
simple.ColorBy(display, ("CELLS", "RTData"))

def tell(*_):
    grid = simple.FindSource("ScatteredGrid1")
    shown = grid and view.SMProxy.FindRepresentation(grid.SMProxy, 0)
    if shown:
        shown = simple.servermanager._getPyProxy(shown)
        print("color:", list(shown.ColorArrayName), shown.LookupTable == display.LookupTable, flush=True)

view.GetRenderWindow().AddObserver("EndEvent", tell)
"""


def images_keep_the_color_of_cells():
    """The values of the cells are at the points of an image."""
    _, said = play([choose("ScatteredGrid"), APPLY], COLORS)
    last = [line for line in said.splitlines() if line.startswith("color:")][-1]
    check(last == "color: ['POINTS', 'RTData'] True", last)


def search_finds_each_filter_once():
    """By words of its name, and by those of ParaView's filters for meshes."""
    for words, both in (("scattered iso", NAMES),
                        ("contour samples", ("Contour samples as points", "Contour samples as triangles"))):
        for typed, found, name in ((words, both, NAMES[0]), (both[1], both[1:], NAMES[1])):
            shown, _ = play([*search(PARAVIEW, typed, *found), APPLY], WAVELET)
            check(name.replace(" ", "") + ("2" if name == NAMES[0] else "1") in shown, f"{name} was created")
    grids = "Resample samples to an image", "Resample samples with a data set"
    for words, found, name in (("resample samples", grids, "Scattered Grid"),
                               ("derivatives of", ("Derivatives of samples",), "Scattered Gradient"),
                               ("cut samples", ("Cut samples by a plane",), "Scattered Slice"),
                               ("surface of particles", ("Surface of particles",), "Scattered Body")):
        shown, _ = play([*search(PARAVIEW, words, *found), APPLY], WAVELET)
        check(any(each.startswith(name.replace(" ", "")) for each in shown), f"{name} was created: {shown}")
    cloud = "Surface (isosurface) of a cloud of samples"
    shown, _ = play([each for words, found in (
        ("vorticity", "Vorticity of samples"), ("streamline", "Streamlines of samples, by an image"),
        ("cloud of", cloud),
        ("surface", cloud)) for each in (*search(PARAVIEW, words, found, are_all=False), APPLY)], WAVELET)
    names = "ScatteredGradient1", "ScatteredGrid1", "ScatteredIsosurface1", "ScatteredIsosurface2"
    check(set(names) <= set(shown), f"filters were created: {shown}")
    play([*search(PARAVIEW, "plot samples", "Plot samples over a line"), APPLY], WAVELET)  # in a view of its own


def an_empty_result_is_explained():
    """One message names the filter to use instead. From a grid there is no message."""
    points = """
points = simple.PointSource(NumberOfPoints=500, Radius=1)
isopoints = simple.Calculator(Input=points, Function="coordsX", ResultArrayName="x")
isopoints.UpdatePipeline()
"""
    for name, more, remedy, count in (
            ("Slice", "", "Scattered Isosurface", 1), ("Slice", WAVELET, "", 0),
            ("Slice", points, "Scattered Slice", 1), ("Gradient", points, "Scattered Gradient", 1),
            ("Plot Over Line", points, "Scattered Line", 1), ("Resample To Image", points, "Scattered Grid", 1),
            ("Gradient", WAVELET, "", 0)):
        _, said = play([choose(name), APPLY], more)
        explained = [line for line in others_of(said).splitlines() if "yields nothing" in line]
        check(len(explained) == count and all(remedy in line for line in explained), f"{name}: {explained}")


def empty_results_keep_splats():
    """Later results are splats again, also after a first one that was empty."""
    shown, said = play([*set_isovalue("5000"), APPLY, *set_isovalue("157"), APPLY])
    check(shown == {"ScatteredIsopoints1": [1, SPLATS]}, f"splats: {shown}")
    check("ERR|" not in said, "no error")
    shown, _ = play([choose(NAMES[0]), *set_isovalue("5000"), APPLY, *set_isovalue("157"), APPLY], WAVELET)
    check(shown["ScatteredIsopoints2"] == [1, SPLATS], f"splats: {shown}")


def negative_sizes_are_explained():
    _, said = play([set_radius_scale("-1")])
    check(others_of(said).count("radius scale -1 is negative") == 1, "one message")


def isovalues_follow_the_array():
    """The panel changes the isovalue before the user applies anything."""
    more = """
isopoints = simple.Calculator(Input=wavelet, ResultArrayName="small", Function="RTData / 1000")
isopoints.UpdatePipeline()
"""
    _, said = play([choose(NAMES[0]), event(FRAME + "SelectInputScalars/ComboBox", "set_string", "small"), APPLY], more)
    check("No isosurface" not in said, "the isovalue is in the range of the array")


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


def selected_points_keep_their_shapes():
    """Extract Selection yields the vertices of points. Users can still add to the active selection."""
    once = [choose("ExtractSelection"), APPLY]
    shown, said = play(once, SELECTS)
    check(shown["ExtractSelection1"] == [1, SPLATS], "the selection as splats")
    last = [line for line in said.splitlines() if line.startswith("extracted:")][-1]
    check(last == "extracted: True ['SplatAxis', 'SplatPolygon'] [0, 0, 0]", last)
    # Where nothing is selected, nothing is extracted.
    for events, more, name in ((2 * once, SELECTS, "ExtractSelection2"), (once, "", "ExtractSelection1")):
        check(name in play(events, more)[0], f"{name}, an extract of nothing")


FRAME_OF_VIEW = VIEWS + "Frame.0/"
CELL_TIPS = [
    event(FRAME_OF_VIEW + "actionHoveringSurfaceCells", "set_boolean", "true"),
    event(WINDOW + "CoreUtilitiesPromptUser/qt_msgbox_buttonbox/1QPushButton0", "activate"),
    # A tip is shown where the mouse stays.
    *(each for x in (0.5, 0.51) for each in (
        event(FRAME_OF_VIEW + "CentralWidgetFrame/Viewport/1QVTKOpenGLNativeWidget0", "mouseMove", f"({x},0.5,0,0,0)"),
        event(WINDOW[:-1], "pause", "3000")))]


def tips_lack_the_numbers_of_splats():
    """What is left of the tip of a cell is narrow: the name of the filter, the cell's number and type."""
    sizes = set()

    def hover(process):
        mouse = Mouse()
        mouse.move(600, 400)  # a place in the view
        while process.poll() is None:
            sizes.update(mouse.sizes_of_tips())
            time.sleep(0.1)

    play(CELL_TIPS, "simple.ResetCamera(view)\nview.GetActiveCamera().Zoom(2)", meanwhile=hover)
    check(sizes and all(width < 400 for width, _ in sizes), f"sizes of tips: {sizes}")


TRACES = """
from paraview import smtrace
smtrace.start_trace(preamble="")
points = simple.PointSource(NumberOfPoints=3000, Radius=1.0)
samples = simple.Elevation(Input=points, LowPoint=[0, 0, -1], HighPoint=[0, 0, 1])
simple.Show(samples, view)
simple.SetActiveSource(samples)
view.GetRenderWindow().AddObserver(
    "EndEvent", lambda *_: print("trace:" + json.dumps(smtrace.get_current_trace_output()), flush=True))
"""


def a_trace_runs_elsewhere():
    """A trace loads the plugin before it shows the samples."""
    _, said = play_script([PARAVIEW, "--dr"], SCRIPT.format(load=LOAD.format(plugin=PLUGIN), more=TRACES),
                          [choose("ScatteredIsopoints"), APPLY, set_radius_scale("0.5")])
    trace = json.loads([line[6:] for line in said.splitlines() if line.startswith("trace:")][-1])
    check("SplatRadiusScale = 0.5" in trace, trace)
    (found,), _ = run_script(PVBATCH, trace + """
display = GetDisplayProperties(FindSource("ScatteredIsopoints1"))
print("found:", str(display.Representation).strip("'"), display.SplatRadiusScale)
""")
    check(found == f"found: {SPLATS} 0.5", found)


run(inputs_are_hidden, rows_follow_others, counters_are_texts, help_is_at_labels, search_finds_each_filter_once,
    an_empty_result_is_explained, empty_results_keep_splats, negative_sizes_are_explained, isovalues_follow_the_array,
    selected_points_keep_their_shapes, derivatives_of_vectors_are_for_vectors, images_keep_the_color_of_cells,
    tips_lack_the_numbers_of_splats, a_trace_runs_elsewhere)
