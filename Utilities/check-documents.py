#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks README.md, CONTRIBUTING.md, CHANGELOG.md and docs/*.md of a source tree.

Links, anchors and paths in backticks exist; commands in blocks marked bash or sh parse and name
scripts, presets and targets that exist; blocks marked python or pvpython compile and, where asked
for, run; words and places that do not belong into a document are not there. Prints
file:line: message for each defect and exits with 1 if there is any.

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

DOCUMENTS = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/*.md")
README_LINES = 130
SOURCES = (".h", ".cxx", ".glsl", ".py", ".sh", ".cmake")  # in backticks, these are the tree's
INSTALLED_PLUGIN = "/usr/local/lib/ScatteredIsopoints/ScatteredIsopoints.so"
UNWANTED = (
    # words of no field, where it has its own
    re.compile(r"\b(?:[Tt]ell|[Tt]ells|[Tt]old|[Hh]eaps?|[Ss]lots?)\b"),
    # relative paths that leave the repository
    re.compile(r"\.\./(?:\.\./|[a-z][\w-]*/)"),
    # absolute paths
    re.compile(r"(?<![\w/.:<>*)\]}])/(?!usr/(?:local|bin)\b)[A-Za-z][\w.-]*(?:/[\w.-]+)*"),
)


class Checker:
    def __init__(self, root, python_path=None, plugin=None):
        self.root, self.python_path, self.plugin = os.path.abspath(root), python_path, plugin
        self.defects, self.documents = [], {}
        self.entries = set(os.listdir(self.root)) - {"build"}
        self.file_names, self.cmake_lists = set(), ""
        for folder, folders, names in os.walk(self.root):
            folders[:] = [name for name in folders if name != ".git" and not name.startswith("build")]
            self.file_names.update(names)
            if "CMakeLists.txt" in names:
                self.cmake_lists += read(os.path.join(folder, "CMakeLists.txt"))
        presets = json.loads(read(os.path.join(self.root, "CMakePresets.json")))["configurePresets"]
        self.presets = {preset["name"] for preset in presets if not preset.get("hidden")}

    def report(self, name, number, message):
        self.defects.append("%s:%d: %s" % (name, number, message))

    def document(self, path):
        if path not in self.documents:
            self.documents[path] = Document(path)
        return self.documents[path]

    def run(self):
        for pattern in DOCUMENTS:
            found = sorted(glob.glob(os.path.join(self.root, pattern)))
            if not found:
                self.report(pattern, 0, "is missing")
            for path in found:
                self.check(os.path.relpath(path, self.root), self.document(path))
        return self.defects

    def check(self, name, document):
        if name == "README.md" and len(document.lines) > README_LINES:
            self.report(name, len(document.lines), "more than %d lines" % README_LINES)
        for number, line in enumerate(document.lines, 1):
            for word in (word for pattern in UNWANTED for word in pattern.findall(line)):
                self.report(name, number, '"%s" does not belong into a document' % word)
        for number, line in document.prose:
            for target in re.findall(r"\]\(([^)\s]+)\)", line):
                self.check_link(name, number, target)
            for code in re.findall(r"`([^`]+)`", line):
                for word in code.split():
                    self.check_path(name, number, word)
                self.check_presets(name, number, code.split())
        for language, first, code, setup in document.blocks:
            if not language:
                self.report(name, first, "a block without a language")
            elif language in ("bash", "sh"):
                self.check_commands(name, first, code)
            elif language in ("python", "pvpython"):
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
            folders = ("", os.path.dirname(name), "Filters", "Filters/Isopoint")
            if not any(glob.glob(os.path.join(self.root, folder, word)) for folder in folders):
                self.report(name, number, "no file %s" % word)

    def check_presets(self, name, number, words):
        for option, value in zip(words, words[1:]):
            if option == "--preset" and value not in self.presets and not value.isupper():
                self.report(name, number, "no preset %s" % value)
            if option == "--target" and not re.search(r"\b%s\b" % re.escape(value), self.cmake_lists):
                self.report(name, number, "no target %s" % value)

    def check_commands(self, name, first, code):
        syntax = subprocess.run(["bash", "-n"], input=code, text=True, stderr=subprocess.PIPE)
        if syntax.returncode != 0:
            self.report(name, first, syntax.stderr.strip())
            return
        for number, line in enumerate(code.splitlines(), first + 1):
            try:
                words = shlex.split(line, comments=True)
            except ValueError:  # part of a longer quotation
                continue
            self.check_presets(name, number, words)
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
        environment = dict(os.environ)
        if language == "python" and self.python_path:
            command = [sys.executable]
            environment["PYTHONPATH"] = self.python_path
        elif language == "pvpython" and self.plugin:
            command = ["pvbatch"]
            code = code.replace(INSTALLED_PLUGIN, os.path.abspath(self.plugin))
        else:
            return
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
    parser.add_argument("--run-pvbatch", metavar="PLUGIN", help="run pvpython blocks with it")
    arguments = parser.parse_args()
    defects = Checker(arguments.root, arguments.run_with, arguments.run_pvbatch).run()
    print("\n".join(defects) if defects else "documents: no defects")
    return 1 if defects else 0


if __name__ == "__main__":
    sys.exit(main())
