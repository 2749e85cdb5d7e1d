// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Neighbors/GapSpread.h"
#include "Core/Neighbors/VoidCriterion.h"
#include "Core/Tetrahedra/CrossingTetrahedra.h"
#include "Core/Tree/SampleBounds.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <unordered_map>
#include <vector>

namespace isopoint
{

/// A facet at the border of a body: between a tetrahedron of the body and a gap or the outside. At
/// least one corner is not below the isovalue.
template <class TId>
struct CapFacet
{
  std::array<TId, 3> corners; // leaves, counterclockwise seen from outside the body
  std::array<bool, 3> areBelow;

  /// Per side, from a corner to the next: the cap facet that bounds the same wedge of the body.
  /// Undefined for a side with both ends below.
  std::array<std::size_t, 3> partners;
};

/// What the surface of a body is made of: docs/triangles.md, "Bodies".
template <class TId>
struct BodyTetrahedra
{
  std::vector<CrossingTetrahedron<TId>> crossing; // in the body
  std::vector<CapFacet<TId>> caps;
  std::size_t droppedCount = 0; // explored tetrahedra in gaps
};

/// Finds the border of the body { x : f(x) >= isovalue } of the samples, closed where they end.
/// Explores the tetrahedralization only beside the hull and in gaps: docs/triangles.md. With a
/// process group, all functions are collective, and all ranks find the same.
/// @tparam TRanks SingleRank, or SharedRanks
template <class TSample, class TRanks>
class BodyFinder
{
public:
  using Id = typename TSample::Id;

  BodyFinder(const Execution& execution, const SampleTree<TSample>& tree, TRanks& ranks,
    CrossingTetrahedraFinder<TSample, TRanks>& finder)
    : Exec(execution)
    , Tree(tree)
    , Bounds(tree)
    , Ranks(ranks)
    , Finder(finder)
  {
  }

  /// @param nodes see CrossingTetrahedraFinder
  /// @throws std::bad_alloc, Aborted, FailedElsewhere, TreeTooLarge
  BodyTetrahedra<Id> find(const std::vector<BinaryIndex>& nodes, bool dropsGaps)
  {
    BodyTetrahedra<Id> body;
    this->Finder.findBody(nodes,
      [&]()
      {
        this->begin();
        if (dropsGaps)
        {
          this->findGaps();
          this->dropFragments();
        }
        this->collect(body);
      });
    return body;
  }

private:
  const PartialTriangulation& cells() const { return this->Finder.triangulation(); }

  /// Explores the crossing tetrahedra and those behind facets of the hull.
  void begin()
  {
    this->resize(this->Finder.triangulation().beginExploring(this->Exec, this->placeOfLeaf()));
    this->Finder.certifyAims();
    this->resize(this->Finder.triangulation().exploreAims(this->Exec, this->placeOfLeaf()));
  }

  /// The order of new tetrahedra: the same for any number of threads and ranks.
  std::function<std::uint64_t(std::uint64_t)> placeOfLeaf() const
  {
    return [this](std::uint64_t leaf) { return this->placeOf(leaf); };
  }

  void resize(std::size_t count)
  {
    this->IsInGap.resize(count, 0);
    this->IsReached.resize(count, 0);
  }

  /// Explores the tetrahedra across facets.
  void exploreAcross(const std::vector<ExploredFacet>& facets)
  {
    this->Finder.triangulation().aimAcross(facets);
    this->Finder.certifyAims();
    this->resize(this->Finder.triangulation().exploreAims(this->Exec, this->placeOfLeaf()));
    // The number of steps is unknown.
    constexpr double share = 0.1; // of the remaining progress
    this->Progress += share * (1.0 - this->Progress);
    this->Exec.progress(this->Progress);
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

  /// An edge of tetrahedra; edges are ordered by the places of their ends in the tree.
  struct Edge
  {
    std::array<std::uint64_t, 2> places; // ascending
    std::array<std::uint64_t, 2> leaves; // in the same order

    bool operator<(const Edge& other) const { return this->places < other.places; }
    bool operator==(const Edge& other) const { return this->places == other.places; }
  };

  /// Calls visit(edge) for the edges of a tetrahedron.
  template <class Visit>
  void forEachEdge(std::size_t tetrahedron, const Visit& visit) const
  {
    const auto corners = this->cells().exploredTetrahedron(tetrahedron).corners;
    for (std::size_t i = 0; i < 4; ++i)
    {
      for (std::size_t j = i + 1; j < 4; ++j)
      {
        const std::uint64_t a = this->placeOf(corners[i]);
        const std::uint64_t b = this->placeOf(corners[j]);
        visit(a < b ? Edge{ { a, b }, { corners[i], corners[j] } }
                    : Edge{ { b, a }, { corners[j], corners[i] } });
      }
    }
  }

  std::uint64_t placeOf(std::uint64_t leaf) const
  {
    return this->Tree.nodes[static_cast<std::size_t>(leaf)].begin;
  }

  /// The tetrahedra with an edge that a criterion rejects.
  template <class TCriterion>
  std::vector<std::size_t> rejectedAmong(
    const TCriterion& criterion, const std::vector<std::size_t>& tetrahedra)
  {
    const std::vector<Edge> rejected = this->rejectedEdges(criterion, tetrahedra);
    std::vector<char> marks(tetrahedra.size(), 0);
    forEachIndex(this->Exec, tetrahedra.size(),
      [&](std::size_t i)
      {
        this->forEachEdge(tetrahedra[i],
          [&](const Edge& edge)
          {
            const bool isRejected = std::binary_search(rejected.begin(), rejected.end(), edge);
            marks[i] = marks[i] || isRejected ? 1 : 0;
          });
      });
    std::vector<std::size_t> found = markedOf(this->Exec, marks);
    std::transform(
      found.begin(), found.end(), found.begin(), [&](std::size_t i) { return tetrahedra[i]; });
    return found;
  }

  /// The edges of tetrahedra that a criterion rejects, ordered. Each is in several tetrahedra.
  template <class TCriterion>
  std::vector<Edge> rejectedEdges(
    const TCriterion& criterion, const std::vector<std::size_t>& tetrahedra)
  {
    std::vector<Edge> edges(6 * tetrahedra.size());
    forEachIndex(this->Exec, tetrahedra.size(),
      [&](std::size_t i)
      {
        std::size_t place = 6 * i;
        this->forEachEdge(tetrahedra[i], [&](const Edge& edge) { edges[place++] = edge; });
      });
    edges = sortedUnique(this->Exec, edges, this->Tree.samples.size(),
      [](const Edge& edge) { return edge.places[0]; });
    this->findSpacings(edges);
    std::vector<char> marks(edges.size(), 0);
    constexpr std::size_t grain = 256;
    this->Ranks.forEach(
      this->Exec, { edges.size(), 8 * grain, grain }, []() { return 0; },
      [&](int, std::size_t i)
      {
        const auto& [places, leaves] = edges[i];
        marks[i] = this->isOwn(edges[i]) &&
                       criterion.drops(this->Tree, this->Bounds, this->sampleAt(leaves[0]),
                         this->sampleAt(leaves[1]),
                         std::max(this->SpacingAt.at(places[0]), this->SpacingAt.at(places[1])))
                     ? 1
                     : 0;
      });
    std::vector<std::size_t> found = markedOf(this->Exec, marks);
    this->Ranks.unite(found);
    return chosenOf(this->Exec, edges, found);
  }

  bool isOwn(const Edge& edge) const
  {
    return this->Tree.isOwn(static_cast<std::size_t>(edge.places[0]));
  }

  /// Finds the spacings at the ends of this rank's edges, each once.
  void findSpacings(const std::vector<Edge>& edges)
  {
    std::vector<std::uint64_t> leaves;
    forEachInOrder(this->Exec, edges.size(),
      [&](std::size_t i)
      {
        for (std::size_t end = 0; end < 2; ++end)
        {
          if (this->isOwn(edges[i]) && this->SpacingAt.emplace(edges[i].places[end], 0.0).second)
          {
            leaves.push_back(edges[i].leaves[end]);
          }
        }
      });
    constexpr std::size_t grain = 256;
    this->Ranks.forEach(
      this->Exec, { leaves.size(), 8 * grain, grain }, []() { return 0; },
      [&](int, std::size_t i)
      {
        this->SpacingAt.at(this->placeOf(leaves[i])) =
          SpacingSearch<TSample>(this->Tree, this->sampleAt(leaves[i])).find();
      });
  }

  const TSample& sampleAt(std::uint64_t leaf) const
  {
    return this->Tree.sampleOf(static_cast<std::size_t>(leaf));
  }

  /// Explores the weak tetrahedra connected with the isosurface or the hull; those connected with a
  /// strong one among them are in gaps.
  void findGaps()
  {
    std::vector<std::size_t> weak;
    std::vector<std::size_t> front(this->IsReached.size());
    std::iota(front.begin(), front.end(), std::size_t{ 0 });
    std::fill(this->IsReached.begin(), this->IsReached.end(), 1);
    std::vector<char> isWeak;
    while (this->Ranks.isAny(!front.empty()))
    {
      const std::vector<std::size_t> found = this->rejectedAmong(weakVoids(), front);
      weak.insert(weak.end(), found.begin(), found.end());
      isWeak.resize(this->IsReached.size(), 0);
      std::vector<ExploredFacet> facets;
      for (const std::size_t tetrahedron : found)
      {
        isWeak[tetrahedron] = 1;
        this->forEachFacet(
          tetrahedron, [&](const ExploredFacet& facet) { facets.push_back(facet); });
      }
      this->exploreAcross(facets);
      front.clear();
      for (const ExploredFacet& facet : facets)
      {
        const std::size_t other = this->cells().across(facet);
        if (other < this->IsReached.size() && !this->IsReached[other])
        {
          this->IsReached[other] = 1;
          front.push_back(other);
        }
      }
      std::sort(front.begin(), front.end());
    }
    isWeak.resize(this->IsReached.size(), 0);
    this->spread(this->rejectedAmong(strongVoids(), weak), isWeak);
  }

  /// Marks seeds and all weak tetrahedra connected with them.
  void spread(std::vector<std::size_t> front, const std::vector<char>& isWeak)
  {
    for (const std::size_t seed : front)
    {
      this->IsInGap[seed] = 1;
    }
    while (!front.empty())
    {
      throwIfAborted(this->Exec);
      std::vector<std::size_t> next;
      for (const std::size_t tetrahedron : front)
      {
        this->forEachFacet(tetrahedron,
          [&](const ExploredFacet& facet)
          {
            const std::size_t other = this->cells().across(facet);
            if (other < isWeak.size() && isWeak[other] && !this->IsInGap[other])
            {
              this->IsInGap[other] = 1;
              next.push_back(other);
            }
          });
      }
      front.swap(next);
    }
  }

  /// Adds the small pieces of the body beside gaps to these.
  void dropFragments()
  {
    std::vector<std::size_t> fragments;
    std::vector<std::size_t> candidates = this->besideGaps();
    while (!candidates.empty())
    {
      throwIfAborted(this->Exec);
      std::vector<std::size_t> open; // whose pieces are not explored
      std::vector<ExploredFacet> facets;
      for (const std::size_t tetrahedron : candidates)
      {
        std::vector<ExploredFacet> unexplored;
        const std::vector<std::size_t> piece = this->pieceAround(tetrahedron, unexplored);
        if (piece.size() < smallestPiece && unexplored.empty())
        {
          fragments.insert(fragments.end(), piece.begin(), piece.end());
        }
        else if (piece.size() < smallestPiece)
        {
          open.push_back(tetrahedron);
          facets.insert(facets.end(), unexplored.begin(), unexplored.end());
        }
      }
      if (!facets.empty())
      {
        this->exploreAcross(facets);
      }
      candidates.swap(open);
    }
    for (const std::size_t fragment : fragments)
    {
      this->IsInGap[fragment] = 1;
    }
  }

  /// The tetrahedra of the body that share a facet with a gap.
  std::vector<std::size_t> besideGaps() const
  {
    return itemsThat(this->Exec, this->IsInGap.size(),
      [this](std::size_t tetrahedron)
      {
        bool isBeside = false;
        if (!this->IsInGap[tetrahedron])
        {
          this->forEachFacet(tetrahedron,
            [&](const ExploredFacet& facet)
            {
              const std::size_t other = this->cells().across(facet);
              isBeside = isBeside || (other < this->IsInGap.size() && this->IsInGap[other] != 0);
            });
        }
        return isBeside;
      });
  }

  /// The tetrahedra of the body connected to one, at most `smallestPiece`.
  /// @param unexplored receives facets to tetrahedra that have to be explored if these are fewer
  std::vector<std::size_t> pieceAround(
    std::size_t tetrahedron, std::vector<ExploredFacet>& unexplored) const
  {
    std::vector<std::size_t> piece{ tetrahedron };
    for (std::size_t i = 0; i < piece.size() && piece.size() < smallestPiece; ++i)
    {
      this->forEachFacet(piece[i],
        [&](const ExploredFacet& facet)
        {
          const std::size_t other = this->cells().across(facet);
          if (other == PartialTriangulation::unexplored)
          {
            unexplored.push_back(facet);
          }
          else if (other != PartialTriangulation::outside && !this->IsInGap[other] &&
                   std::find(piece.begin(), piece.end(), other) == piece.end())
          {
            piece.push_back(other);
          }
        });
    }
    return piece;
  }

  void collect(BodyTetrahedra<Id>& body) const
  {
    body.droppedCount =
      static_cast<std::size_t>(std::count(this->IsInGap.begin(), this->IsInGap.end(), char{ 1 }));
    std::vector<ExploredFacet> facets;
    forEachInOrder(this->Exec, this->IsInGap.size(),
      [&](std::size_t tetrahedron)
      {
        if (this->IsInGap[tetrahedron])
        {
          return;
        }
        const CrossingTetrahedron<std::uint64_t> found =
          this->cells().exploredTetrahedron(tetrahedron);
        if (found.belowCount > 0 && found.belowCount < 4)
        {
          CrossingTetrahedron<Id> crossing{ {}, found.belowCount, found.isAtHull };
          std::transform(found.corners.begin(), found.corners.end(), crossing.corners.begin(),
            [](std::uint64_t leaf) { return static_cast<Id>(leaf); });
          body.crossing.push_back(crossing);
        }
        this->forEachFacet(tetrahedron,
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
    this->addCaps(facets, body.caps);
  }

  /// @param facets ordered
  void addCaps(const std::vector<ExploredFacet>& facets, std::vector<CapFacet<Id>>& caps) const
  {
    const auto isBefore = [](const ExploredFacet& a, const ExploredFacet& b) {
      return a.tetrahedron != b.tetrahedron ? a.tetrahedron < b.tetrahedron : a.corner < b.corner;
    };
    caps.resize(facets.size());
    forEachIndex(this->Exec, facets.size(),
      [&](std::size_t i)
      {
        const FacetCorners corners = this->cells().cornersOf(facets[i]);
        caps[i].areBelow = corners.areBelow;
        for (std::size_t side = 0; side < 3; ++side)
        {
          caps[i].corners[side] = static_cast<Id>(corners.leaves[side]);
          if (!corners.areBelow[side] || !corners.areBelow[(side + 1) % 3])
          {
            const ExploredFacet end = this->cells().wedgeEnd(facets[i], side, this->IsInGap);
            caps[i].partners[side] = static_cast<std::size_t>(
              std::lower_bound(facets.begin(), facets.end(), end, isBefore) - facets.begin());
          }
        }
      });
  }

  const Execution& Exec;
  const SampleTree<TSample>& Tree;
  SampleBounds<TSample> Bounds;
  TRanks& Ranks;
  CrossingTetrahedraFinder<TSample, TRanks>& Finder;
  std::unordered_map<std::uint64_t, double> SpacingAt; // by place of the sample
  double Progress = 0.5;
  // By explored tetrahedron:
  std::vector<char> IsInGap;
  std::vector<char> IsReached;
};

} // namespace isopoint
