# SPDX-License-Identifier: GPL-3.0-or-later
"""Times both filters with their defaults, at a first isovalue and then at another one.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 Testing/Benchmark/defaults.py

Prints a Markdown table of elapsed seconds, the least of some runs: of points and of triangles with
defaults, of points alone (NO_PROJECTION, no normals or splats), each at the first isovalue / at the
other one, and of what VTK offers: for scattered samples, resampling to a grid that yields as many
points and Flying Edges, once; for images Flying Edges on their grid. The clouds are random samples
of the distance to the center of a cube, without and with noise, and the images given.
"""

import argparse

import numpy as np
import speed
import volumes
from scatteredisopoints import vtkScatteredIsopointFilter, vtkScatteredIsosurfaceFilter
from vtkmodules.vtkCommonCore import vtkSMPTools
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D

OTHER_RADIUS = 69.9
NOISE = 0.05  # standard deviation, in mean rises of the values between neighbors


def sphere(count, noise):
    random = np.random.default_rng(1)
    positions = speed.uniform(count, random)
    spacing = speed.SIDE / count ** (1 / 3)
    values = np.linalg.norm(positions, axis=1) + noise * spacing * random.standard_normal(count)
    return volumes.cloud(positions, values.astype(np.float32))


def new_filter(kind, samples, has_all):
    isosurface = kind()
    isosurface.SetInputData(samples)
    isosurface.UseAllCoresOff()
    if not has_all:
        isosurface.SetProjection(kind.NO_PROJECTION)
        isosurface.ComputeNormalsOff()
        isosurface.ComputeSplatsOff()
    return isosurface


def seconds_of(kind, samples, isovalues, runs, has_all=True):
    """@returns the seconds at each isovalue, as text, and the number of points at the first"""
    taken, points = [], 0
    for _ in range(runs):
        isosurface = new_filter(kind, samples, has_all)
        run = []
        for isovalue in isovalues:
            isosurface.SetValue(0, isovalue)
            run.append(speed.measure(isosurface.Update)[0])
            points = points or isosurface.GetOutput().GetNumberOfPoints()
        taken.append(run)
    return " / ".join(f"{seconds:.2f}" for seconds in np.min(taken, axis=0)), points


def peer_of(samples, isovalue, points, threads):
    if samples.IsA("vtkImageData"):
        peer = vtkFlyingEdges3D()
        peer.SetInputData(samples)
        peer.SetValue(0, isovalue)
    else:
        peer = speed.Table("uniform", samples, threads).resampling(points)
    return f"{speed.measure(peer.Update)[0]:.2f}"


def add_row(name, samples, isovalues, options):
    defaults, points = seconds_of(vtkScatteredIsopointFilter, samples, isovalues, options.runs)
    triangles, vertices = seconds_of(vtkScatteredIsosurfaceFilter, samples, isovalues, options.runs)
    alone, _ = seconds_of(vtkScatteredIsopointFilter, samples, isovalues, options.runs, False)
    is_small = samples.IsA("vtkImageData") or samples.GetNumberOfPoints() <= speed.MOST_WITH_PEERS
    peer = peer_of(samples, isovalues[0], points, options.threads) if is_small else ""
    print(f"| {name} | {samples.GetNumberOfPoints() / 1e6:.1f} M | {points:,} | {defaults} |"
          f" {vertices:,} | {triangles} | {alone} | {peer} |", flush=True)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--threads", type=int, default=2, help="default: 2")
    parser.add_argument("--runs", type=int, default=2, help="default: 2")
    parser.add_argument("--samples", type=float, nargs="*", default=[1, 4, 16], metavar="MILLIONS",
                        help="of spheres; default: 1 4 16")
    parser.add_argument("--file", nargs=3, action="append", default=[],
                        metavar=("IMAGE.vti", "ISOVALUE", "OTHER"), help="also an image")
    options = parser.parse_args()
    vtkSMPTools.SetBackend("STDThread")
    vtkSMPTools.Initialize(options.threads)
    print("| cloud | samples | points | seconds | vertices of triangles | seconds |"
          " seconds of points alone | seconds of VTK |\n" + "|---" * 8 + "|")
    for millions in options.samples:
        for noise, name in (0, "sphere"), (NOISE, "sphere, noise of 5 %"):
            samples = sphere(int(1e6 * millions), noise)
            add_row(name, samples, (speed.RADIUS, OTHER_RADIUS), options)
    for path, *isovalues in options.file:
        add_row(path.rsplit("/", 1)[-1], volumes.read(path), [float(v) for v in isovalues], options)


if __name__ == "__main__":
    main()
