# SPDX-License-Identifier: GPL-3.0-or-later
"""Times a frame of splats and one of VTK's Point Gaussian mapper with plain disks, for the same
isopoints, in windows of the same size, in one run. The disks have a radius within which 12 other
isopoints are expected, which covers the surface.

    PYTHONPATH=... Utilities/offscreen.sh /usr/bin/python3 Benchmark/splats.py [--samples SAMPLES] [COUNT...]

Prints a Markdown table for about COUNT isopoints of a torus that fills most of a window of 600 x 600
pixels: milliseconds per frame (the median of nine, with a moving camera), splats per second, and the
memory of the triangles. SAMPLES is that of vtkRenderWindow::SetMultiSamples; drivers may give fewer.
"""

import common
import numpy as np
from scatteredisopoints import vtkIsopointSplatMapper
from scenes import RING, TUBE, Scene, configured
from vtkmodules.vtkRenderingCore import vtkActor, vtkPointGaussianMapper

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
    return common.output_of(common.POINTS(), common.cloud_of(positions, TUBE - tube), 0.0)


def seconds_per_frame(mapper, data, samples):
    actor = configured(vtkActor(), Mapper=common.configured(mapper, data, ScalarVisibility=False))
    scene = Scene(actor, samples=samples)
    scene.camera.Zoom(1.3)

    def draw():
        scene.window.Render()
        scene.window.WaitForCompletion()

    times = []
    for _ in range(11):
        scene.camera.Azimuth(0.1)
        times.append(common.timed(draw)[0])
    return np.median(times[2:]), scene.window.ReportCapabilities()


parser = common.parser_of(__doc__)
parser.add_argument("counts", metavar="COUNT", nargs="*", type=int, default=[20_000, 100_000, 500_000])
common.add_numbers(parser, samples=0)
options = parser.parse_args()
common.print_head(
    "isopoints", "Point Gaussian, ms", "splats, ms", "ratio", "million splats per second", "triangles, MB")
for count in options.counts:
    data = torus(count)
    number = data.GetNumberOfPoints()
    disks, splats = vtkPointGaussianMapper(), vtkIsopointSplatMapper()
    disks.SetScaleFactor(np.sqrt(12 * 4 * np.pi * RING * TUBE / number))
    disks.EmissiveOff()
    disks.SetSplatShaderCode(DISK)
    disks.SetTriangleScale(1.0)
    (stock, _), (ours, report) = (seconds_per_frame(mapper, data, options.samples) for mapper in (disks, splats))
    triangles = splats.GetInput()
    # On the card: a position and a normal for each vertex, three indices for each triangle.
    size = 24 * triangles.GetNumberOfPoints() + 12 * triangles.GetNumberOfPolys()
    common.print_row(f"{number:,}", f"{1e3 * stock:.0f}", f"{1e3 * ours:.0f}", f"{ours / stock:.2f}",
                     f"{number / ours / 1e6:.1f}", f"{size / 1e6:.0f}")
print(next(line for line in report.splitlines() if "renderer string" in line))
