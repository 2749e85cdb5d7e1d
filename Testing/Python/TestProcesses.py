# SPDX-License-Identifier: GPL-3.0-or-later
"""The C library in processes that end, threads that end, and folders of any name: TestProcesses.py [PROCESSES]

The wheels have oneTBB in the library, whose code is in use while its threads run.
"""

import ctypes
import gc
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest

import _ctypes
import numpy as np

import scatteredisopoints
from scatteredisopoints import _library, contour

PROCESSES = 5
FREE = "FreeLibrary" if os.name == "nt" else "dlclose"
CONTOUR = """
import numpy as np
from scatteredisopoints import _library, contour
positions = np.random.default_rng(1).random((20000, 3))
count = len(contour(positions, positions.sum(axis=1), 1.5, triangles=True))
"""


def printed(script, **environment):
    """What a script prints, without a trace of trouble."""
    result = subprocess.run([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            env={**os.environ, **environment}, timeout=120)
    text = result.stdout.decode(errors="replace")
    if result.returncode != 0:
        raise AssertionError(f"ends with {result.returncode}: {text}")
    return text.split()


class Processes(unittest.TestCase):
    def test_they_end(self):
        expected = printed(CONTOUR + "print(count)")
        self.assertGreater(int(expected[0]), 100)
        for number in range(PROCESSES):
            with self.subTest(number):
                self.assertEqual(printed(CONTOUR + "print(count)"), expected)

    def test_the_library_is_unloaded_and_loaded(self):
        # What uses the library lives on, so the process ends at once.
        self.assertEqual(printed("import _ctypes, ctypes, gc, os" + CONTOUR.replace(
            "triangles=True", "triangles=True, threads=1") + f"""
gc.collect()
handle = _library._library._handle
for _ in range(3):
    _ctypes.{FREE}(handle)
    library = ctypes.CDLL(_library.LIBRARY)
    handle = library._handle
    library.isopoint_version.restype = ctypes.c_char_p
    print(library.isopoint_version().decode(), flush=True)
os._exit(0)
"""), 3 * [_library.version().decode()])

    def test_the_library_stays_with_its_threads(self):
        find = "ctypes.windll.kernel32.GetModuleHandleW(_library.LIBRARY)" if os.name == "nt" else (
            "ctypes.CDLL(_library.LIBRARY, os.RTLD_NOLOAD)")
        self.assertEqual(printed("import _ctypes, ctypes, os" + CONTOUR + f"""
_ctypes.{FREE}(_library._library._handle)
assert {find}
print(count == len(contour(positions, positions.sum(axis=1), 1.5, triangles=True)))
"""), ["True"])

    def test_folders_with_any_letters(self):
        package = pathlib.Path(scatteredisopoints.__file__).parent
        with tempfile.TemporaryDirectory() as folder:
            tree = pathlib.Path(folder) / "Größe 点"
            try:
                shutil.copytree(package, tree / package.name)
            except UnicodeEncodeError:
                self.skipTest("file names have no such letters")
            library = tree / package.name / pathlib.Path(_library.LIBRARY).name
            shutil.copy(_library.LIBRARY, library)
            paths = tree / package.name / "_paths.py"
            paths.write_text(paths.read_text(encoding="utf-8").replace('/../', '/').replace(
                "LIBRARY = ", f'LIBRARY = str(_HERE / "{library.name}")  # '), encoding="utf-8")
            self.assertEqual(printed(CONTOUR + "print(ascii(_library.LIBRARY))", PYTHONPATH=str(tree)),
                             ascii(str(library)).split())


class Threads(unittest.TestCase):
    def test_they_end(self):
        positions = np.random.default_rng(1).random((5000, 3))
        expected = len(contour(positions, positions.sum(axis=1), 1.5, triangles=True))
        found = []

        def work():
            found.append(len(contour(positions, positions.sum(axis=1), 1.5, triangles=True)))

        for _ in range(30):
            both = [threading.Thread(target=work) for _ in range(2)]
            for thread in both:
                thread.start()
            for thread in both:
                thread.join(60)
                self.assertFalse(thread.is_alive())
        self.assertEqual(found, 60 * [expected])


class Files(unittest.TestCase):
    def test_mapped_arrays(self):
        """Their files are free after the call: Windows removes none that is in use."""
        with tempfile.TemporaryDirectory() as folder:
            positions = np.random.default_rng(1).random((5000, 3))
            expected = contour(positions, positions.sum(axis=1), 1.5).points
            for name, array in (("positions.npy", positions), ("values.npy", positions.sum(axis=1))):
                np.save(os.path.join(folder, name), array)
            mapped = [np.load(os.path.join(folder, name), mmap_mode="r") for name in ("positions.npy", "values.npy")]
            surface = contour(*mapped, 1.5)
            self.assertEqual(surface.points.tobytes(), expected.tobytes())
            del mapped
            gc.collect()
            for name in ("positions.npy", "values.npy"):
                os.remove(os.path.join(folder, name))


if __name__ == "__main__":
    if len(sys.argv) > 1 and sys.argv[1].isdigit():
        PROCESSES = int(sys.argv.pop(1))
    unittest.main()
