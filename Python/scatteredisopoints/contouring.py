# SPDX-License-Identifier: GPL-3.0-or-later
"""Isosurfaces and bodies of NumPy arrays and data sets in one call: see contour() and body()."""

from __future__ import annotations

import importlib
from typing import Any, Iterable, Mapping, Optional, Union

from ._arrays import isovalues_of, package_of
from ._bodies import body_of
from ._datasets import data_object, samples_for
from ._isosurface import Isosurface
from ._option_types import BodyOptions, OptionsOfContour, Unpack
from ._progress import Progress, part, shown_progress
from ._samples import Samples


def contour(
    positions: Any,
    values: Any = None,
    isovalues: Union[float, Iterable[float], None] = None,
    *,
    triangles: bool = False,
    arrays: Optional[Mapping[str, Any]] = None,
    threads: Optional[int] = None,
    progress: Progress = None,
    **options: Unpack[OptionsOfContour],
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
        Further arrays of the samples to interpolate, by name, with shapes (n,) or (n, components). Not for
        a data set, which has its own.
    threads
        Maximum number of threads; None: all available cores. The result does not depend on it.
    progress
        A function that is called with the share done, from 0 to 1; an exception in it ends the work. True:
        a bar, by tqdm or rich.
    **options
        Properties of the filters in snake case: projection="CREASE_FIT" (or "CUBIC_FIT", the default,
        "QUADRATIC_FIT", "LINEAR_FIT", None), drop_gaps=False, compute_gradients=True,
        compute_projection_orders=True, compute_normals=False, compute_scalars=False, keep_tree=False,
        normal_method="NORMALS_FROM_PLANES" (or "NORMALS_FROM_FIELD"),
        output_points_precision="SINGLE_PRECISION" (or "DOUBLE_PRECISION"). Of points only: compute_splats=False,
        angle=54.7, number_of_neighbors=12. Of triangles only: regularize=False, capping=True and
        minimum_piece_size=0.01.

        capping closes the body of the samples at or above the isovalue where they end. minimum_piece_size is the
        least area of a connected component, as a share of the largest one's: it leaves out droplets and the bubbles
        in them. With gradient_direction="ascent", as in scikit-image, the body has the values at or below the
        isovalue, as that of a distance does: normals, triangles and caps are those of the negated values.

        With MPI, each process contours its own samples unless `controller` is given, which needs the compiled
        VTK classes: then all ranks must make this call, and only the first one raises errors.

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
    data = data_object(positions)
    if data is None and values is None:
        raise TypeError("values are missing: one for each position")
    if isovalues is None:
        raise TypeError("isovalues are missing: give one or several numbers")
    controller = options.get("controller")
    levels = isovalues_of(isovalues)
    # The filters' output does not tell the isovalue of each triangle, which areas and volumes need.
    is_told = not triangles or len(set(levels)) <= 1
    descends = options.get("gradient_direction", "descent") == "descent"
    if controller is not None or (
            threads is None and is_told and descends and data is not None and package_of(data) == "vtkmodules"):
        filters = compiled_filters()
        if filters is not None:
            return filters.filtered(positions if data is None else data, values,
                                    levels, triangles, arrays, progress, options)
        if controller is not None:
            raise TypeError("The option controller needs the compiled VTK classes: build this project"
                            " with VTK, as docs/installing.md in its source says.")
    options.pop("controller", None)
    with shown_progress(progress, "Contouring") as report:
        samples = Samples(positions, values, threads=threads, progress=part(report, 0.0, 0.5))
        return samples._contour(
            levels, triangles, arrays, None, part(report, 0.5, 1.0), options, stacklevel=3)


def body(
    positions: Any,
    arrays: Any = None,
    *,
    threads: Optional[int] = None,
    progress: Progress = None,
    **options: Unpack[BodyOptions],
) -> Isosurface:
    """Finds the closed surface of all samples, such as particles, from their positions alone.

    Parameters
    ----------
    positions
        The samples' positions, shape (n, 3), in any unit of length. Or a data set instead: any grid or composite of
        VTK, PyVista or vedo.
    arrays
        Numbers of the samples, shape (n,) or (n, c), or a mapping of names to such arrays. For a data set also the
        name of an array of points or cells, or a list of names. None: all arrays of the data set.
    threads, progress
        As in :func:`contour`.
    **options
        drop_gaps=False: the convex hull. minimum_piece_size, output_points_precision: as in :func:`contour`.

    Returns
    -------
    Isosurface
        Triangles between samples, counterclockwise seen from outside: closed, each edge with two triangles, each
        point with one fan. Arrays are those of the samples.

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
        About skipped samples, and if there is no body.

    Examples
    --------
    >>> import numpy as np
    >>> from scatteredisopoints import body
    >>> positions = np.random.default_rng(1).random((20000, 3))
    >>> bool(0.95 < body(positions).volume < 1.0)
    True
    """
    with shown_progress(progress, "Finding the body") as report:
        samples = Samples._of(samples_for(positions, arrays), threads, progress=part(report, 0.0, 0.2))
        return body_of(samples, arrays, None, part(report, 0.2, 1.0), options, stacklevel=3)


def compiled_filters() -> Optional[Any]:
    """The module that runs the compiled filters, or None if they are not installed."""
    try:
        return importlib.import_module("._filters", __package__)
    except ImportError:
        return None
