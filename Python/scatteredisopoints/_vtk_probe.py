# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters in Python that interpolate samples at places: see the compiled classes of these names."""

from __future__ import annotations

import math
from typing import Any, Collection, Sequence

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import VTK_CHAR, vtkDataArray, vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkBoundingBox, vtkCellArray, vtkCompositeDataSet, vtkDataObject, vtkImageData, vtkPolyData)
from vtkmodules.vtkCommonExecutionModel import (
    vtkAlgorithm, vtkExtentTranslator, vtkStreamingDemandDrivenPipeline)

from . import _datasets, _library
from ._arrays import as_numpy, positions_of, readable
from ._ghosts import hide_points
from ._lines_and_grids import line_between
from ._options import CONSTANTS, make_probe_options
from ._polydata import as_vtk
from ._progress import part
from ._samples import Samples
from ._shared_arrays import DOUBLE, SharedArray, shared_arrays
from ._vtk_algorithm import LOADED, NearestArrays, ScatteredAlgorithm, describe_left_out, fill, with_properties

PACKAGE = "vtkmodules"
MASK_POINTS, NULL_VALUE, CLOSEST_POINT = range(3)
LINE_LENGTH = "arc_length"
MOST_POINTS = 1e11  # of images, whose positions take terabytes
TOO_MANY_POINTS = ("The image has too many points for any memory. Reduce the sampling dimensions, or increase the"
                   " spacing.")


class Probing(ScatteredAlgorithm):
    """What the filters share that interpolate."""

    def _probe(self, samples: Samples, places: np.ndarray, numbers: dict[str, np.ndarray], outside: Any,
               with_gradients: bool, nearest: Collection[str] = ()) -> tuple[dict, dict, np.ndarray]:
        """Values, gradients, and kinds of places."""
        options = make_probe_options(self._values["Interpolation"], outside)
        with samples._in_call(None):
            return samples._probed(
                places, numbers, options, with_gradients, part(self._advance, LOADED, 1.0), nearest=nearest)

    def _describe_flat(self, kinds: np.ndarray, consequence: str, warns_of_all: bool = False
                       ) -> list[_library.Message]:
        flat = np.count_nonzero(kinds & _library.PLACE_FLAT)
        return [] if flat == 0 else [_library.Message(
            f"At {flat} of {len(kinds)} points the samples around are in a plane or on a line: {consequence}",
            is_warning=warns_of_all and flat == len(kinds), cause="flat")]


@with_properties("ScatteredProbe")
class vtkScatteredProbeFilter(NearestArrays, Probing):
    """Interpolates scattered samples at the points of any data set: see the compiled class of this name."""

    SAMPLES_PORT = 1
    MASK_POINTS, NULL_VALUE, CLOSEST_POINT = MASK_POINTS, NULL_VALUE, CLOSEST_POINT

    def SetSourceData(self, source: Any) -> None:
        self.SetInputData(self.SAMPLES_PORT, source)

    def GetSource(self) -> Any:
        return self.GetInput(self.SAMPLES_PORT)

    def SetSourceConnection(self, output: Any) -> None:
        self.SetInputConnection(self.SAMPLES_PORT, output)

    def _output_class(self, data: Any) -> type:
        return type(data.NewInstance())  # not a class of another package, derived in Python

    def RequestInformation(self, _request, inputs, outputs):
        source = inputs[self.SAMPLES_PORT].GetInformationObject(0)
        if source.Has(vtkStreamingDemandDrivenPipeline.TIME_STEPS()):
            for key in (vtkStreamingDemandDrivenPipeline.TIME_STEPS(), vtkStreamingDemandDrivenPipeline.TIME_RANGE()):
                outputs.GetInformationObject(0).CopyEntry(source, key)
        return 1

    def _own_arrays(self) -> set[str]:
        """The names of the arrays that the filter makes itself. Those of samples do not replace them."""
        return ({self._values["ValidPointsMaskArrayName"]} if self._values["NullPointsStrategy"] == MASK_POINTS
                else set())

    def _chosen_arrays(self) -> set[str]:
        """The names of the arrays to interpolate. Empty: all."""
        return set()

    def _make_places(self, samples: Samples, output: Any) -> None:
        """Gives the output its points, and the arrays that it has besides interpolated ones."""
        places = self.GetInput()
        if not isinstance(output, vtkCompositeDataSet):
            self._pass(places, output)
            return

        def passed(block: Any, _number: int) -> Any:
            made = block.NewInstance()
            self._pass(block, made)
            return made

        fill(output, places, passed)
        if self._values["PassFieldArrays"]:
            output.GetFieldData().PassData(places.GetFieldData())

    def _pass(self, places: Any, output: Any) -> None:
        output.CopyStructure(places)
        for name, attributes, to in (("PassPointArrays", places.GetPointData(), output.GetPointData()),
                                     ("PassCellArrays", places.GetCellData(), output.GetCellData())):
            if self._values[name]:
                to.PassData(attributes)
            elif attributes.HasArray("vtkGhostType"):
                to.AddArray(attributes.GetArray("vtkGhostType"))
        if self._values["PassFieldArrays"]:
            output.GetFieldData().PassData(places.GetFieldData())

    def _compute(self, data: Any, output: Any) -> list[_library.Message]:
        samples = self._all_samples(data, with_arrays=False)
        self._count_samples(samples)
        self._make_places(samples, output)
        arrays, left_out = shared_arrays(data, self._kept[0][2])
        has_arrays, chosen = len(arrays) > 0, self._chosen_arrays()
        if chosen:
            arrays = {name: array for name, array in arrays.items() if name in chosen}
            left_out = [name for name in left_out if name in chosen]
            if not arrays:
                raise ValueError("The samples have none of the chosen arrays. Choose others.")
        own = self._own_arrays() & arrays.keys()
        arrays = {name: array for name, array in arrays.items() if name not in own}
        blocks = [block for block in _datasets.leaves(output) if block.IsA("vtkDataSet")]
        places = [positions_of(as_numpy(_datasets.point_positions(block))) for block in blocks]
        are_all = self._values["Interpolation"] == CONSTANTS["method"]["nearest"]
        nearest = {name for name, array in arrays.items() if are_all or array.has_ids or name in self._nearest}
        numbers = {name: readable(name, array.numbers.astype(np.float64) if array.data_type == DOUBLE
                                  and name in nearest else array.numbers) for name, array in arrays.items()}
        strategy = self._values["NullPointsStrategy"]
        outside = {NULL_VALUE: self._values["NullValue"], CLOSEST_POINT: "nearest"}.get(strategy, math.nan)
        values, _, kinds = self._probe(
            samples, np.concatenate(places) if places else np.empty((0, 3)), numbers, outside, False, nearest)
        are_null = (kinds & _library.PLACE_OUTSIDE) != 0
        self._add(blocks, {name: (array, values[name], array.data_type if name in nearest else DOUBLE)
                           for name, array in arrays.items()}, are_null)
        is_lost = self._values["MarkBlankPointsAndCells"] or strategy != CLOSEST_POINT
        skipped = self._describe_skipped(samples, "There are no values. Connect samples with finite positions.",
                                         "Values there are those of the samples around.")
        if self._counts["SkippedSamples"] == self._counts["Samples"]:
            is_lost = False
            skipped = skipped or [_library.Message(
                "All samples are excluded. Include some.", is_warning=True, cause="no samples")]
        return [*skipped, *_describe_lacking(has_arrays or len(left_out) > 0, are_null if is_lost else are_null[:0]),
                *self._describe_flat(kinds, "values are those at the nearest point of it."),
                *describe_left_out(own, "The output has an array of its own with this name. Rename that of the"
                                   " samples."),
                *describe_left_out(left_out, "Only arrays of numbers are kept that all blocks have, with the same"
                                   " components.")]

    def _add(self, blocks: list[Any], results: dict[str, tuple[SharedArray, np.ndarray, int]], are_null: np.ndarray
             ) -> None:
        """Adds results of a type, for all points of all blocks, and the marks of null points."""
        first = 0
        for block in blocks:
            here = slice(first, first + block.GetNumberOfPoints())
            attributes = block.GetPointData()
            for name, (array, values, data_type) in results.items():
                added = _typed(name, values[here], data_type)
                added.CopyComponentNames(array.first)
                index = attributes.AddArray(added)
                if array.use >= 0:
                    attributes.SetActiveAttribute(index, array.use)
            if self._values["NullPointsStrategy"] == MASK_POINTS:
                attributes.AddArray(_typed(self._values["ValidPointsMaskArrayName"], ~are_null[here], VTK_CHAR))
            if self._values["MarkBlankPointsAndCells"]:
                hide_points(block, are_null[here])
            first = here.stop


def _typed(name: str, numbers: np.ndarray, data_type: int) -> Any:
    """An array of exactly this type."""
    array = as_vtk(PACKAGE, name, numbers.view(np.uint8) if numbers.dtype == bool else numbers)
    if array.GetDataType() == data_type:
        return array
    converted = vtkDataArray.CreateDataArray(data_type)
    converted.DeepCopy(array)
    converted.SetName(name)  # bits lose it
    return converted


def _describe_lacking(has_arrays: bool, are_null: np.ndarray) -> list[_library.Message]:
    """Messages about values that are missing everywhere."""
    messages = []
    if not has_arrays:
        messages.append(_library.Message(
            "The samples have no arrays, nor has the output. Load arrays in the reader.", is_warning=True,
            cause="no arrays"))
    if len(are_null) and are_null.all():
        messages.append(_library.Message(
            f"All {len(are_null)} points are outside of the samples, where there are no values. Move them among the"
            " samples.", is_warning=True, cause="all outside"))
    return messages


for _name, _number in CONSTANTS["method"].items():
    setattr(vtkScatteredProbeFilter, _name.upper(), _number)


@with_properties("ScatteredLine")
class vtkScatteredLineFilter(vtkScatteredProbeFilter):
    """Interpolates scattered samples along a line: see the compiled class of this name."""

    SAMPLES_PORT = 0

    def _output_class(self, data: Any) -> type:
        return vtkPolyData

    def RequestInformation(self, _request, _inputs, outputs):
        outputs.GetInformationObject(0).Set(vtkAlgorithm.CAN_HANDLE_PIECE_REQUEST(), 1)
        return 1

    def _own_arrays(self) -> set[str]:
        return {*super()._own_arrays(), LINE_LENGTH}

    def _make_places(self, samples: Samples, output: Any) -> None:
        begin, end = (np.array(self._values[name]) for name in ("Point1", "Point2"))
        if not np.isfinite([begin, end]).all():
            raise ValueError("The ends of the line are not finite. Set finite numbers.")
        if self.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.UPDATE_PIECE_NUMBER()) > 0:
            return
        positions, distances = line_between(begin, end, self._values["Resolution"])
        count, points, lines = len(positions), vtkPoints(), vtkCellArray()
        points.SetData(as_vtk(PACKAGE, "Points", positions))
        # NumPy 1 makes 32-bit integers on Windows.
        lines.SetData(*(numpy_to_vtkIdTypeArray(np.asarray(ids, np.int64), deep=True)
                        for ids in ([0, count], np.arange(count))))
        output.SetPoints(points)
        output.SetLines(lines)
        output.GetPointData().AddArray(as_vtk(PACKAGE, LINE_LENGTH, distances))


@with_properties("ScatteredGrid")
class vtkScatteredGridFilter(vtkScatteredProbeFilter):
    """Interpolates scattered samples at the points of an image: see the compiled class of this name."""

    SAMPLES_PORT = 0

    def _output_class(self, data: Any) -> type:
        return vtkImageData

    def __init__(self):
        super().__init__()
        self._chosen: set[str] = set()
        self._is_guess_of_data = False
        self._last: Any = None  # the key and the extent of the last whole image

    def AddArray(self, name: str) -> None:
        if name not in self._chosen:
            self._chosen.add(name)
            self.Modified()

    def ClearArrays(self) -> None:
        if self._chosen:
            self._chosen.clear()
            self.Modified()

    def _chosen_arrays(self) -> set[str]:
        return self._chosen

    def RequestInformation(self, request, inputs, outputs):
        super().RequestInformation(request, inputs, outputs)
        info = outputs.GetInformationObject(0)
        info.Set(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT(), self._guess_extent(), 6)
        info.Set(vtkAlgorithm.CAN_PRODUCE_SUB_EXTENT(), 1)
        for key in (vtkDataObject.ORIGIN(), vtkDataObject.SPACING(), vtkDataObject.DIRECTION()):
            info.Remove(key)  # those of samples that are an image
        return 1

    def _guess_extent(self) -> list[int]:
        """The extent is known when the samples are. Until then it is that of the last update if nothing changed, or
        follows from bounds of the present data. _make_places() corrects it."""
        data = self.GetInput()
        if data is not None and self._last and self._last[0] == self._grid_key():
            return self._last[1]
        box = vtkBoundingBox(self._values["SamplingBounds"])
        if self._values["UseInputBounds"]:
            box.Reset()
            for leaf in _datasets.leaves(data) if data is not None else ():
                if leaf.IsA("vtkDataSet") and leaf.GetNumberOfPoints() > 0:
                    box.AddBounds(leaf.GetBounds())
        bounds = [0.0, 1.0, 0.0, 1.0, 0.0, 1.0]
        self._is_guess_of_data = bool(box.IsValid())
        if self._is_guess_of_data:
            box.GetBounds(bounds)
        try:
            return _grid_in(bounds, self._values["SamplingDimensions"], self._values["Spacing"])[0]
        except ValueError:
            return [0] * 6  # the update reports the error

    def _grid_key(self) -> tuple:
        """What the whole image depends on."""
        values = self._values
        return (self.GetInput().GetMTime(), values["SamplingDimensions"], values["Spacing"], values["UseInputBounds"],
                not values["UseInputBounds"] and values["SamplingBounds"])

    def _make_places(self, samples: Samples, output: Any) -> None:
        pipeline, info = vtkStreamingDemandDrivenPipeline, self.GetOutputInformation(0)
        bounds = _bounds_of(samples) if self._values["UseInputBounds"] else self._values["SamplingBounds"]
        whole, origin, spacing = _grid_in(bounds, self._values["SamplingDimensions"], self._values["Spacing"])
        announced, extent = (list(info.Get(key)) for key in (pipeline.WHOLE_EXTENT(), pipeline.UPDATE_EXTENT()))
        for axis in range(3) if self._is_guess_of_data else ():
            # Filters downstream do not hear of another extent, as of samples that move or are hidden.
            steps, needed = announced[2 * axis + 1], whole[2 * axis + 1]
            if self._values["SamplingDimensions"][axis] > 0 or steps <= 0 or needed <= 0:
                continue
            if self._values["Spacing"][axis] == 0.0:
                whole[2 * axis + 1] = steps
                spacing[axis] = (bounds[2 * axis + 1] - bounds[2 * axis]) / steps
            else:
                whole[2 * axis + 1] = max(needed, steps)
        self._last = self._grid_key(), whole
        if announced != whole:
            pieces = info.Get(pipeline.UPDATE_NUMBER_OF_PIECES())
            if pieces > 1:
                translator = vtkExtentTranslator()
                translator.PieceToExtentThreadSafe(
                    info.Get(pipeline.UPDATE_PIECE_NUMBER()), pieces,
                    info.Get(pipeline.UPDATE_NUMBER_OF_GHOST_LEVELS()), whole, extent, translator.BLOCK_MODE, 0)
            else:
                extent = _cut(whole, announced, extent)
            info.Set(pipeline.WHOLE_EXTENT(), whole, 6)
            info.Set(pipeline.UPDATE_EXTENT(), extent, 6)
        if math.prod(float(high - low + 1) for low, high in zip(extent[::2], extent[1::2])) > MOST_POINTS:
            raise ValueError(TOO_MANY_POINTS)
        output.GetPointData().Initialize()  # images keep the scalars of the last update
        output.SetOrigin(origin)
        output.SetSpacing(spacing)
        output.SetExtent(extent)


def _grid_in(bounds: Sequence[float], dimensions: Sequence[int], spacing: Sequence[float]
             ) -> tuple[list[int], list[float], list[float]]:
    """The extent, origin and spacing of an image that fills bounds, as the compiled filter finds them."""
    lengths = [high - low for low, high in zip(bounds[::2], bounds[1::2])]
    if not all(0.0 <= length < math.inf for length in lengths):
        raise ValueError("The sampling bounds are not three ascending pairs of numbers. Set the least and the greatest"
                         " x, y and z.")
    if min(dimensions) < 0:
        raise ValueError("A sampling dimension is negative. Set the number of points along the axis, or 0 for as many"
                         " as the spacing needs.")
    if not all(0.0 <= step < math.inf for step in spacing):
        raise ValueError("The spacing is negative or not finite. Set the distance of points along each axis, or 0 for a"
                         " 99th of the longest side.")
    extent, origins, steps = [], [], []
    for least, length, dimension, step in zip(bounds[::2], lengths, dimensions, spacing):
        step = step or max(lengths) / 99
        count = 0.0 if length == 0.0 else dimension - 1 if dimension > 0 else length / step * (1.0 - 1e-12)
        if not count < 2**31 - 1:
            raise ValueError(TOO_MANY_POINTS)
        count = math.ceil(count)
        if dimension > 0 or step == 0.0:
            step = length / count if count > 0 else 1.0
        extent += [0, count]
        origins.append(least if count > 0 else least + 0.5 * length)
        steps.append(step)
    return extent, origins, steps


def _cut(whole: list[int], announced: list[int], extent: list[int]) -> list[int]:
    """Cuts an extent that was asked for to that of the whole image. Where it ends as the announced image, it ends as
    the whole one."""
    ends = [high if last == asked else min(last, high)
            for last, asked, high in zip(extent[1::2], announced[1::2], whole[1::2])]
    if any(low > high for low, high in zip(extent[::2], ends)):
        return [0, -1, 0, -1, 0, -1]  # of no points, for any axis
    return [end for pair in zip(extent[::2], ends) for end in pair]


def _bounds_of(samples: Samples) -> list[float]:
    """The bounds of the samples in use: least and greatest x, y and z."""
    positions = as_numpy(samples._positions)
    are_used = np.isfinite(positions).all(axis=1)
    if samples._excluded is not None:
        are_used &= ~samples._excluded
    if not are_used.any():
        raise ValueError("All samples are hidden or have no finite position. Connect samples with finite positions.")
    used = positions if are_used.all() else positions[are_used]
    return [float(end) for axis in range(3) for end in (used[:, axis].min(), used[:, axis].max())]
