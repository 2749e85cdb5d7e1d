# SPDX-License-Identifier: GPL-3.0-or-later
"""A Markdown file taken apart, for check-documents.py."""

import re


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


class Document:
    """The paragraphs of a file, its headings and its fenced blocks, with their line numbers.

    A paragraph is all text between blank lines, fences and comments. Fences and comments without an
    end are in defects.
    """

    def __init__(self, path):
        self.lines = read(path).splitlines()
        self.paragraphs, self.anchors, self.blocks, self.defects = [], set(), [], []
        self.continues = False
        fence, comment, language, first, setup = None, None, "", 0, ""
        for number, line in enumerate(self.lines, 1):
            if fence:
                if re.fullmatch(r" *%s+ *" % fence, line):
                    code = "\n".join(self.lines[first : number - 1]) + "\n"
                    self.blocks.append((language, first, code, setup))
                    fence, setup = None, ""
                continue
            if comment is not None or line.startswith("<!--"):
                if comment is None:
                    comment, first = "", number
                comment += line + "\n"
                if "-->" not in line:
                    continue
                comment, line = comment.split("-->", 1)
                found = re.match(r"<!--\s*setup:(.*)", comment, re.DOTALL)
                setup, comment, self.continues = found.group(1).strip() if found else "", None, False
                if line.strip():
                    self.add_line(number, line.strip("\n"))
                continue
            found = re.match(r" *(`{3,}|~{3,})([^`]*)$", line)
            if found:
                fence, first, self.continues = found.group(1), number, False
                language = (found.group(2).split() or [""])[0]
            else:
                setup = setup if not line else ""
                self.add_line(number, line)
        if fence or comment is not None:
            self.defects.append((first, "a %s without an end" % ("fence" if fence else "comment")))

    def add_line(self, number, line):
        if not line.strip():
            self.continues = False
            return
        if self.continues:
            self.paragraphs[-1][1] += "\n" + line
        else:
            self.paragraphs.append([number, line])
        self.continues = True
        if re.match(r"#+ ", line):
            self.add_anchor(line.lstrip("#"))

    def add_anchor(self, heading):
        text = re.sub(r"\]\([^)]*\)", "", heading).strip().lower()
        anchor = re.sub(r"[^\w\- ]", "", text).replace(" ", "-")
        count = sum(re.sub(r"-\d+$", "", known) == anchor for known in self.anchors)
        self.anchors.add("%s-%d" % (anchor, count) if count else anchor)
