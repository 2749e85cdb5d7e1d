// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// The number of rounds in which short edges are merged.
constexpr int shortEdgeRounds = 3;

struct ShortEdge
{
  double share; // its length over the side of an equilateral triangle of their mean area
  std::size_t first;
  std::size_t second; // above the first

  bool operator<(const ShortEdge& other) const
  {
    return this->share != other.share   ? this->share < other.share
           : this->first != other.first ? this->first < other.first
                                        : this->second < other.second;
  }
};

/// Edges shorter than 0.55 sides of an equilateral triangle, shortest first. Its area is the mean
/// of the areas of the triangles at both ends. O(n log n)
/// @returns an edge of several triangles several times
/// @throws std::bad_alloc
std::vector<ShortEdge> shortEdges(
  const std::vector<Vector>& positions, const std::vector<SurfaceTriangle>& triangles);

} // namespace isopoint
