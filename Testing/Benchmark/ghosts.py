# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the time of another isovalue of a grid of hexahedra with ghost cells to that without.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 Testing/Benchmark/ghosts.py

Extracts points alone at 31 isovalues from both grids in turn. Prints the median of the seconds of
each, elapsed and of the processor, and their ratio.
"""

import argparse
import statistics
import time

import numpy as np
from scatteredisopoints import vtkScatteredIsopointFilter
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkImageData
from vtkmodules.vtkFiltersCore import vtkAppendFilter


def new_filter(side, has_ghosts):
    image = vtkImageData()
    image.SetDimensions(side, side, side)
    append = vtkAppendFilter()  # of an image it makes an unstructured grid
    append.AddInputData(image)
    append.Update()
    grid = append.GetOutput()
    z, y, x = np.mgrid[:side, :side, :side] - side / 2
    distances = numpy_to_vtk(np.sqrt(x * x + y * y + z * z).ravel().astype(np.float32), deep=True)
    grid.GetPointData().SetScalars(distances)
    if has_ghosts:
        flags = np.zeros(grid.GetNumberOfCells(), np.uint8)
        flags[:: side - 1] = vtkDataSetAttributes.DUPLICATECELL
        ghosts = numpy_to_vtk(flags, deep=True)
        ghosts.SetName(vtkDataSetAttributes.GhostArrayName())
        grid.GetCellData().AddArray(ghosts)
    isopoints = vtkScatteredIsopointFilter()
    isopoints.SetInputData(grid)
    isopoints.SetProjection(vtkScatteredIsopointFilter.NO_PROJECTION)
    isopoints.ComputeNormalsOff()
    isopoints.ComputeSplatsOff()
    isopoints.SetValue(0, side / 4)
    isopoints.Update()
    return isopoints


def main(side):
    filters = [new_filter(side, has_ghosts) for has_ghosts in (False, True)]
    elapsed, processor = ([], []), ([], [])
    for run in range(31):
        for i in (0, 1) if run % 2 else (1, 0):
            filters[i].SetValue(0, side / 4 + 0.001 * side * (run + 1))
            before = time.perf_counter(), time.process_time()
            filters[i].Update()
            elapsed[i].append(time.perf_counter() - before[0])
            processor[i].append(time.process_time() - before[1])
    print(f"| {side**3} points | without ghosts, s | with ghosts, s | ratio |")
    print("|---|---|---|---|")
    for name, seconds in (("elapsed", elapsed), ("processor", processor)):
        without, with_ghosts = map(statistics.median, seconds)
        print(f"| {name} | {without:.4f} | {with_ghosts:.4f} | {with_ghosts / without:.2f} |")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--side", type=int, default=110, help="points along each axis; default: 110")
    main(parser.parse_args().side)
