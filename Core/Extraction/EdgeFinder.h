// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"
#include "Core/Extraction/ExtractionContext.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Neighbors/AngleCriterion.h"
#include "Core/Neighbors/GapCriterion.h"
#include "Core/Neighbors/ImplicitNeighborhood.h"
#include "Core/Neighbors/NeighborSearch.h"
#include "Core/Neighbors/NeighborhoodCache.h"
#include "Core/Tree/CoincidentSamples.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// Finds the crossing edges of leaves, one leaf at a time. Memory is kept. For one thread.
template <class TSample>
class EdgeFinder
{
public:
  using Id = typename TSample::Id;

  /// @param listsGaps whether to fill gapEdges()
  EdgeFinder(ExtractionContext<TSample>& context, const AngleCriterion& criterion, bool listsGaps)
    : Context(context)
    , Tree(context.tree)
    , Isovalue(context.isovalue)
    , Criterion(criterion)
    , ListsGaps(listsGaps)
    , Implicit(context.tree, context.bounds)
    , Values(context.leafValues)
  {
  }

  /// Adds the edges from the leaf's sample to the neighbors on the other side of the isovalue that
  /// survive the angle criterion ([RL06] sections 6 and 7).
  /// @throws MissingNode, nothing added
  void find(const Path& leaf)
  {
    const std::size_t edgeCount = this->Edges.size();
    const std::size_t gapCount = this->GapEdges.size();
    const std::size_t keptRecords = this->KeptRecords;
    try
    {
      this->addEdgesOf(leaf);
    }
    catch (const MissingNode&)
    {
      this->Edges.erase(
        this->Edges.begin() + static_cast<std::ptrdiff_t>(edgeCount), this->Edges.end());
      this->GapEdges.resize(gapCount);
      this->KeptRecords = keptRecords;
      throw;
    }
  }

  const std::vector<CrossingEdge<TSample>>& edges() const { return this->Edges; }

  /// The edges that the strong gap criterion rejects.
  const std::vector<CrossingEdge<TSample>>& gapEdges() const { return this->GapEdges; }

  /// The neighborhoods that were searched, as input of NeighborhoodCache::add().
  std::vector<Id>& records()
  {
    this->Records.resize(this->KeptRecords);
    return this->Records;
  }

private:
  void addEdgesOf(const Path& leaf)
  {
    const double value = this->Values.at(leaf.nodeIndex());
    const bool isBelow = value < this->Isovalue;
    this->Neighbors = this->Context.neighborhoods.at(leaf.nodeIndex());
    if (this->Neighbors.isEmpty())
    {
      if (this->Context.listBudget.isSpent() && !this->Criterion.dropsNothing() &&
          this->Implicit.canSearch())
      {
        this->connectToSurvivors(leaf, value);
        return;
      }
      const TouchingRoots surroundings(leaf);
      if (!touchesOtherSide(this->Tree, surroundings, maximumDepth, this->Isovalue, isBelow))
      {
        return;
      }
      this->listNeighbors(leaf.nodeIndex(), surroundings);
    }
    this->findCrossings(isBelow);
    if (this->Crossings.empty())
    {
      return;
    }
    this->measureNeighbors(this->Tree.sampleOf(leaf.nodeIndex()));
    for (const Crossing& crossing : this->Crossings)
    {
      if (this->survives(crossing.neighbor))
      {
        this->connect(leaf, value, this->Neighbors[crossing.neighbor], crossing.value);
      }
    }
  }

  struct Crossing
  {
    std::size_t neighbor;
    double value;
  };

  void listNeighbors(std::size_t leaf, const TouchingRoots& surroundings)
  {
    const std::size_t begin = this->KeptRecords;
    this->Records.resize(begin);
    this->Records.push_back(static_cast<Id>(leaf));
    this->Records.push_back(0);
    visitNeighbors(this->Tree, surroundings,
      [this](std::size_t nodeIndex)
      {
        this->Records.push_back(static_cast<Id>(nodeIndex));
        return false;
      });
    const std::size_t count = this->Records.size() - begin - 2;
    this->Context.listBudget.spend(count);
    this->Records[begin + 1] = static_cast<Id>(count);
    this->Neighbors = { this->Records.data() + begin + 2, count };
    if (this->Context.cacheBudget.fetch_sub(static_cast<std::int64_t>(count + 2)) >
        static_cast<std::int64_t>(count + 2))
    {
      this->KeptRecords = this->Records.size();
    }
  }

  /// find() without a list of neighbors.
  void connectToSurvivors(const Path& leaf, double value)
  {
    const bool isBelow = value < this->Isovalue;
    this->Implicit.moveTo(leaf);
    this->Implicit.forEachSurvivor(
      this->Criterion,
      [this, isBelow](const Node<TSample>& node)
      { return mayHoldOtherSide(node, this->Isovalue, isBelow); },
      [this, isBelow](std::size_t nodeIndex)
      { return (this->Values.at(nodeIndex) < this->Isovalue) != isBelow; },
      [this, &leaf, value](std::size_t nodeIndex)
      { this->connect(leaf, value, nodeIndex, this->Values.at(nodeIndex)); });
  }

  /// Lists the neighbors on the other side of the isovalue.
  void findCrossings(bool isBelow)
  {
    this->Crossings.clear();
    for (std::size_t i = 0; i < this->Neighbors.count; ++i)
    {
      const double value = this->Values.at(this->Neighbors[i]);
      if ((value < this->Isovalue) != isBelow)
      {
        this->Crossings.push_back({ i, value });
      }
    }
  }

  /// Lists the offsets to the neighbors.
  void measureNeighbors(const TSample& sample)
  {
    const Vector center = positionOf(sample);
    this->Offsets.resize(this->Neighbors.count);
    std::transform(this->Neighbors.begin(), this->Neighbors.end(), this->Offsets.begin(),
      [this, &center](Id nodeIndex)
      { return offsetBetween(center, positionOf(this->Tree.sampleOf(nodeIndex))); });
    this->Sorted.clear();
  }

  /// Among many neighbors, as of a large cell among small ones, compares the nearest first: all
  /// pairs would take quadratic time.
  bool survives(std::size_t neighbor)
  {
    constexpr std::size_t few = 64;
    if (this->Offsets.size() <= few)
    {
      return this->Criterion.survives(this->Offsets.data(), this->Offsets.size(), neighbor);
    }
    if (this->Sorted.empty())
    {
      this->Sorted = this->Offsets;
      nearestFirst(this->Sorted);
    }
    return this->Criterion.survivesAmongSorted(this->Sorted.data(), this->Offsets[neighbor]);
  }

  /// Adds the edge between a leaf's sample and another sample.
  void connect(const Path& leaf, double value, std::size_t otherLeaf, double otherValue)
  {
    const TSample& sample = this->Tree.sampleOf(leaf.nodeIndex());
    const TSample& otherSample = this->Tree.sampleOf(otherLeaf);
    this->addEdge({ sample.id, static_cast<Id>(leaf.nodeIndex()), value },
      { otherSample.id, static_cast<Id>(otherLeaf), otherValue });
    if (this->ListsGaps && this->isGapSeed(leaf, sample, otherSample))
    {
      this->GapEdges.push_back(this->Edges.back());
    }
  }

  /// Whether the strong gap criterion rejects the edge; mayReject() quickly rules out most.
  bool isGapSeed(const Path& leaf, const TSample& own, const TSample& other) const
  {
    const GapCriterion strong = GapCriterion::strong();
    return strong.mayReject(
             this->Tree, leaf, own, offsetBetween(positionOf(own), positionOf(other)).length) &&
           strong.rejects(this->Tree, this->Context.bounds, own, other);
  }

  struct End
  {
    Id id;
    Id leaf;
    double value;
  };

  void addEdge(const End& a, const End& b)
  {
    const End& first = a.id < b.id ? a : b;
    const End& second = a.id < b.id ? b : a;
    this->Edges.push_back({ { first.id, second.id },
      edgeParameter(first.value, second.value, this->Isovalue), first.leaf, second.leaf });
  }

  ExtractionContext<TSample>& Context;
  const SampleTree<TSample>& Tree;
  const double Isovalue;
  const AngleCriterion& Criterion;
  const bool ListsGaps;
  ImplicitNeighborhood<TSample> Implicit;
  IndexSpan<Id> Neighbors;
  std::vector<Id> Records; // kept records, then that of the current leaf
  std::size_t KeptRecords = 0;
  std::vector<Offset> Offsets; // of the neighbors
  std::vector<Offset> Sorted;  // the same, nearest first, if there are many
  std::vector<Crossing> Crossings;
  std::vector<CrossingEdge<TSample>> Edges;
  std::vector<CrossingEdge<TSample>> GapEdges;
  LeafValues<TSample>& Values;
};

} // namespace isopoint
