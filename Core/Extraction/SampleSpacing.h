// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SampleSpacing_h
#define isopoint_SampleSpacing_h

#include "Core/Base/Vector.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace isopoint
{

/// The spacing of the samples around one of them; see docs/algorithm.md, section 10.1. Memory is
/// kept. For one thread.
class SampleSpacing
{
public:
  /// Forgets all neighbors.
  void clear() { this->Neighbors.clear(); }

  /// Adds a neighbor at another position.
  void add(const Vector& offset)
  {
    this->Neighbors.push_back({ offset, lengthOf(offset), this->Neighbors.size() });
  }

  /// The distance that two fifths of the neighbors and the sample itself do not exceed, or that at
  /// which they span space, if that is well less. The farthest may be across a void, the nearest
  /// all on one line or in one slice with the sample.
  /// Complexity: O(n log n)
  double spacing()
  {
    std::sort(this->Neighbors.begin(), this->Neighbors.end(),
      [](const Neighbor& a, const Neighbor& b)
      { return a.distance != b.distance ? a.distance < b.distance : a.number < b.number; });
    constexpr double spanShare = 1.2;
    const std::size_t rank = 2 * (this->Neighbors.size() + 1) / 5;
    const double usual = rank > 0 ? this->Neighbors[rank - 1].distance : 0.0;
    return std::min(usual, spanShare * this->distanceThatSpans());
  }

private:
  struct Neighbor
  {
    Vector offset;
    double distance;
    std::size_t number;
  };

  /// The distance of the nearest neighbor that is more than 30 degrees off the plane of the nearest
  /// one and the nearest that is more than 30 degrees off the line of that; infinite without any.
  double distanceThatSpans() const
  {
    constexpr double sine = 0.5;
    constexpr double cosine = 0.86602540378443865;
    std::optional<Vector> line;
    std::optional<Vector> normal; // of the plane
    for (const Neighbor& neighbor : this->Neighbors)
    {
      const Vector direction = directionOf(neighbor.offset);
      if (normal && std::abs(dot(direction, *normal)) > sine)
      {
        return neighbor.distance;
      }
      if (line && !normal && std::abs(dot(direction, *line)) < cosine)
      {
        normal = directionOf(cross(direction, *line));
      }
      line = line ? line : direction;
    }
    return std::numeric_limits<double>::infinity();
  }

  std::vector<Neighbor> Neighbors;
};

} // namespace isopoint

#endif
