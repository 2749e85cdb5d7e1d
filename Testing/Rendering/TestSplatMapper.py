# SPDX-License-Identifier: GPL-3.0-or-later
"""What the splat mapper adds to VTK's: the filter in front of it."""

import numpy as np
from scatteredisopoints import vtkIsopointSplatMapper
from scenes import Scene, check, differs, polydata
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor

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
        follows_changes,
    ):
        print(test.__name__, flush=True)
        test()
