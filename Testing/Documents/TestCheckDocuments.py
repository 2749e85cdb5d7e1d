# SPDX-License-Identifier: GPL-3.0-or-later
"""The checker of documents finds each class of defect, and none in the documents as they are."""

import importlib.util
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).parents[2]
PATH = ROOT / "Utilities/check-documents.py"
sys.path.insert(0, str(PATH.parent))
spec = importlib.util.spec_from_file_location("check_documents", PATH)
checking = importlib.util.module_from_spec(spec)
spec.loader.exec_module(checking)


def block(language, code):
    return f"```{language}\n{code}\n```\n"


FIRST = block("python", "a = 1")
DEFECTS = (  # the text of a page in docs, the line of the defect, and a word of the message
    ("\n[a](missing.md)\n", 2, "missing.md"), ("[a](../README.md#three)\n", 1, "heading"),
    ("[a](#nowhere)\n", 1, "heading"), ("[a](../../outside.md)\n", 1, "outside.md"),
    ('\n<img width="1" src="missing.md">\n', 2, "missing.md"),
    ('[a](missing.md "title")\n', 1, "missing.md"), ("\n<!-- c --> [a](missing.md)\n", 2, "missing.md"),
    ("\n[a\nb](\nmissing.md)\n", 4, "missing.md"), ("[b]: missing.md\n", 1, "missing.md"),
    ("`docs/missing.md`\n", 1, "missing.md"), ("`docs/missing*.md`\n", 1, "missing"), ("`A.cxx`\n", 1, "A.cxx"),
    ("`Missing/File.h`\n", 1, "File.h"), ("`build/base/bin/Program`\n", 1, "base"),
    ("`cmake --preset base`\n", 1, "base"), ("`cmake --preset=missing`\n", 1, "missing"),
    ("a\n`vtkmissing`\n", 2, "vtkmissing"), ("`vtkObject::GetMissing()`\n", 1, "GetMissing"),
    ("`ProcessGroup::together`\n", 1, "together in ProcessGroup"), ("`camelCase`\n", 1, "camelCase"), (block("bash", "ls\ncmake --preset base"), 3, "base"),
    (block("bash", "./missing.sh"), 2, "missing.sh"), (block("bash", "ls\ncmake --preset \\\n  base\nls"), 3, "base"),
    (block("bash", "if true"), 1, "syntax"), (block("bash", "A=1 Utilities/steps.sh X"), 2, "executable"),
    *((block("bash", f"cmake --build x --target isopoint {name}"), 2, name) for name in ("Missing", "Documents")),
    ("`-DSCATTEREDISOPOINTS_MISSING=ON`\n", 1, "POINTS_MISSING"),
    # Set by CMake, but no option.
    (block("bash", "cmake -D SCATTEREDISOPOINTS_PYTHON_BUILD_PATH=a"), 2, "no option"),
    *((block("bash", f"ctest --tests-regex '{pattern}'"), 2, "no test") for pattern in (
        "Missing", "^(TestSplats|Other)", "^SplatsOn", "[")),
    (block("", "ls"), 1, "language"), (block("fortran", "a"), 1, "fortran"), ("a\n```bash\nls\n", 2, "end"),
    ("a\n<!-- b\nc\n", 2, "end"), *((f"\n| 12 | {word} |\n", 2, re.escape(word)) for word in (
        "TESTS12", "TESTS12V", "TESTSID", "CIRUN", "RESULTS", "TODO", "TBD", "XXX", "???")),
    (block("python", "a = 1\na = ("), 3, "Python"),
    (block("python", "raise RuntimeError('reason')"), 1, "reason"),
    (FIRST + block("python", "a"), 4, "NameError"),  # each block runs alone
    ("| smallestPiece | GapSpread.h | 8 |\n", 1, "backticks"),
    *((f"| {name} | {file} | {value} |\n", 1, f"{name} in {file} is {known}") for name, file, value, known in (
        ("`smallestPiece`", "GapSpread.h", 9, 8), ("`smallestPiece`", "GapSpread.h", "half", 8),
        ("`coneCosine`", "GapCriterion.h", "1 / 2", "1.0 / 1.7"), ("`minPivot`", "NormalEquations.h", "1e-9", "1e-7"),
        ("`other`", "GapTetrahedra.h", 1, "not in"), ("`smallestPiece`", "Base.h", 1, "not in"))),
    *((f"| property | default |\n|---|---|\n| `{name}` | {value} |\n", 3, f"{name} is {known}")
      for name, value, known in (
        ("MinimumPieceSize", 0.5, "0.0"), ("MinimumPieceSize", "", "0.0"),
        ("ComputeGradients", "on", "false"), ("Angle", 54, 54.7),
        ("Projection", "`LINEAR_FIT`", "Cubic"), ("NormalMethod", "planes", "Automatic"),
        ("RadiusArrayName", "`Size`", "Radius"), ("Controller", 3, "not in"))))


class CheckDocuments(unittest.TestCase):
    def test_each_defect_is_found_and_nothing_else(self):
        checker = checking.Checker(ROOT, "/")
        with tempfile.NamedTemporaryFile("w+", suffix=".md") as page:
            for text, line, word in (*DEFECTS, (FIRST, 0, "")):
                page.truncate(page.seek(0))
                page.write(text)
                page.flush()
                checker.defects, checker.name = [], "docs/testing.md"
                checker.check(checking.Document(page.name))
                with self.subTest(text):
                    expected = f"(?s)^docs/testing.md:{line}: .*{word}" if line else "^$"
                    self.assertRegex("\n".join(checker.defects), expected)
        self.assertEqual(checking.Checker(ROOT).run(), [])

    def test_all_documents_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "docs/a/b").mkdir(parents=True)
            (pathlib.Path(folder) / "docs/a/b/page.md").write_text("`A.cxx`\n" + block("python", "import missing"))
            (pathlib.Path(folder) / "CMakePresets.json").write_text('{"configurePresets": []}')
            done = subprocess.run([sys.executable, PATH, "--root", folder], stdout=subprocess.PIPE, text=True)
        self.assertEqual((done.returncode, done.stdout.splitlines()), (1, [
            *(name + ".md:0: is missing" for name in ("README", "CONTRIBUTING", "CHANGELOG")),
            "docs/a/b/page.md:1: no file A.cxx"]))


class Version(unittest.TestCase):
    def test_all_files_have_the_version_of_the_header(self):
        version = re.search('ISOPOINT_VERSION "(.*)"', (ROOT / "Library/isopoint.h").read_text())[1]
        for name, pattern in (("CHANGELOG.md", r"^## \[([\d.]+)\]"), ("CITATION.cff", r"^version: ([\d.]+)$"),
                              ("Utilities/conda-forge/recipe.yaml", r'^  version: "([\d.]+)"$'),
                              ("docs/installing.md", r"/scattered-isopoints_([\d.]+)-1~deb12")):
            self.assertEqual(re.search(pattern, (ROOT / name).read_text(), re.MULTILINE)[1], version, name)


if __name__ == "__main__":
    unittest.main()
