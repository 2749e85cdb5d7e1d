# SPDX-License-Identifier: GPL-3.0-or-later
"""Includes go in one direction only: docs/architecture.md, "Folders". TestLayers.py ROOT"""

import contextlib
import pathlib
import re
import sys
import tempfile
import unittest

CORE = "Filters/Isopoint"
TRACER = "RayTracing/Tracer"

# Each folder of the core, and those whose headers its files may include besides its own.
CORE_FOLDERS = {
    "Base": [],
    "Tree": ["Base"],
    "Neighbors": ["Base", "Tree"],
    "Fit": ["Base"],
    "Extraction": ["Base", "Tree", "Neighbors", "Fit"],
    "Splat": ["Base", "Tree", "Neighbors", "Fit"],
    "Tetrahedra": ["Base", "Tree", "Neighbors", "Fit", "Extraction"],
    "Triangles": ["Base", "Tree", "Neighbors", "Fit", "Extraction", "Splat", "Tetrahedra"],
    "Ranks": [
        "Base", "Tree", "Neighbors", "Fit", "Extraction", "Splat", "Tetrahedra", "Triangles"],
    "": [
        "Base", "Tree", "Neighbors", "Fit", "Extraction", "Splat", "Tetrahedra", "Triangles",
        "Ranks"],
}

# The other folders with sources, and the headers of the project that they may include.
FOLDERS = {
    "Filters": ["Filters/*.h", CORE + "/*.h", CORE + "/Base/*.h", CORE + "/Ranks/ByteBuffer.h"],
    "Rendering": ["Rendering/*.h"],
    "RayTracing": ["RayTracing/*.h", TRACER + "/*.h", "Rendering/*.h", CORE + "/Base/*.h"],
    TRACER: [TRACER + "/*.h", CORE + "/Base/*.h"],
    "Plugin/Window": [
        "Plugin/Window/*.h", "Plugin/Exporter/vtkIsopointRayTracingExporter.h",
        "Plugin/Representation/vtkSMIsopointRepresentationDomain.h"],
    "Plugin/Exporter": ["Plugin/Exporter/*.h", "RayTracing/vtkIsopointRayTracer.h"],
    "Plugin/Representation": [
        "Plugin/Representation/*.h", "Rendering/vtkIsopointPolygonMapper.h",
        "Rendering/vtkIsopointSplatPolygons.h"],
}

# The folders that alone may include a library.
LIBRARIES = {
    "Eigen": [CORE + "/Fit"],
    "CGAL": [CORE + "/Splat", CORE + "/Tetrahedra"],
    "embree3": [TRACER],
    "embree4": [TRACER],
}

TOP_FOLDERS = ("Filters", "Rendering", "RayTracing", "Plugin")
SOURCES = (".h", ".cxx")
OTHER_SUFFIXES = (".c", ".cc", ".cpp", ".c++", ".hh", ".hpp", ".hxx", ".inl", ".ipp", ".txx")
RENDERING = re.compile(
    r"vtk\w*(OpenGL|Render|Mapper|Actor|Shader|Camera|Texture|Light|View|HardwareSelector)"
    r"|vtk(Prop|Volume)|vtk\w*Window\b"
)
PARAVIEW = re.compile(r"vtk(PV|SM(?!P[A-Z])|SI(?!L)|ClientServer|ProcessModule|ParaView)|pq[A-Z]")


def included(path):
    pattern = r'^\s*#\s*(?:include|import)\s*["<]([^">]+)[">]'
    return re.findall(pattern, path.read_text(), re.MULTILINE)


class Project:
    def __init__(self, root):
        self.root = pathlib.Path(root)
        self.problems = []
        folders = [CORE] + [f"{CORE}/{name}" for name in CORE_FOLDERS if name] + list(FOLDERS)
        self.files = {
            path.relative_to(self.root).as_posix(): path
            for folder in folders
            for path in sorted((self.root / folder).glob("*"))
            if path.suffix in SOURCES
        }
        self.folders = folders
        self.test_headers = [
            path.relative_to(self.root).as_posix() for path in (self.root / "Testing").glob("**/*.h*")
        ]
        self.headers = {}  # by the last part of their names
        for name in self.files:
            if name.endswith(".h"):
                self.headers.setdefault(name.rsplit("/", 1)[-1], name)

    def own(self, include):
        """The header of the project that an include names, or None."""
        if include.startswith("Isopoint/"):
            return "Filters/" + include
        if include.startswith("Tracer/"):
            return "RayTracing/" + include
        return self.headers.get(include.rsplit("/", 1)[-1])

    def check(self):
        for name, path in self.files.items():
            folder = name.rsplit("/", 1)[0]
            check = self.check_core if folder.startswith(CORE) else self.check_module
            if re.search(r"^\s*#\s*import\b", path.read_text(), re.MULTILINE):
                self.report(name, "#import instead of #include")
            for include in included(path):
                check(name, folder, include, self.own(include))
                self.check_everywhere(name, folder, include)
        self.check_all_files()
        self.check_core_folders()
        self.check_circles()
        return self.problems

    def report(self, name, problem):
        self.problems.append(f"{name}: {problem}")

    def check_everywhere(self, name, folder, include):
        if include.endswith((".cxx", ".cpp", ".cc", ".c")):
            self.report(name, f"includes {include}: not a header")
        for library, homes in LIBRARIES.items():
            if library in include.split("/")[:-1] and folder not in homes:
                self.report(name, f"includes {include}: {library} belongs into {' or '.join(homes)}")
        path = "/" + re.sub(r"^(\.\.?/)+", "", include)
        if any(("/" + header).endswith(path) for header in self.test_headers) and (
            "Testing/" in include or not self.own(include)
        ):
            self.report(name, f"includes {include}: a header of the tests")
        if PARAVIEW.match(include.rsplit("/", 1)[-1]) and not folder.startswith("Plugin"):
            self.report(name, f"includes {include}: ParaView belongs into Plugin")

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
        elif folder == "Filters" and RENDERING.match(include.rsplit("/", 1)[-1]):
            self.report(name, f"includes {include}: filters know no rendering")
        elif folder == TRACER and include.startswith("vtk"):
            self.report(name, f"includes {include}: the tracer knows no VTK")

    def check_all_files(self):
        for path in sorted(path for top in TOP_FOLDERS for path in (self.root / top).glob("**/*")):
            name = path.relative_to(self.root).as_posix()
            if path.suffix in OTHER_SUFFIXES:
                self.report(name, "an unexpected suffix: sources are .h and .cxx")
            elif path.suffix in SOURCES and name.rsplit("/", 1)[0] not in self.folders:
                self.report(name, "in a folder that no rule names")

    def check_core_folders(self):
        for folder in sorted(path for path in (self.root / CORE).glob("**") if path.is_dir()):
            name = folder.relative_to(self.root / CORE).as_posix().replace(".", "")
            count = sum(path.suffix in (".h", ".cxx") for path in folder.glob("*"))
            if name not in CORE_FOLDERS:
                self.report(f"{CORE}/{name}", "a folder without a place in the order")
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
                    if target:
                        visit(target)
                active.pop()
                done.add(name)

        for name in self.files:
            visit(name)


class LayersTest(unittest.TestCase):
    root = "."
    maxDiff = None

    def test_includes_go_in_one_direction(self):
        self.assertEqual(Project(self.root).check(), [])

    def test_all_folders_with_sources_are_checked(self):
        names = Project(self.root).files
        for folder in list(FOLDERS) + [CORE] + [f"{CORE}/{name}" for name in CORE_FOLDERS if name]:
            self.assertTrue(any(name.startswith(folder + "/") for name in names), folder)

    def problems(self, files):
        with self.project(files) as root:
            return "\n".join(Project(root).check())

    def check_defect(self, files, expected):
        self.assertIn(expected, self.problems(files))

    @contextlib.contextmanager
    def project(self, files):
        """The root of a project of plain files and those given, by their names."""
        with tempfile.TemporaryDirectory() as root:
            for folder in list(CORE_FOLDERS):
                path = pathlib.Path(root) / CORE / folder / f"Plain{folder}.h"
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text("#include <vector>\n")
            for name, text in files.items():
                path = pathlib.Path(root) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            yield root

    def test_each_defect_is_found(self):
        core = CORE + "/"
        self.check_defect({core + "Base/A.h": '#include "vtkType.h"\n'}, "neither VTK")
        self.check_defect({core + "Base/A.h": '#include "Isopoint/Tree/PlainTree.h"\n'},
                          "against the direction")
        self.check_defect({core + "Fit/A.h": '#include "PlainFit.h"\n'}, "not a header from")
        self.check_defect({core + "Fit/A.h": '#include "Isopoint/Fit/B.h"\n',
                           core + "Fit/B.h": '#include "Isopoint/Fit/A.h"\n'}, "a circle")
        self.check_defect({core + "New/A.h": "\n"}, "without a place")
        self.check_defect({"Filters/a.cxx": '#include "vtkOpenGLState.h"\n'}, "no rendering")
        self.check_defect({"Filters/a.cxx": '#include "Isopoint/Splat/PlainSplat.h"\n'},
                          "may not know")
        self.check_defect({"Filters/vtkA.h": "\n", "Rendering/b.cxx": '#include "vtkA.h"\n'},
                          "may not know")
        self.check_defect({"Rendering/vtkA.h": "\n",
                           "Plugin/Representation/b.cxx": '#include "vtkA.h"\n'}, "may not know")
        self.check_defect({"Filters/vtkA.h": "\n", "RayTracing/b.cxx": '#include "vtkA.h"\n'},
                          "may not know")
        self.check_defect({"RayTracing/Tracer/A.h": '#include "vtkType.h"\n'}, "knows no VTK")
        self.check_defect({"RayTracing/vtkA.h": "\n", "Rendering/b.cxx": '#include "vtkA.h"\n'},
                          "may not know")
        self.check_defect({"RayTracing/a.cxx": "#include <embree4/rtcore.h>\n"}, "embree4 belongs into")
        self.check_defect({"Rendering/a.cxx": '#import "vtkType.h"\n'}, "#import")
        for name in (core + "Fit/A.h", "Rendering/A.h"):
            include = name.replace("Filters/", "")
            self.check_defect({name: f'#include "{include}"\n'}, f"a circle: {name} > {name}")
        for suffix in ("cpp", "hxx", "hpp", "cc", "c"):
            for folder in (core + "Fit", "Filters", "Rendering", "Plugin/Representation"):
                self.check_defect({f"{folder}/a.{suffix}": "\n"}, "an unexpected suffix")
        for name in ("Filters/New/a.cxx", "Rendering/New/a.h", "Plugin/a.cxx", "Plugin/New/a.h"):
            self.check_defect({name: "\n"}, f"{name}: in a folder that no rule names")

    def test_unwanted_includes_are_found(self):
        places = (CORE + "/Fit/a.cxx", "Filters/a.cxx", "Rendering/a.cxx", "Plugin/Representation/a.cxx")
        for name in places:
            self.check_defect({name: '#include "b.cxx"\n'}, "not a header")
            for path in ("Random.h", "Cxx/Random.h", "../Testing/Cxx/Random.h"):
                self.check_defect({name: f'#include "{path}"\n', "Testing/Cxx/Random.h": "\n"},
                                  "a header of the tests")
            for library, homes in (("Eigen", ["Fit"]), ("CGAL", ["Splat", "Tetrahedra"])):
                include = f"#include <{library}/Core>\n"
                for home in homes:
                    self.assertEqual(self.problems({f"{CORE}/{home}/a.cxx": include}), "")
                if not name.startswith(tuple(f"{CORE}/{home}/" for home in homes)):
                    self.check_defect({name: include}, f"{library} belongs into")
        for header in ("vtkPVView.h", "vtkSMProxy.h", "vtkSMPropertyHelper.h", "pqView.h"):
            include = f'#include "{header}"\n'
            self.check_defect({"Filters/a.cxx": include}, "ParaView belongs into")
            self.check_defect({"Rendering/a.cxx": include}, "ParaView belongs into")
            self.assertEqual(self.problems({"Plugin/Representation/a.cxx": include}), "")
        for name in ("HardwareSelector", "Prop", "Window", "Volume", "Property", "Camera", "Viewport"):
            self.check_defect({"Filters/a.cxx": f'#include "vtk{name}.h"\n'}, "no rendering")
        for header in ("vtkSMPTools.h", "vtkSMPThreadLocal.h", "vtkType.h", "CGAL_a/Random.h"):
            self.assertEqual(self.problems({"Filters/a.cxx": f'#include "{header}"\n'}), "")

    def test_all_problems_are_shown(self):
        names = [f"Filters/a{i}.cxx" for i in range(100)]
        with self.project({name: '#include "vtkProp.h"\n' for name in names}) as root:
            test = LayersTest("test_includes_go_in_one_direction")
            test.root, result = root, unittest.TestResult()
            test.run(result)
        for name in names:
            self.assertIn(f"{name}: ", result.failures[0][1])


if __name__ == "__main__":
    LayersTest.root = sys.argv.pop(1)
    unittest.main()
