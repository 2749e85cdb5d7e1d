// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_AngleCriterion_h
#define isopoint_AngleCriterion_h

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// Just under arccos(1 / sqrt(3)) = 54.7356 degrees, the angle between an edge and a diagonal of
/// a cube: on a regular lattice the diagonals survive rounding.
constexpr double defaultAngle = 54.7;

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

/// The order in which AngleCriterion::survivesAmongSorted() takes a neighbourhood.
inline void nearestFirst(std::vector<Offset>& offsets)
{
  std::sort(offsets.begin(), offsets.end(),
    [](const Offset& a, const Offset& b) { return a.squaredLength < b.squaredLength; });
}

/// The angle criterion (section 6 of the paper): a neighbour is dropped if any strictly closer one,
/// dropped itself or not, lies under a smaller angle than the given one.
class AngleCriterion
{
public:
  /// @param degrees 0 (nothing is dropped) up to 180 (the nearest neighbour remains, and what lies
  /// exactly opposite)
  explicit AngleCriterion(double degrees)
    : DropsNothing(degrees <= 0.0)
    , Cosine(std::cos(degrees * 3.14159265358979323846 / 180.0))
  {
  }

  /// Whether `offsets[candidate]` survives among all `count` offsets of a neighbourhood. O(count)
  bool survives(const Offset* offsets, std::size_t count, std::size_t candidate) const
  {
    if (this->DropsNothing)
    {
      return true;
    }
    const Offset& y = offsets[candidate];
    for (std::size_t i = 0; i < count; ++i)
    {
      if (offsets[i].squaredLength < y.squaredLength && this->drops(offsets[i], y))
      {
        return false;
      }
    }
    return true;
  }

  /// The same of a neighbourhood sorted by nearestFirst(), for which the nearest ones, seen in many
  /// directions, decide most often: far less than O(count) for all but the few that survive.
  bool survivesAmongSorted(const Offset* offsets, const Offset& y) const
  {
    for (; !this->DropsNothing && offsets->squaredLength < y.squaredLength; ++offsets)
    {
      if (this->drops(*offsets, y))
      {
        return false;
      }
    }
    return true;
  }

private:
  /// Whether z lies under a smaller angle from y than the given one.
  bool drops(const Offset& z, const Offset& y) const
  {
    const double product =
      y.vector[0] * z.vector[0] + y.vector[1] * z.vector[1] + y.vector[2] * z.vector[2];
    return product > this->Cosine * (y.length * z.length);
  }

  bool DropsNothing;
  double Cosine;
};

} // namespace isopoint

#endif
