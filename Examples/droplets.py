# SPDX-License-Identifier: GPL-3.0-or-later
"""Droplets of a jet of particles as closed bodies, and their number and volume over time: pvbatch droplets.py

Needs the compiled plugin, loaded by PV_PLUGIN_PATH or the Debian package."""

import numpy as np
from paraview.simple import *
from vtkmodules.vtkFiltersCore import vtkMassProperties

COLORS = "Inferno" if GetParaViewVersion() >= 6 else "Inferno (matplotlib)"

# Stands for your files: particles of a jet that breaks into droplets, at seven times.
random = np.random.default_rng(6)
lattice = np.stack(np.meshgrid(np.arange(-3, 3, 0.045), *2 * [np.arange(-0.6, 0.6, 0.045)], indexing="ij"), -1)
particles = lattice.reshape(-1, 3) + random.normal(0, 0.004, (lattice.size // 3, 3))
x, y, z = particles.T
paths = []
for step in range(7):
    wave = np.maximum(1 + 0.32 * step * np.cos(np.pi * x), 0)
    radius = 0.33 * wave / np.sqrt((wave**2).mean()) * (np.abs(x) < 2.9)
    drop = particles[np.hypot(y, z) < radius]
    paths.append(f"droplets_{step}.csv")
    np.savetxt(paths[-1], drop, "%.6f", ",", header="x,y,z", comments="")

samples = TableToPoints(Input=CSVReader(FileName=paths), XColumn="x", YColumn="y", ZColumn="z")
body = ScatteredBody(Input=samples)
pieces = Connectivity(Input=body)

rows = []
for step in range(7):
    UpdatePipeline(step, pieces)
    mass = vtkMassProperties()
    mass.SetInputData(servermanager.Fetch(body))
    mass.Update()
    count = pieces.PointData["RegionId"].GetRange()[1] + 1
    rows.append([step, count, mass.GetVolume()])
    print(f"time {step}: {count:.0f} bodies, volume {mass.GetVolume():.3f}")
np.savetxt("over_time.csv", rows, "%.6f", ",", header="time,bodies,volume", comments="")

LoadPalette("WhiteBackground")
layout = CreateLayout("droplets")
place = 0
for step in (0, 3, 6):
    view = CreateRenderView()
    view.OrientationAxesVisibility, view.ViewTime = 0, step
    AssignViewToLayout(view, layout, place)
    place = layout.SplitVertical(place, 0.22) + 1
    UpdatePipeline(step, pieces)
    shown = Show(pieces, view)
    ColorBy(shown, ("POINTS", "RegionId"))
    GetColorTransferFunction("RegionId").ApplyPreset(COLORS, True)
    GetColorTransferFunction("RegionId").RescaleTransferFunction(-1, 4)
    shown.SetScalarBarVisibility(view, False)
    Render(view)
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, -8, 2], [0, 0, 0], [0, 0, 1]
    view.CameraParallelProjection, view.CameraParallelScale = 1, 0.6

chart = CreateView("XYChartView")
chart.BottomAxisTitle, chart.LeftAxisTitle = "time", ""
AssignViewToLayout(chart, layout, place)
curves = Show(CSVReader(FileName=["over_time.csv"]), chart)
curves.UseIndexForXAxis, curves.XArrayName = 0, "time"
curves.SeriesVisibility = ["bodies", "volume"]
curves.SeriesLineThickness = ["bodies", "3", "volume", "3"]

layout.SetSize(800, 700)
RenderAllViews()
SaveScreenshot("droplets.png", layout)
