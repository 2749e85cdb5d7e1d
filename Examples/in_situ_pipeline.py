# SPDX-License-Identifier: GPL-3.0-or-later
# script-version: 2.0
"""A Catalyst pipeline: the surface of a simulation's particles, drawn each step.

Needs the compiled plugin, loaded by PV_PLUGIN_PATH or the Debian package."""

from paraview import catalyst
from paraview.simple import *

particles = PVTrivialProducer(registrationName="particles")
surface = ScatteredIsosurface(Input=particles, ContourBy=["POINTS", "density"], Isosurfaces=[0.5])

LoadPalette("WhiteBackground")
view = CreateView("RenderView")
view.OrientationAxesVisibility = 0
view.ViewSize = [400, 300]
Show(surface, view).ColorArrayName = ["POINTS", ""]
view.CameraPosition = [0.5, -1.1, 0.7]
view.CameraFocalPoint = [0.5, 0.5, 0.5]
view.CameraViewUp = [0, 0, 1]
picture = CreateExtractor("PNG", view, registrationName="picture")
picture.Writer.FileName = "in_situ_{timestep}.png"
picture.Writer.ImageResolution = [400, 300]

options = catalyst.Options()
options.ExtractsOutputDirectory = "."
options.GlobalTrigger = "TimeStep"
