// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Triangles/CrossingVertices.h"

#include <array>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// Marching tetrahedra: the isosurface of linear interpolation in each crossing tetrahedron.
/// @param tetrahedra their corners are leaves of the tree
/// @throws std::bad_alloc, Aborted
/// Complexity: O(n log n)
template <class TSample>
MarchedTriangles<TSample> marchTetrahedra(const Execution& execution,
  const SampleTree<TSample>& tree, LeafValues<TSample>& values, double isovalue, EdgeOrder order,
  const std::vector<LeafTetrahedron>& tetrahedra)
{
  const Execution findExecution = partOf(execution, 0.0, 0.6);
  const std::vector<CapFacet> noCaps;
  CrossingVertices<TSample> vertices(
    findExecution, tree, values, isovalue, order, tetrahedra, noCaps);
  vertices.find();
  const std::vector<SurfaceTriangle> triangles = collectedFromEach<SurfaceTriangle>(
    execution, tetrahedra.size(),
    [&](std::size_t i, std::vector<SurfaceTriangle>& found)
    {
      const auto polygon = vertices.polygonOf(tetrahedra[i]);
      std::array<std::size_t, 4> corners{};
      std::size_t count = 0;
      for (std::size_t k = 0; k < polygon.count; ++k)
      {
        const std::size_t corner = vertices.vertexOf(vertices.numberOf(polygon.pairs[k]));
        if (count == 0 || (corner != corners[count - 1] && corner != corners[0]))
        {
          corners[count++] = corner;
        }
      }
      vertices.split(
        corners, count, [&found](const SurfaceTriangle& each) { found.push_back(each); });
    },
    partOf(execution, 0.6, 0.8).progress);
  const std::vector<std::size_t> used = verticesOf(execution, triangles, vertices.pairCount());
  MarchedTriangles<TSample> result = vertices.chosen(used);
  result.mesh.triangles =
    renumbered(execution, triangles, inverseOf(execution, used, vertices.pairCount()), used.size());
  return result;
}

} // namespace isopoint
