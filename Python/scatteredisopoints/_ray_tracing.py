# SPDX-License-Identifier: GPL-3.0-or-later
"""Ray-traced pictures of scenes by Mitsuba: see ray_trace()."""

from __future__ import annotations

import contextlib
import math
import operator
import os
from typing import Any, Iterator, NamedTuple, Optional, Union

import numpy as np

from ._datasets import leaves
from ._progress import Progress, shown_progress
from ._writing import file_to_write

_DIAGONAL = 100.0  # of the surfaces in Mitsuba's scene, which offsets rays by about 1e-4 beside such lengths
_FAR = 100.0 * _DIAGONAL  # the distance of lights without a position
_AT_ONCE = 16  # samples of a pixel that are spread evenly over lights and directions
_LONGEST_PATH = 10  # pieces of a path
_FLAT, _PBR, _SURFACE = 0, 3, 2  # of vtkProperty


def ray_trace(
    scene: Any,
    path: Union[str, os.PathLike[str], None] = None,
    *,
    samples: int = 16,
    size: Optional[tuple[int, int]] = None,
    light_angle: float = 1.0,
    ambient_light: float = 0.3,
    progress: Progress = None,
) -> np.ndarray:
    """Traces rays through the surfaces of a scene, by Mitsuba 3 (``pip install mitsuba``).

    Surfaces are the triangles of visible actors that are drawn as surfaces, also of splats. Their ``vtkProperty`` says
    what they are made of: matte by default; with physically based rendering (PBR) metal or plastic of any roughness,
    and with an opacity of 0 glass, which refracts as its ``BaseIOR`` says. Other opacities let a share of the light
    pass. Mirrors and glass show the background.

    Parameters
    ----------
    scene
        A plotter of PyVista, a vtkRenderer, a vtkRenderWindow (its first renderer), or a render view of ParaView.
    path
        Name of a PNG file for the picture, or None.
    samples
        Paths of light through each pixel, at least 1, rounded up to a multiple of 16. More give less noise.
    size
        Width and height in pixels. None: those of the scene.
    light_angle
        The apparent size of lights in degrees, from 0.01 to 90. Larger lights cast softer shadows.
    ambient_light
        The light of the background on matte surfaces, as a share of its brightness: from 0.001 to 1.
    progress
        A function, called with the completed share; an exception in it ends the call. True: a bar by tqdm or rich.

    Returns
    -------
    numpy.ndarray
        The picture: shape (height, width, 3), of uint8, first row on top.

    Raises
    ------
    ImportError
        Without Mitsuba.
    TypeError, ValueError
        If the scene is none of these, a number is out of its range, or the path does not end with .png.
    OSError
        If the file cannot be written. An earlier one stays.
    """
    renderer, own_size = _renderer_of(scene)
    width, height = map(operator.index, own_size if size is None else size)
    if path is not None and not os.fsdecode(path).lower().endswith(".png"):
        raise ValueError(f"{path!r} names no PNG file: it must end with .png")
    for name, value, least, most in (
            ("samples", operator.index(samples), 1, 2**31), ("width", width, 1, 2**15), ("height", height, 1, 2**15),
            ("light_angle", light_angle, 0.01, 90), ("ambient_light", ambient_light, 0.001, 1)):
        if not least <= value <= most:
            raise ValueError(f"{name} is {value}: it must be from {least} to {most}")
    try:
        import mitsuba
    except ImportError:
        raise ImportError("ray_trace() needs Mitsuba: pip install mitsuba") from None
    variant = mitsuba.variant()
    mitsuba.set_variant("scalar_rgb")
    try:
        with contextlib.nullcontext() if path is None else file_to_write(os.fsdecode(path)) as target:
            picture = _traced(mitsuba, renderer, (width, height), samples, light_angle, ambient_light, progress)
            if target is not None:
                _write(mitsuba.Bitmap(picture), target, path)
        return picture
    finally:
        if variant is not None:
            mitsuba.set_variant(variant)


def _write(bitmap: Any, target: str, path: Any) -> None:
    try:
        bitmap.write(target)
    except RuntimeError:
        raise OSError(f"{path} cannot be written: is the disk full?") from None


def _renderer_of(scene: Any) -> tuple[Any, tuple[int, int]]:
    """The renderer, with lights and a camera, and the size of its picture."""
    if hasattr(scene, "window_size"):  # a plotter of PyVista
        renderer, size = scene.renderer, scene.window_size
        if not scene.camera_set:
            renderer.camera_position = renderer.get_default_cam_pos()
            renderer.ResetCamera()
    elif hasattr(scene, "StillRender"):  # a view of ParaView
        scene.StillRender()
        renderer, size = scene.GetRenderer(), scene.ViewSize
    elif hasattr(scene, "GetRenderers") and scene.GetRenderers().GetFirstRenderer():
        renderer, size = scene.GetRenderers().GetFirstRenderer(), scene.GetSize()
    elif hasattr(scene, "GetActiveCamera"):
        renderer, size = scene, scene.GetSize()
    else:
        raise TypeError(f"{scene!r} is no plotter, render view, window with a renderer, or renderer")
    if not renderer.IsActiveCameraCreated():
        renderer.ResetCamera()
    if renderer.GetLights().GetNumberOfItems() == 0 and renderer.GetAutomaticLightCreation():
        renderer.CreateLight()
    renderer.UpdateLightsGeometryToFollowCamera()
    return renderer, size


def _traced(mitsuba: Any, renderer: Any, size: tuple[int, int], samples: int, light_angle: float,
            ambient_light: float, progress: Progress) -> np.ndarray:
    frame = _frame_of(renderer)
    lights = [_environment_of(mitsuba, renderer), *_lights_of(mitsuba, renderer, frame, light_angle, ambient_light)]
    meshes = _meshes_of(mitsuba, renderer, frame, ambient_light)
    scene = mitsuba.load_dict({
        "type": "scene", "sensor": _sensor_of(mitsuba, renderer, frame, size),
        # The background is drawn behind the picture, as VTK draws it.
        "integrator": {"type": "path", "max_depth": _LONGEST_PATH, "hide_emitters": True},
        **{f"part {i}": part for i, part in enumerate([*lights, *meshes])}})
    # The brightness of a white surface by all lights: a path that meets a small one by chance would leave a speck.
    limit = max(1.0, ambient_light * sum(each.get("light", each)["sampling_weight"] for each in lights))
    passes = -(-samples // _AT_ONCE)
    total = np.zeros((size[1], size[0], 4))
    with shown_progress(progress, "Tracing rays") as report:
        for done in range(passes):
            total += np.minimum(np.array(mitsuba.render(scene, spp=_AT_ONCE, seed=done)), limit)
            if report is not None:
                report((done + 1) / passes)
    total /= passes
    background = _background_of(renderer, np.linspace(1.0, 0.0, size[1]))[:, None, :]
    picture = total[..., :3] + (1.0 - total[..., 3:]) * background
    return np.rint(255.0 * np.clip(picture, 0.0, 1.0)).astype(np.uint8)


class _Frame(NamedTuple):
    """Maps the scene to Mitsuba's, whose surfaces have the diagonal _DIAGONAL around the origin."""

    center: np.ndarray
    scale: float

    def __call__(self, points: Any) -> np.ndarray:
        return (np.asarray(points, float) - self.center) * self.scale


def _frame_of(renderer: Any) -> _Frame:
    bounds = np.reshape(renderer.ComputeVisiblePropBounds(), (3, 2))
    length = math.hypot(*np.diff(bounds)[:, 0])
    is_usable = (bounds[:, 0] <= bounds[:, 1]).all() and 0.0 < length < math.inf
    return _Frame(bounds.mean(axis=1), _DIAGONAL / length) if is_usable else _Frame(np.zeros(3), 1.0)


def _meshes_of(mitsuba: Any, renderer: Any, frame: _Frame, ambient: float) -> Iterator[Any]:
    from vtkmodules.vtkFiltersCore import vtkTriangleFilter
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter

    actors = renderer.GetActors()
    actors.InitTraversal()
    for _ in range(actors.GetNumberOfItems()):
        actor = actors.GetNextActor()
        mapper, used = actor.GetMapper(), actor.GetProperty()
        is_clear = used.GetOpacity() == 0.0 and used.GetInterpolation() != _PBR
        if mapper is None or not actor.GetVisibility() or used.GetRepresentation() != _SURFACE or is_clear:
            continue
        mapper.Update()
        for data in _blocks_of(mapper):
            surface, triangulation = vtkGeometryFilter(), vtkTriangleFilter()
            surface.SetInputData(data)
            triangulation.SetInputConnection(surface.GetOutputPort())
            triangulation.PassVertsOff()
            triangulation.PassLinesOff()
            triangulation.Update()
            if triangulation.GetOutput().GetNumberOfPolys() > 0:
                yield _mesh_of(mitsuba, actor, triangulation.GetOutput(), frame, ambient)


def _blocks_of(mapper: Any) -> Iterator[Any]:
    """The visible data sets."""
    data = mapper.GetInputDataObject(0, 0)
    hidden: set[str] = set()  # by address, since data of PyVista have no hash
    if data is not None and data.IsA("vtkCompositeDataSet"):
        attributes, nodes = mapper.GetCompositeDataDisplayAttributes(), data.NewIterator()
        if hasattr(nodes, "VisitOnlyLeavesOff"):
            nodes.VisitOnlyLeavesOff()
        nodes.InitTraversal()
        while attributes and not nodes.IsDoneWithTraversal():  # outer nodes come before those within
            node = nodes.GetCurrentDataObject()
            if attributes.HasBlockVisibility(node):
                change = hidden.difference_update if attributes.GetBlockVisibility(node) else hidden.update
                change(leaf.GetAddressAsString("") for leaf in leaves(node))
            nodes.GoToNextItem()
    for leaf in () if data is None else leaves(data):
        if leaf.IsA("vtkDataSet") and leaf.GetAddressAsString("") not in hidden:
            yield leaf


def _mesh_of(mitsuba: Any, actor: Any, data: Any, frame: _Frame, ambient: float) -> Any:
    from vtkmodules.util.numpy_support import vtk_to_numpy

    used, normals = actor.GetProperty(), data.GetPointData().GetNormals()
    matrix = np.array([[actor.GetMatrix().GetElement(i, j) for j in range(4)] for i in range(3)])
    points = frame(vtk_to_numpy(data.GetPoints().GetData()).astype(float) @ matrix[:, :3].T + matrix[:, 3])
    triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    colors, attribute = _colors_of(actor.GetMapper(), data)
    is_kept = np.isfinite(points).all(axis=1)[triangles].all(axis=1)
    triangles, points = triangles[is_kept], np.where(np.isfinite(points), points, 0.0)
    a, b, c = (points[triangles[:, i]] for i in range(3))
    outward = np.cross(b - a, c - a)
    if np.einsum("ij,ij->", a, outward) < 0.0:  # turned over: glass must be inside of its surface
        triangles, outward = triangles[:, ::-1], -outward
    if used.GetInterpolation() == _FLAT or np.linalg.det(matrix[:, :3]) == 0.0:
        normals = None
    if normals is not None:
        normals = vtk_to_numpy(normals).astype(float) @ np.linalg.inv(matrix[:, :3])
        sign = -1.0 if np.einsum("ij,ij->", outward, normals[triangles].sum(axis=1)) < 0.0 else 1.0
        normals *= sign / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
    reflectance = _rgb(_tinted(used, ambient, used.GetDiffuseColor())) if colors is None else {
        "type": "mesh_attribute", "name": attribute}
    properties = mitsuba.Properties()
    properties["bsdf"] = mitsuba.load_dict(_material_of(used, reflectance))
    mesh = mitsuba.Mesh("", len(points), len(triangles), has_vertex_normals=normals is not None, props=properties)
    if colors is not None:
        colors = colors[is_kept] if attribute == "face_color" else colors
        mesh.add_attribute(attribute, 3, np.float32(_tinted(used, ambient, colors)).ravel())
    values = mitsuba.traverse(mesh)
    values["vertex_positions"] = np.float32(points).ravel()
    values["faces"] = np.uint32(triangles).ravel()
    if normals is not None:
        values["vertex_normals"] = np.float32(normals).ravel()
    values.update()
    return mesh


def _colors_of(mapper: Any, mesh: Any) -> tuple[Optional[np.ndarray], str]:
    """As the mapper maps scalars."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import reference

    copy = mapper.NewInstance()  # since mapping stores its result in the mapper
    copy.ShallowCopy(mapper)
    copy.SetInterpolateScalarsBeforeMapping(False)
    source = reference(0)
    mapped = copy.MapScalars(mesh, 1.0, source)
    is_used = mapper.GetScalarVisibility() and mapped is not None and source != 2  # which are field data
    colors = vtk_to_numpy(mapped)[:, :3] / 255.0 if is_used else None
    return colors, "face_color" if source else "vertex_color"


def _sensor_of(mitsuba: Any, renderer: Any, frame: _Frame, size: tuple[int, int]) -> dict[str, Any]:
    camera = renderer.GetActiveCamera()
    transform = mitsuba.ScalarTransform4f().look_at(
        list(frame(camera.GetPosition())), list(frame(camera.GetFocalPoint())), list(_view_axes(camera)[1]))
    projection = {"type": "perspective", "fov": camera.GetViewAngle(),
                  "fov_axis": "x" if camera.GetUseHorizontalViewAngle() else "y"}
    if camera.GetParallelProjection():
        half = camera.GetParallelScale() * frame.scale * size[0] / size[1]
        projection = {"type": "orthographic"}
        transform = transform @ mitsuba.ScalarTransform4f().scale([half, half, 1.0])
    return {
        **projection, "to_world": transform, "far_clip": 10.0 * _FAR,
        "near_clip": max(camera.GetClippingRange()[0] * frame.scale, 1e-3),
        "sampler": {"type": "multijitter", "sample_count": _AT_ONCE},
        "film": {"type": "hdrfilm", "width": size[0], "height": size[1], "pixel_format": "rgba",
                 "rfilter": {"type": "box"}}}


def _view_axes(camera: Any) -> np.ndarray:
    """The directions to the right, up and back in the scene."""
    matrix = camera.GetViewTransformMatrix()
    return np.array([[matrix.GetElement(i, j) for j in range(3)] for i in range(3)])


def _background_of(renderer: Any, heights: np.ndarray) -> np.ndarray:
    """Colors at heights from 0, the bottom of the picture, to 1."""
    bottom = np.array(renderer.GetBackground())
    top = np.array(renderer.GetBackground2()) if renderer.GetGradientBackground() else bottom
    return bottom + heights[:, None] * (top - bottom)


def _environment_of(mitsuba: Any, renderer: Any) -> dict[str, Any]:
    """The background all around: what mirrors and glass show."""
    rows = _background_of(renderer, np.linspace(1.0, 0.0, 65)).astype(np.float32)
    axes = np.eye(4)
    axes[:3, :3] = _view_axes(renderer.GetActiveCamera()).T
    return {"type": "envmap", "sampling_weight": float(max(rows.mean(axis=0).max(), 0.01)),
            "bitmap": mitsuba.Bitmap(np.repeat(rows[:, None], 4, axis=1).copy()),
            "to_world": mitsuba.ScalarTransform4f(axes)}


def _lights_of(mitsuba: Any, renderer: Any, frame: _Frame, angle: float, ambient: float) -> Iterator[dict[str, Any]]:
    """Those of VTK: one of intensity 1 gives a matte surface of the color c that faces it the brightness c. Lights with
    a position do so at their focal point."""
    lights = renderer.GetLights()
    lights.InitTraversal()
    extent = math.tan(0.5 * math.radians(angle))
    for _ in range(lights.GetNumberOfItems()):
        light = lights.GetNextItem()
        color = np.array(light.GetDiffuseColor()) * light.GetIntensity() / ambient  # see _tinted()
        position, target = frame(light.GetTransformedPosition()), frame(light.GetTransformedFocalPoint())
        distance = float(np.linalg.norm(position - target))
        if not light.GetSwitch() or not color.max() > 0.0 or distance == 0.0:
            continue
        back, weight = (position - target) / distance, float(color.max())
        if not light.GetPositional():
            position, target, distance = back * _FAR, np.zeros(3), _FAR
        transform = mitsuba.ScalarTransform4f().look_at(
            list(position), list(target), [1.0, 0.0, 0.0] if abs(back[0]) < 0.7 else [0.0, 1.0, 0.0])
        if light.GetPositional() and light.GetConeAngle() < 90.0:
            yield {"type": "spot", "to_world": transform, "intensity": _rgb(math.pi * distance**2 * color),
                   "cutoff_angle": light.GetConeAngle(), "sampling_weight": weight}
        else:
            yield {"type": "sphere" if light.GetPositional() else "disk",
                   "to_world": transform @ mitsuba.ScalarTransform4f().scale(distance * extent),
                   "light": {"type": "area", "radiance": _rgb(color / extent**2), "sampling_weight": weight}}


def _tinted(used: Any, ambient: float, colors: Any) -> np.ndarray:
    """The colors of a material from those of a property.

    Matte surfaces are darker by the factor `ambient`, and lights brighter by its inverse. So the background, which
    mirrors and glass show as bright as it is, gives matte surfaces only that share of its light.
    """
    colors = np.asarray(colors, float)
    if used.GetInterpolation() != _PBR:
        return ambient * used.GetDiffuse() * colors
    if used.GetOpacity() == 0.0:
        return np.sqrt(colors)  # light passes the surface twice
    return (used.GetMetallic() + (1.0 - used.GetMetallic()) * ambient) * colors


def _material_of(used: Any, color: dict[str, Any]) -> dict[str, Any]:
    roughness, opacity = used.GetRoughness(), used.GetOpacity()
    if used.GetInterpolation() != _PBR:
        material = {"type": "diffuse", "reflectance": color}
    elif opacity == 0.0:
        rough = {"type": "roughdielectric", "alpha": max(roughness**2, 1e-3)} if roughness > 0.0 else {}
        return {"type": "dielectric", "int_ior": used.GetBaseIOR(), "specular_transmittance": color, **rough}
    elif used.GetMetallic() == 1.0 and roughness == 0.0:
        material = {"type": "conductor", "material": "none", "specular_reflectance": color}
    else:
        material = {"type": "principled", "base_color": color, "metallic": used.GetMetallic(), "roughness": roughness,
                    "eta": max(used.GetBaseIOR(), 1.001)}
    material = {"type": "twosided", "material": material}
    return material if opacity == 1.0 else {"type": "mask", "opacity": opacity, "material": material}


def _rgb(color: Any) -> dict[str, Any]:
    return {"type": "rgb", "value": [float(each) for each in color]}
