# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of splats on several ranks are those of one, and what is selected there is seen there:

TestSplatsOnRanks.py PLUGIN FOLDER PVSERVER..., with a server that the script starts by this command:
first one of one rank, which leaves its pictures in the folder, then one of several."""

import os
import sys

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

from scripting import SPLATS, check, contoured, leaves_of, load, make_view, pixels, read_image, psnr, updated

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
x, y, z = np.ascontiguousarray((5.0 * mine).T)  # NumPy's sines of other arrays depend on their addresses
place = vtkPoints()
place.SetData(numpy_to_vtk(mine, deep=True))
output.SetPoints(place)
output.PointData.append(np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x), "gyroid")
output.PointData.append(np.sin(2.0 * x - y) + z, "color")
"""
# Along an axis in parallel, from a corner in perspective, and from within.
CAMERAS = {"front": (1, [0.0, 0.0, 5.0], [0.0, 1.0, 0.0]), "corner": (0, [2.9, 2.3, 3.4], [0.0, 1.0, 0.0]),
           "near": (0, [-0.9, 1.9, 0.6], [0.0, 0.0, 1.0])}


def look_from(name):
    VIEW.CameraFocalPoint = [0.0, 0.0, 0.0]
    VIEW.CameraParallelScale = 1.3
    VIEW.CameraParallelProjection, VIEW.CameraPosition, VIEW.CameraViewUp = CAMERAS[name]
    simple.Render(VIEW)


def shows_what_one_rank_does(count):
    samples = simple.ProgrammableSource(Script=SAMPLES.replace("COUNT", str(count)), OutputDataSetType="vtkPolyData")
    isopoints = contoured(samples, "gyroid", 0.1)
    display = simple.Show(isopoints, VIEW)
    check(display.Representation == SPLATS, "the representation by default")
    simple.ColorBy(display, ("POINTS", "color"))
    display.SetScalarBarVisibility(VIEW, False)
    simple.GetColorTransferFunction("color").RescaleTransferFunction(-5.0, 5.0)
    for camera in CAMERAS:
        look_from(camera)
        found = pixels(VIEW, os.path.join(FOLDER, f"{count}-{camera}-{SIZE}.png"))
        quality = psnr(found, read_image(os.path.join(FOLDER, f"{count}-{camera}-1.png")))
        check((found < 250).any(axis=2).mean() > 0.3, "the surface is seen")
        print(f"{count} samples, {camera}: {quality:.1f} dB")
        check(quality >= 45.0, f"{quality} dB of {count} samples, {camera}")
    return isopoints


def chosen(isopoints, rectangle):
    """The positions of the points that are seen in a rectangle of pixels, as a set."""
    simple.ClearSelection(isopoints)
    simple.SelectSurfacePoints(View=VIEW, Rectangle=rectangle)
    extract = simple.ExtractSelection(Input=isopoints)
    # ParaView 5.11 fetches the unstructured grid of the first rank alone, and polygons of all ranks.
    surface = updated(simple.ExtractSurface(Input=extract))
    points = []
    for leaf in leaves_of(surface):
        points += [leaf.GetPoint(i) for i in range(leaf.GetNumberOfPoints())]
        ghosts = leaf.GetPointData().GetArray("vtkGhostType")
        check(not ghosts or not vtk_to_numpy(ghosts).any(), "a ghost was selected")
    simple.Delete(surface)
    simple.Delete(extract)
    simple.ClearSelection(isopoints)
    check(len(set(points)) == len(points), "a point was selected twice")
    return set(points)


def selects_what_one_rank_does(isopoints):
    """Points in a rectangle, and those below single pixels, as when hovering."""
    look_from("front")
    every, *hits = [chosen(isopoints, rectangle) for rectangle in [[95, 95, 405, 305]] + [
        [x, y, x, y] for x in range(130, 380, 50) for y in range(100, 310, 50)]]
    path = os.path.join(FOLDER, "chosen.npy")
    if SIZE == 1:
        np.save(path, sorted(every))
    expected = set(map(tuple, np.load(path).tolist()))
    others, hits = len(every ^ expected), [hit for hit in hits if hit]
    print(f"{len(every)} points in a rectangle, {len(expected)} on one rank, {others} differ; {len(hits)} pixels hit")
    check(len(expected) > 500, "points in a rectangle")
    check(others <= 0.005 * len(expected), "a rectangle with points that are not seen there")
    check(len(hits) >= 15, "pixels with a point")
    check(all(len(hit) == 1 and hit <= expected for hit in hits), "one point of a pixel")


plugin, FOLDER, *server = sys.argv[1:]
SIZE = load(plugin, *server)
VIEW = make_view(500, 400, [1.0, 1.0, 1.0])
VIEW.RemoteRenderThreshold = 0.0  # each rank renders its own points
for count in (5000, 100000):
    isopoints = shows_what_one_rank_does(count)
    if count == 5000:
        selects_what_one_rank_does(isopoints)
    simple.Hide(isopoints, VIEW)
print("passed")
