# SPDX-License-Identifier: GPL-3.0-or-later
"""Scattered samples as a slice, a volume and a plot over a line beside the exact solution: pvbatch heat.py

Needs the compiled plugin, loaded by PV_PLUGIN_PATH or the Debian package."""

import numpy as np
from paraview.simple import *

COLORS = "Inferno" if GetParaViewVersion() >= 6 else "Inferno (matplotlib)"

# Stands for your file: heat that spreads from two points in a ball of 60,000 uneven sensors.
lattice = np.stack(np.meshgrid(*3 * [np.linspace(-1, 1, 49)], indexing="ij"), -1).reshape(-1, 3)
places = lattice + np.random.default_rng(3).normal(0, 0.008, lattice.shape)
x, y, z = places = places[np.linalg.norm(places, axis=1) < 1].T
temperature = np.exp(-8 * ((x - 0.4) ** 2 + y**2 + z**2)) + 0.7 * np.exp(-20 * ((x + 0.4) ** 2 + y**2 + z**2))
np.savetxt("heat.csv", np.column_stack([*places, temperature]), "%.6f", ",", header="x,y,z,temperature", comments="")

table = CSVReader(FileName=["heat.csv"])
samples = TableToPoints(Input=table, XColumn="x", YColumn="y", ZColumn="z")

LoadPalette("WhiteBackground")
layout = CreateLayout("heat")


def render_view(hint):
    view = CreateRenderView()
    view.OrientationAxesVisibility = 0
    AssignViewToLayout(view, layout, hint)
    return view


# The slice ends where the samples do. Dragging the plane keeps the tree.
view = render_view(0)
layout.SplitHorizontal(0, 0.33)
piece = ScatteredSlice(Input=samples)
piece.SliceType.Origin, piece.SliceType.Normal = [0, 0, 0], [0, 1, 0.3]
display = Show(piece, view)
ColorBy(display, ("POINTS", "temperature"))
GetColorTransferFunction("temperature").ApplyPreset(COLORS, True)
ResetCamera(view)
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, -6, 1], [0, 0, 0], [0, 0, 1]
ResetCamera(view)

# An image of the samples: outside of these its points are hidden.
view = render_view(2)
layout.SplitHorizontal(2, 0.5)
image = ScatteredGrid(Input=samples, SamplingDimensions=3 * [80])
volume = Show(image, view)
volume.SetRepresentationType("Volume")
ColorBy(volume, ("POINTS", "temperature"))
ResetCamera(view)

# The plot: outside of the samples the curve has gaps.
chart = CreateView("XYChartView")
chart.BottomAxisTitle, chart.LeftAxisTitle, chart.LegendLocation = "distance", "temperature", "TopLeft"
AssignViewToLayout(chart, layout, 6)
line = ScatteredLine(Input=samples, Point1=[-1.2, 0, 0], Point2=[1.2, 0, 0])
exact = PythonCalculator(Input=line, ArrayName="exact", Expression=(
    "exp(-8 * (inputs[0].Points[:,0] - 0.4)**2) + 0.7 * exp(-20 * (inputs[0].Points[:,0] + 0.4)**2)"))
curves = Show(exact, chart)
curves.UseIndexForXAxis, curves.XArrayName = 0, "arc_length"
curves.SeriesVisibility = ["temperature", "exact"]
curves.SeriesLineThickness = ["temperature", "4", "exact", "1"]

layout.SetSize(1200, 400)
RenderAllViews()
SaveScreenshot("heat.png", layout)
