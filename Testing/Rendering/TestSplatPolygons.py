# SPDX-License-Identifier: GPL-3.0-or-later
"""The triangles that vtkIsopointSplatPolygons makes of points."""

import numpy as np
from scatteredisopoints import vtkIsopointSplatPolygons
from scenes import RING, TUBE, add_array, check, isopoints, polydata, subset, torus_splats
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import (
    vtkBitArray,
    vtkSMPTools,
    vtkSOADataArrayTemplate,
    vtkStringArray,
    vtkUnsignedCharArray,
)
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray,
    vtkDataSetAttributes,
    vtkImageData,
    vtkMultiBlockDataSet,
    vtkPartitionedDataSetCollection,
    vtkPolyData,
)
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkFiltersGeneral import vtkTransformFilter

UP = [0.0, 0.0, 1.0]
SHAPES = ("SplatAxis", "SplatPolygon")


def polygons_of(data, **properties):
    polygons = vtkIsopointSplatPolygons()
    for name, value in properties.items():
        getattr(polygons, "Set" + name)(value)
    events = []
    for event in ("WarningEvent", "ErrorEvent"):
        polygons.AddObserver(event, lambda _, name: events.append(name))
    polygons.SetInputDataObject(data)
    polygons.Update()
    return polygons.GetOutputDataObject(0), events


def triangles_of(data, **properties):
    """Places and normals of the corners (n, 3, 3), and the output."""
    output, events = polygons_of(data, **properties)
    check(not events, f"no message: {events}")
    if output.GetNumberOfPolys() == 0:
        return np.zeros((0, 3, 3)), np.zeros((0, 3, 3)), output
    corners = vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    places = vtk_to_numpy(output.GetPoints().GetData()).astype(float)
    normals = vtk_to_numpy(output.GetPointData().GetNormals()).astype(float)
    return places[corners], normals[corners], output


def array(output, name, cells=False):
    data = output.GetCellData() if cells else output.GetPointData()
    return vtk_to_numpy(data.GetArray(name))


def areas(triangles):
    return 0.5 * np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])


def hidden_points(data):
    """Isopoints without a shape, since others close by represent them."""
    shapes = vtk_to_numpy(data.GetCellData().GetArray("SplatPolygon"))
    return set(np.flatnonzero(~shapes.any(1) | np.isnan(shapes).any(1)))


def splats_of_isopoints():
    """Close to the torus and its normals, of its area, facing outwards."""
    data = torus_splats(100_000)
    triangles, normals, output = triangles_of(data)
    x, y, z = np.moveaxis(triangles, -1, 0)
    distance = np.hypot(np.hypot(x, y) - RING, z) - TUBE
    check(np.abs(distance).max() < 0.01, "on the torus")
    area = np.linalg.norm(areas(triangles), axis=1).sum() / (4 * np.pi**2 * RING * TUBE)
    check(abs(area - 1) < 0.02, f"the area of the torus: {area}")
    facing = (areas(triangles)[:, None] * normals).sum(2)
    check(facing[:, 0].min() > -1e-9, f"none faces away: {facing[:, 0].min()}")
    ids = array(output, "vtkOriginalPointIds")
    cells = array(output, "vtkOriginalCellIds", cells=True)
    corners = vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    check((ids[corners] == cells[:, None]).all(), "each triangle is of one isopoint")
    hidden = hidden_points(data)
    check(len(hidden) < 0.1 * data.GetNumberOfPoints(), "few isopoints are hidden")
    check(not set(range(data.GetNumberOfPoints())) - set(cells) - hidden, "each other isopoint has triangles")
    scaled, _, _ = triangles_of(data, RadiusScale=0.5)
    half = np.linalg.norm(areas(scaled), axis=1).sum() / np.linalg.norm(areas(triangles), axis=1).sum()
    check(abs(half - 0.25) < 0.01, "half the size")


def arrays_are_interpolated():
    """Between isopoints, as on a mesh: across corners that splats share there is no step."""
    data = torus_splats(100_000)
    count = data.GetNumberOfPoints()
    x = vtk_to_numpy(data.GetPoints().GetData())[:, 0]
    add_array(data, "of doubles", x.astype(float))
    other_layout = vtkSOADataArrayTemplate["float64"]()
    other_layout.SetName("in another layout")
    other_layout.SetNumberOfTuples(count)
    for i in range(count):
        other_layout.SetValue(i, x[i])
    data.GetPointData().AddArray(other_layout)
    add_array(data, "of integers", np.arange(count, dtype=np.int32))
    words = vtkStringArray()
    words.SetName("words")
    for i in range(count):
        words.InsertNextValue(str(i))
    data.GetPointData().AddArray(words)
    _, _, output = triangles_of(data)
    places = vtk_to_numpy(output.GetPoints().GetData())
    error = np.abs(array(output, "of doubles") - places[:, 0])
    check(np.median(error) < 0.006, f"values where they are: {np.median(error)}")
    ids = array(output, "vtkOriginalPointIds")
    rounded = np.round(places, 5)
    _, group, sizes = np.unique(rounded, axis=0, return_inverse=True, return_counts=True)
    low, high = np.full(len(sizes), np.inf), np.full(len(sizes), -np.inf)
    np.minimum.at(low, group.ravel(), array(output, "of doubles"))
    np.maximum.at(high, group.ravel(), array(output, "of doubles"))
    shared = sizes >= 3
    visible = count - len(hidden_points(data))
    check(shared.sum() > 1.8 * visible, f"most corners are shared by three: {shared.sum()}, {visible}")
    different = np.count_nonzero((high - low)[shared] > 1e-6)
    check(different < 0.001 * shared.sum(), f"one value at each but {different}")
    copied = output.GetPointData().GetArray("in another layout")
    check(copied.IsA(other_layout.GetClassName()), "the layout stays")
    check([copied.GetValue(i) for i in range(len(ids))] == array(output, "of doubles").tolist(),
          "the same means")
    check((np.isin(array(output, "of integers"), np.arange(count))).all(), "integers stay")
    strings = output.GetPointData().GetAbstractArray("words")
    check(strings.GetNumberOfValues() == len(ids), "strings are kept")
    for name in SHAPES:
        check(not output.GetPointData().HasArray(name), f"{name} is not")
        check(not output.GetCellData().HasArray(name), f"{name} of cells is not")


def octagons_and_octahedra():
    radius = 0.5
    for normal in (UP, [1.0, 2.0, -3.0], [0, 0, -1e-20], [1e30, 0, 0]):
        triangles, normals, _ = triangles_of(polydata([(1, 2, 3)], [normal], Radius=np.array([radius])))
        check(len(triangles) == 8, "eight triangles")
        total = areas(triangles).sum(0)
        check(np.isclose(np.linalg.norm(total), 2 * np.sqrt(2) * radius**2), "an octagon's area")
        check(np.allclose(normals, np.array(normal) / np.linalg.norm(normal)), "of one normal")
        check((areas(triangles) @ normals[0, 0] > 0).all(), "facing along it")
    for normals in (None, [[0.0, 0.0, 0.0]], [[np.nan, 0.0, 0.0]]):
        triangles, normals, _ = triangles_of(polydata([(1, 2, 3)], normals, Radius=np.array([radius])))
        volume = np.einsum("ij,ij->i", triangles[:, 0] - [1, 2, 3], areas(triangles)).sum() / 3
        check(len(triangles) == 8 and np.isclose(volume, 4 / 3 * radius**3), "an octahedron")
        check(np.allclose(normals, (triangles - [1, 2, 3]) / radius), "with outward normals")
    triangles, _, _ = triangles_of(polydata([(0, 0, 0)], [UP]), Radius=2.0)
    check(np.isclose(np.abs(triangles).max(), 2.0), "a constant radius")
    triangles, _, _ = triangles_of(
        polydata([(0, 0, 0)], [UP], size=np.array([3.0])), RadiusArrayName="size", RadiusScale=2.0
    )
    check(np.isclose(np.abs(triangles).max(), 6.0), "another array, scaled")


def the_automatic_radius_suits_the_finite_points():
    points = np.array([1e9, -1e9, 1e9]) + [(-0.6, 0, 0), (0.6, 0, 0), (0, 0.3, 0.3)]
    sizes = []
    for extra in ([], [(np.inf, 0, 0)], [(0, -np.inf, np.nan)]):
        count = 3 + len(extra)
        data = polydata([*points, *extra], [UP] * count)
        triangles, _, _ = triangles_of(data, RadiusArrayName=None, RadiusScale=np.sqrt(count))
        sizes.append(np.linalg.norm(areas(triangles), axis=1).sum())
    check(sizes[0] > 0 and np.allclose(sizes, sizes[0], rtol=1e-4), f"of one size: {sizes}")


def what_cannot_be_drawn_is_left_out():
    nan, inf = float("nan"), float("inf")
    points = [(0, 0, 0), (nan, 0, 0), (0, inf, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0), (4, 0, 0), (5, 0, 0)]
    data = polydata(points, [UP] * 8, Radius=np.array([1, 1, 1, 0, -1, nan, inf, 1.0]))
    _, _, output = triangles_of(data)
    check(sorted(set(array(output, "vtkOriginalPointIds"))) == [0, 7], "two of eight")
    ghosts = vtkUnsignedCharArray()
    ghosts.SetName(vtkDataSetAttributes.GhostArrayName())
    for i in range(8):
        ghosts.InsertNextValue(
            (vtkDataSetAttributes.DUPLICATEPOINT if i == 0 else 0)
            | (vtkDataSetAttributes.HIDDENPOINT if i == 7 else 0)
        )
    data.GetPointData().AddArray(ghosts)
    check(polygons_of(data)[0].GetNumberOfPolys() == 0, "ghosts")
    torus = torus_splats(20_000)
    numbers = vtk_to_numpy(torus.GetCellData().GetArray("SplatPolygon"))
    numbers[5, 7] = nan
    numbers[6] = 0
    _, _, output = triangles_of(torus)
    missing = set(range(torus.GetNumberOfPoints())) - set(array(output, "vtkOriginalPointIds"))
    check(missing == hidden_points(torus), f"without a shape: {missing}")
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
        expected = [] if removed == SHAPES else ["WarningEvent"]
        check(events == expected, f"warnings without {removed}: {events}")
        check(output.GetNumberOfPolys() == 8 * np.count_nonzero(array(torus, "Radius")), "octagons instead")


def shapes_are_those_of_vertices():
    """The first vertex of each point alone gives its splat, wherever it is among the cells."""
    torus = torus_splats(20_000)
    count = torus.GetNumberOfPoints()
    shapes = [array(torus, name, cells=True) for name in SHAPES]
    expected, _, output = triangles_of(torus)
    ids = array(output, "vtkOriginalCellIds", cells=True)

    def with_vertices(cells, tuples):
        """The torus with vertex cells of some points each and the shapes of some points."""
        data = subset(torus, slice(None))
        data.GetCellData().Initialize()
        vertices = vtkCellArray()
        for cell in cells:
            vertices.InsertNextCell(len(cell), cell)
        data.SetVerts(vertices)
        for name, values in zip(SHAPES, shapes):
            add_array(data, name, values[tuples], cells=True)
        return data

    def grid_of(data):
        append = vtkAppendFilter()
        append.AddInputData(data)
        append.Update()
        return append.GetOutput()

    order = np.random.default_rng(1).permutation(count)
    alone = [[i] for i in range(count)]
    wrong = np.roll(np.arange(count), 1)
    for name, data in {
        "in another order": with_vertices([[i] for i in order], order),
        "two vertices of a point": with_vertices(2 * alone, np.concatenate([np.arange(count), wrong])),
        "cells of several before": with_vertices(
            [[0, 1], list(range(count)), *alone], np.concatenate([[9, 9], np.arange(count)])),
    }.items():
        for kind in (data, grid_of(data)):
            triangles, _, output = triangles_of(kind)
            check(np.array_equal(triangles, expected), name)
            cells = array(output, "vtkOriginalCellIds", cells=True)
            check(len(cells) == len(expected), "ids of the vertices")
    # Points without a vertex of their own.
    octagons, _, _ = triangles_of(with_vertices([], []))
    visible = np.flatnonzero(array(torus, "Radius"))
    check(len(octagons) == 8 * len(visible), "octagons without cells")
    check(np.array_equal(triangles_of(with_vertices([list(range(count))], [0]))[0], octagons),
          "octagons for a cell of several")
    some = order[: count // 2]
    for kind in (with_vertices([[i] for i in some], some), grid_of(with_vertices([[i] for i in some], some))):
        triangles, _, output = triangles_of(kind)
        own = array(output, "vtkOriginalPointIds")
        points = own[vtk_to_numpy(output.GetPolys().GetConnectivityArray())[::3]]
        drawn = np.isin(points, some)
        check(np.array_equal(triangles[drawn], expected[np.isin(ids, some)]), "where there is one")
        missing = ~np.isin(visible, some)
        check(np.array_equal(triangles[~drawn], octagons.reshape(-1, 8, 3, 3)[missing].reshape(-1, 3, 3)),
              "octagons elsewhere")
    # Files may have them at the points.
    old = with_vertices(alone, [])
    old.GetCellData().Initialize()
    for name, values in zip(SHAPES, shapes):
        add_array(old, name, values)
    check(np.array_equal(triangles_of(old)[0], expected), "arrays of points")
    # A filter turned the normals, and left the axes.
    turned = with_vertices(alone, np.arange(count))
    normals = vtk_to_numpy(turned.GetPointData().GetNormals())
    normals[:] = np.roll(normals, 1, axis=1)
    slope = np.abs((normals * shapes[0]).sum(1)) / np.linalg.norm(shapes[0], axis=1)
    triangles, _, output = triangles_of(turned)
    found = np.bincount(array(output, "vtkOriginalCellIds", cells=True), minlength=count)
    check((found[slope > 2e-4] == 8).all(), "octagons around other normals")


def transforms_turn_splats():
    """vtkTransformFilter turns normals of points and vectors of cells, the axes."""
    torus = torus_splats(20_000)
    expected, _, _ = triangles_of(torus)
    transform = vtkTransform()
    transform.RotateWXYZ(40.0, 1.0, 2.0, 3.0)
    turn = vtkTransformFilter()
    turn.SetTransform(transform)
    turn.SetInputData(torus)
    turn.Update()
    triangles, _, _ = triangles_of(turn.GetOutput())
    matrix = np.array([[transform.GetMatrix().GetElement(i, k) for k in range(3)] for i in range(3)])
    check(np.abs(triangles - expected @ matrix.T).max() < 1e-5, "turned splats")


def cells():
    data = polydata([(0, 0, 0), (3, 0, 0)], [UP] * 2, Radius=np.ones(2))
    data.GetCellData().AddArray(named([5.0, 7.0], "value"))
    data.GetFieldData().AddArray(named([3.0], "of the field"))
    _, _, output = triangles_of(data)
    check(array(output, "value", cells=True).tolist() == 8 * [5.0] + 8 * [7.0], "arrays of cells")
    check(output.GetFieldData().GetArray("of the field").GetValue(0) == 3.0, "the field's array")
    grid = vtkAppendFilter()
    grid.AddInputData(data)
    grid.Update()
    _, _, output = triangles_of(grid.GetOutput())
    check(array(output, "value", cells=True).tolist() == 8 * [5.0] + 8 * [7.0], "of a grid")
    data.SetVerts(None)
    data.GetCellData().Initialize()
    _, _, output = triangles_of(data)
    check(output.GetNumberOfPolys() == 16, "points without cells")
    check(output.GetCellData().GetNumberOfArrays() == 0, "have no arrays of cells")
    image = vtkImageData()
    image.SetDimensions(3, 2, 1)
    triangles, _, _ = triangles_of(image, Radius=0.1)
    check(len(triangles) == 6 * 8, "points of an image")


def named(values, name):
    result = numpy_to_vtk(np.array(values), deep=True)
    result.SetName(name)
    return result


def blocks():
    torus = torus_splats(20_000)
    left = vtk_to_numpy(torus.GetPoints().GetData())[:, 0] < 0
    whole = polygons_of(torus)[0].GetNumberOfPolys()
    data = vtkMultiBlockDataSet()
    data.SetBlock(0, subset(torus, left))
    data.SetBlock(2, subset(torus, ~left))
    output, _ = polygons_of(data)
    check(output.IsA("vtkMultiBlockDataSet") and output.GetNumberOfBlocks() == 3, "three blocks")
    check(output.GetBlock(1) is None, "one empty")
    count = sum(output.GetBlock(i).GetNumberOfPolys() for i in (0, 2))
    check(count == whole, "the same triangles")
    collection = vtkPartitionedDataSetCollection()
    collection.SetPartition(0, 0, subset(torus, left))
    collection.SetPartition(1, 0, subset(torus, ~left))
    output, _ = polygons_of(collection)
    check(output.GetNumberOfPoints() > torus.GetNumberOfPoints(), "a collection")


def progress():
    """It rises while the triangles are made, over all blocks."""
    torus = torus_splats(100_000)
    blocks = vtkMultiBlockDataSet()
    blocks.SetBlock(0, torus)
    blocks.SetBlock(1, torus)
    for data, fewest in ((torus, 4), (blocks, 7)):
        polygons = vtkIsopointSplatPolygons()
        polygons.SetInputData(data)
        shares = []
        polygons.AddObserver("ProgressEvent", lambda caller, _, to=shares: to.append(caller.GetProgress()))
        polygons.Update()
        check(len(shares) >= fewest and shares == sorted(shares), f"progress rises: {shares}")


def aborts():
    """An abort at any event leaves the output empty, and the next update is complete."""
    torus = torus_splats(20_000)
    blocks = vtkMultiBlockDataSet()
    for i in range(6):
        blocks.SetBlock(i, torus)
    for data in (torus, blocks):
        polygons = vtkIsopointSplatPolygons()
        polygons.SetInputDataObject(data)
        events = []
        abort_at = 0

        def watch(caller, _):
            events.append(caller.GetProgress())
            if len(events) == abort_at:
                caller.SetAbortExecute(1)

        polygons.AddObserver("ProgressEvent", watch)
        polygons.Update()
        count = polygons.GetOutputDataObject(0).GetNumberOfElements(1)
        all_events = len(events)
        for abort_at in range(1, all_events - 1):
            events.clear()
            polygons.Modified()
            polygons.Update()
            # One more step, and the pipeline's own last event.
            check(len(events) <= abort_at + 2, f"work after the abort at event {abort_at}: {events}")
            left = polygons.GetOutputDataObject(0).GetNumberOfElements(1)
            check(left == 0 and polygons.GetErrorCode() == 0, f"output after the abort at {abort_at}")
        abort_at = 0
        polygons.SetAbortExecute(0)
        polygons.Modified()
        polygons.Update()
        check(polygons.GetOutputDataObject(0).GetNumberOfElements(1) == count, "the next update")


def bits_are_copied():
    """Of arrays whose values share bytes, on several threads."""
    torus = torus_splats(20_000)
    values = np.arange(torus.GetNumberOfPoints()) ** 2 % 7 % 2
    bits = vtkBitArray()
    bits.SetName("bits")
    for value in values:
        bits.InsertNextValue(int(value))
    torus.GetPointData().AddArray(bits)
    add_array(torus, "integers", values.astype(np.int32))
    vtkSMPTools.SetBackend("STDThread")
    _, _, output = triangles_of(torus)
    copied = output.GetPointData().GetArray("bits")
    found = [copied.GetValue(i) for i in range(copied.GetNumberOfTuples())]
    check(found == array(output, "integers").tolist(), "bits")


def precision():
    """Far from the origin, in doubles, corners still meet."""
    offset = 1e7
    data = isopoints(
        lambda p: 1 - np.linalg.norm(p - offset, axis=1), [offset - 1.3] * 3, [offset + 1.3] * 3, 20_000
    )
    triangles, _, output = triangles_of(data)
    check(triangles.dtype == float and abs(triangles.mean() - offset) < 0.1, "there")
    check(np.abs(np.linalg.norm(triangles - offset, axis=2) - 1).max() < 0.02, "on the sphere")


if __name__ == "__main__":
    for test in (
        splats_of_isopoints,
        arrays_are_interpolated,
        octagons_and_octahedra,
        the_automatic_radius_suits_the_finite_points,
        what_cannot_be_drawn_is_left_out,
        arrays_of_the_wrong_shape,
        shapes_are_those_of_vertices,
        transforms_turn_splats,
        cells,
        blocks,
        progress,
        aborts,
        bits_are_copied,
        precision,
    ):
        print(test.__name__, flush=True)
        test()
