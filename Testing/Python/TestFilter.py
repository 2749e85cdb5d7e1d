# SPDX-License-Identifier: GPL-3.0-or-later
"""The filter in scripts that use VTK's Python interface."""

import unittest

import numpy as np
from scatteredisopoints import vtkScatteredIsopointFilter, vtkScatteredIsosurfaceFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData


def cloud(count, seed=1):
    positions = np.random.default_rng(seed).random((count, 3)) * 2.0 - 1.0
    points = vtkPoints()
    points.SetData(numpy_to_vtk(positions, deep=True))
    data = vtkPolyData()
    data.SetPoints(points)
    distance = numpy_to_vtk(np.linalg.norm(positions, axis=1), deep=True)
    distance.SetName("distance")
    data.GetPointData().SetScalars(distance)
    return data


def contoured():
    isopoints = vtkScatteredIsopointFilter()
    isopoints.SetInputData(cloud(30000))
    isopoints.SetValue(0, 0.7)
    isopoints.Update()
    return isopoints.GetOutput()


class FilterTest(unittest.TestCase):
    def test_points_and_normals_of_a_sphere(self):
        output = contoured()
        positions = vtk_to_numpy(output.GetPoints().GetData())
        radii = np.linalg.norm(positions, axis=1)
        self.assertGreater(len(positions), 1000)
        self.assertLess(np.abs(radii - 0.7).max(), 0.02)
        normals = vtk_to_numpy(output.GetPointData().GetNormals())
        outwards = -(normals * positions).sum(axis=1) / radii
        self.assertGreater(outwards.min(), 0.95)

    def test_the_splats_leave_no_hole(self):
        output = contoured()
        positions = vtk_to_numpy(output.GetPoints().GetData())
        reach = vtk_to_numpy(output.GetPointData().GetArray("Radius"))
        directions = np.random.default_rng(2).normal(size=(3000, 3))
        surface = 0.7 * directions / np.linalg.norm(directions, axis=1)[:, None]
        for chunk in np.array_split(surface, 30):
            distances = np.linalg.norm(chunk[:, None, :] - positions[None], axis=2)
            self.assertTrue((distances < reach).any(axis=1).all())

    def test_triangles_of_a_sphere(self):
        surface = vtkScatteredIsosurfaceFilter()
        surface.SetInputData(cloud(30000))
        surface.SetValue(0, 0.7)
        surface.Update()
        output = surface.GetOutput()
        positions = vtk_to_numpy(output.GetPoints().GetData())
        self.assertLess(np.abs(np.linalg.norm(positions, axis=1) - 0.7).max(), 0.005)
        triangles = vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        corners = positions[triangles].astype(float)
        volumes = np.linalg.det(corners) / 6.0  # normals point inwards
        self.assertAlmostEqual(-volumes.sum(), 4.0 / 3.0 * np.pi * 0.7**3, delta=0.01)
        edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        _, counts = np.unique(edges, axis=0, return_counts=True)
        self.assertTrue((counts == 2).all())
        self.assertEqual(len(positions) - len(counts) + len(triangles), 2)

    def test_defaults_and_properties(self):
        isopoints = vtkScatteredIsopointFilter()
        self.assertEqual(isopoints.GetAngle(), 54.7)
        self.assertEqual(isopoints.GetNumberOfNeighbors(), 12)
        self.assertEqual(isopoints.GetNumberOfContours(), 1)
        self.assertEqual(isopoints.GetValue(0), 0.0)
        for name in ("ComputeNormals", "ComputeSplats", "ComputeScalars", "KeepTree"):
            self.assertEqual(getattr(isopoints, "Get" + name)(), 1)
            getattr(isopoints, name + "Off")()
            self.assertEqual(getattr(isopoints, "Get" + name)(), 0)
        self.assertEqual(isopoints.GetMinimumSpacing(), 0.0)
        isopoints.SetMinimumSpacing(2.0)
        self.assertEqual(isopoints.GetMinimumSpacing(), 1.0)
        isopoints.SetMinimumSpacing(-1.0)
        self.assertEqual(isopoints.GetMinimumSpacing(), 0.0)
        isopoints.SetNumberOfNeighbors(1)
        self.assertEqual(isopoints.GetNumberOfNeighbors(), 3)
        isopoints.GenerateValues(3, 0.0, 1.0)
        self.assertEqual([isopoints.GetValue(i) for i in range(3)], [0.0, 0.5, 1.0])

    def test_projection(self):
        deviation = {}
        for projection in (0, 1, 2, 3):
            isopoints = vtkScatteredIsopointFilter()
            isopoints.SetInputData(cloud(30000))
            isopoints.SetValue(0, 0.7)
            isopoints.SetProjection(projection)
            isopoints.ComputeProjectionOrdersOn()
            isopoints.Update()
            data = isopoints.GetOutput()
            positions = vtk_to_numpy(data.GetPoints().GetData())
            deviation[projection] = np.abs(np.linalg.norm(positions, axis=1) - 0.7).mean()
            orders = vtk_to_numpy(data.GetPointData().GetArray("ProjectionOrder"))
            self.assertEqual((orders == 0).sum(), isopoints.GetNumberOfUnprojectedPoints())
        self.assertLess(deviation[2], 0.1 * deviation[0])
        self.assertLess(deviation[3], 0.5 * deviation[2])
        self.assertEqual(vtkScatteredIsopointFilter().GetProjection(), 3)

    def test_thinned_points_are_a_subset(self):
        isopoints = vtkScatteredIsopointFilter()
        isopoints.SetInputData(cloud(30000))
        isopoints.SetValue(0, 0.7)
        isopoints.SetMinimumSpacing(0.5)
        isopoints.Update()
        few = {tuple(p) for p in vtk_to_numpy(isopoints.GetOutput().GetPoints().GetData())}
        every = {tuple(p) for p in vtk_to_numpy(contoured().GetPoints().GetData())}
        self.assertTrue(few <= every)
        self.assertGreater(len(few), 0.3 * len(every))
        self.assertLess(len(few), 0.6 * len(every))

    def test_without_isovalues_the_output_is_empty(self):
        isopoints = vtkScatteredIsopointFilter()
        isopoints.SetNumberOfContours(0)
        isopoints.SetInputData(cloud(100))
        isopoints.Update()
        self.assertEqual(isopoints.GetOutput().GetNumberOfPoints(), 0)

    def test_prints(self):
        self.assertIn("Angle: 54.7", str(vtkScatteredIsopointFilter()))


if __name__ == "__main__":
    unittest.main(verbosity=2)
