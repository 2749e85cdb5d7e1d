# SPDX-License-Identifier: GPL-3.0-or-later
"""A pick finds the splat that is seen: the surface is divided among the points nearest to it."""

import numpy as np
from scenes import RING, TUBE, Scene, actor_of, add_array, check, parts, subset, torus_splats
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray,
    vtkDataObject,
    vtkMultiBlockDataSet,
    vtkSelectionNode,
)
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkHardwareSelector, vtkPolyDataMapper

POINTS = vtkDataObject.FIELD_ASSOCIATION_POINTS
CELLS = vtkDataObject.FIELD_ASSOCIATION_CELLS


def ray(renderer, x, y):
    ends = []
    for depth in (0, 1):
        renderer.SetDisplayPoint(x + 0.5, y + 0.5, depth)
        renderer.DisplayToWorld()
        end = np.array(renderer.GetWorldPoint())
        ends.append(end[:3] / end[3])
    length = np.linalg.norm(ends[1] - ends[0])
    return ends[0], (ends[1] - ends[0]) / length, length


def hit_torus(start, direction, length):
    """Where the ray enters the torus; None where it passes by."""
    t = 0.0
    while t < length:
        p = start + t * direction
        distance = np.hypot(np.hypot(p[0], p[1]) - RING, p[2]) - TUBE
        if distance < 1e-7:
            return p
        t += distance
    return None


def hit(selection):
    """The actor, block and id of a selection at one pixel; None where there is nothing."""
    if selection is None or selection.GetNumberOfNodes() == 0:
        return None
    check(selection.GetNumberOfNodes() == 1, "one node a pixel")
    node = selection.GetNode(0)
    properties = node.GetProperties()
    return (
        properties.Get(vtkSelectionNode.PROP()),
        properties.Get(vtkSelectionNode.COMPOSITE_INDEX()),
        vtk_to_numpy(node.GetSelectionList())[0],
    )


def selector_of(scene, field):
    selector = vtkHardwareSelector()
    selector.SetRenderer(scene.renderer)
    selector.SetFieldAssociation(field)
    return selector


def pick(scene, field, x, y):
    selector = selector_of(scene, field)
    selector.SetArea(int(x), int(y), int(x), int(y))
    return hit(selector.Select())


def pick_randomly(name, data, field, splats, to_global):
    """100 picks; ids of data are given to to_global(block, id), which numbers the splats."""
    points, _, radii = splats
    points = np.where(radii[:, None] > 1e-6, points, np.inf)  # others stand for hidden points
    actor = actor_of(data)
    scene = Scene(actor)
    scene.camera.Zoom(1.6)
    scene.window.Render()
    selector = selector_of(scene, field)
    selector.SetArea(0, 0, 599, 599)
    check(selector.CaptureBuffers(), "captured buffers")
    random = np.random.default_rng(5)
    wrong = overlapped = picks = 0
    while picks < 100:
        x, y = (int(i) for i in random.integers(0, 600, 2))
        start, direction, length = ray(scene.renderer, x, y)
        surface = hit_torus(start, direction, length)
        if surface is None:
            continue
        picks += 1
        found = hit(selector.GenerateSelection(x, y, x, y))
        if picks <= 3:
            check(found == pick(scene, field, x, y), "one pixel or all of them")
            check(selector.CaptureBuffers(), "captured buffers")
        check(found is not None and found[0] is actor, f"{name}: the torus is picked at {x}, {y}")
        i = to_global(found[1], found[2])
        distance = np.linalg.norm(points - surface, axis=1)
        # Cells are cut in tangent planes, at the size of a pixel. Where corners do not meet, cells
        # overlap: 0.2 % of the picture.
        wrong += distance[i] > 1.4 * distance.min() + 0.004
        overlapped += distance[i] > 1.1 * distance.min() + 0.004
    print(f"{name}: {wrong} of {picks} wrong, {overlapped} where splats overlap")
    check(wrong == 0 and overlapped <= 1, name)


def reversed_vertices(data):
    """The same points, their vertex cells in the opposite order."""
    result = data.NewInstance()
    result.ShallowCopy(data)
    result.GetCellData().Initialize()
    for name in ("SplatAxis", "SplatPolygon"):
        shapes = vtk_to_numpy(data.GetCellData().GetArray(name))
        add_array(result, name, shapes[::-1], cells=True)
    cells = vtkCellArray()
    for i in reversed(range(data.GetNumberOfPoints())):
        cells.InsertNextCell(1, [i])
    result.SetVerts(cells)
    return result


def two_blocks(data):
    points, _, _ = parts(data)
    blocks = vtkMultiBlockDataSet()
    left = points[:, 0] < 0
    for i, chosen in enumerate((left, ~left)):
        blocks.SetBlock(2 * i, subset(data, chosen))
    # Flat indices: 1, an empty block, 3.
    ids = {1: np.flatnonzero(left), 3: np.flatnonzero(~left)}
    return blocks, lambda block, i: ids[block][i]


def hidden_behind_another_actor(data):
    """What stands before the splats is picked instead of them, and the other way round."""
    source = vtkSphereSource()
    source.SetCenter(0, -1.4, 0.4)
    source.SetRadius(0.1)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    ball = vtkActor()
    ball.SetMapper(mapper)
    torus = actor_of(data)
    scene = Scene(torus, ball)
    scene.window.Render()
    scene.renderer.SetWorldPoint(0, -1.4, 0.4, 1)
    scene.renderer.WorldToDisplay()
    x, y, _ = scene.renderer.GetDisplayPoint()
    check(pick(scene, CELLS, x, y)[0] is ball, "the ball before the torus")
    source.SetCenter(0, -1, 0)
    scene.window.Render()
    check(pick(scene, CELLS, x, y)[0] is torus, "the torus around the ball")


def main():
    data = torus_splats(300_000)
    splats = parts(data)
    last = data.GetNumberOfPoints() - 1
    pick_randomly("points", data, POINTS, splats, lambda block, i: i)
    pick_randomly("cells", data, CELLS, splats, lambda block, i: i)
    pick_randomly(
        "cells in another order", reversed_vertices(data), CELLS, splats, lambda block, i: last - i
    )
    blocks, to_global = two_blocks(data)
    pick_randomly("points of blocks", blocks, POINTS, splats, to_global)
    pick_randomly("cells of blocks", blocks, CELLS, splats, to_global)
    hidden_behind_another_actor(data)


if __name__ == "__main__":
    main()
