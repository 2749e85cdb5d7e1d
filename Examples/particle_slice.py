# SPDX-License-Identifier: GPL-3.0-or-later
"""A slice through particles of a liquid, beside those of ParaView's interpolators: pvbatch particle_slice.py

Needs the compiled plugin, loaded by PV_PLUGIN_PATH or the Debian package."""

import numpy as np
from paraview.simple import *

COLORS = "Viridis" if GetParaViewVersion() >= 6 else "Viridis (matplotlib)"

# Stands for your file: 85,000 particles of water with waves, around a ball, and their speed.
random = np.random.default_rng(5)
spacing = 0.025
lattice = np.stack(np.meshgrid(*[np.arange(-size, size, spacing) for size in (1, 0.5, 0.5)], indexing="ij"), -1)
places = lattice.reshape(-1, 3) + random.normal(0, 0.15 * spacing, (lattice.size // 3, 3))
x, y, z = places.T
depth = 0.2 + 0.15 * np.cos(5 * x + y) - z
away = np.linalg.norm(places - [0.2, 0, -0.15], axis=1)
wet = (depth > 0) & (away > 0.2)
speed = 1.5 * np.exp(-2 * depth) * (1 + 0.3 * np.sin(5 * x + y)) + 0.004 / np.maximum(away, 0.2) ** 3
columns = {"x": x, "y": y, "z": z, "speed": speed, "Rho": np.full(len(x), 1000.0),
           "Mass": np.full(len(x), 1000 * spacing**3)}
np.savetxt("particles.csv", np.column_stack([*columns.values()])[wet], "%.5f", ",", header=",".join(columns),
           comments="")

table = CSVReader(FileName=["particles.csv"])
particles = TableToPoints(Input=table, XColumn="x", YColumn="y", ZColumn="z")
particles.UpdatePipeline()


def place(source, center, normal):
    setattr(source, center, [0, 0, 0])
    source.Normal = [0, 1, 0]


def slice_of(name, **options):
    """A plane through samples, or through an image of them."""
    piece = globals()[name](**options)
    place(piece.SliceType, "Origin", "Normal")
    return piece


# Only the plane is set here, all else has the default values.
plane = Plane(Origin=[-1, 0, -0.55], Point1=[1, 0, -0.55], Point2=[-1, 0, 0.45], XResolution=100, YResolution=100)
point_plane, sph_plane = (
    kind(Input=particles, Source="Bounded Plane") for kind in (PointPlaneInterpolator, SPHPlaneInterpolator))
for interpolator in point_plane, sph_plane:
    place(interpolator.Source, "Center", "Normal")
pieces = {
    "Scattered Slice": slice_of("ScatteredSlice", Input=particles),
    "Point Plane Interpolator": point_plane,
    "Point Dataset Interpolator": PointDatasetInterpolator(Input=particles, Source=plane),
    "Point Volume Interpolator, Slice": slice_of(
        "Slice", Input=PointVolumeInterpolator(Input=particles, Source="Bounded Volume")),
    "SPH Plane Interpolator": sph_plane,
    "SPH Volume Interpolator, Slice": slice_of(
        "Slice", Input=SPHVolumeInterpolator(Input=particles, Source="Bounded Volume")),
}

LoadPalette("WhiteBackground")
layout = CreateLayout("slices")
layout.SplitVertical(0, 0.5)
for row in 1, 2:
    layout.SplitHorizontal(row, 1 / 3)
    layout.SplitHorizontal(2 * (row + 1), 0.5)
views, cells = [], (3, 9, 10, 5, 13, 14)
for cell, (name, piece) in zip(cells, pieces.items()):
    view = CreateRenderView(OrientationAxesVisibility=0)
    AssignViewToLayout(view, layout, cell)
    display = Show(piece, view)
    display.Ambient, display.Diffuse = 1, 0
    ColorBy(display, ("POINTS", "speed"))
    title = Show(Text(Text=name), view)
    title.FontSize, title.WindowLocation = 14, "Lower Center"
    views.append(view)
colors = GetColorTransferFunction("speed")
colors.ApplyPreset(COLORS, True)
colors.RescaleTransferFunction(0, 2)

layout.SetSize(960, 480)
RenderAllViews()
for view in views:
    view.CameraParallelProjection, view.CameraParallelScale = 1, 0.8
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, -5, -0.15], [0, 0, -0.15], [0, 0, 1]
SaveScreenshot("particle_slice.png", layout)
