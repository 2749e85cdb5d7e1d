# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples whose tree is kept between calls: see Samples."""

from __future__ import annotations

import contextlib
import math
import threading
import warnings
import weakref
from ctypes import byref, c_double, c_void_p
from dataclasses import dataclass, replace
from typing import Any, Collection, Iterable, Iterator, Mapping, Optional, Union

import numpy as np

from . import _datasets, _library
from ._arrays import (
    are_names, as_numpy, by_name, checked_tensors, describe_masked, further_arrays, levels_of, nearest_names, negated,
    positions_of, readable, values_of, without_text)
from ._bodies import body_with_warnings
from ._cuts import Normal
from ._interpolator import Interpolator
from ._isosurface import Isosurface, describe_not_finite
from ._option_types import BodyOptions, ContourOptions, SliceOptions, Unpack
from ._options import (
    CONSTANTS, direction_sign, hint, make_options, make_probe_options, switch, thread_count)
from ._progress import Progress, part, shown_progress
from ._slices import slice_with_warnings


@dataclass
class Extracted:
    """An isosurface with its messages."""

    isosurface: Isosurface
    surface: _library.Surface
    own_messages: list[_library.Message]
    """Messages of this package, beside those of the library."""

    @property
    def messages(self) -> list[_library.Message]:
        """All messages."""
        return _library.messages(self.surface) + self.own_messages


class Samples:
    """Scattered samples with a tree that is kept between isovalues, places and time steps.

    Several threads may use one object: their calls take turns. Objects do not wait for each other.
    Positions and arrays must not be changed while the object is in use.

    Parameters
    ----------
    positions
        As in :func:`contour`.
    values
        As in :func:`contour`; None: without values, for :meth:`probe`, :meth:`slice` and :meth:`body`. A sample whose
        value is not finite takes no part in contours, values and gradients. Bodies and slices need positions alone.
    threads
        As in :func:`contour`. It is the default of the methods, too.
    progress
        As in :func:`contour`, for loading.

    Examples
    --------
    >>> import numpy as np
    >>> from scatteredisopoints import Samples
    >>> positions = np.random.default_rng(1).random((20000, 3))
    >>> samples = Samples(positions, np.linalg.norm(positions - 0.5, axis=1))
    >>> spheres = [samples.contour(radius, triangles=True) for radius in (0.2, 0.3)]
    >>> [round(sphere.area, 1) for sphere in spheres]
    [0.5, 1.1]
    """

    def __init__(
        self,
        positions: Any,
        values: Any = None,
        *,
        threads: Optional[int] = None,
        progress: Progress = None,
    ):
        self._initialize(threads)
        with shown_progress(progress, "Loading samples") as report:
            self._take(_datasets.samples_with_values(positions, values), progress=report)

    @classmethod
    def _from_data(cls, samples: _datasets.DataSamples, threads: Optional[int] = None, **callbacks: Any) -> Samples:
        """Makes Samples of a data object. Callbacks are those of _library.Callbacks."""
        created = cls.__new__(cls)
        created._initialize(threads)
        created._take(samples, **callbacks)
        return created

    def _initialize(self, threads: Optional[int]) -> None:
        self._renew_lock()
        _all.add(self)
        self._threads = threads
        self._skipped = 0
        self._clear()

    def _clear(self) -> None:
        """Frees the samples and their tree."""
        self._extractor = _library.Extractor(_library.create_extractor())
        self._is_loaded = False
        self._range = (np.nan, np.nan)
        self._loaded_key: Any = None
        self._values: Any = None

    def _renew_lock(self) -> None:
        self._lock = threading.RLock()
        self._is_in_call = False

    def _take(self, samples: _datasets.DataSamples, **callbacks: Any) -> None:
        """Loads samples; keeps the tree if the positions are the same."""
        self._positions, self._excluded = samples.positions, samples.excluded
        self._count = len(as_numpy(samples.positions))
        self._center: Optional[np.ndarray] = None
        self._arrays, self._maker = samples.arrays, samples.maker
        self._without_array, self._name = samples.without_array, samples.name
        self._differing, self._of_text = samples.differing, samples.of_text
        self._association = samples.association
        self._ids = samples.ids
        self._load(samples.values, samples.masked, samples.are_float, **callbacks)

    def __len__(self) -> int:
        """The number of samples, including skipped ones."""
        return self._count

    def __repr__(self) -> str:
        if self._values is None or not self._is_loaded:
            return f"<Samples: {len(self)}, {'without values' if self._is_loaded else 'freed'}>"
        least, greatest = self.range
        return f"<Samples: {len(self)}, values from {least:g} to {greatest:g}>"

    @property
    def range(self) -> tuple[float, float]:
        """The least and the greatest value of the samples used; NaN if there are none."""
        return self._range

    def __reduce__(self) -> Any:
        raise TypeError("Samples cannot be copied or pickled: make them again of positions and values.")

    @property
    def skipped(self) -> int:
        """The number of samples skipped because they are not finite, masked or hidden."""
        return self._skipped

    def replace_values(self, values: Any, *, progress: Progress = None) -> None:
        """Replaces the values of the samples, for a later time step, and keeps the tree.

        Parameters
        ----------
        values
            One per sample, shape (n,), of any real type.
        progress
            As in :func:`contour`.
        """
        with shown_progress(progress, "Loading samples") as report:
            self._load(*values_of(values, len(self)), progress=report)

    @contextlib.contextmanager
    def _exclusive(self) -> Iterator[None]:
        """Gives one thread at a time access to the extractor."""
        with self._lock:
            if self._is_in_call:
                raise RuntimeError("A progress callback cannot use the samples that it is called for.")
            self._is_in_call = True
            try:
                yield
            finally:
                self._is_in_call = False

    @contextlib.contextmanager
    def _in_call(self, threads: Optional[int]) -> Iterator[Optional[int]]:
        """Exclusive access to an extractor with samples, for at most so many threads, or the samples' own number. Lasts
        until the result is complete, so that no other call changes what it is made of. Yields the number."""
        threads = self._threads if threads is None else threads
        most_threads = thread_count(threads)
        with self._exclusive():
            self._require_samples()
            _library.run(_library.set_extractor_threads, self._extractor, most_threads)
            yield threads

    def _load(self, values: Any, masked: Optional[np.ndarray], are_float: bool = True,
              **callbacks: Any) -> None:
        if self._count == 0:
            raise ValueError("There are no samples: the input has no points.")
        numbers = None if values is None else readable("values", as_numpy(values))
        with self._exclusive():
            self._is_loaded, self._loaded_key, self._range = False, None, (np.nan, np.nan)
            self._values, self._masked = values, masked
            _library.run(_library.set_extractor_threads, self._extractor, thread_count(self._threads))
            self._load_values(1, numbers, [self._excluded, masked], callbacks)
            range_ = (2 * c_double)()
            _library.get_value_range(self._extractor, byref(range_))
            self._range = range_[0], range_[1]
            self._skipped = _library.get_skipped_count(self._extractor)
            is_float = numbers is not None and numbers.dtype == np.float32
            self._value_type = np.float32 if are_float and is_float else np.float64
            self._is_loaded = True

    def _load_values(self, key: Any, numbers: Any, left_out: list[Optional[np.ndarray]], callbacks: Mapping[str, Any]
                     ) -> None:
        """Makes these numbers the values that the extractor holds. Their key says which ones they are: a cut's, "body",
        or for the samples' own values their sign."""
        self._loaded_key = None
        positions = positions_of(self._current("positions", self._positions))
        masks = [each for each in left_out if each is not None]
        _library.run(_library.set_value_name, self._extractor, self._name.encode(errors="replace"))
        _library.run(_library.set_values_negated, self._extractor, int(key == -1))
        _library.run_with(
            _library.Callbacks(**callbacks), self._extractor, _library.set_samples, positions, numbers,
            np.any(masks, axis=0).view(np.uint8) if masks else None)
        self._loaded_key = key

    def _reload_own_values(self, callbacks: Mapping[str, Any], sign: int = 1) -> None:
        """Loads the samples' own values again if the extractor holds others, such as those of a slice.

        sign: -1 negates them.
        """
        is_lost = self._loaded_key is None  # by a call that was canceled
        if self._loaded_key != sign and (self._values is not None or is_lost):
            numbers = None if self._values is None else readable("values", as_numpy(self._values))
            if sign < 0 and numbers is not None:
                numbers = negated(numbers)
            self._load_values(sign, numbers, [self._excluded, self._masked], callbacks)

    def _require_samples(self) -> None:
        if not self._is_loaded:
            raise ValueError("The samples were freed: call replace_values() or make new Samples.")

    def _current(self, name: str, array: Any) -> np.ndarray:
        """The current array of the samples: those of data sets may have been reallocated."""
        numbers = as_numpy(array)
        if len(numbers) != self._count:
            raise ValueError(f"{name} of the data set have changed from {self._count} to {len(numbers)}"
                             " tuples: make new Samples.")
        return numbers

    def contour(
        self,
        isovalues: Union[float, Iterable[float]],
        *,
        triangles: bool = False,
        arrays: Optional[Mapping[str, Any]] = None,
        threads: Optional[int] = None,
        progress: Progress = None,
        **options: Unpack[ContourOptions],
    ) -> Isosurface:
        """Extracts isosurfaces: :func:`contour` describes parameters, result and errors.

        Calls after the first one take a fraction of its time. ``keep_tree=False`` frees the samples: call
        :meth:`replace_values` before the next isosurface.
        """
        return self._contour(isovalues, triangles, arrays, threads, progress, options, stacklevel=3)

    def _contour(self, isovalues, triangles, arrays, threads, progress, options, stacklevel) -> Isosurface:
        arrays, of_text = without_text(arrays)
        with shown_progress(progress, "Contouring") as report:
            extracted = self._extract(isovalues, triangles, arrays, options, threads, progress=report)
        isosurface, of_text = extracted.isosurface, [*of_text, *self._of_text]
        for text in [*(message.text for message in extracted.messages), *describe_not_finite(isosurface.arrays),
                     *([_datasets.describe_text(of_text)] if of_text else [])]:
            warnings.warn(text, RuntimeWarning, stacklevel=stacklevel)
        return isosurface

    def _extract(self, isovalues, triangles, arrays, options, threads=None, **callbacks) -> Extracted:
        """contour() without warnings. Callbacks are those of _library.Callbacks."""
        if arrays is not None and self._arrays is not None:
            raise TypeError("arrays go with an array of positions: add them to the data set instead")
        chosen = make_options(triangles, options)
        sign = direction_sign(options.get("gradient_direction", "descent"))
        levels = levels_of("isovalues", isovalues)
        of_samples = further_arrays(arrays, len(self)) if self._arrays is None else {
            name: array for name, array in self._arrays.items() if not self._has_global_ids(name)}
        with self._in_call(threads) as threads:
            if self._values is None:
                raise ValueError("The samples were made without values: call replace_values().")
            self._reload_own_values({**callbacks, "progress": None}, sign)
            surface = self._surface([sign * level for level in levels], chosen, callbacks)
            messages = []
            if self._masked is not None:
                messages.append(_library.Message(
                    describe_masked(self._masked), is_warning=False, cause="masked values"))
            if self._without_array:
                messages.append(_datasets.describe_without_array(self._without_array, self._name))
            found = self._interpolated(surface, of_samples, callbacks.get("is_canceled"), self._ids)
            if options.get("compute_scalars", True):
                name = self._maker.scalars or "values"
                if name in found:
                    messages.append(_library.Message(
                        f'The isovalues replace the array "{name}" of the data set: rename that.',
                        is_warning=True, cause=f"isovalues replace {name}"))
                contoured = self._contoured(surface, chosen, sign, callbacks.get("is_canceled"))
                found[name] = contoured.astype(self._value_type, copy=False)
            if not options.get("keep_tree", True):
                self._clear()
        computed = _computed(surface, chosen, sign)
        messages += [_library.Message(
            f'The computed array "{name}" replaces the input array of this name. To keep that, rename'
            " it or switch the computed array off.", is_warning=True, cause=f"replaced array {name}")
            for name in computed if name in found]
        found.update(computed)
        isosurface = self._as_isosurface(surface, found, levels, chosen, threads, sign)
        return Extracted(isosurface, surface, messages)

    def _surface(self, levels: list[float], options: _library.Options, callbacks: Mapping[str, Any]
                 ) -> _library.Surface:
        """The isosurfaces of the values that the extractor holds."""
        pointer = c_void_p()
        try:
            _library.run_with(
                _library.Callbacks(**callbacks), self._extractor, _library.extract,
                (len(levels) * c_double)(*levels), len(levels), byref(options), byref(pointer))
        finally:
            if pointer.value:
                surface = _library.Surface(pointer.value)
        return surface

    def body(
        self, *, arrays: Any = None, threads: Optional[int] = None, progress: Progress = None,
        **options: Unpack[BodyOptions]
    ) -> Isosurface:
        """The closed surface of all samples: :func:`body` describes it. ``arrays`` are as in :meth:`slice`."""
        return body_with_warnings(self, arrays, threads, progress, options, stacklevel=3)

    def slice(
        self,
        normal: Optional[Normal] = None,
        origin: Any = None,
        *,
        arrays: Any = None,
        function: Any = None,
        offsets: Union[float, Iterable[float]] = 0.0,
        interpolation: str = "fits",
        nearest_arrays: Union[str, Iterable[str]] = (),
        threads: Optional[int] = None,
        progress: Progress = None,
        **options: Unpack[SliceOptions],
    ) -> Isosurface:
        """Slices the samples: :func:`slice_samples` describes parameters, result and errors.

        A slice along the normal of the last one takes a fraction of its time.

        Parameters
        ----------
        arrays
            As in :meth:`probe`. None: the values of the samples and the arrays of the data set that they were made
            of.
        """
        return slice_with_warnings(self, normal, origin, arrays, function, offsets, interpolation, threads, progress,
                                   options, stacklevel=3, nearest_arrays=nearest_arrays)

    def probe(
        self,
        places: Any,
        *,
        arrays: Any = None,
        gradient: bool = False,
        method: str = "blend",
        outside: Union[float, str, None] = math.nan,
        nearest_arrays: Union[str, Iterable[str]] = (),
        threads: Optional[int] = None,
        progress: Progress = None,
    ) -> Any:
        """Interpolates arrays of the samples at places: :func:`probe` describes parameters, result and errors.

        Parameters
        ----------
        arrays
            One per sample, or names of arrays of the data set that the samples were made of. None: the values of
            the samples. A mapping of names to arrays, or a list of names, gives a dict.
        """
        return self._probe(places, arrays, gradient, method, outside, threads, progress, stacklevel=3,
                           nearest_arrays=nearest_arrays)

    def gradient(
        self, *, arrays: Any = None, method: str = "blend", threads: Optional[int] = None, progress: Progress = None
    ) -> Any:
        """Gradients at the samples themselves: :func:`gradient` describes them. Parameters are as of :meth:`probe`."""
        return self._gradient(arrays, method, threads, progress, stacklevel=3)

    def interpolator(
        self,
        array: Any = None,
        *,
        method: str = "blend",
        outside: Union[float, str, None] = math.nan,
        threads: Optional[int] = None,
    ) -> Interpolator:
        """A function of places, called as the interpolators of SciPy are. Parameters are those of :meth:`probe`."""
        if isinstance(array, Mapping) or are_names(array):
            raise TypeError("an interpolator has one array: make one for each")
        numbers = self._numbers_of(array)
        make_probe_options(method, outside)
        for text in self._describe_gaps("values", array, numbers):
            warnings.warn(text, RuntimeWarning, stacklevel=2)
        return Interpolator(self, array, dict(method=method, outside=outside, threads=threads))

    def _gradient(self, arrays, method, threads, progress, stacklevel) -> Any:
        """gradient()."""
        places = self._current("positions", self._positions)
        return self._probe(places, arrays, True, method, math.nan, threads, progress, stacklevel + 1,
                           nearest_arrays=None)[1]

    def _probe(self, places, arrays, gradient, method, outside, threads, progress, stacklevel, seeks_gaps=True,
               nearest_arrays=()) -> Any:
        """probe(). Seeks entries of the arrays that are no numbers, for a message, which takes a pass over them.

        nearest_arrays: None if not even ids take the nearest value.
        """
        chosen, with_gradients = make_probe_options(method, outside), switch("gradient", gradient)
        is_nearest = chosen.method == CONSTANTS["method"]["nearest"]
        if with_gradients and is_nearest:
            raise ValueError('the method "nearest" has no gradients: use another one')
        arrays, of_text = without_text(arrays)
        if nearest_arrays is not None:
            nearest_arrays = nearest_names(nearest_arrays, [*of_text, *self._of_text])
        many = by_name(arrays)
        points, shape = _datasets.place_positions(places)
        with shown_progress(progress, "Probing") as report, self._in_call(threads):
            numbers = {name: self._numbers_of(array, name) for name, array in many.items()}
            nearest = () if nearest_arrays is None else self._nearest(many, nearest_arrays)
            values, gradients, kinds = self._probed(
                points, numbers, chosen, with_gradients, report, nearest=nearest)
            texts = [*self._describe_left_out(), *_describe_flat(kinds),
                     *([_datasets.describe_text(of_text)] if of_text else [])]
            for name, array in many.items() if seeks_gaps else ():
                texts += self._describe_gaps(name, array, numbers[name])
        for text in texts:
            warnings.warn(text, RuntimeWarning, stacklevel=stacklevel)
        for found in (values, gradients) if with_gradients else (values,):
            found.update({name: array.reshape(shape + array.shape[1:]) for name, array in found.items()})
        if not (isinstance(arrays, Mapping) or are_names(arrays)):
            (values,), (gradients,) = values.values(), gradients.values()
        return (values, gradients) if with_gradients else values

    def _probed(self, points: np.ndarray, numbers: Mapping[str, np.ndarray], options: _library.ProbeOptions,
                with_gradients: bool, report: Any, leaves_out: bool = True, nearest: Collection[str] = ()
                ) -> tuple[dict, dict, np.ndarray]:
        """Values, gradients and kinds of places, without samples that lack a value if these are to be left out. Some
        arrays take the nearest value, whatever the method. Within _in_call()."""
        by_nearest = _library.ProbeOptions.from_buffer_copy(options)
        by_nearest.method = CONSTANTS["method"]["nearest"]
        values, gradients = {}, {}
        for name, array in numbers.items():
            shape, is_nearest = (len(points), *array.shape[1:]), name in nearest or options.method == by_nearest.method
            values[name] = np.empty(shape, array.dtype if is_nearest else np.float64)
            gradients[name] = np.zeros((*shape, 3)) if with_gradients else None
        kinds = np.empty(len(points), np.uint8)
        if self._loaded_key is None or (leaves_out and self._skipped > 0):
            self._reload_own_values({})
        copied = [name for name in numbers if name in nearest]
        fitted = [name for name in numbers if name not in nearest]
        share = 0.8 if copied and fitted else 1.0
        if fitted or not copied:
            self._run_probe(points, fitted, numbers, options, values, gradients, kinds, part(report, 0.0, share))
        if copied:
            self._run_probe(points, copied, numbers, by_nearest, values, dict.fromkeys(copied), kinds,
                            part(report, share if fitted else 0.0, 1.0))
        return values, gradients, kinds

    def _run_probe(self, points, names, numbers, options, values, gradients, kinds, report) -> None:
        """_probed() for some of the arrays."""
        _library.run_with(
            _library.Callbacks(report), self._extractor, _library.probe, points,
            [numbers[name].reshape(len(numbers[name]), -1) for name in names], len(names), byref(options),
            [(values[name], gradients[name]) for name in names], kinds, kinds.nbytes)

    def _describe_left_out(self) -> Iterator[str]:
        """Messages about samples that are left out."""
        skipped = self._skipped - (0 if self._excluded is None else np.count_nonzero(self._excluded))
        if skipped > 0:
            yield f"{skipped} of {len(self)} samples are left out: their position or value is not finite, or masked."
        if self._without_array:
            yield _datasets.describe_without_array(self._without_array, self._name).text

    def _describe_gaps(self, name: str, array: Any, numbers: np.ndarray) -> Iterator[str]:
        """A message about entries of an array that are no numbers, unless it is None: the samples' own values."""
        is_gap = ~np.isfinite(numbers).reshape(len(numbers), -1).all(axis=1)
        if self._excluded is not None:
            is_gap &= ~self._excluded
        if array is not None and is_gap.any():
            yield (f'{np.count_nonzero(is_gap)} of {len(self)} entries of "{array if isinstance(array, str) else name}"'
                   " are masked or not finite: results are those of the samples around.")

    def _own_values(self) -> Any:
        """The samples' values, NaN where they are masked."""
        return self._values if self._masked is None else np.where(self._masked, np.nan, as_numpy(self._values))

    def _numbers_of(self, array: Any, name: str = "values") -> np.ndarray:
        """The numbers of an array, of a name of one, or the values for None."""
        if array is None:
            self._require_samples()
            if self._values is None:
                raise TypeError("arrays are missing: the samples were made without values")
            array = self._values
        elif isinstance(array, str):
            known = {**(self._arrays or {}), **({self._name: self._values} if self._name else {})}
            if array in self._differing:
                raise ValueError(_datasets.describe_differing([array]) + " Convert it, or combine the blocks first.")
            if array not in known:
                raise ValueError(f'the samples have no array "{array}": ' + (
                    hint(array, known) if known else "give its numbers, for they are of no data set with arrays"))
            name, array = array, known[array]
        is_of_vtk = hasattr(array, "GetDataType") and not isinstance(array, np.ndarray)
        return checked_tensors(name, self._current(name, array) if is_of_vtk else array, len(self))

    def _arrays_of(self, arrays: Any, nearest_arrays: Any = ()) -> tuple[dict[str, Any], set[str]]:
        """Arrays by name; for None the values, and all arrays of the data set. And those that take the nearest
        value."""
        if arrays is not None:
            many = by_name(arrays)
            return ({name: self._numbers_of(array, name) for name, array in many.items()},
                    self._nearest(many, nearest_arrays))
        own = self._maker.scalars or "values"
        values = {} if self._values is None else {own: self._own_values()}
        known = {**values, **(self._arrays or {})}
        return known, self._nearest({name: None if name in values else name for name in known}, nearest_arrays)

    def _has_global_ids(self, name: str) -> bool:
        return self._ids.get(name) == _datasets.GLOBAL_IDS

    def _nearest(self, many: Mapping[str, Any], listed: Iterable[str]) -> set[str]:
        """Which of several arrays take the value of the nearest sample: those with ids, and listed ones."""
        names = set(listed)
        for name in names.difference(many):
            remedy = hint(str(name), many) if many else "there are no arrays"
            raise ValueError(f"nearest_arrays cannot have {name!r}: {remedy}")

        def has_ids(array: Any) -> bool:
            array = self._name if array is None else array
            return array in self._ids if isinstance(array, str) else _datasets.has_ids(array)

        return names | {name for name, array in many.items() if has_ids(array)}

    def _interpolated(self, surface, of_samples: Mapping[str, Any], is_canceled, nearest: Collection[str] = ()
                      ) -> dict[str, np.ndarray]:
        count = len(_library.view(surface, _library.POINTS))
        found: dict[str, np.ndarray] = {}
        for name, array in of_samples.items():
            if name in nearest:
                is_first_nearer = _library.view(surface, _library.EDGE_PARAMETERS) < 0.5
                edges = _library.view(surface, _library.EDGES)
                found[name] = self._current(name, array)[np.where(is_first_nearer, *edges.T)]
                continue
            array = readable(name, self._current(name, array))
            found[name] = np.empty((count, *array.shape[1:]), array.dtype)
            _library.run_with(_library.Callbacks(is_canceled=is_canceled), surface, _library.interpolate,
                              array if array.ndim < 3 else array.reshape(len(array), -1), found[name],
                              found[name].nbytes)
        return found

    def _contoured(self, surface, options: _library.Options, sign: int, is_canceled) -> np.ndarray:
        """The isovalues; at samples of caps the values of these."""
        isovalues = _signed(_library.view(surface, _library.ISOVALUES), sign)
        if not options.capping:
            return isovalues
        values = np.asarray(readable("values", as_numpy(self._values)), np.float64)
        at_samples = np.equal(*_library.view(surface, _library.EDGES).T)
        return np.where(at_samples, self._interpolated(surface, {"": values}, is_canceled)[""], isovalues)

    def _as_isosurface(self, surface, arrays, levels, options: _library.Options, threads: Optional[int],
                       sign: int = 1) -> Isosurface:
        def views(is_wanted: int, **ids: int) -> dict[str, np.ndarray]:
            return {name: _library.view(surface, id_) for name, id_ in ids.items()} if is_wanted else {}

        return Isosurface(
            _library.view(surface, _library.POINTS), arrays=arrays, threads=threads, levels=levels,
            triangles=_library.view(surface, _library.TRIANGLES) if options.triangles else None,
            splat_shapes=views(options.compute_splats and not options.triangles, SplatAxis=_library.SPLAT_AXES,
                               SplatPolygon=_library.SPLAT_POLYGONS),
            cell_arrays=views(options.capping, IsCap=_library.CAPS), is_capped=bool(options.capping),
            make_polydata=self._maker if options.compute_normals else replace(self._maker, normals=None),
            isovalues=_signed(_library.view(surface, _library.ISOVALUES), sign))


_all: weakref.WeakSet[Samples] = weakref.WeakSet()


@_library.at_fork
def _renew_locks() -> None:
    """A forked process lacks the threads that may hold them."""
    for samples in _all:
        samples._renew_lock()


def _describe_flat(kinds: np.ndarray) -> Iterator[str]:
    """A message about places of these kinds."""
    flat = np.count_nonzero((kinds & (_library.PLACE_FLAT | _library.PLACE_OUTSIDE)) == _library.PLACE_FLAT)
    if flat > 0:
        yield (f"At {flat} of {len(kinds)} places the samples around are in a plane or on a line: values are those"
               " at the nearest point of it, and gradients have no part across.")


def _signed(numbers: np.ndarray, sign: int) -> np.ndarray:
    """Negates numbers if the sign is -1."""
    return numbers if sign > 0 else 0.0 - numbers  # 0 stays 0


def _computed(surface: _library.Handle, options: _library.Options, sign: int) -> dict[str, np.ndarray]:
    """The arrays that the library computes for each point, by the filters' names."""
    are_wanted = {
        "Normals": (_library.NORMALS, options.compute_normals),
        "Radius": (_library.RADII, options.compute_splats and not options.triangles),
        "Gradients": (_library.GRADIENTS, options.compute_gradients),
        "ProjectionOrder": (_library.PROJECTION_ORDERS, options.compute_projection_orders),
    }
    computed = {name: _library.view(surface, array_id)
                for name, (array_id, is_wanted) in are_wanted.items() if is_wanted}
    if "Gradients" in computed:
        computed["Gradients"] = _signed(computed["Gradients"], sign)
    return computed
