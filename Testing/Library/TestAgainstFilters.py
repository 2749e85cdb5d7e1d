# SPDX-License-Identifier: GPL-3.0-or-later
"""The C library and the VTK filters yield the same bytes: TestAgainstFilters.py EXAMPLE

EXAMPLE is the program of Examples/contour.c. Testing/Python/TestPythonFilters.py compares the C library with the
filters by the Python package, for random combinations of inputs and options.
"""

import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from scatteredisopoints import (
    gradient, probe, vtkScatteredGradientFilter, vtkScatteredIsosurfaceFilter, vtkScatteredProbeFilter)
from vtkmodules.util.numpy_support import vtk_to_numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Python"))
from vtk_data import cloud_of, named, set_all, updated  # noqa: E402

positions = np.random.default_rng(1).random((20000, 3)).astype(np.float32)
values = np.sin(7 * positions[:, 0]) + np.cos(5 * positions[:, 1]) + positions[:, 2]
with tempfile.TemporaryDirectory() as folder:
    np.column_stack([positions, values]).tofile(folder + "/samples")
    subprocess.run([sys.argv[1], folder + "/samples", "0.5", folder + "/surface.ply"], check=True)
    content = pathlib.Path(folder, "surface.ply").read_bytes()
output = updated(vtkScatteredIsosurfaceFilter, cloud_of(positions, values), [0.5]).GetOutput()
vertices = np.hstack([vtk_to_numpy(array) for array in (
    output.GetPoints().GetData(), output.GetPointData().GetNormals())]).astype("<f4")
corners = vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)
faces = np.empty(len(corners), [("count", "u1"), ("ids", "<i4", 3)])
faces["count"], faces["ids"] = 3, corners
if len(corners) <= 3000 or content.split(b"end_header\n", 1)[1] != vertices.tobytes() + faces.tobytes():
    sys.exit(f"failed: the example's triangles are not the filter's {len(corners)}")

# Values and gradients at places, by all methods. Some samples are not finite, or integers.
arrays = {"float": values, "vector": np.cross(positions, [1.0, 2.0, 3.0]), "short": (100 * values).astype(np.int16)}
arrays["float"][::7] = np.nan
places = 1.2 * np.random.default_rng(2).random((2000, 3)) - 0.1
source = cloud_of(positions)
for name, array in arrays.items():
    source.GetPointData().AddArray(named(name, array))
for number, method in enumerate(("BLEND", "CUBIC", "QUADRATIC", "AFFINE", "NEAREST")):
    for strategy, outside in ((0, np.nan), (1, -7.0), (2, "nearest")):
        filter_ = set_all(vtkScatteredProbeFilter(), InputData=cloud_of(places), SourceData=source,
                          Interpolation=number, NullPointsStrategy=strategy, NullValue=-7.0)
        filter_.Update()
        found = filter_.GetOutput().GetPointData()
        for name, expected in probe(positions, arrays, places, method=method, outside=outside).items():
            if vtk_to_numpy(found.GetArray(name)).tobytes() != expected.tobytes():
                sys.exit(f"failed: {name} by {method} at places, outside {outside}")
    for name in arrays if number < 4 else ():
        filter_ = set_all(vtkScatteredGradientFilter(), InputData=source, Interpolation=number)
        filter_.SetInputArrayToProcess(0, 0, 0, 0, name)
        filter_.Update()
        found = vtk_to_numpy(filter_.GetOutput().GetPointData().GetArray("Gradients"))
        if found.tobytes() != gradient(positions, arrays[name], method=method).tobytes():
            sys.exit(f"failed: the gradient of {name} by {method}")
