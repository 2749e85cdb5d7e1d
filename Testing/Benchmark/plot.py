# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots time over samples from benchmark.csv: plot.py [FOLDER]. Writes benchmark.png there and prints
how time and memory grow."""

import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

LABELS = {
    "isopoints": "isopoints",
    "isopoints, normals, radii": "isopoints, normals, radii",
    "then isovalue 69.9": "another isovalue",
    "VTK: resample to a grid (8 closest) + Flying Edges": "VTK: resample + contour",
    "CGAL: Delaunay, parallel + crossing edges": "CGAL: Delaunay, parallel",
    "VTK: vtkDelaunay3D + contour": "VTK: vtkDelaunay3D + contour",
}


def series(rows, what, threads):
    chosen = [
        (int(row["samples"]), float(row["seconds"]), float(row["peak_bytes_per_sample"]))
        for row in rows
        if row["cloud"] == "uniform" and row["what"] == what and row["threads"] == threads
    ]
    return np.array(sorted(chosen)).reshape(-1, 3)


def main(folder):
    with open(os.path.join(folder, "benchmark.csv")) as file:
        # What was measured may hold commas; the other columns do not.
        lines = [line.rstrip("\n").split(",") for line in file]
    names = lines[0]
    rows = [
        dict(zip(names, [line[0], ",".join(line[1 : len(line) - len(names) + 2])] + line[-(len(names) - 2) :]))
        for line in lines[1:]
    ]
    threads = rows[0]["threads"]
    figure, axes = plt.subplots(figsize=(7, 5))
    for what, label in LABELS.items():
        data = series(rows, what, "1" if "vtkDelaunay3D" in what else threads)
        if len(data):
            axes.loglog(data[:, 0], data[:, 1], "o-", label=label)
    axes.set_xlabel("samples")
    axes.set_ylabel("seconds")
    axes.set_title("Uniform cloud, sphere, %s threads" % threads)
    axes.grid(True, which="both", alpha=0.3)
    axes.legend()
    figure.savefig(os.path.join(folder, "benchmark.png"), dpi=120, bbox_inches="tight")

    ours = series(rows, "isopoints", threads)
    ours = ours[ours[:, 0] >= 1e6]
    exponent, _ = np.polyfit(np.log(ours[:, 0]), np.log(ours[:, 1]), 1)
    print("seconds grow as samples ^ %.2f from a million samples on" % exponent)
    for samples, seconds, peak in ours:
        print("%9d samples: %4.0f ns and %5.1f bytes a sample" % (samples, 1e9 * seconds / samples, peak))


main(sys.argv[1] if len(sys.argv) > 1 else ".")
