// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_TriangleRanks_h
#define isopoint_TriangleRanks_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Base/Team.h"
#include "Isopoint/Extraction/CrossingEdge.h"
#include "Isopoint/Extraction/ExtractionContext.h"
#include "Isopoint/Extraction/NarrowBand.h"
#include "Isopoint/Extraction/NeighborhoodFits.h"
#include "Isopoint/Fit/LocalFit.h"
#include "Isopoint/Ranks/ByteBuffer.h"
#include "Isopoint/Ranks/NodeExchange.h"
#include "Isopoint/Ranks/RankSurface.h"
#include "Isopoint/Ranks/Rounds.h"
#include "Isopoint/Ranks/SentIsopoint.h"
#include "Isopoint/Ranks/TeamOfTree.h"
#include "Isopoint/Tetrahedra/BandTriangulation.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace isopoint
{

/// The ranks that share a tree, as the extraction of triangles sees them: what SingleRank is for
/// one. All functions but order() and isHome() are collective.
template <class TSample>
class TriangleRanks : public TeamOfTree<TSample>
{
public:
  TriangleRanks(SampleTree<TSample>& tree, NodeExchange<TSample>& exchange)
    : TeamOfTree<TSample>(exchange)
    , Tree(tree)
  {
  }

  std::vector<BinaryIndex> refine(NarrowBand<TSample>& band) { return band.refine(this->Exchange); }

  void gatherLeaves(std::vector<std::size_t>& leaves)
  {
    std::vector<SentEnd> own;
    this->together(
      [&]()
      {
        for (const std::size_t leaf : leaves)
        {
          const std::size_t begin = this->Tree.nodes[leaf].begin;
          own.push_back({ begin, positionOf(this->Tree.samples[begin]) });
        }
      });
    std::vector<std::vector<SentEnd>> all = this->Exchange.team().gather(own);
    std::vector<SentEnd> others;
    this->together(
      [&]()
      {
        all[static_cast<std::size_t>(this->Exchange.team().rank())].clear();
        for (const std::vector<SentEnd>& list : all)
        {
          others.insert(others.end(), list.begin(), list.end());
        }
        all.clear();
        leaves.reserve(leaves.size() + others.size());
      });
    std::mutex mutex;
    inRounds(
      Execution(), this->Exchange, others.size(), []() { return 0; },
      [&](int, std::size_t i)
      {
        const std::size_t leaf = leafAt(this->Tree, others[i].place, others[i].position);
        const std::lock_guard<std::mutex> lock(mutex);
        leaves.push_back(leaf);
      });
  }

  void order(std::vector<CrossingTetrahedron<typename TSample::Id>>& tetrahedra) const
  {
    using Tetrahedron = CrossingTetrahedron<typename TSample::Id>;
    const auto placesOfCorners = [this](const Tetrahedron& tetrahedron)
    {
      std::array<std::uint64_t, 4> places{};
      std::transform(tetrahedron.corners.begin(), tetrahedron.corners.end(), places.begin(),
        [this](typename TSample::Id leaf) { return this->Tree.nodes[leaf].begin; });
      std::sort(places.begin(), places.end());
      return places;
    };
    std::sort(tetrahedra.begin(), tetrahedra.end(),
      [&](const Tetrahedron& a, const Tetrahedron& b)
      { return placesOfCorners(a) < placesOfCorners(b); });
  }

  bool isHome(std::size_t leaf) const { return this->Tree.hasOwn(this->Tree.nodes[leaf]); }

  /// The numbers are those of things that all ranks have in one order; each finds others.
  void unite(std::vector<std::size_t>& found)
  {
    const std::vector<std::vector<std::size_t>> all = this->Exchange.team().gather(found);
    this->together(
      [&]()
      {
        found.clear();
        for (const std::vector<std::size_t>& list : all)
        {
          found.insert(found.end(), list.begin(), list.end());
        }
        std::sort(found.begin(), found.end());
      });
  }

  /// Each rank fits to the samples around the edges that are counted there.
  std::vector<LocalFit> fit(const Execution& execution, ExtractionContext<TSample>& context,
    const FitRequest& request, const std::vector<CrossingEdge<TSample>>& edges)
  {
    std::vector<LocalFit> fits;
    std::vector<TreePlace> places; // of those, in the order of the tree
    this->together(
      [&]()
      {
        fits.resize(edges.size());
        places = placesOf(execution, this->Tree, edges);
        const auto isOther = [this](const TreePlace& place)
        { return place.lower < this->Tree.ownBegin || place.lower >= this->Tree.ownEnd; };
        places.erase(std::remove_if(places.begin(), places.end(), isOther), places.end());
      });
    inRounds(
      execution, this->Exchange, places.size(),
      [&]() { return NeighborhoodFitter<TSample>(context, request); },
      [&](NeighborhoodFitter<TSample>& fitter, std::size_t i)
      { fits[places[i].edge] = fitter.fit(edges[places[i].edge]); });
    this->gatherFits(places, fits);
    return fits;
  }

private:
  void gatherFits(const std::vector<TreePlace>& places, std::vector<LocalFit>& fits)
  {
    ByteBuffer own;
    this->together(
      [&]()
      {
        for (const TreePlace& place : places)
        {
          append(own, static_cast<std::uint64_t>(place.edge));
          appendFit(own, fits[place.edge]);
        }
      });
    const std::vector<ByteBuffer> all = this->Exchange.team().gather(own);
    this->together(
      [&]()
      {
        for (const ByteBuffer& buffer : all)
        {
          ByteReader in(buffer);
          while (!in.isAtEnd())
          {
            const auto edge = static_cast<std::size_t>(in.read<std::uint64_t>());
            fits[edge] = readFit(in);
          }
        }
      });
  }

  SampleTree<TSample>& Tree;
};

} // namespace isopoint

#endif
