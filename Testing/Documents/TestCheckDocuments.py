# SPDX-License-Identifier: GPL-3.0-or-later
"""The checker of documents finds each class of defect, and none where there is none."""

import os
import subprocess
import sys
import tempfile
import unittest

SOURCE_DIR = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
CHECKER = os.path.join(SOURCE_DIR, "Utilities", "check-documents.py")
PRESETS = '{"configurePresets": [{"name": "base", "hidden": true}, {"name": "release"}]}'

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


def block(language, code):
    return "```%s\n%s\n```\n" % (language, code)


class CheckDocuments(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        for name, text in {
            "CMakePresets.json": PRESETS,
            "CMakeLists.txt": CMAKE,
            "Program.cxx": "class vtkThing { void SetValue(); };\n",
            "TestThing.cxx": "TEST(Suite, Works)\n{\n}\n",
            "Module/vtk.module": "NAME\n  Project::vtkModule\n",
            "run.sh": "#!/bin/sh\n",
            "README.md": "# Title\n\n## Two words\n",
            "CONTRIBUTING.md": "",
            "CHANGELOG.md": "",
            "docs/page.md": "# Page\n",
        }.items():
            self.write(name, text)
        os.chmod(os.path.join(self.folder.name, "run.sh"), 0o755)

    def write(self, name, text):
        path = os.path.join(self.folder.name, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def check(self, text, *options):
        """The checker's output for a page with that text, and whether it found defects."""
        self.write("docs/page.md", text)
        result = subprocess.run(
            [sys.executable, CHECKER, "--root", self.folder.name, *options],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)  # fmt: skip
        self.assertIn(result.returncode, (0, 1), result.stdout)
        return result.stdout if result.returncode else ""

    def expect_clean(self, text, *options):
        self.assertEqual(self.check(text, *options), "")

    def expect(self, text, line, message, *options):
        output = self.check(text, *options)
        self.assertIn("docs/page.md:%d: " % line, output)
        self.assertIn(message, output)

    def test_links(self):
        self.expect_clean("[a](../README.md#two-words), [b](#here), [c](https://example.org/x)\n# Here\n")
        self.expect("\n[a](missing.md)\n", 2, "no file for the link missing.md")
        self.expect("[a](../README.md#three-words)\n", 1, "no heading")
        self.expect("[a](#nowhere)\n", 1, "no heading")
        self.expect("[a](../../outside.md)\n", 1, "no file for the link")

    def test_other_links(self):
        self.expect_clean('[a](../README.md "title"), `[a](missing.md)`\n\n[b]: ../README.md\n')
        for text in (
            '[a](missing.md "title")\n',
            "[b]: missing.md\n",
            '<img width="1" src="missing.md">\n',
            "<!-- c --> [a](missing.md)\n",
        ):
            self.expect("\n" + text, 2, "no file for the link missing.md")
        self.expect("\n[a\nb](\nmissing.md)\n", 4, "no file for the link missing.md")

    def test_paths_in_backticks(self):
        self.expect_clean("`Program.cxx`, `docs/page.md`, `docs/*.md`, `build/release/bin/Program`, `a/b`\n")
        self.expect("`docs/missing.md`\n", 1, "no file docs/missing.md")
        self.expect("`Missing.cxx`\n", 1, "no file Missing.cxx")
        self.expect("`Missing/File.h`\n", 1, "no file Missing/File.h")
        self.expect("`build/debug/bin/Program`\n", 1, "no preset debug")
        self.expect("`cmake --preset debug`\n", 1, "no preset debug")

    def test_commands(self):
        self.expect_clean(block("bash", "A=1 ./run.sh X  # comment\ncmake --preset release --target Program"))
        self.expect(block("bash", "ls\ncmake --preset base"), 3, "no preset base")
        self.expect(block("bash", "./missing.sh"), 2, "no file missing.sh")
        self.expect(block("bash", "if true"), 1, "syntax error")
        self.write("docs/plain.sh", "")
        self.expect(block("bash", "docs/plain.sh"), 2, "not executable")

    def test_presets_and_targets(self):
        self.expect_clean(block("bash", "cmake --preset=release && ctest --preset \\\n  release"))
        self.expect("`cmake --preset=debug`\n", 1, "no preset debug")
        self.expect(block("bash", "ls\ncmake --preset \\\n  debug\nls"), 3, "no preset debug")
        target = "cmake --build x --target "
        self.expect_clean(block("bash", target + "Program vtkModule TestThing all; ls x"))
        self.expect(block("bash", target + "Program Missing"), 2, "no target Missing")

    def test_options(self):
        for option in ("-DSCATTEREDISOPOINTS_A=ON", "-D SCATTEREDISOPOINTS_B:STRING=x", "-DOTHER=1"):
            self.expect_clean(block("bash", "cmake " + option))
        for option in ("-DSCATTEREDISOPOINTS_C=ON", "-D SCATTEREDISOPOINTS_D=ON"):
            self.expect(block("bash", "cmake " + option), 2, "no option SCATTEREDISOPOINTS_")
        self.expect("`-DSCATTEREDISOPOINTS_D=ON`\n", 1, "no option SCATTEREDISOPOINTS_D")

    def test_tests(self):
        for pattern in ("Own", "^(TestThing|Own\\.Test)", "^TestThing.Suite.Works$"):
            self.expect_clean(block("bash", "ctest --tests-regex '%s'" % pattern))
        for pattern in ("Missing", "^(TestThing|Other)", "^Works", "["):
            self.expect(block("bash", "ctest --tests-regex '%s'" % pattern), 2, "no test for")

    def test_blocks(self):
        self.expect_clean(block("text", "a") + "````text\n```\n````\n" + block("cmake", "a"))
        self.expect(block("", "ls"), 1, "unknown language")
        self.expect(block("fortran", "a"), 1, "unknown language fortran")
        self.expect("a\n```bash\nls\n", 2, "a fence without an end")
        self.expect("a\n<!-- b\nc\n", 2, "a comment without an end")

    def test_identifiers_in_backticks(self):
        self.expect_clean("`vtkThing`, `vtkThing::SetValue()`, `SetX()`, `NAME`, `word`\n")
        self.expect("a\n`vtkmissing`\n", 2, "no identifier vtkmissing")
        self.expect("`vtkThing::GetValue()`\n", 1, "no identifier GetValue")
        self.expect("`camelCase`\n", 1, "no identifier camelCase")

    def test_scripts(self):
        self.expect_clean(block("python", "import missing"))
        self.expect(block("python", "a = 1\na = ("), 3, "no Python")
        self.expect("<!-- setup: missing.py -->\n" + block("python", "a"), 2, "no file missing.py")

    def test_scripts_run(self):
        run = ("--run-with", self.folder.name)
        self.write("module.py", "value = 1\n")
        self.expect_clean(block("python", "import module\nassert module.value == 1"), *run)
        self.expect_clean("<!-- setup:\na = 1\n-->\n" + block("python", "assert a == 1"), *run)
        self.write("setup.py", "a = 2\n")
        self.expect_clean("<!-- setup: setup.py -->\n" + block("python", "assert a == 2"), *run)
        self.expect(block("python", "raise RuntimeError('reason')"), 1, "reason", *run)
        # A setup is that of the next block only.
        text = "<!-- setup: setup.py -->\n" + block("python", "a") + block("python", "a")
        self.expect(text, 5, "NameError", *run)

    def test_what_is_still_to_be_filled_in(self):
        self.expect_clean("FILE, IEEE 754, `RESULTS`, and vtkThing with KNOWN_NAME\n" + block("text", "RESULTS"))
        for word in ("TESTS12", "TESTS12V", "TESTSID", "CIRUN", "RESULTS", "TODO", "TBD", "XXX", "???"):
            self.expect("\n| 12 | %s |\n" % word, 2, word + " is still to be filled in")

    def test_constants(self):
        self.write("Core.h", "constexpr double share = 0.5;\n  static constexpr std::size_t most{ 1024 };\n"
                   "constexpr std::size_t batch = std::size_t{ 1 } << 16;\nconstexpr double least = 1e-10;\n")
        head = "| constant | file | value | unit |\n|---|---|---|---|\n"
        self.expect_clean(head + "| `share` | Core.h | 1 / 2 | 1 |\n| `most` | Core.h | 2^10 | 1 |\n"
                          "| `batch` | Core.h | 65536 | 1 |\n| `least` | Core.h | 1e-10 | 1 |\n")
        self.expect_clean("| constant | value |\n|---|---|\n| share | 7 |\n")
        self.expect(head + "| `share` | Core.h | 0.6 | 1 |\n", 3, "share is 0.5 in Core.h, not 0.6")
        self.expect(head + "| `share` | Core.h | half | 1 |\n", 3, "share is 0.5 in Core.h, not half")
        self.expect(head + "| `batch` | Core.h | 2^15 | 1 |\n", 3, "batch is 65536 in Core.h, not 2^15")
        self.expect(head + "| `least` | Core.h | 1e-9 | 1 |\n", 3, "least is 1e-10 in Core.h, not 1e-9")
        self.expect(head + "| `other` | Core.h | 1 | 1 |\n", 3, "no constant other in Core.h")
        self.expect(head + "| `share` | Base.h | 1 | 1 |\n", 3, "no constant share in Base.h")
        self.expect(head + "| share | Core.h | 0.5 | 1 |\n", 3, "share is no constant's name in backticks")

    def test_defaults(self):
        self.write("vtkThing.h", "  double Size = 1.5;\n  vtkTypeBool Runs = 1;\n  int Kind = ROUND;\n"
                   "  int Source = AUTOMATIC_SOURCE;\n  double Angle;\n  bool Name();\n")
        self.write("Options.h", "// IsFlat\nconstexpr double defaultTurn = 9.5;\n  bool isFlat = false;\n"
                   "  double turn = defaultTurn;\n  int fit = static_cast<int>(FitOrder::Cubic);\n")
        self.write("thing.xml", '<IntVectorProperty default_values="7"\n command="SetSize" />\n'
                   '<DoubleVectorProperty command="SetAngle"\n default_values="54.7" />\n')
        head = "| property | default |\n|---|---|\n"
        self.expect_clean(head + "| `Size` | 1.5 (m) |\n| `Runs` | on |\n| `Kind` | `ROUND` |\n")
        self.expect_clean(head + "| `Angle` | 54.7 |\n| `Source` | automatic |\n| `Name` | none |\n| Other | 1 |\n")
        self.expect_clean("| property | range |\n|---|---|\n| `Size` | 2 |\n")
        self.expect_clean(head + "| `IsFlat` | off |\n| `Turn` | 9.5 |\n| `Fit` | `CUBIC_FIT` |\n")
        self.expect(head + "| `IsFlat` | on |\n", 3, "the default of IsFlat is 0")
        self.expect(head + "| `Turn` | 9 |\n", 3, "the default of Turn is 9.5")
        self.expect(head + "| `Fit` | `LINEAR_FIT` |\n", 3, "the default of Fit is Cubic")
        self.expect(head + "| `Size` | 1.6 |\n", 3, "the default of Size is 1.5, not 1.6")
        self.expect(head + "| `Size` | 7 |\n", 3, "the default of Size is 1.5, not 7")
        self.expect(head + "| `Size` | |\n", 3, "the default of Size is 1.5")
        self.expect(head + "| `Runs` | off |\n", 3, "the default of Runs is 1")
        self.expect(head + "| `Kind` | `FLAT` |\n", 3, "the default of Kind is ROUND")
        self.expect(head + "| `Source` | field |\n", 3, "the default of Source is AUTOMATIC_SOURCE")
        self.expect(head + "| `Angle` | 55 |\n", 3, "the default of Angle is 54.7, not 55")
        self.expect(head + "| `Name` | 3 |\n", 3, "no default of Name in the sources")

    def test_documents_in_folders(self):
        self.write("docs/a/b/page.md", "`Missing.cxx`\n")
        self.assertIn("docs/a/b/page.md:1: no file Missing.cxx", self.check(""))

    def test_documents_are_there(self):
        os.remove(os.path.join(self.folder.name, "CHANGELOG.md"))
        self.assertIn("CHANGELOG.md:0: is missing", self.check(""))


if __name__ == "__main__":
    unittest.main()
