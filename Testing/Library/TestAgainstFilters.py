# SPDX-License-Identifier: GPL-3.0-or-later
"""The example in C and the VTK filter yield the same bytes: TestAgainstFilters.py EXAMPLE

EXAMPLE is the program of Examples/contour.c. Testing/Python/TestPythonFilters.py compares the C library with the
filters by the Python package, for random combinations of inputs and options.
"""

import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from scatteredisopoints import vtkScatteredIsosurfaceFilter
from vtkmodules.util.numpy_support import vtk_to_numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Python"))
from vtk_data import cloud_of, updated  # noqa: E402

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
