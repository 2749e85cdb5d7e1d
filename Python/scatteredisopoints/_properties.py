# SPDX-License-Identifier: GPL-3.0-or-later
"""The properties of the filters, as declared in the XML of the ParaView plugin."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Union
from xml.etree import ElementTree


@dataclass(frozen=True)
class Property:
    """A property with one value."""

    name: str
    default: Union[int, float]
    least: Union[int, float]
    greatest: Union[int, float]
    is_switch: bool

    def clamped(self, value: Union[int, float]) -> Union[int, float]:
        """The nearest value in the range; NaN is unchanged."""
        if self.is_switch:
            return int(bool(value))
        value = type(self.default)(value)
        return min(max(value, self.least), self.greatest) if value == value else value


def proxy_of(name: str) -> ElementTree.Element:
    """The XML of a filter by its proxy's name: ScatteredIsopoints, ScatteredIsosurface,
    IsopointSplatPolygons."""
    root = ElementTree.parse(Path(__file__).parent / "paraview" / f"{name}.xml").getroot()
    return root[0][0]  # ServerManagerConfiguration, ProxyGroup


def properties_of(name: str) -> list[Property]:
    """The properties of a filter with one number and a default."""
    found = []
    for element in proxy_of(name):
        kind = {"IntVectorProperty": int, "DoubleVectorProperty": float}.get(element.tag)
        is_set = element.get("command", "").startswith("Set")
        if kind is None or not is_set or element.get("number_of_elements") != "1":
            continue
        least, greatest = (-2**31, 2**31 - 1) if kind is int else (-math.inf, math.inf)
        is_switch = False
        for domain in element:
            if domain.tag == "BooleanDomain":
                least, greatest, is_switch = 0, 1, True
            elif domain.tag == "EnumerationDomain":
                values = [int(entry.attrib["value"]) for entry in domain]
                least, greatest = min(values), max(values)
            elif domain.tag.endswith("RangeDomain"):
                least = kind(domain.get("min", least))
                greatest = kind(domain.get("max", greatest))
        name = element.attrib["command"][3:]
        found.append(Property(name, kind(element.attrib["default_values"]), least, greatest, is_switch))
    return found
