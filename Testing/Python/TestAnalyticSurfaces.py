# SPDX-License-Identifier: GPL-3.0-or-later
"""The surfaces that Benchmark measures against: feet lie on the surface, no other
point of it is nearer, and normals point towards decreasing values."""

import os
import sys
import unittest

import numpy as np

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
sys.path.insert(0, os.path.join(ROOT, "Benchmark"))
import analytic_surfaces as surfaces  # noqa: E402

SPACING = 0.05
FIELDS = (surfaces.sphere, surfaces.torus, surfaces.gyroid, surfaces.gaussian_mixture,
          surfaces.marschner_lobb, surfaces.cube, surfaces.two_sheets, surfaces.two_balls, surfaces.step,
          surfaces.smooth_step, surfaces.plane_step)
SAMPLINGS = (surfaces.uniform, surfaces.clustered, surfaces.lattice, surfaces.jittered,
             surfaces.slices(4), surfaces.lines)


def positions_beside(surface, count, random):
    """Random positions within two spacings of feet of random positions."""
    feet, _ = surface.feet(surfaces.uniform(count, random))
    return feet + 2 / np.sqrt(3) * SPACING * surfaces.uniform(len(feet), random)


class AnalyticSurfaces(unittest.TestCase):
    def test_feet_are_the_nearest_points_and_have_normals(self):
        for field in FIELDS:
            random = np.random.default_rng(1)
            surface = field(SPACING)
            positions = positions_beside(surface, 2000, random)
            feet, normals = surface.feet(positions)
            with self.subTest(field.__name__):
                lengths = surfaces.length(normals)
                self.assertTrue(((np.abs(lengths - 1) < 1e-12) | (lengths == 0)).all())
                self.assertTrue((lengths.max(axis=1) > 0).all())
                inwards = 1e-6 * surfaces.unit(normals.sum(axis=1))
                self.assertTrue((surface.value(feet + inwards) < surface.isovalue).all())
                self.assertTrue((surface.value(feet - inwards) > surface.isovalue).all())
                # No other point is nearer, neither of the surface at large, nor around each foot.
                distances = surfaces.length(positions - feet)
                others, _ = surface.feet(positions_beside(surface, 4000, random))
                for position, distance in zip(positions[:500], distances):
                    self.assertGreater(surfaces.length(others - position).min(), distance - 1e-9)
                for size in (0.001, 0.003, 0.01, 0.03):
                    others, _ = surface.feet(feet + size * surfaces.uniform(len(feet), random))
                    self.assertTrue((surfaces.length(others - positions) > distances - 1e-9).all())

    def test_samplings_fill_the_cube_and_nothing_else(self):
        for sampling in SAMPLINGS:
            with self.subTest(sampling.__qualname__):
                positions = sampling(8000, np.random.default_rng(1))
                self.assertGreater(len(positions), 7500)
                self.assertLessEqual(len(positions), 8000)
                self.assertLessEqual(np.abs(positions).max(), 1)
                # No eighth of the cube is empty, nor the outer tenth beside a face.
                for side in (-1, 1):
                    self.assertTrue(((side * positions > 0.8).sum(axis=0) > 0).all())
                octants = (positions > 0) @ [1, 2, 4]
                self.assertEqual(len(np.unique(octants)), 8)


if __name__ == "__main__":
    unittest.main()
