# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests of filters share, of the compiled classes and of those in Python: samples, differences, messages."""

import pathlib

import numpy as np
from scatteredisopoints import _vtk
from vtk_data import blocks_of, centers_in, cloud_of, named, observed, points_of, positions_in, set_all
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import (
    vtkDataObject, vtkImageData, vtkPartitionedDataSet, vtkPartitionedDataSetCollection, vtkRectilinearGrid,
    vtkStructuredGrid, vtkTable, vtkUnstructuredGrid)

DOCUMENT = pathlib.Path(__file__).resolve().parents[2] / "docs/python.md"

# Of the classes in Python, in the words of docs/python.md.
DIFFERENCES = (
    "Hyper tree grids are no input.",
    "String arrays are left out.",
    "Each piece of isosurfaces and slices is the whole.",
    "Isosurfaces: samples of blocks without the array have a message of their own.",
    "Slices: call `Modified()` after changes of the function's transform, or of functions within it.",
    "`vtkIsopointSplatPolygons`: points without normals have no polygons.",
)

POINTS, CELLS, ANY = (vtkDataObject.FIELD_ASSOCIATION_POINTS, vtkDataObject.FIELD_ASSOCIATION_CELLS,
                      vtkDataObject.FIELD_ASSOCIATION_POINTS_THEN_CELLS)
DUPLICATE_POINT, HIDDEN_POINT, DUPLICATE, REFINED, HIDDEN = 1, 2, 1, 8, 32


def cloud(count=2000, seed=1, kind=np.float64):
    """Random points in a cube of side 2 around the origin, with the distance from it and further arrays."""
    positions = np.random.default_rng(seed).uniform(-1, 1, (count, 3)).astype(kind)
    data = cloud_of(positions, np.linalg.norm(positions, axis=1), "distance")
    data.GetPointData().AddArray(named("x", positions[:, 0]))
    data.GetPointData().AddArray(named("position", positions))
    return data


def values_in(data, name="distance"):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def image(cells=8, origin=-1.0):
    """A box of cells. All coordinates are exact: a position computed in another way is the same."""
    return set_all(vtkImageData(), Dimensions=3 * (cells + 1,), Spacing=3 * (0.25,), Origin=3 * (origin,))


def rectilinear(box):
    axes = {axis + "Coordinates": named(axis, low + step * np.arange(count)) for axis, low, step, count in zip(
        "XYZ", box.GetOrigin(), box.GetSpacing(), box.GetDimensions())}
    return set_all(vtkRectilinearGrid(), Dimensions=box.GetDimensions(), **axes)


def structured(box):
    return set_all(vtkStructuredGrid(), Dimensions=box.GetDimensions(), Points=points_of(positions_in(box)))


def unstructured(box):
    grid = set_all(vtkUnstructuredGrid(), Points=points_of(positions_in(box)))
    for cell in range(box.GetNumberOfCells()):
        ids = box.GetCell(cell).GetPointIds()
        grid.InsertNextCell(box.GetCellType(cell), ids)
    return grid


def every_grid():
    return [make(image()) for make in (lambda box: box, rectilinear, structured, unstructured)]


def places_of(data, association):
    return positions_in(data) if association == POINTS else centers_in(data)


def add(data, association, name, values):
    data.GetAttributes(association).AddArray(named(name, values))
    return data


def with_field(data, association=POINTS):
    """Adds an array f of points or cells, and one named like it of the others."""
    add(data, 1 - association, "f", np.zeros(data.GetNumberOfElements(1 - association)))
    return add(data, association, "f", np.cos(places_of(data, association) @ [2.0, 3.0, 1.0]))


def with_ghosts(data, association, bits):
    """bits: of one element each, repeated"""
    count = data.GetNumberOfElements(association)
    return add(data, association, "vtkGhostType", np.resize(np.array(bits, np.uint8), count))


def chosen(filter_, name, association=POINTS):
    filter_.SetInputArrayToProcess(0, 0, 0, association, name)
    return filter_


class FilterTests:
    """Tests for both kinds of classes, which subclasses choose: `module` has them."""

    def differs(self, difference):
        self.assertIn(difference, DIFFERENCES)
        return self.module is _vtk

    def texts_of(self, filter_, event="WarningEvent"):
        """The messages of an update, without the name of the class."""
        texts = observed(filter_)
        filter_.Modified()
        filter_.Update()
        filter_.RemoveObservers("ErrorEvent")
        filter_.RemoveObservers("WarningEvent")
        filter_.RemoveObservers("MessageEvent")
        return [text[text.index("Filter") + 6:] if "Filter" in text else text for text in texts[event]]

    def assert_one(self, texts, *words):
        self.assertEqual(len(texts), 1, texts)
        for word in words:
            self.assertIn(word, texts[0])

    def assert_pieces(self, filter_):
        """Together they are the whole, of an updated filter of surfaces."""
        whole = filter_.GetOutput().GetNumberOfCells()
        counts = []
        for piece in range(3):
            filter_.UpdatePiece(piece, 3, 0)
            counts.append(filter_.GetOutput().GetNumberOfCells())
        is_whole = self.differs("Each piece of isosurfaces and slices is the whole.")
        np.testing.assert_allclose(counts, [whole if is_whole else whole / 3] * 3, atol=1)
        filter_.UpdatePiece(0, 1, 0)
        self.assertEqual(filter_.GetOutput().GetNumberOfCells(), whole)

    def blocks(self):
        """Adjacent blocks of several kinds; two of them have the points of a shared face."""
        boxes = [set_all(image(4), Origin=origin) for origin in (3 * (-1.0,), (0.0, -1.0, -1.0), (-1.0, 0.0, -1.0))]
        blocks = [boxes[0], rectilinear(boxes[1]), unstructured(boxes[2])]
        for block in blocks:
            for association in (POINTS, CELLS):
                add(block, association, "f", np.cos(places_of(block, association) @ [2.0, 3.0, 1.0]))
        return blocks

    def trees(self, blocks):
        """The same blocks in every composite that is a tree, with gaps and leaves that are no data sets."""
        table, partitioned, collection = vtkTable(), vtkPartitionedDataSet(), vtkPartitionedDataSetCollection()
        for i, block in enumerate(blocks):
            partitioned.SetPartition(i, block)
            collection.SetPartition(i, 0, block)
        return [blocks_of(blocks[0], None, *blocks[1:]), blocks_of(blocks[0], blocks_of(table, *blocks[1:]), table),
                partitioned, collection]
