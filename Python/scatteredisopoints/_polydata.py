# SPDX-License-Identifier: GPL-3.0-or-later
"""Isosurfaces as data of VTK or PyVista."""

from __future__ import annotations

import importlib
import importlib.util
import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Collection, Iterator, Mapping, Optional

import numpy as np

if TYPE_CHECKING:
    from ._isosurface import Isosurface


@dataclass
class PolyDataMaker:
    """Makes the same data as the compiled filters."""

    package: Optional[str] = None
    """That has VTK's classes; None: whichever is installed."""

    wraps: bool = False
    """Whether the result is a pyvista.PolyData."""

    scalars: Optional[str] = None
    """The name of the values."""

    uses: Mapping[str, int] = field(default_factory=dict)
    """Arrays that are an attribute: vectors, texture coordinates, ..."""

    field_data: Any = None
    """Arrays of the whole input, a vtkFieldData."""

    normals: Optional[str] = "Normals"
    """The name of computed normals; None: there are none, and an array of this name is one of the samples."""

    id_types: Collection[str] = ()
    """Arrays of the type vtkIdType."""

    def __getstate__(self) -> dict[str, Any]:
        return {**vars(self), "field_data": None}  # VTK's objects cannot be pickled

    def __call__(self, surface: Isosurface, shares_memory: bool = False) -> Any:
        """The data: a copy, unless nothing else uses the arrays' memory any more."""
        package = self.package or _installed_package()
        model = importlib.import_module(package + ".vtkCommonDataModel")
        core = importlib.import_module(package + ".vtkCommonCore")
        support = importlib.import_module(package + ".util.numpy_support")
        id_type = core.vtkIdTypeArray().GetDataType()

        def ids(numbers: np.ndarray):
            # A copy: vtkCellArray keeps the memory of ids alive, but not the array that owns NumPy's.
            return support.numpy_to_vtk(numbers, deep=True, array_type=id_type)

        def cells(corners: np.ndarray):
            offsets = np.arange(len(corners) + 1, dtype=np.int64) * corners.shape[1]
            result = model.vtkCellArray()
            result.SetData(ids(offsets), ids(corners.ravel()))
            return result

        def arrays(named: Mapping[str, np.ndarray], id_types: Collection[str] = ()) -> Iterator[Any]:
            for name, array in named.items():
                if shares_memory:
                    array = _unlocked(array)
                is_id_type = name in id_types and array.dtype == np.int64
                yield as_vtk(package, name, array, id_type if is_id_type else None)

        data = model.vtkPolyData()
        points = core.vtkPoints()
        points.SetData(*arrays({"Points": surface.points}))
        data.SetPoints(points)
        if surface.triangles is not None:
            data.SetPolys(cells(surface.triangles))
        else:
            data.SetVerts(cells(np.arange(len(surface.points), dtype=np.int64)[:, None]))
        attributes = data.GetPointData()
        for array in arrays(surface.arrays, self.id_types):
            index = attributes.AddArray(array)
            if array.GetName() in self.uses:
                attributes.SetActiveAttribute(index, self.uses[array.GetName()])
        if self.scalars in surface.arrays:
            attributes.SetActiveScalars(self.scalars)
        if self.normals in surface.arrays:
            attributes.SetActiveNormals(self.normals)
        for shapes in arrays(surface.splat_shapes):
            shapes.GetInformation().Set(core.vtkAbstractArray.GUI_HIDE(), 1)
            data.GetCellData().AddArray(shapes)
        for array in arrays(surface.cell_arrays):
            data.GetCellData().AddArray(array)
        if "SplatAxis" in surface.splat_shapes:
            data.GetCellData().SetActiveVectors("SplatAxis")  # transforms of points rotate them
        if self.field_data is not None:
            data.GetFieldData().ShallowCopy(self.field_data)
        if self.wraps:
            return importlib.import_module("pyvista").PolyData(data)
        return data


def locked(array: np.ndarray) -> np.ndarray:
    """A view of the same memory that stays read-only: NumPy refuses to make it writable."""
    return np.asarray(memoryview(array).toreadonly())


def _unlocked(array: np.ndarray) -> np.ndarray:
    """The array that locked() was called for."""
    return getattr(array.base, "obj", array)


def as_vtk(package: str, name: str, array: np.ndarray, data_type: Optional[int] = None) -> Any:
    """A VTK array that shares the memory and keeps it alive. Copies layouts that VTK does not have, and
    read-only arrays, into which VTK would write. Tensors become vectors."""
    support = importlib.import_module(package + ".util.numpy_support")
    table = array if array.ndim < 3 else array.reshape(len(array), math.prod(array.shape[1:]))
    result = support.numpy_to_vtk(np.require(table, requirements=["C", "W"]), array_type=data_type)
    result.SetName(name)
    return result


def _installed_package() -> str:
    for package in ("vtkmodules", "cvista"):
        if importlib.util.find_spec(package) is not None:
            return package
    raise ImportError("polydata needs VTK: pip install vtk, or pip install pyvista. The attributes"
                      " points, normals, radii, triangles and arrays need NumPy alone.")
