# SPDX-License-Identifier: GPL-3.0-or-later
"""Ray-traced isopoints of a sphere against the true sphere, as matte surface, mirror and glass; the
same picture for any number of threads, frames and units of length; windows, aborts and scenes with
nothing to see."""

import numpy as np
from scatteredisopoints import contour, vtkIsopointRayTracer, vtkIsopointSplatMapper
from scenes import check, polydata, psnr
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersSources import vtkLineSource, vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkHardwareSelector,
    vtkLight,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkWindowToImageFilter,
)

WIDTH, HEIGHT = 320, 240


def sphere_of_splats(samples=300_000):
    positions = np.random.default_rng(1).uniform(-1.2, 1.2, (samples, 3))
    return contour(positions, np.linalg.norm(positions, axis=1), 1.0).polydata


def true_sphere():
    """Triangles whose corners, with their normals, are within 3e-6 of the sphere."""
    source = vtkSphereSource()
    source.SetRadius(1.0)
    source.SetThetaResolution(1600)
    source.SetPhiResolution(800)
    source.Update()
    return source.GetOutput()


def actor_of(data, material="matte", position=(0.0, 0.0, 0.0), scale=1.0):
    has_cells = data.GetNumberOfPolys() + data.GetNumberOfLines() > 0
    mapper = vtkPolyDataMapper() if has_cells else vtkIsopointSplatMapper()
    mapper.SetInputData(data)
    mapper.SetScalarVisibility(data.GetCellData().GetScalars() is not None)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.SetPosition(*position)
    actor.SetScale(scale)
    material_of = actor.GetProperty()
    material_of.SetColor(0.9, 0.7, 0.3)
    if material != "matte":
        material_of.SetInterpolationToPBR()
        material_of.SetRoughness(0.0)
        material_of.SetMetallic(1.0 if material == "mirror" else 0.0)
        material_of.SetOpacity(0.0 if material == "glass" else 1.0)
    return actor


def tiles():
    source = vtkPlaneSource()
    source.SetOrigin(-4, -4, -1)
    source.SetPoint1(4, -4, -1)
    source.SetPoint2(-4, 4, -1)
    source.SetResolution(12, 12)
    source.Update()
    data = source.GetOutput()
    row, column = np.divmod(np.arange(144), 12)
    colors = np.array([[230, 230, 230], [90, 110, 140]], np.uint8)[(row + column) % 2]
    data.GetCellData().SetScalars(numpy_to_vtk(colors, deep=True))
    return data


def renderer_of(*actors, center=(0.0, 0.0, 0.0), scale=1.0):
    renderer = vtkRenderer()
    for actor in actors:
        renderer.AddActor(actor)
    renderer.SetBackground(0.9, 0.95, 1.0)
    renderer.SetBackground2(0.2, 0.4, 0.8)
    renderer.GradientBackgroundOn()
    light = vtkLight()
    light.SetPosition(*(np.array(center) + scale * np.array([-3.0, -4.0, 6.0])))
    light.SetFocalPoint(*center)
    renderer.AddLight(light)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(*(np.array(center) + scale * np.array([0.0, -5.0, 1.2])))
    camera.SetFocalPoint(*center)
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCameraClippingRange()
    return renderer


def tracer_of(**properties):
    tracer = vtkIsopointRayTracer()
    tracer.SetSamplesPerPixel(8)
    for name, value in properties.items():
        getattr(tracer, "Set" + name)(value)
    return tracer


def traced(renderer, tracer=None, width=WIDTH, height=HEIGHT):
    image = vtkImageData()
    tracer = tracer or tracer_of()
    check(tracer.RenderToImage(renderer, width, height, image), "there is a picture")
    return pixels_of(image)


def pixels_of(image):
    columns, rows, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars())
    return pixels.reshape(rows, columns, -1)[..., :3].astype(int)


def window_of(renderer, tracer):
    renderer.SetPass(tracer)
    window = vtkRenderWindow()
    window.SetMultiSamples(0)
    window.SetOffScreenRendering(True)
    window.SetSize(WIDTH, HEIGHT)
    window.AddRenderer(renderer)
    return window


def frame_of(window):
    grabber = vtkWindowToImageFilter()
    grabber.SetInput(window)
    grabber.ReadFrontBufferOff()
    grabber.Update()
    return pixels_of(grabber.GetOutput())


SPLATS = sphere_of_splats()
ROUNDING = 2  # levels of 255 between a picture and the window that Mesa draws it in (1 before Mesa 25)


def is_like_the_true_sphere():
    mesh = true_sphere()
    for material, bar in (("matte", 51.0), ("mirror", 48.0), ("glass", 41.0)):
        pictures = [
            traced(renderer_of(actor_of(data, material), actor_of(tiles())))
            for data in (SPLATS, mesh)
        ]
        quality = psnr(*pictures)
        print(f"{material}: {quality:.1f} dB")
        check(quality >= bar, f"{material}: {quality:.1f} dB, below {bar}")
        colors = pictures[0][100:140, 140:180].reshape(-1, 3).std(axis=0).max()
        check(colors > 1.0, f"{material}: the sphere is seen")


def is_the_same_on_any_threads():
    renderer = renderer_of(actor_of(SPLATS, "glass"), actor_of(tiles()))
    pictures = [
        traced(renderer, tracer_of(NumberOfThreads=n, SamplesPerPixel=3, AmbientLight=0.2))
        for n in (1, 2, 3)
    ]
    for picture in pictures[1:]:
        check(np.array_equal(picture, pictures[0]), "the same bytes with other threads")


def is_the_same_in_any_unit():
    expected = traced(renderer_of(actor_of(SPLATS, "mirror"), actor_of(tiles())))
    for scale, center in ((1e-9, (0.0, 0.0, 0.0)), (1e20, (0.0, 0.0, 0.0)), (1.0, (1e6, -2e6, 3e6))):
        actors = [actor_of(data, kind, center, scale)
                  for data, kind in ((SPLATS, "mirror"), (tiles(), "matte"))]
        quality = psnr(traced(renderer_of(*actors, center=center, scale=scale)), expected)
        check(quality > 40, f"scaled by {scale}, around {center}: {quality:.1f} dB")


def is_progressive():
    whole = window_of(renderer_of(actor_of(SPLATS, "mirror"), actor_of(tiles())),
                      tracer_of(SamplesPerPixel=6))
    whole.Render()
    expected = frame_of(whole)
    tracer = tracer_of(SamplesPerPixel=6, SamplesPerFrame=2)
    window = window_of(renderer_of(actor_of(SPLATS, "mirror"), actor_of(tiles())), tracer)
    for samples in (2, 4, 6, 6):
        window.Render()
        check(tracer.GetNumberOfSamples() == samples, f"{samples} samples")
    grabbed = vtkImageData()
    check(tracer.RenderToImage(list(window.GetRenderers())[0], WIDTH, HEIGHT, grabbed), "a picture")
    check(np.abs(pixels_of(grabbed) - expected).max() <= ROUNDING, "a picture as in the window")
    check(np.array_equal(frame_of(window), expected), "as many frames as one")
    check(tracer.GetNumberOfSamples() == 6, "a grabbed picture has all samples")
    list(window.GetRenderers())[0].GetActiveCamera().Azimuth(5)
    window.Render()
    check(tracer.GetNumberOfSamples() == 2, "another camera begins again")


def is_drawn_in_windows():
    """As the picture; what is not traced is hidden by what is, and hides what is behind it."""
    sphere, floor = actor_of(SPLATS), actor_of(tiles())
    renderer = renderer_of(sphere, floor)
    expected = traced(renderer, tracer_of())
    window = window_of(renderer, tracer_of())
    window.Render()
    frame = frame_of(window)
    check(np.abs(frame - expected).max() <= ROUNDING, "the window shows the picture")
    for y, is_seen in ((-1.5, True), (1.5, False)):
        line = vtkLineSource()
        line.SetPoint1(-0.5, y, 0.0)
        line.SetPoint2(0.5, y, 0.0)
        line.Update()
        actor = actor_of(line.GetOutput())
        actor.GetProperty().SetLineWidth(3)
        actor.GetProperty().SetColor(0, 1, 0)
        actor.GetProperty().LightingOff()
        with_line = frame_of(window_of(renderer_of(sphere, floor, actor), tracer_of()))
        green = np.all(with_line == [0, 255, 0], axis=2).any()
        check(green == is_seen, f"a line at {y} is {'seen' if is_seen else 'hidden'}")


def can_be_selected_from():
    sphere, floor = actor_of(SPLATS), actor_of(tiles())
    renderer = renderer_of(sphere, floor)
    window = window_of(renderer, tracer_of(SamplesPerPixel=1))
    window.Render()
    selector = vtkHardwareSelector()
    selector.SetRenderer(renderer)
    for x, y, expected in ((WIDTH // 2, HEIGHT // 2, sphere), (WIDTH // 2, 8, floor)):
        selector.SetArea(x, y, x, y)
        node = selector.Select().GetNode(0)
        check(node.GetProperties().Get(node.PROP()) is expected, "the actor at a pixel is selected")


def can_be_aborted():
    renderer = renderer_of(actor_of(SPLATS, "glass"), actor_of(tiles()))
    tracer = tracer_of(SamplesPerPixel=4000)
    shares = []

    def stop(caller, _event):
        shares.append(caller.GetNumberOfSamples())
        caller.AbortExecuteOn()

    observer = tracer.AddObserver("ProgressEvent", stop)
    check(not tracer.RenderToImage(renderer, WIDTH, HEIGHT, vtkImageData()), "no picture")
    check(len(shares) == 1, "it ends at once")
    tracer.RemoveObserver(observer)
    tracer.SetSamplesPerPixel(8)
    check(np.array_equal(traced(renderer, tracer), traced(renderer)), "and works again")


def has_clear_results_of_nothing():
    background = traced(renderer_of())
    empty = vtkPolyData()
    check(np.array_equal(traced(renderer_of(actor_of(empty))), background), "no points")
    up = [[0.0, -1.0, 0.0]]
    for name, data in {
        "a radius of zero": polydata([[0, 0, 0]], up, Radius=np.zeros(1)),
        "a negative radius": polydata([[0, 0, 0]], up, Radius=-np.ones(1)),
        "a radius that is no number": polydata([[0, 0, 0]], up, Radius=np.full(1, np.nan)),
        "a point that is no number": polydata([[np.nan, 0, 0]], up, Radius=np.ones(1)),
    }.items():
        check(np.array_equal(traced(renderer_of(actor_of(data))), background), name)
    flattened = actor_of(SPLATS)
    flattened.SetScale(1, 0, 1)
    check(np.array_equal(traced(renderer_of(flattened)), background), "no extent")
    dark = renderer_of(actor_of(SPLATS))
    dark.RemoveAllLights()
    dark.AutomaticLightCreationOff()
    check(np.all(traced(dark)[HEIGHT // 2, WIDTH // 2] == 0), "without lights a matte sphere is black")
    check(traced(dark, tracer_of(AmbientLight=0.5))[HEIGHT // 2, WIDTH // 2, 0] > 50, "or ambient")


is_like_the_true_sphere()
is_the_same_on_any_threads()
is_the_same_in_any_unit()
is_progressive()
is_drawn_in_windows()
can_be_selected_from()
can_be_aborted()
has_clear_results_of_nothing()
