# SPDX-License-Identifier: GPL-3.0-or-later
"""Isosurfaces of NumPy arrays and data sets in one call: see contour()."""

from __future__ import annotations

import re
import warnings
from dataclasses import dataclass
from typing import Any, Iterable, Mapping, Optional, Union

import numpy as np
from vtkmodules.numpy_interface import dataset_adapter
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_STRING, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPolyData

from .vtkScatteredIsopointFilters import (
    vtkScatteredContourFilter, vtkScatteredIsopointFilter, vtkScatteredIsosurfaceFilter)


@dataclass(frozen=True)
class Isosurface:
    """What contour() extracted. All arrays share the memory of `polydata`."""

    polydata: vtkPolyData
    """Points, vertices or triangles, and all arrays, for VTK; pyvista.wrap() takes it as well."""

    are_triangles: bool
    """Whether triangles were extracted, or points alone."""

    @property
    def points(self) -> np.ndarray:
        """Positions in the units of the input: shape (n, 3), of float32 or float64."""
        points = self.polydata.GetPoints()
        if points is None:
            return np.zeros((0, 3), np.float32)
        return vtk_to_numpy(points.GetData()).reshape(-1, 3)

    @property
    def normals(self) -> Optional[np.ndarray]:
        """Unit normals towards decreasing values: shape (n, 3); None if they were not computed."""
        return self.arrays.get("Normals")

    @property
    def radii(self) -> Optional[np.ndarray]:
        """Radii of splats in the units of positions: shape (n,); None if not computed."""
        return self.arrays.get("Radius")

    @property
    def triangles(self) -> Optional[np.ndarray]:
        """Indices of points, shape (m, 3), counterclockwise seen from lower values; None of points."""
        if not self.are_triangles:
            return None
        if self.polydata.GetNumberOfPolys() == 0:
            return np.zeros((0, 3), np.int64)
        return vtk_to_numpy(self.polydata.GetPolys().GetConnectivityArray()).reshape(-1, 3)

    @property
    def arrays(self) -> dict[str, np.ndarray]:
        """All numeric arrays of the points that have a name, by that: shape (n,) or (n, components)."""
        data = self.polydata.GetPointData()
        found = (data.GetArray(i) for i in range(data.GetNumberOfArrays()))
        return {array.GetName(): vtk_to_numpy(array) for array in found if array and array.GetName()}

    def __len__(self) -> int:
        return self.polydata.GetNumberOfPoints()


def contour(
    positions: Any,
    values: Any = None,
    isovalues: Union[float, Iterable[float]] = 0.0,
    *,
    triangles: bool = False,
    arrays: Optional[Mapping[str, Any]] = None,
    **options: Any,
) -> Isosurface:
    """Extracts isosurfaces from scattered samples, as points or as triangles.

    Parameters
    ----------
    positions
        The samples' positions, shape (n, 3), in any unit of length. Arrays of native float32 or
        float64 in C order are not copied. Or a data set in place of arrays: any VTK data object that
        the filters take, an object of PyVista, or one of vedo.
    values
        The samples' values, shape (n,), of any real type; integers count as rounded. Samples with a
        value that is not finite or masked are left out. Of a data set: the name of an array of
        its points or cells, an array with one value for each point or cell, or None for the active
        scalars of its points.
    isovalues
        One or several (any iterable), in the unit of the values.
    triangles
        Whether to connect points by triangles (vtkScatteredIsosurfaceFilter) instead of giving them
        radii (vtkScatteredIsopointFilter).
    arrays
        Further arrays of the samples by name, shapes (n,) or (n, components), which are interpolated.
        Not of a data set, which has its own.
    options
        Properties of the filter in snake case, as `drop_gaps=False`, `projection="CREASE_FIT"`,
        `compute_gradients=True`. docs/properties.md lists them. On several ranks each process
        contours its own samples, unless `controller` is given: then all ranks have to call this
        together, and an error is raised on the first one alone.

    Raises
    ------
    ValueError, TypeError
        If arguments have a wrong shape or type, or an option is unknown.
    RuntimeError
        With the filter's message, if it reports an error.

    What the filter warns of or notes, such as skipped samples, is a RuntimeWarning.
    """
    filter_class = vtkScatteredIsosurfaceFilter if triangles else vtkScatteredIsopointFilter
    isopoints = filter_class()
    data = _data_object(positions)
    if data is None:
        isopoints.SetInputData(_samples(positions, values, {} if arrays is None else arrays))
    elif arrays:
        raise TypeError("arrays go with an array of positions: add them to the data set instead")
    else:
        _set_input(isopoints, data, values)
    chosen = _isovalues(isovalues)
    isopoints.SetNumberOfContours(len(chosen))
    for i, isovalue in enumerate(chosen):
        isopoints.SetValue(i, isovalue)
    for name, value in options.items():
        _set_option(isopoints, name, value)
    _update(isopoints)
    output = vtkPolyData()
    output.ShallowCopy(isopoints.GetOutput())
    return Isosurface(output, triangles)


def _isovalues(isovalues: Any) -> list[float]:
    if isovalues is None or isinstance(isovalues, (str, bytes)):
        raise TypeError(f"isovalues are {isovalues!r}, not numbers")
    if np.ndim(isovalues) == 0 and not hasattr(isovalues, "__iter__"):
        return [float(isovalues)]
    if isinstance(isovalues, np.ma.MaskedArray):
        isovalues = isovalues.compressed()
    return [float(value) for value in np.ravel(list(isovalues))]


def _data_object(source: Any) -> Optional[vtkDataObject]:
    """The VTK data of a data set or of an object that wraps one; None of arrays."""
    if isinstance(source, vtkDataObject):
        return source
    if isinstance(source, (np.ndarray, list, tuple)):
        return None
    for name in ("dataset", "VTKObject", "inputdata", "polydata"):  # vedo, and VTK's adapters
        wrapped = getattr(source, name, None)
        if callable(wrapped) and not isinstance(wrapped, vtkDataObject):
            wrapped = wrapped()
        if isinstance(wrapped, vtkDataObject):
            return wrapped
    return None


def _samples(positions: Any, values: Any, arrays: Mapping[str, Any]) -> vtkPolyData:
    place = _real_array("positions", positions)
    if place.ndim != 2 or place.shape[1] != 3:
        raise ValueError(
            f"positions have the shape {place.shape}, not (n, 3): for samples in a plane append zeros")
    if values is None:
        raise TypeError("values are missing: one for each position")
    if place.dtype.kind != "f":
        place = place.astype(np.float64)
    points = vtkPoints()
    points.SetData(_as_vtk(place))
    data = vtkPolyData()
    data.SetPoints(points)
    data.GetPointData().SetScalars(_named("values", values, len(place), one_component=True))
    if not isinstance(arrays, Mapping) or not all(isinstance(name, str) for name in arrays):
        raise TypeError("arrays are to be a mapping of names to arrays")
    for name, array in arrays.items():
        if name == "values":
            raise ValueError('an array cannot have the name "values", which is that of the values')
        data.GetPointData().AddArray(_named(name, array, len(place)))
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
        length = len(_real_array("values", values))
        if length not in counts:
            raise ValueError(
                f"{length} values for a data set of {counts[0]} points and {counts[1]} cells")
        is_of_cells = length != counts[0]
        copy = data.NewInstance()
        copy.ShallowCopy(data)
        attributes = copy.GetCellData() if is_of_cells else copy.GetPointData()
        attributes.AddArray(_named("values", values, length, one_component=True))
        isopoints.SetInputData(copy)
        isopoints.SetInputArrayToProcess(0, 0, 0, cells if is_of_cells else points, "values")


def _real_array(name: str, array: Any) -> np.ndarray:
    """An array of a type that VTK has, in C order; masked places are NaN."""
    if isinstance(array, np.ma.MaskedArray) and np.ma.is_masked(array):
        array = array.astype(np.result_type(array.dtype, np.float32)).filled(np.nan)
    result = np.asarray(array)
    if result.dtype.kind == "b":
        result = result.astype(np.uint8)
    elif result.dtype == np.float16:
        result = result.astype(np.float32)
    elif result.dtype.kind == "f" and result.dtype.itemsize > 8:
        result = result.astype(np.float64)
    if result.dtype.kind not in "fiu":
        raise TypeError(f"{name} are of the type {result.dtype}, not real numbers")
    return np.ascontiguousarray(result, dtype=result.dtype.newbyteorder("="))


def _named(name: str, array: Any, count: int, one_component: bool = False):
    values = _real_array(name, array)
    if one_component and values.ndim == 2 and values.shape[1] == 1:
        values = values.ravel()
    if values.ndim not in (1, 2) or len(values) != count or (one_component and values.ndim != 1):
        wanted = f"({count},)" if one_component else f"({count},) or ({count}, components)"
        raise ValueError(f"{name} have the shape {values.shape}, not {wanted}")
    result = _as_vtk(values)
    result.SetName(name)
    return result


def _as_vtk(array: np.ndarray):
    """A VTK array of the same memory, which it keeps alive."""
    if not array.flags.writeable:
        array = array.copy()  # numpy_to_vtk() refuses it
    return numpy_to_vtk(array)


def _options_of(isopoints: vtkScatteredContourFilter) -> dict[str, str]:
    """The methods that set the filter's properties, by the properties' names in snake case."""
    base = next(c for c in type(isopoints).__mro__ if not c.__name__.startswith("vtkScattered"))
    inherited = set(dir(base))
    # Outputs are one vtkPolyData, and a controller is an option of its own.
    others = {"SetValue", "SetNumberOfContours", "SetContourBlocks", "SetUseGlobalController"}
    return {
        re.sub(r"(?<!^)(?=[A-Z])", "_", method[3:]).lower(): method
        for method in dir(isopoints)
        if method.startswith("Set") and "To" not in method[3:] and method not in inherited | others
    }


# The constants that can be named, of properties with such.
_CONSTANTS = {
    "projection": r"NO_PROJECTION|[A-Z]+_FIT",
    "normal_method": r"[A-Z]+_NORMALS|NORMALS_FROM_[A-Z]+",
}


def _set_option(isopoints: vtkScatteredContourFilter, name: str, value: Any) -> None:
    methods = _options_of(isopoints)
    if name not in methods:
        raise TypeError(f"unknown option {name}; there are {', '.join(sorted(methods))}")
    given = value
    if isinstance(value, str):
        isNamed = re.fullmatch(_CONSTANTS.get(name, "(?!)"), value.upper())
        value = getattr(isopoints, value.upper(), None) if isNamed else None
        if value is None:
            raise ValueError(f"{name} cannot be {given!r}")
    getattr(isopoints, methods[name])(value)
    if name in _CONSTANTS and getattr(isopoints, "G" + methods[name][1:])() != value:
        raise ValueError(f"{name} cannot be {given!r}")


def _update(isopoints: vtkScatteredContourFilter) -> None:
    """Runs the filter. @throws RuntimeError with what it reports"""
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
    isopoints.Update()
    for text in cautions:
        warnings.warn(text, RuntimeWarning, stacklevel=3)
    if errors:
        raise RuntimeError("\n".join(errors))
