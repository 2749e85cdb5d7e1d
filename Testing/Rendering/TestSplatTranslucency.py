# SPDX-License-Identifier: GPL-3.0-or-later
"""Translucent splats show the layers that a translucent mesh shows."""

import numpy as np
from scatteredisopoints import vtkScatteredIsopointFilter
from scenes import Scene, actor_of, check, color_by, polydata, psnr, torus_mesh, torus_splats
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


def layered(values, isovalue):
    """The share of a sphere's pixels that show more than its two layers, of samples with noise."""
    positions = np.random.default_rng(1).uniform(-1.2, 1.2, (200_000, 3))
    samples = polydata(positions, f=values(np.linalg.norm(positions, axis=1)))
    samples.GetPointData().SetActiveScalars("f")
    contour = vtkScatteredIsopointFilter()
    contour.SetInputData(samples)
    contour.SetValue(0, isovalue)
    contour.Update()
    actor = actor_of(contour.GetOutput())
    actor.GetProperty().SetOpacity(0.5)
    actor.GetProperty().LightingOff()
    scene = Scene(actor)
    peel(scene)
    scene.renderer.SetBackground(0, 0, 0)
    low_view(scene)
    image = scene.image()[..., 0]
    return np.mean(image[image > 0] > 200)  # two layers are 191


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
    noise = 5e-4 * np.random.default_rng(2).normal(size=200_000)
    for name, values, isovalue in (
        ("8 bits", lambda r: np.round(121.5 * r), 121.5),
        ("noise", lambda r: r + noise, 1.0),
    ):
        share = layered(values, isovalue)
        print(f"{name}: {100 * share:.2f} % show more than two layers, at most 2 %", flush=True)
        check(0 < share <= 0.02, "splats of noisy samples overlap")
    check(not failed, ", ".join(failed))


if __name__ == "__main__":
    main()
