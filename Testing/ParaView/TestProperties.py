# SPDX-License-Identifier: GPL-3.0-or-later
"""The XML of the plugin against its classes and the document of the properties:
TestProperties.py PLUGIN PROPERTIES_MD REPRESENTATION_XML FILTER_XML...

Properties offer the ranges that the classes accept and have their defaults, and so does the document;
help mentions only representations that exist."""

import re
import sys
import xml.etree.ElementTree as ElementTree

import numpy as np
import scatteredisopoints
from paraview import servermanager, simple
from scripting import SPLATS, check, load, vtk_data
from vtkmodules.vtkCommonDataModel import vtkPlane

LARGE = {"IntVectorProperty": 2**31 - 1, "DoubleVectorProperty": 1e100}


def is_hidden(element):
    return element.get("panel_visibility") == "never"


def vector_properties(root):
    """Yields name, XML, name in the class and default of each property that users set, with one value and a default."""
    for element in root.iter():
        if (element.tag.endswith("VectorProperty") and not is_hidden(element)
                and {"default_values", "command"} <= set(element.keys()) and element.get("information_only") != "1"
                and element.get("number_of_elements") == "1" and "repeat_command" not in element.attrib):
            check(element.get("command")[:3] == "Set", element.get("command"))
            default = element.get("default_values")
            yield (element.get("name"), element, element.get("command")[3:],
                   default if element.tag == "StringVectorProperty" else float(default))


def limits(element):
    """The least and the greatest value that a property offers. None means that there is no limit."""
    domain = next(child for child in element if child.tag.endswith("Domain"))
    if domain.tag == "BooleanDomain":
        return 0, 1
    if domain.tag == "EnumerationDomain":
        values = [int(entry.get("value")) for entry in domain]
        check(values == list(range(values[0], values[-1] + 1)), "consecutive values")
        return values[0], values[-1]
    number = int if domain.tag == "IntRangeDomain" else float
    return [number(domain.get(name)) if domain.get(name) else None for name in ("min", "max")]


def check_range(name, element, accepts):
    """accepts(value): whether the class takes a value as it is."""
    if element.tag == "StringVectorProperty":
        return
    low, high = limits(element)
    if low is None and high is None:
        return
    check(low is not None and accepts(low), f"{name}: the least value, {low}")
    check(accepts(LARGE[element.tag] if high is None else high), f"{name}: the greatest, {high}")
    if element.find("BooleanDomain") is None:
        check(not accepts(low - 1), f"{name}: less than {low}")
        check(high is None or not accepts(high + 1), f"{name}: more than {high}")


def filter_accepts(instance, name):
    """A value outside of the range is set to the nearest one, or is an error at the update."""
    positions = np.random.default_rng(1).random((50, 3))
    instance.SetInputData(vtk_data.cloud_of(positions, positions[:, 0]))
    if hasattr(instance, "SetSourceData"):
        instance.SetSourceData(vtk_data.cloud_of(positions, positions))
    elif instance.IsA("vtkScatteredGradientFilter"):
        instance.GetInput().GetPointData().SetScalars(vtk_data.named("vectors", positions))
    if hasattr(instance, "SetValue"):
        instance.SetValue(0, 0.5)
    if hasattr(instance, "SetCutFunction"):
        instance.SetCutFunction(vtkPlane())
    if name == "Capping":  # what it requires
        instance.SetRegularize(False)
        instance.SetProjection(instance.NO_PROJECTION)
    errors = []
    instance.AddObserver("ErrorEvent", lambda *_: errors.append(1))

    def accepts(value):
        errors.clear()
        getattr(instance, "Set" + name)(value)
        if name != "Resolution":  # of as many points
            instance.Update()
        return getattr(instance, "Get" + name)() == value and not errors

    return accepts


def check_filter(root, documented):
    """documented: the defaults in the tables of the document, by property."""
    proxy = root.find(".//*[@class]")
    contours = proxy.get("name") in ("ScatteredIsopoints", "ScatteredIsosurface")
    filter_class = getattr(scatteredisopoints, proxy.get("class"))
    names = []
    for name, element, name_in_class, default in vector_properties(root):
        value = getattr(filter_class(), "Get" + name_in_class)()
        if name not in ("ResultArrayName", "QCriterionArrayName"):  # named as in vtkGradientFilter, and as in ParaView
            check(value == default, f"{name}: the default {default}, in the class {value}")
        check_range(name, element, filter_accepts(filter_class(), name_in_class))
        check(name in documented, f"{name} in {sorted(documented)}")
        if contours and element.find("EnumerationDomain") is None:
            text = documented[name].split()[0]
            check({"on": 1.0, "off": 0.0}.get(text) == default or text == f"{default:g}",
                  f"{name}: the default {default}, in the document {text}")
        names.append(name)
    check(len(names) >= (10 if contours else 3), f"properties of the filter: {names}")
    check_panel(proxy)
    if contours:
        shown = [element.get("name") for element in proxy
                 if element.tag.endswith("VectorProperty") and not is_hidden(element)]
        groups = proxy.findall("PropertyGroup")
        grouped = [element.get("name") for group in groups for element in group]
        labels = [group.get("label") for group in groups]
        check(labels == ["Isosurfaces", "Surface", "Output Arrays", "Performance", "Last Update"], f"groups {labels}")
        check(shown[:2] == ["SelectInputScalars", "ContourValues"], f"first: {shown[:2]}")
        check(grouped == shown, f"groups have all properties in their order: {grouped}")


def check_panel(proxy):
    """Counts are advanced, rows of one filter are those of others, and the first property for animations is that of
    isovalues."""
    name, visibility = proxy.get("name"), {element.get("name"): element.get("panel_visibility", "default")
                                           for element in proxy if element.tag.endswith("Property")}
    advanced = {each for each in visibility if visibility[each] == "advanced"}
    check(all(each in advanced for each in visibility if each.startswith("NumberOf")), f"{name}: counts")
    check("Regularize" not in visibility or "Regularize" in advanced, f"{name}: Regularize is advanced")
    if "NullPointsStrategy" in visibility:
        check(("NullPointsStrategy" in advanced) == (name == "ScatteredProbe"), f"{name}: the strategy")
    options = [entry.get("text") for entry in proxy.iterfind("*[@name='Interpolation']//Entry")]
    check(not options or options[0] == "Blend", f"{name}: {options}")
    animated = sorted(element.get("name") for element in proxy if element.tag.endswith("VectorProperty")
                      and element.get("animateable") != "0" and element.get("information_only") != "1")
    if "ContourValues" in animated:
        check(animated[0] == "ContourValues", f"{name}: animated first: {animated}")
    labels = {element.get("name"): element.get("label") for element in proxy if element.tag == "InputProperty"}
    check(labels == (dict(Input="Samples", Source="Destination Mesh") if name == "ScatteredProbe" else
                     dict(Input=None)), f"{name}: ports {labels}")
    grouped = [element.get("name") for group in proxy.findall("PropertyGroup") for element in group]
    if name in ("ScatteredProbe", "ScatteredSlice"):
        rows = {each for each in advanced if each not in ("UseGlobalController", "UsePanelNames")}
        check(rows <= set(grouped), f"{name}: without a heading: {rows - set(grouped)}")


def value_of(representation, name, like):
    """Reads a value from what a representation prints, since Python does not know the class."""
    return type(like)(dict(re.findall(r"^ *(\w+): (\S*)$", str(representation), re.MULTILINE))[name])


def check_representation(root):
    manager = servermanager.ProxyManager()
    proxy = manager.NewProxy("representations", "IsopointSplatRepresentation")
    representation = proxy.GetClientSideObject()
    fresh = representation.NewInstance()
    check(fresh.GetClassName() == "vtkIsopointSplatRepresentation", fresh.GetClassName())
    names = []
    for name, element, name_in_class, default in vector_properties(root):
        value = value_of(fresh, name_in_class, default)
        check(value == default, f"{name}: the default {default}, in the class {value}")

        def accepts(value):
            servermanager.vtkSMPropertyHelper(proxy, name).Set(value)
            proxy.UpdateVTKObjects()
            return value_of(representation, name_in_class, value) == value

        check_range(name, element, accepts)
        names.append(name)
    check(len(names) == 3, f"properties of the representation: {names}")


def check_mentioned_representations(roots):
    isopoints = simple.ScatteredIsopoints(Input=simple.Wavelet(), Isosurfaces=[150.0])
    known = list(simple.Show(isopoints, simple.CreateView("RenderView")).GetProperty("Representation").Available)
    names = r"([A-Z]\w*(?: [A-Z]\w*)*)"
    mentioned = set()
    for element in (element for root in roots for element in root.iter("Documentation")):
        texts = filter(None, (element.text, element.get("short_help"), element.get("long_help")))
        text = " ".join(" ".join(texts).split())
        for found in re.findall(rf"[Rr]epresentations? {names}(?: and {names})?", text):
            mentioned.update(filter(None, found))
    print("representations in help:", ", ".join(sorted(mentioned)))
    check(SPLATS in mentioned <= set(known), f"{mentioned} among the representations {known}")


plugin, document, *files = sys.argv[1:]
load(plugin)
with open(document) as text:
    documented = dict(re.findall(r"^\| `(\w+)`[^|]*\| ([^|]+) \|", text.read(), re.MULTILINE))
of_representation, *of_filters = roots = [ElementTree.parse(file).getroot() for file in files]
check(len(of_filters) == 9, "all filters")
for of_filter in of_filters:
    check_filter(of_filter, documented)
check_representation(of_representation)
check_mentioned_representations(roots)
print("passed")
