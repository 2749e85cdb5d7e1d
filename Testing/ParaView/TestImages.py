# SPDX-License-Identifier: GPL-3.0-or-later
"""Splats of images and rectilinear grids, whose points are computed rather than stored."""

import contextlib
import resource
import sys

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkRectilinearGrid

from scripting import check, covered, look, make_view, pixels

def image(origin, count=20):
    data = vtkImageData()
    data.SetDimensions(count, count, 1)
    data.SetOrigin(origin, origin, origin)
    return data


def rectilinear_grid(origin):
    data = vtkRectilinearGrid()
    data.SetDimensions(20, 20, 1)
    for set_coordinates, count in (
        (data.SetXCoordinates, 20),
        (data.SetYCoordinates, 20),
        (data.SetZCoordinates, 1),
    ):
        set_coordinates(numpy_to_vtk(origin + np.arange(float(count)), deep=True))
    return data


def shown(data, view):
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    display = simple.Show(source, view)
    display.Representation = "Isopoint Splats"  # which is not offered: there are no normals
    display.SplatRadius = 0.4
    display.ColorArrayName = ["POINTS", ""]
    return source


def number_of_splats(view):
    """Disjoint octahedra, seen from above as squares whose diagonals are of 32 pixels."""
    return np.count_nonzero(covered(pixels(view))) / (2 * 16**2)


def all_seen(count):
    """Whether all 400 splats are seen."""
    return abs(count - 400) < 4


def look_at(view, origin):
    look(view, 50.0, 10.0, [origin + 9.5, origin + 9.5, origin])


def keeps_precision(view):
    """Single precision would not distinguish points that are 1 apart there."""
    for make in (image, rectilinear_grid):
        for origin in (0.0, 1e9):
            source = shown(make(origin), view)
            look_at(view, origin)
            count = number_of_splats(view)
            print(f"{make.__name__} at {origin:g}: {count:.1f} splats")
            check(all_seen(count), f"the splats of {make.__name__} at {origin:g}")
            simple.Delete(source)


@contextlib.contextmanager
def limited_memory():
    """Limits the memory to what suffices for all but the positions of a huge image."""
    former = resource.getrlimit(resource.RLIMIT_AS)
    with open("/proc/self/statm") as pages:
        size = int(pages.read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (size + (8 << 30), former[1]))
    yield
    resource.setrlimit(resource.RLIMIT_AS, former)


def runs_out_of_memory(view):
    """An image too large is one error, and another one can be shown afterwards."""
    huge = image(0.0, 60_000)
    source = shown(image(0.0), view)
    look_at(view, 0.0)
    check(all_seen(number_of_splats(view)), "a small image")
    source.GetClientSideObject().SetOutput(huge)
    source.MarkModified(source)
    usual, collecting = vtkOutputWindow.GetInstance(), vtkStringOutputWindow()
    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkOutputWindow.SetInstance(collecting)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    with limited_memory():
        for _ in range(3):
            simple.Render(view)
    vtkOutputWindow.SetInstance(usual)
    vtkLogger.SetStderrVerbosity(verbosity)
    messages = collecting.GetOutput()
    check(messages.count("ERROR:") == 1, "one error of a huge image, not " + messages)
    check("Out of memory" in messages, "a cause in " + messages)
    source.GetClientSideObject().SetOutput(image(0.0))
    source.MarkModified(source)
    check(all_seen(number_of_splats(view)), "a small image again")


def main(plugin):
    simple.LoadPlugin(plugin)
    simple._DisableFirstRenderCameraReset()
    view = make_view(800)
    view.UseFXAA = 0  # it smears rims, differently in each version
    keeps_precision(view)
    runs_out_of_memory(view)


main(sys.argv[1])
print("passed")
