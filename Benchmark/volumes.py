# SPDX-License-Identifier: GPL-3.0-or-later
"""How close isopoints are to the surface of a volume of which they saw a quarter of the voxels.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 \\
        Benchmark/volumes.py FILE.vti ISOVALUE [FILE.vti ISOVALUE]...

A quarter of the voxels, chosen at random with a fixed seed, are the samples. The reference is the
surface of all voxels, trilinear between them: marching cubes after each voxel is divided in three.
The table gives mean distances from it in mean spacings of the samples, and processor seconds of the
filter with normals and radii, beside those of the extraction alone.
"""

import sys

import common
import numpy as np
from common import positions_of
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D, vtkImplicitPolyDataDistance
from vtkmodules.vtkImagingCore import vtkImageResample

DIVISIONS = 3
MEASURED_POINTS = 20000


def quarter_of(volume, seed=1):
    """A quarter of the voxels as a cloud of points, and their mean spacing."""
    random = np.random.default_rng(seed)
    count = volume.GetNumberOfPoints()
    chosen = np.sort(random.permutation(count)[: count // 4])
    index = np.array(np.unravel_index(chosen, volume.GetDimensions()[::-1])).T[:, ::-1]
    positions = volume.GetOrigin() + (index + volume.GetExtent()[::2]) * volume.GetSpacing()
    values = vtk_to_numpy(volume.GetPointData().GetScalars())[chosen]
    samples = common.cloud_of(positions.astype(np.float32), values.astype(np.float32))
    return samples, (np.prod(volume.GetSpacing()) * count / len(chosen)) ** (1 / 3)


def reference_of(volume, isovalue):
    fine = vtkImageResample()
    fine.SetInterpolationModeToLinear()
    for axis in range(3):
        fine.SetAxisMagnificationFactor(axis, DIVISIONS)
    distance = vtkImplicitPolyDataDistance()
    distance.SetInput(common.output_of(
        vtkFlyingEdges3D(), common.output_of(fine, volume), isovalue, ComputeNormals=False))
    return distance


def extract_both(samples, isovalue):
    """Isopoints alone, and those with the default fit, normals and splats; processor seconds of each."""
    found = []
    for properties in (common.alone(), {}):
        isopoints = common.configured(common.POINTS(), samples, isovalue, **properties)
        seconds = common.timed(isopoints.Update)[1]
        found.append((isopoints.GetOutput(), seconds))
    return found


def measured(positions, volume, spacing):
    """Indices away from the volume's border, where samples stand on all sides; at most this many."""
    bounds = np.array(volume.GetBounds()).reshape(3, 2)
    inside = (positions > bounds[:, 0] + 2 * spacing) & (positions < bounds[:, 1] - 2 * spacing)
    indices = np.flatnonzero(inside.all(axis=1))
    return indices[:: max(1, len(indices) // MEASURED_POINTS)]


def distances(positions, reference):
    values = vtkDoubleArray()
    reference.FunctionValue(numpy_to_vtk(np.ascontiguousarray(positions)), values)
    return np.abs(vtk_to_numpy(values))


def main():
    if len(sys.argv) < 3 or len(sys.argv) % 2 == 0:
        sys.exit(__doc__)
    common.print_head("volume", "isovalue", "points", "linear", "cubic fit", "extraction, s", "cubic fit, s")
    for path, text in zip(sys.argv[1::2], sys.argv[2::2]):
        volume, isovalue = common.read(path), float(text)
        samples, spacing = quarter_of(volume)
        reference, means, seconds = reference_of(volume, isovalue), [], []
        for isopoints, taken in extract_both(samples, isovalue):
            positions = positions_of(isopoints)
            positions = positions[measured(positions, volume, spacing)]
            means.append(f"{distances(positions, reference).mean() / spacing:.4f}")
            seconds.append(f"{taken:.2f}")
        common.print_row(common.name_of(path), text, isopoints.GetNumberOfPoints(), *means, *seconds)


if __name__ == "__main__":
    main()
