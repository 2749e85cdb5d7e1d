// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Extraction/IsopointNeighbors.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Neighbors/NeighborSearch.h"
#include "Core/Neighbors/NeighborhoodCache.h"
#include "Core/Ranks/ByteBuffer.h"
#include "Core/Ranks/SentIsopoint.h"
#include "Core/Ranks/SharedRanks.h"
#include "Core/Splat/Splat.h"
#include "Core/Splat/SplatPolygons.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <mutex>
#include <unordered_set>
#include <utility>
#include <vector>

namespace isopoint
{

/// WholeSurface for several ranks: this rank's isopoints and those of others within some rings
/// around them, in the order of the whole surface. Each ring adds the isopoints of edges adjacent
/// to the previous ring's. An IsopointNeighbors::Finder for k rings needs k + 1 rings here.
/// Collective: gather(), forEach(), share() and shareCells().
template <class TSample>
class SurfaceHalo
{
public:
  using Neighborhoods = NeighborhoodCache<typename TSample::Id>;

  /// @param own isopoints on edges with an end in this rank's leaves; on both ranks if between two
  /// @param hasFits whether surfaces have fits; an empty one does not show this
  SurfaceHalo(const Execution& execution, SharedRanks<TSample>& ranks,
    const SampleTree<TSample>& tree, const Neighborhoods& known, Isosurface own, bool hasFits)
    : Run(execution)
    , Tree(tree)
    , Ranks(ranks)
    , Cache(known)
    , Own(std::move(own))
    , HasFits(hasFits)
  {
  }

  /// @param rings 0, or at least 3
  /// @throws std::bad_alloc, Aborted, FailedElsewhere
  void gather(int rings, bool isShared)
  {
    this->indexOwn();
    this->Received.resize(static_cast<std::size_t>(this->Ranks.processes().size()));
    this->Sent.resize(this->Received.size());
    std::vector<std::size_t> ends = endsOf(this->Own.leaves);
    for (int ring = 0; ring < rings; ++ring)
    {
      this->requestIn(this->withTouching(ends));
      for (const std::vector<SentIsopoint>& list : this->Received)
      {
        for (const SentIsopoint& isopoint : list)
        {
          ends.insert(ends.end(), { isopoint.leaves.first, isopoint.leaves.second });
          if (ring == std::min(2, rings - 2)) // including those of previous rings
          {
            this->Surrounded.push_back(isopoint.edge);
          }
        }
      }
      keepUnique(ends);
    }
    this->unite();
    this->chooseOwn(isShared);
  }

  const Isosurface& surface() const { return this->All; }

  std::vector<std::size_t> numbers() const { return {}; }

  /// Whether each isopoint of surface() is this rank's own or in the inner rings: the first three,
  /// or the first two if gather() fetched only three.
  const std::vector<bool>* inner() const { return &this->IsInner; }

  std::vector<std::size_t> owned() const { return markedOf(this->Run, this->IsOwned); }
  std::vector<std::size_t> ghosts() const
  {
    return itemsThat(
      this->Run, this->All.size(), [this](std::size_t i) { return !this->IsOwned[i]; });
  }

  Isosurface takeOwned() const { return chosenIsopoints(this->Run, this->All, this->owned()); }

  // See AllPoints.

  const std::vector<std::size_t>& own() const { return this->OwnInTreeOrder; }
  const std::vector<std::size_t>& shaped() const { return this->Shaped; }

  void keepOwn(std::vector<std::size_t>& points) const
  {
    std::vector<std::size_t> kept;
    std::set_intersection(points.begin(), points.end(), this->OwnIndices.begin(),
      this->OwnIndices.end(), std::back_inserter(kept));
    points.swap(kept);
  }

  template <class MakeWorker, class Work>
  void forEach(const Execution& execution, const ItemBatches& batches, const MakeWorker& makeWorker,
    const Work& work, const BatchDone& batchDone)
  {
    this->Ranks.forEach(execution, batches, makeWorker, work, batchDone);
  }

  void shareCells(RawArray<VoronoiCell>& cells)
  {
    std::vector<SentCell> sent(cells.size());
    for (const std::size_t i : this->OwnIndices)
    {
      sent[i].cell = cells[i];
      for (std::size_t k = 0; k < cells[i].count; ++k)
      {
        const std::size_t beyond = cells[i].corners[k].beyond;
        sent[i].beyond[k] = beyond == VoronoiCell::none ? IsopointEdge{} : this->All.edges[beyond];
      }
    }
    this->share(sent);
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      cells[i] = sent[i].cell;
      for (std::size_t k = 0; k < cells[i].count; ++k)
      {
        std::size_t& beyond = cells[i].corners[k].beyond;
        const std::size_t found =
          beyond == VoronoiCell::none ? this->All.size() : this->find(sent[i].beyond[k]);
        beyond = found < this->All.size() ? found : VoronoiCell::none;
      }
    }
  }

  /// Isopoints of edges between two ranks have equal results on both.
  template <class T>
  void share(std::vector<T>& ofAll)
  {
    std::vector<std::vector<T>> outgoing(this->Sent.size());
    for (std::size_t rank = 0; rank < this->Sent.size(); ++rank)
    {
      for (const std::size_t isopoint : this->Sent[rank])
      {
        outgoing[rank].push_back(ofAll[this->OwnIndices[isopoint]]);
      }
    }
    const std::vector<std::vector<T>> arrived = this->Ranks.processes().exchange(outgoing);
    for (std::size_t rank = 0; rank < arrived.size(); ++rank)
    {
      for (std::size_t i = 0; i < arrived[rank].size(); ++i)
      {
        ofAll[this->indexOf(this->Received[rank][i].edge)] = arrived[rank][i];
      }
    }
  }

private:
  /// A cell as sent between ranks.
  struct SentCell
  {
    VoronoiCell cell;
    std::array<IsopointEdge, maxCorners> beyond; // the points beyond its sides, if any
  };

  /// The tree index of a leaf, and an isopoint whose edge ends there.
  using OwnEnd = std::pair<std::uint64_t, std::size_t>;

  static std::vector<std::size_t> endsOf(const std::vector<EdgeLeaves>& leaves)
  {
    std::vector<std::size_t> ends;
    for (const EdgeLeaves& edge : leaves)
    {
      ends.insert(ends.end(), { edge.first, edge.second });
    }
    keepUnique(ends);
    return ends;
  }

  void indexOwn()
  {
    for (std::size_t i = 0; i < this->Own.size(); ++i)
    {
      for (const std::size_t leaf : { this->Own.leaves[i].first, this->Own.leaves[i].second })
      {
        this->OwnEnds.emplace_back(this->Tree.nodes[leaf].begin, i);
      }
    }
    std::sort(this->OwnEnds.begin(), this->OwnEnds.end());
  }

  /// The leaves and their neighbors, except for neighbors of leaves that have too many.
  std::vector<std::size_t> withTouching(const std::vector<std::size_t>& leaves)
  {
    using Id = typename TSample::Id;
    constexpr std::size_t most = 256; // see IsopointNeighbors
    std::vector<std::size_t> all = leaves;
    std::mutex mutex;
    this->Ranks.forEach(
      this->Run, { leaves.size(), 1024, 256 }, []() { return std::vector<Id>(); },
      [&](std::vector<Id>& memory, std::size_t i)
      {
        const IndexSpan<Id> touching =
          fewNeighborsOf(this->Tree, this->Cache, leaves[i], most, memory);
        const std::lock_guard<std::mutex> lock(mutex);
        std::copy_if(touching.begin(), touching.end(), std::back_inserter(all),
          [this](Id node) { return !this->Tree.hasOwn(this->Tree.nodes[node]); });
      });
    keepUnique(all);
    return all;
  }

  /// Fetches the isopoints of leaves that other ranks own, unless fetched before.
  void requestIn(const std::vector<std::size_t>& leaves)
  {
    std::vector<std::vector<std::uint64_t>> questions(this->Received.size());
    for (const std::size_t leaf : leaves)
    {
      const Node<TSample>& node = this->Tree.nodes[leaf];
      if (!this->Tree.hasOwn(node) && this->Requested.insert(leaf).second)
      {
        questions[this->Ranks.ownerOf(node.begin)].push_back(node.begin);
      }
    }
    const std::vector<std::vector<std::uint64_t>> asked =
      this->Ranks.processes().exchange(questions);
    std::vector<ByteBuffer> answers(asked.size());
    for (std::size_t rank = 0; rank < asked.size(); ++rank)
    {
      this->answer(asked[rank], rank, answers[rank]);
    }
    const std::vector<SentIsopoint*> added =
      this->receive(this->Ranks.processes().exchange(answers));
    std::vector<SentEnd> ends;
    for (const SentIsopoint* const isopoint : added)
    {
      ends.insert(ends.end(), isopoint->ends.begin(), isopoint->ends.end());
    }
    const std::vector<std::size_t> leavesAtEnds = this->Ranks.leavesAt(ends);
    for (std::size_t i = 0; i < added.size(); ++i)
    {
      added[i]->leaves = { leavesAtEnds[2 * i], leavesAtEnds[2 * i + 1] };
    }
  }

  /// Writes the isopoints that end in some of this rank's leaves, each once.
  void answer(const std::vector<std::uint64_t>& treeIndices, std::size_t rank, ByteBuffer& answer)
  {
    std::vector<std::size_t> isopoints;
    for (const std::uint64_t treeIndex : treeIndices)
    {
      for (auto end =
             std::lower_bound(this->OwnEnds.begin(), this->OwnEnds.end(), OwnEnd{ treeIndex, 0 });
           end != this->OwnEnds.end() && end->first == treeIndex; ++end)
      {
        isopoints.push_back(end->second);
      }
    }
    keepUnique(isopoints);
    for (const std::size_t isopoint : isopoints)
    {
      appendIsopoint(answer, this->Tree, this->Own, isopoint);
      this->Sent[rank].push_back(isopoint);
    }
  }

  /// @returns isopoints that arrived; valid until the next call
  std::vector<SentIsopoint*> receive(const std::vector<ByteBuffer>& arrived)
  {
    std::vector<SentIsopoint*> added;
    for (std::size_t rank = 0; rank < arrived.size(); ++rank)
    {
      const std::size_t before = this->Received[rank].size();
      ByteReader in(arrived[rank]);
      while (!in.isAtEnd())
      {
        this->Received[rank].push_back(readIsopoint(in, this->HasFits));
      }
      for (std::size_t i = before; i < this->Received[rank].size(); ++i)
      {
        added.push_back(&this->Received[rank][i]);
      }
    }
    return added;
  }

  /// Merges own and received isopoints in one order.
  void unite()
  {
    Isosurface both = this->Own;
    for (const std::vector<SentIsopoint>& list : this->Received)
    {
      for (const SentIsopoint& isopoint : list)
      {
        both.edges.push_back(isopoint.edge);
        both.positions.push_back(isopoint.position);
        both.decreasingEdges.push_back(isopoint.decreasingEdge);
        both.leaves.push_back(isopoint.leaves);
        if (this->HasFits)
        {
          both.fits.push_back(isopoint.fit);
        }
      }
    }
    std::vector<std::size_t> order = iota(both.size());
    std::stable_sort(order.begin(), order.end(),
      [&both](std::size_t a, std::size_t b) { return both.edges[a] < both.edges[b]; });
    order.erase(std::unique(order.begin(), order.end(),
                  [&both](std::size_t a, std::size_t b) { return both.edges[a] == both.edges[b]; }),
      order.end());
    this->All = chosenIsopoints(this->Run, both, order);
    std::sort(this->Surrounded.begin(), this->Surrounded.end());
    this->IsInner.clear();
    this->OwnIndices.resize(this->Own.size());
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      const bool isOwn = order[i] < this->Own.size();
      if (isOwn)
      {
        this->OwnIndices[order[i]] = i;
      }
      this->IsInner.push_back(isOwn || std::binary_search(this->Surrounded.begin(),
                                         this->Surrounded.end(), this->All.edges[i]));
    }
  }

  /// Finds this rank's isopoints among all: which belong to it, and in which order cells are cut.
  void chooseOwn(bool isShared)
  {
    this->IsOwned.assign(this->All.size(), false);
    std::vector<bool> isOwn(this->All.size(), false);
    for (const std::size_t i : this->OwnIndices)
    {
      isOwn[i] = true;
      this->IsOwned[i] = this->Tree.isOwn(lowerTreeIndex(this->Tree, this->All.leaves[i]));
      // Both ranks of an edge between two send such a ghost.
      if (this->IsOwned[i] || isShared)
      {
        this->Shaped.push_back(i);
      }
    }
    this->OwnInTreeOrder =
      chosenThat(this->Run, inOrderOfLeaves(this->Run, this->All.leaves, this->Tree.nodes.size()),
        [&](std::size_t i) { return isOwn[i]; });
  }

  /// @returns the index of the edge's isopoint in surface(), or size() if there is none
  std::size_t find(const IsopointEdge& edge) const
  {
    const std::size_t index = this->indexOf(edge);
    return index < this->All.size() && this->All.edges[index] == edge ? index : this->All.size();
  }

  std::size_t indexOf(const IsopointEdge& edge) const
  {
    return static_cast<std::size_t>(
      std::lower_bound(this->All.edges.begin(), this->All.edges.end(), edge) -
      this->All.edges.begin());
  }

  const Execution& Run;
  const SampleTree<TSample>& Tree;
  SharedRanks<TSample>& Ranks;
  const Neighborhoods& Cache;
  const Isosurface Own;
  const bool HasFits;
  std::vector<OwnEnd> OwnEnds;
  std::unordered_set<std::size_t> Requested;       // leaves
  std::vector<std::vector<SentIsopoint>> Received; // from each rank, in order of arrival
  std::vector<std::vector<std::size_t>> Sent;      // to each rank, in order of sending
  std::vector<IsopointEdge> Surrounded;            // received with the inner rings
  Isosurface All;
  std::vector<std::size_t> OwnIndices; // of this rank's isopoints among all
  std::vector<std::size_t> OwnInTreeOrder;
  std::vector<std::size_t> Shaped;
  std::vector<bool> IsInner;
  std::vector<bool> IsOwned; // whether each belongs to this rank
};

} // namespace isopoint
