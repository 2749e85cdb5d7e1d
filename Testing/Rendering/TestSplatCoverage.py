# SPDX-License-Identifier: GPL-3.0-or-later
"""No hole: within the outline of the true surface every pixel is the surface's, however far the
camera is, and nothing far outside of it is. Neither is there a hole at a lower level of detail."""

import numpy as np
from scenes import Scene, actor_of, check, color_by, differs, isopoints, parts, polydata, shrunk

RADIUS = 70.0


def sphere(samples):
    """The sphere of radius 70 around the middle of a cube with one sample a unit volume."""
    side = samples ** (1 / 3)
    scale = side / 200.0
    radius = RADIUS * scale
    half = [side / 2] * 3
    return isopoints(
        lambda p: radius - np.linalg.norm(p, axis=1), np.negative(half), half, samples
    ), radius


def outline(scene, radius):
    """How far each pixel's middle is from the sphere's outline, in pixels, negative inside."""
    width, height = scene.window.GetSize()
    distance = scene.camera.GetDistance()
    apparent = radius / np.sqrt(distance**2 - radius**2)  # tangent of half the angle it fills
    half = np.tan(np.radians(scene.camera.GetViewAngle() / 2))
    pixels = apparent / half * height / 2
    x, y = np.meshgrid(np.arange(width) + 0.5 - width / 2, np.arange(height) + 0.5 - height / 2)
    return np.hypot(x, y) - pixels


def shuffled(splats):
    """The same splats in random order."""
    points, normals, radii = parts(splats)
    order = np.random.default_rng(2).permutation(len(points))
    return polydata(points[order], normals[order], Radius=radii[order])


def is_covered(splats, radius, strides, distances):
    actor = actor_of(splats)
    scene = Scene(actor)
    scene.renderer.SetBackground(0, 0, 1)
    actor.GetProperty().SetAmbient(0.3)
    for stride in strides:
        actor.GetMapper().SetStride(stride)
        for distance in distances:
            scene.camera.SetPosition(
                0.3 * distance * radius, -distance * radius, 0.2 * distance * radius
            )
            scene.camera.SetFocalPoint(0, 0, 0)
            scene.camera.SetViewUp(0, 0, 1)
            scene.renderer.ResetCameraClippingRange()
            covered = differs(scene.image(), (0, 0, 1))
            place = outline(scene, radius)
            holes = np.count_nonzero(~covered & (place < 0))
            # Larger splats reach out farther beyond the horizon.
            outside = np.count_nonzero(covered & (place > (1.5 if stride == 1 else 3.0)))
            print(
                f"stride {stride}, {distance:5} radii away: {holes} holes, "
                f"{outside} pixels outside"
            )
            scene.save(f"sphere_{stride}_{distance:g}.png")
            check(holes == 0, "holes")
            check(outside == 0, "pixels outside")


def both_sides_of_a_thin_wall():
    """At a lower level of detail no splat of one side stands for some of the other side."""
    side = 100
    x, y = (axis.ravel() for axis in np.meshgrid(*[np.linspace(-1, 1, side)] * 2))
    count = len(x)
    height = np.repeat([0.005, -0.005], count)
    wall = polydata(
        np.column_stack([np.tile(x, 2), np.tile(y, 2), height]),
        np.column_stack([0 * height, 0 * height, np.sign(height)]),
        Radius=np.full(2 * count, 2.0 / side),
        x=height,
    )
    actor = actor_of(wall)
    actor.GetProperty().LightingOff()
    actor.GetMapper().SetStride(8)
    color_by(actor, "x", -0.005, 0.005)
    actor.GetMapper().SetBlendDepth(0.05)
    for camera in ((0, -1, 3), (0, -1, -3)):
        scene = Scene(actor)
        scene.camera.SetPosition(*camera)
        scene.renderer.ResetCameraClippingRange()
        image = scene.image()
        wall_pixels = shrunk(differs(image))
        colors = np.unique(image[wall_pixels].round(-1), axis=0)
        print(f"wall: {len(colors)} colors in {wall_pixels.sum()} pixels")
        check(wall_pixels.sum() > 50_000, "a wall")
        check(len(colors) == 1, "one side only")


def main():
    splats, radius = sphere(8_000_000)
    is_covered(splats, radius, (1,), (2.5, 3.67, 4.66, 6.0, 15.0, 40.0, 300.0))
    is_covered(splats, radius, (8,), (2.5, 4.66, 15.0))
    is_covered(shuffled(splats), radius, (2, 8), (2.5, 4.66, 15.0))
    both_sides_of_a_thin_wall()


if __name__ == "__main__":
    main()
