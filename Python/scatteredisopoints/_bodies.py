# SPDX-License-Identifier: GPL-3.0-or-later
"""The body of all samples; docs/triangles.md in the source defines it."""

from __future__ import annotations

import math
import warnings
from typing import TYPE_CHECKING, Any, Mapping, Optional

import numpy as np

from . import _datasets, _library
from ._isosurface import Isosurface
from ._options import hint, make_options, thread_count
from ._progress import Progress, part, shown_progress
from ._slices import arrays_of

if TYPE_CHECKING:
    from ._samples import Samples

OPTIONS = ("drop_gaps", "minimum_piece_size", "output_points_precision")


def body_of(samples: Samples, arrays: Any, threads: Optional[int], progress: Progress, options: Mapping[str, Any],
            stacklevel: int) -> Isosurface:
    """Samples.body()."""
    for name in options:
        if name not in OPTIONS:
            raise TypeError(f"unknown option {name}: {hint(name, OPTIONS)}")
    chosen = make_options(True, {**options, "capping": True, "projection": None, "compute_normals": False})
    of_samples = arrays_of(samples, arrays)
    threads = samples._threads if threads is None else threads
    most_threads = thread_count(threads)
    with shown_progress(progress, "Finding the body") as report, samples._exclusive():
        samples._require_samples()
        _library.run(_library.set_threads, samples._extractor, most_threads)
        if samples._held != "body":
            samples._hold("body", np.zeros(len(samples)), [samples._excluded], {"progress": part(report, 0.0, 0.3)})
        surface = samples._surface([-math.inf], chosen, {"progress": part(report, 0.3, 1.0)})
        skipped = _library.get_skipped_count(samples._extractor)
    found = samples._interpolated(surface, of_samples, None)
    texts = list(samples._describe_left_out(skipped))
    if arrays is None and samples._differing:
        texts.append(_datasets.describe_differing(samples._differing))
    body = samples._as_isosurface(surface, found, [-math.inf], chosen, threads)
    if len(body) == 0:
        texts.append("There is no body: the samples are in one plane, or fewer than four.")
    for text in texts:
        warnings.warn(text, RuntimeWarning, stacklevel=stacklevel)
    return body
