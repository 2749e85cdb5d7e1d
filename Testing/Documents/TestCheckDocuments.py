# SPDX-License-Identifier: GPL-3.0-or-later
"""The checker of documents finds each class of defect, and none where there is none."""

import importlib.util
import pathlib
import sys
import tempfile
import unittest

PATH = pathlib.Path(__file__).parents[2] / "Utilities/check-documents.py"
sys.path.insert(0, str(PATH.parent))
spec = importlib.util.spec_from_file_location("check_documents", PATH)
checking = importlib.util.module_from_spec(spec)
spec.loader.exec_module(checking)

FILES = {
    "CMakePresets.json": '{"configurePresets": [{"name": "base", "hidden": true}, {"name": "release"}]}',
    "Program.cxx": "class vtkMore {};\n", "run.sh": "", "docs/plain.sh": "", "setup.py": "a = 2\n",
    "README.md": "# Title\n\n## Two words\n", "CONTRIBUTING.md": "", "CHANGELOG.md": "", "docs/page.md": "",
    "Core.h": "constexpr double share = 0.5;\nconstexpr std::size_t batch = std::size_t{ 1 } << 16;\n",
    "vtkThing.h": "  double Size = 1.5;\n  vtkTypeBool Runs = 1;\n  double turn = defaultTurn;\n",
    "Options.h": "constexpr double defaultTurn = 9.5;\n  int fit = static_cast<int>(FitOrder::Cubic);\n",
    "thing.xml": '<DoubleVectorProperty command="SetAngle"\n default_values="54.7" />\n'}
CONSTANTS, DEFAULTS = "| constant | file | value |\n|---|---|---|\n", "| property | default |\n|---|---|\n"


def block(language, code):
    return f"```{language}\n{code}\n```\n"


CLEAN = (
    '[a](../README.md#two-words "title"), [b](#here), [c](https://example.org/x)\n# Here\n\n[d]: ../README.md\n'
    "`Program.cxx`, `docs/*.md`, `build/release/bin/Program`, `a/b`, `[a](missing.md)`, `SetX()`, `vtkMore`\n"
    + block("bash", "A=1 ./run.sh X  # comment\ncmake --preset=release \\\n  --target Program all; ls")
    + block("text", "a TODO")
    + CONSTANTS + "| `share` | Core.h | 1 / 2 |\n| `batch` | Core.h | 2^16 |\n\n" + DEFAULTS + "| `Size` | 1.5 (m) |\n"
    "| `Runs` | on |\n| `Angle` | 54.7 |\n| `Turn` | 9.5 |\n| `Fit` | `CUBIC_FIT` |\n| `Name` | none |\n| Other | 1 |\n\n"
    "<!-- setup: setup.py -->\n" + block("python", "assert a == 2"))
DEFECTS = (  # text, line, and a word of the message
    ("\n[a](missing.md)\n", 2, "missing.md"), ("[a](../README.md#three)\n", 1, "heading"),
    ("[a](../../outside.md)\n", 1, "outside.md"), ('\n<img src="missing.md">\n', 2, "missing.md"),
    ("[b]: missing.md\n", 1, "missing.md"), ("`docs/missing.md`\n", 1, "missing.md"), ("`A.cxx`\n", 1, "A.cxx"),
    ("`build/debug/bin/Program`\n", 1, "debug"), ("a\n`vtkmissing`\n", 2, "vtkmissing"),
    (block("bash", "ls\ncmake --preset \\\n  debug\nls"), 3, "debug"), (block("bash", "if true"), 1, "syntax"),
    (block("bash", "docs/plain.sh"), 2, "executable"), ("`-DSCATTEREDISOPOINTS_D=ON`\n", 1, "SCATTERED"),
    (block("bash", "ctest --tests-regex '^TestOther'"), 2, "TestOther"), (block("", "ls"), 1, "language"),
    ("a\n```bash\nls\n", 2, "end"), ("\n| 12 | TODO |\n", 2, "TODO"), (block("python", "a = 1\na = ("), 3, "Python"),
    ("<!-- setup: missing.py -->\n" + block("py", "a"), 2, "missing.py"), (block("python", "1 / 0"), 1, "fails"),
    ("<!-- setup: setup.py -->\n" + block("python", "a") + block("python", "a"), 5, "fails"),
    *((CONSTANTS + f"| `{name}` | {file} | {value} |\n", 3, word) for name, file, value, word in (
        ("share", "Core.h", 0.6, "0.5"), ("other", "Core.h", 1, "other"), ("share", "Base.h", 1, "Base.h"))),
    *((DEFAULTS + f"| `{name}` | {value} |\n", 3, name) for name, value in (
        ("Size", 7), ("Size", ""), ("Runs", "off"), ("Turn", 9), ("Fit", "`LINEAR_FIT`"), ("Angle", 55), ("Name", 3))))


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
                    self.assertRegex(found, f"^docs/page.md:{line}: .*{word}" if line else "^$")
            (root / "CHANGELOG.md").unlink()
            self.assertEqual(checking.Checker(root, None, False).run(), ["CHANGELOG.md:0: is missing"])


if __name__ == "__main__":
    unittest.main()
