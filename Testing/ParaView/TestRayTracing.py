# SPDX-License-Identifier: GPL-3.0-or-later
"""Ray-traced pictures of ParaView's views, by ray_trace() and by File > Export Scene:
TestRayTracing.py PLUGIN"""

import sys

import numpy as np
from paraview import simple
from scatteredisopoints import ray_trace

from scripting import SPLATS, check, contoured, load, path_of, read_image, psnr, run, shown


def screenshot(**options):
    """The view's picture. The first row is the uppermost, as in that of ray_trace()."""
    simple.SaveScreenshot(path_of("drawn.png"), VIEW, **options)
    return read_image(path_of("drawn.png"))[::-1]


def exported(**options):
    simple.ExportView(path_of("exported.png"), view=VIEW, **options)
    return read_image(path_of("exported.png"))[::-1]


def is_nearly(one, other):
    return one.shape == other.shape and np.abs(one - other.astype(int)).max() <= 1


def is_what_the_view_shows():
    drawn, traced = screenshot(), ray_trace(VIEW, samples=16, shadows=False)
    check(traced.shape == drawn.shape, "as large as the view")
    quality = psnr(traced, drawn)
    print(f"without shadows against the view: {quality:.1f} dB")
    check(quality > 27, "the picture is that of the view")
    small = ray_trace(VIEW, path_of("small.png"), samples=1, size=(80, 60))
    check(small.shape == (60, 80, 3), "of the size asked for")
    check(np.array_equal(read_image(path_of("small.png"))[::-1], small), "the file is the picture")


def can_be_exported():
    plain = exported(SamplesPerPixel=4, AmbientLight=0.2)
    check(is_nearly(plain, ray_trace(VIEW, samples=4, ambient_light=0.2)), "the file is that of ray_trace()")
    DISPLAY.Interpolation, DISPLAY.Metallic, DISPLAY.Roughness = "PBR", 1.0, 0.0
    mirror = exported(SamplesPerPixel=4, Magnification=2)
    check(mirror.shape == (480, 640, 3), "twice as large")
    check(is_nearly(mirror, ray_trace(VIEW, samples=4, size=(640, 480), ambient_light=0.3)), "a mirror, in tiles")
    check(psnr(mirror[::2, ::2], plain) < 30, "the material is that of the view")
    DISPLAY.Interpolation = "Gouraud"


def has_the_annotations_of_the_view():
    """The color legend and the axes are where a screenshot has them."""
    simple.ColorBy(DISPLAY, ("POINTS", "Radius"))
    DISPLAY.SetScalarBarVisibility(VIEW, True)
    VIEW.OrientationAxesVisibility = 1
    for magnification in (1, 2):
        drawn = screenshot(ImageResolution=[magnification * each for each in VIEW.ViewSize])
        traced = exported(SamplesPerPixel=16, Shadows=0, AmbientLight=0.0, Magnification=magnification)
        check(traced.shape == drawn.shape, "as large as a screenshot")
        height, width, _ = drawn.shape
        for name, part in (("legend", np.s_[height // 2:, 3 * width // 4:]),
                           ("axes", np.s_[3 * height // 4:, :width // 5])):
            quality = psnr(traced[part], drawn[part])
            print(f"{name}, magnification {magnification}: {quality:.1f} dB")
            check(np.ptp(drawn[part]) > 100, f"there is something to see of the {name}")
            check(quality > 35, f"the picture has the {name}")


def rejects_what_it_cannot_trace():
    for arguments, options, expected in (
            ((simple.Sphere(),), {}, TypeError), ((VIEW,), {"softness": 1.0}, TypeError),
            ((VIEW,), {"size": (100_000, 1)}, RuntimeError),
            ((VIEW, path_of("small.png")), {"size": (100_000, 1)}, RuntimeError),
            ((VIEW, "/no/such/folder/a.png"), {"samples": 1}, OSError)):
        try:
            ray_trace(*arguments, **options)
        except expected as error:
            check(str(error), "it says why")
        else:
            check(False, f"{options} is accepted")
    check(read_image(path_of("small.png")).shape == (60, 80, 3), "an earlier picture stays")


load(sys.argv[1])
# A view of splats above a disk of triangles.
VIEW = simple.CreateRenderView(ViewSize=[320, 240])
VIEW.OrientationAxesVisibility = 0
DISPLAY = shown(contoured(simple.Wavelet(), "RTData", 200.0), VIEW)
check(DISPLAY.Representation == SPLATS, "splats are shown")
DISPLAY.DiffuseColor = [0.8, 0.7, 0.4]
floor = simple.Transform(Input=simple.Disk(InnerRadius=0.0, OuterRadius=20.0, CircumferentialResolution=60))
floor.Transform.Translate = [0.0, 0.0, -10.0]
simple.Show(floor, VIEW).DiffuseColor = [0.4, 0.6, 0.8]
VIEW.CameraPosition, VIEW.CameraFocalPoint, VIEW.CameraViewUp = [40.0, -50.0, 30.0], [0.0, 0.0, -2.0], [0.0, 0.0, 1.0]
run(is_what_the_view_shows, can_be_exported, has_the_annotations_of_the_view, rejects_what_it_cannot_trace)
