# SPDX-License-Identifier: GPL-3.0-or-later
"""Ray-traced pictures of ParaView's views, by ray_trace() and by File > Export Scene:
TestRayTracing.py PLUGIN"""

import os
import sys

import numpy as np
from paraview import simple
from scatteredisopoints import ray_trace

from scripting import FOLDER, check, pixels_of_file


def read(path):
    """Rows from above, as ray_trace() yields them."""
    return pixels_of_file(path)[::-1].astype(float)


def psnr(one, other):
    error = np.mean((one.astype(float) - other) ** 2)
    return np.inf if error == 0 else 10 * np.log10(255**2 / error)


def scene():
    """A view of splats, colored by an array, above a disk of triangles."""
    wavelet = simple.Wavelet()
    points = ScatteredIsopoints(  # noqa: F821, of the plugin
        Input=wavelet, ContourBy=["POINTS", "RTData"], Isosurfaces=[200.0])
    view = simple.CreateRenderView(ViewSize=[320, 240])
    view.OrientationAxesVisibility = 0
    shown = simple.Show(points, view)
    check(shown.Representation == "Isopoint Splats", "splats are shown")
    simple.ColorBy(shown, None)
    shown.DiffuseColor = [0.8, 0.7, 0.4]
    floor = simple.Disk(InnerRadius=0.0, OuterRadius=20.0, CircumferentialResolution=60)
    moved = simple.Transform(Input=floor)
    moved.Transform.Translate = [0.0, 0.0, -10.0]
    simple.Show(moved, view).DiffuseColor = [0.4, 0.6, 0.8]
    view.CameraPosition = [40.0, -50.0, 30.0]
    view.CameraFocalPoint = [0.0, 0.0, -2.0]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    return view, shown


def is_what_the_view_shows(view):
    path = os.path.join(FOLDER, "drawn.png")
    simple.SaveScreenshot(path, view)
    drawn = read(path)
    traced = ray_trace(view, samples=16, shadows=False)
    check(traced.shape == drawn.shape, "as large as the view")
    quality = psnr(traced, drawn)
    print(f"without shadows against the view: {quality:.1f} dB")
    check(quality > 27, "the picture is that of the view")
    small = ray_trace(view, os.path.join(FOLDER, "small.png"), samples=1, size=(80, 60))
    check(small.shape == (60, 80, 3), "of the size asked for")
    check(np.array_equal(read(os.path.join(FOLDER, "small.png")), small), "the file is the picture")


def can_be_exported(view, shown):
    path = os.path.join(FOLDER, "exported.png")
    simple.ExportView(path, view=view, SamplesPerPixel=4, AmbientLight=0.2)
    exported = read(path)
    expected = ray_trace(view, samples=4, ambient_light=0.2)
    check(np.abs(exported - expected).max() <= 1, "the file is that of ray_trace()")
    shown.Interpolation = "PBR"
    shown.Metallic = 1.0
    shown.Roughness = 0.0
    simple.ExportView(path, view=view, SamplesPerPixel=4, Magnification=2)
    mirror = read(path)
    check(mirror.shape == (480, 640, 3), "twice as large")
    difference = np.abs(mirror - ray_trace(view, samples=4, size=(640, 480), ambient_light=0.3))
    check(difference.max() <= 1, "a mirror, in tiles")
    check(psnr(mirror[::2, ::2], exported) < 30, "the material is that of the view")
    shown.Interpolation = "Gouraud"


def has_the_annotations_of_the_view(view, shown):
    """The color legend and the axes are where a screenshot has them."""
    path = os.path.join(FOLDER, "annotated.png")
    simple.ColorBy(shown, ("POINTS", "Radius"))
    shown.SetScalarBarVisibility(view, True)
    view.OrientationAxesVisibility = 1
    for magnification in (1, 2):
        size = [magnification * each for each in view.ViewSize]
        simple.SaveScreenshot(path, view, ImageResolution=size)
        drawn = read(path)
        simple.ExportView(path, view=view, SamplesPerPixel=16, Shadows=0, AmbientLight=0.0,
                          Magnification=magnification)
        exported = read(path)
        check(exported.shape == drawn.shape, "as large as a screenshot")
        height, width, _ = drawn.shape
        parts = dict(legend=np.s_[height // 2:, 3 * width // 4:], axes=np.s_[3 * height // 4:, :width // 5])
        for name, part in parts.items():
            quality = psnr(exported[part], drawn[part])
            print(f"{name}, magnification {magnification}: {quality:.1f} dB")
            check(np.ptp(drawn[part]) > 100, f"there is something to see of the {name}")
            check(quality > 35, f"the picture has the {name}")


def rejects_what_it_cannot_trace(view):
    for arguments, options, expected in (
        ((simple.Sphere(),), {}, TypeError),
        ((view,), {"softness": 1.0}, TypeError),
        ((view,), {"size": (100_000, 1)}, RuntimeError),
        ((view, "/no/such/folder/a.png"), {"samples": 1}, OSError),
    ):
        try:
            ray_trace(*arguments, **options)
        except expected as error:
            check(str(error), "it says why")
        else:
            check(False, f"{options} is accepted")


simple.LoadPlugin(sys.argv[1], ns=globals())
VIEW, SHOWN = scene()
is_what_the_view_shows(VIEW)
can_be_exported(VIEW, SHOWN)
has_the_annotations_of_the_view(VIEW, SHOWN)
rejects_what_it_cannot_trace(VIEW)
