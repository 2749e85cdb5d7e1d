# SPDX-License-Identifier: GPL-3.0-or-later
"""Real files of every kind, where a folder with them is available: TestRealFiles.py PLUGIN FOLDER
Prints a table; each file must give as many isopoints as its surface lets expect."""

import os
import sys
import time

from paraview import simple

from scripting import contoured, load, number_of_points, updated

# file, association, array (the first scalars if None), isovalue, least and largest number of isopoints
CASES = [
    ("volumes/engine_256x256x128_uint8.vti", "POINTS", "scalar", 80.0, 297523, 297523),
    ("volumes/headsq_64x64x93_uint16.vti", "POINTS", None, 500.0, 20000, 60000),
    ("volumes/hydrogenAtom_128x128x128_uint8.vti", "POINTS", None, 20.0, 20000, 100000),
    ("volumes/fuel_64x64x64_uint8.vti", "POINTS", None, 15.0, 1000, 20000),
    ("volumes/tooth.vti", "POINTS", None, 120.0, 20000, 200000),
    ("volumes/imide_potential_23x43x48.vti", "POINTS", None, 0.05, 1000, 20000),
    ("scattered/sph_water_jet.vtp", "POINTS", "speed", 33.0, 1000, 10000),
    ("scattered/ctd_southern_ocean_TS.vtp", "POINTS", "temperature_degC", 2.0, 1000, 200000),
    ("scattered/drillholes_babbitt_CuNi.vtp", "POINTS", "CU_pct", 0.5, 1000, 100000),
    ("scattered/amr_spcth_leafcells.vtp", "POINTS", "volume_fraction_total", 0.5, 1000, 60000),
    ("scattered/cosmo_nbody_adaptive.vtp", "POINTS", "log10_overdensity_knn32", 1.0, 1000, 60000),
    ("unstructured/disk_out_ref.vtu", "POINTS", "Temp", 400.0, 500, 20000),
    ("unstructured/can.vtu", "POINTS", "mag(VEL)", 3600.0, 100, 20000),
    ("unstructured/fea_bracket_kiefer.vtu", "CELLS", "von_Mises_psi", 5.0, 500, 50000),
    ("multiblock/bluntfin.vts", "POINTS", "Density", 1.0, 500, 50000),
    ("multiblock/multicomb.vtm", "POINTS", "Density", 0.28, 500, 50000),
    ("amr/HierarchicalBoxDataset.v1.1.vthb", "CELLS", "Fractal Volume Fraction", 0.5, 200, 2000),
]

plugin, folder = sys.argv[1:]
if not os.path.isdir(folder):
    print("skipped: there is no folder", folder)
    sys.exit(77)
load(plugin)
wrong = []
print("| file | array | isovalue | samples | skipped | isopoints | seconds |\n" + 7 * "|---" + "|")
for name, association, array, isovalue, least, largest in CASES:
    source = simple.OpenDataFile(os.path.join(folder, name))
    if name.endswith(".vthb"):
        source.DefaultNumberOfLevels = 10
    updated(source)
    if array is None:
        arrays = [source.PointData.GetArray(i) for i in range(source.PointData.GetNumberOfArrays())]
        array = next(each.GetName() for each in arrays if each.GetNumberOfComponents() == 1)
    elif "(" in array:
        source = updated(simple.Calculator(Input=source, Function=array, ResultArrayName=array))
    start = time.perf_counter()
    isopoints = contoured(source, array, isovalue, association)
    seconds = time.perf_counter() - start
    information, count = source.GetDataInformation(), number_of_points(isopoints)
    samples = information.GetNumberOfPoints() if association == "POINTS" else information.GetNumberOfCells()
    print(f"| {name} | {array} | {isovalue:g} | {samples} | {isopoints.NumberOfSkippedSamples} | {count} |"
          f" {seconds:.3f} |")
    wrong += [] if least <= count <= largest else [name]
    simple.Delete(isopoints)
    simple.Delete(source)
sys.exit(f"failed: {wrong}" if wrong else 0)
