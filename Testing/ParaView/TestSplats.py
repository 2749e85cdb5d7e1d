# SPDX-License-Identifier: GPL-3.0-or-later
"""The representation Isopoint Splats. Runs in pvbatch, under MPI too, and in a client of a server:

TestSplats.py PLUGIN [PVSERVER...], with a server that the script starts by this command."""

import json
import os
import socket
import subprocess
import sys

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

from scripting import FOLDER, check, covered, look, make_view, pixels

BALL_POINTS = 39193  # of ball(), on any number of ranks


def look_at_the_ball(view):
    look(view, 300.0, 60.0)
    simple.Render(view)


def ball():
    """The distance from the middle of an image; the ball of radius 48 is 320 pixels wide."""
    image = simple.Wavelet(WholeExtent=[-60, 60] * 3)
    return simple.Calculator(Input=image, ResultArrayName="r", Function="mag(coords)")


def shows_the_ball(view, isopoints):
    display = simple.Show(isopoints, view)
    check(display.Representation == "Isopoint Splats", "the representation by default")
    simple.ColorBy(display, None)
    display.DiffuseColor = display.AmbientColor = [1.0, 1.0, 0.0]
    look_at_the_ball(view)
    image = pixels(view)
    if image is not None:
        area = np.count_nonzero(covered(image)) / (np.pi * 160**2)
        check(abs(area - 1) < 0.05, f"the ball's area {area}")
        check(image[280, 200, 0] > image[120, 200, 0] + 40, "lit from above")
    return display, image


def colors(view, isopoints, display):
    simple.ColorBy(display, ("POINTS", "RTData"))
    display.RescaleTransferFunctionToDataRange(False, True)
    display.SetScalarBarVisibility(view, True)
    simple.Render(view)
    image = pixels(view)
    if image is not None:
        inside = image[120:280, 120:280].reshape(-1, 3)
        check(inside.std(0).max() > 5, "colors by an array")
    display.SetScalarBarVisibility(view, False)
    simple.ColorBy(display, None)


def properties(view, isopoints, display, reference):
    display.SplatRadiusScale = 0.1
    simple.Render(view)
    image = pixels(view)
    if image is not None:
        check(covered(image).sum() < 0.6 * covered(reference).sum(), "the radius scale")
    display.SplatRadiusScale = 1.0
    display.Scale = [0.5, 0.5, 0.5]
    simple.Render(view)
    image = pixels(view)
    if image is not None:
        ratio = covered(image).sum() / covered(reference).sum()
        check(abs(ratio - 0.25) < 0.02, "the actor's scale")
    display.Scale = [1.0, 1.0, 1.0]


def level_of_detail(view, isopoints, display):
    """What is drawn while the user interacts: ParaView's coarser surface, the same ball."""
    render_window = view.GetRenderWindow()
    pictures = []
    for threshold in (0.0, 1000.0):
        view.LODThreshold = threshold
        simple.Render(view)
        view.SMProxy.InteractiveRender()
        grab = vtkWindowToImageFilter()
        grab.SetInput(render_window)
        grab.ShouldRerenderOff()
        grab.Update()
        width, height, _ = grab.GetOutput().GetDimensions()
        scalars = vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars())
        pictures.append(scalars.reshape(height, width, -1)[..., :3].astype(int))
    coarse, everything = pictures
    check(covered(coarse).sum() > 0.9 * covered(everything).sum(), "the ball in fewer triangles")
    check(not np.array_equal(coarse, everything), "fewer triangles while interacting")
    view.LODThreshold = 20.0


def exports_the_surface(view, isopoints):
    """A file of the view has the triangles of the splats."""
    polygons = simple.IsopointSplatPolygons(Input=isopoints)
    polygons.UpdatePipeline()
    triangles = polygons.GetDataInformation().GetNumberOfCells()
    check(triangles > 3 * BALL_POINTS, f"{triangles} triangles as data")
    path = os.path.join(FOLDER, "view.gltf")
    simple.Render(view)
    simple.ExportView(path, view=view)
    with open(path) as file:
        scene = json.load(file)
    primitives = [p for mesh in scene["meshes"] for p in mesh["primitives"]]
    indices = [scene["accessors"][p["indices"]]["count"] for p in primitives if p["mode"] == 4]
    check(sum(indices) == 3 * triangles, f"{sum(indices)} corners of {triangles} triangles")
    simple.Delete(polygons)


def selection(view, isopoints, display):
    simple.Render(view)
    for select, of_points in (
        (simple.SelectSurfacePoints, True),
        (simple.SelectSurfaceCells, False),
    ):
        simple.ClearSelection(isopoints)
        select(View=view, Rectangle=[180, 180, 220, 220])
        extract = simple.ExtractSelection(Input=isopoints)
        extract.UpdatePipeline()
        chosen = servermanager.Fetch(extract)
        count = sum(
            chosen.GetBlock(i).GetNumberOfPoints() for i in range(chosen.GetNumberOfBlocks())
        ) if chosen.IsA("vtkMultiBlockDataSet") else chosen.GetNumberOfPoints()
        check(count > 3, f"{count} points chosen")
        leaf = chosen.GetBlock(0) if chosen.IsA("vtkMultiBlockDataSet") else chosen
        for i in range(leaf.GetNumberOfPoints()):
            x, y, z = leaf.GetPoint(i)
            check(abs(x) < 9 and abs(y) < 9 and z > 45, f"a point seen there, {x, y, z}")
        simple.Delete(extract)
    simple.ClearSelection(isopoints)


def sharp_edges(view):
    """With the fit for creases splats end there as they come, and do not extend beyond the cube."""
    image = simple.Wavelet(WholeExtent=[-25, 25] * 3)
    distance = "max(max(abs(coordsX),abs(coordsY)),abs(coordsZ))"
    source = simple.Calculator(Input=image, ResultArrayName="r", Function=distance)
    cube = simple.ScatteredIsopoints(Input=source)
    cube.ContourBy = ["POINTS", "r"]
    cube.Isosurfaces = [20.3]
    cube.Projection = "Cubic fit with creases"
    simple.ColorBy(simple.Show(cube, view), None)
    simple.Render(view)
    picture = pixels(view)
    if picture is not None:
        edge = round(200 * 20.3 / 60) + 1
        area = covered(picture)
        area[200 - edge : 200 + edge, 200 - edge : 200 + edge] = False
        outside = np.count_nonzero(area)
        print(f"outside of the cube: {outside} pixels")
        check(outside == 0, "splats end at the edges")
    simple.Hide(cube, view)


def colors_and_hides_blocks(view, display):
    """Of two spheres, to the left and to the right, as the Multi-block Inspector does."""
    display.BlockColors = ["/Root/Sphere1", "1", "0", "0", "/Root/Sphere2", "0", "1", "0"]
    simple.Render(view)
    image = pixels(view)
    if image is not None:
        check(image[200, 120, 0] > 100 and image[200, 120, 1] < 50, "the left block is red")
        check(image[200, 280, 1] > 100 and image[200, 280, 0] < 50, "the right block is green")
    display.BlockSelectors = ["/Root/Sphere2"]
    simple.Render(view)
    image = pixels(view)
    if image is not None:
        check(not covered(image)[200, 120] and covered(image)[200, 280], "the left block is hidden")
    display.BlockSelectors = ["/"]
    display.BlockColors = []
    simple.Render(view)
    image = pixels(view)
    if image is not None:
        check(covered(image)[200, 120] and image[200, 280, 0] > 100, "as before")


def other_data(view):
    """Splats are not offered without radii. Where they are set anyway, as in a state, points without
    normals are drawn only with a radius of the user's; composite data show all their blocks."""
    sphere = simple.Sphere(ThetaResolution=80, PhiResolution=80, Radius=12.0, Center=[-24, 0, 0])
    other = simple.Sphere(ThetaResolution=80, PhiResolution=80, Radius=12.0, Center=[24, 0, 0])
    grouped = simple.GroupDatasets(Input=[sphere, other])
    wavelet = simple.Wavelet(WholeExtent=[-25, 25] * 3)
    for source in (wavelet, sphere, grouped):
        display = simple.Show(source, view)
        check("Isopoint Splats" not in display.GetProperty("Representation").Available, "not offered")
        display.Representation = "Isopoint Splats"
        simple.Render(view)
        image = pixels(view)
        if image is not None:
            check(covered(image).any() == (source is not wavelet), "only with normals or a radius")
        display.SplatRadius = 1.5
        display.ColorArrayName = ["POINTS", ""]
        display.DiffuseColor = display.AmbientColor = [1.0, 1.0, 0.0]
        simple.Render(view)
        image = pixels(view)
        if image is not None:
            check(covered(image).any(), "shown")
            if source is grouped:
                check(covered(image)[200, 120] and covered(image)[200, 280], "both blocks")
        if source is grouped:
            colors_and_hides_blocks(view, display)
        simple.Hide(source, view)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def connect_to(*server):
    """Starts a server by a command and connects to it. The server ends when this client does; if it
    ended before, the client would report an error."""
    port = free_port()
    # What MPI has set in this process would keep mpiexec from starting ranks.
    environment = {
        name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_"))
    }
    # The client listens and the server calls, so that neither has to wait for the other.
    subprocess.Popen(
        [*server, "--reverse-connection", "--client-host=127.0.0.1", f"--server-port={port}"],
        env=environment,
    )
    simple.ReverseConnect(str(port))


def main(plugin, *server):
    if server:
        connect_to(*server)
        simple.LoadPlugin(plugin, remote=True)
    simple.LoadPlugin(plugin, remote=False)
    simple._DisableFirstRenderCameraReset()
    view = make_view(400)
    source = ball()
    isopoints = simple.ScatteredIsopoints(Input=source)
    isopoints.ContourBy = ["POINTS", "r"]
    isopoints.Isosurfaces = [48.0]
    isopoints.UpdatePipeline()
    check(isopoints.GetDataInformation().GetNumberOfPoints() == BALL_POINTS, "points of all ranks")
    display, image = shows_the_ball(view, isopoints)
    colors(view, isopoints, display)
    properties(view, isopoints, display, image)
    ranks = servermanager.ActiveConnection.GetNumberOfDataPartitions()
    if ranks == 1:
        selection(view, isopoints, display)
    if ranks == 1 and not server:
        level_of_detail(view, isopoints, display)
        exports_the_surface(view, isopoints)
    simple.Hide(isopoints, view)
    sharp_edges(view)
    other_data(view)


if __name__ == "__main__":
    main(*sys.argv[1:])
