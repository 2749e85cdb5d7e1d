# SPDX-License-Identifier: GPL-3.0-or-later
"""The accessor `scattered` of PyVista's data sets, which PyVista finds through the entry point group
pyvista.accessors."""

from __future__ import annotations

from typing import Any, Optional, Sequence, Union

import numpy as np
import pyvista as pv

from . import _datasets
from ._progress import Progress
from ._samples import Samples
from ._splats import polygons_of


@pv.register_dataset_accessor("scattered", pv.DataObject)
class ScatteredAccessor:
    """Isosurfaces of points without a mesh: ``dataset.scattered.contour()``.

    The cells of grids are not used: their points, or the centers of their cells, are the samples.
    """

    def __init__(self, dataset: Any):
        if not (dataset.IsA("vtkDataSet") or dataset.IsA("vtkCompositeDataSet")):
            raise TypeError(f"A {type(dataset).__name__} has no samples: make a pyvista.PolyData of its"
                            " positions first.")
        self._dataset = dataset
        self._samples: Optional[Samples] = None
        self._loaded: Any = None  # what the samples are of

    def contour(
        self,
        isosurfaces: Union[int, Sequence[float]] = 10,
        scalars: Union[str, np.ndarray, None] = None,
        *,
        triangles: bool = True,
        rng: Optional[Sequence[float]] = None,
        preference: str = "point",
        progress_bar: bool = False,
        **options: Any,
    ) -> pv.PolyData:
        """Extract isosurfaces from scattered samples.

        Parameters
        ----------
        isosurfaces : int | sequence[float], default: 10
            Number of isosurfaces, evenly spaced over ``rng``, or their values.
        scalars : str | array_like[float], optional
            Name of an array of points or cells, or values for each of them. By default the active
            scalars.
        triangles : bool, default: True
            Whether to connect points by triangles. ``False`` yields isopoints with normals and radii,
            which :meth:`splats` turns into polygons.
        rng : sequence[float], optional
            Range of values of a number of isosurfaces. By default that of all samples.
        preference : str, default: "point"
            Whether ``scalars`` names an array of points or cells, ``"point"`` or ``"cell"``, where
            both have one.
        progress_bar : bool, default: False
            Display a progress bar, for which tqdm or rich is needed.
        **options : dict, optional
            Options of :func:`scatteredisopoints.contour`, such as ``drop_gaps=False``.

        Returns
        -------
        pyvista.PolyData
            The isosurfaces, with ``Normals`` and all arrays of the samples.

        Notes
        -----
        The tree is kept: further isosurfaces of the same data take a fraction of the time. Samples are
        loaded again when the data set or its scalars are changed as PyVista notices it, as by
        ``mesh["a"] = ...`` or ``mesh.points[0] = ...``; call ``mesh.Modified()`` after other changes.

        Examples
        --------
        >>> import numpy as np
        >>> import pyvista as pv
        >>> cloud = pv.PolyData(np.random.default_rng(1).random((20000, 3)))
        >>> cloud["distance"] = np.linalg.norm(cloud.points - 0.5, axis=1)
        >>> surface = cloud.scattered.contour([0.3], "distance")
        >>> surface.is_manifold
        True
        """
        samples = self._load(scalars, preference, progress_bar)
        if isinstance(isosurfaces, (int, np.integer)) and not isinstance(isosurfaces, bool):
            least, greatest = samples.range if rng is None else rng
            isosurfaces = np.linspace(least, greatest, isosurfaces)
            if rng is None:  # nothing is beyond the least and the greatest value
                isosurfaces = isosurfaces[(isosurfaces > least) & (isosurfaces < greatest)]
        surface = samples._contour(
            isosurfaces, triangles, None, progress_bar, options, stacklevel=3)
        return surface.polydata

    def splats(self, scale: float = 1.0) -> pv.PolyData:
        """Turn isopoints into the polygons that show them as a closed surface.

        Parameters
        ----------
        scale : float, default: 1.0
            Factor on the size of splats.

        Returns
        -------
        pyvista.PolyData
            Triangles with normals: draw them with ``smooth_shading=True``.

        Notes
        -----
        Filters that keep the cells of points, such as ``clip`` and ``threshold``, keep their splats.
        Points with normals alone become octagons.

        Examples
        --------
        >>> isopoints = cloud.scattered.contour([0.3], triangles=False)  # doctest: +SKIP
        >>> isopoints.scattered.splats().plot(smooth_shading=True)  # doctest: +SKIP
        """
        return polygons_of(self._dataset, "Radius", 0.0, scale).polydata

    def _load(self, scalars: Any, preference: str, progress: Progress) -> Samples:
        if preference not in ("point", "cell"):
            raise ValueError(f"preference cannot be {preference!r}: it is 'point' or 'cell'")
        leaves = [leaf for leaf in _datasets.leaves(self._dataset) if leaf is not None]
        if scalars is None and leaves:
            info = leaves[0].active_scalars_info
            scalars = info.name
            preference = info.association.name.lower()
            if scalars is None:
                raise ValueError("There are no active scalars: give the name of an array as scalars.")
        loaded = None
        if isinstance(scalars, str):
            loaded = scalars, preference, tuple(leaf.GetMTime() for leaf in leaves)
        if loaded is None or loaded != self._loaded:
            self._samples = Samples(
                _datasets.samples_of(self._dataset, scalars, preference == "cell"), progress=progress)
            self._loaded = loaded
        return self._samples
