# SPDX-License-Identifier: GPL-3.0-or-later
"""Time and memory of both filters with their defaults, by the number of samples.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 Benchmark/cost.py

Prints a Markdown table of the distance to the center of a cube at random positions: for points and
for triangles their number, elapsed seconds and processor seconds, medians of some runs, at a first
isovalue; elapsed seconds at another isovalue; and the peak of memory in MB beyond the samples,
which take 16 bytes each.
"""

import common
import numpy as np
from common import measure

parser = common.parser_of(__doc__)
common.add_numbers(parser, threads=2, runs=5, samples=[0.1, 1.0, 4.0, 16.0])
options = parser.parse_args()
common.set_threads(options.threads)
common.print_head("million samples", "filter", "points or triangles", "seconds", "processor seconds",
                  "seconds at another isovalue", "MB")
for millions in options.samples:
    positions, values = common.sphere(int(1e6 * millions), 0)
    samples = common.cloud_of(positions, values.astype(np.float32))
    for name, kind in (("points", common.POINTS), ("triangles", common.TRIANGLES)):
        rows = []
        for _ in range(options.runs):
            isosurface = common.configured(kind(), samples, common.RADIUS, UseAllCores=False)
            seconds, processor, peak = measure(isosurface.Update)
            output = isosurface.GetOutput()
            count = output.GetNumberOfPolys() or output.GetNumberOfPoints()
            isosurface.SetValue(0, common.OTHER_RADIUS)
            rows.append((seconds, processor, measure(isosurface.Update)[0], peak / 1e6))
        seconds, processor, other, peak = np.median(rows, axis=0)
        common.print_row(f"{millions:g}", name, f"{count:,}", f"{seconds:.2f}", f"{processor:.2f}", f"{other:.2f}",
                         f"{peak:,.0f}")
