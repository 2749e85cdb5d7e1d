# SPDX-License-Identifier: GPL-3.0-or-later
"""The longest time between two questions whether to cancel, of the C library on one thread.

    PYTHONPATH=build/release/lib/python3.11/dist-packages /usr/bin/python3 Benchmark/cancellation.py

Contours an image of waves as points and as triangles, by default with two million triangles before merging. Prints a
Markdown table: the step; its processor seconds; the number of questions; the longest processor time between two of
them, in milliseconds.
"""

import argparse
import ctypes
import time

import numpy as np
from scatteredisopoints import _library as library


def image(nodes):
    """Positions and values of an image of waves."""
    positions = np.stack(np.meshgrid(*3 * [np.arange(nodes, dtype=np.float32)], indexing="ij"), -1).reshape(-1, 3)
    angles = (2 * np.pi * 6 / nodes * positions).astype(np.float32)
    values = (np.sin(angles) * np.cos(np.roll(angles, 1, axis=1))).sum(axis=1)
    return positions, values + 0.01 * np.sin(positions @ np.float32([0.7, 1.3, 2.1]))


def measure(step, call):
    """Prints the row of a call."""
    times.clear()
    times.append(time.thread_time())
    call()
    times.append(time.thread_time())
    seconds = np.array(times)
    print(f"| {step} | {seconds[-1] - seconds[0]:.2f} | {len(times) - 2} | {1e3 * np.diff(seconds).max():.0f} |")


def ask(_):
    times.append(time.thread_time())
    return 0


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--nodes", type=int, default=113, help="of the image, in each direction")
positions, values = image(parser.parse_args().nodes)
times: list = []
cancels = library.Cancels(ask)
extractor = library.Extractor(library.create_extractor())
library.run(library.set_extractor_threads, extractor, 1)
library.run(library.set_extractor_callbacks, extractor, library.Progress(), cancels, None)
print("| step | processor s | questions | longest, ms |\n|---|---|---|---|")
measure("load", lambda: library.run(library.set_samples, extractor, positions, values, None))
for name, chosen in (("points", dict(triangles=0)), ("triangles", dict(triangles=1)),
                     ("exact triangles", dict(triangles=1, regularize=0)),
                     ("triangles with creases", dict(triangles=1, projection=4))):
    options, pointer = library.Options(), ctypes.c_void_p()
    for option, value in chosen.items():
        setattr(options, option, value)
    isovalue = (ctypes.c_double * 1)(0.3)
    measure(name, lambda: library.run(
        library.extract, extractor, isovalue, 1, ctypes.byref(options), ctypes.byref(pointer)))
    surface = library.Surface(pointer.value)
    count = len(library.view(surface, library.TRIANGLES if chosen["triangles"] else library.POINTS))
    print(f"| ({count} {'triangles' if chosen['triangles'] else 'points'}) | | | |")
    del surface
