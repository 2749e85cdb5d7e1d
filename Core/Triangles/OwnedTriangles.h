// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Triangles/SurfaceTriangle.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// The triangles of one rank.
struct OwnedTriangles
{
  std::vector<std::size_t> vertices;        // their numbers in the whole surface, ascending
  std::vector<bool> areGhosts;              // whether each is counted on another rank
  std::vector<SurfaceTriangle> triangles;   // indices into `vertices`; ghosts last
  std::vector<std::size_t> triangleNumbers; // in the whole surface
  std::size_t ghostCount = 0;
};

/// The triangles that belong to the rank of their first vertex, and ghosts. Vertices are counted on
/// the rank of their first triangle.
/// @param triangles of the whole surface; every vertex has one
/// @param vertexRanks the rank of each vertex
/// @param ghostRings number of rings of other ranks' triangles to add, each with all triangles that
/// share a vertex with those so far
/// @throws std::bad_alloc, Aborted
/// Complexity: O(vertices + triangles) per ring
OwnedTriangles ownedTriangles(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<std::size_t>& vertexRanks,
  std::size_t rank, int ghostRings);

} // namespace isopoint
