// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_MarchingTetrahedra_h
#define isopoint_MarchingTetrahedra_h

#include "Core/Base/Collected.h"
#include "Core/Base/Execution.h"
#include "Core/Base/SortUnique.h"
#include "Core/Base/Vector.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Tetrahedra/BandTriangulation.h"
#include "Core/Tree/CoincidentSamples.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

namespace isopoint
{

/// Triangles on crossing edges.
template <class TSample>
struct EdgeTriangles
{
  /// One for each vertex, ordered, each once. Of edges whose crossings are one sample, since that
  /// has the isovalue, the first.
  std::vector<CrossingEdge<TSample>> edges;
  std::vector<Vector> positions;          // of the crossings
  std::vector<SurfaceTriangle> triangles; // ordered
};

/// Marching tetrahedra: the isosurface of the linear interpolation in each crossing tetrahedron.
template <class TSample>
class MarchingTetrahedra
{
public:
  using Id = typename TSample::Id;

  /// @param tetrahedra of leaves of the tree
  MarchingTetrahedra(const Execution& execution, const SampleTree<TSample>& tree,
    SharedLeafMeans<TSample>& means, double isovalue,
    const std::vector<CrossingTetrahedron<Id>>& tetrahedra)
    : Run(execution)
    , Tree(tree)
    , Means(means)
    , Isovalue(isovalue)
    , Tetrahedra(tetrahedra)
  {
  }

  /// @throws std::bad_alloc, Aborted
  /// Complexity: O(n log n)
  EdgeTriangles<TSample> march()
  {
    this->Pairs = sortedUnique(this->Run, this->allPairs(), this->Tree.nodes.size(),
      [](const LeafPair& pair) { return static_cast<std::uint64_t>(pair.first); });
    this->Run.progress(0.4);
    this->indexPairs();
    this->placeVertices();
    this->Run.progress(0.6);
    this->mergeAtSamples();
    const std::vector<SurfaceTriangle> triangles = this->allTriangles();
    return this->ordered(triangles);
  }

private:
  /// An edge, by the node indices of its ends in ascending order.
  using LeafPair = std::pair<Id, Id>;

  static LeafPair pairOf(Id a, Id b) { return std::minmax(a, b); }

  /// The edges of a tetrahedron that cross, around its polygon, with values falling to the front.
  struct Polygon
  {
    std::array<LeafPair, 4> pairs;
    std::size_t count;
  };

  static Polygon polygonOf(const CrossingTetrahedron<Id>& tetrahedron)
  {
    const auto& [a, b, c, d] = tetrahedron.corners;
    switch (tetrahedron.belowCount)
    {
      case 1:
        return { { pairOf(a, b), pairOf(a, d), pairOf(a, c) }, 3 };
      case 2:
        return { { pairOf(a, c), pairOf(b, c), pairOf(b, d), pairOf(a, d) }, 4 };
      default: // d is above
        return { { pairOf(d, a), pairOf(d, c), pairOf(d, b) }, 3 };
    }
  }

  std::vector<LeafPair> allPairs()
  {
    return this->collectedOfAll<LeafPair>(
      [&](std::size_t begin, std::size_t end, std::vector<LeafPair>& found)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          const Polygon polygon = polygonOf(this->Tetrahedra[i]);
          found.insert(found.end(), polygon.pairs.begin(),
            polygon.pairs.begin() + static_cast<std::ptrdiff_t>(polygon.count));
        }
        keepUnique(found);
      },
      isopoint::partOf(this->Run, 0.0, 0.2));
  }

  template <class T, class Collect>
  std::vector<T> collectedOfAll(const Collect& collect, const Execution& execution) const
  {
    constexpr std::size_t grain = 4096;
    return collected<T>(
      execution, { this->Tetrahedra.size(), 8 * grain, grain }, collect, execution.progress);
  }

  void placeVertices()
  {
    this->Edges.resize(this->Pairs.size());
    this->Positions.resize(this->Pairs.size());
    constexpr std::size_t grain = 4096;
    forBatches(this->Run, this->Pairs.size(), 8 * grain, grain,
      [&](std::size_t begin, std::size_t end)
      {
        LeafValueCache<TSample> values(this->Tree, this->Means);
        for (std::size_t i = begin; i < end; ++i)
        {
          const auto [lower, upper] = this->Pairs[i];
          const bool isLowerFirst = this->Tree.sampleOf(lower).id < this->Tree.sampleOf(upper).id;
          const Id first = isLowerFirst ? lower : upper;
          const Id second = isLowerFirst ? upper : lower;
          const double parameter = edgeParameter(values.at(static_cast<std::size_t>(first)),
            values.at(static_cast<std::size_t>(second)), this->Isovalue);
          this->Edges[i] = { { this->Tree.sampleOf(first).id, this->Tree.sampleOf(second).id },
            parameter, first, second };
          this->Positions[i] = interpolate(positionOf(this->Tree.sampleOf(first)),
            positionOf(this->Tree.sampleOf(second)), parameter);
        }
      });
  }

  /// Edges that cross at one of their ends are crossed at one vertex there.
  void mergeAtSamples()
  {
    this->VertexOf.resize(this->Edges.size());
    std::iota(this->VertexOf.begin(), this->VertexOf.end(), std::size_t{ 0 });
    std::unordered_map<Id, std::size_t> vertexAt; // by leaf
    const auto add = [&](Id leaf, std::size_t edge)
    {
      std::size_t& vertex = vertexAt.emplace(leaf, edge).first->second;
      if (this->Edges[edge] < this->Edges[vertex])
      {
        vertex = edge;
      }
    };
    std::vector<std::pair<std::size_t, Id>> merged;
    for (std::size_t i = 0; i < this->Edges.size(); ++i)
    {
      const CrossingEdge<TSample>& edge = this->Edges[i];
      for (const Id end : { edge.firstLeaf, edge.secondLeaf })
      {
        if (edge.crossing == (end == edge.firstLeaf ? 0.0 : 1.0) ||
            this->Positions[i] == positionOf(this->Tree.sampleOf(end)))
        {
          add(end, i);
          merged.emplace_back(i, end);
          break;
        }
      }
    }
    for (const auto& [edge, leaf] : merged)
    {
      this->VertexOf[edge] = vertexAt.at(leaf);
    }
  }

  /// Notes where the pairs of each few consecutive leaves begin.
  void indexPairs()
  {
    this->LeavesPerPart = 4 * this->Tree.nodes.size() / (this->Pairs.size() + 1) + 1;
    this->PartBegins.assign(this->Tree.nodes.size() / this->LeavesPerPart + 2, 0);
    for (const LeafPair& pair : this->Pairs)
    {
      ++this->PartBegins[this->partOf(pair) + 1];
    }
    std::partial_sum(this->PartBegins.begin(), this->PartBegins.end(), this->PartBegins.begin());
  }

  std::size_t partOf(const LeafPair& pair) const
  {
    return static_cast<std::size_t>(pair.first) / this->LeavesPerPart;
  }

  std::size_t vertexOn(const LeafPair& pair) const
  {
    const std::size_t part = this->partOf(pair);
    const auto placeOf = [this](std::size_t begin)
    { return this->Pairs.begin() + static_cast<std::ptrdiff_t>(begin); };
    const auto found =
      std::lower_bound(placeOf(this->PartBegins[part]), placeOf(this->PartBegins[part + 1]), pair);
    return this->VertexOf[static_cast<std::size_t>(found - this->Pairs.begin())];
  }

  /// The triangles, their vertices numbered as pairs are.
  std::vector<SurfaceTriangle> allTriangles()
  {
    return this->collectedOfAll<SurfaceTriangle>(
      [&](std::size_t begin, std::size_t end, std::vector<SurfaceTriangle>& found)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          this->addTriangles(polygonOf(this->Tetrahedra[i]), found);
        }
      },
      isopoint::partOf(this->Run, 0.6, 0.8));
  }

  void addTriangles(const Polygon& polygon, std::vector<SurfaceTriangle>& triangles) const
  {
    std::array<std::size_t, 4> corners;
    std::size_t count = 0;
    for (std::size_t i = 0; i < polygon.count; ++i)
    {
      const std::size_t corner = this->vertexOn(polygon.pairs[i]);
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
      const std::size_t from = this->cutsFirst(corners) ? 0 : 1;
      const auto corner = [&](std::size_t i) { return corners[(from + i) % 4]; };
      triangles.push_back({ corner(0), corner(1), corner(2) });
      triangles.push_back({ corner(2), corner(3), corner(0) });
    }
  }

  /// Whether a quadrilateral is cut from its first corner: along the shorter diagonal or, of equal
  /// ones, that from the vertex of the first edge.
  bool cutsFirst(const std::array<std::size_t, 4>& corners) const
  {
    const auto lengthBetween = [&](std::size_t a, std::size_t b)
    { return lengthOf(difference(this->Positions[corners[b]], this->Positions[corners[a]])); };
    const double first = lengthBetween(0, 2);
    const double second = lengthBetween(1, 3);
    if (first != second)
    {
      return first < second;
    }
    const auto lower = [&](std::size_t a, std::size_t b)
    { return std::min(this->Edges[corners[a]], this->Edges[corners[b]]); };
    return lower(0, 2) < lower(1, 3);
  }

  /// Orders vertices and triangles, and leaves out vertices without triangles.
  EdgeTriangles<TSample> ordered(const std::vector<SurfaceTriangle>& triangles) const
  {
    const std::vector<std::size_t> order =
      this->inOrderOfEdges(verticesOf(triangles, this->Edges.size()));
    EdgeTriangles<TSample> result;
    result.edges.resize(order.size());
    result.positions.resize(order.size());
    forEachIndex(this->Run, order.size(),
      [&](std::size_t place)
      {
        result.edges[place] = this->Edges[order[place]];
        result.positions[place] = this->Positions[order[place]];
      });
    result.triangles = renumbered(this->Run, triangles, order, this->Edges.size());
    return result;
  }

  /// A vertex, in the order of its edge.
  struct EdgeVertex : SampleEdge
  {
    std::size_t vertex;
  };

  std::vector<std::size_t> inOrderOfEdges(std::vector<std::size_t> vertices) const
  {
    std::vector<EdgeVertex> keyed;
    keyed.reserve(vertices.size());
    std::uint64_t most = 0;
    for (const std::size_t vertex : vertices)
    {
      keyed.push_back({ this->Edges[vertex], vertex });
      most = std::max(most, keyed.back().first);
    }
    keyed = sortedUnique(
      this->Run, keyed, most + 1, [](const EdgeVertex& vertex) { return vertex.first; });
    std::transform(keyed.begin(), keyed.end(), vertices.begin(),
      [](const EdgeVertex& vertex) { return vertex.vertex; });
    return vertices;
  }

  const Execution& Run;
  const SampleTree<TSample>& Tree;
  SharedLeafMeans<TSample>& Means;
  const double Isovalue;
  const std::vector<CrossingTetrahedron<Id>>& Tetrahedra;
  std::vector<LeafPair> Pairs; // of crossing edges, ordered
  std::size_t LeavesPerPart = 1;
  std::vector<std::size_t> PartBegins; // in the pairs, by their first leaves
  // One entry for each pair.
  std::vector<CrossingEdge<TSample>> Edges;
  std::vector<Vector> Positions;
  std::vector<std::size_t> VertexOf; // the pair whose vertex is that of this one
};

} // namespace isopoint

#endif
