# SPDX-License-Identifier: GPL-3.0-or-later
"""Time and memory of both filters with their defaults, by the number of samples.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 Testing/Benchmark/cost.py

Prints a Markdown table of the distance to the center of a cube at random positions: for points and
for triangles their number, elapsed seconds and processor seconds, medians of some runs, at a first
isovalue; elapsed seconds at another isovalue; and the peak of memory in MB beyond the samples,
which take 16 bytes each.
"""

import argparse
import time

import defaults
import numpy as np
import speed
from scatteredisopoints import vtkScatteredIsopointFilter, vtkScatteredIsosurfaceFilter
from vtkmodules.vtkCommonCore import vtkSMPTools


def cost_of(kind, samples, runs):
    """@returns cells of the table"""
    rows = []
    for _ in range(runs):
        isosurface = defaults.new_filter(kind, samples, True)
        isosurface.SetValue(0, speed.RADIUS)
        processor = time.process_time()
        seconds, peak = speed.measure(isosurface.Update)
        processor = time.process_time() - processor
        output = isosurface.GetOutput()
        count = output.GetNumberOfPolys() or output.GetNumberOfPoints()
        isosurface.SetValue(0, defaults.OTHER_RADIUS)
        rows.append((seconds, processor, speed.measure(isosurface.Update)[0], peak / 1e6))
    first, processor, other, peak = np.median(rows, axis=0)
    return f"{count:,} | {first:.2f} | {processor:.2f} | {other:.2f} | {peak:,.0f}"


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--threads", type=int, default=2, help="default: 2")
    parser.add_argument("--runs", type=int, default=5, help="default: 5")
    parser.add_argument("--samples", type=float, nargs="*", default=[0.1, 1, 4, 16],
                        metavar="MILLIONS", help="default: 0.1 1 4 16")
    options = parser.parse_args()
    vtkSMPTools.SetBackend("STDThread")
    vtkSMPTools.Initialize(options.threads)
    print("| million samples | filter | points or triangles | seconds | processor seconds |"
          " seconds at another isovalue | MB |\n" + "|---" * 7 + "|")
    for millions in options.samples:
        samples = defaults.sphere(int(1e6 * millions), 0)
        for name, kind in (("points", vtkScatteredIsopointFilter),
                           ("triangles", vtkScatteredIsosurfaceFilter)):
            print(f"| {millions:g} | {name} | {cost_of(kind, samples, options.runs)} |", flush=True)


if __name__ == "__main__":
    main()
