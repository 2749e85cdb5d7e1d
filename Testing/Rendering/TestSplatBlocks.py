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
    pieces = vtkMultiPieceDataSet()
    pieces.SetNumberOfPieces(2)
    pieces.SetPiece(0, disk(0.0))
    inner, outer = vtkMultiBlockDataSet(), vtkMultiBlockDataSet()
    inner.SetBlock(0, pieces)
    inner.SetBlock(1, disk(0.6))
    outer.SetBlock(0, disk(-0.6))
    outer.SetBlock(1, inner)
    return outer


# Flat indices of the blocks.
OUTER, LEFT, INNER, PIECES, MIDDLE, RIGHT = 0, 1, 2, 3, 4, 6


def with_attributes(data):
    actor = actor_of(data)
    actor.GetProperty().LightingOff()
    mapper = actor.GetMapper()
    mapper.SetCompositeDataDisplayAttributes(vtkCompositeDataDisplayAttributes())
    mapper.Update()
    return actor, mapper


def seen(scene):
    image = scene.image()
    check(set(differs(image)[300].nonzero()[0]) <= set(range(130, 470)), "nothing elsewhere")
    return [image[300, x].tolist() for x in PLACES]


def nothing():
    return [round(255 * value) for value in BACKGROUND]


def visibilities():
    actor, mapper = with_attributes(nested())
    scene = Scene(actor)
    check(seen(scene) == [WHITE] * 3, "all blocks")
    mapper.SetBlockVisibility(LEFT, False)
    check(seen(scene) == [nothing(), WHITE, WHITE], "a leaf hidden")
    mapper.SetBlockVisibility(INNER, False)
    check(seen(scene) == [nothing()] * 3, "a block of blocks hidden as well")
    mapper.SetBlockVisibility(PIECES, True)
    check(seen(scene) == [nothing(), WHITE, nothing()], "an inner block has the last word")
    mapper.RemoveBlockVisibilities()
    mapper.SetBlockVisibility(OUTER, False)
    mapper.SetBlockVisibility(RIGHT, True)
    check(seen(scene) == [nothing(), nothing(), WHITE], "all but one")
    mapper.RemoveBlockVisibilities()
    check(seen(scene) == [WHITE] * 3, "all blocks again")


def colors():
    for scalars in ("none", "mapped", "a color map"):
        actor, mapper = with_attributes(nested())
        plain = WHITE
        if scalars != "none":
            color_by(actor, "value", 0, 1)
            mapper.SetInterpolateScalarsBeforeMapping(scalars == "a color map")
            plain = RED
        scene = Scene(actor)
        check(seen(scene) == [plain] * 3, f"{scalars}: no colors")
        mapper.SetBlockColor(INNER, [0, 0, 1])
        check(seen(scene) == [plain, BLUE, BLUE], f"{scalars}: a block of blocks")
        mapper.SetBlockColor(MIDDLE, [0, 1, 0])
        check(seen(scene) == [plain, GREEN, BLUE], f"{scalars}: a block in it")
        mapper.RemoveBlockColors()
        check(seen(scene) == [plain] * 3, f"{scalars}: no colors again")


if __name__ == "__main__":
    for test in (visibilities, colors):
        print(test.__name__, flush=True)
        test()
