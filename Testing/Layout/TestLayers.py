# SPDX-License-Identifier: GPL-3.0-or-later
"""Includes go in one direction only: docs/architecture.md, "Folders". TestLayers.py ROOT"""

import collections
import graphlib
import pathlib
import re
import sys
import tempfile
import unittest

# Each folder of the core, and those whose headers its files may include besides its own.
CORE_FOLDERS = {
    "Base": "", "Tree": "Base", "Neighbors": "Base Tree", "Fit": "Base", "Places": "Base Tree Neighbors Fit",
    "Extraction": "Base Tree Neighbors Fit", "Splat": "Base Tree Neighbors Fit Extraction", "SplatMesh": "Base",
    "Tetrahedra": "Base Tree Neighbors Fit Extraction", "Triangles": "Base Tree Neighbors Fit Extraction Tetrahedra",
    "Ranks": "Base Tree Neighbors Fit Extraction Splat Tetrahedra Triangles"}
# Each folder with sources, and the headers of the project that they may include besides its own.
FROM_FILTERS = ("Common/*.h", "Core/*.h", "Core/Base/*.h", "Core/Places/ProbeRequest.h", "Core/Ranks/ByteBuffer.h")
FOLDERS = {
    "Filters": ("Filters/Update/*.h", "Filters/Output/*.h", "Filters/Input/*.h"),
    "Filters/Update": ("Filters/Output/*.h", "Filters/Input/*.h", *FROM_FILTERS),
    "Filters/Output": ("Filters/Input/*.h", *FROM_FILTERS),
    "Filters/Input": FROM_FILTERS,
    "Core": ("Core/*/*.h",),
    **{f"Core/{name}": [f"Core/{lower}/*.h" for lower in lowers.split()] for name, lowers in CORE_FOLDERS.items()},
    "Library": ("Core/*.h", "Core/Base/*.h", "Core/SplatMesh/*.h"),
    "Common": ("Core/Base/*.h",),
    "Rendering": ("Common/*.h", "Core/SplatMesh/*.h", "Core/Base/*.h"),
    "Plugin/Window": ("Plugin/Representation/vtkSMIsopointRepresentationDomain.h",),
    "Plugin/Representation": ("Rendering/vtkIsopointPolygonMapper.h", "Rendering/vtkIsopointSplatPolygons.h")}
# Patterns of other projects' headers, and of the folders that may include them.
OTHERS = {
    r"Eigen/": r"Core/(Fit|Splat)", r"CGAL/": r"Core/Tetrahedra", r"vtk": r"(?!Core|Library)",
    r"vtk(PV|SM(?!P[A-Z])|SI(?!L)|ClientServer|ProcessModule|ParaView)|pq[A-Z]": r"Plugin",
    r"vtk(\w*(OpenGL|Render|Mapper|Actor|Shader|Camera|Texture|Light|View|HardwareSelector)|(Prop|Volume)|\w*Window\b)":
        r"(?!Filters|Common)"}


def problems_of(root):
    root = pathlib.Path(root)
    paths = [path for top in ("Core", "Library", "Common", "Filters", "Rendering", "Plugin")
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
            header = include if re.match("Core/|Library/", include) else headers.get(last, "")
            own[name].update({header} & set(files))
            allowed = any(map(pathlib.PurePath(header).match, (folder + "/*.h", *FOLDERS[folder])))
            foreign = any(re.match(other, include) and not re.match(homes, folder) for other, homes in OTHERS.items())
            problems += [f"{name}: includes {include}: {reason}" for reason, is_so in {
                "not a header": re.search(r"\.(cxx|cpp|cc|c)$", include),
                f"{folder} may not know it": header and not allowed,
                "not from the top folder": header and folder.startswith("Core") and not include.startswith("Core/"),
                "a header of the tests": not header and last in tests,
                f"does not belong into {folder}": foreign}.items() if is_so]
    return problems + circles(own)


def circles(own):
    """A circle of components: a header, the source of its name, and headers that only this source includes."""
    def component(name):
        users = [user for user in own if name in own[user]]
        return (users[0] if len(users) == 1 and users[0].endswith(".cxx") else name).rpartition(".")[0]

    uses = collections.defaultdict(set)
    for name, headers in own.items():
        uses[component(name)].update(set(map(component, headers)) - {component(name)})
    try:
        graphlib.TopologicalSorter(uses).prepare()
    except graphlib.CycleError as error:
        return [f"a circle among {', '.join(sorted(set(error.args[1])))}"]
    return []


class LayersTest(unittest.TestCase):
    root = "."

    def test_includes_go_in_one_direction(self):
        self.assertEqual(problems_of(self.root), [])

    def test_all_folders_have_sources(self):
        for folder in FOLDERS:
            suffixes = {path.suffix for path in pathlib.Path(self.root, folder).glob("*")}
            self.assertTrue({".h", ".cxx"} & suffixes, folder)

    def test_each_defect_is_found(self):
        for word, files in (
                ("belong", {"Core/Fit/A.h": "vtkType.h"}), ("belong", {"Filters/a.cxx": "vtkOpenGLState.h"}),
                ("belong", {"Rendering/a.cxx": "vtkSMProxy.h"}), ("belong", {"Rendering/a.cxx": "Eigen/Core"}),
                ("may not know", {"Core/Base/A.h": "Core/Fit/B.h", "Core/Fit/B.h": ""}),
                ("may not know", {"Filters/Input/a.cxx": "Output/B.h", "Filters/Output/B.h": ""}),
                ("top folder", {"Core/Fit/A.h": "B.h", "Core/Fit/B.h": ""}),
                ("not a header", {"Core/Fit/A.h": "b.cxx"}),
                ("of the tests", {"Filters/a.cxx": "A.h", "Testing/A.h": ""}),
                ("no rule", {"Filters/New/a.cxx": ""}), ("suffix", {"Filters/a.cpp": ""}),
                ("a circle among Filters/A, Filters/B", {
                    "Filters/A.h": "", "Filters/A.cxx": "A.h B.h", "Filters/B.h": "", "Filters/B.cxx": "B.h A.h"})):
            with self.subTest(files), tempfile.TemporaryDirectory() as root:
                include = "#include <{}>\n" if word == "belong" else '#include "{}"\n'
                for name, includes in files.items():
                    pathlib.Path(root, name).parent.mkdir(parents=True, exist_ok=True)
                    pathlib.Path(root, name).write_text("".join(map(include.format, includes.split())))
                found = problems_of(root)
                self.assertTrue(len(found) == 1 and word in found[0], found)


if __name__ == "__main__":
    LayersTest.root = sys.argv.pop(1)
    unittest.main()
