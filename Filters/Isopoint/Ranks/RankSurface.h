// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_RankSurface_h
#define isopoint_RankSurface_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Base/SortUnique.h"
#include "Isopoint/Extraction/CrossingEdge.h"
#include "Isopoint/Extraction/ExpectedWork.h"
#include "Isopoint/Extraction/ExtractIsosurface.h"
#include "Isopoint/Extraction/ExtractionContext.h"
#include "Isopoint/Extraction/GapEdges.h"
#include "Isopoint/Extraction/Isosurface.h"
#include "Isopoint/Extraction/IsosurfaceRequest.h"
#include "Isopoint/Extraction/NarrowBand.h"
#include "Isopoint/Extraction/NeighborhoodFits.h"
#include "Isopoint/Fit/LocalFit.h"
#include "Isopoint/Neighbors/NeighborhoodCache.h"
#include "Isopoint/Ranks/EdgeTeam.h"
#include "Isopoint/Ranks/NodeExchange.h"
#include "Isopoint/Ranks/Rounds.h"
#include "Isopoint/Tree/CoincidentSamples.h"
#include "Isopoint/Tree/Path.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace isopoint
{

/// An edge as ranks send it to each other: leaves are named by the places of their first samples in
/// the order of the tree, which are the same on all ranks.
struct SentEdge
{
  std::uint64_t first;
  std::uint64_t second;
  double crossing;
  std::uint64_t firstPlace;
  std::uint64_t secondPlace;
  Vector firstPosition;
  Vector secondPosition;
};

/// The leaf at a place in the order of the tree, where a sample of it is.
/// @throws MissingNode if this rank does not hold it as a leaf. O(depth)
template <class TSample>
std::size_t leafAt(const SampleTree<TSample>& tree, std::uint64_t place, const Vector& position)
{
  std::size_t nodeIndex = SampleTree<TSample>::rootNode;
  while (tree.nodes[nodeIndex].isSplit())
  {
    const Node<TSample>& node = tree.nodes[nodeIndex];
    const bool upper = place >= tree.nodes[node.upperNode()].begin;
    nodeIndex = tree.child(node, upper);
  }
  requireLeaf(tree, nodeIndex, Region{ position, position });
  return nodeIndex;
}

/// The place in the order of the tree of the leaf that comes first there: the rank that has it is
/// the one to which the isopoint of the edge belongs.
template <class TSample>
std::uint64_t firstPlaceOf(const SampleTree<TSample>& tree, const EdgeLeaves& leaves)
{
  return std::min(tree.nodes[leaves.first].begin, tree.nodes[leaves.second].begin);
}

/// The crossing edges of one isovalue that end in at least one of this rank's leaves, ordered, each
/// once, and what is needed to go on from them. All functions are collective.
template <class TSample>
class RankSurface
{
public:
  using Edge = CrossingEdge<TSample>;
  using Neighborhoods = NeighborhoodCache<typename TSample::Id>;

  /// @param tree see SharedTree; refined as far as needed
  /// @param idCount above every id
  RankSurface(const Execution& execution, SampleTree<TSample>& tree,
    NodeExchange<TSample>& exchange, Neighborhoods& neighborhoods, std::uint64_t idCount)
    : Run(execution)
    , Tree(tree)
    , Exchange(exchange)
    , Known(neighborhoods)
    , IdCount(idCount)
  {
  }

  /// The isopoints on edges with an end in one of this rank's leaves, those of edges between two
  /// ranks on both.
  /// @throws Aborted, std::bad_alloc, std::length_error, FailedElsewhere
  Isosurface extract(const IsosurfaceRequest& request, WorkProgress& progress, double laterWork)
  {
    Isosurface surface;
    surface.isovalue = request.isovalue;
    if (this->Tree.isEmpty())
    {
      return surface; // that of all ranks is
    }
    const double fitting = request.fit ? work::fitting : 0.0;
    const double afterEdges = work::placing + fitting + laterWork;
    NarrowBand<TSample> band(
      this->Tree, request.isovalue, this->Run, progress, work::finding + afterEdges);
    const std::vector<BinaryIndex> crossing = band.refine(this->Exchange);
    std::optional<ExtractionContext<TSample>> made;
    this->Exchange.together([&]() { made.emplace(this->Tree, this->Known, request.isovalue); });
    ExtractionContext<TSample>& context = *made;
    const auto partFor = [&progress](double isopointCount, double work, double left)
    { return progress.part(isopointCount * work, isopointCount * left); };
    const double expected = work::isopointsForNode * static_cast<double>(crossing.size());
    this->findEdges(partFor(expected, work::finding, afterEdges), context, request, crossing);
    const std::size_t dropped = request.dropsGaps ? this->dropGaps() : 0;
    const auto count = static_cast<double>(this->Edges.size());
    if (request.fit)
    {
      this->fitAll(partFor(count, fitting, work::placing + laterWork), context, *request.fit);
    }
    this->Exchange.together(
      [&]()
      {
        surface = placeIsopoints(partFor(count, work::placing, laterWork), context, this->Edges,
          std::move(this->Fits), request.fit && request.fit->move);
        surface.droppedEdges = dropped;
      });
    return surface;
  }

private:
  void findEdges(const Execution& part, ExtractionContext<TSample>& context,
    const IsosurfaceRequest& request, std::vector<BinaryIndex> nodes)
  {
    FoundEdges<TSample> found;
    std::vector<MissingNode> missing;
    do
    {
      this->Exchange.together(
        [&]()
        {
          MissingWork left = addEdges(part, context, request, nodes, found);
          nodes = std::move(left.leaves);
          missing = std::move(left.missing);
        });
    } while (this->Exchange.fetch(missing));
    this->shareEdges(found.edges);
    this->Exchange.together(
      [&]()
      {
        this->Edges = sortedUnique(
          part, found.edges, this->IdCount, [](const Edge& edge) { return edge.first; });
        this->GapEdges = std::move(found.gapEdges);
        keepNeighborhoods(part, found.neighborhoods, this->Tree.nodes.size(), this->Known);
      });
  }

  /// Sends each edge to the rank of its other end, and adds those that arrive.
  void shareEdges(std::vector<Edge>& edges)
  {
    std::vector<std::vector<SentEdge>> outgoing;
    this->Exchange.together(
      [&]()
      {
        outgoing.resize(static_cast<std::size_t>(this->Exchange.team().size()));
        for (const Edge& edge : edges)
        {
          for (const auto leaf : { edge.firstLeaf, edge.secondLeaf })
          {
            const Node<TSample>& node = this->Tree.nodes[leaf];
            if (!this->Tree.hasOwn(node))
            {
              outgoing[this->Exchange.ownerOf(node.begin)].push_back(this->sent(edge));
            }
          }
        }
      });
    const std::vector<std::vector<SentEdge>> arrived = this->Exchange.team().exchange(outgoing);
    std::vector<SentEdge> open;
    this->Exchange.together(
      [&]()
      {
        for (const std::vector<SentEdge>& list : arrived)
        {
          open.insert(open.end(), list.begin(), list.end());
        }
      });
    inRounds(
      Execution(), this->Exchange, open.size(), [&]() { return 0; },
      [&](int, std::size_t i)
      {
        const SentEdge& edge = open[i];
        const std::size_t firstLeaf = leafAt(this->Tree, edge.firstPlace, edge.firstPosition);
        const std::size_t secondLeaf = leafAt(this->Tree, edge.secondPlace, edge.secondPosition);
        edges.push_back(
          { edge.first, edge.second, edge.crossing, static_cast<typename TSample::Id>(firstLeaf),
            static_cast<typename TSample::Id>(secondLeaf) });
      });
  }

  /// Drops the edges in gaps. @returns how many of them are counted on this rank
  std::size_t dropGaps()
  {
    EdgeTeam<TSample> team(this->Tree, this->Exchange, this->Edges);
    const std::vector<char> isInGap =
      edgesInGaps(this->Run, this->Tree, team, this->Edges, this->GapEdges);
    std::size_t count = 0;
    for (std::size_t i = 0; i < this->Edges.size(); ++i)
    {
      const Edge& edge = this->Edges[i];
      const std::uint64_t place = firstPlaceOf(this->Tree, { edge.firstLeaf, edge.secondLeaf });
      const bool isCounted = place >= this->Tree.ownBegin && place < this->Tree.ownEnd;
      count += isInGap[i] && isCounted ? 1 : 0;
    }
    dropMarked(isInGap, this->Edges);
    return count;
  }

  SentEdge sent(const Edge& edge) const
  {
    const Node<TSample>& first = this->Tree.nodes[edge.firstLeaf];
    const Node<TSample>& second = this->Tree.nodes[edge.secondLeaf];
    return { edge.first, edge.second, edge.crossing, first.begin, second.begin,
      positionOf(this->Tree.samples[first.begin]), positionOf(this->Tree.samples[second.begin]) };
  }

  void fitAll(const Execution& part, ExtractionContext<TSample>& context, FitRequest request)
  {
    std::vector<TreePlace> places;
    this->Exchange.together(
      [&]()
      {
        this->Fits.resize(this->Edges.size());
        places = placesOf(part, this->Tree, this->Edges);
      });
    inRounds(
      part, this->Exchange, places.size(),
      [&]() { return NeighborhoodFitter<TSample>(context, request); },
      [&](NeighborhoodFitter<TSample>& fitter, std::size_t i)
      { this->Fits[places[i].edge] = fitter.fit(this->Edges[places[i].edge]); });
  }

  const Execution& Run;
  SampleTree<TSample>& Tree;
  NodeExchange<TSample>& Exchange;
  Neighborhoods& Known;
  std::uint64_t IdCount;
  std::vector<Edge> Edges;
  std::vector<Edge> GapEdges; // see FoundEdges
  std::vector<LocalFit> Fits;
};

} // namespace isopoint

#endif
