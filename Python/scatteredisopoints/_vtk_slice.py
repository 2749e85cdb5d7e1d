# SPDX-License-Identifier: GPL-3.0-or-later
"""The filter in Python that slices samples: see the compiled class of this name."""

from __future__ import annotations

from typing import Any

from vtkmodules.vtkCommonCore import vtkWeakReference
from vtkmodules.vtkCommonDataModel import vtkPolyData

from . import _library
from ._cuts import cut_by
from ._option_types import SliceOptions
from ._options import INTERPOLATIONS, make_slice_options, property_name
from ._progress import part
from ._slices import compute_slice
from ._vtk_algorithm import (
    LOADED, ContourValues, NearestArrays, ScatteredAlgorithm, with_counts, with_properties)


@with_properties("ScatteredSlice")
@with_counts
class vtkScatteredSliceFilter(NearestArrays, ContourValues, ScatteredAlgorithm):
    """Slices scattered samples by an implicit function: see the compiled class of this name."""

    COUNTS = ("Samples", "SkippedSamples", "ExtractedPoints")
    FITS, LINEAR, NEAREST = range(3)

    def __init__(self):
        super().__init__()
        self._function: Any = None
        self._observer = 0

    def SetCutFunction(self, function: Any) -> None:
        if function is self._function:
            return
        if self._function is not None:
            self._function.RemoveObserver(self._observer)
        self._function = function
        if function is not None:
            self._observer = function.AddObserver("ModifiedEvent", _modifying(self))
        self.Modified()

    def GetCutFunction(self) -> Any:
        return self._function

    def _output_class(self, data: Any) -> type:
        return vtkPolyData

    def _compute(self, data: Any, output: Any) -> list[_library.Message]:
        if self._function is None:
            raise ValueError("There is no cut function. Set a plane or another one.")
        samples = self._all_samples(data)
        cut, level = cut_by(self._function)
        levels = [level + value for value in self.GetValues()]
        options = make_slice_options({name: self._values[property_name(name)] for name in SliceOptions.__annotations__})
        options.keep_tetrahedra = self._values["KeepTree"]
        made, messages = compute_slice(
            samples, cut, levels, options, None, [*INTERPOLATIONS.values()][self._values["Interpolation"]], None,
            part(self._advance, LOADED, 1.0), [name for name in self._nearest if name in (samples._arrays or {})])
        return self._finish(samples, made, messages, output)


def _modifying(slice_: vtkScatteredSliceFilter) -> Any:
    """Calls Modified() of a filter while it lives, because GetMTime() cannot be overridden in Python."""
    filter_ = vtkWeakReference()
    filter_.Set(slice_)

    def modify(_caller: Any, _event: str) -> None:
        alive = filter_.Get()
        if alive is not None:
            alive.Modified()

    return modify
