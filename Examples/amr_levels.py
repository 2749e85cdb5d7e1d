# SPDX-License-Identifier: GPL-3.0-or-later
"""One surface across the levels of an adaptive grid, between whose blocks Contour leaves cracks:
pvbatch amr_levels.py

Needs the compiled plugin, loaded by PV_PLUGIN_PATH or the Debian package."""

from paraview.simple import *

# Stands for your data: cells of three sizes.
wavelet = PointDatatoCellData(Input=Wavelet(WholeExtent=[-32, 32, -32, 32, -32, 32]))
grid = ImageDataToAMR(Input=wavelet, Numberoflevels=3, MaximumNumberofBlocks=60)
surface = ScatteredIsosurface(Input=grid, ContourBy=["CELLS", "RTData"], Isosurfaces=[220.0])

LoadPalette("WhiteBackground")
view = GetActiveViewOrCreate("RenderView")
view.OrientationAxesVisibility = 0
view.ViewSize = [600, 400]
ColorBy(Show(surface), None)
ResetCamera()
GetActiveCamera().Azimuth(35)
GetActiveCamera().Elevation(25)
GetActiveCamera().Zoom(1.4)
SaveScreenshot("amr_levels.png", view)
