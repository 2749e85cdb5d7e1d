# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of splats on several ranks are those of one, and what is selected there is seen there:

TestSplatsOnRanks.py PLUGIN FOLDER PVSERVER..., with a server that the script starts by this command:
first one of one rank, which leaves its pictures in the folder, then one of several."""

import os
import sys

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

from scripting import check, pixels_of_file
from TestSplats import connect_to

LEAST_PSNR = 45.0

SAMPLES = """
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkParallelCore import vtkMultiProcessController
ranks = vtkMultiProcessController.GetGlobalController()
size = ranks.GetNumberOfProcesses() if ranks else 1
rank = ranks.GetLocalProcessId() if ranks else 0
every = np.random.default_rng(5).random((COUNT, 3)) * 2.0 - 1.0
mine = every[rank * COUNT // size:(rank + 1) * COUNT // size]
x, y, z = (5.0 * mine).T
place = vtkPoints()
place.SetData(numpy_to_vtk(mine, deep=True))
output.SetPoints(place)
for name, values in (
        ("gyroid", np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)),
        ("color", np.sin(2.0 * x - y) + z)):
    array = numpy_to_vtk(values, deep=True)
    array.SetName(name)
    output.GetPointData().AddArray(array)
"""


def surface_of(count):
    samples = simple.ProgrammableSource(Script=SAMPLES.replace("COUNT", str(count)))
    samples.OutputDataSetType = "vtkPolyData"
    isopoints = simple.ScatteredIsopoints(Input=samples)
    isopoints.ContourBy = ["POINTS", "gyroid"]
    isopoints.Isosurfaces = [0.1]
    return isopoints


def make_view():
    view = simple.CreateView("RenderView")
    view.ViewSize = [500, 400]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.RemoteRenderThreshold = 0.0  # each rank renders its own points
    return view


def cameras(view):
    """Along an axis in parallel, from a corner in perspective, and from within."""
    view.CameraFocalPoint = [0.0, 0.0, 0.0]
    view.CameraParallelScale = 1.3
    for name, parallel, position, up in (
            ("front", 1, [0.0, 0.0, 5.0], [0.0, 1.0, 0.0]),
            ("corner", 0, [2.9, 2.3, 3.4], [0.0, 1.0, 0.0]),
            ("near", 0, [-0.9, 1.9, 0.6], [0.0, 0.0, 1.0])):
        view.CameraParallelProjection = parallel
        view.CameraPosition = position
        view.CameraViewUp = up
        simple.Render(view)
        yield name


def shows_what_one_rank_does(view, folder, size, count):
    isopoints = surface_of(count)
    display = simple.Show(isopoints, view)
    check(display.Representation == "Isopoint Splats", "the representation by default")
    simple.ColorBy(display, ("POINTS", "color"))
    display.SetScalarBarVisibility(view, False)
    simple.GetColorTransferFunction("color").RescaleTransferFunction(-5.0, 5.0)
    for camera in cameras(view):
        path = os.path.join(folder, f"{count}-{camera}-{size}.png")
        simple.SaveScreenshot(path, view)
        found = pixels_of_file(path)
        expected = pixels_of_file(os.path.join(folder, f"{count}-{camera}-1.png"))
        check((found < 250).any(axis=2).mean() > 0.3, "the surface is seen")
        difference = (found - expected) ** 2
        psnr = 10.0 * np.log10(255.0**2 / np.maximum(difference.mean(), 1e-10))
        worst = np.sqrt(difference.max())
        print(f"{count} samples, {camera}: {psnr:.1f} dB, {worst:.0f} at most")
        check(psnr >= LEAST_PSNR, f"{psnr} dB of {count} samples, {camera}")
    return isopoints, display


def chosen(view, isopoints, rectangle):
    """The positions of the points that are seen in a rectangle of pixels, as a set."""
    simple.ClearSelection(isopoints)
    simple.SelectSurfacePoints(View=view, Rectangle=rectangle)
    extract = simple.ExtractSelection(Input=isopoints)
    extract.UpdatePipeline()
    found = servermanager.Fetch(extract)
    leaves = [found.GetBlock(i) for i in range(found.GetNumberOfBlocks())] if found.IsA(
        "vtkMultiBlockDataSet") else [found]
    points = []
    for leaf in leaves:
        points += [leaf.GetPoint(i) for i in range(leaf.GetNumberOfPoints())]
        ghosts = leaf.GetPointData().GetArray("vtkGhostType")
        check(not ghosts or not vtk_to_numpy(ghosts).any(), "a ghost was selected")
    simple.Delete(extract)
    simple.ClearSelection(isopoints)
    check(len(set(points)) == len(points), "a point was selected twice")
    return set(points)


def selects_what_one_rank_does(view, folder, size, isopoints):
    """Points in a rectangle, and those below single pixels, as when hovering. Of several ranks
    ParaView 5.11 selects points of one alone, with any representation."""
    next(cameras(view))
    rectangles = [[95, 95, 405, 305]] + [
        [x, y, x, y] for x in range(130, 380, 50) for y in range(100, 310, 50)]
    found = [chosen(view, isopoints, rectangle) for rectangle in rectangles]
    path = os.path.join(folder, "chosen.npy")
    if size == 1:
        np.save(path, np.array(found, dtype=object), allow_pickle=True)
    expected = list(np.load(path, allow_pickle=True))
    others = len(found[0] - expected[0])
    print(f"{len(found[0])} points in a rectangle, {len(expected[0])} on one rank, {others} others")
    check(len(found[0]) > 100, "points in a rectangle")
    check(others <= 0.005 * len(found[0]), "a rectangle with points that are not seen there")
    hits = [i for i in range(1, len(found)) if found[i]]
    print(f"{len(hits)} of {len(found) - 1} pixels have a point")
    check(len(hits) >= (15 if size == 1 else 4), "pixels with a point")
    check(all(len(found[i]) == 1 and found[i] <= expected[0] for i in hits), "one point of a pixel")


def main(plugin, folder, *server):
    connect_to(*server)
    simple.LoadPlugin(plugin, remote=True)
    simple.LoadPlugin(plugin, remote=False)
    simple._DisableFirstRenderCameraReset()
    size = servermanager.ActiveConnection.GetNumberOfDataPartitions()
    view = make_view()
    for count in (5000, 100000):
        isopoints, _ = shows_what_one_rank_does(view, folder, size, count)
        if count == 5000:
            selects_what_one_rank_does(view, folder, size, isopoints)
        simple.Hide(isopoints, view)


if __name__ == "__main__":
    main(*sys.argv[1:])
    print("passed")
