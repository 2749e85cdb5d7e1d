# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of isopoints and of the alternatives against surfaces that are known exactly.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 Benchmark/accuracy.py

Prints a Markdown table: distances from the true surface in mean spacings of the samples, errors of
normals in degrees, and seconds. Only points two spacings inside the samples count. Triangles
without a fit are those of marching tetrahedra on the Delaunay tetrahedralization of all samples; the
grid of marching cubes has as many nodes as there are samples, with exact values but for noise.
"""

import time

import analytic_surfaces as surfaces
import common
from common import POINTS, TRIANGLES
from fits import AnalyticSet, angles_between
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D

FIELDS = {
    "sphere": surfaces.sphere, "torus": surfaces.torus, "gyroid": surfaces.gyroid,
    "Marschner-Lobb": surfaces.marschner_lobb, "Gaussian mixture": surfaces.gaussian_mixture,
    "cube": surfaces.cube, "two sheets": surfaces.two_sheets}
SAMPLINGS = {
    "uniform": surfaces.uniform, "clustered": surfaces.clustered,
    "jittered": surfaces.jittered, "lines": surfaces.lines}


def filtered(kind, projection):
    """Contours by one of the filters."""
    normals = kind.NORMALS_FROM_PLANES if projection == kind.NO_PROJECTION else kind.AUTOMATIC_NORMALS
    return lambda samples, isovalue: common.output_of(
        kind(), samples, isovalue, Projection=projection, DropGaps=False, Regularize=False, NormalMethod=normals)


def marching_cubes(nodes, isovalue):
    """Contours the nodes of a lattice, z fastest."""
    side = round(nodes.GetNumberOfPoints() ** (1 / 3))
    values = vtk_to_numpy(nodes.GetPointData().GetScalars()).reshape(3 * [side])
    grid = common.set_all(vtkImageData(), Dimensions=3 * [side], Spacing=3 * [2 / (side - 1)], Origin=(-1, -1, -1))
    grid.GetPointData().SetScalars(numpy_to_vtk(values.T.ravel(), deep=True))
    return common.output_of(vtkFlyingEdges3D(), grid, isovalue)


CONTESTANTS = {
    "linear interpolation": filtered(POINTS, POINTS.NO_PROJECTION),
    "cubic fit": filtered(POINTS, POINTS.CUBIC_FIT),
    "cubic fit with creases": filtered(POINTS, POINTS.CREASE_FIT),
    "Delaunay + marching tetrahedra": filtered(TRIANGLES, POINTS.NO_PROJECTION)}


def print_row(names, draw, extract):
    begin = time.perf_counter()
    found = extract(draw.samples, draw.isovalue)
    seconds = time.perf_counter() - begin
    positions = common.positions_of(found)
    measured = draw.measured(positions)
    distances, truth = draw.feet(positions[measured])
    normals = vtk_to_numpy(found.GetPointData().GetNormals()).astype(float)[measured]
    angles = angles_between(normals, truth)
    common.print_row(*names, f"{len(positions):,}", f"{distances.max():.4f}", f"{distances.mean():.5f}",
                     f"{angles.max():.1f}", f"{angles.mean():.2f}", f"{seconds:.2f}")


def main(options):
    common.print_head("field", "sampling", "noise, %", "method", "points", "largest distance", "mean",
                      "largest error of a normal", "mean", "s")
    for field in options.fields:
        for percent in options.noise:
            for sampling in options.samplings:
                draw = AnalyticSet(FIELDS[field], SAMPLINGS[sampling], percent / 100).draw(1, options.samples)
                for name, extract in CONTESTANTS.items():
                    print_row([field, sampling, f"{percent:g}", name], draw, extract)
            grid = AnalyticSet(FIELDS[field], surfaces.lattice, percent / 100).draw(1, options.samples)
            print_row([field, "grid", f"{percent:g}", "marching cubes"], grid, marching_cubes)


if __name__ == "__main__":
    parser = common.parser_of(__doc__)
    common.add_numbers(parser, samples=64000)
    for name, known in (("--fields", FIELDS), ("--samplings", SAMPLINGS)):
        parser.add_argument(name, nargs="+", choices=known, default=known, help="default: all")
    parser.add_argument("--noise", nargs="+", type=float, default=(0.0, 1.0, 5.0),
                        help="percents of the field's standard deviation; default: 0 1 5")
    main(parser.parse_args())
