# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the time of another isovalue of a grid of hexahedra with ghost cells to that without.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 Benchmark/ghosts.py

Extracts points alone at 31 isovalues from both grids in turn. Prints the median of the seconds of
each, elapsed and of the processor, and their ratio.
"""

import common
import numpy as np
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
    distances = np.sqrt(x * x + y * y + z * z).ravel().astype(np.float32)
    grid.GetPointData().SetScalars(numpy_to_vtk(distances, deep=True))
    if has_ghosts:
        flags = np.zeros(grid.GetNumberOfCells(), np.uint8)
        flags[:: side - 1] = vtkDataSetAttributes.DUPLICATECELL
        ghosts = numpy_to_vtk(flags, deep=True)
        ghosts.SetName(vtkDataSetAttributes.GhostArrayName())
        grid.GetCellData().AddArray(ghosts)
    isopoints = common.configured(common.POINTS(), grid, side / 4, **common.alone())
    isopoints.Update()
    return isopoints


parser = common.parser_of(__doc__)
common.add_numbers(parser, side=110)
side = parser.parse_args().side
filters = [new_filter(side, has_ghosts) for has_ghosts in (False, True)]
taken = [], []
for run in range(31):
    for i in (0, 1) if run % 2 else (1, 0):
        filters[i].SetValue(0, side / 4 + 0.001 * side * (run + 1))
        taken[i].append(common.timed(filters[i].Update))
common.print_head(f"{side**3} points", "without ghosts, s", "with ghosts, s", "ratio")
for name, without, with_ghosts in zip(("elapsed", "processor"), *(np.median(each, axis=0) for each in taken)):
    common.print_row(name, f"{without:.4f}", f"{with_ghosts:.4f}", f"{with_ghosts / without:.2f}")
