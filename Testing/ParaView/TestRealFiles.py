# SPDX-License-Identifier: GPL-3.0-or-later
"""Real files of several kinds, where a folder with them is at hand."""

import os
import sys

from paraview import simple

SKIPPED = 77

# file, array, isovalue, least and largest number of isopoints
CASES = [
    ("volumes/engine_256x256x128_uint8.vti", "scalar", 80.0, 297523, 297523),
    ("scattered/sph_water_jet.vtp", "speed", 33.0, 1000, 10000),
    ("scattered/ctd_southern_ocean_TS.vtp", "temperature_degC", 2.0, 1000, 200000),
    ("unstructured/disk_out_ref.vtu", "Temp", 400.0, 500, 20000),
    ("multiblock/bluntfin.vts", "Density", 1.0, 500, 50000),
]


def main(plugin, folder):
    if not os.path.isdir(folder):
        print("skipped: there is no folder", folder)
        sys.exit(SKIPPED)
    simple.LoadPlugin(plugin)
    wrong = 0
    for name, array, isovalue, least, largest in CASES:
        reader = simple.OpenDataFile(os.path.join(folder, name))
        reader.UpdatePipeline()
        isopoints = simple.ScatteredIsopoints(Input=reader)
        isopoints.ContourBy = ["POINTS", array]
        isopoints.Isosurfaces = [isovalue]
        isopoints.UpdatePipeline()
        count = isopoints.GetDataInformation().GetNumberOfPoints()
        print(name, array, isovalue, count)
        wrong += 0 if least <= count <= largest else 1
        simple.Delete(isopoints)
        simple.Delete(reader)
    sys.exit("failed: %d files" % wrong if wrong else 0)


main(*sys.argv[1:])
