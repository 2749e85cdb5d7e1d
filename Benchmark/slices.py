# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures slices of random samples: their time beside that of an isosurface, and the errors of their values.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 Benchmark/slices.py [-n MILLIONS]
        [--repeat TIMES]

Prints processor times, medians over runs that alternate, and their ratios to that of the same plane as an isosurface,
beside a sphere with as many points, which does not end at the hull; then errors of values at points that are not at the
rim.
"""

import numpy as np
from common import TRIANGLES, cloud_of, named, parser_of, positions_of, print_head, print_row, timed
from scatteredisopoints import vtkScatteredSliceFilter
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPlane


def field(places):
    x, y, z = places.T
    return np.sin(3 * x) * np.cos(2 * y) + z * z


def samples(count):
    positions = np.random.default_rng(1).random((count, 3)).astype(np.float32)
    data = cloud_of(positions, np.linalg.norm(positions - np.float32(0.5), axis=1), "distance")
    data.GetPointData().AddArray(named("height", positions[:, 2]))
    data.GetPointData().AddArray(named("field", field(positions.astype(float))))
    return data


def isosurface_of(data, name, isovalue):
    surface = TRIANGLES()
    surface.SetInputData(data)
    surface.SetInputArrayToProcess(0, 0, 0, 0, name)
    surface.SetValue(0, isovalue)
    return surface, surface.Update


def slice_of(data, interpolation):
    plane, sliced = vtkPlane(), vtkScatteredSliceFilter()
    plane.SetNormal(0, 0, 1)
    plane.SetOrigin(0.5, 0.5, 0.5)
    sliced.SetInputData(data)
    sliced.SetCutFunction(plane)
    sliced.SetInterpolation(interpolation)

    def move():
        plane.SetOrigin(0.5, 0.5, plane.GetOrigin()[2] + 0.01)
        sliced.Update()

    return sliced, sliced.Update, move


def print_times(data, repeat):
    kinds = {"isosurface, plane": lambda: isosurface_of(data, "height", 0.5),
             "isosurface, sphere": lambda: isosurface_of(data, "distance", 0.282),  # an area of about 1
             "slice, fits": lambda: slice_of(data, vtkScatteredSliceFilter.FITS),
             "slice, linear": lambda: slice_of(data, vtkScatteredSliceFilter.LINEAR)}
    seconds, points = {}, {}
    for _ in range(repeat):
        for name, make in kinds.items():
            algorithm, *works = make()
            for work, label in zip(works, (name, name + ", moved")):
                seconds.setdefault(label, []).append(timed(work)[1])
                points[label] = algorithm.GetOutput().GetNumberOfPoints()
    print_head("", "points", "seconds", "to the plane")
    base = np.median(seconds["isosurface, plane"])
    for label, times in seconds.items():
        print_row(label, points[label], f"{np.median(times):.2f}", f"{np.median(times) / base:.2f}")


def print_errors(data):
    means = []
    print_head("values", "mean error", "largest")
    for name in ("FITS", "LINEAR"):
        sliced, update, _ = slice_of(data, getattr(vtkScatteredSliceFilter, name))
        update()
        places = positions_of(sliced.GetOutput())
        errors = np.abs(vtk_to_numpy(sliced.GetOutput().GetPointData().GetArray("field")) - field(places))
        errors = errors[(np.abs(places[:, :2] - 0.5) < 0.4).all(axis=1)]
        means.append(errors.mean())
        print_row(name.lower(), f"{means[-1]:.1e}", f"{errors.max():.1e}")
    print(f"\nratio of the means: {means[1] / means[0]:.0f}")


def main():
    parser = parser_of(__doc__)
    parser.add_argument("-n", type=float, default=4, metavar="MILLIONS", help="samples")
    parser.add_argument("--repeat", type=int, default=3, metavar="TIMES")
    arguments = parser.parse_args()
    data = samples(int(1e6 * arguments.n))
    print_times(data, arguments.repeat)
    print()
    print_errors(data)


if __name__ == "__main__":
    main()
