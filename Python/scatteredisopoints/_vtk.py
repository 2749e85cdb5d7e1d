# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters in Python, on the C library, for versions of VTK without the compiled classes.

Methods, constants, defaults, ranges, output arrays and messages are those of the compiled classes, which
document them. docs/python.md lists the differences.
"""

from __future__ import annotations

import errno
import math
import re
from typing import Any, Callable, Optional

from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkVersion, vtkWeakReference
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet, vtkDataObject, vtkMultiBlockDataSet, vtkPartitionedDataSetCollection, vtkPolyData)
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkCommonMisc import vtkContourValues
from vtkmodules.vtkParallelCore import vtkMultiProcessController

from . import _datasets, _library, _progress
from ._arrays import CELL, POINT
from ._options import CONSTANTS, option_names, property_name
from ._properties import Property, properties_of
from ._samples import Extracted, Samples
from ._splats import NoNormalsError, polygons_of

UNKNOWN_ERROR = 40000 + 99  # vtkErrorCode::UnknownError

# GetNumberOf...()
_COUNTS = ("Samples", "ExtractedPoints", "SkippedSamples", "UnprojectedPoints", "DroppedInGaps")


def _with_properties(name: str, *others: str):
    """Gives a class the methods SetX, GetX, XOn and XOff of all properties X of a proxy, except some. Methods
    that the class has already stay."""

    def add(cls: Any) -> Any:
        cls.PROPERTIES = {property_.name: property_ for property_ in properties_of(name)
                          if property_.name not in others}
        for property_ in cls.PROPERTIES.values():
            _add_methods(cls, property_)
        return cls

    return add


def _add_methods(cls: type, property_: Property) -> None:
    name = property_.name

    def set_(self, value):
        self._set(name, value)

    def get(self):
        return self._values[name]

    methods = {f"Set{name}": set_, f"Get{name}": get}
    if property_.is_switch:
        methods.update({f"{name}On": lambda self: set_(self, 1), f"{name}Off": lambda self: set_(self, 0)})
    for method, function in methods.items():
        if method in vars(cls):
            continue
        function.__name__, function.__qualname__ = method, f"{cls.__name__}.{method}"
        setattr(cls, method, function)


def in_properties(text: str, as_in_panel: bool = False) -> str:
    """A message of the library, with the names of properties instead of options: DropGaps, or as in ParaView's panel
    Drop Gaps, not drop_gaps."""
    options = "|".join({*option_names(True), *option_names(False), "contour_blocks"})

    def name(found: re.Match) -> str:
        if not found[1]:
            return found[0]
        return found[1].replace("_", " ").title() if as_in_panel else property_name(found[1])

    return re.sub(rf'"[^"]*"|\b({options})\b', name, text)  # names of arrays are quoted


def is_first_of_several() -> bool:
    """Whether this process is the first of several, by VTK's global controller."""
    controller = vtkMultiProcessController.GetGlobalController()
    return (controller is not None and controller.GetNumberOfProcesses() > 1
            and controller.GetLocalProcessId() == 0)


def _fill(output: Any, data: Any, make: Callable[[Any, int], Optional[vtkPolyData]]) -> None:
    """Gives a composite the structure of another one, with a result for each of its data sets: other leaves,
    such as tables, have none."""
    output.CopyStructure(data)
    for number, place in enumerate(_datasets.places(data)):
        block = place.GetCurrentDataObject()
        output.SetDataSet(place, make(block, number) if block.IsA("vtkDataSet") else None)


class _Algorithm(VTKPythonAlgorithmBase):
    """Adds what VTK's filters in C++ have and vtkPythonAlgorithm lacks."""

    PROPERTIES: dict[str, Property] = {}

    def __init__(self):
        super().__init__(nInputPorts=1, nOutputPorts=1, outputType="vtkDataObject")
        self._values = {name: property_.default for name, property_ in self.PROPERTIES.items()}
        self._error_code = 0

    def _set(self, name: str, value: Any) -> None:
        """Gives a property the nearest value in its range."""
        # As in the compiled class, an angle out of range is an error in the next update.
        clamped = float(value) if name == "Angle" else self.PROPERTIES[name].clamped(value)
        if self._values[name] != clamped:
            self._values[name] = clamped
            self.Modified()

    def FillInputPortInformation(self, _port, info):
        info.Set(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet")
        info.Append(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet")
        return 1

    def SetInputData(self, data: Any) -> None:
        self.SetInputDataObject(0, data)

    def GetInput(self) -> Any:
        return self.GetInputDataObject(0, 0) if self.GetNumberOfInputConnections(0) else None

    def GetOutput(self) -> vtkPolyData:
        return self.GetOutputDataObject(0)

    def GetErrorCode(self) -> int:
        """EINVAL for invalid input or options, ENOMEM for a lack of memory, 0 after a success."""
        return self._error_code

    def _output_class(self, data: Any) -> type:
        """The class of the output for an input, which may be None."""
        raise NotImplementedError

    def _make(self, data: Any, output: Any) -> None:
        """Fills the output. Exceptions are reported as errors, except InterruptedError by AbortExecute."""
        raise NotImplementedError

    def RequestDataObject(self, _request, inputs, outputs):
        class_ = self._output_class(vtkDataObject.GetData(inputs[0], 0))
        if type(vtkDataObject.GetData(outputs, 0)) is not class_:
            outputs.GetInformationObject(0).Set(vtkDataObject.DATA_OBJECT(), class_())
        return 1

    def RequestData(self, _request, inputs, outputs):
        output = vtkDataObject.GetData(outputs, 0)
        self._error_code = 0
        try:
            self._make(vtkDataObject.GetData(inputs[0], 0), output)
        except Exception as error:
            output.Initialize()
            if not isinstance(error, InterruptedError):
                self._error_code = (errno.EINVAL if isinstance(error, (ValueError, TypeError)) else
                                    errno.ENOMEM if isinstance(error, MemoryError) else UNKNOWN_ERROR)
                self._report("ErrorEvent", str(error))
        return 1

    def _callbacks(self, part: tuple[float, float]) -> dict[str, Any]:
        """The callbacks of _library.Callbacks, for a part of the progress."""
        return dict(progress=_progress.part(self.UpdateProgress, *part), is_canceled=self.GetAbortExecute)

    def _report(self, event: str, text: str) -> None:
        """Reports to observers, otherwise to the output window, as VTK's macros do."""
        kind = "ERROR" if event == "ErrorEvent" else "Warning"
        described = f"{kind}: {type(self).__name__}: {text}\n\n"
        if self.HasObserver(event):
            self.InvokeEvent(event, described if event != "MessageEvent" else text)
        elif event == "ErrorEvent":
            vtkOutputWindow.GetInstance().DisplayErrorText(described)
        elif event == "WarningEvent":
            vtkOutputWindow.GetInstance().DisplayWarningText(described)


class _Contour(_Algorithm):
    """vtkScatteredContourFilter in Python."""

    _triangles = False
    _has_polygons = False  # whether the output has the points' polygons

    def __init__(self):
        super().__init__()
        self._values["UsePanelNames"] = 0  # the XML has ParaView's default
        self._contours = vtkContourValues()
        self._contours.SetValue(0, 0.0)
        self._kept: dict[int, tuple[Any, Samples]] = {}  # by block number
        self._reported: set[str] = set()  # causes
        self._reported_of = vtkWeakReference()
        self._counts = dict.fromkeys(_COUNTS, 0)

    def SetValue(self, i: int, value: float) -> None:
        self._change_contours(self._contours.SetValue, i, value)

    def GetValue(self, i: int) -> float:
        return self._contours.GetValue(i)

    def GetValues(self) -> list[float]:
        return [self.GetValue(i) for i in range(self.GetNumberOfContours())]

    def SetNumberOfContours(self, number: int) -> None:
        self._change_contours(self._contours.SetNumberOfContours, number)

    def GetNumberOfContours(self) -> int:
        return self._contours.GetNumberOfContours()

    def GenerateValues(self, number: int, *range_: Any) -> None:
        self._change_contours(self._contours.GenerateValues, number, *range_)

    def _change_contours(self, method: Any, *arguments: Any) -> None:
        """Also calls Modified(), because GetMTime() cannot be overridden in Python."""
        before = self._contours.GetMTime()
        method(*arguments)
        if self._contours.GetMTime() != before:
            self.Modified()

    def _output_class(self, data: Any) -> type:
        if not (self._values["ContourBlocks"] and isinstance(data, vtkCompositeDataSet)):
            return vtkPolyData
        return vtkMultiBlockDataSet if data.IsA("vtkUniformGridAMR") else type(data)

    def RequestUpdateExtent(self, _request, inputs, _outputs):
        info = inputs[0].GetInformationObject(0)
        # Neighbors of a piece's samples may be in any other piece.
        info.Set(vtkStreamingDemandDrivenPipeline.UPDATE_PIECE_NUMBER(), 0)
        info.Set(vtkStreamingDemandDrivenPipeline.UPDATE_NUMBER_OF_PIECES(), 1)
        info.Set(vtkStreamingDemandDrivenPipeline.UPDATE_NUMBER_OF_GHOST_LEVELS(), 0)
        return 1

    def _make(self, data: Any, output: Any) -> None:
        messages: list[_library.Message] = []
        if is_first_of_several():
            messages.append(_library.Message(
                "Each process contours its own samples: surfaces have seams. The compiled plugin"
                " contours those of all processes as one cloud.", is_warning=True, cause="processes"))
        self._counts = dict.fromkeys(_COUNTS, 0)
        is_kept = False
        try:
            if isinstance(output, vtkCompositeDataSet):
                messages += self._contour_blocks(data, output)
            else:
                self._kept = {0: self._kept[0]} if 0 in self._kept else {}
                extracted = self._contour_one(data, 0, (0.0, 1.0))
                output.ShallowCopy(extracted.isosurface.polydata)
                messages += extracted.messages
            is_kept = self._values["KeepTree"]
        except BaseException:
            self._counts = dict.fromkeys(_COUNTS, 0)
            raise
        finally:
            if not is_kept:
                self._kept.clear()
        self._report_messages(messages)

    def _contour_blocks(self, data: Any, output: Any) -> list[_library.Message]:
        """Contours each block. Returns the messages about all."""
        count = sum(1 for _ in _datasets.leaves(data))
        found: dict[int, Extracted] = {}  # by block number
        lacking: list[_datasets.NoSamplesError] = []

        def contour(block: Any, number: int) -> Optional[vtkPolyData]:
            try:
                found[number] = self._contour_one(block, number, (number / count, (number + 1) / count))
                return found[number].isosurface.polydata
            except _datasets.NoSamplesError as error:
                lacking.append(error)
                return None

        _fill(output, data, contour)
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
        samples = self._samples(data, number, (begin, half))
        options = {option: self._values[property_name(option)] for option in option_names(self._triangles)}
        try:
            extracted: Extracted = samples._extract(
                self.GetValues(), self._triangles, None, options, **self._callbacks((half, end)))
        except ValueError as error:
            raise ValueError(in_properties(str(error), self._values["UsePanelNames"])) from None
        surface = extracted.surface
        for name, count in zip(_COUNTS, (
                len(samples) + samples._without_array, len(extracted.isosurface),
                samples.skipped + samples._without_array, _library.get_unprojected_count(surface),
                _library.get_dropped_count(surface))):
            self._counts[name] += count
        isopoints = extracted.isosurface
        if self._has_polygons and isopoints.splat_shapes and isopoints.normals is not None:
            extracted.isosurface = isopoints._splats(is_canceled=self.GetAbortExecute)
        return extracted

    def _samples(self, data: Any, number: int, part: tuple[float, float]) -> Samples:
        """The samples of the last update, unless something has changed."""
        choice = self._array_choice()
        key = choice, _datasets.state_of(data)
        kept_key, samples = self._kept.get(number, (None, None))
        if samples is None or kept_key != key:
            found = _datasets.samples_of(data, *choice)
            callbacks = self._callbacks(part)
            if samples is None:
                samples = Samples._of(found, **callbacks)
            else:
                samples._take(found, **callbacks)
            self._kept[number] = key, samples
        return samples

    def _array_choice(self) -> tuple[Optional[str], tuple[int, ...], int]:
        """The array to process, as samples_of() takes it: name, associations, active array."""
        info = self.GetInputArrayInformation(0)
        name = info.Get(vtkDataObject.FIELD_NAME()) if info.Has(vtkDataObject.FIELD_NAME()) else None
        associations = {vtkDataObject.FIELD_ASSOCIATION_CELLS: (CELL,),
                        vtkDataObject.FIELD_ASSOCIATION_POINTS_THEN_CELLS: (POINT, CELL)}
        key = vtkDataObject.FIELD_ATTRIBUTE_TYPE()
        return (name or None, associations.get(info.Get(vtkDataObject.FIELD_ASSOCIATION()), (POINT,)),
                info.Get(key) if info.Has(key) else _datasets.SCALARS)

    def _report_messages(self, messages: list[_library.Message]) -> None:
        """Reports each cause once while it persists for the same input."""
        producer = self.GetInputAlgorithm() if self.GetNumberOfInputConnections(0) else None
        before = self._reported if self._reported_of.Get() is producer else set()
        self._reported_of.Set(producer)
        self._reported = set()
        for message in messages:
            if message.cause not in before | self._reported:
                self._report("WarningEvent" if message.is_warning else "MessageEvent",
                             in_properties(message.text, self._values["UsePanelNames"]))
            self._reported.add(message.cause)


@_with_properties("ScatteredIsopoints", "UseGlobalController")
class vtkScatteredIsopointFilter(_Contour):
    """Isosurfaces of scattered samples as points: see the compiled class of this name."""


@_with_properties("ScatteredIsosurface", "UseGlobalController")
class vtkScatteredIsosurfaceFilter(_Contour):
    """Isosurfaces of scattered samples as triangles: see the compiled class of this name."""

    _triangles = True


for _name, _number in {**CONSTANTS["projection"], **CONSTANTS["normal_method"]}.items():
    setattr(_Contour, _name, _number)
for _name in _COUNTS:
    setattr(_Contour, f"GetNumberOf{_name}", lambda self, name=_name: self._counts[name])


@_with_properties("IsopointSplatPolygons")
class vtkIsopointSplatPolygons(_Algorithm):
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
            self._report("WarningEvent", problem)

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

        _fill(output, data, make)
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
