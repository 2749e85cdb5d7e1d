# SPDX-License-Identifier: GPL-3.0-or-later
"""How tests that are scripts check and run."""

import sys


def check(condition, message):
    if not condition:
        sys.exit("failed: " + message)


def run(*tests):
    for test in tests:
        print(test.__name__, flush=True)
        test()
    print("passed")
