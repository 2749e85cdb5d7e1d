# SPDX-License-Identifier: GPL-3.0-or-later
"""Times isopoints and other methods on the distance to the center of a cube of side 200, isovalue 70.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 Benchmark/speed.py

Prints a Markdown table: elapsed seconds, the same over those of isopoints without fits, over those
of one copy of the samples in memory, and in nanoseconds a sample; the number of points of the
surface and their largest distance from the sphere; and the peak of memory in bytes a sample, in
addition to what was taken before. Each row is the faster of two runs, except updates of a filter
that has a tree, and vtkDelaunay3D. CGAL is timed by TriangleAdversaries.
"""

import common
import numpy as np
from common import POINTS, RADIUS, SIDE, TRIANGLES, measure, set_all, uniform
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkSMPTools
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkStaticPointLocator
from vtkmodules.vtkFiltersCore import vtkContourFilter, vtkDelaunay3D, vtkFlyingEdges3D, vtkProbeFilter
from vtkmodules.vtkFiltersPoints import vtkPointInterpolator, vtkShepardKernel

MOST_WITH_PEERS, MOST_WITH_DELAUNAY = 4e6, 5e4  # the latter takes over a minute for 100,000


def clustered(count, random):
    """The density varies ten-thousandfold, highest at a point of the sphere."""
    distances = 1 + 99 * random.random((3 * count, 1), dtype=np.float32)
    directions = uniform(3 * count, random)
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    positions = np.array([RADIUS, 0, 0], np.float32) + distances * directions
    return positions[(np.abs(positions) < SIDE / 2).all(axis=1)][:count]


def slab(count, random):
    return uniform(count, random) / np.array([1, 1, 20], np.float32)


def lattice(count, _):
    side = round(count ** (1 / 3))
    nodes = np.float32(SIDE) * ((np.arange(side, dtype=np.float32) + 0.5) / side - 0.5)
    return np.stack(np.meshgrid(nodes, nodes, nodes, indexing="ij"), axis=-1).reshape(-1, 3)[:, ::-1]


def cloud(positions):
    return common.cloud_of(positions, np.linalg.norm(positions, axis=1))


def resampled(path, count):
    """A volume, interpolated at random positions."""
    volume = common.read(path)
    bounds = np.array(volume.GetBounds()).reshape(3, 2)
    shares = np.random.default_rng(1).random((count, 3), dtype=np.float32)
    positions = (bounds[:, 0] + shares * (bounds[:, 1] - bounds[:, 0])).astype(np.float32)
    probe = vtkProbeFilter()
    probe.SetSourceData(volume)
    values = common.output_of(probe, cloud(positions)).GetPointData().GetArray(
        volume.GetPointData().GetScalars().GetName())
    return common.cloud_of(positions, vtk_to_numpy(values).astype(np.float32))


class Table:
    """The rows of one cloud."""

    def __init__(self, name, samples, threads, isovalue=RADIUS):
        self.name, self.samples, self.threads, self.isovalue = name, samples, threads, isovalue
        self.count = samples.GetNumberOfPoints()
        self.ours = 0
        arrays = [vtk_to_numpy(array) for array in (
            samples.GetPoints().GetData(), samples.GetPointData().GetScalars())]
        targets = [np.zeros_like(array) for array in arrays]
        self.copy = min(measure(lambda: [np.copyto(*pair) for pair in zip(targets, arrays)])[0] for _ in range(5))

    def add(self, what, new_algorithm, runs=2, threads=None, radius=None):
        """A row for the updates of algorithms. @returns the last one's surface"""
        taken = []
        for _ in range(runs):
            algorithm = new_algorithm()
            taken.append(measure(algorithm.Update))
        (seconds, _, peak), surface = min(taken), algorithm.GetOutput()
        self.ours = self.ours or seconds
        points = common.positions_of(surface)
        radius = radius or (self.isovalue if self.name != "file" else None)
        deviation = np.abs(np.linalg.norm(points, axis=1) - radius).max() if radius else np.nan
        common.print_row(
            self.name, f"{self.count:,}", threads or self.threads, what, f"{seconds:.4f}", f"{seconds / self.ours:.3g}",
            f"{seconds / self.copy:.3g}", f"{1e9 * seconds / self.count:.0f}", f"{len(points):,}", f"{deviation:.5f}",
            f"{peak / self.count:.1f}")
        return surface

    def new_filter(self, kind=POINTS, has_fit=True, is_all=True):
        """@param is_all with normals and splats, or with gradients in their place"""
        return common.configured(
            kind(), self.samples, self.isovalue, ComputeNormals=has_fit and is_all, ComputeSplats=has_fit and is_all,
            Regularize=has_fit, ComputeGradients=has_fit and not is_all, UseAllCores=False,
            Projection=kind.CUBIC_FIT if has_fit else kind.NO_PROJECTION)

    def add_ours(self):
        """@returns the surface of isopoints alone"""
        surface = self.add("isopoints", lambda: self.new_filter(has_fit=False))
        self.add("isopoints, projected, gradients", lambda: self.new_filter(is_all=False))
        self.add("isopoints, projected, normals, splats", self.new_filter)
        self.add("triangles", lambda: self.new_filter(TRIANGLES, has_fit=False))
        self.add("triangles, projected, normals", lambda: self.new_filter(TRIANGLES))
        self.add_later_updates()
        if self.threads > 1:
            vtkSMPTools.Initialize(1)
            self.add("isopoints", lambda: self.new_filter(has_fit=False), threads=1)
            self.add("isopoints, projected, normals, splats", self.new_filter, threads=1)
            vtkSMPTools.Initialize(self.threads)
        return surface

    def add_later_updates(self):
        kept = self.new_filter(has_fit=False)
        kept.Update()
        for isovalue in (69.9, 30.0, 70.0) if self.name != "file" else ():
            kept.SetValue(0, isovalue)
            self.add(f"then isovalue {isovalue:g}", lambda: kept, 1, radius=isovalue)
        # Moves the surface at least as far as the next step of a simulation would.
        array = self.samples.GetPointData().GetScalars()
        values = vtk_to_numpy(array)
        former = values.copy()
        values += 0.125 * vtk_to_numpy(self.samples.GetPoints().GetData())[:, 0]
        array.Modified()
        self.add("then new values at the same positions", lambda: kept, 1)
        values[:] = former
        array.Modified()

    def add_peers(self, surface_points):
        self.add("VTK: resample to a grid (8 closest) + Flying Edges", lambda: self.resampling(surface_points))
        if self.count <= MOST_WITH_DELAUNAY:
            self.add("VTK: vtkDelaunay3D + contour", self.delaunay, 1, threads=1)

    def resampling(self, surface_points):
        """A grid that yields as many points: a sphere crosses 6 pi (r / spacing)^2 of its edges."""
        spacing = self.isovalue * np.sqrt(6 * np.pi / surface_points)
        bounds = np.array(self.samples.GetBounds()).reshape(3, 2)
        grid = set_all(vtkImageData(), Spacing=3 * [spacing], Origin=bounds[:, 0],
                       Dimensions=[int(length / spacing) + 1 for length in bounds[:, 1] - bounds[:, 0]])
        kernel = set_all(vtkShepardKernel(), NumberOfPoints=8)
        kernel.SetKernelFootprintToNClosest()
        interpolator = set_all(vtkPointInterpolator(), InputData=grid, SourceData=self.samples, Kernel=kernel,
                               Locator=vtkStaticPointLocator())
        return self.contour_of(interpolator, set_all(vtkFlyingEdges3D(), ComputeNormals=False))

    def delaunay(self):
        return self.contour_of(set_all(vtkDelaunay3D(), InputData=self.samples), vtkContourFilter())

    def contour_of(self, source, contour):
        contour.SetInputConnection(source.GetOutputPort())
        contour.SetInputArrayToProcess(0, 0, 0, 0, "values")
        contour.SetValue(0, self.isovalue)
        return contour


def compare(options):
    common.print_head("cloud", "samples", "threads", "method", "seconds", "times isopoints", "times a copy",
                      "ns a sample", "points", "largest deviation", "peak, bytes a sample")
    for millions in (0.01, 0.05, 0.25, 1, 4, 8, 16, 32, 64, 128):
        if millions <= options.largest:
            positions = uniform(int(1e6 * millions), np.random.default_rng(1))
            table = Table("uniform", cloud(positions), options.threads)
            surface = table.add_ours()
            if table.count <= MOST_WITH_PEERS:
                table.add_peers(surface.GetNumberOfPoints())
    for sampling in (clustered, slab, lattice):
        positions = sampling(int(1e6 * min(4, options.largest)), np.random.default_rng(1))
        Table(sampling.__name__, cloud(positions), options.threads).add_ours()
    if options.file:
        path, isovalue = options.file
        Table("file", resampled(path, 16000000), options.threads, float(isovalue)).add_ours()


# Of Tables 1 and 2 of [RL06]: millions of samples, angle, seconds, largest deviation; None: not given.
PUBLISHED = (
    (4, 54.7, 70, None), (8, 54.7, 151, None), (12, 54.7, 243, None), (16, 54.7, 318, None),
    (8, 15, None, 0.0425), (8, 35, None, 0.0355), (8, 55, None, 0.0320), (8, 80, None, 0.0182))


def repeat_paper(options):
    common.print_head("samples, million", "angle", "seconds [RL06]", "linear", "quadratic", "largest deviation [RL06]",
                      "linear", "quadratic")
    for millions, angle, published_seconds, published_deviation in PUBLISHED:
        samples = cloud(uniform(int(1e6 * millions), np.random.default_rng(1)))
        seconds, deviations = [published_seconds], [published_deviation]
        for projection in (POINTS.NO_PROJECTION, POINTS.QUADRATIC_FIT):
            properties = {**common.alone(), "Angle": angle, "Projection": projection}
            isopoints = common.configured(POINTS(), samples, RADIUS, **properties)
            seconds.append(round(measure(isopoints.Update)[0], 2))
            distances = np.linalg.norm(common.positions_of(isopoints.GetOutput()), axis=1)
            deviations.append(round(np.abs(distances - RADIUS).max(), 5))
        common.print_row(millions, f"{angle:g}", *seconds, *deviations)


if __name__ == "__main__":
    parser = common.parser_of(__doc__)
    common.add_numbers(parser, threads=2)
    parser.add_argument("--largest", type=float, default=64, metavar="MILLIONS",
                        help="of samples of the largest uniform cloud; default: 64")
    parser.add_argument("--file", nargs=2, metavar=("IMAGE.vti", "ISOVALUE"),
                        help="also a volume, interpolated at 16 million random positions")
    parser.add_argument("--paper", action="store_true", help="Tables 1 and 2 of [RL06] (docs/references.md) instead")
    arguments = parser.parse_args()
    common.set_threads(arguments.threads)
    repeat_paper(arguments) if arguments.paper else compare(arguments)
