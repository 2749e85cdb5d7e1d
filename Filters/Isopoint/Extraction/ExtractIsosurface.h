// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_ExtractIsosurface_h
#define isopoint_ExtractIsosurface_h

#include "Isopoint/Neighbors/AngleCriterion.h"
#include "Isopoint/Base/Execution.h"
#include "Isopoint/Neighbors/GapCriterion.h"
#include "Isopoint/Base/Interpolation.h"
#include "Isopoint/Extraction/Isosurface.h"
#include "Isopoint/Neighbors/ImplicitNeighborhood.h"
#include "Isopoint/Tree/LeafValueCache.h"
#include "Isopoint/Extraction/NarrowBand.h"
#include "Isopoint/Extraction/NeighborhoodFits.h"
#include "Isopoint/Extraction/ExtractionContext.h"
#include "Isopoint/Base/SortUnique.h"

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
    const GapCriterion& gapCriterion, ExtractionContext<TSample>& shared)
    : Tree(tree)
    , Isovalue(isovalue)
    , Criterion(criterion)
    , Gaps(gapCriterion)
    , Shared(shared)
    , Many(tree, shared.bounds)
    , Values(tree, shared.leafMeans)
  {
  }

  /// Adds an isopoint for each neighbour of the leaf's sample that survives the angle criterion
  /// there and lies on the other side of the isovalue (sections 6 and 7 of the paper), but not
  /// across a gap.
  void find(const Path& leaf)
  {
    const double value = this->Values.at(leaf.nodeIndex());
    const bool isBelow = value < this->Isovalue;
    this->Neighbors = this->Tree.neighborhoods.at(leaf.nodeIndex());
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
    this->measureNeighbors(this->sampleAt(leaf.nodeIndex()));
    for (const Crossing& crossing : this->Crossings)
    {
      if (this->survives(crossing.neighbor))
      {
        this->connect(leaf, value, this->Neighbors[crossing.neighbor], crossing.value);
      }
    }
  }

  std::vector<LocatedIsopoint<TSample>>& points() { return this->Points; }

  /// Node indices of leaves with several samples among the points' ends, with repetitions.
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
    this->Records.push_back(static_cast<Id>(leaf.nodeIndex()));
    this->Records.push_back(0);
    visitTouching(this->Tree, leaf, maximumDepth,
      [this](std::size_t nodeIndex)
      {
        this->Records.push_back(static_cast<Id>(nodeIndex));
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
      [this, isBelow](std::size_t nodeIndex)
      { return (this->Values.at(nodeIndex) < this->Isovalue) != isBelow; },
      [this, &leaf, value](std::size_t nodeIndex)
      { this->connect(leaf, value, nodeIndex, this->Values.at(nodeIndex)); });
  }

  const TSample& sampleAt(std::size_t nodeIndex) const
  {
    return this->Tree.samples[this->Tree.nodes[nodeIndex].begin];
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
    for (const std::size_t nodeIndex : this->Neighbors)
    {
      const TSample& other = this->sampleAt(nodeIndex);
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
  void connect(const Path& leaf, double value, std::size_t otherLeaf, double otherValue)
  {
    const TSample& sample = this->sampleAt(leaf.nodeIndex());
    const TSample& otherSample = this->sampleAt(otherLeaf);
    if (this->Gaps.drops(this->Tree, leaf, sample, otherSample))
    {
      return;
    }
    this->addPoint({ sample.id, static_cast<Id>(leaf.nodeIndex()), value },
      { otherSample.id, static_cast<Id>(otherLeaf), otherValue });
    this->addCoincident(leaf.nodeIndex());
    this->addCoincident(otherLeaf);
  }

  struct End
  {
    Id id;
    Id nodeIndex;
    double value;
  };

  void addPoint(const End& a, const End& b)
  {
    const End& first = a.id < b.id ? a : b;
    const End& second = a.id < b.id ? b : a;
    this->Points.push_back(
      { { first.id, second.id, edgeParameter(first.value, second.value, this->Isovalue) },
        first.nodeIndex, second.nodeIndex });
  }

  void addCoincident(std::size_t leaf)
  {
    if (this->Tree.nodes[nodeIndex].count() > 1 && (this->Merged.empty() || this->Merged.back() != nodeIndex))
    {
      this->Merged.push_back(nodeIndex);
    }
  }

  const SampleTree<TSample>& Tree;
  const double Isovalue;
  const AngleCriterion& Criterion;
  const GapCriterion& Gaps;
  ExtractionContext<TSample>& Shared;
  ImplicitNeighborhood<TSample> Many;
  NodeList<Id> Neighbors;
  std::vector<Id> Records; // behind the kept ones, one for the leaf at hand where there is no room
  std::size_t KeptRecords = 0;
  std::vector<Offset> Offsets; // of the neighbours
  std::vector<Offset> Sorted;  // the same, nearest first, where there are many
  std::vector<Crossing> Crossings;
  std::vector<LocatedIsopoint<TSample>> Points;
  std::vector<std::size_t> Merged;
  LeafValueCache<TSample> Values;
};

/// The samples of leaves, ordered by lowest id. @param nodeIndices of the leaves, with repetitions
template <class TSample>
std::vector<CoincidentSamples> coincidentSamplesOf(
  const SampleTree<TSample>& tree, std::vector<std::size_t>& nodeIndices)
{
  std::sort(nodeIndices.begin(), nodeIndices.end());
  nodeIndices.erase(std::unique(nodeIndices.begin(), nodeIndices.end()), nodeIndices.end());
  std::vector<CoincidentSamples> merged;
  for (const std::size_t nodeIndex : nodeIndices)
  {
    const Node<TSample>& leaf = tree.nodes[nodeIndex];
    CoincidentSamples group;
    for (std::size_t i = leaf.begin; i < leaf.end; ++i)
    {
      group.ids.push_back(tree.samples[i].id);
    }
    merged.push_back(std::move(group));
  }
  std::sort(merged.begin(), merged.end(),
    [](const CoincidentSamples& a, const CoincidentSamples& b) { return a.ids.front() < b.ids.front(); });
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
  const std::vector<BinaryIndex> crossing = NarrowBand<TSample>(tree, isovalue, execution).refine();
  const AngleCriterion criterion(angle);
  const GapCriterion gapCriterion(gapFactor);
  std::vector<LocatedIsopoint<TSample>> points;
  std::vector<std::size_t> merged;
  std::vector<std::vector<typename TSample::Id>> records;
  ExtractionContext<TSample> shared(tree);
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
  result.merged = coincidentSamplesOf(tree, merged);
  return result;
}

} // namespace isopoint

#endif
