# SPDX-License-Identifier: GPL-3.0-or-later
"""How well splats follow the surface: how much of them strays from it, their area, what of the surface they
leave uncovered, and how far their normals are off.

    PYTHONPATH=... Utilities/offscreen.sh /usr/bin/python3 Benchmark/splat_shapes.py [FILE ARRAY ISOVALUE]...

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

import common
import numpy as np
from analytic_surfaces import unit
from common import corners_of, leaves_of, output_of
from scatteredisopoints import vtkIsopointSplatMapper, vtkIsopointSplatPolygons
from scenes import Scene, configured
from scipy.ndimage import binary_dilation
from scipy.spatial import cKDTree
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkCellCenters, vtkContourFilter
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

PLACES = 300_000  # on splats, and on the reference
RANDOM = np.random.default_rng(1)

# name, field, isovalue
FIELDS = (
    ("sphere", lambda p: np.linalg.norm(p, axis=1), 0.8),
    ("torus", lambda p: np.hypot(np.hypot(p[:, 0], p[:, 1]) - 0.65, p[:, 2]), 0.25),
    ("thin tube", lambda p: np.hypot(np.hypot(p[:, 0], p[:, 1]) - 0.65, p[:, 2]), 0.0445),
    ("cube", lambda p: np.abs(p).max(axis=1), 0.6),
)


def on_triangles(corners, normals):
    """Random places, uniform by area, of triangles (n, 3, 3), with interpolated normals; and the area."""
    chosen, weights = common.random_places(corners, PLACES, RANDOM)
    directions = unit(common.placed(weights, normals[chosen]))
    return common.placed(weights, corners[chosen]), directions, common.areas_of(corners).sum()


def pixels_of(data, mapper, bounds, direction):
    """Which pixels something covers, seen along a direction."""
    actor = configured(vtkActor(), Mapper=common.configured(mapper, data, ScalarVisibility=False))
    actor.GetProperty().LightingOff()
    scene = Scene(actor, background=(0, 0, 0))
    scene.look(np.negative(direction), bounds=bounds)
    return scene.image()[..., 0] > 0


def outside(points, mesh):
    """The splats' pixels outside of a mesh, over the mesh's pixels: the maximum of three views."""
    shares = []
    for direction in ((1, 0.5, -0.4), (-0.3, 1, -0.6), (0.2, -0.3, -1)):
        inside = pixels_of(mesh, vtkPolyDataMapper(), mesh.GetBounds(), direction)
        splats = pixels_of(points, vtkIsopointSplatMapper(), mesh.GetBounds(), direction)
        near = binary_dilation(inside, np.ones((3, 3)), iterations=2)
        shares.append(np.count_nonzero(splats & ~near) / np.count_nonzero(inside))
    return max(shares)


def mesh_of_field(field, isovalue, cells=160):
    """Marching cubes on a fine grid."""
    image = configured(vtkImageData(), Dimensions=3 * [cells + 1], Spacing=3 * [2.0 / cells], Origin=(-1, -1, -1))
    image.GetPointData().SetScalars(common.named("f", field(common.positions_of(image))))
    return contour_of(image, "f", isovalue)


def contour_of(data, array, isovalue):
    contour = vtkContourFilter()
    contour.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, array)
    append = vtkAppendPolyData()
    for block in leaves_of(output_of(contour, data, isovalue)):
        append.AddInputData(block)
    append.Update()
    return append.GetOutput()


def filtered(kind, data, array, isovalue, **properties):
    isopoints = kind()
    is_of_points = all(leaf.GetPointData().HasArray(array) for leaf in leaves_of(data))
    isopoints.SetInputArrayToProcess(0, 0, 0, 0 if is_of_points else 1, array)
    return output_of(isopoints, data, isovalue, **properties)


def samples_of(data, array):
    leaves = (leaf if leaf.GetPointData().HasArray(array) else output_of(vtkCellCenters(), leaf)
              for leaf in leaves_of(data))
    return np.concatenate(list(map(common.positions_of, leaves)))


def reference_of(data, array, isovalue):
    first = leaves_of(data)[0]
    has_cells = first.GetNumberOfCells() > 0 and first.GetCell(0).GetCellDimension() == 3
    if has_cells and first.GetPointData().HasArray(array):
        return contour_of(data, array, isovalue)
    return filtered(common.TRIANGLES, data, array, isovalue, Regularize=False)


def gradient_of(field, places):
    return unit(np.stack([field(places + h) - field(places - h) for h in 1e-6 * np.eye(3)], axis=1))


def print_row(name, data, array, isovalue, mesh, field=None):
    points = filtered(common.POINTS, data, array, isovalue)
    corners = corners_of(mesh)
    on_reference, true_normals, true_area = on_triangles(
        corners, np.repeat(unit(common.normals_of(corners))[:, None], 3, axis=1))
    fans = output_of(vtkIsopointSplatPolygons(), points)
    ids = vtk_to_numpy(fans.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    arrays = fans.GetPoints().GetData(), fans.GetPointData().GetNormals()
    on_splats, normals, area = on_triangles(*(vtk_to_numpy(array).astype(float)[ids] for array in arrays))
    samples = cKDTree(np.unique(samples_of(data, array), axis=0))

    def spacing_at(places):
        return np.median(samples.query(places, k=12)[0], axis=1)

    distances, nearest = cKDTree(on_reference).query(on_splats)
    stray = (distances > 0.5 * spacing_at(on_splats)).mean() * area / true_area
    some = on_reference[: PLACES // 3]
    uncovered = (cKDTree(on_splats).query(some)[0] > 0.25 * spacing_at(some)).mean()
    truth = gradient_of(field, on_splats) if field else true_normals[nearest]
    shading = np.degrees(np.arccos(np.minimum(np.abs((normals * truth).sum(axis=1)), 1))).mean()
    common.print_row(name, f"{points.GetNumberOfPoints():,}", f"{100 * stray:.2f} %", f"{area / true_area:.3f}",
                     f"{100 * uncovered:.2f} %", f"{100 * outside(points, mesh):.2f} %", f"{shading:.2f}")


common.print_head("", "splats", "stray", "area", "uncovered", "outside", "shading, degrees")
arguments = sys.argv[1:]
for path, array, isovalue in zip(arguments[::3], arguments[1::3], map(float, arguments[2::3])):
    data = common.read(path)
    print_row(common.name_of(path), data, array, isovalue, reference_of(data, array, isovalue))
for name, field, isovalue in FIELDS if not arguments else ():
    positions = RANDOM.uniform(-1, 1, (200_000, 3))
    samples = common.cloud_of(positions, field(positions), "f")
    print_row(name, samples, "f", isovalue, mesh_of_field(field, isovalue), field)
