// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_GapTetrahedra_h
#define isopoint_GapTetrahedra_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Base/Offset.h"
#include "Isopoint/Neighbors/GapCriterion.h"
#include "Isopoint/Tetrahedra/BandTriangulation.h"
#include "Isopoint/Triangles/CrossingFacets.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace isopoint
{

/// Finds the crossing tetrahedra that lie in gaps of the cloud or outside of it: docs/triangles.md.
/// Where several ranks share the tree, all functions are collective.
/// @tparam TRanks SingleRank, or TriangleRanks
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
  {
  }

  /// @returns for each tetrahedron whether it lies in a gap
  /// @throws std::bad_alloc, Aborted, FailedElsewhere
  std::vector<char> find()
  {
    std::vector<std::size_t> front = this->seeds(); // the same on all ranks
    this->Ranks.together(
      [&]()
      {
        this->IsMet.resize(this->Tetrahedra.size(), 0);
        this->IsInGap.resize(this->Tetrahedra.size(), 0);
        for (const std::size_t i : front)
        {
          this->IsMet[i] = 1;
        }
      });
    while (!front.empty())
    {
      const std::vector<char> areOver = this->areOver(GapCriterion::weak(), front);
      this->Ranks.together([&]() { front = this->next(front, areOver); });
    }
    this->Ranks.together([&]() { this->dropFragments(); });
    return std::move(this->IsInGap);
  }

private:
  static constexpr std::size_t smallestPiece = 8; // of tetrahedra beside a gap

  /// The tetrahedra that gaps spread from: those over the strong criterion, and those at the hull.
  std::vector<std::size_t> seeds()
  {
    std::vector<std::size_t> candidates;
    const std::vector<char> isCrowded = this->crowdedLeaves();
    this->Ranks.together(
      [&]()
      {
        for (std::size_t i = 0; i < this->Tetrahedra.size(); ++i)
        {
          const auto& corners = this->Tetrahedra[i].corners;
          if (std::count_if(corners.begin(), corners.end(),
                [&](Id leaf) { return isCrowded[static_cast<std::size_t>(leaf)] != 0; }) >= 2)
          {
            candidates.push_back(i);
          }
        }
      });
    const std::vector<char> areOver = this->areOver(GapCriterion::strong(), candidates);
    std::vector<std::size_t> seeds;
    this->Ranks.together(
      [&]()
      {
        for (std::size_t i = 0; i < candidates.size(); ++i)
        {
          if (areOver[i] && !this->Tetrahedra[candidates[i]].isAtHull)
          {
            seeds.push_back(candidates[i]);
          }
        }
        for (std::size_t i = 0; i < this->Tetrahedra.size(); ++i)
        {
          if (this->Tetrahedra[i].isAtHull)
          {
            seeds.push_back(i);
          }
        }
      });
    return seeds;
  }

  /// Marks, by node, the leaves at which the longest edge of a tetrahedron may be over the strong
  /// criterion. In clouds without gaps these are few, so that next to no edge is looked at.
  std::vector<char> crowdedLeaves()
  {
    std::vector<double> longest;      // edge at each leaf, by node
    std::vector<std::size_t> corners; // in the same order on all ranks
    std::vector<char> marks;          // of these
    std::vector<char> marksOfNodes;
    this->Ranks.together(
      [&]()
      {
        longest = this->longestEdges();
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
        marks.resize(corners.size(), 0);
      });
    this->Ranks.forEach(
      this->Run, corners.size(), []() { return 0; },
      [&](int, std::size_t i)
      {
        const std::size_t leaf = corners[i];
        marks[i] = this->Ranks.isHome(leaf) &&
                       GapCriterion::strong().mayDrop(this->Tree, pathToLeaf(this->Tree, leaf),
                         this->sampleOf(leaf), longest[leaf])
                     ? 1
                     : 0;
      });
    this->Ranks.unite(marks);
    this->Ranks.together(
      [&]()
      {
        marksOfNodes.resize(longest.size(), 0);
        for (std::size_t i = 0; i < corners.size(); ++i)
        {
          marksOfNodes[corners[i]] = marks[i];
        }
      });
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
            offsetBetween(positionOf(this->sampleOf(a)), positionOf(this->sampleOf(b))).length;
          longest[a] = std::max(longest[a], length);
          longest[b] = std::max(longest[b], length);
        }
      }
    }
    return longest;
  }

  /// Of some tetrahedra, whether an edge is dropped by a criterion.
  std::vector<char> areOver(
    const GapCriterion& criterion, const std::vector<std::size_t>& tetrahedra)
  {
    std::vector<char> marks;
    this->Ranks.together([&]() { marks.resize(tetrahedra.size(), 0); });
    this->Ranks.forEach(
      this->Run, tetrahedra.size(), []() { return 0; },
      [&](int, std::size_t i)
      {
        const Tetrahedron& tetrahedron = this->Tetrahedra[tetrahedra[i]];
        marks[i] =
          this->Ranks.isHome(this->firstLeafOf(tetrahedron)) && this->isOver(criterion, tetrahedron)
            ? 1
            : 0;
      });
    this->Ranks.unite(marks);
    return marks;
  }

  bool isOver(const GapCriterion& criterion, const Tetrahedron& tetrahedron) const
  {
    for (std::size_t i = 0; i < 4; ++i)
    {
      const auto leaf = static_cast<std::size_t>(tetrahedron.corners[i]);
      const Path path = pathToLeaf(this->Tree, leaf);
      for (std::size_t j = i + 1; j < 4; ++j)
      {
        if (criterion.drops(this->Tree, path, this->sampleOf(leaf),
              this->sampleOf(static_cast<std::size_t>(tetrahedron.corners[j]))))
        {
          return true;
        }
      }
    }
    return false;
  }

  /// Puts those of a front that are over the weak criterion into the gap.
  /// @returns their neighbors that were not met before
  std::vector<std::size_t> next(
    const std::vector<std::size_t>& front, const std::vector<char>& areOver)
  {
    throwIfAborted(this->Run);
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < front.size(); ++i)
    {
      if (!areOver[i])
      {
        continue;
      }
      this->IsInGap[front[i]] = 1;
      if (!this->Facets)
      {
        this->Facets.emplace(this->Tetrahedra);
      }
      this->Facets->forEachNeighbor(front[i],
        [&](std::size_t neighbor)
        {
          if (!this->IsMet[neighbor])
          {
            this->IsMet[neighbor] = 1;
            found.push_back(neighbor);
          }
        });
    }
    std::sort(found.begin(), found.end()); // neighbors stand in another order on each rank
    return found;
  }

  /// Puts small pieces that border on a gap into it.
  void dropFragments()
  {
    if (!this->Facets)
    {
      return;
    }
    std::vector<std::size_t> fragments;
    for (std::size_t i = 0; i < this->Tetrahedra.size(); ++i)
    {
      // All beside a gap were met.
      if (this->IsMet[i] && !this->IsInGap[i] && this->isBesideGap(i))
      {
        const std::vector<std::size_t> piece = this->pieceAround(i);
        if (piece.size() < smallestPiece)
        {
          fragments.insert(fragments.end(), piece.begin(), piece.end());
        }
      }
    }
    for (const std::size_t i : fragments)
    {
      this->IsInGap[i] = 1;
    }
  }

  bool isBesideGap(std::size_t tetrahedron) const
  {
    bool isBeside = false;
    this->Facets->forEachNeighbor(
      tetrahedron, [&](std::size_t neighbor) { isBeside = isBeside || this->IsInGap[neighbor]; });
    return isBeside;
  }

  /// The tetrahedra that hang together with one across crossing facets, out of gaps; of many,
  /// `smallestPiece`.
  std::vector<std::size_t> pieceAround(std::size_t tetrahedron) const
  {
    std::vector<std::size_t> piece{ tetrahedron };
    for (std::size_t i = 0; i < piece.size() && piece.size() < smallestPiece; ++i)
    {
      this->Facets->forEachNeighbor(piece[i],
        [&](std::size_t neighbor)
        {
          if (!this->IsInGap[neighbor] && piece.size() < smallestPiece &&
              std::find(piece.begin(), piece.end(), neighbor) == piece.end())
          {
            piece.push_back(neighbor);
          }
        });
    }
    return piece;
  }

  /// The corner that comes first in the order of the tree.
  std::size_t firstLeafOf(const Tetrahedron& tetrahedron) const
  {
    return static_cast<std::size_t>(
      *std::min_element(tetrahedron.corners.begin(), tetrahedron.corners.end(),
        [this](Id a, Id b) { return this->Tree.nodes[a].begin < this->Tree.nodes[b].begin; }));
  }

  const TSample& sampleOf(std::size_t leaf) const
  {
    return this->Tree.samples[this->Tree.nodes[leaf].begin];
  }

  const Execution& Run;
  const SampleTree<TSample>& Tree;
  TRanks& Ranks;
  const std::vector<Tetrahedron>& Tetrahedra;
  std::optional<CrossingFacets> Facets; // where there is a gap
  std::vector<char> IsMet;              // each tetrahedron: whether it was in a front
  std::vector<char> IsInGap;
};

} // namespace isopoint

#endif
