#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume and area of bodies of samples alone, beside the true ones: prints the table of docs/triangles.md.

With --file FILE ARRAY ISOVALUE (VTK's XML formats), time and angles with and without caps instead; with --particles
FILE, time and closedness beside pysplashsurf, which it needs, with trimesh and scipy; with --droplets the volume of
small bodies beside that of their particles.
"""
import argparse
import time

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import common
from scatteredisopoints import body, contour

OPTIONS = {"triangles": True, "compute_normals": False}


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


def droplets():
    """Balls of particles on a jittered lattice of spacing 1, so that each particle has the volume 1."""
    print("| particles | volume over theirs |\n|---|---|")
    for radius in (10, 5, 3, 2, 1.65):
        balls = []
        for seed in range(20):
            random = np.random.default_rng(seed)
            positions = lattice(25, 12.0) + random.uniform(0, 1, 3)
            positions += random.uniform(-.25, .25, positions.shape)
            balls.append(positions[np.linalg.norm(positions, axis=1) < radius])
        share = np.mean([body(ball).volume / len(ball) for ball in balls])
        print(f"| {np.mean([len(ball) for ball in balls]):.0f} | {share:.2f} |")


def seconds(work):
    begin = time.process_time()
    work()
    return time.process_time() - begin


def elapsed(work):
    begin = time.perf_counter()
    result = work()
    return time.perf_counter() - begin, result


def least_angles(points, triangles):
    """In degrees."""
    corners = points[triangles].astype(float)
    sides = np.roll(corners, -1, 1) - corners
    return np.min([np.degrees(np.arctan2(np.linalg.norm(np.cross(sides[:, i], -sides[:, i - 1]), axis=1),
                                         np.einsum("ij,ij->i", sides[:, i], -sides[:, i - 1]))) for i in range(3)], 0)


def with_caps(data, array, isovalue):
    exact = {**OPTIONS, "regularize": False, "projection": None}
    for name, options in (("default", OPTIONS), ("exact", exact)):
        runs = [[seconds(lambda: contour(data, array, isovalue, capping=capping, **options))
                 for capping in (False, True)] for _ in range(5)]
        without, capped = np.median(runs, axis=0)
        print(f"{name}: {without:.2f} s without caps, {capped:.2f} s with caps, ratio {capped / without:.2f}")
    surface, closed = (contour(data, array, isovalue, capping=capping, **OPTIONS) for capping in (False, True))
    isosurface = closed.triangles[closed.cell_arrays["IsCap"] == 0]
    angles = [np.percentile(least_angles(*mesh), 5) if len(mesh[1]) else np.nan
              for mesh in ((surface.points, surface.triangles), (closed.points, isosurface))]
    print(f"least angle, 5th percentile: {angles[0]:.1f} degrees without caps, {angles[1]:.1f} with caps")


def beside_splashsurf(positions):
    import pysplashsurf
    import trimesh
    from scipy.spatial import cKDTree
    radius = float(np.median(cKDTree(positions).query(positions, 2)[0][:, 1]) / 2)
    parameters = dict(particle_radius=radius, smoothing_length=2.0, cube_size=0.5, iso_surface_threshold=0.6)
    smoothing = dict(mesh_cleanup=True, mesh_smoothing_weights=True, mesh_smoothing_iters=25)

    def theirs(**options):
        mesh = pysplashsurf.reconstruction_pipeline(positions.astype(np.float32), **parameters, **options)[0].mesh
        return np.asarray(mesh.vertices), np.asarray(mesh.triangles)

    def ours():
        surface = body(positions)
        return surface.points, surface.triangles

    print("| | elapsed s | triangles | volume | closed | results of 5 runs |\n|---|---|---|---|---|---|")
    for name, work in (("body()", ours), ("splashsurf", theirs), ("splashsurf, smoothed", lambda: theirs(**smoothing))):
        runs = [elapsed(work) for _ in range(5)]
        points, triangles = runs[-1][1]
        mesh = trimesh.Trimesh(points, triangles, process=False)
        count = len({result[0].tobytes() for _, result in runs})
        is_closed = mesh.is_watertight and mesh.is_winding_consistent
        print(f"| {name} | {np.median([run[0] for run in runs]):.2f} | {len(triangles)} | {mesh.volume:.4g} |"
              f" {is_closed} | {count} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--file", nargs=3, metavar=("FILE", "ARRAY", "ISOVALUE"))
    parser.add_argument("--particles", metavar="FILE")
    parser.add_argument("--droplets", action="store_true")
    arguments = parser.parse_args()
    if arguments.droplets:
        droplets()
        return
    if arguments.file:
        with_caps(common.read(arguments.file[0]), arguments.file[1], float(arguments.file[2]))
        return
    if arguments.particles:
        beside_splashsurf(vtk_to_numpy(common.read(arguments.particles).GetPoints().GetData()))
        return
    print("| samples | count | true volume, area | volume, area | triangles |\n|---|---|---|---|---|")
    for name, positions, volume, area in clouds():
        surface = body(positions, output_points_precision="DOUBLE_PRECISION")
        true = f"{volume:.2f}" + (f", {area:.2f}" if area else "")
        print(f"| {name} | {len(positions)} | {true} | {surface.volume:.3f}, {surface.area:.2f} |"
              f" {len(surface.triangles)} |")


if __name__ == "__main__":
    main()
