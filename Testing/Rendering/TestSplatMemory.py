# SPDX-License-Identifier: GPL-3.0-or-later
"""Where memory runs out, one error is reported, no splat is rendered, and the program continues. To
be run with the library of LimitedMemory.cxx preloaded."""

import ctypes

import numpy as np
from scenes import Scene, actor_of, check, color_by, differs, polydata
from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkRenderingCore import vtkHardwareSelector

COUNT = 800_000  # so that even the indices of every second splat are large in LimitedMemory.cxx
UP = [0.0, -1.0, 1.0]  # towards the scene's camera


def splats(count):
    """Splats of which some 1000 are drawn, which takes less time; the others have no radius."""
    random = np.random.default_rng(1)
    points = random.uniform(-1.0, 1.0, (count, 3)).astype(np.float32)
    vectors = np.tile(np.array([[0.01, 0.0, 0.0]], np.float32), (count, 1))
    data = polydata(
        points,
        np.tile(np.array([UP], np.float32), (count, 1)),
        Radius=np.where(np.arange(count) % (count // 1000) == 0, 0.02, 0.0).astype(np.float32),
        SplatAxis1=vectors,
        SplatAxis2=vectors[:, [1, 0, 2]],
        SplatClip=np.tile(np.array([[1.0, 0.0, 0.0, 0.001]], np.float32), (count, 1)),
        value=points[:, 0].copy(),
    )
    data.GetCellData().AddArray(data.GetPointData().GetArray("value"))
    of_field = vtkFloatArray()
    of_field.SetName("value")
    of_field.InsertNextValue(0.5)
    data.GetFieldData().AddArray(of_field)
    return data


class LimitedMemory:
    """Limits the sum of large allocations, in bytes, in a block of statements."""

    program = ctypes.CDLL(None)

    def __init__(self, size):
        self.size = size

    def __enter__(self):
        self.program.limitMemory(ctypes.c_size_t(self.size))

    def __exit__(self, *_):
        self.program.unlimitMemory()


def plain(mapper):
    mapper.ScalarVisibilityOff()
    mapper.SetStride(1)
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SetInterpolateScalarsBeforeMapping(False)


def colors(mapper):
    mapper.ScalarVisibilityOn()


def color_map(mapper):
    mapper.ScalarVisibilityOn()
    mapper.SetInterpolateScalarsBeforeMapping(True)


def colors_of_cells(mapper):
    mapper.ScalarVisibilityOn()
    mapper.SetScalarModeToUseCellFieldData()


def color_of_field(mapper):
    mapper.ScalarVisibilityOn()
    mapper.SetScalarModeToUseFieldData()
    mapper.SetFieldDataTupleId(0)


def every_second(mapper):
    mapper.SetStride(2)


class Subject:
    """A mapper in a scene that has drawn a few splats, and the errors that it reports."""

    def __init__(self, few):
        self.few = few
        self.actor = actor_of(few)
        self.mapper = self.actor.GetMapper()
        color_by(self.actor, "value", -1.0, 1.0)
        plain(self.mapper)
        self.errors = 0
        self.mapper.AddObserver("ErrorEvent", self.count)
        self.scene = Scene(self.actor, size=60)
        self.picture = self.scene.image()
        check(differs(self.picture).any(), "few splats are drawn")

    def count(self, *_):
        self.errors += 1

    def set_input(self, data):
        data.Modified()
        self.mapper.SetInputDataObject(data)
        self.errors = 0

    def draws(self):
        return bool(differs(self.scene.image()).any())

    def draws_all_or_nothing(self, limit):
        """Renders two frames with limited memory and returns whether it sufficed."""
        with LimitedMemory(limit):
            drawn = [self.draws() for _ in range(2)]
        if not self.errors:
            check(drawn == [True, True], f"drawn with {limit} bytes")
            return True
        check(self.errors == 1, f"{self.errors} errors in two frames with {limit} bytes")
        check(drawn == [False, False], f"nothing is drawn with {limit} bytes")
        plain(self.mapper)
        self.mapper.SetInputDataObject(self.few)
        check(np.array_equal(self.scene.image(), self.picture), "few splats afterwards")
        return False


def more_memory_each_time(step):
    """Increasing limits, at which one array after the other fails."""
    for i in range(100):
        yield i * step
    check(False, "enough memory at last")


def fills_buffers_or_draws_nothing(many, few):
    subject = Subject(few)
    for limit in more_memory_each_time(8 * COUNT):
        subject.set_input(many)
        if subject.draws_all_or_nothing(limit):
            break
    print(f"  {limit} bytes suffice", flush=True)
    check(limit > 60 * COUNT, "several arrays failed")


def draws_as_asked_or_nothing(many, few):
    """Changes of a property of splats that have been rendered before."""
    for prepare in (colors, color_map, colors_of_cells, color_of_field, every_second):
        subject = Subject(few)
        prepare(subject.mapper)
        check(subject.draws(), "few splats so, with the memory for their shaders")
        plain(subject.mapper)
        for limit in more_memory_each_time(4 * COUNT):
            subject.set_input(many)
            check(subject.draws(), "many splats are drawn")
            prepare(subject.mapper)
            if subject.draws_all_or_nothing(limit):
                break
        print(f"  {prepare.__name__}: {limit} bytes suffice", flush=True)
        check(limit > 2 * COUNT, "arrays failed")


def draws_as_soon_as_there_is_memory(many, few):
    subject = Subject(few)
    subject.set_input(many)
    with LimitedMemory(COUNT):
        check(not subject.draws(), "nothing is drawn")
    check(subject.draws() and subject.errors == 1, "the same input, later")
    colors(subject.mapper)
    with LimitedMemory(COUNT):
        check(not subject.draws(), "nothing is drawn in colors")
    check(subject.errors == 2, f"an error for each time that memory lacks, not {subject.errors}")


def selects_cells_or_nothing(many, few):
    subject = Subject(few)
    subject.set_input(many)
    check(subject.draws(), "many splats are drawn")
    selector = vtkHardwareSelector()
    selector.SetRenderer(subject.scene.renderer)
    selector.SetFieldAssociation(vtkDataObject.FIELD_ASSOCIATION_CELLS)
    selector.SetArea(30, 30, 30, 30)
    with LimitedMemory(COUNT):
        found = selector.Select()
    check(found is None or found.GetNumberOfNodes() == 0, "nothing is selected")
    check(subject.errors == 1, f"one error, not {subject.errors}")
    check(selector.Select().GetNumberOfNodes() == 1, "a cell, later")


if __name__ == "__main__":
    many_splats, few_splats = splats(COUNT), splats(1000)
    for test in (
        fills_buffers_or_draws_nothing,
        draws_as_asked_or_nothing,
        draws_as_soon_as_there_is_memory,
        selects_cells_or_nothing,
    ):
        print(test.__name__, flush=True)
        test(many_splats, few_splats)
