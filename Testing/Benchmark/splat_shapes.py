# SPDX-License-Identifier: GPL-3.0-or-later
"""How well splats follow the surface: how much of them strays from it, their area, what of the surface they
leave uncovered, and how far their normals are off.

    PYTHONPATH=... Utilities/offscreen.sh /usr/bin/python3 Testing/Benchmark/splat_shapes.py [FILE ARRAY ISOVALUE]...

Prints a Markdown table of analytic fields among random samples, or of files (VTK's XML formats; the array of
points or cells). The reference is the exact surface of a field; of a file, the contour of its cells or, without
cells or with values of cells, the triangles of vtkScatteredIsosurfaceFilter. S is the median
distance of a place to the 12 nearest samples.

- stray: the area of splats farther than S / 2 from the reference, over the area of that;
- area: that of all splats, over that of the reference;
- uncovered: the share of the reference that is farther than S / 4 from all splats;
- outside: pixels of splats that are farther than two pixels from those of the reference, over the pixels of that,
  seen along three directions in windows of 600 x 600 pixels, the largest;
- shading: the mean angle between the normals of splats, interpolated between corners, and that of the reference
  nearby, in degrees.

Needs SciPy.
"""

import sys

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, the factories
from scatteredisopoints import (
    vtkIsopointSplatMapper,
    vtkIsopointSplatPolygons,
    vtkScatteredIsopointFilter,
    vtkScatteredIsosurfaceFilter,
)
from scipy.ndimage import binary_dilation
from scipy.spatial import cKDTree
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkDataObject, vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import (
    vtkAppendPolyData,
    vtkCellCenters,
    vtkContourFilter,
    vtkTriangleFilter,
)
from vtkmodules.vtkIOXML import vtkXMLGenericDataObjectReader
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkWindowToImageFilter,
)

PLACES = 300_000  # on splats, and on the reference
RANDOM = np.random.default_rng(1)

# name, field, isovalue
FIELDS = (
    ("sphere", lambda p: np.linalg.norm(p, axis=1), 0.8),
    ("torus", lambda p: np.hypot(np.hypot(p[:, 0], p[:, 1]) - 0.65, p[:, 2]), 0.25),
    ("thin tube", lambda p: np.hypot(np.hypot(p[:, 0], p[:, 1]) - 0.65, p[:, 2]), 0.0445),
    ("cube", lambda p: np.abs(p).max(axis=1), 0.6),
)


def length(vectors):
    return np.linalg.norm(vectors, axis=-1, keepdims=True)


def on_triangles(triangles, normals, count):
    """Random places, uniform by area, of triangles (n, 3, 3), with interpolated normals; and the area."""
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    areas = 0.5 * length(cross)[:, 0]
    chosen = RANDOM.choice(len(areas), count, p=areas / areas.sum())
    share = np.sqrt(RANDOM.uniform(size=(count, 1)))
    other = RANDOM.uniform(size=(count, 1))
    weights = np.hstack([1 - share, share * (1 - other), share * other])
    places = np.einsum("ij,ijk->ik", weights, triangles[chosen])
    directions = np.einsum("ij,ijk->ik", weights, normals[chosen])
    return places, directions / np.maximum(length(directions), 1e-30), areas.sum()


def fans_of(points):
    """The triangles of all splats (n, 3, 3), and the normals of their corners."""
    polygons = vtkIsopointSplatPolygons()
    polygons.SetInputData(points)
    polygons.Update()
    fans = polygons.GetOutput()
    corners = vtk_to_numpy(fans.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    places = vtk_to_numpy(fans.GetPoints().GetData()).astype(float)
    normals = vtk_to_numpy(fans.GetPointData().GetNormals()).astype(float)
    return places[corners], normals[corners]


def pixels_of(data, mapper, bounds, direction):
    """Which pixels something covers, seen along a direction."""
    mapper.SetInputDataObject(data)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    window, renderer = vtkRenderWindow(), vtkRenderer()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(600, 600)
    window.AddRenderer(renderer)
    renderer.AddActor(actor)
    renderer.GetActiveCamera().SetPosition(*np.negative(direction))
    renderer.GetActiveCamera().SetFocalPoint(0, 0, 0)
    renderer.GetActiveCamera().SetViewUp(0, 0, 1)
    renderer.ResetCamera(bounds)
    renderer.ResetCameraClippingRange()
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    return vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars()).reshape(600, 600, 3)[..., 0] > 0


def outside(points, mesh):
    """The pixels of splats outside of those of a mesh, over the latter: the most in three views."""
    shares = []
    for direction in ((1, 0.5, -0.4), (-0.3, 1, -0.6), (0.2, -0.3, -1)):
        inside = pixels_of(mesh, vtkPolyDataMapper(), mesh.GetBounds(), direction)
        splats = pixels_of(points, vtkIsopointSplatMapper(), mesh.GetBounds(), direction)
        near = binary_dilation(inside, np.ones((3, 3)), iterations=2)
        shares.append(np.count_nonzero(splats & ~near) / np.count_nonzero(inside))
    return max(shares)


def random_samples(count, field):
    positions = RANDOM.uniform(-1, 1, (count, 3))
    cloud, points = vtkPolyData(), vtkPoints()
    points.SetData(numpy_to_vtk(positions, deep=True))
    cloud.SetPoints(points)
    values = numpy_to_vtk(field(positions), deep=True)
    values.SetName("f")
    cloud.GetPointData().SetScalars(values)
    return cloud


def mesh_of_field(field, isovalue, cells=160):
    """Marching cubes on a fine grid."""
    image = vtkImageData()
    image.SetDimensions([cells + 1] * 3)
    image.SetSpacing([2.0 / cells] * 3)
    image.SetOrigin(-1, -1, -1)
    places = np.array([image.GetPoint(i) for i in range(image.GetNumberOfPoints())])
    values = numpy_to_vtk(field(places), deep=True)
    values.SetName("f")
    image.GetPointData().SetScalars(values)
    return contour_of(image, "f", isovalue)


def triangles_of(mesh):
    """The triangles of a mesh (n, 3, 3), and their own normals at each corner."""
    split = vtkTriangleFilter()
    split.SetInputData(mesh)
    split.PassLinesOff()
    split.PassVertsOff()
    split.Update()
    mesh = split.GetOutput()
    places = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
    triangles = places[vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.maximum(length(normals), 1e-30)
    return triangles, np.repeat(normals[:, None], 3, axis=1)


def contour_of(data, array, isovalue):
    contour = vtkContourFilter()
    contour.SetInputData(data)
    contour.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, array)
    contour.SetValue(0, isovalue)
    contour.Update()
    append = vtkAppendPolyData()
    for block in leaves_of(contour.GetOutputDataObject(0)):
        append.AddInputData(block)
    append.Update()
    return append.GetOutput()


def leaves_of(data):
    if not isinstance(data, vtkCompositeDataSet):
        return [data]
    iterator = data.NewIterator()
    leaves = []
    while not iterator.IsDoneWithTraversal():
        leaves.append(iterator.GetCurrentDataObject())
        iterator.GoToNextItem()
    return leaves


def configured(isopoints, data, array, isovalue):
    is_of_points = all(leaf.GetPointData().HasArray(array) for leaf in leaves_of(data))
    association = (
        vtkDataObject.FIELD_ASSOCIATION_POINTS if is_of_points else vtkDataObject.FIELD_ASSOCIATION_CELLS
    )
    isopoints.SetInputData(data)
    isopoints.SetInputArrayToProcess(0, 0, 0, association, array)
    isopoints.SetValue(0, isovalue)
    isopoints.Update()
    return isopoints.GetOutput()


def samples_of(data, array):
    places = []
    for leaf in leaves_of(data):
        if not leaf.GetPointData().HasArray(array):
            centers = vtkCellCenters()
            centers.SetInputData(leaf)
            centers.Update()
            leaf = centers.GetOutput()
        if hasattr(leaf, "GetPoints") and leaf.GetPoints():
            places.append(vtk_to_numpy(leaf.GetPoints().GetData()).astype(float))
        else:
            places.append(np.array([leaf.GetPoint(i) for i in range(leaf.GetNumberOfPoints())]))
    return np.concatenate(places)


def reference_of(data, array, isovalue):
    first = leaves_of(data)[0]
    has_cells = first.GetNumberOfCells() > 0 and first.GetCell(0).GetCellDimension() == 3
    if has_cells and first.GetPointData().HasArray(array):
        return contour_of(data, array, isovalue)
    triangles = vtkScatteredIsosurfaceFilter()
    triangles.RegularizeOff()
    return configured(triangles, data, array, isovalue)


def gradient_of(field, places):
    step = 1e-6
    steps = step * np.eye(3)
    gradients = np.stack([field(places + h) - field(places - h) for h in steps], axis=1)
    return gradients / np.maximum(length(gradients), 1e-30)


def measured(data, array, isovalue, mesh, field):
    """The number of points, stray, area, uncovered, outside and shading."""
    isopoints = vtkScatteredIsopointFilter()
    points = configured(isopoints, data, array, isovalue)
    on_reference, true_normals, true_area = on_triangles(*triangles_of(mesh), PLACES)
    on_splats, normals, area = on_triangles(*fans_of(points), PLACES)
    samples = cKDTree(np.unique(samples_of(data, array), axis=0))

    def spacing_at(places):
        return np.median(samples.query(places, k=12)[0], axis=1)

    distances, nearest = cKDTree(on_reference).query(on_splats)
    stray = (distances > 0.5 * spacing_at(on_splats)).mean() * area / true_area
    some = on_reference[: PLACES // 3]
    uncovered = (cKDTree(on_splats).query(some)[0] > 0.25 * spacing_at(some)).mean()
    truth = gradient_of(field, on_splats) if field else true_normals[nearest]
    cosines = np.abs((normals * truth).sum(axis=1))
    shading = np.degrees(np.arccos(np.minimum(cosines, 1))).mean()
    return points.GetNumberOfPoints(), stray, area / true_area, uncovered, outside(points, mesh), shading


def print_row(name, data, array, isovalue, mesh, field=None):
    count, stray, area, uncovered, beyond, shading = measured(data, array, isovalue, mesh, field)
    print(
        f"| {name} | {count:,} | {100 * stray:.2f} % | {area:.3f} | {100 * uncovered:.2f} % | {100 * beyond:.2f} %"
        f" | {shading:.2f} |",
        flush=True,
    )


def main(arguments):
    print("| | splats | stray | area | uncovered | outside | shading, degrees |\n|---|---|---|---|---|---|---|", flush=True)
    for path, array, isovalue in zip(arguments[::3], arguments[1::3], arguments[2::3]):
        reader = vtkXMLGenericDataObjectReader()
        reader.SetFileName(path)
        reader.Update()
        data = reader.GetOutputDataObject(0)
        print_row(path.split("/")[-1], data, array, float(isovalue), reference_of(data, array, float(isovalue)))
    for name, field, isovalue in FIELDS if not arguments else ():
        data = random_samples(200_000, field)
        print_row(name, data, "f", isovalue, mesh_of_field(field, isovalue), field)


if __name__ == "__main__":
    main(sys.argv[1:])
