// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Triangles/CrossingVertices.h"
#include "Core/Triangles/EdgeTriangles.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <array>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// Marching tetrahedra: the isosurface of linear interpolation in each crossing tetrahedron.
template <class TSample>
class MarchingTetrahedra
{
public:
  using Id = typename TSample::Id;

  /// @param tetrahedra their corners are leaves of the tree
  MarchingTetrahedra(const Execution& execution, const SampleTree<TSample>& tree,
    LeafValues<TSample>& values, double isovalue, EdgeOrder order,
    const std::vector<CrossingTetrahedron<Id>>& tetrahedra)
    : Exec(execution)
    , Tetrahedra(tetrahedra)
    , FindExec(partOf(execution, 0.0, 0.6))
    , Vertices(this->FindExec, tree, values, isovalue, order, tetrahedra, this->NoCaps)
  {
  }

  /// @throws std::bad_alloc, Aborted
  /// Complexity: O(n log n)
  MarchedTriangles<TSample> march()
  {
    this->Vertices.find();
    return this->withUsedVertices(this->allTriangles());
  }

private:
  using Polygon = typename CrossingVertices<TSample>::Polygon;

  /// The triangles, with the numbers of pairs as vertices.
  std::vector<SurfaceTriangle> allTriangles()
  {
    constexpr std::size_t grain = 4096;
    return collected<SurfaceTriangle>(
      this->Exec, { this->Tetrahedra.size(), 8 * grain, grain },
      [&](std::size_t begin, std::size_t end, std::vector<SurfaceTriangle>& found)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          this->addTriangles(this->Vertices.polygonOf(this->Tetrahedra[i]), found);
        }
      },
      partOf(this->Exec, 0.6, 0.8).progress);
  }

  void addTriangles(const Polygon& polygon, std::vector<SurfaceTriangle>& triangles) const
  {
    std::array<std::size_t, 4> corners;
    std::size_t count = 0;
    for (std::size_t i = 0; i < polygon.count; ++i)
    {
      const std::size_t corner = this->Vertices.vertexOf(this->Vertices.numberOf(polygon.pairs[i]));
      if (count == 0 || (corner != corners[count - 1] && corner != corners[0]))
      {
        corners[count++] = corner;
      }
    }
    if (count == 3)
    {
      triangles.push_back({ corners[0], corners[1], corners[2] });
    }
    else if (count == 4)
    {
      const std::size_t from = this->Vertices.cutsFirst(corners) ? 0 : 1;
      const auto corner = [&](std::size_t i) { return corners[(from + i) % 4]; };
      triangles.push_back({ corner(0), corner(1), corner(2) });
      triangles.push_back({ corner(2), corner(3), corner(0) });
    }
  }

  /// Orders the triangles, and drops unused vertices.
  MarchedTriangles<TSample> withUsedVertices(const std::vector<SurfaceTriangle>& triangles) const
  {
    const std::size_t count = this->Vertices.pairCount();
    const std::vector<std::size_t> used = verticesOf(this->Exec, triangles, count);
    MarchedTriangles<TSample> result;
    result.edges = chosenOf(this->Exec, this->Vertices.edges(), used);
    result.positions = chosenOf(this->Exec, this->Vertices.positions(), used);
    result.nearerEnds = chosenOf(this->Exec, this->Vertices.nearerEnds(), used);
    result.endCount = this->Vertices.endCount();
    result.triangles = renumbered(this->Exec, triangles, used, count);
    return result;
  }

  const Execution& Exec;
  const std::vector<CrossingTetrahedron<Id>>& Tetrahedra;
  const Execution FindExec;
  const std::vector<CapFacet<Id>> NoCaps;
  CrossingVertices<TSample> Vertices;
};

} // namespace isopoint
