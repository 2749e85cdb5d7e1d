# SPDX-License-Identifier: GPL-3.0-or-later
"""A table of borehole samples as the surface of an ore body: pvbatch csv_table.py"""

import numpy as np
from paraview.simple import *

# Stands for your file: samples every meter down 200 boreholes, with their grade.
random = np.random.default_rng(1)
x, y = random.uniform(0, 100, (2, 200))
holes = np.array([(px, py, -z) for px, py in zip(x, y) for z in range(60)])
grade = np.exp(-(((holes - [50, 50, -30]) / [30, 18, 12]) ** 2).sum(1)) + 0.1 * np.sin(holes[:, 0] / 9)
np.savetxt("boreholes.csv", np.column_stack([holes, grade]), "%.4f", ",", header="x,y,z,grade", comments="")

table = CSVReader(FileName=["boreholes.csv"])
points = TableToPoints(Input=table, XColumn="x", YColumn="y", ZColumn="z")
ore = ScatteredIsosurface(Input=points, ContourBy=["POINTS", "grade"], Isosurfaces=[0.5])

LoadPalette("WhiteBackground")
view = GetActiveViewOrCreate("RenderView")
view.OrientationAxesVisibility = 0
view.ViewSize = [600, 400]
display = Show(ore)
ColorBy(display, None)
display.DiffuseColor = [0.85, 0.6, 0.3]
boreholes = Show(points)
boreholes.SetRepresentationType("Points")
boreholes.Opacity = 0.3
boreholes.ColorArrayName = ["POINTS", ""]
boreholes.AmbientColor = boreholes.DiffuseColor = [0.4, 0.4, 0.5]
ResetCamera()
view.CameraPosition = [50, -170, 60]
SaveScreenshot("csv_table.png", view)
