# SPDX-License-Identifier: GPL-3.0-or-later
"""An example runs as it stands, and its pictures show something: TestExamples.py SCRIPT FOLDER
[ARGUMENTS], with pvbatch or the interpreter that the example is for. FOLDER receives what it writes."""

import glob
import os
import runpy
import sys

import numpy as np
from vtkmodules.vtkParallelCore import vtkMultiProcessController

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../Python"))
from vtk_data import read_image  # noqa: E402

_, script, folder, *arguments = sys.argv
os.makedirs(folder, exist_ok=True)
os.chdir(folder)
pattern = os.path.splitext(os.path.basename(script))[0].removesuffix("_simulation") + "*.png"
ranks = vtkMultiProcessController.GetGlobalController()
is_first = ranks is None or ranks.GetLocalProcessId() == 0
for path in glob.glob(pattern) if is_first else ():
    os.remove(path)
sys.argv = [script, *arguments]
runpy.run_path(script, run_name="__main__")
pictures = glob.glob(pattern) if is_first else ()
if is_first and not pictures:
    sys.exit(f"{script} wrote no picture")
for path in pictures:
    # The surface covers a part of the picture, in many shades.
    pixels = read_image(path).reshape(-1, 3)
    share = (np.abs(pixels - pixels[0]).max(axis=1) > 8).mean()
    shades = len(np.unique(pixels, axis=0))
    if not (0.02 < share < 0.95 and shades > 60):
        sys.exit(f"{path} shows a surface at {share:.3f} of it, in {shades} shades")
