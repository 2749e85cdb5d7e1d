// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Base/Vector.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Tetrahedra/PartialTriangulation.h"
#include "Core/Tree/CoincidentSamples.h"
#include "Core/Triangles/EdgeTriangles.h"
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

/// The order of edges, used for coincident crossings and equal diagonals.
enum class EdgeOrder
{
  Ids, // by the ids of their ends
  Tree // by the places of their ends in the tree, independent of sample ids
};

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
    , Tree(tree)
    , Values(values)
    , Isovalue(isovalue)
    , Order(order)
    , Tetrahedra(tetrahedra)
  {
  }

  /// @throws std::bad_alloc, Aborted
  /// Complexity: O(n log n)
  MarchedTriangles<TSample> march()
  {
    this->numberLeaves();
    this->Pairs = sortedUnique(this->Exec, this->allPairs(), this->Leaves.size(),
      [](const LeafPair& pair) { return static_cast<std::uint64_t>(pair.first); });
    this->Exec.progress(0.4);
    this->indexPairs();
    this->placeVertices();
    this->Exec.progress(0.6);
    this->mergeAtSamples();
    const std::vector<SurfaceTriangle> triangles = this->allTriangles();
    return this->withUsedVertices(triangles);
  }

private:
  /// The numbers of an edge's ends, ascending.
  using LeafPair = std::pair<Id, Id>;

  static LeafPair pairOf(Id a, Id b) { return std::minmax(a, b); }

  /// The end at which an edge crosses, if any; tested from either end, because of rounding.
  enum class End : char
  {
    Neither,
    Lower,
    Upper
  };

  /// Numbers the corner leaves in the order of the tree.
  void numberLeaves()
  {
    std::vector<bool> isCorner(this->Tree.nodes.size(), false);
    forEachInOrder(this->Exec, this->Tetrahedra.size(),
      [&](std::size_t i)
      {
        for (const Id corner : this->Tetrahedra[i].corners)
        {
          isCorner[static_cast<std::size_t>(corner)] = true;
        }
      });
    const std::vector<std::size_t> leaves =
      inTreeOrder(this->Exec, this->Tree, markedOf(this->Exec, isCorner));
    this->Leaves.resize(leaves.size());
    this->NumberOf.resize(this->Tree.nodes.size());
    forEachIndex(this->Exec, leaves.size(),
      [&](std::size_t number)
      {
        this->NumberOf[leaves[number]] = static_cast<Id>(number);
        this->Leaves[number] = static_cast<Id>(leaves[number]);
      });
  }

  std::size_t leafOf(Id number) const
  {
    return static_cast<std::size_t>(this->Leaves[static_cast<std::size_t>(number)]);
  }

  /// The crossing edges of a tetrahedron, counterclockwise seen from lower values.
  struct Polygon
  {
    std::array<LeafPair, 4> pairs;
    std::size_t count;
  };

  Polygon polygonOf(const CrossingTetrahedron<Id>& tetrahedron) const
  {
    const auto numberOf = [&](std::size_t corner)
    { return this->NumberOf[static_cast<std::size_t>(tetrahedron.corners[corner])]; };
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
      isopoint::partOf(this->Exec, 0.0, 0.2));
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
    this->NearerEnds.resize(this->Pairs.size());
    this->Ends.resize(this->Pairs.size());
    constexpr std::size_t grain = 4096;
    forBatches(this->Exec, this->Pairs.size(), 8 * grain, grain,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          this->placeVertex(i);
        }
      });
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
    const double upwards = edgeParameter(lowerValue, upperValue, this->Isovalue);
    this->NearerEnds[vertex] = static_cast<std::size_t>(upwards <= 0.5 ? lower : upper);
    const bool isLowerFirst = lowerSample.id < upperSample.id;
    const double downwards = edgeParameter(upperValue, lowerValue, this->Isovalue);
    this->Edges[vertex] = isLowerFirst
                            ? CrossingEdge<TSample>{ { lowerSample.id, upperSample.id }, upwards,
                                static_cast<Id>(lowerLeaf), static_cast<Id>(upperLeaf) }
                            : CrossingEdge<TSample>{ { upperSample.id, lowerSample.id }, downwards,
                                static_cast<Id>(upperLeaf), static_cast<Id>(lowerLeaf) };
    const Vector atLower = positionOf(lowerSample);
    const Vector atUpper = positionOf(upperSample);
    const std::array<Vector, 2> places{ interpolate(atLower, atUpper, upwards),
      interpolate(atUpper, atLower, downwards) };
    this->Positions[vertex] = places[isLowerFirst || this->Order == EdgeOrder::Tree ? 0 : 1];
    const auto isOneOf = [&](const Vector& end) { return places[0] == end || places[1] == end; };
    this->Ends[vertex] = upwards == 0.0 || downwards == 1.0 || isOneOf(atLower)   ? End::Lower
                         : upwards == 1.0 || downwards == 0.0 || isOneOf(atUpper) ? End::Upper
                                                                                  : End::Neither;
  }

  bool isBefore(std::size_t a, std::size_t b) const
  {
    return this->Order == EdgeOrder::Tree ? a < b : this->Edges[a] < this->Edges[b];
  }

  /// Merges the vertices of edges that cross at the same end.
  void mergeAtSamples()
  {
    this->VertexOf.resize(this->Edges.size());
    std::iota(this->VertexOf.begin(), this->VertexOf.end(), std::size_t{ 0 });
    std::unordered_map<Id, std::size_t> vertexAt; // by end
    const auto add = [&](Id end, std::size_t edge)
    {
      std::size_t& vertex = vertexAt.emplace(end, edge).first->second;
      if (this->isBefore(edge, vertex))
      {
        vertex = edge;
      }
    };
    const auto endOf = [this](std::size_t edge)
    {
      const auto& [lower, upper] = this->Pairs[edge];
      return this->Ends[edge] == End::Lower ? lower : upper;
    };
    const std::vector<std::size_t> merged = itemsThat(this->Exec, this->Edges.size(),
      [this](std::size_t edge) { return this->Ends[edge] != End::Neither; });
    forEachInOrder(
      this->Exec, merged.size(), [&](std::size_t i) { add(endOf(merged[i]), merged[i]); });
    forEachIndex(this->Exec, merged.size(),
      [&](std::size_t i) { this->VertexOf[merged[i]] = vertexAt.at(endOf(merged[i])); });
  }

  void indexPairs()
  {
    this->PairBegins.assign(this->Leaves.size() + 1, 0);
    // Pairs are ordered: where the first leaf changes, the lists of leaves begin.
    forEachIndex(this->Exec, this->Pairs.size(),
      [this](std::size_t i)
      {
        const auto leaf = static_cast<std::size_t>(this->Pairs[i].first);
        const std::size_t last = i + 1 < this->Pairs.size()
                                   ? static_cast<std::size_t>(this->Pairs[i + 1].first)
                                   : this->Leaves.size();
        std::fill(this->PairBegins.begin() + static_cast<std::ptrdiff_t>(leaf) + 1,
          this->PairBegins.begin() + static_cast<std::ptrdiff_t>(last) + 1, i + 1);
      });
  }

  std::size_t vertexOn(const LeafPair& pair) const
  {
    const auto placeOf = [this](std::size_t begin)
    { return this->Pairs.begin() + static_cast<std::ptrdiff_t>(begin); };
    const auto leaf = static_cast<std::size_t>(pair.first);
    const auto found =
      std::lower_bound(placeOf(this->PairBegins[leaf]), placeOf(this->PairBegins[leaf + 1]), pair);
    return this->VertexOf[static_cast<std::size_t>(found - this->Pairs.begin())];
  }

  /// The triangles, with the numbers of pairs as vertices.
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
      isopoint::partOf(this->Exec, 0.6, 0.8));
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

  /// Whether to split a quadrilateral at its first corner: along the shorter diagonal or, if equal,
  /// along the one from the vertex of the first edge.
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

  /// Orders the triangles, and drops unused vertices.
  MarchedTriangles<TSample> withUsedVertices(const std::vector<SurfaceTriangle>& triangles) const
  {
    const std::vector<std::size_t> used = verticesOf(this->Exec, triangles, this->Edges.size());
    MarchedTriangles<TSample> result;
    result.edges = chosenOf(this->Exec, this->Edges, used);
    result.positions = chosenOf(this->Exec, this->Positions, used);
    result.nearerEnds = chosenOf(this->Exec, this->NearerEnds, used);
    result.endCount = this->Leaves.size();
    result.triangles = renumbered(this->Exec, triangles, used, this->Edges.size());
    return result;
  }

  const Execution& Exec;
  const SampleTree<TSample>& Tree;
  LeafValues<TSample>& Values;
  const double Isovalue;
  const EdgeOrder Order;
  const std::vector<CrossingTetrahedron<Id>>& Tetrahedra;
  std::vector<Id> Leaves;              // by number
  std::vector<Id> NumberOf;            // by leaf
  std::vector<LeafPair> Pairs;         // of crossing edges, ordered
  std::vector<std::size_t> PairBegins; // by the number of their first leaf
  // One entry per pair.
  std::vector<CrossingEdge<TSample>> Edges;
  std::vector<Vector> Positions;
  std::vector<std::size_t> NearerEnds;
  std::vector<End> Ends;             // if the crossing is at an end
  std::vector<std::size_t> VertexOf; // the pair that represents this pair's vertex
};

} // namespace isopoint
