# SPDX-License-Identifier: GPL-3.0-or-later
"""Splats cover what the surface covers. They have no hole at any distance of the camera. With multisampling their
outlines are as smooth as a mesh's, and in the same place. Nothing within the surface is cut away."""

import numpy as np
from scenes import (
    Scene, actor_of, ball_field, check, configured, differs, isopoints, polydata, positions_of, psnr, run, subset,
    torus_mesh, torus_splats)

RADIUS = 70.0
SAMPLES = 8  # as a window has by default; the driver may give fewer


def outline(scene, radius):
    """The signed distance of each pixel's middle from the sphere's outline, in pixels; negative inside."""
    width, height = scene.window.GetSize()
    apparent = radius / np.sqrt(scene.camera.GetDistance()**2 - radius**2)  # tangent of half the angle it fills
    pixels = apparent / np.tan(np.radians(scene.camera.GetViewAngle() / 2)) * height / 2
    x, y = np.meshgrid(np.arange(width) + 0.5 - width / 2, np.arange(height) + 0.5 - height / 2)
    return np.hypot(x, y) - pixels


def a_sphere_has_no_hole():
    """The sphere has the radius 70, and each unit of volume has one sample. At any distance of the camera, all pixels
    that are a twentieth of a pixel inside the outline show the surface, and none far outside does."""
    half = 100.0
    splats = isopoints(lambda p: RADIUS - np.linalg.norm(p, axis=1), -half, half, 8_000_000)
    scene = Scene(actor_of(splats, Ambient=0.3), background=(0, 0, 1))
    for distance in (2.5, 3.67, 4.66, 6.0, 15.0, 40.0, 300.0):
        position = tuple(np.array([0.3, -1.0, 0.2]) * distance * RADIUS)
        configured(scene.camera, Position=position, FocalPoint=(0, 0, 0), ViewUp=(0, 0, 1))
        scene.renderer.ResetCameraClippingRange()
        covered, place = differs(scene.image(f"sphere_{distance:g}.png"), (0, 0, 1)), outline(scene, RADIUS)
        holes, outside = np.count_nonzero(~covered & (place < -0.05)), np.count_nonzero(covered & (place > 1.0))
        print(f"{distance:5} radii away: {holes} holes, {outside} pixels outside")
        check(covered.any() and holes == outside == 0, f"the sphere {distance} radii away")


def a_sphere_has_no_crack():
    """The half of a sphere that the camera sees hides the background in each sample of each pixel."""
    splats = isopoints(lambda p: RADIUS - np.linalg.norm(p, axis=1), -100.0, 100.0, 1_000_000)
    for samples in (0, 4, SAMPLES):
        cracks = 0
        for position in ((200, 150, 270), (-300, 40, 130), (10, -280, -190), (-150, 260, -170)):
            half = subset(splats, positions_of(splats) @ position > 0.0)
            scene = Scene(actor_of(half, Lighting=False, Color=(0, 1, 0)), samples=samples, background=(1, 0, 0))
            configured(scene.camera, Position=position, FocalPoint=(0, 0, 0), ViewUp=(0, 0, 1))
            scene.renderer.ResetCameraClippingRange()
            cracks += np.count_nonzero((scene.image()[..., 0] > 0) & (outline(scene, RADIUS) < -2.0))
        print(f"{samples} samples: {cracks} pixels with cracks")
        check(cracks == 0, "no crack")


def picture(data, splats, camera, background=(1, 0, 1), samples=SAMPLES, lighting=True):
    actor = actor_of(data, splats, Lighting=lighting, Color=(1, 1, 1) if lighting else (0, 0, 0))
    scene = Scene(actor, samples=samples, background=background)
    scene.look(camera)
    return scene.image()


def coverage(data, splats, camera, samples=SAMPLES):
    """The share of each pixel that a surface covers."""
    return 1 - picture(data, splats, camera, (1, 1, 1), samples, lighting=False)[..., 0] / 255


def outlines_are_those_of_the_mesh():
    both = (torus_mesh(), False), (torus_splats(), True)
    for camera in ((0, -3, 3), (0.1, -0.5, 4), (3.5, 1, 1)):
        ratio = psnr(*(picture(data, splats, camera) for data, splats in both))
        truth, ours = (coverage(data, splats, camera) for data, splats in both)
        partial = np.count_nonzero((truth > 0) & (truth < 1))
        offset = (ours - truth).sum() / partial
        outside = np.count_nonzero((ours > 0) & (truth == 0))
        print(f"from {camera}: {ratio:.2f} dB, outline {offset:+.3f} pixels too wide, {outside} of {partial} beyond it")
        check(partial > 500, "the window has samples")
        check(ratio >= 40, "the same picture")
        check(abs(offset) < 0.1, "the same outline")
        check(outside < 0.1 * partial, "hardly a pixel beyond the outline")
        check(np.abs(ours - truth).max() <= 0.8, "no pixel apart")


def shrunk(mask, times=3):
    """A mask without the pixels at its border."""
    for _ in range(times):
        mask = np.logical_and.reduce([np.roll(mask, shift, axis) for axis in (0, 1) for shift in (-1, 0, 1)])
    return mask


def nothing_inside_is_cut_away():
    """Strongly curved, flat and sharp shapes have no hole from any direction."""
    x, y = (axis.ravel() for axis in np.meshgrid(*2 * [np.linspace(-1, 1, 60)]))
    radii = np.full(len(x), 0.05)
    for name, data in (
            ("sheet", polydata(np.stack([x, y, 0 * x], 1), np.tile([0.0, 0.0, 1.0], (len(x), 1)), Radius=radii)),
            ("wave", polydata(np.stack([x, y, 0.02 * np.sin(12 * x)], 1),
                              np.stack([-0.24 * np.cos(12 * x), 0 * x, 0 * x + 1], 1), Radius=radii)),
            ("ball", isopoints(ball_field, -1.3, 1.3, 100_000)),
            ("cube", isopoints(lambda p: 0.8 - np.abs(p).max(axis=1), -1.2, 1.2, 200_000, creases=True))):
        for camera in ((0, -3, 3), (0, -4, 0.3), (0.1, -4, 0.1), (2, 3, 1), (30, -20, 10)):
            inside = shrunk(coverage(data, True, camera, samples=0) > 0)
            holes = np.count_nonzero(inside & (coverage(data, True, camera) < 1))
            print(f"{name} from {camera}: {holes} holes in {inside.sum()} pixels")
            check(holes == 0, f"holes in the {name}")


run(a_sphere_has_no_hole, a_sphere_has_no_crack, outlines_are_those_of_the_mesh, nothing_inside_is_cut_away)
