# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays of NumPy and VTK, for the C library."""

from __future__ import annotations

import importlib
import os
from numbers import Number
from typing import Any, Iterable, Mapping, Optional, Union

import numpy as np

# As in vtkType.h and vtkDataObject::FieldAssociations.
BIT, UNSIGNED_CHAR, FLOAT, ID_TYPE = 1, 3, 10, 12
POINT, CELL = 0, 1

MAPPING_NEEDED = "arrays are a mapping of names, which are strings, to arrays"


def package_of(vtk_object: Any) -> str:
    """The name of the package with the class of an object of VTK: vtkmodules, cvista."""
    for base in type(vtk_object).__mro__:
        package, _, module = base.__module__.rpartition(".")
        if module == "vtkCommonCore":  # has vtkObject; cvista has data objects that name vtkmodules
            return package
    raise TypeError(f"{type(vtk_object).__name__} is none of VTK's data objects")


def module_of(vtk_object: Any, name: str) -> Any:
    """A module of the package of an object."""
    return importlib.import_module(f"{package_of(vtk_object)}.{name}")


def as_numpy(array: Any) -> np.ndarray:
    """The numbers of an array of VTK or NumPy, which shares its memory if contiguous.

    VTK's arrays get the shape (n,) or (n, components). They may be reallocated: do not keep the result
    after a call.
    """
    if isinstance(array, np.ndarray):
        return array
    is_bits = array.GetDataType() == BIT
    if is_bits or not array.HasStandardMemoryLayout():  # vtk_to_numpy() reads neither in all versions
        copy = module_of(array, "vtkCommonCore").vtkDataArray.CreateDataArray(
            UNSIGNED_CHAR if is_bits else array.GetDataType())
        copy.DeepCopy(array)
        array = copy
    return module_of(array, "util.numpy_support").vtk_to_numpy(array)


def checksum(array: np.ndarray) -> int:
    """A hash of the type, the shape and the bytes of an array, equal for two different ones once in 2^61. Takes a few
    percent of the time of loading them as samples."""
    rows = 1 << 15  # so that copies fit in a cache
    parts = (array[i:i + rows].tobytes() for i in range(0, len(array), rows))
    return hash((array.dtype.str, array.shape, *map(hash, parts)))


def readable(name: str, array: Any) -> np.ndarray:
    """Converts an array to a type and layout that the library reads (no zero strides); masked entries
    become NaN. Raises TypeError for types without an order, such as complex numbers or text."""
    is_masked = isinstance(array, np.ma.MaskedArray) and array.dtype.kind in "fiub"
    if is_masked and np.ma.is_masked(array):
        array = array.astype(np.result_type(array.dtype, np.float32)).filled(np.nan)
    try:
        result = np.asarray(array)
    except ValueError as error:  # of lists of different lengths
        raise ValueError(f"{name} are no array of numbers: {error}") from None
    if result.dtype == bool:
        result = result.astype(np.uint8)
    elif result.dtype == np.float16:
        result = result.astype(np.float32)
    elif result.dtype.kind == "f" and result.dtype.itemsize > 8:
        result = result.astype(np.float64)
    if result.dtype.kind == "O" and result.ndim == 0:
        raise TypeError(f"{name} cannot be {'None' if array is None else 'a ' + type(array).__name__}: give numbers")
    if result.dtype.kind not in "fiu":
        remedy = {"O": ": convert them, as by astype(float)", "U": ": names are strings, for arrays of a data set"}.get(
            result.dtype.kind, "")
        raise TypeError(f"{name} are of the type {result.dtype}, not real numbers{remedy}")
    result = np.asarray(result, dtype=result.dtype.newbyteorder("="))
    if 0 in result.strides or not result.flags.aligned:
        result = np.array(result, order="C")
    return result


def shape_error(name: str, shape: tuple[int, ...], wanted: str) -> ValueError:
    """An error about positions of a wrong shape."""
    remedy = (f"for {name} in a plane append zeros" if shape[1:] == (2,) else
              f"pass numpy.transpose({name})" if len(shape) == 2 and shape[0] == 3 and shape[1] > 0 else
              "pass three coordinates of each")
    return ValueError(f"{name} have the shape {shape}, not {wanted}: {remedy}")


def positions_of(array: Any, name: str = "positions") -> np.ndarray:
    """Positions with shape (n, 3), float32 or float64."""
    if isinstance(array, (str, os.PathLike)):
        raise TypeError(f"{name} cannot be the file {os.fspath(array)}: read the file first, or use"
                        " python -m scatteredisopoints")
    result = readable(name, array)
    if result.ndim != 2 or result.shape[1] != 3:
        raise shape_error(name, result.shape, "(n, 3)")
    return result if result.dtype.kind == "f" else result.astype(np.float64)


def values_of(array: Any, count: int) -> tuple[np.ndarray, Optional[np.ndarray]]:
    """Values with shape (count,), and which of them are masked; None if none is. They keep their type, since
    integers count as rounded."""
    if array is None:
        raise TypeError("values are missing: one for each position")
    masked = None
    if isinstance(array, np.ma.MaskedArray):
        masked = _checked_values(np.ma.getmaskarray(array), count).view(bool)
        array = array.data
    return _checked_values(array, count), masked if masked is not None and masked.any() else None


def negated(numbers: np.ndarray) -> np.ndarray:
    """Negated numbers. Integers stay integers, since they count as rounded, unless int64 cannot hold one."""
    if numbers.dtype.kind == "f":
        return -numbers
    limits = np.iinfo(np.int64)
    if numbers.dtype == np.uint64 and numbers.size and numbers.max() > limits.max:
        return -numbers.astype(np.float64)
    # The library reads the least and the negated greatest number as the same double.
    return -np.maximum(numbers.astype(np.int64, copy=False), -limits.max)


def describe_masked(masked: np.ndarray) -> str:
    """A message about values that are masked."""
    remedy = "Give values that are not masked." if masked.all() else (
        "The surface there is that of the samples around.")
    return f"{np.count_nonzero(masked)} of {len(masked)} values are masked: their samples are left out. {remedy}"


def _checked_values(array: Any, count: int) -> np.ndarray:
    """Values of the samples with shape (count,)."""
    result = readable("values", array)
    if result.ndim == 2 and result.shape[1] == 1:
        result = result[:, 0]
    if result.shape != (count,):
        raise ValueError(f"values have the shape {result.shape}, not ({count},)")
    return result


def checked_tensors(name: str, array: Any, count: int) -> np.ndarray:
    """An array of the samples with any number of components, in shape (count, ...)."""
    result = readable(name, array)
    if result.ndim < 1 or len(result) != count or 0 in result.shape[1:]:
        remedy = ": give several arrays as a mapping of names to them" if result.shape[1:2] == (count,) else ""
        raise ValueError(f"{name} have the shape {result.shape}, not ({count},) or ({count}, components){remedy}")
    return result


def are_names(arrays: Any) -> bool:
    """Whether several arrays are given by their names."""
    if isinstance(arrays, np.ndarray):
        return arrays.ndim == 1 and arrays.size > 0 and arrays.dtype.kind == "U"
    return isinstance(arrays, (list, tuple)) and len(arrays) > 0 and all(isinstance(name, str) for name in arrays)


def by_name(arrays: Any) -> Mapping[str, Any]:
    """Arrays by their names, for a mapping, a name, a list of names, or an array, which gets the name "values"."""
    if isinstance(arrays, str) or are_names(arrays):
        return {name: name for name in ([arrays] if isinstance(arrays, str) else arrays)}
    if isinstance(arrays, Mapping) and not all(isinstance(name, str) for name in arrays):
        raise TypeError(MAPPING_NEEDED)
    return arrays if isinstance(arrays, Mapping) else {"values": arrays}


def further_arrays(arrays: Optional[Mapping[str, Any]], count: int) -> dict[str, np.ndarray]:
    """Arrays of the samples by name, except the values."""
    if arrays is None:
        return {}
    if not isinstance(arrays, Mapping):
        raise TypeError(MAPPING_NEEDED)
    if "values" in arrays:
        raise ValueError('an array cannot have the name "values", which is that of the values')
    return {name: checked_tensors(name, array, count) for name, array in by_name(arrays).items()}


def nearest_names(listed: Any, of_text: Iterable[str]) -> set[str]:
    """The names of arrays that take the nearest value, of one or several that are given."""
    try:
        names = {listed} if isinstance(listed, str) else {*listed}
    except TypeError:
        raise TypeError(f"nearest_arrays cannot be {listed!r}: give names of arrays") from None
    for name in names.intersection(of_text):
        raise ValueError(f"nearest_arrays cannot have {name!r}: the array holds no numbers")
    return names


def without_text(arrays: Any) -> tuple[Any, list[str]]:
    """A mapping of names to arrays without those that hold text or times, such as columns of a table, and the names of
    these. Returns other arguments as they are."""
    if not isinstance(arrays, Mapping):
        return arrays, []
    names = [name for name, array in arrays.items() if not isinstance(array, str) and _holds_text(array)]
    return {name: array for name, array in arrays.items() if name not in names}, names


def _holds_text(array: Any) -> bool:
    if hasattr(array, "IsA"):
        return not array.IsA("vtkDataArray")
    try:
        numbers = np.asarray(array)
    except ValueError:  # of lists of different lengths
        return False
    return numbers.dtype.kind in "USTMm" or (
        numbers.dtype.kind == "O" and any(isinstance(each, str) for each in numbers.flat))


def levels_of(name: str, given: Union[float, Iterable[float], None]) -> list[float]:
    """One or several isovalues or offsets as a list, without masked ones."""
    if given is None:
        raise TypeError(f"{name} are missing: give one or several numbers")
    if isinstance(given, (str, bytes, bool, np.bool_, Mapping)):
        raise TypeError(f"{name} are {given!r}, not numbers")
    if isinstance(given, np.ma.MaskedArray):
        given = given.compressed()
    elif hasattr(given, "__iter__") and not isinstance(given, np.ndarray):
        given = list(given)
    values = np.atleast_1d(np.asarray(given))
    if values.dtype == object and all(isinstance(value, Number) for value in values.ravel()):  # such as great integers
        try:
            values = np.array([float(value) for value in values.ravel()])
        except OverflowError:
            raise ValueError(f"{name} are beyond the range of float64") from None
    if values.size and values.dtype.kind not in "fiu":
        raise TypeError(f"{name} are of the type {values.dtype}, not numbers")
    return values.ravel().astype(np.float64).tolist()
