# SPDX-License-Identifier: GPL-3.0-or-later
"""What the filters in Python share."""

from __future__ import annotations

import errno
import re
from typing import Any, Callable, Iterable, Optional

import numpy as np
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkWeakReference
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkCommonMisc import vtkContourValues
from vtkmodules.vtkParallelCore import vtkMultiProcessController

from . import _datasets, _library, _progress
from ._arrays import CELL, POINT
from ._isosurface import Isosurface
from ._options import option_names, property_name
from ._properties import Property, properties_of
from ._samples import Samples

LOADED = 0.2  # share of the progress
UNKNOWN_ERROR = 40000 + 99  # vtkErrorCode::UnknownError


def with_properties(name: str, *others: str):
    """Gives a class the methods SetX, GetX, XOn and XOff of all properties X of a proxy, except some. Methods
    that the class has already stay."""

    def add(cls: Any) -> Any:
        cls.PROXY = name
        cls.PROPERTIES = {**cls.PROPERTIES, **{property_.name: property_ for property_ in properties_of(name)
                                               if property_.name not in (*others, "UseGlobalController")}}
        for property_ in cls.PROPERTIES.values():
            _add_methods(cls, property_)
        return cls

    return add


def _add_methods(cls: type, property_: Property) -> None:
    name = property_.name

    def set_(self, *values):
        if not isinstance(property_.default, tuple) or len(values) == 1:
            values, = values
        self._set(name, values)

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


def fill(output: Any, data: Any, make: Callable[[Any, int], Any], are_all: bool = False) -> None:
    """Gives a composite the structure of another one, with a result for each of its data sets: other leaves,
    such as tables, have none unless all have."""
    output.CopyStructure(data)
    for number, place in enumerate(_datasets.leaf_iterators(data)):
        block = place.GetCurrentDataObject()
        output.SetDataSet(place, make(block, number) if are_all or block.IsA("vtkDataSet") else None)


def describe_left_out(names: Iterable[str], rule: str) -> list[_library.Message]:
    """The note that arrays are left out of the output, if any, and which are not."""
    listed = ", ".join(f'"{name}"' for name in sorted(names))
    return [] if not listed else [_library.Message(
        f"Left out of the output: {listed}. {rule}", is_warning=False, cause=f"left out {listed}")]


class Algorithm(VTKPythonAlgorithmBase):
    """Adds what VTK's filters in C++ have and vtkPythonAlgorithm lacks."""

    PROXY = ""
    """The name of ParaView's proxy."""
    PROPERTIES: dict[str, Property] = {}
    SAMPLES_PORT = 0
    """The last input port."""

    def __init__(self):
        super().__init__(nInputPorts=self.SAMPLES_PORT + 1, nOutputPorts=1, outputType="vtkDataObject")
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

    def SetInputData(self, *port_and_data: Any) -> None:
        self.SetInputDataObject(*port_and_data)

    def AddInputData(self, *port_and_data: Any) -> None:
        self.AddInputDataObject(*port_and_data)

    def GetInput(self, port: int = 0) -> Any:
        return self.GetInputDataObject(port, 0) if self.GetNumberOfInputConnections(port) else None

    def GetOutput(self, port: int = 0) -> Any:
        return self.GetOutputDataObject(port)

    def GetErrorCode(self) -> int:
        """EINVAL for invalid input or options, ENOMEM for a lack of memory, 0 after a success."""
        return self._error_code

    def _output_class(self, data: Any) -> type:
        """The class of the output for the first input, which may be None."""
        raise NotImplementedError

    def _make(self, data: Any, output: Any) -> None:
        """Fills the output, from the data of the last port. Exceptions are reported as errors, except
        InterruptedError by AbortExecute."""
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
            self._make(vtkDataObject.GetData(inputs[self.SAMPLES_PORT], 0), output)
        except Exception as error:
            output.Initialize()
            if not isinstance(error, InterruptedError):
                self._error_code = (errno.EINVAL if isinstance(error, (ValueError, TypeError)) else
                                    errno.ENOMEM if isinstance(error, MemoryError) else UNKNOWN_ERROR)
                self._report("ErrorEvent", in_properties(str(error), self._values.get("UsePanelNames", 0)))
        return 1

    def _callbacks(self, part: tuple[float, float]) -> dict[str, Any]:
        """The callbacks of _library.Callbacks, for a part of the progress."""
        return dict(progress=_progress.part(self.UpdateProgress, *part), is_canceled=self.GetAbortExecute)

    def _advance(self, fraction: float) -> None:
        """Reports progress. Raises InterruptedError after AbortExecute."""
        self.UpdateProgress(fraction)
        if self.GetAbortExecute():
            raise InterruptedError

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


def with_counts(cls: Any) -> Any:
    """Gives a class the methods GetNumberOf...() of its COUNTS."""
    for name in cls.COUNTS:
        setattr(cls, f"GetNumberOf{name}", lambda self, name=name: self._counts[name])
    return cls


@with_counts
class ScatteredAlgorithm(Algorithm):
    """vtkScatteredAlgorithm in Python."""

    COUNTS: tuple[str, ...] = ("Samples", "SkippedSamples")
    """For methods GetNumberOf...()."""

    def __init__(self):
        super().__init__()
        self._values["UsePanelNames"] = 0  # the XML has ParaView's default
        self._kept: dict[int, Any] = {}  # by block number: state, samples, their parts
        self._reported: set[str] = set()  # causes
        self._reported_of = vtkWeakReference()
        self._counts = dict.fromkeys(self.COUNTS, 0)

    def RequestUpdateExtent(self, _request, inputs, _outputs):
        pipeline, samples = vtkStreamingDemandDrivenPipeline, inputs[self.SAMPLES_PORT]
        for info in map(samples.GetInformationObject, range(samples.GetNumberOfInformationObjects())):
            # Neighbors of a piece's samples may be in any other piece.
            info.Set(pipeline.EXACT_EXTENT(), 1)
            info.Set(pipeline.UPDATE_PIECE_NUMBER(), 0)
            info.Set(pipeline.UPDATE_NUMBER_OF_PIECES(), 1)
            info.Set(pipeline.UPDATE_NUMBER_OF_GHOST_LEVELS(), 0)
            if info.Has(pipeline.WHOLE_EXTENT()):  # not the extent of a structured output
                info.Set(pipeline.UPDATE_EXTENT(), info.Get(pipeline.WHOLE_EXTENT()), 6)
        return 1

    def _compute(self, data: Any, output: Any) -> list[_library.Message]:
        """Fills the output and counts. Returns messages."""
        raise NotImplementedError

    def _make(self, data: Any, output: Any) -> None:
        messages: list[_library.Message] = []
        if is_first_of_several():
            messages.append(_library.Message(
                "Each process takes its own samples alone: results have seams. The compiled plugin takes those of all"
                " processes as one cloud.", is_warning=True, cause="processes"))
        self._counts = dict.fromkeys(self.COUNTS, 0)
        is_kept = False
        try:
            messages += self._compute(data, output)
            is_kept = self._values["KeepTree"]
        except BaseException:
            self._counts = dict.fromkeys(self.COUNTS, 0)
            raise
        finally:
            if not is_kept:
                self._kept.clear()
        self._report_messages(messages)

    def _loaded(self, data: Any, number: int, choice: Any, find: Callable[[], _datasets.DataSamples],
                part: tuple[float, float]) -> Samples:
        """The samples of the last update, unless the choice of an array or the data have changed: then those found."""
        key = choice, _datasets.state_of(data)
        kept_key, samples, _ = self._kept.get(number, (None, None, None))
        if samples is None or kept_key != key:
            found = find()
            callbacks = self._callbacks(part)
            if samples is None:
                samples = Samples._from_data(found, **callbacks)
            else:
                samples._take(found, **callbacks)
            self._kept[number] = key, samples, found.parts
        return samples

    def _all_samples(self, data: Any, with_arrays: bool = True) -> Samples:
        """The samples of all blocks, without values."""
        return self._loaded(data, 0, None, lambda: _datasets.samples_without_values(data, with_arrays), (0.0, LOADED))

    def _array_choice(self) -> tuple[Optional[str], tuple[int, ...], int]:
        """The array to process, as samples_with_values() takes it: name, associations, active array."""
        info = self.GetInputArrayInformation(0)
        name = info.Get(vtkDataObject.FIELD_NAME()) if info.Has(vtkDataObject.FIELD_NAME()) else None
        associations = {vtkDataObject.FIELD_ASSOCIATION_CELLS: (CELL,),
                        vtkDataObject.FIELD_ASSOCIATION_POINTS_THEN_CELLS: (POINT, CELL)}
        key = vtkDataObject.FIELD_ATTRIBUTE_TYPE()
        return (name or None, associations.get(info.Get(vtkDataObject.FIELD_ASSOCIATION()), (POINT,)),
                info.Get(key) if info.Has(key) else _datasets.SCALARS)

    def _count_samples(self, samples: Samples) -> None:
        self._counts["Samples"] = len(samples) + samples._without_array
        self._counts["SkippedSamples"] = samples.skipped + samples._without_array

    def _finish(self, samples: Samples, made: Isosurface, messages: list[_library.Message], output: Any
                ) -> list[_library.Message]:
        """Fills the output and counts with triangles. Returns all messages."""
        output.ShallowCopy(made._into_polydata())
        self._count_samples(samples)
        self._counts["ExtractedPoints"] = len(made)
        return [*messages, *describe_left_out(
            samples._differing, "Only arrays are kept that all blocks have, with the same components.")]

    def _describe_skipped(self, samples: Samples, of_none: str, of_some: str) -> list[_library.Message]:
        """The message about skipped samples, unless all of them are ghosts. Ends with a sentence for none or some
        left."""
        excluded = 0 if samples._excluded is None else int(np.count_nonzero(samples._excluded))
        array = f'"{samples._name}"' if samples._name else "the array"
        reasons = ((samples.skipped - excluded, "not finite"),
                   (samples._without_array, f"in blocks without {array}"), (excluded, "excluded"))
        if reasons[0][0] + reasons[1][0] == 0:
            return []
        count, skipped = self._counts["Samples"], self._counts["SkippedSamples"]
        parts = [f"{number} {reason}" if number < skipped else reason for number, reason in reasons if number]
        return [_library.Message(
            f"Skipped {skipped} of {count} samples: {', '.join(parts)}. {of_none if skipped == count else of_some}",
            is_warning=skipped == count,
            cause=f"samples skipped of {samples._name}: {10 * skipped // max(count, 1)} of 10")]

    def _report_messages(self, messages: list[_library.Message]) -> None:
        """Reports each cause once while it persists for the same input."""
        port = self.SAMPLES_PORT
        producer = self.GetInputAlgorithm(port, 0) if self.GetNumberOfInputConnections(port) else None
        before = self._reported if self._reported_of.Get() is producer else set()
        self._reported_of.Set(producer)
        self._reported = set()
        for message in messages:
            if message.cause not in before | self._reported:
                self._report("WarningEvent" if message.is_warning else "MessageEvent",
                             in_properties(message.text, self._values["UsePanelNames"]))
            self._reported.add(message.cause)


class NearestArrays:
    """The names of arrays whose values are those of the nearest sample."""

    Modified: Callable[[], None]

    def __init__(self):
        super().__init__()
        self._nearest: list[str] = []

    def AddNearestArray(self, name: str) -> None:
        if name not in self._nearest:
            self._nearest.append(name)
            self.Modified()

    def ClearNearestArrays(self) -> None:
        if self._nearest:
            self._nearest.clear()
            self.Modified()

    def GetNumberOfNearestArrays(self) -> int:
        return len(self._nearest)

    def GetNearestArray(self, i: int) -> Optional[str]:
        return self._nearest[i] if 0 <= i < len(self._nearest) else None


class ContourValues:
    """The values of an algorithm, as of vtkContourFilter."""

    Modified: Callable[[], None]

    def __init__(self):
        super().__init__()
        self._contours = vtkContourValues()
        self._contours.SetValue(0, 0.0)

    def GetValues(self) -> list[float]:
        return [self._contours.GetValue(i) for i in range(self._contours.GetNumberOfContours())]


def _delegate(name: str) -> None:
    """Gives ContourValues a method of vtkContourValues."""

    def method(self, *arguments):
        before = self._contours.GetMTime()
        result = getattr(self._contours, name)(*arguments)
        if self._contours.GetMTime() != before:  # because GetMTime() cannot be overridden in Python
            self.Modified()
        return result

    method.__name__ = name
    setattr(ContourValues, name, method)


for _name in ("SetValue", "GetValue", "SetNumberOfContours", "GetNumberOfContours", "GenerateValues"):
    _delegate(_name)
