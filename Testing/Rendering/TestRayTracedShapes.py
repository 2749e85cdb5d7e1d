# SPDX-License-Identifier: GPL-3.0-or-later
"""Ray-traced splats are those that the mapper draws: shapes, colors, blocks, transforms, radii,
opacities. Pictures without shadows are compared with the window's."""

import numpy as np
from scatteredisopoints import vtkIsopointRayTracer
from scenes import Scene, actor_of, add_array, as_array, check, color_by, isopoints, polydata, psnr
from scenes import torus_mesh, torus_splats
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkCompositeDataDisplayAttributes, vtkLight

SIZE = 300
VTK_SCALAR_MODE_USE_CELL_FIELD_DATA = 4
VTK_SCALAR_MODE_USE_FIELD_DATA = 5


def traced(scene, samples=9, shadows=False):
    tracer = vtkIsopointRayTracer()
    tracer.SetSamplesPerPixel(samples)
    tracer.SetShadows(shadows)
    image = vtkImageData()
    check(tracer.RenderToImage(scene.renderer, SIZE, SIZE, image), "there is a picture")
    return as_array(image)


def drawn(scene):
    """The window's picture in four times as many pixels, averaged."""
    scene.window.SetSize(2 * SIZE, 2 * SIZE)
    image = scene.image()
    return image.reshape(SIZE, 2, SIZE, 2, 3).mean(axis=(1, 3))


def compare(name, *actors, bar=33.0):
    scene = Scene(*actors, size=SIZE)
    picture = traced(scene)
    quality = psnr(picture, drawn(scene))
    print(f"{name}: {quality:.1f} dB")
    check(quality >= bar, f"{name}: {quality:.1f} dB, below {bar}")
    return picture


def body_field(p):
    """A box, which has sharp edges."""
    return 0.8 - np.abs(p * [1.0, 1.2, 2.4]).max(axis=1)


def shapes():
    torus = torus_splats(200_000)
    compare("splats", actor_of(torus))
    smaller = actor_of(torus)
    smaller.GetMapper().SetRadiusScale(0.5)
    compare("smaller splats", smaller, bar=28)
    body = isopoints(body_field, -1.1, 1.1, 150_000, creases=True)
    compare("a body with edges", actor_of(body))
    normal = np.array([0.0, -1.0, 1.0]) / np.sqrt(2.0)
    compare("one octagon", actor_of(polydata([[0, 0, 0]], [normal], Radius=np.ones(1))), bar=35)


def small_bodies():
    """A ball of four spacings casts no shadow on its own lit side, coarse as its triangles are."""
    spacing = 0.25
    ball = isopoints(lambda p: 1.0 - np.linalg.norm(p, axis=1), -1.5, 1.5, round((3 / spacing) ** 3))
    mesh = vtkSphereSource()
    mesh.SetRadius(1.0)
    mesh.SetThetaResolution(24)
    mesh.SetPhiResolution(12)
    mesh.Update()
    for name, actor in (("splats", actor_of(ball)), ("mesh", actor_of(mesh.GetOutput(), False))):
        scene = Scene(actor, size=SIZE)
        light = vtkLight()
        light.SetPosition(-8.0, 3.0, 2.0)
        scene.renderer.AddLight(light)
        lit = traced(scene).max(axis=2)
        darkened = (lit - traced(scene, shadows=True).max(axis=2) > 20).sum()
        share = darkened / (lit > 20).sum()
        print(f"a small ball as {name}: {share:.2%} of it in its own shadow")
        check(share < 0.002, f"a small ball as {name} is in its own shadow")


def transforms():
    torus = torus_splats(200_000)
    for name, scale in (("uniform", (0.7, 0.7, 0.7)), ("not uniform", (1.2, 0.6, 0.9))):
        actor = actor_of(torus)
        actor.SetScale(*scale)
        actor.RotateX(25)
        actor.RotateY(-10)
        actor.SetPosition(0.1, 0.2, -0.1)
        compare(f"{name} transform", actor)


def colors():
    torus = torus_splats(200_000)
    by_points = actor_of(torus)
    color_by(by_points, "x", -1.4, 1.4)
    compare("colors of points", by_points)
    mesh = actor_of(torus_mesh(200, 100), splats=False)
    color_by(mesh, "x", -1.4, 1.4)
    compare("colors of a mesh", mesh)
    shiny = actor_of(torus)
    shiny.GetProperty().SetSpecular(0.7)
    shiny.GetProperty().SetSpecularPower(30)
    shiny.GetProperty().SetAmbient(0.2)
    shiny.GetProperty().SetColor(0.3, 0.6, 0.9)
    compare("highlights", shiny)


def colors_of_the_field():
    """Field data have a color for each cell, or one that all cells have."""
    data = torus_mesh(40, 20)
    add_array(data, "f", np.arange(data.GetNumberOfCells()) % 7 / 6.0)
    values = data.GetPointData().GetArray("f")
    data.GetPointData().RemoveArray("f")
    data.GetFieldData().AddArray(values)
    data.GetCellData().AddArray(values)

    def colored(mode, tuple_of_all=-1):
        actor = actor_of(data, splats=False)
        actor.GetProperty().LightingOff()
        mapper = actor.GetMapper()
        mapper.ScalarVisibilityOn()
        mapper.SetScalarMode(mode)
        mapper.SelectColorArray("f")
        mapper.SetFieldDataTupleId(tuple_of_all)
        mapper.SetScalarRange(0, 1)
        return traced(Scene(actor, size=SIZE))

    of_cells = colored(VTK_SCALAR_MODE_USE_CELL_FIELD_DATA)
    of_field = colored(VTK_SCALAR_MODE_USE_FIELD_DATA)
    check((of_field == of_cells).all(), "a color for each cell")
    single = colored(VTK_SCALAR_MODE_USE_FIELD_DATA, 6)
    seen = [len(np.unique(picture[:, SIZE // 2 - 20 : SIZE // 2 + 20].reshape(-1, 3), axis=0))
            for picture in (of_cells, single)]
    check(seen[1] < seen[0] / 3, f"one color for all cells: {seen[1]} of {seen[0]} colors")


def blocks():
    torus = torus_splats(200_000)
    moved = torus.NewInstance()
    moved.DeepCopy(torus)
    points = moved.GetPoints()
    for i in range(0, points.GetNumberOfPoints()):
        x, y, z = points.GetPoint(i)
        points.SetPoint(i, 0.4 * x, 0.4 * y, 0.4 * z)
    moved.GetPointData().RemoveArray("Radius")
    moved.GetCellData().RemoveArray("SplatPolygon")
    add_array(moved, "Radius", np.full(points.GetNumberOfPoints(), 0.03))
    composite = vtkMultiBlockDataSet()
    composite.SetBlock(0, torus)
    composite.SetBlock(1, moved)
    actor = actor_of(composite)
    mapper = actor.GetMapper()
    mapper.SetCompositeDataDisplayAttributes(vtkCompositeDataDisplayAttributes())
    mapper.Update()
    mapper.SetBlockColor(2, (0.9, 0.2, 0.1))
    both = compare("blocks", actor)
    mapper.SetBlockVisibility(1, False)
    one = compare("a hidden block", actor)
    check(psnr(both, one) < 25, "the block is hidden")


def opacities():
    mesh = torus_mesh(200, 100)
    for splats, data in ((True, torus_splats(200_000)), (False, mesh)):
        actor = actor_of(data, splats)
        actor.GetProperty().SetOpacity(0.5)
        scene = Scene(actor, size=SIZE)
        scene.window.AlphaBitPlanesOn()
        scene.renderer.UseDepthPeelingOn()
        quality = psnr(traced(scene), drawn(scene))
        print(f"translucent {'splats' if splats else 'mesh'}: {quality:.1f} dB")
        check(quality > 30, "translucent")


shapes()
small_bodies()
transforms()
colors()
colors_of_the_field()
blocks()
opacities()
