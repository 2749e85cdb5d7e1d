# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of contour() and its family: names and types, for type checkers, completion and the C library."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypedDict, Union, get_type_hints

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


class OptionsOfPoints(TypedDict, total=False):
    """Options of contour() for points alone."""

    angle: float
    compute_splats: bool
    number_of_neighbors: int


class OptionsOfTriangles(TypedDict, total=False):
    """Options of contour() for triangles alone."""

    capping: bool
    minimum_piece_size: float
    regularize: bool


class ContourOptions(OptionsOfPoints, OptionsOfTriangles, total=False):
    """Options of contour()."""

    compute_gradients: bool
    compute_normals: bool
    compute_projection_orders: bool
    compute_scalars: bool
    drop_gaps: bool
    gradient_direction: Literal["descent", "ascent"]
    keep_tree: bool
    normal_method: Constant
    output_points_precision: Constant
    projection: Union[Constant, None]


OPTION_TYPES = get_type_hints(ContourOptions)
"""The type of each option of contour()."""

MEMBERS = (
    "triangles", "projection", "normal_method", "drop_gaps", "compute_normals", "compute_gradients",
    "compute_projection_orders", "output_points_precision", "number_of_neighbors", "compute_splats", "angle",
    "keep_tetrahedra", "regularize", "keep_hull_slivers", "capping", "minimum_piece_size")
"""The members of isopoint_options after its size, in its order: double if their type here is float, else int32_t."""
