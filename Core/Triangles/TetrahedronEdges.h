// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/ConcurrentMemo.h"
#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Base/Sorting.h"
#include "Core/Neighbors/SampleSpacing.h"
#include "Core/Neighbors/VoidCriterion.h"
#include "Core/Tree/SampleBounds.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace isopoint
{

/// Applies criteria to the edges of tetrahedra, to each edge mostly once. With a process group, all
/// functions are collective.
/// @tparam TRanks SingleRank, or SharedRanks
template <class TSample, class TRanks>
class TetrahedronEdges
{
public:
  using Corners = std::array<std::size_t, 4>;

  /// @param cornersOf(tetrahedron) the leaves at its corners; called from any thread
  TetrahedronEdges(const Execution& execution, const SampleTree<TSample>& tree, TRanks& ranks,
    std::function<Corners(std::size_t tetrahedron)> cornersOf)
    : Run(execution)
    , Tree(tree)
    , Bounds(tree)
    , Ranks(ranks)
    , CornersOf(std::move(cornersOf))
  {
  }

  /// The tetrahedra with an edge that a criterion rejects.
  /// @param tetrahedra the same on all ranks
  /// @throws std::bad_alloc, Aborted, FailedElsewhere
  template <class TCriterion>
  std::vector<std::size_t> rejectedAmong(
    const TCriterion& criterion, const std::vector<std::size_t>& tetrahedra)
  {
    std::vector<std::size_t> found;
    for (std::size_t begin = 0; begin < tetrahedra.size(); begin += partSize)
    {
      const std::size_t count = std::min(partSize, tetrahedra.size() - begin);
      const std::vector<std::size_t> part = this->rejectedIn(criterion, &tetrahedra[begin], count);
      found.insert(found.end(), part.begin(), part.end());
    }
    return found;
  }

  /// How many edges were asked, with repetitions.
  std::size_t askedCount() const { return this->AskedCount; }

private:
  /// Edges of this many tetrahedra are listed at once: of these each is asked once. They take 200
  /// bytes for each tetrahedron, and as much for sorting.
  static constexpr std::size_t partSize = std::size_t{ 1 } << 18;

  /// Edges are ordered by the tree indices of their ends.
  struct Edge
  {
    std::array<std::size_t, 2> treeIndices; // ascending
    std::array<std::size_t, 2> leaves;      // in the same order

    bool operator<(const Edge& other) const { return this->treeIndices < other.treeIndices; }
    bool operator==(const Edge& other) const { return this->treeIndices == other.treeIndices; }
  };

  std::array<Edge, 6> edgesBetween(const Corners& corners) const
  {
    std::array<Edge, 6> edges;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 4; ++i)
    {
      for (std::size_t j = i + 1; j < 4; ++j)
      {
        const std::size_t a = this->Tree.nodes[corners[i]].begin;
        const std::size_t b = this->Tree.nodes[corners[j]].begin;
        edges[count++] = a < b ? Edge{ { a, b }, { corners[i], corners[j] } }
                               : Edge{ { b, a }, { corners[j], corners[i] } };
      }
    }
    return edges;
  }

  /// Those of some tetrahedra with an edge that a criterion rejects.
  template <class TCriterion>
  std::vector<std::size_t> rejectedIn(
    const TCriterion& criterion, const std::size_t* tetrahedra, std::size_t count)
  {
    std::vector<Edge> edges(6 * count);
    forEachIndex(this->Run, count,
      [&](std::size_t i)
      {
        const std::array<Edge, 6> six = this->edgesBetween(this->CornersOf(tetrahedra[i]));
        std::copy(six.begin(), six.end(), &edges[6 * i]);
      });
    const std::vector<Edge> rejected = this->rejectedOf(criterion, edges);
    std::vector<std::size_t> found = itemsThat(this->Run, count,
      [&](std::size_t i)
      {
        return std::any_of(&edges[6 * i], &edges[6 * i] + 6,
          [&](const Edge& edge)
          { return std::binary_search(rejected.begin(), rejected.end(), edge); });
      });
    std::transform(
      found.begin(), found.end(), found.begin(), [&](std::size_t i) { return tetrahedra[i]; });
    return found;
  }

  /// The edges that a criterion rejects, ordered. The rank that owns the first end asks it.
  /// @param edges with repetitions
  template <class TCriterion>
  std::vector<Edge> rejectedOf(const TCriterion& criterion, const std::vector<Edge>& edges)
  {
    const std::vector<Edge> distinct = sortedUnique(this->Run, edges, this->Tree.samples.size(),
      [](const Edge& edge) { return edge.treeIndices[0]; });
    this->AskedCount += distinct.size();
    if (distinct.size() > this->Tree.samples.size()) // samples on lines
    {
      this->Bounds.compute();
    }
    std::vector<std::size_t> found = itemsThat(this->Run, this->Ranks, distinct.size(),
      [&](std::size_t i)
      {
        return this->Tree.isOwn(distinct[i].treeIndices[0]) &&
               this->isRejected(criterion, distinct[i].leaves);
      });
    this->Ranks.unite(found);
    return chosenOf(this->Run, distinct, found);
  }

  template <class TCriterion>
  bool isRejected(const TCriterion& criterion, const std::array<std::size_t, 2>& leaves)
  {
    return criterion.rejects(
      this->Tree, this->Bounds, this->Tree.sampleOf(leaves[0]), this->Tree.sampleOf(leaves[1]));
  }

  template <class TCriterion>
  bool isRejected(
    const VoidCriterion<TCriterion>& criterion, const std::array<std::size_t, 2>& leaves)
  {
    return criterion.rejects(this->Tree, this->Bounds, this->Tree.sampleOf(leaves[0]),
      this->Tree.sampleOf(leaves[1]),
      std::array{ this->spacingAt(leaves[0]), this->spacingAt(leaves[1]) });
  }

  SampleSpacing spacingAt(std::size_t leaf)
  {
    return this->Spacings.at(
      leaf, [&]() { return SpacingSearch<TSample>(this->Tree, this->Tree.sampleOf(leaf)).find(); });
  }

  const Execution& Run;
  const SampleTree<TSample>& Tree;
  SampleBounds<TSample> Bounds;
  TRanks& Ranks;
  const std::function<Corners(std::size_t)> CornersOf;
  ConcurrentMemo<SampleSpacing> Spacings; // by leaf
  std::size_t AskedCount = 0;
};

} // namespace isopoint
