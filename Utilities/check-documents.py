#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks README.md, CONTRIBUTING.md, CHANGELOG.md and docs/**/*.md of a source tree.

Links, anchors, and paths and identifiers in backticks exist; commands in blocks marked bash parse
and name scripts, presets, targets, options and tests that exist; blocks marked python or pvpython
compile and, where asked for, run; blocks marked py, which need PyVista, compile; values in tables of
constants are those of the sources; nothing is left to be filled in. Prints file:line: message for each defect and exits with 1 if there is any.

A comment before a block, <!-- setup: FILE.py --> or <!-- setup: code -->, runs before it.
"""

import argparse
import fnmatch
import glob
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile

from markdown_document import Document, read

DOCUMENTS = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/**/*.md")
SOURCES = (".h", ".cxx", ".glsl", ".py", ".sh", ".cmake")  # in backticks, these are the tree's
LANGUAGES = ("bash", "cmake", "pvpython", "py", "python", "text")
STANDARD_TARGETS = {"all", "clean", "install", "package", "test"}
PLACEHOLDERS = {"GetX", "SetX", "XOff", "XOn"}  # stand for identifiers
WITH_IDENTIFIERS = (".h", ".cxx", ".xml", ".py", ".glsl", ".cmake", ".in", "CMakeLists.txt")
OF_THIS_CHECK = ("check-documents.py", "TestCheckDocuments.py")  # name what does not exist
LINKS = re.compile(
    r"""\]\(\s*<?([^)\s>]+)"""  # [text](target "title")
    r"""|^\ {0,3}\[[^\]^]+\]:\s*<?([^\s>]+)"""  # [label]: target
    r"""|<\w+\s[^>]*?\b(?:src|href)\s*=\s*["']?([^"'\s>]+)""",  # <img src="target">
    re.MULTILINE,
)
IDENTIFIERS = re.compile(r"\b(?:vtk\w+|(?=\w*[a-z])[A-Za-z]\w*[A-Z]\w*)\b")
# What waits to be filled in: names such as RESULTS or TESTS12 that nothing in the tree defines.
UNFINISHED = re.compile(r"\?\?\?|\b(?:TODO|TBD|FIXME|XXX|TKTK)\b|\b[A-Z]{4,}\d*[A-Z]*\b")
CAPITALS = {
    "ARRAY", "BRDF", "DATA", "EPYC", "FILE", "FOLDER", "GLSL", "IEEE", "ISOVALUE", "PSNR", "README", "SIGGRAPH", "VGTC"}  # fmt: skip

# A member of a class or of the core's options, and its default, without the type of an enumeration.
PROPERTY_MEMBER = re.compile(
    r"^  (?:double|int|bool|vtkTypeBool) (\w+) = (?:static_cast<int>\(\w+::)?([\w.]+)\)?;", re.MULTILINE)
DEFAULT_CONSTANT = re.compile(r"constexpr \w+ (default\w+) = ([\w.]+);")
PROPERTY_ELEMENT = re.compile(r"<\w+VectorProperty\b[^>]*>")
SWITCHES = {"on": "1", "off": "0", "true": "1", "false": "0"}


def number_of(expression):
    """The value of a constant's expression in C++ or in a document, or None."""
    expression = re.sub(r"std::\w+(?=\s*\{)|\b(?:long )?double(?=\s*\{)", "", expression)
    expression = re.sub(r"[{}]", lambda brace: "(" if brace.group() == "{" else ")", expression)
    expression = expression.replace("^", "**").replace("'", "")
    if not re.fullmatch(r"[\d\s.eE()<>*/+-]+", expression):
        return None
    try:
        return eval(expression)  # pylint: disable=eval-used
    except (SyntaxError, TypeError, ZeroDivisionError):
        return None


class BuildNames:
    """Targets, options and tests, as far as CMake's files and the C++ sources name them."""

    def __init__(self):
        self.targets, self.options, self.tests = set(STANDARD_TARGETS), set(), set()

    def add_cmake(self, text):
        text = re.sub(r"#.*", "", text)
        self.targets.update(re.findall(r"\badd_(?:executable|library|custom_target)\s*\(\s*(\w+)", text))
        for wrapper in re.findall(r"\bfunction\s*\((\w+) name\)\s*add_executable\b", text):
            self.targets.update(re.findall(r"\b%s\s*\((\w+)" % wrapper, text))
        for names in re.findall(r"\bforeach\s*\(name ([\w\s]+)\)\s*add_\w+_test\b", text):
            self.targets.update(names.split())
        self.options.update(re.findall(r"\boption\s*\(\s*(\w+)", text))
        self.options.update(re.findall(r"\bset\s*\(\s*(\w+)[^()]*\sCACHE\s", text))
        self.tests.update(re.findall(r"\badd_test\s*\(NAME \"?([\w.]+)[\"\s]", text))
        for prefix in re.findall(r'\badd_test\s*\(NAME "([\w.]+)\$\{name\}"', text):
            names = re.findall(r"\badd_\w+_(?:test|target)\s*\((\w+)", text)
            self.tests.update(prefix + name for name in names)

    def add_module(self, text):
        self.targets.update(re.findall(r"^NAME\s+(?:\w+::)?(\w+)", text, re.MULTILINE))

    def add_cxx(self, program, text):
        for suite, test in re.findall(r"^(?:TYPED_)?TEST(?:_[FP])?\((\w+),\s*(\w+)\)", text, re.MULTILINE):
            self.tests.add("%s.%s.%s" % (program, suite, test))

    def has_test(self, pattern):
        """Whether each alternative of a pattern, as those in ^(a|b), is found in a test's name."""
        before, group, after = re.fullmatch(r"([^()]*)(?:\(([^()]*)\))?(.*)", pattern).groups()
        patterns = [before + choice + after for choice in group.split("|")] if group else [pattern]
        try:
            return all(any(re.search(one, test) for test in self.tests) for one in patterns)
        except re.error:
            return False


class Checker:
    def __init__(self, root, python_path=None, runs_pvbatch=False):
        self.root, self.python_path = os.path.abspath(root), python_path
        self.runs_pvbatch = runs_pvbatch
        self.defects, self.documents = [], {}
        self.entries = set(os.listdir(self.root)) - {"build"}
        self.file_names, self.names, self.identifiers = set(), BuildNames(), set(PLACEHOLDERS)
        self.sources = {}  # paths of C++ files by their names
        self.defaults = {}  # of properties, as headers of classes and of the core's options initialize them
        self.constants = {}  # of defaults
        self.plugin_defaults = {}  # of properties, as the plugin's XML has them
        for folder, folders, names in os.walk(self.root):
            folders[:] = [name for name in folders if name != ".git" and not name.startswith("build")]
            self.file_names.update(names)
            for name in names:
                self.add_source(name, os.path.join(folder, name))
        presets = json.loads(read(os.path.join(self.root, "CMakePresets.json")))["configurePresets"]
        self.presets = {preset["name"] for preset in presets if not preset.get("hidden")}

    def add_source(self, name, path):
        self.identifiers.update(re.findall(r"\w+", name))
        if name == "vtk.module":
            self.names.add_module(read(path))
        elif name.endswith(WITH_IDENTIFIERS) and name not in OF_THIS_CHECK:
            text = read(path)
            self.identifiers.update(re.findall(r"\w+", text))
            if name.endswith((".h", ".cxx")):
                self.sources.setdefault(name, path)
            if re.match(r"(vtk\w+|Options)\.h$", name):
                for member, value in PROPERTY_MEMBER.findall(text):
                    self.defaults.setdefault(member[0].upper() + member[1:], set()).add(value)
            self.constants.update(DEFAULT_CONSTANT.findall(text))
            if name.endswith(".xml"):
                for element in PROPERTY_ELEMENT.findall(text):
                    attributes = dict(re.findall(r'(\w+)="([^"]*)"', element))
                    member = re.fullmatch(r"Set(\w+)", attributes.get("command", ""))
                    if member and "default_values" in attributes:
                        values = self.plugin_defaults.setdefault(member.group(1), set())
                        values.add(attributes["default_values"])
            if name.endswith((".cmake", "CMakeLists.txt")):
                self.names.add_cmake(text)
            elif name.endswith(".cxx"):
                self.names.add_cxx(name[: -len(".cxx")], text)

    def report(self, name, number, message):
        self.defects.append("%s:%d: %s" % (name, number, message))

    def document(self, path):
        if path not in self.documents:
            self.documents[path] = Document(path)
        return self.documents[path]

    def run(self):
        for pattern in DOCUMENTS:
            found = sorted(glob.glob(os.path.join(self.root, pattern), recursive=True))
            if not found:
                self.report(pattern, 0, "is missing")
            for path in found:
                self.check(os.path.relpath(path, self.root), self.document(path))
        return self.defects

    def check(self, name, document):
        self.check_tables(name, document.lines)
        for number, message in document.defects:
            self.report(name, number, message)
        for first, text in document.paragraphs:
            prose = re.sub(r"`[^`]+`", lambda code: re.sub(r"\S", "x", code.group()), text)
            for match in UNFINISHED.finditer(prose):
                word = match.group()
                if word not in CAPITALS and word not in self.identifiers:
                    number = first + text.count("\n", 0, match.start())
                    self.report(name, number, "%s is still to be filled in" % word)
            for match in LINKS.finditer(prose):
                number = first + text.count("\n", 0, match.start(match.lastindex))
                self.check_link(name, number, match.group(match.lastindex))
            for match in re.finditer(r"`([^`]+)`", text):
                self.check_code(name, first + text.count("\n", 0, match.start()), match.group(1))
        for language, first, code, setup in document.blocks:
            if language not in LANGUAGES:
                self.report(name, first, "a block in the unknown language %s" % (language or "(none)"))
            elif language == "bash":
                self.check_commands(name, first, code)
            elif language in ("python", "pvpython", "py"):
                self.check_script(name, first, language, code, setup)

    def check_link(self, name, number, target):
        if re.match(r"[a-z]+:", target):
            return
        path, _, anchor = target.partition("#")
        folder = os.path.dirname(os.path.join(self.root, name))
        full = os.path.normpath(os.path.join(folder, path)) if path else os.path.join(self.root, name)
        if not full.startswith(self.root + os.sep) or not os.path.exists(full):
            self.report(name, number, "no file for the link %s" % target)
        elif anchor and anchor not in self.document(full).anchors:
            self.report(name, number, "no heading for the link %s" % target)

    def check_tables(self, name, lines):
        """Tables of constants, whose rows begin with name, file and value, and of properties' defaults."""
        header = []
        for number, line in enumerate(lines, 1):
            cells = [cell.strip() for cell in line.strip("|").split("|")] if line.startswith("|") else []
            if not cells or not header:
                header = cells
            elif len(cells) < len(header) or set(line) <= set("|-: "):
                continue
            elif header[:3] == ["constant", "file", "value"]:
                self.check_constant(name, number, *cells[:3])
            elif "default" in header and re.match(r"`\w+`", cells[0]):
                member = re.match(r"\w+", cells[0][1:]).group()
                self.check_default(name, number, member, cells[header.index("default")])

    def check_constant(self, name, number, constant, file, value):
        if not re.fullmatch(r"`\w+`", constant):
            self.report(name, number, "%s is no constant's name in backticks" % constant)
            return
        constant = constant.strip("`")
        text = read(self.sources[file]) if file in self.sources else ""
        values = re.findall(r"\bconstexpr\b[^;={]*\b%s\s*(?:=\s*([^;]+)|\{([^;]+)\});" % constant, text)
        values = [number_of(first or second) for first, second in values]
        if not values:
            self.report(name, number, "no constant %s in %s" % (constant, file))
        elif number_of(value) is None or number_of(value) not in values:
            self.report(name, number, "%s is %s in %s, not %s" % (constant, values[0], file, value))

    def check_default(self, name, number, member, cell):
        """A default that begins with a number, on, off, or (the beginning of) the name of a constant."""
        default = re.match(r"`?([\w.+-]*)", cell).group(1)
        wanted = number_of(SWITCHES.get(default, default))
        values = self.defaults.get(member) or self.plugin_defaults.get(member, set())
        values = {SWITCHES.get(value, self.constants.get(value, value)) for value in values}
        if wanted is not None:
            agrees = wanted in {number_of(value) for value in values}
        else:
            agrees = not values or any(
                value.lower().startswith(default.lower()) or default.lower().startswith(value.lower())
                for value in values)
        if not values and not agrees:
            self.report(name, number, "no default of %s in the sources" % member)
        elif not agrees or not default:
            self.report(name, number, "the default of %s is %s, not %s"
                        % (member, " or ".join(sorted(values)), cell))  # fmt: skip

    def check_path(self, name, number, word):
        """A word in backticks or of a command that looks like a path of the tree."""
        word = word.split("=")[-1].rstrip(",.;:)")
        word = word[2:] if word.startswith("./") else word
        if not re.fullmatch(r"[\w.*-]+(?:/[\w.*-]+)*/?", word):
            return
        parts = word.rstrip("/").split("/")
        if parts[0] == "build":
            if len(parts) > 2 and parts[1] not in self.presets:
                self.report(name, number, "%s: no preset %s" % (word, parts[1]))
        elif len(parts) == 1:
            if word.endswith(SOURCES) and not fnmatch.filter(self.file_names, word):
                self.report(name, number, "no file %s" % word)
        elif parts[0] in self.entries or word.endswith(SOURCES):
            folders = ("", os.path.dirname(name), "Filters", "Core")
            if not any(glob.glob(os.path.join(self.root, folder, word)) for folder in folders):
                self.report(name, number, "no file %s" % word)

    def check_code(self, name, number, code):
        """Code in backticks."""
        for word in code.split():
            self.check_path(name, number, word)
        self.check_options(name, number, code.split())
        for word in IDENTIFIERS.findall(code):
            if word not in self.identifiers:
                self.report(name, number, "no identifier %s in the sources" % word)

    def check_options(self, name, number, words):
        """Presets, targets, CMake's options and tests that the words of a command name."""
        values = re.compile(r"(?:(--preset|--target|--tests-regex)=|(-D))(.+)")
        option = ""
        for word in words:
            match = values.fullmatch(word)
            if match:
                option, word = match.group(1) or match.group(2), match.group(3)
            elif re.match(r"-|[;&|()]+$", word):
                option = word
                continue
            if option == "--preset" and word not in self.presets and not word.isupper():
                self.report(name, number, "no preset %s" % word)
            elif option == "--target" and word not in self.names.targets:
                self.report(name, number, "no target %s" % word)
            elif option == "--tests-regex" and not self.names.has_test(word.strip("\"'")):
                self.report(name, number, "no test for %s" % word)
            elif option == "-D" and re.match("SCATTEREDISOPOINTS_", word):
                if re.match(r"\w+", word).group() not in self.names.options:
                    self.report(name, number, "no option %s" % word)
            if option != "--target":  # which alone takes several
                option = ""

    def check_commands(self, name, first, code):
        syntax = subprocess.run(["bash", "-n"], input=code, text=True, stderr=subprocess.PIPE)
        if syntax.returncode != 0:
            self.report(name, first, syntax.stderr.strip())
            return
        number = first + 1
        for line in re.findall(r"(?:[^\\\n]|\\(?:.|\n))*\n", code):  # with those that continue it
            try:
                lexer = shlex.shlex(line.replace("\\\n", " "), posix=True, punctuation_chars=";&|()")
                lexer.whitespace_split = True
                words = list(lexer)
            except ValueError:  # part of a longer quotation
                words = []
            self.check_line(name, number, words)
            number += line.count("\n")

    def check_line(self, name, number, words):
        """The words of one line of commands."""
        self.check_options(name, number, words)
        for word in words:
            self.check_path(name, number, word)
        commands = [word for word in words if not re.match(r"\w+=", word)]
        script = os.path.join(self.root, commands[0]) if commands else self.root
        if os.path.isfile(script) and not os.access(script, os.X_OK):
            self.report(name, number, "%s is not executable" % commands[0])

    def check_script(self, name, first, language, code, setup):
        if setup.endswith(".py") and "\n" not in setup:
            try:
                setup = read(os.path.join(self.root, setup))
            except OSError:
                self.report(name, first, "no file %s" % setup)
                return
        try:
            compile(setup + "\n", "the setup", "exec")
            compile("\n" * first + code, name, "exec")
        except SyntaxError as error:
            self.report(name, error.lineno or first, "no Python: %s" % error.msg)
            return
        if language == "python" and self.python_path:
            command = [sys.executable]
        elif language == "pvpython" and self.runs_pvbatch:
            command = ["pvbatch"]
        else:
            return
        environment = dict(os.environ)
        if self.python_path:
            environment["PYTHONPATH"] = self.python_path
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "script.py"), "w", encoding="utf-8") as file:
                file.write(setup + "\n" + code)
            result = subprocess.run(command + ["script.py"], cwd=folder, env=environment, text=True,
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)  # fmt: skip
        if result.returncode != 0 or "ERROR" in result.stdout or "ERR|" in result.stdout:
            self.report(name, first, "the script fails:\n" + result.stdout.strip())


def main():
    source_dir = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--root", default=source_dir, help="the source tree; default: this one")
    parser.add_argument("--run-with", metavar="PYTHONPATH", help="run python blocks with it")
    parser.add_argument("--run-pvbatch", action="store_true", help="run pvpython blocks as well")
    arguments = parser.parse_args()
    defects = Checker(arguments.root, arguments.run_with, arguments.run_pvbatch).run()
    print("\n".join(defects) if defects else "documents: no defects")
    return 1 if defects else 0


if __name__ == "__main__":
    sys.exit(main())
