# SPDX-License-Identifier: GPL-3.0-or-later
"""A Markdown file taken apart, for check-documents.py and TestWheel.py."""

import re

FENCES = re.compile(r"^ *(`{3,}|~{3,})([^`\n]*)\n(.*?)^ *\1 *$|<!--.*?-->", re.MULTILINE | re.DOTALL)


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


class Document:
    """Text without blocks and comments, and the blocks as (language, line, code)."""

    def __init__(self, path):
        self.blocks = []

        def cut(match):
            if match[1]:
                self.blocks.append((match[2].strip(), source.count("\n", 0, match.start()) + 1, match[3]))
            return "\n" * match[0].count("\n")

        source = read(path)
        self.text = FENCES.sub(cut, source)
        headings = re.findall(r"^#+ (.*)", self.text, re.MULTILINE)
        headings = [re.sub(r"\]\([^)]*\)", "", heading).strip().lower() for heading in headings]
        anchors = [re.sub(r"[^\w\- ]", "", heading).replace(" ", "-") for heading in headings]
        self.anchors = {f"{each}-{anchors[:i].count(each)}".removesuffix("-0") for i, each in enumerate(anchors)}
