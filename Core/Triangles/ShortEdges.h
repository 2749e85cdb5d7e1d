// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_ShortEdges_h
#define isopoint_ShortEdges_h

#include "Core/Base/Vector.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// How often short edges are merged.
constexpr int shortEdgeRounds = 3;

/// An edge that is short beside the triangles around it.
struct ShortEdge
{
  double share; // of the side of an equilateral triangle that is as large as they are in the mean
  std::size_t first;
  std::size_t second; // above the first

  bool operator<(const ShortEdge& other) const
  {
    return this->share != other.share   ? this->share < other.share
           : this->first != other.first ? this->first < other.first
                                        : this->second < other.second;
  }
};

/// The edges that are shorter than 0.55 times the side of an equilateral triangle, the shortest
/// first. Its area is the mean over the triangles around one end and those around the other.
/// @returns edges of several triangles once for each
/// @throws std::bad_alloc
/// Complexity: O(n log n)
std::vector<ShortEdge> shortEdges(
  const std::vector<Vector>& positions, const std::vector<SurfaceTriangle>& triangles);

} // namespace isopoint

#endif
