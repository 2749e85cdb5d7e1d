# SPDX-License-Identifier: GPL-3.0-or-later
"""python -m scatteredisopoints paraview: explains how to load the filters into ParaView."""

import sys

from ._paths import PYTHON_PLUGIN

USAGE = "usage: python -m scatteredisopoints paraview"
TEXT = f"""The filters for ParaView are in

    {PYTHON_PLUGIN}

Ways to load them:

- In the window: Tools > Manage Plugins > Load New, and choose this file. Tick Auto Load.
- For all programs of ParaView: the environment variable PV_PLUGIN_PATH={PYTHON_PLUGIN.parent}
- In a script: from scatteredisopoints import load_plugin; load_plugin(globals())

A ParaView with a Python of its own, whose NumPy serves, finds the package in a folder of its own:

    pip install --no-deps --target FOLDER scatteredisopoints-*.whl

The file is then FOLDER/scatteredisopoints/paraview/{PYTHON_PLUGIN.name}; PYTHONPATH=FOLDER is for scripts.
"""


def main(arguments: list) -> int:
    if arguments != ["paraview"]:
        print(USAGE, file=sys.stderr)
        return 2
    print(TEXT, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
