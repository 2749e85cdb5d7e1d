# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters in Python against the compiled ones: methods, defaults, ranges, outputs, messages."""

import errno
import re
import unittest
from unittest import mock

import fingerprint
import numpy as np
import scatteredisopoints
from scatteredisopoints import _vtk, _vtk_algorithm
from vtk_data import assert_same, blocks_of, cloud_of, configured, named, observed, set_all, updated
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkBox, vtkCylinder, vtkDataObject, vtkPlane, vtkPolyData, vtkSphere
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer
from vtkmodules.vtkCommonTransforms import vtkTransform

NAMES = ("vtkScatteredIsopointFilter", "vtkScatteredIsosurfaceFilter", "vtkIsopointSplatPolygons",
         "vtkScatteredProbeFilter", "vtkScatteredLineFilter", "vtkScatteredGridFilter", "vtkScatteredGradientFilter",
         "vtkScatteredSliceFilter", "vtkScatteredBodyFilter")
PAIRS = [(getattr(scatteredisopoints, name), getattr(_vtk, name)) for name in NAMES]
ISOPOINTS, ISOSURFACE = _vtk.vtkScatteredIsopointFilter, _vtk.vtkScatteredIsosurfaceFilter

# What the filters in Python do not have: ranks, threads of VTK, and what VTK's own classes have for C++.
MISSING = {"SetController", "GetController", "SetUseGlobalController", "SetUseAllCores",
           "GetUseAllCores", "UseAllCoresOn", "UseAllCoresOff"}


def own_methods(class_):
    base = next(c for c in class_.__mro__ if not c.__name__.startswith(("vtkScattered", "vtkIsopoint")))
    return {name for name in set(dir(class_)) - set(dir(base)) if name[0].isupper()}


def cloud(count=5000):
    positions = np.random.default_rng(1).random((count, 3))
    return cloud_of(positions, np.linalg.norm(positions - 0.5, axis=1), "distance")


class PythonFilters(unittest.TestCase):
    def test_methods_are_the_same(self):
        for theirs, ours in PAIRS:
            lacking = own_methods(theirs) - set(dir(ours)) - MISSING - {
                "InterpolationMethods", "NormalMethods", "ProjectionMethod", "Strategy"}
            lacking -= {name for name in lacking if "To" in name or name.endswith(("MinValue", "MaxValue"))}
            self.assertEqual(lacking, set(), theirs.__name__)

    def test_defaults_and_ranges(self):
        for theirs, ours in PAIRS:
            self.assertGreater(len(ours.PROPERTIES), 1)
            for name in ours.PROPERTIES:
                pair = ours(), theirs()
                self.assertIn(f"{name}: ", str(pair[1]))
                for value in (None, *self.values_for(ours.PROPERTIES[name])):
                    for filter_ in pair if value is not None else ():
                        getattr(filter_, "Set" + name)(value)
                    self.assertEqual(*(getattr(filter_, "Get" + name)() for filter_ in pair), (name, value))

    def test_ends_of_the_values_of_each_input(self):
        """A surface of earlier samples excuses no isovalue at an end of others."""
        for class_ in (ISOPOINTS, ISOSURFACE):
            for keeps in (0, 1):
                first, other = cloud(), cloud(4000)
                filter_ = set_all(configured(class_, first, [0.3]), KeepTree=keeps)
                texts = observed(filter_)
                filter_.Update()
                filter_.SetValue(0, first.GetPointData().GetScalars().GetRange()[0])
                filter_.Update()
                self.assertEqual([len(texts[event]) for event in ("WarningEvent", "MessageEvent")], [0, 1])
                filter_.SetInputData(other)
                filter_.SetValue(0, other.GetPointData().GetScalars().GetRange()[0])
                filter_.Update()
                self.assertEqual([len(texts[event]) for event in ("WarningEvent", "MessageEvent")], [1, 1])

    def test_integers_of_windows(self):
        """NumPy 1 makes 32-bit integers there."""
        made = {name: getattr(np, name) for name in ("arange", "array")}

        def narrow(name):
            def make(*arguments, **options):
                result = made[name](*arguments, **options)
                is_chosen = "dtype" in options or len(arguments) > 1
                return result.astype(np.int32) if result.dtype == np.int64 and not is_chosen else result
            return make

        for name, isovalues in (("vtkScatteredIsopointFilter", [0.3]), ("vtkScatteredIsosurfaceFilter", [0.3]),
                                ("vtkScatteredLineFilter", ())):
            filter_ = configured(getattr(_vtk, name), cloud(), isovalues)
            texts = observed(filter_)
            with mock.patch.multiple(np, **{each: narrow(each) for each in made}):
                filter_.Update()
            self.assertEqual(texts["ErrorEvent"], [], name)
            assert_same(self, filter_.GetOutput(), updated(getattr(_vtk, name), cloud(), isovalues).GetOutput())

    def values_for(self, property_):
        if isinstance(property_.default, tuple):
            return [[type(each)(i - 2) for i, each in enumerate(property_.default)]]
        if isinstance(property_.default, str):
            return "other", ""
        return (0, 1) if property_.is_switch else (-5, -1, 0, 1, 2, 3, 4, 5, 12, 10**6)

    def test_outputs_are_the_same(self):
        compared = with_points = with_splats = 0
        for number in range(60):
            for theirs, ours in PAIRS[:2]:
                filter_, _ = fingerprint.configured(number, theirs)
                filter_.Update()
                data = filter_.GetInputDataObject(0, 0)
                if data.IsA("vtkHyperTreeGrid"):
                    continue
                isovalues = [filter_.GetValue(i) for i in range(filter_.GetNumberOfContours())]
                other = configured(ours, data, isovalues, **{
                    name: getattr(filter_, "Get" + name)() for name in ours.PROPERTIES})
                other.SetNumberOfContours(len(isovalues))
                other.GetInputArrayInformation(0).Copy(filter_.GetInputArrayInformation(0))
                other.Update()
                with self.subTest(number=number, data=data.GetClassName()):
                    assert_same(self, other.GetOutputDataObject(0), filter_.GetOutputDataObject(0))
                    with_splats += self.same_splats(filter_.GetOutputDataObject(0))
                    for count in ("Samples", "ExtractedPoints", "SkippedSamples", "UnprojectedPoints",
                                  "DroppedInGaps"):
                        method = "GetNumberOf" + count
                        self.assertEqual(getattr(other, method)(), getattr(filter_, method)(), method)
                compared += 1
                with_points += filter_.GetOutputDataObject(0).GetNumberOfElements(0) > 0
        self.assertGreater(compared, 90)
        self.assertGreater(with_points, 60)
        self.assertGreater(with_splats, 10)

    def test_places_slices_and_bodies_are_the_same(self):
        """Outputs, counts and messages, of random samples and options."""
        kinds = set()
        for number in range(40):
            source, random = fingerprint.configured(number, PAIRS[0][0])
            data = source.GetInputDataObject(0, 0)
            if data.IsA("vtkHyperTreeGrid"):
                continue
            grid = updated(PAIRS[5][0], data, SamplingDimensions=(7, 6, 5), KeepTree=0).GetOutput()
            grid.GetPointData().Initialize()
            grid.GetCellData().Initialize()
            corners = cloud_of(np.array([grid.GetPoint(i) for i in range(210)]).astype(random.choice(["f4", "f8"])))
            places = (grid, corners, blocks_of(grid, corners, None))[int(random.integers(3))]
            low, high = np.reshape(grid.GetBounds(), (3, 2)).T
            options = self.random_options(random, low, high)
            for name, pair in zip(NAMES[3:], PAIRS[3:]):
                found = []
                for class_ in pair:
                    filter_ = set_all(class_(), InputDataObject=data, **options[name])
                    if name == "vtkScatteredProbeFilter":
                        set_all(filter_, SourceData=data, InputDataObject=places)
                    if name == "vtkScatteredGradientFilter":
                        association = source.GetInputArrayInformation(0).Get(vtkDataObject.FIELD_ASSOCIATION())
                        array = "vectors" if filter_.GetComputeQCriterion() else "values"
                        filter_.SetInputArrayToProcess(0, 0, 0, association, array)
                    texts = observed(filter_)
                    filter_.Update()
                    found.append((filter_, self.without_class(texts)))
                (theirs, expected), (ours, texts) = found
                with self.subTest(number=number, name=name, data=data.GetClassName(), options=options[name]):
                    assert_same(self, ours.GetOutputDataObject(0), theirs.GetOutputDataObject(0))
                    texts["MessageEvent"] = [text for text in texts["MessageEvent"]  # string arrays are left out
                                             if not text.startswith('Left out of the output: "names".')]
                    self.assertEqual(texts, expected)
                    for count in ours.COUNTS:
                        self.assertEqual(*(getattr(each, "GetNumberOf" + count)() for each in (ours, theirs)), count)
                    if theirs.GetOutputDataObject(0).GetNumberOfElements(0) > 0:
                        kinds.add((name, data.GetClassName()))
        self.assertGreater(len(kinds), 15)

    def random_options(self, random, low, high):
        """By class, for samples in bounds."""
        middle, size = 0.5 * low + 0.5 * high, (high - low).max()
        normal = random.normal(size=3)
        turned = vtkTransform()
        turned.RotateX(20)
        function = (
            lambda: set_all(vtkPlane(), Normal=tuple(normal), Origin=tuple(middle)),
            lambda: set_all(vtkPlane(), Normal=tuple(normal), Origin=tuple(middle), Transform=turned),
            lambda: set_all(vtkSphere(), Center=tuple(middle), Radius=0.3 * size),
            lambda: set_all(vtkBox(), Bounds=tuple(np.ravel([middle - 0.3 * size, middle + 0.2 * size], order="F"))),
            lambda: set_all(vtkCylinder(), Center=tuple(middle), Radius=0.3 * size))[int(random.integers(5))]()
        probing = dict(Interpolation=int(random.integers(5)), NullPointsStrategy=int(random.integers(3)),
                       NullValue=-7.5, MarkBlankPointsAndCells=int(random.integers(2)),
                       PassPointArrays=int(random.integers(2)))
        return dict(zip(NAMES[3:], (
            probing, dict(probing, Point1=tuple(low), Point2=tuple(high), Resolution=50),
            dict(probing, SamplingDimensions=(6, 7, 8)),
            dict(Interpolation=int(random.integers(4)), **dict.fromkeys(
                ("ComputeDivergence", "ComputeVorticity", "ComputeQCriterion"), int(random.integers(2)))),
            dict(CutFunction=function, Interpolation=int(random.integers(2)), Value=(1, 0.1 * size),
                 DropGaps=int(random.integers(2)), Regularize=int(random.integers(2)),
                 OutputPointsPrecision=int(random.integers(3))),
            dict(DropGaps=int(random.integers(2)), MinimumPieceSize=float(random.choice([0, 0.3])),
                 OutputPointsPrecision=int(random.integers(3))))))

    def without_class(self, texts):
        """The texts of events alone."""
        return {event: [re.sub(r"^(ERROR|Warning):(.|\n)*?(\): |Filter: )", "", text).strip() for text in list_]
                for event, list_ in texts.items()}

    def same_splats(self, points):
        """The same triangles, points of vertices, and means of floating-point arrays. @returns whether there are any"""
        arrays = points.GetPointData() if points.IsA("vtkPolyData") and points.GetNumberOfPoints() else None
        if not arrays or not arrays.HasArray("Radius") or not arrays.HasArray("Normals"):
            return False
        numbered = points.NewInstance()
        numbered.ShallowCopy(points)
        numbered.GetPointData().AddArray(named("number", np.arange(points.GetNumberOfPoints())))
        for scale in (1.0, 0.4):
            theirs, ours = (updated(class_, numbered, RadiusScale=scale).GetOutputDataObject(0) for class_ in PAIRS[2])
            found, expected = ours.GetPointData(), theirs.GetPointData()
            names = [found.GetArrayName(i) for i in range(found.GetNumberOfArrays())]
            self.assertLessEqual({"Normals", "vectors"}, set(names))
            pairs = [("vertices", ours.GetPoints().GetData(), theirs.GetPoints().GetData()),
                     ("triangles", ours.GetPolys().GetConnectivityArray(), theirs.GetPolys().GetConnectivityArray()),
                     # Integers are those of one isopoint.
                     ("vertex points", found.GetArray("number"), expected.GetArray("vtkOriginalPointIds")),
                     *((name, found.GetArray(name), expected.GetArray(name)) for name in names)]
            for name, *pair in pairs:
                one, other = map(vtk_to_numpy, pair)
                if name == "triangles":
                    one, other = one.astype(np.int64), other.astype(np.int64)  # VTK stores cells in either
                if one.dtype.kind == "f" or name in ("triangles", "vertex points"):
                    self.assertEqual((one.dtype, one.shape), (other.dtype, other.shape), name)
                    self.assertEqual(one.tobytes(), other.tobytes(), name)
        return True

    def test_the_tree_is_kept(self):
        data = cloud()
        filter_ = updated(ISOPOINTS, data, [0.3])
        kind = type(filter_._kept[0][1])
        with mock.patch.object(kind, "_take", autospec=True, side_effect=kind._take) as take:
            filter_.SetValue(0, 0.4)
            filter_.Update()
            self.assertEqual(take.call_count, 0)
            data.GetPointData().GetScalars().SetValue(7, 5.0)
            data.GetPointData().GetScalars().Modified()
            filter_.Update()
            self.assertEqual(take.call_count, 1)
        filter_.KeepTreeOff()
        filter_.Update()
        self.assertEqual(filter_._kept, {})

    def test_errors_and_messages(self):
        """Blocks may lack the array, but nothing else goes unnoticed."""
        speed = ("SetInputArrayToProcess", 0, 0, 0, 0, "speed")
        for change, code, data, blocks in (
                (speed, errno.EINVAL, cloud(), False), (speed, errno.EINVAL, blocks_of(cloud()), True),
                (("SetAngle", 200.0), errno.EINVAL, blocks_of(cloud()), True),
                (("SetInputData", vtkPolyData()), errno.EINVAL, cloud(), False),
                (("SetValue", 0, float("nan")), errno.EINVAL, cloud(), False),
                (("SetValue", 0, 99.0), 0, cloud(), False)):
            for pair in PAIRS[:1 if change[0] == "SetAngle" else 2]:
                found = []
                for class_ in pair:
                    filter_ = configured(class_, data, [0.3], ContourBlocks=blocks)
                    texts = observed(filter_)
                    getattr(filter_, change[0])(*change[1:])
                    filter_.Update()
                    self.assertEqual((filter_.GetErrorCode(), len(texts["ErrorEvent"])), (code, int(code != 0)))
                    self.assertEqual(filter_.GetOutputDataObject(0).GetNumberOfElements(0), 0)
                    found.append({event: len(list_) for event, list_ in texts.items()})
                self.assertEqual(found[0], found[1])

    def test_several_processes_are_told_of_once(self):
        with mock.patch.object(_vtk_algorithm, "is_first_of_several", lambda: True):
            for class_ in (ISOPOINTS, _vtk.vtkScatteredLineFilter):
                filter_ = configured(class_, cloud(), [0.3] if class_ is ISOPOINTS else [])
                texts = observed(filter_)
                for _ in range(2):
                    filter_.Modified()
                    filter_.Update()
                self.assertEqual(len(texts["WarningEvent"]), 1)
                self.assertIn("process takes its own samples alone", texts["WarningEvent"][0])

    def test_progress_and_aborts(self):
        """Progress rises; an abort leaves nothing, and the next update is complete."""
        for class_ in (ISOPOINTS, ISOSURFACE):
            filter_ = configured(class_, cloud(100000), [0.3])
            texts, fractions = observed(filter_), []
            filter_.AddObserver("ProgressEvent", lambda caller, _: caller.SetAbortExecute(1))
            filter_.Update()
            self.assertEqual(filter_.GetOutput().GetNumberOfPoints(), 0)
            self.assertEqual((filter_.GetErrorCode(), texts["ErrorEvent"]), (0, []))
            filter_.RemoveObservers("ProgressEvent")
            filter_.SetAbortExecute(0)
            filter_.AddObserver("ProgressEvent", lambda caller, _, to=fractions: to.append(caller.GetProgress()))
            filter_.Modified()
            filter_.Update()
            self.assertGreater(filter_.GetOutput().GetNumberOfPoints(), 1000)
            self.assertEqual(fractions, sorted(fractions))
            self.assertGreater(len(fractions), 5)

    def test_pipelines(self):
        """Readers, pieces and composites that a producer makes."""
        producer = vtkTrivialProducer()
        producer.SetOutput(blocks_of(cloud(), cloud(100)))
        for pair in PAIRS[:2]:
            outputs = []
            for class_ in pair:
                filter_ = class_()
                filter_.SetInputConnection(producer.GetOutputPort())
                filter_.SetInputArrayToProcess(0, 0, 0, 0, "distance")
                filter_.GenerateValues(3, 0.2, 0.4)
                filter_.ContourBlocksOn()
                filter_.Update()
                outputs.append(filter_.GetOutputDataObject(0))
            assert_same(self, outputs[1], outputs[0])
        polygons = [class_() for class_ in PAIRS[2]]
        for filter_ in polygons:
            isopoints = configured(ISOPOINTS, cloud(), [0.3])
            filter_.SetInputConnection(isopoints.GetOutputPort())
            filter_.SetRadiusScale(0.8)
            filter_.Update()
        arrays = [[data.GetPoints().GetData(), data.GetPolys().GetConnectivityArray()] for data in (
            filter_.GetOutputDataObject(0) for filter_ in polygons)]
        for pair in zip(*arrays):
            self.assertEqual(*(vtk_to_numpy(array).astype(float).tobytes() for array in pair))


if __name__ == "__main__":
    unittest.main()
