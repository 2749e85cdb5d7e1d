# SPDX-License-Identifier: GPL-3.0-or-later
"""The samples of data sets of VTK, and of packages with its classes (PyVista, cvista, vedo).

Only calls methods of the objects, so that any of these packages works. docs/properties.md in the source defines which
points and cells are samples.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, Callable, Iterable, Iterator, Mapping, Optional, Sequence

import numpy as np

from ._arrays import (
    CELL, FLOAT, ID_TYPE, POINT, are_names, as_numpy, checksum, module_of, package_of, positions_of, readable,
    shape_error, values_of)
from ._ghosts import cell_arrays, excluded_cells, excluded_points, ghosts_of
from ._library import Message
from ._lines_and_grids import lattice
from ._polydata import PolyDataMaker

# As in vtkDataSetAttributes::AttributeTypes.
SCALARS, GLOBAL_IDS, PEDIGREE_IDS, PROCESS_IDS = 0, 5, 6, 11


@dataclass
class DataSamples:
    """The samples of arrays or a data object. Positions and arrays of one data set are VTK's: see
    as_numpy()."""

    positions: Any
    values: Any  # None: without
    excluded: Optional[np.ndarray]  # bool; None without ghosts
    arrays: Optional[dict[str, Any]]  # None: the caller passes arrays for each isosurface
    maker: PolyDataMaker
    without_array: int = 0  # points or cells of blocks without the array
    differing: tuple[str, ...] = ()  # arrays that not all blocks have alike
    of_text: tuple[str, ...] = ()  # arrays without numbers
    masked: Optional[np.ndarray] = None  # bool: which values are masked; None without any
    name: str = ""  # of the values, for messages
    association: int = POINT  # of the first block
    are_float: bool = True  # whether the values of all blocks are float32, and isovalues in the output too
    parts: list[Part] = field(default_factory=list)  # one for each block of a data object
    ids: dict[str, int] = field(default_factory=dict)  # arrays with ids: types of attribute that they are, or -1


@dataclass(frozen=True)
class Part:
    """Which points or cells of a data object are a block of samples."""

    leaf: int  # its number among leaves()
    association: int
    count: int


def data_object(source: Any) -> Any:
    """The data object that an object is or wraps (vedo); None for arrays. Raises TypeError for a filter."""
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
    if hasattr(source, "GetOutputDataObject"):
        raise TypeError(f"A {source.GetClassName()} is no data set: call Update() and give its GetOutput().")
    return None


def is_of_pyvista(data: Any) -> bool:
    """Whether a data object belongs to PyVista rather than VTK."""
    return any(base.__module__.startswith("pyvista.") for base in type(data).__mro__)


def leaf_iterators(composite: Any) -> Iterator[Any]:
    """An iterator of VTK at each data set of a composite."""
    iterator = composite.NewIterator()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        yield iterator
        iterator.GoToNextItem()


def leaves(data: Any) -> Iterator[Any]:
    """The data sets of a composite, or the data set itself."""
    if data.IsA("vtkCompositeDataSet"):
        yield from (each.GetCurrentDataObject() for each in leaf_iterators(data))
    else:
        yield data


def bounds_of(data: Any) -> np.ndarray:
    """The bounds of all points, in the shape (3, 2). Raises NoSamplesError if there are none."""
    boxes = [_box_of(leaf) for leaf in leaves(data) if leaf.IsA("vtkDataSet") and leaf.GetNumberOfPoints() > 0]
    if not boxes:
        raise NoSamplesError()
    return np.stack([np.min(boxes, axis=0)[:, 0], np.max(boxes, axis=0)[:, 1]], axis=1)


def _box_of(leaf: Any) -> np.ndarray:
    """GetBounds(), which misses changes that VTK has no notice of, in the shape (3, 2)."""
    if leaf.IsA("vtkImageData"):
        return np.reshape(leaf.GetBounds(), (3, 2))
    axes = (map(as_numpy, _coordinates(leaf)) if leaf.IsA("vtkRectilinearGrid") else
            as_numpy(leaf.GetPoints().GetData()).T)
    return np.array([(np.fmin.reduce(axis), np.fmax.reduce(axis)) for axis in axes], np.float64)


def state_of(data: Any) -> tuple:
    """A value that changes when VTK notices a change of the data object, and when points or cells are blanked."""
    fields = data.GetFieldData()  # a composite's own, which the output has
    state = [(fields.__this__, fields.GetMTime())]
    for leaf in leaves(data):
        times = [leaf.GetMTime()]
        if leaf.IsA("vtkDataSet"):  # blanking changes flags in place
            marks = (ghosts_of(leaf, association) for association in (POINT, CELL))
            times += [checksum(each) for each in marks if each is not None]
        if leaf.IsA("vtkRectilinearGrid"):
            times += [axis.GetMTime() for axis in _coordinates(leaf)]
        state.append((leaf.__this__, *times))
    return tuple(state)


def contents_of(data: Any, values: Optional[str]) -> tuple:
    """A value that changes with state_of(), and when NumPy changes what samples are loaded from, of which VTK has no
    notice: coordinates, cells and the array of this name. The samples of a composite are copies of all arrays."""
    is_composite = data.IsA("vtkCompositeDataSet")
    sums = []
    for leaf in leaves(data):
        if not leaf.IsA("vtkDataSet"):
            continue
        arrays = list(_coordinates(leaf)) if leaf.IsA("vtkRectilinearGrid") else []
        if leaf.IsA("vtkPointSet") and leaf.GetPoints() is not None:
            arrays.append(leaf.GetPoints().GetData())
        for cells in cell_arrays(leaf):
            arrays += [cells.GetOffsetsArray(), cells.GetConnectivityArray()]
        for association in (POINT, CELL):
            arrays += [array for name, array, _ in named_arrays(leaf.GetAttributes(association))
                       if is_composite or name == values]
        sums.append(tuple(checksum(as_numpy(array)) for array in arrays))
    return (state_of(data), *sums)


def samples_with_values(
    source: Any, values: Any, associations: Optional[tuple[int, ...]] = None, attribute: int = SCALARS,
    are_values: bool = True,
) -> DataSamples:
    """The samples of an array of positions, or of a data object.

    Parameters
    ----------
    values
        One number per position, or None. Of a data object: the name of a point or cell array, one number per point
        or cell of a data set, or None for the active array.
    associations
        POINT, CELL or both: where an array is looked for, in this order. None: a name at both, the active
        array at the points.
    attribute
        Which array is active, as in vtkDataSetAttributes::AttributeTypes.
    are_values
        False: the array of a data object, of any components, determines the samples, which have no values or arrays.
    """
    data = data_object(source)
    if data is None:
        positions = positions_of(source)
        numbers, masked = (None, None) if values is None else values_of(values, len(positions))
        return DataSamples(positions, numbers, None, None, PolyDataMaker(scalars="values"), masked=masked)
    are_given = not (values is None or isinstance(values, str))
    if are_given and data.IsA("vtkCompositeDataSet"):
        raise _needs_name(data)
    if associations is None:
        associations = (POINT,) if values is None else (POINT, CELL)

    def block_of(leaf: Any) -> Optional[DataSamples]:
        if are_given:
            association = association_of(data, np.shape(values))
            numbers, masked = values_of(values, data.GetNumberOfElements(association))
            return replace(_block(leaf, association, numbers), masked=masked)
        found = _find(leaf, values, associations, attribute)
        return None if found is None else _block(leaf, *found, are_values)

    def describe(leaf: Any) -> str:
        elements = _elements(associations)
        wanted = f"active {elements} scalars" if values is None else f"{elements} array named {_quoted([values])}"
        return f"The input has no {wanted}. {_choice_of(leaf)}"

    return _gathered(data, block_of, describe, with_arrays=are_values)


def samples_with_arrays(data: Any, names: Sequence[str], associations: tuple[int, ...]) -> DataSamples:
    """The samples of a data object without values, at the points or cells with arrays of all these names."""
    lacking = set(names)

    def block_of(leaf: Any) -> Optional[DataSamples]:
        for association in associations:
            count = leaf.GetNumberOfElements(association)
            found = {name for name, array, _ in named_arrays(leaf.GetAttributes(association))
                     if array.GetNumberOfTuples() == count}
            lacking.difference_update(found)
            if found.issuperset(names) and (found or len(associations) == 1):
                return _block(leaf, association, None)
        return None

    def describe(leaf: Any) -> str:
        if names and not lacking:
            return (f"The arrays {_quoted(names)} are in different blocks, or some are of points and others of cells:"
                    " give them in separate calls.")
        for name in (each for each in names if each in lacking):
            if (found := _find(leaf, name, associations, SCALARS)) is not None:
                _block(leaf, *found, are_values=False, marks_text=True)  # raises an error that says what is wrong
        named = f"array named {_quoted(each for each in names if each in lacking)}" if names else "array of numbers"
        return f"The input has no {_elements(associations)} {named}. {_choice_of(leaf, True)}"

    return _gathered(data, block_of, describe)


def samples_without_values(
        data: Any, with_arrays: bool, associations: tuple[int, ...] = (POINT, CELL)) -> DataSamples:
    """The samples of a data object without values: of each data set its points or cells, the first of these with
    arrays of numbers, or else the first."""

    def block_of(leaf: Any) -> DataSamples:
        with_numbers = (each for each in associations
                        if any(use != GLOBAL_IDS for _, _, use in named_arrays(leaf.GetAttributes(each))))
        return _block(leaf, next(with_numbers, associations[0]), None)

    samples = _gathered(data, block_of, lambda _: "The input has no samples. Connect a data set with points.",
                        with_arrays)
    samples.maker.scalars = None
    return samples


def _gathered(data: Any, block_of: Callable[[Any], Optional[DataSamples]], describe: Callable[[Any], str],
              with_arrays: bool = True) -> DataSamples:
    """The samples of all blocks for which there are some. Of a block without, the other function says what lacks."""
    if not (data.IsA("vtkDataSet") or data.IsA("vtkCompositeDataSet")):
        remedy = ("convert it to points first" if data.IsA("vtkTable") else
                  "apply vtkHyperTreeGridCellCenters first" if data.IsA("vtkHyperTreeGrid") else
                  "convert it to a data set first")
        raise TypeError(f"A {data.GetClassName()} has no samples: {remedy}.")
    blocks, lacking, without_array = [], None, 0
    for number, leaf in enumerate(leaves(data)):
        size = max(leaf.GetNumberOfPoints(), leaf.GetNumberOfCells()) if leaf.IsA("vtkDataSet") else 0
        if size == 0:
            continue
        block = block_of(leaf)
        if block is not None:
            block.parts = [Part(number, block.association, leaf.GetNumberOfElements(block.association))]
            if not with_arrays:
                block.arrays, block.of_text = {}, ()
            blocks.append(block)
        else:
            without_array += size
            lacking = leaf if lacking is None else lacking
    if not blocks:
        raise NoSamplesError() if lacking is None else NoSamplesError(describe(lacking), without_array)
    samples = blocks[0] if len(blocks) == 1 else _joined(blocks)
    samples.without_array = without_array
    samples.maker.scalars = samples.maker.scalars or "values"
    samples.maker.package, samples.maker.wraps = package_of(data), is_of_pyvista(data)
    samples.maker.field_data = module_of(data, "vtkCommonDataModel").vtkFieldData()
    samples.maker.field_data.ShallowCopy(data.GetFieldData())
    return samples


def _needs_name(data: Any) -> TypeError:
    return TypeError(f"values of a {data.GetClassName()} have to be one of its arrays: give its name")


def association_of(data: Any, shape: tuple[int, ...]) -> int:
    """Whether an array of this shape is of points or of cells."""
    if not hasattr(data, "GetCellData"):
        raise _needs_name(data)
    points, cells = (data.GetNumberOfElements(association) for association in (POINT, CELL))
    if len(shape) > 0 and shape[0] not in (points, cells):
        given = f"{shape[0]} values" if len(shape) == 1 else f"values of the shape {shape}"
        raise ValueError(f"{given} for a data set of {points} points and {cells} cells: there is to be one for each")
    return CELL if shape[:1] == (cells,) and cells != points else POINT


def _find(leaf: Any, name: Optional[str], associations: tuple[int, ...], attribute: int
          ) -> Optional[tuple[int, Any]]:
    """The array of this name, or the active one, and its association."""
    for association in associations:
        attributes = leaf.GetAttributes(association)
        array = (attributes.GetAbstractAttribute(attribute) if name is None else
                 attributes.GetAbstractArray(name))
        if array is not None:
            return association, array
    return None


class NoSamplesError(ValueError):
    """A data object has no points, no cells or no array of values."""

    def __init__(self, text: str = "The input has no points or cells. Give a data set with points.",
                 without_array: int = 0):
        super().__init__(text)
        self.without_array = without_array  # points or cells


def describe_without_array(count: int, name: str) -> Message:
    """A message about points or cells of blocks."""
    return Message(f"{count} points or cells are left out: their blocks do not have the array.",
                   is_warning=False, cause=f"blocks without {name}")


def describe_differing(names: Iterable[str]) -> str:
    """A message about arrays that not all blocks have."""
    return f"Left out are {_quoted(names)}: not all blocks have these arrays with the same type and components."


def describe_text(names: Iterable[str]) -> str:
    """A message about arrays without numbers."""
    return f"Left out are {_quoted(names)}: they hold no numbers."


def _quoted(names: Iterable[str]) -> str:
    return ", ".join(f'"{name}"' for name in names)


def _elements(associations: tuple[int, ...]) -> str:
    return " or ".join(("point", "cell")[association] for association in sorted(associations))


def _choice_of(leaf: Any, marks_text: bool = False) -> str:
    """The remedy for a wrong array: lists those of a data set, perhaps with a mark at those of text, which the messages
    of filters do not have."""

    def names(attributes: Any) -> str:
        found = [attributes.GetArrayName(i) for i in range(attributes.GetNumberOfArrays())]
        of_text = _names_of_text(attributes) if marks_text else ()
        return ", ".join(f"{each} (text)" if each in of_text else each or "(unnamed)"
                         for each in found if each != "vtkGhostType") or "none"

    of_points, of_cells = names(leaf.GetPointData()), names(leaf.GetCellData())
    if of_points == of_cells == "none":
        return "There are no arrays: load point or cell arrays in the reader."
    return f"Choose a scalar array; the point arrays are: {of_points}; the cell arrays are: {of_cells}."


def _block(leaf: Any, association: int, scalars: Any, are_values: bool = True, marks_text: bool = False
           ) -> DataSamples:
    name, count = "values", leaf.GetNumberOfElements(association)
    if not (scalars is None or isinstance(scalars, np.ndarray)):
        name = scalars.GetName() or ""
        if not hasattr(scalars, "GetDataTypeSize") or not scalars.IsA("vtkDataArray"):
            raise TypeError(f'The array "{name}" holds no numbers. {_choice_of(leaf, marks_text)}')
        if are_values and scalars.GetNumberOfComponents() != 1:
            raise ValueError(f'The array "{name}" has {scalars.GetNumberOfComponents()} components,'
                             " but a scalar array has one. Compute a component or the magnitude first.")
        if scalars.GetNumberOfTuples() != count:
            raise ValueError(f'The array "{name}" has {scalars.GetNumberOfTuples()} values for {count}'
                             f" {'cells' if association == CELL else 'points'}. {_choice_of(leaf)}")
    if association == CELL:
        positions, excluded = _cell_centers(leaf), excluded_cells(leaf)
    else:
        positions, excluded = point_positions(leaf), excluded_points(leaf)
    arrays, uses, ids, id_types = {}, {}, {}, set()
    for key, array, use in named_arrays(leaf.GetAttributes(association)):
        if array.GetNumberOfTuples() != count:
            continue
        if has_ids(array, use):
            ids[key] = use
            id_types.update([key] if has_ids(array) else [])
        if array is not scalars:
            arrays[key] = array
            if use not in (-1, GLOBAL_IDS):  # several points may have the id of one sample
                uses[key] = use
    maker = PolyDataMaker(scalars=name or None, uses=uses, id_types=id_types)
    return DataSamples(positions, scalars if are_values else None, excluded, arrays, maker, association=association,
                       of_text=_names_of_text(leaf.GetAttributes(association)), ids=ids,
                       name="" if scalars is None or isinstance(scalars, np.ndarray) else name)


def has_ids(array: Any, use: int = -1) -> bool:
    """Whether an array has ids: by its type of attribute, or of the type vtkIdType. NumPy's arrays have none."""
    return use in (GLOBAL_IDS, PEDIGREE_IDS, PROCESS_IDS) or (
        hasattr(array, "GetDataType") and array.GetDataType() == ID_TYPE)


def _names_of_text(attributes: Any) -> tuple[str, ...]:
    """The names of arrays without numbers."""
    arrays = map(attributes.GetAbstractArray, range(attributes.GetNumberOfArrays()))
    return tuple(array.GetName() for array in arrays if array.GetName() and not array.IsA("vtkDataArray"))


def named_arrays(attributes: Any) -> Iterator[tuple[str, Any, int]]:
    """The numeric arrays that have a name, except ghosts: their names and types of attribute, or -1."""
    for i in range(attributes.GetNumberOfArrays()):
        array = attributes.GetArray(i)
        if array is not None and array.GetName() not in (None, "vtkGhostType"):
            yield array.GetName(), array, attributes.IsArrayAnAttribute(i)


def _joined(blocks: list[DataSamples]) -> DataSamples:
    """The samples of all blocks, with the arrays that all have."""
    positions = [positions_of(as_numpy(block.positions)) for block in blocks]
    first, *others = [{key: as_numpy(array) for key, array in (block.arrays or {}).items()}
                      for block in blocks]
    arrays = {key: np.concatenate([array, *(other[key] for other in others)])
              for key, array in first.items()
              if all(key in other and other[key].dtype == array.dtype
                     and other[key].shape[1:] == array.shape[1:] for other in others)}
    differing = {key: None for names in (first, *others) for key in names if key not in arrays}
    uses = {key: use for key, use in blocks[0].maker.uses.items()
            if key in arrays and all(block.maker.uses.get(key) == use for block in blocks)}
    ids = {key: use for block in blocks for key, use in block.ids.items()}
    id_types = set.union(*(set(block.maker.id_types) for block in blocks))
    name = next(filter(None, (block.name for block in blocks)), "")
    excluded = [np.zeros(len(place), bool) if block.excluded is None else block.excluded
                for block, place in zip(blocks, positions)]
    values = [as_numpy(block.values) for block in blocks if block.values is not None]
    return DataSamples(np.concatenate(positions), np.concatenate(values) if values else None,
                       np.concatenate(excluded), arrays,
                       PolyDataMaker(scalars=name or None, uses=uses, id_types=id_types),
                       differing=tuple(differing), name=name, ids=ids,
                       of_text=tuple(dict.fromkeys(each for block in blocks for each in block.of_text)),
                       are_float=all(each.dtype == np.float32 for each in values),
                       parts=[part for block in blocks for part in block.parts])


def place_positions(places: Any) -> tuple[np.ndarray, tuple[int, ...]]:
    """Places with shape (n, 3), those of a data set at its points; and the shape of places without their last axis."""
    data = data_object(places)
    if data is not None and not data.IsA("vtkDataSet"):
        remedy = ("pass its blocks one by one, or combine them first" if data.IsA("vtkCompositeDataSet") else
                  "pass positions, shape (n, 3)")
        raise TypeError(f"A {data.GetClassName()} has no points of its own: {remedy}.")
    numbers = readable("places", places if data is None else as_numpy(point_positions(data)))
    if numbers.shape == (0,):
        numbers = numbers.reshape(0, 3)
    if numbers.shape[-1:] == (3,):
        return positions_of(numbers.reshape(-1, 3), "places"), numbers.shape[:-1]
    raise shape_error("places", numbers.shape, "(..., 3)")


def point_positions(leaf: Any) -> Any:
    """The points of a data set, with shape (n, 3): VTK's array of a point set, of any type, or NumPy's."""
    if leaf.IsA("vtkImageData"):
        return _image_positions(leaf, [np.arange(low, high + 1.0) for low, high in _extent(leaf)])
    if leaf.IsA("vtkRectilinearGrid"):
        return lattice([as_numpy(axis).astype(np.float64) for axis in _coordinates(leaf)])
    points = leaf.GetPoints()
    return np.zeros((0, 3), np.float32) if points is None else points.GetData()


def _extent(image: Any) -> np.ndarray:
    """The least and the greatest index along each axis."""
    return np.reshape(image.GetExtent(), (3, 2))


def _coordinates(grid: Any) -> tuple[Any, Any, Any]:
    return grid.GetXCoordinates(), grid.GetYCoordinates(), grid.GetZCoordinates()


def _image_positions(image: Any, indices: list[np.ndarray], origin: Any = None) -> np.ndarray:
    """Positions at continuous indices, equal to VTK's to the last bit. An origin replaces the image's."""
    matrix = image.GetIndexToPhysicalMatrix()
    x, y, z = lattice(indices).T
    positions = np.empty((len(x), 3))
    for row in range(3):
        a, b, c, d = (matrix.GetElement(row, i) for i in range(4))
        positions[:, row] = a * x + b * y + c * z + (d if origin is None else origin[row])
    return positions


def _cell_centers(leaf: Any) -> np.ndarray:
    if leaf.IsA("vtkImageData"):
        # An image with the cell centers as points: its origin is the center of the first cell.
        halfway = [np.array([0.5 if low < high else 0.0]) for low, high in _extent(leaf)]
        origin = _image_positions(leaf, halfway)[0]
        return _image_positions(
            leaf, [np.arange(low, max(high, low + 1.0)) for low, high in _extent(leaf)], origin)
    if leaf.IsA("vtkRectilinearGrid"):
        axes = [as_numpy(axis).astype(np.float64) for axis in _coordinates(leaf)]
        return lattice([0.5 * axis[:-1] + 0.5 * axis[1:] if len(axis) > 1 else axis for axis in axes])
    if leaf.GetNumberOfPoints() == 0:
        raise ValueError("The input has cells, but no points: its cells have no centers. Connect data with"
                         " points.")
    centers = module_of(leaf, "vtkCommonCore").vtkDoubleArray()
    centers.SetNumberOfComponents(3)
    centers.SetNumberOfTuples(leaf.GetNumberOfCells())
    module_of(leaf, "vtkFiltersCore").vtkCellCenters.ComputeCellCenters(leaf, centers)
    is_float = leaf.IsA("vtkPointSet") and leaf.GetPoints().GetDataType() == FLOAT
    return as_numpy(centers).astype(np.float32 if is_float else np.float64, copy=False)


def samples_for_call(source: Any, values: Any, associations: tuple[int, ...] = (POINT, CELL)) -> DataSamples:
    """The samples for calls on arrays, without values, so that each array keeps those it has."""
    data = data_object(source)
    if data is None:
        return samples_with_values(source, None)
    if isinstance(values, str) or are_names(values):
        return samples_with_arrays(data, [values] if isinstance(values, str) else values, associations)
    first = next(iter(values.values()), None) if isinstance(values, Mapping) else values
    if first is None:
        return samples_without_values(data, with_arrays=True)
    return samples_with_arrays(data, (), (association_of(data, np.shape(first)),))
