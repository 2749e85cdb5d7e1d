# SPDX-License-Identifier: GPL-3.0-or-later
"""What averaging noisy samples over their neighbors does to a surface, beside fits alone.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 \\
        Testing/Benchmark/smoothing.py

Prints a Markdown table for a torus in random samples with noise. The unit of noise, radii and
distances is the mean spacing of the samples, which is the mean rise of the values between neighbors
as well. Radius 0 is without averaging. The table has the mean distance of isopoints from the torus
and the mean error of their normals in degrees, without a fit, with normals of planes, and with the
default fit.
"""

import argparse
import warnings

import analytic_surfaces
import fits
import numpy as np
import volumes
from scatteredisopoints import contour
from vtkmodules.vtkFiltersPoints import vtkLinearKernel, vtkPointInterpolator


def averaged(samples, radius):
    if radius == 0:
        return samples
    kernel = vtkLinearKernel()
    kernel.SetRadius(radius)
    average = vtkPointInterpolator()
    average.SetInputData(samples)
    average.SetSourceData(samples)
    average.SetKernel(kernel)
    average.PassPointArraysOff()
    average.Update()
    average.GetOutput().GetPointData().SetActiveScalars("values")
    return average.GetOutput()


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--samples", type=int, default=60000, help="default: 60000")
    options = parser.parse_args()
    warnings.simplefilter("ignore")  # that no fit holds in noise
    random = np.random.default_rng(1)
    positions = analytic_surfaces.uniform(options.samples, random)
    spacing = 2 / options.samples ** (1 / 3)
    torus = analytic_surfaces.torus(spacing)
    print("| noise | radius | distance, linear interpolation | normals | distance, cubic fit |"
          " normals |\n" + "|---" * 6 + "|")
    for noise in 0.1, 0.3, 1.0:
        values = torus.value(positions) + noise * spacing * random.standard_normal(len(positions))
        for radius in 0, 1.5, 2, 3:
            samples = averaged(volumes.cloud(positions, values), radius * spacing)
            cells = []
            for projection in "NO_PROJECTION", "CUBIC_FIT":
                surface = contour(samples, None, torus.isovalue, projection=projection)
                feet, normals = torus.feet(surface.points.astype(float))
                distance = np.linalg.norm(surface.points - feet, axis=1).mean() / spacing
                angle = fits.angles_between(surface.normals, normals).mean()
                cells.append(f"{distance:.2f} | {angle:.1f}")
            print(f"| {noise} | {radius} | {' | '.join(cells)} |")


if __name__ == "__main__":
    main()
