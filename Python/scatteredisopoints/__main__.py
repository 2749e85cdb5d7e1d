# SPDX-License-Identifier: GPL-3.0-or-later
"""python -m scatteredisopoints: isosurfaces of files; see --help."""

import sys

from ._command_line import main

if __name__ == "__main__":
    sys.exit(main())
