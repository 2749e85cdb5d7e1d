# SPDX-License-Identifier: GPL-3.0-or-later
"""Each filter applied to the same samples, a picture each: pvbatch filters.py

Needs the compiled plugin, loaded by PV_PLUGIN_PATH or the Debian package."""

import numpy as np
from paraview.simple import *

COLORS = "Inferno" if GetParaViewVersion() >= 6 else "Inferno (matplotlib)"

# Stands for your file: the temperature at 60,000 uneven places in a ball.
lattice = np.stack(np.meshgrid(*3 * [np.linspace(-1, 1, 49)], indexing="ij"), -1).reshape(-1, 3)
places = lattice + np.random.default_rng(4).normal(0, 0.008, lattice.shape)
x, y, z = places = places[np.linalg.norm(places, axis=1) < 1].T
temperature = np.exp(-8 * ((x - 0.4) ** 2 + y**2 + z**2)) + 0.7 * np.exp(-20 * ((x + 0.4) ** 2 + y**2 + z**2))
np.savetxt("filters.csv", np.column_stack([*places, temperature]), "%.6f", ",", header="x,y,z,temperature", comments="")

table = CSVReader(FileName=["filters.csv"])
samples = TableToPoints(Input=table, XColumn="x", YColumn="y", ZColumn="z")

isosurface = ScatteredIsosurface(Input=samples, ContourBy=["POINTS", "temperature"], Isosurfaces=[0.3])
piece = ScatteredSlice(Input=samples)
piece.SliceType.Origin, piece.SliceType.Normal = [0, 0, 0], [0, 1, 0]
image = ScatteredGrid(Input=samples, SamplingDimensions=3 * [80])
line = ScatteredLine(Input=samples, Point1=[-1, 0, 0], Point2=[1, 0, 0])
gradient = ScatteredGradient(Input=samples, ScalarArray=["POINTS", "temperature"])
arrows = Glyph(Input=gradient, GlyphType="Arrow", OrientationArray=["POINTS", "Gradient"],
               ScaleArray=["POINTS", "Gradient"], ScaleFactor=0.14, MaximumNumberOfSamplePoints=2500)
probe = ScatteredProbe(
    Samples=samples,
    DestinationMesh=Superquadric(ThetaResolution=100, PhiResolution=100, Toroidal=1, Size=0.7))
hot = Clip(Input=samples, ClipType="Scalar", Scalars=["POINTS", "temperature"], Value=0.3, Invert=0)
body = ScatteredBody(Input=hot)

LoadPalette("WhiteBackground")
pictures = {"isosurface": isosurface, "slice": piece, "grid": image, "gradient": arrows, "probe": probe, "body": body}
for name, shown in pictures.items():
    view = CreateRenderView(ViewSize=[320, 240], OrientationAxesVisibility=0)
    display = Show(shown, view)
    if shown is image:
        display.SetRepresentationType("Volume")
    if shown in (isosurface, body):
        display.ColorArrayName = ["POINTS", ""]
        display.AmbientColor = display.DiffuseColor = [0.8, 0.4, 0.2]
    else:
        ColorBy(display, ("POINTS", "temperature"))
        GetColorTransferFunction("temperature").ApplyPreset(COLORS, True)
    view.CameraPosition, view.CameraViewUp = [1, -4, 2], [0, 0, 1]
    ResetCamera(view)
    GetActiveCamera().Zoom(2 if shown is arrows else 1.4)
    SaveScreenshot(f"filters_{name}.png", view)

chart = CreateView("XYChartView", ViewSize=[320, 240], ShowLegend=0)
curves = Show(line, chart)
curves.UseIndexForXAxis, curves.XArrayName, curves.SeriesVisibility = 0, "arc_length", ["temperature"]
curves.SeriesLineThickness, curves.SeriesColor = ["temperature", "3"], ["temperature", "0.8", "0.2", "0.1"]
Render(chart)
SaveScreenshot("filters_line.png", chart)
