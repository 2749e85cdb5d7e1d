# SPDX-License-Identifier: GPL-3.0-or-later
"""A machined part with sharp edges, from samples a little off a lattice: pvbatch sharp_solid.py

Needs the compiled plugin, loaded by PV_PLUGIN_PATH or the Debian package."""

from paraview.simple import *

# Stands for your data: distances from a block with a bore.
samples = ProgrammableSource(OutputDataSetType="vtkPolyData")
samples.Script = """
import numpy as np
lattice = np.stack(np.meshgrid(*3 * [np.linspace(-1, 1, 90)]), -1).reshape(-1, 3)
positions = lattice + np.random.default_rng(1).uniform(-0.005, 0.005, lattice.shape)
block = (np.abs(positions) - [0.8, 0.5, 0.4]).max(axis=1)
bore = 0.25 - np.hypot(positions[:, 0], positions[:, 1])
output.Points = positions
output.PointData.append(np.maximum(block, bore), "distance")
"""

part = ScatteredIsopoints(
    Input=samples, ContourBy=["POINTS", "distance"], Isosurfaces=[0.0],
    Projection="Cubic fit with creases")

LoadPalette("WhiteBackground")
view = GetActiveViewOrCreate("RenderView")
view.OrientationAxesVisibility = 0
view.ViewSize = [600, 400]
ColorBy(Show(part), None)
ResetCamera()
GetActiveCamera().Azimuth(30)
GetActiveCamera().Elevation(35)
GetActiveCamera().Zoom(1.15)
SaveScreenshot("sharp_solid.png", view)
