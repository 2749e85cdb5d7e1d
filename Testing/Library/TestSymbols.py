# SPDX-License-Identifier: GPL-3.0-or-later
"""The C library exports exactly the functions of its header: TestSymbols.py LIBRARY HEADER

LLVM's tools read those for Windows and macOS.
"""

import pathlib
import re
import subprocess
import sys

path, header = sys.argv[1:]
text = re.sub(r"/\*.*?\*/", "", pathlib.Path(header).read_text(), flags=re.DOTALL)
declared = set(re.findall(r"^ISOPOINT_API[^;(]*?(\w+)\(", text, re.MULTILINE))


def printed(*command):
    return subprocess.run([*command, path], stdout=subprocess.PIPE, check=True, universal_newlines=True).stdout


if path.endswith(".dll"):
    exported = set(re.findall(r"^ +Name: (\w+)$", printed("llvm-readobj", "--coff-exports"), re.MULTILINE))
elif path.endswith(".dylib"):
    exported = set(re.findall(r"^0x\S+ +_(\w+)", printed("llvm-objdump", "--macho", "--exports-trie"), re.MULTILINE))
    exported -= {"__dso_handle", "_mh_dylib_header"}  # the linker's
else:
    exported = {line.split()[-1].split("@")[0] for line in printed("nm", "--dynamic", "--defined-only").splitlines()}
    exported.discard("ISOPOINT_1.0")  # the version of the symbols
if len(declared) < 15 or exported != declared:
    sys.exit(f"failed: exported but not declared {sorted(exported - declared)}, "
             f"declared but not exported {sorted(declared - exported)}")
text = re.sub(r"typedef \w+ \(\*(\w+)\)", r"typedef \1", text)  # pointers to functions
names = re.findall(r"\b(?:typedef|enum|struct|define)\s+(?:enum\s+|struct\s+)?(\w+)", text)
foreign = [name for name in names if not re.match("isopoint_|ISOPOINT_|isopoint_h", name)
           and name not in ("enum", "struct")]
if foreign:
    sys.exit(f"failed: names of the header without the prefix {foreign}")
