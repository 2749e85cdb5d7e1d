# SPDX-License-Identifier: GPL-3.0-or-later
"""Translucent splats show the layers that a translucent mesh shows."""

import numpy as np
from scenes import Scene, actor_of, check, color_by, psnr, torus_mesh, torus_splats
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper


def peel(scene):
    scene.window.SetAlphaBitPlanes(1)
    scene.renderer.UseDepthPeelingOn()
    scene.renderer.SetMaximumNumberOfPeels(16)
    scene.renderer.SetOcclusionRatio(0)


def half(actor):
    actor.GetProperty().SetOpacity(0.5)
    actor.GetProperty().SetColor(0.9, 0.6, 0.3)


def ball():
    source = vtkSphereSource()
    source.SetCenter(1.0, 0.0, 0.0)
    source.SetRadius(0.25)
    source.SetThetaResolution(60)
    source.SetPhiResolution(60)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.1, 0.3, 0.9)
    actor.GetProperty().SetOpacity(0.4)
    return actor


def with_depth_peeling(scene, actor):
    half(actor)
    peel(scene)


def without_depth_peeling(scene, actor):
    half(actor)


def around_a_translucent_ball(scene, actor):
    with_depth_peeling(scene, actor)
    scene.renderer.AddActor(ball())


def translucent_colors(scene, actor):
    peel(scene)
    color_by(actor, "x", -1.4, 1.4)
    table = vtkLookupTable()
    table.SetTableRange(-1.4, 1.4)
    table.SetAlphaRange(0.1, 0.9)
    table.SetNumberOfTableValues(1024)
    table.Build()
    actor.GetMapper().SetLookupTable(table)


def low_view(scene):
    """Rays meet the torus up to four times."""
    scene.camera.SetPosition(0, -4, 0.8)
    scene.renderer.ResetCameraClippingRange()


def picture(data, splats, mode):
    actor = actor_of(data, splats)
    scene = Scene(actor)
    mode(scene, actor)
    low_view(scene)
    image = scene.image()
    scene.save(f"{mode.__name__}_{'splats' if splats else 'mesh'}.png")
    return image


def differing(picture, expected):
    """The share of a body's pixels that differ by more than 8 gray levels."""
    expected = expected.astype(int)
    body = (expected != expected[0, 0]).any(axis=-1)
    return np.mean(np.abs(picture - expected).max(axis=-1)[body] > 8)


def main():
    splats, mesh = torus_splats(), torus_mesh()
    failed = []
    for mode in (
        with_depth_peeling,
        without_depth_peeling,
        around_a_translucent_ball,
        translucent_colors,
    ):
        expected, drawn = picture(mesh, False, mode), picture(splats, True, mode)
        ratio = psnr(expected, drawn)
        print(f"{mode.__name__:26} {ratio:6.2f} dB, at least 48", flush=True)
        if not ratio >= 48:
            failed.append(mode.__name__)
        if mode is with_depth_peeling:
            share = differing(drawn, expected)
            print(f"    {100 * share:.2f} % of the pixels differ, at most 0.5 %", flush=True)
            check(share <= 0.005, "splats overlap")
    check(not failed, ", ".join(failed))


if __name__ == "__main__":
    main()
