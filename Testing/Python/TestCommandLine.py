# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line, in a folder of its own; files of VTK where PyVista is installed."""

import contextlib
import importlib.util
import io
import os
import pathlib
import re
import shlex
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from unittest import mock

import numpy as np
from scatteredisopoints import _command_line, _reading, _writing, body, contour, probe, slice_samples

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
        self.assertRegex(errors, r'\A(.*contour: warning: "(nx|x|a_b|ö)" has the name ".*_" in the PLY file, .*\n){4}\Z')
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
            *((f"contour a.npz {name} 1", 1, f'the array "{name}" holds no numbers')
              for name in ("words", "objects", "dates", "nothing")),
            ("contour open.csv T 5", 1, "a quote in line 3 is not closed"),
            ("contour head_open.csv T 5", 1, "a quote in line 1 is not closed"),
            ("contour long.csv T 5", 1, "a quote in line 2 is not closed"),
            ("probe nan.csv --grid 2,2,2", 1, "No sample has a finite position"),
            ("probe a.csv --grid 1000000,1000000,1000000", 1, "Out of memory. Free memory"),
            ("contour a.csv T 0.3 --columns x,y,x", 1, "columns x, y, x are not different"),
            ("contour a.csv T 0.3 --columns x,y,q", 1, 'no "q": .* there are x, y, z, T$'),
            ("contour cut.ply T 0.3", 1, "cut.ply cannot be read: it ends after"), ("contour cut.npz T 1", 1, "zip"),
            ("contour minus.ply T 0.3", 1, "its header is not that of a PLY file"),
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
            ("contour a.csv T 1 --thread 1", 2, "unrecognized"), ("", 2, "COMMAND"), ("nothing", 2, "nothing"),
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
        pathlib.Path("made.ply").write_text("earlier")

        def fail(path, _):
            pathlib.Path(path).write_text("half")
            raise OSError(28, "No space left on device", path)

        with mock.patch.dict(_writing._WRITERS, {".ply": fail}):
            status, _, errors = run("contour", "a.npz", "T", 0.3, "-o", "made.ply")
        self.assertEqual(status, 1)
        self.assertRegex(errors, "No space left")
        self.assertEqual(pathlib.Path("made.ply").read_text(), "earlier")
        self.assertEqual(list(pathlib.Path().glob("*part*")), [])

    def test_help(self):
        for name in ("contour", "body", "slice", "probe"):
            status, out, _ = run(name, "--help")
            found = re.findall(rf"^  python -m scatteredisopoints ({name} .*)", out, re.MULTILINE)
            self.assertTrue(status == 0 and found)
            for example in found:  # which names no file that is there
                status, _, errors = run(*shlex.split(example))
                self.assertEqual(status, 1, errors)
                self.assertRegex(errors, "No such file")
        self.assertRegex(run("paraview")[1], "scattered_isopoints.py")
        self.assertRegex(run("--version")[1], r"^\d+\.\d+\.\d+$")

    def test_pipes_that_are_closed_early(self):
        arguments = [*COMMAND, "probe", "a.npz", "--grid", "60,60,60"]
        with subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            process.stdout.readline()
            process.stdout.close()
            self.assertEqual((process.stderr.read(), process.wait()), (b"", 1))

    @unittest.skipIf(sys.platform == "win32", "there are no pseudo terminals")
    def test_terminals_and_interrupts(self):
        random = np.random.default_rng(1)
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
        self.assertEqual(list(pathlib.Path().glob("*.ply.part*")) + list(pathlib.Path().glob("large_*")), [])


if __name__ == "__main__":
    unittest.main()
