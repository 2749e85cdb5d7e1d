# SPDX-License-Identifier: GPL-3.0-or-later
"""ParaView's plugin in Python, for versions of ParaView without the compiled plugin: Scattered Isopoints,
Scattered Isosurface, Isopoint Splat Polygons, and Scattered Probe, Line, Grid, Gradient, Slice and Body.

Proxies, properties and help come from the compiled plugin's XML. Points have polygons, because there is no
representation that draws splats. Load the plugin by Tools > Manage Plugins, by setting PV_PLUGIN_PATH to
this folder, or by scatteredisopoints.load_plugin() in a script.
"""

import os
import sys
from xml.etree import ElementTree

# The package may only be beside this file: ParaView may know nothing but this folder.
_SITE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
if _SITE not in sys.path:
    sys.path.append(_SITE)

from scatteredisopoints import __version__, _vtk  # noqa: E402
from scatteredisopoints._properties import proxy_of  # noqa: E402
from scatteredisopoints.plugin import PROXIES, loaded_plugins  # noqa: E402

paraview_plugin_name = "ScatteredIsopointsPython"
paraview_plugin_version = __version__


def _adapted(name):
    """The XML of a proxy, with ParaView's own classes instead of the compiled plugin's."""
    proxy = proxy_of(name)
    proxy.tag = "SourceProxy"
    proxy.set("class", f"{__name__}.{name}")
    proxy.set("si_class", "vtkSIPythonSourceProxy")
    for element in proxy.iter():
        element.tag = {"IsopointArrayDomain": "ArrayListDomain",
                       "IsopointRangeDomain": "ArrayRangeDomain"}.get(element.tag, element.tag)
        if element.get("name") == "ContourValues" and element.get("default_values") is None:
            element.set("default_values", "0.5")
        if element.tag == "ArrayRangeDomain":
            element.set("default_mode", "mid")
        element.attrib.pop("icon", None)
    for parent in list(proxy.iter()):
        for child in list(parent):
            # ParaView does not read counts back from Python.
            is_count = child.get("information_only") == "1" or child.get("label") == "Last Update"
            is_compiled = (child.get("name") == "UseGlobalController" or child.tag == "RepresentationType"
                           or child.get("value") == "vtkHyperTreeGrid")
            if is_count or is_compiled:
                parent.remove(child)
    root = ElementTree.Element("ServerManagerConfiguration")
    ElementTree.SubElement(root, "ProxyGroup", name="filters").append(proxy)
    return ElementTree.tostring(root, encoding="unicode")


_IS_LOADED = "ScatteredIsopoints" in loaded_plugins()
if _IS_LOADED:
    print("ScatteredIsopoints, the compiled plugin, is loaded already: the one in Python adds nothing.")
_FILTERS = {getattr(each, "PROXY", ""): each for each in vars(_vtk).values()}
for _name in PROXIES:
    globals()[_name] = type(_name, (_FILTERS[_name],), {  # ParaView 6 wants a class with XML
        "_pvsm_proxy_xml": "<ServerManagerConfiguration />" if _IS_LOADED else _adapted(_name),
        "_has_polygons": True})
