# SPDX-License-Identifier: GPL-3.0-or-later
"""The ray-traced engine of docs/raytracing.md: ray_traced_engine.py VOLUME, an image of 256 x 256 x
128 voxels of a computed tomography. Writes ray_traced_engine.png."""

import sys

import common
from scatteredisopoints import contour, vtkIsopointRayTracer, vtkIsopointSplatMapper
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer

engine = vtkActor()
engine.SetMapper(vtkIsopointSplatMapper())
engine.GetMapper().SetInputData(contour(common.read(sys.argv[1]), None, 80.0).polydata)
engine.GetMapper().ScalarVisibilityOff()
engine.GetProperty().SetInterpolationToPBR()
engine.GetProperty().SetMetallic(1.0)
engine.GetProperty().SetRoughness(0.3)
engine.GetProperty().SetColor(0.78, 0.8, 0.84)

ground = vtkPlaneSource()
level = engine.GetBounds()[4]
ground.SetOrigin(-600.0, -600.0, level)
ground.SetPoint1(900.0, -600.0, level)
ground.SetPoint2(-600.0, 900.0, level)
floor = vtkActor()
floor.SetMapper(vtkPolyDataMapper())
floor.GetMapper().SetInputConnection(ground.GetOutputPort())
floor.GetProperty().SetColor(0.75, 0.75, 0.78)

light = vtkLight()
light.SetPosition(-200.0, -400.0, 600.0)
light.SetFocalPoint(128.0, 128.0, 60.0)
light.SetIntensity(0.9)
renderer = vtkRenderer()
renderer.AddActor(engine)
renderer.AddActor(floor)
renderer.AddLight(light)
renderer.SetBackground(0.95, 0.96, 0.98)
renderer.SetBackground2(0.45, 0.6, 0.8)
renderer.GradientBackgroundOn()
camera = renderer.GetActiveCamera()
camera.SetFocalPoint(128.0, 128.0, 60.0)
camera.SetPosition(-70.0, -230.0, 290.0)
camera.SetViewUp(0.0, 0.0, 1.0)
renderer.ResetCameraClippingRange()

tracer = vtkIsopointRayTracer()
tracer.SetSamplesPerPixel(48)
tracer.SetLightAngle(4.0)
tracer.SetAmbientLight(0.35)
image = vtkImageData()
tracer.RenderToImage(renderer, 480, 360, image)
writer = vtkPNGWriter()
writer.SetInputData(image)
writer.SetFileName("ray_traced_engine.png")
writer.Write()
