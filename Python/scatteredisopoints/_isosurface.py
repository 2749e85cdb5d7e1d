# SPDX-License-Identifier: GPL-3.0-or-later
"""The result of contour(), body() and slice_samples()."""

from __future__ import annotations

import importlib
import math
import os
import warnings
from ctypes import byref, c_void_p
from dataclasses import replace
from typing import Any, Iterable, Iterator, Mapping, Optional, Union

import numpy as np

from . import _library
from ._arrays import checked_tensors, package_of, positions_of, readable
from ._measures import Measures, Piece, measure
from ._options import number_of, thread_count
from ._polydata import PolyDataMaker, locked
from ._progress import Progress, shown_progress


class Isosurface:
    """Points on isosurfaces, or triangles between them, as :func:`contour` makes them: the constructor is private.
    Arrays are read-only views that keep their memory alive.

    Examples
    --------
    >>> import numpy as np
    >>> from scatteredisopoints import contour
    >>> positions = np.random.default_rng(1).random((20000, 3))
    >>> sphere = contour(positions, np.linalg.norm(positions - 0.5, axis=1), 0.3, triangles=True)
    >>> sphere.triangles.shape[1], sphere.normals.shape == sphere.points.shape, list(sphere.arrays)
    (3, True, ['values', 'Normals'])
    """

    arrays: dict[str, np.ndarray]
    """All numeric arrays of the points by name: shape (n,) or (n, ...), as those of the samples."""

    splat_shapes: Mapping[str, np.ndarray]
    """What splats look like: SplatAxis, shape (n, 3), and SplatPolygon, (n, 40), five numbers for each of eight
    corners; empty if splats were not computed."""

    cell_arrays: Mapping[str, np.ndarray]
    """Arrays of the triangles by name: with capping IsCap, 1 in caps and 0 in the isosurface."""

    def __init__(
        self,
        points: np.ndarray,
        *,
        triangles: Optional[np.ndarray] = None,
        arrays: Optional[dict[str, np.ndarray]] = None,
        splat_shapes: Optional[Mapping[str, np.ndarray]] = None,
        cell_arrays: Optional[Mapping[str, np.ndarray]] = None,
        make_polydata: PolyDataMaker = PolyDataMaker(),
        threads: Optional[int] = None,
        levels: Iterable[float] = (math.nan,),
        isovalues: Optional[np.ndarray] = None,
        is_capped: bool = False,
    ):
        self._points = points
        self._triangles = triangles
        self.arrays = arrays or {}
        self.splat_shapes = splat_shapes or {}
        self.cell_arrays = cell_arrays or {}
        self._lock_arrays()
        self._make_polydata = make_polydata
        self._polydata: Any = None
        self._threads = threads
        self._levels = sorted({*levels})
        self._isovalues = isovalues  # of points; None without
        self._is_capped = is_capped
        self._measures: Optional[Measures] = None
        self._has_lost_splats = False  # by points that were assigned

    def __getstate__(self) -> dict[str, Any]:
        return {**vars(self), "_polydata": None}  # VTK's objects cannot be pickled

    def __setstate__(self, state: dict[str, Any]) -> None:
        vars(self).update(state)
        self._lock_arrays()

    def _lock_arrays(self) -> None:
        """Makes all arrays read-only, because areas and volumes are computed once."""
        self._points = locked(self._points)
        self._triangles = None if self._triangles is None else locked(self._triangles)
        for name in ("arrays", "splat_shapes", "cell_arrays"):
            setattr(self, name, {key: locked(array) for key, array in getattr(self, name).items()})

    @property
    def points(self) -> np.ndarray:
        """Positions in the unit of the input: shape (n, 3), of float32 or float64. Others can be assigned, which clears
        what they determine: area, volume, pieces, polydata, normals, radii and splats. All other arrays stay."""
        return self._points

    @points.setter
    def points(self, positions: Any) -> None:
        points = positions_of(positions, "points")
        if len(points) != len(self):
            raise ValueError(f"points have the shape {points.shape}, not {self._points.shape}: give one for each")
        are_finite = np.isfinite(points).all(axis=1)
        if not are_finite.all():
            raise ValueError(f"{np.count_nonzero(~are_finite)} of {len(points)} points are not finite: give finite"
                             " coordinates")
        self._points = locked(points.copy())
        self._measures = self._polydata = None
        computed = [self._make_polydata.normals, "Radius" if self.splat_shapes else None]
        self._has_lost_splats |= bool(self.splat_shapes)
        self.arrays = {name: array for name, array in self.arrays.items() if name not in computed}
        self.splat_shapes = {}

    @property
    def triangles(self) -> Optional[np.ndarray]:
        """Indices of points, shape (m, 3), counterclockwise seen from lower values, or from higher ones with
        gradient_direction="ascent"; None of points."""
        return self._triangles

    @property
    def are_triangles(self) -> bool:
        """Whether triangles were extracted rather than only points."""
        return self.triangles is not None

    @property
    def normals(self) -> Optional[np.ndarray]:
        """Unit normals out of the body, shape (n, 3): towards decreasing values, or increasing ones with
        gradient_direction="ascent". None if not computed."""
        return self.arrays.get("Normals")

    @property
    def radii(self) -> Optional[np.ndarray]:
        """Radii of splats in the unit of positions, shape (n,); None if not computed."""
        return self.arrays.get("Radius")

    @property
    def polydata(self) -> Any:
        """Points, vertices or triangles, and all arrays: a copy, made on first use.

        A pyvista.PolyData if the samples were an object of PyVista, otherwise a vtkPolyData. Raises
        ImportError if neither VTK nor PyVista is installed.
        """
        if self._polydata is None:
            self._polydata = self._make_polydata(self)
        return self._polydata

    def _into_polydata(self) -> Any:
        """The same without a copy, for callers that keep no isosurface."""
        return self._make_polydata(self, shares_memory=True)

    def to_pyvista(self) -> Any:
        """:attr:`polydata` as a pyvista.PolyData. Raises ImportError if PyVista is not installed."""
        pyvista = _imported("pyvista")
        package, data = package_of(pyvista.PolyData()), self.polydata
        if package_of(data) != package:  # PyVista has cvista, while the data are of vtkmodules
            data = replace(self._make_polydata, package=package, field_data=None)(self)
        return pyvista.wrap(data)

    def to_trimesh(self) -> Any:
        """A trimesh.Trimesh of the triangles as they are, without arrays. Raises ImportError if trimesh is not
        installed, ValueError for points."""
        if self.triangles is None:
            raise ValueError("Points are no mesh: extract triangles.")
        return _imported("trimesh").Trimesh(self.points.copy(), self.triangles.copy(), process=False)

    def save(self, path: Union[str, os.PathLike[str]]) -> None:
        """Writes a file, with all arrays of points that its format can hold. An earlier one keeps its owner and
        permissions, as far as the system allows, and stays if this fails.

        Parameters
        ----------
        path
            Its ending says the format: .ply, .stl, .obj, .npz or .csv; with PyVista also .vtk, .vtp and .vtu, and with
            meshio its own. Raises ValueError if no installed package writes this format.
        """
        from ._writing import file_to_write, writer_for  # which imports this module

        write = writer_for(os.fspath(path), self.are_triangles)
        with file_to_write(os.fspath(path)) as target:
            write(target, self)

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """The connected components of the triangles, largest area first: isovalue, area, and volume. Raises ValueError
        for points."""
        return self._measured("pieces").pieces

    @property
    def region_ids(self) -> np.ndarray:
        """The index in :attr:`pieces` of each triangle's piece, shape (m,): for an array RegionId, as VTK calls it."""
        return locked(self._measured("pieces").region_ids)

    @property
    def area(self) -> Union[float, np.ndarray]:
        """The area of the triangles, in the square of the unit of positions; if there are several isovalues, of each,
        ascending."""
        return self._sums("area")

    @property
    def volume(self) -> Union[float, np.ndarray]:
        """The volume within the triangles, in the cube of the unit of positions; if there are several isovalues, of
        each, ascending. The sum of the volumes of the pieces: bubbles are subtracted. Negative around lower values, as
        of a distance, unless gradient_direction is "ascent". NaN, with a warning, unless each edge has exactly two
        triangles."""
        volumes = self._sums("volume")
        if any(math.isnan(piece.volume) for piece in self._measured("volume").pieces):
            warnings.warn("Not every edge has exactly two triangles, so there is no volume: extract the surface with"
                          " capping=True.", RuntimeWarning, stacklevel=2)
        elif not np.isfinite(volumes).all():
            warnings.warn("The volume is beyond the range of float64: choose another unit of length.", RuntimeWarning,
                          stacklevel=2)
        return volumes

    def _measured(self, name: str) -> Measures:
        if self.triangles is None:
            raise ValueError(f"Points have no {name}: extract triangles.")
        if self._measures is None:
            isovalues = np.full(len(self), self._levels[0]) if self._isovalues is None else self._isovalues
            self._measures = measure(self.points, self.triangles, isovalues, not self._is_capped)
        return self._measures

    def _sums(self, name: str) -> Union[float, np.ndarray]:
        """The sums over the pieces of each isovalue."""
        sums = np.zeros(len(self._levels))
        for piece in self._measured(name).pieces:
            sums[self._levels.index(piece.isovalue) if len(sums) > 1 else 0] += getattr(piece, name)
        return float(sums[0]) if len(sums) == 1 else sums

    def splats(
        self, scale: float = 1.0, *, threads: Optional[int] = None, progress: Progress = None
    ) -> Isosurface:
        """The triangles that show points as a closed, lit surface, for programs that draw meshes.

        Splats do not share vertices: for a connected mesh extract triangles.

        Parameters
        ----------
        scale
            Factor on the size of splats, greater than 0; 1 closes the surface.
        threads
            Maximum number of threads; None: as many as for the points. The result does not depend on it.
        progress
            As in :func:`contour`.

        Returns
        -------
        Triangles with normals and the arrays of the points. Real numbers are averaged where splats meet. Raises
        ValueError if there are no splats: for triangles, or if splats or normals were switched off.
        """
        with shown_progress(progress, "Making splats") as report:
            return self._splats(scale, threads, progress=report)

    def _splats(self, scale: float = 1.0, threads: Optional[int] = None, **callbacks: Any) -> Isosurface:
        """splats(). Callbacks are those of _library.Callbacks."""
        if self.triangles is not None:
            raise ValueError("Triangles have no splats: draw them as they are, or extract points.")
        if self._has_lost_splats:
            raise ValueError("The surface has no splats any more, since points were assigned: make splats() before, and"
                             " assign points to these.")
        if not self.splat_shapes or self.normals is None:
            raise ValueError("The surface has no splats: extract points with compute_splats and"
                             " compute_normals.")
        parts = [("points", self.points), ("normals", self.normals),
                 *((name, self.splat_shapes[name]) for name in ("SplatAxis", "SplatPolygon"))]
        threads = self._threads if threads is None else threads
        scale = number_of("scale", scale, 1.0)
        pointer = c_void_p()
        _library.run(_library.create_surface, *(readable(*part) for part in parts), byref(pointer))
        surface = _library.Surface(pointer.value)
        _library.run(_library.set_surface_threads, surface, thread_count(threads))
        _library.run_with(
            _library.Callbacks(**callbacks), surface, _library.make_splat_mesh, scale)
        point_of_vertex = _library.view(surface, _library.SPLAT_VERTEX_POINTS)
        is_canceled = callbacks.get("is_canceled")
        arrays = {name: _at_vertices(surface, checked_tensors(name, array, len(self)), point_of_vertex, is_canceled)
                  for name, array in self.arrays.items()}
        arrays["Normals"] = _library.view(surface, _library.SPLAT_VERTEX_NORMALS)
        return Isosurface(
            _library.view(surface, _library.SPLAT_VERTICES), triangles=_library.view(surface, _library.SPLAT_TRIANGLES),
            arrays=arrays, make_polydata=self._make_polydata, threads=threads)

    def __len__(self) -> int:
        return len(self.points)

    def __repr__(self) -> str:
        shown = f"{len(self)} points"
        if self.triangles is not None:
            shown += f", {len(self.triangles)} triangles"
        return f"<Isosurface: {shown}; arrays: {', '.join(self.arrays) or 'none'}>"


def _imported(package: str) -> Any:
    try:
        return importlib.import_module(package)
    except ImportError as error:
        raise ImportError(f"{error}: pip install {package}") from None


def _at_vertices(surface: _library.Surface, array: np.ndarray, point_of_vertex, is_canceled) -> np.ndarray:
    """An array of points, evaluated at the vertices of their splats."""
    if array.dtype.kind != "f":
        return array[point_of_vertex]
    result = np.empty((len(point_of_vertex), *array.shape[1:]), array.dtype)
    _library.run_with(_library.Callbacks(is_canceled=is_canceled), surface, _library.average_at_splat_vertices,
                      array.reshape(len(array), math.prod(array.shape[1:])), result, result.nbytes)
    return result


def describe_not_finite(arrays: Mapping[str, np.ndarray]) -> Iterator[str]:
    """Messages about arrays of points with entries that are not finite, as gaps in data are."""
    for name, numbers in arrays.items():
        is_finite = np.isfinite(numbers)
        if not is_finite.all():
            count = np.count_nonzero(~is_finite.reshape(len(numbers), -1).all(axis=1))
            yield f'"{name}" is not finite at {count} of {len(numbers)} points, as at samples beside them.'
