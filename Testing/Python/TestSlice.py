# SPDX-License-Identifier: GPL-3.0-or-later
"""Slices of samples, with NumPy alone."""

import unittest
import warnings
from unittest import mock

import numpy as np
from scatteredisopoints import Samples, _library, contour, slice_samples
from scatteredisopoints._cuts import rounded

RANDOM = np.random.default_rng(1)
POSITIONS = RANDOM.random((20000, 3))


def wave(places):
    return np.sin(4 * places[:, 0]) * places[:, 1] + places[:, 2] ** 2


def ball(places):
    return np.linalg.norm(places - 0.5, axis=1) - 0.3


def area(surface):
    a, b, c = (surface.points[surface.triangles[:, i]] for i in range(3))
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()


def rim(surface):
    """The edges with one triangle, shape (n, 2, 3)."""
    edges = np.sort(surface.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, counts = np.unique(edges, axis=0, return_counts=True)
    return surface.points[edges[counts == 1]]


def distances_to(segments, places):
    begins, ways = segments[:, 0], segments[:, 1] - segments[:, 0]
    offsets = places[:, None] - begins
    shares = np.clip((offsets * ways).sum(axis=2) / (ways**2).sum(axis=1), 0, 1)
    return np.linalg.norm(offsets - shares[..., None] * ways, axis=2).min(axis=1)


class Values(unittest.TestCase):
    def test_fits_are_closer_than_lines(self):
        arrays = {"wave": wave(POSITIONS), "place": POSITIONS, "tensor": POSITIONS[:, [0, 1, 2, 0]].reshape(-1, 2, 2)}
        fits, lines = (slice_samples(POSITIONS, "y", arrays=arrays, interpolation=each) for each in ("fits", "linear"))
        self.assertEqual(fits.points.tobytes(), lines.points.tobytes())
        error, linear = (np.abs(each.arrays["wave"] - wave(each.points)) for each in (fits, lines))
        self.assertLess(100 * error.mean(), linear.mean())
        self.assertLess(error.max(), 0.01)  # at rims, too
        for surface in (fits, lines):
            np.testing.assert_allclose(surface.arrays["place"], surface.points, atol=1e-12)
            np.testing.assert_allclose(surface.arrays["tensor"].reshape(-1, 4)[:, :3], surface.points, atol=1e-12)
            np.testing.assert_allclose(surface.points[:, 1], np.ptp(POSITIONS[:, 1]) / 2 + POSITIONS[:, 1].min())

    def test_types_and_values_that_are_missing(self):
        lacking = np.where(RANDOM.random(20000) < 0.1, np.nan, wave(POSITIONS)).astype(np.float32)
        with self.assertWarnsRegex(RuntimeWarning, '"masked" is not finite at [0-9]+ of [0-9]+ points'):
            sliced = slice_samples(POSITIONS.astype(np.float32), "z", arrays={
                "lacking": lacking, "byte": np.rint(255 * POSITIONS[:, 2]).astype(np.uint8),
                "masked": np.ma.masked_less(POSITIONS[:, 0], 0.4),
                "short": np.ma.masked_less(np.arange(20000, dtype=np.int16), 9),
                "long": np.ma.masked_less(np.arange(20000), 9)})
        found = sliced.arrays
        self.assertEqual([sliced.points.dtype, *(each.dtype for each in found.values())],
                         [np.float32, np.float32, np.uint8, float, np.float32, float])
        np.testing.assert_allclose(found["lacking"], wave(sliced.points), atol=0.02)
        np.testing.assert_allclose(found["byte"], 127.5, atol=1.6)
        for dtype in (np.int8, np.uint16, np.int64, np.uint64):
            least, most = np.iinfo(dtype).min, np.iinfo(dtype).max
            self.assertEqual(rounded(np.array([-1e30, 1.6, 1e30]), np.dtype(dtype)).tolist(), [least, 2, most])
        halves = np.array([-2.5, -0.5, 0.49999999999999994, 0.5, 2.5])  # as C rounds
        self.assertEqual(rounded(halves, np.dtype(int)).tolist(), [-3, -1, 0, 1, 3])

    def test_functions_that_are_no_planes(self):
        for regularize in (True, False):
            for interpolation, atol in (("fits", 2e-3), ("linear", 0.03)):
                sliced = slice_samples(POSITIONS, arrays={"wave": wave(POSITIONS), "place": POSITIONS}, function=ball,
                                       offsets=[0, 0.1], interpolation=interpolation, regularize=regularize)
                distances = ball(sliced.points)
                np.testing.assert_allclose(np.minimum(abs(distances), abs(distances - 0.1)), 0, atol=1e-14)
                np.testing.assert_allclose(sliced.arrays["place"], sliced.points, atol=1e-12)
                np.testing.assert_allclose(sliced.arrays["wave"], wave(sliced.points), atol=atol)
        box = slice_samples(POSITIONS, function=lambda places: np.abs(places - 0.5).max(axis=1) - 0.3)  # has edges
        np.testing.assert_allclose(np.abs(box.points - 0.5).max(axis=1), 0.3, atol=1e-14)
        self.assertAlmostEqual(area(box), 6 * 0.36, delta=0.1)


class Rims(unittest.TestCase):
    def test_a_full_block_has_a_clean_rim(self):
        for seed in (1, 2, 3):  # the second has an edge that is strong, but for its middle
            positions = np.random.default_rng(seed).random((200000, 3))
            for axis, at in (("x", 0.5), ("z", 0.3)):
                sliced = slice_samples(positions, axis, [at] * 3)
                hull = slice_samples(positions, axis, [at] * 3, drop_gaps=False, regularize=False)
                self.assertAlmostEqual(area(sliced) / area(hull), 1, delta=0.01)
                self.assertLess(distances_to(rim(hull), rim(sliced)[:, 0]).max(), 0.05 * 200000 ** (-1 / 3))

    def test_voids_are_left_out(self):
        positions = POSITIONS[ball(POSITIONS) > -0.05]
        sliced = slice_samples(positions, "z", [0.5] * 3)
        self.assertAlmostEqual(area(sliced), 1 - np.pi * 0.25**2, delta=0.03)
        self.assertAlmostEqual(area(slice_samples(positions, "z", [0.5] * 3, drop_gaps=False)), 1, delta=0.01)


class KeptSamples(unittest.TestCase):
    def test_offsets_of_a_plane_load_no_more(self):
        values = wave(POSITIONS)
        surface = contour(POSITIONS, values, 0.7)
        expected = [slice_samples(POSITIONS, (1, 2, 3), (0.5, 0.5, at), arrays=values) for at in (0.5, 0.4)]
        samples = Samples(POSITIONS, values)
        with mock.patch.object(_library, "set_samples", side_effect=_library.set_samples) as load:
            for at, each in zip((0.5, 0.4), expected):
                sliced = samples.slice((2, 4, 6), (0.5, 0.5, at))
                for name in ("points", "triangles"):
                    self.assertEqual(getattr(sliced, name).tobytes(), getattr(each, name).tobytes())
                self.assertEqual(sliced.arrays["values"].tobytes(), each.arrays["values"].tobytes())
            self.assertEqual(load.call_count, 1)
            self.assertEqual(samples.contour(0.7).points.tobytes(), surface.points.tobytes())
            self.assertEqual(load.call_count, 2)
        self.assertEqual(samples.range, (values.min(), values.max()))
        both = samples.slice("x", [0.4] * 3, arrays={"p": POSITIONS}, offsets=[0, 0.1])
        np.testing.assert_allclose(np.unique(both.points[:, 0].round(12)), [0.4, 0.5])

    def test_samples_that_lack_a_value_take_part(self):
        """They have a position. What else the samples are asked for does not depend on former slices."""
        is_lacking = POSITIONS[:, 0] < 0.5
        places = POSITIONS[:50] + 1e-3
        expected = slice_samples(POSITIONS, "z", arrays={"wave": wave(POSITIONS)})
        for values in (np.where(is_lacking, np.nan, 1.0), np.ma.masked_array(np.ones(20000), is_lacking)):
            samples = Samples(POSITIONS, values)
            with self.assertWarnsRegex(RuntimeWarning, "samples are left out"):
                before = samples.probe(places, arrays=wave(POSITIONS))
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                sliced = samples.slice("z", arrays={"wave": wave(POSITIONS)})
            with self.assertWarnsRegex(RuntimeWarning, '"values" is not finite at [0-9]+ of [0-9]+ points'):
                own = samples.slice("z").arrays["values"]
            self.assertEqual(sliced.points.tobytes(), expected.points.tobytes())
            self.assertEqual(sliced.arrays["wave"].tobytes(), expected.arrays["wave"].tobytes())
            np.testing.assert_allclose(own[expected.points[:, 0] > 0.5], 1)
            self.assertTrue(np.isnan(own[expected.points[:, 0] < 0.2]).all())
            with self.assertWarnsRegex(RuntimeWarning, "samples are left out"):
                self.assertEqual(samples.probe(places, arrays=wave(POSITIONS)).tobytes(), before.tobytes())
        far = np.vstack([POSITIONS, [[np.nan, 0, 0]]])
        with self.assertWarnsRegex(RuntimeWarning, "Skipped 1 of 20001 samples: not finite. The") as caught:
            Samples(far, np.zeros(20001)).slice("z")
        self.assertEqual(caught.filename, __file__)

    def test_nearest_samples_keep_numbers_of_materials(self):
        large = 2**53 + 1  # not held by float64
        material = np.where(POSITIONS[:, 0] < 0.5, 3, large)
        for function in (None, ball):
            found = slice_samples(POSITIONS, arrays={"material": material, "place": POSITIONS}, function=function,
                                  interpolation="nearest").arrays
            self.assertEqual(found["material"].dtype, material.dtype)
            self.assertEqual(found["material"].tolist(), np.where(found["place"][:, 0] < 0.5, 3, large).tolist())
            for interpolation in ("fits", "linear"):
                listed = slice_samples(POSITIONS, arrays={"material": material, "place": POSITIONS}, function=function,
                                       interpolation=interpolation, nearest_arrays=["material"]).arrays
                self.assertEqual(listed["material"].tolist(), found["material"].tolist())
            number = np.random.default_rng(4).integers(0, 10785, len(POSITIONS))
            for interpolation in ("fits", "linear"):
                found = slice_samples(POSITIONS, arrays=number, function=function, interpolation=interpolation)
                self.assertEqual(found.arrays["values"].dtype, number.dtype)
                self.assertTrue(0 <= found.arrays["values"].min() < found.arrays["values"].max() <= number.max())


def only_at_samples(places):
    return ball(places) if len(places) == len(POSITIONS) else np.full(len(places), np.nan)


def moves_places(places):
    places -= 0.5
    return places[:, 0]


class Calls(unittest.TestCase):
    def test_empty_slices(self):
        for arguments, text in (
                ((POSITIONS, "x", [2, 0, 0]), "all samples are on one side of it. Move it among"),
                ((POSITIONS, "x", POSITIONS[POSITIONS[:, 0].argmin()]), "count as above it, and none are below"),
                ((POSITIONS * [1, 1, 0], "z"), "the same at all samples"),
                ((POSITIONS * [1, 1, 0], "x"), "in one plane")):
            with self.assertWarnsRegex(RuntimeWarning, "No slice: .*" + text) as caught:
                self.assertEqual(len(slice_samples(*arguments)), 0)
            self.assertEqual(caught.filename, __file__)

    def test_wrong_arguments(self):
        for options, error, text in (
                (dict(normal="w"), ValueError, "^normal cannot be 'w': it is x, y, z, -x, .* or three finite numbers"),
                (dict(normal={"T": POSITIONS}), ValueError, "^normal cannot be of the type dict: it is x"),
                (dict(normal=(0, 0, 0)), ValueError, "length is 0"),
                (dict(normal=(1, 2)), ValueError, "three"), (dict(origin=(1, np.nan, 2)), ValueError, "origin.*finite"),
                (dict(function=3), TypeError, "function"), (dict(function=ball, origin=[0, 0, 0]), TypeError, "origin"),
                (dict(function=ball, normal="x"), TypeError, "normal"),
                (dict(function=lambda places: places), ValueError, "one number for each"),
                (dict(function=lambda places: np.full(len(places), np.inf)), ValueError, "not finite at 20000"),
                (dict(function=lambda places: places[:, 0] + 1j), TypeError, "complex128: it is to return real"),
                (dict(function=only_at_samples), ValueError, "not finite at [0-9]+ places between samples"),
                (dict(function=moves_places), ValueError, "read-only"),
                (dict(offsets=np.nan), ValueError, "An offset is not a number"),
                (dict(interpolation="cubic"), ValueError, '"linear" or "nearest"'), (dict(angle=3), TypeError, "angle"),
                (dict(offsets=None), TypeError, "offsets are missing"), (dict(threads=0), ValueError, "threads")):
            with self.subTest(text), self.assertRaisesRegex(error, text):
                slice_samples(POSITIONS, arrays=POSITIONS, **options)

    def test_threads_and_progress(self):
        expected = slice_samples(POSITIONS, arrays=POSITIONS, threads=1, interpolation="linear")
        fractions = []
        found = slice_samples(POSITIONS, arrays=POSITIONS, threads=3, interpolation="linear", progress=fractions.append)
        self.assertEqual(found.arrays["values"].tobytes(), expected.arrays["values"].tobytes())
        self.assertEqual((fractions, fractions[-1]), (sorted(fractions), 1))


if __name__ == "__main__":
    unittest.main()
