# SPDX-License-Identifier: GPL-3.0-or-later
"""Times a frame of splats and one of VTK's Point Gaussian mapper with plain disks, for the same points
and radii, in windows of the same size, in one run.

    PYTHONPATH=... Utilities/offscreen.sh /usr/bin/python3 Testing/Benchmark/splats.py [--samples SAMPLES] [COUNT...]

Prints a Markdown table for COUNT splats of a torus that fills most of a window of 600 x 600 pixels:
milliseconds per frame (the median of nine, with a moving camera) and splats per second. SAMPLES is that
of vtkRenderWindow::SetMultiSamples; drivers may give fewer.
"""

import argparse
import time

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, the factories
from scatteredisopoints import vtkIsopointSplatMapper
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
    """Random splats of constant density, with a radius within which 12 others are expected."""
    random = np.random.default_rng(1)
    u, v = random.uniform(0, 2 * np.pi, (2, 3 * count))
    kept = random.uniform(0, RING + TUBE, 3 * count) < RING + TUBE * np.cos(v)
    u, v = u[kept][:count], v[kept][:count]
    normals = np.column_stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)])
    positions = RING * np.column_stack([np.cos(u), np.sin(u), 0 * u]) + TUBE * normals
    radius = np.sqrt(12 * 4 * np.pi * RING * TUBE / count)
    data = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(positions.astype(np.float32), deep=True))
    data.SetPoints(points)
    data.GetPointData().SetNormals(numpy_to_vtk(normals.astype(np.float32), deep=True))
    radii = numpy_to_vtk(np.full(count, radius, np.float32), deep=True)
    radii.SetName("Radius")
    data.GetPointData().AddArray(radii)
    return data


def splats():
    return vtkIsopointSplatMapper()


def point_gaussian():
    mapper = vtkPointGaussianMapper()
    mapper.SetScaleArray("Radius")
    mapper.SetScaleFactor(1.0)
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
    print("| number | Point Gaussian, ms | splats, ms | ratio | million splats per second |")
    print("|---|---|---|---|---|")
    for count in counts:
        data = torus(count)
        stock, report = seconds_per_frame(point_gaussian(), data, samples)
        ours, report = seconds_per_frame(splats(), data, samples)
        print(
            f"| {count:,} | {1e3 * stock:.0f} | {1e3 * ours:.0f} | {ours / stock:.2f}"
            f" | {count / ours / 1e6:.1f} |"
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
