# SPDX-License-Identifier: GPL-3.0-or-later
"""contour() by the compiled filters, if installed: for all kinds of data, and for process groups."""

from __future__ import annotations

import errno
import importlib
import re
import signal
import threading
import warnings
from typing import Any, Mapping, Optional

import numpy as np
from vtkmodules.numpy_interface import dataset_adapter
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_STRING, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPolyData

from ._arrays import column, further_arrays, positions_of, readable, values_of
from ._datasets import is_of_pyvista
from ._isosurface import Isosurface
from ._options import constant, make_options, snake_case, switch
from ._polydata import PolyDataMaker
from ._progress import Progress, shown_progress
from .vtkScatteredIsopointFilters import (
    vtkScatteredContourFilter, vtkScatteredIsopointFilter, vtkScatteredIsosurfaceFilter)


def filtered(
    source: Any,
    values: Any,
    isovalues: list[float],
    triangles: bool,
    arrays: Optional[Mapping[str, Any]],
    progress: Progress,
    options: Mapping[str, Any],
) -> Isosurface:
    """contour() of a data object of vtkmodules, or of arrays."""
    triangles = switch("triangles", triangles)
    isopoints = vtkScatteredIsosurfaceFilter() if triangles else vtkScatteredIsopointFilter()
    if not isinstance(source, vtkDataObject):
        isopoints.SetInputData(_samples(source, values, arrays))
    elif arrays:
        raise TypeError("arrays go with an array of positions: add them to the data set instead")
    else:
        _set_input(isopoints, source, values)
    isopoints.SetNumberOfContours(len(isovalues))
    for i, isovalue in enumerate(isovalues):
        isopoints.SetValue(i, isovalue)
    make_options(triangles, {name: value for name, value in options.items()
                             if name not in ("controller", "use_all_cores")})
    for name, value in options.items():
        _set_option(isopoints, name, value)
    with shown_progress(progress, "Contouring") as report:
        _update(isopoints, report)
    output = vtkPolyData()
    output.ShallowCopy(isopoints.GetOutput())
    if is_of_pyvista(source):
        output = importlib.import_module("pyvista").PolyData(output)
    return _isosurface(output, triangles)


def _isosurface(data: vtkPolyData, are_triangles: bool) -> Isosurface:
    points, triangles = np.zeros((0, 3), np.float32), None
    if data.GetPoints() is not None:
        points = vtk_to_numpy(data.GetPoints().GetData()).reshape(-1, 3)
    if are_triangles:
        triangles = np.zeros((0, 3), np.int64)
        if data.GetNumberOfPolys() > 0:
            triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    scalars = data.GetPointData().GetScalars()
    maker = PolyDataMaker("vtkmodules", is_of_pyvista(data), scalars and scalars.GetName())
    return Isosurface(points, triangles, _arrays(data.GetPointData()), _arrays(data.GetCellData()),
                      maker, data)


def _arrays(attributes: Any) -> dict[str, np.ndarray]:
    found = (attributes.GetArray(i) for i in range(attributes.GetNumberOfArrays()))
    return {array.GetName(): vtk_to_numpy(array) for array in found if array and array.GetName()}


def _samples(positions: Any, values: Any, arrays: Optional[Mapping[str, Any]]) -> vtkPolyData:
    place = positions_of(positions)
    points = vtkPoints()
    points.SetData(_as_vtk("positions", place))
    data = vtkPolyData()
    data.SetPoints(points)
    data.GetPointData().SetScalars(_as_vtk("values", values_of(values, len(place))))
    for name, array in further_arrays(arrays, len(place)).items():
        data.GetPointData().AddArray(_as_vtk(name, array))
    return data


def _set_input(isopoints: vtkScatteredContourFilter, data: vtkDataObject, values: Any) -> None:
    points, cells = vtkDataObject.FIELD_ASSOCIATION_POINTS, vtkDataObject.FIELD_ASSOCIATION_CELLS
    if values is None:
        isopoints.SetInputData(data)
    elif isinstance(values, str):
        isopoints.SetInputData(data)
        attributes = dataset_adapter.WrapDataObject(data)
        of_points = getattr(attributes, "PointData", None)
        of_cells = getattr(attributes, "CellData", None)
        is_of_cells = (of_cells is not None and values in of_cells.keys()
                       and not (of_points is not None and values in of_points.keys()))
        isopoints.SetInputArrayToProcess(0, 0, 0, cells if is_of_cells else points, values)
    else:
        if not hasattr(data, "GetCellData"):
            raise TypeError(
                f"values of a {data.GetClassName()} have to be one of its arrays: give its name")
        counts = [data.GetNumberOfElements(association) for association in (points, cells)]
        length = len(readable("values", values))
        if length not in counts:
            raise ValueError(
                f"{length} values for a data set of {counts[0]} points and {counts[1]} cells")
        is_of_cells = length != counts[0]
        copy = data.NewInstance()
        copy.ShallowCopy(data)
        attributes = copy.GetCellData() if is_of_cells else copy.GetPointData()
        attributes.AddArray(_as_vtk("values", column("values", values, length, one_component=True)))
        isopoints.SetInputData(copy)
        isopoints.SetInputArrayToProcess(0, 0, 0, cells if is_of_cells else points, "values")


def _as_vtk(name: str, array: np.ndarray):
    """A VTK array that shares the memory, and keeps it alive. Copies layouts that VTK does not have."""
    array = np.ascontiguousarray(array)
    if not array.flags.writeable:
        array = array.copy()  # numpy_to_vtk() refuses its layout
    result = numpy_to_vtk(array)
    result.SetName(name)
    return result


def _options_of(isopoints: vtkScatteredContourFilter) -> dict[str, str]:
    """The filter's setters, by the names of their properties in snake case."""
    base = next(c for c in type(isopoints).__mro__ if not c.__name__.startswith("vtkScattered"))
    inherited = set(dir(base))
    # contour() itself determines these.
    others = {"SetValue", "SetNumberOfContours", "SetContourBlocks", "SetUseGlobalController"}
    return {
        snake_case(method[3:]): method
        for method in dir(isopoints)
        if method.startswith("Set") and "To" not in method[3:] and method not in inherited | others
    }


def _set_option(isopoints: vtkScatteredContourFilter, name: str, value: Any) -> None:
    methods = _options_of(isopoints)
    if name not in methods:
        raise TypeError(f"unknown option {name}; there are {', '.join(sorted(methods))}")
    number = constant(name, value)
    getattr(isopoints, methods[name])(number)
    # Setters clamp.
    if number is not None and name != "controller":
        if getattr(isopoints, "G" + methods[name][1:])() != number:
            raise ValueError(f"{name} is {value!r}, which is out of range.")


def _update(isopoints: vtkScatteredContourFilter, report: Any) -> None:
    """Runs the filter. Raises the errors that it reports and those of `report`. Ctrl-C ends it."""
    raised: list[BaseException] = []

    def end(error: BaseException) -> None:
        raised.append(error)
        isopoints.SetAbortExecute(1)

    def advance(caller, _event):
        try:
            if report is not None and not raised:
                report(caller.GetProgress())
        except BaseException as error:
            end(error)

    isopoints.AddObserver("ProgressEvent", advance)
    errors: list[str] = []
    cautions: list[str] = []

    def watch(event: str, messages: list[str]):
        def note(_caller, _event, text):
            messages.append(re.sub(r"^(ERROR|Warning):[^\n]*\n[^\n]*?\): ", "", text).strip())

        note.CallDataType = VTK_STRING
        for source in (isopoints, isopoints.GetExecutive()):
            source.AddObserver(event, note)

    watch("ErrorEvent", errors)
    watch("WarningEvent", cautions)
    watch("MessageEvent", cautions)
    # VTK prints exceptions in observers, so Python's handler must not raise one there.
    is_replaced = signal.getsignal(signal.SIGINT) is signal.default_int_handler and (
        threading.current_thread() is threading.main_thread())
    if is_replaced:
        signal.signal(signal.SIGINT, lambda *_: end(KeyboardInterrupt()))
    try:
        isopoints.Update()
    finally:
        if is_replaced:
            signal.signal(signal.SIGINT, signal.default_int_handler)
    if raised:
        raise raised[0]
    for text in cautions:
        warnings.warn(text, RuntimeWarning, stacklevel=4)
    if errors:
        kinds = {errno.EINVAL: ValueError, errno.ENOMEM: MemoryError}
        raise kinds.get(isopoints.GetErrorCode(), RuntimeError)("\n".join(errors))
