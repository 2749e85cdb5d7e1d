# SPDX-License-Identifier: GPL-3.0-or-later
"""The accessor `scattered` of PyVista's data sets, found through the entry point group pyvista.accessors."""

from __future__ import annotations

import contextlib
import inspect
import math
import operator
import threading
import warnings
import weakref
from collections import OrderedDict
from typing import Any, Callable, Collection, Iterable, Iterator, Mapping, Optional, Sequence, Union

import numpy as np
import pyvista as pv

from . import _datasets, _library
from ._arrays import CELL, POINT, are_names, levels_of, package_of
from ._bodies import body_with_warnings
from ._cuts import three_numbers
from ._derivatives import DERIVATIVES, names_of_derivatives
from ._lines_and_grids import box_of, grid_in, line_between
from ._option_types import BodyOptions, ContourOptions, SliceOptions, Unpack
from ._options import check_names, named, parameters_of, switch, unknown_option
from ._polydata import as_vtk
from ._progress import Progress, shown_progress
from ._samples import Samples
from ._slices import slice_with_warnings
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

    def __repr__(self) -> str:
        methods = [name for name in dir(self) if not name.startswith("_")]
        return f"<scattered of a {type(self._dataset).__name__}: {', '.join(methods)}>"

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
        **options: Unpack[ContourOptions],
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
            Options of :func:`scatteredisopoints.contour`, such as ``capping=True`` or ``drop_gaps=False``.

        Returns
        -------
        pyvista.PolyData
            The isosurfaces, with ``Normals`` and all arrays of the samples.

        Notes
        -----
        The tree is kept unless ``keep_tree=False``: further isosurfaces of the same data take a fraction of
        the time. After changes of points or arrays, also in memory that NumPy's arrays share, values or samples
        are loaded again.

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
        for name in options:
            if name in _NAMES:
                raise TypeError(f"unknown option {name}: did you mean {_NAMES[name]}?")
            if name not in ("arrays", *ContourOptions.__annotations__):
                raise unknown_option(name, triangles, parameters_of(self.contour))
        keeps = options.get("keep_tree", True)
        with self._loaded(scalars, preference, progress_bar, threads, keeps) as samples:
            if isinstance(isosurfaces, (int, np.integer)) and not isinstance(isosurfaces, bool):
                if isosurfaces < 0:
                    raise ValueError(f"isosurfaces cannot be {isosurfaces}: give their number, 0 or more, or a list of"
                                     " isovalues")
                if rng is not None and (np.shape(rng) != (2,) or np.asarray(rng).dtype.kind not in "fiu"):
                    raise ValueError(f"rng cannot be {rng!r}: rng has two values, the least and the greatest isovalue")
                # If no sample is in use, any isovalue leads to the message about this.
                isosurfaces = (_spaced(*np.nan_to_num(samples.range), int(isosurfaces) + 2)[1:-1] if rng is None else
                               _spaced(*rng, int(isosurfaces)))
            else:
                isosurfaces = levels_of("isosurfaces", isosurfaces)
            return samples._contour(isosurfaces, triangles, options.pop("arrays", None), threads, progress_bar, options,
                                    stacklevel=3)._into_polydata()

    def body(
        self,
        scalars: Union[str, Sequence[str], np.ndarray, None] = None,
        *,
        preference: str = "point",
        progress_bar: bool = False,
        threads: Optional[int] = None,
        **options: Unpack[BodyOptions],
    ) -> pv.PolyData:
        """Find the closed surface of all samples, from their positions alone.

        Parameters
        ----------
        scalars, preference, progress_bar, threads
            As in :meth:`probe`.
        **options : dict, optional
            ``drop_gaps=False`` for the convex hull, ``minimum_piece_size`` to leave out droplets.

        Returns
        -------
        pyvista.PolyData
            Closed triangles between samples, with their arrays.
        """
        check_names(options, BodyOptions.__annotations__, parameters_of(self.body))
        with self._samples_with(scalars, preference, progress_bar, threads, needs_arrays=False) as (samples, arrays):
            return body_with_warnings(samples, None if scalars is None else arrays, threads, progress_bar, options,
                                      stacklevel=3)._into_polydata()

    def splats(self, scale: float = 1.0, *, threads: Optional[int] = None) -> pv.PolyData:
        """Turn isopoints into polygons that show them as a closed surface.

        Parameters
        ----------
        scale : float, default: 1.0
            Factor on the size of splats.
        threads : int, optional
            As in :meth:`contour`.

        Returns
        -------
        pyvista.PolyData
            Triangles with normals: draw them with ``smooth_shading=True``.

        Notes
        -----
        Filters that keep the cells of points, such as ``clip`` and ``threshold``, keep their splats. Points
        with only normals become octagons.
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
        method: str = "blend",
        outside: Union[float, str, None] = math.nan,
        nearest_arrays: Union[str, Iterable[str]] = (),
        preference: str = "point",
        progress_bar: bool = False,
        threads: Optional[int] = None,
    ) -> pv.DataSet:
        """Interpolate arrays of scattered samples at points.

        Parameters
        ----------
        where : pyvista.DataSet | array_like[float]
            Points, or one, or a data set, at its points.
        scalars : str | sequence[str] | array_like[float], optional
            Names of arrays of points or cells, or numbers for each of them. By default all arrays of
            ``preference``, or else of the others.
        gradient : bool, default: False
            Whether to add gradients, too, named as the array and ``_gradient``. The index of a component varies
            slower than that of a derivative, as in :meth:`compute_derivative`.
        method, outside, nearest_arrays
            As in :func:`scatteredisopoints.probe`.
        preference, progress_bar, threads
            As in :meth:`contour`.

        Returns
        -------
        pyvista.DataSet
            A shallow copy of ``where``, or a ``PolyData`` of points, with the arrays, which replace its own of the
            same names.
        """
        return self._probe(where, scalars, gradient, method, outside, nearest_arrays, preference, progress_bar, threads)

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
        begin, end = three_numbers("pointa", pointa), three_numbers("pointb", pointb)
        if not hasattr(resolution, "__index__") or operator.index(resolution) < 1:
            raise ValueError(f"resolution cannot be {resolution!r}: it is a whole number, 1 or more")
        points, distances = line_between(begin, end, operator.index(resolution))
        line = pv.PolyData(points, lines=[len(points), *range(len(points))])
        options = _options_of_probe(options, self.sample_over_line)
        return self._probe(line, scalars, **options, computed={"Distance": distances})

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
            may end beyond, by less than one spacing. A grid has at most 2^31 - 1 points.
        scalars, **options
            As in :meth:`probe`.

        Returns
        -------
        pyvista.ImageData
            The grid, with the arrays.
        """
        box = box_of(_datasets.bounds_of(self._checked()).ravel() if bounds is None else bounds)
        options = _options_of_probe(options, self.to_grid)
        return self._probe(pv.ImageData(**grid_in(box, dimensions, spacing)), scalars, **options)

    def slice(
        self,
        normal: Union[str, Sequence[float], None] = None,
        origin: Optional[Sequence[float]] = None,
        generate_triangles: bool = True,
        contour: bool = False,
        progress_bar: bool = False,
        plane: Optional[pv.PolyData] = None,
        **options: Any,
    ) -> pv.PolyData:
        """Slice scattered samples by a plane.

        Parameters
        ----------
        normal : str | sequence[float], default: "x"
            Normal of the plane: a vector, or the name of an axis, such as ``"-x"``.
        origin : sequence[float], optional
            A point on the plane, by default the center of the bounds of the samples.
        generate_triangles : bool, default: True
            Cells are triangles in any case.
        contour : bool, default: False
            Contour the slice.
        progress_bar : bool, default: False
            As in :meth:`contour`.
        plane : pyvista.PolyData, optional
            Not supported: give ``normal`` and ``origin``.
        **options : dict, optional
            Other parameters of :func:`scatteredisopoints.slice_samples`, such as ``interpolation="linear"``; and
            ``scalars`` and ``preference``, as in :meth:`probe`.

        Returns
        -------
        pyvista.PolyData
            Triangles with all arrays, which end where the samples end.

        Notes
        -----
        A slice along the normal of the last one takes a fraction of its time.
        """
        if plane is not None:
            raise TypeError("plane is not supported: give its normal and its origin")
        _check_slice_options(options, self.slice)
        return self._slice(normal, origin, None, contour, progress_bar, options)

    def slice_orthogonal(
        self,
        x: Optional[float] = None,
        y: Optional[float] = None,
        z: Optional[float] = None,
        generate_triangles: bool = True,
        contour: bool = False,
        progress_bar: bool = False,
        **options: Any,
    ) -> pv.MultiBlock:
        """Slice scattered samples by three orthogonal planes.

        Parameters
        ----------
        x, y, z : float, optional
            Where the planes cross the axes, by default at the center of the bounds of the samples.
        generate_triangles, contour, progress_bar, **options
            As in :meth:`slice`.

        Returns
        -------
        pyvista.MultiBlock
            The slices ``YZ``, ``XZ`` and ``XY``.
        """
        _check_slice_options(options, self.slice_orthogonal)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            slices = {name: self._slice(axis, None if at is None else 3 * [at], None, contour, progress_bar, options)
                      for name, axis, at in (("YZ", "x", x), ("XZ", "y", y), ("XY", "z", z))}
        for text, category in dict.fromkeys((str(each.message), each.category) for each in caught):
            warnings.warn(text, category, stacklevel=2)
        return pv.MultiBlock(slices)

    def slice_implicit(
        self,
        implicit_function: Any,
        generate_triangles: bool = True,
        contour: bool = False,
        progress_bar: bool = False,
        **options: Any,
    ) -> pv.PolyData:
        """Slice scattered samples by an implicit function.

        Parameters
        ----------
        implicit_function : vtkImplicitFunction | callable
            The slice is where it is 0. A callable gets points of shape (n, 3), and returns n numbers.
        generate_triangles, contour, progress_bar, **options
            As in :meth:`slice`.

        Returns
        -------
        pyvista.PolyData
            As of :meth:`slice`.
        """
        if implicit_function is None:
            raise TypeError("implicit_function is missing")
        _check_slice_options(options, self.slice_implicit)
        return self._slice(None, None, implicit_function, contour, progress_bar, options)

    def _slice(self, normal: Any, origin: Any, function: Any, contour: bool, progress: Progress,
               options: Mapping[str, Any]) -> pv.PolyData:
        options = dict(options)
        scalars, preference = options.pop("scalars", None), options.pop("preference", "point")
        offsets, interpolation = options.pop("offsets", 0.0), options.pop("interpolation", "fits")
        threads, nearest_arrays = options.pop("threads", None), options.pop("nearest_arrays", ())
        with self._samples_with(scalars, preference, progress, threads, needs_arrays=False) as (samples, arrays):
            result = slice_with_warnings(
                samples, normal, origin, None if scalars is None else arrays, function, offsets, interpolation, threads,
                progress, options, stacklevel=4, nearest_arrays=nearest_arrays)._into_polydata()
        if not (switch("contour", contour) and result.n_cells):
            return result
        try:
            return result.contour()
        except (pv.MissingDataError, pv.AmbiguousDataError):
            raise ValueError("contour=True needs an array of numbers: give its name as scalars") from None

    def compute_derivative(
        self,
        scalars: Union[str, np.ndarray, None] = None,
        gradient: Union[bool, str] = True,
        divergence: Union[bool, str, None] = None,
        vorticity: Union[bool, str, None] = None,
        qcriterion: Union[bool, str, None] = None,
        *,
        method: str = "blend",
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
            scalars, (first, _) = _active_scalars(self._dataset)
            preference = "cell" if first == CELL else "point"
        if are_names(scalars):
            raise TypeError("scalars are one array: call compute_derivative() for each")
        wanted = names_of_derivatives(gradient, divergence, vorticity, qcriterion)
        with self._samples_with(scalars, preference, progress_bar, threads) as (samples, _):
            if not hasattr(self._dataset, "GetCellData"):
                raise TypeError(f"A {type(self._dataset).__name__} has no samples of its own: call compute_derivative()"
                                " for each block.")
            gradients = samples._gradient(scalars, method, threads, progress_bar, stacklevel=3)
            are_cells = samples._association == CELL
        count = math.prod(gradients.shape[1:-1])
        of_vectors = [name for name in wanted if name != "gradient"]
        if count != 3 and of_vectors:
            shown = f'"{scalars}" has' if isinstance(scalars, str) else "scalars have"
            raise ValueError(f"{' and '.join(of_vectors)} cannot be computed, because {shown} {count}"
                             f" component{'s' if count > 1 else ''}: choose vectors, which have three")
        gradients = gradients.reshape(len(gradients), count, 3)
        result = self._dataset.copy(deep=False)
        attributes = result.cell_data if are_cells else result.point_data
        _warn_of_replaced(wanted.values(), attributes.keys(), stacklevel=3)
        _add_arrays(attributes, {label: DERIVATIVES[name](gradients) for name, label in wanted.items()})
        return result

    def _probe(self, where: Any, scalars: Any, gradient: bool, method: str, outside: Union[float, str, None],
               nearest_arrays: Union[str, Iterable[str]], preference: str, progress_bar: bool, threads: Optional[int],
               computed: Optional[Mapping[str, np.ndarray]] = None) -> Any:
        """probe(), with further arrays that are computed."""
        data = _datasets.data_object(where)
        places = pv.PolyData(_datasets.place_positions(where)[0].copy()) if data is None else data
        with self._samples_with(scalars, preference, progress_bar, threads) as (samples, arrays):
            found = samples._probe(places, arrays, gradient, method, outside, threads, progress_bar, stacklevel=4,
                                   nearest_arrays=nearest_arrays)
            differing, of_text = (samples._differing, samples._of_text) if scalars is None else ((), ())
        values, gradients = found if gradient else (found, {})
        computed = {**{name + "_gradient": array for name, array in gradients.items()}, **(computed or {})}
        _warn_of_replaced(computed, values, stacklevel=4)
        if differing:
            warnings.warn(_datasets.describe_differing(differing), RuntimeWarning, stacklevel=3)
        if of_text:
            warnings.warn(_datasets.describe_text(of_text), RuntimeWarning, stacklevel=3)
        result = pv.wrap(places).copy(deep=False)
        _add_arrays(result.point_data, {**values, **computed})
        return result

    @contextlib.contextmanager
    def _samples_with(self, scalars: Any, preference: str, progress: Progress, threads: Optional[int],
                      needs_arrays: bool = True) -> Iterator[tuple[Samples, dict[str, Any]]]:
        """The samples without values, kept for the next call, and the arrays to probe.

        needs_arrays: whether data without any have no samples.
        """
        data, associations = self._checked(), _associations(preference)
        names = [scalars] if isinstance(scalars, str) else scalars if are_names(scalars) else []
        if scalars is not None and not names:
            associations = (_datasets.association_of(data, np.shape(scalars)),)
        is_any = scalars is None and not needs_arrays

        def find() -> _datasets.DataSamples:
            return (_datasets.samples_without_values(data, True, associations) if is_any else
                    _datasets.samples_with_arrays(data, names, associations))

        choice = "without values", is_any, *names, *associations
        with _kept_samples(data, choice, None, find, progress, threads, True) as samples:
            if scalars is None:
                names = list(samples._arrays or {})
            yield samples, {name: name for name in names} if scalars is None or names else {"values": scalars}

    def _checked(self) -> Any:
        """The data, if these can have samples."""
        data = self._dataset
        if not (data.IsA("vtkDataSet") or data.IsA("vtkCompositeDataSet")):
            raise TypeError(f"A {type(data).__name__} has no samples: make a pyvista.PolyData of its"
                            " positions first.")
        return data

    def _loaded(self, scalars: Any, preference: str, progress: Progress, threads: Optional[int], keeps: bool
                ) -> contextlib.AbstractContextManager[Samples]:
        data, associations = self._checked(), _associations(preference)
        if scalars is None:
            scalars, associations = _active_scalars(data)
        if not isinstance(scalars, str):
            return contextlib.nullcontext(Samples(data, scalars, threads=threads, progress=progress))
        return _kept_samples(data, (scalars, *associations), scalars,
                             lambda: _datasets.samples_with_values(data, scalars, associations), progress, threads,
                             keeps)


def _spaced(least: float, greatest: float, count: int) -> list[float]:
    """So many evenly spaced numbers, also where the range of float64 does not hold their difference."""
    scale = 1.0 if math.isfinite(float(greatest) - float(least)) else 0.25
    return (np.linspace(scale * least, scale * greatest, count) / scale).tolist()


def _associations(preference: str) -> tuple[int, ...]:
    """Where an array is looked for, in this order."""
    return named("preference", preference, {"point": (POINT, CELL), "cell": (CELL, POINT)})


def _check_slice_options(given: Mapping[str, Any], method: Callable[..., Any]) -> None:
    """Raises TypeError for an option that slices do not have."""
    names = (*SliceOptions.__annotations__, "interpolation", "nearest_arrays", "offsets", "preference", "scalars",
             "threads")
    check_names(given, names, parameters_of(method))


def _options_of_probe(given: Mapping[str, Any], method: Callable[..., Any]) -> dict[str, Any]:
    """All of ScatteredAccessor.probe(), with defaults. Raises TypeError if it has no such one."""
    parameters = inspect.signature(ScatteredAccessor.probe).parameters.values()
    options = {each.name: each.default for each in parameters if each.kind is each.KEYWORD_ONLY}
    check_names(given, options, parameters_of(method))
    return {**options, **given}


def _warn_of_replaced(computed: Iterable[str], given: Collection[str], stacklevel: int) -> None:
    for name in computed:
        if name in given:
            warnings.warn(f'The computed array "{name}" replaces the array of this name: rename that to keep both.',
                          RuntimeWarning, stacklevel=stacklevel)


def _add_arrays(attributes: pv.DataSetAttributes, arrays: Mapping[str, np.ndarray]) -> None:
    for name, array in arrays.items():
        array = array.reshape(len(array), math.prod(array.shape[1:])) if array.ndim > 1 else array
        if len(array):
            attributes[name] = array
        else:  # PyVista adds no empty vectors
            attributes.VTKObject.AddArray(as_vtk(package_of(attributes.VTKObject), name, array))


def _active_scalars(data: Any) -> tuple[str, tuple[int, ...]]:
    """The name of the active scalars of the first data set that has some, and where they are."""
    for leaf in _datasets.leaves(data):
        info = leaf.active_scalars_info if isinstance(leaf, pv.DataSet) and leaf.n_points else None
        if info is not None and info.name is not None:
            return info.name, _associations(info.association.name)
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


@contextlib.contextmanager
def _kept_samples(data: Any, choice: tuple, values: Optional[str], find: Callable[[], _datasets.DataSamples],
                  progress: Progress, threads: Optional[int], keeps: bool) -> Iterator[Samples]:
    """The samples of a data set that a function finds for a choice of arrays; reuses those of the last call, or
    their tree. No other call gets them meanwhile. Keeps them for the next one if wanted."""
    id_, key = id(data), (choice, _datasets.contents_of(data, values))
    with _lock:
        kept = _kept.pop(id_, None)
    samples = kept[2] if kept is not None and kept[0]() is data else None
    if samples is not None:
        samples._threads = threads
    if samples is None or kept[1] != key:
        with shown_progress(progress, "Loading samples") as report:
            if samples is None:
                samples = Samples._from_data(find(), threads, progress=report)
            else:
                samples._take(find(), progress=report)
    try:
        yield samples
    finally:
        if keeps:
            with _lock:
                _kept[id_] = weakref.ref(data, lambda _: _kept.pop(id_, None)), key, samples
                _kept.move_to_end(id_)
                while len(_kept) > MOST_KEPT:
                    _kept.popitem(last=False)
