# SPDX-License-Identifier: GPL-3.0-or-later
"""An example runs as it stands, and its pictures show something: TestExamples.py SCRIPT FOLDER
[ARGUMENTS], with pvbatch or the interpreter that the example is for. FOLDER receives what it writes."""

import glob
import os
import runpy
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkParallelCore import vtkMultiProcessController


def check(path):
    """The surface covers a part of the picture, in many shades."""
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    scalars = reader.GetOutput().GetPointData().GetScalars()
    pixels = vtk_to_numpy(scalars)[:, :3].astype(int)
    share = (np.abs(pixels - pixels[0]).max(axis=1) > 8).mean()
    shades = len(np.unique(pixels, axis=0))
    if not (0.02 < share < 0.95 and shades > 60):
        sys.exit(f"{path} shows a surface at {share:.3f} of it, in {shades} shades")


def main(script, folder, *arguments):
    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    name = os.path.splitext(os.path.basename(script))[0]
    pattern = name.removesuffix("_simulation") + "*.png"
    ranks = vtkMultiProcessController.GetGlobalController()
    isFirst = ranks is None or ranks.GetLocalProcessId() == 0
    if isFirst:
        for path in glob.glob(pattern):
            os.remove(path)
    sys.argv = [script, *arguments]
    runpy.run_path(script, run_name="__main__")
    pictures = glob.glob(pattern)
    if isFirst and not pictures:
        sys.exit(f"{script} wrote no picture")
    for path in pictures if isFirst else ():
        check(path)


main(*sys.argv[1:])
