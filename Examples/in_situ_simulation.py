# SPDX-License-Identifier: GPL-3.0-or-later
"""A simulation of particles that runs the Catalyst pipeline of in_situ_pipeline.py each step:
pvbatch in_situ_simulation.py, or mpirun -n 4 pvbatch --symmetric in_situ_simulation.py

Needs the compiled plugin, loaded by PV_PLUGIN_PATH or the Debian package."""

import os

import numpy as np
from paraview.catalyst import bridge
from vtkmodules.numpy_interface import dataset_adapter
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkParallelCore import vtkMultiProcessController

ranks = vtkMultiProcessController.GetGlobalController()
random = np.random.default_rng(ranks.GetLocalProcessId())
positions = random.random((40000 // ranks.GetNumberOfProcesses(), 3))

bridge.initialize()
bridge.add_pipeline(os.path.join(os.path.dirname(__file__), "in_situ_pipeline.py"))
for step in range(3):
    positions += 0.02 * np.sin(6 * positions[:, [1, 2, 0]] + step)  # the particles flow
    blobs = [np.linalg.norm(positions - [0.5 + shift, 0.5, 0.5], axis=1) for shift in (-0.2, 0.2)]
    density = sum(np.exp(-((blob / (0.14 + 0.03 * step)) ** 2)) for blob in blobs)

    particles = dataset_adapter.WrapDataObject(vtkPolyData())
    particles.VTKObject.SetPoints(vtkPoints())
    particles.Points = positions
    particles.PointData.append(density, "density")
    bridge.coprocess(float(step), step, particles.VTKObject, name="particles")
bridge.finalize()
