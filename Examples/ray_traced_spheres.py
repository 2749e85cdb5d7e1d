# SPDX-License-Identifier: GPL-3.0-or-later
"""A mirror and a glass sphere, ray-traced from points: python3 ray_traced_spheres.py

Figure 11 of Rosenthal and Linsen's paper: the isosurfaces of two spheres in eight million samples
each, a yellow mirror on the right, glass on the left.

Needs the compiled classes, as in the Debian package, and the interpreter that they were built for."""

import argparse

import numpy as np
from scatteredisopoints import contour, vtkIsopointRayTracer, vtkIsopointSplatMapper
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer

parser = argparse.ArgumentParser()
parser.add_argument("--samples", type=int, default=8_000_000, help="of each sphere")
parser.add_argument("--rays", type=int, default=64, help="for each pixel")
options = parser.parse_args()


def sphere(center, seed):
    """Stands for your samples: the distance from a center at random places."""
    offsets = np.random.default_rng(seed).uniform(-1.2, 1.2, (options.samples, 3))
    distances = np.linalg.norm(offsets, axis=1)
    mapper = vtkIsopointSplatMapper()
    mapper.SetInputData(contour(offsets + center, distances, 1.0).polydata)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetInterpolationToPBR()
    actor.GetProperty().SetRoughness(0.0)
    return actor


mirror = sphere([1.15, 0.0, 1.0], 1)
mirror.GetProperty().SetMetallic(1.0)
mirror.GetProperty().SetColor(1.0, 0.8, 0.25)

glass = sphere([-1.15, -0.3, 1.0], 2)
glass.GetProperty().SetMetallic(0.0)
glass.GetProperty().SetBaseIOR(1.5)
glass.GetProperty().SetOpacity(0.0)
glass.GetProperty().SetColor(0.85, 0.95, 0.9)

tiles = vtkPlaneSource()
tiles.SetOrigin(-8.0, -8.0, 0.0)
tiles.SetPoint1(8.0, -8.0, 0.0)
tiles.SetPoint2(-8.0, 8.0, 0.0)
tiles.SetResolution(24, 24)
tiles.Update()
floor = tiles.GetOutput()
row, column = np.divmod(np.arange(24 * 24), 24)
colors = np.array([[225, 220, 210], [120, 60, 50]], np.uint8)[(row + column) % 2]
floor.GetCellData().SetScalars(numpy_to_vtk(colors, deep=True))
floor_mapper = vtkPolyDataMapper()
floor_mapper.SetInputData(floor)
floor_actor = vtkActor()
floor_actor.SetMapper(floor_mapper)

light = vtkLight()
light.SetPosition(-3.0, -5.0, 8.0)
light.SetIntensity(0.9)

renderer = vtkRenderer()
for actor in (mirror, glass, floor_actor):
    renderer.AddActor(actor)
renderer.AddLight(light)
renderer.SetBackground(0.85, 0.9, 0.95)
renderer.SetBackground2(0.25, 0.45, 0.75)
renderer.GradientBackgroundOn()
camera = renderer.GetActiveCamera()
camera.SetPosition(0.0, -7.5, 2.3)
camera.SetFocalPoint(0.0, 0.0, 0.85)
camera.SetViewUp(0.0, 0.0, 1.0)
renderer.ResetCameraClippingRange()

tracer = vtkIsopointRayTracer()
tracer.SetSamplesPerPixel(options.rays)
tracer.SetLightAngle(5.0)
tracer.SetAmbientLight(0.3)
image = vtkImageData()
tracer.RenderToImage(renderer, 640, 400, image)
writer = vtkPNGWriter()
writer.SetInputData(image)
writer.SetFileName("ray_traced_spheres.png")
writer.Write()
