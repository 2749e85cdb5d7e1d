# SPDX-License-Identifier: GPL-3.0-or-later
"""ParaView's plugin in Python, where the package has no compiled classes:
TestPythonPlugin.py LIBRARY PACKAGE PVBATCH COMPILED_PLUGIN

Proxies have the labels, groups, properties and defaults of the compiled plugin, and yield the same;
each plugin loads the states of the other."""

import os
import pathlib
import subprocess
import sys
import tempfile

from python_site import python_alone

BUILD = """
from paraview.simple import *
wavelet = Wavelet(WholeExtent=[-15, 15] * 3)
wavelet.UpdatePipeline()
points = ScatteredIsopoints(registrationName="points", Input=wavelet, Isosurfaces=[180.0], DropGaps=0)
surface = ScatteredIsosurface(registrationName="surface", Input=wavelet,
                              ContourBy=["POINTS", "RTData"], Projection="Quadratic fit", Regularize=0)
Show(surface)
Render()
"""

REPORT = """
from paraview.simple import *
import hashlib
from paraview import servermanager
from vtkmodules.util.numpy_support import vtk_to_numpy
for name, kind in (("points", "ScatteredIsopoints"), ("surface", "ScatteredIsosurface")):
    source = FindSource(name)
    source.UpdatePipeline()
    data = servermanager.Fetch(source)
    if data.GetNumberOfVerts():  # points in Python come with their polygons
        data = servermanager.Fetch(IsopointSplatPolygons(Input=source))
    print("found:", name, hashlib.sha256(vtk_to_numpy(data.GetPoints().GetData())).hexdigest())
    names = [n for n in source.ListProperties() if n not in ("Input", "UseGlobalController")]
    print("found:", *(f"{n}={source.GetPropertyValue(n)}" for n in sorted(names)
                      if not n.startswith("NumberOf") or n == "NumberOfNeighbors"))
    proxy = source.SMProxy
    print("found:", proxy.GetXMLName(), proxy.GetXMLLabel(),
          proxy.GetDocumentation().GetDescription()[:60].strip())
    for i in range(proxy.GetNumberOfPropertyGroups()):
        group = proxy.GetPropertyGroup(i)
        if group.GetXMLLabel() == "Last Update":  # of the compiled plugin alone
            continue
        print("found:", group.GetXMLLabel(), *(
            group.GetProperty(j).GetXMLName() for j in range(group.GetNumberOfProperties())))
"""

LOAD = """
from paraview.simple import *
from scatteredisopoints import load_plugin
load_plugin(globals())
load_plugin(globals())
"""


def check(condition, message):
    if not condition:
        sys.exit("failed: " + message)


class Installation:
    """A package that scripts load the plugin from."""

    def __init__(self, path, pvbatch):
        self.path, self.pvbatch = path, pvbatch

    def run(self, text, folder):
        script = folder / "script.py"
        script.write_text(text)
        environment = dict(os.environ, PYTHONPATH=str(self.path))
        done = subprocess.run([self.pvbatch, str(script)], env=environment, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        found = [line for line in done.stdout.splitlines() if line.startswith("found:")]
        check(done.returncode == 0 and "rror" not in done.stdout and "Traceback" not in done.stdout,
              text + done.stdout)
        return found, done.stdout


def main(library, package, pvbatch, compiled_plugin):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        compiled = Installation(pathlib.Path(package).parent, pvbatch)
        python = Installation(python_alone(folder, library, package), pvbatch)
        expected = None
        for installation in (compiled, python):
            state = folder / f"{'compiled' if installation is compiled else 'python'}.pvsm"
            found, _ = installation.run(LOAD + BUILD + REPORT + f"SaveState({str(state)!r})\n", folder)
            check(len(found) > 10, "\n".join(found))
            check(expected in (None, found), "different:\n" + "\n".join((expected or []) + found))
            expected = found
        for installation, state in ((compiled, "python.pvsm"), (python, "compiled.pvsm")):
            found, _ = installation.run(LOAD + f"LoadState({str(folder / state)!r})\n" + REPORT, folder)
            check(found == expected, f"{state}:\n" + "\n".join(expected + found))

        plugin = str(folder / "site/scatteredisopoints/paraview/scattered_isopoints.py")
        _, text = python.run(
            LOAD.split("from scatteredisopoints")[0] + "import inspect\n"
            "inspect.getargspec = inspect.getfullargspec\n"
            f"LoadPlugin({compiled_plugin!r})\nLoadPlugin({plugin!r}, remote=False)\n", folder)
        check("is loaded already: the one in Python adds nothing" in text, text)


if __name__ == "__main__":
    main(*sys.argv[1:])
