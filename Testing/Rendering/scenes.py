# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces as splats and as meshes, and pictures of them, for the tests of the splat mapper."""

import sys

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, the factories
from scatteredisopoints import vtkIsopointSplatMapper, vtkScatteredIsopointFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkWindowToImageFilter,
)

RING, TUBE = 1.0, 0.4
BACKGROUND = (0.2, 0.25, 0.35)


def check(condition, message):
    if not condition:
        sys.exit("failed: " + message)


def add_array(data, name, values, normals=False, cells=False):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    if normals:
        data.GetPointData().SetNormals(array)
    else:
        (data.GetCellData() if cells else data.GetPointData()).AddArray(array)


def polydata(points, normals=None, **arrays):
    """Points with one vertex cell each and arrays."""
    data = vtkPolyData()
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(np.ascontiguousarray(points, dtype=float), deep=True))
    data.SetPoints(vtk_points)
    if normals is not None:
        add_array(data, "Normals", np.asarray(normals, dtype=np.float32), normals=True)
    for name, values in arrays.items():
        add_array(data, name, values)
    count = len(points)
    connectivity = np.column_stack([np.ones(count, np.int64), np.arange(count, dtype=np.int64)])
    cells = vtkCellArray()
    cells.SetCells(count, numpy_to_vtkIdTypeArray(connectivity.ravel(), deep=True))
    data.SetVerts(cells)
    return data


def isopoints(field, low, high, count, seed=1, creases=False):
    """The filter's isopoints where a field is 0, of random samples in a box; on request with fits
    of creases and clipping planes along them."""
    positions = np.random.default_rng(seed).uniform(low, high, (count, 3))
    samples = polydata(positions, f=field(positions), x=positions[:, 0])
    samples.GetPointData().SetActiveScalars("f")
    contour = vtkScatteredIsopointFilter()
    contour.SetInputData(samples)
    contour.SetValue(0, 0.0)
    if creases:
        contour.SetProjection(vtkScatteredIsopointFilter.CREASE_FIT)
    contour.Update()
    return contour.GetOutput()


def torus_field(p):
    return TUBE - np.hypot(np.hypot(p[:, 0], p[:, 1]) - RING, p[:, 2])


def torus_splats(samples=830_000):
    """About 40,000 isopoints of the torus, by default."""
    return isopoints(torus_field, [-1.6, -1.6, -0.6], [1.6, 1.6, 0.6], samples)


def parts(splats):
    """Points, normals and radii as arrays."""
    return (
        vtk_to_numpy(splats.GetPoints().GetData()).astype(float),
        vtk_to_numpy(splats.GetPointData().GetNormals()).astype(float),
        vtk_to_numpy(splats.GetPointData().GetArray("Radius")).astype(float),
    )


def subset(data, chosen):
    """Some of the isopoints with all their arrays."""
    points = vtk_to_numpy(data.GetPoints().GetData())
    arrays = {}
    for i in range(data.GetPointData().GetNumberOfArrays()):
        array = data.GetPointData().GetArray(i)
        if array.GetName() != "Normals":
            arrays[array.GetName()] = vtk_to_numpy(array)[chosen]
    normals = vtk_to_numpy(data.GetPointData().GetNormals())
    result = polydata(points[chosen], normals[chosen], **arrays)
    for i in range(data.GetCellData().GetNumberOfArrays()):
        array = data.GetCellData().GetArray(i)
        add_array(result, array.GetName(), vtk_to_numpy(array)[chosen], cells=True)
    return result


def grid_mesh(points, normals):
    """A mesh over a rectangular array of points; its last rows and columns meet the first."""
    rows, columns = points.shape[:2]
    data = polydata(points.reshape(-1, 3), normals.reshape(-1, 3), x=points[..., 0].ravel())
    data.SetVerts(None)
    index = np.arange(rows * columns).reshape(rows, columns)
    right, up = np.roll(index, -1, 1), np.roll(index, -1, 0)
    corners = np.stack([index, up, np.roll(right, -1, 0), right], -1).reshape(-1, 4)
    cells = vtkCellArray()
    connectivity = np.insert(corners, 0, 4, axis=1).astype(np.int64)
    cells.SetCells(len(corners), numpy_to_vtkIdTypeArray(connectivity.ravel(), deep=True))
    data.SetPolys(cells)
    return data


def torus_mesh(rows=800, columns=400):
    u, v = np.meshgrid(
        np.linspace(0, 2 * np.pi, rows, endpoint=False),
        np.linspace(0, 2 * np.pi, columns, endpoint=False),
        indexing="ij",
    )
    normals = np.stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)], -1)
    center = np.stack([np.cos(u), np.sin(u), 0 * u], -1) * RING
    return grid_mesh(center + TUBE * normals, normals)


def actor_of(data, splats=True):
    mapper = vtkIsopointSplatMapper() if splats else vtkPolyDataMapper()
    mapper.SetInputDataObject(data)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


def color_by(actor, name, low, high):
    mapper = actor.GetMapper()
    mapper.ScalarVisibilityOn()
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(name)
    mapper.SetScalarRange(low, high)


class Scene:
    """A window with one renderer that looks down at the torus; multisampling is off by default."""

    def __init__(self, *actors, size=600, samples=0):
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(samples)
        self.window.SetSize(size, size)
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(*BACKGROUND)
        self.window.AddRenderer(self.renderer)
        self.camera = self.renderer.GetActiveCamera()
        self.camera.SetPosition(0, -3, 3)
        self.camera.SetFocalPoint(0, 0, 0)
        for actor in actors:
            self.renderer.AddActor(actor)
        self.renderer.ResetCamera(-1.4, 1.4, -1.4, 1.4, -0.4, 0.4)

    def image(self):
        """The picture as an array, its first row at the bottom."""
        self.window.Render()
        grab = vtkWindowToImageFilter()
        grab.SetInput(self.window)
        grab.ReadFrontBufferOff()
        grab.Update()
        return as_array(grab.GetOutput())

    def save(self, path):
        grab = vtkWindowToImageFilter()
        grab.SetInput(self.window)
        grab.ReadFrontBufferOff()
        writer = vtkPNGWriter()
        writer.SetFileName(path)
        writer.SetInputConnection(grab.GetOutputPort())
        writer.Write()


def as_array(image):
    width, height, _ = image.GetDimensions()
    scalars = vtk_to_numpy(image.GetPointData().GetScalars())
    return scalars.reshape(height, width, -1)[..., :3].astype(float)


def read_image(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    return as_array(reader.GetOutput())


def psnr(a, b):
    """Peak signal to noise ratio in decibels."""
    error = np.mean((a - b) ** 2)
    return np.inf if error == 0 else 10 * np.log10(255**2 / error)


def differs(image, color=BACKGROUND):
    """Where a picture is not of a color."""
    return np.abs(image - 255 * np.asarray(color)).max(2) > 3


def shrunk(mask):
    """Without the pixels at its border."""
    result = mask.copy()
    for axis in (0, 1):
        for shift in (-1, 1):
            result &= np.roll(mask, shift, axis)
    return result
