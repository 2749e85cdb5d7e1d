#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume and area of bodies of samples with one value, beside the true ones: prints the table of docs/triangles.md.

With --file FILE ARRAY ISOVALUE (VTK's XML formats), the time with and without caps instead.
"""
import argparse
import time

import numpy as np

import common
from scatteredisopoints import contour

EXACT = {"triangles": True, "regularize": False, "projection": None, "compute_normals": False}


def lattice(count, half=1.0):
    axis = np.linspace(-half, half, count)
    return np.stack(np.meshgrid(axis, axis, axis), -1).reshape(-1, 3)


def clouds():
    """Name, positions, and true volume and area."""
    random = np.random.default_rng(1)
    cube = random.uniform(-1, 1, (30000, 3))
    x, y, z = cube.T
    radius = np.linalg.norm(cube, axis=1)
    yield "cube", cube[:20000], 8, 24
    bore = (radius < 1) & (np.hypot(x, y) > .4)
    yield "ball with a bore", cube[bore], 4 / 3 * np.pi * .84**1.5, 4 * np.pi * .84**.5 * 1.4
    corners = lattice(25)
    yield "L of a lattice", corners[(corners[:, 0] <= .1) | (corners[:, 1] <= .1)], 6.319, None
    yield "L", cube[(x <= .1) | (y <= .1)], 6.38, 22.38
    yield "two boxes", cube[:20000][np.abs(x[:20000]) > .2], 6.4, 28.8
    ring = random.uniform(-1, 1, (60000, 3))
    inside = np.hypot(np.hypot(ring[:, 0], ring[:, 1]) - .65, ring[:, 2]) < .3
    yield "torus", ring[inside], 2 * np.pi**2 * .65 * .09, 4 * np.pi**2 * .65 * .3
    ball = cube[radius < 1]
    both = np.concatenate([ball[:8000], ball[8000:] * .5 + [1.8, 0, 0]])
    yield "balls of two densities", both, 4 / 3 * np.pi * 1.125, 4 * np.pi * 1.25
    block = lattice(40, .975)
    drilled = block[np.hypot(block[:, 0], block[:, 1]) > .4]
    yield "lattice with a bore", drilled, 1.95**3 - np.pi * .16 * 1.95, None
    along, around, out = (axis.ravel() for axis in np.meshgrid(
        np.linspace(0, 4, 80), np.linspace(0, 2 * np.pi, 24, endpoint=False), np.linspace(.5, 1, 6)))
    pipe = np.stack([along, out * np.cos(around), out * np.sin(around)], 1)
    yield "pipe of 24 rows around", pipe, 48 * np.sin(np.pi / 12) * .75, None


def measures(surface):
    a, b, c = (surface.points[surface.triangles[:, corner]] for corner in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6, np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


def seconds(work):
    begin = time.process_time()
    work()
    return time.process_time() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--file", nargs=3, metavar=("FILE", "ARRAY", "ISOVALUE"))
    arguments = parser.parse_args()
    if arguments.file:
        data, array, isovalue = common.read(arguments.file[0]), arguments.file[1], float(arguments.file[2])
        runs = [[seconds(lambda: contour(data, array, isovalue, capping=capping, **EXACT))
                 for capping in (False, True)] for _ in range(5)]
        without, with_caps = np.median(runs, axis=0)
        print(f"{without:.2f} s without caps, {with_caps:.2f} s with caps, ratio {with_caps / without:.2f}")
        return
    print("| samples | count | true volume, area | volume, area | triangles |\n|---|---|---|---|---|")
    for name, positions, volume, area in clouds():
        surface = contour(positions, np.ones(len(positions)), .5, capping=True,
                          output_points_precision="DOUBLE_PRECISION", **EXACT)
        found = measures(surface)
        true = f"{volume:.2f}" + (f", {area:.2f}" if area else "")
        print(f"| {name} | {len(positions)} | {true} | {found[0]:.3f}, {found[1]:.2f} | {len(surface.triangles)} |")


if __name__ == "__main__":
    main()
