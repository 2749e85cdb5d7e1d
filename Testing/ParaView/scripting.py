# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scripts here share: checks, sources, filters, views and their pictures, servers."""

import contextlib
import os
import socket
import subprocess
import sys
import tempfile

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
from vtkmodules.vtkIOImage import vtkPNGReader

_temporary = tempfile.TemporaryDirectory()  # removed when the script ends
FOLDER = _temporary.name
SPLATS = "Isopoint Splats"


def check(condition, message):
    if not condition:
        sys.exit("failed: " + message)


def run(*tests):
    for test in tests:
        print(test.__name__, flush=True)
        test()
    print("passed")


def path_of(name):
    return os.path.join(FOLDER, name)


@contextlib.contextmanager
def messages():
    """Collects what is reported meanwhile, in a list."""
    usual, collecting, texts = vtkOutputWindow.GetInstance(), vtkStringOutputWindow(), []
    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkOutputWindow.SetInstance(collecting)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    try:
        yield texts
    finally:
        vtkOutputWindow.SetInstance(usual)
        vtkLogger.SetStderrVerbosity(verbosity)
        texts.append(collecting.GetOutput())


def produced(data):
    """A source of a data object."""
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source


def add_array(attributes, name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    attributes.AddArray(array)


def distance_in(source, association="Point Data", function="mag(coords)"):
    """The array "r", by default the distance from the origin."""
    return simple.Calculator(Input=source, AttributeType=association, ResultArrayName="r", Function=function)


def ball(half, radius):
    """Isopoints of a sphere in an image from -half to half."""
    return contoured(distance_in(simple.Wavelet(WholeExtent=[-half, half] * 3)), "r", radius)


def contoured(source, array, isovalue, association="POINTS", kind="ScatteredIsopoints", **properties):
    surface = getattr(simple, kind)(Input=source, ContourBy=[association, array], Isosurfaces=[isovalue], **properties)
    surface.UpdatePipeline()
    return surface


def updated(proxy):
    proxy.UpdatePipeline()
    return proxy


def number_of_points(proxy):
    return proxy.GetDataInformation().GetNumberOfPoints()


def offered_arrays(proxy):
    """The menu of arrays of a filter."""
    menu = proxy.SMProxy.GetProperty("SelectInputScalars").FindDomain("vtkSMArrayListDomain")
    return [menu.GetString(i) for i in range(menu.GetNumberOfStrings())]


def leaves_of(proxy):
    """The data objects of a source, as one or as blocks."""
    data = servermanager.Fetch(proxy)
    if not isinstance(data, vtkCompositeDataSet):
        return [data]
    iterator, found = data.NewIterator(), []
    while not iterator.IsDoneWithTraversal():
        found.append(iterator.GetCurrentDataObject())
        iterator.GoToNextItem()
    return found


def positions(proxy):
    parts = [vtk_to_numpy(leaf.GetPoints().GetData()) for leaf in leaves_of(proxy) if leaf.GetNumberOfPoints()]
    return np.concatenate([np.empty((0, 3)), *parts])


def make_view(width, height=None, background=(0.0, 0.0, 1.0)):
    """A view of one color, blue by default, where nothing is."""
    view = simple.CreateView("RenderView")
    view.ViewSize = [width, height or width]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = background
    return view


def look(view, height, scale, middle=(0.0, 0.0, 0.0)):
    """From the front, in parallel; scale is half of what is seen along an edge."""
    view.CameraParallelProjection = 1
    view.CameraPosition = [middle[0], middle[1], middle[2] + height]
    view.CameraFocalPoint = middle
    view.CameraParallelScale = scale


def shown(source, view, color=None, **properties):
    """A display of a source, not colored by an array."""
    display = simple.Show(source, view)
    for name, value in properties.items():
        setattr(display, name, value)
    display.ColorArrayName = ["POINTS", ""]
    if color:
        display.DiffuseColor = display.AmbientColor = color
    return display


def representation_of(display):
    return str(display.Representation).strip("'")


def covered(image):
    """Which pixels of a view with a blue background show something."""
    return image[..., 2] < 250


def pixels(view, path=None):
    """The picture as an array, rows from below; on the first rank only, else None."""
    path = path or path_of("view.png")
    simple.SaveScreenshot(path, view)
    return pixels_of_file(path) if os.path.exists(path) else None


def pixels_of_file(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    scalars = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return scalars.reshape(height, width, -1)[..., :3].astype(int)


def psnr(one, other):
    error = np.mean((one.astype(float) - other) ** 2)
    return 10.0 * np.log10(255.0**2 / np.maximum(error, 1e-10))


def connect_to(*server):
    """Starts a server by a command and connects to it. The server ends when this client does; if it
    ended before, the client would report an error."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    # What MPI has set in this process would keep mpiexec from starting ranks.
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_"))}
    # The client listens and the server calls, so that neither has to wait for the other.
    subprocess.Popen([*server, "--reverse-connection", "--client-host=127.0.0.1", f"--server-port={port}"],
                     env=environment)
    simple.ReverseConnect(str(port))


def load(plugin, *server):
    """Loads the plugin, also on a server that a command starts. @returns the number of its ranks"""
    if server:
        connect_to(*server)
        simple.LoadPlugin(plugin, remote=True)
    simple.LoadPlugin(plugin, remote=False)
    simple._DisableFirstRenderCameraReset()
    return servermanager.ActiveConnection.GetNumberOfDataPartitions()
