# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of docs/choosing.md: troubleshooting_pictures.py PLUGIN FOLDER, for pvbatch.

Each picture has the trouble on the left and what remedies it on the right. All samples are made
here. PLUGIN is ScatteredIsopoints.so, FOLDER receives the PNG files.
"""

import os
import sys
import tempfile

import common
import numpy as np
import triangle_pictures as pictures
from paraview import simple
from scripting import contoured, make_view, produced, read_image, shown
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet

SIZE = [200, 200]
GRAY = [0.5, 0.5, 0.6]
BOUNDS = (-0.9, 0.9) * 3
CAMERA = (-0.52, -0.42, -0.74), (0.0, 1.0, 0.0), 1.35  # direction, view up, zoom
FROM_BELOW = (0.0, 0.7, -0.7), (0.0, 1.0, 0.0), 1.35


def points(samples, isovalue=0.0, **options):
    return contoured(samples, "values", isovalue, **options)


def triangles(samples, isovalue=0.0, **options):
    return contoured(samples, "values", isovalue, kind="ScatteredIsosurface", **options)


def scaled(data, *factors):
    transform = simple.Transform(Input=data)
    transform.Transform.Scale = list(factors)
    return transform


def uniform(count, seed=1):
    return np.random.default_rng(seed).uniform(-1, 1, (count, 3))


def torus(positions):
    """The distance from a torus, negative inside."""
    return np.hypot(np.hypot(positions[:, 0], positions[:, 1]) - 0.6, positions[:, 2]) - 0.25


def torus_samples(**arrays):
    positions = uniform(60000)
    data = common.cloud_of(positions, torus(positions))
    for name, array in arrays.items():
        data.GetPointData().AddArray(common.named(name, array))
    return produced(data)


class Album:
    def __init__(self, folder, scratch):
        self.folder, self.part = folder, os.path.join(scratch, "part.png")

    def add(self, name, before, after, samples=None, camera=CAMERA, draw=None):
        """A picture of two surfaces, and of samples. draw(view, path, surface) draws instead of
        ParaView."""
        halves = []
        for surface in before, after:
            surface.UpdatePipeline()
            information = surface.GetDataInformation()
            is_mesh = information.GetNumberOfCells() != information.GetNumberOfPoints()
            representation = "Surface" if is_mesh else "Isopoint Splats"
            view = make_view(*SIZE, pictures.WHITE)
            shown(surface, view, pictures.COLOR, Representation=representation)
            if samples:
                shown(samples, view, GRAY, Representation="Point Gaussian", GaussianRadius=0.012)
            simple.ResetCamera(view)
            pictures.place(view.GetActiveCamera(), BOUNDS, *camera)
            if draw:
                draw(view, self.part, surface)
            else:
                simple.SaveScreenshot(self.part, view, ImageResolution=SIZE)
            simple.Delete(view)
            halves.append(read_image(self.part).astype(np.uint8))
        pictures.write(np.concatenate(halves, axis=1), os.path.join(self.folder, name + ".png"))


def add_gaps(album):
    # Two groups of samples, and the isovalue between them.
    groups = np.concatenate([0.4 * uniform(1500) + [side, 0, 0] for side in (-0.55, 0.55)])
    samples = produced(common.cloud_of(groups, groups[:, 0]))
    album.add("empty", triangles(samples), triangles(samples, DropGaps=0), samples)

    # A bent slab: the space inside the bend has no samples.
    slab = uniform(100000)
    radius = np.hypot(slab[:, 0], slab[:, 1])
    is_bend = (radius > 0.5) & (radius < 0.95) & ~((slab[:, 0] > 0) & (np.abs(slab[:, 1]) < 0.3))
    slab = slab[is_bend & (np.abs(slab[:, 2]) < 0.3)]
    samples = produced(common.cloud_of(slab, slab[:, 2] + 0.1 * np.sin(6 * slab[:, 0])))
    album.add("filled", triangles(samples, DropGaps=0), triangles(samples), camera=FROM_BELOW)

    # Stations, each with some samples close to each other.
    nodes = np.linspace(-1, 1, 9)
    stations = np.stack(np.meshgrid(nodes, nodes, nodes), -1).reshape(-1, 1, 3)
    stations = stations + 0.06 * uniform(15 * len(stations)).reshape(-1, 15, 3)
    stations = stations.reshape(-1, 3)
    samples = produced(common.cloud_of(stations, np.linalg.norm(stations, axis=1)))
    album.add("early", triangles(samples, 0.8), triangles(samples, 0.8, DropGaps=0))


def add_seams(album):
    positions = uniform(60000)
    blocks = vtkMultiBlockDataSet()
    for i, is_here in enumerate((positions[:, 0] < 0.1, positions[:, 0] >= 0.1)):
        blocks.SetBlock(i, common.cloud_of(positions[is_here], torus(positions[is_here])))
    samples = produced(blocks)
    album.add("seams", points(samples, ContourBlocks=1), points(samples))


def add_holes(album):
    # The particles of a liquid alone, with the number of others in reach: a density that drops at
    # the surface.
    positions = uniform(100000)
    positions = positions[torus(positions) < 0]
    reach = 0.14
    near = np.array([(((positions - place) ** 2).sum(axis=1) < reach**2).sum() for place in positions])
    samples = produced(common.cloud_of(positions, near.astype(float)))
    isovalue = 0.5 * near.max()
    album.add("holes", points(samples, isovalue), triangles(samples, isovalue))

    samples = torus_samples()
    album.add("mirrored", scaled(points(samples), -1, 1, 1), points(scaled(samples, -1, 1, 1)))


def add_large(album):
    samples = torus_samples(Radius=np.full(60000, 0.12))
    album.add("large", points(samples, ComputeSplats=0), points(samples))


def add_black(album):
    samples = torus_samples()
    album.add("black", scaled(triangles(samples), -1, 1, 1), triangles(scaled(samples, -1, 1, 1)))


def add_noise(album):
    positions = uniform(60000)
    spacing = 2 / len(positions) ** (1 / 3)
    noise = spacing * np.random.default_rng(2).standard_normal(len(positions))
    samples = produced(common.cloud_of(positions, torus(positions) + noise))
    smooth = simple.PointDatasetInterpolator(Input=samples, Source=samples)
    smooth.Kernel = "LinearKernel"
    smooth.Kernel.Radius = 2 * spacing
    album.add("noise", points(samples), points(smooth))


def main(plugin, folder):
    simple.LoadPlugin(plugin)
    os.makedirs(folder, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        album = Album(folder, scratch)
        for add in add_gaps, add_seams, add_holes, add_large, add_black, add_noise:
            add(album)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
