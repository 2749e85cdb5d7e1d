# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters in Python, on the C library, for versions of VTK without the compiled classes.

Methods, constants, defaults, ranges, output arrays and messages are those of the compiled classes, which
document them. Differences: no vtkHyperTreeGrid; strings are not copied to the output; each process contours
its own samples; GetErrorCode() is 0 for C++ callers.
"""

from __future__ import annotations

import errno
from typing import Any, Callable, Optional

from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkOutputWindow
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet, vtkDataObject, vtkMultiBlockDataSet, vtkPolyData)
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkCommonMisc import vtkContourValues
from vtkmodules.vtkParallelCore import vtkMultiProcessController

from . import _datasets, _library
from ._options import CONSTANTS
from ._properties import Property, properties_of
from ._samples import Extracted, Samples
from ._splats import polygons_of

VERSION = _library.version().decode()
UNKNOWN_ERROR = 40000 + 99  # vtkErrorCode::UnknownError


def _with_properties(name: str, *others: str):
    """Gives a class the methods SetX, GetX, XOn and XOff of all properties X of a proxy, except some."""

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
        # As in the compiled class, an angle out of range is an error in the next update.
        clamped = float(value) if name == "Angle" else property_.clamped(value)
        if self._values[name] != clamped:
            self._values[name] = clamped
            self.Modified()

    def get(self):
        return self._values[name]

    methods = {f"Set{name}": set_, f"Get{name}": get}
    if property_.is_switch:
        methods.update({f"{name}On": lambda self: set_(self, 1), f"{name}Off": lambda self: set_(self, 0)})
    for method, function in methods.items():
        function.__name__, function.__qualname__ = method, f"{cls.__name__}.{method}"
        setattr(cls, method, function)


def is_first_of_several() -> bool:
    """Whether this process is the first of several, by VTK's global controller."""
    controller = vtkMultiProcessController.GetGlobalController()
    return (controller is not None and controller.GetNumberOfProcesses() > 1
            and controller.GetLocalProcessId() == 0)


def _fill(output: Any, data: Any, make: Callable[[Any, int], Optional[vtkPolyData]]) -> None:
    """Gives a composite the structure of another one, with a result for each of its blocks."""
    output.CopyStructure(data)
    iterator = data.NewIterator()
    iterator.InitTraversal()
    number = 0
    while not iterator.IsDoneWithTraversal():
        output.SetDataSet(iterator, make(iterator.GetCurrentDataObject(), number))
        number += 1
        iterator.GoToNextItem()


class _Algorithm(VTKPythonAlgorithmBase):
    """Adds what VTK's filters in C++ have and vtkPythonAlgorithm lacks."""

    PROPERTIES: dict[str, Property] = {}

    def __init__(self, input_types: tuple[str, ...]):
        super().__init__(nInputPorts=1, nOutputPorts=1, outputType="vtkDataObject")
        self._input_types = input_types
        self._values = {name: property_.default for name, property_ in self.PROPERTIES.items()}
        self._error_code = 0

    def FillInputPortInformation(self, _port, info):
        info.Set(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), self._input_types[0])
        for name in self._input_types[1:]:
            info.Append(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), name)
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

    def _set_output(self, info: Any, class_: type) -> Any:
        """Makes the output an object of a class, unless it is one."""
        output = vtkDataObject.GetData(info, 0)
        if type(output) is not class_:
            output = class_()
            info.GetInformationObject(0).Set(vtkDataObject.DATA_OBJECT(), output)
        return output

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

    def _fail(self, error: Exception, output: vtkDataObject) -> None:
        output.Initialize()
        is_usage = isinstance(error, (ValueError, TypeError))
        is_memory = isinstance(error, MemoryError)
        self._error_code = errno.EINVAL if is_usage else errno.ENOMEM if is_memory else UNKNOWN_ERROR
        self._report("ErrorEvent", str(error))


class _Contour(_Algorithm):
    """vtkScatteredContourFilter in Python."""

    _triangles = False
    _has_polygons = False  # whether the output has the points' polygons

    def __init__(self):
        super().__init__(("vtkDataSet", "vtkCompositeDataSet"))
        self._contours = vtkContourValues()
        self._contours.SetValue(0, 0.0)
        self._kept: dict[int, tuple[Any, Samples]] = {}  # by block number
        self._reported: set[str] = set()
        self._reported_of: Any = None
        self._counts = dict.fromkeys(("samples", "points", "skipped", "unprojected", "dropped"), 0)

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

    def GetNumberOfSamples(self) -> int:
        return self._counts["samples"]

    def GetNumberOfExtractedPoints(self) -> int:
        return self._counts["points"]

    def GetNumberOfSkippedSamples(self) -> int:
        return self._counts["skipped"]

    def GetNumberOfUnprojectedPoints(self) -> int:
        return self._counts["unprojected"]

    def GetNumberOfDroppedInGaps(self) -> int:
        return self._counts["dropped"]

    def RequestDataObject(self, _request, inputs, outputs):
        data = vtkDataObject.GetData(inputs[0], 0)
        class_ = vtkPolyData
        if self._values["ContourBlocks"] and data is not None and data.IsA("vtkCompositeDataSet"):
            class_ = vtkMultiBlockDataSet if data.IsA("vtkUniformGridAMR") else type(data)
        self._set_output(outputs, class_)
        return 1

    def RequestUpdateExtent(self, _request, inputs, _outputs):
        info = inputs[0].GetInformationObject(0)
        # Neighbors of a piece's samples may be in any other piece.
        info.Set(vtkStreamingDemandDrivenPipeline.UPDATE_PIECE_NUMBER(), 0)
        info.Set(vtkStreamingDemandDrivenPipeline.UPDATE_NUMBER_OF_PIECES(), 1)
        info.Set(vtkStreamingDemandDrivenPipeline.UPDATE_NUMBER_OF_GHOST_LEVELS(), 0)
        return 1

    def RequestData(self, _request, inputs, outputs):
        data = vtkDataObject.GetData(inputs[0], 0)
        output = vtkDataObject.GetData(outputs, 0)
        self._error_code, messages = 0, []
        if is_first_of_several():
            messages.append(_library.Message(
                "Each process contours its own samples: surfaces have seams. The compiled plugin"
                " contours those of all processes as one cloud.", is_warning=True))
        self._counts = dict.fromkeys(self._counts, 0)
        try:
            if isinstance(output, vtkCompositeDataSet):
                self._contour_blocks(data, output, messages)
            else:
                self._kept = {0: self._kept[0]} if 0 in self._kept else {}
                output.ShallowCopy(self._contour_one(data, 0, (0.0, 1.0), messages))
        except InterruptedError:  # by AbortExecute
            output.Initialize()
            self._kept.clear()
        except Exception as error:
            self._kept.clear()
            self._fail(error, output)
        else:
            self._report_messages(messages)
        if not self._values["KeepTree"]:
            self._kept.clear()
        return 1

    def _contour_blocks(self, data: Any, output: Any, messages: list[_library.Message]) -> None:
        count = sum(1 for _ in _datasets.leaves(data))
        lacking: list[_datasets.NoSamplesError] = []

        def contour(block: Any, number: int) -> Optional[vtkPolyData]:
            try:
                part = number / count, (number + 1) / count
                return self._contour_one(block, number, part, messages)
            except _datasets.NoSamplesError as error:
                lacking.append(error)
                return None

        _fill(output, data, contour)
        if count and len(lacking) == count:
            raise lacking[0]

    def _contour_one(self, data: Any, number: int, part: tuple[float, float],
                     messages: list[_library.Message]) -> vtkPolyData:
        begin, end = part
        half = 0.5 * (begin + end)
        samples = self._samples(data, number, lambda f: self.UpdateProgress(begin + f * (half - begin)))
        options = {property_.option: self._values[name] for name, property_ in self.PROPERTIES.items()
                   if name != "ContourBlocks"}
        extracted: Extracted = samples._extract(
            self.GetValues(), self._triangles, None, options,
            progress=lambda f: self.UpdateProgress(half + f * (end - half)),
            is_canceled=self.GetAbortExecute)
        self._counts["points"] += len(extracted.isosurface)
        self._counts["unprojected"] += extracted.unprojected
        self._counts["dropped"] += extracted.dropped
        self._counts["samples"] += len(samples) + samples._without_array
        self._counts["skipped"] += samples.skipped + samples._without_array
        messages += extracted.messages
        surface = extracted.isosurface
        if self._has_polygons and surface.splat_shapes and surface.normals is not None:
            surface = surface.splats()
        return surface.polydata

    def _samples(self, data: Any, number: int, progress: Any) -> Samples:
        """The samples of the last update, unless something has changed."""
        info = self.GetInputArrayInformation(0)
        name = info.Get(vtkDataObject.FIELD_NAME()) if info.Has(vtkDataObject.FIELD_NAME()) else None
        cells = info.Get(vtkDataObject.FIELD_ASSOCIATION()) == vtkDataObject.FIELD_ASSOCIATION_CELLS
        key = name, cells, _datasets.state_of(data)
        kept = self._kept.get(number)
        if kept is None or kept[0] != key:
            found = _datasets.samples_of(data, name or None, cells)
            callbacks = dict(progress=progress, is_canceled=self.GetAbortExecute)
            if kept is None:
                samples = Samples._of(found, **callbacks)
            else:
                samples = kept[1]
                samples._take(found, **callbacks)
            self._kept[number] = key, samples
        return self._kept[number][1]

    def _report_messages(self, messages: list[_library.Message]) -> None:
        """Reports each cause once while it persists for the same input."""
        producer = self.GetInputAlgorithm() if self.GetNumberOfInputConnections(0) else None
        before = self._reported if self._reported_of is producer else set()
        self._reported_of, self._reported = producer, {message.text for message in messages}
        for message in messages:
            if message.text not in before:
                self._report("WarningEvent" if message.is_warning else "MessageEvent", message.text)


@_with_properties("ScatteredIsopoints", "UseGlobalController")
class vtkScatteredIsopointFilter(_Contour):
    """Isosurfaces of scattered samples as points: see the compiled class of this name."""


@_with_properties("ScatteredIsosurface", "UseGlobalController")
class vtkScatteredIsosurfaceFilter(_Contour):
    """Isosurfaces of scattered samples as triangles: see the compiled class of this name."""

    _triangles = True


for _constants in (CONSTANTS["projection"], CONSTANTS["normal_method"]):
    for _name, _number in _constants.items():
        setattr(_Contour, _name, _number)


@_with_properties("IsopointSplatPolygons")
class vtkIsopointSplatPolygons(_Algorithm):
    """The triangles that show points, as data: see the compiled class of this name. Points need normals."""

    def __init__(self):
        super().__init__(("vtkDataSet", "vtkCompositeDataSet"))
        self._radius_array = "Radius"

    def SetRadiusArrayName(self, name: Optional[str]) -> None:
        if self._radius_array != name:
            self._radius_array = name
            self.Modified()

    def GetRadiusArrayName(self) -> Optional[str]:
        return self._radius_array

    def RequestDataObject(self, _request, inputs, outputs):
        data = vtkDataObject.GetData(inputs[0], 0)
        is_composite = data is not None and data.IsA("vtkCompositeDataSet")
        self._set_output(outputs, vtkMultiBlockDataSet if is_composite else vtkPolyData)
        return 1

    def RequestData(self, _request, inputs, outputs):
        data = vtkDataObject.GetData(inputs[0], 0)
        output = vtkDataObject.GetData(outputs, 0)
        self._error_code = 0
        try:
            if isinstance(output, vtkPolyData):
                output.ShallowCopy(self._polygons(data))
                return 1
            _fill(output, data, lambda block, _: self._polygons(block))
        except Exception as error:
            self._fail(error, output)
        return 1

    def _polygons(self, data: Any) -> vtkPolyData:
        if data.GetNumberOfPoints() == 0:
            return vtkPolyData()
        return polygons_of(
            data, self._radius_array, self._values["Radius"], self._values["RadiusScale"]).polydata
