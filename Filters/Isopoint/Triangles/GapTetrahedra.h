// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_GapTetrahedra_h
#define isopoint_GapTetrahedra_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Base/Offset.h"
#include "Isopoint/Base/SortUnique.h"
#include "Isopoint/Neighbors/GapCriterion.h"
#include "Isopoint/Neighbors/GapSpread.h"
#include "Isopoint/Tetrahedra/BandTriangulation.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace isopoint
{

/// Crossing tetrahedra as parts of a surface for GapSpread: those with a crossing facet in common
/// are connected.
template <class TSample>
class TetrahedronParts
{
public:
  using Tetrahedron = CrossingTetrahedron<typename TSample::Id>;

  TetrahedronParts(const SampleTree<TSample>& tree, const std::vector<Tetrahedron>& tetrahedra)
    : Tree(tree)
    , Tetrahedra(tetrahedra)
  {
  }

  std::size_t size() const { return this->Tetrahedra.size(); }

  /// On the rank of the corner that comes first in the order of the tree.
  bool isCounted(std::size_t tetrahedron) const
  {
    const auto& corners = this->Tetrahedra[tetrahedron].corners;
    const auto first = *std::min_element(corners.begin(), corners.end(),
      [this](auto a, auto b) { return this->Tree.nodes[a].begin < this->Tree.nodes[b].begin; });
    return this->Tree.isOwn(this->Tree.nodes[first].begin);
  }

  template <class TRanks>
  void unite(TRanks& ranks, std::vector<std::size_t>& found) const
  {
    ranks.unite(found);
  }

  template <class Test>
  bool anyEdge(std::size_t tetrahedron, const Test& test) const
  {
    const auto& corners = this->Tetrahedra[tetrahedron].corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      for (std::size_t j = i + 1; j < corners.size(); ++j)
      {
        if (test(static_cast<std::size_t>(corners[i]), static_cast<std::size_t>(corners[j])))
        {
          return true;
        }
      }
    }
    return false;
  }

  /// O(1), except for the first time: O(n log n). @throws std::bad_alloc
  template <class Visit>
  void forEachNeighbor(std::size_t tetrahedron, const Visit& visit)
  {
    if (this->Neighbors.empty())
    {
      this->listNeighbors();
    }
    for (const std::size_t neighbor : this->Neighbors[tetrahedron])
    {
      if (neighbor != none)
      {
        visit(neighbor);
      }
    }
  }

private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  struct Facet
  {
    std::array<typename TSample::Id, 3> corners; // ascending
    std::size_t tetrahedron;
  };

  void listNeighbors()
  {
    this->Neighbors.resize(this->Tetrahedra.size(), { none, none, none, none });
    std::vector<Facet> facets;
    facets.reserve(4 * this->Tetrahedra.size());
    for (std::size_t i = 0; i < this->Tetrahedra.size(); ++i)
    {
      addFacets(this->Tetrahedra[i], i, facets);
    }
    std::sort(facets.begin(), facets.end(),
      [](const Facet& a, const Facet& b) { return a.corners < b.corners; });
    for (std::size_t i = 1; i < facets.size(); ++i)
    {
      if (facets[i - 1].corners == facets[i].corners)
      {
        this->addNeighbor(facets[i - 1].tetrahedron, facets[i].tetrahedron);
        this->addNeighbor(facets[i].tetrahedron, facets[i - 1].tetrahedron);
      }
    }
  }

  static void addFacets(
    const Tetrahedron& tetrahedron, std::size_t number, std::vector<Facet>& facets)
  {
    for (std::size_t opposite = 0; opposite < 4; ++opposite)
    {
      const bool isBelow = opposite < tetrahedron.belowCount;
      if (tetrahedron.belowCount == (isBelow ? 1 : 3))
      {
        continue; // all corners of the facet are on one side
      }
      Facet facet{ {}, number };
      std::size_t place = 0;
      for (std::size_t corner = 0; corner < 4; ++corner)
      {
        if (corner != opposite)
        {
          facet.corners[place++] = tetrahedron.corners[corner];
        }
      }
      std::sort(facet.corners.begin(), facet.corners.end());
      facets.push_back(facet);
    }
  }

  void addNeighbor(std::size_t tetrahedron, std::size_t neighbor)
  {
    std::array<std::size_t, 4>& all = this->Neighbors[tetrahedron];
    *std::find(all.begin(), all.end(), none) = neighbor;
  }

  const SampleTree<TSample>& Tree;
  const std::vector<Tetrahedron>& Tetrahedra;
  /// Of each: as many as there are, then none. Listed once there is a gap.
  std::vector<std::array<std::size_t, 4>> Neighbors;
};

/// Finds the crossing tetrahedra that lie in gaps of the cloud or outside of it: docs/triangles.md.
/// Where several ranks share the tree, all functions are collective.
/// @tparam TRanks SingleRank, or SharedRanks
template <class TSample, class TRanks>
class GapTetrahedraFinder
{
public:
  using Id = typename TSample::Id;
  using Tetrahedron = CrossingTetrahedron<Id>;

  /// @param tetrahedra all that are crossing, in the same order on all ranks
  GapTetrahedraFinder(const Execution& execution, const SampleTree<TSample>& tree, TRanks& ranks,
    const std::vector<Tetrahedron>& tetrahedra)
    : Run(execution)
    , Tree(tree)
    , Ranks(ranks)
    , Tetrahedra(tetrahedra)
    , Parts(tree, tetrahedra)
    , Spread(execution, tree, ranks, this->Parts)
  {
  }

  /// @returns for each tetrahedron whether it lies in a gap
  /// @throws std::bad_alloc, Aborted, FailedElsewhere
  std::vector<char> find()
  {
    this->Spread.spread(this->seeds());
    return this->withFragments(this->Spread.isInGap());
  }

private:
  static constexpr std::size_t smallestPiece = 8; // of tetrahedra beside a gap

  /// The tetrahedra that gaps spread from: those over the strong criterion, and those at the hull.
  std::vector<std::size_t> seeds()
  {
    std::vector<std::size_t> candidates;
    const std::vector<char> isCrowded = this->crowdedLeaves();
    for (std::size_t i = 0; i < this->Tetrahedra.size(); ++i)
    {
      const auto& corners = this->Tetrahedra[i].corners;
      if (std::count_if(corners.begin(), corners.end(),
            [&](Id leaf) { return isCrowded[static_cast<std::size_t>(leaf)] != 0; }) >= 2)
      {
        candidates.push_back(i);
      }
    }
    std::vector<std::size_t> seeds = this->Spread.over(GapCriterion::strong(), candidates);
    for (std::size_t i = 0; i < this->Tetrahedra.size(); ++i)
    {
      if (this->Tetrahedra[i].isAtHull)
      {
        seeds.push_back(i);
      }
    }
    keepUnique(seeds);
    return seeds;
  }

  /// Marks, by node, the leaves at which the longest edge of a tetrahedron may be over the strong
  /// criterion. In clouds without gaps these are few, so that next to no edge is looked at.
  std::vector<char> crowdedLeaves()
  {
    const std::vector<double> longest = this->longestEdges(); // at each leaf, by node
    std::vector<std::size_t> corners;                         // in the same order on all ranks
    for (std::size_t leaf = 0; leaf < longest.size(); ++leaf)
    {
      if (longest[leaf] > 0.0)
      {
        corners.push_back(leaf);
      }
    }
    std::sort(corners.begin(), corners.end(),
      [this](std::size_t a, std::size_t b)
      { return this->Tree.nodes[a].begin < this->Tree.nodes[b].begin; });
    std::vector<char> marks(corners.size(), 0);
    constexpr std::size_t grain = 256;
    this->Ranks.forEach(
      this->Run, { corners.size(), 8 * grain, grain }, []() { return 0; },
      [&](int, std::size_t i)
      {
        const std::size_t leaf = corners[i];
        marks[i] = this->Tree.hasOwn(this->Tree.nodes[leaf]) &&
                       GapCriterion::strong().mayDrop(this->Tree, pathToLeaf(this->Tree, leaf),
                         this->Tree.sampleOf(leaf), longest[leaf])
                     ? 1
                     : 0;
      });
    std::vector<std::size_t> crowded = markedOf(marks);
    this->Ranks.unite(crowded);
    std::vector<char> marksOfNodes(longest.size(), 0);
    for (const std::size_t i : crowded)
    {
      marksOfNodes[corners[i]] = 1;
    }
    return marksOfNodes;
  }

  std::vector<double> longestEdges() const
  {
    std::vector<double> longest(this->Tree.nodes.size(), 0.0);
    for (const Tetrahedron& tetrahedron : this->Tetrahedra)
    {
      for (std::size_t i = 0; i < 4; ++i)
      {
        const auto a = static_cast<std::size_t>(tetrahedron.corners[i]);
        for (std::size_t j = i + 1; j < 4; ++j)
        {
          const auto b = static_cast<std::size_t>(tetrahedron.corners[j]);
          const double length =
            offsetBetween(positionOf(this->Tree.sampleOf(a)), positionOf(this->Tree.sampleOf(b)))
              .length;
          longest[a] = std::max(longest[a], length);
          longest[b] = std::max(longest[b], length);
        }
      }
    }
    return longest;
  }

  /// What is in gaps, with the small pieces that border on them.
  std::vector<char> withFragments(std::vector<char> isInGap)
  {
    std::vector<std::size_t> fragments;
    for (std::size_t i = 0; i < this->Tetrahedra.size(); ++i)
    {
      // All that borders on a gap was reached.
      if (this->Spread.isReached()[i] && !isInGap[i] && this->isBesideGap(i))
      {
        const std::vector<std::size_t> piece = this->pieceAround(i, isInGap);
        if (piece.size() < smallestPiece)
        {
          fragments.insert(fragments.end(), piece.begin(), piece.end());
        }
      }
    }
    for (const std::size_t i : fragments)
    {
      isInGap[i] = 1;
    }
    return isInGap;
  }

  bool isBesideGap(std::size_t tetrahedron)
  {
    bool isBeside = false;
    this->Parts.forEachNeighbor(tetrahedron,
      [&](std::size_t neighbor) { isBeside = isBeside || this->Spread.isInGap()[neighbor] != 0; });
    return isBeside;
  }

  /// The tetrahedra that are connected with one across crossing facets, out of gaps; of many,
  /// `smallestPiece`.
  std::vector<std::size_t> pieceAround(std::size_t tetrahedron, const std::vector<char>& isInGap)
  {
    std::vector<std::size_t> piece{ tetrahedron };
    for (std::size_t i = 0; i < piece.size() && piece.size() < smallestPiece; ++i)
    {
      this->Parts.forEachNeighbor(piece[i],
        [&](std::size_t neighbor)
        {
          if (!isInGap[neighbor] && piece.size() < smallestPiece &&
              std::find(piece.begin(), piece.end(), neighbor) == piece.end())
          {
            piece.push_back(neighbor);
          }
        });
    }
    return piece;
  }

  const Execution& Run;
  const SampleTree<TSample>& Tree;
  TRanks& Ranks;
  const std::vector<Tetrahedron>& Tetrahedra;
  TetrahedronParts<TSample> Parts;
  GapSpread<TSample, TRanks, TetrahedronParts<TSample>> Spread;
};

} // namespace isopoint

#endif
