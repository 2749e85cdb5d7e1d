# SPDX-License-Identifier: GPL-3.0-or-later
"""Includes go in one direction only: docs/architecture.md, "Folders". TestLayers.py ROOT"""

import pathlib
import re
import sys
import tempfile
import unittest

TO_SPLAT = ("Base", "Tree", "Neighbors", "Fit")
TO_TRIANGLES = (*TO_SPLAT, "Extraction", "Splat", "Tetrahedra")
# Each folder of the core, and the folders whose headers its files may include besides its own.
CORE_FOLDERS = {
    "Base": (), "Tree": ("Base",), "Neighbors": ("Base", "Tree"), "Fit": ("Base",), "Extraction": TO_SPLAT,
    "Splat": (*TO_SPLAT, "Extraction"), "SplatMesh": ("Base",), "Tetrahedra": (*TO_SPLAT, "Extraction"),
    "Triangles": (*TO_SPLAT, "Extraction", "Tetrahedra"),
    "Ranks": (*TO_TRIANGLES, "Triangles")}
# Each folder with sources, and the headers of the project that they may include besides its own.
FROM_FILTERS = ("Common/*.h", "Core/*.h", "Core/Base/*.h", "Core/Ranks/ByteBuffer.h")
FOLDERS = {
    "Filters": ("Filters/Update/*.h", "Filters/Output/*.h", "Filters/Input/*.h"),
    "Filters/Update": ("Filters/Output/*.h", "Filters/Input/*.h", *FROM_FILTERS),
    "Filters/Output": ("Filters/Input/*.h", *FROM_FILTERS),
    "Filters/Input": FROM_FILTERS,
    "Core": ("Core/*/*.h",),
    **{f"Core/{name}": [f"Core/{lower}/*.h" for lower in lowers] for name, lowers in CORE_FOLDERS.items()},
    "Library": ("Core/*.h", "Core/Base/*.h", "Core/SplatMesh/*.h"),
    "Common": ("Core/Base/*.h",),
    "Rendering": ("Common/*.h", "Core/SplatMesh/*.h", "Core/Base/*.h"),
    "RayTracing": ("RayTracing/Tracer/*.h", "Rendering/*.h", "Core/Base/*.h"),
    "RayTracing/Tracer": ("Core/Base/*.h",),
    "Plugin/Window": ("Plugin/Exporter/vtkIsopointRayTracingExporter.h",
                      "Plugin/Representation/vtkSMIsopointRepresentationDomain.h"),
    "Plugin/Exporter": ("RayTracing/vtkIsopointRayTracer.h",),
    "Plugin/Representation": ("Rendering/vtkIsopointPolygonMapper.h", "Rendering/vtkIsopointSplatPolygons.h")}
# Patterns of other projects' headers, and of the folders that may include them.
OTHERS = {
    r"Eigen/": r"Core/(Fit|Splat)", r"CGAL/": r"Core/Tetrahedra", r"embree[34]/": r"RayTracing/Tracer",
    r"vtk": r"(?!Core|Library|RayTracing/Tracer)",
    r"vtk(PV|SM(?!P[A-Z])|SI(?!L)|ClientServer|ProcessModule|ParaView)|pq[A-Z]": r"Plugin",
    r"vtk(\w*(OpenGL|Render|Mapper|Actor|Shader|Camera|Texture|Light|View|HardwareSelector)|(Prop|Volume)|\w*Window\b)":
        r"(?!Filters|Common)"}


def problems_of(root):
    root = pathlib.Path(root)
    paths = [path for top in ("Core", "Library", "Common", "Filters", "Rendering", "RayTracing", "Plugin")
             for path in sorted((root / top).rglob("*"))]
    files = {path.relative_to(root).as_posix(): path.read_text() for path in paths if path.suffix in (".h", ".cxx")}
    problems = [f"{path}: an unexpected suffix" for path in paths
                if re.fullmatch(r"\.(c|cc|cpp|c\+\+|hh|hpp|hxx|inl|ipp|txx)", path.suffix)]
    tests = {path.name for path in (root / "Testing").rglob("*.h")}
    headers = {name.rpartition("/")[2]: name for name in reversed(files) if name.endswith(".h")}
    own = {name: set() for name in files}  # the project's headers that each file includes
    for name, text in files.items():
        folder = name.rpartition("/")[0]
        if folder not in FOLDERS:
            problems.append(f"{name}: in a folder that no rule names")
            continue
        for include in re.findall(r'^\s*#\s*(?:include|import)\s*["<]([^">]+)[">]', text, re.MULTILINE):
            last = include.rpartition("/")[2]
            header = re.sub("^Tracer/", "RayTracing/Tracer/", include)
            header = header if re.match("Core/|Library/|RayTracing/Tracer/", header) else headers.get(last)
            allowed = header and any(map(pathlib.PurePath(header).match, (folder + "/*.h", *FOLDERS[folder])))
            own[name].update({header} & set(files))
            foreign = [pattern for pattern, homes in OTHERS.items()
                       if re.match(pattern, include) and not re.match(homes, folder)]
            for is_wrong, reason in (
                    (re.search(r"\.(cxx|cpp|cc|c)$", include), "not a header"),
                    (header and not allowed, f"{folder} may not know it"),
                    (header and folder.startswith("Core") and not include.startswith("Core/"), "not from the top folder"),
                    (not header and last in tests, "a header of the tests"), (foreign, f"does not belong into {folder}")):
                problems += [f"{name}: includes {include}: {reason}"] if is_wrong else []
    return problems + circles(own)


def circles(own):
    """Circles of components: a header, the source of its name, and headers that only this source includes."""
    def component(name):
        users = [user for user in own if name in own[user]]
        return (users[0] if len(users) == 1 and users[0].endswith(".cxx") else name).rpartition(".")[0]

    uses = {}
    for name, headers in own.items():
        uses.setdefault(component(name), set()).update(set(map(component, headers)) - {component(name)})
    while uses:
        done = {part for part in uses if not uses[part] & set(uses)}
        if not done:
            return [f"a circle among {', '.join(sorted(uses))}"]
        uses = {part: uses[part] for part in set(uses) - done}
    return []


class LayersTest(unittest.TestCase):
    root = "."

    def test_includes_go_in_one_direction(self):
        self.assertEqual(problems_of(self.root), [])

    def test_all_folders_have_sources(self):
        folders = [folder for folder in FOLDERS if any(
            path.suffix in (".h", ".cxx") for path in pathlib.Path(self.root, folder).glob("*"))]
        self.assertEqual(folders, list(FOLDERS))

    def test_each_defect_is_found(self):
        for word, files in (
                ("belong", {"Core/Fit/A.h": '#include "vtkType.h"\n'}),
                ("belong", {"Filters/a.cxx": '#include "vtkOpenGLState.h"\n'}),
                ("belong", {"Rendering/a.cxx": '#include "vtkSMProxy.h"\n'}),
                ("belong", {"Rendering/a.cxx": "#include <Eigen/Core>\n"}),
                ("may not know", {"Core/Base/A.h": '#include "Core/Fit/B.h"\n', "Core/Fit/B.h": ""}),
                ("may not know", {"Filters/Input/a.cxx": '#include "Output/B.h"\n', "Filters/Output/B.h": ""}),
                ("top folder", {"Core/Fit/A.h": '#include "B.h"\n', "Core/Fit/B.h": ""}),
                ("not a header", {"Core/Fit/A.h": '#include "b.cxx"\n'}),
                ("of the tests", {"Filters/a.cxx": '#include "A.h"\n', "Testing/A.h": ""}),
                ("no rule", {"Filters/New/a.cxx": ""}), ("suffix", {"Filters/a.cpp": ""}),
                ("a circle among Filters/A, Filters/B", {
                    "Filters/A.h": "", "Filters/A.cxx": '#include "A.h"\n#include "B.h"\n',
                    "Filters/B.h": "", "Filters/B.cxx": '#include "B.h"\n#include "A.h"\n'})):
            with self.subTest(files), tempfile.TemporaryDirectory() as root:
                for name, text in files.items():
                    pathlib.Path(root, name).parent.mkdir(parents=True, exist_ok=True)
                    pathlib.Path(root, name).write_text(text)
                found = problems_of(root)
                self.assertTrue(len(found) == 1 and word in found[0], found)


if __name__ == "__main__":
    LayersTest.root = sys.argv.pop(1)
    unittest.main()
