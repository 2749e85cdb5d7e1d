# SPDX-License-Identifier: GPL-3.0-or-later
"""The filter in Python that slices samples: see the compiled class of this name."""

from __future__ import annotations

from typing import Any

from vtkmodules.vtkCommonCore import vtkWeakReference
from vtkmodules.vtkCommonDataModel import vtkPolyData

from . import _library
from ._cuts import cut_by, describe_empty, is_outermost
from ._option_types import SliceOptions
from ._options import INTERPOLATIONS, make_slice_options, property_name
from ._progress import part
from ._slices import Slice, make_slice
from ._vtk_algorithm import LOADED, ContourValues, ScatteredAlgorithm, describe_left_out, with_counts, with_properties


@with_properties("ScatteredSlice")
@with_counts
class vtkScatteredSliceFilter(ContourValues, ScatteredAlgorithm):
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
        made = make_slice(samples, cut, levels, options, samples._arrays_of(None),
                          [*INTERPOLATIONS.values()][self._values["Interpolation"]], None,
                          part(self._advance, LOADED, 1.0))
        output.ShallowCopy(made.isosurface.polydata)
        self._count_samples(samples)
        self._counts["ExtractedPoints"] = len(made.isosurface)
        return [*self._describe_skipped(samples, "There is no slice. Connect samples with finite positions.",
                                        "The slice there is that of the samples around."),
                *_describe(made, levels), *describe_left_out(
                    samples._differing, "Only arrays are kept that all blocks have, with the same components.")]


def _modifying(slice_: vtkScatteredSliceFilter) -> Any:
    """Calls Modified() of a filter while it lives, because GetMTime() cannot be overridden in Python."""
    filter_ = vtkWeakReference()
    filter_.Set(slice_)

    def modify(_caller: Any, _event: str) -> None:
        alive = filter_.Get()
        if alive is not None:
            alive.Modified()

    return modify


def _describe(made: Slice, levels: list[float]) -> list[_library.Message]:
    least, greatest = made.range
    if len(made.isosurface) == 0:
        text = describe_empty(levels, least, greatest, made.dropped,
                              "all samples are on one side of it. Move it among the samples.")
        return [] if text is None else [_library.Message(text, is_warning=True, cause="empty slice")]
    return [] if not is_outermost(levels, least, greatest) else [_library.Message(
        "The slice is only where samples are on it, as no sample is beyond it. Move it among the samples; make a box or"
        " a sphere smaller.", is_warning=False, cause="outermost slice")]
