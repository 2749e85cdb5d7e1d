# SPDX-License-Identifier: GPL-3.0-or-later
"""Values and gradients at places, with NumPy alone."""

import contextlib
import os
import signal
import unittest
import warnings

import numpy as np
from scatteredisopoints import Samples, body, contour, gradient, probe, slice_samples

RANDOM = np.random.default_rng(1)
POSITIONS = RANDOM.uniform(-1, 1, (6000, 3))
# A few places among random samples count as outside.
PLACES = RANDOM.uniform(-0.8, 0.8, (310, 3))
PLACES = PLACES[np.isfinite(probe(POSITIONS, POSITIONS[:, 0], PLACES, method="AFFINE"))][:300]
DEGREES = {"BLEND": 1, "AFFINE": 1, "QUADRATIC": 2, "CUBIC": 3}


def polynomial(degree, places):
    """A polynomial with two components, and its gradients, of shapes (n, 2) and (n, 2, 3)."""
    x, y, z = places.T
    one, zero = np.ones_like(x), np.zeros_like(x)
    values, gradients = [x - 2 * y + 3 * z + 4, z], [[one, -2 * one, 3 * one], [zero, zero, one]]
    if degree > 1:
        values, gradients = [values[0], x * y + z**2], [gradients[0], [y, x, 2 * z]]
    if degree > 2:
        values, gradients = [values[1], x * y * z - y**3], [gradients[1], [y * z, x * z - 3 * y**2, x * y]]
    return np.stack(values, axis=-1), np.moveaxis(np.array(gradients), -1, 0)


class Values(unittest.TestCase):
    def test_polynomials_are_exact(self):
        for method, degree in DEGREES.items():
            for kind in (np.float32, np.float64):
                positions = POSITIONS.astype(kind)
                values, gradients = probe(
                    positions, polynomial(degree, positions.astype(float))[0], PLACES, method=method, gradient=True)
                expected = polynomial(degree, PLACES)
                np.testing.assert_allclose(values, expected[0], atol=1e-11)
                np.testing.assert_allclose(gradients, expected[1], atol=1e-9)

    def test_a_smooth_field_and_vectors_that_turn(self):
        def field(places):
            return np.sin(2 * places) + places[:, [1, 2, 0]] ** 2

        found, gradients = probe(POSITIONS, field(POSITIONS), PLACES, gradient=True)
        np.testing.assert_allclose(found, field(PLACES), atol=5e-3)
        step = 1e-6 * np.eye(3)
        expected = np.stack([(field(PLACES + each) - field(PLACES - each)) / 2e-6 for each in step], axis=-1)
        np.testing.assert_allclose(gradients, expected, atol=0.1)
        turn = np.linalg.qr(RANDOM.normal(size=(3, 3)))[0]
        turned = probe(POSITIONS, field(POSITIONS) @ turn, PLACES)
        np.testing.assert_allclose(turned, found @ turn, atol=1e-10)

    def test_the_nearest_sample(self):
        nearest = np.linalg.norm(PLACES[:, None] - POSITIONS, axis=-1).argmin(axis=1)
        for kind in ("f4", "i1", "u8", ">i4"):
            array = RANDOM.integers(0, 99, (len(POSITIONS), 2)).astype(kind)
            found = probe(POSITIONS, array, PLACES, method="nearest")
            self.assertEqual(found.dtype, array.dtype.newbyteorder("="))
            np.testing.assert_array_equal(found, array[nearest])
        masked = [np.ma.masked_equal(np.arange(len(POSITIONS), dtype=kind), 0) for kind in ("i2", "i4")]
        for array, expected in ((array > 9, "u1"), (array.astype("f2"), "f4"), (array.astype("g"), "f8"),
                                (masked[0], "f4"), (masked[1], "f8")):
            with self.subTest(expected), warnings.catch_warnings():
                warnings.simplefilter("ignore")  # of the masked entry
                self.assertEqual(probe(POSITIONS, array, PLACES, method="NEAREST").dtype, expected)

    def test_arrays_that_take_the_nearest_value(self):
        nearest = np.linalg.norm(PLACES[:, None] - POSITIONS, axis=-1).argmin(axis=1)
        material = RANDOM.integers(0, 99, len(POSITIONS))
        arrays = {"x": POSITIONS[:, 0], "material": material}
        values, gradients = probe(POSITIONS, arrays, PLACES, gradient=True, nearest_arrays=["material"])
        self.assertEqual(values["material"].dtype, material.dtype)
        np.testing.assert_array_equal(values["material"], material[nearest])
        np.testing.assert_array_equal(gradients["material"], np.zeros((len(PLACES), 3)))
        alone = probe(POSITIONS, arrays["x"], PLACES, gradient=True)
        self.assertEqual((values["x"].tobytes(), gradients["x"].tobytes()), tuple(each.tobytes() for each in alone))
        samples = Samples(POSITIONS, material)
        np.testing.assert_array_equal(samples.probe(PLACES, nearest_arrays="values"), material[nearest])
        with self.assertRaisesRegex(ValueError, "nearest_arrays cannot have 'materials': did you mean material?"):
            probe(POSITIONS, arrays, PLACES, nearest_arrays=["materials"])
        texts = {**arrays, "words": np.full(len(POSITIONS), "word")}
        for given, listed, error, text in (
                (arrays, 5, TypeError, "nearest_arrays cannot be 5: give names of arrays"),
                (texts, "words", ValueError, "nearest_arrays cannot have 'words': the array holds no numbers"),
                (None, ["material"], ValueError, "nearest_arrays cannot have 'material': there are no arrays")):
            with self.assertRaisesRegex(error, text):
                slice_samples(POSITIONS, "x", arrays=given, nearest_arrays=listed)
            if given:
                with self.assertRaisesRegex(error, text):
                    probe(POSITIONS, given, PLACES, nearest_arrays=listed)

    def test_integers_stay_within_the_range_of_the_samples(self):
        """By all methods, also where fits of the same numbers would leave it."""
        numbers = np.rint(100 * np.sign(POSITIONS - 0.5) * np.abs(POSITIONS - 0.5)**0.1)
        is_beyond = False
        for method in ("blend", "cubic", "quadratic", "affine"):
            free = probe(POSITIONS, numbers[:, :2], PLACES, method=method, outside=None)
            for kind in ("i1", "i2", "i4", "i8"):
                found = probe(POSITIONS, numbers[:, :2].astype(kind), PLACES, method=method, outside=None)
                self.assertEqual(found.dtype, float)
                least, greatest = numbers[:, :2].min(axis=0), numbers[:, :2].max(axis=0)
                self.assertTrue((found >= least).all() and (found <= greatest).all())
                if method != "blend":  # whose weights know of the rounding
                    np.testing.assert_array_equal(found, free.clip(least, greatest))
            is_beyond |= bool((free < least).any() or (free > greatest).any())
        self.assertTrue(is_beyond)

    def test_shapes_and_types(self):
        count, places = len(POSITIONS), len(PLACES)
        for shape in ((), (1,), (4,), (3, 3)):
            array = RANDOM.integers(0, 9, (count, *shape))
            values, gradients = probe(POSITIONS, array, PLACES, gradient=True)
            self.assertEqual((values.shape, gradients.shape), ((places, *shape), (places, *shape, 3)))
            self.assertEqual((values.dtype, gradients.dtype), (float, float))
            np.testing.assert_array_equal(gradient(POSITIONS, array)[:5], probe(
                POSITIONS, array, POSITIONS[:5], gradient=True)[1])
            self.assertEqual(probe(POSITIONS, array, PLACES[:0]).shape, (0, *shape))
        arrays = {"a": POSITIONS[:, 0], "b": POSITIONS}
        values, gradients = probe(POSITIONS, arrays, PLACES, gradient=True)
        for name, array in arrays.items():
            np.testing.assert_array_equal(values[name], probe(POSITIONS, array, PLACES))
            np.testing.assert_array_equal(gradient(POSITIONS, arrays)[name], gradient(POSITIONS, array))
        self.assertEqual(list(gradients), ["a", "b"])
        self.assertEqual(probe(POSITIONS, {}, PLACES), {})

    def test_places_of_all_shapes(self):
        """As those of interpolators: the last axis has the coordinates. No places have any shape."""
        for array in (POSITIONS[:, 0], POSITIONS):
            expected = probe(POSITIONS, array, PLACES[:6], gradient=True)
            function = Samples(POSITIONS, array[:, 0] if array.ndim > 1 else array).interpolator(array)
            for places, shape in ((PLACES[:6].reshape(2, 3, 3), (2, 3)), (PLACES[0], ()), (PLACES[0].tolist(), ()),
                                  ([], (0,)), (PLACES[:0], (0,)), (PLACES[:0].reshape(2, 0, 3), (2, 0))):
                found = probe(POSITIONS, {"a": array}, places, gradient=True)
                for each, of_all, call in zip(found, expected, (function, function.gradient)):
                    of_some = of_all[:each["a"].size // of_all[0].size].reshape(shape + of_all.shape[1:])
                    self.assertEqual(each["a"].shape, of_some.shape)
                    np.testing.assert_array_equal(each["a"], of_some)
                    np.testing.assert_array_equal(call(places), of_some)

    def test_text_is_left_out(self):
        """With a warning: columns of tables go in as they are."""
        words = np.array(["word"] * len(POSITIONS))
        text = '^Left out are "words", "objects", "times": they hold no numbers.$'
        arrays = {"words": words, "x": POSITIONS[:, 0], "objects": words.astype(object),
                  "times": np.zeros(len(POSITIONS), "M8[s]")}
        for call in (lambda: probe(POSITIONS, arrays, PLACES), lambda: body(POSITIONS, arrays=arrays).arrays,
                     lambda: slice_samples(POSITIONS, arrays=arrays).arrays,
                     lambda: contour(POSITIONS, arrays["x"], 0.5, arrays=arrays, compute_scalars=False,
                                     compute_normals=False, compute_splats=False).arrays):
            with self.assertWarnsRegex(RuntimeWarning, text) as caught:
                found = call()
            self.assertEqual((list(found), caught.filename), (["x"], __file__))
        with self.assertRaisesRegex(TypeError, "objects are of the type object, not real numbers"):
            probe(POSITIONS, {"objects": np.full(len(POSITIONS), None)}, PLACES)

    def test_layouts_make_no_difference(self):
        array = np.sin(POSITIONS)
        expected = probe(POSITIONS, array, PLACES)
        read_only = array.copy()
        read_only.flags.writeable = False
        for positions, values, places in (
                (np.asfortranarray(POSITIONS), np.asfortranarray(array), np.asfortranarray(PLACES)),
                (POSITIONS, np.repeat(array, 2, axis=1)[:, ::2], np.repeat(PLACES, 2, axis=0)[::2]),
                (POSITIONS.astype(">f8"), array.astype(np.longdouble), PLACES.astype(">f8")),
                (POSITIONS.tolist(), read_only, PLACES.tolist()),
                (POSITIONS, array[:, ::-1].copy()[:, ::-1], PLACES[::-1].copy()[::-1])):
            np.testing.assert_array_equal(probe(positions, values, places), expected)
        for threads in (1, 3):
            np.testing.assert_array_equal(probe(POSITIONS, array, PLACES, threads=threads), expected)


class Outside(unittest.TestCase):
    def test_places_outside(self):
        values, far = POSITIONS @ [1, 2, 3], [[0.1, 0.2, 0.3], [9, 9, 9], [np.nan, 0, 0]]
        for outside, expected in ((np.nan, np.nan), (-5, -5), ("nearest", values[POSITIONS.sum(axis=1).argmax()]),
                                  (None, 54)):
            found, gradients = probe(POSITIONS, values, far, outside=outside, gradient=True)
            np.testing.assert_allclose(found[:2], [1.4, expected], atol=1e-9)
            self.assertEqual(np.isnan(gradients[1]).all(), outside not in ("nearest", None))
        self.assertTrue(np.isfinite(probe(POSITIONS, values, POSITIONS)).all())
        self.assertEqual(probe(POSITIONS, np.arange(len(POSITIONS)), far, method="NEAREST")[1], 0)

    def test_values_that_are_missing(self):
        values, is_there = np.sin(POSITIONS[:, 0]), np.arange(len(POSITIONS)) % 3 > 0
        expected = probe(POSITIONS[is_there], values[is_there], PLACES)
        for lacking in (np.where(is_there, values, np.nan), np.ma.masked_array(values, ~is_there)):
            with self.assertWarnsRegex(RuntimeWarning, '^2000 of 6000 entries of "lacking" are masked') as caught:
                found = probe(POSITIONS, {"lacking": lacking, "all": values}, PLACES)
            self.assertEqual((len(caught.warnings), caught.filename), (1, __file__))
            with self.assertWarnsRegex(RuntimeWarning, "2000 of 6000 entries") as caught:
                function = Samples(POSITIONS).interpolator(lacking)
            self.assertEqual(caught.filename, __file__)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                np.testing.assert_array_equal(function(PLACES), found["lacking"])
            np.testing.assert_allclose(found["lacking"], np.sin(PLACES[:, 0]), atol=1e-3)
            np.testing.assert_array_equal(found["all"], probe(POSITIONS, values, PLACES))
        samples = Samples(POSITIONS, lacking)
        with self.assertWarnsRegex(RuntimeWarning, "2000 of 6000 samples are left out") as caught:
            np.testing.assert_allclose(samples.probe(PLACES), expected, atol=1e-12)
        self.assertEqual((len(caught.warnings), caught.filename), (1, __file__))

    def test_samples_in_a_plane(self):
        flat = POSITIONS * [1, 1, 0]
        with self.assertWarnsRegex(RuntimeWarning, "At 300 of 300 places .* in a plane") as caught:
            values, gradients = probe(flat, flat @ [1, 2, 3], PLACES, gradient=True, outside=None)
        self.assertEqual(caught.filename, __file__)
        np.testing.assert_allclose(values, PLACES @ [1, 2, 0], atol=1e-12)
        np.testing.assert_allclose(gradients, np.tile([1, 2, 0], (300, 1)), atol=1e-10)
        with self.assertWarnsRegex(RuntimeWarning, "At 6000 of 6000 places") as caught:
            np.testing.assert_allclose(gradient(flat, flat @ [1, 2, 3]), np.tile([1, 2, 0], (6000, 1)), atol=1e-6)
        self.assertEqual(caught.filename, __file__)
        with self.assertWarns(RuntimeWarning):
            self.assertEqual(probe([[1, 2, 3]], [7], [[1, 2, 3]]), 7)
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # there is nothing to say about places outside
            self.assertTrue(np.isnan(probe(flat, flat, [[9, 9, 9]])).all())
        with self.assertWarnsRegex(RuntimeWarning, "At 1 of 2 places"):
            probe(flat, flat, [[9, 9, 9], flat[0]], outside="nearest")


class KeptSamples(unittest.TestCase):
    def test_samples_with_and_without_values(self):
        values = np.linalg.norm(POSITIONS, axis=1)
        expected, surface = probe(POSITIONS, values, PLACES), contour(POSITIONS, values, 0.5)
        samples = Samples(POSITIONS)
        self.assertEqual(repr(samples), "<Samples: 6000, without values>")
        np.testing.assert_array_equal(samples.probe(PLACES, arrays=values), expected)
        with self.assertRaisesRegex(TypeError, "without values"):
            samples.probe(PLACES)
        with self.assertRaisesRegex(ValueError, "without values: call replace_values"):
            samples.contour(0.5)
        samples.replace_values(values)
        for _ in range(2):
            np.testing.assert_array_equal(samples.probe(PLACES), expected)
            np.testing.assert_array_equal(samples.gradient(), gradient(POSITIONS, values))
            self.assertEqual(samples.contour(0.5).points.tobytes(), surface.points.tobytes())
        samples.contour(0.5, keep_tree=False)
        for arrays in (None, values):
            with self.assertRaisesRegex(ValueError, "were freed: call replace_values"):
                samples.probe(PLACES, arrays=arrays)

    def test_interpolators(self):
        samples = Samples(POSITIONS, POSITIONS @ [1, 2, 3])
        x, y, z = grid = np.meshgrid([0.1, 0.2], [0.3], [0.1, 0.2, 0.4], indexing="ij")
        plane, place = samples.interpolator(), samples.interpolator(POSITIONS, method="CUBIC", outside=0)
        self.assertEqual(repr(plane), "<Interpolator: \"values\" of 6000 samples, method 'blend'>")
        np.testing.assert_allclose(plane(*grid), x + 2 * y + 3 * z)
        np.testing.assert_allclose(plane(0.1, 0.2, [0.3, 0.4]), [1.4, 1.7])
        np.testing.assert_allclose(plane.gradient([0.1, 0.2, 0.3]), [1, 2, 3])
        self.assertEqual((plane([0.1, 0.2, 0.3]).shape, place(0.1, 0.2, 0.3).shape), ((), (3,)))
        np.testing.assert_allclose(place(np.stack(grid, axis=-1)), np.stack(grid, axis=-1))
        self.assertEqual(place.gradient(np.zeros((2, 5, 3))).shape, (2, 5, 3, 3))
        self.assertEqual(place([9, 9, 9]).tolist(), [0, 0, 0])
        masked = np.ma.masked_greater([0.1, 0.9], 0.5)
        for places in ((0.1, 0.2, masked), (np.ma.stack([masked, masked, masked], axis=-1),)):
            self.assertEqual(np.isnan(plane(*places)).tolist(), [False, True])
        for places, error, text in (((np.zeros((5, 2)),), ValueError, r"\(5, 2\), not \(..., 3\)"),
                                    ((), TypeError, "places, .* or x, y and z: not 0 arg"),
                                    ((1, 2), TypeError, "or x, y and z: not 2 arguments"),
                                    (("here",), TypeError, "not real numbers")):
            with self.subTest(text), self.assertRaisesRegex(error, text):
                plane(*places)
        for arguments, error in ((dict(array={"a": POSITIONS}), TypeError), (dict(method="LINEAR"), ValueError),
                                 (dict(array="T"), ValueError)):
            with self.assertRaises(error):
                samples.interpolator(**arguments)


class Calls(unittest.TestCase):
    def test_wrong_arguments(self):
        values = POSITIONS[:, 0]
        for arguments, error, text in (
                ((POSITIONS, values, PLACES[:, :2]), ValueError, r"places.*\(300, 2\).*zeros"),
                ((POSITIONS, values, PLACES[0, :2]), ValueError, r"places.*\(2,\), not \(..., 3\)"),
                ((POSITIONS, values[:9], PLACES), ValueError, r"values.*\(9,\).*6000"),
                ((POSITIONS, {"a": values, "b": values[:9]}, PLACES), ValueError, r"b have.*\(9,\)"),
                ((POSITIONS, None, PLACES), TypeError, "values are missing"),
                ((POSITIONS, values, None), TypeError, "places cannot be None: give numbers"),
                ((POSITIONS, 7 * [None], PLACES), TypeError, "values are of the type object"),
                ((POSITIONS, [], PLACES), ValueError, r"\(0,\)"),
                ((POSITIONS, [values, values], PLACES), ValueError, r"\(2, 6000\), .*give several arrays as a mapping"),
                ((POSITIONS, np.array(["T", "p"]), PLACES), ValueError, 'no array "T"'),
                ((POSITIONS, "T", PLACES), ValueError, '"T": give its numbers'),
                ((POSITIONS, 1j * values, PLACES), TypeError, "complex"),
                ((POSITIONS[:0], values[:0], PLACES), ValueError, "no samples")):
            with self.subTest(text), self.assertRaisesRegex(error, text):
                probe(*arguments)
        for options, text in (
                *((dict(method=wrong), f"^method cannot be {wrong!r}: it is \"blend\", \"cubic\",.* or \"nearest\"$")
                  for wrong in ("CUBIG", None, 9)),
                (dict(outside="far"), '"nearest", or None'), (dict(outside=True), "a number"),
                (dict(outside=10**400), "outside is out of range: .*1.8e308"),
                (dict(threads=0), "threads"), (dict(gradient="yes"), "True or False"),
                (dict(method="NEAREST", gradient=True), "no gradients")):
            with self.subTest(text), self.assertRaisesRegex(ValueError, text):
                probe(POSITIONS, values, PLACES, **options)

    def test_progress_and_interrupts(self):
        signal.signal(signal.SIGINT, signal.default_int_handler)
        places = RANDOM.uniform(-1, 1, (30000, 3))
        for call in (lambda progress: probe(POSITIONS, POSITIONS, places, progress=progress),
                     lambda progress: Samples(POSITIONS).probe(places, arrays=POSITIONS, progress=progress)):
            fractions = []
            call(fractions.append)
            self.assertEqual((fractions, fractions[-1]), (sorted(fractions), 1))
            self.assertGreater(len(fractions), 3)
            with self.assertRaises(KeyboardInterrupt):
                call(lambda fraction: fraction > 0.3 and signal.raise_signal(signal.SIGINT))
            with self.assertRaises(ZeroDivisionError):
                call(lambda fraction: fraction > 0.3 and 1 / 0)
        samples = Samples(POSITIONS)
        with self.assertRaisesRegex(RuntimeError, "cannot use the samples"):
            samples.probe(places, arrays=POSITIONS, progress=lambda _: samples.probe(PLACES, arrays=POSITIONS))

    @unittest.skipUnless(hasattr(os, "fork"), "there is no fork()")
    def test_forked_children(self):
        samples = Samples(POSITIONS)
        expected = samples.probe(PLACES, arrays=POSITIONS)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # of fork() in a process with threads
            child = os.fork()
        if child == 0:
            signal.alarm(60)  # a child that waits is a failure
            with contextlib.suppress(BaseException):
                os._exit(0 if np.array_equal(samples.probe(PLACES, arrays=POSITIONS), expected) else 1)
            os._exit(2)
        self.assertEqual(os.waitpid(child, 0)[1], 0)


if __name__ == "__main__":
    unittest.main()
