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
from vtkmodules.vtkCommonCore import VTK_STRING, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPolyData

from ._arrays import CELL, POINT, as_numpy, describe_masked, further_arrays, positions_of, values_of
from ._datasets import given_values, is_of_pyvista, leaves, named_arrays, point_positions
from ._ghosts import HIDDEN_CELL, HIDDEN_POINT, ghosts_of
from ._isosurface import Isosurface
from ._options import constant, direction_sign, make_options, property_name, switch
from ._polydata import PolyDataMaker, as_vtk
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
        isopoints.SetInputData(_cloud(source, values, arrays))
    elif arrays:
        raise TypeError("arrays go with an array of positions: add them to the data set instead")
    else:
        _set_input(isopoints, source, values)
    isopoints.SetNumberOfContours(len(isovalues))
    for i, isovalue in enumerate(isovalues):
        isopoints.SetValue(i, isovalue)
    make_options(triangles, {name: value for name, value in options.items()
                             if name not in ("controller", "use_all_cores")})
    options = {**options}
    if direction_sign(options.pop("gradient_direction", "descent")) < 0:
        raise TypeError("gradient_direction does not work with a controller: contour the negated values")
    for name, value in options.items():
        number = constant(name, value)
        getattr(isopoints, "Set" + property_name(name))(number)
        # Setters clamp.
        if name != "controller" and getattr(isopoints, "Get" + property_name(name))() != number:
            raise ValueError(f"{name} is {value!r}, which is out of range.")
    with shown_progress(progress, "Contouring") as report:
        _update(isopoints, report)
    output = vtkPolyData()
    output.ShallowCopy(isopoints.GetOutput())
    if is_of_pyvista(source):
        output = importlib.import_module("pyvista").PolyData(output)
    return _isosurface(output, triangles, isovalues)


def _isosurface(data: vtkPolyData, are_triangles: bool, levels: list[float]) -> Isosurface:
    triangles = None
    if are_triangles:
        triangles = as_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    of_points, of_cells = ({name: as_numpy(array) for name, array, _ in named_arrays(attributes)}
                           for attributes in (data.GetPointData(), data.GetCellData()))
    scalars = data.GetPointData().GetScalars()
    maker = PolyDataMaker("vtkmodules", is_of_pyvista(data), scalars and scalars.GetName())
    caps = {name: of_cells.pop(name) for name in ("IsCap",) if name in of_cells}
    return Isosurface(as_numpy(point_positions(data)), triangles, of_points, of_cells, maker, data, cell_arrays=caps,
                      levels=levels, is_capped=bool(caps))


def _cloud(positions: Any, values: Any, arrays: Optional[Mapping[str, Any]]) -> vtkPolyData:
    place = positions_of(positions)
    points = vtkPoints()
    points.SetData(as_vtk("vtkmodules", "Points", place))
    data = vtkPolyData()
    data.SetPoints(points)
    numbers, masked = values_of(values, len(place))
    data.GetPointData().SetScalars(as_vtk("vtkmodules", "values", numbers))
    _hide(data, POINT, masked)
    for name, array in further_arrays(arrays, len(place)).items():
        data.GetPointData().AddArray(as_vtk("vtkmodules", name, array))
    return data


def _set_input(isopoints: vtkScatteredContourFilter, data: vtkDataObject, values: Any) -> None:
    if isinstance(values, str):
        def has(association: int) -> bool:
            found = (leaf.GetAttributes(association) for leaf in leaves(data))
            return any(attributes is not None and attributes.HasArray(values) for attributes in found)

        association = CELL if has(CELL) and not has(POINT) else POINT
        isopoints.SetInputArrayToProcess(0, 0, 0, association, values)
    elif values is not None:
        association, numbers, masked = given_values(data, values)
        copy = data.NewInstance()
        copy.ShallowCopy(data)
        copy.GetAttributes(association).AddArray(as_vtk("vtkmodules", "values", numbers))
        _hide(copy, association, masked)
        data = copy
        isopoints.SetInputArrayToProcess(0, 0, 0, association, "values")
    isopoints.SetInputData(data)


def _hide(data: vtkDataObject, association: int, masked: Optional[np.ndarray]) -> None:
    """Marks points or cells with masked values as hidden, and warns of them."""
    if masked is None:
        return
    marks = np.where(masked, HIDDEN_CELL if association == CELL else HIDDEN_POINT, 0).astype(np.uint8)
    before = ghosts_of(data, association)
    data.GetAttributes(association).AddArray(
        as_vtk("vtkmodules", "vtkGhostType", marks if before is None else marks | before))
    warnings.warn(describe_masked(masked), RuntimeWarning, stacklevel=5)


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
    for event, texts in (("ErrorEvent", errors), ("WarningEvent", cautions), ("MessageEvent", cautions)):
        def note(_caller, _event, text, texts=texts):
            texts.append(re.sub(r"^(ERROR|Warning):[^\n]*\n[^\n]*?\): ", "", text).strip())

        note.CallDataType = VTK_STRING
        for source in (isopoints, isopoints.GetExecutive()):
            source.AddObserver(event, note)
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
