# SPDX-License-Identifier: GPL-3.0-or-later
"""Visibilities and colors of the blocks of composite input."""

import numpy as np
from scenes import BACKGROUND, Scene, actor_of, check, color_by, differs, polydata
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkMultiPieceDataSet
from vtkmodules.vtkRenderingCore import vtkCompositeDataDisplayAttributes

UP = [0.0, -1.0, 1.0]  # towards the scene's camera
RED, GREEN, BLUE, WHITE = [255, 0, 0], [0, 255, 0], [0, 0, 255], [255] * 3
PLACES = (190, 300, 410)  # columns of the three splats


def disk(x):
    return polydata([(x, 0, 0)], [UP], Radius=np.array([0.25]), value=np.array([0.0]))


def nested():
    """(left), ((middle, none), right): the first block is a leaf, the second has blocks."""
    left, middle, right = disk(-0.6), disk(0.0), disk(0.6)
    pieces = vtkMultiPieceDataSet()
    pieces.SetNumberOfPieces(2)
    pieces.SetPiece(0, middle)
    inner, outer = vtkMultiBlockDataSet(), vtkMultiBlockDataSet()
    inner.SetBlock(0, pieces)
    inner.SetBlock(1, right)
    outer.SetBlock(0, left)
    outer.SetBlock(1, inner)
    return outer, inner, pieces, (left, middle, right)


def with_attributes(data):
    attributes = vtkCompositeDataDisplayAttributes()
    actor = actor_of(data)
    actor.GetProperty().LightingOff()
    actor.GetMapper().SetCompositeDataDisplayAttributes(attributes)
    return actor, attributes


def seen(scene):
    image = scene.image()
    check(set(differs(image)[300].nonzero()[0]) <= set(range(130, 470)), "nothing elsewhere")
    return [image[300, x].tolist() for x in PLACES]


def nothing():
    return [round(255 * value) for value in BACKGROUND]


def visibilities():
    outer, inner, pieces, (left, middle, right) = nested()
    actor, attributes = with_attributes(outer)
    mapper = actor.GetMapper()
    scene = Scene(actor)
    check(mapper.GetCompositeDataDisplayAttributes() is attributes, "the attributes")
    check(seen(scene) == [WHITE] * 3, "all blocks")
    attributes.SetBlockVisibility(left, False)
    check(seen(scene) == [nothing(), WHITE, WHITE], "a leaf hidden")
    check(list(mapper.GetBounds()[:2]) == [-0.25, 0.85], "bounds of what is visible")
    attributes.SetBlockVisibility(inner, False)
    check(seen(scene) == [nothing()] * 3, "a block of blocks hidden as well")
    low, high = mapper.GetBounds()[:2]
    check(low > high, "no bounds of nothing")
    attributes.SetBlockVisibility(pieces, True)
    check(seen(scene) == [nothing(), WHITE, nothing()], "an inner block has the last word")
    attributes.RemoveBlockVisibilities()
    attributes.SetBlockVisibility(outer, False)
    attributes.SetBlockVisibility(right, True)
    check(seen(scene) == [nothing(), nothing(), WHITE], "all but one")
    attributes.RemoveBlockVisibilities()
    check(seen(scene) == [WHITE] * 3, "all blocks again")
    attributes.SetBlockVisibility(left, False)
    mapper.SetCompositeDataDisplayAttributes(None)
    check(seen(scene) == [WHITE] * 3, "without attributes")


def colors():
    outer, inner, pieces, (left, middle, right) = nested()
    for scalars in ("none", "mapped", "a color map"):
        actor, attributes = with_attributes(outer)
        plain = WHITE
        if scalars != "none":
            color_by(actor, "value", 0, 1)
            actor.GetMapper().SetInterpolateScalarsBeforeMapping(scalars == "a color map")
            plain = RED
        scene = Scene(actor)
        check(seen(scene) == [plain] * 3, f"{scalars}: no colors")
        attributes.SetBlockColor(inner, [0, 0, 1])
        check(seen(scene) == [plain, BLUE, BLUE], f"{scalars}: a block of blocks")
        attributes.SetBlockColor(middle, [0, 1, 0])
        check(seen(scene) == [plain, GREEN, BLUE], f"{scalars}: a block in it")
        attributes.SetBlockColor(middle, [1, 1, 1])
        check(seen(scene) == [plain, WHITE, BLUE], f"{scalars}: another color")
        attributes.RemoveBlockColors()
        check(seen(scene) == [plain] * 3, f"{scalars}: no colors again")


if __name__ == "__main__":
    for test in (visibilities, colors):
        print(test.__name__, flush=True)
        test()
