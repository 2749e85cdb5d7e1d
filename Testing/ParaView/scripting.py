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
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../Python"))
import vtk_data  # noqa: E402
from checking import check, run  # noqa: E402, F401
from vtk_data import named, psnr, read_image, set_all  # noqa: E402, F401

_temporary = tempfile.TemporaryDirectory()  # removed when the script ends
FOLDER = _temporary.name
SPLATS = "Isopoint Splats"


def path_of(name):
    return os.path.join(FOLDER, name)


@contextlib.contextmanager
def messages():
    """Collects in a list what VTK reports within the block."""
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


def table_of_points(**columns):
    """Points that ParaView reads from a file of comma-separated columns, x, y and z among them."""
    path = path_of("points.csv")
    np.savetxt(path, np.column_stack(list(columns.values())), delimiter=",", header=",".join(columns), comments="")
    return simple.TableToPoints(Input=simple.CSVReader(FileName=[path]), XColumn="x", YColumn="y", ZColumn="z")


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
    """The data object of a source, or the leaves of a composite."""
    return vtk_data.leaves_of(servermanager.Fetch(proxy))


def positions(proxy):
    parts = [vtk_to_numpy(leaf.GetPoints().GetData()) for leaf in leaves_of(proxy) if leaf.GetNumberOfPoints()]
    return np.concatenate([np.empty((0, 3)), *parts])


def make_view(width, height=None, background=(0.0, 0.0, 1.0)):
    """A view with a background of one color, blue by default."""
    view = simple.CreateView("RenderView")
    view.ViewSize = [width, height or width]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = background
    return view


def look(view, height, scale, middle=(0.0, 0.0, 0.0)):
    """Looks from the front in parallel projection. The scale is half the height of what is seen."""
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
    return read_image(path) if os.path.exists(path) else None


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
