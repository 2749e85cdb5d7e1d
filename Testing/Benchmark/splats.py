# SPDX-License-Identifier: GPL-3.0-or-later
"""Times a frame of splats and one of VTK's Point Gaussian mapper with plain disks, for the same
isopoints, in windows of the same size, in one run. The disks have a radius within which 12 other
isopoints are expected, which covers the surface.

    PYTHONPATH=... Utilities/offscreen.sh /usr/bin/python3 Testing/Benchmark/splats.py [--samples SAMPLES] [COUNT...]

Prints a Markdown table for about COUNT isopoints of a torus that fills most of a window of 600 x 600
pixels: milliseconds per frame (the median of nine, with a moving camera), splats per second, and the
memory of the triangles. SAMPLES is that of vtkRenderWindow::SetMultiSamples; drivers may give fewer.
"""

import argparse
import time

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, the factories
from scatteredisopoints import vtkIsopointSplatMapper, vtkScatteredIsopointFilter
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPointGaussianMapper,
    vtkRenderer,
    vtkRenderWindow,
)

RING, TUBE = 1.0, 0.4
DISK = """//VTK::Color::Impl
if (dot(offsetVCVSOutput.xy, offsetVCVSOutput.xy) > 1.0)
{
  discard;
}
"""


def torus(count):
    """About so many isopoints of random samples near the torus."""
    random = np.random.default_rng(1)
    area = 4 * np.pi**2 * RING * TUBE
    spacing = np.sqrt(1.5 * area / count)  # found by trial
    reach = min(4 * spacing, 0.9 * TUBE)
    number = int(area * 2 * reach / spacing**3)
    u, v = random.uniform(0, 2 * np.pi, (2, 2 * number))
    tube = np.sqrt(random.uniform((TUBE - reach) ** 2, (TUBE + reach) ** 2, 2 * number))
    kept = random.uniform(0, RING + TUBE + reach, 2 * number) < RING + tube * np.cos(v)
    u, v, tube = u[kept][:number], v[kept][:number], tube[kept][:number]
    ring = RING + tube * np.cos(v)
    positions = np.column_stack([ring * np.cos(u), ring * np.sin(u), tube * np.sin(v)])
    samples = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(positions, deep=True))
    samples.SetPoints(points)
    samples.GetPointData().SetScalars(numpy_to_vtk(TUBE - tube, deep=True))
    contour = vtkScatteredIsopointFilter()
    contour.SetInputData(samples)
    contour.SetValue(0, 0.0)
    contour.Update()
    return contour.GetOutput()


def splats():
    return vtkIsopointSplatMapper()


def point_gaussian(count):
    mapper = vtkPointGaussianMapper()
    mapper.SetScaleFactor(np.sqrt(12 * 4 * np.pi * RING * TUBE / count))
    mapper.EmissiveOff()
    mapper.SetSplatShaderCode(DISK)
    mapper.SetTriangleScale(1.0)
    return mapper


def seconds_per_frame(mapper, data, samples):
    mapper.SetInputDataObject(data)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(samples)
    window.SetSize(600, 600)
    renderer = vtkRenderer()
    window.AddRenderer(renderer)
    renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0, -3, 3)
    camera.SetFocalPoint(0, 0, 0)
    renderer.ResetCamera()
    camera.Zoom(1.3)
    times = []
    for _ in range(11):
        camera.Azimuth(0.1)
        start = time.perf_counter()
        window.Render()
        window.WaitForCompletion()
        times.append(time.perf_counter() - start)
    return np.median(times[2:]), window.ReportCapabilities()


def main(counts, samples):
    report = None
    print("| isopoints | Point Gaussian, ms | splats, ms | ratio | million splats per second | triangles, MB |")
    print("|---|---|---|---|---|---|")
    for count in counts:
        data = torus(count)
        stock, report = seconds_per_frame(
            point_gaussian(data.GetNumberOfPoints()), data, samples
        )
        mapper = splats()
        ours, report = seconds_per_frame(mapper, data, samples)
        triangles = mapper.GetInput()
        # On the card: a position and a normal for each vertex, three indices for each triangle.
        size = 24 * triangles.GetNumberOfPoints() + 12 * triangles.GetNumberOfPolys()
        number = data.GetNumberOfPoints()
        print(
            f"| {number:,} | {1e3 * stock:.0f} | {1e3 * ours:.0f} | {ours / stock:.2f}"
            f" | {number / ours / 1e6:.1f} | {size / 1e6:.0f} |"
        )
    print(next(line for line in report.splitlines() if "renderer string" in line))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "counts",
        metavar="COUNT",
        nargs="*",
        type=int,
        default=[20_000, 100_000, 500_000],
        help="number of splats; default: 20000 100000 500000",
    )
    parser.add_argument(
        "--samples", type=int, default=0, help="samples of multisampling; default: 0, none"
    )
    arguments = parser.parse_args()
    main(arguments.counts, arguments.samples)
