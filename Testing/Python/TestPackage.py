# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python package with NumPy alone: TestPackage.py [PATH OF isopoint.h]"""

import contextlib
import copy
import ctypes
import doctest
import gc
import importlib
import importlib.util
import inspect
import os
import pathlib
import pickle
import pydoc
import re
import signal
import subprocess
import sys
import tempfile
import threading
import typing
import unittest
import warnings
import weakref
from unittest import mock

import numpy as np
import scatteredisopoints
from scatteredisopoints import (
    Interpolator, Isosurface, Samples, _functions, _library, _option_types, _options, contour, gradient, probe)

HEADER = pathlib.Path(__file__).parents[2] / "Library/isopoint.h"


def cloud(count=5000, dtype=np.float64, seed=1):
    positions = np.random.default_rng(seed).random((count, 3)).astype(dtype)
    return positions, np.linalg.norm(positions - 0.5, axis=1).astype(dtype)


def contents(surface: Isosurface):
    """All bytes of a surface."""
    triangles = None if surface.triangles is None else surface.triangles.tobytes()
    arrays = {**surface.arrays, **surface.splat_shapes}
    return surface.points.tobytes(), triangles, {name: arrays[name].tobytes() for name in arrays}


class Signatures(unittest.TestCase):
    """The declarations of _library are those of the header."""

    C_TYPES = {"void*": ctypes.c_void_p, "double*": ctypes.POINTER(ctypes.c_double), "size_t": ctypes.c_size_t,
               "int32_t": ctypes.c_int32, "int64_t": ctypes.c_int64, "uint64_t": ctypes.c_uint64,
               "double": ctypes.c_double, "const void*": ctypes.c_void_p}

    @classmethod
    def setUpClass(cls):
        cls.text = re.sub(r"/\*.*?\*/", "", HEADER.read_text(), flags=re.DOTALL)

    def members(self, struct):
        body = re.search(r"typedef struct %s\s*{(.*?)}" % struct, self.text, re.DOTALL)[1]
        return [(name, self.C_TYPES[kind.strip()]) for kind, name in re.findall(r"([\w *]+?\*?) (\w+);", body)]

    def test_structs(self):
        for struct, mirror in (("isopoint_array", _library.Array), ("isopoint_options", _library.Options),
                               ("isopoint_probe_options", _library.ProbeOptions),
                               ("isopoint_probe_result", _library.Probed)):
            self.assertEqual(self.members(struct), list(mirror._fields_))

    def test_ids_of_arrays(self):
        body = re.search(r"typedef enum isopoint_array_id\s*{(.*?)}", self.text, re.DOTALL)[1]
        ids = re.findall(r"ISOPOINT_ARRAY_(\w+) = (\d+)", body)
        self.assertEqual(len(ids), 16)
        for name, number in ids:
            self.assertEqual(getattr(_library, name), int(number))

    def test_named_constants(self):
        names = {"PROJECTION_NONE": "NO_PROJECTION", "NORMALS_AUTOMATIC": "AUTOMATIC_NORMALS",
                 "PRECISION_INPUT": "DEFAULT_PRECISION"}
        found = {}
        for name, number in re.findall(
                r"ISOPOINT_((?:PROJECTION_|NORMALS_|PRECISION_|PROBE_(?!OUTSIDE))\w+) = (-?\d+)", self.text):
            own = re.sub(r"^PROJECTION_(.*)", r"\1_FIT", re.sub(
                r"^PRECISION_(.*)", r"\1_PRECISION", re.sub("^PROBE_", "", name)))
            found[names.get(name, own)] = int(number)
        for name, number in re.findall(r"ISOPOINT_(?:PROBE_)?((?:OUTSIDE|PLACE)_\w+) = (\d+)", self.text):
            self.assertEqual(getattr(_library, name, int(number)), int(number))
        ours = {name.upper(): number for constants in _options.CONSTANTS.values() for name, number in constants.items()}
        self.assertEqual(found, ours)

    def test_functions(self):
        counts = {}
        for name, parameters in re.findall(
                r"ISOPOINT_API [\w ]+?\*?\s*isopoint_(\w+)\(((?:[^()]|\([^()]*\))*)\);", self.text):
            callbacks = re.sub(r"\(\*(\w+)\)\([^()]*\)", r"\1", parameters)
            counts[name] = 0 if callbacks.strip() == "void" else callbacks.count(",") + 1
        declared = {name: function for name, function in vars(_library).items()
                    if isinstance(function, ctypes._CFuncPtr) and hasattr(function, "argtypes")
                    and getattr(function, "__name__", "").startswith("isopoint_")}
        self.assertGreater(len(declared), 14)
        for function in declared.values():
            name = function.__name__[len("isopoint_"):]
            self.assertEqual(len(function.argtypes), counts[name], name)

    def test_counts_have_64_bits(self):
        kinds = dict(_library.Array._fields_)
        for member in ("count", "stride", "component_stride"):
            self.assertEqual(ctypes.sizeof(kinds[member]), 8)
        self.assertIs(_library.extract.argtypes[2], ctypes.c_int64)


class Arrays(unittest.TestCase):
    def test_layouts_make_no_difference(self):
        positions, values = cloud()
        expected = contents(contour(positions, values, 0.3))
        padded = np.zeros(len(values), [("pad", "u1"), ("x", "f8", 3), ("v", "f8")])
        padded["x"], padded["v"] = positions, values
        read_only = positions.copy()
        read_only.flags.writeable = False
        table = np.column_stack([positions, values])
        for name, place, value in (
                ("Fortran's order", np.asfortranarray(positions), values),
                ("backwards", positions[::-1][::-1], values[::-1].copy()[::-1]),
                ("strides", np.repeat(positions, 2, axis=0)[::2], np.repeat(values, 3)[::3]),
                ("columns", table[:, :3], table[:, 3]),
                ("swapped bytes", positions.astype(">f8"), values.astype(">f8")),
                ("not aligned", padded["x"], padded["v"]),
                ("read-only", read_only, values[:, None]),
                ("lists", positions.tolist(), values.tolist()),
                ("long double", positions.astype(np.longdouble), values)):
            with self.subTest(name):
                self.assertEqual(contents(contour(place, value, 0.3)), expected)

    def test_broadcast_arrays(self):
        positions, _ = cloud(100)
        constant = np.broadcast_to(1.0, 100)  # a stride of zero
        with self.assertWarnsRegex(RuntimeWarning, "all values of the array are 1"):
            self.assertEqual(len(contour(positions, constant, 1.0)), 0)
        in_a_plane = np.broadcast_to(positions[:1], (100, 3))
        with self.assertWarns(RuntimeWarning):
            self.assertEqual(len(contour(in_a_plane, np.arange(100.0), 5.5)), 0)

    def test_types_of_values(self):
        positions, values = cloud()
        whole = np.rint(100 * values)
        expected = contour(positions, whole.astype(np.int32), 30.5).points
        for kind in ("i1", "u1", "i2", "u2", "i8", "u8", ">i4"):
            found = contour(positions, whole.astype(kind), 30.5).points
            np.testing.assert_allclose(found, expected, atol=1e-5, err_msg=kind)
        self.assertGreater(len(contour(positions, values > 0.3, 0.5)), 100)
        self.assertGreater(len(contour(positions, values.astype(np.float16), 0.3)), 100)

    def test_samples_that_are_no_numbers(self):
        positions, values = cloud()
        bad = np.arange(len(values)) % 7 == 0
        expected = contents(contour(positions[~bad], values[~bad], 0.3))[0]
        with_nan, with_inf, places = values.copy(), values.copy(), positions.copy()
        with_nan[bad], with_inf[bad], places[bad, 1] = np.nan, np.inf, np.nan
        for place, value in ((positions, with_nan), (positions, with_inf), (places, values),
                             (np.ma.masked_array(positions, np.column_stack(3 * [bad])), values)):
            with self.assertWarnsRegex(RuntimeWarning, "Skipped 715 of 5000 samples: not finite"):
                self.assertEqual(contents(contour(place, value, 0.3))[0], expected)

    def test_masked_values(self):
        """Their samples are left out. Integers count as rounded all the same."""
        positions, values = cloud()
        bad = np.arange(len(values)) % 7 == 0
        whole = np.rint(20 * values)
        samples = Samples(positions, values)
        for kind in ("f4", "f8", "i2", "i8", "u1", "?"):
            value, isovalue = (values > 0.3, 0.5) if kind == "?" else (whole.astype(kind), 6.5)
            surface = contour(positions[~bad], value[~bad], isovalue)
            masked = np.ma.masked_array(np.where(bad, value.max(), value), bad)
            samples.replace_values(masked)
            for found in (contour, lambda *_: samples.contour(isovalue)):
                with self.subTest(kind), self.assertWarnsRegex(RuntimeWarning, "715 of 5000 values are masked"):
                    self.assertTrue(contents(found(positions, masked, isovalue)) == contents(surface))
            self.assertEqual(samples.skipped, 715)

    def test_few_samples(self):
        with self.assertRaisesRegex(ValueError, "no samples"):
            contour(np.zeros((0, 3)), np.zeros(0), 0.3)
        for count in (1, 2, 3, 4, 5):
            positions, values = cloud(count)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                for triangles in (False, True):
                    surface = contour(positions, values, np.median(values), triangles=triangles)
                    self.assertEqual(surface.points.shape, (len(surface), 3))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self.assertEqual(len(contour(np.full((9, 3), np.nan), np.arange(9.0), 4.5)), 0)

    def test_wrong_arguments(self):
        positions, values = cloud(100)
        triangles = dict(triangles=True)
        for arguments, error, text in (
                ((positions[:, :2], values), ValueError, r"\(100, 2\).*\(n, 3\).*zeros"),
                ((positions.ravel(), values), ValueError, r"\(300,\).*\(n, 3\)"),
                ((positions.T, values), ValueError, r"\(3, 100\).*pass numpy.transpose\(positions\)$"),
                ((np.zeros((3, 0)), values), ValueError, r"\(3, 0\).*: pass three coordinates of each$"),
                ((3.0, values), ValueError, r"\(\).*\(n, 3\)"),
                ((positions, 3.0), ValueError, r"values.*\(\).*\(100,\)"),
                ((positions, values[:99]), ValueError, r"\(99,\).*\(100,\)"),
                ((positions, positions), ValueError, r"values.*\(100, 3\)"),
                ((positions, None), TypeError, "values.*missing"),
                ((positions.tolist() + [[1.0]], values), (ValueError, TypeError), "^positions are (no array|of)"),
                ((positions, "T"), TypeError, "^values are of the type <U1, not real numbers: names are strings"),
                *(((name, "T"), TypeError, "^positions cannot be the file a.csv: read the file first, or use python -m")
                  for name in ("a.csv", pathlib.Path("a.csv"))),
                ((positions * 1j, values), TypeError, "positions.*complex128"),
                ((positions, ["a"] * 100), TypeError, "values.*type"),
                ((positions, np.full(100, None)), TypeError, "values.*object"),
                ((positions, values, np.nan), ValueError, "not a number"),
                *(((positions, values, wrong), TypeError, "isovalues|not numbers")
                  for wrong in ("0.3", None, [1j], ["0.3"]))):
            with self.subTest(text=text), self.assertRaisesRegex(error, text):
                contour(*arguments, *([0.3] if len(arguments) == 2 else []))
        for options, error, text in (
                (dict(threads=0), ValueError, "threads"),
                *((dict(threads=wrong), TypeError, f"threads cannot be {wrong!r}: give a whole number")
                  for wrong in (2.0, "4")),
                (dict(progress=3), TypeError, "progress"),
                *((dict(triangles=wrong), ValueError, "^triangles cannot be .*: it is True or False")
                  for wrong in ("no", np.array([True, False]))),
                *((dict(projection=wrong), ValueError, 'projection cannot be .* or "none"$')
                  for wrong in (True, "cubes", 1.5, type("Null", (), {"__str__": lambda _: "None"})())),
                (dict(arrays={"a": values[:3]}), ValueError, "shape"), (dict(arrays=[values]), TypeError, "mapping"),
                (dict(arrays={"values": values}), ValueError, "name"), (dict(gap=2), TypeError, "gap.*drop_gaps"),
                (dict(size=2), TypeError, "size"), (dict(triangles, angle=30.0), TypeError, "angle"),
                (dict(regularize=True), TypeError, "regularize"),
                (dict(triangles, regularize=2), ValueError, "regularize"),
                (dict(angle=200.0), ValueError, "angle.*200.*180"), (dict(angle="wide"), ValueError, "angle"),
                (dict(number_of_neighbors=2**32 + 12), ValueError, "range"),
                (dict(drop_gaps=2), ValueError, "drop_gaps"), (dict(drop_gaps="yes"), ValueError, "True or False"),
                (dict(triangle=True), TypeError, "did you mean triangles"),
                (dict(DropGap=True), TypeError, "did you mean drop_gaps"),
                (dict(angle=30.0, **triangles), TypeError, "angle is an option of points"),
                (dict(contour_blocks=True), TypeError, "each block"), (dict(angle="30"), ValueError, "a real number")):
            with self.subTest(options=list(options)), self.assertRaisesRegex(error, text):
                contour(positions, values, 0.3, **options)


class Results(unittest.TestCase):
    def test_points_and_splats(self):
        positions, values = cloud(20000)
        surface = contour(positions, values, np.array(0.3))
        self.assertLess(np.abs(np.linalg.norm(surface.points - 0.5, axis=1) - 0.3).max(), 1e-3)
        self.assertEqual(surface.normals.shape, surface.points.shape)
        self.assertEqual(surface.radii.shape, (len(surface),))
        self.assertIsNone(surface.triangles)
        splats = surface.splats()
        self.assertEqual(set(splats.arrays), {"values", "Radius", "Normals"})
        self.assertLess(splats.triangles.max(), len(splats))
        for scale in (1.0, 0.5):
            splats = surface.splats(scale)
            corners = splats.points[splats.triangles]
            areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
            self.assertAlmostEqual(areas.sum() / (4 * np.pi * 0.3**2), scale**2, delta=0.02)
        for wrong in (0.0, -1.0, np.nan, np.inf):
            with self.assertRaisesRegex(ValueError, "The scale of splats"):
                surface.splats(wrong)
        for wrong in ("a", None, [1.0, 2.0]):
            with self.assertRaisesRegex(ValueError, "scale cannot be .*: it is a real number"):
                surface.splats(wrong)
        for wrong in (np.ones((len(surface), 0)), np.ones(3)):
            surface.arrays["wrong"] = wrong
            with self.assertRaisesRegex(ValueError, "wrong have the shape"):
                surface.splats()

    def test_splats_of_arrays_of_other_layouts(self):
        surface = contour(*cloud(20000), 0.3)
        expected = contents(surface.splats())
        arrays = surface.points, surface.normals, *surface.splat_shapes.values()
        for name, changed in (("swapped bytes", lambda array: array.astype(array.dtype.newbyteorder())),
                              ("columns", lambda array: np.repeat(array, 2, axis=1)[:, ::2]),
                              ("Fortran's order", np.asfortranarray)):
            points, normals, *shapes = map(changed, arrays)
            other = Isosurface(points, arrays={**surface.arrays, "Normals": normals},
                               splat_shapes=dict(zip(surface.splat_shapes, shapes)))
            with self.subTest(name):
                self.assertTrue(contents(other.splats()) == expected)

    def test_arrays_live_as_long_as_calls(self):
        """What the library reads is passed as an array of NumPy, which its description keeps alive."""
        numbers = np.arange(6.0)
        self.assertIs(_library.Array.of(numbers).numbers, numbers)
        declared = [value for value in vars(_library).values() if isinstance(value, ctypes._CFuncPtr)]
        outputs = [each.__name__ for each in declared if ctypes.POINTER(_library.Array) in (each.argtypes or ())]
        self.assertEqual(outputs, ["isopoint_get_array"])
        inputs = [each.__name__ for each in declared if _library.InputArray in (each.argtypes or ())]
        self.assertEqual(len(inputs), 5)
        self.assertIs(_library.InputArrays.from_param([numbers]).arrays[0].numbers, numbers)
        self.assertIs(_library.ProbeOutputs.from_param([(numbers, None)]).pairs[0][0], numbers)

    def test_surfaces_without_splats(self):
        positions, values = cloud()
        for options, text in ((dict(triangles=True), "Triangles have no splats"),
                              (dict(compute_splats=False), "has no splats"),
                              (dict(compute_normals=False), "has no splats")):
            with self.assertRaisesRegex(ValueError, text):
                contour(positions, values, 0.3, **options).splats()

    def test_arrays_are_interpolated(self):
        positions, values = cloud()
        count = np.arange(len(values))
        surface = contour(positions, values, 0.3, projection="no_projection", arrays={
            "place": positions, "double": 2 * values, "count": count, "swapped": values.astype(">f4")})
        np.testing.assert_allclose(surface.arrays["place"], surface.points, atol=1e-12)
        np.testing.assert_allclose(surface.arrays["double"], 0.6, atol=1e-12)
        self.assertEqual(surface.arrays["count"].dtype, count.dtype)
        np.testing.assert_allclose(surface.arrays["swapped"], 0.3, atol=1e-6)
        with self.assertWarnsRegex(RuntimeWarning, 'computed array "Normals" replaces'):
            contour(positions, values, 0.3, arrays={"Normals": positions})

    def test_arrays_that_are_not_computed(self):
        positions, values = cloud()
        surface = contour(positions, values, 0.3, compute_normals=False, compute_splats=False, compute_scalars=False)
        self.assertEqual(surface.arrays, {})
        self.assertIsNone(surface.normals)
        self.assertIsNone(surface.radii)
        surface = contour(positions, values, 0.3, compute_gradients=True,
                          compute_projection_orders=True, output_points_precision="SINGLE_PRECISION")
        self.assertEqual(surface.arrays["Gradients"].shape, (len(surface), 3))
        self.assertEqual(surface.arrays["ProjectionOrder"].dtype, np.uint8)
        self.assertEqual(surface.points.dtype, np.float32)

    def test_threads_make_no_difference(self):
        positions, values = cloud(30000)
        for triangles in (False, True):
            found = [contents(contour(positions, values, 0.3, triangles=triangles, threads=threads))
                     for threads in (None, 1, 3)]
            self.assertEqual(found[1:], [found[0]] * 2)

    @unittest.skipUnless(os.path.exists("/proc/self/task"), "threads are read from /proc")
    def test_one_thread_is_one(self):
        script = ("import numpy, os; from scatteredisopoints import contour\n"
                  "positions = numpy.random.default_rng(1).random((50000, 3))\n"
                  "values = numpy.linalg.norm(positions - 0.5, axis=1)\n"
                  "before = len(os.listdir('/proc/self/task'))\n"
                  "for triangles in (True, False): surface = contour(positions, values, 0.3, threads=1,"
                  " triangles=triangles)\n"
                  "surface.splats()\n"
                  "print(len(os.listdir('/proc/self/task')) - before, len(surface.splats(threads=2)))\n")
        result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
        more, count = map(int, result.stdout.split())
        self.assertEqual(more, 0)
        self.assertGreater(count, 10000)
        with self.assertRaisesRegex(ValueError, "threads are 0"):
            contour(*cloud(), 0.3).splats(threads=0)

    def test_views_outlive_what_they_are_of(self):
        points = contour(*cloud(), 0.3).points
        expected = points.copy()
        gc.collect()
        other = [contour(*cloud(seed=seed), 0.3) for seed in range(2, 6)]
        np.testing.assert_array_equal(points, expected)
        self.assertEqual(len(other), 4)

    def test_points_are_read_only_unless_assigned(self):
        """Areas and volumes are computed once."""
        positions, values = cloud()
        arrays = {"place": positions, "Radius": values}
        surface = contour(positions, values, (0.3, 0.4), triangles=True, arrays=arrays, compute_gradients=True)
        area, volume, pieces = surface.area, surface.volume, surface.pieces
        for each in (surface, pickle.loads(pickle.dumps(surface))):
            for array in (each.points, each.triangles, each.region_ids, *each.arrays.values()):
                with self.assertRaisesRegex(ValueError, "read-only"):
                    array *= 2
                with self.assertRaisesRegex(ValueError, "cannot set WRITEABLE flag"):
                    array.flags.writeable = True
            with self.assertRaises(AttributeError):
                each.triangles = surface.triangles
            doubled = 2 * each.points
            each.points = doubled
            doubled[:] = 7.0
            with self.assertRaisesRegex(ValueError, "cannot set WRITEABLE flag"):
                each.points.flags.writeable = True
            np.testing.assert_allclose(each.area, 4 * area)
            np.testing.assert_allclose(each.volume, 8 * volume)
            self.assertAlmostEqual(each.pieces[0].area / pieces[0].area, 4)
            self.assertEqual((list(each.arrays), each.normals), (["place", "Radius", "values", "Gradients"], None))
        points = contour(positions, values, 0.3)
        points.points = points.points + 1
        self.assertEqual((list(points.arrays), points.radii), (["values"], None))
        with self.assertRaisesRegex(ValueError, "no splats any more, since points were assigned"):
            points.splats()
        own = contour(positions, values, 0.3, arrays={"Normals": positions}, compute_normals=False, triangles=True)
        own.points = own.points.astype(np.float32).tolist()
        self.assertEqual(own.arrays.keys(), {"Normals", "values"})
        for wrong, text in ((own.points[1:], "points have the shape .*: give one for each"),
                            (own.points[:, :2], r"points have the shape .*, not \(n, 3\)"),
                            (np.where(own.points > 0.5, np.nan, own.points), "points are not finite: give finite")):
            with self.assertRaisesRegex(ValueError, text):
                own.points = wrong

    def test_nothing_to_see(self):
        positions, values = cloud(500)
        with self.assertWarnsRegex(RuntimeWarning, "no isosurface at 99"):
            surface = contour(positions, values, 99.0, triangles=True)
        self.assertEqual((len(surface), surface.triangles.shape), (0, (0, 3)))
        with self.assertWarnsRegex(RuntimeWarning, "no isosurface at 99"):
            points = contour(positions, values, 99.0)
        self.assertEqual((points.points.shape, points.triangles), ((0, 3), None))
        with self.assertWarnsRegex(RuntimeWarning, "there are no isovalues. Set one."):
            self.assertEqual(len(contour(positions, values, [])), 0)

    def test_messages_of_many_isovalues_are_short(self):
        with self.assertWarns(RuntimeWarning) as caught:
            contour(*cloud(100), np.arange(2.0, 5002.0))
        self.assertRegex(
            str(caught.warning), "^The array is from .* to .*: no isosurface at 2, 3, 4 and 4997 more. Choose")
        self.assertLess(len(str(caught.warning)), 150)

    def test_isovalues_are_always_given(self):
        positions, values = cloud(100)
        with self.assertRaisesRegex(TypeError, "isovalues are missing: give one or several numbers"):
            contour(positions, values)
        with self.assertRaises(TypeError):
            Samples(positions, values).contour()

    def test_options_are_those_of_the_library(self):
        of_python = {"compute_scalars", "gradient_direction", "keep_tree"}
        of_library = {*_option_types.MEMBERS} - {"triangles", "keep_tetrahedra", "keep_hull_slivers"}
        self.assertEqual({*_option_types.ContourOptions.__annotations__}, of_library | of_python)
        self.assertEqual({*_options.option_names(False), *_options.option_names(True)},
                         of_library | of_python - {"gradient_direction"})
        for none in (None, "none", "None", "no_projection"):  # as messages advise
            self.assertEqual(_options.make_options(True, {"projection": none}).projection, 0)
        for function in (contour, scatteredisopoints.body, scatteredisopoints.slice_samples, Samples.contour):
            self.assertIn("options", typing.get_type_hints(function))

    def test_files_and_meshes(self):
        surface = contour(*cloud(2000), 0.4, triangles=True)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "surface.npz"
            surface.save(path)
            with np.load(path) as file:
                np.testing.assert_array_equal(file["triangles"], surface.triangles)
            with np.errstate(all="ignore"), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                empty = contour(*cloud(2000), 9.0, triangles=True)
            for kind in ("ply", "stl", "obj", "npz", "csv"):
                for each in (surface, empty):
                    each.save(f"{folder}/saved.{kind}")
                os.unlink(f"{folder}/saved.{kind}")
            surface.arrays["points"] = surface.arrays["values"]
            with self.assertRaisesRegex(ValueError, 'The name "points" is that of something else in NPZ files: rename'):
                surface.save(path)
            with self.assertRaisesRegex(FileNotFoundError, r"nowhere\W+a.ply'"):
                surface.save(f"{folder}/nowhere/a.ply")
            with self.assertRaisesRegex(ValueError, "the format of .*surface.xyz is unknown: there are .ply"):
                surface.save(f"{folder}/surface.xyz")
            self.assertEqual([each.name for each in path.parent.iterdir()], ["surface.npz"])
        with mock.patch.dict(sys.modules, trimesh=mock.MagicMock()) as modules:
            self.assertIs(surface.to_trimesh(), modules["trimesh"].Trimesh.return_value)
            for given, expected in zip(modules["trimesh"].Trimesh.call_args.args, (surface.points, surface.triangles)):
                np.testing.assert_array_equal(given, expected)
                self.assertTrue(given.flags.writeable)
            self.assertEqual(modules["trimesh"].Trimesh.call_args.kwargs, {"process": False})
        with mock.patch.dict(sys.modules, trimesh=None, pyvista=None):
            for method, name in ((surface.to_trimesh, "trimesh"), (surface.to_pyvista, "pyvista")):
                with self.assertRaisesRegex(ImportError, f"{name}.*: pip install {name}$"):
                    method()
        with self.assertRaisesRegex(ValueError, "Points are no mesh: extract triangles"):
            contour(*cloud(2000), 0.4).to_trimesh()

    def test_docstrings(self):
        for owner in (_functions, scatteredisopoints._isosurface, scatteredisopoints._samples):
            self.assertEqual(doctest.testmod(owner).failed, 0)
        for owner in (contour, scatteredisopoints.body, scatteredisopoints.slice_samples, probe, gradient, Samples,
                      Isosurface):
            self.assertIn(">>> ", owner.__doc__)
        for triangles in (False, True):
            for name in _options.option_names(triangles):
                self.assertIn(name + "=", contour.__doc__)
        for owner in (contour, probe, gradient, Samples, Isosurface, Interpolator, scatteredisopoints.load_plugin):
            self.assertNotRegex(pydoc.render_doc(owner), r"docs/|\.md\b")  # which the wheel lacks
        page = pydoc.plain(pydoc.render_doc(scatteredisopoints))
        for name in ("body", "contour", "gradient", "probe", "slice_samples", "Interpolator", "Isosurface", "Samples"):
            self.assertRegex(page, rf"(?m)^    (class )?{name}\(")


class KeptTrees(unittest.TestCase):
    def test_samples_yield_what_contour_does(self):
        positions, values = cloud()
        samples = Samples(positions, values)
        self.assertEqual(len(samples), 5000)
        self.assertEqual(samples.range, (values.min(), values.max()))
        for isovalue in (0.3, 0.2, 0.4):
            for triangles in (False, True):
                self.assertEqual(contents(samples.contour(isovalue, triangles=triangles)),
                                 contents(contour(positions, values, isovalue, triangles=triangles)))

    def test_samples_take_the_parameters_of_functions(self):
        for function, method, more in (
                (contour, Samples.contour, ()), (scatteredisopoints.body, Samples.body, ()),
                (scatteredisopoints.slice_samples, Samples.slice, ()), (probe, Samples.probe, ("arrays",)),
                (gradient, Samples.gradient, ("arrays",))):
            parameters, of_samples = ([name for name in inspect.signature(each).parameters if name not in left_out]
                                      for each, left_out in ((function, ("positions", "values")), (method, more)))
            self.assertEqual(of_samples, ["self", *parameters])
        samples = Samples(*cloud(), threads=2)
        expected = contents(samples.contour(0.3))
        self.assertEqual(contents(samples.contour(0.3, threads=1)), expected)
        with self.assertRaisesRegex(ValueError, "threads are 0"):
            samples.contour(0.3, threads=0)

    def test_samples_are_freed_on_request(self):
        positions, values = cloud()
        samples = Samples(positions, values)
        tree = weakref.ref(samples._extractor)
        surface = samples.contour(0.3, keep_tree=False)
        self.assertIsNone(tree())
        self.assertEqual((np.isnan(samples.range).all(), repr(samples)), (True, "<Samples: 5000, freed>"))
        for call in (lambda: samples.contour(0.3), samples.body, samples.slice, samples.gradient):
            with self.assertRaisesRegex(ValueError, r"samples were freed: call replace_values\(\) or make new Samples"):
                call()
        samples.replace_values(values)
        self.assertEqual(contents(samples.contour(0.3)), contents(surface))

    def test_values_are_replaced(self):
        positions, values = cloud()
        samples = Samples(positions, values)
        samples.contour(0.3)
        for later in (np.sin(5 * values), values.astype(np.float32), np.rint(100 * values).astype(int)):
            samples.replace_values(later)
            isovalue = float(np.median(later)) + 0.25
            self.assertEqual(contents(samples.contour(isovalue)), contents(contour(positions, later, isovalue)))
        with self.assertRaisesRegex(ValueError, r"values have the shape \(3,\)"):
            samples.replace_values(values[:3])

    def test_values_that_were_not_replaced(self):
        positions, values = cloud(100000)
        samples = Samples(positions, values)

        def fail(_):
            raise InterruptedError

        with self.assertRaises(InterruptedError):
            samples.replace_values(2 * values, progress=fail)
        self.assertEqual((np.isnan(samples.range).all(), repr(samples)), (True, "<Samples: 100000, freed>"))
        with self.assertRaisesRegex(ValueError, "call replace_values"):
            samples.contour(0.3)
        samples.replace_values(values)
        self.assertEqual(contents(samples.contour(0.3)), contents(contour(positions, values, 0.3)))

    def test_copies(self):
        samples = Samples(*cloud())
        for copied in (copy.copy, copy.deepcopy, pickle.dumps):
            with self.assertRaisesRegex(TypeError, "cannot be copied"):
                copied(samples)
        surface = samples.contour(0.3)
        for again in (copy.deepcopy(surface), pickle.loads(pickle.dumps(surface))):
            self.assertEqual(contents(again), contents(surface))
            self.assertEqual(len(again.splats()), len(surface.splats()))

    def test_two_threads_share_samples(self):
        positions, values = cloud(20000)
        samples = Samples(positions, values)
        isovalues = np.linspace(0.1, 0.6, 12)
        expected = [contents(contour(positions, values, isovalue)) for isovalue in isovalues]
        found = [None] * len(isovalues)

        def extract(first):
            for i in range(first, len(isovalues), 2):
                surface = samples.contour(isovalues[i])
                surface.splats()
                found[i] = contents(surface)

        run_together(lambda: extract(0), lambda: extract(1))
        self.assertEqual(found, expected)

    @staticmethod
    def with_call_meanwhile(samples, call, other):
        """The result of a call during which another thread begins another one, while arrays are interpolated."""
        samples._lock = lock = AnnouncedLock()

        def work():
            try:
                other(samples)
            finally:
                lock.reached.set()

        def begin_other(*arguments):
            del samples._interpolated
            thread.start()
            lock.reached.wait()
            return samples._interpolated(*arguments)

        thread, samples._interpolated = threading.Thread(target=work), begin_other
        result = call(samples)
        thread.join()
        return result

    def test_calls_take_turns(self):
        positions, values = cloud()
        lacking = np.where(positions[:, 0] < 0.5, np.nan, values)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for call, other in (
                    (lambda of: of.contour(0.4, triangles=True, capping=True),
                     lambda of: of.replace_values(2 * lacking)),
                    (lambda of: of.slice("z", arrays=values), lambda of: of.contour(0.3))):
                expected = contents(call(Samples(positions, lacking)))
                self.assertEqual(contents(self.with_call_meanwhile(Samples(positions, lacking), call, other)), expected)

    def test_memory_is_given_back(self):
        statm = pathlib.Path("/proc/self/statm")
        if sys.platform != "linux":
            self.skipTest("memory is read from /proc")
        positions, values = cloud(50000)

        def fail(fraction):
            if fraction == 1.0:
                raise StopIteration

        samples = Samples(positions, values)

        def extract():
            with contextlib.suppress(StopIteration):  # when there is a surface
                samples.contour(0.3, progress=fail, compute_gradients=True)
            contour(positions, values, 0.3, triangles=True)
            contour(positions, values, 0.3).splats()
            return int(statm.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")

        for _ in range(5):
            before = extract()
        for _ in range(15):
            after = extract()
        # One tree and surface have some 10 MB.
        self.assertLess(after - before, 30e6)


    def test_callers_die_before_their_surfaces(self):
        """What is called back is free after the call, without the garbage collector, though results live on."""
        class Caller:
            def report(self, fraction):
                self.fraction = fraction

        samples = Samples(*cloud())
        gc.disable()
        try:
            caller = Caller()
            reference = weakref.ref(caller)
            surface = samples.contour(0.3, progress=caller.report)
            splats = surface.splats(progress=caller.report)
            samples.replace_values(samples.contour(0.3).points[:1, 0].repeat(5000), progress=caller.report)
            self.assertEqual(caller.fraction, 1.0)
            del caller
            self.assertIsNone(reference())
        finally:
            gc.enable()
        self.assertGreater(len(splats), len(surface))


class Interruptions(unittest.TestCase):
    def setUp(self):
        # Processes that a shell starts in the background ignore it.
        signal.signal(signal.SIGINT, signal.default_int_handler)

    def test_progress_rises_to_one(self):
        positions, values = cloud(100000)
        for triangles in (False, True):
            fractions = []
            contour(positions, values, 0.3, triangles=triangles, progress=fractions.append)
            self.assertEqual(fractions, sorted(fractions))
            self.assertEqual(fractions[-1], 1.0)
            self.assertGreater(len(fractions), 5)
            self.assertGreaterEqual(fractions[0], 0.0)
        fractions = []
        surface = contour(positions, values, 0.3)
        surface.splats(progress=fractions.append)
        self.assertEqual((fractions, fractions[-1]), (sorted(fractions), 1.0))

    def test_progress_may_end_the_work(self):
        class Enough(Exception):
            pass

        def stop(fraction):
            if fraction > 0.2:
                raise Enough

        positions, values = cloud(100000)
        samples = Samples(positions, values)
        with self.assertRaises(Enough):
            samples.contour(0.3, progress=stop)
        with self.assertRaises(Enough):
            Samples(positions, values, progress=stop)
        self.assertEqual(contents(samples.contour(0.3)), contents(contour(positions, values, 0.3)))

    def test_progress_cannot_use_the_same_samples(self):
        samples = Samples(*cloud())
        with self.assertRaisesRegex(RuntimeError, "cannot use the samples"):
            samples.contour(0.3, progress=lambda _: samples.contour(0.2))
        other = Samples(*cloud(seed=2))
        samples.contour(0.3, progress=lambda _: other.contour(0.2))

    def test_interrupts_are_raised(self):
        positions, values = cloud(100000)
        samples = Samples(positions, values)

        def interrupt(fraction):
            if fraction > 0.2:
                signal.raise_signal(signal.SIGINT)

        for _ in range(5):
            with self.assertRaises(KeyboardInterrupt):
                samples.contour(0.3, progress=interrupt)
        surface = samples.contour(0.3)
        self.assertGreater(len(surface), 1000)
        with self.assertRaises(KeyboardInterrupt):
            surface.splats(progress=lambda _: signal.raise_signal(signal.SIGINT))
        # Handlers of signals run within the call, where it asks whether to end.
        with mock.patch.object(_library.Callbacks, "_is_over", side_effect=KeyboardInterrupt):
            with self.assertRaises(KeyboardInterrupt):
                surface.splats()
        both = samples, Samples(positions)
        with mock.patch.object(_library.Callbacks, "_is_over", side_effect=KeyboardInterrupt):
            for each in both:
                with self.assertRaises(KeyboardInterrupt):
                    each.body()
        for each in both:
            self.assertEqual(each.probe(positions[:2], arrays=values).shape, (2,))

    def test_arrays_can_be_canceled(self):
        """Those of the points, and those at the vertices of splats."""
        positions, values = cloud(20000)
        samples = Samples(positions, values)
        surface = samples.contour(0.3)
        for name, call in (
                ("interpolate", lambda is_over: samples._extract(
                    0.3, False, {"positions": positions}, {}, is_canceled=is_over)),
                ("average_at_splat_vertices", lambda is_over: surface._splats(is_canceled=is_over))):
            calls = []

            def begin(*arguments, function=getattr(_library, name), calls=calls):
                calls.append(1)
                return function(*arguments)

            with self.subTest(name), mock.patch.object(_library, name, begin):
                with self.assertRaises(InterruptedError):
                    call(lambda calls=calls: bool(calls))

    def test_signals_and_the_end_of_the_interpreter(self):
        none = r"\A\Z"
        begin = (
            "import numpy, os, signal, threading, time\n"
            "from scatteredisopoints import contour\n"
            "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
            "positions = numpy.random.default_rng(1).random((200000, 3))\n"
            "values = positions.sum(axis=1)\n"
            "interrupt = threading.Timer(0.2, signal.raise_signal, (signal.SIGINT,))\n")
        for name, before, script, output, errors in (
                ("all handlers of signals may raise", "", (
                    "def end(*_): raise TimeoutError\n"
                    "signal.signal(signal.SIGALRM, end)\n"
                    "for _ in range(10):\n"
                    "    signal.setitimer(signal.ITIMER_REAL, 0.05)\n"
                    "    try:\n"
                    "        for _ in range(99): contour(positions, values, 1.5, triangles=True)\n"
                    "    except TimeoutError: print('raised')\n"), 10 * "raised\n", none),
                ("handlers of signals may go on", "", (
                    "noted = []\n"
                    "signal.signal(signal.SIGINT, lambda *_: noted.append(1))\n"
                    "interrupt.start()\n"
                    "for _ in range(99):\n"
                    "    surface = contour(positions, values, 1.5, triangles=True)\n"
                    "    if noted: break\n"
                    "print(noted and len(surface) > 1000)\n"), "True\n", none),
                ("interrupts from outside end a script", "", (
                    "interrupt.start()\n"
                    "for _ in range(99): contour(positions, values, 1.5, triangles=True)\n"), "",
                 r"\A(?s:(?!.*Exception ignored).*)KeyboardInterrupt\n\Z"),
                # A daemon thread ends silently, although it catches exceptions and has time to go on.
                ("the interpreter may end in a call", "import atexit, time; atexit.register(time.sleep, 0.5)\n", (
                    "def work():\n"
                    "    while True:\n"
                    "        try: contour(positions, values, 1.5, triangles=True)\n"
                    "        except Exception as error: print(repr(error))\n"
                    "threading.Thread(target=work, daemon=True).start()\n"
                    "time.sleep(0.3)\n"), "", none),
                ("calls when the interpreter ends", (
                    "import atexit\n"
                    "atexit.register(lambda: print(len(contour(positions, values, 1.5)) > 1000))\n"),
                 "", "True\n", none)):
            with self.subTest(name):
                if "SIGALRM" in script and not hasattr(signal, "SIGALRM"):
                    self.skipTest("there is no such signal")
                result = subprocess.run([sys.executable, "-c", before + begin + script], capture_output=True, text=True)
                self.assertEqual(result.stdout, output)
                self.assertRegex(result.stderr, errors)
                self.assertEqual(result.returncode == 0, errors == none)

    @unittest.skipUnless(hasattr(os, "fork"), "there is no fork()")
    def test_forked_children(self):
        positions, values = cloud(50000)
        samples = Samples(positions, values)
        expected = contents(samples.contour(0.3)), contents(samples.contour(0.3, triangles=True))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # of fork() in a process with threads
            child = os.fork()
        if child == 0:
            signal.alarm(120)  # a child that waits is a failure
            found = contents(samples.contour(0.3)), contents(samples.contour(0.3, triangles=True))
            again = contents(contour(positions, values, 0.3, triangles=True))
            os._exit(0 if (found, again) == (expected, expected[1]) else 1)
        _, status = os.waitpid(child, 0)
        self.assertEqual(status, 0)
        self.assertEqual(contents(samples.contour(0.3)), expected[0])

    @unittest.skipUnless(hasattr(os, "fork"), "there is no fork()")
    def test_children_forked_during_a_call(self):
        positions, values = cloud(50000)
        samples = Samples(positions, values)
        surface = samples.contour(0.3)
        is_inside, may_go_on = threading.Event(), threading.Event()

        def wait(_):
            is_inside.set()
            may_go_on.wait()

        thread = threading.Thread(target=lambda: samples.contour(0.3, progress=wait))
        thread.start()
        is_inside.wait()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)
            child = os.fork()
        if child == 0:
            signal.alarm(60)
            refused = 0
            for call in (lambda: samples.contour(0.3), lambda: contour(positions, values, 0.3), surface.splats):
                with contextlib.suppress(ValueError):
                    call()
                    continue
                refused += 1
            del samples, surface
            _library._Calls.changed.wait_for = lambda is_over, timeout: is_over() or os._exit(2)
            _library._end_calls()
            os._exit(0 if refused == 3 else 1)
        _, status = os.waitpid(child, 0)
        may_go_on.set()
        thread.join()
        self.assertEqual(status, 0)


class Imports(unittest.TestCase):
    def test_import_loads_no_other_package(self):
        script = ("import sys, numpy; before = set(sys.modules); import scatteredisopoints\n"
                  "print(*{name.split('.')[0] for name in set(sys.modules) - before})")
        result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
        loaded = set(result.stdout.split()) - set(sys.stdlib_module_names if sys.version_info >= (3, 10) else ())
        self.assertFalse(loaded & {"vtkmodules", "vtk", "pyvista", "cvista", "tqdm", "rich"})

    def test_shared_libraries_that_are_missing(self):
        """The remedy is for what the loader names."""
        own = os.path.basename(_library.LIBRARY)
        again = "Install this package again, for this system"
        for text, remedy in (
                ("libtbb.so.12: cannot open shared object file: No such file or directory", "has libtbb.so.12, "),
                (f"Error loading shared library libgmp.so.10: No such file or directory (needed by /a/{own})",
                 "has libgmp.so.10, "),
                (f"dlopen(/a/{own}, 0x0006): Library not loaded: @rpath/libtbb.12.dylib\n  Referenced from: /a/{own}",
                 "has libtbb.12.dylib, "),
                (f"/a/{own}: cannot open shared object file: No such file or directory", again),
                (f"/a/{own}: invalid ELF header", again),
                (f"/lib/libc.so.6: version `GLIBC_2.38' not found (required by /a/{own})", again)):
            script = (f"import ctypes\ndef load(path): raise OSError({text!r})\nctypes.CDLL = load\n"
                      "import scatteredisopoints")
            result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
            self.assertIn(f"ImportError: The C library cannot be loaded: {text}. ", result.stderr)
            self.assertRegex(result.stderr, remedy)
            self.assertEqual(again in result.stderr, remedy == again)

    def test_names(self):
        self.assertRegex(scatteredisopoints.__version__, r"^\d+\.\d+\.\d+$")
        names = set(scatteredisopoints.__all__)
        self.assertLessEqual({"contour", "probe", "gradient", "slice_samples", "Samples", "Interpolator", "Isosurface",
                              "load_plugin"}, names)
        self.assertLessEqual(names, set(dir(scatteredisopoints)))
        imported = {}
        exec("from scatteredisopoints import *", imported)
        self.assertLessEqual(names, set(imported))
        for name in ("nothing", "vtkNothing"):
            with self.assertRaisesRegex(AttributeError, f"no attribute '{name}'"):
                getattr(scatteredisopoints, name)

    def test_names_that_are_missing_say_what_they_need(self):
        has_vtk = importlib.util.find_spec("vtkmodules") is not None
        for name in set(scatteredisopoints._MODULES) - set(scatteredisopoints.__all__):
            is_in_python = not has_vtk and name in (
                "vtkIsopointSplatPolygons", *(f"vtkScattered{kind}Filter" for kind in (
                    "Body", "Gradient", "Grid", "Isopoint", "Isosurface", "Line", "Probe", "Slice")))
            text = f"{name} needs " + ("VTK: pip install vtk$" if is_in_python else "classes that are compiled")
            with self.assertRaisesRegex(ImportError, text):
                exec(f"from scatteredisopoints import {name}")
            with self.assertRaises(ImportError) as caught:
                exec(f"from scatteredisopoints import {name}")
            self.assertNotIn("docs/", str(caught.exception))  # which the wheel lacks
            with self.assertRaisesRegex(AttributeError, text):
                getattr(scatteredisopoints, name)
            self.assertFalse(hasattr(scatteredisopoints, name))


class AnnouncedLock:
    """A lock that sets an event when a thread has to wait for it."""

    def __init__(self):
        self._lock, self.reached = threading.RLock(), threading.Event()

    def __enter__(self):
        if not self._lock.acquire(blocking=False):
            self.reached.set()
            self._lock.acquire()

    def __exit__(self, *_):
        self._lock.release()


def run_together(*functions):
    """Runs functions on a thread each; raises what one raised."""
    errors = []

    def run(function):
        try:
            function()
        except BaseException as error:
            errors.append(error)

    threads = [threading.Thread(target=run, args=(function,)) for function in functions]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if errors:
        raise errors[0]


if __name__ == "__main__":
    unittest.main()
