// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_IsopointNeighbors_h
#define isopoint_IsopointNeighbors_h

#include "Core/Base/Collected.h"
#include "Core/Base/Execution.h"
#include "Core/Base/ItemLists.h"
#include "Core/Base/NodeList.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Extraction/LeafSet.h"
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

/// All isopoints, those first whose edges begin in the first leaf: mostly close ones after each
/// other.
/// @param leaves of the isopoints' edges
/// @param nodeCount of the tree
/// Complexity: O(nodes + isopoints)
inline std::vector<std::size_t> inOrderOfLeaves(
  const std::vector<EdgeLeaves>& leaves, std::size_t nodeCount)
{
  return ItemLists(nodeCount, leaves.size(),
    [&leaves](std::size_t i) { return std::array<std::size_t, 1>{ leaves[i].first }; })
    .all();
}

/// The isopoints around each isopoint: those whose edges end in leaves around its own edge, so that
/// around an isopoint there are others in all directions in which the surface goes on, however
/// unevenly the samples are spread.
///
/// The time is bounded for leaves that touch very many others, as one that fills a void: around a
/// leaf that touches more than 256 others no others are listed, nor are the isopoints of a leaf
/// that has more than 256. The other end of their edges mostly lists what lies around.
template <class TSample>
class IsopointNeighbors
{
public:
  using Id = typename TSample::Id;

  /// @param tree in which the leaves' neighborhoods are complete
  /// @param known neighborhoods; others are searched for
  /// @param leaves of the isopoints' edges
  /// @param isInner for each isopoint, whether others will be looked for around it; null for all
  /// @throws std::bad_alloc, Aborted
  /// Complexity: O(nodes + isopoints)
  IsopointNeighbors(const Execution& execution, const SampleTree<TSample>& tree,
    const NeighborhoodCache<Id>& known, const std::vector<EdgeLeaves>& leaves,
    const std::vector<bool>* isInner = nullptr)
    : Tree(tree)
    , Bounds(tree)
  {
    // Of the leaves that edges end in; 0 is none.
    std::vector<Id> numbers(tree.nodes.size());
    this->numberLeaves(execution, leaves, numbers);
    this->Isopoints.emplace(this->Leaves.size(), this->Ends.size(),
      [this](std::size_t isopoint) { return this->Ends[isopoint]; });
    std::vector<bool> isSurrounded(this->Leaves.size(), !isInner);
    for (std::size_t i = 0; isInner && i < leaves.size(); ++i)
    {
      for (const Id end : this->Ends[i])
      {
        isSurrounded[end] = isSurrounded[end] || (*isInner)[i];
      }
    }
    this->listTouching(execution, tree, known, numbers, isSurrounded);
  }

  /// Whether a void of a width, up to a sample, is a gap as seen from an isopoint: whether it is
  /// over the strong gap criterion, in place of the length of an edge between an end of the
  /// isopoint's edge and the sample.
  /// @throws MissingNode
  bool isAcrossGap(std::size_t isopoint, const TSample& sample, double width) const
  {
    return std::any_of(this->Ends[isopoint].begin(), this->Ends[isopoint].end(),
      [&](Id end)
      {
        const TSample& own = this->Tree.samples[this->Tree.nodes[this->Leaves[end]].begin];
        const double length = offsetBetween(positionOf(own), positionOf(sample)).length;
        return width > 0.0 && GapCriterion::strong(std::max(1.0, length / width))
                                .drops(this->Tree, this->Bounds, own, sample);
      });
  }

  /// Lists the isopoints around one. What was found is kept for the next ones whose edges begin in
  /// the same leaf. For one thread.
  class Finder
  {
  public:
    explicit Finder(const IsopointNeighbors& neighbors)
      : Neighbors(neighbors)
    {
    }

    /// @param rings 1 or more. In the first ring are the isopoints whose edges end in or next to an
    /// end of one of the edges that begin where this one's does; each further ring adds those whose
    /// edges end in or next to an end of one of the ring before. All samples that determine which
    /// these are lie in leaves that are connected to this one's edge by no more than 2 rings + 1
    /// touching leaves.
    /// @returns isopoints, each once, mostly this one among them; a list that holds until the next
    /// call
    NodeList<std::size_t> find(std::size_t isopoint, int rings)
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
      if (this->Isopoints.size() >= mostIsopoints || !this->Visited.add(leaf))
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
    std::vector<std::size_t> RingEnds; // in this list
    LeafSet<Id> Ends;                  // whose surroundings are listed
    LeafSet<Id> Visited;
    LeafSet<std::size_t> Listed;
  };

private:
  /// Leaves that touch, or have, more than that are left out.
  static constexpr std::size_t most = 256;

  /// No leaf is added once this many isopoints are listed.
  static constexpr std::size_t mostIsopoints = 2048;

  /// The isopoints whose edges end in a leaf; none if they are more than `most`.
  NodeList<std::size_t> isopointsAt(Id leaf) const
  {
    const NodeList<std::size_t> isopoints = this->Isopoints->at(leaf);
    return isopoints.count > most ? NodeList<std::size_t>{} : isopoints;
  }

  /// The leaves that touch one.
  NodeList<Id> touching(Id leaf) const
  {
    const std::size_t begin = this->TouchingEnds[leaf - 1];
    return { this->Touching.data() + begin, this->TouchingEnds[leaf] - begin };
  }

  /// Numbers the leaves from 1 on, in the order of their nodes: close ones are close in memory.
  void numberLeaves(
    const Execution& execution, const std::vector<EdgeLeaves>& leaves, std::vector<Id>& numbers)
  {
    for (const EdgeLeaves& edge : leaves)
    {
      numbers[edge.first] = 1;
      numbers[edge.second] = 1;
    }
    this->Leaves.push_back(0);
    for (std::size_t node = 0; node < numbers.size(); ++node)
    {
      if (numbers[node] != 0)
      {
        numbers[node] = static_cast<Id>(this->Leaves.size());
        this->Leaves.push_back(static_cast<Id>(node));
      }
    }
    this->Ends.resize(leaves.size());
    forEachIndex(execution, leaves.size(),
      [&](std::size_t i) {
        this->Ends[i] = { numbers[leaves[i].first], numbers[leaves[i].second] };
      });
  }

  /// Lists for each leaf the others that touch it.
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
            const NodeList<Id> touching =
              isSurrounded[leaf] ? fewNeighborsOf(tree, known,
                                     static_cast<std::size_t>(this->Leaves[leaf]), most, memory)
                                 : NodeList<Id>{};
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
    const std::vector<std::size_t> begins = beginsOf(parts);
    this->Touching = joined(execution, parts, begins);
    forEachIndex(execution, count,
      [&](std::size_t leaf) { this->TouchingEnds[leaf + 1] += begins[leaf / grain]; });
  }

  const SampleTree<TSample>& Tree;
  mutable SampleBounds<TSample> Bounds;  // computed once, from any thread
  std::vector<Id> Leaves;                // node indices of the leaves that edges end in, by number
  std::vector<std::array<Id, 2>> Ends;   // of the isopoints' edges, numbers of leaves
  std::optional<ItemLists> Isopoints;    // whose edges end in each leaf, by number
  std::vector<Id> Touching;              // each leaf, numbers of leaves, one list after the other
  std::vector<std::size_t> TouchingEnds; // of these lists; the first one is empty
};

} // namespace isopoint

#endif
