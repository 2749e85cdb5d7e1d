# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters with their defaults: which array and isovalue they take, and what they compute."""

import sys

import numpy as np
from paraview import simple
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet

from scripting import (
    check, contoured, load, messages, named, number_of_points, offered_arrays, path_of, produced, run, updated,
    vtk_data)

load(sys.argv[1])
FILTERS = simple.ScatteredIsopoints, simple.ScatteredIsosurface
ASSOCIATIONS = "POINTS", "CELLS"


def attributes_of(data, association):
    return data.GetCellData() if association == "CELLS" else data.GetPointData()


def lattice(association, **arrays):
    """A lattice with arrays of points or cells. Each array has a name and a function that yields its values."""
    image = vtkImageData()
    image.SetDimensions(*([13] * 3 if association == "CELLS" else [12] * 3))
    places = np.stack(np.meshgrid(*3 * [np.arange(12.0)], indexing="ij"), -1).reshape(-1, 3)
    for name, function in arrays.items():
        attributes_of(image, association).AddArray(named(name, function(places)))
    return image


def distance(places):
    return np.linalg.norm(places - 5.6, axis=1)


def number(value):
    return lambda places: np.full(len(places), value)


def ghosts(places):
    return (places[:, 0] < 2).astype(np.uint8)


def ids(places):
    return np.arange(len(places))


def the_array_of_an_input():
    """The active scalars, unless they are constant or ids: then the first array that is neither, as in an AMR, whose
    first array is the number of a block, and as in finite elements, where ids are the first arrays by name."""
    for association in ASSOCIATIONS:
        for chosen, active, arrays in (
                ("distance", None, dict(BlockId=number(0), distance=distance, z=distance)),
                ("stress", None, dict(GlobalElementId=ids, Nodes=ids, Pedigree=ids, stress=distance,
                                      vtkGhostType=ghosts)),
                ("second", "second", dict(BlockId=number(0), first=distance, second=distance)),
                ("first", "BlockId", dict(BlockId=number(0), first=distance, second=distance)),
                ("first", "Index", dict(Index=ids, first=distance)),
                ("first", "Number", dict(Number=lambda p: ids(p) + 1.0, first=distance)),
                ("Index", None, dict(Index=ids)),
                ("BlockId", None, dict(BlockId=number(0)))):
            data, blocks = lattice(association, **arrays), vtkMultiBlockDataSet()
            attributes = attributes_of(data, association)
            if "Nodes" in arrays:
                attributes.SetActiveGlobalIds("Nodes")
                attributes.SetActivePedigreeIds("Pedigree")
            if active:
                attributes.SetActiveScalars(active)
            blocks.SetBlock(0, data)
            for create in FILTERS:
                for source in (produced(data), *([produced(blocks)] if chosen == "distance" else [])):
                    isopoints = create(Input=source)
                    found = list(isopoints.ContourBy)
                    check(found == [association, chosen], f"chosen {found}, not {chosen}")
                    if arrays[chosen] is distance:
                        low, high = distance(np.array([[6.0] * 3, [0.0] * 3]))
                        check(len(isopoints.Isosurfaces) == 1 and low < isopoints.Isosurfaces[0] < high,
                              f"an isovalue within the range: {isopoints.Isosurfaces}")
                        check(number_of_points(updated(isopoints)) > 100, "points")


def arrays_without_isosurfaces_are_not_offered():
    """No isosurface exists for strings, ghost marks, and arrays without a number."""
    for association in ASSOCIATIONS:
        data = lattice(association, vtkGhostType=ghosts, none=number(np.nan),
                       some=lambda p: np.where(p[:, 0] < 2, np.nan, distance(p)))
        attributes_of(data, association).AddArray(named("names", 12**3 * ["name"]))
        for create in FILTERS:
            isopoints = create(Input=produced(data))
            check(offered_arrays(isopoints) == ["some"], f"offered: {offered_arrays(isopoints)}")
            check(isopoints.ContourBy[1] == "some", "the default is among them")
            without = create(Input=produced(lattice(association, vtkGhostType=ghosts)))
            check(not offered_arrays(without) and not without.ContourBy[1], "no ghost marks")
            with messages() as texts:
                without.UpdatePipeline()
            check("arrays in the reader" in texts[0], "what to do without arrays")


def triangles_are_saved_as_stl():
    """Isopoints have no triangles, and a message says so."""
    source = produced(lattice("POINTS", distance=distance))
    for create, word in zip(FILTERS, ("Scattered Isosurface", "")):
        isopoints = updated(create(Input=source))
        with messages() as texts:
            simple.SaveData(path_of("surface.stl"), isopoints)
        check(word in texts[0] and bool(texts[0]) == bool(word), f"said of {isopoints}: {texts}")


def arrays_that_describe_isopoints_are_not_the_default():
    """Those are normals and radii."""
    points = contoured(produced(lattice("POINTS", value=distance)), "value", 3.5)
    check(simple.ScatteredIsosurface(Input=points).ContourBy[1] == "value", "the array to contour")
    check(simple.ScatteredGradient(Input=points).ScalarArray[1] == "value", "the array of a gradient")
    named = simple.Calculator(Input=points, Function="coordsX", ResultArrayName="x")
    named.UpdatePipeline()
    check(simple.ScatteredIsosurface(Input=named).ContourBy[1] == "x", "an array of their own")


def ranges_are_finite():
    """Of the isovalue and its default, also after its button for the default was pressed."""
    data = lattice(
        "POINTS", value=lambda p: np.where(p[:, 0] == 0, np.inf, np.where(p[:, 0] == 1, np.nan, distance(p))))
    for create in FILTERS:
        isopoints = create(Input=produced(data))
        values = isopoints.SMProxy.GetProperty("ContourValues")
        for each in (values.ResetToDomainDefaults, lambda: None):
            domain = values.FindDomain("vtkSMArrayRangeDomain")
            least, greatest = domain.GetMinimum(0), domain.GetMaximum(0)
            check(0 < least < 1 and 8 < greatest < 10, f"the finite range: {least}, {greatest}")
            check(list(isopoints.Isosurfaces) == [0.5 * (least + greatest)], f"its middle: {isopoints.Isosurfaces}")
            each()


def grids_of_chosen_arrays_without_errors():
    """Images of samples in a plane, of one, and of others, whose extent the samples determine: the extent that is
    announced downstream is that of the data."""
    places = np.random.default_rng(3).random((500, 3))
    for scale, expected in (((2, 1, 0), (99, 50, 0)), ((0, 0, 0), (0, 0, 0))):
        samples = vtk_data.cloud_of(np.vstack([np.zeros(3), places, np.ones(3)]) * scale, np.arange(502.0), "first")
        samples.GetPointData().AddArray(named("second", np.arange(502.0)))
        view = simple.CreateView("RenderView")
        with messages() as texts:
            grid = simple.ScatteredGrid(Input=produced(samples))
            check(list(grid.Arrays) == ["first", "second"], f"all arrays: {grid.Arrays}")
            for option in (dict(), dict(Arrays=["second"]), dict(SamplingDimensions=[7, 6, 5])):
                for name, value in option.items():
                    setattr(grid, name, value)
                simple.Show(grid, view).Representation = "Outline"  # a slice would need the former array
                simple.Render(view)
                found, dimensions = grid.GetDataInformation().GetExtent()[1::2], grid.SamplingDimensions
                check(found == (expected if not any(dimensions) else
                                tuple(d - 1 if s else 0 for d, s in zip(dimensions, scale))), f"extent {found}")
        check("ERR" not in texts[0] and "outside" not in texts[0], texts[0])
        check(set(grid.PointData.keys()) - {"vtkGhostType"} == {"second"}, f"arrays {grid.PointData.keys()}")


def spreadsheets_hide_splats():
    """Unless the user shows their columns."""
    former, sheet = simple.GetActiveView(), simple.CreateView("SpreadSheetView")
    hidden = list(sheet.HiddenColumnLabels)
    simple.Delete(sheet)
    simple.SetActiveView(former)
    check(hidden == ["Block Number"] + [name + end for name in ("SplatAxis", "SplatPolygon")
                                        for end in ("", "_Magnitude")], f"hidden: {hidden}")


def input_matters_rather_than_the_active_source():
    named, other, both = (produced(lattice("POINTS", **dict.fromkeys(names, distance)))
                          for names in (["named"], ["other"], ["first", "named"]))
    for create in FILTERS:
        for active, source, options, expected in (
                (other, named, {}, "named"), (named, both, {}, "first"),
                (named, both, dict(ContourBy=["POINTS", "named"]), "named")):
            simple.SetActiveSource(active)
            chosen = list(create(Input=source, **options).ContourBy)
            check(chosen == ["POINTS", expected], f"the array of the input: {chosen}")
        kept = create(Input=named, ContourBy=["POINTS", "named"])
        kept.Input = both
        check(kept.ContourBy[1] == "named", "a choice that both inputs have")


def isovalue_follows_the_array():
    """The isovalue follows the array until the user chooses an isovalue."""
    source = produced(lattice("POINTS", first=distance, large=lambda p: 1000 * distance(p)))
    for create in FILTERS:
        isopoints = create(Input=source)
        first = isopoints.Isosurfaces[0]
        isopoints.ContourBy = ["POINTS", "large"]
        check(np.isclose(isopoints.Isosurfaces[0], 1000 * first), "the middle of the other range")
        check(number_of_points(updated(isopoints)) > 100, "points")
        isopoints.ContourBy = ["POINTS", "first"]
        check(isopoints.Isosurfaces[0] == first, "and back")
        for isovalues, array in (([4.25], "large"), ([3000.0, 4000.0], "first")):
            isopoints.Isosurfaces = isovalues
            isopoints.ContourBy = ["POINTS", array]
            check(list(isopoints.Isosurfaces) == isovalues, "a choice stays")
        given = create(Input=source, ContourBy=["POINTS", "large"], Isosurfaces=[first])
        check(list(given.Isosurfaces) == [first], "an isovalue that is given with the array stays")


def arrays_may_come_later():
    """As those that are ticked in a reader when there is a filter already: array, list and isovalue appear."""
    path = path_of("lattice.vti")
    simple.SaveData(path, produced(lattice("POINTS", late=lambda p: 10 * distance(p), other=distance)),
                    DataMode="Binary")
    for create in FILTERS:
        source = simple.XMLImageDataReader(FileName=[path], PointArrayStatus=[])
        source.UpdatePipeline()
        isopoints = create(Input=source)
        check(not offered_arrays(isopoints) and len(isopoints.Isosurfaces) == 0, "nothing to choose")
        source.PointArrayStatus = ["late"]
        source.UpdatePipeline()
        check(offered_arrays(isopoints) == ["late"] == [isopoints.ContourBy[1]], f"chosen: {isopoints.ContourBy}")
        check(len(isopoints.Isosurfaces) == 1, "an isovalue")
        check(number_of_points(updated(isopoints)) > 100, "points")
        source.PointArrayStatus = ["late", "other"]
        source.UpdatePipeline()
        check(isopoints.ContourBy[1] == "late", "the choice stays")


def properties_may_outlive_proxies():
    """As in a script or a panel that keeps them. What depends on a property ignores its changes then."""
    without, source = produced(lattice("POINTS")), produced(lattice("POINTS", distance=distance))
    for create in FILTERS:
        isopoints, shown = create(Input=without), simple.Show(create(Input=source))
        array, *others = map(isopoints.SMProxy.GetProperty, ("SelectInputScalars", "ContourValues", "Input"))
        splats = shown.SMProxy.GetProperty("SplatsForIsopoints")
        others += [splats]
        if simple.GetParaViewVersion() < 6:  # ParaView 6.1 crashes, also with its own representations
            others.append(splats.GetParent().GetProperty("Input"))
        for each in (isopoints, shown):
            simple.Delete(each)
        del isopoints, shown, each
        check(not any(each.GetParent() for each in [array, *others]), "the proxies are deleted")
        array.SetElement(4, "other")  # the isovalue waits for an array
        del splats
        while others:
            for each in others:
                each.ResetToDomainDefaults()
                each.InvokeEvent("UncheckedPropertyModifiedEvent")
            others.pop(0)


def panel():
    source = simple.Wavelet()
    for name, has_both in (("DropGaps", True), ("Regularize", False)):
        for create in FILTERS:
            shown = create(Input=source).SMProxy.GetProperty(name)
            if not has_both and create is FILTERS[0]:
                check(shown is None, f"points have no {name}")
            else:
                check(shown.GetElement(0) == 1, f"{name} is on")


run(the_array_of_an_input, arrays_without_isosurfaces_are_not_offered, triangles_are_saved_as_stl,
    arrays_that_describe_isopoints_are_not_the_default, ranges_are_finite, grids_of_chosen_arrays_without_errors,
    spreadsheets_hide_splats, input_matters_rather_than_the_active_source, isovalue_follows_the_array,
    arrays_may_come_later,
    properties_may_outlive_proxies, panel)
