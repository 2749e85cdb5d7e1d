# SPDX-License-Identifier: GPL-3.0-or-later
"""Times clouds that are hard on a kd-tree, each beside a uniform one of the same size.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 Benchmark/adversaries.py [SAMPLES]

Contours with the default options and prints a Markdown table of times relative to that of the
uniform cloud. Exits with 1 if any of them is above 5; two skew lines, whose splats are slow, above 100.
"""

import sys

import common
import numpy as np

ISOVALUE = 0.4
MOST = 5.0
MOST_OF = {"two skew lines": 100.0}


def distance(positions):
    return np.linalg.norm(positions - np.float32(0.5), axis=1)


def uniform(count):
    return np.random.default_rng(1).random((count, 3), dtype=np.float32)


def ordered(positions, axes):
    """Sorted by the first of some axes, then by the next ones."""
    return positions[np.lexsort(positions.T[list(reversed(axes))])]


def organ_pipe(count):
    """Ascending coordinates and then descending ones."""
    positions = ordered(uniform(count), [0, 1, 2])
    return np.concatenate([positions[::2], positions[1::2][::-1]])


def lattice(count):
    nodes = np.linspace(0, 1, round(count ** (1 / 3)), dtype=np.float32)
    return np.stack(np.meshgrid(nodes, nodes, nodes, indexing="ij"), axis=-1).reshape(-1, 3)[:, ::-1]


def flattened(count, dimensions):
    positions = uniform(count)
    positions[:, dimensions:] = 0.5
    return positions


def coincident(count, percent):
    """Some of the samples at one position; their values stay those of their former positions."""
    positions = uniform(count)
    values = distance(positions)
    positions[np.arange(count) % 100 < percent] = 0.9, 0.5, 0.5
    return positions, values


def layer_before_one(count, step=None):
    """A layer of samples, a single one in front of its middle, and as many again far behind that one.
    The cell of the single one touches the cells of all in the layer.

    step: each such one of all samples, by its number, goes to the position of the single one"""
    positions = uniform(count)
    depth = 1 / np.sqrt(count)
    positions[:, 0] = np.where(np.arange(count) % 2, -depth * (1 + positions[:, 0]), 4 + positions[:, 0])
    values = np.where(positions[:, 0] < 0, 0, 0.8)
    positions[: None if step else 1 : step] = depth, 0.5, 0.5
    return positions, values


def double_layer_before_few(count, few=1000):
    """Two layers of samples close to each other, and a few in front of their middle: long edges with most
    samples beside their ends, none of them behind."""
    positions = uniform(count)
    depth = 1 / np.sqrt(count)
    positions[:, 0] = np.where(np.arange(count) % 2, 0, -depth)
    positions[:few] = 0.5 + depth * uniform(few)
    return positions, np.where(np.arange(count) < few, 0, 0.8)


def skew_lines(count):
    """Two at right angles, the Delaunay tetrahedralization of which has quadratic size."""
    positions = uniform(count)
    positions[::2, :2] = 0.75, 0.5
    positions[1::2, ::2] = 0.25, 0.5
    return positions


def clustered(count):
    scale = 10.0 ** (-6 * np.random.default_rng(2).random((count, 1)))
    return np.array([0.9, 0.5, 0.5]) + scale * (uniform(count) - 0.5)


def on_sphere(count):
    """All but one sample in the middle."""
    positions = uniform(count) - np.float32(0.5)
    positions = 0.5 + positions / np.linalg.norm(positions, axis=1)[:, None]
    positions[0] = 0.5
    return positions, np.arange(count) > 0


def scaled(count, scale):
    positions = uniform(count)
    return np.float32(scale) * positions, distance(positions)


def with_values(count, value_of):
    positions = uniform(count)
    return positions, value_of(distance(positions))


# The name of each cloud, and its positions; or these and values other than the distance to the center.
CLOUDS = {
    "sorted": lambda n: ordered(uniform(n), [0, 1, 2]),
    "sorted backwards along z": lambda n: ordered(uniform(n), [2, 1, 0])[::-1],
    "organ pipe": organ_pipe,
    "lattice": lattice,
    "coplanar": lambda n: flattened(n, 2),
    "collinear": lambda n: flattened(n, 1),
    "all at one position": lambda n: coincident(n, 100),
    "90 % at one position": lambda n: coincident(n, 90),
    "each position twice": lambda n: np.repeat(uniform(n // 2), 2, axis=0),
    "a cell that touches half of all": layer_before_one,
    "coincident samples whose cell touches half of all": lambda n: layer_before_one(n, 4),
    "a double layer before a thousand": double_layer_before_few,
    "two skew lines": skew_lines,
    "strongly clustered": clustered,
    "on a sphere, one inside": on_sphere,
    "denormal": lambda n: scaled(n, 1e-40),
    "scaled by 1e30": lambda n: scaled(n, 1e30),
    "constant field": lambda n: with_values(n, lambda values: np.full_like(values, ISOVALUE)),
    "a step at the isovalue": lambda n: with_values(
        n, lambda values: np.where(values < ISOVALUE, 0, ISOVALUE)),
}


def measure(cloud):
    """The faster of two updates of new filters, and the number of isopoints."""
    positions, values = cloud if isinstance(cloud, tuple) else (cloud, distance(cloud))
    data = common.cloud_of(positions.astype(np.float32), values.astype(np.float32))
    seconds = []
    for _ in range(2):
        isopoints = common.configured(common.POINTS(), data, ISOVALUE)
        seconds.append(common.timed(isopoints.Update)[0])
    return min(seconds), isopoints.GetOutput().GetNumberOfPoints()


def main(count):
    seconds, number = measure(uniform(count))
    common.print_head(f"{count} samples", "time relative to uniform", "isopoints")
    common.print_row("uniform", f"1 ({seconds:.3f} s)", number)
    are_bounded = True
    for name, cloud_of in CLOUDS.items():
        seconds, number = measure(cloud_of(count))
        # Again, since the machine's load may change.
        ratio = seconds / measure(uniform(count))[0]
        are_bounded &= ratio <= MOST_OF.get(name, MOST)
        common.print_row(name, f"{ratio:.2f}", number)
    return are_bounded


if __name__ == "__main__":
    if len(sys.argv) > 2 or not all(text.isdigit() for text in sys.argv[1:]):
        sys.exit(__doc__)
    sys.exit(0 if main(int(sys.argv[1]) if len(sys.argv) > 1 else 1000000) else 1)
