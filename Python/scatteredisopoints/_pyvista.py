# SPDX-License-Identifier: GPL-3.0-or-later
"""The accessor `scattered` of PyVista's data sets, found through the entry point group pyvista.accessors."""

from __future__ import annotations

import threading
import warnings
import weakref
from collections import OrderedDict
from typing import Any, Optional, Sequence, Union

import numpy as np
import pyvista as pv

from . import _datasets, _library
from ._arrays import CELL, POINT
from ._progress import Progress, shown_progress
from ._samples import Samples
from ._splats import polygons_of


@pv.register_dataset_accessor("scattered", pv.DataObject)
class ScatteredAccessor:
    """Isosurfaces of points without a mesh: ``dataset.scattered.contour()``.

    Ignores the cells of grids: points, or the centers of cells, are the samples.
    """

    def __init__(self, dataset: Any):
        self._dataset = dataset

    def contour(
        self,
        isosurfaces: Union[int, Sequence[float]] = 10,
        scalars: Union[str, np.ndarray, None] = None,
        *,
        triangles: bool = True,
        rng: Optional[Sequence[float]] = None,
        preference: str = "point",
        progress_bar: bool = False,
        threads: Optional[int] = None,
        **options: Any,
    ) -> pv.PolyData:
        """Extract isosurfaces from scattered samples.

        Parameters
        ----------
        isosurfaces : int | sequence[float], default: 10
            Number of isosurfaces, evenly spaced, or their values.
        scalars : str | array_like[float], optional
            Name of an array of points or cells, or values for each of them. By default the active scalars.
        triangles : bool, default: True
            Whether to connect points by triangles. ``False`` yields isopoints with normals and radii, which
            :meth:`splats` turns into polygons.
        rng : sequence[float], optional
            Least and greatest isovalue for a number of isosurfaces. By default they are inside the range of
            all samples, because there is no surface at its ends.
        preference : str, default: "point"
            Whether ``scalars`` names an array of points (``"point"``) or cells (``"cell"``) if there are
            both.
        progress_bar : bool, default: False
            Display a progress bar, which requires tqdm or rich.
        threads : int, optional
            Maximum number of threads. By default all available cores.
        **options : dict, optional
            Options of :func:`scatteredisopoints.contour`, such as ``drop_gaps=False`` or
            ``regularize=False``.

        Returns
        -------
        pyvista.PolyData
            The isosurfaces, with ``Normals`` and all arrays of the samples.

        Notes
        -----
        The tree is kept unless ``keep_tree=False``: further isosurfaces of the same data take a fraction of
        the time. After changes of the data set or its scalars that PyVista notices, such as ``mesh["a"] =
        ...`` or ``mesh.points[0] = ...``, values or samples are loaded again; call ``mesh.Modified()`` after
        other changes.

        Examples
        --------
        >>> import numpy as np
        >>> import pyvista as pv
        >>> cloud = pv.PolyData(np.random.default_rng(1).random((20000, 3)))
        >>> cloud["distance"] = np.linalg.norm(cloud.points - 0.5, axis=1)
        >>> surface = cloud.scattered.contour([0.3], "distance")
        >>> surface.is_manifold
        True
        """
        keeps = options.get("keep_tree", True)
        samples = self._load(scalars, preference, progress_bar, threads, keeps)
        if isinstance(isosurfaces, (int, np.integer)) and not isinstance(isosurfaces, bool):
            if isosurfaces < 0 or (rng is not None and np.shape(rng) != (2,)):
                raise ValueError("isosurfaces are a number, 0 or more, and rng has two values, least and greatest")
            count = int(isosurfaces)
            isosurfaces = (np.linspace(*samples.range, count + 2)[1:-1].tolist() if rng is None
                           else np.linspace(rng[0], rng[1], count).tolist())
        surface = samples._contour(
            isosurfaces, triangles, options.pop("arrays", None), threads, progress_bar, options, stacklevel=3)
        return surface.polydata

    def splats(self, scale: float = 1.0, *, threads: Optional[int] = None) -> pv.PolyData:
        """Turn isopoints into polygons that show them as a closed surface.

        Parameters
        ----------
        scale : float, default: 1.0
            Factor on the size of splats.
        threads : int, optional
            Maximum number of threads. By default all available cores.

        Returns
        -------
        pyvista.PolyData
            Triangles with normals: draw them with ``smooth_shading=True``.

        Notes
        -----
        Filters that keep the cells of points, such as ``clip`` and ``threshold``, keep their splats. Points
        with only normals become octagons.

        Examples
        --------
        >>> isopoints = cloud.scattered.contour([0.3], triangles=False)  # doctest: +SKIP
        >>> isopoints.scattered.splats().plot(smooth_shading=True)  # doctest: +SKIP
        """
        polygons, problem = polygons_of(self._dataset, "Radius", 0.0, scale, threads=threads)
        if problem:
            warnings.warn(problem, RuntimeWarning, stacklevel=2)
        return polygons

    def _load(self, scalars: Any, preference: str, progress: Progress, threads: Optional[int], keeps: bool) -> Samples:
        data = self._dataset
        if not (data.IsA("vtkDataSet") or data.IsA("vtkCompositeDataSet")):
            raise TypeError(f"A {type(data).__name__} has no samples: make a pyvista.PolyData of its"
                            " positions first.")
        if preference not in ("point", "cell"):
            raise ValueError(f"preference cannot be {preference!r}: it is 'point' or 'cell'")
        if scalars is None:
            scalars, preference = _active_scalars(data)
        if not isinstance(scalars, str):
            return _loaded(_datasets.samples_of(data, scalars), progress, threads)
        return _kept_samples(data, scalars, preference, progress, threads, keeps)


def _loaded(found: _datasets.DataSamples, progress: Progress, threads: Optional[int],
            kept: Optional[Samples] = None) -> Samples:
    """Samples of a data object, in the place of others, whose tree serves if the positions are the same."""
    with shown_progress(progress, "Loading samples") as report:
        if kept is None:
            return Samples._of(found, threads, progress=report)
        kept._threads = threads
        kept._take(found, progress=report)
        return kept


def _active_scalars(data: Any) -> tuple[str, str]:
    """The name and the association of the active scalars of the first data set that has some."""
    for leaf in _datasets.leaves(data):
        info = leaf.active_scalars_info if isinstance(leaf, pv.DataSet) and leaf.n_points else None
        if info is not None and info.name is not None:
            return info.name, info.association.name.lower()
    raise ValueError("There are no active scalars: give the name of an array as scalars.")


# The trees of the data sets contoured last, by id. Accessors cannot keep them: they and their data sets
# live until garbage collection.
_kept: OrderedDict[int, tuple[Any, Any, Samples]] = OrderedDict()
_lock = threading.Lock()
MOST_KEPT = 2


@_library.at_fork
def _renew_lock() -> None:
    """A forked process lacks the thread that may hold it."""
    global _lock
    _lock = threading.Lock()


def _kept_samples(data: Any, scalars: str, preference: str, progress: Progress, threads: Optional[int],
                  keeps: bool) -> Samples:
    """The samples of a data set; reuses those of the last call, or their tree. Keeps them for the next one if
    wanted."""
    id_, key = id(data), (scalars, preference, _datasets.state_of(data))
    with _lock:
        kept = _kept.pop(id_, None)
    samples = kept[2] if kept is not None and kept[0]() is data else None
    if samples is None or kept[1] != key:
        associations = (CELL, POINT) if preference == "cell" else (POINT, CELL)
        samples = _loaded(_datasets.samples_of(data, scalars, associations), progress, threads, samples)
    if not keeps:
        return samples
    with _lock:
        _kept[id_] = weakref.ref(data, lambda _: _kept.pop(id_, None)), key, samples
        while len(_kept) > MOST_KEPT:
            _kept.popitem(last=False)
    return samples
