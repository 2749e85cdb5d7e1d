# SPDX-License-Identifier: GPL-3.0-or-later
"""The checker of documents finds each class of defect, and none where there is none."""

import importlib.util
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PATH = pathlib.Path(__file__).parents[2] / "Utilities/check-documents.py"
sys.path.insert(0, str(PATH.parent))
spec = importlib.util.spec_from_file_location("check_documents", PATH)
checking = importlib.util.module_from_spec(spec)
spec.loader.exec_module(checking)

CMAKE = """
add_executable(Program Program.cxx)
function (add_own_test name)
  add_executable(${name} ${name}.cxx)
  add_test(NAME "Own.${name}" COMMAND ${name})
endfunction ()
add_own_test(TestThing)
option(SCATTEREDISOPOINTS_A "of Nothing" ON)
set(SCATTEREDISOPOINTS_B "" CACHE STRING "")
set(SCATTEREDISOPOINTS_C "")
"""
FILES = {
    "CMakePresets.json": '{"configurePresets": [{"name": "base", "hidden": true}, {"name": "release"}]}',
    "CMakeLists.txt": CMAKE, "Module/vtk.module": "NAME\n  Project::vtkModule\n",
    "Program.cxx": "class vtkMore { void SetValue(); };\n", "TestThing.cxx": "TEST(Suite, Works)\n{\n}\n",
    "run.sh": "", "docs/plain.sh": "", "setup.py": "a = 2\n", "module.py": "value = 1\n",
    "README.md": "# Title\n\n## Two words\n", "CONTRIBUTING.md": "", "CHANGELOG.md": "", "docs/page.md": "",
    "Core.h": "constexpr double share = 0.5;\n  static constexpr std::size_t most{ 1024 };\n"
              "constexpr std::size_t batch = std::size_t{ 1 } << 16;\nconstexpr double least = 1e-10;\n",
    "vtkThing.h": "  double Size = 1.5;\n  vtkTypeBool Runs = 1;\n  int Kind = ROUND;\n"
                  "  int Source = AUTOMATIC_SOURCE;\n  double Angle;\n  bool Name();\n",
    "Options.h": "// IsFlat\nconstexpr double defaultTurn = 9.5;\n  bool isFlat = false;\n"
                 "  double turn = defaultTurn;\n  int fit = static_cast<int>(FitOrder::Cubic);\n",
    "thing.xml": '<IntVectorProperty default_values="7"\n command="SetSize" />\n'
                 '<DoubleVectorProperty command="SetAngle"\n default_values="54.7" />\n'}
CONSTANTS, DEFAULTS = "| constant | file | value |\n|---|---|---|\n", "| property | default |\n|---|---|\n"


def block(language, code):
    return f"```{language}\n{code}\n```\n"


CLEAN = (
    '[a](../README.md#two-words "title"), [b](#here), [c](https://example.org/x), [d](#here-1)\n# Here\n'
    "# Here\n\n[e]: ../README.md\n`Program.cxx`, `docs/page.md`, `docs/*.md`, `build/release/bin/Program`, `a/b`,"
    " `[a](missing.md)`, `SetX()`, `vtkMore::SetValue()`, `NAME`, `word`, FILE, IEEE 754, `RESULTS`,"
    " SCATTEREDISOPOINTS_A and STRING\n"
    + block("bash", "A=1 ./run.sh X  # comment\ncmake --preset=release && ctest --preset \\\n  release")
    + block("bash", "cmake --build x --target Program vtkModule TestThing all; ls x\ncmake -DOTHER=1")
    + block("bash", "cmake -DSCATTEREDISOPOINTS_A=ON -D SCATTEREDISOPOINTS_B:STRING=x")
    + "".join(block("bash", f"ctest --tests-regex '{pattern}'") for pattern in (
        "Own", "^(TestThing|Own\\.Test)", "^TestThing.Suite.Works$"))
    + block("text", "a TODO") + "````text\n```\n````\n" + block("cmake", "a") + block("py", "import missing")
    + CONSTANTS + "| `share` | Core.h | 1 / 2 |\n| `most` | Core.h | 2^10 |\n| `batch` | Core.h | 65536 |\n"
    "| `least` | Core.h | 1e-10 |\n\n| constant | value |\n|---|---|\n| share | 7 |\n\n" + DEFAULTS
    + "| `Size` | 1.5 (m) |\n| `Runs` | on |\n| `Kind` | `ROUND` |\n| `Angle` | 54.7 |\n| `Source` | automatic |\n"
    "| `IsFlat` | off |\n| `Turn` | 9.5 |\n| `Fit` | `CUBIC_FIT` |\n| `Name` | none |\n| Other | 1 |\n\n"
    "| property | range |\n|---|---|\n| `Size` | 2 |\n\n"
    + block("python", "import module\nassert module.value == 1")
    + "<!-- setup:\na = 1\n-->\n" + block("python", "assert a == 1")
    + "<!-- setup: setup.py -->\n" + block("python", "assert a == 2"))
DEFECTS = (  # text, line, and a word of the message
    ("\n[a](missing.md)\n", 2, "missing.md"), ("[a](../README.md#three)\n", 1, "heading"),
    ("[a](#nowhere)\n", 1, "heading"), ("[a](../../outside.md)\n", 1, "outside.md"),
    ('\n<img width="1" src="missing.md">\n', 2, "missing.md"),
    ('[a](missing.md "title")\n', 1, "missing.md"), ("\n<!-- c --> [a](missing.md)\n", 2, "missing.md"),
    ("\n[a\nb](\nmissing.md)\n", 4, "missing.md"), ("[b]: missing.md\n", 1, "missing.md"),
    ("`docs/missing.md`\n", 1, "missing.md"), ("`A.cxx`\n", 1, "A.cxx"), ("`Missing/File.h`\n", 1, "File.h"),
    ("`build/debug/bin/Program`\n", 1, "debug"), ("`cmake --preset debug`\n", 1, "debug"),
    ("`cmake --preset=debug`\n", 1, "debug"), ("a\n`vtkmissing`\n", 2, "vtkmissing"),
    ("`vtkMore::GetValue()`\n", 1, "GetValue"), ("`camelCase`\n", 1, "camelCase"),
    (block("bash", "ls\ncmake --preset base"), 3, "base"), (block("bash", "./missing.sh"), 2, "missing.sh"),
    (block("bash", "ls\ncmake --preset \\\n  debug\nls"), 3, "debug"), (block("bash", "if true"), 1, "syntax"),
    (block("bash", "docs/plain.sh"), 2, "executable"),
    (block("bash", "cmake --build x --target Program Missing"), 2, "Missing"),
    ("`-DSCATTEREDISOPOINTS_D=ON`\n", 1, "POINTS_D"), (block("bash", "cmake -DSCATTEREDISOPOINTS_C=ON"), 2, "POINTS_C"),
    (block("bash", "cmake -D SCATTEREDISOPOINTS_D=ON"), 2, "POINTS_D"),
    *((block("bash", f"ctest --tests-regex '{pattern}'"), 2, "no test") for pattern in (
        "Missing", "^(TestThing|Other)", "^Works", "[")),
    (block("", "ls"), 1, "language"), (block("fortran", "a"), 1, "fortran"), ("a\n```bash\nls\n", 2, "end"),
    ("a\n<!-- b\nc\n", 2, "end"), *((f"\n| 12 | {word} |\n", 2, re.escape(word)) for word in (
        "TESTS12", "TESTS12V", "TESTSID", "CIRUN", "RESULTS", "TODO", "TBD", "XXX", "???")),
    (block("python", "a = 1\na = ("), 3, "Python"),
    ("<!-- setup: missing.py -->\n" + block("py", "a"), 2, "missing.py"),
    (block("python", "raise RuntimeError('reason')"), 1, "reason"),
    # A setup is that of the next block only.
    ("<!-- setup: setup.py -->\n" + block("python", "a") + block("python", "a"), 5, "NameError"),
    *((CONSTANTS + f"| {name} | {file} | {value} |\n", 3, word) for name, file, value, word in (
        ("`share`", "Core.h", 0.6, "0.5"), ("`share`", "Core.h", "half", "0.5"), ("`batch`", "Core.h", "2^15", "65536"),
        ("`least`", "Core.h", "1e-9", "1e-10"), ("`other`", "Core.h", 1, "other"), ("`share`", "Base.h", 1, "Base.h"),
        ("share", "Core.h", 0.5, "backticks"))),
    *((DEFAULTS + f"| `{name}` | {value} |\n", 3, f"{name} is {known}") for name, value, known in (
        ("Size", 1.6, 1.5), ("Size", 7, 1.5), ("Size", "", 1.5), ("Runs", "off", 1), ("IsFlat", "on", 0),
        ("Turn", 9, 9.5), ("Kind", "`FLAT`", "ROUND"), ("Source", "field", "AUTOMATIC_SOURCE"),
        ("Fit", "`LINEAR_FIT`", "Cubic"),
        ("Angle", 55, 54.7), ("Name", 3, "not in"))))


class CheckDocuments(unittest.TestCase):
    def test_each_defect_is_found_and_nothing_else(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in FILES.items():
                (root / name).parent.mkdir(exist_ok=True)
                (root / name).write_text(text)
            (root / "run.sh").chmod(0o755)
            for text, line, word in (*DEFECTS, (CLEAN, 0, "")):
                with self.subTest(text):
                    (root / "docs/page.md").write_text(text)
                    found = "\n".join(checking.Checker(root, folder, False).run())
                    self.assertRegex(found, f"(?s)^docs/page.md:{line}: .*{word}" if line else "^$")
            (root / "docs/page.md").write_text(block("python", "import missing"))  # runs on request only
            (root / "docs/a/b").mkdir(parents=True)
            for text, status, message in (("", 0, "no defects"), ("`A.cxx`\n", 1, "docs/a/b/page.md:1: no file A.cxx")):
                (root / "docs/a/b/page.md").write_text(text)
                done = subprocess.run([sys.executable, PATH, "--root", folder], stdout=subprocess.PIPE, text=True)
                self.assertEqual(done.returncode, status)
                self.assertIn(message, done.stdout)
            (root / "docs/a/b/page.md").unlink()
            (root / "CHANGELOG.md").unlink()
            self.assertEqual(checking.Checker(root, None, False).run(), ["CHANGELOG.md:0: is missing"])


if __name__ == "__main__":
    unittest.main()
