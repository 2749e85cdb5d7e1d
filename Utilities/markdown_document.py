# SPDX-License-Identifier: GPL-3.0-or-later
"""A Markdown file taken apart, for check-documents.py."""

import re


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


class Document:
    """The prose lines of a file, its headings and its fenced blocks, with their line numbers."""

    def __init__(self, path):
        self.lines = read(path).splitlines()
        self.prose, self.anchors, self.blocks = [], set(), []
        language, first, setup, comment = None, 0, "", None
        for number, line in enumerate(self.lines, 1):
            fence = re.match(r" *```+ *([\w-]*)", line)
            if language is not None:
                if fence:
                    code = "\n".join(self.lines[first : number - 1]) + "\n"
                    self.blocks.append((language, first, code, setup))
                    language, setup = None, ""
            elif comment is not None or line.startswith("<!--"):
                comment = line if comment is None else comment + "\n" + line
                if "-->" in line:
                    found = re.fullmatch(r"<!--\s*setup:(.*)-->\s*", comment, re.DOTALL)
                    setup, comment = found.group(1).strip() if found else "", None
            elif fence:
                language, first = fence.group(1), number
            else:
                setup = setup if not line else ""
                self.prose.append((number, line))
                if re.match(r"#+ ", line):
                    self.add_anchor(line.lstrip("#"))

    def add_anchor(self, heading):
        text = re.sub(r"\]\([^)]*\)", "", heading).strip().lower()
        anchor = re.sub(r"[^\w\- ]", "", text).replace(" ", "-")
        count = sum(re.sub(r"-\d+$", "", known) == anchor for known in self.anchors)
        self.anchors.add("%s-%d" % (anchor, count) if count else anchor)
