# SPDX-License-Identifier: GPL-3.0-or-later
"""The filter in Python that finds the body of samples: see the compiled class of this name."""

from __future__ import annotations

from typing import Any

from vtkmodules.vtkCommonDataModel import vtkPolyData

from . import _library
from ._bodies import OPTIONS, compute_body
from ._options import property_name
from ._progress import part
from ._vtk_algorithm import LOADED, ScatteredAlgorithm, with_counts, with_properties


@with_properties("ScatteredBody")
@with_counts
class vtkScatteredBodyFilter(ScatteredAlgorithm):
    """Finds the closed surface of scattered samples: see the compiled class of this name."""

    COUNTS = ("Samples", "SkippedSamples", "ExtractedPoints")

    def _output_class(self, data: Any) -> type:
        return vtkPolyData

    def _compute(self, data: Any, output: Any) -> list[_library.Message]:
        samples = self._all_samples(data)
        options = {name: self._values[property_name(name)] for name in (*OPTIONS, "keep_tree")}
        made, messages = compute_body(samples, options, None, None, part(self._advance, LOADED, 1.0))
        return self._finish(samples, made, messages, output)
