# SPDX-License-Identifier: GPL-3.0-or-later
"""The splat mapper with valid and invalid input of each kind."""

import numpy as np
from scatteredisopoints import vtkIsopointSplatMapper
from scenes import (
    BACKGROUND,
    Scene,
    actor_of,
    add_array,
    check,
    color_by,
    differs,
    polydata,
)
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkCommand, vtkLookupTable, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (
    vtkDataObject,
    vtkDataSetAttributes,
    vtkMultiBlockDataSet,
    vtkPlane,
    vtkPolyData,
)
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkHardwareSelector, vtkPolyDataMapper

UP = [0.0, -1.0, 1.0]  # towards the scene's camera


def events_of(mapper):
    events = []
    mapper.AddObserver("WarningEvent", lambda *_: events.append("warning"))
    mapper.AddObserver("ErrorEvent", lambda *_: events.append("error"))
    return events


def disk(center=(0, 0, 0), radius=0.3, normal=UP, **arrays):
    return polydata([center], [normal], Radius=np.array([float(radius)]), **arrays)


def area(image):
    return np.count_nonzero(differs(image))


def draws_nothing():
    empty = vtkPolyData()
    nan = float("nan")
    for name, data in (
        ("no points", empty),
        ("no blocks", vtkMultiBlockDataSet()),
        ("an empty block", blocks_of(empty)),
        ("a position that is not finite", disk((nan, 0, 0))),
        ("an infinite position", disk((float("inf"), 0, 0))),
        ("a radius of 0", disk(radius=0)),
        ("a negative radius", disk(radius=-1)),
        ("a radius that is not a number", disk(radius=nan)),
        ("an infinite radius", disk(radius=float("inf"))),
    ):
        scene = Scene(actor_of(data))
        check(area(scene.image()) == 0, name)


def an_infinite_point_changes_nothing():
    """Neither the radius that suits the points nor their precision."""
    points = np.array([1e9, -1e9, 1e9]) + [(-0.6, 0, 0), (0.6, 0, 0), (0, 0.3, 0.3)]
    images = []
    for extra in ([], [(np.inf, 0, 0)], [(0, -np.inf, np.nan)]):
        data = polydata([*points, *extra], [UP] * (3 + len(extra)))
        actor = actor_of(data)
        # Of an automatic radius that depends on the number of points.
        actor.GetMapper().GetPolygons().SetRadiusScale(np.sqrt((3 + len(extra)) / 3) * 0.2)
        scene = Scene(actor)
        scene.renderer.ResetCamera()
        images.append(scene.image())
    check(area(images[0]) > 1000, "splats are seen")
    for image in images[1:]:
        different = np.any(image != images[0], axis=2).sum()
        check(different < 0.01 * area(images[0]), f"{different} pixels differ")


def blocks_of(*blocks):
    data = vtkMultiBlockDataSet()
    for i, block in enumerate(blocks):
        data.SetBlock(i, block)
    return data


def leaves_out_only_what_cannot_be_drawn():
    good = Scene(actor_of(disk())).image()
    points = [(0, 0, 0), (np.nan, 0, 0), (0.2, 0, 0), (np.inf, 0, 0)]
    mixed = polydata(points, [UP] * 4, Radius=np.array([0.3, 0.3, -1.0, 0.3]))
    check(np.array_equal(Scene(actor_of(mixed)).image(), good), "one good splat of four")
    ghosts = vtkUnsignedCharArray()
    ghosts.SetName(vtkDataSetAttributes.GhostArrayName())
    for value in (0, vtkDataSetAttributes.HIDDENPOINT, vtkDataSetAttributes.DUPLICATEPOINT):
        ghosts.InsertNextValue(value)
    marked = polydata([(0, 0, 0), (0.5, 0, 0), (-0.5, 0, 0)], [UP] * 3, Radius=np.full(3, 0.3))
    marked.GetPointData().AddArray(ghosts)
    check(np.array_equal(Scene(actor_of(marked)).image(), good), "ghost points")


def has_the_given_size():
    scene = Scene(actor_of(disk(radius=0.5)))
    scene.camera.ParallelProjectionOn()
    scene.camera.SetParallelScale(1.0)
    expected = 2 * np.sqrt(2) * 150**2  # of an octagon
    check(abs(area(scene.image()) / expected - 1) < 0.02, "an octagon of 300 pixels")
    polygons = scene.renderer.GetActors().GetLastActor().GetMapper().GetPolygons()
    polygons.SetRadiusScale(0.5)
    check(abs(area(scene.image()) / expected - 0.25) < 0.01, "half its radius")
    polygons.SetRadiusScale(1.0)
    polygons.SetRadiusArrayName("nothing")
    polygons.SetRadius(0.25)
    check(abs(area(scene.image()) / expected - 0.25) < 0.01, "a constant radius")
    polygons.SetRadius(0.0)
    polygons.SetRadiusArrayName(None)
    check(area(scene.image()) > 0, "an automatic radius")


def colors_of_every_kind():
    points, normals = [(-0.6, 0, 0), (0.6, 0, 0)], [UP] * 2
    data = polydata(
        points,
        normals,
        Radius=np.full(2, 0.5),
        value=np.array([0.0, 1.0]),
        rgb=np.array([[255, 0, 0], [0, 255, 0]], dtype=np.uint8),
    )
    add_to_cells = numpy_to_vtk(np.array([1.0, 0.0]), deep=True)
    add_to_cells.SetName("of cells")
    data.GetCellData().AddArray(add_to_cells)
    of_field = numpy_to_vtk(np.array([1.0]), deep=True)
    of_field.SetName("of field")
    data.GetFieldData().AddArray(of_field)
    table = vtkLookupTable()
    table.SetNumberOfTableValues(2)
    table.SetTableValue(0, 1, 0, 0, 1)
    table.SetTableValue(1, 0, 1, 0, 1)
    red, green = [255, 0, 0], [0, 255, 0]

    def seen(prepare):
        actor = actor_of(data)
        actor.GetProperty().LightingOff()
        mapper = actor.GetMapper()
        mapper.SetLookupTable(table)
        mapper.ScalarVisibilityOn()
        prepare(mapper)
        image = Scene(actor).image()
        return [image[300, x].tolist() for x in (190, 410)]

    def points_by(name):
        def prepare(mapper):
            mapper.SetScalarModeToUsePointFieldData()
            mapper.SelectColorArray(name)

        return prepare

    def color_map(mapper):
        points_by("value")(mapper)
        mapper.InterpolateScalarsBeforeMappingOn()

    def direct(mapper):
        points_by("rgb")(mapper)
        mapper.SetColorModeToDirectScalars()

    def cells(mapper):
        mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectColorArray("of cells")

    def field(mapper):
        mapper.SetScalarModeToUseFieldData()
        mapper.SelectColorArray("of field")
        mapper.SetFieldDataTupleId(0)

    check(seen(points_by("value")) == [red, green], "values of points")
    check(seen(color_map) == [red, green], "a color map")
    check(seen(direct) == [red, green], "colors of points")
    check(seen(cells) == [green, red], "values of vertex cells")
    check(seen(field) == [green, green], "a value of the field data")
    check(seen(points_by("nothing")) == [[255] * 3] * 2, "no such array")

    actor = actor_of(data)
    actor.GetProperty().LightingOff()
    points_by("value")(actor.GetMapper())
    actor.GetMapper().SetLookupTable(table)
    actor.GetMapper().ScalarVisibilityOn()
    scene = Scene(actor)
    scene.image()
    table.SetTableValue(0, 0, 0, 1, 1)
    check(scene.image()[300, 190].tolist() == [0, 0, 255], "a changed color table")


def blocks_with_and_without_the_array():
    left = disk((-0.6, 0, 0), 0.5, value=np.array([1.0]))
    right = disk((0.6, 0, 0), 0.5)
    for interpolates in (False, True):
        actor = actor_of(blocks_of(left, None, right))
        color_by(actor, "value", 0, 1)
        table = vtkLookupTable()
        table.SetNumberOfTableValues(1)
        table.SetTableValue(0, 1, 0, 0, 1)
        actor.GetMapper().SetLookupTable(table)
        actor.GetMapper().SetInterpolateScalarsBeforeMapping(interpolates)
        actor.GetProperty().LightingOff()
        actor.GetProperty().SetColor(0, 0, 1)
        image = Scene(actor).image()
        check(image[300, 190].tolist() == [255, 0, 0], "the block with the array")
        check(image[300, 410].tolist() == [0, 0, 255], "the block without it")


def follows_changes():
    source = vtkSphereSource()
    source.SetThetaResolution(100)
    source.SetPhiResolution(100)
    mapper = vtkIsopointSplatMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.GetPolygons().SetRadius(0.05)
    actor = vtkActor()
    actor.SetMapper(mapper)
    scene = Scene(actor)
    small = area(scene.image())
    source.SetRadius(0.7)
    check(area(scene.image()) > 1.5 * small, "a changed input")
    scene.window.SetSize(300, 500)
    check(scene.image().shape[:2] == (500, 300), "a changed window")
    actor.VisibilityOff()
    check(area(scene.image()) == 0, "hidden")
    actor.VisibilityOn()
    mapper.SetInputDataObject(blocks_of(source.GetOutput()))
    check(area(scene.image()) > 0, "composite input instead")
    mapper.SetInputDataObject(source.GetOutput())
    check(area(scene.image()) > 0, "and back")


def normals_of_any_length():
    reference = Scene(actor_of(disk())).image()
    for length in (1e-30, 1e-3, 1e3, 1e30):
        data = disk()
        add_array(data, "Normals", length * np.array([UP]), normals=True)
        check(np.array_equal(Scene(actor_of(data)).image(), reference), f"length {length}")


def the_near_plane_cuts():
    """Splats before the near plane hide nothing behind it."""
    random = np.random.default_rng(2)
    points = random.normal(size=(20_000, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    data = polydata(points, points, Radius=np.full(20_000, 0.05))
    scene = Scene(actor_of(data))
    scene.camera.SetPosition(0, 0, 3)
    scene.camera.SetViewUp(0, 1, 0)
    scene.camera.SetClippingRange(0.1, 10)
    whole = area(scene.image())
    scene.camera.SetClippingRange(2.05, 10)  # 5 hundredths of the sphere are before it
    cut = area(scene.image())
    check(cut > 0.999 * whole, f"its other side is seen through the hole: {cut} of {whole}")


def does_not_disturb_other_actors():
    """What is drawn after splats looks as without them where they are not."""
    ball = vtkSphereSource()
    ball.SetCenter(0, 0, 0)
    ball.SetRadius(0.4)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(ball.GetOutputPort())
    other = vtkActor()
    other.SetMapper(mapper)
    alone = Scene(other).image()
    splats = actor_of(disk((1.2, 0, 0), 0.1))
    for order in ((splats, other), (other, splats)):
        image = Scene(*order).image()
        same = np.all(image == alone, axis=2)
        check(np.count_nonzero(~same) < 2000 and not same.all(), "only the splat differs")


def defaults_and_ranges():
    mapper = vtkIsopointSplatMapper()
    polygons = mapper.GetPolygons()
    check(polygons.GetRadiusArrayName() == "Radius", "RadiusArrayName")
    for name, default in (("Radius", 0.0), ("RadiusScale", 1.0)):
        get, set_to = getattr(polygons, "Get" + name), getattr(polygons, "Set" + name)
        check(get() == default, "default of " + name)
        set_to(-5)
        check(get() == 0.0, "least " + name)
        set_to(2.0)
    polygons.SetRadiusArrayName("size")
    other = vtkIsopointSplatMapper()
    other.ShallowCopy(mapper)
    copied = other.GetPolygons()
    check(copied.GetRadius() == 2.0 and copied.GetRadiusScale() == 2.0, "ShallowCopy")
    check(copied.GetRadiusArrayName() == "size", "ShallowCopy of names")
    check("RadiusScale" in str(mapper), "PrintSelf")


def bounds():
    """Of the triangles, without what is not finite."""

    def are(expected):
        return np.allclose(mapper.GetBounds(), expected, atol=0.03)

    mapper = vtkIsopointSplatMapper()
    high = [0.0, 0.0, 1.0]
    mapper.SetInputDataObject(
        blocks_of(disk((-1, 0, 0), normal=high), None, disk((2, 3, 4), normal=high))
    )
    check(are([-1.3, 2.3, -0.3, 3.3, 0, 4]), "bounds of blocks")
    mapper.GetPolygons().SetRadiusScale(2.0)
    check(are([-1.6, 2.6, -0.6, 3.6, 0, 4]), "bounds of larger splats")
    mapper.GetPolygons().SetRadiusScale(1.0)
    for bad in (np.nan, np.inf, -np.inf):
        points = [(-1, 0, 1), (bad, 7, 7), (1, 2, 3), (8, bad, 8), (9, 9, bad)]
        data = polydata(points, [high] * 5, Radius=np.ones(5))
        mapper.SetInputDataObject(data)
        check(are([-2, 2, -1, 3, 1, 3]), f"bounds beside {bad}")
        data.GetPoints().SetPoint(1, 4, 4, 4)
        data.GetPoints().Modified()
        check(are([-2, 5, -1, 5, 1, 4]), f"changed points beside {bad}")
        mapper.SetInputDataObject(disk((bad, 0, 0)))
        low, high_x = mapper.GetBounds()[:2]
        check(low > high_x, f"no bounds of {bad} alone")
    mapper.SetInputDataObject(vtkPolyData())
    low, high_x = mapper.GetBounds()[:2]
    check(low > high_x, "no bounds without points")


if __name__ == "__main__":
    for test in (
        defaults_and_ranges,
        bounds,
        draws_nothing,
        leaves_out_only_what_cannot_be_drawn,
        an_infinite_point_changes_nothing,
        has_the_given_size,
        colors_of_every_kind,
        blocks_with_and_without_the_array,
        follows_changes,
        normals_of_any_length,
        the_near_plane_cuts,
        does_not_disturb_other_actors,
    ):
        print(test.__name__, flush=True)
        test()
