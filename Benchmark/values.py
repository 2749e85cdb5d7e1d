# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares values and gradients at places with those of other packages.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 Benchmark/values.py [TASK...]
        [--file FILE ARRAY]... [--peers NAME...] [--environment FOLDER]

Installs the other packages from PyPI into a virtual environment, build/peers, and prints Markdown
tables. The field is sin 3x cos 2y + z^2 in the cube [-1, 1]^3, if not said otherwise. Tasks, by default all:

accuracy    errors of values and gradients, random samples
hard        errors for a lattice, graded density, duplicates and layers
flat        a plane, a line, one sample and two: errors of what they determine, and overshoot
exact       errors of constant and affine fields
held-out    5 % of the samples of files, from the others: RMS error over standard deviation
continuity  the largest differences between places 1/100 and 1/1000 of a spacing apart
outside     shares of places that count as outside, by their depth inside a body in spacings
same        whether threads and orders give the same bytes
price       processor time in one thread: of each place, of five arrays, of gradients, of few places
            among many samples

Processor times are medians; each is taken in turn with those of the others.
"""

import pathlib
import time
import warnings

import numpy as np
import peers
from analytic_surfaces import lattice, uniform
from scatteredisopoints import Samples
from tables import add_numbers, parser_of, print_head, print_row

METHODS = ("BLEND", "CUBIC", "QUADRATIC", "AFFINE")  # BLEND is the default
MOST = 20000  # places for slow peers, and to time
MOST_VOXELS = 96  # of each axis of a volume: those in the middle


class Ours:
    """Samples and a method, called as a peer."""

    def __init__(self, positions, method="BLEND", threads=1, outside=None):
        self.samples, self.options = Samples(positions, threads=threads), dict(method=method, outside=outside)

    def __call__(self, arrays, places, spacing=0):
        named = {str(number): array for number, array in enumerate(arrays)}
        found = self.samples.probe(places, arrays=named, gradient=bool(spacing), **self.options)
        values, gradients = found if spacing else (found, {"0": None})
        return np.stack(list(values.values())), gradients["0"]


# ---- Fields and samples

def smooth(p):
    """@returns values and gradients"""
    x, y, z = p.T
    return (np.sin(3 * x) * np.cos(2 * y) + z * z,
            np.stack([3 * np.cos(3 * x) * np.cos(2 * y), -2 * np.sin(3 * x) * np.sin(2 * y), 2 * z], axis=1))


def sphere(p):
    return np.linalg.norm(p, axis=1) - 0.6


def step(p):
    return 0.2 * smooth(p)[0] + (p[:, 0] + 0.3 * p[:, 1] > 0.1)


def noisy(p):
    return smooth(p)[0] + 0.1 * np.random.default_rng(3).normal(size=len(p))


def clustered(count, random):
    """Seven tenths in twenty clusters."""
    centers = 0.8 * uniform(20, random)[random.integers(0, 20, 3 * count)]
    near = centers + 0.08 * random.normal(size=centers.shape)
    near = near[(np.abs(near) <= 1).all(axis=1)]
    return np.concatenate([uniform(3 * count // 10, random), near])[:count]


def graded(count, random):
    return uniform(count, random) ** (3, 1, 1)


def graded_everywhere(count, random):
    return uniform(count, random) ** 3


def duplicates(count, random):
    once = uniform(9 * count // 10, random)
    return np.concatenate([once, once[:count // 10]])


def layers(count, random):
    positions = uniform(count, random)
    positions[:, 2] = np.linspace(-1, 1, 20)[random.integers(0, 20, count)]
    return positions


def spacing_of(positions):
    return 2 / len(positions) ** (1 / 3)


# ---- Errors

def quantiles(errors):
    """Median, 99th percentile and maximum; without those of places without a value."""
    errors = errors[np.isfinite(errors)]
    return [f"{number:.2g}" for number in np.quantile(errors, (0.5, 0.99, 1))] if len(errors) else 3 * ["-"]


def all_of(positions, names, *known):
    """Yields the name of each method and peer, and its interpolator. Peers may be tuned to known results."""
    yield from ((method, Ours(positions, method)) for method in METHODS)
    for name in names:
        peer = peers.made(name, positions)
        if hasattr(peer, "tune"):
            peer.tune(*known)
        yield name, peer


def add_errors(set_name, positions, places, options):
    values, (true, true_gradients) = smooth(positions)[0], smooth(places)
    for name, peer in all_of(positions, options.peers, values, places, true):
        some = slice(MOST if name in peers.SLOW else None)
        found, gradients = peers.call(peer, [values], places[some], spacing_of(positions))
        if isinstance(found, str):
            print_row(set_name, name, "raises: " + found, *6 * [""])
            continue
        errors = np.abs(found[0] - true[some])
        off = [] if gradients is None else np.linalg.norm(gradients - true_gradients[some], axis=1)
        print_row(set_name, name, *quantiles(errors), *quantiles(np.asarray(off)),
                  f"{100 * np.isnan(found[0]).mean():.2g} %")


def head_of_errors():
    print_head("samples", "method", "median error", "99 %", "largest", "of gradients", "99 %", "largest", "no value")


def accuracy(options):
    head_of_errors()
    random = np.random.default_rng(1)
    count = int(1e5)
    add_errors(f"{count:,} random", uniform(count, random), 0.9 * uniform(count, random), options)


def hard(options):
    head_of_errors()
    for kind in (lattice, graded, graded_everywhere, duplicates, layers):
        random = np.random.default_rng(1)
        positions = kind(22000 if kind is lattice else 20000, random)
        add_errors(f"{len(positions):,}, {kind.__name__.replace('_', ' ')}", positions, 0.85 * uniform(20000, random),
                   options)


def flat(_):
    """Samples of an affine field, which they determine within their plane or line."""
    print_head("samples", "method", "error in their plane or line", "of the gradient's part in it",
               "beyond the range of the samples", "with values anywhere")
    random = np.random.default_rng(1)
    slope = np.array([0.5, -1.0, 2.0])
    turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
    for name, count, directions in ("plane", 2000, 2), ("line", 200, 1), ("two", 2, 1), ("one", 1, 0):
        basis = turn[:, :directions]
        positions = random.uniform(-1, 1, (count, directions)) @ basis.T + 0.1
        inside = random.dirichlet(np.ones(count), 500) @ positions
        values, around = positions @ slope, np.concatenate([inside, 2.0 * uniform(2000, random)])
        for method in METHODS:
            found, gradients = Ours(positions, method)([values], inside, 1)
            both = [Ours(positions, method, outside=where)([values], around)[0] for where in (np.nan, None)]
            beyond = [np.nanmax(np.maximum(each - values.max(), values.min() - each), initial=0) for each in both]
            print_row(name, method, f"{np.abs(found[0] - inside @ slope).max():.1e}",
                      f"{np.abs((gradients - slope) @ basis).max(initial=0):.1e}", *(f"{most:.1e}" for most in beyond))


def exact(_):
    print_head("samples", "method", "constant", "its gradient", "affine", "its gradient")
    slope = np.array([2.0, -3.0, 0.5])
    for kind in (uniform, clustered, lattice, graded, duplicates, layers):
        random = np.random.default_rng(1)
        positions, places = kind(20000, random), 0.9 * uniform(20000, random)
        for method in METHODS:
            ours, cells = Ours(positions, method), []
            for values, true, rise in ((np.full(len(positions), 3.7), 3.7, 0 * slope),
                                       (1 + positions @ slope, 1 + places @ slope, slope)):
                found, gradients = ours([values], places, 1)
                cells += [f"{np.abs(found[0] - true).max():.1e}", f"{np.abs(gradients - rise).max():.1e}"]
            print_row(kind.__name__, method, *cells)


# ---- Files

def samples_of(path, array):
    """Distinct positions of a file's points, and an array's values; of large volumes the middle."""
    import common
    data = common.read(path)
    positions, given = common.positions_of(data), data.GetPointData().GetArray(array)
    if given is None:
        raise SystemExit(f"{path}: no array {array} of points")
    values = common.vtk_to_numpy(given).astype(float)
    if data.IsA("vtkImageData"):
        middle = [slice(max(0, (count - MOST_VOXELS) // 2), max(0, (count - MOST_VOXELS) // 2) + MOST_VOXELS)
                  for count in data.GetDimensions()[::-1]]
        numbers = np.arange(len(values)).reshape(data.GetDimensions()[::-1])[tuple(middle)].ravel()
        return positions[numbers], values[numbers]
    first = np.sort(np.unique(positions, axis=0, return_index=True)[1])
    return positions[first], values[first]


def held_out(options):
    print_head("file", "array", "samples", *METHODS, *options.peers)
    for path, array in options.file:
        positions, values = samples_of(path, array)
        is_out = np.random.default_rng(7).random(len(positions)) < 0.05
        places, true = positions[is_out][:8000], values[is_out][:8000]
        positions, values = positions[~is_out], values[~is_out]
        cells = []
        for name, peer in all_of(positions, options.peers, values, places, true):
            found, _ = peers.call(peer, [values], places, 0)
            cells.append("raises" if isinstance(found, str) else
                         f"{np.sqrt(np.nanmean((found[0] - true) ** 2)) / values.std():.3g}")
        print_row(pathlib.Path(path).name, array, f"{len(positions):,}", *cells)


# ---- Continuity, outside, same results

def jumps(ours, values, begins, directions, step_length, spacing):
    """The largest differences of values and gradients between neighboring places on lines of ten spacings."""
    along = step_length * spacing * np.arange(round(10 / step_length))
    places = begins[:, None] + along[:, None] * directions[:, None]
    found, gradients = ours([values], places.reshape(-1, 3), 1)
    return (np.abs(np.diff(found[0].reshape(len(begins), -1))).max(),
            np.linalg.norm(np.diff(gradients.reshape(*places.shape), axis=1), axis=2).max())


def continuity(_):
    print_head("samples", "field", "method", "difference at 1/100, over the range", "times that at 1/1000",
               "of gradients: times that at 1/1000")
    for kind in (uniform, clustered, lattice, layers):
        positions = kind(100000, np.random.default_rng(5))
        spacing, random = spacing_of(positions), np.random.default_rng(6)
        begins, directions = 0.4 * uniform(10, random), random.normal(size=(10, 3))
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        for field in (lambda p: smooth(p)[0], sphere, noisy, step):
            values = field(positions)
            for method in METHODS:
                ours = Ours(positions, method)
                (wide, wide_slope), (near, near_slope) = (
                    jumps(ours, values, begins, directions, length, spacing) for length in (0.01, 0.001))
                print_row(kind.__name__, field.__name__.replace("<lambda>", "smooth"), method,
                          f"{wide / np.ptp(values):.1e}", f"{wide / near:.1f}", f"{wide_slope / near_slope:.1f}")


def outside(_):
    """Shares of places without a value. The mask does not depend on the method."""
    depths = (-np.inf, -2, -1, -0.5, 0, 0.25, 0.5, 1, np.inf)
    print_head("body", *(f"{a:g} to {b:g}" for a, b in zip(depths, depths[1:])), "beyond 1 outside",
               "beyond 1 inside")
    all_count = 600000
    spacing = 2 / all_count ** (1 / 3)

    def density(p):
        return np.where(p[:, 0] > 0.2, 1, np.where(p[:, 0] > -0.2, 0.3, 0.05))

    def ball(p):
        return 0.8 - np.linalg.norm(p, axis=1)

    def shell(p):
        return np.minimum(ball(p), np.linalg.norm(p, axis=1) - 0.4)

    def slit(p):
        return np.minimum(0.8 - np.abs(p).max(axis=1), np.abs(p[:, 0]) - 1.5 * spacing)

    for name, depth, is_graded in (("ball", ball, False), ("shell", shell, False), ("slit", slit, False),
                                   ("slit, places within", slit, False), ("ball of three densities", ball, True)):
        random = np.random.default_rng(10)
        positions = uniform(all_count, random)
        positions = positions[depth(positions) > 0]
        if is_graded:
            positions = positions[random.random(len(positions)) < density(positions)]
        places = uniform(60000, random) * ((1.5 * spacing, 0.7, 0.7) if "within" in name else 1)
        deep = depth(places) / spacing * (density(places) ** (1 / 3) if is_graded else 1)
        found, _ = Ours(positions, outside=np.nan)([np.zeros(len(positions))], places)
        shares = [100 * np.isnan(found[0][chosen]).mean() if chosen.any() else np.nan
                  for a, b in (*zip(depths, depths[1:]), (-np.inf, -1), (1, np.inf))
                  for chosen in [(deep >= a) & (deep < b)]]
        print_row(name, *(f"{share:.3g} %" for share in shares))


def same(_):
    print_head("samples", "method", "1 to 4 threads", "permuted places", "permuted samples: difference over the range")
    for kind in (uniform, clustered, lattice, duplicates, layers):
        random = np.random.default_rng(11)
        positions, places = kind(50000, random), 1.2 * uniform(5000, random)
        values, order, places_order = noisy(positions), random.permutation(len(positions)), random.permutation(5000)
        for method in METHODS:
            found, slopes = Ours(positions, method)([values], places, 1)
            by_threads = [Ours(positions, method, threads)([values], places, 1) for threads in (2, 3, 4)]
            turned = Ours(positions, method)([values], places[places_order], 1)
            other, _ = Ours(positions[order], method)([values[order]], places, 1)
            print_row(kind.__name__, method,
                      all(np.array_equal(found, f) and np.array_equal(slopes, g) for f, g in by_threads),
                      np.array_equal(found[:, places_order], turned[0])
                      and np.array_equal(slopes[places_order], turned[1]),
                      f"{np.abs(found - other).max() / np.ptp(values):.1e}")


# ---- Price

def processor_seconds(work):
    begin = time.process_time()
    work()
    return time.process_time() - begin


def add_prices(count, options):
    random = np.random.default_rng(8)
    positions = uniform(count, random)
    first = smooth(positions)[0]
    five = [first, first ** 2, positions[:, 0] * first, np.sin(positions[:, 1]), positions[:, 2] ** 3]
    places, spacing = 0.9 * uniform(MOST, random), spacing_of(positions)
    works, seconds, prepared = {}, {}, {}

    def add(name, peer, has_gradients):
        works[name, 1] = lambda: peer([first], places, 0), MOST
        works[name, 5] = lambda: peer(five, places, 0), MOST
        if has_gradients:
            works[name, "gradient"] = lambda: peer([first], places, spacing), MOST

    for method in (*METHODS, "NEAREST"):
        made = []
        prepared[method] = processor_seconds(lambda: made.append(Ours(positions, method, outside=np.nan)))
        made[0]([first], places)  # refines the tree
        add(method, made[0], method != "NEAREST")
        if method in ("BLEND", "CUBIC"):
            works[method, "at the samples"] = lambda ours=made[0]: ours([first], positions, spacing), count
    for name in options.peers:
        made = []
        prepared[name] = processor_seconds(lambda: made.append(peers.made(name, positions)))
        add(name, made[0], False)
    for _ in range(options.runs):
        for key, (work, size) in works.items():
            seconds.setdefault(key, []).append(1e6 * processor_seconds(work) / size)
    taken = {key: np.median(all_runs) for key, all_runs in seconds.items()}
    base = taken.get(("wlsqm", 1), np.nan)
    for name, first_seconds in prepared.items():
        one = taken[name, 1]
        print_row(f"{count:,}", name, f"{first_seconds:.2f}", f"{one:.2f}", f"{one / base:.2f}",
                  f"{taken[name, 5] / one:.2f}",
                  *(f"{taken[name, what] / one:.2f}" if (name, what) in taken else ""
                    for what in ("gradient", "at the samples")))


def add_line(millions, runs):
    """A thousand places on a line among many samples, first and again."""
    positions = np.random.default_rng(9).random((int(1e6 * millions), 3), dtype=np.float32) * 2 - 1
    values = np.sin(3 * positions[:, 0])
    line = np.linspace([-0.9, -0.7, -0.3], [0.9, 0.8, 0.4], 1000)
    for method in ("BLEND", "CUBIC"):
        taken = []
        for _ in range(runs):
            made = []
            load = processor_seconds(lambda: made.append(Ours(positions, method, outside=np.nan)))
            taken.append((load, *(processor_seconds(lambda: made[0]([values], line)) for _ in range(2))))
        load, probe, again = np.median(taken, axis=0)
        print_row(f"{millions:g} M", method, f"{load:.2f}", f"{probe / load:.2f}", f"{again / load:.2f}")


def price(options):
    print_head("samples", "method", "seconds to load", "microseconds a place", "over wlsqm's", "five arrays over one",
               "with gradients over without", "gradients at all samples, each over a place")
    for millions in options.samples:
        add_prices(int(1e6 * millions), options)
    print()
    print_head("samples", "method", "seconds to load", "a line of 1,000 places over loading", "again")
    for millions in options.many:
        add_line(millions, options.runs)


TASKS = {"accuracy": accuracy, "hard": hard, "flat": flat, "exact": exact, "held-out": held_out,
         "continuity": continuity, "outside": outside, "same": same, "price": price}

warnings.filterwarnings("ignore", "At .* places", RuntimeWarning)  # the samples around are in a plane
parser = parser_of(__doc__)
parser.add_argument("tasks", nargs="*", metavar="TASK", help="default: all")
parser.add_argument("--file", nargs=2, action="append", default=[], metavar=("FILE", "ARRAY"),
                    help="points of VTK's XML formats, for held-out")
parser.add_argument("--peers", nargs="*", default=list(peers.PEERS), metavar="NAME",
                    help="default: " + ", ".join(peers.PEERS))
parser.add_argument("--environment", default=pathlib.Path(__file__).resolve().parents[1] / "build/peers",
                    help="the folder of the virtual environment. Default: build/peers")
add_numbers(parser, runs=5, samples=[0.1, 1.0], many=[16.0])
options = parser.parse_args()
peers.enter(options.environment)
options.peers = [name for name in options.peers if peers.has(peers.PEERS[name][0])]
for task in options.tasks or TASKS:
    print(f"\n{task}\n", flush=True)
    TASKS[task](options)
