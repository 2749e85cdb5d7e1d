// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Extraction/IndexSet.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Neighbors/GapCriterion.h"
#include "Core/Neighbors/NeighborSearch.h"
#include "Core/Neighbors/NeighborhoodCache.h"
#include "Core/Tree/Path.h"
#include "Core/Tree/SampleBounds.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// The indices of all isopoints, sorted by the first leaf of their edges, so that consecutive ones
/// are mostly close. O(nodes + isopoints)
/// @param leaves of the isopoints' edges
/// @param nodeCount of the tree
/// @throws std::bad_alloc, Aborted
inline std::vector<std::size_t> inOrderOfLeaves(
  const Execution& execution, const std::vector<EdgeLeaves>& leaves, std::size_t nodeCount)
{
  return ItemLists(execution, nodeCount, leaves.size(),
    [&leaves](std::size_t i) { return std::array<std::size_t, 1>{ leaves[i].first }; })
    .all();
}

/// Finds the isopoints around an isopoint: those whose edges end in leaves around its own edge.
/// This gives some in every direction in which the surface continues, even for uneven samples.
/// The time is bounded for leaves with very many neighbors, such as one that fills a void: a leaf
/// that touches more than 256 others has no listed neighbors, and the isopoints of a leaf with more
/// than 256 are not listed. The other ends of their edges mostly list them.
template <class TSample>
class IsopointNeighbors
{
public:
  using Id = typename TSample::Id;

  /// O(nodes + isopoints)
  /// @param tree with complete neighborhoods of the leaves
  /// @param known neighborhoods; others are searched
  /// @param leaves of the isopoints' edges
  /// @param isInner per isopoint, whether its neighbors will be requested; null for all
  /// @throws std::bad_alloc, Aborted
  IsopointNeighbors(const Execution& execution, const SampleTree<TSample>& tree,
    const NeighborhoodCache<Id>& known, const std::vector<EdgeLeaves>& leaves,
    const std::vector<bool>* isInner = nullptr)
    : Tree(tree)
    , Bounds(tree)
  {
    // Of the leaves at the ends of edges; 0: none.
    std::vector<Id> numbers(tree.nodes.size());
    this->numberLeaves(execution, leaves, numbers);
    this->Isopoints.emplace(execution, this->Leaves.size(), this->Ends.size(),
      [this](std::size_t isopoint) { return this->Ends[isopoint]; });
    std::vector<bool> isSurrounded(this->Leaves.size(), !isInner);
    forEachInOrder(execution, isInner ? leaves.size() : 0,
      [&](std::size_t i)
      {
        for (const Id end : this->Ends[i])
        {
          isSurrounded[end] = isSurrounded[end] || (*isInner)[i];
        }
      });
    this->listTouching(execution, tree, known, numbers, isSurrounded);
  }

  /// Whether a void of this width between an isopoint and a sample is a gap: whether the strong gap
  /// criterion rejects an edge of length `width` from an end of the isopoint's edge to the sample.
  /// @throws MissingNode
  bool isAcrossGap(std::size_t isopoint, const TSample& sample, double width) const
  {
    return std::any_of(this->Ends[isopoint].begin(), this->Ends[isopoint].end(),
      [&](Id end)
      {
        const TSample& own = this->Tree.samples[this->Tree.nodes[this->Leaves[end]].begin];
        const double length = offsetBetween(positionOf(own), positionOf(sample)).length;
        return width > 0.0 && GapCriterion::strong(std::max(1.0, length / width))
                                .rejects(this->Tree, this->Bounds, own, sample);
      });
  }

  /// Lists the isopoints around one. Edges that begin in one leaf share results. For one thread.
  class Finder
  {
  public:
    /// @throws std::bad_alloc
    explicit Finder(const IsopointNeighbors& neighbors)
      : Neighbors(neighbors)
      , Ends(neighbors.Leaves.size())
      , Visited(neighbors.Leaves.size())
      , Listed(neighbors.Ends.size())
    {
    }

    /// Two edges are adjacent if an end of one is in, or touches, a leaf at an end of the other.
    /// Ring 1 has the isopoints of edges adjacent to any edge that begins in the same leaf as this
    /// one's; each further ring adds those of edges adjacent to the previous ring's. Only leaves
    /// within 2 rings + 1 steps, each to a touching leaf, from this edge affect the result.
    /// @param rings at least 1
    /// @returns isopoints, each once, mostly including this one; valid until the next call
    IndexSpan<std::size_t> find(std::size_t isopoint, int rings)
    {
      const Id leaf = this->Neighbors.Ends[isopoint][0];
      if (this->RingEnds.empty() || leaf != this->Leaf)
      {
        this->begin(leaf);
      }
      while (this->RingEnds.size() < static_cast<std::size_t>(rings))
      {
        this->addRing();
      }
      return { this->Isopoints.data(), this->RingEnds[static_cast<std::size_t>(rings) - 1] };
    }

  private:
    void begin(Id leaf)
    {
      this->Leaf = leaf;
      this->Isopoints.clear();
      this->Ends.clear();
      this->Visited.clear();
      this->Listed.clear();
      this->addAround(leaf);
      for (const std::size_t isopoint : this->Neighbors.isopointsAt(leaf))
      {
        if (this->Neighbors.Ends[isopoint][0] == leaf)
        {
          this->addAround(this->Neighbors.Ends[isopoint][1]);
        }
      }
      this->RingEnds.assign(1, this->Isopoints.size());
    }

    void addRing()
    {
      const std::size_t rings = this->RingEnds.size();
      const std::size_t end = this->RingEnds.back();
      for (std::size_t i = rings > 1 ? this->RingEnds[rings - 2] : 0; i < end; ++i)
      {
        for (const Id leaf : this->Neighbors.Ends[this->Isopoints[i]])
        {
          this->addAround(leaf);
        }
      }
      this->RingEnds.push_back(this->Isopoints.size());
    }

    void addAround(Id leaf)
    {
      if (!this->Ends.add(leaf))
      {
        return;
      }
      this->addLeaf(leaf);
      for (const Id touching : this->Neighbors.touching(leaf))
      {
        this->addLeaf(touching);
      }
    }

    void addLeaf(Id leaf)
    {
      if (this->Isopoints.size() >= maxIsopoints || !this->Visited.add(leaf))
      {
        return;
      }
      for (const std::size_t isopoint : this->Neighbors.isopointsAt(leaf))
      {
        if (this->Listed.add(isopoint))
        {
          this->Isopoints.push_back(isopoint);
        }
      }
    }

    const IsopointNeighbors& Neighbors;
    Id Leaf = 0;
    std::vector<std::size_t> Isopoints;
    std::vector<std::size_t> RingEnds; // in Isopoints
    DenseIndexSet Ends;                // whose neighbors are listed
    DenseIndexSet Visited;
    DenseIndexSet Listed;
  };

private:
  /// Leaves that touch, or have, more than this are skipped.
  static constexpr std::size_t most = 256;

  /// Once this many isopoints are listed, no leaf is added.
  static constexpr std::size_t maxIsopoints = 2048;

  /// The isopoints whose edges end in a leaf; none if there are more than `most`.
  IndexSpan<std::size_t> isopointsAt(Id leaf) const
  {
    const IndexSpan<std::size_t> isopoints = this->Isopoints->at(leaf);
    return isopoints.count > most ? IndexSpan<std::size_t>{} : isopoints;
  }

  /// The leaves that touch a leaf.
  IndexSpan<Id> touching(Id leaf) const
  {
    const std::size_t begin = this->TouchingEnds[leaf - 1];
    return { this->Touching.data() + begin, this->TouchingEnds[leaf] - begin };
  }

  /// Numbers the leaves from 1 on in node order: close leaves are close in memory.
  void numberLeaves(
    const Execution& execution, const std::vector<EdgeLeaves>& leaves, std::vector<Id>& numbers)
  {
    forEachInOrder(execution, leaves.size(),
      [&](std::size_t i) { numbers[leaves[i].first] = numbers[leaves[i].second] = 1; });
    const std::vector<std::size_t> nodes = markedOf(execution, numbers);
    this->Leaves.resize(nodes.size() + 1, 0);
    forEachIndex(execution, nodes.size(),
      [&](std::size_t i)
      {
        numbers[nodes[i]] = static_cast<Id>(i + 1);
        this->Leaves[i + 1] = static_cast<Id>(nodes[i]);
      });
    this->Ends.resize(leaves.size());
    forEachIndex(execution, leaves.size(),
      [&](std::size_t i) {
        this->Ends[i] = { numbers[leaves[i].first], numbers[leaves[i].second] };
      });
  }

  /// Lists the neighbors of each leaf.
  void listTouching(const Execution& execution, const SampleTree<TSample>& tree,
    const NeighborhoodCache<Id>& known, const std::vector<Id>& numbers,
    const std::vector<bool>& isSurrounded)
  {
    constexpr std::size_t grain = 256;
    constexpr std::size_t batch = 64;
    const std::size_t count = this->Leaves.size() - 1;
    std::vector<std::vector<Id>> parts((count + grain - 1) / grain);
    this->TouchingEnds.resize(count + 1, 0);
    forBatches(execution, parts.size(), batch, 1,
      [&](std::size_t begin, std::size_t end)
      {
        std::vector<Id> memory;
        for (std::size_t part = begin; part < end; ++part)
        {
          const std::size_t last = std::min(count, (part + 1) * grain);
          for (std::size_t leaf = part * grain + 1; leaf <= last; ++leaf)
          {
            const IndexSpan<Id> touching =
              isSurrounded[leaf] ? fewNeighborsOf(tree, known, this->Leaves[leaf], most, memory)
                                 : IndexSpan<Id>{};
            for (const Id node : touching)
            {
              if (numbers[node] != 0)
              {
                parts[part].push_back(numbers[node]);
              }
            }
            this->TouchingEnds[leaf] = parts[part].size();
          }
        }
      });
    const std::vector<std::size_t> begins = offsetsOf(parts);
    this->Touching = joined(execution, parts, begins);
    forEachIndex(execution, count,
      [&](std::size_t leaf) { this->TouchingEnds[leaf + 1] += begins[leaf / grain]; });
  }

  const SampleTree<TSample>& Tree;
  mutable SampleBounds<TSample> Bounds;  // computed once; thread-safe
  std::vector<Id> Leaves;                // node indices of the edges' leaves, by number
  std::vector<std::array<Id, 2>> Ends;   // of the isopoints' edges, as leaf numbers
  std::optional<ItemLists> Isopoints;    // with an edge that ends in the leaf, by leaf number
  std::vector<Id> Touching;              // leaf numbers, one list per leaf
  std::vector<std::size_t> TouchingEnds; // ends of these lists, by leaf number
};

} // namespace isopoint
