# SPDX-License-Identifier: GPL-3.0-or-later
"""Includes go in one direction only: docs/architecture.md, "Folders". TestLayers.py ROOT"""

import pathlib
import re
import sys
import tempfile
import unittest

CORE = "Core"
TRACER = "RayTracing/Tracer"

# Each folder of the core, and those whose headers its files may include besides its own.
CORE_FOLDERS = {
    "Base": [],
    "Tree": ["Base"],
    "Neighbors": ["Base", "Tree"],
    "Fit": ["Base"],
    "Extraction": ["Base", "Tree", "Neighbors", "Fit"],
    "Splat": ["Base", "Tree", "Neighbors", "Fit"],
    "SplatMesh": ["Base"],
    "Tetrahedra": ["Base", "Tree", "Neighbors", "Fit", "Extraction"],
    "Triangles": ["Base", "Tree", "Neighbors", "Fit", "Extraction", "Splat", "Tetrahedra"],
    "Ranks": [
        "Base", "Tree", "Neighbors", "Fit", "Extraction", "Splat", "Tetrahedra", "Triangles"],
}

# Each folder with sources, and the headers of the project that they may include besides its own.
CORE_DOOR = [CORE + "/*.h", CORE + "/Base/*.h", CORE + "/Ranks/ByteBuffer.h"]
FOLDERS = {
    "Filters": ["Filters/Update/*.h", "Filters/Output/*.h", "Filters/Input/*.h"],
    "Filters/Update": ["Filters/Output/*.h", "Filters/Input/*.h", *CORE_DOOR],
    "Filters/Output": ["Filters/Input/*.h", *CORE_DOOR],
    "Filters/Input": CORE_DOOR,
    CORE: [CORE + "/*/*.h"],
    **{f"{CORE}/{name}": [f"{CORE}/{lower}/*.h" for lower in lowers]
       for name, lowers in CORE_FOLDERS.items()},
    "Library": [CORE + "/*.h", CORE + "/Base/*.h", CORE + "/SplatMesh/*.h"],
    "Rendering": [CORE + "/SplatMesh/*.h", CORE + "/Base/*.h"],
    "RayTracing": [TRACER + "/*.h", "Rendering/*.h", CORE + "/Base/*.h"],
    TRACER: [CORE + "/Base/*.h"],
    "Plugin/Window": [
        "Plugin/Exporter/vtkIsopointRayTracingExporter.h",
        "Plugin/Representation/vtkSMIsopointRepresentationDomain.h"],
    "Plugin/Exporter": ["RayTracing/vtkIsopointRayTracer.h"],
    "Plugin/Representation": [
        "Rendering/vtkIsopointPolygonMapper.h", "Rendering/vtkIsopointSplatPolygons.h"],
}

# What includes of other projects only some folders may have: a pattern of includes, and one of the
# folders that may have them.
OTHERS = {
    r"Eigen/": CORE + "/(Fit|Splat)",
    r"CGAL/": CORE + "/Tetrahedra",
    r"embree[34]/": TRACER,
    r"vtk": rf"(?!{CORE}|Library|{TRACER})",
    r"vtk(PV|SM(?!P[A-Z])|SI(?!L)|ClientServer|ProcessModule|ParaView)|pq[A-Z]": "Plugin",
    r"vtk(\w*(OpenGL|Render|Mapper|Actor|Shader|Camera|Texture|Light|View|HardwareSelector)"
    r"|(Prop|Volume)|\w*Window\b)": "(?!Filters)",
}

SOURCES = (".h", ".cxx")
OTHER_SUFFIXES = (".c", ".cc", ".cpp", ".c++", ".hh", ".hpp", ".hxx", ".inl", ".ipp", ".txx")


class Project:
    def __init__(self, root):
        self.root = pathlib.Path(root)
        self.problems = []
        paths = [path for top in ("Core", "Library", "Filters", "Rendering", "RayTracing", "Plugin")
                 for path in sorted((self.root / top).rglob("*"))]
        for path in paths:
            if path.suffix in OTHER_SUFFIXES:
                self.report(self.name(path), "an unexpected suffix: sources are .h and .cxx")
        self.files = {self.name(path): path.read_text() for path in paths if path.suffix in SOURCES}
        self.tests = {path.name for path in (self.root / "Testing").rglob("*.h")}
        self.own_headers = {}  # by the last part of their names
        for name in self.files:
            if name.endswith(".h"):
                self.own_headers.setdefault(name.rsplit("/", 1)[-1], name)

    def name(self, path):
        return path.relative_to(self.root).as_posix()

    def report(self, name, problem):
        self.problems.append(f"{name}: {problem}")

    def includes(self, name):
        return re.findall(r'^\s*#\s*(?:include|import)\s*["<]([^">]+)[">]', self.files[name],
                          re.MULTILINE)

    def own(self, include):
        """The header of the project that an include names, or None."""
        if include.startswith(("Core/", "Library/")):
            return include
        if include.startswith("Tracer/"):
            return "RayTracing/" + include
        return self.own_headers.get(include.rsplit("/", 1)[-1])

    def check(self):
        for name in self.files:
            folder = name.rsplit("/", 1)[0]
            if folder not in FOLDERS:
                self.report(name, "in a folder that no rule names")
                continue
            for include in self.includes(name):
                self.check_include(name, folder, include)
        self.check_circles()
        return self.problems

    def check_include(self, name, folder, include):
        own = self.own(include)
        if include.endswith((".cxx", ".cpp", ".cc", ".c")):
            self.report(name, f"includes {include}: not a header")
        if own:
            allowed = [folder + "/*.h"] + FOLDERS[folder]
            if not any(pathlib.PurePath(own).match(pattern) for pattern in allowed):
                self.report(name, f"includes {include}: {folder} may not know it")
            if folder.startswith(CORE) and not include.startswith(CORE + "/"):
                self.report(name, f"includes {include}: not written from the top folder")
        elif include.rsplit("/", 1)[-1] in self.tests:
            self.report(name, f"includes {include}: a header of the tests")
        for pattern, homes in OTHERS.items():
            if re.match(pattern, include) and not re.match(homes, folder):
                self.report(name, f"includes {include}: does not belong into {folder}")

    def check_circles(self):
        """Of components: a header, the source of its name, and headers that only this includes."""
        targets = {name: {own for own in map(self.own, self.includes(name)) if own}
                   for name in self.files}

        def component(name):
            users = [user for user in targets if name in targets[user]]
            is_part = len(users) == 1 and users[0].endswith(".cxx")
            return (users[0] if is_part else name).rsplit(".", 1)[0]

        components = {name: component(name) for name in self.files}
        uses = {}
        for name, own in targets.items():
            used = {components[target] for target in own if target in components}
            uses.setdefault(components[name], set()).update(used - {components[name]})
        done, active = set(), []

        def visit(component):
            if component in active:
                circle = active[active.index(component):] + [component]
                self.report(component, "a circle: " + " > ".join(circle))
            elif component not in done:
                active.append(component)
                for target in sorted(uses.get(component, ())):
                    visit(target)
                active.pop()
                done.add(component)

        for component in uses:
            visit(component)


class LayersTest(unittest.TestCase):
    root = "."
    maxDiff = None

    def test_includes_go_in_one_direction(self):
        self.assertEqual(Project(self.root).check(), [])

    def test_all_folders_have_sources(self):
        folders = {name.rsplit("/", 1)[0] for name in Project(self.root).files}
        self.assertEqual(folders, set(FOLDERS))

    def check_defect(self, files, expected):
        with tempfile.TemporaryDirectory() as root:
            for name, text in files.items():
                path = pathlib.Path(root) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            self.assertIn(expected, "\n".join(Project(root).check()))

    def test_each_defect_is_found(self):
        fit = CORE + "/Fit/"
        self.check_defect({fit + "A.h": '#include "vtkType.h"\n'}, "does not belong")
        self.check_defect({"Filters/a.cxx": '#include "vtkOpenGLState.h"\n'}, "does not belong")
        self.check_defect({"Rendering/a.cxx": '#include "vtkSMProxy.h"\n'}, "does not belong")
        self.check_defect({"Rendering/a.cxx": "#include <Eigen/Core>\n"}, "does not belong")
        self.check_defect({CORE + "/Base/A.h": '#include "Core/Fit/B.h"\n', fit + "B.h": ""},
                          "may not know")
        self.check_defect({"Filters/Input/a.cxx": '#include "Output/vtkA.h"\n',
                           "Filters/Output/vtkA.h": ""}, "may not know")
        self.check_defect({fit + "A.h": '#include "B.h"\n', fit + "B.h": ""}, "not written from")
        self.check_defect({fit + "A.h": '#include "b.cxx"\n'}, "not a header")
        self.check_defect({"Filters/a.cxx": '#include "A.h"\n', "Testing/A.h": ""}, "of the tests")
        self.check_defect({"Filters/New/a.cxx": ""}, "no rule names")
        self.check_defect({"Filters/a.cpp": ""}, "unexpected suffix")

    def test_a_circle_of_components_is_found(self):
        self.check_defect(
            {"Filters/vtkA.h": "", "Filters/vtkA.cxx": '#include "vtkA.h"\n#include "vtkB.h"\n',
             "Filters/vtkB.h": "", "Filters/vtkB.cxx": '#include "vtkB.h"\n#include "vtkA.h"\n'},
            "a circle: Filters/vtkA > Filters/vtkB > Filters/vtkA")


if __name__ == "__main__":
    LayersTest.root = sys.argv.pop(1)
    unittest.main()
