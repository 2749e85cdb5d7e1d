# SPDX-License-Identifier: GPL-3.0-or-later
"""The filter in Python that derives an array at the samples: see the compiled class of this name."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet

from . import _datasets, _library
from ._arrays import positions_of, readable
from ._derivatives import DERIVATIVES
from ._options import CONSTANTS
from ._polydata import as_vtk
from ._shared_arrays import shared_arrays
from ._vtk_algorithm import fill, with_properties
from ._vtk_probe import LOADED, PACKAGE, Probing

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
        choice = self._array_choice()
        samples = self._loaded(
            data, 0, choice, lambda: _datasets.samples_of(data, *choice, are_values=False), (0.0, LOADED))
        parts = self._kept[0][2]
        self._count_samples(samples)
        name = samples._name
        array = shared_arrays(data, parts)[0].get(name)
        if array is None:
            raise ValueError(f'The array "{name}" has different numbers of components in the blocks of the input, or no'
                             " name. Choose another one.")
        places = positions_of(samples._current("positions", samples._positions))
        _, gradients, kinds = self._probe(samples, places, {name: readable(name, array.numbers)}, math.nan, True)
        results = self._derived(gradients[name].reshape(len(places), -1, 3))
        _copy(data, output)
        blocks, first = list(_datasets.leaves(output)), 0
        for part in parts:
            attributes = blocks[part.leaf].GetAttributes(part.association)
            for label, numbers in results.items():
                attributes.AddArray(as_vtk(PACKAGE, label, numbers[first:first + part.count]))
            first += part.count
        return [*self._describe_skipped(samples, "There are no values. Connect samples with finite positions.",
                                        "Values there are those of the samples around."),
                *self._describe_flat(kinds, "gradients have no part across.")]

    def _derived(self, gradients: np.ndarray) -> dict[str, np.ndarray]:
        """Arrays by name, of gradients of shape (n, c, 3)."""
        count = gradients.shape[1]
        wanted = [names for switch, names in _SWITCHES.items() if self._values[switch]]
        if count != 3 and any(derivative != "gradient" for derivative, _ in wanted):
            raise ValueError("Divergence, vorticity and Q-criterion need vectors, but the array has"
                             f" {count} component{'s' if count > 1 else ''}. Choose an array with three components, or"
                             " compute the gradient alone.")
        return {self._values[name]: DERIVATIVES[derivative](gradients) for derivative, name in wanted}


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
    if _name != "NEAREST":
        setattr(vtkScatteredGradientFilter, _name, _number)
