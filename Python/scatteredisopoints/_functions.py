# SPDX-License-Identifier: GPL-3.0-or-later
"""Isosurfaces, bodies, slices, values and gradients in one call each."""

from __future__ import annotations

import contextlib
import math
from typing import Any, Iterable, Iterator, Mapping, Optional, Union

from ._arrays import levels_of
from ._bodies import body_with_warnings
from ._cuts import Normal
from ._datasets import data_object, samples_for_call
from ._isosurface import Isosurface
from ._option_types import BodyOptions, ContourOptions, SliceOptions, Unpack
from ._progress import Progress, part, shown_progress
from ._samples import Samples
from ._slices import slice_with_warnings


def contour(
    positions: Any,
    values: Any = None,
    isovalues: Union[float, Iterable[float], None] = None,
    *,
    triangles: bool = False,
    arrays: Optional[Mapping[str, Any]] = None,
    threads: Optional[int] = None,
    progress: Progress = None,
    **options: Unpack[ContourOptions],
) -> Isosurface:
    """Extracts isosurfaces from scattered samples, as points or as triangles.

    Parameters
    ----------
    positions
        The samples' positions, shape (n, 3), in any unit of length. float32 and float64 arrays in native
        byte order are not copied. Or a data set instead of arrays: any grid or composite of VTK, PyVista or
        vedo.
    values
        The samples' values, shape (n,), of any real type; integers count as rounded. Samples with a
        non-finite or masked value are skipped. For a data set: the name of a point or cell array, an array
        with one value per point or cell, or None for the active scalars of its points.
    isovalues
        One or several (any iterable), in the unit of the values: 10 is the isovalue 10. The accessor of PyVista's
        data takes a number of surfaces instead, as PyVista does.
    triangles
        Whether to connect points by triangles instead of giving them radii.
    arrays
        Further arrays of the samples to interpolate, by name, with shapes (n,) or (n, ...). Not for a data set,
        which has its own. Those of text or times are left out, with a warning.
    threads
        Maximum number of threads; None: all available cores. The result does not depend on it.
    progress
        A function that is called with the share done, from 0 to 1; an exception in it ends the work. True:
        a bar, by tqdm or rich.
    **options
        Properties of the filters in snake case: projection="crease_fit" (or "cubic_fit", the default,
        "quadratic_fit", "linear_fit", None), drop_gaps=False, compute_gradients=True,
        compute_projection_orders=True, compute_normals=False, compute_scalars=False, keep_tree=False,
        normal_method="normals_from_planes" (or "normals_from_field"),
        output_points_precision="single_precision" (or "double_precision"). Of points only: compute_splats=False,
        angle=54.7, number_of_neighbors=12. Of triangles only: regularize=False, capping=True and
        minimum_piece_size=0.01.

        capping closes the body of the samples at or above the isovalue where they end. minimum_piece_size is the
        least area of a connected component, as a share of the largest one's: it leaves out droplets and the bubbles
        in them. With gradient_direction="ascent", as in scikit-image, the body has the values at or below the
        isovalue, as that of a distance does: normals, triangles and caps are those of the negated values.

    Returns
    -------
    Isosurface
        Points, normals, radii or triangles, and all arrays.

    Raises
    ------
    ValueError, TypeError
        If arguments have a wrong shape or type, an option is unknown or out of its range, or there are no
        samples.
    MemoryError
        If there is not enough memory for the tree or the result.
    KeyboardInterrupt
        After Ctrl-C, within a fraction of a second.

    Warns
    -----
    RuntimeWarning
        About skipped samples, isovalues without a surface, and the like.

    Examples
    --------
    >>> import numpy as np
    >>> from scatteredisopoints import contour
    >>> positions = np.random.default_rng(1).random((20000, 3))
    >>> surface = contour(positions, np.linalg.norm(positions - 0.5, axis=1), 0.3)
    >>> float(np.abs(np.linalg.norm(surface.points - 0.5, axis=1) - 0.3).max()) < 1e-3
    True
    """
    if values is None and data_object(positions) is None:
        raise TypeError("values are missing: one for each position")
    levels = levels_of("isovalues", isovalues)
    with shown_progress(progress, "Contouring") as report:
        samples = Samples(positions, values, threads=threads, progress=part(report, 0.0, 0.5))
        return samples._contour(
            levels, triangles, arrays, None, part(report, 0.5, 1.0), options, stacklevel=3)


def body(
    positions: Any,
    *,
    arrays: Any = None,
    threads: Optional[int] = None,
    progress: Progress = None,
    **options: Unpack[BodyOptions],
) -> Isosurface:
    """Finds the closed surface of all samples, such as particles, from their positions alone.

    Parameters
    ----------
    positions, arrays, threads, progress
        As in :func:`slice_samples`.
    **options
        drop_gaps=False: the convex hull. minimum_piece_size, output_points_precision: as in :func:`contour`.

    Returns
    -------
    Isosurface
        Triangles between samples, counterclockwise seen from outside: closed, each edge with two triangles, each
        point with one fan. Arrays are those of the samples. Errors and warnings are as in :func:`contour`. The
        surface passes through the outermost samples: its volume is less than that of particles which extend beyond
        their centers, by 7 % for 4,000 particles, by two thirds for 19.

    Examples
    --------
    >>> import numpy as np
    >>> from scatteredisopoints import body
    >>> positions = np.random.default_rng(1).random((20000, 3))
    >>> bool(0.95 < body(positions).volume < 1.0)
    True
    """
    with _loaded(positions, arrays, "Finding the body", threads, progress) as (samples, report):
        return body_with_warnings(samples, arrays, None, report, options, stacklevel=3)


def slice_samples(
    positions: Any,
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
    """Slices scattered samples along a plane or another implicit function: triangles with all arrays, which end
    where the samples end.

    Parameters
    ----------
    positions, threads, progress
        As in :func:`contour`.
    normal
        Of the plane: "x", "y", "z", "-x", "-y", "-z" or a vector; None: "x".
    origin
        A place on the plane; None: the center of the samples' bounds.
    arrays
        Numbers of the samples, shape (n,) or (n, c), or a mapping of names to such arrays. For a data set also the
        name of an array of points or cells, or a list of names. None: all arrays of the data set.
    function
        Instead of a plane a function of places, shape (m, 3), that returns m numbers, or a vtkImplicitFunction. The
        slice is where it is 0. It must be finite at the samples.
    offsets
        Values of the function on slices, one or several: for a plane distances along its normal.
    interpolation
        "fits": local polynomials, as :func:`probe` fits them with outside=None. "linear": linear along the edges
        between samples. "nearest": the value of the nearest sample, as for numbers of materials.
    nearest_arrays
        Names of arrays that take the value of the nearest sample in any case. Of a data set, ids do: global, pedigree
        and process ids, and arrays of the type vtkIdType.
    **options
        drop_gaps=False: the slice of the whole convex hull. regularize=False: the exact slice of the Delaunay
        tetrahedralization. output_points_precision="single_precision" or "double_precision".

    Returns
    -------
    Isosurface
        Triangles, counterclockwise seen from the side to which the normal does not point, and arrays, which keep their
        types: integers are rounded, and stay within the samples' range. With masked entries they become real numbers,
        which may go beyond it. One array without a name is called "values". Errors and warnings are as in
        :func:`contour`.

    Examples
    --------
    >>> import numpy as np
    >>> from scatteredisopoints import slice_samples
    >>> positions = np.random.default_rng(1).random((20000, 3))
    >>> plane = slice_samples(positions, "z", (0.5, 0.5, 0.3), arrays=positions.sum(axis=1))
    >>> bool(np.allclose(plane.arrays["values"], plane.points.sum(axis=1)))
    True
    """
    with _loaded(positions, arrays, "Slicing", threads, progress) as (samples, report):
        return slice_with_warnings(samples, normal, origin, arrays, function, offsets, interpolation, None, report,
                                   options, stacklevel=3, nearest_arrays=nearest_arrays)


def probe(
    positions: Any,
    values: Any,
    places: Any,
    *,
    gradient: bool = False,
    method: str = "blend",
    outside: Union[float, str, None] = math.nan,
    nearest_arrays: Union[str, Iterable[str]] = (),
    threads: Optional[int] = None,
    progress: Progress = None,
) -> Any:
    """Interpolates scattered samples at places.

    Parameters
    ----------
    positions, threads, progress
        As in :func:`contour`.
    values
        Numbers of the samples, shape (n,) or (n, c), or a mapping of names to such arrays: all share one search.
        Where one is not finite or masked, this array gets its value from the other samples around. For a data set
        also the name of an array of points or cells, or a list of names.
    places
        Where to interpolate, shape (m, 3), (3,) of a single place, or any (..., 3); or a data set, at its points.
    gradient
        Whether to compute gradients, too.
    method
        "blend": the mean of four local fits, weighted by their estimated errors. "cubic", "quadratic" and "affine":
        a fit of this degree, linear in the values. "nearest": the nearest sample.
    outside
        What places outside the samples get: a number, "nearest" for the value of the nearest sample, or None for
        what the method gives there.
    nearest_arrays
        Names of arrays that take the nearest value by any method, as in :func:`slice_samples`, and their gradients 0.

    Returns
    -------
    Values of float64, shape (m,) or (m, c); those of integers without masked entries stay within the samples' range.
    The nearest value keeps float32, float64 and integers, which are 0 outside if they cannot be the number. Of other
    types, bool gives uint8, float16 float32, and longdouble float64; integers with masked entries give float32 up to 16
    bits, and float64 above. With gradient, a pair of these and of gradients, shape (m, 3) or (m, c, 3); for m, the
    shape of the places without their last axis. A dict of arrays gives dicts. Errors and warnings are as in
    :func:`contour`.

    Examples
    --------
    >>> import numpy as np
    >>> from scatteredisopoints import probe
    >>> positions = np.random.default_rng(1).random((2000, 3))
    >>> value, gradient = probe(positions, positions @ [1, 2, 3], [[0.5, 0.5, 0.5]], gradient=True)
    >>> value.round(6), gradient.round(6)
    (array([3.]), array([[1., 2., 3.]]))
    """
    _require(values)
    with _loaded(positions, values, "Probing", threads, progress) as (samples, report):
        return samples._probe(places, values, gradient, method, outside, None, report, stacklevel=3,
                              nearest_arrays=nearest_arrays)


def gradient(
    positions: Any,
    values: Any,
    *,
    method: str = "blend",
    threads: Optional[int] = None,
    progress: Progress = None,
) -> Any:
    """Gradients at the samples themselves, shape (n, 3) or (n, c, 3): :func:`probe` describes parameters and errors.

    A mapping of names to arrays gives a dict. Of a data set, the samples are the points or the cells with the array.

    Examples
    --------
    >>> import numpy as np
    >>> from scatteredisopoints import gradient
    >>> positions = np.random.default_rng(1).random((2000, 3))
    >>> bool(np.allclose(gradient(positions, positions @ [1, 2, 3]), [1, 2, 3]))
    True
    """
    _require(values)
    with _loaded(positions, values, "Probing", threads, progress) as (samples, report):
        return samples._gradient(values, method, None, report, stacklevel=3)


def _require(values: Any) -> None:
    if values is None:
        raise TypeError("values are missing: numbers of the samples, or the name of an array of a data set")


@contextlib.contextmanager
def _loaded(source: Any, arrays: Any, title: str, threads: Optional[int], progress: Progress
            ) -> Iterator[tuple[Samples, Progress]]:
    """Samples without values, and the progress of the work after loading."""
    with shown_progress(progress, title) as report:
        samples = Samples._from_data(samples_for_call(source, arrays), threads, progress=part(report, 0.0, 0.2))
        yield samples, part(report, 0.2, 1.0)
