// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"

#include <algorithm>
#include <cmath>

namespace isopoint
{

/// The vector from a sample to a neighbor, and its length.
struct Offset
{
  Vector vector;
  double squaredLength;
  double length;
};

inline Offset offsetBetween(const Vector& from, const Vector& to)
{
  Offset offset;
  offset.vector = to - from;
  offset.squaredLength = dot(offset.vector, offset.vector);
  offset.length = std::sqrt(offset.squaredLength);
  return offset;
}

/// Bounds on the offsets from a position to all positions in a box. They hold to the last bit for
/// the results of offsetBetween(), since each of its operations is monotonic, rounding included.
/// The same holds for AngleCriterion, which can therefore judge all these offsets at once.
/// Precondition: nothing overflows.
struct OffsetBounds
{
  Vector lower;
  Vector upper;
  double minSquaredLength;
  double greatestSquaredLength;
};

/// @param lower, upper corners of the box, three coordinates each
template <class TBound>
OffsetBounds offsetsToBox(const Vector& from, const TBound& lower, const TBound& upper)
{
  OffsetBounds bounds;
  Vector least;
  Vector greatest;
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds.lower[axis] = lower[axis] - from[axis];
    bounds.upper[axis] = upper[axis] - from[axis];
    least[axis] = std::max({ bounds.lower[axis], -bounds.upper[axis], 0.0 });
    greatest[axis] = std::max(-bounds.lower[axis], bounds.upper[axis]);
  }
  bounds.minSquaredLength = dot(least, least);
  bounds.greatestSquaredLength = dot(greatest, greatest);
  return bounds;
}

/// The least or greatest scalar product with an offset, summed in AngleCriterion's order.
/// @param choose(a, b) std::min or std::max
template <class Choice>
double extremeProduct(const Offset& offset, const OffsetBounds& bounds, const Choice& choose)
{
  Vector products;
  for (int axis = 0; axis < 3; ++axis)
  {
    products[axis] =
      choose(bounds.lower[axis] * offset.vector[axis], bounds.upper[axis] * offset.vector[axis]);
  }
  return products[0] + products[1] + products[2];
}

inline double minProduct(const Offset& offset, const OffsetBounds& bounds)
{
  return extremeProduct(offset, bounds, [](double a, double b) { return std::min(a, b); });
}

inline double greatestProduct(const Offset& offset, const OffsetBounds& bounds)
{
  return extremeProduct(offset, bounds, [](double a, double b) { return std::max(a, b); });
}

} // namespace isopoint
