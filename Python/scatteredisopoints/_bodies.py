# SPDX-License-Identifier: GPL-3.0-or-later
"""The body of all samples; docs/triangles.md in the source defines it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Mapping, Optional

import numpy as np

from . import _library
from ._arrays import without_text
from ._isosurface import Isosurface
from ._option_types import BodyOptions
from ._options import OF_BODIES, check_names, make_options
from ._progress import Progress, part, shown_progress
from ._slices import warn_of

if TYPE_CHECKING:
    from ._samples import Samples

OPTIONS = tuple(BodyOptions.__annotations__)


def compute_body(samples: Samples, options: Mapping[str, Any], arrays: Any, threads: Optional[int], report: Any
                 ) -> tuple[Isosurface, list[_library.Message]]:
    """The body of samples, with arrays as of Samples.body(), and messages. Calls `report` with the share done."""
    chosen = make_options(True, {**options, "capping": True, "projection": None, "compute_normals": False})
    with samples._in_call(threads) as threads:
        of_samples, nearest = samples._arrays_of(arrays)
        of_samples = {name: array for name, array in of_samples.items() if not samples._has_global_ids(name)}
        if samples._loaded_key != "body":
            samples._load_values("body", np.zeros(len(samples)), [samples._excluded],
                                 {"progress": part(report, 0.0, 0.3)})
        surface = samples._surface([-math.inf], chosen, {"progress": part(report, 0.3, 1.0)})
        found = samples._interpolated(surface, of_samples, None, nearest)
    isosurface = samples._as_isosurface(surface, found, [-math.inf], chosen, threads)
    isosurface.cell_arrays = {}  # all is a cap
    return isosurface, _library.messages(surface)


def body_with_warnings(samples: Samples, arrays: Any, threads: Optional[int], progress: Progress,
                       options: Mapping[str, Any], stacklevel: int) -> Isosurface:
    """Samples.body()."""
    check_names(options, OPTIONS, OF_BODIES)
    arrays, of_text = without_text(arrays)
    with shown_progress(progress, "Finding the body") as report:
        made, messages = compute_body(samples, options, arrays, threads, report)
    warn_of(samples, made, messages, arrays is None, of_text, stacklevel + 1)
    return made
