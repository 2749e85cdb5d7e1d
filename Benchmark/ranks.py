# SPDX-License-Identifier: GPL-3.0-or-later
"""The filter on the ranks of MPI, or in a plain process, on random samples of a sphere:

pvbatch ranks.py SAMPLES [all] [triangles]
mpirun -n N pvbatch --symmetric ranks.py SAMPLES [all] [triangles]

Points or triangles alone, or with "all" fits, normals and radii. Each rank uses one thread. Prints the seconds
and processor seconds of the slowest rank for the first isovalue, for another one and for new values
at the same positions, and the largest peak of memory of any rank, all included."""

import os
import sys
import time

os.environ["VTK_SMP_MAX_THREADS"] = "1"  # noqa: E402

import common
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkParallelCore import vtkCommunicator, vtkMultiProcessController

RANKS = vtkMultiProcessController.GetGlobalController()
SIZE = RANKS.GetNumberOfProcesses() if RANKS else 1
RANK = RANKS.GetLocalProcessId() if RANKS else 0
CHUNK = 1 << 20  # samples that are made at once, so that the peak is the filter's


def reduced(values, operation):
    if SIZE == 1:
        return values
    own = numpy_to_vtk(np.asarray(values, dtype=float), deep=True)
    all_of_them = numpy_to_vtk(np.zeros(len(values)), deep=True)
    RANKS.AllReduce(own, all_of_them, operation)
    return list(vtk_to_numpy(all_of_them))


def samples(count):
    """This rank's samples: any number of ranks have the same cloud together."""
    begin, end = RANK * count // SIZE, (RANK + 1) * count // SIZE
    positions, values = vtkFloatArray(), vtkFloatArray()
    positions.SetNumberOfComponents(3)
    positions.SetNumberOfTuples(end - begin)
    values.SetNumberOfTuples(end - begin)
    values.SetName("distance")
    place, distance = vtk_to_numpy(positions), vtk_to_numpy(values)
    for chunk in range(begin // CHUNK, (end + CHUNK - 1) // CHUNK):
        first, last = max(chunk * CHUNK, begin), min((chunk + 1) * CHUNK, end)
        points = np.random.default_rng(chunk).random((CHUNK, 3), dtype=np.float32)
        points = points[first - chunk * CHUNK:last - chunk * CHUNK]
        place[first - begin:last - begin] = points
        distance[first - begin:last - begin] = np.sqrt(((points - 0.5) ** 2).sum(1))
    data = vtkPolyData()
    vtk_points = vtkPoints()
    vtk_points.SetData(positions)
    data.SetPoints(vtk_points)
    data.GetPointData().SetScalars(values)
    return data


def peak_memory():
    return common.memory("VmHWM:") / 1024**2


def timed(what, isopoints):
    if SIZE > 1:
        RANKS.Barrier()
    wall, processor = time.perf_counter(), time.process_time()
    isopoints.Update()
    took = [time.perf_counter() - wall, time.process_time() - processor, peak_memory()]
    wall, processor, memory = reduced(took, vtkCommunicator.MAX_OP)
    points = reduced([isopoints.GetOutput().GetNumberOfPoints()], vtkCommunicator.SUM_OP)[0]
    if RANK == 0:
        print(f"{what}: {wall:.2f} s, processor {processor:.2f} s, peak {memory:.0f} MB, "
              f"{points:.0f} points", flush=True)


def main(count, everything, kind):
    data = samples(count)
    if RANK == 0:
        print(f"{SIZE} ranks, {count} samples; input made: peak {peak_memory():.0f} MB", flush=True)
    isopoints = common.configured(
        kind(), data, 1.0 / 3.0, Controller=RANKS, UseAllCores=False, **({} if everything else common.alone()))
    timed("first", isopoints)
    isopoints.SetValue(0, 0.35)
    timed("another isovalue", isopoints)
    values = data.GetPointData().GetScalars()
    vtk_to_numpy(values)[:] += np.float32(0.01)
    values.Modified()
    data.Modified()
    timed("new values", isopoints)


main(int(float(sys.argv[1])), "all" in sys.argv[2:],
     common.TRIANGLES if "triangles" in sys.argv[2:] else common.POINTS)
