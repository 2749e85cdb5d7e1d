# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints hashes of the filters' outputs for each of N random combinations of inputs and options.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 \
        Testing/Python/fingerprint.py [N] [FIRST]

The first hash is of isopoints, the second of triangles. Two builds whose lists are equal produce
the same bytes: positions, cells and all arrays in their order, and the numbers of skipped samples and
unprojected points. Each combination depends only on its number, from FIRST on. Run by
mpirun -n RANKS pvbatch --symmetric, samples are dealt out in turns, images are on the first rank
alone, and the hashes are of what all ranks put out. See docs/testing.md.
"""

import argparse
import hashlib

import numpy as np
from scatteredisopoints import vtkScatteredIsopointFilter, vtkScatteredIsosurfaceFilter
from vtk_data import blocks_of, cloud_of, leaves_of, named
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkStringArray, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData, vtkRectilinearGrid
from vtkmodules.vtkParallelCore import vtkMultiProcessController

RANKS = vtkMultiProcessController.GetGlobalController()
RANK, SIZE = (RANKS.GetLocalProcessId(), RANKS.GetNumberOfProcesses()) if RANKS else (0, 1)


def lattice(count):
    grid = np.arange(count) / (count - 1)
    return np.array(np.meshgrid(grid, grid, grid)).reshape(3, -1).T.copy()


def on_lines(p):
    p[:, 1:] = np.floor(p[:, 1:] * 14) / 14
    return p


# Of positions p, and a generator r of random numbers.
FIELDS = {
    "waves": lambda p, r: np.sin(7 * p[:, 0]) + np.cos(5 * p[:, 1] + p[:, 0]) + np.sin(6 * p[:, 2] - 2 * p[:, 1]),
    "cube": lambda p, r: 0.6 - np.abs(p - 0.5).max(axis=1),
    "sheets": lambda p, r: np.minimum(np.abs(p[:, 2] - 0.45), np.abs(p[:, 2] - 0.55 + 0.1 * p[:, 0])) - 0.02,
    "step": lambda p, r: (p[:, 0] + 0.3 * p[:, 1] > 0.6).astype(float) + 0.05 * r.random(len(p)),
    "noise": lambda p, r: np.sin(7 * p[:, 0]) + 0.3 * r.normal(size=len(p)),
    "integers": lambda p, r: np.round(4 * (np.sin(7 * p[:, 0]) + np.cos(5 * p[:, 1]))),
    "distance": lambda p, r: np.linalg.norm(p - 0.5, axis=1)}
POSITIONS = {
    "clustered": lambda n, r: 0.5 + (r.random((n, 3)) - 0.5) * 10.0 ** (-3 * r.random((n, 1))),
    "lattice": lambda n, r: lattice(max(2, int(round(n ** (1 / 3))))),
    "coarse": lambda n, r: np.floor(r.random((n, 3)) * 12) / 12,
    "lines": lambda n, r: on_lines(r.random((n, 3))),
    "slab": lambda n, r: r.random((n, 3)) * [1.0, 1.0, 0.05],
    "coplanar": lambda n, r: r.random((n, 3)) * [1.0, 1.0, 0.0],
    "uniform": lambda n, r: r.random((n, 3))}


def add_arrays(attributes, p, values, types, random, dealt=slice(None)):
    attributes.SetScalars(named("values", values.astype(types[1])[dealt]))
    attributes.AddArray(named("vectors", np.sin(3 * p)[dealt]))
    attributes.AddArray(named("counts", (1000 * p[:, 0]).astype(np.int32)[dealt]))
    attributes.AddArray(named("names", [str(i % 97) for i in range(len(p))[dealt]]))
    if random.random() < 0.3:
        attributes.AddArray(named("vtkGhostType", (random.random(len(p)) < 0.02).astype(np.uint8)[dealt]))


def cloud(kinds, types, random, offset=0.0):
    p = POSITIONS[kinds[0]](int(random.integers(50, 9000)), random)
    values = FIELDS[kinds[1]](p, random)
    if types[1] != np.int16 and random.random() < 0.2:
        values[random.random(len(p)) < 0.01] = np.nan
    p = p * types[2] + types[3] + offset
    dealt = slice(RANK, None, SIZE)
    data = cloud_of(p[dealt].astype(types[0]))
    add_arrays(data.GetPointData(), p, values, types, random, dealt)
    return data


def image(kinds, types, random):
    side = [int(n) for n in random.integers(5, 24, 3)]
    if random.random() < 0.5:
        data = vtkImageData()
        data.SetDimensions(side)
        data.SetSpacing(*(0.02 + 0.1 * random.random(3)))
    else:
        data = vtkRectilinearGrid()
        data.SetDimensions(side)
        setters = (data.SetXCoordinates, data.SetYCoordinates, data.SetZCoordinates)
        for n, set_coordinates in zip(side, setters):
            set_coordinates(numpy_to_vtk(np.cumsum(0.01 + 0.1 * random.random(n)), deep=True))
    is_of_cells = random.random() < 0.5
    count = data.GetNumberOfCells() if is_of_cells else data.GetNumberOfPoints()
    cells = [n - 1 if is_of_cells else n for n in side]
    index = np.indices(cells[::-1]).reshape(3, -1)[::-1].T / np.array(side)
    assert len(index) == count
    attributes = data.GetCellData() if is_of_cells else data.GetPointData()
    add_arrays(attributes, index, FIELDS[kinds[1]](index, random), types, random)
    return (data if RANK == 0 else vtkPolyData()), is_of_cells


def blocks(kinds, types, random):
    return blocks_of(*(cloud(kinds, types, random, 0.7 * i * types[2]) for i in range(int(random.integers(2, 5)))))


def choose(random, *options):
    return options[int(random.integers(len(options)))]


def configured(number, filter_class):
    """A filter with the input of a combination, and with those of its options that the filter has."""
    random = np.random.default_rng(number)
    kinds = (
        choose(random, "uniform", "uniform", "clustered", "lattice", "coarse", "lines", "slab",
               "coplanar"),
        choose(random, "waves", "distance", "cube", "sheets", "step", "noise", "integers"),
    )
    types = (
        choose(random, np.float32, np.float64),
        choose(random, np.float32, np.float64, np.int16),
        choose(random, 1.0, 1.0, 1e-9, 1e12),
        choose(random, 0.0, 0.0, 1000.0),
    )
    isopoints = filter_class()
    isopoints.SetController(RANKS)
    is_of_cells = False
    kind = choose(random, "cloud", "cloud", "cloud", "image", "blocks")
    if kind == "image":
        data, is_of_cells = image(kinds, types, random)
    else:
        data = (blocks if kind == "blocks" else cloud)(kinds, types, random)
    isopoints.SetInputData(data)
    isopoints.SetInputArrayToProcess(0, 0, 0, 1 if is_of_cells else 0, "values")
    for i in range(int(random.integers(1, 4))):
        isopoints.SetValue(i, choose(random, 0.0, 0.1, 0.3, 0.5, 1.0, float(random.normal())))
    options = {
        "Angle": choose(random, 54.7, 54.7, 20.0, 0.0, 90.0),
        "Projection": choose(random, 3, 3, 4, 4, 2, 1, 0),
        "NormalMethod": int(random.integers(2)),
        "DropGaps": choose(random, 0, 0, 1, 1),
        "NumberOfNeighbors": int(random.integers(3, 20)),
        "OutputPointsPrecision": int(random.integers(3)),
        "ContourBlocks": int(random.random() < 0.3),
        "KeepTree": int(random.random() < 0.8),
        "Regularize": choose(random, 0, 1),
    }
    for name in ("Normals", "Splats", "Scalars", "Gradients", "ProjectionOrders"):
        options["Compute" + name] = int(random.random() < 0.7)
    for name, value in options.items():
        if hasattr(isopoints, "Set" + name):
            getattr(isopoints, "Set" + name)(value)
    return isopoints, random


def update(isopoints, digest):
    """Adds the filter's output to a hash; returns the number of points."""
    isopoints.Update()
    points = 0
    digest.update(b"%d %d" % (isopoints.GetNumberOfSkippedSamples(), isopoints.GetNumberOfUnprojectedPoints()))
    for leaf in leaves_of(isopoints.GetOutputDataObject(0)):
        count = leaf.GetNumberOfPoints() if leaf else 0
        points += count
        digest.update(b"leaf %d" % count)
        if count == 0:
            continue
        digest.update(b"verts %d" % leaf.GetNumberOfVerts())
        if leaf.GetNumberOfPolys() > 0:
            digest.update(vtk_to_numpy(leaf.GetPolys().GetConnectivityArray()).tobytes())
        digest.update(str(leaf.GetPoints().GetDataType()).encode())
        digest.update(vtk_to_numpy(leaf.GetPoints().GetData()).tobytes())
        for attributes in (leaf.GetPointData(), leaf.GetCellData()):
            for i in range(attributes.GetNumberOfArrays()):
                array = attributes.GetAbstractArray(i)
                digest.update(f"{array.GetName()} {array.GetDataType()} "
                              f"{attributes.IsArrayAnAttribute(i)}".encode())
                if isinstance(array, vtkStringArray):
                    digest.update(" ".join(array.GetValue(k) for k in range(count)).encode())
                else:
                    digest.update(vtk_to_numpy(array).tobytes())
    return points


def of_all_ranks(digest):
    """The hash of the ranks' hashes, on the first one."""
    if SIZE == 1:
        return digest.hexdigest()
    own, all_of_them = vtkUnsignedCharArray(), vtkUnsignedCharArray()
    for byte in digest.digest():
        own.InsertNextValue(byte)
    RANKS.Gather(own, all_of_them, 0)
    return hashlib.sha256(vtk_to_numpy(all_of_them).tobytes()).hexdigest() if RANK == 0 else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, default in (("N", 200), ("FIRST", 0)):
        parser.add_argument(name, nargs="?", type=int, default=default, help=f"default: {default}")
    arguments = parser.parse_args()
    for number in range(arguments.FIRST, arguments.FIRST + arguments.N):
        line = [str(number)]
        for filter_class in (vtkScatteredIsopointFilter, vtkScatteredIsosurfaceFilter):
            isopoints, random = configured(number, filter_class)
            digest = hashlib.sha256()
            points = update(isopoints, digest)
            # Another isovalue from the kept tree.
            isopoints.SetValue(0, float(random.normal()))
            points += update(isopoints, digest)
            line += [str(points), of_all_ranks(digest)[:32]]
        if RANK == 0:
            print(*line, flush=True)


if __name__ == "__main__":
    main()
