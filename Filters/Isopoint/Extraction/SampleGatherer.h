// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SampleGatherer_h
#define isopoint_SampleGatherer_h

#include "Isopoint/Extraction/ExtractionContext.h"
#include "Isopoint/Fit/LocalFit.h"
#include "Isopoint/Neighbors/ImplicitNeighborhood.h"
#include "Isopoint/Neighbors/NeighborSearch.h"
#include "Isopoint/Tree/LeafValueCache.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace isopoint
{

/// Gathers the samples around edges, one edge at a time. Memory is kept. For one thread.
template <class TSample>
class SampleGatherer
{
public:
  using Id = typename TSample::Id;

  explicit SampleGatherer(ExtractionContext<TSample>& context)
    : Context(context)
    , Tree(context.tree)
    , Implicit(context.tree, context.bounds)
    , Values(context.tree, context.leafMeans)
  {
  }

  /// Gathers the samples of both ends' neighbourhoods; but if one end alone has very many
  /// neighbours, as a cell that fills a void has, only those of the other end.
  void gather(Id firstLeaf, Id secondLeaf)
  {
    this->clear();
    this->IsWiderGathered = false;
    this->FirstLeaf = firstLeaf;
    this->SecondLeaf = secondLeaf;
    this->Ends.clear();
    this->Spacing = 0.0;
    for (const Id end : { firstLeaf, secondLeaf })
    {
      const std::size_t begin = this->Leaves.size();
      this->Seen.fill(0);
      if (this->addFew(end))
      {
        this->Ends.push_back(end);
        this->Spacing += this->spacingAt(end, begin);
      }
    }
    if (this->Ends.empty())
    {
      this->Ends = { firstLeaf, secondLeaf };
      for (const Id end : this->Ends)
      {
        const std::size_t begin = this->Leaves.size();
        this->Seen.fill(0);
        this->addSome(end);
        this->Spacing += this->spacingAt(end, begin);
      }
    }
    this->Spacing /= static_cast<double>(this->Ends.size());
    this->list(this->Samples);
  }

  /// The samples of the present edge, by id.
  const std::vector<FitSample>& samples() const { return this->Samples; }

  /// More of them, if those are few: with the neighbourhoods of some of them.
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

  /// The spacing of the samples around the edge: the mean, over the ends whose neighbours are
  /// taken, of the distance that two fifths of these do not exceed.
  double spacing() const { return this->Spacing; }

  /// A leaf's sample.
  FitSample sampleAt(Id leaf)
  {
    const TSample& sample = this->Tree.samples[this->leafAt(leaf).begin];
    return { { sample.position[0], sample.position[1], sample.position[2] },
      this->Values.at(static_cast<std::size_t>(leaf)) };
  }

private:
  /// Neighbourhoods of more samples than that are wide enough, as where samples stand in lines.
  static constexpr std::size_t enoughSamples = 64;

  /// In a neighbourhood of more cells than that, as where samples stand in lines, subtrees whose
  /// size over their distance is less than smallSize are represented by one leaf.
  static constexpr std::size_t mostNeighbors = 256;
  static constexpr double smallSize = 0.2;

  void clear()
  {
    this->Leaves.clear();
    this->Counts.clear();
    this->Seen.fill(0);
  }

  /// The spacing of the samples around an end: the distance that two fifths of its neighbourhood,
  /// listed from `begin` on, do not exceed. The farthest may stand across a void, the nearest all
  /// in one line with it.
  double spacingAt(Id end, std::size_t begin)
  {
    const Vector center = this->sampleAt(end).position;
    this->Distances.clear();
    for (std::size_t i = begin; i < this->Leaves.size(); ++i)
    {
      this->Distances.emplace_back(
        lengthOf(difference(this->sampleAt(this->Leaves[i].second).position, center)),
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

  /// Adds the neighbourhoods of those neighbours of an end that lie on the other side of the
  /// isovalue: the tree is refined around these.
  void gatherWider()
  {
    this->Across.clear();
    this->clear();
    this->addLeaf(this->FirstLeaf);
    this->addLeaf(this->SecondLeaf);
    for (const Id end : this->Ends)
    {
      const std::size_t begin = this->Leaves.size();
      this->Seen.fill(0);
      this->addNeighborhood(end);
      const bool isBelow = this->isBelow(end);
      for (std::size_t i = begin; i < this->Leaves.size(); ++i)
      {
        const Id leaf = this->Leaves[i].second;
        if (this->isBelow(leaf) != isBelow)
        {
          this->Across.push_back(leaf);
        }
      }
    }
    for (const Id leaf : this->Across)
    {
      if (!this->addFew(leaf) && this->Ends.size() == 2)
      {
        this->addSome(leaf);
      }
    }
    this->list(this->WiderSamples);
  }

  bool isBelow(Id leaf) { return this->sampleAt(leaf).value < this->Context.isovalue; }

  /// Lists samples by id, each once.
  void list(std::vector<FitSample>& samples)
  {
    std::sort(this->Leaves.begin(), this->Leaves.end());
    this->Leaves.erase(std::unique(this->Leaves.begin(), this->Leaves.end()), this->Leaves.end());
    samples.clear();
    for (const auto& [id, leaf] : this->Leaves)
    {
      samples.push_back(this->sampleAt(leaf));
    }
  }

  /// Adds a sample and its neighbours, of very many only some.
  void addNeighborhood(Id leafNode)
  {
    if (!this->addFew(leafNode))
    {
      this->addSome(leafNode);
    }
  }

  /// Adds a sample and, unless they are very many, its neighbours. @returns whether it added these
  bool addFew(Id leafNode)
  {
    this->addLeaf(leafNode);
    const NodeList<Id> known = this->Context.neighborhoods.at(static_cast<std::size_t>(leafNode));
    if (known.count > mostNeighbors)
    {
      return false;
    }
    for (const Id leaf : known)
    {
      this->addLeaf(leaf);
    }
    if (!known.isEmpty())
    {
      return true;
    }
    this->Touching.clear();
    const bool areMany = visitTouching(this->Tree, pathToLeaf(this->Tree, leafNode), maximumDepth,
      [this](std::size_t leaf)
      {
        this->Touching.push_back(static_cast<Id>(leaf));
        return this->Touching.size() > mostNeighbors;
      });
    if (areMany)
    {
      return false;
    }
    for (const Id leaf : this->Touching)
    {
      this->addLeaf(leaf);
    }
    return true;
  }

  /// Adds a subset of a sample's neighbours that covers all directions and distances.
  void addSome(Id leafNode)
  {
    this->Implicit.moveTo(pathToLeaf(this->Tree, leafNode));
    this->Implicit.forEachSpread(smallSize,
      [this](std::size_t leaf, std::size_t count) { this->addLeaf(static_cast<Id>(leaf), count); });
  }

  /// Adds a leaf, unless `Seen` shows that it was added: around an edge most leaves are met many
  /// times. `Seen` may miss some; list() then drops the repetitions. Within the neighbourhood of
  /// one end none is met twice.
  /// @param count of the samples that it represents
  void addLeaf(Id leaf, std::size_t count = 1)
  {
    Id& seen = this->Seen[static_cast<std::size_t>(leaf) % this->Seen.size()];
    if (seen == leaf)
    {
      return;
    }
    seen = leaf;
    this->Counts.push_back(count);
    this->Leaves.emplace_back(this->Tree.samples[this->leafAt(leaf).begin].id, leaf);
  }

  const Node<TSample>& leafAt(Id leaf) const
  {
    return this->Tree.nodes[static_cast<std::size_t>(leaf)];
  }

  ExtractionContext<TSample>& Context;
  const SampleTree<TSample>& Tree;
  ImplicitNeighborhood<TSample> Implicit;
  LeafValueCache<TSample> Values;
  Id FirstLeaf = 0; // of the present edge
  Id SecondLeaf = 0;
  std::vector<std::pair<Id, Id>> Leaves; // by the id of the leaf's first sample
  std::array<Id, 1024> Seen{};           // leaves added recently, by their last bits
  std::vector<Id> Ends;                  // whose neighbourhoods are taken
  std::vector<Id> Across;
  std::vector<Id> Touching; // the present leaf
  std::vector<FitSample> Samples;
  std::vector<FitSample> WiderSamples;
  bool IsWiderGathered = false;
  std::vector<std::size_t> Counts; // of the samples that each of Leaves represents
  std::vector<std::pair<double, std::size_t>> Distances; // and the same counts
  double Spacing = 0.0;
};

} // namespace isopoint

#endif
