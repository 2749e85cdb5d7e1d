// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace isopoint
{

/// The spacing of samples around one of them (docs/algorithm.md, section 10.1). For one thread.
class SampleSpacing
{
public:
  void clear() { this->Neighbors.clear(); }

  /// @param offset to a neighbor, not zero
  void add(const Vector& offset)
  {
    this->Neighbors.push_back({ offset, lengthOf(offset), this->Neighbors.size() });
  }

  /// The distance within which two fifths of the sample and its neighbors are; or, if well less,
  /// that at which the neighbors span space. The farthest may be across a void; the nearest may all
  /// be on a line or in a slice with the sample. O(n log n)
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

  /// The distance at which the nearest neighbors span space; infinite if they do not. The nearest
  /// one defines a line; the next, more than 30 degrees off the line, defines a plane; the result
  /// is the distance of the next more than 30 degrees off the plane.
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
