# SPDX-License-Identifier: GPL-3.0-or-later
"""What the benchmarks share: options and tables (tables.py), clouds, files, filters, meshes, and time and memory."""

import ctypes
import pathlib
import sys
import time

import numpy as np
from scatteredisopoints import vtkScatteredIsopointFilter, vtkScatteredIsosurfaceFilter
from tables import add_numbers, parser_of, print_head, print_row  # noqa: F401
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkSMPTools
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkIOXML import vtkXMLGenericDataObjectReader

for folder in ("Python", "Rendering", "ParaView"):
    sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "Testing" / folder))
from vtk_data import cloud_of, leaves_of, named, positions_in, set_all  # noqa: E402, F401

POINTS, TRIANGLES = vtkScatteredIsopointFilter, vtkScatteredIsosurfaceFilter
SIDE, RADIUS, OTHER_RADIUS = 200.0, 70.0, 69.9  # of a cube, and isovalues of the distance to its center
OF_ONE_FILTER = {"ComputeSplats": POINTS, "Regularize": TRIANGLES}  # properties that the other one does not have
NOISE = 0.05  # standard deviation, in mean rises of the values between neighbors


def add_files(parser, *names):
    parser.add_argument("--file", nargs=len(names), action="append", default=[], metavar=names, help="also a file")


def set_threads(threads):
    vtkSMPTools.SetBackend("STDThread")
    vtkSMPTools.Initialize(threads)


def name_of(path):
    return path.rsplit("/", 1)[-1]


def uniform(count, random):
    return np.float32(SIDE) * (random.random((count, 3), dtype=np.float32) - np.float32(0.5))


def sphere(count, noise):
    """Random samples of the distance to the center of the cube. @returns positions and values"""
    random = np.random.default_rng(1)
    positions = uniform(count, random)
    spacing = SIDE / count ** (1 / 3)
    return positions, np.linalg.norm(positions, axis=1) + noise * spacing * random.standard_normal(count)


def spheres(millions):
    """Yields name, positions and values without noise and with it."""
    for noise, name in (0, "sphere"), (NOISE, "sphere, noise of 5 %"):
        yield name, *sphere(int(1e6 * millions), noise)


def read(path):
    """A file of VTK's XML formats; the first array of a volume without scalars becomes active."""
    reader = vtkXMLGenericDataObjectReader()
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutputDataObject(0)
    if data is None or data.GetNumberOfElements(0) == 0:
        sys.exit(f"{path}: no points could be read")
    if not isinstance(data, vtkCompositeDataSet) and not data.GetPointData().GetScalars():
        data.GetPointData().SetActiveScalars(data.GetPointData().GetArrayName(0) or "")
    return data


def positions_of(data):
    if hasattr(data, "GetPoints") and data.GetPoints():
        return vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    return positions_in(data)


def configured(algorithm, data, isovalue=None, **properties):
    """An algorithm with its input. Properties of the other of our filters are left out, unknown ones raise."""
    algorithm.SetInputDataObject(data)
    if isovalue is not None:
        algorithm.SetValue(0, isovalue)
    for name, value in properties.items():
        if isinstance(algorithm, OF_ONE_FILTER.get(name, object)):
            getattr(algorithm, "Set" + name)(value)
    return algorithm


def output_of(algorithm, data, isovalue=None, **properties):
    configured(algorithm, data, isovalue, **properties).Update()
    return algorithm.GetOutputDataObject(0)


def alone():
    """Properties of points or triangles alone."""
    return dict(Projection=POINTS.NO_PROJECTION, ComputeNormals=False, ComputeSplats=False)


def corners_of(mesh):
    """The corners of a mesh's triangles, shape (triangles, 3, 3)."""
    mesh = output_of(vtkTriangleFilter(), mesh, PassVerts=False, PassLines=False)
    if mesh.GetNumberOfPolys() == 0:
        return np.zeros((0, 3, 3))
    return positions_of(mesh)[vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)]


def normals_of(corners):
    """Normals of triangles, as long as twice their areas."""
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


def areas_of(corners):
    return np.linalg.norm(normals_of(corners), axis=1) / 2


def random_places(corners, count, random):
    """Evenly distributed on triangles. @returns the numbers of their triangles, and weights of the corners"""
    areas = areas_of(corners)
    chosen = random.choice(len(areas), count, p=areas / areas.sum())
    root, other = np.sqrt(random.random((count, 1))), random.random((count, 1))
    return chosen, np.hstack([1 - root, root * (1 - other), root * other])


def placed(weights, values):
    """Values at corners, shape (n, 3, k), interpolated."""
    return np.einsum("ij,ijk->ik", weights, values)


def memory(key):
    with open("/proc/self/status") as status:
        return next(1024 * int(line.split()[1]) for line in status if line.startswith(key))


def timed(work):
    """The elapsed and processor seconds of work(), with memory as former work left it."""
    begin = time.perf_counter(), time.process_time()
    work()
    return time.perf_counter() - begin[0], time.process_time() - begin[1]


def measure(work):
    """The elapsed and processor seconds, and the bytes that work() takes."""
    ctypes.CDLL(None).malloc_trim(0)  # freed memory must not hide a new peak
    with open("/proc/self/clear_refs", "w") as peak:
        peak.write("5")
    before = memory("VmRSS:")
    seconds = timed(work)
    return *seconds, max(0, memory("VmHWM:") - before)
