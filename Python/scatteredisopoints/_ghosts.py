# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds points and cells of data sets that are no samples because they are ghosts or hidden, and hides some."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._arrays import CELL, POINT, as_numpy, package_of
from ._polydata import as_vtk

# Bits of vtkGhostType, for points and for cells.
DUPLICATE_POINT, HIDDEN_POINT = 1, 2
DUPLICATE_CELL, REFINED_CELL, HIDDEN_CELL = 1, 8, 32


def excluded_points(data: Any) -> Optional[np.ndarray]:
    """Whether each point is a ghost, hidden, or only in cells that are hidden or ghosts; None if no point
    is."""
    points, cells = ghosts_of(data, POINT), ghosts_of(data, CELL)
    excluded = np.zeros(data.GetNumberOfPoints(), bool)
    if points is not None:
        excluded |= (points & (DUPLICATE_POINT | HIDDEN_POINT)) != 0
    # If the points have a ghost array, it marks duplicates itself.
    bits = HIDDEN_CELL | REFINED_CELL | (DUPLICATE_CELL if points is None else 0)
    if cells is not None and (cells & bits).any():
        cell, point = cell_points(data)
        is_excluded = (cells[cell] & bits) != 0
        in_excluded, in_sample = np.zeros((2, len(excluded)), bool)
        in_excluded[point[is_excluded]] = True
        in_sample[point[~is_excluded]] = True
        excluded |= in_excluded & ~in_sample
    return excluded if excluded.any() else None


def excluded_cells(data: Any) -> Optional[np.ndarray]:
    """Whether each cell is a ghost, hidden, covered by a finer one, with a hidden point, or without points;
    None if no cell is."""
    points, cells = ghosts_of(data, POINT), ghosts_of(data, CELL)
    excluded = np.zeros(data.GetNumberOfCells(), bool)
    if cells is not None:
        excluded |= (cells & (DUPLICATE_CELL | REFINED_CELL | HIDDEN_CELL)) != 0
    has_hidden = points is not None and (points & HIDDEN_POINT).any()
    if has_hidden or cell_arrays(data):
        cell, point = cell_points(data)
        if points is not None and has_hidden:
            excluded[cell[(points[point] & HIDDEN_POINT) != 0]] = True
        excluded |= np.bincount(cell, minlength=len(excluded)) == 0
    return excluded if excluded.any() else None


def ghosts_of(data: Any, association: int) -> Optional[np.ndarray]:
    """The marks of ghosts of the points or cells, None without."""
    array = data.GetAttributes(association).GetArray("vtkGhostType")
    count = data.GetNumberOfElements(association)
    is_usable = (array is not None and array.IsA("vtkUnsignedCharArray")
                 and array.GetNumberOfComponents() == 1 and array.GetNumberOfTuples() >= count)
    return as_numpy(array)[:count] if is_usable else None


def hide_points(data: Any, are_hidden: np.ndarray) -> None:
    """Marks points, and cells with any of them, as hidden, in arrays of the data set's own."""
    if not are_hidden.any():
        return
    cell, point = cell_points(data)
    are_hidden_cells = np.zeros(data.GetNumberOfCells(), bool)
    are_hidden_cells[cell[are_hidden[point]]] = True
    for association, are, bit in ((POINT, are_hidden, HIDDEN_POINT), (CELL, are_hidden_cells, HIDDEN_CELL)):
        before = ghosts_of(data, association)
        marks = np.where(are, bit, 0).astype(np.uint8)
        marks = marks if before is None else marks | before
        data.GetAttributes(association).AddArray(as_vtk(package_of(data), "vtkGhostType", marks))


def cell_arrays(data: Any) -> list[Any]:
    """The vtkCellArrays of a data set, in the order of its cells; empty for structured data sets."""
    if data.IsA("vtkPolyData"):
        return [data.GetVerts(), data.GetLines(), data.GetPolys(), data.GetStrips()]
    is_unstructured = data.IsA("vtkUnstructuredGrid") or data.IsA("vtkExplicitStructuredGrid")
    return [data.GetCells()] if is_unstructured else []


def cell_points(data: Any) -> tuple[np.ndarray, np.ndarray]:
    """All pairs of a cell and one of its points, as two arrays of ids."""
    arrays = cell_arrays(data)
    if arrays:
        sizes = np.concatenate([np.diff(as_numpy(array.GetOffsetsArray())) for array in arrays])
        points = np.concatenate([as_numpy(array.GetConnectivityArray()) for array in arrays])
        return np.repeat(np.arange(len(sizes)), sizes), points
    if not hasattr(data, "GetExtent"):  # points without cells
        return np.zeros(0, np.int64), np.zeros(0, np.int64)
    low, high = np.reshape(data.GetExtent(), (3, 2)).T[:, ::-1]  # of z, y, x
    ids = np.arange(data.GetNumberOfPoints()).reshape(high - low + 1)
    z, y, x = np.maximum(high - low, 1)  # numbers of cells
    corners = [ids[dz:dz + z, dy:dy + y, dx:dx + x].ravel()
               for dz, dy, dx in np.ndindex(*np.minimum(ids.shape, 2))]
    return np.tile(np.arange(z * y * x), len(corners)), np.concatenate(corners)
