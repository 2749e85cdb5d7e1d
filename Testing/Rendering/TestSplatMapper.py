# SPDX-License-Identifier: GPL-3.0-or-later
"""The splat mapper with valid and invalid input of each kind."""

import ctypes
import gc

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
    parts,
    polydata,
    psnr,
    shrunk,
    torus_mesh,
    torus_splats,
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
        actor.GetMapper().SetRadiusScale(np.sqrt((3 + len(extra)) / 3) * 0.2)
        scene = Scene(actor)
        scene.renderer.ResetCamera()
        images.append(scene.image())
    check(area(images[0]) > 1000, "splats are seen")
    for image in images[1:]:
        different = np.any(image != images[0], axis=2).sum()
        check(different < 0.01 * area(images[0]), f"{different} pixels differ")


def clipping_planes_beyond_the_sixth():
    """One error for each change of the planes, not for each frame."""
    actor = actor_of(disk())
    mapper = actor.GetMapper()
    events = events_of(mapper)
    scene = Scene(actor)
    for expected in ([], ["error"], ["error", "error"]):
        count = 6 if not expected else 1
        for _ in range(count):
            plane = vtkPlane()
            plane.SetNormal(*UP)
            plane.SetOrigin(0, 1, -1)
            mapper.AddClippingPlane(plane)
        for _ in range(3):
            scene.camera.Azimuth(1)
            check(area(scene.image()) > 0, "the splat")
        check(events == expected, f"{mapper.GetClippingPlanes().GetNumberOfItems()}: {events}")


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
    expected = np.pi * 150**2
    check(abs(area(scene.image()) / expected - 1) < 0.02, "a disk of 300 pixels")
    mapper = scene.renderer.GetActors().GetLastActor().GetMapper()
    mapper.SetRadiusScale(0.5)
    check(abs(area(scene.image()) / expected - 0.25) < 0.01, "half its radius")
    mapper.SetRadiusScale(1.0)
    mapper.SetRadiusArrayName("nothing")
    mapper.SetRadius(0.25)
    check(abs(area(scene.image()) / expected - 0.25) < 0.01, "a constant radius")
    mapper.SetRadius(0.0)
    mapper.SetRadiusArrayName(None)
    check(area(scene.image()) > 0, "an automatic radius")


def draws_ellipses():
    side, up = np.array([1.0, 0, 0]), np.array([0, np.sqrt(0.5), np.sqrt(0.5)])
    data = disk(
        radius=0.6,
        SplatAxis1=np.array([0.6 * side]),
        SplatAxis2=np.array([0.15 * up]),
    )
    scene = Scene(actor_of(data))
    scene.camera.ParallelProjectionOn()
    scene.camera.SetParallelScale(1.0)
    image = scene.image()
    covered = differs(image)
    check(abs(covered.sum() / (np.pi * 180 * 45) - 1) < 0.02, "the area of an ellipse")
    check(abs(covered.any(0).sum() - 360) <= 2, "its width")
    check(abs(covered.any(1).sum() - 90) <= 2, "its height")
    mapper = scene.renderer.GetActors().GetLastActor().GetMapper()
    mapper.SetShapeToCircle()
    check(abs(area(scene.image()) / (np.pi * 180**2) - 1) < 0.02, "a circle instead")
    # Axes of no length, of one splat among many: a disk.
    data.GetPointData().GetArray("SplatAxis1").Fill(0.0)
    data.GetPointData().GetArray("SplatAxis1").Modified()
    mapper.SetShapeToEllipse()
    check(abs(area(scene.image()) / (np.pi * 180**2) - 1) < 0.02, "no axis")


def warns_once_without_normals():
    data = polydata([(0, 0, 0), (1, 0, 0)], None, Radius=np.full(2, 0.3))
    actor = actor_of(data)
    events = events_of(actor.GetMapper())
    messages = []

    def keep(_object, _event, message):
        messages.append(message)

    keep.CallDataType = "string0"
    actor.GetMapper().AddObserver("WarningEvent", keep)
    scene = Scene(actor)
    check(area(scene.image()) > 0, "splats without normals")
    data.Modified()
    scene.image()
    check(events == ["warning"], f"one warning, not {events}")
    check("Compute Normals in ParaView" in messages[0], "the filter's checkbox is named")
    zero = Scene(actor_of(disk(normal=(0, 0, 0))))
    check(area(zero.image()) > 0, "a normal of no length faces the camera")


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
    mapper.SetRadius(0.05)
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


def one_mapper_in_two_windows():
    data = torus_splats(50_000)
    first, actor = Scene(actor_of(data)), actor_of(data)
    reference = first.image()
    one, other = Scene(actor), Scene(actor)
    for _ in range(2):
        check(np.array_equal(one.image(), reference), "the one window")
        check(np.array_equal(other.image(), reference), "the other")
    one.renderer.RemoveActor(actor)
    check(np.array_equal(other.image(), reference), "removed from the one")
    del one
    gc.collect()
    check(np.array_equal(other.image(), reference), "the one is gone")
    mapper = actor.GetMapper()
    del other, actor
    gc.collect()
    mapper.ReleaseGraphicsResources(None)
    del mapper
    gc.collect()
    check(np.array_equal(first.image(), reference), "the first window")


def a_mapper_that_outlives_its_window():
    """The window deletes its buffers: later, their handles may be those of another window."""
    source = vtkSphereSource()
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    ball = vtkActor()
    ball.SetMapper(mapper)
    other = Scene(ball)
    reference = other.image()
    for draws_again in (False, True):
        actor = actor_of(torus_splats(50_000))
        splats = actor.GetMapper()
        scene = Scene(actor)
        scene.image()
        actor.SetMapper(vtkPolyDataMapper())
        del scene, actor
        gc.collect()
        if draws_again:
            again = vtkActor()
            again.SetMapper(splats)
            other.renderer.AddActor(again)
            check(not np.array_equal(other.image(), reference), "drawn in the other window")
            other.renderer.RemoveActor(again)
            del again
        del splats
        gc.collect()
        ball.Modified()
        check(np.array_equal(other.image(), reference), "the other window's sphere")


def arrays_that_are_too_short():
    points = [(-0.6, 0, 0), (0.6, 0, 0)]
    whole = polydata(points, [UP] * 2)
    reference_actor = actor_of(whole)
    reference_actor.GetMapper().SetRadius(0.4)
    reference = Scene(reference_actor).image()
    for name in ("Radius", "value"):
        data = polydata(points, [UP] * 2, **{name: np.array([0.1])})
        actor = actor_of(data)
        actor.GetMapper().SetRadius(0.4)
        color_by(actor, "value", 0, 1)
        events = events_of(actor.GetMapper())
        scene = Scene(actor)
        check(np.array_equal(scene.image(), reference), "as without " + name)
        scene.image()
        check(events == ["warning"], f"one warning of {name}, not {events}")
    normals = polydata(points, None)
    add_array(normals, "Normals", np.array([[1.0, 0.0, 0.0]]), normals=True)
    check(area(Scene(actor_of(normals)).image()) > 0, "normals that are too few")


def colors_of_cells_that_are_no_vertices():
    source = vtkSphereSource()
    source.Update()
    data = source.GetOutput()
    values = numpy_to_vtk(np.arange(data.GetNumberOfCells(), dtype=float), deep=True)
    values.SetName("of cells")
    data.GetCellData().AddArray(values)
    plain = Scene(actor_of(data)).image()
    actor = actor_of(data)
    mapper = actor.GetMapper()
    mapper.ScalarVisibilityOn()
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("of cells")
    events = events_of(mapper)
    check(np.array_equal(Scene(actor).image(), plain), "the material's color")
    check(events == ["warning"], f"one warning, not {events}")


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


def the_far_plane_is_close():
    """Nothing is hidden because it blends with what would be beyond the far plane."""
    scene = Scene(actor_of(disk(radius=0.5)))
    scene.camera.SetClippingRange(1, 100)
    whole = area(scene.image())
    scene.camera.SetClippingRange(1, 1.01 * scene.camera.GetDistance())
    check(whole > 0 and area(scene.image()) == whole, "the same splat")


def flattened_by_a_transform():
    """The two sides of the surface do not blend, however near to each other they come."""
    splats, mesh = actor_of(torus_splats(300_000)), actor_of(torus_mesh(), splats=False)
    for scale in (1.0, 1e-2, 1e-4):
        images = []
        for actor in (splats, mesh):
            actor.SetScale(1, 1, scale)
            scene = Scene(actor)
            scene.camera.SetPosition(0, -2, 3)
            scene.renderer.ResetCameraClippingRange()
            images.append(scene.image())
        inside = shrunk(differs(images[1]))
        specks = np.count_nonzero(inside & (np.abs(images[0] - images[1]).max(2) > 60))
        print(f"  {specks} specks at a scale of {scale}")
        check(specks <= 3, "specks")


def fewer_splats_look_alike():
    data = torus_splats(300_000)
    actor = actor_of(data)
    scene = Scene(actor)
    all_splats = scene.image()
    for stride in (2, 8):
        actor.GetMapper().SetStride(stride)
        image = scene.image()
        inside = differs(all_splats)
        check(np.count_nonzero(~differs(image) & inside) < 0.01 * inside.sum(), "few holes")
        check(psnr(image, all_splats) > 24, f"stride {stride}")
        check(not np.array_equal(image, all_splats), f"stride {stride} is another picture")
    actor.GetMapper().SetStride(1)
    check(np.array_equal(scene.image(), all_splats), "all splats again")


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


def leaves_the_clear_depth():
    """A clear depth set by others is neither used nor changed, in rendering and in selection."""
    depth_clear_value = 0x0B73
    opengl = ctypes.CDLL("libGL.so.1")
    actor = actor_of(disk())
    scene = Scene(actor)
    expected = scene.image()
    state = scene.window.GetState()
    actor.GetMapper().AddObserver("StartEvent", lambda *_: state.vtkglClearDepth(0.25))

    def check_clear_depth(when):
        depth = ctypes.c_double()
        scene.window.MakeCurrent()
        opengl.glGetDoublev(depth_clear_value, ctypes.byref(depth))
        check(depth.value == 0.25, f"a clear depth of {depth.value} {when}")

    check(np.array_equal(scene.image(), expected), "the same picture")
    actor.GetMapper().SetRadiusScale(0.9)
    scene.window.Render()
    check_clear_depth("after drawing")
    selector = vtkHardwareSelector()
    selector.SetRenderer(scene.renderer)
    selector.SetFieldAssociation(vtkDataObject.FIELD_ASSOCIATION_POINTS)
    selector.SetArea(300, 300, 300, 300)
    check(selector.Select().GetNumberOfNodes() == 1, "the splat is selected")
    check_clear_depth("after selecting")


def defaults_and_ranges():
    mapper = vtkIsopointSplatMapper()
    check(mapper.GetRadiusArrayName() == "Radius", "RadiusArrayName")
    check(mapper.GetSplatAxis1ArrayName() == "SplatAxis1", "SplatAxis1ArrayName")
    check(mapper.GetSplatAxis2ArrayName() == "SplatAxis2", "SplatAxis2ArrayName")
    check(mapper.GetSplatClipArrayName() == "SplatClip", "SplatClipArrayName")
    for name, default, low, high in (
        ("Radius", 0.0, 0.0, None),
        ("RadiusScale", 1.0, 0.0, None),
        ("BlendDepth", 1.0, 0.0, None),
        ("Shape", vtkIsopointSplatMapper.ELLIPSE, 0, 1),
        ("Stride", 1, 1, None),
        ("MaximumNumberOfLayers", 8, 1, 32),
    ):
        get, set_to = getattr(mapper, "Get" + name), getattr(mapper, "Set" + name)
        check(get() == default, "default of " + name)
        set_to(-5)
        check(get() == low, "least " + name)
        if high is not None:
            set_to(1000)
            check(get() == high, "greatest " + name)
    mapper.SetSplatClipArrayName("planes")
    other = vtkIsopointSplatMapper()
    other.ShallowCopy(mapper)
    check(other.GetMaximumNumberOfLayers() == 32 and other.GetStride() == 1, "ShallowCopy")
    check(other.GetSplatClipArrayName() == "planes", "ShallowCopy of names")
    check("BlendDepth" in str(mapper), "PrintSelf")


def bounds():
    mapper = vtkIsopointSplatMapper()
    mapper.SetInputDataObject(blocks_of(disk((-1, 0, 0)), None, disk((2, 3, 4))))
    check(np.allclose(mapper.GetBounds(), [-1.3, 2.3, -0.3, 3.3, -0.3, 4.3]), "bounds of blocks")
    mapper.SetRadiusScale(2.0)
    check(np.allclose(mapper.GetBounds()[:2], [-1.6, 2.6]), "bounds of larger splats")
    mapper.SetRadiusScale(1.0)
    for bad in (np.nan, np.inf, -np.inf):
        points = [(-1, 0, 1), (bad, 7, 7), (1, 2, 3), (8, bad, 8), (9, 9, bad)]
        data = polydata(points, [UP] * 5, Radius=np.ones(5))
        mapper.SetInputDataObject(data)
        check(list(mapper.GetBounds()) == [-2, 2, -1, 3, 0, 4], f"bounds beside {bad}")
        data.GetPoints().SetPoint(1, 4, 4, 4)
        data.GetPoints().Modified()
        check(list(mapper.GetBounds()) == [-2, 5, -1, 5, 0, 5], f"changed points beside {bad}")
        mapper.SetInputDataObject(disk((bad, 0, 0)))
        low, high = mapper.GetBounds()[:2]
        check(low > high, f"no bounds of {bad} alone")
    mapper.SetInputDataObject(vtkPolyData())
    low, high = mapper.GetBounds()[:2]
    check(low > high, "no bounds without points")


if __name__ == "__main__":
    for test in (
        defaults_and_ranges,
        bounds,
        draws_nothing,
        leaves_out_only_what_cannot_be_drawn,
        an_infinite_point_changes_nothing,
        clipping_planes_beyond_the_sixth,
        has_the_given_size,
        draws_ellipses,
        warns_once_without_normals,
        colors_of_every_kind,
        blocks_with_and_without_the_array,
        follows_changes,
        one_mapper_in_two_windows,
        a_mapper_that_outlives_its_window,
        arrays_that_are_too_short,
        colors_of_cells_that_are_no_vertices,
        normals_of_any_length,
        the_near_plane_cuts,
        the_far_plane_is_close,
        flattened_by_a_transform,
        fewer_splats_look_alike,
        does_not_disturb_other_actors,
        leaves_the_clear_depth,
    ):
        print(test.__name__, flush=True)
        test()
