# SPDX-License-Identifier: GPL-3.0-or-later
"""The accessor `scattered` of PyVista's data sets, found through the entry point group pyvista.accessors."""

from __future__ import annotations

import math
import threading
import warnings
import weakref
from collections import OrderedDict
from typing import Any, Callable, Optional, Sequence, Union

import numpy as np
import pyvista as pv

from . import _datasets, _library
from ._arrays import CELL, POINT, are_names, positions_of
from ._grids import derivatives, grid_in
from ._options import hint, switch
from ._progress import Progress, shown_progress
from ._samples import Samples
from ._splats import polygons_of


# Parameters of the accessor by those of contour().
_NAMES = {"values": "scalars", "isovalues": "isosurfaces", "progress": "progress_bar"}


@pv.register_dataset_accessor("scattered", pv.DataObject)
class ScatteredAccessor:
    """Isosurfaces and values of points without a mesh: ``dataset.scattered.contour()``.

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
        for name in options.keys() & _NAMES.keys():
            raise TypeError(f"unknown option {name}: did you mean {_NAMES[name]}?")
        keeps = options.get("keep_tree", True)
        samples = self._load(scalars, preference, progress_bar, threads, keeps)
        if isinstance(isosurfaces, (int, np.integer)) and not isinstance(isosurfaces, bool):
            if isosurfaces < 0:
                raise ValueError(f"isosurfaces cannot be {isosurfaces}: give their number, 0 or more, or a list of"
                                 " isovalues")
            if rng is not None and (np.shape(rng) != (2,) or np.asarray(rng).dtype.kind not in "fiu"):
                raise ValueError(f"rng cannot be {rng!r}: rng has two values, the least and the greatest isovalue")
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

    def probe(
        self,
        where: Union[pv.DataSet, np.ndarray, Sequence[Sequence[float]]],
        scalars: Union[str, Sequence[str], np.ndarray, None] = None,
        *,
        gradient: bool = False,
        method: str = "BLEND",
        outside: Union[float, str, None] = math.nan,
        preference: str = "point",
        progress_bar: bool = False,
        threads: Optional[int] = None,
    ) -> pv.DataSet:
        """Interpolate arrays of scattered samples at points.

        Parameters
        ----------
        where : pyvista.DataSet | array_like[float]
            Points, or a data set, at its points.
        scalars : str | sequence[str] | array_like[float], optional
            Names of arrays of points or cells, or numbers for each of them. By default all arrays of
            ``preference``, or else of the others.
        gradient : bool, default: False
            Whether to add gradients, too, named as the array and ``_gradient``. The index of a component varies
            slower than that of a derivative, as in :meth:`compute_derivative`.
        method, outside
            As in :func:`scatteredisopoints.probe`.
        preference : str, default: "point"
            Whether ``scalars`` names arrays of points (``"point"``) or cells (``"cell"``) if there are both.
        progress_bar : bool, default: False
            Display a progress bar, which requires tqdm or rich.
        threads : int, optional
            Maximum number of threads. By default all available cores.

        Returns
        -------
        pyvista.DataSet
            A shallow copy of ``where``, or a ``PolyData`` of points, with the arrays.

        Examples
        --------
        >>> import numpy as np
        >>> import pyvista as pv
        >>> cloud = pv.PolyData(np.random.default_rng(1).random((20000, 3)))
        >>> cloud["height"] = cloud.points[:, 2]
        >>> plane = pv.Plane(center=(0.5, 0.5, 0.5), i_size=0.5, j_size=0.5)
        >>> bool(np.allclose(cloud.scattered.probe(plane)["height"], 0.5))
        True
        """
        return self._probe(where, scalars, gradient, method, outside, preference, progress_bar, threads)

    def sample_over_line(
        self,
        pointa: Sequence[float],
        pointb: Sequence[float],
        resolution: int = 1000,
        scalars: Union[str, Sequence[str], np.ndarray, None] = None,
        **options: Any,
    ) -> pv.PolyData:
        """Interpolate arrays along a line.

        Parameters
        ----------
        pointa, pointb : sequence[float]
            The ends of the line.
        resolution : int, default: 1000
            Number of pieces of the line, one less than its points.
        scalars, **options
            As in :meth:`probe`.

        Returns
        -------
        pyvista.PolyData
            The line, with the arrays and ``Distance`` from its begin.
        """
        return self._probe(pv.Line(pointa, pointb, resolution=resolution), scalars, **_checked_options(options))

    def to_grid(
        self,
        dimensions: Union[int, Sequence[int], None] = None,
        spacing: Union[float, Sequence[float], None] = None,
        bounds: Optional[Sequence[float]] = None,
        scalars: Union[str, Sequence[str], np.ndarray, None] = None,
        **options: Any,
    ) -> pv.ImageData:
        """Interpolate arrays at the points of a uniform grid.

        Parameters
        ----------
        dimensions : int | sequence[int], optional
            Number of points along all axes, or along each, if ``spacing`` is not given.
        spacing : float | sequence[float], optional
            Distance of points along all axes, or along each, if ``dimensions`` are not given.
        bounds : sequence[float], optional
            ``(x_min, x_max, y_min, ...)`` of the grid, by default those of the data set. With ``spacing`` the grid
            may end beyond, by less than one spacing.
        scalars, **options
            As in :meth:`probe`.

        Returns
        -------
        pyvista.ImageData
            The grid, with the arrays.
        """
        box = np.reshape(self._dataset.bounds if bounds is None else bounds, (3, 2)).astype(float)
        return self._probe(grid_in(box, dimensions, spacing), scalars, **_checked_options(options))

    def compute_derivative(
        self,
        scalars: Union[str, np.ndarray, None] = None,
        gradient: Union[bool, str] = True,
        divergence: Union[bool, str, None] = None,
        vorticity: Union[bool, str, None] = None,
        qcriterion: Union[bool, str, None] = None,
        *,
        method: str = "BLEND",
        preference: str = "point",
        progress_bar: bool = False,
        threads: Optional[int] = None,
    ) -> pv.DataSet:
        """Compute derivatives of an array at the samples themselves.

        Parameters
        ----------
        scalars : str | array_like[float], optional
            Name of an array of points or cells, or numbers for each of them. By default the active scalars.
        gradient, divergence, vorticity, qcriterion : bool | str, optional
            Whether to compute each, or the name of its array, by default ``"gradient"`` and so on. All but the
            gradient need three components.
        method, preference, progress_bar, threads
            As in :meth:`probe`.

        Returns
        -------
        pyvista.DataSet
            A shallow copy of the data set with the arrays, at points or cells as the samples are. A gradient has
            the order of ``vtkGradientFilter``: x, y and z derivatives of the first component, then of the next.
        """
        if scalars is None:
            scalars, preference = _active_scalars(self._dataset)
        if are_names(scalars):
            raise TypeError("scalars are one array: call compute_derivative() for each")
        wanted = {name: name if flag is True else flag for name, flag in (
            ("gradient", gradient), ("divergence", divergence), ("vorticity", vorticity), ("qcriterion", qcriterion))
            if isinstance(flag, str) or (flag is not None and switch(name, flag))}
        samples, _ = self._samples_with(scalars, preference, progress_bar, threads)
        if not hasattr(self._dataset, "GetCellData"):
            raise TypeError(f"A {type(self._dataset).__name__} has no samples of its own: call compute_derivative()"
                            " for each block.")
        places = samples._current("positions", samples._positions)
        _, gradients = samples._probe(places, scalars, True, method, math.nan, threads, progress_bar, stacklevel=3)
        count = math.prod(gradients.shape[1:-1])
        if count != 3 and set(wanted) - {"gradient"}:
            raise ValueError(f"{' and '.join(set(wanted) - {'gradient'})} need an array of three components, not of"
                             f" {count}: choose vectors as scalars")
        found = derivatives(gradients.reshape(len(places), count, 3))
        result = self._dataset.copy(deep=False)
        for name, label in wanted.items():
            (result.cell_data if samples._association == CELL else result.point_data)[label] = found[name]()
        return result

    def _probe(self, where: Any, scalars: Any, gradient: bool = False, method: str = "BLEND",
               outside: Union[float, str, None] = math.nan, preference: str = "point",
               progress_bar: bool = False, threads: Optional[int] = None) -> Any:
        data = _datasets.data_object(where)
        result = pv.PolyData(positions_of(where, "places").copy()) if data is None else pv.wrap(data)
        if not isinstance(result, pv.DataSet):
            raise TypeError(f"A {type(where).__name__} has no points of its own: pass its blocks, or combine them"
                            " first.")
        samples, arrays = self._samples_with(scalars, preference, progress_bar, threads)
        found = samples._probe(np.asarray(result.points), arrays, gradient, method, outside, threads, progress_bar,
                               stacklevel=4)
        values, gradients = found if gradient else (found, {})
        result = result.copy(deep=False)
        for name, array in [*values.items(), *((name + "_gradient", array) for name, array in gradients.items())]:
            if len(array):  # PyVista allows no empty array
                result.point_data[name] = array.reshape(len(array), -1) if array.ndim > 1 else array
        return result

    def _samples_with(self, scalars: Any, preference: str, progress: Progress, threads: Optional[int]
                      ) -> tuple[Samples, dict[str, Any]]:
        """The samples without values, kept for the next call, and the arrays to probe."""
        data = self._checked(preference)
        associations: tuple[int, ...] = (CELL, POINT) if preference == "cell" else (POINT, CELL)
        names = [scalars] if isinstance(scalars, str) else scalars if are_names(scalars) else []
        if scalars is not None and not names:
            associations = (_datasets.association_of(data, np.shape(scalars)),)
        samples = _kept_samples(
            data, ("without values", *names, *associations),
            lambda: _datasets.samples_with(data, names, associations), progress, threads, True)
        if scalars is None:
            uses = samples._maker.uses
            names = [name for name in samples._arrays or {} if uses.get(name) != _datasets.PEDIGREE_IDS]
        elif not names:
            return samples, {"values": scalars}
        return samples, {name: name for name in names}

    def _checked(self, preference: str) -> Any:
        data = self._dataset
        if not (data.IsA("vtkDataSet") or data.IsA("vtkCompositeDataSet")):
            raise TypeError(f"A {type(data).__name__} has no samples: make a pyvista.PolyData of its"
                            " positions first.")
        if preference not in ("point", "cell"):
            raise ValueError(f"preference cannot be {preference!r}: it is 'point' or 'cell'")
        return data

    def _load(self, scalars: Any, preference: str, progress: Progress, threads: Optional[int], keeps: bool) -> Samples:
        data = self._checked(preference)
        if scalars is None:
            scalars, preference = _active_scalars(data)
        if not isinstance(scalars, str):
            return _loaded(_datasets.samples_of(data, scalars), progress, threads)
        associations = (CELL, POINT) if preference == "cell" else (POINT, CELL)
        return _kept_samples(data, (scalars, *associations), lambda: _datasets.samples_of(data, scalars, associations),
                             progress, threads, keeps)


def _checked_options(options: dict[str, Any]) -> dict[str, Any]:
    """Those of ScatteredAccessor.probe(). Raises TypeError if one is not."""
    names = ("gradient", "method", "outside", "preference", "progress_bar", "threads")
    for name in options:
        if name not in names:
            raise TypeError(f"unknown option {name}: {hint(name, names)}")
    return options


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


def _kept_samples(data: Any, choice: tuple, find: Callable[[], _datasets.DataSamples], progress: Progress,
                  threads: Optional[int], keeps: bool) -> Samples:
    """The samples of a data set that a function finds for a choice of arrays; reuses those of the last call, or
    their tree. Keeps them for the next one if wanted."""
    id_, key = id(data), (choice, _datasets.state_of(data))
    with _lock:
        kept = _kept.pop(id_, None)
    samples = kept[2] if kept is not None and kept[0]() is data else None
    if samples is None or kept[1] != key:
        samples = _loaded(find(), progress, threads, samples)
    if not keeps:
        return samples
    with _lock:
        _kept[id_] = weakref.ref(data, lambda _: _kept.pop(id_, None)), key, samples
        while len(_kept) > MOST_KEPT:
            _kept.popitem(last=False)
    return samples
