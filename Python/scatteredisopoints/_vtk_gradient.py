# SPDX-License-Identifier: GPL-3.0-or-later
"""The filter in Python that derives an array at the samples: see the compiled class of this name."""

from __future__ import annotations

import math
from typing import Any, Mapping

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet

from . import _datasets, _library
from ._arrays import as_numpy, positions_of, readable
from ._derivatives import DERIVATIVES
from ._options import CONSTANTS
from ._polydata import as_vtk
from ._vtk_algorithm import LOADED, fill, with_properties
from ._vtk_probe import PACKAGE, Probing

# Derivatives by the properties that switch them on, and those of the names of their arrays.
_SWITCHES = {"ComputeGradient": ("gradient", "ResultArrayName"),
             "ComputeDivergence": ("divergence", "DivergenceArrayName"),
             "ComputeVorticity": ("vorticity", "VorticityArrayName"),
             "ComputeQCriterion": ("qcriterion", "QCriterionArrayName")}


@with_properties("ScatteredGradient")
class vtkScatteredGradientFilter(Probing):
    """Derives an array at scattered samples: see the compiled class of this name."""

    def __init__(self):
        super().__init__()
        self._values.update(ResultArrayName="Gradients", QCriterionArrayName="Q-criterion")  # the XML has ParaView's

    def _output_class(self, data: Any) -> type:
        return type(data.NewInstance())

    def _compute(self, data: Any, output: Any) -> list[_library.Message]:
        wanted = self._wanted()
        choice = self._array_choice()
        samples = self._loaded(
            data, 0, choice, lambda: _datasets.samples_with_values(data, *choice, are_values=False), (0.0, LOADED))
        parts = self._kept[0][2]
        self._count_samples(samples)
        results: dict[str, np.ndarray] = {}
        messages: list[_library.Message] = []
        if wanted:
            name, leaves = samples._name, list(_datasets.leaves(data))
            attributes = [leaves[part.leaf].GetAttributes(part.association) for part in parts]
            numbers = _numbers_in([each.GetAbstractAttribute(choice[2]) if choice[0] is None else
                                   each.GetArray(choice[0]) for each in attributes], name)
            _check_components(wanted, numbers)
            places = positions_of(samples._current("positions", samples._positions))
            _, found, kinds = self._probe(samples, places, {name: readable(name, numbers)}, math.nan, True)
            gradients = found[name].reshape(len(places), -1, 3)
            results = {label: DERIVATIVES[derivative](gradients) for label, derivative in wanted.items()}
            messages = [*self._describe_flat(kinds, "gradients have no part across.", warns_of_all=True),
                        *_describe_lacking(gradients, places)]
        _copy(data, output)
        blocks, first = list(_datasets.leaves(output)), 0
        for part in parts:
            attributes = blocks[part.leaf].GetAttributes(part.association)
            for label, numbers in results.items():
                attributes.AddArray(as_vtk(PACKAGE, label, numbers[first:first + part.count]))
            first += part.count
        return [*self._describe_skipped(samples, "There are no values. Connect samples with finite positions.",
                                        "Gradients are those of the other samples."), *messages]

    def _wanted(self) -> dict[str, str]:
        """The derivatives to compute, by the names of their arrays. Raises ValueError for unusable names."""
        wanted: dict[str, str] = {}
        for switch, (derivative, property_) in _SWITCHES.items():
            name = self._values[property_]
            if not self._values[switch]:
                continue
            if name in ("", "vtkGhostType", *wanted):
                raise ValueError(f'A computed array cannot have the name "{name}": empty, that of ghost marks, or that'
                                 " of another one. Set another name.")
            wanted[name] = derivative
        return wanted


def _numbers_in(pieces: list[Any], name: str) -> np.ndarray:
    """The numbers of an array in all blocks. Raises ValueError if blocks have different numbers of components."""
    numbers = [as_numpy(piece) for piece in pieces]
    if len({each.shape[1:] for each in numbers}) > 1:
        raise ValueError(f'The array "{name}" has different numbers of components in the blocks of the input. Choose'
                         " another one.")
    return numbers[0] if len(numbers) == 1 else np.concatenate(numbers)


def _check_components(wanted: Mapping[str, str], numbers: np.ndarray) -> None:
    count = int(np.prod(numbers.shape[1:]))
    if count != 3 and any(derivative != "gradient" for derivative in wanted.values()):
        raise ValueError("Divergence, vorticity and Q-criterion need vectors, but the array has"
                         f" {count} component{'s' if count > 1 else ''}. Choose an array with three components, or"
                         " compute the gradient alone.")


def _describe_lacking(gradients: np.ndarray, places: np.ndarray) -> list[_library.Message]:
    count = np.count_nonzero(np.isnan(gradients).any(axis=(1, 2)) & np.isfinite(places).all(axis=1))
    return [] if count == 0 else [_library.Message(
        f"{count} of {len(places)} points have no gradient: no samples around are in use and have finite values. Choose"
        " another array, or show hidden samples.", is_warning=count == len(places), cause="no gradient")]


def _copy(data: Any, output: Any) -> None:
    """Shallow copies, of all leaves of a composite."""
    if not isinstance(output, vtkCompositeDataSet):
        output.ShallowCopy(data)
        return

    def copied(leaf: Any, _number: int) -> Any:
        made = leaf.NewInstance()
        made.ShallowCopy(leaf)
        return made

    fill(output, data, copied, are_all=True)
    output.GetFieldData().PassData(data.GetFieldData())


for _name, _number in CONSTANTS["method"].items():
    if _name != "nearest":
        setattr(vtkScatteredGradientFilter, _name.upper(), _number)
