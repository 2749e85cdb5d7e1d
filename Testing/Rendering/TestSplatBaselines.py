# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes as a user sets them up, against pictures that were looked at.

TestSplatBaselines.py FOLDER compares with the pictures in a folder and writes its own to the
working directory; look at them, and copy them there if they are better."""

import os
import sys

import numpy as np
from scenes import Scene, actor_of, check, color_by, isopoints, psnr, read_image
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkRenderingCore import vtkLightKit


def gyroid(p):
    x, y, z = p.T * 1.5 * np.pi
    return np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)


def droplets(p):
    random = np.random.default_rng(7)
    value = -1.0
    for center in random.uniform(-0.7, 0.7, (9, 3)):
        value = value + np.exp(-12 * ((p - center) ** 2).sum(1))
    return value


def look(scene):
    scene.camera.SetPosition(3, -4, 2.5)
    scene.camera.SetViewUp(0, 0, 1)
    scene.renderer.ResetCamera(-1, 1, -1, 1, -1, 1)
    scene.camera.Zoom(1.4)
    lights = vtkLightKit()
    lights.AddLightsToRenderer(scene.renderer)


def gyroid_in_colors():
    actor = actor_of(isopoints(gyroid, [-1] * 3, [1] * 3, 200_000))
    color_by(actor, "x", -1, 1)
    table = vtkLookupTable()
    table.SetHueRange(0.6, 0.05)
    table.SetSaturationRange(0.5, 0.7)
    table.SetValueRange(0.8, 1.0)
    table.Build()
    actor.GetMapper().SetLookupTable(table)
    actor.GetProperty().SetSpecular(0.3)
    actor.GetProperty().SetSpecularPower(40)
    return Scene(actor, size=400)


def translucent_droplets():
    actor = actor_of(isopoints(droplets, [-1.3] * 3, [1.3] * 3, 200_000))
    actor.GetProperty().SetOpacity(0.6)
    actor.GetProperty().SetColor(0.3, 0.6, 0.9)
    scene = Scene(actor, size=400)
    scene.window.SetAlphaBitPlanes(1)
    scene.renderer.UseDepthPeelingOn()
    return scene


def main(folder):
    for make in (gyroid_in_colors, translucent_droplets):
        scene = make()
        look(scene)
        image = scene.image()
        name = make.__name__ + ".png"
        scene.save(name)
        ratio = psnr(image, read_image(os.path.join(folder, name)))
        print(f"{make.__name__:22} {ratio:6.2f} dB, at least 35")
        check(ratio >= 35, name)


if __name__ == "__main__":
    main(sys.argv[1])
