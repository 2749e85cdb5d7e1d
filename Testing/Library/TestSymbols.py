# SPDX-License-Identifier: GPL-3.0-or-later
"""The C library exports exactly the functions of its header: TestSymbols.py LIBRARY HEADER"""

import pathlib
import re
import subprocess
import sys

path, header = sys.argv[1:]
text = re.sub(r"/\*.*?\*/", "", pathlib.Path(header).read_text(), flags=re.DOTALL)
declared = set(re.findall(r"^ISOPOINT_API[^;(]*?(\w+)\(", text, re.MULTILINE))
listed = subprocess.run(["nm", "--dynamic", "--defined-only", path], stdout=subprocess.PIPE, check=True,
                        universal_newlines=True).stdout
exported = {line.split()[-1].split("@")[0] for line in listed.splitlines()}
exported.discard("ISOPOINT_1")  # the version of the symbols
if len(declared) < 15 or exported != declared:
    sys.exit(f"failed: exported but not declared {sorted(exported - declared)}, "
             f"declared but not exported {sorted(declared - exported)}")
names = re.findall(r"\b(?:typedef|enum|struct|define)\s+(?:enum\s+|struct\s+)?(\w+)", text)
foreign = [name for name in names if not re.match("isopoint_|ISOPOINT_|isopoint_h", name)
           and name not in ("enum", "struct")]
if foreign:
    sys.exit(f"failed: names of the header without the prefix {foreign}")
