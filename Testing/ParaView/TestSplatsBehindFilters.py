# SPDX-License-Identifier: GPL-3.0-or-later
"""What filters leave of isopoints is drawn as splats too, unless it became a mesh."""

import sys

import numpy as np
from paraview import simple

from scripting import check, covered, look, make_view, pixels

RADIUS = 7.3


def ball():
    image = simple.Wavelet(WholeExtent=[-10, 10] * 3)
    distance = simple.Calculator(Input=image, ResultArrayName="r", Function="mag(coords)")
    distance.UpdatePipeline()
    return simple.ScatteredIsopoints(
        Input=distance, ContourBy=["POINTS", "r"], Isosurfaces=[RADIUS])


def picture(view, source):
    display = simple.Show(source, view)
    kind = str(display.Representation).strip("'")
    simple.ColorBy(display, None)
    display.DiffuseColor = display.AmbientColor = [1.0, 1.0, 0.0]
    image = pixels(view)
    simple.Hide(source, view)
    return kind, image


def is_drawn(image):
    """The share of the ball's left and right half that is drawn, and how much more light its upper
    half has than the lower one."""
    seen = covered(image)
    half = np.pi * (150 * RADIUS / 10.0) ** 2 / 2
    left, right = seen[:, :150].sum() / half, seen[:, 150:].sum() / half
    upper, lower = image[200, 120:180, 0].mean(), image[100, 120:180, 0].mean()
    return left, right, upper - lower


def filters(isopoints):
    clip = simple.Clip(Input=isopoints)
    clip.ClipType.Origin = [0.0, 0.0, 0.0]
    clip.ClipType.Normal = [1.0, 0.0, 0.0]
    threshold = simple.Threshold(Input=isopoints, Scalars=["POINTS", "r"])
    threshold.LowerThreshold, threshold.UpperThreshold = RADIUS - 1, RADIUS + 1
    calculator = simple.Calculator(Input=isopoints, ResultArrayName="k", Function="coordsX")
    transform = simple.Transform(Input=isopoints)
    transform.Transform.Rotate = [0.0, 90.0, 0.0]
    mask = simple.MaskPoints(Input=isopoints, OnRatio=1)
    group = simple.GroupDatasets(Input=[isopoints])
    simple.SelectPoints("r>0", isopoints)
    selection = simple.ExtractSelection(Input=isopoints)
    of_clip = simple.Threshold(Input=clip, Scalars=["POINTS", "r"])
    of_clip.LowerThreshold, of_clip.UpperThreshold = RADIUS - 1, RADIUS + 1
    return {"Threshold": threshold, "Calculator": calculator, "Transform": transform,
            "Mask Points": mask, "Group Datasets": group, "Extract Selection": selection,
            "Clip": clip, "Threshold of Clip": of_clip}


def main(plugin):
    simple.LoadPlugin(plugin)
    simple._DisableFirstRenderCameraReset()
    view = make_view(300)
    look(view, 50.0, 10.0)
    isopoints = ball()
    for name, source in filters(isopoints).items():
        kind, image = picture(view, source)
        check(kind == "Isopoint Splats", f"{name} is shown as {kind}")
        left, right, light = is_drawn(image)
        print(f"{name}: left {left:.3f}, right {right:.3f}, light {light:.0f}")
        check(0.95 < left < 1.1, f"{name}: the left half")
        check(0.95 < right < 1.1 or ("Clip" in name and right < 0.15), f"{name}: the right half")
        check(light > 20, f"{name}: lit from above")
    for source in (simple.Delaunay3D(Input=isopoints), simple.Sphere(), simple.Slice(Input=isopoints)):
        kind = str(simple.Show(source, view).Representation).strip("'")
        check(kind == "Surface", "meshes are drawn as they are")
    check("Slice" in isopoints.__doc__, "help says that points cannot be sliced")


main(sys.argv[1])
print("passed")
