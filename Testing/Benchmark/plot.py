# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots the times in FOLDER/benchmark.csv over the number of samples to FOLDER/benchmark.png, and
prints how the time and the memory of isopoints grow. Needs matplotlib."""

import argparse
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

LABELS = {
    "isopoints": "isopoints",
    "isopoints, projected, normals, radii": "isopoints, projected, normals, radii",
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
        # Names of methods may contain commas; the other columns do not.
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
    print("from a million samples on, time grows as samples ^ %.2f" % exponent)
    for samples, seconds, peak in ours:
        print("%9d samples: %4.0f ns and %5.1f bytes per sample" % (samples, 1e9 * seconds / samples, peak))


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("folder", metavar="FOLDER", nargs="?", default=".", help="default: the current one")
main(parser.parse_args().folder)
