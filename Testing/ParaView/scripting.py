# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scripts here share: checks, views and their pictures."""

import os
import sys
import tempfile

from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

_temporary = tempfile.TemporaryDirectory()  # removed when the script ends
FOLDER = _temporary.name


def check(condition, message):
    if not condition:
        sys.exit("failed: " + message)


def make_view(side):
    """A view of a square of pixels, blue where nothing is."""
    view = simple.CreateView("RenderView")
    view.ViewSize = [side, side]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [0.0, 0.0, 1.0]
    return view


def look(view, height, scale, middle=(0.0, 0.0, 0.0)):
    """From the front, in parallel; scale is half of what is seen along an edge."""
    view.CameraParallelProjection = 1
    view.CameraPosition = [middle[0], middle[1], middle[2] + height]
    view.CameraFocalPoint = middle
    view.CameraParallelScale = scale


def covered(image):
    """Which pixels of such a view show something."""
    return image[..., 2] < 250


def pixels(view):
    """The picture as an array, rows from below; on the first rank only, else None."""
    path = os.path.join(FOLDER, "view.png")
    simple.SaveScreenshot(path, view)
    return pixels_of_file(path) if os.path.exists(path) else None


def pixels_of_file(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    scalars = vtk_to_numpy(image.GetPointData().GetScalars())
    return scalars.reshape(height, width, -1)[..., :3].astype(int)
