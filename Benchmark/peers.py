# SPDX-License-Identifier: GPL-3.0-or-later
"""Packages that interpolate scattered samples, all called alike, and an environment that has them.

A peer is made of positions, which it may prepare. Its call takes a list of arrays, places and the spacing of the
samples, and returns the values at the places, shape (arrays, places), and the gradients of the first array or None.
"""

import importlib.util
import os
import pathlib
import subprocess
import sys
import venv

import numpy as np

PACKAGES = ("numpy", "scipy", "vtk", "wlsqm", "pycompadre")
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "OMP_PROC_BIND": "false"}


def enter(folder):
    """Runs this program again in a virtual environment that has the packages. Prints which could not be installed."""
    folder = pathlib.Path(folder).absolute()
    if pathlib.Path(sys.prefix) == folder:
        return
    python = str(folder / "bin/python3")
    if not pathlib.Path(python).exists():
        venv.create(folder, with_pip=True)
    for package in PACKAGES:
        made = subprocess.run([python, "-m", "pip", "install", "--quiet", package], capture_output=True, text=True)
        if made.returncode:
            print(f"{package} could not be installed, and is left out: {made.stderr.strip()}\n", flush=True)
    environment = {name: value for name, value in os.environ.items() if not name.startswith("OPENBLAS_")}
    os.execve(python, [python, *sys.argv], {**environment, **ONE_THREAD})


def has(package):
    return importlib.util.find_spec(package) is not None


class Wlsqm:
    """Least squares of order three, weights that decrease from the place: its better ones."""

    NEIGHBORS, ORDER, UNKNOWNS = 45, 3, 20

    def __init__(self, positions):
        from scipy.spatial import cKDTree
        self.positions, self.tree = positions, cKDTree(positions)

    def __call__(self, arrays, places, _):
        import wlsqm

        def each(number, kind=np.int32):
            return np.full(len(places), number, kind)

        near = self.tree.query(places, self.NEIGHBORS)[1]
        solver = wlsqm.ExpertSolver(3, each(self.NEIGHBORS), each(self.ORDER), each(0, np.int64),
                                    each(wlsqm.fitter.defs.WEIGHT_CENTER))
        solver.prepare(places, self.positions[near])
        fits = np.zeros((len(arrays), len(places), self.UNKNOWNS))
        for array, fit in zip(arrays, fits):
            solver.solve(array[near], fit)
        return fits[:, :, 0], fits[0, :, 1:4]


class Pycompadre:
    """Generalized moving least squares of order three, weights of power four: its better ones."""

    ORDER, POWER, REACH = 3, 4, 1.6
    kokkos = None

    def __init__(self, positions):
        import pycompadre
        Pycompadre.kokkos = Pycompadre.kokkos or pycompadre.KokkosParser([])
        self.positions = positions

    def __call__(self, arrays, places, _):
        from pycompadre import GMLS, ParticleHelper, TargetOperation
        fit = GMLS(self.ORDER, 3)
        fit.setWeightingParameter(self.POWER)
        fit.setWeightingType("power")
        helper = ParticleHelper(fit)
        helper.generateKDTree(self.positions)
        helper.generateNeighborListsFromKNNSearchAndSet(places, self.ORDER, 3, self.REACH)
        value = TargetOperation.ScalarPointEvaluation
        slopes = [getattr(TargetOperation, f"Partial{axis}OfScalarPointEvaluation") for axis in "XYZ"]
        for target in (value, *slopes):
            fit.addTargets(target)
        fit.generateAlphas(1)
        return (np.stack([np.ravel(helper.applyStencil(array, value)) for array in arrays]),
                np.stack([np.ravel(helper.applyStencil(arrays[0], slope)) for slope in slopes], axis=1))


class Radial:
    """SciPy's radial basis functions of the 50 nearest samples; gradients by differences."""

    kernel = "cubic"

    def __init__(self, positions):
        self.positions = positions

    def __call__(self, arrays, places, spacing):
        from scipy.interpolate import RBFInterpolator
        function = RBFInterpolator(self.positions, np.stack(arrays, axis=1), neighbors=50, kernel=self.kernel)
        if not spacing:
            return function(places).T, None
        steps = 0.02 * spacing * np.eye(3)
        slopes = [(function(places + step)[:, 0] - function(places - step)[:, 0]) / (2 * step.sum()) for step in steps]
        return function(places).T, np.stack(slopes, axis=1)


class ThinPlate(Radial):
    kernel = "thin_plate_spline"


class Linear:
    """SciPy's linear interpolation in Delaunay tetrahedra."""

    def __init__(self, positions):
        from scipy.spatial import Delaunay
        self.mesh = Delaunay(positions)

    def __call__(self, arrays, places, spacing):
        from scipy.interpolate import LinearNDInterpolator
        values = LinearNDInterpolator(self.mesh, np.stack(arrays, axis=1))(places).T
        if not spacing:
            return values, None
        cells = self.mesh.find_simplex(places)
        corners = arrays[0][self.mesh.simplices[cells]]
        slopes = np.einsum("nij,ni->nj", self.mesh.transform[cells, :3], corners[:, :3] - corners[:, 3:])
        return values, np.where(cells[:, None] < 0, np.nan, slopes)


class Gaussian:
    """VTK's Gaussian kernel. The radius is in mean spacings of the samples' box."""

    RADII = (0.75, 1, 1.25, 1.5, 2, 2.5, 3, 4)

    def __init__(self, positions, radius=1.25):
        from vtkmodules.util.numpy_support import numpy_to_vtk
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticPointLocator

        def cloud(numbers):
            points, data = vtkPoints(), vtkPolyData()
            points.SetData(numpy_to_vtk(np.ascontiguousarray(numbers), deep=1))
            data.SetPoints(points)
            return data

        self.cloud, self.radius = cloud, radius
        self.samples, self.locator = cloud(positions), vtkStaticPointLocator()
        self.locator.SetDataSet(self.samples)
        self.locator.BuildLocator()
        self.spacing = (np.ptp(positions, axis=0).prod() / len(positions)) ** (1 / 3)

    def __call__(self, arrays, places, _):
        from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
        from vtkmodules.vtkFiltersPoints import vtkGaussianKernel, vtkPointInterpolator
        kernel, interpolator = vtkGaussianKernel(), vtkPointInterpolator()
        kernel.SetKernelFootprintToRadius()
        kernel.SetRadius(self.radius * self.spacing)
        for number, array in enumerate(arrays):
            given = numpy_to_vtk(np.ascontiguousarray(array), deep=1)
            given.SetName(str(number))
            self.samples.GetPointData().AddArray(given)
        interpolator.SetInputData(self.cloud(places))
        interpolator.SetSourceData(self.samples)
        interpolator.SetKernel(kernel)
        interpolator.SetLocator(self.locator)
        interpolator.SetNullPointsStrategyToClosestPoint()
        interpolator.Update()
        found = interpolator.GetOutput().GetPointData()
        return np.stack([vtk_to_numpy(found.GetArray(str(i))) for i in range(len(arrays))]), None

    def tune(self, values, places, true):
        """Takes the radius whose mean error is least, which only those can do who know the truth."""
        errors = {}
        for self.radius in self.RADII:
            errors[self.radius] = np.abs(self([values], places, 0)[0][0] - true).mean()
        self.radius = min(errors, key=errors.get)


PEERS = {  # name: package, and class
    "wlsqm": ("wlsqm", Wlsqm),
    "pycompadre": ("pycompadre", Pycompadre),
    "SciPy RBF cubic": ("scipy", Radial),
    "SciPy RBF thin plate": ("scipy", ThinPlate),
    "SciPy linear": ("scipy", Linear),
    "VTK Gaussian": ("vtk", Gaussian)}
SLOW = ("pycompadre", "SciPy RBF cubic", "SciPy RBF thin plate")  # these get fewer places


def made(name, positions):
    """A peer; the text of its error if it raises."""
    try:
        return PEERS[name][1](positions)
    except Exception as error:
        return str(error)


def call(peer, *arguments):
    """What made() returned, called; instead of values the first words of the error if it raised or raises."""
    try:
        return (peer, None) if isinstance(peer, str) else peer(*arguments)
    except Exception as error:
        return str(error).partition("\n")[0][:60], None
