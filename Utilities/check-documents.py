#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks README.md, CONTRIBUTING.md, CHANGELOG.md and docs/**/*.md of a source tree.

Links, anchors, and the paths and identifiers in backticks exist. Blocks marked bash parse, and name presets, targets,
options, tests and executable scripts that exist. Nothing is left to be filled in. Blocks marked python, pvpython or py
(with PyVista) compile; the first two run on request. Tables of constants and of defaults have the values of the
sources. Prints file:line: message for each defect and exits with 1 if there is any. The comment <!-- setup: FILE.py -->
or <!-- setup: code --> before a block runs before it.
"""

import argparse
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
WITH_IDENTIFIERS = (".h", ".cxx", ".xml", ".py", ".cmake", ".in", "CMakeLists.txt")
NOT_HERE = ("check-documents.py", "TestCheckDocuments.py")  # name identifiers that do not exist
LANGUAGES = ("bash", "cmake", "pvpython", "py", "python", "text")
PLACEHOLDERS = {"GetX", "SetX", "XOff", "XOn"}  # stand for identifiers
STANDARD_TARGETS = {"all", "clean", "install", "package", "test"}
# What waits to be filled in: words such as RESULTS or TESTS12 that no source has.
UNFINISHED = re.compile(r"(\?\?\?|\b(?:TODO|TBD|FIXME|XXX|TKTK)\b|\b[A-Z]{4,}\d*[A-Z]*\b)")
CAPITALS = {"BRDF", "DATA", "EPYC", "FILE", "IEEE", "PSNR", "README", "SIGGRAPH", "VGTC"}
LINKS = re.compile(r"""\]\(\s*<?([^)\s>]+)|^ {0,3}\[[^\]^]+\]:\s*<?([^\s>]+)"""
                   r"""|<\w+\s[^>]*?\b(?:src|href)\s*=\s*["']?([^"'\s>]+)""", re.MULTILINE)
CODE = re.compile(r"`([^`\n]+(?:\n[^`\n]+)*)`")
IDENTIFIER = re.compile(r"\b(?:vtk\w+|(?=\w*[a-z])[A-Za-z]\w*[A-Z]\w*)\b")
NAMED = re.compile(r"(--preset)[=\s]+([\w-]+)|(-D) *(SCATTEREDISOPOINTS_\w+)"
                   r"|(--tests-regex)[=\s]+('[^']*'|\S+)|(--target)[=\s]+((?:(?! -|[;&]| \|)[^\n])+)")
MEMBER = re.compile(r"^  (?:double|int|bool|vtkTypeBool) (\w+) = (?:static_cast<int>\(\w+::)?([\w.]+)\)?;", re.MULTILINE)
SWITCHES = {"on": "1", "off": "0", "true": "1", "false": "0"}


def number_of(text):
    """The value of an expression of numbers in C++ or in a document, or None."""
    text = re.sub(r"std::\w+(?=\s*\{)|\b(?:long )?double(?=\s*\{)", "", text).translate(str.maketrans("{}", "()", "'"))
    try:
        return eval(text.replace("^", "**")) if re.fullmatch(r"[\d\s.eE()<>*/^+-]+", text) else None
    except (SyntaxError, TypeError, ZeroDivisionError):
        return None


class Checker:
    def __init__(self, root, python_path, runs_pvbatch):
        self.root, self.python_path, self.runs_pvbatch = os.path.abspath(root), python_path, runs_pvbatch
        self.defects, self.name, self.identifiers = [], "", set(PLACEHOLDERS)
        self.targets, self.options, self.tests = set(STANDARD_TARGETS), set(), set()
        self.sources, self.defaults, self.plugin_defaults, self.constants = {}, {}, {}, {}
        for folder, folders, names in os.walk(self.root):
            folders[:] = [name for name in folders if name != ".git" and not name.startswith("build")]
            for name in names:
                self.sources.setdefault(name, os.path.join(folder, name))
                self.identifiers.update(re.findall(r"\w+", name))
                if name == "vtk.module":
                    text = read(os.path.join(folder, name))
                    self.targets.update(re.findall(r"^NAME\s+(?:\w+::)?(\w+)", text, re.MULTILINE))
                elif name.endswith(WITH_IDENTIFIERS) and name not in NOT_HERE:
                    self.add_source(name, read(os.path.join(folder, name)))
        presets = json.loads(read(os.path.join(self.root, "CMakePresets.json")))["configurePresets"]
        self.presets = {preset["name"] for preset in presets if not preset.get("hidden")}

    def add_source(self, name, text):
        self.identifiers.update(re.findall(r"\w+", text))
        self.constants.update(re.findall(r"constexpr \w+ (default\w+) = ([\w.]+);", text))
        for member, value in MEMBER.findall(text) if re.match(r"(vtk\w+|Options)\.h$", name) else ():
            self.defaults.setdefault(member[0].upper() + member[1:], set()).add(value)
        for element in re.findall(r"<\w+VectorProperty\b[^>]*>", text) if name.endswith(".xml") else ():
            found = [re.search(name + r'="([^"]*)"', element) for name in ("command", "default_values")]
            if all(found):
                self.plugin_defaults.setdefault(found[0][1][3:], set()).add(found[1][1])
        if name.endswith((".cmake", "CMakeLists.txt")):
            self.add_cmake(re.sub(r"#.*", "", text))
        for suite, test in re.findall(r"^(?:TYPED_)?TEST(?:_[FP])?\((\w+),\s*(\w+)\)", text, re.MULTILINE):
            self.tests.add(f"{name.removesuffix('.cxx')}.{suite}.{test}")

    def add_cmake(self, text):
        """Targets, options and tests, as far as a file of CMake names them."""
        self.targets.update(re.findall(r"\badd_(?:executable|library|custom_target)\s*\(\s*(\w+)", text))
        for wrapper in re.findall(r"\bfunction\s*\((\w+) name\b[^)]*\)\s*add_(?:executable|cxx_test)\b", text):
            self.targets.update(re.findall(rf"\b{wrapper}\s*\((\w+)", text))
        for names in re.findall(r"\bforeach\s*\(name ([\w\s]+)\)\s*add_\w+_test\b", text):
            self.targets.update(names.split())
        self.options.update(re.findall(r"\boption\s*\(\s*(\w+)", text))
        self.options.update(re.findall(r"\bset\s*\(\s*(\w+)[^()]*\sCACHE\s", text))
        self.tests.update(re.findall(r"\badd_test\s*\(NAME \"?([\w.]+)[\"\s]", text))
        for prefix in re.findall(r'\badd_test\s*\(NAME "?([\w.]+)\$\{name\}', text):
            self.tests.update(prefix + name for name in re.findall(r"\badd_\w+_(?:test|target)\s*\((\w+)", text))

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
        prose = CODE.sub(lambda code: re.sub(r"\S", "x", code[0]), text)
        for pattern, where, check in (
                (LINKS, prose, self.check_link), (CODE, text, self.check_code),
                (UNFINISHED, prose, self.check_finished), (re.compile(r"(`{3,}|~{3,}|<!--)"), text,
                 lambda line, word: self.report(line, word + " without an end"))):
            for match in pattern.finditer(where):
                check(text.count("\n", 0, match.start(match.lastindex)) + 1, match[match.lastindex])
        self.check_tables(text)
        for language, line, code, setup in document.blocks:
            if language not in LANGUAGES:
                self.report(line, f"a block in the unknown language {language or '(none)'}")
            elif language == "bash":
                self.check_commands(line, code)
            elif language in ("python", "pvpython", "py"):
                self.check_script(line, language, code, setup)

    def check_finished(self, line, word):
        if word not in CAPITALS and word not in self.identifiers:
            self.report(line, word + " is still to be filled in")

    def check_link(self, line, target):
        path, _, anchor = target.partition("#")
        path = os.path.join(os.path.dirname(self.name), path) if path else self.name
        full = os.path.normpath(os.path.join(self.root, path))
        if re.match(r"[a-z]+:", target):
            return
        if not full.startswith(self.root + os.sep) or not os.path.exists(full):
            self.report(line, f"no file for the link {target}")
        elif anchor and anchor not in Document(full).anchors:
            self.report(line, f"no heading for the link {target}")

    def check_code(self, line, code):
        """Code in backticks."""
        self.check_words(line, code)
        for word in IDENTIFIER.findall(code):
            if word not in self.identifiers:
                self.report(line, f"no identifier {word} in the sources")

    def check_words(self, line, text):
        """Paths, and names of presets, targets, options and tests, of code or of a command."""
        for word in re.split(r"[\s;&|()\"']+", text):
            self.check_path(line, re.sub(r"^\./", "", word.split("=")[-1].rstrip(",.;:)")))
        for option, value in (filter(None, found) for found in NAMED.findall(text)):
            if option == "--tests-regex" and not self.has_test(value.strip("'\"")):
                self.report(line, f"no test for {value}")
            kind, known = {"--preset": ("preset", self.presets), "-D": ("option", self.options),
                           "--target": ("target", self.targets)}.get(option, ("", ()))
            for word in value.split() if kind else ():
                if word not in known and not (kind == "preset" and word.isupper()):
                    self.report(line, f"no {kind} {word}")

    def has_test(self, pattern):
        """Whether each alternative of a pattern, as those in ^(a|b), is found in a test's name."""
        before, group, after = re.fullmatch(r"([^()]*)(?:\(([^()]*)\))?(.*)", pattern).groups()
        try:
            patterns = [re.compile(before + each + after) for each in (group or "").split("|")]
            return all(any(map(pattern.search, self.tests)) for pattern in patterns)
        except re.error:
            return False

    def check_path(self, line, word):
        if not re.fullmatch(r"[\w.*-]+(?:/[\w.*-]+)*/?", word):
            return
        parts = word.rstrip("/").split("/")
        if parts[0] == "build":
            if len(parts) > 2 and parts[1] not in self.presets:
                self.report(line, f"{word}: no preset {parts[1]}")
        elif len(parts) == 1:
            if word.endswith(SOURCES) and not fnmatch.filter(self.sources, word):
                self.report(line, f"no file {word}")
        elif os.path.exists(os.path.join(self.root, parts[0])) or word.endswith(SOURCES):
            folders = ("", os.path.dirname(self.name), "Filters", "Core")
            if not any(glob.glob(os.path.join(self.root, folder, word)) for folder in folders):
                self.report(line, f"no file {word}")

    def check_commands(self, first, code):
        syntax = subprocess.run(["bash", "-n"], input=code, text=True, stderr=subprocess.PIPE)
        if syntax.returncode != 0:
            self.report(first, syntax.stderr.strip())
            return
        for match in re.finditer(r"(?:[^\\\n]|\\(?:.|\n))+", code):  # with the lines that continue it
            line, text = first + 1 + code.count("\n", 0, match.start()), match[0].replace("\\\n", " ")
            self.check_words(line, re.sub(r"(^|\s)#.*", "", text))
            script = re.match(r"(?:\w+=\S+\s+)*(\S+)", text)
            path = os.path.join(self.root, script[1]) if script else self.root
            if os.path.isfile(path) and not os.access(path, os.X_OK):
                self.report(line, f"{script[1]} is not executable")

    def check_script(self, first, language, code, setup):
        try:
            if re.fullmatch(r"\S+\.py", setup):
                setup = read(os.path.join(self.root, setup))
            compile(setup + "\n", "the setup", "exec")
            compile("\n" * first + code, self.name, "exec")
        except OSError:
            return self.report(first, f"no file {setup}")
        except SyntaxError as error:
            return self.report(error.lineno or first, f"no Python: {error.msg}")
        command = {"python": sys.executable if self.python_path else None,
                   "pvpython": "pvbatch" if self.runs_pvbatch else None}.get(language)
        if command:
            environment = dict(os.environ, PYTHONPATH=self.python_path or os.environ.get("PYTHONPATH", ""))
            with tempfile.TemporaryDirectory() as folder:
                with open(os.path.join(folder, "script.py"), "w", encoding="utf-8") as file:
                    file.write(setup + "\n" + code)
                done = subprocess.run([command, "script.py"], cwd=folder, env=environment, text=True,
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            if done.returncode != 0 or "ERROR" in done.stdout or "ERR|" in done.stdout:
                self.report(first, "the script fails:\n" + done.stdout.strip())

    def check_tables(self, text):
        """Rows of constants, which begin with name, file and value, and of properties with their defaults."""
        header = []
        for number, line in enumerate(text.split("\n"), 1):
            cells = [cell.strip() for cell in line.strip("|").split("|")] if line.startswith("|") else []
            if not cells or not header:
                header = cells
            elif len(cells) < len(header) or set(line) <= set("|-: "):
                continue
            elif header[:3] == ["constant", "file", "value"]:
                self.check_constant(number, *cells[:3])
            elif "default" in header and re.match(r"`\w+`", cells[0]):
                self.check_default(number, re.match(r"`(\w+)", cells[0])[1], cells[header.index("default")])

    def check_constant(self, line, constant, file, value):
        if not re.fullmatch(r"`\w+`", constant):
            return self.report(line, f"{constant} is no constant's name in backticks")
        constant = constant.strip("`")
        text = read(self.sources[file]) if file in self.sources else ""
        values = re.findall(r"\bconstexpr\b[^;={]*\b%s\s*(?:=\s*([^;]+)|\{([^;]+)\});" % re.escape(constant), text)
        values = [number_of(first or second) for first, second in values]
        if not values:
            self.report(line, f"no constant {constant} in {file}")
        elif number_of(value) is None or number_of(value) not in values:
            self.report(line, f"{constant} is {values[0]} in {file}, not {value}")

    def check_default(self, line, member, cell):
        """A default begins with a number, on, off, or the name of a constant or its beginning."""
        default = re.match(r"`?([\w.+-]*)", cell)[1]
        wanted = number_of(SWITCHES.get(default, default))
        values = self.defaults.get(member) or self.plugin_defaults.get(member, set())
        values = {SWITCHES.get(value, self.constants.get(value, value)) for value in values}
        pairs = [(value.lower(), default.lower()) for value in values]
        agrees = (not values or any(a.startswith(b) or b.startswith(a) for a, b in pairs)) if wanted is None else \
            wanted in map(number_of, values)
        if not agrees or not default:
            known = " or ".join(sorted(values)) or "not in the sources"
            self.report(line, f"the default of {member} is {known}, not {cell}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--root", default=os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    parser.add_argument("--run-with", metavar="PYTHONPATH", help="run python blocks with it")
    parser.add_argument("--run-pvbatch", action="store_true", help="run pvpython blocks as well")
    arguments = parser.parse_args()
    found = Checker(arguments.root, arguments.run_with, arguments.run_pvbatch).run()
    print("\n".join(found) if found else "documents: no defects")
    sys.exit(1 if found else 0)
