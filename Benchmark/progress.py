# SPDX-License-Identifier: GPL-3.0-or-later
"""How evenly the filters report their progress, at one isovalue and then at another from the kept tree.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 Benchmark/progress.py

Prints Markdown tables: the elapsed seconds; the number of reports; the longest time between two of
them, as percentage of the elapsed time; and the largest deviation of the progress reported from the
share of the time, in points of 100.
"""

import time

import common
import numpy as np

FIELDS = {
    "sphere": ((0.3, 0.4), lambda p, noise: np.linalg.norm(p - np.float32(0.5), axis=1)),
    "noisy waves": ((0.5, 0.7), lambda p, noise: np.sin(20 * p).sum(axis=1) + 0.1 * noise)}
OUTPUTS = {"points alone": (common.POINTS, common.alone()), "points": (common.POINTS, {}),
           "triangles": (common.TRIANGLES, {})}


def watched(contour):
    """Updates a filter. @returns the seconds, and times and progress of the reports with begin and end."""
    reports = [(time.perf_counter(), 0.0)]
    tag = contour.AddObserver(
        "ProgressEvent", lambda caller, _: reports.append((time.perf_counter(), caller.GetProgress())))
    contour.Update()
    reports.append((time.perf_counter(), 1.0))
    contour.RemoveObserver(tag)
    times, progress = np.array(reports).T
    return times[-1] - times[0], (times - times[0]) / (times[-1] - times[0]), progress


parser = common.parser_of(__doc__)
common.add_numbers(parser, samples=4000000, threads=2)
options = parser.parse_args()
common.set_threads(options.threads)
random = np.random.default_rng(1)
positions = random.random((options.samples, 3), dtype=np.float32)
noise = random.standard_normal(options.samples, dtype=np.float32)
common.print_head("samples", "output", "isovalue", "seconds", "reports", "longest silence, %", "points of 100 off")
for field, (isovalues, values) in FIELDS.items():
    samples = common.cloud_of(positions, values(positions, noise))
    for output, (kind, properties) in OUTPUTS.items():
        contour = common.configured(kind(), samples, **properties)
        for isovalue in isovalues:
            contour.SetValue(0, isovalue)
            seconds, shares, progress = watched(contour)
            # Until a report, the one before it holds.
            off = np.concatenate([progress - shares, progress[:-1] - shares[1:]])
            common.print_row(field, output, isovalue, f"{seconds:.2f}", len(shares) - 2,
                             f"{100 * np.diff(shares).max():.0f}", f"{100 * off[np.abs(off).argmax()]:+.0f}")
