# SPDX-License-Identifier: GPL-3.0-or-later
"""Times both filters with their defaults, at a first isovalue and then at another one.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 Benchmark/defaults.py

Prints a Markdown table of elapsed seconds, the least of some runs: of points and of triangles with
defaults, of points alone (NO_PROJECTION, no normals or splats), each at the first isovalue / at the
other one, and of what VTK offers: for scattered samples, resampling to a grid that yields as many
points and Flying Edges, once; for images Flying Edges on their grid. The clouds are random samples
of the distance to the center of a cube, without and with noise, and the images given.
"""

import common
import numpy as np
import speed
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D


def seconds_of(kind, samples, isovalues, runs, **properties):
    """@returns the number of points at the first isovalue, and the seconds at each, as text"""
    taken, points = [], 0
    for _ in range(runs):
        isosurface, run = common.configured(kind(), samples, UseAllCores=False, **properties), []
        for isovalue in isovalues:
            isosurface.SetValue(0, isovalue)
            run.append(common.measure(isosurface.Update)[0])
            points = points or isosurface.GetOutput().GetNumberOfPoints()
        taken.append(run)
    return points, " / ".join(f"{seconds:.2f}" for seconds in np.min(taken, axis=0))


def add_row(name, samples, isovalues, options):
    points, defaults = seconds_of(common.POINTS, samples, isovalues, options.runs)
    vertices, triangles = seconds_of(common.TRIANGLES, samples, isovalues, options.runs)
    _, alone = seconds_of(common.POINTS, samples, isovalues, options.runs, **common.alone())
    peer = ""
    if samples.IsA("vtkImageData"):
        peer = common.configured(vtkFlyingEdges3D(), samples, isovalues[0])
    elif samples.GetNumberOfPoints() <= speed.MOST_WITH_PEERS:
        peer = speed.Table("uniform", samples, options.threads).resampling(points)
    common.print_row(name, f"{samples.GetNumberOfPoints() / 1e6:.1f} M", f"{points:,}", defaults, f"{vertices:,}",
                     triangles, alone, f"{common.measure(peer.Update)[0]:.2f}" if peer else "")


parser = common.parser_of(__doc__)
common.add_numbers(parser, threads=2, runs=2, samples=[1.0, 4.0, 16.0])
common.add_files(parser, "IMAGE.vti", "ISOVALUE", "OTHER")
options = parser.parse_args()
common.set_threads(options.threads)
common.print_head("cloud", "samples", "points", "seconds", "vertices of triangles", "seconds",
                  "seconds of points alone", "seconds of VTK")
for millions in options.samples:
    for name, positions, values in common.spheres(millions):
        samples = common.cloud_of(positions, values.astype(np.float32))
        add_row(name, samples, (common.RADIUS, common.OTHER_RADIUS), options)
for path, *isovalues in options.file:
    add_row(common.name_of(path), common.read(path), [float(value) for value in isovalues], options)
