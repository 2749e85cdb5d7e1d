# SPDX-License-Identifier: GPL-3.0-or-later
"""The samples of data sets of VTK, and of packages with its classes (PyVista, cvista, vedo).

Only calls methods of the objects, so that any of these packages works. docs/properties.md defines which
points and cells are samples.
"""

from __future__ import annotations

import importlib
from dataclasses import dataclass
from typing import Any, Iterator, Optional

import numpy as np

from ._arrays import readable
from ._ghosts import excluded_cells, excluded_points

POINT, CELL = 0, 1
# Array types, as in vtkType.h.
BIT, UNSIGNED_CHAR, FLOAT, DOUBLE = 1, 3, 10, 11
UNSIGNED = (UNSIGNED_CHAR, 5, 7, 9, 17)
# Attribute types, as in vtkDataSetAttributes::AttributeTypes.
GLOBAL_IDS, PEDIGREE_IDS = 5, 6


@dataclass
class Block:
    """The samples of one data set."""

    positions: Any
    values: np.ndarray
    excluded: Optional[np.ndarray]  # bool; None without ghosts
    arrays: dict[str, Any]
    uses: dict[str, int]  # types of arrays that are attributes: vectors, texture coordinates, ...


@dataclass
class DataSamples:
    """The samples of all blocks of a data object. With one block, positions and arrays are VTK's; see
    numbers_of()."""

    positions: Any
    values: np.ndarray
    excluded: Optional[np.ndarray]
    name: str  # of the values
    arrays: dict[str, Any]
    uses: dict[str, int]
    without_array: int  # points or cells of blocks without the array
    package: str = ""  # with the data object's class
    is_of_pyvista: bool = False
    field_data: Any = None


def data_object(source: Any) -> Any:
    """The data object that an object is or wraps (vedo); None for arrays."""
    if hasattr(source, "IsA") and hasattr(source, "GetDataObjectType"):
        return source
    if isinstance(source, (np.ndarray, list, tuple)):
        return None
    for name in ("dataset", "VTKObject", "inputdata", "polydata"):
        wrapped = getattr(source, name, None)
        if callable(wrapped) and not hasattr(wrapped, "IsA"):
            wrapped = wrapped()
        if hasattr(wrapped, "IsA"):
            return wrapped
    return None


def package_of(data: Any) -> str:
    """The name of the package with the class of a data object: vtkmodules, cvista."""
    for base in type(data).__mro__:
        package, _, module = base.__module__.rpartition(".")
        if module == "vtkCommonCore":  # has vtkObject; cvista has data objects that name vtkmodules
            return package
    raise TypeError(f"{type(data).__name__} is none of VTK's data objects")


def is_of_pyvista(data: Any) -> bool:
    """Whether a data object belongs to PyVista rather than VTK."""
    return any(base.__module__.startswith("pyvista.") for base in type(data).__mro__)


def module_of(data: Any, name: str) -> Any:
    """A module of the package of a data object."""
    return importlib.import_module(f"{package_of(data)}.{name}")


def leaves(data: Any) -> Iterator[Any]:
    """The data sets of a composite, or the data set itself."""
    if not data.IsA("vtkCompositeDataSet"):
        yield data
        return
    iterator = data.NewIterator()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        yield iterator.GetCurrentDataObject()
        iterator.GoToNextItem()


def as_numpy(array: Any) -> np.ndarray:
    """The numbers of a data array, with shape (n,) or (n, components). Shares its memory if contiguous."""
    kind = array.GetDataType()
    if kind == BIT or not array.HasStandardMemoryLayout():
        kind = UNSIGNED_CHAR if kind == BIT else kind
        copy = module_of(array, "vtkCommonCore").vtkDataArray.CreateDataArray(kind)
        copy.DeepCopy(array)
        array = copy
    letter = "f" if kind in (FLOAT, DOUBLE) else "u" if kind in UNSIGNED else "i"
    dtype = np.dtype(f"{letter}{array.GetDataTypeSize()}")
    count, components = array.GetNumberOfTuples(), array.GetNumberOfComponents()
    numbers = np.frombuffer(array, dtype) if count else np.empty(0, dtype)
    return numbers if components == 1 else numbers.reshape(count, components)


def numbers_of(array: Any) -> np.ndarray:
    """The numbers of a VTK or NumPy array. VTK may reallocate its arrays: do not keep the result after a
    call."""
    return array if isinstance(array, np.ndarray) else as_numpy(array)


def state_of(data: Any) -> tuple:
    """A value that changes when VTK notices a change of the data object."""
    state = []
    for leaf in leaves(data):
        times = [leaf.GetMTime()]
        if leaf.IsA("vtkRectilinearGrid"):
            times += [axis.GetMTime() for axis in _coordinates(leaf)]
        state.append((leaf.__this__, *times))
    return tuple(state)


def samples_of(data: Any, values: Any, prefers_cells: bool = False) -> DataSamples:
    """The samples of a data object.

    Parameters
    ----------
    values
        The name of a point or cell array, one number per point or cell of a data set, or None for the
        active scalars of the points.
    prefers_cells
        Whether a name refers to the cell array if there are both.
    """
    is_supported = data.IsA("vtkDataSet") or data.IsA("vtkCompositeDataSet")
    if not is_supported:
        remedy = ("convert it to points first" if data.IsA("vtkTable") else
                  "apply vtkHyperTreeGridCellCenters first" if data.IsA("vtkHyperTreeGrid") else
                  "convert it to a data set first")
        raise TypeError(f"A {data.GetClassName()} has no samples: {remedy}.")
    given = None if values is None or isinstance(values, str) else readable("values", values)
    if given is not None and not data.IsA("vtkDataSet"):
        raise TypeError(f"values of a {data.GetClassName()} have to be one of its arrays: give its name")
    associations = (CELL, POINT) if prefers_cells else (POINT, CELL)
    blocks, without_array, names = [], 0, []
    name = values if isinstance(values, str) else None
    for leaf in leaves(data):
        size = _size(leaf)
        found = _find(leaf, values, given, associations) if size else None
        if found is None:
            without_array += size
            names += [_array_names(leaf)] if size else []
            continue
        blocks.append(_block(leaf, *found))
        if values is None and name is None:
            name = found[1].GetName()
    if not blocks:
        _raise_nothing(values, names)
    samples = _joined(blocks, name or "values", without_array)
    samples.package, samples.is_of_pyvista = package_of(data), is_of_pyvista(data)
    samples.field_data = module_of(data, "vtkCommonDataModel").vtkFieldData()
    samples.field_data.ShallowCopy(data.GetFieldData())
    return samples


def _size(leaf: Any) -> int:
    is_data_set = leaf.IsA("vtkDataSet")
    return max(leaf.GetNumberOfPoints(), leaf.GetNumberOfCells()) if is_data_set else 0


def _find(leaf: Any, values: Any, given: Optional[np.ndarray], associations: tuple[int, int]
          ) -> Optional[tuple[int, Any]]:
    """The array of a data set's values, of VTK or NumPy, and its association."""
    if given is not None:
        counts = leaf.GetNumberOfPoints(), leaf.GetNumberOfCells()
        if given.ndim == 2 and given.shape[1] == 1:
            given = given[:, 0]
        if given.shape not in [(count,) for count in counts]:
            raise ValueError(f"{len(given)} values for a data set of {counts[0]} points and"
                             f" {counts[1]} cells: there is to be one for each"
                             if given.ndim == 1 else
                             f"values have the shape {given.shape}, not ({counts[0]},)")
        return (POINT if len(given) == counts[POINT] else CELL), given
    if values is None:
        scalars = leaf.GetPointData().GetScalars()
        return (POINT, scalars) if scalars is not None else None
    for association in associations:
        data = leaf.GetPointData() if association == POINT else leaf.GetCellData()
        array = data.GetAbstractArray(values)
        if array is not None:
            return association, array
    return None


def _array_names(leaf: Any) -> tuple[list[str], list[str]]:
    def names(data):
        found = [data.GetArrayName(i) or "(unnamed)" for i in range(data.GetNumberOfArrays())]
        return [name for name in found if name != "vtkGhostType"]
    return names(leaf.GetPointData()), names(leaf.GetCellData())


class NoSamplesError(ValueError):
    """A data object has no points, no cells or no array of values."""


def _raise_nothing(values: Any, names: list[tuple[list[str], list[str]]]) -> None:
    if not names:
        raise NoSamplesError("The input has no points or cells. Give a data set with a scalar array.")
    wanted = "active point scalars" if values is None else f'point or cell array named "{values}"'
    of_points, of_cells = ([", ".join(list_) or "none" for list_ in names[0]])
    raise NoSamplesError(f"The input has no {wanted}. The point arrays are: {of_points}; the cell arrays"
                         f" are: {of_cells}.")


def _block(leaf: Any, association: int, scalars: Any) -> Block:
    of_points = association == POINT
    if not isinstance(scalars, np.ndarray):
        name = scalars.GetName() or ""
        if not hasattr(scalars, "GetDataTypeSize") or not scalars.IsA("vtkDataArray"):
            raise TypeError(f'The array "{name}" holds no numbers.')
        if scalars.GetNumberOfComponents() != 1:
            raise ValueError(f'The array "{name}" has {scalars.GetNumberOfComponents()} components,'
                             " but a scalar array has one. Compute a component or the magnitude first.")
    positions: Any = None
    if of_points and leaf.IsA("vtkPointSet"):
        positions = leaf.GetPoints().GetData()
    else:
        positions = point_positions(leaf) if of_points else _cell_centers(leaf)
    count = leaf.GetNumberOfPoints() if of_points else leaf.GetNumberOfCells()
    values = scalars if isinstance(scalars, np.ndarray) else as_numpy(scalars)
    if len(values) != count:
        raise ValueError(f'The array "{name}" has {len(values)} values for {count}'
                         f" {'points' if of_points else 'cells'}.")
    excluded = excluded_points(leaf, as_numpy) if of_points else excluded_cells(leaf, as_numpy)
    arrays, uses = _further_arrays(leaf.GetPointData() if of_points else leaf.GetCellData(),
                                   scalars, count)
    return Block(positions, values, excluded, arrays, uses)


def _further_arrays(data: Any, scalars: Any, count: int):
    arrays, uses = {}, {}
    for i in range(data.GetNumberOfArrays()):
        array = data.GetArray(i)
        use = data.IsArrayAnAttribute(i)
        if (array is not None and array is not scalars and array.GetNumberOfTuples() == count
                and use != GLOBAL_IDS and array.GetName() not in (None, "vtkGhostType")):
            arrays[array.GetName()] = array
            if use >= 0:
                uses[array.GetName()] = use
    return arrays, uses


def _joined(blocks: list[Block], name: str, without_array: int) -> DataSamples:
    first, *others = blocks
    if not others:
        return DataSamples(first.positions, first.values, first.excluded, name, first.arrays,
                           first.uses, without_array)
    positions = [numbers_of(block.positions) for block in blocks]
    arrays = [{key: numbers_of(array) for key, array in block.arrays.items()} for block in blocks]
    common = [key for key, array in arrays[0].items() if all(
        key in other and other[key].dtype == array.dtype and other[key].shape[1:] == array.shape[1:]
        for other in arrays)]
    uses = {key: use for key, use in first.uses.items()
            if key in common and all(other.uses.get(key) == use for other in others)}
    excluded = None
    if any(block.excluded is not None for block in blocks):
        excluded = np.concatenate([
            np.zeros(len(place), bool) if block.excluded is None else block.excluded
            for block, place in zip(blocks, positions)])
    return DataSamples(
        np.concatenate(positions), np.concatenate([block.values for block in blocks]), excluded, name,
        {key: np.concatenate([of_block[key] for of_block in arrays]) for key in common}, uses,
        without_array)


def point_positions(leaf: Any) -> np.ndarray:
    """The points of a data set, with shape (n, 3)."""
    if leaf.IsA("vtkImageData"):
        extent = leaf.GetExtent()
        return _image_positions(leaf, [np.arange(extent[2 * axis], extent[2 * axis + 1] + 1.0)
                                       for axis in range(3)])
    if leaf.IsA("vtkRectilinearGrid"):
        return _lattice([as_numpy(axis).astype(np.float64) for axis in _coordinates(leaf)])
    points = leaf.GetPoints()
    return np.zeros((0, 3)) if points is None else as_numpy(points.GetData())


def _coordinates(grid: Any) -> tuple[Any, Any, Any]:
    return grid.GetXCoordinates(), grid.GetYCoordinates(), grid.GetZCoordinates()


def _lattice(axes: list[np.ndarray]) -> np.ndarray:
    """All positions with these coordinates, x fastest."""
    z, y, x = np.meshgrid(axes[2], axes[1], axes[0], indexing="ij")
    return np.stack([x.ravel(), y.ravel(), z.ravel()], axis=-1)


def _image_positions(image: Any, indices: list[np.ndarray], origin=None) -> np.ndarray:
    """Positions at continuous indices, equal to VTK's to the last bit.

    Parameters
    ----------
    origin
        Replaces the image's own origin.
    """
    matrix = image.GetIndexToPhysicalMatrix()
    x, y, z = _lattice(indices).T
    positions = np.empty((len(x), 3))
    for row in range(3):
        a, b, c, d = (matrix.GetElement(row, column) for column in range(4))
        positions[:, row] = a * x + b * y + c * z + (d if origin is None else origin[row])
    return positions


def _cell_centers(leaf: Any) -> np.ndarray:
    if leaf.IsA("vtkImageData"):
        # An image with the cell centers as points: its origin is the center of the first cell.
        extent = leaf.GetExtent()
        steps = [extent[2 * axis + 1] > extent[2 * axis] for axis in range(3)]
        halfway = [np.array([0.5 if step else 0.0]) for step in steps]
        origin = _image_positions(leaf, halfway)[0]
        return _image_positions(leaf, [
            np.arange(extent[2 * axis], extent[2 * axis + 1] + (0.0 if steps[axis] else 1.0))
            for axis in range(3)], origin)
    if leaf.IsA("vtkRectilinearGrid"):
        axes = [as_numpy(axis).astype(np.float64) for axis in _coordinates(leaf)]
        return _lattice([0.5 * axis[:-1] + 0.5 * axis[1:] if len(axis) > 1 else axis for axis in axes])
    if leaf.GetNumberOfPoints() == 0:
        raise ValueError("The data set has cells, but no points: its cells have no centers.")
    centers = module_of(leaf, "vtkCommonCore").vtkDoubleArray()
    centers.SetNumberOfComponents(3)
    centers.SetNumberOfTuples(leaf.GetNumberOfCells())
    module_of(leaf, "vtkFiltersCore").vtkCellCenters.ComputeCellCenters(leaf, centers)
    positions = as_numpy(centers)
    points = leaf.GetPoints() if leaf.IsA("vtkPointSet") else None
    is_float = points is not None and points.GetDataType() == FLOAT
    return positions.astype(np.float32) if is_float else positions
