// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_NeighborhoodFits_h
#define isopoint_NeighborhoodFits_h

#include "Execution.h"
#include "FindingTally.h"
#include "Interpolation.h"
#include "Isopoint.h"
#include "LargeNeighborhood.h"
#include "LeafValues.h"
#include "LocalFit.h"
#include "NeighborSearch.h"
#include "SharedState.h"
#include "SortUnique.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace isopoint
{

/// An isopoint and the leaves that its edge connects.
template <class TSample>
struct LocatedIsopoint : Isopoint
{
  typename TSample::Id firstSlot;
  typename TSample::Id secondSlot;
};

/// Gathers the samples around edges and fits to them, one edge at a time. Scratch is kept. The
/// spacing of the samples at an edge is the mean, over the ends whose neighbours are taken, of the
/// distance that two fifths of them do not exceed.
template <class TSample>
class NeighborhoodFitter
{
public:
  NeighborhoodFitter(const SampleTree<TSample>& tree, double isovalue, FitOrder highest,
    SharedState<TSample>& shared)
    : Tree(tree)
    , Isovalue(isovalue)
    , Highest(highest)
    , Many(tree, shared.bounds)
    , Values(tree, shared.heapMeans)
  {
  }

  LocalFit fit(const LocatedIsopoint<TSample>& point, FitTallies& tallies)
  {
    this->gather(point);
    const FitSample first = this->sampleAt(point.firstSlot);
    const FitSample second = this->sampleAt(point.secondSlot);
    FitEdge edge;
    for (int axis = 0; axis < 3; ++axis)
    {
      edge.position[axis] =
        interpolate(first.position[axis], second.position[axis], point.parameter);
    }
    const bool rises = first.value < this->Isovalue;
    edge.rising = rises ? difference(second.position, first.position)
                        : difference(first.position, second.position);
    edge.rise = rises ? second.value - first.value : first.value - second.value;
    edge.spacing = this->Spacing;
    LocalFit fit = fitAround(
      edge, this->Isovalue, this->Samples,
      [&]() -> const std::vector<FitSample>&
      {
        if (this->Samples.size() > enoughSamples)
        {
          return this->Samples;
        }
        this->gatherWider(point);
        return this->WiderSamples;
      },
      this->Highest, tallies);
    fit.spacing = edge.spacing;
    return fit;
  }

  /// Sets a moved isopoint's parameter to that of the edge's nearest place, or moves it back.
  void settle(LocatedIsopoint<TSample>& point, LocalFit& fit, bool move)
  {
    if (fit.order == FitOrder::None)
    {
      return;
    }
    const Vector first = this->sampleAt(point.firstSlot).position;
    const Vector second = this->sampleAt(point.secondSlot).position;
    if (move)
    {
      const Vector edge = difference(second, first);
      const double parameter =
        dot(difference(fit.position, first), directionOf(edge)) / lengthOf(edge);
      point.parameter = std::min(std::max(parameter, 0.0), 1.0);
      return;
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      fit.position[axis] = interpolate(first[axis], second[axis], point.parameter);
    }
  }

private:
  using Id = typename TSample::Id;

  /// Neighbourhoods of more samples are wide enough, as where samples stand in lines.
  static constexpr std::size_t enoughSamples = 64;

  /// Of a neighbourhood of more cells than that, as where samples stand in lines, those that are
  /// this small beside their distance from its middle are represented by one.
  static constexpr std::size_t mostNeighbors = 256;
  static constexpr double smallSize = 0.2;

  void clear()
  {
    this->Slots.clear();
    this->Counts.clear();
    this->Seen.fill(0);
  }

  /// Lists the samples of both ends' neighbourhoods; but where one end alone has very many
  /// neighbours, as in a cell that fills a void, they are far off beside those of the other.
  void gather(const LocatedIsopoint<TSample>& point)
  {
    this->clear();
    this->Ends.clear();
    this->Spacing = 0.0;
    for (const Id end : { point.firstSlot, point.secondSlot })
    {
      const std::size_t begin = this->Slots.size();
      this->Seen.fill(0);
      if (this->addFew(end))
      {
        this->Ends.push_back(end);
        this->Spacing += this->spacingAt(end, begin);
      }
    }
    if (this->Ends.empty())
    {
      this->Ends = { point.firstSlot, point.secondSlot };
      for (const Id end : this->Ends)
      {
        const std::size_t begin = this->Slots.size();
        this->Seen.fill(0);
        this->addSome(end);
        this->Spacing += this->spacingAt(end, begin);
      }
    }
    this->Spacing /= static_cast<double>(this->Ends.size());
    this->list(this->Samples);
  }

  /// The spacing of the samples around an end: the distance that two fifths of its
  /// neighbourhood, which are those listed from `begin` on, do not exceed. The farthest may stand
  /// across a void, the nearest all in one line with it.
  double spacingAt(Id end, std::size_t begin)
  {
    const Vector center = this->sampleAt(end).position;
    this->Distances.clear();
    for (std::size_t i = begin; i < this->Slots.size(); ++i)
    {
      this->Distances.emplace_back(
        lengthOf(difference(this->sampleAt(this->Slots[i].second).position, center)),
        this->Counts[i]);
    }
    std::sort(this->Distances.begin(), this->Distances.end());
    const std::size_t all =
      std::accumulate(this->Counts.begin() + static_cast<std::ptrdiff_t>(begin), this->Counts.end(),
        std::size_t{ 0 });
    std::size_t nearer = 0;
    const auto found = std::find_if(this->Distances.begin(), this->Distances.end(),
      [&](const auto& distance) { return (nearer += distance.second) > 2 * all / 5; });
    return found->first;
  }

  /// Adds the samples of the neighbourhoods of those that lie on the other side of the isovalue
  /// than the end whose neighbours they are: the tree is refined around these.
  void gatherWider(const LocatedIsopoint<TSample>& point)
  {
    this->Across.clear();
    this->clear();
    this->addSlot(point.firstSlot);
    this->addSlot(point.secondSlot);
    for (const Id end : this->Ends)
    {
      const std::size_t begin = this->Slots.size();
      this->Seen.fill(0);
      this->addNeighborhood(end);
      const bool isBelow = this->isBelow(end);
      for (std::size_t i = begin; i < this->Slots.size(); ++i)
      {
        const Id slot = this->Slots[i].second;
        if (this->isBelow(slot) != isBelow)
        {
          this->Across.push_back(slot);
        }
      }
    }
    for (const Id slot : this->Across)
    {
      if (!this->addFew(slot) && this->Ends.size() == 2)
      {
        this->addSome(slot);
      }
    }
    this->list(this->WiderSamples);
  }

  bool isBelow(Id slot) { return this->sampleAt(slot).value < this->Isovalue; }

  /// Lists samples by id, each once.
  void list(std::vector<FitSample>& samples)
  {
    std::sort(this->Slots.begin(), this->Slots.end());
    this->Slots.erase(std::unique(this->Slots.begin(), this->Slots.end()), this->Slots.end());
    samples.clear();
    for (const auto& [id, slot] : this->Slots)
    {
      samples.push_back(this->sampleAt(slot));
    }
  }

  /// Adds a sample and its neighbours, of very many only some.
  void addNeighborhood(Id leafSlot)
  {
    if (!this->addFew(leafSlot))
    {
      this->addSome(leafSlot);
    }
  }

  /// Adds a sample and, unless they are very many, its neighbours. @returns whether they are few
  bool addFew(Id leafSlot)
  {
    this->addSlot(leafSlot);
    const SlotList<Id> known = this->Tree.neighborhoods.at(static_cast<std::size_t>(leafSlot));
    if (known.count > mostNeighbors)
    {
      return false;
    }
    for (const Id slot : known)
    {
      this->addSlot(slot);
    }
    if (!known.isEmpty())
    {
      return true;
    }
    this->Touching.clear();
    const bool areMany = visitTouching(this->Tree, pathToLeaf(this->Tree, leafSlot), maximumDepth,
      [this](std::size_t slot)
      {
        this->Touching.push_back(static_cast<Id>(slot));
        return this->Touching.size() > mostNeighbors;
      });
    if (areMany)
    {
      return false;
    }
    for (const Id slot : this->Touching)
    {
      this->addSlot(slot);
    }
    return true;
  }

  /// Adds some of a sample's neighbours, one for each direction and distance.
  void addSome(Id leafSlot)
  {
    this->Many.moveTo(pathToLeaf(this->Tree, leafSlot));
    this->Many.forEachSpread(smallSize,
      [this](std::size_t slot, std::size_t count) { this->addSlot(static_cast<Id>(slot), count); });
  }

  /// Adds a leaf, unless it was added and is remembered: around an edge most are met many times.
  /// One that is forgotten is listed again, until list() takes each once; within the neighbourhood
  /// of one end none is met twice.
  /// @param count of the samples that it stands for
  void addSlot(Id slot, std::size_t count = 1)
  {
    Id& seen = this->Seen[static_cast<std::size_t>(slot) % this->Seen.size()];
    if (seen == slot)
    {
      return;
    }
    seen = slot;
    this->Counts.push_back(count);
    this->Slots.emplace_back(this->Tree.samples[this->leafAt(slot).begin].id, slot);
  }

  const Node<TSample>& leafAt(Id slot) const
  {
    return this->Tree.nodes[static_cast<std::size_t>(slot)];
  }

  FitSample sampleAt(Id slot)
  {
    const TSample& sample = this->Tree.samples[this->leafAt(slot).begin];
    return { { sample.position[0], sample.position[1], sample.position[2] },
      this->Values.at(static_cast<std::size_t>(slot)) };
  }

  const SampleTree<TSample>& Tree;
  const double Isovalue;
  const FitOrder Highest;
  LargeNeighborhood<TSample> Many;
  LeafValues<TSample> Values;
  std::vector<std::pair<Id, Id>> Slots; // by the id of the leaf's first sample
  std::array<Id, 1024> Seen{};          // slots added lately, by their last bits
  std::vector<Id> Ends;                 // whose neighbourhoods are taken
  std::vector<Id> Across;
  std::vector<Id> Touching; // the leaf at hand
  std::vector<FitSample> Samples;
  std::vector<FitSample> WiderSamples;
  std::vector<std::size_t> Counts; // of the samples that those gathered in Slots stand for
  std::vector<std::pair<double, std::size_t>> Distances; // and the same counts
  double Spacing = 0.0;                                  // mean of those at the ends
};

/// The place of an isopoint in the tree.
struct TreePlace
{
  std::uint64_t lower; // of its edge's ends among the tree's samples
  std::uint64_t upper;
  std::size_t point;

  bool operator<(const TreePlace& other) const
  {
    return this->lower != other.lower ? this->lower < other.lower : this->upper < other.upper;
  }
  bool operator==(const TreePlace& other) const
  {
    return this->lower == other.lower && this->upper == other.upper;
  }
};

/// Isopoints in the order of the tree, where those that follow each other lie close together,
/// however samples are numbered.
template <class TSample>
std::vector<TreePlace> placesOf(const Execution& execution, const SampleTree<TSample>& tree,
  const std::vector<LocatedIsopoint<TSample>>& points)
{
  const auto beginOf = [&tree](typename TSample::Id slot) -> std::uint64_t
  { return tree.nodes[static_cast<std::size_t>(slot)].begin; };
  std::vector<TreePlace> places;
  places.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const auto [lower, upper] =
      std::minmax({ beginOf(points[i].firstSlot), beginOf(points[i].secondSlot) });
    places.push_back({ lower, upper, i });
  }
  return sortedUnique(
    execution, places, tree.samples.size(), [](const TreePlace& place) { return place.lower; });
}

/// Fits to the samples around each isopoint: to those of the two cells that its edge connects and
/// of the cells that touch one of them. Where one of the two touches more than 256, its own are
/// left out; where both do, those that are small as seen from it are represented by one. The tree
/// is to be refined for the isovalue. Isopoints are fitted in groups of 256 that follow each other
/// in the tree: what the others tell of detail and creases decides on doubtful ones (see
/// FindingTally).
/// @param points whose parameters are set to where moved isopoints stand
template <class TSample>
std::vector<LocalFit> fitNeighborhoods(const Execution& execution, const SampleTree<TSample>& tree,
  double isovalue, FitRequest request, SharedState<TSample>& shared,
  std::vector<LocatedIsopoint<TSample>>& points)
{
  std::vector<LocalFit> fits(points.size());
  const std::vector<TreePlace> places = placesOf(execution, tree, points);
  // So many isopoints share tallies. Batches are of few groups: where cells touch hundreds of
  // others, a point takes long.
  constexpr std::size_t groupSize = 256;
  constexpr std::size_t batch = 4;
  forBatches(execution, (places.size() + groupSize - 1) / groupSize, batch, 1,
    [&](std::size_t begin, std::size_t end)
    {
      NeighborhoodFitter<TSample> fitter(tree, isovalue, request.highest, shared);
      for (std::size_t group = begin; group < end; ++group)
      {
        FitTallies tallies;
        const std::size_t groupEnd = std::min((group + 1) * groupSize, places.size());
        for (std::size_t i = group * groupSize; i < groupEnd; ++i)
        {
          const std::size_t point = places[i].point;
          fits[point] = fitter.fit(points[point], tallies);
          fitter.settle(points[point], fits[point], request.move);
        }
      }
    });
  return fits;
}

} // namespace isopoint

#endif
