# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python package as the wheel has it: without compiled classes."""

import shutil


def python_alone(folder, library, package):
    """@returns a folder below `folder` to import a copy of the package from"""
    copy = folder / "site/scatteredisopoints"
    shutil.copytree(package, copy, ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    (copy / "_paths.py").write_text(
        "from pathlib import Path\n"
        f"LIBRARY = {library!r}\n"
        "PLUGIN = Path('nothing')\n"
        "PYTHON_PLUGIN = Path(__file__).parent / 'paraview/scattered_isopoints.py'\n")
    return folder / "site"
