// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SampleGatherer_h
#define isopoint_SampleGatherer_h

#include "Isopoint/Base/Vector.h"
#include "Isopoint/Extraction/ExtractionContext.h"
#include "Isopoint/Extraction/LeafSet.h"
#include "Isopoint/Fit/LocalFit.h"
#include "Isopoint/Neighbors/ImplicitNeighborhood.h"
#include "Isopoint/Neighbors/NeighborSearch.h"
#include "Isopoint/Neighbors/NeighborhoodCache.h"
#include "Isopoint/Tree/CoincidentSamples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace isopoint
{

/// The spacing of the samples around one of them; see docs/algorithm.md, section 10.1. Memory is
/// kept. For one thread.
class SampleSpacing
{
public:
  /// Forgets all neighbors.
  void clear() { this->Neighbors.clear(); }

  /// Adds a neighbor at another position.
  void add(const Vector& offset)
  {
    this->Neighbors.push_back({ offset, lengthOf(offset), this->Neighbors.size() });
  }

  /// The distance that two fifths of the neighbors and the sample itself do not exceed, or that at
  /// which they span space, if that is well less. The farthest may be across a void, the nearest
  /// all on one line or in one slice with the sample.
  /// Complexity: O(n log n)
  double spacing()
  {
    std::sort(this->Neighbors.begin(), this->Neighbors.end(),
      [](const Neighbor& a, const Neighbor& b)
      { return a.distance != b.distance ? a.distance < b.distance : a.number < b.number; });
    constexpr double spanShare = 1.2;
    const std::size_t rank = 2 * (this->Neighbors.size() + 1) / 5;
    const double usual = rank > 0 ? this->Neighbors[rank - 1].distance : 0.0;
    return std::min(usual, spanShare * this->distanceThatSpans());
  }

private:
  struct Neighbor
  {
    Vector offset;
    double distance;
    std::size_t number;
  };

  /// The distance of the nearest neighbor that is more than 30 degrees off the plane of the nearest
  /// one and the nearest that is more than 30 degrees off the line of that; infinite without any.
  double distanceThatSpans() const
  {
    constexpr double sine = 0.5;
    constexpr double cosine = 0.86602540378443865;
    std::optional<Vector> line;
    std::optional<Vector> normal; // of the plane
    for (const Neighbor& neighbor : this->Neighbors)
    {
      const Vector direction = directionOf(neighbor.offset);
      if (normal && std::abs(dot(direction, *normal)) > sine)
      {
        return neighbor.distance;
      }
      if (line && !normal && std::abs(dot(direction, *line)) < cosine)
      {
        normal = directionOf(cross(direction, *line));
      }
      line = line ? line : direction;
    }
    return std::numeric_limits<double>::infinity();
  }

  std::vector<Neighbor> Neighbors;
};

/// Gathers the samples around edges, one edge at a time: within one ring of touching cells
/// around its ends, or two rings as far as the tree is refined for the isovalue. Memory is kept.
/// For one thread.
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

  /// Gathers the samples of both ends and of their neighbors; but if one end alone has very many,
  /// as a cell that fills a void has, only those of the other end. If both have, a subset of theirs
  /// that covers all directions and distances.
  void gather(Id firstLeaf, Id secondLeaf)
  {
    this->Known.clear();
    this->Samples.clear();
    this->IsWide = false;
    const bool isInOrder = this->beginOf(firstLeaf) < this->beginOf(secondLeaf);
    this->Ends[0].leaf = isInOrder ? firstLeaf : secondLeaf;
    this->Ends[1].leaf = isInOrder ? secondLeaf : firstLeaf;
    for (End& end : this->Ends)
    {
      const NodeList<Id> neighbors = this->neighborsOf(end.leaf);
      end.neighbors.assign(neighbors.begin(), neighbors.end());
      end.isTaken = !neighbors.isEmpty();
    }
    if (!this->Ends[0].isTaken && !this->Ends[1].isTaken)
    {
      for (End& end : this->Ends)
      {
        end.isTaken = true;
        this->listSome(end.leaf, end.neighbors);
      }
    }
    for (const End& end : this->Ends)
    {
      this->add(end.leaf);
      if (end.isTaken)
      {
        this->addAll(end.neighbors);
      }
    }
  }

  /// Adds the neighbors of the ends' neighbors across the isovalue, unless there are enough
  /// samples, as where these are in lines.
  void widen()
  {
    constexpr std::size_t enoughSamples = 128;
    if (this->IsWide || this->Samples.size() > enoughSamples)
    {
      return;
    }
    this->IsWide = true;
    for (const End& end : this->Ends)
    {
      const bool isBelow = this->isBelow(end.leaf);
      for (std::size_t i = 0; end.isTaken && i < end.neighbors.size(); ++i)
      {
        const Id leaf = end.neighbors[i];
        if (this->isBelow(leaf) != isBelow)
        {
          this->addAll(this->neighborsOf(leaf));
        }
      }
    }
  }

  /// The samples of the present edge, each once, coincident ones as one. Their order depends on the
  /// tree alone.
  const std::vector<FitSample>& samples() const { return this->Samples; }

  /// The mean of the spacings at those ends whose neighbors are taken.
  double spacing()
  {
    double sum = 0.0;
    double count = 0.0;
    for (const End& end : this->Ends)
    {
      if (end.isTaken)
      {
        sum += this->spacingAt(end);
        count += 1.0;
      }
    }
    return sum / count;
  }

  /// A leaf's sample.
  FitSample sampleAt(Id leaf)
  {
    const TSample& sample = this->Tree.samples[this->beginOf(leaf)];
    return { { sample.position[0], sample.position[1], sample.position[2] },
      this->Values.at(static_cast<std::size_t>(leaf)) };
  }

private:
  /// More neighbors than that are not taken whole.
  static constexpr std::size_t mostNeighbors = 256;

  /// Of leaves about which something is kept, or memory would grow with the surface.
  static constexpr std::size_t mostLists = 4096;

  struct End
  {
    Id leaf;
    bool isTaken; // with its neighbors
    std::vector<Id> neighbors;
  };

  /// The neighbors of a leaf; none if they are too many. Valid until the next call.
  NodeList<Id> neighborsOf(Id leaf)
  {
    const auto found = this->RecentlyFound.find(leaf);
    if (found != this->RecentlyFound.end())
    {
      return { found->second.data(), found->second.size() };
    }
    std::vector<Id> memory;
    const NodeList<Id> neighbors = fewNeighborsOf(this->Tree, this->Context.neighborhoods,
      static_cast<std::size_t>(leaf), mostNeighbors, memory);
    if (!memory.empty())
    {
      if (this->RecentlyFound.size() == mostLists)
      {
        this->RecentlyFound.clear();
      }
      memory.resize(neighbors.count);
      this->RecentlyFound.emplace(leaf, std::move(memory)); // the elements stay where they are
    }
    return neighbors;
  }

  /// Lists some of very many neighbors: one for each subtree whose size over its distance is
  /// small.
  void listSome(Id leaf, std::vector<Id>& neighbors)
  {
    constexpr double smallSize = 0.2;
    neighbors.clear();
    this->Implicit.moveTo(pathToLeaf(this->Tree, leaf));
    this->Implicit.forEachSpread(smallSize,
      [&neighbors](std::size_t neighbor) { neighbors.push_back(static_cast<Id>(neighbor)); });
  }

  /// The spacing of the samples around an end.
  double spacingAt(const End& end)
  {
    if (this->Spacings.size() >= mostLists)
    {
      this->Spacings.clear();
    }
    const auto [known, isNew] = this->Spacings.try_emplace(end.leaf, 0.0);
    if (isNew)
    {
      const Vector center = this->positionOfLeaf(end.leaf);
      this->Spacing.clear();
      for (const Id neighbor : end.neighbors)
      {
        this->Spacing.add(difference(this->positionOfLeaf(neighbor), center));
      }
      known->second = this->Spacing.spacing();
    }
    return known->second;
  }

  bool isBelow(Id leaf)
  {
    return this->Values.at(static_cast<std::size_t>(leaf)) < this->Context.isovalue;
  }

  template <class TLeaves>
  void addAll(const TLeaves& leaves)
  {
    for (const Id leaf : leaves)
    {
      this->add(leaf);
    }
  }

  void add(Id leaf)
  {
    if (this->Known.add(leaf))
    {
      this->Samples.push_back(this->sampleAt(leaf));
    }
  }

  /// The place of a leaf in the order of the tree.
  std::size_t beginOf(Id leaf) const
  {
    return this->Tree.nodes[static_cast<std::size_t>(leaf)].begin;
  }

  Vector positionOfLeaf(Id leaf) const
  {
    return positionOf(this->Tree.samples[this->beginOf(leaf)]);
  }

  ExtractionContext<TSample>& Context;
  const SampleTree<TSample>& Tree;
  ImplicitNeighborhood<TSample> Implicit;
  LeafValueCache<TSample> Values;
  std::array<End, 2> Ends{}; // of the present edge, in the order of the tree
  LeafSet<Id> Known;         // leaves whose samples are taken
  std::vector<FitSample> Samples;
  bool IsWide = false;
  std::unordered_map<Id, std::vector<Id>> RecentlyFound; // neighbors, by leaf
  std::unordered_map<Id, double> Spacings;               // likewise
  SampleSpacing Spacing;
};

} // namespace isopoint

#endif
