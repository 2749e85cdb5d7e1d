# SPDX-License-Identifier: GPL-3.0-or-later
"""The representation Isopoint Splats. Runs in pvbatch, under MPI too, and in a client of a server:

TestSplats.py PLUGIN [PVSERVER...], with a server that the script starts by this command."""

import json
import sys

import numpy as np
from paraview import simple
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

from scripting import (
    SPLATS, ball, check, contoured, covered, distance_in, leaves_of, load, look, make_view, number_of_points, path_of,
    pixels, positions, shown, updated, vtk_data)

BALL_POINTS = 39193  # of the ball, on any number of ranks
YELLOW = [1.0, 1.0, 0.0]


def check_picture(passes, what):
    """passes(image) looks at the view's picture, on the first rank."""
    simple.Render(VIEW)
    image = pixels(VIEW)
    check(image is None or passes(image), what)
    return image


def shows_the_ball():
    """The ball is 320 pixels wide. Its area follows the radius scale and the actor's scale."""
    def area(image):
        return np.count_nonzero(covered(image)) / (np.pi * 160**2)

    display = simple.Show(BALL, VIEW)
    check(display.Representation == SPLATS, "the representation by default")
    shown(BALL, VIEW, YELLOW)
    look(VIEW, 300.0, 60.0)
    whole = check_picture(lambda image: abs(area(image) - 1) < 0.05, "the ball's area")
    check(whole is None or whole[280, 200, 0] > whole[120, 200, 0] + 40, "lit from above")
    simple.ColorBy(display, ("POINTS", "RTData"))
    display.RescaleTransferFunctionToDataRange(False, True)
    display.SetScalarBarVisibility(VIEW, True)
    check_picture(lambda image: image[120:280, 120:280].reshape(-1, 3).std(0).max() > 5, "colors by an array")
    display.SetScalarBarVisibility(VIEW, False)
    simple.ColorBy(display, None)
    display.SplatRadiusScale = 0.1
    check_picture(lambda image: area(image) < 0.6 * area(whole), "the radius scale")
    display.SplatRadiusScale = 1.0
    display.Scale = [0.5, 0.5, 0.5]
    check_picture(lambda image: abs(area(image) / area(whole) - 0.25) < 0.02, "the actor's scale")
    display.Scale = [1.0, 1.0, 1.0]


def level_of_detail():
    """While the user interacts, ParaView draws a coarser surface of the same ball."""
    pictures = []
    for threshold in (0.0, 1000.0):
        VIEW.LODThreshold = threshold
        simple.Render(VIEW)
        VIEW.SMProxy.InteractiveRender()
        grab = vtkWindowToImageFilter()
        grab.SetInput(VIEW.GetRenderWindow())
        grab.ShouldRerenderOff()
        grab.Update()
        pictures.append(vtk_data.as_array(grab.GetOutput()))
    coarse, everything = pictures
    check(covered(coarse).sum() > 0.9 * covered(everything).sum(), "the ball in fewer triangles")
    check(not np.array_equal(coarse, everything), "fewer triangles while interacting")
    VIEW.LODThreshold = 20.0


def exports_the_surface():
    """A file of the view has the triangles of the splats."""
    polygons = updated(simple.IsopointSplatPolygons(Input=BALL))
    triangles = polygons.GetDataInformation().GetNumberOfCells()
    check(triangles > 3 * BALL_POINTS, f"{triangles} triangles as data")
    simple.Render(VIEW)
    simple.ExportView(path_of("view.gltf"), view=VIEW)
    with open(path_of("view.gltf")) as file:
        scene = json.load(file)
    indices = [scene["accessors"][part["indices"]]["count"]
               for mesh in scene["meshes"] for part in mesh["primitives"] if part["mode"] == 4]
    check(sum(indices) == 3 * triangles, f"{sum(indices)} corners of {triangles} triangles")


def selection():
    simple.Render(VIEW)
    for select in (simple.SelectSurfacePoints, simple.SelectSurfaceCells):
        simple.ClearSelection(BALL)
        select(View=VIEW, Rectangle=[180, 180, 220, 220])
        extract = updated(simple.ExtractSelection(Input=BALL))
        check(sum(leaf.GetNumberOfPoints() for leaf in leaves_of(extract)) > 3, "points are chosen")
        found = positions(extract)
        check((np.abs(found[:, :2]) < 9).all() and (found[:, 2] > 45).all(), "points that are seen there")
    simple.ClearSelection(BALL)


def sharp_edges():
    """With the fit for creases, splats end at creases by default and do not extend beyond the cube."""
    image = simple.Wavelet(WholeExtent=[-25, 25] * 3)
    source = distance_in(image, function="max(max(abs(coordsX),abs(coordsY)),abs(coordsZ))")
    cube = contoured(source, "r", 20.3, Projection="Cubic fit with creases")
    shown(cube, VIEW)
    edge = round(200 * 20.3 / 60) + 1

    def ends(image):
        area = covered(image)
        check(area.any(), "the cube is seen")
        area[200 - edge : 200 + edge, 200 - edge : 200 + edge] = False
        return not area.any()

    check_picture(ends, "splats end at the edges")
    simple.Hide(cube, VIEW)


def colors_and_hides_blocks(display):
    """Colors and hides a sphere on the left and one on the right, as the Multi-block Inspector does."""
    left, right = (200, 120), (200, 280)
    display.BlockColors = ["/Root/Sphere1", "1", "0", "0", "/Root/Sphere2", "0", "1", "0"]
    check_picture(lambda image: image[left][0] > 100 > 50 > image[left][1], "the left block is red")
    check_picture(lambda image: image[right][1] > 100 > 50 > image[right][0], "the right block is green")
    display.BlockSelectors = ["/Root/Sphere2"]
    check_picture(lambda image: covered(image)[right] and not covered(image)[left], "the left block is hidden")
    display.BlockSelectors = ["/"]
    display.BlockColors = []
    check_picture(lambda image: covered(image)[left] and image[right][0] > 100, "as before")


def other_data():
    """Splats are not offered without radii. Where they are set anyway, as in a state, points without
    normals are drawn only with a radius of the user's; composite data show all their blocks."""
    spheres = [simple.Sphere(ThetaResolution=80, PhiResolution=80, Radius=12.0, Center=[x, 0, 0]) for x in (-24, 24)]
    wavelet, grouped = simple.Wavelet(WholeExtent=[-25, 25] * 3), simple.GroupDatasets(Input=spheres)
    for source in (wavelet, spheres[0], grouped):
        display = simple.Show(source, VIEW)
        check(SPLATS not in display.GetProperty("Representation").Available, "not offered")
        display.Representation = SPLATS
        check_picture(lambda image: covered(image).any() == (source is not wavelet), "only with normals or a radius")
        shown(source, VIEW, YELLOW, SplatRadius=1.5)
        check_picture(lambda image: covered(image).any(), "shown")
        if source is grouped:
            check_picture(lambda image: covered(image)[200, 120] and covered(image)[200, 280], "both blocks")
            colors_and_hides_blocks(display)
        simple.Hide(source, VIEW)


plugin, *server = sys.argv[1:]
ranks = load(plugin, *server)
VIEW = make_view(400)
BALL = ball(60, 48.0)
check(number_of_points(BALL) == BALL_POINTS, "points of all ranks")
shows_the_ball()
if ranks == 1:
    selection()
if ranks == 1 and not server:
    level_of_detail()
    exports_the_surface()
simple.Hide(BALL, VIEW)
sharp_edges()
other_data()
print("passed")
