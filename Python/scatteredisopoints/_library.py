# SPDX-License-Identifier: GPL-3.0-or-later
"""The C library by ctypes; isopoint.h documents its declarations."""

from __future__ import annotations

import atexit
import ctypes
import os
import re
import threading
import weakref
from ctypes import POINTER, byref, c_char_p, c_double, c_int32, c_int64, c_size_t, c_uint64, c_void_p
from dataclasses import dataclass
from typing import Any, Callable, Generator, Optional

import numpy as np

from ._option_types import MEMBERS, OPTION_TYPES
from ._paths import LIBRARY

# isopoint_array_id
(POINTS, ISOVALUES, NORMALS, GRADIENTS, PROJECTION_ORDERS, EDGES, EDGE_PARAMETERS, TRIANGLES, RADII,
 SPLAT_AXES, SPLAT_POLYGONS, SPLAT_VERTICES, SPLAT_VERTEX_NORMALS, SPLAT_VERTEX_POINTS,
 SPLAT_TRIANGLES, CAPS) = range(16)

# isopoint_type
TYPES = tuple(np.dtype(kind) for kind in ("f4", "f8", "i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8"))

# isopoint_probe_options::outside, and the bits of what isopoint_probe() says about a place
OUTSIDE_NUMBER, OUTSIDE_NEAREST, OUTSIDE_EXTRAPOLATE = range(3)
PLACE_OUTSIDE, PLACE_FLAT = 1, 2

# isopoint_message_code: splats that do not meet, isovalues at an end of the values
SPLATS_APART, ISOVALUE_AT_END = 9, 15

# isopoint_status
(OK, INVALID_ARGUMENT, OUT_OF_MEMORY, CANCELED, INTERNAL_ERROR, INVALID_ARRAY, INVALID_OPTION, INVALID_ORDER,
 FORKED) = range(9)


class Array(ctypes.Structure):
    """isopoint_array"""

    _fields_ = [("data", c_void_p), ("type", c_int32), ("components", c_int32), ("count", c_int64),
                ("stride", c_int64), ("component_stride", c_int64)]

    @classmethod
    def of(cls, numbers: np.ndarray) -> Array:
        """Describes an array of the shape (n,) or (n, components) of readable(), and keeps it alive."""
        columns = numbers.ndim == 2
        if numbers.ndim not in (1, 2):
            raise ValueError(f"an array has the shape {numbers.shape}, not (n,) or (n, components)")
        described = cls(numbers.ctypes.data, TYPES.index(numbers.dtype), numbers.shape[1] if columns else 1,
                        len(numbers), numbers.strides[0], numbers.strides[1] if columns else 0)
        described.numbers = numbers
        return described


class InputArray:
    """The type of a parameter that the library reads: an array of NumPy, alive during the call, or None."""

    @staticmethod
    def from_param(numbers: Optional[np.ndarray]) -> Any:
        return None if numbers is None else byref(Array.of(numbers))


class InputArrays:
    """The type of a parameter that is several arrays that the library reads, alive during the call."""

    @staticmethod
    def from_param(numbers: list[np.ndarray]) -> Any:
        arrays = [Array.of(each) for each in numbers]
        described = (Array * len(arrays))(*arrays)
        described.arrays = arrays
        return described


class OutputArray:
    """The type of a parameter that the library writes: a contiguous array of NumPy, alive during the call."""

    @staticmethod
    def from_param(numbers: np.ndarray) -> Any:
        if not (numbers.flags.c_contiguous and numbers.flags.writeable):
            raise ValueError("the memory for a result is not contiguous, or read-only")
        return numbers.ctypes


class Probed(ctypes.Structure):
    """isopoint_probe_result"""

    _fields_ = [("values", c_void_p), ("values_size", c_size_t), ("gradients", POINTER(c_double)),
                ("gradients_size", c_size_t)]


class ProbeOutputs:
    """The type of a parameter with the memory for several arrays: pairs of values and of gradients or None."""

    @staticmethod
    def from_param(pairs: list[tuple[np.ndarray, Optional[np.ndarray]]]) -> Any:
        described = (Probed * len(pairs))()
        described.pairs = pairs
        for each, (values, gradients) in zip(described, pairs):
            each.values, each.values_size = OutputArray.from_param(values).data, values.nbytes
            if gradients is not None:
                each.gradients, each.gradients_size = (
                    OutputArray.from_param(gradients).data_as(POINTER(c_double)), gradients.nbytes)
        return described


class ProbeOptions(ctypes.Structure):
    """isopoint_probe_options, with the defaults"""

    _fields_ = [("size", c_uint64), ("method", c_int32), ("outside", c_int32), ("outside_number", c_double)]

    def __init__(self):
        super().__init__()
        initialize_probe_options(byref(self), ctypes.sizeof(self))


class Options(ctypes.Structure):
    """isopoint_options, with the defaults"""

    _fields_ = [("size", c_uint64),
                *((name, c_double if OPTION_TYPES.get(name) is float else c_int32) for name in MEMBERS)]

    def __init__(self):
        super().__init__()
        initialize_options(byref(self), ctypes.sizeof(self))


Progress = ctypes.CFUNCTYPE(None, c_void_p, c_double)
Cancels = ctypes.CFUNCTYPE(ctypes.c_int, c_void_p)

try:
    _library = ctypes.CDLL(LIBRARY)
except OSError as error:
    # As said by glibc, musl and macOS.
    named = re.match(r"([^:]*): cannot open shared|Error loading shared library ([^:]*):"
                     r"|.*Library not loaded: (\S+)", str(error), re.DOTALL)
    missing = os.path.basename("".join(filter(None, named.groups()))) if named else ""
    remedy = ("Install this package again, for this system." if missing in ("", os.path.basename(LIBRARY)) else
              f"Install the system's package that has {missing}, as libtbb12 or libgmp10 of Debian do.")
    raise ImportError(f"The C library cannot be loaded: {error}. {remedy}") from None


def _declare(name: str, *arguments: Any, result: Any = ctypes.c_int):
    function = getattr(_library, "isopoint_" + name)
    function.argtypes, function.restype = arguments, result
    return function


_get_error = _declare("get_error", result=c_char_p)
version = _declare("version", result=c_char_p)
initialize_options = _declare("initialize_options", POINTER(Options), c_size_t, result=None)
create_extractor = _declare("create_extractor", result=c_void_p)
destroy_extractor = _declare("destroy_extractor", c_void_p, result=None)
set_extractor_threads = _declare("set_extractor_threads", c_void_p, c_int32)
set_extractor_callbacks = _declare("set_extractor_callbacks", c_void_p, Progress, Cancels, c_void_p)
set_value_name = _declare("set_value_name", c_void_p, c_char_p)
set_values_negated = _declare("set_values_negated", c_void_p, c_int32)
set_samples = _declare("set_samples", c_void_p, InputArray, InputArray, InputArray)
get_value_range = _declare("get_value_range", c_void_p, POINTER(2 * c_double), result=None)
extract = _declare("extract", c_void_p, POINTER(c_double), c_int64, POINTER(Options),
                   POINTER(c_void_p))
initialize_probe_options = _declare("initialize_probe_options", POINTER(ProbeOptions), c_size_t, result=None)
probe = _declare("probe", c_void_p, InputArray, InputArrays, c_int64, POINTER(ProbeOptions), ProbeOutputs, OutputArray,
                 c_size_t)
create_surface = _declare("create_surface", InputArray, InputArray, InputArray, InputArray, POINTER(c_void_p))
destroy_surface = _declare("destroy_surface", c_void_p, result=None)
set_surface_threads = _declare("set_surface_threads", c_void_p, c_int32)
set_surface_callbacks = _declare("set_surface_callbacks", c_void_p, Progress, Cancels, c_void_p)
get_skipped_count = _declare("get_skipped_count", c_void_p, result=c_int64)
get_unprojected_count = _declare("get_unprojected_count", c_void_p, result=c_int64)
get_dropped_count = _declare("get_dropped_count", c_void_p, result=c_int64)
get_message = _declare("get_message", c_void_p, c_int64, POINTER(c_int32), result=c_char_p)
get_message_cause = _declare("get_message_cause", c_void_p, c_int64, result=c_char_p)
get_message_code = _declare("get_message_code", c_void_p, c_int64, result=c_int32)
join_messages = _declare("join_messages", c_void_p, c_void_p)
get_array = _declare("get_array", c_void_p, c_int32, POINTER(Array))
interpolate = _declare("interpolate", c_void_p, InputArray, OutputArray, c_size_t)
make_splat_mesh = _declare("make_splat_mesh", c_void_p, c_double)
average_at_splat_vertices = _declare("average_at_splat_vertices", c_void_p, InputArray, OutputArray, c_size_t)


class Handle:
    """Owns an object of the library."""

    destroy: Any
    set_callbacks: Any

    def __init__(self, pointer: int | None):
        if not pointer:
            raise MemoryError("There is no memory for a tree.")
        self._as_parameter_ = c_void_p(pointer)
        weakref.finalize(self, self.destroy, pointer).atexit = False


class Extractor(Handle):
    """Owns an isopoint_extractor."""

    destroy, set_callbacks = destroy_extractor, set_extractor_callbacks


class Surface(Handle):
    """Owns an isopoint_surface."""

    destroy, set_callbacks = destroy_surface, set_surface_callbacks


class Callbacks:
    """Progress and cancellation of one call.

    ctypes drops exceptions of callbacks, and signal handlers, including that of Ctrl-C, may raise before
    the first line of a callback. So ctypes only calls two methods implemented in C: one of a dictionary,
    which keeps the last fraction, and one of a generator, which waits within a try block. Only the call
    holds these: callers, such as filters, die without the garbage collector.
    """

    def __init__(
        self,
        progress: Optional[Callable[[float], Any]] = None,
        is_canceled: Optional[Callable[[], bool]] = None,
    ):
        self.error: Optional[BaseException] = None
        self._report, self._is_canceled = progress, is_canceled
        self._fractions: dict[Any, float] = {}  # by the callback's user pointer, which is None
        self._reported: Optional[float] = None

    def functions(self) -> tuple[Any, Any]:
        """The functions for the library to call."""
        answers = self._answers()
        next(answers)
        return Progress(self._fractions.__setitem__), Cancels(answers.send)

    def _answers(self) -> Generator[int, Any, None]:
        answer = 0
        while True:
            try:
                yield answer
                answer = int(self._is_over())
            except GeneratorExit:
                raise
            except BaseException as error:
                self.error, answer = error, 1

    def _is_over(self) -> bool:
        if self.error is None:
            self.report()
        return (self.error is not None or _Calls.are_over()
                or (self._is_canceled is not None and bool(self._is_canceled())))

    def report(self) -> None:
        """Reports progress that was not reported yet."""
        fraction = self._fractions.get(None)
        if self._report is not None and fraction is not None and fraction != self._reported:
            self._reported = fraction
            self._report(fraction)


def at_fork(call: Callable[[], None]) -> None:
    """Registers a call in processes forked later."""
    if hasattr(os, "register_at_fork"):
        os.register_at_fork(after_in_child=call)


class _Calls:
    """Counts running calls, so that those of daemon threads end before the interpreter does. An interpreter that ends
    while such a thread is in a callback, or prints an error, aborts the process."""

    changed = threading.Condition()
    count = 0
    last_thread: Optional[int] = None
    """The thread that ends the interpreter, once it does. No other thread may call then."""

    @classmethod
    def are_over(cls) -> bool:
        return cls.last_thread not in (None, threading.get_ident())

    @classmethod
    def begin(cls) -> None:
        with cls.changed:
            if cls.are_over():
                raise SystemExit  # ends a thread silently
            cls.count += 1

    @classmethod
    def end(cls) -> None:
        with cls.changed:
            cls.count -= 1
            cls.changed.notify_all()
            if cls.are_over():
                raise SystemExit

    @classmethod
    def forget(cls) -> None:
        """Forgets the calls of other threads, which a forked process lacks."""
        cls.changed, cls.count, cls.last_thread = threading.Condition(), 0, None


at_fork(_Calls.forget)


@atexit.register
def _end_calls() -> None:
    with _Calls.changed:
        _Calls.last_thread = threading.get_ident()
        _Calls.changed.wait_for(lambda: _Calls.count <= 0, timeout=10.0)


def run(function: Any, *arguments: Any) -> None:
    """Calls a function of the library that returns a status, and raises its error."""
    _check(function(*arguments))


def run_with(callbacks: Callbacks, handle: Handle, function: Any, *arguments: Any) -> None:
    """The same for a function of an extractor or a surface. Also raises exceptions of callbacks and signal
    handlers, and InterruptedError after a cancellation."""
    progress, cancels = callbacks.functions()
    _Calls.begin()
    try:
        run(handle.set_callbacks, handle, progress, cancels, None)
        status = function(handle, *arguments)
    finally:
        handle.set_callbacks(handle, Progress(), Cancels(), None)
        _Calls.end()
    error, callbacks.error = callbacks.error, None
    try:
        if error is not None:
            raise error
    finally:
        del error  # its traceback refers to this frame
    _check(status)
    callbacks.report()


def _check(status: int) -> None:
    if status != OK:
        kinds = {OUT_OF_MEMORY: MemoryError, CANCELED: InterruptedError, INTERNAL_ERROR: RuntimeError}
        raise kinds.get(status, ValueError)(_get_error().decode())


def view(surface: Surface, array_id: int) -> np.ndarray:
    """An array of a surface as a view that keeps its memory alive."""
    array = Array()
    run(get_array, surface, array_id, byref(array))
    dtype = TYPES[array.type]
    shape = (array.count,) if array.components == 1 else (array.count, array.components)
    if array.count == 0:
        return np.empty(shape, dtype)
    size = array.count * array.components * dtype.itemsize
    memory = (ctypes.c_char * size).from_address(array.data)
    memory.surface = surface
    return np.frombuffer(memory, dtype).reshape(shape)


@dataclass(frozen=True)
class Message:
    """A message for the user about a surface."""

    text: str
    is_warning: bool
    """Whether the result is not what was asked for."""

    cause: str
    """Stays the same in later extractions while the cause lasts; figures in the text change."""

    code: int = 0
    """An isopoint_message_code; 0 for messages of this package."""


def messages(surface: Surface) -> list[Message]:
    """All messages about a surface."""
    found: list[Message] = []
    is_warning = c_int32()
    while (text := get_message(surface, len(found), byref(is_warning))) is not None:
        cause, code = get_message_cause(surface, len(found)), get_message_code(surface, len(found))
        found.append(Message(text.decode(), bool(is_warning.value), cause.decode(), code))
    return found
