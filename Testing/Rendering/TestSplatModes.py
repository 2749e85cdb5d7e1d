# SPDX-License-Identifier: GPL-3.0-or-later
"""Splats against a mesh of the same surface, rendered in the same process, in the ways to render that
depend on the normals, arrays, depths, order and places of their triangles; and the layers of translucent ones."""

import sys

import numpy as np
from scenes import (
    BOUNDS, Scene, actor_of, check, color_by, configured, differs, halves, isopoints, output_of, points_of,
    positions_of, psnr, sphere_mesh, torus_mesh, torus_splats)
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersSources import vtkCubeSource
from vtkmodules.vtkRenderingCore import vtkLight

LOOKING_AT_BOTH_SIDES = configured(vtkPlane(), Origin=(0, 0, 0.1), Normal=(0.5, 0.5, -1))


def input_of(actor):
    """The isopoints or the mesh."""
    mapper = actor.GetMapper()
    return (mapper.GetPolygons() if hasattr(mapper, "GetPolygons") else mapper).GetInputDataObject(0, 0)


def plain(scene, actor):
    pass


def colored(scene, actor):
    color_by(actor, "x", -1.4, 1.4)


def color_map(scene, actor):
    colored(scene, actor)
    actor.GetMapper().InterpolateScalarsBeforeMappingOn()


def light_kit(scene, actor):
    scene.renderer.AutomaticLightCreationOff()
    for position, intensity in (((5, 5, 9), 0.7), ((-5, 3, 0), 0.4), ((0, -9, -2), 0.5)):
        scene.renderer.AddLight(configured(vtkLight(), Position=position, Intensity=intensity))


def physically_based(scene, actor):
    light_kit(scene, actor)
    actor.GetProperty().SetInterpolationToPBR()
    configured(actor.GetProperty(), Metallic=0.4, Roughness=0.4, CoatStrength=0.3)


def ambient_occlusion(scene, actor):
    ground = output_of(vtkCubeSource(), Center=(0, 0, -0.45), XLength=3, YLength=3, ZLength=0.1)
    scene.renderer.AddActor(actor_of(ground, splats=False))
    configured(scene.renderer, UseSSAO=True, SSAORadius=0.5, SSAOBias=0.01, SSAOBlur=True)


def transformed(scene, actor):
    actor.SetScale(0.9, 0.6, 0.4)
    actor.RotateX(40)
    actor.SetPosition(0.1, 0.2, 0.3)


def clipped(scene, actor):
    actor.GetMapper().AddClippingPlane(LOOKING_AT_BOTH_SIDES)


def back_culled(scene, actor):
    clipped(scene, actor)
    actor.GetProperty().BackfaceCullingOn()


def composite(scene, actor):
    if hasattr(actor.GetMapper(), "GetPolygons"):
        actor.GetMapper().SetInputDataObject(halves(input_of(actor))[0])


def far_from_the_origin(scene, actor):
    """Neighboring floats there differ by 8, three times the torus's size."""
    data, offset = input_of(actor), 1e8
    moved = data.NewInstance()
    moved.DeepCopy(data)
    moved.SetPoints(points_of(positions_of(moved) + offset))
    configured(actor.GetMapper(), InputDataObject=moved, VBOShiftScaleMethod=1)
    configured(scene.camera, Position=(offset, offset - 3, offset + 3), FocalPoint=(offset, offset, offset))
    scene.renderer.ResetCamera(*(offset + bound for bound in BOUNDS))


def low_view(scene):
    """Rays meet the torus up to four times."""
    scene.camera.SetPosition(0, -4, 0.8)
    scene.renderer.ResetCameraClippingRange()


def without_depth_peeling(scene, actor):
    configured(actor.GetProperty(), Opacity=0.5, Color=(0.9, 0.6, 0.3))
    low_view(scene)


def with_depth_peeling(scene, actor):
    scene.peel(MaximumNumberOfPeels=16, OcclusionRatio=0)
    without_depth_peeling(scene, actor)


def around_a_translucent_ball(scene, actor):
    with_depth_peeling(scene, actor)
    ball = sphere_mesh(60, 60, Center=(1.0, 0.0, 0.0), Radius=0.25)
    scene.renderer.AddActor(actor_of(ball, splats=False, Color=(0.1, 0.3, 0.9), Opacity=0.4))


def translucent_colors(scene, actor):
    scene.peel(MaximumNumberOfPeels=16, OcclusionRatio=0)
    colored(scene, actor)
    table = configured(vtkLookupTable(), TableRange=(-1.4, 1.4), AlphaRange=(0.1, 0.9), NumberOfTableValues=1024)
    table.Build()
    actor.GetMapper().SetLookupTable(table)
    low_view(scene)


# The least ratio in decibels of each.
MODES = {
    plain: 48, colored: 48, color_map: 48, light_kit: 44, physically_based: 44, ambient_occlusion: 44, transformed: 44,
    clipped: 44, back_culled: 44, composite: 44, far_from_the_origin: 44}
TRANSLUCENT = {with_depth_peeling: 48, without_depth_peeling: 48, around_a_translucent_ball: 48, translucent_colors: 48}
SAME = {plain, composite, far_from_the_origin}  # the others must change the picture to be tested at all


def picture(data, splats, mode, samples):
    actor = actor_of(data, splats)
    scene = Scene(actor, samples=samples)
    mode(scene, actor)
    return scene.image(f"{mode.__name__}_{'splats' if splats else 'mesh'}_{samples}.png")


def share_of_more_layers(field):
    """The share of a body's pixels that show more than its two layers."""
    actor = actor_of(isopoints(field, [-1.2] * 3, [1.2] * 3, 200_000), Opacity=0.5, Lighting=False)
    scene = Scene(actor, background=(0, 0, 0))
    scene.peel(MaximumNumberOfPeels=16, OcclusionRatio=0)
    low_view(scene)
    gray = scene.image()[..., 0]
    return np.mean(gray[gray > 0] > 200)  # two layers are 191


def main(chosen):
    splats, mesh = torus_splats(), torus_mesh()
    check(abs(splats.GetNumberOfPoints() - 40_000) < 2_000, "about 40,000 isopoints")
    failed = []
    # Of a window as VTK makes it, and of one without multisampling.
    for samples, modes in ((8, MODES), (0, {**MODES, **TRANSLUCENT})):
        reference = picture(mesh, False, plain, samples)
        for mode in modes if not chosen else [mode for mode in modes if mode.__name__ in chosen]:
            name = f"{mode.__name__} with {samples} samples"
            truth, drawn = picture(mesh, False, mode, samples), picture(splats, True, mode, samples)
            ratio = psnr(truth, drawn)
            print(f"{name:40} {ratio:6.2f} dB, at least {modes[mode]}", flush=True)
            if not differs(truth).any() or (mode not in SAME and np.array_equal(truth, reference)):
                failed.append(name + " changes nothing")
            if not ratio >= modes[mode]:
                failed.append(name)
            if mode is with_depth_peeling:
                different = np.abs(drawn - truth).max(axis=-1) > 8
                share = different[(truth != truth[0, 0]).any(axis=-1)].mean()
                print(f"    {100 * share:.2f} % of the pixels differ, at most 0.5 %", flush=True)
                check(share <= 0.005, "splats overlap")
    noise = 5e-4 * np.random.default_rng(2).normal(size=200_000)
    for name, field in (("8 bits", lambda p: np.round(121.5 * np.linalg.norm(p, axis=1)) - 121.5),
                        ("noise", lambda p: np.linalg.norm(p, axis=1) - 1.0 + noise)):
        share = share_of_more_layers(field)
        print(f"{name}: {100 * share:.2f} % of the pixels show more than two layers, at most 2 %", flush=True)
        check(0 < share <= 0.02, "splats of noisy samples overlap")
    check(not failed, ", ".join(failed))


if __name__ == "__main__":
    main(sys.argv[1:])
