# SPDX-License-Identifier: GPL-3.0-or-later
"""Options are listed only where docs/architecture.md says: TestOptionPlaces.py SOURCE_DIR

A place that lists options names most of them in its code. A header and its source file are one place.
"""

import ast
import pathlib
import re
import sys

MOST_PLACES = 5

root = pathlib.Path(sys.argv[1])
listed = re.search(r"all = std::make_tuple\((.*?)\)", (root / "Core/Options.h").read_text(), re.DOTALL)[1]
options = re.findall(r"\w+", listed)


def code_of(path):
    """The text of a file without comments and docstrings."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        tree = ast.parse(text)
        for node in ast.walk(tree):
            if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str):
                node.value.value = ""
        return ast.unparse(tree)
    return re.sub(r"//.*?$|/\*.*?\*/|<!--.*?-->", "", text, flags=re.MULTILINE | re.DOTALL)


def place_of(path):
    """The path without extensions; isopoint.h is the header of all in its folder."""
    relative = path.relative_to(root)
    return "Library/isopoint" if relative.parts[0] == "Library" else str(relative).split(".")[0]


named = {}
for folder in ("Core", "Filters", "Library", "Plugin", "Python", "Rendering"):
    for path in sorted((root / folder).rglob("*")):
        if path.is_file() and path.suffix in (".h", ".cxx", ".py", ".in", ".xml"):
            words = set(re.findall(r"\w+", code_of(path).replace("_", "").lower()))
            found = {option for option in options if {option.lower(), "set" + option.lower()} & words}
            named.setdefault(place_of(path), set()).update(found)
lists = sorted(place for place, names in named.items() if 3 * len(names) > 2 * len(options))

section = re.search(r"^A property of the filters.*?:\n(.*?)\n\n", (root / "docs/architecture.md").read_text(encoding="utf-8"),
                    re.MULTILINE | re.DOTALL)[1]
documented = [re.match(r"\d\. `([^`.]+)", line)[1] for line in section.splitlines() if line[0].isdigit()]
if len(options) < 10 or len(lists) < 4 or len(documented) > MOST_PLACES or not set(lists) <= set(documented):
    sys.exit(f"failed: {len(options)} options are listed in {lists}; docs/architecture.md names {documented}")
