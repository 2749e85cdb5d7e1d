# SPDX-License-Identifier: GPL-3.0-or-later
"""Ray-traced isopoints of a sphere against the true sphere, as matte surface, mirror and glass; the
same picture for any number of threads, frames and units of length; windows, aborts and scenes with
nothing to see."""

import numpy as np
import scenes
from scatteredisopoints import contour, vtkIsopointRayTracer
from scenes import Scene, as_array, check, configured, output_of, polydata, psnr, run, sphere_mesh
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersSources import vtkLineSource, vtkPlaneSource
from vtkmodules.vtkRenderingCore import vtkHardwareSelector, vtkLight, vtkRenderer

WIDTH, HEIGHT = 320, 240
ROUNDING = 2  # levels of 255 between a picture and the window that Mesa draws it in (1 before Mesa 25)
POSITIONS = np.random.default_rng(1).uniform(-1.2, 1.2, (300_000, 3))
SPLATS = contour(POSITIONS, np.linalg.norm(POSITIONS, axis=1), 1.0).polydata
MATERIALS = {"matte": {}, "mirror": dict(Metallic=1.0), "glass": dict(Metallic=0.0, Opacity=0.0)}


def actor_of(data, material="matte", **properties):
    has_cells = data.GetNumberOfPolys() + data.GetNumberOfLines() > 0
    actor = scenes.actor_of(data, not has_cells, Color=(0.9, 0.7, 0.3), **MATERIALS[material])
    actor.GetMapper().SetScalarVisibility(data.GetCellData().GetScalars() is not None)
    if material != "matte":
        actor.GetProperty().SetInterpolationToPBR()
        actor.GetProperty().SetRoughness(0.0)
    return configured(actor, **properties)


def tiles():
    data = output_of(vtkPlaneSource(), Origin=(-4, -4, -1), Point1=(4, -4, -1), Point2=(-4, 4, -1), Resolution=(12, 12))
    row, column = np.divmod(np.arange(144), 12)
    colors = np.array([[230, 230, 230], [90, 110, 140]], np.uint8)[(row + column) % 2]
    data.GetCellData().SetScalars(numpy_to_vtk(colors, deep=True))
    return data


def renderer_of(*actors, center=(0.0, 0.0, 0.0), scale=1.0):
    renderer = configured(
        vtkRenderer(), Background=(0.9, 0.95, 1.0), Background2=(0.2, 0.4, 0.8), GradientBackground=True)
    for actor in actors:
        renderer.AddActor(actor)
    light, eye = (tuple(np.array(center) + scale * np.array(place)) for place in ([-3.0, -4.0, 6.0], [0.0, -5.0, 1.2]))
    renderer.AddLight(configured(vtkLight(), Position=light, FocalPoint=center))
    configured(renderer.GetActiveCamera(), Position=eye, FocalPoint=center, ViewUp=(0, 0, 1))
    renderer.ResetCameraClippingRange()
    return renderer


def sphere_on_tiles(material="matte", data=SPLATS, center=(0.0, 0.0, 0.0), scale=1.0):
    actors = [actor_of(*each, Position=center, Scale=scale) for each in ((data, material), (tiles(), "matte"))]
    return renderer_of(*actors, center=center, scale=scale)


def traced(renderer, **properties):
    return scenes.traced(renderer, WIDTH, HEIGHT, **{"SamplesPerPixel": 8, **properties})


def window_of(renderer, **properties):
    """A scene whose renderer is traced, and the tracer."""
    tracer = configured(vtkIsopointRayTracer(), **{"SamplesPerPixel": 8, **properties})
    scene = Scene()
    scene.window.RemoveRenderer(scene.renderer)
    scene.renderer = configured(renderer, Pass=tracer)
    scene.window.AddRenderer(renderer)
    scene.window.SetSize(WIDTH, HEIGHT)
    return scene, tracer


def is_like_the_true_sphere():
    mesh = sphere_mesh(1600, 800, Radius=1.0)  # within 3e-6 of it
    for material, bar in (("matte", 51.0), ("mirror", 48.0), ("glass", 41.0)):
        pictures = [traced(sphere_on_tiles(material, data)) for data in (SPLATS, mesh)]
        quality = psnr(*pictures)
        print(f"{material}: {quality:.1f} dB")
        check(quality >= bar, f"{material}: {quality:.1f} dB, below {bar}")
        check(pictures[0][100:140, 140:180].reshape(-1, 3).std(axis=0).max() > 1.0, f"{material}: the sphere is seen")


def is_the_same_on_any_threads():
    renderer = sphere_on_tiles("glass")
    pictures = [traced(renderer, NumberOfThreads=n, SamplesPerPixel=3, AmbientLight=0.2) for n in (1, 2, 3)]
    for picture in pictures[1:]:
        check(np.array_equal(picture, pictures[0]), "the same bytes with other threads")


def is_the_same_in_any_unit():
    expected = traced(sphere_on_tiles("mirror"))
    for scale, center in ((1e-9, (0.0, 0.0, 0.0)), (1e20, (0.0, 0.0, 0.0)), (1.0, (1e6, -2e6, 3e6))):
        quality = psnr(traced(sphere_on_tiles("mirror", SPLATS, center, scale)), expected)
        check(quality > 40, f"scaled by {scale}, around {center}: {quality:.1f} dB")


def is_progressive():
    expected = window_of(sphere_on_tiles("mirror"), SamplesPerPixel=6)[0].image()
    scene, tracer = window_of(sphere_on_tiles("mirror"), SamplesPerPixel=6, SamplesPerFrame=2)
    for samples in (2, 4, 6, 6):
        scene.window.Render()
        check(tracer.GetNumberOfSamples() == samples, f"{samples} samples")
    grabbed = vtkImageData()
    check(tracer.RenderToImage(scene.renderer, WIDTH, HEIGHT, grabbed), "a picture")
    check(np.abs(as_array(grabbed) - expected).max() <= ROUNDING, "a picture as in the window")
    check(np.array_equal(scene.image(), expected), "as many frames as one, also after a picture")
    check(tracer.GetNumberOfSamples() == 6, "a grabbed picture has all samples")
    scene.renderer.GetActiveCamera().Azimuth(5)
    scene.window.Render()
    check(tracer.GetNumberOfSamples() == 2, "another camera begins again")


def is_drawn_in_windows():
    """Windows show the traced picture. Objects that are not traced hide, and are hidden by, those that are."""
    frame = window_of(sphere_on_tiles())[0].image()
    check(np.abs(frame - traced(sphere_on_tiles())).max() <= ROUNDING, "the window shows the picture")
    for y, is_seen in ((-1.5, True), (1.5, False)):
        line = actor_of(output_of(vtkLineSource(), Point1=(-0.5, y, 0.0), Point2=(0.5, y, 0.0)))
        configured(line.GetProperty(), LineWidth=3, Color=(0, 1, 0), Lighting=False)
        renderer = sphere_on_tiles()
        renderer.AddActor(line)
        green = np.all(window_of(renderer)[0].image() == [0, 255, 0], axis=2).any()
        check(green == is_seen, f"a line at {y} is {'seen' if is_seen else 'hidden'}")


def can_be_selected_from():
    sphere, floor = actor_of(SPLATS), actor_of(tiles())
    scene, _ = window_of(renderer_of(sphere, floor), SamplesPerPixel=1)
    scene.window.Render()
    for x, y, expected in ((WIDTH // 2, HEIGHT // 2, sphere), (WIDTH // 2, 8, floor)):
        node = configured(vtkHardwareSelector(), Renderer=scene.renderer, Area=(x, y, x, y)).Select().GetNode(0)
        check(node.GetProperties().Get(node.PROP()) is expected, "the actor at a pixel is selected")


def can_be_aborted():
    renderer = sphere_on_tiles("glass")
    tracer = configured(vtkIsopointRayTracer(), SamplesPerPixel=4000)
    shares = []

    def stop(caller, _event):
        shares.append(caller.GetNumberOfSamples())
        caller.AbortExecuteOn()

    observer = tracer.AddObserver("ProgressEvent", stop)
    image = vtkImageData()
    check(not tracer.RenderToImage(renderer, WIDTH, HEIGHT, image), "no picture")
    check(len(shares) == 1, "it ends at once")
    tracer.RemoveObserver(observer)
    tracer.SetSamplesPerPixel(8)
    check(tracer.RenderToImage(renderer, WIDTH, HEIGHT, image), "a picture")
    check(np.array_equal(as_array(image), traced(renderer)), "and works again")


def has_clear_results_of_nothing():
    background = traced(renderer_of())
    up = [[0.0, -1.0, 0.0]]
    for name, actor in {
            "no points": actor_of(vtkPolyData()), "no extent": actor_of(SPLATS, Scale=(1, 0, 1)),
            **{f"a radius of {radius}": actor_of(polydata([[0, 0, 0]], up, Radius=np.array([radius])))
               for radius in (0.0, -1.0, np.nan)},
            "a point that is no number": actor_of(polydata([[np.nan, 0, 0]], up, Radius=np.ones(1)))}.items():
        check(np.array_equal(traced(renderer_of(actor)), background), name)
    dark = renderer_of(actor_of(SPLATS))
    dark.RemoveAllLights()
    dark.AutomaticLightCreationOff()
    middle = HEIGHT // 2, WIDTH // 2
    check(np.all(traced(dark)[middle] == 0), "without lights a matte sphere is black")
    check(traced(dark, AmbientLight=0.5)[middle][0] > 50, "or ambient")


run(is_like_the_true_sphere, is_the_same_on_any_threads, is_the_same_in_any_unit, is_progressive, is_drawn_in_windows,
    can_be_selected_from, can_be_aborted, has_clear_results_of_nothing)
