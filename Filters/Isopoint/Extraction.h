// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Extraction_h
#define isopoint_Extraction_h

#include "AngleCriterion.h"
#include "Execution.h"
#include "GapCriterion.h"
#include "Interpolation.h"
#include "Isopoint.h"
#include "LargeNeighborhood.h"
#include "LeafValues.h"
#include "NarrowBand.h"
#include "NeighborhoodFits.h"
#include "SharedState.h"
#include "SortUnique.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <new>
#include <optional>
#include <utility>
#include <vector>

namespace isopoint
{

/// Finds the crossing edges of leaves, one leaf at a time, and interpolates on them. Scratch is
/// kept from one leaf to the next.
template <class TSample>
class EdgeFinder
{
public:
  using Id = typename TSample::Id;

  EdgeFinder(const SampleTree<TSample>& tree, double isovalue, const AngleCriterion& criterion,
    const GapCriterion& gapCriterion, SharedState<TSample>& shared)
    : Tree(tree)
    , Isovalue(isovalue)
    , Criterion(criterion)
    , Gaps(gapCriterion)
    , Shared(shared)
    , Many(tree, shared.bounds)
    , Values(tree, shared.heapMeans)
  {
  }

  /// Adds an isopoint for each neighbour of the leaf's sample that survives the angle criterion
  /// there and lies on the other side of the isovalue (sections 6 and 7 of the paper), but not
  /// across a gap.
  void find(const Path& leaf)
  {
    const double value = this->Values.at(leaf.slot());
    const bool isBelow = value < this->Isovalue;
    this->Neighbors = this->Tree.neighborhoods.at(leaf.slot());
    if (this->Neighbors.isEmpty())
    {
      if (this->Shared.limit.isReached() && !this->Criterion.dropsNothing() &&
          this->Many.canSearch())
      {
        this->connectToSurvivors(leaf, value);
        return;
      }
      if (!touchesOtherSide(this->Tree, leaf, maximumDepth, this->Isovalue, isBelow))
      {
        return;
      }
      this->listNeighbors(leaf);
    }
    this->findCrossings(isBelow);
    if (this->Crossings.empty())
    {
      return;
    }
    this->measureNeighbors(this->sampleAt(leaf.slot()));
    for (const Crossing& crossing : this->Crossings)
    {
      if (this->survives(crossing.neighbor))
      {
        this->connect(leaf, value, this->Neighbors[crossing.neighbor], crossing.value);
      }
    }
  }

  std::vector<LocatedIsopoint<TSample>>& points() { return this->Points; }

  /// Slots of leaves with several samples among the points' ends, with repetitions.
  const std::vector<std::size_t>& merged() const { return this->Merged; }

  /// The neighbourhoods searched for, as NeighborhoodCache::add() takes them.
  std::vector<Id>& records()
  {
    this->Records.resize(this->KeptRecords);
    return this->Records;
  }

private:
  struct Crossing
  {
    std::size_t neighbor;
    double value;
  };

  void listNeighbors(const Path& leaf)
  {
    const std::size_t begin = this->KeptRecords;
    this->Records.resize(begin);
    this->Records.push_back(static_cast<Id>(leaf.slot()));
    this->Records.push_back(0);
    visitTouching(this->Tree, leaf, maximumDepth,
      [this](std::size_t slot)
      {
        this->Records.push_back(static_cast<Id>(slot));
        return false;
      });
    const std::size_t count = this->Records.size() - begin - 2;
    this->Shared.limit.listed(count);
    this->Records[begin + 1] = static_cast<Id>(count);
    this->Neighbors = { this->Records.data() + begin + 2, count };
    if (this->Shared.room.fetch_sub(static_cast<std::int64_t>(count + 2)) >
        static_cast<std::int64_t>(count + 2))
    {
      this->KeptRecords = this->Records.size();
    }
  }

  /// What find() does, without a list of the neighbours.
  void connectToSurvivors(const Path& leaf, double value)
  {
    const bool isBelow = value < this->Isovalue;
    this->Many.moveTo(leaf);
    this->Many.forEachSurvivor(
      this->Criterion,
      [this, isBelow](const Node<TSample>& node)
      { return mayHoldOtherSide(node, this->Isovalue, isBelow); },
      [this, isBelow](std::size_t slot)
      { return (this->Values.at(slot) < this->Isovalue) != isBelow; },
      [this, &leaf, value](std::size_t slot)
      { this->connect(leaf, value, slot, this->Values.at(slot)); });
  }

  const TSample& sampleAt(std::size_t slot) const
  {
    return this->Tree.samples[this->Tree.nodes[slot].begin];
  }

  /// Lists the neighbours on the other side.
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

  /// Lists where the neighbours are.
  void measureNeighbors(const TSample& sample)
  {
    const double center[3] = { sample.position[0], sample.position[1], sample.position[2] };
    this->Offsets.clear();
    for (const std::size_t slot : this->Neighbors)
    {
      const TSample& other = this->sampleAt(slot);
      const double position[3] = { other.position[0], other.position[1], other.position[2] };
      this->Offsets.push_back(offsetBetween(center, position));
    }
    this->Sorted.clear();
  }

  /// Of many neighbours (a large cell among small ones) the nearest decide first: to compare each
  /// with each would cost the square of their number.
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

  /// Adds the isopoint between a leaf's sample and another one, unless a gap parts them.
  void connect(const Path& leaf, double value, std::size_t otherSlot, double otherValue)
  {
    const TSample& sample = this->sampleAt(leaf.slot());
    const TSample& otherSample = this->sampleAt(otherSlot);
    if (this->Gaps.drops(this->Tree, leaf, sample, otherSample))
    {
      return;
    }
    this->addPoint({ sample.id, static_cast<Id>(leaf.slot()), value },
      { otherSample.id, static_cast<Id>(otherSlot), otherValue });
    this->addMerged(leaf.slot());
    this->addMerged(otherSlot);
  }

  struct End
  {
    Id id;
    Id slot;
    double value;
  };

  void addPoint(const End& a, const End& b)
  {
    const End& first = a.id < b.id ? a : b;
    const End& second = a.id < b.id ? b : a;
    this->Points.push_back(
      { { first.id, second.id, edgeParameter(first.value, second.value, this->Isovalue) },
        first.slot, second.slot });
  }

  void addMerged(std::size_t slot)
  {
    if (this->Tree.nodes[slot].count() > 1 && (this->Merged.empty() || this->Merged.back() != slot))
    {
      this->Merged.push_back(slot);
    }
  }

  const SampleTree<TSample>& Tree;
  const double Isovalue;
  const AngleCriterion& Criterion;
  const GapCriterion& Gaps;
  SharedState<TSample>& Shared;
  LargeNeighborhood<TSample> Many;
  SlotList<Id> Neighbors;
  std::vector<Id> Records; // behind the kept ones, one for the leaf at hand where there is no room
  std::size_t KeptRecords = 0;
  std::vector<Offset> Offsets; // of the neighbours
  std::vector<Offset> Sorted;  // the same, nearest first, where there are many
  std::vector<Crossing> Crossings;
  std::vector<LocatedIsopoint<TSample>> Points;
  std::vector<std::size_t> Merged;
  LeafValues<TSample> Values;
};

/// The samples of leaves, ordered by lowest id. @param slots of the leaves, with repetitions
template <class TSample>
std::vector<MergedSamples> mergedSamplesOf(
  const SampleTree<TSample>& tree, std::vector<std::size_t>& slots)
{
  std::sort(slots.begin(), slots.end());
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  std::vector<MergedSamples> merged;
  for (const std::size_t slot : slots)
  {
    const Node<TSample>& leaf = tree.nodes[slot];
    MergedSamples group;
    for (std::size_t i = leaf.begin; i < leaf.end; ++i)
    {
      group.ids.push_back(tree.samples[i].id);
    }
    merged.push_back(std::move(group));
  }
  std::sort(merged.begin(), merged.end(),
    [](const MergedSamples& a, const MergedSamples& b) { return a.ids.front() < b.ids.front(); });
  return merged;
}

/// The canonical isopoints of one isovalue (DESIGN section 1), refining the tree as far as needed.
/// @param angle in degrees, 0 up to 180
/// @param gapFactor of the gap criterion: 0, which drops nothing, or positive
/// @param idCount above every id
/// @param fitRequest what is fitted around each isopoint, if anything
/// @throws Aborted, std::bad_alloc, or std::length_error (see NarrowBand); the tree can be used
/// again afterwards
template <class TSample>
Isosurface extractIsosurface(const Execution& execution, SampleTree<TSample>& tree, double isovalue,
  double angle, double gapFactor, std::uint64_t idCount, std::optional<FitRequest> fitRequest)
{
  Isosurface result;
  if (tree.isEmpty())
  {
    return result;
  }
  const std::vector<NodeIndex> crossing = NarrowBand<TSample>(tree, isovalue, execution).refine();
  const AngleCriterion criterion(angle);
  const GapCriterion gapCriterion(gapFactor);
  std::vector<LocatedIsopoint<TSample>> points;
  std::vector<std::size_t> merged;
  std::vector<std::vector<typename TSample::Id>> records;
  SharedState<TSample> shared(tree);
  std::mutex mutex;
  constexpr std::size_t grain = 256;
  forBatches(execution, crossing.size(), 64 * grain, grain,
    [&](std::size_t begin, std::size_t end)
    {
      EdgeFinder<TSample> finder(tree, isovalue, criterion, gapCriterion, shared);
      for (std::size_t i = begin; i < end; ++i)
      {
        Path path = pathTo(tree, crossing[i]);
        forEachBelow(tree, path, maximumDepth, [&finder](const Path& leaf) { finder.find(leaf); });
      }
      const std::lock_guard<std::mutex> lock(mutex);
      points.insert(points.end(), finder.points().begin(), finder.points().end());
      records.push_back(std::move(finder.records()));
      merged.insert(merged.end(), finder.merged().begin(), finder.merged().end());
    });
  try
  {
    for (const std::vector<typename TSample::Id>& found : records)
    {
      tree.neighborhoods.add(found, tree.nodes.size());
    }
  }
  catch (const std::bad_alloc&)
  {
    // What is not remembered is searched for again.
  }

  points =
    sortedUnique(execution, points, idCount, [](const Isopoint& point) { return point.first; });
  if (fitRequest)
  {
    result.fits = fitNeighborhoods(execution, tree, isovalue, *fitRequest, shared, points);
  }
  result.points.assign(points.begin(), points.end());
  result.merged = mergedSamplesOf(tree, merged);
  return result;
}

} // namespace isopoint

#endif
