# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the instructions that small cases take with a table: a guard of speed without a clock.

    Utilities/prepare.sh release InstructionsBenchmark
    python3 Benchmark/instructions.py [--program FILE] [--write]

Runs each case of InstructionsBenchmark under Valgrind's Callgrind, and natively to compare results. Instructions
of system libraries do not count: they depend on the processor. Fails if a case takes more than 3 % more
instructions than instructions.txt says, 3 % fewer (then the table is out of date), or if the table is of other
compilers or libraries. --write writes the table anew: say in the commit why it changed.
"""

import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

FOLDER = pathlib.Path(__file__).resolve().parent
TABLE = FOLDER / "instructions.txt"
TOLERANCE = 0.03


def versions():
    """The compiler and the libraries whose code is compiled into ours."""
    def output(*command):
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout

    packages = output("dpkg-query", "--show", "--showformat=${Package} ${Version}, ", "libeigen3-dev", "libcgal-dev")
    return f"{output('c++', '--version').splitlines()[0]}; {packages.rstrip(', ')}"


def instructions_of(profile):
    """The instructions in our program and library, from the lines of a file of Callgrind."""
    total, counts, is_inclusive = 0, False, False
    for line in profile:
        if line.startswith("ob="):
            counts = "InstructionsBenchmark" in line or "libisopoint" in line
        elif line.startswith("calls="):
            is_inclusive = True  # the next line is the cost of a call
        elif re.match(r"[+\-*\d]", line):
            if counts and not is_inclusive:
                total += int(line.split()[1])
            is_inclusive = False
    return total


def run(program, case):
    """@returns the instructions of a case"""
    native = subprocess.run([program, case], check=True, capture_output=True, text=True).stdout
    with tempfile.TemporaryDirectory() as folder:
        profile = pathlib.Path(folder) / "profile"
        counted = subprocess.run(
            ["valgrind", "--tool=callgrind", "--collect-atstart=no", "--compress-strings=no", "--quiet",
             f"--callgrind-out-file={profile}", program, case], check=True, capture_output=True, text=True).stdout
        if counted != native:
            raise SystemExit(f"{case}: results under Valgrind differ: choose samples with exact predicates")
        with open(profile, encoding="utf-8") as lines:
            return instructions_of(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=FOLDER.parent / "build/release/bin/InstructionsBenchmark",
                        help="default: that of build/release")
    parser.add_argument("--write", action="store_true", help="write the table anew")
    arguments = parser.parse_args()
    cases = subprocess.run([arguments.program], check=False, capture_output=True, text=True).stdout.splitlines()
    header, *rows = TABLE.read_text(encoding="utf-8").splitlines() if TABLE.exists() else [""]
    known = {name: int(count.replace(",", "")) for name, count in (row.rsplit(None, 1) for row in rows)}
    found = {case: run(arguments.program, case) for case in cases}
    for case, count in found.items():
        change = f"{100 * (count / known[case] - 1):+.2f} %" if case in known else "new"
        print(f"{case:20}{count:>16,}  {change}")
    if arguments.write:
        lines = [versions(), *(f"{case:20}{count:>16,}" for case, count in found.items())]
        TABLE.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return
    if header != versions():
        sys.exit(f"The table is of {header}, this is {versions()}. Build the commit that changed the table last with"
                 " these, and write the table of both.")
    wrong = [case for case, count in found.items()
             if case not in known or abs(count / known[case] - 1) > TOLERANCE]
    if wrong or set(known) - set(found):
        sys.exit(f"Beyond {100 * TOLERANCE:g} %: {', '.join(wrong) or 'cases are gone'}. Mend it, or write the table anew"
                 " with --write and say why.")


main()
