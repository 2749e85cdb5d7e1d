# SPDX-License-Identifier: GPL-3.0-or-later
"""Values of scattered samples at places, and their gradients: see probe()."""

from __future__ import annotations

import contextlib
import math
from typing import Any, Iterator, Optional, Union

from . import _datasets
from ._progress import Progress, part, shown_progress
from ._samples import Samples


def probe(
    positions: Any,
    values: Any,
    places: Any,
    *,
    gradient: bool = False,
    method: str = "BLEND",
    outside: Union[float, str, None] = math.nan,
    threads: Optional[int] = None,
    progress: Progress = None,
) -> Any:
    """Interpolates scattered samples at places.

    Parameters
    ----------
    positions
        The samples' positions, shape (n, 3), in any unit of length. Or a data set instead: any grid or
        composite of VTK, PyVista or vedo.
    values
        Numbers of the samples, shape (n,) or (n, c), or a mapping of names to such arrays: all share one search.
        Where one is not finite or masked, this array gets its value from the other samples around. For a data set
        also the name of an array of points or cells, or a list of names.
    places
        Where to interpolate, shape (m, 3), or a data set, at its points.
    gradient
        Whether to compute gradients, too.
    method
        "BLEND": the mean of four local fits, weighted by their estimated errors. "CUBIC", "QUADRATIC" and "AFFINE":
        a fit of this degree, linear in the values. "NEAREST": the nearest sample.
    outside
        What places outside the samples get: a number, "nearest" for the value of the nearest sample, or None for
        what the method gives there.
    threads
        Maximum number of threads; None: all available cores. The result does not depend on it.
    progress
        A function that is called with the share done, from 0 to 1; an exception in it ends the work. True:
        a bar, by tqdm or rich.

    Returns
    -------
    Values of float64, shape (m,) or (m, c). "NEAREST" keeps float32, float64 and integers, which are 0 outside if
    they cannot be the number. Of other types, bool gives uint8, float16 float32, and longdouble float64; integers
    with masked entries give float32 up to 16 bits, and float64 above. With gradient, a pair of these and of
    gradients, shape (m, 3) or (m, c, 3). A dict of arrays gives dicts.

    Raises
    ------
    ValueError, TypeError
        If arguments have a wrong shape or type, an option is out of its range, or there are no samples.
    MemoryError
        If there is not enough memory.
    KeyboardInterrupt
        After Ctrl-C, within a fraction of a second.

    Warns
    -----
    RuntimeWarning
        About samples left out, about entries that are masked or not finite, and about samples in a plane, whose
        gradients have no normal part.

    Examples
    --------
    >>> import numpy as np
    >>> from scatteredisopoints import probe
    >>> positions = np.random.default_rng(1).random((2000, 3))
    >>> value, gradient = probe(positions, positions @ [1, 2, 3], [[0.5, 0.5, 0.5]], gradient=True)
    >>> value.round(6), gradient.round(6)
    (array([3.]), array([[1., 2., 3.]]))
    """
    with _loaded(positions, values, threads, progress) as (samples, report):
        return samples._probe(places, values, gradient, method, outside, None, report, stacklevel=3)


def gradient(
    positions: Any,
    values: Any,
    *,
    method: str = "BLEND",
    threads: Optional[int] = None,
    progress: Progress = None,
) -> Any:
    """Gradients at the samples themselves, shape (n, 3) or (n, c, 3): :func:`probe` describes parameters and errors.

    A mapping of names to arrays gives a dict. Of a data set, the samples are the points or the cells with the array.
    """
    with _loaded(positions, values, threads, progress) as (samples, report):
        return samples._gradient(values, method, None, report, stacklevel=3)


@contextlib.contextmanager
def _loaded(source: Any, values: Any, threads: Optional[int], progress: Progress) -> Iterator[tuple[Samples, Progress]]:
    """The samples, and the progress of the work after loading."""
    if values is None:
        raise TypeError("values are missing: numbers of the samples, or the name of an array of a data set")
    with shown_progress(progress, "Probing") as report:
        samples = Samples._of(_datasets.samples_for(source, values), threads, progress=part(report, 0.0, 0.3))
        yield samples, part(report, 0.3, 1.0)
