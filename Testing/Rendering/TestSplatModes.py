# SPDX-License-Identifier: GPL-3.0-or-later
"""Splats against a mesh of the same surface, rendered in the same process, in the ways to render that
depend on the normals, arrays, depths, order and places of their triangles."""

import sys

import numpy as np
from scenes import (
    Scene,
    actor_of,
    check,
    color_by,
    differs,
    psnr,
    subset,
    torus_mesh,
    torus_splats,
)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPlane
from vtkmodules.vtkFiltersSources import vtkCubeSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper

LOOKING_AT_BOTH_SIDES = vtkPlane()
LOOKING_AT_BOTH_SIDES.SetOrigin(0, 0, 0.1)
LOOKING_AT_BOTH_SIDES.SetNormal(0.5, 0.5, -1)


def box(center, size, color=(1, 1, 1)):
    source = vtkCubeSource()
    source.SetCenter(*center)
    source.SetXLength(size[0])
    source.SetYLength(size[1])
    source.SetZLength(size[2])
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*color)
    return actor


def plain(scene, actor):
    pass


def colored(scene, actor):
    color_by(actor, "x", -1.4, 1.4)


def color_map(scene, actor):
    color_by(actor, "x", -1.4, 1.4)
    actor.GetMapper().InterpolateScalarsBeforeMappingOn()


def light_kit(scene, actor):
    scene.renderer.AutomaticLightCreationOff()
    for position, intensity in (((5, 5, 9), 0.7), ((-5, 3, 0), 0.4), ((0, -9, -2), 0.5)):
        light = vtkLight()
        light.SetPosition(*position)
        light.SetIntensity(intensity)
        scene.renderer.AddLight(light)


def physically_based(scene, actor):
    light_kit(scene, actor)
    actor.GetProperty().SetInterpolationToPBR()
    actor.GetProperty().SetMetallic(0.4)
    actor.GetProperty().SetRoughness(0.4)
    actor.GetProperty().SetCoatStrength(0.3)


def ambient_occlusion(scene, actor):
    scene.renderer.AddActor(box((0, 0, -0.45), (3, 3, 0.1)))
    scene.renderer.UseSSAOOn()
    scene.renderer.SetSSAORadius(0.5)
    scene.renderer.SetSSAOBias(0.01)
    scene.renderer.SSAOBlurOn()


def transformed(scene, actor):
    actor.SetScale(0.9, 0.6, 0.4)
    actor.RotateX(40)
    actor.SetPosition(0.1, 0.2, 0.3)


def clipped(scene, actor):
    actor.GetMapper().AddClippingPlane(LOOKING_AT_BOTH_SIDES)


def back_culled(scene, actor):
    clipped(scene, actor)
    actor.GetProperty().BackfaceCullingOn()


def composite(scene, actor):
    mapper = actor.GetMapper()
    if mapper.IsA("vtkIsopointSplatMapper"):
        isopoints = mapper.GetPolygons().GetInputDataObject(0, 0)
        left = vtk_to_numpy(isopoints.GetPoints().GetData())[:, 0] < 0
        blocks = vtkMultiBlockDataSet()
        for i, chosen in enumerate((left, ~left)):
            blocks.SetBlock(2 * i, subset(isopoints, chosen))
        mapper.SetInputDataObject(blocks)


def far_from_the_origin(scene, actor):
    """Floats are 8 apart there, the torus is as large as a third of that."""
    mapper = actor.GetMapper()
    is_splats = mapper.IsA("vtkIsopointSplatMapper")
    data = (mapper.GetPolygons() if is_splats else mapper).GetInputDataObject(0, 0)
    moved = data.NewInstance()
    moved.DeepCopy(data)
    offset = 1e8
    doubles = vtkPoints()
    doubles.SetDataTypeToDouble()
    doubles.SetData(
        numpy_to_vtk(vtk_to_numpy(moved.GetPoints().GetData()).astype(float) + offset, deep=True)
    )
    moved.SetPoints(doubles)
    mapper.SetInputDataObject(moved)
    mapper.SetVBOShiftScaleMethod(1)
    scene.camera.SetPosition(offset, offset - 3, offset + 3)
    scene.camera.SetFocalPoint(offset, offset, offset)
    scene.renderer.ResetCamera(
        offset - 1.4, offset + 1.4, offset - 1.4, offset + 1.4, offset - 0.4, offset + 0.4
    )


# The least ratio in decibels of each, with multisampling and without.
MODES = {
    plain: 48,
    colored: 48,
    color_map: 48,
    light_kit: 44,
    physically_based: 44,
    ambient_occlusion: 44,
    transformed: 44,
    clipped: 44,
    back_culled: 44,
    composite: 44,
    far_from_the_origin: 44,
}

# What must change the picture to be tested at all.
NOT_DIFFERENT = {plain, composite, far_from_the_origin}


# Of a window as VTK makes it, and of one without multisampling.
SAMPLES = (8, 0)


def picture(data, splats, mode, samples):
    actor = actor_of(data, splats)
    scene = Scene(actor, samples=samples)
    mode(scene, actor)
    image = scene.image()
    scene.save(f"{mode.__name__}_{'splats' if splats else 'mesh'}_{samples}.png")
    return image


def main(chosen):
    splats, mesh = torus_splats(), torus_mesh()
    check(abs(splats.GetNumberOfPoints() - 40_000) < 2_000, "about 40,000 isopoints")
    failed = []
    for samples in SAMPLES:
        reference = picture(mesh, False, plain, samples)
        for mode, least in MODES.items():
            if chosen and mode.__name__ not in chosen:
                continue
            name = f"{mode.__name__} with {samples} samples"
            truth = picture(mesh, False, mode, samples)
            ratio = psnr(truth, picture(splats, True, mode, samples))
            print(f"{name:35} {ratio:6.2f} dB, at least {least}", flush=True)
            if not differs(truth).any():
                failed.append(name + " shows nothing")
            if mode not in NOT_DIFFERENT and np.array_equal(truth, reference):
                failed.append(name + " changes nothing")
            if not ratio >= least:
                failed.append(name)
    check(not failed, ", ".join(failed))


if __name__ == "__main__":
    main(sys.argv[1:])
