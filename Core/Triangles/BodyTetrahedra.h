// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Neighbors/GapSpread.h"
#include "Core/Neighbors/VoidCriterion.h"
#include "Core/Tetrahedra/CrossingTetrahedra.h"
#include "Core/Triangles/CapFacet.h"
#include "Core/Triangles/ConnectedVertices.h"
#include "Core/Triangles/TetrahedronEdges.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace isopoint
{

/// What the surface of a body is made of: docs/triangles.md, "Bodies".
struct BodyTetrahedra
{
  std::vector<LeafTetrahedron> crossing; // in the body
  std::vector<CapFacet> caps;
  std::size_t droppedCount = 0; // explored tetrahedra in gaps
};

/// The explored tetrahedra as the elements of GapSpread, connected by facets with a corner that is
/// not below. With a process group, functions that explore are collective.
template <class TSample, class TRanks>
class ExploredTetrahedra
{
public:
  ExploredTetrahedra(const Execution& execution, const SampleTree<TSample>& tree,
    CrossingTetrahedraFinder<TSample, TRanks>& finder)
    : Run(execution)
    , Tree(tree)
    , Finder(finder)
  {
  }

  /// Explores the crossing tetrahedra and those behind facets of the hull.
  void begin()
  {
    this->Finder.triangulation().beginExploring(this->Run, this->treeIndexOfLeaf());
    this->exploreTargets();
  }

  std::size_t size() const { return this->Count; }

  /// Explores the tetrahedra across the facets of some.
  void connect(const Execution& execution, const std::vector<std::size_t>& tetrahedra)
  {
    std::vector<ExploredFacet> facets;
    forEachInOrder(execution, tetrahedra.size(),
      [&](std::size_t i)
      {
        this->forEachFacet(tetrahedra[i],
          [&](const ExploredFacet& facet)
          {
            if (this->cells().across(facet) == PartialTriangulation::unexplored)
            {
              facets.push_back(facet);
            }
          });
      });
    if (!facets.empty())
    {
      this->Finder.triangulation().targetAcross(facets);
      this->exploreTargets();
      // The number of steps is unknown.
      constexpr double share = 0.1; // of the remaining progress
      this->Progress += share * (1.0 - this->Progress);
      execution.progress(this->Progress);
    }
  }

  bool isConnected(std::size_t tetrahedron) const
  {
    bool isConnected = true;
    this->forEachFacet(tetrahedron,
      [&](const ExploredFacet& facet) {
        isConnected =
          isConnected && this->cells().across(facet) != PartialTriangulation::unexplored;
      });
    return isConnected;
  }

  template <class Visit>
  void forEachNeighbor(std::size_t tetrahedron, const Visit& visit) const
  {
    this->forEachFacet(tetrahedron,
      [&](const ExploredFacet& facet)
      {
        const std::size_t other = this->cells().across(facet);
        if (other < this->Count)
        {
          visit(other);
        }
      });
  }

  /// Calls visit(facet) for the facets of a tetrahedron with a corner that is not below.
  template <class Visit>
  void forEachFacet(std::size_t tetrahedron, const Visit& visit) const
  {
    for (int corner = 0; corner < 4; ++corner)
    {
      const ExploredFacet facet{ tetrahedron, corner };
      if (!this->cells().cornersOf(facet).isAllBelow())
      {
        visit(facet);
      }
    }
  }

  const PartialTriangulation& cells() const { return this->Finder.triangulation(); }

private:
  void exploreTargets()
  {
    this->Finder.certifyTargets();
    this->Count = this->Finder.triangulation().exploreTargets(this->Run, this->treeIndexOfLeaf());
  }

  /// The order of new tetrahedra: the same for any number of threads and ranks.
  std::function<std::uint64_t(std::uint64_t)> treeIndexOfLeaf() const
  {
    return [this](std::uint64_t leaf) -> std::uint64_t { return this->Tree.nodes[leaf].begin; };
  }

  const Execution& Run;
  const SampleTree<TSample>& Tree;
  CrossingTetrahedraFinder<TSample, TRanks>& Finder;
  std::size_t Count = 0;
  double Progress = 0.5;
};

/// Finds the border of the body { x : f(x) >= isovalue } of the samples, closed where they end.
/// Explores the tetrahedralization only beside the hull and in gaps: docs/triangles.md. With a
/// process group, all functions are collective, and all ranks find the same.
/// @tparam TRanks SingleRank, or SharedRanks
template <class TSample, class TRanks>
class BodyFinder
{
public:
  BodyFinder(const Execution& execution, const SampleTree<TSample>& tree, TRanks& ranks,
    CrossingTetrahedraFinder<TSample, TRanks>& finder)
    : Run(execution)
    , Ranks(ranks)
    , Finder(finder)
    , Explored(execution, tree, finder)
    , Edges(execution, tree, ranks,
        [this](std::size_t i) { return this->cells().exploredTetrahedron(i).corners; })
  {
  }

  /// @param nodes see CrossingTetrahedraFinder
  /// @throws std::bad_alloc, Aborted, FailedElsewhere, TooManyTetrahedra, TreeTooLarge
  BodyTetrahedra find(const std::vector<BinaryIndex>& nodes, bool dropsGaps)
  {
    BodyTetrahedra body;
    this->Finder.findBody(nodes,
      [&]()
      {
        body = {}; // of a search that failed
        this->IsInGap.clear();
        this->Explored.begin();
        if (dropsGaps)
        {
          this->findGaps();
        }
        this->IsInGap.resize(this->Explored.size(), 0);
        this->collect(body);
      });
    return body;
  }

  /// See TetrahedronEdges.
  std::size_t askedCount() const { return this->Edges.askedCount(); }

private:
  using Spread = GapSpread<TRanks, ExploredTetrahedra<TSample, TRanks>>;

  const PartialTriangulation& cells() const { return this->Explored.cells(); }

  /// Explores weak tetrahedra outward from the isosurface and the hull. A connected set of them
  /// with a strong one is a gap.
  void findGaps()
  {
    Spread ofWeak(this->Run, this->Ranks, this->Explored);
    ofWeak.spread(iota(this->Explored.size()), [this](const std::vector<std::size_t>& some)
      { return this->Edges.rejectedAmong(weakVoidCriterion(), some); });
    const std::vector<char> areWeak = ofWeak.takeMarks();
    Spread ofStrong(this->Run, this->Ranks, this->Explored);
    ofStrong.spread(this->strongAmong(areWeak),
      [&](const std::vector<std::size_t>& some)
      {
        return chosenOf(this->Run, some,
          itemsThat(this->Run, some.size(), [&](std::size_t i) { return areWeak[some[i]] != 0; }));
      });
    ofStrong.dropFragments();
    this->IsInGap = ofStrong.takeMarks();
  }

  /// Of each connected set of weak tetrahedra that has strong ones, some of these. In clouds on
  /// curves nearly all are in one set: few are asked.
  std::vector<std::size_t> strongAmong(const std::vector<char>& areWeak)
  {
    std::vector<std::size_t> open = markedOf(this->Run, areWeak);
    ConnectedVertices sets(this->Run, areWeak.size());
    forEachIndex(this->Run, open.size(),
      [&](std::size_t i)
      {
        this->Explored.forEachNeighbor(open[i],
          [&](std::size_t other)
          {
            if (areWeak[other])
            {
              sets.unite(open[i], other);
            }
          });
      });
    std::vector<std::size_t> seeds;
    std::vector<char> areSeeded(areWeak.size(), 0); // by root
    constexpr std::size_t firstCount = 1024;        // of a set
    for (std::size_t most = firstCount; !open.empty(); most *= 4)
    {
      std::vector<std::size_t> counts(areWeak.size(), 0); // by root
      std::vector<std::size_t> asked;
      std::vector<std::size_t> others;
      forEachInOrder(this->Run, open.size(),
        [&](std::size_t i)
        {
          const std::size_t root = sets.rootOf(open[i]);
          if (!areSeeded[root])
          {
            (counts[root]++ < most ? asked : others).push_back(open[i]);
          }
        });
      for (const std::size_t strong : this->Edges.rejectedAmong(strongVoidCriterion(), asked))
      {
        areSeeded[sets.rootOf(strong)] = 1;
        seeds.push_back(strong);
      }
      open.swap(others);
    }
    return seeds;
  }

  void collect(BodyTetrahedra& body) const
  {
    body.droppedCount =
      static_cast<std::size_t>(std::count(this->IsInGap.begin(), this->IsInGap.end(), char{ 1 }));
    std::vector<ExploredFacet> facets;
    forEachInOrder(this->Run, this->IsInGap.size(),
      [&](std::size_t tetrahedron)
      {
        if (this->IsInGap[tetrahedron])
        {
          return;
        }
        const LeafTetrahedron found = this->cells().exploredTetrahedron(tetrahedron);
        if (found.belowCount > 0 && found.belowCount < 4)
        {
          body.crossing.push_back(found);
        }
        this->Explored.forEachFacet(tetrahedron,
          [&](const ExploredFacet& facet)
          {
            const std::size_t other = this->cells().across(facet);
            if (other == PartialTriangulation::outside ||
                (other != PartialTriangulation::unexplored && this->IsInGap[other]))
            {
              facets.push_back(facet);
            }
          });
      });
    body.caps = this->capsAt(facets);
  }

  /// @param facets ordered
  std::vector<CapFacet> capsAt(const std::vector<ExploredFacet>& facets) const
  {
    const auto isBefore = [](const ExploredFacet& a, const ExploredFacet& b) {
      return a.tetrahedron != b.tetrahedron ? a.tetrahedron < b.tetrahedron : a.corner < b.corner;
    };
    return tabulated<CapFacet>(this->Run, facets.size(),
      [&](std::size_t i)
      {
        CapFacet cap{ this->cells().cornersOf(facets[i]), {} };
        for (std::size_t side = 0; side < 3; ++side)
        {
          if (!cap.areBelow[side] || !cap.areBelow[(side + 1) % 3])
          {
            const ExploredFacet end = this->cells().nextBorderFacet(facets[i], side, this->IsInGap);
            cap.partners[side] = static_cast<std::size_t>(
              std::lower_bound(facets.begin(), facets.end(), end, isBefore) - facets.begin());
          }
        }
        return cap;
      });
  }

  const Execution& Run;
  TRanks& Ranks;
  CrossingTetrahedraFinder<TSample, TRanks>& Finder;
  ExploredTetrahedra<TSample, TRanks> Explored;
  TetrahedronEdges<TSample, TRanks> Edges;
  std::vector<char> IsInGap; // by explored tetrahedron
};

} // namespace isopoint
