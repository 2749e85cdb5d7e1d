# SPDX-License-Identifier: GPL-3.0-or-later
"""The triangles that vtkIsopointSplatPolygons makes of points, the compiled class and the one in Python.

docs/python.md lists the differences. IS_COMPILED tells where tests follow them.
"""

import numpy as np
import scatteredisopoints
import scatteredisopoints._vtk
from scenes import (
    RING, TUBE, add_array, array, ball_field, blocks_of, check, configured, halves, isopoints, output_of, polydata,
    positions_of, run, subset, torus_field, torus_splats)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkBitArray, vtkSMPTools, vtkSOADataArrayTemplate, vtkStringArray
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray, vtkDataSetAttributes, vtkImageData, vtkMultiBlockDataSet, vtkPartitionedDataSetCollection,
    vtkPolyData)
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkFiltersGeneral import vtkTransformFilter

IS_COMPILED = True
OCTAGON = 8  # triangles
UP = [0.0, 0.0, 1.0]
SHAPES = ("SplatAxis", "SplatPolygon")


def new_polygons():
    return (scatteredisopoints if IS_COMPILED else scatteredisopoints._vtk).vtkIsopointSplatPolygons()


def polygons_of(data, **properties):
    polygons = configured(new_polygons(), **properties)
    events = []
    for event in ("WarningEvent", "ErrorEvent"):
        polygons.AddObserver(event, lambda _, name: events.append(name))
    polygons.SetInputDataObject(data)
    polygons.Update()
    return polygons.GetOutputDataObject(0), events


def corners_of(output):
    return vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def triangles_of(data, **properties):
    """Places and normals of the corners (n, 3, 3), and the output."""
    output, events = polygons_of(data, **properties)
    check(not events, f"no message: {events}")
    if output.GetNumberOfPolys() == 0:
        return np.zeros((0, 3, 3)), np.zeros((0, 3, 3)), output
    corners = corners_of(output)
    return positions_of(output)[corners], array(output, "Normals").astype(float)[corners], output


def areas(triangles):
    return 0.5 * np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])


def area(triangles):
    return np.linalg.norm(areas(triangles), axis=1).sum()


def hidden_points(data):
    """Isopoints without a shape, since others close by represent them."""
    shapes = array(data, "SplatPolygon", cells=True)
    return set(np.flatnonzero(~shapes.any(1) | np.isnan(shapes).any(1)))


def filled(kind, name, values):
    """An array of a kind that NumPy cannot make."""
    result = kind()
    result.SetName(name)
    for value in values:
        result.InsertNextValue(value)
    return result


def grid_of(data):
    append = vtkAppendFilter()
    append.AddInputData(data)
    return output_of(append)


def splats_of_isopoints():
    """The triangles are close to the torus, have its normals and area, and face outwards."""
    data = torus_splats(100_000)
    triangles, normals, output = triangles_of(data)
    check(np.abs(torus_field(triangles.reshape(-1, 3))).max() < 0.01, "on the torus")
    share = area(triangles) / (4 * np.pi**2 * RING * TUBE)
    check(abs(share - 1) < 0.02, f"the area of the torus: {share}")
    facing = (areas(triangles)[:, None] * normals).sum(2)
    check(facing[:, 0].min() > -1e-9, f"none faces away: {facing[:, 0].min()}")
    cells = array(output, "vtkOriginalCellIds", cells=True)
    ids = array(output, "vtkOriginalPointIds")
    check((ids[corners_of(output)] == cells[:, None]).all(), "each triangle is of one isopoint")
    hidden = hidden_points(data)
    check(len(hidden) < 0.1 * data.GetNumberOfPoints(), "few isopoints are hidden")
    check(not set(range(data.GetNumberOfPoints())) - set(cells) - hidden, "each other isopoint has triangles")
    half = area(triangles_of(data, RadiusScale=0.5)[0]) / area(triangles)
    check(abs(half - 0.25) < 0.01, "half the size")


def arrays_are_interpolated():
    """Values are interpolated between isopoints as on a mesh. Splats that share a corner have one value there."""
    data = torus_splats(100_000)
    count, x = data.GetNumberOfPoints(), positions_of(data)[:, 0]
    other_layout = vtkSOADataArrayTemplate["float64"]
    add_array(data, "of doubles", x)
    add_array(data, "of integers", np.arange(count, dtype=np.int32))
    data.GetPointData().AddArray(filled(other_layout, "in another layout", x))
    data.GetPointData().AddArray(filled(vtkStringArray, "words", map(str, range(count))))
    _, _, output = triangles_of(data)
    places, values = positions_of(output), array(output, "of doubles")
    error = np.median(np.abs(values - places[:, 0]))
    check(error < 0.006, f"values where they are: {error}")
    _, group, sizes = np.unique(np.round(places, 5), axis=0, return_inverse=True, return_counts=True)
    low, high = np.full(len(sizes), np.inf), np.full(len(sizes), -np.inf)
    np.minimum.at(low, group.ravel(), values)
    np.maximum.at(high, group.ravel(), values)
    shared, visible = sizes >= 3, count - len(hidden_points(data))
    check(shared.sum() > 1.8 * visible, f"most corners are shared by three: {shared.sum()}, {visible}")
    different = np.count_nonzero((high - low)[shared] > 1e-6)
    check(different < 0.001 * shared.sum(), f"one value at each but {different}")
    copied = output.GetPointData().GetArray("in another layout")
    check(not IS_COMPILED or copied.IsA(other_layout().GetClassName()), "the layout stays")
    check([copied.GetValue(i) for i in range(len(values))] == values.tolist(), "the same means")
    check(np.isin(array(output, "of integers"), np.arange(count)).all(), "integers stay")
    words = output.GetPointData().GetAbstractArray("words")
    check(words.GetNumberOfValues() == len(values) if IS_COMPILED else words is None, "strings are kept")
    check(not any(attributes.HasArray(name) for attributes in (output.GetPointData(), output.GetCellData())
                  for name in SHAPES), "shapes are not")


def octagons_and_octahedra():
    center, radius = np.array([1, 2, 3]), 0.5

    def single(normals):
        return triangles_of(polydata([center], normals, Radius=np.array([radius])))[:2]

    for normal in (UP, [1.0, 2.0, -3.0], [0, 0, -1e-20], [1e30, 0, 0]):
        triangles, normals = single([normal])
        check(len(triangles) == OCTAGON, "an octagon")
        check(np.isclose(np.linalg.norm(areas(triangles).sum(0)), 2 * np.sqrt(2) * radius**2), "an octagon's area")
        check(np.allclose(normals, np.array(normal) / np.linalg.norm(normal)), "of one normal")
        check((areas(triangles) @ normals[0, 0] > 0).all(), "facing along it")
    for normals in (None, [[0.0, 0.0, 0.0]], [[np.nan, 0.0, 0.0]]):
        if not IS_COMPILED:
            output, events = polygons_of(polydata([center], normals))
            check(output.GetNumberOfPolys() == 0, "nothing")
            check(events == (["ErrorEvent"] if normals is None else []), f"an error: {events}")
            continue
        triangles, normals = single(normals)
        volume = np.einsum("ij,ij->i", triangles[:, 0] - center, areas(triangles)).sum() / 3
        check(len(triangles) == 8 and np.isclose(volume, 4 / 3 * radius**3), "an octahedron")
        check(np.allclose(normals, (triangles - center) / radius), "with outward normals")
    for expected, arrays, properties in (
            (2.0, {}, dict(Radius=2.0)),
            (6.0, dict(size=np.array([3.0])), dict(RadiusArrayName="size", RadiusScale=2.0))):
        triangles, _, _ = triangles_of(polydata([(0, 0, 0)], [UP], **arrays), **properties)
        check(np.isclose(np.abs(triangles).max(), expected), f"the radius of {properties}")


def the_automatic_radius_suits_the_finite_points():
    points = np.array([1e9, -1e9, 1e9]) + [(-0.6, 0, 0), (0.6, 0, 0), (0, 0.3, 0.3)]
    sizes = []
    for extra in ([], [(np.inf, 0, 0)], [(0, -np.inf, np.nan)]):
        count = 3 + len(extra)
        data = polydata([*points, *extra], [UP] * count)
        sizes.append(area(triangles_of(data, RadiusArrayName=None, RadiusScale=np.sqrt(count))[0]))
    check(sizes[0] > 0 and np.allclose(sizes, sizes[0], rtol=1e-4), f"of one size: {sizes}")


def what_cannot_be_drawn_is_left_out():
    nan, inf = float("nan"), float("inf")
    points = [(0, 0, 0), (nan, 0, 0), (0, inf, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0), (4, 0, 0), (5, 0, 0)]
    data = polydata(points, [UP] * 8, Radius=np.array([1, 1, 1, 0, -1, nan, inf, 1.0]))
    _, _, output = triangles_of(data)
    check(sorted(set(array(output, "vtkOriginalPointIds"))) == [0, 7], "two of eight")
    ghosts = np.zeros(8, np.uint8)
    ghosts[0], ghosts[7] = vtkDataSetAttributes.DUPLICATEPOINT, vtkDataSetAttributes.HIDDENPOINT
    add_array(data, vtkDataSetAttributes.GhostArrayName(), ghosts)
    check(polygons_of(data)[0].GetNumberOfPolys() == 0, "ghosts")
    torus = torus_splats(20_000)
    numbers = array(torus, "SplatPolygon", cells=True)
    numbers[5, 7] = nan
    numbers[6] = 0
    _, _, output = triangles_of(torus)
    missing = set(range(torus.GetNumberOfPoints())) - set(array(output, "vtkOriginalPointIds"))
    check(missing == hidden_points(torus) >= {5, 6}, f"without a shape: {missing}")
    for empty in (vtkPolyData(), vtkMultiBlockDataSet(), vtkImageData()):
        output, events = polygons_of(empty)
        check(not events and output is not None, "empty input")


def arrays_of_the_wrong_shape():
    torus = torus_splats(20_000)
    for removed in (SHAPES[:1], SHAPES[1:], SHAPES):
        damaged = subset(torus, slice(None))
        for name in removed:
            damaged.GetCellData().RemoveArray(name)
        if removed == SHAPES[1:]:
            add_array(damaged, "SplatPolygon", np.zeros((torus.GetNumberOfPoints(), 7)), cells=True)
        output, events = polygons_of(damaged)
        check(events == ([] if removed == SHAPES else ["WarningEvent"]), f"warnings without {removed}: {events}")
        check(output.GetNumberOfPolys() == OCTAGON * np.count_nonzero(array(torus, "Radius")), "octagons instead")


def shapes_are_those_of_vertices():
    """The first vertex of each point alone gives its splat, wherever it is among the cells."""
    torus = torus_splats(20_000)
    count = torus.GetNumberOfPoints()
    shapes = [array(torus, name, cells=True) for name in SHAPES]
    expected, _, output = triangles_of(torus)
    ids = array(output, "vtkOriginalCellIds", cells=True)

    def with_vertices(cells, tuples):
        """The torus with vertex cells of some points each and the shapes of some points."""
        data, vertices = subset(torus, slice(None)), vtkCellArray()
        data.GetCellData().Initialize()
        for cell in cells:
            vertices.InsertNextCell(len(cell), cell)
        data.SetVerts(vertices)
        for name, values in zip(SHAPES, shapes):
            add_array(data, name, values[tuples], cells=True)
        return data

    order, every = np.random.default_rng(1).permutation(count), np.arange(count)
    alone = [[i] for i in range(count)]
    for name, data in {
            "in another order": with_vertices([[i] for i in order], order),
            "two vertices of a point": with_vertices(2 * alone, np.concatenate([every, np.roll(every, 1)])),
            "cells of several before": with_vertices(
                [[0, 1], every.tolist(), *alone], np.append([9, 9], every))}.items():
        for kind in (data, grid_of(data)):
            triangles, _, output = triangles_of(kind)
            check(np.array_equal(triangles, expected), name)
            check(len(array(output, "vtkOriginalCellIds", cells=True)) == len(expected), "ids of the vertices")
    # Points without a vertex of their own.
    octagons, _, _ = triangles_of(with_vertices([], []))
    visible = np.flatnonzero(array(torus, "Radius"))
    check(len(octagons) == OCTAGON * len(visible), "octagons without cells")
    of_several, _, _ = triangles_of(with_vertices([every.tolist()], [0]))
    check(np.array_equal(of_several, octagons), "octagons for a cell of several")
    some = order[: count // 2]
    for kind in (with_vertices([[i] for i in some], some), grid_of(with_vertices([[i] for i in some], some))):
        triangles, _, output = triangles_of(kind)
        drawn = np.isin(array(output, "vtkOriginalPointIds")[corners_of(output)[:, 0]], some)
        # Shared corners lie where one of those that meet lies, up to rounding.
        same = expected[np.isin(ids, some)]
        check(len(same) == drawn.sum() and np.allclose(triangles[drawn], same, rtol=0, atol=1e-6), "where there is one")
        missing = octagons.reshape(-1, OCTAGON, 3, 3)[~np.isin(visible, some)]
        check(np.array_equal(triangles[~drawn], missing.reshape(-1, 3, 3)), "octagons elsewhere")
    # Files may have them at the points.
    old = with_vertices(alone, [])
    old.GetCellData().Initialize()
    for name, values in zip(SHAPES, shapes):
        add_array(old, name, values)
    check(np.array_equal(triangles_of(old)[0], expected), "arrays of points")
    # A filter turned the normals, and left the axes.
    turned = with_vertices(alone, every)
    normals = array(turned, "Normals")
    normals[:] = np.roll(normals, 1, axis=1)
    slope = np.abs((normals * shapes[0]).sum(1)) / np.linalg.norm(shapes[0], axis=1)
    _, _, output = triangles_of(turned)
    found = np.bincount(array(output, "vtkOriginalCellIds", cells=True), minlength=count)
    check((found[slope > 2e-4] == OCTAGON).all(), "octagons around other normals")


def transforms_turn_splats():
    """vtkTransformFilter turns normals of points and vectors of cells, the axes."""
    torus = torus_splats(20_000)
    transform = vtkTransform()
    transform.RotateWXYZ(40.0, 1.0, 2.0, 3.0)
    triangles, _, _ = triangles_of(output_of(vtkTransformFilter(), Transform=transform, InputData=torus))
    matrix = np.array([[transform.GetMatrix().GetElement(i, k) for k in range(3)] for i in range(3)])
    check(np.abs(triangles - triangles_of(torus)[0] @ matrix.T).max() < 1e-5, "turned splats")


def cells():
    data = polydata([(0, 0, 0), (3, 0, 0)], [UP] * 2, Radius=np.ones(2))
    add_array(data, "value", [5.0, 7.0], cells=True)
    data.GetFieldData().AddArray(filled(vtkStringArray, "of the field", ["a"]))
    for kind in (data, grid_of(data)):
        _, _, output = triangles_of(kind)
        check(array(output, "value", cells=True).tolist() == OCTAGON * [5.0] + OCTAGON * [7.0], "arrays of cells")
    _, _, output = triangles_of(data)
    check(output.GetFieldData().GetAbstractArray("of the field").GetValue(0) == "a", "the field's array")
    data.SetVerts(None)
    data.GetCellData().Initialize()
    _, _, output = triangles_of(data)
    check(output.GetNumberOfPolys() == 2 * OCTAGON, "points without cells")
    check(output.GetCellData().GetNumberOfArrays() == 0, "have no arrays of cells")
    image = configured(vtkImageData(), Dimensions=(3, 2, 1))
    check(not IS_COMPILED or len(triangles_of(image, Radius=0.1)[0]) == 6 * 8, "points of an image")


def blocks():
    torus = torus_splats(20_000)
    data, _ = halves(torus)
    output, _ = polygons_of(data)
    check(output.IsA("vtkMultiBlockDataSet") and output.GetNumberOfBlocks() == 3, "three blocks")
    check(output.GetBlock(1) is None, "one empty")
    count = sum(output.GetBlock(i).GetNumberOfPolys() for i in (0, 2))
    check(count == polygons_of(torus)[0].GetNumberOfPolys(), "the same triangles")
    collection = vtkPartitionedDataSetCollection()
    for i in range(2):
        collection.SetPartition(i, 0, data.GetBlock(2 * i))
    output, _ = polygons_of(collection)
    check(output.GetNumberOfPoints() > torus.GetNumberOfPoints(), "a collection")


def progress_and_aborts():
    """Progress rises while triangles are made, over all blocks. An abort at any event leaves the output empty, and the
    next update is complete."""
    torus = torus_splats(20_000)
    large = torus_splats(100_000)
    for data, fewest in ((large, 4), (blocks_of(large, large), 7), (torus, 1), (blocks_of(*6 * [torus]), 7)):
        polygons = configured(new_polygons(), InputDataObject=data)
        events, abort_at = [], 0

        def watch(caller, _):
            events.append(caller.GetProgress())
            if len(events) == abort_at:
                caller.SetAbortExecute(1)

        def update():
            events.clear()
            polygons.SetAbortExecute(0)
            polygons.Modified()
            polygons.Update()
            return polygons.GetOutputDataObject(0).GetNumberOfElements(1)

        polygons.AddObserver("ProgressEvent", watch)
        count, shares = update(), list(events)
        check(len(shares) >= fewest and shares == sorted(shares), f"progress rises: {shares}")
        for abort_at in range(1, len(shares) - 1):
            left = update()
            # One more step, and the pipeline's own last event.
            check(len(events) <= abort_at + 2, f"work after the abort at event {abort_at}: {events}")
            check(left == 0 and polygons.GetErrorCode() == 0, f"output after the abort at {abort_at}")
        abort_at = 0
        check(update() == count > 0, "the next update")


def bits_are_copied():
    """Several threads copy arrays whose values share bytes."""
    torus = torus_splats(20_000)
    values = np.arange(torus.GetNumberOfPoints()) ** 2 % 7 % 2
    torus.GetPointData().AddArray(filled(vtkBitArray, "bits", map(int, values)))
    add_array(torus, "integers", values.astype(np.int32))
    vtkSMPTools.SetBackend("STDThread")
    _, _, output = triangles_of(torus)
    copied = output.GetPointData().GetArray("bits")
    found = [copied.GetValue(i) for i in range(copied.GetNumberOfTuples())]
    check(found == array(output, "integers").tolist(), "bits")


def precision():
    """Far from the origin, coordinates are doubles, and corners still meet."""
    offset = 1e7
    data = isopoints(lambda p: ball_field(p - offset), offset - 1.3, offset + 1.3, 20_000)
    triangles, _, _ = triangles_of(data)
    check(triangles.dtype == float and abs(triangles.mean() - offset) < 0.1, "there")
    check(np.abs(ball_field(triangles.reshape(-1, 3) - offset)).max() < 0.02, "on the sphere")


TESTS = (splats_of_isopoints, arrays_are_interpolated, octagons_and_octahedra,
         the_automatic_radius_suits_the_finite_points, what_cannot_be_drawn_is_left_out, arrays_of_the_wrong_shape,
         shapes_are_those_of_vertices, transforms_turn_splats, cells, blocks, progress_and_aborts, bits_are_copied,
         precision)
run(*TESTS)
IS_COMPILED, OCTAGON = False, 6
run(*TESTS)
