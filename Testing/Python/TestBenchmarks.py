# SPDX-License-Identifier: GPL-3.0-or-later
"""The benchmarks that need neither files nor a window run to their end with few samples. This test does not
look at what they measure."""

import pathlib
import subprocess
import sys
import unittest

from vtkmodules.vtkCommonDataModel import vtkPolyData

FOLDER = pathlib.Path(__file__).parents[2] / "Benchmark"
COMMANDS = (
    "accuracy.py --samples 2000 --fields sphere cube --noise 1", "cost.py --samples 0.02 --runs 1",
    "defaults.py --samples 0.02 --runs 1", "triangle_quality.py --samples 0.02", "smoothing.py --samples 2000",
    "ghosts.py --side 12", "cancellation.py --nodes 12", "progress.py --samples 20000", "speed.py --largest 0.01")


class Benchmarks(unittest.TestCase):
    def test_all_rows_of_a_table_are_as_long_as_its_head(self):
        for command in COMMANDS:
            with self.subTest(command):
                script, *arguments = command.split()
                done = subprocess.run([sys.executable, FOLDER / script, *arguments], stdout=subprocess.PIPE,
                                      text=True, check=True)
                rows = [line.count("|") for line in done.stdout.splitlines() if line.startswith("|")]
                self.assertGreater(len(rows), 2, done.stdout)
                self.assertEqual(set(rows), {rows[0]}, done.stdout)

    def test_misspelled_properties_raise(self):
        sys.path.insert(0, str(FOLDER))
        import common

        for kind in (common.POINTS, common.TRIANGLES):
            common.configured(kind(), vtkPolyData(), 0.5, **common.alone(), Regularize=False)
            with self.assertRaises(AttributeError):
                common.configured(kind(), vtkPolyData(), 0.5, UseAlCores=False)


if __name__ == "__main__":
    unittest.main()
