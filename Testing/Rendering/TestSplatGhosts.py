# SPDX-License-Identifier: GPL-3.0-or-later
"""Ghosts are blended with the splats around, and neither seen nor selected elsewhere. Two actors
with half of the splats each and ghosts of the other half are what two ranks render."""

import numpy as np
from scenes import Scene, actor_of, check, color_by, differs, parts, polydata, psnr, torus_splats
from TestSplatSelection import POINTS, hit, selector_of
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes

UP = (0, 0, 1)


def mark(data, is_ghost):
    values = np.where(is_ghost, vtkDataSetAttributes.DUPLICATEPOINT, 0).astype(np.uint8)
    ghosts = numpy_to_vtk(values, deep=True)
    ghosts.SetName(vtkDataSetAttributes.GhostArrayName())
    data.GetPointData().AddArray(ghosts)


def halves(splats, color, reach):
    """For each of two actors: it, and the splats it has, ghosts behind its own."""
    points, normals, radii = splats
    result = []
    for side in (1, -1):
        own = np.flatnonzero(side * points[:, 0] >= 0)
        ghosts = np.flatnonzero((side * points[:, 0] < 0) & (side * points[:, 0] > -reach))
        chosen = np.concatenate([own, ghosts])
        data = polydata(points[chosen], normals[chosen], Radius=radii[chosen], c=color[chosen])
        mark(data, np.arange(len(chosen)) >= len(own))
        actor = actor_of(data)
        actor.GetMapper().BlendGhostsOn()
        color_by(actor, "c", -1.0, 1.0)
        result.append((actor, chosen, len(own)))
    return result


def halves_look_like_the_whole(splats, color):
    points, normals, radii = splats
    whole = actor_of(polydata(points, normals, Radius=radii, c=color))
    color_by(whole, "c", -1.0, 1.0)
    expected = Scene(whole).image()
    near = 6.0 * radii.max()
    with_ghosts = psnr(Scene(*(part[0] for part in halves(splats, color, near))).image(), expected)
    without = psnr(Scene(*(part[0] for part in halves(splats, color, 0.0))).image(), expected)
    print(f"two halves: {with_ghosts:.1f} dB, without ghosts {without:.1f} dB")
    check(with_ghosts > 60, "two halves with ghosts look like the whole")
    check(without < with_ghosts - 10, "two halves without ghosts do not")


def halves_are_selected_like_the_whole(splats, color):
    points, normals, radii = splats
    parts_of = halves(splats, color, 6.0 * radii.max())
    whole_scene = Scene(actor_of(polydata(points, normals, Radius=radii)))
    scene = Scene(*(part[0] for part in parts_of))
    random = np.random.default_rng(3)
    pixels = [(int(x), int(y)) for x, y in random.integers(0, 600, (300, 2))]
    pixels += [(int(x), int(y)) for x, y in zip(random.integers(295, 305, 200),
                                                random.integers(0, 600, 200))]  # the border
    found = []
    for each in (whole_scene, scene):
        each.window.Render()
        selector = selector_of(each, POINTS)
        selector.SetArea(0, 0, 599, 599)
        check(selector.CaptureBuffers(), "captured buffers")
        found.append([hit(selector.GenerateSelection(x, y, x, y)) for x, y in pixels])
    hits = different = 0
    for expected, other in zip(*found):
        check((expected is None) == (other is None), "something is hit in both or neither")
        if expected is None:
            continue
        hits += 1
        chosen, own = next(part[1:] for part in parts_of if part[0] is other[0])
        check(other[2] < own, "a ghost was selected")
        different += chosen[other[2]] != expected[2]
    print(f"{different} of {hits} splats selected differ")
    check(hits > 60, "enough splats")
    check(different == 0, "the same splats")


def ghosts_alone_are_not_seen():
    points, radii = [(-0.3, 0, 0), (0.3, 0, 0)], np.full(2, 0.4)
    data = polydata(points, [UP] * 2, Radius=radii)
    mark(data, np.array([False, True]))
    actor = actor_of(data)
    off = Scene(actor).image()
    own = Scene(actor_of(polydata(points[:1], [UP], Radius=radii[:1]))).image()
    check(np.array_equal(off, own), "ghosts are not drawn by default")
    actor.GetMapper().BlendGhostsOn()
    on = Scene(actor).image()
    # Seen as far as the blended splat reaches below the ghost, and not beyond.
    extent = differs(on).sum() / differs(own).sum()
    check(1.0 <= extent < 1.35, f"{extent} times the area")
    actor.GetMapper().SetStride(2)
    few = Scene(actor).image()
    check(differs(few).sum() <= 2.1 * differs(own).sum(), "no ghosts at a lower level of detail")


def main():
    splats = parts(torus_splats(200_000))
    color = np.sin(9.0 * splats[0][:, 0] + 5.0 * splats[0][:, 1])
    halves_look_like_the_whole(splats, color)
    halves_are_selected_like_the_whole(splats, color)
    ghosts_alone_are_not_seen()


main()
print("passed")
