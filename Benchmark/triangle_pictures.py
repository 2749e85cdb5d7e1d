# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of docs/triangles.md: triangle_pictures.py PLUGIN FOLDER PICTURE, for pvbatch.

FOLDER has the data sets as docs/testing.md, "Real files", has them. PICTURE, a PNG file, will have a row for
each: splats, triangles, and ParaView's Contour of the mesh, if there is one. PLUGIN is ScatteredIsopoints.so.
"""

import os
import sys
import tempfile

import common  # noqa: F401, the folders of what follows
import numpy as np
from paraview import simple
from scripting import contoured, make_view, read_image, shown
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

WHITE = [1.0, 1.0, 1.0]
SIZE = [420, 420]
COLOR = [0.85, 0.72, 0.5]

# file, array, isovalue; the camera's direction, its view up, and how large things are drawn
ROWS = [
    ("multiblock/bluntfin.vts", "Density", 1.0, (0.3, 1.0, -0.5), (0, 0, 1), 0.95),
    ("unstructured/disk_out_ref.vtu", "Temp", 400.0, (1.0, 0.5, -0.4), (0, 0, 1), 1.25),
    ("unstructured/fea_bracket_kiefer.vtu", "von_Mises_psi", 5.0, (0, 0, -1), (0, 1, 0), 1.3),
    ("scattered/sph_water_jet.vtp", "speed", 33.0, (0.5, 1.0, -0.4), (0, 0, 1), 1.25),
]


def surfaces_of(folder, name, array, isovalue):
    """The surface of each column, with its representation; None where there is no mesh."""
    mesh = simple.OpenDataFile(os.path.join(folder, name))
    mesh.UpdatePipeline()
    samples = mesh
    if array not in mesh.PointData.keys():
        samples = simple.CellCenters(Input=mesh)
        mesh = simple.CellDatatoPointData(Input=mesh)
        mesh.UpdatePipeline()
    columns = [(contoured(samples, array, isovalue, kind=kind, DropGaps=1), shape) for kind, shape in (
        ("ScatteredIsopoints", "Isopoint Splats"), ("ScatteredIsosurface", "Surface"))]
    has_mesh = mesh.GetDataInformation().GetNumberOfCells() > 0 and not name.endswith(".vtp")
    columns.append((contoured(mesh, array, isovalue, kind="Contour"), "Surface") if has_mesh else None)
    return columns


def place(camera, bounds, direction, up, zoom):
    """Looks along a direction, with all of the bounds in view if the zoom is 1."""
    center = np.add(bounds[0::2], bounds[1::2]) / 2
    radius = np.linalg.norm(np.subtract(bounds[1::2], bounds[0::2])) / 2
    direction = np.divide(direction, np.linalg.norm(direction))
    distance = radius / zoom / np.tan(np.radians(camera.GetViewAngle() / 2))
    camera.SetFocalPoint(*center)
    camera.SetPosition(*(center - distance * direction))
    camera.SetViewUp(*up)


def write(pixels, path):
    image = vtkImageData()
    image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(pixels.reshape(-1, 3), deep=True))
    writer = vtkPNGWriter()
    writer.SetInputData(image)
    writer.SetFileName(path)
    writer.Write()


def pixels_of(column, bounds, camera, path):
    """camera: direction, view up, zoom."""
    if column is None:
        return np.full((SIZE[1], SIZE[0], 3), 255, np.uint8)
    surface, representation = column
    view = make_view(*SIZE, WHITE)
    shown(surface, view, COLOR, Representation=representation)
    simple.ResetCamera(view)
    place(view.GetActiveCamera(), bounds, *camera)
    simple.SaveScreenshot(path, view, ImageResolution=SIZE)
    simple.Delete(view)
    return read_image(path).astype(np.uint8)


def main(plugin, folder, picture):
    if not os.path.isdir(folder):
        sys.exit("triangle_pictures: there is no folder " + folder)
    simple.LoadPlugin(plugin)
    rows = []
    with tempfile.TemporaryDirectory() as scratch:
        for name, array, isovalue, *camera in ROWS:
            columns = surfaces_of(folder, name, array, isovalue)
            # All columns are seen alike: triangles may have outliers, and splats be huge.
            framed = columns[2] or columns[0]
            bounds = framed[0].GetDataInformation().GetBounds()
            path = os.path.join(scratch, "part.png")
            parts = [pixels_of(column, bounds, camera, path) for column in columns]
            rows.insert(0, np.concatenate(parts, axis=1))
    write(np.concatenate(rows, axis=0), picture)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
