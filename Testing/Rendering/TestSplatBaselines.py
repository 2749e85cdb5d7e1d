# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes as a user sets them up, against pictures that were looked at.

TestSplatBaselines.py FOLDER compares with the pictures in a folder and writes its own to the
working directory; look at them, and copy them there if they are better."""

import os
import sys

import numpy as np
from scenes import Scene, actor_of, check, color_by, configured, isopoints, psnr, read_image
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkRenderingCore import vtkLightKit


def gyroid(p):
    x, y, z = p.T * 1.5 * np.pi
    return np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)


def droplets(p):
    centers = np.random.default_rng(7).uniform(-0.7, 0.7, (9, 3))
    return sum(np.exp(-12 * ((p - center) ** 2).sum(1)) for center in centers) - 1.0


def gyroid_in_colors():
    actor = actor_of(isopoints(gyroid, -1, 1, 200_000), Specular=0.3, SpecularPower=40)
    color_by(actor, "x", -1, 1)
    table = configured(vtkLookupTable(), HueRange=(0.6, 0.05), SaturationRange=(0.5, 0.7), ValueRange=(0.8, 1.0))
    table.Build()
    actor.GetMapper().SetLookupTable(table)
    return Scene(actor, size=400)


def translucent_droplets():
    scene = Scene(actor_of(isopoints(droplets, -1.3, 1.3, 200_000), Opacity=0.6, Color=(0.3, 0.6, 0.9)), size=400)
    scene.peel()
    return scene


for make in (gyroid_in_colors, translucent_droplets):
    scene, name = make(), make.__name__ + ".png"
    scene.look((3, -4, 2.5), bounds=(-1, 1, -1, 1, -1, 1))
    scene.camera.Zoom(1.4)
    lights = vtkLightKit()
    lights.AddLightsToRenderer(scene.renderer)
    ratio = psnr(scene.image(name), read_image(os.path.join(sys.argv[1], name)))
    print(f"{make.__name__:22} {ratio:6.2f} dB, at least 35")
    check(ratio >= 35, name)
