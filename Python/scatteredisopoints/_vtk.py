# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters in Python, on the C library, for versions of VTK without the compiled classes.

Methods, constants, defaults, ranges, output arrays and messages are those of the compiled classes, which
document them. docs/python.md in the source lists the differences.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, Optional

from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet, vtkMultiBlockDataSet, vtkPartitionedDataSetCollection, vtkPolyData)

from . import _datasets, _library
from ._options import CONSTANTS, option_names, property_name
from ._samples import Extracted
from ._splats import NoNormalsError, polygons_of
from ._vtk_algorithm import (
    Algorithm, ContourValues, ScatteredAlgorithm, fill, in_properties, with_counts, with_properties)
from ._vtk_body import vtkScatteredBodyFilter as vtkScatteredBodyFilter
from ._vtk_gradient import vtkScatteredGradientFilter as vtkScatteredGradientFilter
from ._vtk_probe import vtkScatteredGridFilter as vtkScatteredGridFilter
from ._vtk_probe import vtkScatteredLineFilter as vtkScatteredLineFilter
from ._vtk_probe import vtkScatteredProbeFilter as vtkScatteredProbeFilter
from ._vtk_slice import vtkScatteredSliceFilter as vtkScatteredSliceFilter


@with_counts
class _Contour(ContourValues, ScatteredAlgorithm):
    """vtkScatteredContourFilter in Python."""

    COUNTS = ("Samples", "ExtractedPoints", "SkippedSamples", "UnprojectedPoints", "DroppedInGaps")

    _triangles = False
    _has_polygons = False  # whether the output has the points' polygons
    _with_surface: Any = None  # the samples that had one in an earlier update

    def _output_class(self, data: Any) -> type:
        if not (self._values["ContourBlocks"] and isinstance(data, vtkCompositeDataSet)):
            return vtkPolyData
        return vtkMultiBlockDataSet if data.IsA("vtkUniformGridAMR") else type(data)

    def _compute(self, data: Any, output: Any) -> list[_library.Message]:
        samples = self._array_choice(), _datasets.state_of(data)
        messages = (self._contour_blocks(data, output) if isinstance(output, vtkCompositeDataSet) else
                    self._contour_all(data, output))
        if self._with_surface == samples:  # animations begin and end where surfaces do
            messages = [replace(message, is_warning=False) if message.code == _library.ISOVALUE_AT_END else message
                        for message in messages]
        if self._counts["ExtractedPoints"] > 0:
            self._with_surface = samples
        return messages

    def _contour_all(self, data: Any, output: Any) -> list[_library.Message]:
        self._kept = {0: self._kept[0]} if 0 in self._kept else {}
        extracted = self._contour_one(data, 0, (0.0, 1.0))
        output.ShallowCopy(extracted.isosurface._into_polydata())
        return extracted.messages

    def _contour_blocks(self, data: Any, output: Any) -> list[_library.Message]:
        """Contours each block. Returns the messages about all."""
        count = sum(1 for _ in _datasets.leaves(data))
        found: dict[int, Extracted] = {}  # by block number
        lacking: list[_datasets.NoSamplesError] = []

        def contour(block: Any, number: int) -> Optional[vtkPolyData]:
            try:
                found[number] = self._contour_one(block, number, (number / count, (number + 1) / count))
                return found[number].isosurface._into_polydata()
            except _datasets.NoSamplesError as error:
                lacking.append(error)
                return None

        fill(output, data, contour)
        self._kept = {number: self._kept[number] for number in found}
        lacking.sort(key=lambda error: error.without_array == 0)  # those that name arrays come first
        if not found:
            raise lacking[0] if lacking else _datasets.NoSamplesError()
        first, *others = found.values()
        for other in others:
            _library.run(_library.join_messages, first.surface, other.surface)
        messages = first.messages + [message for other in others for message in other.own_messages]
        without_array = sum(error.without_array for error in lacking)
        if without_array:
            self._counts["Samples"] += without_array
            self._counts["SkippedSamples"] += without_array
            messages.append(_datasets.describe_without_array(without_array, self._array_choice()[0] or ""))
        return messages

    def _contour_one(self, data: Any, number: int, part: tuple[float, float]) -> Extracted:
        begin, end = part
        half = 0.5 * (begin + end)
        choice = self._array_choice()
        samples = self._loaded(
            data, number, choice, lambda: _datasets.samples_with_values(data, *choice), (begin, half))
        options = {option: self._values[property_name(option)] for option in option_names(self._triangles)}
        extracted: Extracted = samples._extract(
            self.GetValues(), self._triangles, None, options, **self._callbacks((half, end)))
        surface = extracted.surface
        for name, count in zip(self.COUNTS, (
                len(samples) + samples._without_array, len(extracted.isosurface),
                samples.skipped + samples._without_array, _library.get_unprojected_count(surface),
                _library.get_dropped_count(surface))):
            self._counts[name] += count
        isopoints = extracted.isosurface
        if self._has_polygons and isopoints.splat_shapes and isopoints.normals is not None:
            extracted.isosurface = isopoints._splats(is_canceled=self.GetAbortExecute)
        return extracted


@with_properties("ScatteredIsopoints")
class vtkScatteredIsopointFilter(_Contour):
    """Isosurfaces of scattered samples as points: see the compiled class of this name."""

    _are_apart = False

    def AreSplatsApart(self) -> bool:
        return self._are_apart

    def _compute(self, data: Any, output: Any) -> list[_library.Message]:
        self._are_apart = False
        messages = super()._compute(data, output)
        self._are_apart = any(message.code == _library.SPLATS_APART for message in messages)
        return messages


@with_properties("ScatteredIsosurface")
class vtkScatteredIsosurfaceFilter(_Contour):
    """Isosurfaces of scattered samples as triangles: see the compiled class of this name."""

    _triangles = True


for _name, _number in {**CONSTANTS["projection"], **CONSTANTS["normal_method"]}.items():
    setattr(_Contour, _name.upper(), _number)


@with_properties("IsopointSplatPolygons", "RadiusArrayName")
class vtkIsopointSplatPolygons(Algorithm):
    """The triangles that show points, as data: see the compiled class of this name. Points need normals."""

    def __init__(self):
        super().__init__()
        self._radius_array = "Radius"

    def SetRadiusArrayName(self, name: Optional[str]) -> None:
        if self._radius_array != name:
            self._radius_array = name
            self.Modified()

    def GetRadiusArrayName(self) -> Optional[str]:
        return self._radius_array

    def SetRadiusScale(self, scale: float) -> None:
        if scale < 0:
            self._report("WarningEvent", f"The radius scale {scale:g} is negative: nothing is drawn. Set it to 1 for"
                         " splats that close the surface.")
        self._set("RadiusScale", scale)

    def _output_class(self, data: Any) -> type:
        if not isinstance(data, vtkCompositeDataSet):
            return vtkPolyData
        # Before VTK 9.3, ParaView's geometry representation does not accept such collections.
        is_new = (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion()) >= (9, 3)
        return (vtkPartitionedDataSetCollection
                if is_new and data.IsA("vtkPartitionedDataSetCollection") else vtkMultiBlockDataSet)

    def _make(self, data: Any, output: Any) -> None:
        problems: set[str] = set()  # each once, of all blocks
        if isinstance(output, vtkPolyData):
            output.ShallowCopy(self._polygons(data, (0.0, 1.0), problems))
        else:
            self._make_blocks(data, output, problems)
        for problem in sorted(problems):
            self._report("WarningEvent", in_properties(problem))

    def _make_blocks(self, data: Any, output: Any, problems: set[str]) -> None:
        """Blocks without normals have no polygons, which is an error only if no block has normals."""
        count = sum(1 for _ in _datasets.leaves(data))
        lacking: list[bool] = []  # of each block with points

        def make(block: Any, number: int) -> vtkPolyData:
            try:
                polygons = self._polygons(block, (number / count, (number + 1) / count), problems)
                lacking.extend([False] * (block.GetNumberOfPoints() > 0))
                return polygons
            except NoNormalsError as error:
                lacking.append(True)
                problems.add(str(error))
                return _without_polygons(block)

        fill(output, data, make)
        if lacking and all(lacking):
            raise NoNormalsError

    def _polygons(self, data: Any, part: tuple[float, float], problems: set[str]) -> vtkPolyData:
        scale = self._values["RadiusScale"]
        if data.GetNumberOfPoints() == 0 or not 0 < scale < math.inf:
            return _without_polygons(data)
        polygons, problem = polygons_of(
            data, self._radius_array, self._values["Radius"], scale, **self._callbacks(part))
        if problem:
            problems.add(problem)
        return polygons


def _without_polygons(data: Any) -> vtkPolyData:
    empty = vtkPolyData()
    empty.GetFieldData().ShallowCopy(data.GetFieldData())
    return empty
