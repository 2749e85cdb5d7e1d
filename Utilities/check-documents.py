#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks README.md, CONTRIBUTING.md, CHANGELOG.md and docs/**/*.md of a source tree.

Links, anchors, and the paths and identifiers in backticks exist. Blocks marked bash parse, and name presets, targets,
options, tests and executable scripts that exist. Nothing is left to be filled in. Blocks marked python, pvpython or py
(with PyVista) compile; the first two run on request. Tables of constants and of defaults have the values of the
sources. Prints file:line: message for each defect and exits with 1 if there is any.
"""

import argparse
import collections
import fnmatch
import glob
import json
import os
import re
import subprocess
import sys
import tempfile

from markdown_document import Document, read

DOCUMENTS = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/**/*.md")
SOURCES = (".h", ".cxx", ".py", ".sh", ".cmake")  # in backticks, files of the tree have these suffixes
NOT_HERE = ("check-documents.py", "TestCheckDocuments.py")  # name identifiers that do not exist
LANGUAGES = ("bash", "cmake", "pvpython", "py", "python", "text")
# Files, and what they declare: a kind, and a pattern of a name and its value, if it has one.
CMAKE = ("*.cmake", "CMakeLists.txt")
DECLARATIONS = [(files, kind, re.compile(pattern, re.MULTILINE)) for files, kind, pattern in (
    ((*CMAKE, "*.h", "*.cxx", "*.xml", "*.py", "*.in"), "identifier", r"(\w+)"),
    (("vtk.module",), "target", r"^NAME\s+(?:\w+::)?(\w+)"),
    (CMAKE, "target", r"\badd_(?:executable|library|custom_target|(?:cxx|core|filter)_test|fuzz_target)\s*\(\s*(\w+)"),
    (CMAKE, "option", r"\boption\s*\(\s*(\w+)"), (CMAKE, "option", r"\bset\s*\(\s*(\w+)[^()]*\sCACHE\s"),
    (CMAKE, "test", r"\badd_test\s*\(NAME \"?([\w.]+)[\"\s]"),
    (("*.h",), "constant", r"constexpr \w+ (default\w+) = ([\w.]+);"),
    (("vtk*.h", "Options.h"), "default",
     r"^  (?:double|int|bool|vtkTypeBool) (\w+) = (?:static_cast<int>\(\w+::)?([\w.]+)\)?;"),
    (("*.xml",), "default of the plugin",
     r'<\w+VectorProperty\b(?=[^>]*command="Set(\w+)")(?=[^>]*default_values="([^"]*)")'))]
STANDARD = {"target": ("all", "clean", "install", "package", "test"), "identifier": ("GetX", "SetX", "XOff", "XOn")}
# What commands name, by kind.
NAMED = {"preset": r"--preset[=\s]+([\w-]+)", "option": r"-D *(SCATTEREDISOPOINTS_\w+)",
         "test": r"--tests-regex[=\s]+('[^']*'|\S+)", "target": r"--target[=\s]+((?:(?! -|[;&]| \|)[^\n])+)"}
# What waits to be filled in: words such as RESULTS or TESTS12 that no source has.
UNFINISHED = r"(\?\?\?|\b(?:TODO|TBD|FIXME|XXX|TKTK)\b|\b[A-Z]{4,}\d*[A-Z]*\b)"
CAPITALS = {"BRDF", "DATA", "EPYC", "EQPS", "FILE", "IEEE", "PSNR", "README", "SIGGRAPH", "VGTC"}
LINKS = r"""\]\(\s*<?([^)\s>]+)|^ {0,3}\[[^\]^]+\]:\s*<?([^\s>]+)|<\w+\s[^>]*?\b(?:src|href)\s*=\s*["']?([^"'\s>]+)"""
CODE = r"`([^`\n]+(?:\n[^`\n]+)*)`"
OPEN = r"(`{3,}|~{3,}|<!--)"
CONSTANT = r"^\| ([^|]+) \| ([\w.]+\.(?:h|cxx)) \| ([^|]+) \|"  # a row of name, file and value
DEFAULTS = r"^(\|.*\| default \|.*)\n\|[-|: ]+\n((?:\|.*\n)*)"  # a table of properties
CLASS = r"\b(?:class|struct)\s+(?:[A-Z]+_EXPORT\s+)?(\w+)\b[^;{]*\{"  # a definition
MEMBER = r"\b(\w+)::(\w+)"
IDENTIFIER = re.compile(r"\b(?:vtk\w+|(?=\w*[a-z])[A-Za-z]\w*[A-Z]\w*)\b")
SWITCHES = {"on": "1", "off": "0", "true": "1", "false": "0"}


def number_of(text):
    """The value of an expression of numbers in C++ or in a document, or None."""
    try:
        return eval(text) if re.fullmatch(r"[\d\s.eE()*/+-]+", text) else None
    except (SyntaxError, TypeError, ZeroDivisionError):
        return None


class Checker:
    def __init__(self, root, python_path=None, runs_pvbatch=False):
        self.root, self.python_path, self.runs_pvbatch = os.path.abspath(root), python_path, runs_pvbatch
        self.defects, self.name, self.sources = [], "", {}
        self.known = collections.defaultdict(lambda: collections.defaultdict(set))  # values by kind and name
        for folder, folders, names in os.walk(self.root):
            folders[:] = [name for name in folders if name != ".git" and not name.startswith("build")]
            for name in names:
                self.sources.setdefault(name, os.path.join(folder, name))
                self.add_source(name, os.path.join(folder, name))
        presets = json.loads(read(os.path.join(self.root, "CMakePresets.json")))["configurePresets"]
        self.known["preset"] = {preset["name"] for preset in presets if not preset.get("hidden")}
        for kind, names in STANDARD.items():
            self.known[kind].update((name, set()) for name in names)

    def add_source(self, name, path):
        self.known["identifier"].update((word, set()) for word in re.findall(r"\w+", name))
        found = [row[1:] for row in DECLARATIONS if any(fnmatch.fnmatch(name, each) for each in row[0])]
        if not found or name in NOT_HERE:
            return
        text = re.sub(r"#.*", "", read(path)) if name.endswith((".cmake", ".txt")) else read(path)
        for kind, pattern in found:
            for declared, *value in map(re.Match.groups, pattern.finditer(text)):
                self.known[kind][declared].update(value)
        if name.endswith(".h"):
            words = set(re.findall(r"\w+", re.sub(r"//.*", "", text)))
            for declared in re.findall(CLASS, text):
                self.known["class"][declared].update(words)
        tests = re.findall(r"^(?:TYPED_)?TEST(?:_[FP])?\((\w+),\s*(\w+)\)", text, re.MULTILINE)
        self.known["test"].update((f"{name.removesuffix('.cxx')}.{suite}.{test}", set()) for suite, test in tests)
        for prefix in re.findall(r'\badd_test\s*\(NAME "?([\w.]+)\$\{name\}', text):
            names = re.findall(r"\badd_\w+_(?:test|target)\s*\((\w+)", text)
            self.known["test"].update((prefix + each, set()) for each in names)

    def report(self, line, message):
        self.defects.append(f"{self.name}:{line}: {message}")

    def run(self):
        for pattern in DOCUMENTS:
            paths = sorted(glob.glob(os.path.join(self.root, pattern), recursive=True))
            if not paths:
                self.defects.append(f"{pattern}:0: is missing")
            for path in paths:
                self.name = os.path.relpath(path, self.root)
                self.check(Document(path))
        return self.defects

    def check(self, document):
        text = document.text
        prose = re.sub(CODE, lambda code: re.sub(r"\S", "x", code[0]), text)
        for pattern, where, check in (
                (LINKS, prose, self.check_link), (UNFINISHED, prose, self.check_finished),
                (CODE, text, self.check_code), (CONSTANT, text, self.check_constant),
                (DEFAULTS, text, self.check_defaults),
                (OPEN, text, lambda line, word: self.report(line, word + " without an end"))):
            for match in re.finditer(pattern, where, re.MULTILINE):
                line = text.count("\n", 0, match.start(match.lastindex)) + 1
                check(line, *(group for group in match.groups() if group is not None))
        for language, line, code in document.blocks:
            if language not in LANGUAGES:
                self.report(line, f"a block in the unknown language {language or '(none)'}")
            elif language == "bash":
                self.check_commands(line, code)
            elif language in ("python", "pvpython", "py"):
                self.check_script(line, language, code)

    def check_finished(self, line, word):
        if word not in CAPITALS and word not in self.known["identifier"]:
            self.report(line, word + " is still to be filled in")

    def check_link(self, line, target):
        path, _, anchor = target.partition("#")
        path = os.path.join(os.path.dirname(self.name), path) if path else self.name
        full = os.path.normpath(os.path.join(self.root, path))
        if re.match(r"[a-z]+:", target):
            return
        if full.endswith(".png") and not os.path.exists(os.path.join(self.root, ".git")):
            return  # archives of the source lack pictures
        if not full.startswith(self.root + os.sep) or not os.path.exists(full):
            self.report(line, f"no file for the link {target}")
        elif anchor and anchor not in Document(full).anchors:
            self.report(line, f"no heading for the link {target}")

    def check_code(self, line, code):
        """Code in backticks."""
        self.check_words(line, code)
        for word in IDENTIFIER.findall(code):
            if word not in self.known["identifier"]:
                self.report(line, f"no identifier {word} in the sources")
        for name, member in re.findall(MEMBER, code):
            if name in self.known["class"] and member not in self.known["class"][name]:
                self.report(line, f"no {member} in {name}")

    def check_words(self, line, text):
        """Paths, and names of presets, targets, options and tests, of code or of a command."""
        for word in re.split(r"[\s;&|()\"']+", text):
            self.check_path(line, re.sub(r"^\./", "", word.split("=")[-1].rstrip(",.;:)")))
        for kind, pattern in NAMED.items():
            for word in " ".join(re.findall(pattern, text)).split():
                if not (self.has_test(word.strip("'\"")) if kind == "test" else word in self.known[kind]):
                    self.report(line, f"no {kind} {word}")

    def has_test(self, pattern):
        """Whether each alternative of a pattern, as those in ^(a|b), is found in a test's name."""
        find = re.match if pattern.startswith("^") else re.search
        alternatives = re.sub(r"[()^]", "", pattern).split("|")
        try:
            return all(any(find(each, test) for test in self.known["test"]) for each in alternatives)
        except re.error:
            return False

    def check_path(self, line, word):
        first, _, rest = word.rstrip("/").partition("/")
        if not re.fullmatch(r"[\w.*-]+(?:/[\w.*-]+)*/?", word):
            return
        if first == "build":
            exists = "/" not in rest or rest.split("/")[0] in self.known["preset"]
        elif first == "dist":
            exists = True  # made by releasing.md
        elif not rest:
            exists = not word.endswith(SOURCES) or fnmatch.filter(self.sources, word)
        elif os.path.exists(os.path.join(self.root, first)) or word.endswith(SOURCES):
            folders = ("", os.path.dirname(self.name), "Filters", "Core")
            exists = any(glob.glob(os.path.join(self.root, folder, word)) for folder in folders)
        else:
            exists = True
        if not exists:
            self.report(line, f"no file {word}")

    def check_commands(self, first, code):
        syntax = subprocess.run(["bash", "-n"], input=code, text=True, stderr=subprocess.PIPE)
        if syntax.returncode != 0:
            return self.report(first, syntax.stderr.strip())
        for match in re.finditer(r"(?:[^\\\n]|\\(?:.|\n))+", code):  # with the lines that continue it
            line, text = first + 1 + code.count("\n", 0, match.start()), match[0].replace("\\\n", " ")
            self.check_words(line, re.sub(r"(^|\s)#.*", "", text))
            script = re.match(r"(?:\w+=\S+\s+)*(\S+)", text)
            path = os.path.join(self.root, script[1]) if script else self.root
            if os.path.isfile(path) and not os.access(path, os.X_OK):
                self.report(line, f"{script[1]} is not executable")

    def check_script(self, first, language, code):
        try:
            compile("\n" * first + code, self.name, "exec")
        except SyntaxError as error:
            return self.report(error.lineno or first, f"no Python: {error.msg}")
        command = {"python": sys.executable if self.python_path else None,
                   "pvpython": "pvbatch" if self.runs_pvbatch else None}.get(language)
        if command:
            environment = dict(os.environ, PYTHONPATH=self.python_path or os.environ.get("PYTHONPATH", ""))
            with tempfile.TemporaryDirectory() as folder:
                with open(os.path.join(folder, "script.py"), "w", encoding="utf-8") as file:
                    file.write(code)
                done = subprocess.run([command, "script.py"], cwd=folder, env=environment, text=True,
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            if done.returncode != 0 or "ERROR" in done.stdout or "ERR|" in done.stdout:
                self.report(first, "the script fails:\n" + done.stdout.strip())

    def check_defaults(self, line, head, rows):
        """The rows of a table of properties."""
        column = head.split("|").index(" default ")
        for number, row in enumerate(rows.splitlines(), line):
            if re.match(r"\| `\w+`", row):
                self.check_default(number, re.match(r"\| `(\w+)", row)[1], row.split("|")[column].strip())

    def check_constant(self, line, constant, file, value):
        if not re.fullmatch(r"`\w+`", constant):
            return self.report(line, f"{constant} is no constant's name in backticks")
        text = read(self.sources[file]) if file in self.sources else ""
        values = re.findall(rf"\bconstexpr\b[^;={{]*\b{constant[1:-1]}(?: = |{{ )([^;}}]+)", text)
        self.check_value(line, f"{constant} in {file}", values, value)

    def check_default(self, line, member, cell):
        """A default begins with a number, on, off, or the name of a constant or its beginning."""
        default = re.match(r"`?([\w.+-]*)", cell)[1]
        values = self.known["default"][member] | self.known["default"][member[0].lower() + member[1:]]
        values = values or self.known["default of the plugin"][member]
        values = {each for value in values for each in self.known["constant"].get(value, {value})}
        if values or number_of(default) is not None:
            self.check_value(line, f"the default of {member}", values, default)

    def check_value(self, line, name, values, text):
        """Whether a text is one of the values of the sources, as a number or as the beginning of a name."""
        wanted, *known = (SWITCHES.get(value, value).lower() for value in (text, *values))
        is_number = number_of(wanted) is not None
        if not text or not (number_of(wanted) in map(number_of, known) if is_number else any(
                value.startswith(wanted) or wanted.startswith(value) for value in known)):
            self.report(line, f"{name} is {' or '.join(sorted(values)) or 'not in the sources'}, not {text}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--root", default=os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    parser.add_argument("--run-with", metavar="PYTHONPATH", help="run python blocks with it")
    parser.add_argument("--run-pvbatch", action="store_true", help="run pvpython blocks as well")
    arguments = parser.parse_args()
    found = Checker(arguments.root, arguments.run_with, arguments.run_pvbatch).run()
    print("\n".join(found) if found else "documents: no defects")
    sys.exit(1 if found else 0)
