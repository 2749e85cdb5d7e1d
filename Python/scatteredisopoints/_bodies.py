# SPDX-License-Identifier: GPL-3.0-or-later
"""The body of all samples; docs/triangles.md in the source defines it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Mapping, Optional

import numpy as np

from . import _library
from ._isosurface import Isosurface
from ._option_types import BodyOptions
from ._options import check_names, make_options, thread_count
from ._progress import Progress, part, shown_progress
from ._slices import warn_of

if TYPE_CHECKING:
    from ._samples import Samples

OPTIONS = tuple(BodyOptions.__annotations__)


@dataclass
class Body:
    """A closed surface, and what tells why it may be empty."""

    isosurface: Isosurface
    dropped: int
    """The number of tetrahedra in gaps."""
    skipped: int
    """The number of samples without a finite position, and of hidden ones."""

    def describe_empty(self) -> Optional[str]:
        """Why there is no body, and the remedy; None if there is one."""
        if len(self.isosurface) > 0:
            return None
        return "There is no body: " + (
            "all of it is in gaps between samples. Turn drop_gaps off." if self.dropped > 0
            else "the samples are in one plane, or fewer than four.")


def make_body(samples: Samples, options: Mapping[str, Any], of_samples: Mapping[str, Any], threads: Optional[int],
              report: Any) -> Body:
    """The body of samples, with arrays by name. Calls `report` with the share done."""
    chosen = make_options(True, {**options, "capping": True, "projection": None, "compute_normals": False})
    threads = samples._threads if threads is None else threads
    most_threads = thread_count(threads)
    with samples._exclusive():
        samples._require_samples()
        _library.run(_library.set_threads, samples._extractor, most_threads)
        if samples._held != "body":
            samples._hold("body", np.zeros(len(samples)), [samples._excluded], {"progress": part(report, 0.0, 0.3)})
        surface = samples._surface([-math.inf], chosen, {"progress": part(report, 0.3, 1.0)})
        skipped = _library.get_skipped_count(samples._extractor)
    found = samples._interpolated(surface, of_samples, None)
    isosurface = samples._as_isosurface(surface, found, [-math.inf], chosen, threads)
    isosurface.cell_arrays = {}  # all is a cap
    return Body(isosurface, _library.get_dropped_count(surface), skipped)


def body_of(samples: Samples, arrays: Any, threads: Optional[int], progress: Progress, options: Mapping[str, Any],
            stacklevel: int) -> Isosurface:
    """Samples.body()."""
    check_names(options, OPTIONS)
    of_samples = samples._arrays_of(arrays)
    with shown_progress(progress, "Finding the body") as report:
        made = make_body(samples, options, of_samples, threads, report)
    warn_of(samples, made.isosurface, made.skipped, arrays is None, made.describe_empty(), stacklevel + 1)
    return made.isosurface
