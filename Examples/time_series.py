# SPDX-License-Identifier: GPL-3.0-or-later
"""A wave through sensors that stay where they are, step by step: pvbatch time_series.py

Positions are the same in each step, so that the filter keeps its tree and takes the new values alone.

Needs the compiled plugin, loaded by PV_PLUGIN_PATH or the Debian package."""

from paraview.simple import *

# Stands for your reader of a time series.
sensors = ProgrammableSource(OutputDataSetType="vtkPolyData")
sensors.ScriptRequestInformation = """
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as pipeline
info = self.GetOutputInformation(0)
info.Set(pipeline.TIME_STEPS(), [0.0, 1.0, 2.0], 3)
info.Set(pipeline.TIME_RANGE(), [0.0, 2.0], 2)
"""
sensors.Script = """
import numpy as np
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as pipeline
time = self.GetOutputInformation(0).Get(pipeline.UPDATE_TIME_STEP())
if not hasattr(self, "positions"):
    self.positions = np.random.default_rng(1).random((60000, 3))
output.Points = self.positions
x, y, z = self.positions.T
output.PointData.append(z - 0.15 * np.sin(9 * x + 2 * time) * np.sin(7 * y - time), "wave")
"""

surface = ScatteredIsopoints(Input=sensors, ContourBy=["POINTS", "wave"], Isosurfaces=[0.5])
LoadPalette("WhiteBackground")
view = GetActiveViewOrCreate("RenderView")
view.OrientationAxesVisibility = 0
view.ViewSize = [400, 300]
ColorBy(Show(surface), None)
ResetCamera()
GetActiveCamera().Elevation(-60)
GetActiveCamera().Zoom(1.6)
animation = GetAnimationScene()
animation.UpdateAnimationUsingDataTimeSteps()
for step, time in enumerate(animation.TimeKeeper.TimestepValues):
    animation.AnimationTime = time
    SaveScreenshot(f"time_series_{step}.png", view)
