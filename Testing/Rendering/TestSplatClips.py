# SPDX-License-Identifier: GPL-3.0-or-later
"""Splats with clipping planes: which part of them is rendered, and how sharp edges of bodies are."""

import numpy as np
from scenes import (
    Scene,
    actor_of,
    add_array,
    check,
    color_by,
    differs,
    isopoints,
    polydata,
    psnr,
    shrunk,
)
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPlane
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource
from vtkmodules.vtkRenderingCore import vtkHardwareSelector

RADIUS = 0.5
UP = np.array([0.0, -1.0, 1.0]) / np.sqrt(2.0)  # towards the scene's camera
RIGHT, ABOVE = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 1.0]) / np.sqrt(2.0)


def plane_through(point, normal, center=(0.0, 0.0, 0.0)):
    """The plane of a splat at a center that keeps the side that the normal points to."""
    return np.append(normal, np.dot(normal, np.subtract(center, point)))


def disk(plane, center=(0.0, 0.0, 0.0), kind=np.float64, **arrays):
    return polydata(
        [center], [UP], Radius=np.array([RADIUS]), SplatClip=np.array([plane], kind), **arrays
    )


def parallel_scene(actor, center=(0.0, 0.0, 0.0)):
    """From above, 150 pixels a unit of length."""
    scene = Scene(actor)
    scene.camera.ParallelProjectionOn()
    scene.camera.SetParallelScale(1.0 / 0.5)
    scene.camera.SetFocalPoint(*center)
    scene.camera.SetPosition(*(np.asarray(center) + 4.0 * UP))
    scene.renderer.ResetCameraClippingRange()
    return scene


def segment(height):
    """Share of a disk before a chord this far behind its center, in radii."""
    return (np.pi - np.arccos(height) + height * np.sqrt(1.0 - height**2)) / np.pi


def ends_at_its_plane():
    whole = np.pi * (RADIUS * 150) ** 2
    for distance in (-0.3, 0.0, 0.2, 0.45):
        for direction in (RIGHT, -RIGHT, ABOVE, 0.6 * RIGHT - 0.8 * ABOVE):
            plane = 3.0 * plane_through(-distance * direction, direction + 0.7 * UP)
            covered = differs(parallel_scene(actor_of(disk(plane))).image())
            expected = segment(distance / RADIUS)
            check(abs(covered.sum() / whole - expected) < 0.01, f"{distance} towards {direction}")
            y, x = np.argwhere(covered).mean(0) - 299.5
            side = x * np.dot(direction, RIGHT) + y * np.dot(direction, ABOVE)
            check(side > 0, "the side of the plane's normal")
    beyond = parallel_scene(actor_of(disk(plane_through(0.6 * RIGHT, RIGHT))))
    check(not differs(beyond.image()).any(), "nothing of a splat beyond its plane")


def nearly_same(one, other, message):
    """Pixels of an edge may differ, one in ten of them."""
    different = np.any(one != other, axis=2).sum()
    check(different <= 15, f"{message}: {different} pixels differ")


def follows_the_actor():
    """As clipping planes of the mapper do, which are the world's."""
    normal = 0.6 * RIGHT - 0.8 * ABOVE + 0.3 * UP
    center = np.array([0.2, 0.3, -0.1])
    point = center - 0.1 * RIGHT
    plane = plane_through(point, normal, center)
    half_axes = dict(
        SplatAxis1=np.array([RADIUS * RIGHT]), SplatAxis2=np.array([0.3 * RADIUS * ABOVE])
    )

    def place(actor):
        actor.SetScale(1.3, -0.6, 2.0)
        actor.RotateX(25)
        actor.RotateZ(-70)
        actor.SetPosition(0.2, -0.1, 0.3)

    for arrays in ({}, half_axes):
        for moves in (False, True):
            for scale in (0.3, 1.0, 2.0):
                own = actor_of(disk(plane, center, **arrays))
                world = actor_of(disk(np.zeros(4), center, **arrays))
                for actor in (own, world):
                    actor.GetMapper().SetRadiusScale(scale)
                    if moves:
                        place(actor)
                to_model = vtkMatrix4x4()
                vtkMatrix4x4.Invert(world.GetMatrix(), to_model)
                to_model.Transpose()
                moved = np.array(to_model.MultiplyPoint(plane_through(point, normal)))
                length = np.linalg.norm(moved[:3])
                clipping = vtkPlane()
                clipping.SetNormal(moved[:3] / length)
                clipping.SetOrigin(-moved[3] / length**2 * moved[:3])
                world.GetMapper().AddClippingPlane(clipping)
                images = [Scene(actor).image() for actor in (own, world)]
                check(differs(images[0]).any(), "something is drawn")
                nearly_same(*images, f"moved {moves}, scale {scale}")


def faces_the_camera_without_normals():
    plane = plane_through((0.0, 0.0, 0.0), RIGHT)
    data = polydata([(0, 0, 0)], None, Radius=np.array([RADIUS]), SplatClip=np.array([plane]))
    half = differs(parallel_scene(actor_of(data)).image()).sum()
    check(abs(half / (0.5 * np.pi * (RADIUS * 150) ** 2) - 1) < 0.02, "half a disk")


def whole_where_no_plane_is():
    half = plane_through((0.0, 0.0, 0.0), RIGHT)
    plain = polydata([(0, 0, 0)], [UP], Radius=np.array([RADIUS]))
    whole = parallel_scene(actor_of(plain)).image()

    def seen(data, name="SplatClip"):
        actor = actor_of(data)
        actor.GetMapper().SetSplatClipArrayName(name)
        return parallel_scene(actor).image()

    check(not np.array_equal(seen(disk(half)), whole), "the plane clips")
    check(not np.array_equal(seen(disk(half, kind=np.float32)), whole), "in single precision, too")
    for name in ("", None, "nothing"):
        check(np.array_equal(seen(disk(half), name), whole), f"an array called {name}")
    for what, plane in (
        ("zeros", np.zeros(4)),
        ("no normal", np.array([0.0, 0.0, 0.0, -1.0])),
        ("not a number", np.full(4, np.nan)),
        ("infinitely far behind the center", np.append(RIGHT, -np.inf)),
        ("infinitely far before the center", np.append(RIGHT, np.inf)),
        ("farther than single precision reaches", np.append(RIGHT, 1e300)),
        ("farther than the splat reaches", np.append(RIGHT, 1.01 * RADIUS)),
    ):
        check(np.array_equal(seen(disk(plane)), whole), what)
    for what, values in (
        ("three components", np.array([half[:3]])),
        ("six components", np.array([np.append(half, (1.0, 1.0))])),
        ("integers", np.array([half], np.int32)),
    ):
        add_array(plain, "SplatClip", values)
        check(np.array_equal(seen(plain), whole), what)


def ends_there_whichever_way_the_surface_turns():
    """A fifth component does not change a single splat, whatever its value; without it, it is -1."""
    half = plane_through((0.0, 0.0, 0.0), RIGHT)
    expected = parallel_scene(actor_of(disk(half))).image()
    for turn in (1.0, 0.0, -1.0, 1e300, np.nan, -np.inf):
        image = parallel_scene(actor_of(disk(np.append(half, turn)))).image()
        check(np.array_equal(image, expected), f"turning to {turn}")


def mixes_clipped_and_whole_splats():
    """The splats of no plane are as large as without the array."""
    points = [(-0.6, 0, 0), (0.6, 0, 0)]
    planes = np.array([np.zeros(4), plane_through(points[1], ABOVE, points[1])])
    data = polydata(points, [UP] * 2, Radius=np.full(2, RADIUS), SplatClip=planes)
    covered = differs(parallel_scene(actor_of(data)).image())
    left, right = covered[:, :300].sum(), covered[:, 300:].sum()
    check(abs(left / (np.pi * (RADIUS * 150) ** 2) - 1) < 0.01, "the whole one")
    check(abs(right / left - 0.5) < 0.01, "the clipped one")


def far_from_the_origin():
    """Planes of both precisions are where they are near the origin."""
    near = parallel_scene(actor_of(disk(plane_through(-0.1 * RIGHT, RIGHT)))).image()
    center = np.array([1e8, 2e8, -1e8])
    plane = plane_through(center - 0.1 * RIGHT, RIGHT, center)
    for kind in (np.float64, np.float32):
        actor = actor_of(disk(plane, center, kind))
        image = parallel_scene(actor, center).image()
        nearly_same(image, near, f"{kind.__name__} at 1e8")


def selects_what_is_seen():
    """Of two splats at one place that end at one plane each is chosen on its own side."""
    points = np.array([-0.1 * RIGHT, 0.1 * RIGHT])
    planes = [plane_through((0, 0, 0), side, p) for side, p in zip((RIGHT, -RIGHT), points)]
    data = polydata(points, [UP] * 2, Radius=np.full(2, RADIUS), SplatClip=np.array(planes))
    scene = parallel_scene(actor_of(data))
    scene.window.Render()
    selector = vtkHardwareSelector()
    selector.SetRenderer(scene.renderer)
    selector.SetFieldAssociation(vtkDataObject.FIELD_ASSOCIATION_POINTS)
    for x, expected in ((310, 0), (290, 1), (330, 0), (270, 1)):
        selector.SetArea(x, 300, x, 300)
        node = selector.Select().GetNode(0)
        chosen = node.GetSelectionList().GetTuple1(0)
        check(chosen == expected, f"point {chosen} at {x}")


def far_from(corners, scene, pixels):
    """The pixels farther than some from where points are seen."""
    y, x = np.mgrid[:600, :600] + 0.5
    result = np.ones((600, 600), bool)
    for corner in corners:
        scene.renderer.SetWorldPoint(*corner, 1.0)
        scene.renderer.WorldToDisplay()
        place = scene.renderer.GetDisplayPoint()
        result &= np.hypot(x - place[0], y - place[1]) > pixels
    return result


def wedge(random, side, count=4000):
    """Two square faces that meet at the y axis at a right angle, red and green, with normals to one
    side of them or the other (-1); each splat near the edge ends at the other face."""
    y, away = random.uniform(-1, 1, count), random.uniform(0, 1, count)
    first = np.arange(count) % 2 == 0
    zero = np.zeros(count)
    points = np.where(
        first[:, None], np.column_stack([-away, y, zero]), np.column_stack([zero, y, -away])
    )
    normals = np.where(first[:, None], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0])
    planes = np.column_stack([-1.0 * first, zero, -1.0 * ~first, away, zero - side])
    radius = np.sqrt(12 * 4 / (np.pi * count))
    planes[away > 2 * radius] = 0.0
    return polydata(
        points,
        side * normals,
        Radius=np.full(count, radius),
        SplatClip=planes,
        face=np.where(first, 0.0, 1.0),
    )


def does_not_blend_across_an_edge(side):
    data = wedge(np.random.default_rng(5), side)
    actor = actor_of(data)
    color_by(actor, "face", 0, 1)
    table = vtkLookupTable()
    table.SetNumberOfTableValues(2)
    table.SetTableValue(0, 1, 0, 0, 1)
    table.SetTableValue(1, 0, 1, 0, 1)
    actor.GetMapper().SetLookupTable(table)
    actor.GetProperty().LightingOff()
    scene = Scene(actor)
    scene.renderer.SetBackground(0, 0, 1)
    # The second and the third hide the green face, the last sees both from inside.
    for position in ((3, 0, 4), (-3, 0.5, 3), (-3, 0, 0.6), (-3, 0.2, -2.5)):
        scene.camera.SetPosition(*position)
        scene.camera.SetFocalPoint(-0.4, 0, -0.4)
        scene.camera.SetViewUp(0, 1, 0)
        scene.renderer.ResetCameraClippingRange()
        mixed = []
        for name in ("", "SplatClip"):
            actor.GetMapper().SetSplatClipArrayName(name)
            colors = scene.image()
            along_edge = ~far_from([(0, y, 0) for y in np.linspace(-0.7, 0.7, 50)], scene, 40)
            mixed.append(np.count_nonzero(along_edge & (colors[..., :2].min(2) > 10)))
        print(f"  {position}, {side}: {mixed[0]} pixels of both colors, {mixed[1]} with planes")
        check(mixed[0] > 1000, "both colors without planes")
        check(mixed[1] <= 5, "one color each with planes")


def does_not_blend_across_an_edge_whichever_way_normals_point():
    for side in (1, -1):
        does_not_blend_across_an_edge(side)


CUBE = 12.0  # half a side, of samples with a spacing of 1


def cube(center):
    """The isopoints of a cube at a center."""
    low, high = np.subtract(center, 20.0), np.add(center, 20.0)
    return isopoints(lambda p: CUBE - np.abs(p - center).max(1), low, high, 64_000, creases=True)


def picture_around(center, data, name, clips="SplatClip"):
    actor = actor_of(data)
    actor.GetMapper().SetSplatClipArrayName(clips)
    scene = Scene(actor)
    scene.camera.SetFocalPoint(*center)
    scene.camera.SetPosition(*np.add(center, (46.0, -72.0, 42.0)))
    scene.camera.SetViewUp(0, 0, 1)
    scene.renderer.ResetCameraClippingRange()
    image = scene.image()
    scene.save(f"{name}.png")
    return image


def edges_far_from_the_origin():
    """A cube has the edges that it has near the origin, also where the spacing of the samples is
    less than the precision of the arrays at their coordinates."""
    center = np.array([1e8, 2e8, -1e8])
    near, far = cube(np.zeros(3)), cube(center)
    expected = picture_around(np.zeros(3), near, "cube_near")
    whole = picture_around(np.zeros(3), near, "cube_near_whole", clips="")
    image = picture_around(center, far, "cube_far")
    noise = [psnr(other, expected) for other in (whole, image)]
    print(f"  {noise[0]:.1f} dB, with planes {noise[1]:.1f} dB")
    check(noise[1] > noise[0] + 6.0, "as near the origin")


def edges_of_translated_points():
    """A filter that translates points leaves the array as it is."""
    points = cube(np.zeros(3))
    expected = picture_around(np.zeros(3), points, "cube_before")
    for shift in ((3.0, -2.0, 5.0), (4096.0, 1024.0, -8192.0)):
        transform = vtkTransform()
        transform.Translate(*shift)
        translation = vtkTransformPolyDataFilter()
        translation.SetInputData(points)
        translation.SetTransform(transform)
        translation.Update()
        image = picture_around(shift, translation.GetOutput(), "cube_translated")
        nearly_same(image, expected, f"translated by {shift}")


def edges_of_a_cube(side):
    """Against a mesh of the cube, from a field that is larger inside (1) or outside (-1): far
    better with planes than without, and no hole along edges."""
    points = isopoints(
        lambda p: side * (1 - np.abs(p).max(1)), [-1.7] * 3, [1.7] * 3, 500_000, creases=True
    )
    source = vtkCubeSource()
    for set_length in (source.SetXLength, source.SetYLength, source.SetZLength):
        set_length(2.0)
    source.Update()
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    for position in ((3.5, -5.5, 3.2), (6.2, -2.0, 0.6), (7.0, 6.0, 9.0)):

        def picture(actor, name):
            actor.GetProperty().SetAmbient(0.3)
            scene = Scene(actor)
            scene.renderer.SetBackground(0, 0, 1)
            scene.camera.SetPosition(*position)
            scene.camera.SetViewUp(0, 0, 1)
            scene.renderer.ResetCameraClippingRange()
            image = scene.image()
            scene.save(f"cube_{side}_{position[0]:g}_{name}.png")
            return image, scene

        mesh, scene = picture(actor_of(source.GetOutput(), splats=False), "mesh")
        clipped, _ = picture(actor_of(points), "clipped")
        whole_actor = actor_of(points)
        whole_actor.GetMapper().SetSplatClipArrayName("")
        whole, _ = picture(whole_actor, "whole")
        noise = [psnr(image, mesh) for image in (whole, clipped)]
        inside = shrunk(differs(mesh, (0, 0, 1))) & far_from(corners, scene, 25)
        holes = np.count_nonzero(inside & ~differs(clipped, (0, 0, 1)))
        print(f"  {position}, {side}: {noise[0]:.1f} dB", end=", ")
        print(f"with planes {noise[1]:.1f} dB; {holes} holes")
        check(noise[1] > noise[0] + 6.0, "nearer to the mesh with planes")
        check(holes == 0, "holes along the edges")


def edges_of_a_cube_whichever_way_normals_point():
    for side in (1, -1):
        edges_of_a_cube(side)


if __name__ == "__main__":
    for test in (
        ends_at_its_plane,
        follows_the_actor,
        faces_the_camera_without_normals,
        whole_where_no_plane_is,
        ends_there_whichever_way_the_surface_turns,
        mixes_clipped_and_whole_splats,
        far_from_the_origin,
        edges_far_from_the_origin,
        edges_of_translated_points,
        selects_what_is_seen,
        does_not_blend_across_an_edge_whichever_way_normals_point,
        edges_of_a_cube_whichever_way_normals_point,
    ):
        print(test.__name__, flush=True)
        test()
