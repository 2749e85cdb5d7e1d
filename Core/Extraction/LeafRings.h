// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Lists.h"
#include "Core/Base/Vector.h"
#include "Core/Extraction/ExtractionContext.h"
#include "Core/Extraction/IndexSet.h"
#include "Core/Neighbors/ImplicitNeighborhood.h"
#include "Core/Neighbors/NeighborSearch.h"
#include "Core/Tree/CoincidentSamples.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace isopoint
{

/// The spacing of samples around one of them (docs/algorithm.md, section 10.1). For one thread.
class NeighborSpacing
{
public:
  void clear() { this->Neighbors.clear(); }

  /// @param offset to a neighbor, not zero
  void add(const Vector& offset)
  {
    this->Neighbors.push_back({ offset, lengthOf(offset), this->Neighbors.size() });
  }

  /// min(a, 1.2 b): a is the distance of the neighbor at 2/5 of the sorted list (ignores far ones
  /// across a void); b is the distance at which the neighbors first span space (ignores near ones
  /// on a line or plane). O(n log n)
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

  /// The distance at which the nearest neighbors span space; infinite if they do not. The nearest
  /// one defines a line; the next, more than 30 degrees off the line, defines a plane; the result
  /// is the distance of the next more than 30 degrees off the plane.
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

/// The rings of cells around leaves (docs/algorithm.md, section 10.1). Up to some thousands are
/// cached, since nearby edges share ends. For one thread.
template <class TSample>
class LeafRings
{
public:
  using Id = typename TSample::Id;

  /// Known rings around a leaf.
  struct Rings
  {
    Id leaf;
    bool hasTooMany;     // neighbors to list them all
    IndexSpan<Id> first; // neighbors; if too many, none or representatives
    std::vector<Id> representatives;
    std::optional<std::vector<Id>> second;
    std::optional<double> spacing;
  };

  explicit LeafRings(ExtractionContext<TSample>& context)
    : Context(context)
    , Tree(context.tree)
    , Implicit(context.tree, context.bounds)
    , Values(context.leafValues)
  {
  }

  LeafRings(const LeafRings&) = delete; // lists refer to others
  LeafRings& operator=(const LeafRings&) = delete;

  /// Clears the cache once it is large: memory must not grow with the surface.
  void makeRoom()
  {
    constexpr std::size_t maxLists = 4096;
    constexpr std::size_t maxListed = std::size_t{ 1 } << 20;
    if (this->Known.size() > maxLists || this->Found.size() > maxLists ||
        this->CountListed > maxListed)
    {
      this->Known.clear();
      this->Found.clear();
      this->CountListed = 0;
    }
  }

  /// The rings around a leaf. Valid until the next call of makeRoom().
  Rings& at(Id leaf)
  {
    const auto known = this->Known.find(leaf);
    if (known != this->Known.end())
    {
      return known->second;
    }
    const IndexSpan<Id> first = this->neighborsOf(leaf);
    return this->Known.try_emplace(leaf, Rings{ leaf, first.isEmpty(), first, {}, {}, {} })
      .first->second;
  }

  /// If there are too many neighbors, and no first ring yet, sets it to representatives: one for
  /// each subtree whose size over its distance is small.
  void represent(Rings& rings)
  {
    if (!rings.first.isEmpty())
    {
      return;
    }
    constexpr double smallSize = 0.2;
    std::vector<Id>& some = rings.representatives;
    some.clear();
    this->Implicit.moveTo(pathToNode(this->Tree, rings.leaf));
    this->Implicit.forEachSpread(
      smallSize, [&some](std::size_t neighbor) { some.push_back(static_cast<Id>(neighbor)); });
    rings.first = { some.data(), some.size() };
    this->CountListed += some.size();
  }

  /// The neighbors of the first ring's leaves across the isovalue, without the leaf and its first
  /// ring: each once, in search order. The first ring must be set.
  const std::vector<Id>& secondOf(Rings& rings)
  {
    if (!rings.second)
    {
      std::vector<Id> second;
      this->Listed.clear();
      this->Listed.add(rings.leaf);
      for (const Id leaf : rings.first)
      {
        this->Listed.add(leaf);
      }
      const bool isBelow = this->isBelow(rings.leaf);
      for (const Id leaf : rings.first)
      {
        if (this->isBelow(leaf) != isBelow)
        {
          for (const Id next : this->neighborsOf(leaf))
          {
            if (this->Listed.add(next))
            {
              second.push_back(next);
            }
          }
        }
      }
      this->CountListed += second.size();
      rings.second = std::move(second);
    }
    return *rings.second;
  }

  /// The spacing of the samples of a leaf and its first ring, which must be set.
  double spacingOf(Rings& rings)
  {
    if (!rings.spacing)
    {
      const Vector center = this->positionOfLeaf(rings.leaf);
      this->Spacing.clear();
      for (const Id neighbor : rings.first)
      {
        this->Spacing.add(this->positionOfLeaf(neighbor) - center);
      }
      rings.spacing = this->Spacing.spacing();
    }
    return *rings.spacing;
  }

  double valueOf(Id leaf) { return this->Values.at(leaf); }

private:
  /// The neighbors of a leaf; none if there are too many. Valid until the next call of makeRoom().
  IndexSpan<Id> neighborsOf(Id leaf)
  {
    constexpr std::size_t maxNeighbors = 256;
    const auto found = this->Found.find(leaf);
    if (found != this->Found.end())
    {
      return { found->second.data(), found->second.size() };
    }
    std::vector<Id> memory;
    const IndexSpan<Id> neighbors =
      fewNeighborsOf(this->Tree, this->Context.neighborhoods, leaf, maxNeighbors, memory);
    if (!memory.empty())
    {
      memory.resize(neighbors.count);
      this->Found.emplace(leaf, std::move(memory)); // elements do not move
    }
    return neighbors;
  }

  bool isBelow(Id leaf) { return this->valueOf(leaf) < this->Context.isovalue; }

  Vector positionOfLeaf(Id leaf) const { return positionOf(this->Tree.sampleOf(leaf)); }

  ExtractionContext<TSample>& Context;
  const SampleTree<TSample>& Tree;
  ImplicitNeighborhood<TSample> Implicit;
  LeafValues<TSample>& Values;
  std::unordered_map<Id, Rings> Known;           // by leaf
  std::unordered_map<Id, std::vector<Id>> Found; // neighbors from searches, by leaf
  std::size_t CountListed = 0;                   // leaves in all second rings
  IndexSet<Id> Listed;
  NeighborSpacing Spacing;
};

} // namespace isopoint
