# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of rendering share: surfaces as splats and as meshes, scenes of them, and pictures."""

import pathlib
import sys

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, the factories
from scatteredisopoints import vtkIsopointSplatMapper, vtkScatteredIsopointFilter
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter)

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "Python"))
from checking import check, run  # noqa: E402, F401
from vtk_data import as_array, blocks_of, cloud_of, named, points_of, psnr, read_image  # noqa: E402, F401
from vtk_data import set_all as configured  # noqa: E402

RING, TUBE = 1.0, 0.4
BOUNDS = (-1.4, 1.4, -1.4, 1.4, -0.4, 0.4)  # of the torus
BACKGROUND = (0.2, 0.25, 0.35)


def output_of(source, **properties):
    configured(source, **properties).Update()
    return source.GetOutput()


def sphere_mesh(theta=100, phi=100, **properties):
    return output_of(vtkSphereSource(), ThetaResolution=theta, PhiResolution=phi, **properties)


def add_array(data, name, values, cells=False):
    array = named(name, values)
    attributes = data.GetCellData() if cells else data.GetPointData()
    attributes.SetNormals(array) if name == "Normals" else attributes.AddArray(array)


def array(data, name, cells=False):
    return vtk_to_numpy((data.GetCellData() if cells else data.GetPointData()).GetArray(name))


def cells_of(rows):
    """Cells of equal sizes by the ids of their points."""
    cells = vtkCellArray()
    connectivity = np.insert(np.asarray(rows, np.int64), 0, np.shape(rows)[1], axis=1)
    cells.SetCells(len(rows), numpy_to_vtkIdTypeArray(connectivity.ravel(), deep=True))
    return cells


def polydata(points, normals=None, **arrays):
    """Points with one vertex cell each and arrays."""
    data = cloud_of(np.asarray(points, dtype=float))
    if normals is not None:
        add_array(data, "Normals", np.asarray(normals, dtype=np.float32))
    for name, values in arrays.items():
        add_array(data, name, values)
    data.SetVerts(cells_of(np.arange(len(points))[:, None]))
    return data


def isopoints(field, low, high, count, seed=1, creases=False):
    """The isopoints of a field at 0, from random samples in a box. On request the fit follows creases."""
    positions = np.random.default_rng(seed).uniform(low, high, (count, 3))
    samples = polydata(positions, f=field(positions), x=positions[:, 0])
    samples.GetPointData().SetActiveScalars("f")
    projection = dict(Projection=vtkScatteredIsopointFilter.CREASE_FIT) if creases else {}
    return output_of(vtkScatteredIsopointFilter(), InputData=samples, Value=(0, 0.0), **projection)


def ball_field(p):
    return 1 - np.linalg.norm(p, axis=1)


def torus_field(p):
    return TUBE - np.hypot(np.hypot(p[:, 0], p[:, 1]) - RING, p[:, 2])


def torus_splats(samples=830_000):
    """About 40,000 isopoints of the torus, by default."""
    return isopoints(torus_field, [-1.6, -1.6, -0.6], [1.6, 1.6, 0.6], samples)


def positions_of(data):
    return vtk_to_numpy(data.GetPoints().GetData()).astype(float)


def subset(data, chosen):
    """Some of the isopoints with all their arrays."""
    points = vtk_to_numpy(data.GetPoints().GetData())
    result = polydata(points[chosen], array(data, "Normals")[chosen])
    for attributes, is_of_cells in ((data.GetPointData(), False), (data.GetCellData(), True)):
        for i in range(attributes.GetNumberOfArrays()):
            if attributes.GetArrayName(i) != "Normals":
                add_array(result, attributes.GetArrayName(i), vtk_to_numpy(attributes.GetArray(i))[chosen], is_of_cells)
    return result


def halves(data):
    """Two blocks, the left and the right half, with an empty one between; and the ids of their points."""
    left = positions_of(data)[:, 0] < 0
    return blocks_of(subset(data, left), None, subset(data, ~left)), (np.flatnonzero(left), np.flatnonzero(~left))


def torus_mesh(rows=800, columns=400):
    u, v = np.meshgrid(np.arange(rows) * 2 * np.pi / rows, np.arange(columns) * 2 * np.pi / columns, indexing="ij")
    normals = np.stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)], -1)
    points = RING * np.stack([np.cos(u), np.sin(u), 0 * u], -1) + TUBE * normals
    data = polydata(points.reshape(-1, 3), normals.reshape(-1, 3), x=points[..., 0].ravel())
    index = np.arange(rows * columns).reshape(rows, columns)
    right, up = np.roll(index, -1, 1), np.roll(index, -1, 0)
    data.SetVerts(None)
    data.SetPolys(cells_of(np.stack([index, up, np.roll(right, -1, 0), right], -1).reshape(-1, 4)))
    return data


def actor_of(data, splats=True, **properties):
    """properties: those of the actor's vtkProperty"""
    mapper = vtkIsopointSplatMapper() if splats else vtkPolyDataMapper()
    actor = configured(vtkActor(), Mapper=configured(mapper, InputDataObject=data, ScalarVisibility=False))
    configured(actor.GetProperty(), **properties)
    return actor


def color_by(actor, name, low, high):
    mapper = actor.GetMapper()
    mapper.ScalarVisibilityOn()
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(name)
    mapper.SetScalarRange(low, high)


class Scene:
    """A window with one renderer that looks down at the torus; multisampling is off by default."""

    def __init__(self, *actors, size=600, samples=0, background=BACKGROUND):
        self.window = configured(vtkRenderWindow(), OffScreenRendering=True, MultiSamples=samples, Size=(size, size))
        self.renderer = configured(vtkRenderer(), Background=background)
        self.window.AddRenderer(self.renderer)
        self.camera = self.renderer.GetActiveCamera()
        for actor in actors:
            self.renderer.AddActor(actor)
        self.look((0, -3, 3), None)

    def look(self, position, up=(0, 0, 1), bounds=BOUNDS):
        configured(self.camera, Position=tuple(position), FocalPoint=(0, 0, 0))
        if up:
            self.camera.SetViewUp(*up)
        self.renderer.ResetCamera(*bounds)

    def peel(self, **properties):
        self.window.SetAlphaBitPlanes(1)
        configured(self.renderer, UseDepthPeeling=True, **properties)

    def image(self, path=None):
        """The picture as an array, its first row at the bottom; also as a file."""
        self.window.Render()
        grab = configured(vtkWindowToImageFilter(), Input=self.window, ReadFrontBuffer=False)
        grab.Update()
        if path:
            configured(vtkPNGWriter(), FileName=path, InputData=grab.GetOutput()).Write()
        return as_array(grab.GetOutput())


def differs(image, color=BACKGROUND):
    """Where a picture is not of a color."""
    return np.abs(image - 255 * np.asarray(color)).max(2) > 3
