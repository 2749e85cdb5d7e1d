# SPDX-License-Identifier: GPL-3.0-or-later
"""What slices samples: planes and other implicit functions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Callable, Optional, Union

import numpy as np

from ._arrays import as_numpy, module_of
from ._options import shown

Normal = Union[str, Any]
"""The name of an axis, such as "x" or "-x", or three numbers."""


@dataclass(frozen=True)
class Cut:
    """An implicit function whose level sets are slices."""

    at: Callable[[np.ndarray], np.ndarray]
    """The values at places of float64, shape (n, 3)."""
    normal: Optional[tuple[float, ...]] = None
    """Of a plane, whose function is dot(place, normal). Other functions may change from call to call."""


def by_plane(normal: np.ndarray) -> Cut:
    x, y, z = numbers = tuple(normal.tolist())

    def at(places: np.ndarray) -> np.ndarray:
        with np.errstate(invalid="ignore"):  # at places that are not finite
            # Not as a product of matrices, whose rounding depends on the library and its threads.
            return places[:, 0] * x + places[:, 1] * y + places[:, 2] * z

    return Cut(at, numbers)


def by_function(function: Callable[[np.ndarray], Any]) -> Cut:
    """By a function of arrays of NumPy, or a vtkImplicitFunction."""
    evaluate = evaluator(function) if is_implicit_function(function) else function

    def at(places: np.ndarray) -> np.ndarray:
        unchanged = places.view()
        unchanged.setflags(write=False)
        values = np.asarray(evaluate(unchanged))
        if values.dtype.kind not in "fiub":
            raise TypeError(f"function returns the type {values.dtype}: it is to return real numbers")
        values = values.astype(np.float64, copy=False)
        if values.shape != (len(places),):
            raise ValueError(f"function returns the shape {values.shape} for places of the shape {places.shape}: it is"
                             " to return one number for each place")
        return values

    return Cut(at)


def is_implicit_function(function: Any) -> bool:
    """Whether an object is a vtkImplicitFunction."""
    return hasattr(function, "EvaluateFunction") and hasattr(function, "FunctionValue")


def evaluator(function: Any) -> Callable[[np.ndarray], np.ndarray]:
    """A vtkImplicitFunction as a function of arrays of NumPy."""
    core = module_of(function, "vtkCommonCore")
    support = module_of(function, "util.numpy_support")

    def values(places: np.ndarray) -> np.ndarray:
        found = core.vtkDoubleArray()
        found.SetNumberOfTuples(len(places))
        if len(places):
            function.FunctionValue(support.numpy_to_vtk(np.ascontiguousarray(places)), found)
        return as_numpy(found)

    return values


def make_cut(normal: Optional[Normal], origin: Any, function: Any, center: Callable[[], np.ndarray]
             ) -> tuple[Cut, float]:
    """What slices, and the level of the slice. Raises ValueError or TypeError for unusable arguments.

    Parameters
    ----------
    center
        Returns the default of the origin.
    """
    if function is None:
        plane = by_plane(_normal_of("x" if normal is None else normal))
        origin = center() if origin is None else three_numbers("origin", origin)
        return plane, float(plane.at(origin[None])[0])
    if normal is not None or origin is not None:
        raise TypeError("normal and origin are those of a plane, and do not go with a function: give one or the other")
    return cut_by(function)


def cut_by(function: Any) -> tuple[Cut, float]:
    """What slices by a function, and the level of the slice. Raises TypeError if it is none."""
    if is_implicit_function(function) and function.IsA("vtkPlane") and function.GetTransform() is None:
        # Subclasses, such as ParaView's, may have an offset besides.
        zero, gradient = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
        function.EvaluateGradient(zero, gradient)
        length, level = math.hypot(*gradient), -function.EvaluateFunction(zero)
        if length == 0.0:
            raise ValueError("The normal of the plane is zero. Set a direction.")
        if not math.isfinite(length) or not math.isfinite(level):
            raise ValueError("The normal or the origin of the plane is not finite. Set finite numbers.")
        return by_plane(np.array(gradient)), level
    if not (callable(function) or is_implicit_function(function)):
        raise TypeError(f"function cannot be {shown(function)}: it is a function of places, shape (n, 3), or a"
                        " vtkImplicitFunction")
    return by_function(function), 0.0


_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0),
         "-x": (-1.0, 0.0, 0.0), "-y": (0.0, -1.0, 0.0), "-z": (0.0, 0.0, -1.0)}


def _normal_of(normal: Normal) -> np.ndarray:
    if isinstance(normal, str) and normal.lower() in _AXES:
        return np.array(_AXES[normal.lower()])
    numbers = three_numbers("normal", normal, f"it is {', '.join(_AXES)}, or three finite numbers")
    length = math.hypot(*numbers)
    if not 0.0 < length < math.inf:
        raise ValueError(f"normal cannot be {normal!r}: its length is {length}")
    return numbers / length


def three_numbers(name: str, value: Any, kind: str = "it has three finite numbers") -> np.ndarray:
    """A place or a direction. Raises ValueError for other values."""
    try:
        numbers = np.array(value, dtype=np.float64)
    except (TypeError, ValueError):
        numbers = np.empty(0)
    if numbers.shape != (3,) or not np.isfinite(numbers).all():
        raise ValueError(f"{name} cannot be {shown(value)}: {kind}")
    return numbers


def shares_to_zero(values: Callable[[np.ndarray, np.ndarray], np.ndarray], begins: np.ndarray, ends: np.ndarray
                   ) -> np.ndarray:
    """Where a function is zero between places with values of different signs: shares of the ways, 0 to 1.

    Each second step of bisection is one of the secant, so brackets always shrink. A way without a change of sign
    has the share 0.

    Parameters
    ----------
    values
        The values of the function at the places with these indices, at these shares of the ways.
    begins, ends
        The values at both ends of the ways.
    """
    shares = np.zeros(len(begins))
    left = np.flatnonzero(np.signbit(begins) != np.signbit(ends))
    left = left[begins[left] != 0.0]
    low, high = np.zeros(len(left)), np.ones(len(left))
    at_low, at_high = begins[left], ends[left]
    enough = 1e-15 * np.maximum(np.abs(at_low), np.abs(at_high))
    for step in range(100):
        if len(left) == 0:
            break
        secant = low + (high - low) * (at_low / (at_low - at_high))
        tried = np.clip(secant, low, high) if step % 2 == 0 else 0.5 * (low + high)
        found = values(left, tried)
        shares[left] = tried
        is_low = np.signbit(found) == np.signbit(at_low)
        low, at_low = np.where(is_low, tried, low), np.where(is_low, found, at_low)
        high, at_high = np.where(is_low, high, tried), np.where(is_low, at_high, found)
        goes_on = (np.abs(found) > enough) & (high - low > 1e-15)
        left, low, high, at_low, at_high, enough = (
            each[goes_on] for each in (left, low, high, at_low, at_high, enough))
    return shares


def rounded(numbers: np.ndarray, dtype: np.dtype) -> np.ndarray:
    """Numbers in a type, integers rounded to the nearest that it has, halves away from zero."""
    if dtype.kind == "f":
        return numbers.astype(dtype)
    limits = np.iinfo(dtype)
    held = np.clip(numbers, float(limits.min), float(limits.max))
    whole = np.trunc(held)
    with np.errstate(invalid="ignore"):
        nearest = (whole + np.where(np.abs(held - whole) >= 0.5, np.sign(held), 0.0)).astype(dtype)
    return np.where(numbers >= float(limits.max), limits.max, nearest).astype(dtype)
