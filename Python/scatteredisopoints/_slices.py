# SPDX-License-Identifier: GPL-3.0-or-later
"""How Samples are sliced; docs/triangles.md in the source defines the result."""

from __future__ import annotations

import math
import warnings
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Collection, Mapping, Optional, Sequence

import numpy as np

from . import _datasets, _library
from ._arrays import as_numpy, levels_of, nearest_names, readable, without_text
from ._cuts import Cut, Normal, make_cut, rounded, shares_to_zero
from ._isosurface import Isosurface, describe_not_finite
from ._options import INTERPOLATIONS, make_probe_options, make_slice_options, named
from ._progress import Progress, part, shown_progress

if TYPE_CHECKING:
    from ._samples import Samples


def slice_with_warnings(
    samples: Samples, normal: Optional[Normal], origin: Any, arrays: Any, function: Any, offsets: Any,
    interpolation: Any, threads: Optional[int], progress: Progress, options: Mapping[str, Any], stacklevel: int,
    nearest_arrays: Any = ()
) -> Isosurface:
    """Samples.slice()."""
    method = named("interpolation", interpolation, INTERPOLATIONS)
    cut, level = make_cut(normal, origin, function, lambda: _center_of_bounds(samples))
    levels = [level + offset for offset in levels_of("offsets", offsets)]
    if any(map(math.isnan, levels)):
        raise ValueError("An offset is not a number. Choose numbers as offsets.")
    chosen = make_slice_options(options)
    arrays, of_text = without_text(arrays)
    nearest_arrays = nearest_names(nearest_arrays, [*of_text, *samples._of_text])
    with shown_progress(progress, "Slicing") as report:
        made, messages = compute_slice(
            samples, cut, levels, chosen, arrays, method, threads, report, nearest_arrays)
    warn_of(samples, made, messages, arrays is None, of_text, stacklevel + 1)
    return made


def warn_of(samples: Samples, isosurface: Isosurface, messages: list[_library.Message], has_all_arrays: bool,
            of_text: Sequence[str], stacklevel: int) -> None:
    """Warns by messages, and of arrays that are left out or not finite."""
    texts = [*(message.text for message in messages), *describe_not_finite(isosurface.arrays)]
    if has_all_arrays and samples._differing:
        texts.append(_datasets.describe_differing(samples._differing))
    of_text = samples._of_text if has_all_arrays else of_text
    if of_text:
        texts.append(_datasets.describe_text(of_text))
    for text in texts:
        warnings.warn(text, RuntimeWarning, stacklevel=stacklevel)


def compute_slice(samples: Samples, cut: Cut, levels: list[float], options: _library.Options, arrays: Any,
                  method: Optional[str], threads: Optional[int], report: Any, nearest_arrays: Any = ()
                  ) -> tuple[Isosurface, list[_library.Message]]:
    """A slice at levels of a function, with arrays as of Samples.slice(), and messages. Calls `report` with the share
    done."""
    with samples._in_call(threads) as threads:
        of_samples, nearest = samples._arrays_of(arrays, nearest_arrays)
        at_samples = _load_cut(samples, cut, part(report, 0.0, 0.3))
        surface = samples._surface(levels, options, {"progress": part(report, 0.3, 0.6)})
        points = _library.view(surface, _library.POINTS)
        found = samples._interpolated(surface, of_samples, None, nearest)
        if cut.normal is None and at_samples is not None and len(points):
            points = _moved_onto(samples, cut, at_samples, surface, points, of_samples, found, nearest)
        if (method is not None or nearest) and len(points):
            _fit(samples, points, of_samples, found, method, part(report, 0.6, 1.0), nearest)
    if report is not None:
        report(1.0)
    made = Isosurface(points, triangles=_library.view(surface, _library.TRIANGLES), arrays=found,
                      make_polydata=replace(samples._maker, normals=None), threads=threads)
    return made, _library.messages(surface)


def _center_of_bounds(samples: Samples) -> np.ndarray:
    if samples._center is None:
        positions = as_numpy(samples._positions)
        is_finite = np.isfinite(positions)
        box = [find(positions, axis=0, where=is_finite, initial=initial)
               for find, initial in ((np.min, np.inf), (np.max, -np.inf))]
        samples._center = np.where(is_finite.any(axis=0), 0.5 * box[0] + 0.5 * box[1], 0.0).astype(np.float64)
    return samples._center


def _load_cut(samples: Samples, cut: Cut, report: Any) -> Optional[np.ndarray]:
    """Loads the values of a function at the samples, unless the extractor has them. Returns what it loaded."""
    if cut.normal is not None and samples._loaded_key == cut.normal:
        return None
    positions = samples._current("positions", samples._positions).astype(np.float64, copy=False)
    at_samples = cut.at(positions)
    lacking = np.count_nonzero(~np.isfinite(at_samples) & np.isfinite(positions).all(axis=1))
    if lacking:
        raise ValueError(f"The cut function is not finite at {lacking} of {samples._count} samples. Choose one that is"
                         " finite everywhere.")
    samples._load_values(cut.normal, at_samples, [samples._excluded], {"progress": report})
    return at_samples


def _moved_onto(samples: Samples, cut: Cut, at_samples: np.ndarray, surface: _library.Surface, points: np.ndarray,
                of_samples: Mapping[str, Any], found: dict[str, np.ndarray], nearest: Collection[str]) -> np.ndarray:
    """Moves vertices towards the sample at an end of their edge on the other side of the function, as far as it
    crosses zero, and arrays with them."""
    levels, edges = (_library.view(surface, each) for each in (_library.ISOVALUES, _library.EDGES))
    dtype, points = points.dtype, points.astype(np.float64)
    before = cut.at(points) - levels
    if not np.isfinite(before).all():
        raise ValueError(f"The cut function is not finite at {np.count_nonzero(~np.isfinite(before))} places between"
                         " samples. Choose one that is finite everywhere.")
    is_second = (at_samples[edges[:, 1]] >= levels) != (before >= 0.0)
    ends = np.where(is_second, edges[:, 1], edges[:, 0])
    ways = samples._current("positions", samples._positions)[ends] - points
    shares = shares_to_zero(
        lambda which, share: cut.at(points[which] + share[:, None] * ways[which]) - levels[which],
        before, at_samples[ends] - levels)
    for name, array in of_samples.items():
        if name not in nearest:
            share = shares.reshape(-1, *[1] * (found[name].ndim - 1))
            at_ends = readable(name, samples._current(name, array))[ends]
            found[name] = rounded((1.0 - share) * found[name] + share * at_ends, found[name].dtype)
    return (points + shares[:, None] * ways).astype(dtype)


def _fit(samples: Samples, points: np.ndarray, of_samples: Mapping[str, Any], found: dict[str, np.ndarray],
         method: Optional[str], report: Any, nearest: Collection[str]) -> None:
    """Replaces arrays at points by those of a method of probe(), where it has values; None: only those that take the
    nearest value. Fits extrapolate at rims: edges of slivers on the convex hull are far too long for linear
    interpolation."""
    fitted = {name: samples._numbers_of(array, name) for name, array in of_samples.items()
              if method is not None or name in nearest}
    values, _, _ = samples._probed(points, fitted, make_probe_options(method or "nearest", None), False, report,
                                   leaves_out=False, nearest=nearest)
    for name, numbers in values.items():
        dtype = found[name].dtype
        exact = numbers if numbers.dtype == dtype else rounded(numbers, dtype)
        found[name] = np.where(np.isfinite(numbers), exact, found[name])
