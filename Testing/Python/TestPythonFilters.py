# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters in Python against the compiled ones: methods, defaults, ranges, outputs, messages."""

import errno
import unittest
from unittest import mock

import fingerprint
import numpy as np
import scatteredisopoints
from scatteredisopoints import _vtk
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_STRING, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer

PAIRS = [(getattr(scatteredisopoints, name), getattr(_vtk, name))
         for name in ("vtkScatteredIsopointFilter", "vtkScatteredIsosurfaceFilter",
                      "vtkIsopointSplatPolygons")]

# What the filters in Python do not have: ranks, threads of VTK, and what VTK's own classes have for C++.
MISSING = {"SetController", "GetController", "SetUseGlobalController", "SetUseAllCores",
           "GetUseAllCores", "UseAllCoresOn", "UseAllCoresOff"}


def own_methods(class_):
    base = next(c for c in class_.__mro__ if not c.__name__.startswith(("vtkScattered", "vtkIsopoint")))
    return {name for name in set(dir(class_)) - set(dir(base)) if name[0].isupper()}


def cloud(count=5000):
    positions = np.random.default_rng(1).random((count, 3))
    data, points = vtkPolyData(), vtkPoints()
    points.SetData(numpy_to_vtk(positions, deep=True))
    data.SetPoints(points)
    array = numpy_to_vtk(np.linalg.norm(positions - 0.5, axis=1), deep=True)
    array.SetName("distance")
    data.GetPointData().SetScalars(array)
    return data


def observed(filter_):
    """The texts of a filter's events, as they arrive."""
    texts = {"ErrorEvent": [], "WarningEvent": [], "MessageEvent": []}
    for event, list_ in texts.items():
        def note(_caller, _event, text, list_=list_):
            list_.append(text)
        note.CallDataType = VTK_STRING
        filter_.AddObserver(event, note)
    return texts


class PythonFilters(unittest.TestCase):
    def same_data(self, ours, theirs):
        self.assertEqual(ours.GetClassName(), theirs.GetClassName())
        self.assertEqual(ours.GetNumberOfPoints(), theirs.GetNumberOfPoints())
        if theirs.GetNumberOfPoints():
            np.testing.assert_array_equal(*(vtk_to_numpy(data.GetPoints().GetData())
                                            for data in (ours, theirs)))
        for cells in ("GetVerts", "GetPolys"):
            found, expected = getattr(ours, cells)(), getattr(theirs, cells)()
            self.assertEqual(found.GetNumberOfCells(), expected.GetNumberOfCells(), cells)
            if expected.GetNumberOfCells():
                np.testing.assert_array_equal(vtk_to_numpy(found.GetConnectivityArray()),
                                              vtk_to_numpy(expected.GetConnectivityArray()))
        for attributes in ("GetPointData", "GetCellData"):
            found, expected = getattr(ours, attributes)(), getattr(theirs, attributes)()
            names = [expected.GetArrayName(i) for i in range(expected.GetNumberOfArrays())
                     if expected.GetArray(i)]
            self.assertEqual({found.GetArrayName(i) for i in range(found.GetNumberOfArrays())},
                             set(names))
            for name in names:
                np.testing.assert_array_equal(
                    *(vtk_to_numpy(data.GetArray(name)) for data in (found, expected)), name)

    def test_methods_are_the_same(self):
        for theirs, ours in PAIRS:
            lacking = own_methods(theirs) - set(dir(ours)) - MISSING
            enumerations = {"NormalMethods", "ProjectionMethod"}
            lacking -= enumerations | {name for name in lacking
                                       if "To" in name or name.endswith(("MinValue", "MaxValue"))}
            self.assertEqual(lacking, set(), theirs.__name__)

    def test_defaults_and_ranges(self):
        for theirs, ours in PAIRS:
            self.assertGreater(len(ours.PROPERTIES), 1)
            for name in ours.PROPERTIES:
                a, b = theirs(), ours()
                self.assertEqual(getattr(b, "Get" + name)(), getattr(a, "Get" + name)(), name)
                for value in (-5, -1, 0, 1, 2, 3, 4, 5, 12, 10**6):
                    for filter_ in (a, b):
                        getattr(filter_, "Set" + name)(value)
                    self.assertEqual(getattr(b, "Get" + name)(), getattr(a, "Get" + name)(), (name, value))

    def test_outputs_are_the_same(self):
        compared = 0
        for number in range(40):
            for theirs, ours in PAIRS[:2]:
                filter_, _ = fingerprint.configured(number, theirs)
                filter_.Update()
                other, data = ours(), filter_.GetInputDataObject(0, 0)
                other.SetInputData(data)
                info = filter_.GetInputArrayInformation(0)
                other.GetInputArrayInformation(0).Copy(info)
                other.SetNumberOfContours(filter_.GetNumberOfContours())
                for i in range(filter_.GetNumberOfContours()):
                    other.SetValue(i, filter_.GetValue(i))
                for name in other.PROPERTIES:
                    getattr(other, "Set" + name)(getattr(filter_, "Get" + name)())
                if data.IsA("vtkHyperTreeGrid"):
                    continue
                other.Update()
                with self.subTest(number=number, data=data.GetClassName()):
                    self.same_outputs(other.GetOutputDataObject(0), filter_.GetOutputDataObject(0))
                    for count in ("Samples", "ExtractedPoints", "SkippedSamples", "UnprojectedPoints",
                                  "DroppedInGaps"):
                        method = "GetNumberOf" + count
                        self.assertEqual(getattr(other, method)(), getattr(filter_, method)(), method)
                compared += 1
        self.assertGreater(compared, 60)

    def same_outputs(self, ours, theirs):
        if not theirs.IsA("vtkCompositeDataSet"):
            self.same_data(ours, theirs)
            return
        self.assertEqual(ours.GetClassName(), theirs.GetClassName())
        iterator = theirs.NewIterator()
        iterator.InitTraversal()
        while not iterator.IsDoneWithTraversal():
            self.same_data(ours.GetDataSet(iterator), iterator.GetCurrentDataObject())
            iterator.GoToNextItem()

    def test_splats_are_the_same(self):
        theirs, ours = PAIRS[0]
        isopoints = ours()
        isopoints.SetInputData(cloud())
        isopoints.SetValue(0, 0.3)
        polygons = [class_() for class_ in PAIRS[2]]
        for filter_ in polygons:
            filter_.SetInputConnection(isopoints.GetOutputPort())
            filter_.SetRadiusScale(0.8)
            filter_.Update()
        data, expected = (filter_.GetOutputDataObject(0) for filter_ in polygons[::-1])
        np.testing.assert_array_equal(*(vtk_to_numpy(d.GetPoints().GetData()) for d in (data, expected)))
        np.testing.assert_array_equal(
            *(vtk_to_numpy(d.GetPolys().GetConnectivityArray()) for d in (data, expected)))

    def test_the_tree_is_kept(self):
        filter_ = _vtk.vtkScatteredIsopointFilter()
        data = cloud()
        filter_.SetInputData(data)
        filter_.SetValue(0, 0.3)
        filter_.Update()
        samples = filter_._kept[0][1]
        loads = []
        take = type(samples)._take
        type(samples)._take = lambda self, *args, **options: (loads.append(1), take(self, *args, **options))
        try:
            filter_.SetValue(0, 0.4)
            filter_.Update()
            self.assertEqual(loads, [])
            data.GetPointData().GetScalars().SetValue(7, 5.0)
            data.GetPointData().GetScalars().Modified()
            filter_.Update()
            self.assertEqual(loads, [1])
        finally:
            type(samples)._take = take
        filter_.KeepTreeOff()
        filter_.Update()
        self.assertEqual(filter_._kept, {})

    def test_errors_and_messages(self):
        for theirs, ours in PAIRS[:2]:
            for change, code in (
                    (lambda f: f.SetInputArrayToProcess(0, 0, 0, 0, "speed"), errno.EINVAL),
                    (lambda f: f.SetInputData(vtkPolyData()), errno.EINVAL),
                    (lambda f: f.SetValue(0, float("nan")), errno.EINVAL),
                    (lambda f: f.SetValue(0, 99.0), 0)):
                found = []
                for class_ in (theirs, ours):
                    filter_ = class_()
                    filter_.SetInputData(cloud())
                    filter_.SetValue(0, 0.3)
                    texts = observed(filter_)
                    change(filter_)
                    filter_.Update()
                    self.assertEqual(filter_.GetErrorCode(), code)
                    self.assertEqual(filter_.GetOutput().GetNumberOfPoints(), 0)
                    found.append({event: len(list_) for event, list_ in texts.items()})
                    filter_.SetValue(0, 0.3)
                self.assertEqual(found[0], found[1])

    def test_errors_of_blocks(self):
        """Blocks may lack the array, but nothing else goes unnoticed."""
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, cloud())
        for change in (lambda f: f.SetAngle(200.0),
                       lambda f: f.SetInputArrayToProcess(0, 0, 0, 0, "speed")):
            for class_ in PAIRS[0]:
                filter_ = class_()
                filter_.SetInputData(blocks)
                filter_.SetValue(0, 0.3)
                filter_.ContourBlocksOn()
                texts = observed(filter_)
                change(filter_)
                filter_.Update()
                self.assertEqual((filter_.GetErrorCode(), len(texts["ErrorEvent"])), (errno.EINVAL, 1))

    def test_several_processes_are_told_of_once(self):
        with mock.patch.object(_vtk, "is_first_of_several", lambda: True):
            filter_ = _vtk.vtkScatteredIsopointFilter()
            filter_.SetInputData(cloud())
            texts = observed(filter_)
            for isovalue in (0.3, 0.4):
                filter_.SetValue(0, isovalue)
                filter_.Update()
        self.assertEqual(len(texts["WarningEvent"]), 1)
        self.assertIn("Each process contours its own samples", texts["WarningEvent"][0])

    def test_an_abort_leaves_nothing(self):
        filter_ = _vtk.vtkScatteredIsosurfaceFilter()
        filter_.SetInputData(cloud(100000))
        filter_.SetValue(0, 0.3)
        texts = observed(filter_)
        filter_.AddObserver("ProgressEvent", lambda caller, _: caller.SetAbortExecute(1))
        filter_.Update()
        self.assertEqual(filter_.GetOutput().GetNumberOfPoints(), 0)
        self.assertEqual((filter_.GetErrorCode(), texts["ErrorEvent"]), (0, []))
        filter_.RemoveObservers("ProgressEvent")
        filter_.SetAbortExecute(0)
        filter_.Modified()
        filter_.Update()
        self.assertGreater(filter_.GetOutput().GetNumberOfPoints(), 1000)

    def test_progress_rises(self):
        filter_ = _vtk.vtkScatteredIsopointFilter()
        filter_.SetInputData(cloud(100000))
        filter_.SetValue(0, 0.3)
        fractions = []
        filter_.AddObserver("ProgressEvent", lambda caller, _: fractions.append(caller.GetProgress()))
        filter_.Update()
        self.assertEqual(fractions, sorted(fractions))
        self.assertGreater(len(fractions), 5)

    def test_pipelines(self):
        """Readers, pieces and composites that a producer makes."""
        producer = vtkTrivialProducer()
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, cloud())
        blocks.SetBlock(1, cloud(100))
        producer.SetOutput(blocks)
        for theirs, ours in PAIRS[:2]:
            outputs = []
            for class_ in (theirs, ours):
                filter_ = class_()
                filter_.SetInputConnection(producer.GetOutputPort())
                filter_.SetInputArrayToProcess(0, 0, 0, 0, "distance")
                filter_.GenerateValues(3, 0.2, 0.4)
                filter_.ContourBlocksOn()
                filter_.Update()
                outputs.append(filter_.GetOutputDataObject(0))
            self.same_outputs(outputs[1], outputs[0])


if __name__ == "__main__":
    unittest.main()
