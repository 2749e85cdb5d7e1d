# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints hashes of extractions from 24 clouds, or the first ones: extractions.py [--filters] [CLOUDS]

The option runs the compiled filters rather than the C library. The lines are the same wherever results are.
"""

import hashlib
import sys
import warnings

import numpy as np
from scatteredisopoints import Isosurface, _options, contour


def samples(number):
    """Samples that need only sums, products and square roots, which all versions of NumPy round alike."""
    random = np.random.default_rng(number)
    positions = random.random((4000, 3))
    kind = number % 4
    if kind == 1:
        positions = np.floor(12 * positions)  # a lattice, with coincident samples
    elif kind == 2:
        positions = positions * positions * positions  # dense at a corner
    elif kind == 3:
        positions[:, 2] = np.round(8 * positions[:, 2]) / 8  # slices
    x, y, z = ((positions - positions.min(axis=0)) / np.ptp(positions, axis=0) - 0.5).T
    values = np.sqrt(x * x + y * y + z * z) + 0.3 * x * y * z
    if number % 3 == 0:
        values = np.maximum(np.maximum(np.abs(x), np.abs(y)), np.abs(z))
    dtype = [np.float32, np.float64][number % 2]
    values = np.rint(100 * values).astype(np.int16) if number % 5 == 4 else values.astype(dtype)
    return positions.astype(dtype), values


def options_of(number):
    options = {"projection": ["CUBIC_FIT", "NO_PROJECTION", "QUADRATIC_FIT", "CREASE_FIT"][number % 4],
               "compute_gradients": number % 3 == 1, "drop_gaps": number % 7 != 3}
    return options


def extracted(positions, values, isovalues, triangles, options):
    return contour(positions, values, isovalues, triangles=triangles, **options)


def filtered(positions, values, isovalues, triangles, options):
    """The same by a filter."""
    from scatteredisopoints import vtkScatteredIsopointFilter, vtkScatteredIsosurfaceFilter
    from vtk_data import cloud_of, updated
    from vtkmodules.util.numpy_support import vtk_to_numpy

    kind = vtkScatteredIsosurfaceFilter if triangles else vtkScatteredIsopointFilter
    properties = {_options.property_name(name): _options.number_of(name, value, 0) for name, value in options.items()}
    output = updated(kind, cloud_of(positions, values), isovalues, **properties).GetOutput()
    arrays, shapes = ({data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
                      for data in (output.GetPointData(), output.GetCellData()))
    return Isosurface(vtk_to_numpy(output.GetPoints().GetData()), arrays=arrays, splat_shapes=shapes,
                      triangles=vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3))


def main(extract, clouds):
    for number in range(clouds):
        positions, values = samples(number)
        for triangles in (False, True):
            options = options_of(number)
            if triangles:
                options["regularize"] = number % 5 < 3
            isovalues = np.sort(values)[[len(values) // 3, len(values) // 2]] + 0.001
            surface = extract(positions, values, [float(value) for value in isovalues], triangles, options)
            arrays = [surface.points, *(surface.arrays[name] for name in sorted(surface.arrays)),
                      *(surface.splat_shapes[name] for name in sorted(surface.splat_shapes))]
            if triangles:
                arrays.append(surface.triangles.astype(np.int64))
            hashes = [hashlib.sha256(array.tobytes()).hexdigest()[:12] for array in arrays]
            print(number, "triangles" if triangles else "points", len(surface), *hashes)


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    count = int(sys.argv[-1]) if sys.argv[-1].isdigit() else 24
    main(filtered if "--filters" in sys.argv else extracted, count)
