# SPDX-License-Identifier: GPL-3.0-or-later
"""With multisampling outlines of splats are as smooth as a mesh's, and lie where the mesh's do; nothing
within the surface is cut away."""

import numpy as np
from scenes import (
    Scene,
    actor_of,
    check,
    isopoints,
    polydata,
    psnr,
    shrunk,
    torus_mesh,
    torus_splats,
)

MAGENTA = (1, 0, 1)
SAMPLES = 8  # as a window has by default; the driver may give fewer
CAMERAS = ((0, -3, 3), (0.1, -0.5, 4), (3.5, 1, 1))


def scene_of(actor, camera, background=MAGENTA, samples=SAMPLES):
    scene = Scene(actor, samples=samples)
    scene.renderer.SetBackground(*background)
    scene.camera.SetPosition(*camera)
    scene.camera.SetViewUp(0, 0, 1)
    scene.renderer.ResetCamera(-1.4, 1.4, -1.4, 1.4, -0.4, 0.4)
    return scene


def coverage(data, splats, camera, samples=SAMPLES):
    """The share of each pixel that a surface covers."""
    actor = actor_of(data, splats)
    actor.GetProperty().LightingOff()
    actor.GetProperty().SetColor(0, 0, 0)
    return 1 - scene_of(actor, camera, (1, 1, 1), samples).image()[..., 0] / 255


def outlines_are_those_of_the_mesh():
    splats, mesh = torus_splats(), torus_mesh()
    for i, camera in enumerate(CAMERAS):
        images = []
        for data, is_splats in ((mesh, False), (splats, True)):
            scene = scene_of(actor_of(data, is_splats), camera)
            images.append(scene.image())
            scene.save(f"outline_{i}_{'splats' if is_splats else 'mesh'}.png")
        ratio = psnr(*images)
        truth, ours = coverage(mesh, False, camera), coverage(splats, True, camera)
        partial = (truth > 0) & (truth < 1)
        offset = (ours - truth).sum() / np.count_nonzero(partial)
        outside = np.count_nonzero((ours > 0) & (truth == 0))
        far = np.abs(ours - truth) > 0.8
        print(
            f"camera {i}: {ratio:.2f} dB, outline {offset:+.3f} pixels too wide, {outside} of "
            f"{np.count_nonzero(partial)} pixels touched beyond it"
        )
        check(np.count_nonzero(partial) > 500, "the window has samples")
        check(ratio >= 40, "the same picture")
        check(abs(offset) < 0.1, "the same outline")
        check(outside < 0.1 * np.count_nonzero(partial), "hardly a pixel beyond the outline")
        check(not far.any(), "no pixel apart")


def nothing_inside_is_cut_away():
    """Neither of what is curved more than pixels show, nor of flat and sharp shapes, seen from anywhere."""
    side = 60
    grid = np.linspace(-1, 1, side)
    x, y = (axis.ravel() for axis in np.meshgrid(grid, grid))
    flat = np.column_stack([x, y, 0 * x])
    sheet = polydata(
        flat, np.tile([0.0, 0.0, 1.0], (len(flat), 1)), Radius=np.full(len(flat), 3.0 / side)
    )
    wave = polydata(
        np.column_stack([x, y, 0.02 * np.sin(12 * x)]),
        np.column_stack([-0.24 * np.cos(12 * x), 0 * x, 0 * x + 1]),
        Radius=np.full(len(flat), 3.0 / side),
    )
    ball = isopoints(
        lambda p: 1 - np.linalg.norm(p, axis=1), [-1.3] * 3, [1.3] * 3, 100_000
    )
    cube = isopoints(
        lambda p: 0.8 - np.abs(p).max(axis=1), [-1.2] * 3, [1.2] * 3, 200_000, creases=True
    )
    for name, data in (("sheet", sheet), ("wave", wave), ("ball", ball), ("cube", cube)):
        for camera in ((0, -3, 3), (0, -4, 0.3), (0.1, -4, 0.1), (2, 3, 1), (30, -20, 10)):
            without = coverage(data, True, camera, samples=0) > 0
            with_samples = coverage(data, True, camera)
            inside = shrunk(shrunk(shrunk(without)))
            holes = np.count_nonzero(inside & (with_samples < 1))
            print(f"{name} from {camera}: {holes} holes in {inside.sum()} pixels")
            check(holes == 0, f"holes in the {name}")


def main():
    outlines_are_those_of_the_mesh()
    nothing_inside_is_cut_away()


if __name__ == "__main__":
    main()
