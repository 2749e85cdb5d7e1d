# SPDX-License-Identifier: GPL-3.0-or-later
"""An error on the last rank only: TestErrors.py [PVSERVER...]. The output of the test must contain it,
also if that rank is not the one that runs the script."""

import sys

from paraview import simple
from scripting import connect_to

SCRIPT = """
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from vtkmodules.vtkIOLegacy import vtkPolyDataReader

ranks = vtkMultiProcessController.GetGlobalController()
if ranks.GetLocalProcessId() == ranks.GetNumberOfProcesses() - 1:
    vtkPolyDataReader().Update()  # of no file
"""

if len(sys.argv) > 1:
    connect_to(*sys.argv[1:])
simple.ProgrammableSource(Script=SCRIPT).UpdatePipeline()
