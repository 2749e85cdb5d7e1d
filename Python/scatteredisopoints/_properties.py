# SPDX-License-Identifier: GPL-3.0-or-later
"""The properties of the filters, as declared in the XML of the ParaView plugin."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Optional, Union
from xml.etree import ElementTree

_KINDS = {"IntVectorProperty": int, "DoubleVectorProperty": float, "StringVectorProperty": str}


@dataclass(frozen=True)
class Property:
    """A property: a number, several numbers, or a text."""

    name: str
    default: Union[int, float, str, tuple]
    least: Union[int, float] = 0  # of one number, as is the greatest
    greatest: Union[int, float] = 0
    is_switch: bool = False

    def clamped(self, value: Any) -> Any:
        """The nearest value in the range; NaN, several numbers and texts are unchanged."""
        if self.is_switch:
            return int(bool(value))
        if isinstance(self.default, str):
            return "" if value is None else str(value)
        if isinstance(self.default, tuple):
            numbers = tuple(type(self.default[0])(each) for each in value)
            if len(numbers) != len(self.default):
                raise TypeError(f"Set{self.name}() takes {len(self.default)} numbers, not {len(numbers)}")
            return numbers
        value = type(self.default)(value)
        return min(max(value, self.least), self.greatest) if value == value else value


def proxy_of(name: str) -> ElementTree.Element:
    """The XML of a filter by its proxy's name, such as ScatteredIsopoints."""
    root = ElementTree.parse(Path(__file__).parent / "properties" / f"{name}.xml").getroot()
    return root[0][0]  # ServerManagerConfiguration, ProxyGroup


def properties_of(name: str) -> list[Property]:
    """The properties of a filter that have a default."""
    return [found for found in map(_property_of, proxy_of(name)) if found is not None]


def _property_of(element: ElementTree.Element) -> Optional[Property]:
    kind, command = _KINDS.get(element.tag), element.get("command", "")
    if kind is None or not command.startswith("Set") or element.get("default_values") is None:
        return None
    if element.get("repeat_command") == "1":  # contour values
        return None
    name, default = command[3:], element.attrib["default_values"]
    if kind is str:
        return Property(name, default) if element.get("number_of_elements") == "1" else None
    if element.get("number_of_elements") != "1":
        return Property(name, tuple(kind(each) for each in default.split()))
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
    return Property(name, kind(default), least, greatest, is_switch)
