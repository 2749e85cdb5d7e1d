# SPDX-License-Identifier: GPL-3.0-or-later
"""A table of readings as the surface of a plume, colored by another column: pvbatch csv_table.py

Needs the compiled plugin, loaded by PV_PLUGIN_PATH or the Debian package."""

import numpy as np
from paraview.simple import *

# Stands for your file: concentration and temperature at 40,000 places in the air behind a chimney.
random = np.random.default_rng(1)
x, y, z = places = random.uniform(0, 1, (3, 40000)) * [[200], [80], [80]]
height = 15 + 36 * (1 - np.exp(-x / 70)) + 4 * np.sin(x / 9)
distance = np.hypot(y - 40 - 6 * np.sin(x / 20), z - height)
width = (6 + x / 16) * (1 + 0.2 * np.sin(x / 5))
concentration = np.exp(-x / 120) / (1 + np.exp(15 - x)) * np.exp(-0.5 * (distance / width) ** 2)
temperature = 15 + 60 * np.exp(-x / 70) * np.exp(-distance / 30)
np.savetxt("plume.csv", np.column_stack([*places, concentration, temperature]), "%.5f", ",",
           header="x,y,z,concentration,temperature", comments="")

table = CSVReader(FileName=["plume.csv"])
points = TableToPoints(Input=table, XColumn="x", YColumn="y", ZColumn="z")
plume = ScatteredIsopoints(Input=points, ContourBy=["POINTS", "concentration"], Isosurfaces=[0.2])

LoadPalette("WhiteBackground")
view = GetActiveViewOrCreate("RenderView")
view.OrientationAxesVisibility = 0
view.ViewSize = [600, 400]
display = Show(plume)
ColorBy(display, ("POINTS", "temperature"))
GetColorTransferFunction("temperature").ApplyPreset("Cool to Warm", True)
readings = Show(points)
readings.SetRepresentationType("Points")
readings.Opacity = 0.08
readings.ColorArrayName = ["POINTS", ""]
readings.AmbientColor = readings.DiffuseColor = [0.4, 0.4, 0.5]
ResetCamera()
GetActiveCamera().Elevation(-65)
GetActiveCamera().Azimuth(10)
GetActiveCamera().Zoom(1.45)
SaveScreenshot("csv_table.png", view)
