// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_AngleCriterion_h
#define isopoint_AngleCriterion_h

#include "Core/Base/Cosine.h"
#include "Core/Base/Offset.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// Just under arccos(1 / sqrt(3)) = 54.7356 degrees, the angle between an edge and a diagonal of
/// a cube: on a regular lattice the diagonals survive rounding.
constexpr double defaultAngle = 54.7;

/// Sorts a neighborhood as AngleCriterion::survivesAmongSorted() requires, whose result does not
/// depend on the order of equal distances.
inline void nearestFirst(std::vector<Offset>& offsets)
{
  std::sort(offsets.begin(), offsets.end(),
    [](const Offset& a, const Offset& b) { return a.squaredLength < b.squaredLength; });
}

/// The angle criterion ([RL06] section 6; docs/algorithm.md, section 5): a neighbor is
/// dropped if the angle between it and any strictly closer one, dropped itself or not, is smaller
/// than the given one. Neighbors at the same distance do not drop each other.
class AngleCriterion
{
public:
  /// @param degrees 0 (nothing is dropped) up to 180 (all nearest neighbors survive, and of the
  /// others what stands exactly opposite, as far as rounding permits)
  explicit AngleCriterion(double degrees)
    : DropsNothing(degrees <= 0.0)
    , Cosine(cosineOf(degrees * 3.14159265358979323846 / 180.0))
  {
  }

  /// Whether `offsets[candidate]` survives among all `count` offsets of a neighborhood. O(count)
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

  /// The same in a neighborhood sorted by nearestFirst(). The nearest ones, seen in many
  /// directions, mostly drop the others: far less than O(count) except for the few that survive.
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

  /// Whether z is closer than all y within the bounds and drops them. Conservative: may be false
  /// where z drops them all, never true where it does not.
  bool dropsAll(const Offset& z, const OffsetBounds& y) const
  {
    const double squaredLength =
      this->Cosine > 0.0 ? y.greatestSquaredLength : y.leastSquaredLength;
    return z.squaredLength < y.leastSquaredLength &&
           leastProduct(z, y) > this->Cosine * (std::sqrt(squaredLength) * z.length);
  }

  /// Whether a z within the bounds might be closer than y and drop it. Conservative: may be true
  /// where none does, never false where one does.
  bool mayDrop(const OffsetBounds& z, const Offset& y) const
  {
    const double squaredLength =
      this->Cosine > 0.0 ? z.leastSquaredLength : z.greatestSquaredLength;
    return z.leastSquaredLength < y.squaredLength &&
           greatestProduct(y, z) > this->Cosine * (y.length * std::sqrt(squaredLength));
  }

  bool dropsNothing() const { return this->DropsNothing; }

  /// Whether z is strictly closer than y and drops it.
  bool isDroppedBy(const Offset& y, const Offset& z) const
  {
    return z.squaredLength < y.squaredLength && this->drops(z, y);
  }

private:
  /// Whether the angle between z and y is smaller than the given one.
  bool drops(const Offset& z, const Offset& y) const
  {
    return dot(y.vector, z.vector) > this->Cosine * (y.length * z.length);
  }

  bool DropsNothing;
  double Cosine;
};

} // namespace isopoint

#endif
