# SPDX-License-Identifier: GPL-3.0-or-later
"""The splat mapper adds a filter to VTK's mapper: its properties, copies, bounds and updates."""

import numpy as np
from scatteredisopoints import vtkIsopointSplatMapper
from scenes import Scene, blocks_of, check, configured, differs, polydata, run
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

HIGH = [0.0, 0.0, 1.0]


def disk(center):
    return polydata([center], [HIGH], Radius=np.array([0.3]))


def area(image):
    return np.count_nonzero(differs(image))


def follows_changes():
    source = configured(vtkSphereSource(), ThetaResolution=100, PhiResolution=100)
    mapper = configured(vtkIsopointSplatMapper(), InputConnection=source.GetOutputPort(), Radius=0.05)
    actor = configured(vtkActor(), Mapper=mapper)
    scene = Scene(actor)
    small = area(scene.image())
    source.SetRadius(0.7)
    check(area(scene.image()) > 1.5 * small, "a changed input")
    scene.window.SetSize(300, 500)
    check(scene.image().shape[:2] == (500, 300), "a changed window")
    actor.VisibilityOff()
    check(area(scene.image()) == 0, "hidden")
    actor.VisibilityOn()
    for data in (blocks_of(source.GetOutput()), source.GetOutput()):
        mapper.SetInputDataObject(data)
        check(area(scene.image()) > 0, data.GetClassName())


def defaults_and_ranges():
    mapper = vtkIsopointSplatMapper()
    check(mapper.GetRadiusArrayName() == "Radius", "RadiusArrayName")
    for name, default in (("Radius", 0.0), ("RadiusScale", 1.0)):
        values = []
        for value in (None, -5, 2.0):
            configured(mapper, **({name: value} if value is not None else {}))
            values.append(getattr(mapper, "Get" + name)())
        check(values == [default, 0.0, 2.0], f"{name}: {values}")
    check("RadiusScale" in str(mapper), "PrintSelf")


def shallow_copies():
    """A copy draws the same picture of the same polygons, and has shapes of its own."""
    source = configured(vtkSphereSource(), ThetaResolution=30, PhiResolution=30)
    mapper = configured(vtkIsopointSplatMapper(), InputConnection=source.GetOutputPort(), RadiusArrayName="size",
                        Radius=0.05, RadiusScale=2.0, ScalarVisibility=False)
    copied = vtkIsopointSplatMapper()
    copied.ShallowCopy(mapper)
    for name in ("Radius", "RadiusScale", "RadiusArrayName", "ScalarVisibility"):
        values = [getattr(each, "Get" + name)() for each in (copied, mapper, vtkIsopointSplatMapper())]
        check(values[0] == values[1] != values[2], f"{name} of a copy: {values}")

    def drawn(by):
        return Scene(configured(vtkActor(), Mapper=by)).image(), by.GetInputDataObject(0, 0).GetNumberOfElements(1)

    original, polygons = drawn(mapper)
    copy, polygons_of_copy = drawn(copied)
    check(polygons_of_copy == polygons > 0, f"{polygons_of_copy} polygons of a copy for {polygons}")
    check(np.array_equal(copy, original), "the picture of a copy")
    copied.SetRadiusScale(1.0)
    check(area(drawn(copied)[0]) < area(original), "smaller splats of the copy")
    check(np.array_equal(drawn(mapper)[0], original), "the original stays as it was")
    mapper.ShallowCopy(mapper)
    check(np.array_equal(drawn(mapper)[0], original), "a copy of itself")
    copied.ShallowCopy(vtkIsopointSplatMapper())
    check(copied.GetInputDataObject(0, 0) is None, "a copy without input")
    copied.ShallowCopy(configured(vtkPolyDataMapper(), InputConnection=source.GetOutputPort()))
    check(drawn(copied)[1] > source.GetOutput().GetNumberOfCells(), "splats of another mapper's input")


def bounds():
    """Bounds are those of the triangles, without values that are not finite."""
    mapper = vtkIsopointSplatMapper()

    def expect(expected, what):
        check(np.allclose(mapper.GetBounds(), expected, atol=0.03), f"{what}: {mapper.GetBounds()}")

    mapper.SetInputDataObject(blocks_of(disk((-1, 0, 0)), None, disk((2, 3, 4))))
    expect([-1.3, 2.3, -0.3, 3.3, 0, 4], "blocks")
    mapper.SetRadiusScale(2.0)
    expect([-1.6, 2.6, -0.6, 3.6, 0, 4], "larger splats")
    mapper.SetRadiusScale(1.0)
    for bad in (np.nan, np.inf, -np.inf):
        points = [(-1, 0, 1), (bad, 7, 7), (1, 2, 3), (8, bad, 8), (9, 9, bad)]
        data = polydata(points, [HIGH] * 5, Radius=np.ones(5))
        mapper.SetInputDataObject(data)
        expect([-2, 2, -1, 3, 1, 3], f"beside {bad}")
        data.GetPoints().SetPoint(1, 4, 4, 4)
        data.GetPoints().Modified()
        expect([-2, 5, -1, 5, 1, 4], f"changed points beside {bad}")
    for data in (*(disk((bad, 0, 0)) for bad in (np.nan, np.inf, -np.inf)), vtkPolyData()):
        mapper.SetInputDataObject(data)
        low, high = mapper.GetBounds()[:2]
        check(low > high, "no bounds of nothing")


run(defaults_and_ranges, shallow_copies, bounds, follows_changes)
