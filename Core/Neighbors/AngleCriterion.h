// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Cosine.h"
#include "Core/Base/Offset.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// In degrees. Just under arccos(1 / sqrt 3) = 54.7356, the angle between an edge and a diagonal of
/// a cube, so that the diagonals of a regular lattice survive rounding.
constexpr double defaultAngle = 54.7;

/// Sorts for AngleCriterion::survivesAmongSorted(). The order of equal distances does not matter.
inline void nearestFirst(std::vector<Offset>& offsets)
{
  std::sort(offsets.begin(), offsets.end(),
    [](const Offset& a, const Offset& b) { return a.squaredLength < b.squaredLength; });
}

/// The angle criterion ([RL06] section 6; docs/algorithm.md, section 5): drops a neighbor if its
/// angle to any strictly closer neighbor, dropped or not, is smaller than a given angle. Neighbors
/// at the same distance do not drop each other.
class AngleCriterion
{
public:
  /// @param degrees from 0 (drops nothing) to 180 (keeps the nearest neighbors and, as far as
  /// rounding permits, those exactly opposite)
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

  /// Whether an offset survives in a neighborhood sorted by nearestFirst(). Mostly far less than
  /// O(count), since the nearest neighbors drop most others; O(count) for survivors.
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

  /// Whether z is closer than all y within the bounds and drops them; false if uncertain.
  bool dropsAll(const Offset& z, const OffsetBounds& y) const
  {
    const double squaredLength = this->Cosine > 0.0 ? y.greatestSquaredLength : y.minSquaredLength;
    return z.squaredLength < y.minSquaredLength &&
           minProduct(z, y) > this->Cosine * (std::sqrt(squaredLength) * z.length);
  }

  /// Whether any z within the bounds is closer than y and drops it; true if uncertain.
  bool mayDrop(const OffsetBounds& z, const Offset& y) const
  {
    const double squaredLength = this->Cosine > 0.0 ? z.minSquaredLength : z.greatestSquaredLength;
    return z.minSquaredLength < y.squaredLength &&
           greatestProduct(y, z) > this->Cosine * (y.length * std::sqrt(squaredLength));
  }

  bool dropsNothing() const { return this->DropsNothing; }

  /// Whether z is strictly closer than y and drops it.
  bool isDroppedBy(const Offset& y, const Offset& z) const
  {
    return z.squaredLength < y.squaredLength && this->drops(z, y);
  }

private:
  bool drops(const Offset& z, const Offset& y) const
  {
    return dot(y.vector, z.vector) > this->Cosine * (y.length * z.length);
  }

  bool DropsNothing;
  double Cosine;
};

} // namespace isopoint
