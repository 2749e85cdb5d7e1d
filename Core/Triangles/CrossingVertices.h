// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Base/Sorting.h"
#include "Core/Base/Vector.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Tetrahedra/PartialTriangulation.h"
#include "Core/Tree/CoincidentSamples.h"
#include "Core/Triangles/CapFacet.h"
#include "Core/Triangles/VertexMerging.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace isopoint
{

/// The order of edges, used for coincident crossings and equal diagonals.
enum class EdgeOrder
{
  Ids, // by the ids of their ends
  Tree // by the tree indices of their ends, independent of sample ids
};

/// A surface in a tetrahedralization, before vertices are merged.
template <class TSample>
struct MarchedTriangles
{
  std::vector<CrossingEdge<TSample>> edges; // by crossing, sorted by the edges' ends in the tree
  CrossingMesh mesh;                        // each vertex is one crossing
  std::vector<std::size_t> nearerEnds;      // of the edges, numbered in the order of the tree
  std::size_t endCount = 0;                 // exceeds all of these numbers
};

/// The order of edges by their ends' ids; equal ones stay in theirs. @throws std::bad_alloc,
/// Aborted
/// @param edgeOf(i) the edge of each of `count` items
template <class EdgeOf>
std::vector<std::size_t> orderOfEdges(
  const Execution& execution, std::size_t count, const EdgeOf& edgeOf)
{
  std::uint64_t most = 0;
  forEachInOrder(execution, count, [&](std::size_t i) { most = std::max(most, edgeOf(i).first); });
  return orderByKeys(
    execution, count, most + 1, [&](std::size_t i) -> SampleEdge { return edgeOf(i); },
    [](const SampleEdge& edge) { return edge.first; });
}

/// The vertices of a surface in a tetrahedralization: crossing edges of tetrahedra and, at the
/// border of a body, samples. Each is a *pair* of leaves, twice the same for a sample.
template <class TSample>
class CrossingVertices
{
public:
  using Id = typename TSample::Id;

  /// The numbers of an edge's ends, ascending.
  using LeafPair = std::pair<Id, Id>;

  /// A polygon of pairs, counterclockwise seen from lower values.
  struct Polygon
  {
    std::array<LeafPair, 4> pairs;
    std::size_t count;
  };

  /// @param tetrahedra, caps their corners are leaves of the tree
  CrossingVertices(const Execution& execution, const SampleTree<TSample>& tree,
    LeafValues<TSample>& values, double isovalue, EdgeOrder order,
    const std::vector<LeafTetrahedron>& tetrahedra, const std::vector<CapFacet>& caps)
    : Run(execution)
    , Tree(tree)
    , Values(values)
    , Isovalue(isovalue)
    , Order(order)
    , Tetrahedra(tetrahedra)
    , Caps(caps)
  {
  }

  /// Finds and places all vertices. O(n log n) @throws std::bad_alloc, Aborted
  void find()
  {
    this->numberLeaves();
    this->Pairs = sortedUnique(this->Run, this->allPairs(), this->Leaves.size(),
      [](const LeafPair& pair) { return static_cast<std::uint64_t>(pair.first); });
    this->Run.progress(0.7);
    this->indexPairs();
    this->placeVertices();
    this->mergeAtSamples();
    this->Run.progress(1.0);
  }

  Polygon polygonOf(const LeafTetrahedron& tetrahedron) const
  {
    const auto numberOf = [&](std::size_t corner)
    { return this->NumberOf[tetrahedron.corners[corner]]; };
    const Id a = numberOf(0);
    const Id b = numberOf(1);
    const Id c = numberOf(2);
    const Id d = numberOf(3);
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

  /// The polygon of a cap: its part that is not below the isovalue. Sets, per side of the facet
  /// with an end that is not below, the corner of the polygon at which its part begins.
  Polygon polygonOf(const CapFacet& cap, std::array<std::size_t, 3>& begins) const
  {
    Polygon polygon{};
    for (std::size_t side = 0; side < 3; ++side)
    {
      const std::size_t next = (side + 1) % 3;
      const Id start = this->NumberOf[cap.corners[side]];
      const Id end = this->NumberOf[cap.corners[next]];
      begins[side] = polygon.count;
      if (!cap.areBelow[side])
      {
        polygon.pairs[polygon.count++] = { start, start };
      }
      if (cap.areBelow[side] != cap.areBelow[next])
      {
        polygon.pairs[polygon.count++] = pairOf(start, end);
      }
    }
    return polygon;
  }

  std::size_t pairCount() const { return this->Pairs.size(); }

  /// The number of a pair, ascending in the order of the tree.
  std::size_t numberOf(const LeafPair& pair) const
  {
    const LeafPair* const all = this->Pairs.data();
    const LeafPair* const found = std::lower_bound(
      all + this->PairBegins[pair.first], all + this->PairBegins[pair.first + 1], pair);
    return static_cast<std::size_t>(found - all);
  }

  /// The pair whose vertex represents that of a pair: another one if it crosses at a sample.
  std::size_t vertexOf(std::size_t pair) const { return this->VertexOf[pair]; }

  /// By the number of a pair.
  const std::vector<CrossingEdge<TSample>>& edges() const { return this->Edges; }

  /// The crossings of some pairs, without triangles. @throws std::bad_alloc, Aborted
  MarchedTriangles<TSample> chosen(const std::vector<std::size_t>& pairs) const
  {
    MarchedTriangles<TSample> result;
    result.edges = chosenOf(this->Run, this->Edges, pairs);
    result.mesh.positions = chosenOf(this->Run, this->Positions, pairs);
    result.mesh.members = iota(pairs.size());
    result.nearerEnds = chosenOf(this->Run, this->NearerEnds, pairs);
    result.endCount = this->Leaves.size();
    return result;
  }

  /// Splits a polygon into triangles: a quadrilateral along the shorter diagonal or, if equal,
  /// along the one from the vertex of the first edge.
  /// @param count of the corners, which are pairs; less than 3 for no triangle
  /// @param add(triangle) called for each
  /// @returns the corner at which the first triangle begins
  template <class Add>
  std::size_t split(
    const std::array<std::size_t, 4>& corners, std::size_t count, const Add& add) const
  {
    const std::size_t from = count == 4 && !this->cutsFirst(corners) ? 1 : 0;
    const auto corner = [&](std::size_t i) { return corners[(from + i) % count]; };
    if (count >= 3)
    {
      add(SurfaceTriangle{ corner(0), corner(1), corner(2) });
    }
    if (count == 4)
    {
      add(SurfaceTriangle{ corner(2), corner(3), corner(0) });
    }
    return from;
  }

private:
  /// The end at which an edge crosses, if any; tested from either end, because of rounding.
  enum class End : char
  {
    Neither,
    Lower,
    Upper
  };

  /// Whether to split a quadrilateral at its first corner.
  bool cutsFirst(const std::array<std::size_t, 4>& corners) const
  {
    const auto lengthBetween = [&](std::size_t a, std::size_t b)
    { return lengthOf(this->Positions[corners[b]] - this->Positions[corners[a]]); };
    const double first = lengthBetween(0, 2);
    const double second = lengthBetween(1, 3);
    if (first != second)
    {
      return first < second;
    }
    const auto firstOf = [&](std::size_t a, std::size_t b)
    { return this->isBefore(corners[a], corners[b]) ? corners[a] : corners[b]; };
    return this->isBefore(firstOf(0, 2), firstOf(1, 3));
  }

  static LeafPair pairOf(Id a, Id b) { return std::minmax(a, b); }

  bool isAtSample(std::size_t pair) const
  {
    return this->Pairs[pair].first == this->Pairs[pair].second;
  }

  /// Numbers the corner leaves in the order of the tree.
  void numberLeaves()
  {
    std::vector<bool> isCorner(this->Tree.nodes.size(), false);
    const auto mark = [&isCorner](const auto& corners)
    {
      for (const std::size_t corner : corners)
      {
        isCorner[corner] = true;
      }
    };
    forEachInOrder(this->Run, this->Tetrahedra.size(),
      [&](std::size_t i) { mark(this->Tetrahedra[i].corners); });
    forEachInOrder(
      this->Run, this->Caps.size(), [&](std::size_t i) { mark(this->Caps[i].corners); });
    const std::vector<std::size_t> leaves =
      inTreeOrder(this->Run, this->Tree, markedOf(this->Run, isCorner));
    this->Leaves.resize(leaves.size());
    this->NumberOf.resize(this->Tree.nodes.size());
    forEachIndex(this->Run, leaves.size(),
      [&](std::size_t number)
      {
        this->NumberOf[leaves[number]] = static_cast<Id>(number);
        this->Leaves[number] = static_cast<Id>(leaves[number]);
      });
  }

  std::size_t leafOf(Id number) const { return this->Leaves[number]; }

  std::vector<LeafPair> allPairs()
  {
    constexpr std::size_t grain = 4096;
    std::vector<LeafPair> pairs =
      collected<LeafPair>(this->Run, { this->Tetrahedra.size(), 8 * grain, grain },
        [&](std::size_t begin, std::size_t end, std::vector<LeafPair>& found)
        {
          for (std::size_t i = begin; i < end; ++i)
          {
            add(this->polygonOf(this->Tetrahedra[i]), found);
          }
          keepUnique(found);
        });
    std::array<std::size_t, 3> begins{};
    forEachInOrder(this->Run, this->Caps.size(),
      [&](std::size_t i) { add(this->polygonOf(this->Caps[i], begins), pairs); });
    return pairs;
  }

  static void add(const Polygon& polygon, std::vector<LeafPair>& pairs)
  {
    pairs.insert(pairs.end(), polygon.pairs.data(), polygon.pairs.data() + polygon.count);
  }

  void indexPairs()
  {
    this->PairBegins.assign(this->Leaves.size() + 1, 0);
    // Pairs are ordered: where the first leaf changes, the lists of leaves begin.
    forEachIndex(this->Run, this->Pairs.size(),
      [this](std::size_t i)
      {
        const auto leaf = static_cast<std::size_t>(this->Pairs[i].first);
        const std::size_t last =
          i + 1 < this->Pairs.size() ? this->Pairs[i + 1].first : this->Leaves.size();
        std::fill(this->PairBegins.data() + leaf + 1, this->PairBegins.data() + last + 1, i + 1);
      });
  }

  void placeVertices()
  {
    this->Edges.resize(this->Pairs.size());
    this->Positions.resize(this->Pairs.size());
    this->NearerEnds.resize(this->Pairs.size());
    this->Ends.resize(this->Pairs.size());
    forEachIndex(
      this->Run, this->Pairs.size(), [this](std::size_t pair) { this->placeVertex(pair); });
  }

  void placeVertex(std::size_t vertex)
  {
    const auto [lower, upper] = this->Pairs[vertex];
    const std::size_t lowerLeaf = this->leafOf(lower);
    const std::size_t upperLeaf = this->leafOf(upper);
    const TSample& lowerSample = this->Tree.sampleOf(lowerLeaf);
    const TSample& upperSample = this->Tree.sampleOf(upperLeaf);
    const double lowerValue = this->Values.at(lowerLeaf);
    const double upperValue = this->Values.at(upperLeaf);
    const bool isSample = lower == upper;
    const double upwards = isSample ? 0.0 : edgeParameter(lowerValue, upperValue, this->Isovalue);
    this->NearerEnds[vertex] = upwards <= 0.5 ? lower : upper;
    const bool isLowerFirst = lowerSample.id < upperSample.id;
    const double downwards = isSample ? 0.0 : edgeParameter(upperValue, lowerValue, this->Isovalue);
    this->Edges[vertex] = isLowerFirst
                            ? CrossingEdge<TSample>{ { lowerSample.id, upperSample.id }, upwards,
                                static_cast<Id>(lowerLeaf), static_cast<Id>(upperLeaf) }
                            : CrossingEdge<TSample>{ { upperSample.id, lowerSample.id }, downwards,
                                static_cast<Id>(upperLeaf), static_cast<Id>(lowerLeaf) };
    const Vector atLower = positionOf(lowerSample);
    const Vector atUpper = positionOf(upperSample);
    const std::array<Vector, 2> crossings{ interpolate(atLower, atUpper, upwards),
      interpolate(atUpper, atLower, downwards) };
    this->Positions[vertex] = crossings[isLowerFirst || this->Order == EdgeOrder::Tree ? 0 : 1];
    const auto isOneOf = [&](const Vector& end)
    { return crossings[0] == end || crossings[1] == end; };
    this->Ends[vertex] = upwards == 0.0 || downwards == 1.0 || isOneOf(atLower)   ? End::Lower
                         : upwards == 1.0 || downwards == 0.0 || isOneOf(atUpper) ? End::Upper
                                                                                  : End::Neither;
  }

  bool isBefore(std::size_t a, std::size_t b) const
  {
    return this->Order == EdgeOrder::Tree ? a < b : this->Edges[a] < this->Edges[b];
  }

  /// Merges the vertices of edges that cross at the same end. A vertex at the sample represents
  /// them if there is one.
  void mergeAtSamples()
  {
    this->VertexOf = iota(this->Edges.size());
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> vertexAt(this->Leaves.size(), none); // by end
    const auto add = [&](std::size_t end, std::size_t edge)
    {
      std::size_t& vertex = vertexAt[end];
      vertex = vertex == none ? edge : vertex;
      if (this->isAtSample(edge) != this->isAtSample(vertex) ? this->isAtSample(edge)
                                                             : this->isBefore(edge, vertex))
      {
        vertex = edge;
      }
    };
    const auto endOf = [this](std::size_t edge)
    {
      const auto& [lower, upper] = this->Pairs[edge];
      return this->Ends[edge] == End::Lower ? lower : upper;
    };
    const std::vector<std::size_t> merged = itemsThat(this->Run, this->Edges.size(),
      [this](std::size_t edge) { return this->Ends[edge] != End::Neither; });
    forEachInOrder(
      this->Run, merged.size(), [&](std::size_t i) { add(endOf(merged[i]), merged[i]); });
    forEachIndex(this->Run, merged.size(),
      [&](std::size_t i) { this->VertexOf[merged[i]] = vertexAt[endOf(merged[i])]; });
  }

  const Execution& Run;
  const SampleTree<TSample>& Tree;
  LeafValues<TSample>& Values;
  const double Isovalue;
  const EdgeOrder Order;
  const std::vector<LeafTetrahedron>& Tetrahedra;
  const std::vector<CapFacet>& Caps;
  std::vector<Id> Leaves;              // by number
  std::vector<Id> NumberOf;            // by leaf
  std::vector<LeafPair> Pairs;         // ordered
  std::vector<std::size_t> PairBegins; // by the number of their first leaf
  // One entry per pair.
  std::vector<CrossingEdge<TSample>> Edges;
  std::vector<Vector> Positions;
  std::vector<std::size_t> NearerEnds;
  std::vector<End> Ends;             // if the crossing is at an end
  std::vector<std::size_t> VertexOf; // the pair that represents this pair's vertex
};

} // namespace isopoint
