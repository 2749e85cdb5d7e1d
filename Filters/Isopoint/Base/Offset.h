// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Offset_h
#define isopoint_Offset_h

#include <algorithm>
#include <cmath>

namespace isopoint
{

/// A neighbour as seen from the sample whose neighbourhood it belongs to.
struct Offset
{
  double vector[3];
  double squaredLength;
  double length;
};

inline Offset offsetBetween(const double from[3], const double to[3])
{
  Offset offset;
  for (int axis = 0; axis < 3; ++axis)
  {
    offset.vector[axis] = to[axis] - from[axis];
  }
  offset.squaredLength = offset.vector[0] * offset.vector[0] + offset.vector[1] * offset.vector[1] +
                         offset.vector[2] * offset.vector[2];
  offset.length = std::sqrt(offset.squaredLength);
  return offset;
}

/// Bounds on the offsets from a position to all those in a box. They hold for what
/// offsetBetween() computes, to the last bit, not for the exact offsets alone: each operation in it
/// is monotonic, rounding included. So are those in AngleCriterion, and with them the bounds tell
/// what it does with every offset at once. Nothing may overflow for that.
struct OffsetBounds
{
  double lower[3];
  double upper[3];
  double leastSquaredLength;
  double greatestSquaredLength;
};

template <class TCoordinate>
OffsetBounds offsetsToBox(
  const double from[3], const TCoordinate lower[3], const TCoordinate upper[3])
{
  OffsetBounds bounds;
  double least[3];
  double greatest[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds.lower[axis] = lower[axis] - from[axis];
    bounds.upper[axis] = upper[axis] - from[axis];
    least[axis] = std::max({ bounds.lower[axis], -bounds.upper[axis], 0.0 });
    greatest[axis] = std::max(-bounds.lower[axis], bounds.upper[axis]);
  }
  bounds.leastSquaredLength = least[0] * least[0] + least[1] * least[1] + least[2] * least[2];
  bounds.greatestSquaredLength =
    greatest[0] * greatest[0] + greatest[1] * greatest[1] + greatest[2] * greatest[2];
  return bounds;
}

/// The least, or the greatest, of the scalar products with an offset, summed as AngleCriterion
/// does.
/// @param choose(a, b) the lesser or the greater of two
template <class Choice>
double extremeProduct(const Offset& offset, const OffsetBounds& bounds, const Choice& choose)
{
  double products[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    products[axis] =
      choose(bounds.lower[axis] * offset.vector[axis], bounds.upper[axis] * offset.vector[axis]);
  }
  return products[0] + products[1] + products[2];
}

inline double leastProduct(const Offset& offset, const OffsetBounds& bounds)
{
  return extremeProduct(offset, bounds, [](double a, double b) { return std::min(a, b); });
}

inline double greatestProduct(const Offset& offset, const OffsetBounds& bounds)
{
  return extremeProduct(offset, bounds, [](double a, double b) { return std::max(a, b); });
}

} // namespace isopoint

#endif
