# SPDX-License-Identifier: GPL-3.0-or-later
"""The splats of points in a data set, from the filters or after other filters that keep them."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._arrays import POINT, as_numpy, package_of, positions_of
from ._datasets import GLOBAL_IDS, PEDIGREE_IDS, is_of_pyvista, named_arrays, point_positions
from ._ghosts import DUPLICATE_POINT, HIDDEN_POINT, cell_points, ghosts_of
from ._isosurface import Isosurface
from ._polydata import PolyDataMaker, as_vtk

# As in vtkCellType.h.
VERTEX, POLY_VERTEX = 1, 2

# The names of VTK's filters.
POINT_IDS, CELL_IDS = "vtkOriginalPointIds", "vtkOriginalCellIds"

# Octagons in units of the axis, in the format of SplatPolygon.
_ANGLES = 2.0 * np.pi * np.arange(8) / 8
OCTAGON = np.stack([np.cos(_ANGLES), np.sin(_ANGLES), *np.zeros((3, 8))], axis=-1).ravel()


class NoNormalsError(ValueError):
    """Points have no normals."""

    def __init__(self):
        super().__init__("The points have no normals: extract them with compute_normals.")


def polygons_of(
    data: Any, radius_array: Optional[str], radius: float, scale: float, threads: Optional[int] = None,
    **callbacks: Any,
) -> tuple[Any, str]:
    """The triangles that show the points of a data set, and a warning or ""; see vtkIsopointSplatPolygons.
    Callbacks are those of _library.Callbacks. Raises NoNormalsError."""
    if not data.IsA("vtkDataSet"):
        raise TypeError(f"A {data.GetClassName()} has no points of its own: pass its blocks, or combine"
                        " them first.")
    points = positions_of(as_numpy(point_positions(data)))
    attributes = data.GetPointData()
    active = attributes.GetNormals()
    normals = _numbers(attributes.GetArray("Normals") if active is None else active, len(points), 3)
    if normals is None and len(points) > 0:
        raise NoNormalsError
    normals = np.zeros((0, 3)) if normals is None else normals
    directions = normals.astype(np.float64)
    directions /= np.maximum(np.linalg.norm(directions, axis=1, keepdims=True), 1e-300)
    radii = _numbers(attributes.GetArray(radius_array) if radius_array else None, len(points), 1)
    if radii is None:
        radii = np.full(len(points), radius if radius > 0 else _automatic_radius(points))
    axes = _perpendicular(directions) * np.where((radii > 0) & np.isfinite(radii), radii, 0.0)[:, None]
    polygons = np.tile(OCTAGON.astype(np.float32), (len(points), 1))
    cell_of_point = _vertex_cells(data)
    problem = _take_shapes(data, cell_of_point, directions, axes, polygons)
    ghosts = ghosts_of(data, POINT)
    if ghosts is not None:
        axes[(ghosts & (DUPLICATE_POINT | HIDDEN_POINT)) != 0] = 0.0  # without a size they are not drawn
    kept = [each for each in named_arrays(attributes) if _is_kept(each[1], active)]
    scalars = attributes.GetScalars()
    maker = PolyDataMaker(package_of(data), is_of_pyvista(data), None if scalars is None else scalars.GetName(),
                          {name: use for name, _, use in kept if use not in (-1, GLOBAL_IDS, PEDIGREE_IDS)},
                          data.GetFieldData())
    arrays = {name: as_numpy(array) for name, array, _ in kept}
    isopoints = Isosurface(
        points, arrays={**arrays, "Normals": normals.astype(np.float32), POINT_IDS: np.arange(len(points))},
        splat_shapes={"SplatAxis": axes.astype(np.float32), "SplatPolygon": polygons}, make_polydata=maker)
    splats = isopoints._splats(scale, threads, **callbacks)
    polygons = splats._into_polydata()
    _add_cell_arrays(polygons, splats, data, cell_of_point)
    return polygons, problem


def _is_kept(array: Any, normals: Any) -> bool:
    """Whether an array describes a point rather than the shape of its splat."""
    return array is not normals and array.GetName() not in (
        "Normals", "SplatAxis", "SplatPolygon", POINT_IDS, CELL_IDS)


def _add_cell_arrays(polygons: Any, splats: Isosurface, data: Any, cell_of_point: np.ndarray) -> None:
    """Gives the polygons of splats the arrays of their points' cells, if all points have cells."""
    assert splats.triangles is not None
    cells = cell_of_point[splats.arrays[POINT_IDS][splats.triangles[:, 0]]]
    if (cells < 0).any():
        return
    attributes, package = polygons.GetCellData(), package_of(data)
    for name, array, use in named_arrays(data.GetCellData()):
        if _is_kept(array, data.GetCellData().GetNormals()):
            index = attributes.AddArray(as_vtk(package, name, as_numpy(array)[cells]))
            if use not in (-1, GLOBAL_IDS, PEDIGREE_IDS):
                attributes.SetActiveAttribute(index, use)
    attributes.AddArray(as_vtk(package, CELL_IDS, cells))


def _vertex_cells(data: Any) -> np.ndarray:
    """The first cell that is a vertex of each point alone, otherwise the first one of vertices; -1 without."""
    cells, points = cell_points(data)
    sizes = np.bincount(cells, minlength=data.GetNumberOfCells())
    are_vertices = np.zeros(len(sizes), bool)
    if data.IsA("vtkPolyData"):
        are_vertices[:data.GetNumberOfVerts()] = True
    elif data.IsA("vtkUnstructuredGrid") and len(sizes):
        try:
            types = as_numpy(data.GetCellTypes())
        except TypeError:  # before VTK 9.6
            types = as_numpy(data.GetCellTypesArray())
        are_vertices = (types == VERTEX) | (types == POLY_VERTEX)
    found = np.full(data.GetNumberOfPoints(), -1)
    for is_wanted in (are_vertices & (sizes > 1), are_vertices & (sizes == 1)):
        chosen = is_wanted[cells]
        found[points[chosen][::-1]] = cells[chosen][::-1]  # the first one replaces later ones
    return found


def _take_shapes(
    data: Any, cell_of_point: np.ndarray, directions: np.ndarray, axes: np.ndarray, polygons: np.ndarray
) -> str:
    """Replaces octagons by the shapes of vertex cells, which files may store at the points. Returns a warning."""
    shapes, count = data.GetCellData(), data.GetNumberOfCells()
    is_alone = np.append(np.bincount(cell_points(data)[0], minlength=count) == 1, False)  # False at -1
    tuples = np.where(is_alone[cell_of_point], cell_of_point, -1)
    if not shapes.HasArray("SplatPolygon"):
        shapes, count, tuples = data.GetPointData(), len(axes), np.arange(len(axes))
    polygon = _numbers(shapes.GetArray("SplatPolygon"), count, len(OCTAGON))
    axis = _numbers(shapes.GetArray("SplatAxis"), count, 3)
    if polygon is None:
        return ('The array "SplatPolygon" has not 40 components for each vertex cell: splats are octagons of the'
                " points' radii. Keep the array as it was extracted."
                if shapes.HasArray("SplatPolygon") else "")
    if axis is None:
        return ('The array "SplatPolygon" has no array "SplatAxis" of three components beside it: splats are'
                " octagons of the points' radii. Pass both arrays.")
    points = np.flatnonzero(tuples >= 0)
    axis, polygon = axis[tuples[points]], polygon[tuples[points]]
    slope = np.abs((axis * directions[points]).sum(axis=1))
    is_tangential = ~(slope > 1e-4 * np.linalg.norm(axis, axis=1))  # a filter may have turned normals alone
    points = points[is_tangential]
    axes[points], polygons[points] = axis[is_tangential], polygon[is_tangential]
    return ""


def _numbers(array: Any, count: int, components: int) -> Optional[np.ndarray]:
    """The numbers of an array if it has this shape, otherwise None."""
    is_usable = (array is not None and array.GetNumberOfTuples() >= count
                 and array.GetNumberOfComponents() == components)
    return as_numpy(array)[:count] if is_usable else None


def _perpendicular(normals: np.ndarray) -> np.ndarray:
    """Unit vectors perpendicular to others."""
    smallest = np.eye(3)[np.abs(normals).argmin(axis=1)]
    across = np.cross(normals, smallest)
    return across / np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-300)


def _automatic_radius(points: np.ndarray) -> float:
    finite = points[np.isfinite(points).all(axis=1)]
    diagonal = np.linalg.norm(np.ptp(finite.astype(np.float64), axis=0)) if len(finite) else 0.0
    radius = 2.0 * diagonal / np.sqrt(max(len(points), 1))
    return float(radius) if np.isfinite(radius) and radius > 0 else 1.0
