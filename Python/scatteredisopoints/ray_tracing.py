# SPDX-License-Identifier: GPL-3.0-or-later
"""Ray-traced pictures of views in one call: see ray_trace()."""

from __future__ import annotations

import os
import re
from typing import Any, Mapping, Optional, Union

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_STRING
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkRenderer

from ._options import property_name
from ._writing import file_to_write
from .vtkScatteredIsopointRayTracing import vtkIsopointRayTracer


def ray_trace(
    view: Any,
    path: Union[str, os.PathLike[str], None] = None,
    *,
    samples: int = 64,
    size: Optional[tuple[int, int]] = None,
    **options: Any,
) -> np.ndarray:
    """Traces what a view shows.

    Parameters
    ----------
    view
        A render view of ParaView, a vtkRenderWindow (its first renderer) or a vtkRenderer.
    path
        Name of a PNG file for the picture, or None.
    samples
        Paths through each pixel (SamplesPerPixel).
    size
        Width and height in pixels; None: those of the view.
    options
        Other properties of vtkIsopointRayTracer in snake case, such as `ambient_light=0.3`.
        The help of that class lists them.

    Returns
    -------
    The picture: shape (height, width, 3), of uint8, first row on top.

    Raises
    ------
    TypeError
        If the view is none of these, or an option is unknown.
    RuntimeError
        With the ray tracer's message, if it reports an error.
    OSError
        If the file cannot be written. An earlier one stays after any error.
    """
    if path is None:
        image = _traced(view, samples, size, options)
    else:
        with file_to_write(os.fspath(path)) as target:
            image = _traced(view, samples, size, options)
            writer = vtkPNGWriter()
            writer.SetFileName(target)
            writer.SetInputData(image)
            writer.Write()
            if writer.GetErrorCode():
                raise OSError(f"{path} cannot be written: is the disk full?")
    columns, rows, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, 3)
    return pixels[::-1].copy()


def _traced(view: Any, samples: int, size: Optional[tuple[int, int]], options: Mapping[str, Any]) -> vtkImageData:
    tracer = vtkIsopointRayTracer()
    tracer.SetSamplesPerPixel(samples)
    for name, value in options.items():
        method = "Set" + property_name(name)
        if not hasattr(tracer, method):
            raise TypeError(f"unknown option {name}")
        getattr(tracer, method)(value)
    messages: list[str] = []

    def note(_caller, _event, text):
        messages.append(re.sub(r"^ERROR:[^\n]*\n[^\n]*?\): ", "", text).strip())

    note.CallDataType = VTK_STRING
    tracer.AddObserver("ErrorEvent", note)
    image = vtkImageData()
    if not tracer.RenderToImage(_renderer_of(view), *(size or (0, 0)), image):
        raise RuntimeError("\n".join(messages) or "aborted")
    return image


def _renderer_of(view: Any) -> vtkRenderer:
    if isinstance(view, vtkRenderer):
        return view
    if hasattr(view, "StillRender"):  # a ParaView view
        view.StillRender()
        return view.GetRenderer()
    if hasattr(view, "GetRenderers") and view.GetRenderers().GetFirstRenderer():
        return view.GetRenderers().GetFirstRenderer()
    raise TypeError(f"{view!r} is no render view, window with a renderer, or renderer")
