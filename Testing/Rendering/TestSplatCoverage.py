# SPDX-License-Identifier: GPL-3.0-or-later
"""No hole: within the outline of the true surface, a twentieth of a pixel inside it, every pixel is the surface's, however far the
camera is, and nothing far outside of it is."""

import numpy as np
from scenes import Scene, actor_of, check, differs, isopoints

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


def is_covered(splats, radius, distances):
    actor = actor_of(splats)
    scene = Scene(actor)
    scene.renderer.SetBackground(0, 0, 1)
    actor.GetProperty().SetAmbient(0.3)
    for distance in distances:
        scene.camera.SetPosition(
            0.3 * distance * radius, -distance * radius, 0.2 * distance * radius
        )
        scene.camera.SetFocalPoint(0, 0, 0)
        scene.camera.SetViewUp(0, 0, 1)
        scene.renderer.ResetCameraClippingRange()
        covered = differs(scene.image(), (0, 0, 1))
        place = outline(scene, radius)
        holes = np.count_nonzero(~covered & (place < -0.05))
        outside = np.count_nonzero(covered & (place > 1.0))
        print(f"{distance:5} radii away: {holes} holes, {outside} pixels outside")
        scene.save(f"sphere_{distance:g}.png")
        check(holes == 0, "holes")
        check(outside == 0, "pixels outside")


def main():
    splats, radius = sphere(8_000_000)
    is_covered(splats, radius, (2.5, 3.67, 4.66, 6.0, 15.0, 40.0, 300.0))


if __name__ == "__main__":
    main()
