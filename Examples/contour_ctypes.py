# SPDX-License-Identifier: GPL-3.0-or-later
"""Contours samples with Python's standard library alone: contour_ctypes.py LIBRARY

LIBRARY is the path of the C library, libisopoint.so, which any installation of this project has. isopoint.h
describes its functions.
"""

import array
import ctypes
import random
import sys

FLOAT, DOUBLE = 0, 1
POINTS, NORMALS = 0, 2


class Array(ctypes.Structure):
    """isopoint_array"""

    _fields_ = [("data", ctypes.c_void_p), ("type", ctypes.c_int32), ("components", ctypes.c_int32),
                ("count", ctypes.c_int64), ("stride", ctypes.c_int64),
                ("component_stride", ctypes.c_int64)]


class Options(ctypes.Structure):
    """isopoint_options"""

    _fields_ = [("size", ctypes.c_uint64), *((name, ctypes.c_int32) for name in (
        "triangles", "projection", "normal_method", "drop_gaps", "compute_normals",
        "compute_gradients", "compute_projection_orders", "output_points_precision",
        "number_of_neighbors", "compute_splats")),
        ("angle", ctypes.c_double),
        ("keep_tetrahedra", ctypes.c_int32), ("regularize", ctypes.c_int32), ("keep_hull_slivers", ctypes.c_int32),
        ("capping", ctypes.c_int32),
        ("minimum_piece_size", ctypes.c_double)]


def load(path):
    """Loads the library, and declares what functions return that do not return int."""
    library = ctypes.CDLL(path)
    library.isopoint_create_extractor.restype = ctypes.c_void_p
    library.isopoint_get_error.restype = ctypes.c_char_p
    library.isopoint_get_message.restype = ctypes.c_char_p
    return library


class Extractor:
    """Holds samples, and extracts surfaces from them."""

    def __init__(self, library):
        self.library = library
        self.handle = ctypes.c_void_p(library.isopoint_create_extractor())

    def close(self):
        self.library.isopoint_destroy_extractor(self.handle)
        self.handle = None

    def check(self, status):
        if status != 0:
            raise ValueError(self.library.isopoint_get_error().decode())

    def set_samples(self, positions, values, excluded=None):
        """Arrays of type Array."""
        self.check(self.library.isopoint_set_samples(
            self.handle, ctypes.byref(positions), ctypes.byref(values),
            ctypes.byref(excluded) if excluded else None))

    def options(self, **chosen):
        options = Options()
        self.library.isopoint_initialize_options(
            ctypes.byref(options), ctypes.c_size_t(ctypes.sizeof(options)))
        for name, value in chosen.items():
            setattr(options, name, value)
        return options

    def extract(self, isovalues, **options):
        """The handle of a surface, which the caller destroys."""
        surface = ctypes.c_void_p()
        numbers = (ctypes.c_double * len(isovalues))(*isovalues)
        self.check(self.library.isopoint_extract(
            self.handle, numbers, ctypes.c_int64(len(isovalues)),
            ctypes.byref(self.options(**options)), ctypes.byref(surface)))
        return surface

    def array(self, surface, number):
        found = Array()
        self.check(self.library.isopoint_get_array(surface, number, ctypes.byref(found)))
        return found


def main():
    numbers = random.Random(1)
    xyz = array.array("f", (numbers.random() for _ in range(3 * 20000)))
    distances = array.array("d", (
        sum((xyz[3 * i + axis] - 0.5) ** 2 for axis in range(3)) ** 0.5 for i in range(20000)))
    positions = Array(xyz.buffer_info()[0], FLOAT, 3, 20000, 0, 0)
    values = Array(distances.buffer_info()[0], DOUBLE, 1, 20000, 0, 0)

    extractor = Extractor(load(sys.argv[1]))
    extractor.set_samples(positions, values)
    surface = extractor.extract([0.3])
    points = extractor.array(surface, POINTS)
    coordinates = ctypes.cast(points.data, ctypes.POINTER(ctypes.c_float))
    radii = [sum((coordinates[3 * i + axis] - 0.5) ** 2 for axis in range(3)) ** 0.5
             for i in range(points.count)]
    print(f"{points.count} points, {min(radii):.3f} to {max(radii):.3f} away from the center")
    extractor.library.isopoint_destroy_surface(surface)
    extractor.close()


if __name__ == "__main__":
    main()
