# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges the fits that move isopoints, on smooth and on hard fields and on volumes.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 \\
        Benchmark/fits.py [--only SET,...] [--seeds N] [--samples N] [--save FILE.json]
        [FILE.vti ISOVALUE]...

One line for each set of samples: the mean distance of isopoints from the true surface with linear
interpolation and with the default fit; the ratio of the two, and the largest ratio of a seed; the
largest distance and the mean error of a normal with the fit; the share of points that the fit puts
farther away; and processor microseconds of fits, normals and radii for each point. Distances are in
mean spacings of the samples, angles in degrees. Only points two spacings inside the samples count.
Volumes are sampled and measured as by volumes.py.

    Benchmark/fits.py --compare FILE.json OTHER.json...

compares what --save has written: mean distances with the fit of the first file, and those of the
others divided by them. So a constant is judged at half and at twice its value: build each time,
save, compare. Sets that nobody looked at when a constant was chosen count most.
"""

import json
import sys
from collections import namedtuple

import analytic_surfaces as surfaces
import common
import numpy as np
import volumes
from vtkmodules.util.numpy_support import vtk_to_numpy

ROUNDING = 1e-9  # differences of distances, in spacings, that do not count


# measured(positions): indices of those that count; feet(positions): distances from the surface in
# spacings, and the true normals or None.
Draw = namedtuple("Draw", "samples isovalue measured feet")


class AnalyticSet:
    """Samples of a field whose isosurface is known."""

    def __init__(self, field, sampling, noise=0.0):
        self.field, self.sampling, self.noise = field, sampling, noise

    def draw(self, seed, count):
        random = np.random.default_rng(seed)
        positions = self.sampling(count, random)
        spacing = 2 / len(positions) ** (1 / 3)
        surface = self.field(spacing)
        values = surface.value(positions)
        if self.noise:
            deviation = surface.value(2 * np.random.default_rng(0).random((100000, 3)) - 1).std()
            values = values + self.noise * deviation * random.normal(size=len(values))

        def measured(points):
            return np.flatnonzero((np.abs(points) <= 1 - 2 * spacing).all(axis=1))

        def feet(points):
            nearest, normals = surface.feet(points)
            return surfaces.length(points - nearest) / spacing, normals

        return Draw(common.cloud_of(positions, values), surface.isovalue, measured, feet)


class VolumeSet:
    """A quarter of the voxels of a volume."""

    def __init__(self, path, isovalue):
        self.isovalue = isovalue
        self.volume = common.read(path)
        self.reference = volumes.reference_of(self.volume, isovalue)

    def draw(self, seed, _):
        samples, spacing = volumes.quarter_of(self.volume, seed)

        def measured(points):
            return volumes.measured(points, self.volume, spacing)

        def feet(points):
            return volumes.distances(points, self.reference) / spacing, None

        return Draw(samples, self.isovalue, measured, feet)


def angles_between(normals, truth):
    """Degrees from each normal to the nearest of the true ones; those of length 0 do not count."""
    cosines = (surfaces.unit(normals)[:, None] * truth).sum(axis=2)
    cosines = np.where(np.abs(truth).sum(axis=2) > 0, cosines, -1).max(axis=1)
    return np.degrees(np.arccos(np.clip(cosines, -1, 1)))


def analytic_sets():
    smooth = {"sphere": surfaces.sphere, "torus": surfaces.torus, "gyroid": surfaces.gyroid,
              "Gaussian mixture": surfaces.gaussian_mixture}
    samplings = {"clustered": surfaces.clustered, "jittered": surfaces.jittered,
                 "lattice": surfaces.lattice, "slices 4": surfaces.slices(4),
                 "slices 8": surfaces.slices(8), "lines": surfaces.lines}
    sharp = {"step": surfaces.step, "plane step": surfaces.plane_step,
             "smooth step": surfaces.smooth_step, "cube": surfaces.cube,
             "two sheets": surfaces.two_sheets, "two balls": surfaces.two_balls}
    sets = {name: AnalyticSet(field, surfaces.uniform) for name, field in smooth.items()}
    for name in ("sphere", "torus", "gyroid"):
        for percent in (1, 5):
            sets[f"{name} noise {percent} %"] = AnalyticSet(smooth[name], surfaces.uniform, percent / 100)
    sets.update((name, AnalyticSet(field, surfaces.uniform)) for name, field in sharp.items())
    for name in ("step", "cube"):
        sets[f"{name} noise 1 %"] = AnalyticSet(sharp[name], surfaces.uniform, 0.01)
    for name in ("sphere", "gyroid"):
        for sampling, positions in samplings.items():
            sets[f"{name} {sampling}"] = AnalyticSet(smooth[name], positions)
    sets["sphere slices 4 noise 1 %"] = AnalyticSet(smooth["sphere"], samplings["slices 4"], 0.01)
    sets["two sheets lines"] = AnalyticSet(sharp["two sheets"], samplings["lines"])
    return sets


def judge(draw):
    """The figures of one draw."""
    (linear, alone), (fitted, seconds) = volumes.extract_both(draw.samples, draw.isovalue)
    # The points of both are in the same order.
    before, after = common.positions_of(linear), common.positions_of(fitted)
    measured = draw.measured(before)
    without, _ = draw.feet(before[measured])
    distances, truth = draw.feet(after[measured])
    figures = {
        "points": len(after),
        "linear": without.mean(),
        "fit": distances.mean(),
        "largest": distances.max(),
        "farther": (distances > without + ROUNDING).mean(),
        "seconds": seconds - alone,
    }
    if truth is not None:
        normals = vtk_to_numpy(fitted.GetPointData().GetNormals()).astype(float)
        figures["normal"] = angles_between(normals[measured], truth).mean()
    return {name: float(figure) for name, figure in figures.items()}


def mean_of(draws, name):
    return np.mean([draw[name] for draw in draws if name in draw] or [np.nan])


def print_row(name, draws):
    ratio = mean_of(draws, "fit") / mean_of(draws, "linear")
    cells = [
        name,
        f"{mean_of(draws, 'points'):.0f}",
        f"{mean_of(draws, 'linear'):.5f}",
        f"{mean_of(draws, 'fit'):.5f}",
        f"{ratio:.3f}",
        f"{max(draw['fit'] / draw['linear'] for draw in draws):.3f}",
        f"{max(draw['largest'] for draw in draws):.4f}",
        f"{mean_of(draws, 'normal'):.3f}",
        f"{100 * mean_of(draws, 'farther'):.0f}",
        f"{1e6 * mean_of(draws, 'seconds') / mean_of(draws, 'points'):.0f}",
    ]
    common.print_row(*("" if cell == "nan" else cell for cell in cells))


def judge_all(options):
    sets = analytic_sets()
    for path, isovalue in zip(options.volumes[::2], options.volumes[1::2]):
        sets[f"{common.name_of(path)} {isovalue}"] = (path, float(isovalue))
    unknown = set(options.only) - set(sets)
    if unknown:
        sys.exit("there is no set named " + ", ".join(sorted(unknown)))
    common.print_head("set", "points", "linear", "fit", "ratio", "largest ratio", "largest distance", "normal",
                      "farther, %", "us / point")
    results = {}
    for name, of_set in sets.items():
        if options.only and name not in options.only:
            continue
        if isinstance(of_set, tuple):
            of_set = VolumeSet(*of_set)
        results[name] = [judge(of_set.draw(seed, options.samples)) for seed in range(1, options.seeds + 1)]
        print_row(name, results[name])
    if options.save:
        with open(options.save, "w") as file:
            json.dump(results, file, indent=1)


def compare(paths):
    files = []
    for path in paths:
        with open(path) as file:
            files.append(json.load(file))
    common.print_head("set", "linear", *(common.name_of(path).rsplit(".", 1)[0] for path in paths))
    for name, draws in files[0].items():
        if all(name in file for file in files):
            first = mean_of(draws, "fit")
            others = [f"{mean_of(file[name], 'fit') / first:.3f}" for file in files[1:]]
            common.print_row(name, f"{mean_of(draws, 'linear'):.5f}", f"{first:.5f}", *others)


def main():
    parser = common.parser_of(__doc__)
    common.add_numbers(parser, seeds=5, samples=64000)
    parser.add_argument("--only", default=[], type=lambda text: text.split(","))
    parser.add_argument("--save")
    parser.add_argument("--compare", nargs="+")
    parser.add_argument("volumes", nargs="*", metavar="FILE.vti ISOVALUE")
    options = parser.parse_args()
    if options.compare:
        compare(options.compare)
    elif len(options.volumes) % 2 or options.seeds < 1:
        sys.exit(__doc__)
    else:
        judge_all(options)


if __name__ == "__main__":
    main()
