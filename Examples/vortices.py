# SPDX-License-Identifier: GPL-3.0-or-later
"""Vortices among scattered velocities: the isosurface of the Q-criterion, and streamlines: pvbatch vortices.py

Needs the compiled plugin, loaded by PV_PLUGIN_PATH or the Debian package."""

import numpy as np
from paraview.simple import *

# Stands for your file: a Taylor-Green vortex at 60,000 places.
x, y, z = places = np.random.default_rng(2).uniform(0, 2 * np.pi, (3, 60000))
u = np.sin(x) * np.cos(y) * np.cos(z)
v = -np.cos(x) * np.sin(y) * np.cos(z)
np.savetxt("vortices.csv", np.column_stack([*places, u, v, 0.1 * np.sin(2 * z)]), "%.5f", ",",
           header="x,y,z,u,v,w", comments="")

table = CSVReader(FileName=["vortices.csv"])
points = TableToPoints(Input=table, XColumn="x", YColumn="y", ZColumn="z")
samples = Calculator(Input=points, ResultArrayName="velocity", Function="u*iHat + v*jHat + w*kHat")

# Derivatives at the samples, then an isosurface of one of them.
gradients = ScatteredGradient(Input=samples, ScalarArray=["POINTS", "velocity"], ComputeGradient=0,
                              ComputeVorticity=1, ComputeQCriterion=1)
vortices = ScatteredIsosurface(Input=gradients, ContourBy=["POINTS", "Q Criterion"], Isosurfaces=[0.35])
vorticity = Calculator(Input=vortices, ResultArrayName="vorticity along z", Function="Vorticity_Z")

# Streamlines need cells: those of an image.
image = ScatteredGrid(Input=samples, SamplingDimensions=3 * [60])
streamlines = StreamTracer(Input=image, Vectors=["POINTS", "velocity"], SeedType="Point Cloud", MaximumStreamlineLength=8)
streamlines.SeedType.Center, streamlines.SeedType.Radius = 3 * [np.pi], 3
streamlines.SeedType.NumberOfPoints = 50
tubes = Tube(Input=streamlines, Radius=0.02)

LoadPalette("WhiteBackground")
view = GetActiveViewOrCreate("RenderView")
view.OrientationAxesVisibility = 0
view.ViewSize = [600, 400]
display = Show(vorticity)
ColorBy(display, ("POINTS", "vorticity along z"))
GetColorTransferFunction("vorticity along z").ApplyPreset("Cool to Warm", True)
lines = Show(tubes)
lines.ColorArrayName = ["POINTS", ""]
lines.AmbientColor = lines.DiffuseColor = [0.35, 0.35, 0.4]
ResetCamera()
GetActiveCamera().Elevation(-60)
GetActiveCamera().Azimuth(25)
ResetCamera()
GetActiveCamera().Zoom(1.3)
SaveScreenshot("vortices.png", view)
