// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Base/Offset.h"
#include "Core/Neighbors/GapCriterion.h"
#include "Core/Neighbors/GapSpread.h"
#include "Core/Neighbors/VoidCriterion.h"
#include "Core/Tetrahedra/PartialTriangulation.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// Crossing tetrahedra as the elements of GapSpread, connected by shared crossing facets.
template <class TSample>
class TetrahedronParts
{
public:
  using Tetrahedron = CrossingTetrahedron<typename TSample::Id>;

  TetrahedronParts(const SampleTree<TSample>& tree, const std::vector<Tetrahedron>& tetrahedra)
    : Tree(tree)
    , Tetrahedra(tetrahedra)
  {
  }

  std::size_t size() const { return this->Tetrahedra.size(); }

  /// True on the rank that owns the first corner, in the order of the tree.
  bool isCounted(std::size_t tetrahedron) const
  {
    const auto& corners = this->Tetrahedra[tetrahedron].corners;
    const auto first = *std::min_element(corners.begin(), corners.end(),
      [this](auto a, auto b) { return this->Tree.nodes[a].begin < this->Tree.nodes[b].begin; });
    return this->Tree.isOwn(this->Tree.nodes[first].begin);
  }

  template <class TRanks>
  void unite(TRanks& ranks, std::vector<std::size_t>& found) const
  {
    ranks.unite(found);
  }

  template <class Test>
  bool anyEdge(std::size_t tetrahedron, const Test& test) const
  {
    const auto& corners = this->Tetrahedra[tetrahedron].corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      for (std::size_t j = i + 1; j < corners.size(); ++j)
      {
        if (test(static_cast<std::size_t>(corners[i]), static_cast<std::size_t>(corners[j])))
        {
          return true;
        }
      }
    }
    return false;
  }

  /// O(tetrahedra at a corner), O(n) for the first call. @throws std::bad_alloc
  template <class Visit>
  void forEachNeighbor(const Execution& execution, std::size_t tetrahedron, const Visit& visit)
  {
    if (!this->AtLeaves)
    {
      this->AtLeaves.emplace(
        execution, this->Tree.nodes.size(),
        this->Tetrahedra.size(), [this](std::size_t item) -> const auto& {
          return this->Tetrahedra[item].corners;
        });
    }
    const auto& [corners, belowCount, isAtHull] = this->Tetrahedra[tetrahedron];
    for (std::size_t opposite = 0; opposite < 4; ++opposite)
    {
      const bool isBelow = opposite < belowCount;
      if (belowCount != (isBelow ? 1 : 3)) // otherwise all corners of the facet are on one side
      {
        this->visitAcross(tetrahedron, corners[opposite], visit);
      }
    }
  }

private:
  /// Visits the tetrahedron across the facet opposite a corner, if there is one.
  template <class Visit>
  void visitAcross(std::size_t tetrahedron, typename TSample::Id opposite, const Visit& visit) const
  {
    const auto& corners = this->Tetrahedra[tetrahedron].corners;
    // Searches at the corner with the fewest tetrahedra: one in a void has very many.
    std::size_t shared = static_cast<std::size_t>(corners[0] == opposite ? corners[1] : corners[0]);
    for (const auto corner : corners)
    {
      const auto leaf = static_cast<std::size_t>(corner);
      const bool hasFewer = this->AtLeaves->at(leaf).count < this->AtLeaves->at(shared).count;
      shared = corner != opposite && hasFewer ? leaf : shared;
    }
    for (const std::size_t other : this->AtLeaves->at(shared))
    {
      const auto& otherCorners = this->Tetrahedra[other].corners;
      const auto isShared = [&](typename TSample::Id corner)
      {
        return corner == opposite ||
               std::find(otherCorners.begin(), otherCorners.end(), corner) != otherCorners.end();
      };
      if (other != tetrahedron && std::all_of(corners.begin(), corners.end(), isShared))
      {
        visit(other);
      }
    }
  }

  const SampleTree<TSample>& Tree;
  const std::vector<Tetrahedron>& Tetrahedra;
  std::optional<ItemLists> AtLeaves; // tetrahedra; built when a gap is found
};

/// Finds the crossing tetrahedra that lie in gaps of the cloud or outside of it: docs/triangles.md.
/// With a process group, all functions are collective.
/// @tparam TRanks SingleRank, or SharedRanks
template <class TSample, class TRanks>
class GapTetrahedraFinder
{
public:
  using Id = typename TSample::Id;
  using Tetrahedron = CrossingTetrahedron<Id>;

  /// @param tetrahedra all crossing tetrahedra, in the same order on all ranks
  /// @param keepsHullSlivers see IsosurfaceRequest
  GapTetrahedraFinder(const Execution& execution, const SampleTree<TSample>& tree, TRanks& ranks,
    const std::vector<Tetrahedron>& tetrahedra, bool keepsHullSlivers)
    : Exec(execution)
    , Tree(tree)
    , Ranks(ranks)
    , Tetrahedra(tetrahedra)
    , KeepsHullSlivers(keepsHullSlivers)
    , Parts(tree, tetrahedra)
    , Spread(execution, tree, ranks, this->Parts)
  {
  }

  /// @returns for each tetrahedron whether it lies in a gap
  /// @throws std::bad_alloc, Aborted, FailedElsewhere
  std::vector<char> find()
  {
    if (this->KeepsHullSlivers)
    {
      this->Spread.spread(weakVoids(), this->seeds());
    }
    else
    {
      this->Spread.spread(RimCriterion(), this->seeds());
    }
    return this->withFragments(this->Spread.isInGap());
  }

private:
  /// The tetrahedra from which gaps spread. If slivers are kept, these span a void; otherwise the
  /// strong criterion rejects them, or they are at the hull.
  std::vector<std::size_t> seeds()
  {
    const std::vector<char> isDense = this->denseLeaves();
    const std::vector<std::size_t> candidates = itemsThat(this->Exec, this->Tetrahedra.size(),
      [&](std::size_t i)
      {
        const auto& corners = this->Tetrahedra[i].corners;
        return std::count_if(corners.begin(), corners.end(),
                 [&](Id leaf) { return isDense[static_cast<std::size_t>(leaf)] != 0; }) >= 2;
      });
    if (this->KeepsHullSlivers)
    {
      return this->Spread.rejectedAmong(strongVoids(), candidates);
    }
    std::vector<std::size_t> seeds = this->Spread.rejectedAmong(GapCriterion::strong(), candidates);
    const std::vector<std::size_t> atHull = itemsThat(this->Exec, this->Tetrahedra.size(),
      [&](std::size_t i) { return this->Tetrahedra[i].isAtHull; });
    seeds.insert(seeds.end(), atHull.begin(), atHull.end());
    return sortedUnique(this->Exec, seeds, this->Tetrahedra.size());
  }

  /// Marks, by node, the leaves whose longest edge the strong criterion may reject. Clouds without
  /// gaps have few, so that almost no edges are tested.
  std::vector<char> denseLeaves()
  {
    const std::vector<std::atomic<double>> longest = this->longestEdges(); // at each leaf, by node
    const std::vector<std::size_t> corners = // in the same order on all ranks
      inTreeOrder(this->Exec, this->Tree,
        itemsThat(this->Exec, longest.size(),
          [&longest](std::size_t leaf) { return longest[leaf] > 0.0; }));
    std::vector<char> marks(corners.size(), 0);
    constexpr std::size_t grain = 256;
    this->Ranks.forEach(
      this->Exec, { corners.size(), 8 * grain, grain }, []() { return 0; },
      [&](int, std::size_t i)
      {
        const std::size_t leaf = corners[i];
        marks[i] = this->Tree.hasOwn(this->Tree.nodes[leaf]) &&
                       GapCriterion::strong().mayDrop(this->Tree, pathToNode(this->Tree, leaf),
                         this->Tree.sampleOf(leaf), longest[leaf])
                     ? 1
                     : 0;
      },
      this->Exec.progress);
    std::vector<std::size_t> dense = markedOf(this->Exec, marks);
    this->Ranks.unite(dense);
    std::vector<char> marksOfNodes(longest.size(), 0);
    forEachInOrder(
      this->Exec, dense.size(), [&](std::size_t i) { marksOfNodes[corners[dense[i]]] = 1; });
    return marksOfNodes;
  }

  std::vector<std::atomic<double>> longestEdges() const
  {
    std::vector<std::atomic<double>> longest(this->Tree.nodes.size());
    const auto raise = [&longest](std::size_t leaf, double length)
    {
      double former = longest[leaf].load(std::memory_order_relaxed);
      while (former < length &&
             !longest[leaf].compare_exchange_weak(former, length, std::memory_order_relaxed))
      {
      }
    };
    constexpr std::size_t grain = 4096;
    forBatches(this->Exec, this->Tetrahedra.size(), 8 * grain, grain,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t tetrahedron = begin; tetrahedron < end; ++tetrahedron)
        {
          const auto& corners = this->Tetrahedra[tetrahedron].corners;
          std::array<Vector, 4> positions;
          std::transform(corners.begin(), corners.end(), positions.begin(),
            [this](Id corner) { return positionOf(this->Tree.sampleOf(corner)); });
          for (std::size_t i = 0; i < 4; ++i)
          {
            for (std::size_t j = i + 1; j < 4; ++j)
            {
              const double length = offsetBetween(positions[i], positions[j]).length;
              raise(static_cast<std::size_t>(corners[i]), length);
              raise(static_cast<std::size_t>(corners[j]), length);
            }
          }
        }
      });
    return longest;
  }

  /// Adds the small pieces that border on gaps.
  std::vector<char> withFragments(std::vector<char> isInGap)
  {
    std::vector<std::size_t> fragments;
    forEachInOrder(this->Exec, this->Tetrahedra.size(),
      [&](std::size_t i)
      {
        // Everything next to a gap was reached.
        if (this->Spread.isReached()[i] && !isInGap[i] && this->isBesideGap(i))
        {
          const std::vector<std::size_t> piece = this->pieceAround(i, isInGap);
          if (piece.size() < smallestPiece)
          {
            fragments.insert(fragments.end(), piece.begin(), piece.end());
          }
        }
      });
    forEachInOrder(this->Exec, fragments.size(), [&](std::size_t i) { isInGap[fragments[i]] = 1; });
    return isInGap;
  }

  bool isBesideGap(std::size_t tetrahedron)
  {
    bool isBeside = false;
    this->Parts.forEachNeighbor(this->Exec, tetrahedron,
      [&](std::size_t neighbor) { isBeside = isBeside || this->Spread.isInGap()[neighbor] != 0; });
    return isBeside;
  }

  /// The tetrahedra outside gaps connected to one by crossing facets, at most `smallestPiece`.
  std::vector<std::size_t> pieceAround(std::size_t tetrahedron, const std::vector<char>& isInGap)
  {
    std::vector<std::size_t> piece{ tetrahedron };
    for (std::size_t i = 0; i < piece.size() && piece.size() < smallestPiece; ++i)
    {
      this->Parts.forEachNeighbor(this->Exec, piece[i],
        [&](std::size_t neighbor)
        {
          if (!isInGap[neighbor] && piece.size() < smallestPiece &&
              std::find(piece.begin(), piece.end(), neighbor) == piece.end())
          {
            piece.push_back(neighbor);
          }
        });
    }
    return piece;
  }

  const Execution& Exec;
  const SampleTree<TSample>& Tree;
  TRanks& Ranks;
  const std::vector<Tetrahedron>& Tetrahedra;
  const bool KeepsHullSlivers;
  TetrahedronParts<TSample> Parts;
  GapSpread<TSample, TRanks, TetrahedronParts<TSample>> Spread;
};

} // namespace isopoint
