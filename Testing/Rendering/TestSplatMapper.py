# SPDX-License-Identifier: GPL-3.0-or-later
"""What the splat mapper adds to VTK's: the filter in front of it."""

import numpy as np
from scatteredisopoints import vtkIsopointSplatMapper
from scenes import Scene, check, differs, polydata
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

UP = [0.0, -1.0, 1.0]  # towards the scene's camera


def disk(center=(0, 0, 0), radius=0.3, normal=UP, **arrays):
    return polydata([center], [normal], Radius=np.array([float(radius)]), **arrays)


def area(image):
    return np.count_nonzero(differs(image))


def blocks_of(*blocks):
    data = vtkMultiBlockDataSet()
    for i, block in enumerate(blocks):
        data.SetBlock(i, block)
    return data


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


def defaults_and_ranges():
    mapper = vtkIsopointSplatMapper()
    check(mapper.GetRadiusArrayName() == "Radius", "RadiusArrayName")
    for name, default in (("Radius", 0.0), ("RadiusScale", 1.0)):
        get, set_to = getattr(mapper, "Get" + name), getattr(mapper, "Set" + name)
        check(get() == default, "default of " + name)
        set_to(-5)
        check(get() == 0.0, "least " + name)
        set_to(2.0)
    mapper.SetRadiusArrayName("size")
    check("RadiusScale" in str(mapper), "PrintSelf")


def shallow_copies():
    """A copy draws the same picture of the same polygons, and has shapes of its own."""
    source = vtkSphereSource()
    source.SetThetaResolution(30)
    source.SetPhiResolution(30)
    mapper = vtkIsopointSplatMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.SetRadiusArrayName("size")
    mapper.SetRadius(0.05)
    mapper.SetRadiusScale(2.0)
    mapper.SetScalarVisibility(False)
    copied = vtkIsopointSplatMapper()
    copied.ShallowCopy(mapper)
    check(copied.GetRadius() == 0.05 and copied.GetRadiusScale() == 2.0, "numbers of a copy")
    check(copied.GetRadiusArrayName() == "size", "names of a copy")
    check(not copied.GetScalarVisibility(), "what VTK's mapper copies")

    def drawn(by):
        actor = vtkActor()
        actor.SetMapper(by)
        return Scene(actor).image(), by.GetInputDataObject(0, 0).GetNumberOfElements(1)

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
    plain = vtkPolyDataMapper()
    plain.SetInputConnection(source.GetOutputPort())
    copied.ShallowCopy(plain)
    check(drawn(copied)[1] > source.GetOutput().GetNumberOfCells(), "splats of another mapper's input")


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
    mapper.SetRadiusScale(2.0)
    check(are([-1.6, 2.6, -0.6, 3.6, 0, 4]), "bounds of larger splats")
    mapper.SetRadiusScale(1.0)
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
        shallow_copies,
        bounds,
        follows_changes,
    ):
        print(test.__name__, flush=True)
        test()
