# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays that all blocks of a data object have, as arrays of all samples."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np

from ._arrays import as_numpy
from ._datasets import GLOBAL_IDS, Part, has_ids, leaves

DOUBLE = 11  # as in vtkType.h


@dataclass
class SharedArray:
    """An array of the samples of all blocks."""

    numbers: np.ndarray
    """Shape (n,) or (n, components), of the type of the blocks' arrays or one that holds the numbers of all."""
    data_type: int
    """VTK's, of the blocks' arrays; double if they differ."""
    use: int
    """The type of attribute that it is in all blocks, except global ids, or -1."""
    first: Any
    """VTK's array of the first block, which names the components."""
    has_ids: bool
    """In any block."""


def shared_arrays(data: Any, parts: Sequence[Part]) -> tuple[dict[str, SharedArray], list[str]]:
    """The numeric arrays by name that all parts have with as many components, in the order of the first part; and the
    sorted names of others. Ghost marks are never among them."""
    blocks = list(leaves(data))
    found = [_arrays_of(blocks[part.leaf].GetAttributes(part.association)) for part in parts]
    arrays: dict[str, SharedArray] = {}
    others = set()
    for name in {name: None for each in found for name in each}:
        pieces: list[Any] = [each.get(name) for each in found]
        if _are_alike(pieces, parts):
            arrays[name] = _joined([array for array, _ in pieces], [use for _, use in pieces])
        else:
            others.add(name)
    return arrays, sorted(others)


def _arrays_of(attributes: Any) -> dict[str, tuple[Any, int]]:
    """All arrays with a name, of text too, and what they are used for."""
    found = {}
    for i in range(attributes.GetNumberOfArrays()):
        array, use = attributes.GetAbstractArray(i), attributes.IsArrayAnAttribute(i)
        if array.GetName() not in (None, "vtkGhostType"):
            found[array.GetName()] = array, use
    return found


def _are_alike(pieces: list[Any], parts: Sequence[Part]) -> bool:
    """Whether pieces of an array have numbers for all samples of the parts, with as many components."""
    return all(piece is not None and piece[0].IsA("vtkDataArray") and piece[0].GetNumberOfTuples() == part.count
               and piece[0].GetNumberOfComponents() == pieces[0][0].GetNumberOfComponents()
               for piece, part in zip(pieces, parts))


def _joined(pieces: list[Any], uses: list[int]) -> SharedArray:
    types = {piece.GetDataType() for piece in pieces}
    numbers = [as_numpy(piece) for piece in pieces]
    use = uses[0] if len(set(uses)) == 1 and uses[0] != GLOBAL_IDS else -1
    return SharedArray(numbers[0] if len(numbers) == 1 else np.concatenate(numbers),
                       types.pop() if len(types) == 1 else DOUBLE, use, pieces[0], any(map(has_ids, pieces, uses)))
