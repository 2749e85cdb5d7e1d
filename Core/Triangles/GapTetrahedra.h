// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Hash.h"
#include "Core/Base/Lists.h"
#include "Core/Base/Offset.h"
#include "Core/Neighbors/GapCriterion.h"
#include "Core/Neighbors/GapSpread.h"
#include "Core/Neighbors/VoidCriterion.h"
#include "Core/Tetrahedra/PartialTriangulation.h"
#include "Core/Triangles/TetrahedronEdges.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace isopoint
{

/// Crossing tetrahedra as the elements of GapSpread, connected by shared crossing facets.
class ConnectedTetrahedra
{
public:
  /// @param nodeCount of the tree
  ConnectedTetrahedra(const std::vector<LeafTetrahedron>& tetrahedra, std::size_t nodeCount)
    : Tetrahedra(tetrahedra)
    , NodeCount(nodeCount)
  {
  }

  std::size_t size() const { return this->Tetrahedra.size(); }

  /// O(n) for the first call. @throws std::bad_alloc, Aborted
  void connect(const Execution& execution, const std::vector<std::size_t>& some)
  {
    if (!this->AtLeaves && !some.empty())
    {
      this->AtLeaves.emplace(
        execution, this->NodeCount, this->size(), [this](std::size_t item) -> const auto& {
          return this->Tetrahedra[item].corners;
        });
      if (this->haveManyAtAllCorners(execution))
      {
        this->AtFacets.emplace(execution, this->size(), this->size(),
          [this](std::size_t item)
          {
            const auto& corners = this->Tetrahedra[item].corners;
            return std::array{ this->facetKey(corners, corners[0]),
              this->facetKey(corners, corners[1]), this->facetKey(corners, corners[2]),
              this->facetKey(corners, corners[3]) };
          });
      }
    }
  }

  bool isConnected(std::size_t /*tetrahedron*/) const { return this->AtLeaves.has_value(); }

  /// O(1) mostly
  template <class Visit>
  void forEachNeighbor(std::size_t tetrahedron, const Visit& visit) const
  {
    const auto& [corners, belowCount, isAtHull] = this->Tetrahedra[tetrahedron];
    for (std::size_t opposite = 0; opposite < 4 && this->AtLeaves; ++opposite)
    {
      const bool isBelow = opposite < belowCount;
      if (belowCount != (isBelow ? 1 : 3)) // otherwise all corners of the facet are on one side
      {
        this->visitAcross(tetrahedron, corners[opposite], visit);
      }
    }
  }

private:
  using Corners = std::array<std::size_t, 4>;

  /// Whether a tetrahedron has many others at each corner, as all have in clouds on curves.
  bool haveManyAtAllCorners(const Execution& execution) const
  {
    constexpr std::size_t many = 256;
    bool haveMany = false;
    forEachInOrder(execution, this->size(),
      [&](std::size_t tetrahedron)
      {
        const Corners& corners = this->Tetrahedra[tetrahedron].corners;
        haveMany =
          haveMany || std::all_of(corners.begin(), corners.end(),
                        [&](std::size_t leaf) { return this->AtLeaves->at(leaf).count > many; });
      });
    return haveMany;
  }

  /// A key of the facet opposite a corner, which few others have.
  std::size_t facetKey(Corners corners, std::size_t opposite) const
  {
    std::swap(*std::find(corners.begin(), corners.end(), opposite), corners.back());
    std::sort(corners.begin(), corners.end() - 1);
    return hashOf(std::array<std::uint64_t, 3>{ corners[0], corners[1], corners[2] }.data(), 3) %
           this->size();
  }

  /// Visits the tetrahedron across the facet opposite a corner, if there is one.
  template <class Visit>
  void visitAcross(std::size_t tetrahedron, std::size_t opposite, const Visit& visit) const
  {
    const Corners& corners = this->Tetrahedra[tetrahedron].corners;
    // Searches at the corner with the fewest tetrahedra: one in a void has very many.
    std::size_t shared = corners[0] == opposite ? corners[1] : corners[0];
    for (const std::size_t leaf : corners)
    {
      const bool hasFewer = this->AtLeaves->at(leaf).count < this->AtLeaves->at(shared).count;
      shared = leaf != opposite && hasFewer ? leaf : shared;
    }
    const IndexSpan<std::size_t> candidates =
      this->AtFacets ? this->AtFacets->at(this->facetKey(corners, opposite))
                     : this->AtLeaves->at(shared);
    for (const std::size_t other : candidates)
    {
      const auto& otherCorners = this->Tetrahedra[other].corners;
      const auto isShared = [&](std::size_t corner)
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

  const std::vector<LeafTetrahedron>& Tetrahedra;
  const std::size_t NodeCount;
  std::optional<ItemLists> AtLeaves; // tetrahedra; built when a gap is found
  std::optional<ItemLists> AtFacets; // by key; only if lists at leaves are long
};

/// Finds the crossing tetrahedra that lie in gaps of the cloud or outside of it: docs/triangles.md.
/// With a process group, all functions are collective.
/// @tparam TRanks SingleRank, or SharedRanks
template <class TSample, class TRanks>
class GapTetrahedraFinder
{
public:
  /// @param tetrahedra all crossing tetrahedra, in the same order on all ranks
  /// @param keepsHullSlivers see IsosurfaceRequest
  GapTetrahedraFinder(const Execution& execution, const SampleTree<TSample>& tree, TRanks& ranks,
    const std::vector<LeafTetrahedron>& tetrahedra, bool keepsHullSlivers)
    : Run(execution)
    , Tree(tree)
    , Ranks(ranks)
    , Tetrahedra(tetrahedra)
    , KeepsHullSlivers(keepsHullSlivers)
    , Edges(execution, tree, ranks, [&tetrahedra](std::size_t i) { return tetrahedra[i].corners; })
  {
  }

  /// @returns for each tetrahedron whether it lies in a gap
  /// @throws std::bad_alloc, Aborted, FailedElsewhere
  std::vector<char> find()
  {
    ConnectedTetrahedra connected(this->Tetrahedra, this->Tree.nodes.size());
    GapSpread<TRanks, ConnectedTetrahedra> spread(this->Run, this->Ranks, connected);
    const auto weakAmong = [this](const std::vector<std::size_t>& some)
    {
      return this->KeepsHullSlivers ? this->Edges.rejectedAmong(weakVoidCriterion(), some)
                                    : this->Edges.rejectedAmong(RimCriterion(), some);
    };
    if (!this->KeepsHullSlivers)
    {
      spread.spread(itemsThat(this->Run, this->Tetrahedra.size(),
                      [&](std::size_t i) { return this->Tetrahedra[i].isAtHull; }),
        weakAmong);
    }
    // Strong tetrahedra are weak, too. In clouds on curves nearly all are in one gap: few are
    // asked.
    constexpr std::size_t firstPart = 65536;
    std::vector<std::size_t> open = this->candidates();
    for (std::size_t most = firstPart; !open.empty(); most *= 2)
    {
      open = chosenThat(this->Run, open, [&](std::size_t i) { return !spread.isReached(i); });
      const std::size_t count = std::min(most, open.size());
      spread.spread(this->strongAmong({ open.data(), open.data() + count }), weakAmong);
      open.erase(open.begin(), open.begin() + static_cast<std::ptrdiff_t>(count));
    }
    spread.dropFragments();
    return spread.takeMarks();
  }

  /// See TetrahedronEdges.
  std::size_t askedCount() const { return this->Edges.askedCount(); }

private:
  /// Those from which gaps spread. If slivers are kept, these span a void.
  std::vector<std::size_t> strongAmong(const std::vector<std::size_t>& some)
  {
    return this->KeepsHullSlivers ? this->Edges.rejectedAmong(strongVoidCriterion(), some)
                                  : this->Edges.rejectedAmong(GapCriterion::strong(), some);
  }

  /// The tetrahedra that may be strong.
  std::vector<std::size_t> candidates()
  {
    const std::vector<char> isDense = this->denseLeaves();
    return itemsThat(this->Run, this->Tetrahedra.size(),
      [&](std::size_t i)
      {
        const auto& corners = this->Tetrahedra[i].corners;
        return std::count_if(corners.begin(), corners.end(),
                 [&](std::size_t leaf) { return isDense[leaf] != 0; }) >= 2;
      });
  }

  /// Marks, by node, the leaves whose longest edge the strong criterion may reject. Clouds without
  /// gaps have few, so that almost no edges are tested.
  std::vector<char> denseLeaves()
  {
    const std::vector<std::atomic<double>> longest = this->longestEdges(); // at each leaf, by node
    const std::vector<std::size_t> corners = // in the same order on all ranks
      inTreeOrder(this->Run, this->Tree,
        itemsThat(
          this->Run, longest.size(), [&longest](std::size_t leaf) { return longest[leaf] > 0.0; }));
    std::vector<std::size_t> dense = itemsThat(
      this->Run, this->Ranks, corners.size(),
      [&](std::size_t i)
      {
        const std::size_t leaf = corners[i];
        return this->Tree.hasOwn(this->Tree.nodes[leaf]) &&
               GapCriterion::strong().mayReject(this->Tree, pathToNode(this->Tree, leaf),
                 this->Tree.sampleOf(leaf), longest[leaf]);
      },
      this->Run.progress);
    this->Ranks.unite(dense);
    std::vector<char> marksOfNodes(longest.size(), 0);
    forEachInOrder(
      this->Run, dense.size(), [&](std::size_t i) { marksOfNodes[corners[dense[i]]] = 1; });
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
    forEachIndex(this->Run, this->Tetrahedra.size(),
      [&](std::size_t tetrahedron)
      {
        const auto& corners = this->Tetrahedra[tetrahedron].corners;
        std::array<Vector, 4> positions;
        std::transform(corners.begin(), corners.end(), positions.begin(),
          [this](std::size_t corner) { return positionOf(this->Tree.sampleOf(corner)); });
        for (std::size_t i = 0; i < 4; ++i)
        {
          for (std::size_t j = i + 1; j < 4; ++j)
          {
            const double length = offsetBetween(positions[i], positions[j]).length;
            raise(corners[i], length);
            raise(corners[j], length);
          }
        }
      });
    return longest;
  }

  const Execution& Run;
  const SampleTree<TSample>& Tree;
  TRanks& Ranks;
  const std::vector<LeafTetrahedron>& Tetrahedra;
  const bool KeepsHullSlivers;
  TetrahedronEdges<TSample, TRanks> Edges;
};

} // namespace isopoint
