# SPDX-License-Identifier: GPL-3.0-or-later
"""A pick finds the splat that is seen: the surface is divided among the points nearest to it."""

import numpy as np
from scenes import (
    Scene, actor_of, add_array, array, cells_of, check, configured, halves, positions_of, torus_field, torus_splats)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkSelectionNode
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkHardwareSelector, vtkPolyDataMapper

POINTS = vtkDataObject.FIELD_ASSOCIATION_POINTS
CELLS = vtkDataObject.FIELD_ASSOCIATION_CELLS


def hit_torus(renderer, x, y):
    """Where the ray of a pixel enters the torus; None where it passes by."""
    ends = []
    for depth in (0, 1):
        renderer.SetDisplayPoint(x + 0.5, y + 0.5, depth)
        renderer.DisplayToWorld()
        end = np.array(renderer.GetWorldPoint())
        ends.append(end[:3] / end[3])
    length = np.linalg.norm(ends[1] - ends[0])
    t = 0.0
    while t < length:
        p = ends[0] + t / length * (ends[1] - ends[0])
        distance = -torus_field(p[None])[0]
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
    return (properties.Get(vtkSelectionNode.PROP()), properties.Get(vtkSelectionNode.COMPOSITE_INDEX()),
            vtk_to_numpy(node.GetSelectionList())[0])


def selector_of(scene, field, *area):
    return configured(vtkHardwareSelector(), Renderer=scene.renderer, FieldAssociation=field, Area=area)


def pick(scene, field, x, y):
    return hit(selector_of(scene, field, *2 * (int(x), int(y))).Select())


def pick_randomly(name, data, field, isopoints, to_global):
    """Picks 100 times. to_global(block, id) is the number of the isopoint with an id in the data."""
    # Points without a radius are hidden by others.
    points = np.where(array(isopoints, "Radius")[:, None] > 1e-6, positions_of(isopoints), np.inf)
    actor = actor_of(data)
    scene = Scene(actor)
    scene.camera.Zoom(1.6)
    scene.window.Render()
    selector = selector_of(scene, field, 0, 0, 599, 599)
    check(selector.CaptureBuffers(), "captured buffers")
    random = np.random.default_rng(5)
    wrong = overlapped = picks = 0
    while picks < 100:
        x, y = (int(i) for i in random.integers(0, 600, 2))
        surface = hit_torus(scene.renderer, x, y)
        if surface is None:
            continue
        picks += 1
        found = hit(selector.GenerateSelection(x, y, x, y))
        if picks <= 3:
            check(found == pick(scene, field, x, y), "one pixel or all of them")
            check(selector.CaptureBuffers(), "captured buffers")
        check(found is not None and found[0] is actor, f"{name}: the torus is picked at {x}, {y}")
        distance = np.linalg.norm(points - surface, axis=1)
        # Cells are cut in tangent planes, at the size of a pixel. Where corners do not meet, cells
        # overlap: 0.2 % of the picture.
        excess = distance[to_global(*found[1:])] - 0.004
        wrong += excess > 1.4 * distance.min()
        overlapped += excess > 1.1 * distance.min()
    print(f"{name}: {wrong} of {picks} wrong, {overlapped} where splats overlap")
    check(wrong == 0 and overlapped <= 1, name)


def reversed_vertices(data):
    """The same points, their vertex cells in the opposite order."""
    result = data.NewInstance()
    result.ShallowCopy(data)
    result.GetCellData().Initialize()
    for name in ("SplatAxis", "SplatPolygon"):
        add_array(result, name, array(data, name, cells=True)[::-1], cells=True)
    result.SetVerts(cells_of(np.arange(data.GetNumberOfPoints())[::-1, None]))
    return result


def hidden_behind_another_actor(data):
    """A pick finds the front object: another actor before the splats, or splats before it."""
    source = configured(vtkSphereSource(), Center=(0, -1.4, 0.4), Radius=0.1)
    ball = configured(vtkActor(), Mapper=configured(vtkPolyDataMapper(), InputConnection=source.GetOutputPort()))
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
    last = data.GetNumberOfPoints() - 1
    blocks, (left, right) = halves(data)
    ids = {1: left, 3: right}  # flat indices; 2 is the empty block
    for name, shown, field, to_global in (
            ("points", data, POINTS, lambda block, i: i), ("cells", data, CELLS, lambda block, i: i),
            ("cells in another order", reversed_vertices(data), CELLS, lambda block, i: last - i),
            ("points of blocks", blocks, POINTS, lambda block, i: ids[block][i]),
            ("cells of blocks", blocks, CELLS, lambda block, i: ids[block][i])):
        pick_randomly(name, shown, field, data, to_global)
    hidden_behind_another_actor(data)


main()
