# SPDX-License-Identifier: GPL-3.0-or-later
"""Programs compiled with isopoint.h of version 1.0 run with the present library.

TestVersions.py HEADER_OF_1_0 HEADER PROGRAM_OF_1_0 PROGRAM

The header still has all declarations of 1.0: members and numbers are only appended. Examples/contour.c, compiled with
each of them, writes the same file.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np


def declarations(header):
    """The declarations of a header: functions and types by their text, the members of these in their order."""
    text = re.sub(r"/\*.*?\*/|^\s*#.*?$", "", pathlib.Path(header).read_text(), flags=re.DOTALL | re.MULTILINE)
    text = " ".join(text.split()).replace('extern "C" {', "")
    types = {}
    for head, members, name in re.findall(r"((?:typedef )?(?:struct|enum)[ \w]*?) ?\{ ([^}]*)\}([ \w]*);", text):
        separator = "," if "enum" in head else ";"
        listed = [" ".join(member.split()) for member in members.split(separator) if member.strip()]
        types[name.strip() or listed[0]] = listed
    rest = re.sub(r"\{[^}]*\}", "", text)
    return {" ".join(line.split()) for line in rest.split(";")}, types


old, new, *programs = sys.argv[1:]
(old_lines, old_types), (new_lines, new_types) = declarations(old), declarations(new)
if len(old_lines) < 30 or len(old_types) < 10:
    sys.exit(f"failed: only {len(old_lines)} declarations and {len(old_types)} types found in {old}")
if not old_lines <= new_lines:
    sys.exit(f"failed: no longer declared as in version 1.0: {sorted(old_lines - new_lines)}")
growing = ("isopoint_options", "isopoint_probe_options")
for name, members in old_types.items():
    present = new_types.get(name, [])
    may_grow = name in growing or members[0].startswith("ISOPOINT_")
    if present[:len(members)] != members or (present != members and not may_grow):
        sys.exit(f"failed: {name} is {present}, but was {members} in version 1.0")

positions = np.random.default_rng(1).random((3000, 3)).astype(np.float32)
with tempfile.TemporaryDirectory() as folder:
    np.column_stack([positions, np.linalg.norm(positions, axis=1)]).astype(np.float32).tofile(folder + "/samples")
    written = []
    for program in programs:
        subprocess.run([program, folder + "/samples", "0.8", folder + "/surface.ply"], check=True)
        written.append(pathlib.Path(folder, "surface.ply").read_bytes())
if len(written) != 2 or len(written[0]) < 10000 or written[0] != written[1]:
    sys.exit("failed: the programs write different surfaces")
