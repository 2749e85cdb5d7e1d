# SPDX-License-Identifier: GPL-3.0-or-later
"""Names and types of options, for type checkers and completion."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypedDict, Union

if TYPE_CHECKING:
    from typing_extensions import Unpack as Unpack
else:
    try:
        from typing import Unpack  # since Python 3.11
    except ImportError:
        class Unpack:
            """Keyword arguments of any type."""

            def __class_getitem__(cls, _types):
                return Any

Constant = Union[str, int]
"""The name or the number of a constant."""


class BodyOptions(TypedDict, total=False):
    """Options of body()."""

    drop_gaps: bool
    minimum_piece_size: float
    output_points_precision: Constant


class SliceOptions(TypedDict, total=False):
    """Options of slice_samples()."""

    drop_gaps: bool
    output_points_precision: Constant
    regularize: bool


class ContourOptions(TypedDict, total=False):
    """Options of contour()."""

    angle: float
    capping: bool
    compute_gradients: bool
    compute_normals: bool
    compute_projection_orders: bool
    compute_scalars: bool
    compute_splats: bool
    drop_gaps: bool
    gradient_direction: Literal["descent", "ascent"]
    keep_tree: bool
    minimum_piece_size: float
    normal_method: Constant
    number_of_neighbors: int
    output_points_precision: Constant
    projection: Union[Constant, None]
    regularize: bool


class OptionsOfContour(ContourOptions, total=False):
    """Options of contour() alone."""

    controller: Any
