# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of contour(): properties in snake case, as keyword arguments."""

from __future__ import annotations

import difflib
import inspect
import math
import operator
import re
from typing import Any, Callable, Collection, Iterable, Mapping, Optional

import numpy as np

from . import _library
from ._library import Options, ProbeOptions
from ._option_types import OPTION_TYPES, OptionsOfPoints, OptionsOfTriangles, SliceOptions

# Names of constants by option, in lower case; their numbers are those of isopoint.h.
CONSTANTS = {
    "projection": {"no_projection": 0, "linear_fit": 1, "quadratic_fit": 2, "cubic_fit": 3, "crease_fit": 4},
    "normal_method": {"automatic_normals": -1, "normals_from_field": 0, "normals_from_planes": 1},
    "method": {"blend": 0, "cubic": 1, "quadratic": 2, "affine": 3, "nearest": 4},
    "output_points_precision": {"single_precision": 0, "double_precision": 1, "default_precision": 2},
}

INTERPOLATIONS = {"fits": "blend", "linear": None, "nearest": "nearest"}
"""The methods of probe() for the arrays of slices, in the order of VTK's constants; None: linear."""

# Parameters that are no options, of contour(), and of slice_samples() and body().
_OF_CONTOUR = ("arrays", "isovalues", "progress", "threads", "triangles")
_OF_SLICES = ("arrays", "function", "interpolation", "nearest_arrays", "normal", "offsets", "origin", "progress",
              "threads")
OF_BODIES = ("arrays", "progress", "threads")


def property_name(option: str) -> str:
    """Converts the name of an option to that of its property: drop_gaps to DropGaps."""
    return "".join(word.capitalize() for word in option.split("_"))


def option_names(triangles: bool) -> list[str]:
    """The options for triangles, or for points."""
    others = (OptionsOfPoints if triangles else OptionsOfTriangles).__annotations__
    return sorted(name for name in OPTION_TYPES if name not in others and name != "gradient_direction")


def named(name: str, value: Any, choices: Mapping[str, Any]) -> Any:
    """What a name in upper or lower case stands for. Raises ValueError if it is none of the choices."""
    if not isinstance(value, str) or value.lower() not in choices:
        raise ValueError(f"{name} cannot be {shown(value)}: it is {_listed(choices)}")
    return choices[value.lower()]


def shown(value: Any) -> str:
    """A wrong value in a message: itself, or the type of a long one, such as an array."""
    text = repr(value)
    return text if len(text) <= 80 else f"of the type {type(value).__name__}"


def _listed(names: Iterable[str]) -> str:
    *others, last = (f'"{name}"' for name in names)
    return f"{', '.join(others)} or {last}"


def check_names(given: Iterable[str], names: Collection[str], parameters: Iterable[str] = ()) -> None:
    """Raises TypeError for an option that is not among some. The message names further parameters of the call, too."""
    for name in given:
        if name not in names:
            raise TypeError(f"unknown option {name}: {hint(name, [*names, *parameters])}")


def parameters_of(function: Callable[..., Any]) -> list[str]:
    """The names of the parameters of a method, without self and **options."""
    return [each.name for each in inspect.signature(function).parameters.values()
            if each.kind is not each.VAR_KEYWORD and each.name != "self"]


def make_options(triangles: bool, given: Mapping[str, Any]) -> Options:
    """Raises TypeError for unknown options and ValueError for invalid values. The library checks ranges."""
    options = Options()
    options.triangles = int(switch("triangles", triangles))
    names = [*option_names(triangles), "gradient_direction"]
    for name, value in given.items():
        if name not in names:
            raise unknown_option(name, triangles)
        if name == "compute_scalars":
            switch(name, value)
        elif name == "gradient_direction":
            direction_sign(value)
        elif name == "keep_tree":
            options.keep_tetrahedra = int(switch(name, value))
        else:
            setattr(options, name, number_of(name, value, getattr(options, name)))
    return options


def direction_sign(direction: Any) -> int:
    """What values are multiplied by so that they decrease out of the body. Raises ValueError for invalid values."""
    return named("gradient_direction", direction, {"descent": 1, "ascent": -1})


def make_probe_options(method: Any, outside: Any) -> ProbeOptions:
    """Raises ValueError for invalid values."""
    options = ProbeOptions()
    options.method = number_of("method", method, options.method)
    if outside is None:
        options.outside = _library.OUTSIDE_EXTRAPOLATE
    elif isinstance(outside, str) and outside.lower() == "nearest":
        options.outside = _library.OUTSIDE_NEAREST
    elif isinstance(outside, (float, int, np.floating, np.integer)) and not isinstance(outside, bool):
        options.outside_number = number_of("outside", outside, math.nan)
    else:
        raise ValueError(f'outside cannot be {shown(outside)}: it is a number, "nearest", or None for no mask')
    return options


def make_slice_options(given: Mapping[str, Any]) -> Options:
    """The options of the isosurface that is a slice. Raises TypeError for unknown options and ValueError for invalid
    values."""
    check_names(given, SliceOptions.__annotations__, _OF_SLICES)
    options = make_options(True, {**given, "projection": None, "compute_normals": False})
    options.keep_hull_slivers = 1
    return options


def thread_count(threads: Optional[int]) -> int:
    """The library's number for at most so many threads; None: all available cores. Raises ValueError for fewer
    than one, TypeError for other types."""
    if threads is None:
        return 0
    remedy = "give a whole number, 1 or more, or None for all cores"
    if isinstance(threads, bool) or not hasattr(threads, "__index__"):
        raise TypeError(f"threads cannot be {shown(threads)}: {remedy}")
    if operator.index(threads) < 1:
        raise ValueError(f"threads are {threads}: {remedy}")
    return min(operator.index(threads), 2**31 - 1)


def hint(name: str, names: Iterable[str]) -> str:
    """The remedy for a wrong name: the nearest of some, or all of these."""
    others = [each for each in names if each != name]
    near = difflib.get_close_matches(name, others, 1)
    return f"did you mean {near[0]}?" if near else f"there are {', '.join(others)}"


def unknown_option(name: str, triangles: bool, parameters: Iterable[str] = _OF_CONTOUR) -> TypeError:
    """An error that names the options for triangles, or for points, and the parameters of the call."""
    if name in option_names(not triangles):
        return TypeError(f"{name} is an option of {'points' if triangles else 'triangles'} only")
    if name in ("contour_blocks", "use_all_cores"):
        remedy = "call contour() for each block" if name == "contour_blocks" else "use threads"
        return TypeError(f"{name} is a property of the filters alone: {remedy}")
    names = [*option_names(triangles), "gradient_direction"]
    snake = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower()
    return TypeError(f"unknown option {name}: {hint(snake, [*names, *parameters])}")


def switch(name: str, value: Any) -> bool:
    """Raises ValueError unless the value is true or false, as a bool or a number."""
    if not isinstance(value, (bool, int, np.bool_, np.integer)) or value not in (0, 1):
        raise ValueError(f"{name} cannot be {shown(value)}: it is True or False")
    return bool(value)


def number_of(name: str, value: Any, default: Any) -> Any:
    """Converts a value to the type of the default, and the name of a constant to its number. The projection None, or
    "none", is "no_projection". Raises ValueError for other values."""
    if OPTION_TYPES.get(name) is bool:
        return int(switch(name, value))
    constants = CONSTANTS.get(name, {})
    is_projection = name == "projection"
    names = [*constants, "none"] if is_projection else constants
    kind = _listed(names) if constants else "a real number" if isinstance(default, float) else "a whole number"
    error = ValueError(f"{name} cannot be {shown(value)}: it is {kind}")
    if is_projection and (value is None or isinstance(value, str) and value.lower() == "none"):
        value = "no_projection"
    if isinstance(value, str):
        value = constants.get(value.lower())
    try:
        if isinstance(value, (bool, np.bool_)):
            raise error
        number = float(value) if isinstance(default, float) else operator.index(value)
    except (TypeError, ValueError):
        raise error from None
    except OverflowError:
        raise ValueError(f"{name} is out of range: float64 holds numbers up to 1.8e308") from None
    if constants and number not in constants.values():
        raise error
    if isinstance(number, int) and not -2**31 <= number < 2**31:
        raise ValueError(f"{name} is {value!r}, which is out of range.")
    return number
