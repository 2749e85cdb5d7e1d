# SPDX-License-Identifier: GPL-3.0-or-later
"""ParaView's plugin in Python, where the package has no compiled classes:
TestPythonPlugin.py LIBRARY PACKAGE PVBATCH COMPILED_PLUGIN

Proxies have the labels, groups, properties and defaults of the compiled plugin, and yield the same;
each plugin loads the states of the other."""

import os
import sys

from playing import FOLDER, check, python_alone, run_script

BUILD = """
from paraview.simple import *
wavelet = Wavelet(WholeExtent=[-15, 15] * 3)
wavelet.UpdatePipeline()
points = ScatteredIsopoints(registrationName="points", Input=wavelet, Isosurfaces=[180.0], DropGaps=0)
surface = ScatteredIsosurface(registrationName="surface", Input=wavelet,
                              ContourBy=["POINTS", "RTData"], Projection="Quadratic fit", Regularize=0)
ScatteredProbe(registrationName="probe", Samples=wavelet, DestinationMesh=Sphere(Radius=9), Interpolation="Cubic fit")
ScatteredLine(registrationName="line", Input=wavelet, Resolution=30)
ScatteredGrid(registrationName="grid", Input=wavelet, SamplingDimensions=[7, 8, 9])
ScatteredGradient(registrationName="gradient", Input=wavelet)
ScatteredBody(registrationName="body", Input=wavelet, MinimumPieceSize=0.1)
plane = ScatteredSlice(registrationName="slice", Input=wavelet, DropGaps=0)
plane.SliceType.Normal = [1, 2, 3]
UpdatePipeline(proxy=plane)
plane.SliceType.Origin = [0, 0, 2.5]             # after an update: the filter notices
plane.SliceType.Offset = 1.5
ball = ScatteredSlice(registrationName="ball", Input=wavelet, SliceType="Sphere", Interpolation="Linear")
ball.SliceType.Radius = 7
Show(surface)
Render()
"""

REPORT = """
from paraview.simple import *
import hashlib
from paraview import servermanager
from vtkmodules.util.numpy_support import vtk_to_numpy
for name in ("points", "surface", "probe", "line", "grid", "gradient", "slice", "ball", "body"):
    source = FindSource(name)
    source.UpdatePipeline()
    data = servermanager.Fetch(source)
    if name == "points" and data.GetNumberOfVerts():  # those in Python come with their polygons
        data = servermanager.Fetch(IsopointSplatPolygons(Input=source))
    points = data.GetPoints().GetData() if data.IsA("vtkPointSet") else None
    arrays = [data.GetPointData().GetArray(i) for i in range(data.GetPointData().GetNumberOfArrays())]
    print("found:", name, data.GetNumberOfPoints(), data.GetBounds(), *(
        hashlib.sha256(vtk_to_numpy(array)).hexdigest()[:16]
        for array in (points, *(arrays if name != "points" else ()))
        if array))
    names = [n for n in source.ListProperties() if n not in (
        "Input", "Samples", "DestinationMesh", "UseGlobalController", "AreSplatsApart")]
    print("found:", *(f"{n}={source.GetPropertyValue(n)}" for n in sorted(names) if n != "SliceType"
                      and (not n.startswith("NumberOf") or n == "NumberOfNeighbors")))
    proxy = source.SMProxy
    print("found:", proxy.GetXMLName(), proxy.GetXMLLabel(), proxy.GetDocumentation().GetDescription()[:60].strip())
    for i in range(proxy.GetNumberOfPropertyGroups()):
        group = proxy.GetPropertyGroup(i)
        if group.GetXMLLabel() != "Last Update":  # of the compiled plugin alone
            print("found:", group.GetXMLLabel(), *(
                group.GetProperty(j).GetXMLName() for j in range(group.GetNumberOfProperties())))
"""

LOAD = "from paraview.simple import *\nfrom scatteredisopoints import load_plugin\n" + 2 * "load_plugin(globals())\n"

library, package, pvbatch, compiled_plugin = sys.argv[1:]
site, plugin = python_alone(library, package)
SITES = {"compiled": os.path.dirname(package), "python": str(site)}
STATES = {name: str(FOLDER / (name + ".pvsm")) for name in SITES}


def found_by(name, text):
    """Runs a text and the report. Saves the pipeline if the text builds one, not if it loads one."""
    save = f"SaveState({STATES[name]!r})\n" if text is BUILD else ""
    found, output = run_script(pvbatch, LOAD + text + REPORT + save, PYTHONPATH=SITES[name])
    check(len(found) > 10 and "rror" not in output, output)
    return found


expected = found_by("compiled", BUILD)
for name, text in (("python", BUILD), ("python", f"LoadState({STATES['compiled']!r})\n"),
                   ("compiled", f"LoadState({STATES['python']!r})\n")):
    found = found_by(name, text)
    check(found == expected, f"different, {name}, {text}:\n" + "\n".join(expected + found))

_, output = run_script(pvbatch, (
    "from paraview.simple import *\nimport inspect\ninspect.getargspec = inspect.getfullargspec\n"
    f"LoadPlugin({compiled_plugin!r})\nLoadPlugin({plugin!r}, remote=False)\n"), PYTHONPATH=SITES["python"])
check("loaded already: the one in Python adds nothing" in output and "rror" not in output, output)
