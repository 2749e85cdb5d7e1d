# SPDX-License-Identifier: GPL-3.0-or-later
"""Includes go in one direction only: docs/architecture.md, "Folders". TestLayers.py ROOT"""

import pathlib
import re
import sys
import tempfile
import unittest

CORE = "Filters/Isopoint"

# Each folder of the core, and those whose headers its files may include besides its own.
CORE_FOLDERS = {
    "Base": [],
    "Tree": ["Base"],
    "Neighbors": ["Base", "Tree"],
    "Fit": ["Base"],
    "Extraction": ["Base", "Tree", "Neighbors", "Fit"],
    "Splat": ["Base", "Tree", "Neighbors", "Fit"],
    "": ["Base", "Tree", "Neighbors", "Fit", "Extraction", "Splat"],
}

# The other folders with sources, and the headers of the project that they may include.
FOLDERS = {
    "Filters": ["Filters/*.h", CORE + "/*.h", CORE + "/Base/*.h"],
    "Rendering": ["Rendering/*.h"],
    "Plugin/Representation": ["Plugin/Representation/*.h", "Rendering/vtkIsopointSplatMapper.h"],
}

MOST_FILES = 14
RENDERING = re.compile(r"vtk\w*(OpenGL|Render|Mapper|Actor|Shader|Camera|Texture|Light|Prop3D|View)")


def included(path):
    return re.findall(r'^\s*#\s*include\s*["<]([^">]+)[">]', path.read_text(), re.MULTILINE)


class Project:
    def __init__(self, root):
        self.root = pathlib.Path(root)
        self.problems = []
        folders = [CORE] + [f"{CORE}/{name}" for name in CORE_FOLDERS if name] + list(FOLDERS)
        self.files = {
            path.relative_to(self.root).as_posix(): path
            for folder in folders
            for path in sorted((self.root / folder).glob("*"))
            if path.suffix in (".h", ".cxx")
        }
        self.headers = {}  # by the last part of their names
        for name in self.files:
            if name.endswith(".h"):
                self.headers.setdefault(name.rsplit("/", 1)[-1], name)

    def own(self, include):
        """The header of the project that an include names, or None."""
        if include.startswith("Isopoint/"):
            return "Filters/" + include
        return self.headers.get(include.rsplit("/", 1)[-1])

    def check(self):
        for name, path in self.files.items():
            folder = name.rsplit("/", 1)[0]
            check = self.check_core if folder.startswith(CORE) else self.check_module
            for include in included(path):
                check(name, folder, include, self.own(include))
        self.check_unknown_folders()
        self.check_circles()
        return self.problems

    def report(self, name, problem):
        self.problems.append(f"{name}: {problem}")

    def check_core(self, name, folder, include, own):
        if include.startswith("vtk") or ".." in include:
            self.report(name, f"includes {include}: the core knows neither VTK nor relative paths")
        elif own:
            target = own[len(CORE):].rsplit("/", 1)[0].strip("/")
            source = folder[len(CORE):].strip("/")
            if not include.startswith("Isopoint/") or own not in self.files:
                self.report(name, f"includes {include}: not a header from Isopoint/")
            elif target != source and target not in CORE_FOLDERS[source]:
                self.report(name, f"includes {include}: against the direction")

    def check_module(self, name, folder, include, own):
        allowed = FOLDERS[folder]
        if own and not any(pathlib.PurePath(own).match(pattern) for pattern in allowed):
            self.report(name, f"includes {include}: {folder} may not know it")
        elif folder == "Filters" and RENDERING.match(include):
            self.report(name, f"includes {include}: filters know no rendering")

    def check_unknown_folders(self):
        for folder in sorted(path for path in (self.root / CORE).glob("**") if path.is_dir()):
            name = folder.relative_to(self.root / CORE).as_posix().replace(".", "")
            count = sum(path.suffix in (".h", ".cxx") for path in folder.glob("*"))
            if name not in CORE_FOLDERS:
                self.report(f"{CORE}/{name}", "a folder without a place in the order")
            if count > MOST_FILES:
                self.report(f"{CORE}/{name}", f"{count} files, more than {MOST_FILES}")
            if count == 0:
                self.report(f"{CORE}/{name}", "no sources")

    def check_circles(self):
        done, active = set(), []

        def visit(name):
            if name in active:
                self.report(name, "a circle: " + " > ".join(active[active.index(name):] + [name]))
            elif name not in done and name in self.files:
                active.append(name)
                for include in included(self.files[name]):
                    target = self.own(include)
                    if target and target != name:
                        visit(target)
                active.pop()
                done.add(name)

        for name in self.files:
            visit(name)


class LayersTest(unittest.TestCase):
    root = "."

    def test_includes_go_in_one_direction(self):
        self.assertEqual(Project(self.root).check(), [])

    def test_all_folders_with_sources_are_checked(self):
        names = Project(self.root).files
        for folder in list(FOLDERS) + [CORE] + [f"{CORE}/{name}" for name in CORE_FOLDERS if name]:
            self.assertTrue(any(name.startswith(folder + "/") for name in names), folder)

    def check_defect(self, files, expected):
        with tempfile.TemporaryDirectory() as root:
            for folder in list(CORE_FOLDERS):
                path = pathlib.Path(root) / CORE / folder / f"Plain{folder}.h"
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text("#include <vector>\n")
            for name, text in files.items():
                path = pathlib.Path(root) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            problems = "\n".join(Project(root).check())
            self.assertIn(expected, problems)

    def test_each_defect_is_found(self):
        core = CORE + "/"
        self.check_defect({core + "Base/A.h": '#include "vtkType.h"\n'}, "neither VTK")
        self.check_defect({core + "Base/A.h": '#include "Isopoint/Tree/PlainTree.h"\n'},
                          "against the direction")
        self.check_defect({core + "Fit/A.h": '#include "PlainFit.h"\n'}, "not a header from")
        self.check_defect({core + "Fit/A.h": '#include "Isopoint/Fit/B.h"\n',
                           core + "Fit/B.h": '#include "Isopoint/Fit/A.h"\n'}, "a circle")
        self.check_defect({core + "New/A.h": "\n"}, "without a place")
        self.check_defect({core + f"Fit/A{i}.h": "\n" for i in range(14)}, "more than 14")
        self.check_defect({"Filters/a.cxx": '#include "vtkOpenGLState.h"\n'}, "no rendering")
        self.check_defect({"Filters/a.cxx": '#include "Isopoint/Splat/PlainSplat.h"\n'},
                          "may not know")
        self.check_defect({"Filters/vtkA.h": "\n", "Rendering/b.cxx": '#include "vtkA.h"\n'},
                          "may not know")
        self.check_defect({"Rendering/vtkA.h": "\n",
                           "Plugin/Representation/b.cxx": '#include "vtkA.h"\n'}, "may not know")


if __name__ == "__main__":
    LayersTest.root = sys.argv.pop(1)
    unittest.main()
