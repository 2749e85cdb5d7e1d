# SPDX-License-Identifier: GPL-3.0-or-later
"""The splats of points in a data set, from the filters or after other filters that keep them."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._arrays import as_numpy, package_of
from ._datasets import is_of_pyvista, named_arrays, point_positions
from ._ghosts import cell_points
from ._isosurface import Isosurface
from ._polydata import PolyDataMaker

# Octagons in units of the axis, in the format of SplatPolygon.
_ANGLES = 2.0 * np.pi * np.arange(8) / 8
OCTAGON = np.stack([np.cos(_ANGLES), np.sin(_ANGLES), *np.zeros((3, 8))], axis=-1).ravel()


def polygons_of(data: Any, radius_array: str, radius: float, scale: float) -> Isosurface:
    """The triangles that show the points of a data set; see vtkIsopointSplatPolygons. Raises ValueError if
    the points have no normals."""
    if not data.IsA("vtkDataSet"):
        raise TypeError(f"A {data.GetClassName()} has no points of its own: pass its blocks, or combine"
                        " them first.")
    points = as_numpy(point_positions(data))
    attributes = data.GetPointData()
    active = attributes.GetNormals()
    normals = _numbers(attributes.GetArray("Normals") if active is None else active, len(points), 3)
    if normals is None and len(points) > 0:
        raise ValueError("The points have no normals: extract them with ComputeNormals.")
    normals = np.zeros((0, 3)) if normals is None else normals
    radii = _numbers(attributes.GetArray(radius_array or "Radius"), len(points), 1)
    if radii is not None and (radii < 0).any():
        raise ValueError(f"The array of radii, {radius_array}, has negative numbers.")
    if radii is None:
        radii = np.full(len(points), radius if radius > 0 else _automatic_radius(points))
    axes = _perpendicular(normals.astype(np.float64)) * radii[:, None]
    polygons = np.tile(OCTAGON.astype(np.float32), (len(points), 1))
    axes = axes.astype(np.float32)
    _take_shapes(data, axes, polygons)
    arrays = {name: as_numpy(array) for name, array, _ in named_arrays(attributes) if name != "Normals"}
    scalars = attributes.GetScalars()
    maker = PolyDataMaker(package_of(data), is_of_pyvista(data),
                          None if scalars is None else scalars.GetName())
    isopoints = Isosurface(points, None, {**arrays, "Normals": normals.astype(np.float32)},
                           {"SplatAxis": axes, "SplatPolygon": polygons}, maker)
    return isopoints.splats(scale)


def _take_shapes(data: Any, axes: np.ndarray, polygons: np.ndarray) -> None:
    """Replaces octagons by the shapes of vertex cells, which files may store at the points."""
    cells, point = cell_points(data)
    count = np.bincount(cells, minlength=data.GetNumberOfCells())
    is_vertex = count[cells] == 1
    for attributes, size, of_elements, of_points in (
            (data.GetCellData(), data.GetNumberOfCells(), cells[is_vertex], point[is_vertex]),
            (data.GetPointData(), len(axes), slice(None), slice(None))):
        axis = _numbers(attributes.GetArray("SplatAxis"), size, 3)
        polygon = _numbers(attributes.GetArray("SplatPolygon"), size, len(OCTAGON))
        if axis is not None and polygon is not None:
            axes[of_points], polygons[of_points] = axis[of_elements], polygon[of_elements]
            return


def _numbers(array: Any, count: int, components: int) -> Optional[np.ndarray]:
    """The numbers of an array if it has this shape, otherwise None."""
    is_usable = (array is not None and array.GetNumberOfTuples() == count
                 and array.GetNumberOfComponents() == components)
    return as_numpy(array) if is_usable else None


def _perpendicular(normals: np.ndarray) -> np.ndarray:
    """Unit vectors perpendicular to others."""
    smallest = np.eye(3)[np.abs(normals).argmin(axis=1)]
    across = np.cross(normals, smallest)
    return across / np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-300)


def _automatic_radius(points: np.ndarray) -> float:
    finite = points[np.isfinite(points).all(axis=1)]
    diagonal = np.linalg.norm(np.ptp(finite, axis=0)) if len(finite) else 0.0
    return 2.0 * diagonal / np.sqrt(max(len(points), 1)) or 1.0
