# SPDX-License-Identifier: GPL-3.0-or-later
"""The benchmarks that need neither files nor a window run to their end, with few samples. What they
measure is not looked at."""

import os
import subprocess
import sys
import unittest

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Benchmark")


class Benchmarks(unittest.TestCase):
    def check(self, script, *arguments):
        """That all rows of its table are as long as its head."""
        done = subprocess.run([sys.executable, os.path.join(FOLDER, script), *arguments],
                              stdout=subprocess.PIPE, universal_newlines=True, check=True)
        rows = [line.count("|") for line in done.stdout.splitlines() if line.startswith("|")]
        self.assertGreater(len(rows), 2, done.stdout)
        self.assertEqual(set(rows), {rows[0]}, done.stdout)

    def test_accuracy(self):
        self.check("accuracy.py", "--samples", "2000", "--fields", "sphere,cube", "--noise", "1")

    def test_cost(self):
        self.check("cost.py", "--samples", "0.02", "--runs", "1")

    def test_defaults(self):
        self.check("defaults.py", "--samples", "0.02", "--runs", "1")

    def test_triangle_quality(self):
        self.check("triangle_quality.py", "--samples", "0.02")

    def test_smoothing(self):
        self.check("smoothing.py", "--samples", "2000")

    def test_ghosts(self):
        self.check("ghosts.py", "--side", "12")

    def test_speed(self):
        self.check("speed.py", "--largest", "0.01")


if __name__ == "__main__":
    unittest.main()
