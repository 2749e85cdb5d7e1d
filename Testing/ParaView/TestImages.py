# SPDX-License-Identifier: GPL-3.0-or-later
"""Splats of images and rectilinear grids. These compute their points instead of storing them."""

import contextlib
import resource
import sys

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkRectilinearGrid

from scripting import (
    SPLATS, check, covered, load, look, make_view, messages, pixels, produced, run, set_all, shown)


def image(origin, count=20):
    return set_all(vtkImageData(), Dimensions=(count, count, 1), Origin=3 * (origin,))


def rectilinear_grid(origin):
    return set_all(vtkRectilinearGrid(), Dimensions=(20, 20, 1), **{
        axis + "Coordinates": numpy_to_vtk(origin + np.arange(float(count)), deep=True)
        for axis, count in (("X", 20), ("Y", 20), ("Z", 1))})


def show(data, origin):
    source = produced(data)
    # Splats are not offered: there are no normals.
    shown(source, VIEW, Representation=SPLATS, SplatRadius=0.4)
    look(VIEW, 50.0, 10.0, [origin + 9.5, origin + 9.5, origin])
    return source


def check_splats(what):
    """Shows 400 separate octahedra from above, as squares with diagonals of 32 pixels."""
    count = np.count_nonzero(covered(pixels(VIEW))) / (2 * 16**2)
    check(abs(count - 400) < 4, f"{count:.1f} splats: {what}")


def precision():
    """In single precision, points at distance 1 would coincide at 1e9."""
    for make in (image, rectilinear_grid):
        for origin in (0.0, 1e9):
            source = show(make(origin), origin)
            check_splats(f"{make.__name__} at {origin:g}")
            simple.Delete(source)


@contextlib.contextmanager
def limited_memory():
    """Limits the memory so that the positions of a huge image alone do not fit."""
    former = resource.getrlimit(resource.RLIMIT_AS)
    with open("/proc/self/statm") as pages:
        size = int(pages.read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (size + (8 << 30), former[1]))
    yield
    resource.setrlimit(resource.RLIMIT_AS, former)


def lack_of_memory():
    """An image that is too large causes one error. Afterwards the view can show another image."""
    source = show(image(0.0), 0.0)
    check_splats("a small image")
    source.GetClientSideObject().SetOutput(image(0.0, 60_000))
    source.MarkModified(source)
    with messages() as texts, limited_memory():
        for _ in range(3):
            simple.Render(VIEW)
    check(texts[0].count("ERROR:") == 1 and "memory" in texts[0], f"one error, with its cause: {texts[0]}")
    source.GetClientSideObject().SetOutput(image(0.0))
    source.MarkModified(source)
    check_splats("a small image again")


load(sys.argv[1])
VIEW = make_view(800)
VIEW.UseFXAA = 0  # it smears rims, differently in each version
run(precision, lack_of_memory)
