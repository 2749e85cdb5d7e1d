# SPDX-License-Identifier: GPL-3.0-or-later
"""Values at places as a function: see Samples.interpolator()."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._arrays import readable

if TYPE_CHECKING:
    from ._samples import Samples


class Interpolator:
    """Interpolates one array of kept samples, as SciPy's interpolators do. :meth:`Samples.interpolator` makes it: the
    constructor is private."""

    def __init__(self, samples: Samples, array: Any, options: dict[str, Any]):
        self._samples = samples
        self._array = array
        self._options = options

    def __repr__(self) -> str:
        name = self._array if isinstance(self._array, str) else self._samples._name or "values"
        return f'<Interpolator: "{name}" of {len(self._samples)} samples, method {self._options["method"]!r}>'

    def __call__(self, *x: Any) -> np.ndarray:
        """The values at places.

        Parameters
        ----------
        *x
            Places, shape (..., 3), or three arrays of coordinates that broadcast.

        Returns
        -------
        The shape of the places without their last axis, followed by the components of the array.
        """
        return self._evaluate(x, False)

    def gradient(self, *x: Any) -> np.ndarray:
        """The gradients at places: the shape of the values, followed by the three derivatives."""
        return self._evaluate(x, True)

    def _evaluate(self, x: tuple, gradient: bool) -> np.ndarray:
        if len(x) not in (1, 3):
            raise TypeError(f"an interpolator takes places, shape (..., 3), or x, y and z: not {len(x)} arguments")
        numbers = [readable("places", each) for each in x]
        places = numbers[0] if len(x) == 1 else np.stack(np.broadcast_arrays(*numbers), axis=-1)
        found = self._samples._probe(places, self._array, gradient, **self._options, progress=None, stacklevel=4,
                                     seeks_gaps=False)
        return found[1] if gradient else found
