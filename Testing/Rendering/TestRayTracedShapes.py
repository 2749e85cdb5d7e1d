# SPDX-License-Identifier: GPL-3.0-or-later
"""Ray-traced splats are those that the mapper draws: shapes, colors, blocks, transforms, radii,
opacities. Pictures without shadows are compared with the window's."""

import numpy as np
import scenes
from scenes import (
    Scene, actor_of, add_array, ball_field, blocks_of, check, color_by, configured, isopoints, polydata, positions_of,
    psnr, run, sphere_mesh, subset, torus_mesh, torus_splats)
from vtkmodules.vtkRenderingCore import vtkCompositeDataDisplayAttributes, vtkLight

SIZE = 300
VTK_SCALAR_MODE_USE_CELL_FIELD_DATA = 4
VTK_SCALAR_MODE_USE_FIELD_DATA = 5
TORUS = torus_splats(200_000)


def traced(scene, shadows=False):
    return scenes.traced(scene.renderer, SIZE, SIZE, SamplesPerPixel=9, Shadows=shadows)


def compare(name, actor, bar=33.0, peels=False):
    """Compares the traced picture with the window's, which has four times as many pixels, averaged."""
    scene = Scene(actor, size=2 * SIZE)
    if peels:
        scene.peel()
    picture, drawn = traced(scene), scene.image().reshape(SIZE, 2, SIZE, 2, 3).mean(axis=(1, 3))
    quality = psnr(picture, drawn)
    print(f"{name}: {quality:.1f} dB")
    check(quality >= bar, f"{name}: {quality:.1f} dB, below {bar}")
    return picture


def shapes():
    compare("splats", actor_of(TORUS))
    smaller = actor_of(TORUS)
    smaller.GetMapper().SetRadiusScale(0.5)
    compare("smaller splats", smaller, bar=28)
    body = isopoints(lambda p: 0.8 - np.abs(p * [1.0, 1.2, 2.4]).max(axis=1), -1.1, 1.1, 150_000, creases=True)
    compare("a body with edges", actor_of(body))
    normal = np.array([0.0, -1.0, 1.0]) / np.sqrt(2.0)
    compare("one octagon", actor_of(polydata([[0, 0, 0]], [normal], Radius=np.ones(1))), bar=35)


def small_bodies():
    """A ball with a radius of four spacings has coarse triangles, but no shadow on its own lit side."""
    spacing = 0.25
    ball = isopoints(ball_field, -1.5, 1.5, round((3 / spacing) ** 3))
    for name, actor in (("splats", actor_of(ball)), ("mesh", actor_of(sphere_mesh(24, 12, Radius=1.0), False))):
        scene = Scene(actor, size=SIZE)
        scene.renderer.AddLight(configured(vtkLight(), Position=(-8.0, 3.0, 2.0)))
        lit, shadowed = (traced(scene, shadows).max(axis=2) for shadows in (False, True))
        share = (lit - shadowed > 20).sum() / (lit > 20).sum()
        print(f"a small ball as {name}: {share:.2%} of it in its own shadow")
        check(share < 0.002, f"a small ball as {name} is in its own shadow")


def transforms():
    for scale in (0.7, 0.7, 0.7), (1.2, 0.6, 0.9):
        actor = configured(actor_of(TORUS), Scale=scale, Position=(0.1, 0.2, -0.1))
        actor.RotateX(25)
        actor.RotateY(-10)
        compare(f"scaled by {scale}", actor)


def colors():
    for name, data, splats in (("points", TORUS, True), ("a mesh", torus_mesh(200, 100), False)):
        actor = actor_of(data, splats)
        color_by(actor, "x", -1.4, 1.4)
        compare(f"colors of {name}", actor)
    compare("highlights", actor_of(TORUS, Specular=0.7, SpecularPower=30, Ambient=0.2, Color=(0.3, 0.6, 0.9)))


def colors_of_the_field():
    """Field data have a color for each cell, or one that all cells have."""
    data = torus_mesh(40, 20)
    add_array(data, "f", np.arange(data.GetNumberOfCells()) % 7 / 6.0, cells=True)
    data.GetFieldData().AddArray(data.GetCellData().GetArray("f"))

    def colored(mode, tuple_of_all=-1):
        actor = actor_of(data, splats=False, Lighting=False)
        mapper = configured(actor.GetMapper(), ScalarVisibility=True, ScalarMode=mode, FieldDataTupleId=tuple_of_all,
                            ScalarRange=(0, 1))
        mapper.SelectColorArray("f")
        return traced(Scene(actor, size=SIZE))

    of_cells = colored(VTK_SCALAR_MODE_USE_CELL_FIELD_DATA)
    check((colored(VTK_SCALAR_MODE_USE_FIELD_DATA) == of_cells).all(), "a color for each cell")
    seen = [len(np.unique(picture[:, SIZE // 2 - 20 : SIZE // 2 + 20].reshape(-1, 3), axis=0))
            for picture in (of_cells, colored(VTK_SCALAR_MODE_USE_FIELD_DATA, 6))]
    check(seen[1] < seen[0] / 3, f"one color for all cells: {seen[1]} of {seen[0]} colors")


def blocks():
    small = polydata(0.4 * positions_of(TORUS), scenes.array(TORUS, "Normals"), x=scenes.array(TORUS, "x"),
                     Radius=np.full(TORUS.GetNumberOfPoints(), 0.03))
    actor = actor_of(blocks_of(subset(TORUS, slice(None)), small))
    mapper = configured(actor.GetMapper(), CompositeDataDisplayAttributes=vtkCompositeDataDisplayAttributes())
    mapper.Update()
    mapper.SetBlockColor(2, (0.9, 0.2, 0.1))
    both = compare("blocks", actor)
    mapper.SetBlockVisibility(1, False)
    check(psnr(both, compare("a hidden block", actor)) < 25, "the block is hidden")


def opacities():
    for splats, data in ((True, TORUS), (False, torus_mesh(200, 100))):
        actor = actor_of(data, splats, Opacity=0.5)
        compare(f"translucent {'splats' if splats else 'mesh'}", actor, bar=30, peels=True)


run(shapes, small_bodies, transforms, colors, colors_of_the_field, blocks, opacities)
