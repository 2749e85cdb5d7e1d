// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SampleGatherer_h
#define isopoint_SampleGatherer_h

#include "LargeNeighborhood.h"
#include "LeafValues.h"
#include "LocalFit.h"
#include "NeighborSearch.h"
#include "SharedState.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace isopoint
{

/// Gathers the samples around edges, one edge at a time. Scratch is kept.
template <class TSample>
class SampleGatherer
{
public:
  using Id = typename TSample::Id;

  SampleGatherer(const SampleTree<TSample>& tree, double isovalue, SharedState<TSample>& shared)
    : Tree(tree)
    , Isovalue(isovalue)
    , Many(tree, shared.bounds)
    , Values(tree, shared.heapMeans)
  {
  }

  /// Gathers the samples of both ends' neighbourhoods; but where one end alone has very many
  /// neighbours, as in a cell that fills a void, they are far off beside those of the other.
  void gather(Id firstSlot, Id secondSlot)
  {
    this->clear();
    this->IsWiderGathered = false;
    this->FirstSlot = firstSlot;
    this->SecondSlot = secondSlot;
    this->Ends.clear();
    this->Spacing = 0.0;
    for (const Id end : { firstSlot, secondSlot })
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
      this->Ends = { firstSlot, secondSlot };
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

  /// Of the edge at hand, by id.
  const std::vector<FitSample>& samples() const { return this->Samples; }

  /// More of them, if those are few: the neighbourhoods of some of them as well.
  const std::vector<FitSample>& widerSamples()
  {
    if (this->Samples.size() > enoughSamples)
    {
      return this->Samples;
    }
    if (!this->IsWiderGathered)
    {
      this->gatherWider();
      this->IsWiderGathered = true;
    }
    return this->WiderSamples;
  }

  /// The mean, over the ends whose neighbours are taken, of the distance that two fifths of them do
  /// not exceed.
  double spacing() const { return this->Spacing; }

  /// A leaf's sample.
  FitSample sampleAt(Id slot)
  {
    const TSample& sample = this->Tree.samples[this->leafAt(slot).begin];
    return { { sample.position[0], sample.position[1], sample.position[2] },
      this->Values.at(static_cast<std::size_t>(slot)) };
  }

private:
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
  void gatherWider()
  {
    this->Across.clear();
    this->clear();
    this->addSlot(this->FirstSlot);
    this->addSlot(this->SecondSlot);
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

  const SampleTree<TSample>& Tree;
  const double Isovalue;
  LargeNeighborhood<TSample> Many;
  LeafValues<TSample> Values;
  Id FirstSlot = 0; // of the edge at hand
  Id SecondSlot = 0;
  std::vector<std::pair<Id, Id>> Slots; // by the id of the leaf's first sample
  std::array<Id, 1024> Seen{};          // slots added lately, by their last bits
  std::vector<Id> Ends;                 // whose neighbourhoods are taken
  std::vector<Id> Across;
  std::vector<Id> Touching; // the leaf at hand
  std::vector<FitSample> Samples;
  std::vector<FitSample> WiderSamples;
  bool IsWiderGathered = false;
  std::vector<std::size_t> Counts; // of the samples that those gathered in Slots stand for
  std::vector<std::pair<double, std::size_t>> Distances; // and the same counts
  double Spacing = 0.0;
};

} // namespace isopoint

#endif
