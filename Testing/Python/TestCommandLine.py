# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line, in a folder of its own; files of VTK where PyVista is installed."""

import contextlib
import errno
import importlib.util
import io
import os
import pathlib
import pydoc
import re
import shlex
import signal
import stat
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings
import zipfile
from unittest import mock

import numpy as np
from scatteredisopoints import _command_line, _reading, _writing, body, contour, probe, slice_samples
from scatteredisopoints._option_types import OptionsOfPoints

HAS_PYVISTA, HAS_MESHIO = (importlib.util.find_spec(name) is not None for name in ("pyvista", "meshio"))
COMMAND = [sys.executable, "-m", "scatteredisopoints"]
POSITIONS = np.random.default_rng(1).random((3000, 3))
VALUES = np.linalg.norm(POSITIONS - 0.5, axis=1)
TABLE = np.column_stack([POSITIONS, VALUES])
# POSITIONS and VALUES as text: what surrounds the numbers, and their delimiter.
TEXTS = {"a.csv": ("x,y,z,T\n", ","), "quoted.csv": ('# by hand\n\n"X (m)", "Y (m)" , "Z [m]", "T"\n', ", "),
         "semicolons.csv": ('\ufeffX;Y;Z;"T"\n', ";"), "tabs.tsv": ("x\ty\tz\tT\n", "\t"),
         "blanks.txt": ("# x y z T\n", "  "), "decimal.txt": ("# x y z T\n", " "),
         "paraview.csv": ('"Points:0","Points:1","Points:2","T"\n', ",")}


def write_inputs():
    for name, (header, delimiter) in TEXTS.items():
        rows = [delimiter.join(map(repr, row)) for row in TABLE.tolist()]
        text = header + "\n".join(rows[:1000] + ["# a comment", ""] + rows[1000:]) + "\n"
        pathlib.Path(name).write_text(text.replace(".", ",") if delimiter in " ;" else text, encoding="utf-8")
    np.save("a.npy", TABLE)
    np.save("records.npy", np.rec.fromarrays(TABLE.T, names="x,y,z,T"))
    np.savez("a.npz", points=POSITIONS, T=VALUES, velocity=POSITIONS * [1, 2, 3], words=np.full(3000, "a"),
             objects=np.full(3000, None), dates=np.zeros(3000, "M8[s]"), nothing=np.empty((3000, 0)), step=7)
    np.savez("columns.npz", **dict(zip(("x", "y", "z", "T"), TABLE.T)))
    properties = "obj_info i\n".join(f"property double {name}\n" for name in ("x", "y", "z", "T"))
    faces = "element face 1\nproperty list uchar int vertex_indices\n"
    lines = [*(" ".join(map(repr, row)) for row in TABLE.tolist()), "3 0 1 2"]
    for name, kind, body in (("ascii.ply", "ascii", "\n".join(lines).encode()),
                             ("big.ply", "binary_big_endian", TABLE.astype(">f8").tobytes())):
        header = f"ply\nformat {kind} 1.0\ncomment c\nelement vertex 3000\n{properties}{faces}end_header\n"
        pathlib.Path(name).write_bytes(header.encode() + body)
    if HAS_PYVISTA:
        import pyvista

        cloud = pyvista.PolyData(POSITIONS)
        cloud["T"], cloud["velocity"] = VALUES, POSITIONS * [1, 2, 3]
        cloud.save("a.vtp")
        cloud.cast_to_unstructured_grid().save("a.vtu")


def run(*arguments):
    """Returns the exit status and the text on stdout and stderr."""
    with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()) as errors:
        try:
            status = _command_line.main([str(each) for each in arguments])
        except SystemExit as error:
            status = error.code
    return status, out.getvalue(), errors.getvalue()


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.before = os.getcwd()
        self.folder = tempfile.TemporaryDirectory()
        os.chdir(self.folder.name)
        write_inputs()

    def tearDown(self):
        os.chdir(self.before)
        self.folder.cleanup()

    def made(self, *arguments):
        """The arrays that a command writes."""
        status, _, errors = run(*arguments, "-o", "made.npz")
        self.assertEqual((status, errors), (0, ""), arguments)
        with np.load("made.npz") as archive:
            return dict(archive)

    def test_all_inputs_give_the_same(self):
        expected = contour(POSITIONS, VALUES, [0.3, 0.4], triangles=True)
        names = [*TEXTS, "records.npy", "a.npz", "columns.npz", "ascii.ply", "big.ply"]
        for name in names + ["a.vtp", "a.vtu"] * HAS_PYVISTA:
            with self.subTest(name):
                found = self.made("contour", name, "T", 0.3, 0.4)
                np.testing.assert_array_equal(found["points"], expected.points)
                np.testing.assert_array_equal(found["triangles"], expected.triangles)
                np.testing.assert_array_equal(found["Normals"], expected.normals)
                np.testing.assert_array_equal(found["T"], expected.arrays["values"])
        np.testing.assert_array_equal(self.made("contour", "a.npy", "value", 0.3, 0.4)["points"], expected.points)
        np.savetxt("plain.xyz", TABLE, "%.17g")
        np.testing.assert_array_equal(self.made("contour", "plain.xyz", "value", 0.3, 0.4)["points"], expected.points)
        with open("a.csv") as file:
            done = subprocess.run([*COMMAND, "contour", "-", "T", "0.3", "0.4"], stdin=file, capture_output=True,
                                  text=True)
        self.assertEqual((done.stdout, done.stderr), (
            f"stdin_contour.ply: {len(expected)} points, {len(expected.triangles)} triangles\n", ""))

    def test_parts_of_vectors(self):
        velocity = POSITIONS * [1, 2, 3]
        for part, values in (("y", velocity[:, 1]), ("1", velocity[:, 1]),
                             ("magnitude", np.linalg.norm(velocity, axis=1))):
            for name in ["a.npz"] + ["a.vtp"] * HAS_PYVISTA:
                found = self.made("contour", name, f"velocity:{part}", 0.8)
                expected = contour(POSITIONS, values, 0.8, triangles=True, arrays={"velocity": velocity})
                np.testing.assert_array_equal(found["points"], expected.points)
                np.testing.assert_array_equal(found["velocity"], expected.arrays["velocity"])

    def test_missing_entries(self):
        pathlib.Path("gaps.csv").write_text(
            "x,y,z,T,name\n" + "".join(",".join([*map(repr, row), f"station {i}"]) + "\n"
                                       for i, row in enumerate(TABLE.tolist())) + "0.5,0.5,0.5,,a\n0.5,0.5,,NaN,b\n")
        status, out, errors = run("contour", "gaps.csv", "T", 0.3)
        self.assertEqual(status, 0)
        self.assertRegex(errors, r"\A.*contour: warning: .*2 .*\n\Z")
        np.testing.assert_array_equal(_reading.read_samples("gaps_contour.ply").positions,
                                      contour(POSITIONS, VALUES, 0.3, triangles=True).points)

    def test_options(self):
        found = self.made("contour", "a.npz", "T", 0.6, "--points", "--threads", 1, "--option", "drop_gaps=False",
                          "--option", "projection=QUADRATIC_FIT")
        expected = contour(POSITIONS, VALUES, 0.6, drop_gaps=False, projection="QUADRATIC_FIT")
        self.assertNotIn("triangles", found)
        np.testing.assert_array_equal(found["points"], expected.points)
        np.testing.assert_array_equal(found["Radius"], expected.radii)
        signed = {"x": POSITIONS[:, 0], "y": POSITIONS[:, 1], "z": POSITIONS[:, 2], "T": VALUES - 0.4}
        np.savez("signed.npz", **signed)
        found = self.made("contour", "signed.npz", "T", "-1e-1", "-.05", "--columns", "z,x,y")
        expected = contour(POSITIONS[:, [2, 0, 1]], signed["T"], [-0.1, -0.05], triangles=True)
        np.testing.assert_array_equal(found["points"], expected.points)

    def test_bodies(self):
        velocity = POSITIONS * [1, 2, 3]
        for arguments, expected in (
                (("contour", "a.npz", "T", 0.4, "--capping"),
                 contour(POSITIONS, VALUES, 0.4, triangles=True, capping=True, arrays={"velocity": velocity})),
                (("body", "a.npz", "velocity", "--option", "minimum_piece_size=0.01"),
                 body(POSITIONS, arrays={"velocity": velocity}, minimum_piece_size=0.01))):
            found = self.made(*arguments)
            np.testing.assert_array_equal(found["points"], expected.points)
            np.testing.assert_array_equal(found["triangles"], expected.triangles)
            np.testing.assert_array_equal(found["velocity"], expected.arrays["velocity"])
            self.assertEqual("IsCap" in found, "--capping" in arguments)
            for name, array in expected.cell_arrays.items():
                np.testing.assert_array_equal(found[name], array)
        self.assertEqual(run("body", "a.npz")[1], f"a_body.ply: {len(expected)} points, {len(expected.triangles)}"
                         f" triangles, volume {expected.volume:.6g}\n")

    def test_slices(self):
        for arguments, options in (
                ((), {}), (("--normal", "-Z", "--origin", "0,0,0.3"), dict(normal="-z", origin=(0, 0, 0.3))),
                (("--offsets", "-0.1,0.1", "--normal", "-1,1,0", "--interpolation", "Linear"),
                 dict(offsets=[-0.1, 0.1], normal=(-1, 1, 0), interpolation="linear"))):
            expected = slice_samples(POSITIONS, arrays={"T": VALUES, "velocity": POSITIONS * [1, 2, 3]}, **options)
            for order in (("slice", "a.npz", "T", "velocity", *arguments), ("slice", *arguments, "a.npz"),
                          ("slice", "a.npz", *arguments, "velocity", "T")):
                found = self.made(*order)
                np.testing.assert_array_equal(found["points"], expected.points)
                np.testing.assert_array_equal(found["triangles"], expected.triangles)
                for name in ("T", "velocity"):
                    np.testing.assert_array_equal(found[name], expected.arrays[name])

    def test_places(self):
        arrays = {"T": VALUES, "velocity": POSITIONS * [1, 2, 3]}
        line = np.linspace((0.2, 0.2, 0.2), (0.8, 0.5, 0.5), 5)
        axes = [np.linspace(each.min(), each.max(), count) for each, count in zip(POSITIONS.T, (2, 3, 4))]
        grid = np.array([(x, y, z) for z in axes[2] for y in axes[1] for x in axes[0]])
        np.save("places.npy", line[1:])
        for arguments, places in (
                (("--at", "0.2,0.3,0.4", "--at=-0.5,-.5,1e-1"), [[0.2, 0.3, 0.4], [-0.5, -0.5, 0.1]]),
                (("--line", "0.2,0.2,0.2", "0.8,0.5,0.5", "--resolution", 4), line), (("--grid", "2,3,4"), grid),
                (("--places", "places.npy"), line[1:])):
            found = self.made("probe", "a.npz", "--gradient", "--outside", "NEAREST", "--method", "Blend", *arguments)
            np.testing.assert_allclose(found["points"], places, atol=1e-15)
            values, gradients = probe(POSITIONS, arrays, found["points"], gradient=True, outside="nearest")
            for name in arrays:
                np.testing.assert_array_equal(found[name], values[name])
                np.testing.assert_array_equal(found[f"{name}_gradient"], gradients[name])
        self.assertEqual(run("probe", "a.csv", "T", "--at", "2,2,2", "--outside", "7", "-o", "made.csv")[0], 0)
        self.assertEqual(pathlib.Path("made.csv").read_text(), "x,y,z,T\n2.0,2.0,2.0,7.0\n")
        done = subprocess.run([*COMMAND, "probe", "a.npz", "velocity:z", "--at", "0.5,0.5,0.5"], capture_output=True,
                              text=True)
        self.assertRegex(done.stdout, r"\Ax,y,z,velocity:z\n0.5,0.5,0.5,1\.(5|49)\d*\n\Z")

    def test_outputs(self):
        expected = contour(POSITIONS, VALUES, 0.3, triangles=True, arrays={"velocity": POSITIONS * [1, 2, 3]})
        formats = ["ply", "stl", "obj", "csv", "npz", *["vtp", "vtk", "vtu"] * HAS_PYVISTA,
                   *["off", "msh"] * HAS_MESHIO]
        for kind in formats:
            status, out, _ = run("contour", "a.npz", "T", 0.3, "-o", f"made.{kind}")
            self.assertEqual((status, out), (
                0, f"made.{kind}: {len(expected)} points, {len(expected.triangles)} triangles\n"))
        ply = _reading.read_samples("made.ply")
        np.testing.assert_array_equal(ply.positions, expected.points)
        np.testing.assert_array_equal(np.column_stack([ply.arrays[f"n{axis}"] for axis in "xyz"]), expected.normals)
        np.testing.assert_array_equal(ply.arrays["velocity:2"], expected.arrays["velocity"][:, 2])
        np.savez("like.npz", points=POSITIONS, T=VALUES,
                 **{name: VALUES for name in ("nx", "x", "a b", "a_b", "ä", "ö")})
        status, _, errors = run("contour", "like.npz", "T", 0.3, "-o", "like.ply")
        like = _reading.read_samples("like.ply")
        np.testing.assert_array_equal(like.positions, expected.points)
        np.testing.assert_array_equal(like.arrays["nx"], expected.normals[:, 0])
        self.assertEqual(set(like.arrays), {"T", "nx", "ny", "nz", "nx_", "x_", "a_b", "a_b_", "?", "?_"})
        self.assertRegex(
            errors, r'\A(.*contour: warning: "(nx|x|a_b|ö)" has the name ".*_" in the PLY file, .*\n){4}\Z')
        faces = np.frombuffer(pathlib.Path("made.ply").read_bytes()[-13 * len(expected.triangles):],
                              [("n", "u1"), ("corners", "<i4", 3)])
        np.testing.assert_array_equal(faces["corners"], expected.triangles)
        facets = np.frombuffer(pathlib.Path("made.stl").read_bytes()[84:],
                               [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
        np.testing.assert_array_equal(facets["corners"], expected.points[expected.triangles].astype("f4"))
        np.testing.assert_allclose(np.linalg.norm(facets["normal"], axis=1), 1, rtol=1e-6)
        lines = [line.split() for line in pathlib.Path("made.obj").read_text().splitlines()]
        triangles = np.array([line[1:] for line in lines if line[0] == "f"], int)
        np.testing.assert_array_equal(triangles, expected.triangles + 1)
        np.testing.assert_array_equal(_reading.read_samples("made.csv").positions, expected.points)
        for kind in [each for each in formats if each not in ("csv", "npz")] if HAS_PYVISTA else ():
            import pyvista

            mesh = pyvista.read(f"made.{kind}").extract_surface(algorithm="dataset_surface")
            self.assertEqual(mesh.n_cells, len(expected.triangles), kind)
            self.assertAlmostEqual(mesh.volume, 4 / 3 * np.pi * 0.3**3, delta=0.01, msg=kind)
        for kind in ["ply", "obj", "npz", *["vtp", "vtu"] * HAS_PYVISTA]:
            status, out, _ = run("contour", "a.npz", "T", 0.3, "--points", "-o", f"points.{kind}")
            self.assertRegex(out, rf"^points.{kind}: \d+ points\n$")

    def test_errors(self):
        damaged = {"cut.ply": pathlib.Path("big.ply").read_bytes()[:5000], "cut.npz": b"PK", "cut.npy": b"hello",
                   "empty.csv": b"", "head.csv": b"x,y,z,T\n", "ragged.csv": b"x,y,z,T\n1,2,3,4\n1,2,3\n",
                   "words.csv": b"x,y,z,T\n1,2,3,4\n1,2,east,5\n", "flat.csv": b"a,b,T\n1,2,3\n",
                   "twice.csv": b"x,y,z,x\n1,2,3,4\n", "units.csv": b"x [m],x [ft],y,z,T\n1,2,3,4,5\n",
                   "quotes.csv": b'""\n', "cut.vtu": b"<VTKFile",
                   "open.csv": b'x,y,z,T\n1,2,3,4\n1,2,3,"5\n1,2,3,6\n', "nan.csv": b"x,y,z,T\nnan,1,2,3\n",
                   "head_open.csv": b'x,y,z,"T\n1,2,3,4\n', "long.csv": b'x,y,z,T\n1,2,3,"4\n' + 40_000 * b"1,2,3,4\n",
                   "minus.ply": pathlib.Path("big.ply").read_bytes().replace(b"vertex 3000", b"vertex -1")}
        for i, property_ in enumerate((b"", b"property O x\n", b"property S0 x\n", b"property M8 x\n")):
            damaged[f"kind{i}.ply"] = (b"ply\nformat binary_little_endian 1.0\nelement vertex 2\n" + property_ +
                                      b"end_header\n" + bytes(64))
        for name, content in damaged.items():
            pathlib.Path(name).write_bytes(content)
        cases = [
            ("contour missing.csv T 0.3", 1, "missing.csv: No such file"), ("contour . T 0.3", 1, "Is a directory"),
            ("contour a.csv q 0.3", 1, 'no array of numbers named "q": there are T$'),
            ("contour a.csv T 9", 1, r"no isosurface at 9\. .*between 0\."),
            ("contour a.csv T nan", 1, "not a number"),
            ("contour a.csv T 0.3 -o missing/a.ply", 1, "no folder .*: make it"),
            ("contour a.csv T 0.3 -o a.foo", 2, r"format of a.foo is unknown: there are .ply, .*pip install"),
            ("contour a.csv T 0.3 --points -o a.stl", 2, "triangles alone"),
            ("contour a.npz T 0.3 -o ./a.npz", 2, "would replace the samples"),
            ("contour a.npz velocity 0.3", 1, "3 components: choose one, .*velocity:magnitude"),
            ("contour a.npz velocity:w 0.3", 1, 'no component "w": there are 0 to 2'),
            ("contour a.csv T 0.3 --option drop_gap=0", 1, "did you mean drop_gaps"),
            ("contour a.csv T 0.3 --capping --option capping=False", 1, "option is given twice: capping, capping"),
            *((f"contour a.csv T 0.3 --option {name}=1", 1, f"unknown option {name}: ")
              for name in ("triangles", "isovalues", "progress")),
            *((f"slice a.csv --option {name}=1", 1, f"unknown option {name}: ") for name in ("normal", "function")),
            *((f"contour a.npz {name} 1", 1, f'"{name}" holds no numbers')
              for name in ("words", "objects", "dates", "nothing")),
            ("contour open.csv T 5", 1, "a quote in line 3 is not closed"),
            ("contour head_open.csv T 5", 1, "a quote in line 1 is not closed"),
            ("contour long.csv T 5", 1, "a quote in line 2 is not closed"),
            ("probe nan.csv --grid 2,2,2", 1, "No sample has a finite position"),
            ("probe a.csv --grid 99999999,99999999,9999", 1,
             r"--grid 99999999,99999999,9999 would give 1e\+20 points, .* at most 2147483647: choose fewer$"),
            ("probe a.csv --line 0,0,0 1,0,0 --resolution 1000000000000000", 1, "Out of memory. Free memory"),
            ("contour a.csv T 0.3 --columns x,y,x", 1, "columns x, y, x are not different"),
            ("contour a.csv T 0.3 --columns x,y,q", 1, 'no "q": .* there are x, y, z, T$'),
            ("contour cut.ply T 0.3", 1, "cut.ply cannot be read: it ends after"), ("contour cut.npz T 1", 1, "zip"),
            *((f"contour {name}.ply x 0.3", 1, "its header is not that of a PLY file")
              for name in ("minus", "kind0", "kind1", "kind2", "kind3")),
            ("contour cut.npy T 0.3", 1, "magic"), ("contour empty.csv T 0.3", 1, "it is empty"),
            ("contour head.csv T 0.3", 1, "no samples"), ("contour quotes.csv T 0.3", 1, "it is empty"),
            ("contour twice.csv T 0.3", 1, 'two columns have the name "x"'),
            ("contour units.csv T 1", 1, r'several columns for "x": .* --columns; there are x \[m\], x \[ft\], y,'),
            ("contour ragged.csv T 0", 1, "line 3 has 3 entries instead of 4"),
            ("contour words.csv T 0.3", 1, '"east" in line 3, column "z"'),
            ("contour flat.csv T 0.3", 1, "give the coordinates by --columns; there are a, b, T"),
            ("slice a.csv --origin 5,5,5", 1, "slice"), ("slice a.csv --normal w", 2, "w: give x, y, z, -x,.* 1,1,0$"),
            ("probe a.csv", 2, "required"), ("probe a.csv --at 1,2", 2, "--at: 1,2: give three"),
            ("probe a.csv --at 1,2,3 --outside no", 2, "--outside: no: give a number, nearest or fit$"),
            ("probe a.csv --grid 1,0,1", 2, "--grid: 1,0,1: give three whole"), ("contour a.csv T", 2, "ISOVALUE"),
            ("contour a.csv T x", 2, "x: give a number$"),
            ("contour a.csv T 1 --threads 0", 2, "--threads: 0: give a whole number, 1 or more$"),
            ("contour a.csv T 1 --thread 1", 2, "unrecognized"),
            ("contour a.csv T 1 --unknown -2", 2, "unrecognized arguments: --unknown -2$"),
            ("", 2, "COMMAND"), ("nothing", 2, "nothing"),
            ("contour cut.vtu T 0.3", 1, "cut.vtu" if HAS_PYVISTA or HAS_MESHIO else "needs PyVista or meshio: pip")]
        before = set(os.listdir())
        for text, expected, message in cases:
            with self.subTest(text):
                status, out, errors = run(*text.split())
                self.assertEqual((status, out), (expected, ""), errors)
                lines = errors.splitlines()
                self.assertRegex(lines[-1], rf"\Apython -m scatteredisopoints.*: error: .*{message}")
                self.assertTrue(len(lines) == 1 or expected == 2, errors)
                self.assertEqual(set(os.listdir()), before)

    def test_earlier_files_stay_if_writing_fails(self):
        before = os.listdir()
        pathlib.Path("made.ply").write_text("earlier")

        def fail(path, _):
            pathlib.Path(path).write_text("half")
            raise OSError(28, "No space left on device", path)

        def write_nothing(*_):
            pass

        with mock.patch.dict(_writing._WRITERS, {".ply": write_nothing}):
            self.assertRegex(run("contour", "a.npz", "T", 0.3, "-o", "made.ply")[2], "made.ply cannot be written")

        with mock.patch.dict(_writing._WRITERS, {".ply": fail}):
            status, _, errors = run("contour", "a.npz", "T", 0.3, "-o", "made.ply")
        self.assertEqual(status, 1)
        self.assertRegex(errors, "error: [^ ]*made.ply: No space left")
        with mock.patch("os.mkdir", side_effect=lambda path, _: os.rmdir(path)):  # which fails as os.mkdir() may
            with self.assertRaisesRegex(OSError, r"[^ ]*made.ply'\Z"), _writing.file_to_write("made.ply"):
                pass
        self.assertEqual(pathlib.Path("made.ply").read_text(), "earlier")
        self.assertEqual(set(os.listdir()), {*before, "made.ply"})

    def test_files_beside_the_output_stay(self):
        """Neither files nor links of others are written to, and two runs do not collide."""
        for name in ("made.ply.part.ply", "kept"):
            pathlib.Path(name).write_text("of the user")
        with contextlib.suppress(OSError):  # of systems without links for everyone
            os.symlink("kept", "linked.ply.part.ply")
        before = set(os.listdir())
        for name in ("made.ply", "linked.ply"):
            self.assertEqual(run("contour", "a.npz", "T", 0.3, "-o", name)[0], 0)
        self.assertEqual(set(os.listdir()), {*before, "made.ply", "linked.ply"})
        for name in ("made.ply.part.ply", "kept"):
            self.assertEqual(pathlib.Path(name).read_text(), "of the user")
        with _writing.file_to_write("both.csv") as first, _writing.file_to_write("both.csv") as second:
            self.assertNotEqual(first, second)
            self.assertEqual({*map(os.path.basename, (first, second))}, {"both.csv"})
            for path in (first, second):
                pathlib.Path(path).write_text(path)
                if os.name == "posix":
                    self.assertEqual(os.stat(os.path.dirname(path)).st_mode & 0o777, 0o700)
        self.assertEqual(pathlib.Path("both.csv").read_text(), first)
        with _writing.file_to_write("two.xdmf") as path:
            for each in (path, path.replace("xdmf", "h5")):
                pathlib.Path(each).write_text(each)
        self.assertEqual(set(os.listdir()), {*before, "made.ply", "linked.ply", "both.csv", "two.xdmf", "two.h5"})

    @unittest.skipIf(sys.platform == "win32", "links are not for everyone")
    def test_links_stay(self):
        os.mkdir("there")
        for name in ("link.ply", "dangling.ply"):
            os.symlink(f"there/{name}.data", name)
        pathlib.Path("there/link.ply.data").write_text("earlier")
        for name in ("link.ply", "dangling.ply"):
            self.assertEqual(run("contour", "a.npz", "T", 0.3, "-o", name)[0], 0)
            self.assertTrue(os.path.islink(name) and pathlib.Path(name).read_bytes().startswith(b"ply"))
        self.assertEqual(set(os.listdir("there")), {"link.ply.data", "dangling.ply.data"})
        os.symlink("loop.ply", "loop.ply")
        errors = run("contour", "a.npz", "T", 0.3, "-o", "loop.ply")[2]
        self.assertRegex(errors, f"error: loop.ply: {os.strerror(errno.ELOOP)}")
        self.assertTrue(os.path.islink("loop.ply"))

    @unittest.skipIf(sys.platform == "win32", "permissions are others")
    def test_permissions(self):
        before = os.umask(0o027)
        try:
            for name, mode in (("secret.ply", 0o600), ("all.ply", 0o666), ("new.ply", None)):
                if mode is not None:
                    pathlib.Path(name).write_text("earlier")
                    os.chmod(name, mode)
                self.assertEqual(run("contour", "a.npz", "T", 0.3, "-o", name)[0], 0)
                self.assertEqual(os.stat(name).st_mode & 0o777, mode or 0o640)
        finally:
            os.umask(before)

    @unittest.skipIf(sys.platform == "win32", "permissions are others")
    def test_owners(self):
        """A file keeps its owner and group, or else gives nobody more permissions; none runs as another user."""
        def replaced(mode, chown=os.chown):
            for name in ("two.xdmf", "two.h5"):
                with contextlib.suppress(FileNotFoundError):
                    os.remove(name)
                pathlib.Path(name).write_text("earlier")
                if os.geteuid() == 0:
                    os.chown(name, 12345, 54321)
                os.chmod(name, mode)
            with mock.patch("os.chown", chown), _writing.file_to_write("two.xdmf") as path:
                for each in (path, path.replace("xdmf", "h5")):
                    pathlib.Path(each).write_text("later")
            found = [os.stat(name) for name in ("two.xdmf", "two.h5")]
            self.assertEqual(found[0].st_mode, found[1].st_mode)
            self.assertEqual(pathlib.Path("two.h5").read_text(), "later")
            return [(each.st_uid, each.st_gid) for each in found], oct(found[0].st_mode & 0o7777)

        owner = (12345, 54321) if os.geteuid() == 0 else (os.geteuid(), os.stat(".").st_gid)
        self.assertEqual(replaced(0o6751), ([owner] * 2, "0o751"))
        self.assertEqual(replaced(0o444), ([owner] * 2, "0o444"))
        for mode, expected in ((0o664, "0o644"), (0o640, "0o600"), (0o604, "0o600"), (0o4755, "0o755")):
            refused = mock.Mock(side_effect=PermissionError(1, "Operation not permitted"))
            self.assertEqual(replaced(mode, refused)[1], expected)

    def test_what_cannot_be_replaced(self):
        """Errors name the file, which stays."""
        pathlib.Path("made.ply").write_text("earlier")
        os.chmod("made.ply", 0o444)
        with mock.patch("os.name", "nt"):  # where read-only files cannot be replaced
            with self.assertRaises(PermissionError) as caught, _writing.file_to_write("made.ply"):
                pass
        self.assertEqual(caught.exception.filename, "made.ply")
        os.chmod("made.ply", 0o644)
        with self.assertRaises(OSError) as caught, _writing.file_to_write("made.ply"):
            raise OSError(28, "No space left on device")  # as file.write() does
        self.assertEqual((caught.exception.filename, caught.exception.errno), ("made.ply", 28))
        self.assertEqual(pathlib.Path("made.ply").read_text(), "earlier")

    @unittest.skipIf(sys.platform == "win32", "there are no such files")
    def test_pipes_and_devices(self):
        os.mkfifo("fifo.csv")
        os.symlink("/dev/stdout", "out.csv")
        self.assertEqual(run("contour", "a.npz", "T", 0.3, "-o", "file.csv")[0], 0)
        expected = pathlib.Path("file.csv").read_text()
        for name in ("fifo.csv", "out.csv"):
            with subprocess.Popen([*COMMAND, "contour", "a.npz", "T", "0.3", "-o", name], stdout=subprocess.PIPE,
                                  text=True) as process:
                if name == "fifo.csv":
                    self.assertEqual(pathlib.Path(name).read_text(), expected)
                self.assertTrue(process.stdout.read().startswith(expected if name == "out.csv" else "fifo.csv: "))
                self.assertEqual(process.wait(), 0)
        self.assertTrue(stat.S_ISFIFO(os.stat("fifo.csv").st_mode) and os.path.islink("out.csv"))

    def assert_the_same(self, *names, **options):
        """The command gives for each file what contour() gives for the arrays."""
        expected = contour(POSITIONS, VALUES, 0.3, triangles=True)
        for name in names:
            with self.subTest(name):
                np.testing.assert_array_equal(self.made("contour", name, "T", 0.3)["points"], expected.points)

    def test_columns_of_pandas(self):
        rows = [",".join([f"{i}", *map(repr, row)]) for i, row in enumerate(TABLE.tolist())]
        for name, header in (("pandas.csv", ",x,y,z,T"), ("numbers.csv", ",0,1,2,3")):
            pathlib.Path(name).write_text("\n".join([header, *rows]) + "\n")
        pathlib.Path("comma.csv").write_text("".join(f"{row},\n" for row in ["x,y,z,T", *(
            row.partition(",")[2] for row in rows)]))
        self.assert_the_same("pandas.csv", "comma.csv")
        np.testing.assert_array_equal(
            self.made("contour", "numbers.csv", "3", 0.3, "--columns", "0,1,2")["points"],
            self.made("contour", "pandas.csv", "T", 0.3)["points"])
        self.assertRegex(run("contour", "numbers.csv", "3", 0.3)[2], 'no "x": .* there are 0, 1, 2, 3\n$')

    def test_byte_order_marks(self):
        text = pathlib.Path("a.csv").read_bytes()
        done = subprocess.run([*COMMAND, "contour", "-", "T", "0.3"], input=b"\xef\xbb\xbf" + text, capture_output=True)
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        for kind in ("utf-16", "utf-16-le", "utf-16-be"):
            other = text.decode().encode(kind)
            pathlib.Path("other.csv").write_bytes(other)
            done = subprocess.run([*COMMAND, "contour", "-", "T", "0.3"], input=other, capture_output=True, text=False)
            for errors in (run("contour", "other.csv", "T", 0.3)[2], done.stderr.decode()):
                self.assertRegex(errors, r"error: (other.csv|-) cannot be read: it is in UTF-16, .* in UTF-8\r?\n\Z")

    def test_members_that_are_no_arrays(self):
        with zipfile.ZipFile("a.npz", "a") as archive:
            archive.writestr("readme.txt", "of the measurement")
        self.assert_the_same("a.npz")
        self.assertRegex(run("contour", "a.npz", "readme.txt", 0.3)[2], 'a.npz: "readme.txt" holds no numbers\n$')

    def test_headers_that_claim_too_much(self):
        for kind, content in (("ascii", b"1 2 3\n"), ("binary_little_endian", bytes(24)),
                              ("binary_big_endian", bytes(30))):
            for count in (10**12, 10**30):
                header = (f"ply\nformat {kind} 1.0\nelement vertex {count}\nproperty double x\nproperty double y\n"
                          "property double z\nend_header\n")
                pathlib.Path("claim.ply").write_bytes(header.encode() + content)
                status, _, errors = run("body", "claim.ply")
                self.assertRegex(errors, rf"error: claim.ply cannot be read: it ends after 1 of {count} vertices\n\Z")
                self.assertEqual(status, 1)

    @unittest.skipIf(sys.platform == "win32", "there are no such files")
    def test_pipes_of_vertices(self):
        for name in ("ascii.ply", "big.ply"):
            os.mkfifo("fifo.ply")
            write = pathlib.Path("fifo.ply").write_bytes
            threading.Thread(target=write, args=(pathlib.Path(name).read_bytes(),), daemon=True).start()
            done = subprocess.run([*COMMAND, "contour", "fifo.ply", "T", "0.3"], capture_output=True, timeout=100)
            self.assertEqual((done.returncode, done.stderr), (0, b""))
            os.unlink("fifo.ply")

    def test_names_in_csv_files(self):
        """They are such that the file can be read."""
        arrays = {"x": VALUES, "X": VALUES, "y [m]": VALUES, "z(m)": VALUES, "a;b": VALUES, "a,b": VALUES,
                  "c\nb": VALUES, " T": VALUES, 'q"': VALUES, "v": POSITIONS, "v:0": VALUES}
        np.savez("like.npz", points=POSITIONS, T=VALUES, **arrays)
        for kind in ("csv", "ply"):
            status, _, errors = run("contour", "like.npz", "T", 0.3, "-o", f"like.{kind}", "--columns", "points")
            found = _reading.read_samples(f"like.{kind}")
            np.testing.assert_array_equal(found.positions, contour(POSITIONS, VALUES, 0.3, triangles=True).points)
            self.assertRegex(errors, f'"x" has the name "x_" in the {kind.upper()} file, since "x" names something')
            if kind == "csv":
                self.assertEqual(set(found.arrays) - {f"Normals:{i}" for i in range(3)}, {
                    "T", "x_", "X_", "y_ [m]", "z_(m)", "a;b", "a,b", "c b", "T_", 'q"', "v:0", "v:1", "v:2", "v:0_"})
                self.assertEqual(errors.count("warning"), 6)
        np.savez("x.npz", points=POSITIONS, x=VALUES)
        done = subprocess.run([*COMMAND, "probe", "x.npz", "--at", "0.5,0.5,0.5"], capture_output=True, text=True)
        self.assertRegex(done.stdout, r"\Ax,y,z,x_\n")
        self.assertRegex(done.stderr, r'\A[^\n]*probe: warning: "x" has the name "x_" in the CSV file[^\n]*\n\Z')

    def test_isovalues_that_are_not_finite_or_have_exponents(self):
        for text, shown in (("-inf", "-inf"), ("-Infinity", "-inf"), ("inf", "inf"), ("-1e5", "-100000"),
                            ("-.5", "-0.5"), ("-5.", "-5"), ("1e-3", "0.001"), ("-1E-3", "-0.001")):
            for arguments in ((text,), ("--threads", 1, text), ("--", text)):
                status, _, errors = run("contour", "a.npz", "T", *arguments)
                self.assertRegex(errors, rf"\A.*error: .*[Nn]o isosurface at {shown}[:.] .*\n\Z")
        self.assertRegex(run("contour", "a.npz", "T", "-nan")[2], "An isovalue is not a number")
        self.assertEqual(run("probe", "a.npz", "T", "--at", "9,9,9", "--outside", "-inf", "-o", "out.csv")[0], 0)
        self.assertEqual(pathlib.Path("out.csv").read_text(), "x,y,z,T\n9.0,9.0,9.0,-inf\n")

    def test_names_that_begin_with_a_hyphen(self):
        for before, name in (("a.csv", "-x.csv"), ("-x.csv", "-2.csv"), ("-2.csv", "-o.csv")):
            os.replace(before, name)
            for arguments in (("contour", "-o", "made.csv", "--", name, "T", "0.3"),
                              ("contour", "-o", "-1.csv", "--", name, "T", "0.3", "4e-1")):
                self.assertEqual(run(*arguments)[0::2], (0, ""))
            os.unlink("-1.csv")
        self.assertRegex(run("contour", "-2.csv", "T", 0.3)[2], "error: -2.csv: No such file")
        np.savez("a.npz", **{"points": POSITIONS, "-x": VALUES})
        self.assertEqual(run("contour", "a.npz", "-x", 0.3)[0], 0)

    def test_underscores_are_in_no_numbers(self):
        row = "1_0,2,3,4"
        for name, text in (("a.csv", f"x,y,z,T\n{row}\n"), ("a.tsv", "x\ty\tz\tT\n" + row.replace(",", "\t"))):
            pathlib.Path(name).write_text(text)
            self.assertRegex(run("contour", name, "T", 1)[2], f'{name}: "1_0" in line 2, column "x", is no number')
        header = "ply\nformat ascii 1.0\nelement vertex {}\n" + "".join(f"property int {axis}\n" for axis in "xyz")
        for count, body, message in (("1", "1_0 2 3", "1_0 2 3 are no numbers"), ("1_0", "1 2 3\n" * 10, "its header")):
            pathlib.Path("a.ply").write_text(f"{header.format(count)}end_header\n{body}\n")
            self.assertRegex(run("body", "a.ply")[2], f"a.ply cannot be read: {message}")
        for text in ("contour a.npz T 1_0", "contour a.npz T 1 --threads 1_0", "slice a.npz --offsets 0,1_0",
                     "slice a.npz --normal 1_0,0,0", "slice a.npz --origin 1_0,0,0", "probe a.npz --at 1_0,0,0",
                     "probe a.npz --grid 1_0,2,2", "probe a.npz --at 1,2,3 --outside 1_0"):
            status, _, errors = run(*text.split())
            self.assertEqual(status, 2, text)
            self.assertRegex(errors, r"1_0.*: give ")
        for name in ("minimum_piece_size", "drop_gaps", "projection"):
            self.assertRegex(run("contour", "a.npz", "T", 0.3, "--option", f"{name}=1_0")[2], f"{name} cannot be '1_0'")

    def test_separators_of_thousands(self):
        """Commas are decimal if any of the file must be, and doubtful if each may separate thousands."""
        for kind, separator in (("csv", ";"), ("tsv", "\t"), ("txt", " ")):
            def texts(column, form, positions=POSITIONS):
                """The file with one column like this."""
                rows = [[*map(str, place), str(value)] for place, value in zip(positions.tolist(), VALUES.tolist())]
                for i, row in enumerate(rows):
                    row[column] = form(i)
                return "".join(separator.join(row) + "\n" for row in [["x", "y", "z", "T"], *rows])

            def read(text):
                pathlib.Path(f"a.{kind}").write_text(text)
                with warnings.catch_warnings(record=True) as caught:
                    warnings.simplefilter("always")
                    samples = _reading.read_samples(f"a.{kind}", ["T"])
                return samples.arrays["T"], [str(each.message) for each in caught]

            def thousand(i):
                return f"{1000 + i:,}"

            with self.subTest(kind):
                with self.assertRaisesRegex(ValueError, r'a\..*: "1,000", column "T", and "0\.\d+" cannot both be'):
                    read(texts(3, thousand))
                with self.assertRaisesRegex(ValueError, '"1.000", column "T", and "0,.*" cannot both be decimal'):
                    read(texts(3, thousand).replace(".", ";;").replace(",", ".").replace(";;", ","))
                values, messages = read(texts(3, thousand).replace(".", ","))
                np.testing.assert_array_equal(values, np.arange(1000, 4000) / 1000)
                self.assertEqual(messages, [])
                whole = np.arange(9000).reshape(-1, 3) % 100
                values, messages = read(texts(3, thousand, whole))
                np.testing.assert_array_equal(values, np.arange(1000, 4000) / 1000)
                self.assertEqual(messages, ['The comma in "1,000", column "T", is read as a decimal point. If commas'
                                            ' separate thousands, remove them.'])
                for number in ("0,125", "1,5", "12,3456", "1234,567", "1,250e3", ",125"):
                    _, messages = read(texts(3, lambda i: number if i == 2000 else thousand(i), whole))
                    self.assertEqual(messages, [], number)
                values, messages = read(texts(3, lambda i: f"{1 + i % 9}.500", whole))
                self.assertEqual((values[0], messages), (1.5, []))
        pathlib.Path("words.tsv").write_text("x\ty\tz\tT\tname\n1\t2\t3\t1.5\t1,000\n1\t2\t4\t1.5\ta, b\n")
        self.assertEqual(_reading.read_samples("words.tsv").arrays["T"].tolist(), [1.5, 1.5])

    def test_columns_of_places(self):
        for name, header in (("named.csv", "e,n,h,T"), ("places.csv", "h,n,e")):
            rows = TABLE.tolist() if name == "named.csv" else [[0.3, 0.4, 0.5]]
            pathlib.Path(name).write_text("".join(",".join(row) + "\n" for row in [
                header.split(","), *(map(repr, row) for row in rows)]))
        np.save("plain.npy", [[0.5, 0.4, 0.3]])
        for name in ("places.csv", "plain.npy"):
            found = self.made("probe", "named.csv", "--columns", "e,n,h", "--places", name)
            np.testing.assert_array_equal(found["points"], [[0.5, 0.4, 0.3]])
        for arguments in (("a.npz", "--places", "places.csv"),
                          ("a.csv", "--places", "places.csv", "--columns", "z,x,y")):
            self.assertRegex(run("probe", *arguments)[2], 'error: places.csv has no "x": name the coordinates x, y, z,'
                             ' or as in FILE; there are h, n, e\n$')

    def test_options_by_name(self):
        for text, value in (("false", False), ("False", False), ("TRUE", True), ("0", False)):
            found = self.made("contour", "a.npz", "T", 0.6, "--option", f"drop_gaps={text}")
            expected = contour(POSITIONS, VALUES, 0.6, triangles=True, drop_gaps=value)
            np.testing.assert_array_equal(found["points"], expected.points)
        found = self.made("contour", "a.npz", "T", 0.3, "--points", "--option", "projection=none")
        np.testing.assert_array_equal(found["points"], contour(POSITIONS, VALUES, 0.3, projection=None).points)
        for text in ("no", "off", "", "2"):
            self.assertRegex(run("contour", "a.npz", "T", 0.6, "--option", f"drop_gaps={text}")[2],
                             "error: drop_gaps cannot be .*: it is True or False\n$")

    def test_files_without_three_coordinates(self):
        pathlib.Path("flat.csv").write_text("x,y,T\n1,2,3\n2,3,4\n3,5,7\n4,4,4\n")
        np.savez("flat.npz", points=POSITIONS[:, :2], T=VALUES)
        np.savez("lengths.npz", x=VALUES, y=VALUES, z=VALUES[1:], T=VALUES)
        for text, message in (
                ("flat.csv", 'flat.csv has no "z": add it, or give the coordinates by --columns; there are x, y, T'),
                ("flat.csv --columns x,y", r'flat.csv has "x" of the shape \(4,\), "y" of the shape \(4,\), not three'
                 " columns of coordinates: give the coordinates by --columns; there are x, y, T"),
                ("flat.npz", r'flat.npz has "points" of the shape \(3000, 2\), not three columns .*: give .*--columns'),
                ("lengths.npz", r'lengths.npz has "x" of the shape \(3000,\), .*"z" of the shape \(2999,\), not')):
            name, *rest = text.split()
            self.assertRegex(run("contour", name, "T", 3, *rest)[2], f"error: {message}")

    def test_help(self):
        for name in ("contour", "body", "slice", "probe"):
            status, out, _ = run(name, "--help")
            found = re.findall(rf"^  python -m scatteredisopoints ({name} .*)", out, re.MULTILINE)
            self.assertTrue(status == 0 and found)
            for example in found:  # which names no file that is there
                status, _, errors = run(*shlex.split(example))
                self.assertEqual(status, 1, errors)
                self.assertRegex(errors, "No such file")
            self.assertNotRegex(out, r"docs/|\.md\b")  # which the wheel lacks
            described = re.findall("python -m pydoc (.*) describes", out)
            self.assertEqual([pydoc.locate(each) is not None for each in described], [True] * (name != "probe"))
            for name, value in re.findall(r"^  (\w+)=(.*)$", out, re.MULTILINE):
                value = {"COUNT": "12", "NUMBER": "0.5"}.get(value, value.split("|")[-1])
                command = found[0].split()[0]
                status, _, errors = run(command, "a.npz", *["T", "0.3"] * (command == "contour"),
                                        *["--points"] * (name in OptionsOfPoints.__annotations__),
                                        "--option", f"{name}={value}", "-o", "made.ply")
                self.assertEqual((status, errors), (0, ""), name)
        self.assertRegex(run("paraview")[1], "scattered_isopoints.py")
        self.assertRegex(run("--version")[1], r"^\d+\.\d+\.\d+$")

    def test_names_of_the_program(self):
        """What pip installs calls main() without arguments, and says its own name."""
        script = ("import sys\nsys.argv = ['{}', *sys.argv[1:]]\n"
                  "from scatteredisopoints._command_line import main\nsys.exit(main())")
        for name, shown in (("bin/scatteredisopoints", "scatteredisopoints"),
                            ("scatteredisopoints.exe", "scatteredisopoints"),
                            ("scatteredisopoints/__main__.py", "python -m scatteredisopoints")):
            done = subprocess.run([sys.executable, "-c", script.format(name), "contour", "a.csv", "T", "9"],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, rf"\A{shown} contour: error: .*no isosurface")

    def test_pipes_that_are_closed_early(self):
        arguments = [*COMMAND, "probe", "a.npz", "--grid", "60,60,60"]
        with subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            process.stdout.readline()
            process.stdout.close()
            self.assertEqual((process.stderr.read(), process.wait()), (b"", 1))

    @unittest.skipIf(sys.platform == "win32", "there are no pseudo terminals")
    def test_terminals_and_interrupts(self):
        before, random = os.listdir(), np.random.default_rng(1)
        np.save("large.npy", random.random((400_000, 4)))
        main, end = os.openpty()
        process = subprocess.Popen([*COMMAND, "contour", "large.npy", "value", *map(str, np.linspace(0.1, 0.9, 50))],
                                   stdout=end, stderr=end)
        os.close(end)
        shown = b""
        while shown.count(b"%") < 3:
            shown += os.read(main, 1000)
        process.send_signal(signal.SIGINT)
        with contextlib.suppress(OSError):  # which tells that the other end is closed
            while True:
                shown += os.read(main, 1000)
        os.close(main)
        self.assertEqual(process.wait(), 1)
        self.assertRegex(shown.decode(), r"\A(\r *\d+ %\r)+\r?.*\r     \rpython.*contour: error: interrupted\r\n\Z")
        self.assertEqual(set(os.listdir()), {*before, "large.npy"})


if __name__ == "__main__":
    unittest.main()
