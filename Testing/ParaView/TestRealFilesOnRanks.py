# SPDX-License-Identifier: GPL-3.0-or-later
"""Real files, where a folder with them is available: the ranks yield together, bit for bit, what one
process does. mpirun -n N pvbatch --symmetric TestRealFilesOnRanks.py FOLDER DATA

Each rank has a consecutive part of the points, or of the boxes of an AMR, so that the order of all
samples is that of the file."""

import os
import sys

import numpy as np
from scatteredisopoints import vtkScatteredIsopointFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkOverlappingAMR, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLGenericDataObjectReader, vtkXMLUniformGridAMRReader

from TestRanks import ALL_ARRAYS, RANK, RANKS, SIZE, gather

SKIPPED = 77

# file, array, isovalue
CLOUDS = [
    ("volumes/engine_256x256x128_uint8.vti", "scalar", 80.0),
    ("volumes/headsq_64x64x93_uint16.vti", None, 500.0),
    ("scattered/sph_water_jet.vtp", "speed", 33.0),
    ("scattered/ctd_southern_ocean_TS.vtp", "temperature_degC", 2.0),
    ("scattered/amr_spcth_leafcells.vtp", "volume_fraction_total", 0.5),
    ("unstructured/disk_out_ref.vtu", "Temp", 400.0),
    ("multiblock/bluntfin.vts", "Density", 1.0),
]
AMR = ("amr/HierarchicalBoxDataset.v1.1.vthb", "Fractal Volume Fraction", 0.5)


def part_of(count, rank, size):
    return slice(rank * count // size, (rank + 1) * count // size)


def cloud(path, array, rank, size):
    """Points of a file with their arrays."""
    reader = vtkXMLGenericDataObjectReader()
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutput()
    count = data.GetNumberOfPoints()
    part = part_of(count, rank, size)
    if hasattr(data, "GetPoints") and data.GetPoints():
        positions = vtk_to_numpy(data.GetPoints().GetData())[part]
    else:
        positions = np.array([data.GetPoint(i) for i in range(part.start, part.stop)])
    result = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(positions, deep=True))
    result.SetPoints(points)
    for i in range(data.GetPointData().GetNumberOfArrays()):
        values = data.GetPointData().GetArray(i)
        own = numpy_to_vtk(vtk_to_numpy(values)[part], deep=True)
        own.SetName(values.GetName())
        result.GetPointData().AddArray(own)
        if array is None and values.GetNumberOfComponents() == 1:
            array = values.GetName()
    result.GetPointData().SetActiveScalars(array)
    return result


def boxes(path, rank, size):
    reader = vtkXMLUniformGridAMRReader()
    reader.SetFileName(path)
    reader.SetMaximumLevelsToReadByDefault(0)
    reader.Update()
    whole = reader.GetOutput()
    data = vtkOverlappingAMR()
    data.CopyStructure(whole)
    places = [(level, box) for level in range(whole.GetNumberOfLevels())
              for box in range(whole.GetNumberOfDataSets(level))]
    for level, box in places[part_of(len(places), rank, size)]:
        data.SetDataSet(level, box, whole.GetDataSet(level, box))
    return data


def described(output):
    """The points with all arrays as rows of bytes, sorted, and the names of the arrays."""
    arrays = sorted((output.GetPointData().GetArray(i)
                     for i in range(output.GetPointData().GetNumberOfArrays())),
                    key=lambda array: array.GetName())
    names = [(array.GetName(), array.GetDataType()) for array in arrays]
    count = output.GetNumberOfPoints()
    if count == 0:
        return names, np.empty(0)
    columns = [np.ascontiguousarray(vtk_to_numpy(array)).view(np.uint8).reshape(count, -1)
               for array in arrays + [output.GetPoints().GetData()]]
    rows = np.ascontiguousarray(np.concatenate(columns, axis=1))
    return names, np.sort(rows.view(np.dtype((np.void, rows.shape[1]))).ravel())


def contour(data, controller, isovalue, cells=None, **options):
    isopoints = vtkScatteredIsopointFilter()
    isopoints.SetController(controller)
    isopoints.SetInputData(data)
    if cells:
        isopoints.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, cells)
    isopoints.SetValue(0, isovalue)
    for name, value in {**ALL_ARRAYS, **options}.items():
        getattr(isopoints, "Set" + name)(value)
    isopoints.Update()
    return described(isopoints.GetOutput())


def is_same(name, read, isovalue, **options):
    parts = gather(contour(read(RANK, SIZE), RANKS, isovalue, **options))
    if RANK > 0:
        return True
    names, rows = contour(read(0, 1), None, isovalue, **options)
    filled = [part[1] for part in parts if len(part[1])]
    found = np.sort(np.concatenate(filled)) if filled else np.empty(0)
    same = all(part[0] == names for part in parts) and found.tobytes() == rows.tobytes()
    print(f"{name}, {SIZE} ranks: {len(found)} points, {[len(part[1]) for part in parts]}, "
          f"{'the same bytes' if same and len(rows) else 'DIFFERENT'}", flush=True)
    return same and len(rows) > 0


def main(folder):
    if not os.path.isdir(folder):
        print("skipped: there is no folder", folder)
        sys.exit(SKIPPED)
    same = True
    for name, array, isovalue in CLOUDS:
        path = os.path.join(folder, name)
        same &= is_same(
            name, lambda rank, size: cloud(path, array, rank, size), isovalue)  # noqa: B023
    name, array, isovalue = AMR
    path = os.path.join(folder, name)
    same &= is_same(name, lambda rank, size: boxes(path, rank, size), isovalue, cells=array)
    print("passed" if same else "failed: other points", flush=True)
    if not same:
        os._exit(1)  # the other ranks may wait for this one


main(sys.argv[-1])
