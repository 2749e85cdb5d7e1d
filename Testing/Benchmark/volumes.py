# SPDX-License-Identifier: GPL-3.0-or-later
"""How close isopoints are to the surface of a volume of which they saw a quarter of the voxels.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 \\
        Testing/Benchmark/volumes.py FILE.vti ISOVALUE [FILE.vti ISOVALUE]...

A quarter of the voxels, chosen at random with a fixed seed, are the samples. The reference is the
surface of all voxels, trilinear between them: marching cubes after each voxel is divided in three.
The table gives mean distances from it in mean spacings of the samples, and processor seconds of the
filter with normals and radii, beside those of the extraction alone.
"""

import sys
import time

import numpy as np
from scatteredisopoints import vtkScatteredIsopointFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D, vtkImplicitPolyDataDistance
from vtkmodules.vtkImagingCore import vtkImageResample
from vtkmodules.vtkIOXML import vtkXMLImageDataReader

PROJECTIONS = {
    "linear": vtkScatteredIsopointFilter.NO_PROJECTION,
    "cubic fit": vtkScatteredIsopointFilter.CUBIC_FIT,
}
DIVISIONS = 3
MEASURED_POINTS = 20000


def read(path):
    reader = vtkXMLImageDataReader()
    reader.SetFileName(path)
    reader.Update()
    volume = reader.GetOutput()
    if volume.GetNumberOfPoints() == 0:
        sys.exit(f"{path}: no voxels could be read")
    if not volume.GetPointData().GetScalars():
        volume.GetPointData().SetActiveScalars(volume.GetPointData().GetArrayName(0))
    return volume


def cloud(positions, values):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(positions, deep=True))
    samples = vtkPolyData()
    samples.SetPoints(points)
    scalars = numpy_to_vtk(values, deep=True)
    scalars.SetName("values")
    samples.GetPointData().SetScalars(scalars)
    return samples


def quarter_of(volume, seed=1):
    """A quarter of the voxels as a cloud of points, and their mean spacing."""
    random = np.random.default_rng(seed)
    count = volume.GetNumberOfPoints()
    chosen = np.sort(random.permutation(count)[: count // 4])
    index = np.array(np.unravel_index(chosen, volume.GetDimensions()[::-1])).T[:, ::-1]
    positions = volume.GetOrigin() + (index + volume.GetExtent()[::2]) * volume.GetSpacing()
    values = vtk_to_numpy(volume.GetPointData().GetScalars())[chosen]
    samples = cloud(positions.astype(np.float32), values.astype(np.float32))
    return samples, (np.prod(volume.GetSpacing()) * count / len(chosen)) ** (1 / 3)


def reference_of(volume, isovalue):
    fine = vtkImageResample()
    fine.SetInputData(volume)
    fine.SetInterpolationModeToLinear()
    for axis in range(3):
        fine.SetAxisMagnificationFactor(axis, DIVISIONS)
    contour = vtkFlyingEdges3D()
    contour.SetInputConnection(fine.GetOutputPort())
    contour.SetValue(0, isovalue)
    contour.ComputeNormalsOff()
    contour.Update()
    distance = vtkImplicitPolyDataDistance()
    distance.SetInput(contour.GetOutput())
    return distance


def extract(samples, isovalue, projection, is_alone=False):
    """The isopoints and the processor seconds that they took."""
    isopoints = vtkScatteredIsopointFilter()
    isopoints.SetInputData(samples)
    isopoints.SetValue(0, isovalue)
    isopoints.SetProjection(projection)
    isopoints.SetComputeNormals(not is_alone)
    isopoints.SetComputeSplats(not is_alone)
    begin = time.process_time()
    isopoints.Update()
    return isopoints.GetOutput(), time.process_time() - begin


def positions_of(isopoints):
    return vtk_to_numpy(isopoints.GetPoints().GetData()).astype(float)


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
    print("| volume | isovalue | points |", " | ".join(PROJECTIONS), "| extraction, s |",
          ", s | ".join(list(PROJECTIONS)[1:]) + ", s |")
    print("|---" * (4 + 2 * len(PROJECTIONS) - 1) + "|")
    for path, text in zip(sys.argv[1::2], sys.argv[2::2]):
        volume, isovalue = read(path), float(text)
        samples, spacing = quarter_of(volume)
        reference = reference_of(volume, isovalue)
        means, seconds = [], []
        for name, projection in PROJECTIONS.items():
            isopoints, taken = extract(samples, isovalue, projection, name == "linear")
            positions = positions_of(isopoints)
            positions = positions[measured(positions, volume, spacing)]
            means.append(f"{distances(positions, reference).mean() / spacing:.4f}")
            seconds.append(f"{taken:.2f}")
        print("|", path.rsplit("/", 1)[-1], "|", text, "|", isopoints.GetNumberOfPoints(), "|",
              " | ".join(means), "|", " | ".join(seconds), "|", flush=True)


if __name__ == "__main__":
    main()
