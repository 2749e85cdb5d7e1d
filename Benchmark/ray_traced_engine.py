# SPDX-License-Identifier: GPL-3.0-or-later
"""The ray-traced engine of docs/raytracing.md: ray_traced_engine.py VOLUME, an image of 256 x 256 x
128 voxels of a computed tomography. Writes ray_traced_engine.png."""

import sys

import common
from scatteredisopoints import contour, vtkIsopointRayTracer
from scenes import actor_of, configured, output_of
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkLight, vtkRenderer

MIDDLE = (128.0, 128.0, 60.0)
engine = actor_of(contour(common.read(sys.argv[1]), None, 80.0).polydata, Metallic=1.0, Roughness=0.3,
                  Color=(0.78, 0.8, 0.84))
engine.GetProperty().SetInterpolationToPBR()
level = engine.GetBounds()[4]
ground = output_of(vtkPlaneSource(), Origin=(-600, -600, level), Point1=(900, -600, level), Point2=(-600, 900, level))
renderer = configured(
    vtkRenderer(), Background=(0.95, 0.96, 0.98), Background2=(0.45, 0.6, 0.8), GradientBackground=True)
renderer.AddActor(engine)
renderer.AddActor(actor_of(ground, splats=False, Color=(0.75, 0.75, 0.78)))
renderer.AddLight(configured(vtkLight(), Position=(-200.0, -400.0, 600.0), FocalPoint=MIDDLE, Intensity=0.9))
configured(renderer.GetActiveCamera(), FocalPoint=MIDDLE, Position=(-70.0, -230.0, 290.0), ViewUp=(0.0, 0.0, 1.0))
renderer.ResetCameraClippingRange()
image = vtkImageData()
tracer = configured(vtkIsopointRayTracer(), SamplesPerPixel=48, LightAngle=4.0, AmbientLight=0.35)
tracer.RenderToImage(renderer, 480, 360, image)
configured(vtkPNGWriter(), InputData=image, FileName="ray_traced_engine.png").Write()
