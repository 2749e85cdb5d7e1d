// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Base/Vector.h"
#include "Core/Extraction/ExtractIsosurface.h"
#include "Core/Extraction/ExtractionContext.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Extraction/NarrowBand.h"
#include "Core/Tetrahedra/CrossingTetrahedra.h"
#include "Core/Tetrahedra/KeptTetrahedra.h"
#include "Core/Triangles/BodyOrientation.h"
#include "Core/Triangles/BodySurface.h"
#include "Core/Triangles/BodyTetrahedra.h"
#include "Core/Triangles/CreaseMesh.h"
#include "Core/Triangles/EdgeFlipping.h"
#include "Core/Triangles/EdgeTriangles.h"
#include "Core/Triangles/GapTetrahedra.h"
#include "Core/Triangles/MarchingTetrahedra.h"
#include "Core/Triangles/SurfacePieces.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace isopoint
{

/// The triangles for one isovalue.
struct TriangleSurface
{
  Isosurface vertices; // of crossing Delaunay edges
  std::vector<SurfaceTriangle> triangles;
  std::vector<char> areCaps;         // by triangle; empty without caps
  std::size_t droppedTetrahedra = 0; // in gaps
};

/// Extracts the triangles for one isovalue; see docs/triangles.md. With a process group, all
/// functions are collective, and each rank finds the whole surface.
template <class TSample, class TRanks>
class TriangleExtraction
{
public:
  using Id = typename TSample::Id;

  /// @param tree is refined
  /// @param ranks SingleRank, or SharedRanks
  /// @param neighborhoods known neighborhoods of leaves
  /// @param band see CrossingTetrahedraFinder
  TriangleExtraction(const Execution& execution, SampleTree<TSample>& tree, TRanks& ranks,
    const NeighborhoodCache<Id>& neighborhoods, std::unique_ptr<KeptTetrahedra>& band,
    const IsosurfaceRequest& request)
    : Exec(execution)
    , Tree(tree)
    , Ranks(ranks)
    , Neighborhoods(neighborhoods)
    , Kept(band)
    , Request(request)
    , Values(tree)
  {
  }

  /// @throws Aborted, std::bad_alloc, or TreeTooLarge (see NarrowBand); the tree stays usable
  TriangleSurface extract()
  {
    if (this->Tree.isEmpty())
    {
      return {};
    }
    constexpr double fitsEnd = 0.9; // shares of the progress
    const double mergingBegin = this->Request.fit ? 0.6 : 0.85;
    const double fitsBegin = this->hasCreases() ? 0.8 : mergingBegin + 0.05;
    MarchedTriangles<TSample> marched = this->march(partOf(this->Exec, 0.0, mergingBegin));
    ExtractionContext<TSample> context(this->Tree, this->Neighborhoods, this->Request.isovalue);
    FitsAtEdges known;
    EdgeTriangles<TSample> mesh = this->Request.regularizes
                                    ? this->merge(partOf(this->Exec, mergingBegin, fitsBegin),
                                        context, std::move(marched), known)
                                    : EdgeTriangles<TSample>(std::move(marched));
    std::vector<LocalFit> fits;
    if (this->Request.fit)
    {
      fits = this->fitTo(partOf(this->Exec, fitsBegin, fitsEnd), context, mesh, known);
    }
    return this->place(partOf(this->Exec, fitsEnd, 1.0), context, mesh, std::move(fits));
  }

  std::vector<CrossingTetrahedron<Id>> tetrahedra(const Execution& execution)
  {
    if (this->Tree.isEmpty())
    {
      return {};
    }
    return this->withFinder(
      execution, [](const Execution& /*part*/, CrossingTetrahedraFinder<TSample, TRanks>& finder,
                   const std::vector<BinaryIndex>& nodes) { return finder.find(nodes); });
  }

  /// The tetrahedra and facets that the surface of the body consists of.
  BodyTetrahedra<Id> bodyTetrahedra(const Execution& execution)
  {
    return this->withFinder(execution,
      [this](const Execution& part, CrossingTetrahedraFinder<TSample, TRanks>& finder,
        const std::vector<BinaryIndex>& nodes)
      {
        return BodyFinder<TSample, TRanks>(part, this->Tree, this->Ranks, finder)
          .find(nodes, this->Request.dropsGaps);
      });
  }

  const TetrahedraCounts& counts() const { return this->Counts; }

private:
  /// @returns find(execution, finder, nodes at the isosurface)
  template <class Find>
  auto withFinder(const Execution& execution, const Find& find)
  {
    constexpr double bandEnd = 0.3; // share of the progress
    const std::vector<BinaryIndex> nodes =
      NarrowBand<TSample>(this->Tree, this->Request.isovalue, partOf(execution, 0.0, bandEnd))
        .refine(this->Ranks);
    const Execution part = partOf(execution, bandEnd, 1.0);
    CrossingTetrahedraFinder<TSample, TRanks> finder(
      part, this->Tree, this->Ranks, this->Values, this->Request.isovalue, this->Kept);
    auto found = find(part, finder, nodes);
    if (!this->Request.keepsTetrahedra)
    {
      dropTetrahedra(execution, this->Kept);
    }
    this->Counts = finder.counts();
    return found;
  }

  MarchedTriangles<TSample> march(const Execution& execution)
  {
    constexpr double tetrahedraEnd = 0.8; // shares of the progress
    constexpr double gapsEnd = 0.9;
    const EdgeOrder order = this->Request.regularizes ? EdgeOrder::Tree : EdgeOrder::Ids;
    if (this->Request.caps)
    {
      const BodyTetrahedra<Id> body = this->bodyTetrahedra(partOf(execution, 0.0, gapsEnd));
      this->Dropped = body.droppedCount;
      return BodySurface<TSample>(partOf(execution, gapsEnd, 1.0), this->Tree, this->Values,
        this->Request.isovalue, order, body)
        .find();
    }
    std::vector<CrossingTetrahedron<Id>> found =
      this->tetrahedra(partOf(execution, 0.0, tetrahedraEnd));
    if (this->Request.dropsGaps)
    {
      this->dropGaps(partOf(execution, tetrahedraEnd, gapsEnd), found);
    }
    return MarchingTetrahedra<TSample>(partOf(execution, gapsEnd, 1.0), this->Tree, this->Values,
      this->Request.isovalue, order, found)
      .march();
  }

  bool hasCreases() const
  {
    return this->Request.fit && this->Request.fit->highest == FitOrder::Crease;
  }

  /// By the edges of vertices with one edge.
  using FitsAtEdges = std::map<SampleEdge, LocalFit>;

  /// Merges vertices except at creases. Needs fits at all vertices to find these.
  /// @param kept set to the fits of vertices at creases
  EdgeTriangles<TSample> merge(const Execution& execution, ExtractionContext<TSample>& context,
    MarchedTriangles<TSample> marched, FitsAtEdges& kept)
  {
    constexpr double fitsEnd = 0.8; // share of the progress
    std::vector<char> areFixed;
    if (this->hasCreases())
    {
      std::vector<LocalFit> fits =
        this->fitTo(partOf(execution, 0.0, fitsEnd), context, marched, {});
      areFixed = areAtCreases(execution, fits, marched.triangles);
      const std::vector<std::size_t> vertices = markedOf(execution, areFixed);
      forEachInOrder(execution, vertices.size(),
        [&](std::size_t i)
        { kept.emplace(marched.edges[vertices[i]], std::move(fits[vertices[i]])); });
    }
    return withMergedVertices(partOf(execution, fitsEnd, 1.0), std::move(marched),
      std::move(areFixed), this->Request.keepsHullSlivers);
  }

  /// The vertices of caps at samples stay there, without fits.
  /// @param known fits that are reused
  std::vector<LocalFit> fitTo(const Execution& execution, ExtractionContext<TSample>& context,
    const EdgeTriangles<TSample>& mesh, const FitsAtEdges& known)
  {
    const std::vector<CrossingEdge<TSample>> edges = mesh.firstEdges(this->Exec);
    if (known.empty() && mesh.caps.empty())
    {
      return this->Ranks.fitShared(execution, context, *this->Request.fit, edges, mesh.positions);
    }
    std::vector<LocalFit> fits(edges.size());
    std::vector<char> areUnknown(edges.size(), 0);
    forEachIndex(execution, edges.size(),
      [&](std::size_t vertex)
      {
        fits[vertex].position = mesh.positions[vertex];
        const auto found = known.find(edges[vertex]);
        if (found != known.end())
        {
          fits[vertex] = found->second;
        }
        areUnknown[vertex] = found == known.end() && !edges[vertex].isSample() ? 1 : 0;
      });
    const std::vector<std::size_t> unknown = markedOf(execution, areUnknown);
    const std::vector<LocalFit> others =
      this->Ranks.fitShared(execution, context, *this->Request.fit,
        chosenOf(this->Exec, edges, unknown), chosenOf(this->Exec, mesh.positions, unknown));
    forEachIndex(execution, unknown.size(), [&](std::size_t i) { fits[unknown[i]] = others[i]; });
    return fits;
  }

  void dropGaps(const Execution& execution, std::vector<CrossingTetrahedron<Id>>& found)
  {
    this->Ranks.order(found);
    const std::size_t count = found.size();
    dropMarked(execution,
      GapTetrahedraFinder<TSample, TRanks>(
        execution, this->Tree, this->Ranks, found, this->Request.keepsHullSlivers)
        .find(),
      found);
    this->Dropped = count - found.size();
  }

  /// Moves vertices by their fits unless a triangle turns over.
  TriangleSurface place(const Execution& execution, ExtractionContext<TSample>& context,
    EdgeTriangles<TSample>& mesh, std::vector<LocalFit> fits)
  {
    const bool isMoved = this->Request.fit && this->Request.fit->move;
    if (isMoved && !mesh.caps.empty())
    {
      this->keepRimOnEdges(mesh, fits);
      std::vector<SurfaceTriangle> others = mesh.triangles;
      dropMarked(this->Exec, areAmong(this->Exec, mesh.triangles, mesh.caps), others);
      keepTrianglesUpright(partOf(execution, 0.0, 0.5), mesh.positions, others, fits);
      keepBodiesOriented(this->Exec, mesh.positions, mesh.triangles, mesh.caps, fits);
    }
    else if (isMoved)
    {
      keepTrianglesUpright(partOf(execution, 0.0, 0.5), mesh.positions, mesh.triangles, fits);
    }
    const std::vector<Vector> positions = this->positionsOf(mesh, fits);
    if (this->Request.regularizes)
    {
      const std::vector<SurfaceTriangle> before =
        this->Request.caps ? mesh.triangles : std::vector<SurfaceTriangle>();
      this->flipEdgesOf(mesh, positions, fits);
      if (this->Request.caps)
      {
        revertInvertingFlips(this->Exec, positions, before, mesh.triangles);
      }
    }
    std::vector<std::size_t> order = orderOfEdges(this->Exec, mesh);
    if (this->Request.minimumPieceSize > 0.0 && !mesh.triangles.empty())
    {
      this->dropSmallPieces(mesh, positions);
      const std::vector<char> areUsed = areVerticesOf(this->Exec, mesh.triangles, positions.size());
      order.erase(std::remove_if(order.begin(), order.end(),
                    [&](std::size_t vertex) { return areUsed[vertex] == 0; }),
        order.end());
    }
    mesh = inOrder(this->Exec, mesh, order);
    fits = chosenOf(this->Exec, fits, order);
    TriangleSurface surface;
    surface.vertices = placeIsopoints<TSample>(partOf(execution, 0.5, 1.0), context,
      { mesh.edges, mesh.edgeBegins, mesh.positions }, std::move(fits), isMoved);
    if (this->Request.caps)
    {
      surface.areCaps = areAmong(this->Exec, mesh.triangles, mesh.caps);
    }
    surface.triangles = std::move(mesh.triangles);
    if (isMoved && this->hasCreases())
    {
      meshCreases(this->Exec, surface.vertices, surface.triangles, this->Request);
    }
    surface.droppedTetrahedra = this->Dropped;
    surface.vertices.coincident = coincidentEnds(this->Exec, this->Tree, surface.vertices.leaves);
    return surface;
  }

  /// Vertices of the rim, between isosurface and caps, move along their edges only, so that caps
  /// stay where they are: to the tangent plane of the fit.
  void keepRimOnEdges(const EdgeTriangles<TSample>& mesh, std::vector<LocalFit>& fits) const
  {
    const std::vector<char> areOfCaps = areVerticesOf(this->Exec, mesh.caps, fits.size());
    forEachIndex(this->Exec, fits.size(),
      [&](std::size_t vertex)
      {
        LocalFit& fit = fits[vertex];
        if (!areOfCaps[vertex] || !fit.order)
        {
          return;
        }
        const CrossingEdge<TSample>& edge = mesh.edges[mesh.edgeBegin(vertex)];
        const Vector first = positionOf(this->Tree.sampleOf(edge.firstLeaf));
        const Vector second = positionOf(this->Tree.sampleOf(edge.secondLeaf));
        const Vector rising = directionOf(fit.gradient);
        const double parameter = dot(rising, fit.position - first) / dot(rising, second - first);
        const bool isInside = parameter > 0.0 && parameter < 1.0;
        fit.position = isInside ? interpolate(first, second, parameter) : mesh.positions[vertex];
        if (!isInside)
        {
          fit.order.reset();
        }
      });
  }

  std::vector<Vector> positionsOf(
    const EdgeTriangles<TSample>& mesh, const std::vector<LocalFit>& fits) const
  {
    std::vector<Vector> positions = mesh.positions;
    forEachIndex(this->Exec, fits.size(),
      [&](std::size_t vertex) { positions[vertex] = fits[vertex].position; });
    return positions;
  }

  /// Leaves vertices without triangles.
  void dropSmallPieces(EdgeTriangles<TSample>& mesh, const std::vector<Vector>& positions) const
  {
    const std::vector<char> areSmall = areOfSmallPieces(
      this->Exec, positions, mesh.triangles, this->Request.minimumPieceSize, this->Request.caps);
    const std::vector<char> areCaps = areAmong(this->Exec, mesh.triangles, mesh.caps);
    mesh.caps = chosenOf(this->Exec, mesh.triangles,
      itemsThat(this->Exec, areCaps.size(),
        [&](std::size_t i) { return areCaps[i] != 0 && areSmall[i] == 0; }));
    dropMarked(this->Exec, areSmall, mesh.triangles);
  }

  void flipEdgesOf(EdgeTriangles<TSample>& mesh, const std::vector<Vector>& positions,
    const std::vector<LocalFit>& fits) const
  {
    const std::vector<char> areFixed = this->hasCreases()
                                         ? areAtCreases(this->Exec, fits, mesh.triangles)
                                         : areVerticesOf(this->Exec, mesh.caps, positions.size());
    flipEdges(this->Exec, positions, areFixed, mesh.triangles);
  }

  const Execution& Exec;
  SampleTree<TSample>& Tree;
  TRanks& Ranks;
  const NeighborhoodCache<Id>& Neighborhoods;
  std::unique_ptr<KeptTetrahedra>& Kept;
  const IsosurfaceRequest& Request;
  LeafValues<TSample> Values;
  TetrahedraCounts Counts;
  std::size_t Dropped = 0;
};

} // namespace isopoint
