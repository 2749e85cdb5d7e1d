# SPDX-License-Identifier: GPL-3.0-or-later
"""What averaging noisy samples over their neighbors does to a surface, beside fits alone.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 \\
        Benchmark/smoothing.py

Prints a Markdown table for a torus in random samples with noise. The unit of noise, radii and
distances is the mean spacing of the samples, which is the mean rise of the values between neighbors
as well. Radius 0 is without averaging. The table has the mean distance of isopoints from the torus
and the mean error of their normals in degrees, without a fit, with normals of planes, and with the
default fit.
"""

import warnings

import analytic_surfaces
import common
import fits
import numpy as np
from scatteredisopoints import contour
from vtkmodules.vtkFiltersPoints import vtkLinearKernel, vtkPointInterpolator


def averaged(samples, radius):
    if radius == 0:
        return samples
    kernel = vtkLinearKernel()
    kernel.SetRadius(radius)
    average = vtkPointInterpolator()
    average.SetSourceData(samples)
    result = common.output_of(average, samples, Kernel=kernel, PassPointArrays=False)
    result.GetPointData().SetActiveScalars("values")
    return result


parser = common.parser_of(__doc__)
common.add_numbers(parser, samples=60000)
count = parser.parse_args().samples
warnings.simplefilter("ignore")  # that no fit holds in noise
random = np.random.default_rng(1)
positions = analytic_surfaces.uniform(count, random)
spacing = 2 / count ** (1 / 3)
torus = analytic_surfaces.torus(spacing)
common.print_head("noise", "radius", "distance, linear interpolation", "normals", "distance, cubic fit", "normals")
for noise in 0.1, 0.3, 1.0:
    values = torus.value(positions) + noise * spacing * random.standard_normal(count)
    for radius in 0, 1.5, 2, 3:
        samples, cells = averaged(common.cloud_of(positions, values), radius * spacing), []
        for projection in "NO_PROJECTION", "CUBIC_FIT":
            surface = contour(samples, None, torus.isovalue, projection=projection)
            feet, normals = torus.feet(surface.points.astype(float))
            distance = np.linalg.norm(surface.points - feet, axis=1).mean() / spacing
            angle = fits.angles_between(surface.normals, normals).mean()
            cells += [f"{distance:.2f}", f"{angle:.1f}"]
        common.print_row(noise, radius, *cells)
