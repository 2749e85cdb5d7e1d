# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests share that are scripts: check() ends them, run() calls their functions."""

import sys


def check(condition, message):
    if not condition:
        sys.exit("failed: " + message)


def run(*tests):
    for test in tests:
        print(test.__name__, flush=True)
        test()
    print("passed")
