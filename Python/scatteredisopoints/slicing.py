# SPDX-License-Identifier: GPL-3.0-or-later
"""Slices of scattered samples: see slice_samples()."""

from __future__ import annotations

from typing import Any, Iterable, Optional, Union

from ._cuts import Normal
from ._datasets import samples_for
from ._isosurface import Isosurface
from ._option_types import SliceOptions, Unpack
from ._progress import Progress, part, shown_progress
from ._samples import Samples
from ._slices import sliced


def slice_samples(
    positions: Any,
    arrays: Any = None,
    normal: Optional[Normal] = None,
    origin: Any = None,
    *,
    function: Any = None,
    offsets: Union[float, Iterable[float]] = 0.0,
    interpolation: str = "fits",
    threads: Optional[int] = None,
    progress: Progress = None,
    **options: Unpack[SliceOptions],
) -> Isosurface:
    """Slices scattered samples along a plane or another implicit function: triangles with all arrays, which end
    where the samples end.

    Parameters
    ----------
    positions
        The samples' positions, shape (n, 3), in any unit of length. Or a data set instead: any grid or
        composite of VTK, PyVista or vedo.
    arrays
        Numbers of the samples, shape (n,) or (n, c), or a mapping of names to such arrays. For a data set also the
        name of an array of points or cells, or a list of names. None: all arrays of the data set.
    normal
        Of the plane: "x", "y", "z", "-x", "-y", "-z" or a vector; None: "x".
    origin
        A place on the plane; None: the center of the samples' bounds.
    function
        Instead of a plane a function of places, shape (m, 3), that returns m numbers, or a vtkImplicitFunction. The
        slice is where it is 0. It must be finite at the samples.
    offsets
        Values of the function on slices, one or several: for a plane distances along its normal.
    interpolation
        "fits": local polynomials, as :func:`probe` fits them with outside=None. "linear": linear along the edges
        between samples. "nearest": the value of the nearest sample, as for numbers of materials.
    threads, progress
        As in :func:`contour`.
    **options
        drop_gaps=False: the slice of the whole convex hull. regularize=False: the exact slice of the Delaunay
        tetrahedralization. output_points_precision="SINGLE_PRECISION" or "DOUBLE_PRECISION".

    Returns
    -------
    Isosurface
        Triangles, counterclockwise seen from the side to which the normal does not point, and arrays, which keep
        their types: integers are rounded. One array without a name is called "values".

    Raises
    ------
    ValueError, TypeError
        If arguments have a wrong shape or type, an option is unknown or out of its range, or there are no samples.
    MemoryError
        If there is not enough memory.
    KeyboardInterrupt
        After Ctrl-C, within a fraction of a second.

    Warns
    -----
    RuntimeWarning
        If the slice is empty.

    Examples
    --------
    >>> import numpy as np
    >>> from scatteredisopoints import slice_samples
    >>> positions = np.random.default_rng(1).random((20000, 3))
    >>> plane = slice_samples(positions, positions.sum(axis=1), "z", (0.5, 0.5, 0.3))
    >>> bool(np.allclose(plane.arrays["values"], plane.points.sum(axis=1)))
    True
    """
    with shown_progress(progress, "Slicing") as report:
        samples = Samples._of(samples_for(positions, arrays), threads, progress=part(report, 0.0, 0.2))
        return sliced(samples, normal, origin, arrays, function, offsets, interpolation, None, part(report, 0.2, 1.0),
                      options, stacklevel=3)
