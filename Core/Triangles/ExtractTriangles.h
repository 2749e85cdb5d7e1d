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
#include "Core/Triangles/GapTetrahedra.h"
#include "Core/Triangles/MarchingTetrahedra.h"
#include "Core/Triangles/SurfacePieces.h"
#include "Core/Triangles/TriangleGeometry.h"
#include "Core/Triangles/VertexMerging.h"

#include <cstddef>
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
  /// @param kept see CrossingTetrahedraFinder
  TriangleExtraction(const Execution& execution, SampleTree<TSample>& tree, TRanks& ranks,
    const NeighborhoodCache<Id>& neighborhoods, std::unique_ptr<KeptTetrahedra>& kept,
    const IsosurfaceRequest& request)
    : Run(execution)
    , Tree(tree)
    , Ranks(ranks)
    , Neighborhoods(neighborhoods)
    , Kept(kept)
    , Request(request)
    , Values(tree)
  {
  }

  /// @throws Aborted, std::bad_alloc, TooManyTetrahedra, or TreeTooLarge (see NarrowBand); the tree
  /// stays usable
  TriangleSurface extract()
  {
    if (this->Tree.isEmpty())
    {
      return {};
    }
    constexpr double fitsEnd = 0.9; // shares of the progress
    const double mergingBegin = this->Request.fit ? 0.6 : 0.85;
    const double fitsBegin = this->hasCreases() ? 0.8 : mergingBegin + 0.05;
    MarchedTriangles<TSample> marched = this->march(partOf(this->Run, 0.0, mergingBegin));
    this->Edges = std::move(marched.edges);
    ExtractionContext<TSample> context(this->Tree, this->Neighborhoods, this->Request.isovalue);
    CrossingMesh mesh =
      this->Request.regularizes
        ? this->merge(partOf(this->Run, mergingBegin, fitsBegin), context, std::move(marched))
        : std::move(marched.mesh);
    std::vector<LocalFit> fits;
    if (this->Request.fit)
    {
      fits = this->fitTo(partOf(this->Run, fitsBegin, fitsEnd), context, mesh);
    }
    return this->placeVertices(
      partOf(this->Run, fitsEnd, 1.0), context, std::move(mesh), std::move(fits));
  }

  std::vector<LeafTetrahedron> tetrahedra(const Execution& execution)
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
  BodyTetrahedra bodyTetrahedra(const Execution& execution)
  {
    std::size_t askedCount = 0;
    BodyTetrahedra found = this->withFinder(execution,
      [&](const Execution& part, CrossingTetrahedraFinder<TSample, TRanks>& finder,
        const std::vector<BinaryIndex>& nodes)
      {
        BodyFinder<TSample, TRanks> bodyFinder(part, this->Tree, this->Ranks, finder);
        BodyTetrahedra body = bodyFinder.find(nodes, this->Request.dropsGaps);
        askedCount = bodyFinder.askedCount();
        return body;
      });
    this->Counts.edges = askedCount;
    return found;
  }

  /// Drops the crossing tetrahedra in gaps.
  void dropGaps(const Execution& execution, std::vector<LeafTetrahedron>& found)
  {
    this->Ranks.order(found);
    const std::size_t count = found.size();
    GapTetrahedraFinder<TSample, TRanks> finder(
      execution, this->Tree, this->Ranks, found, this->Request.keepsHullSlivers);
    dropMarked(execution, finder.find(), found);
    this->Counts.edges = finder.askedCount();
    this->Dropped = count - found.size();
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
    CrossingTetrahedraFinder<TSample, TRanks> finder(part, this->Tree, this->Ranks, this->Values,
      this->Request.isovalue, this->Kept, this->Request.tetrahedraLimit);
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
      const BodyTetrahedra body = this->bodyTetrahedra(partOf(execution, 0.0, gapsEnd));
      this->Dropped = body.droppedCount;
      return BodySurface<TSample>(partOf(execution, gapsEnd, 1.0), this->Tree, this->Values,
        this->Request.isovalue, order, body)
        .find();
    }
    std::vector<LeafTetrahedron> found = this->tetrahedra(partOf(execution, 0.0, tetrahedraEnd));
    if (this->Request.dropsGaps)
    {
      this->dropGaps(partOf(execution, tetrahedraEnd, gapsEnd), found);
    }
    return marchTetrahedra(partOf(execution, gapsEnd, 1.0), this->Tree, this->Values,
      this->Request.isovalue, order, found);
  }

  bool hasCreases() const
  {
    return this->Request.fit && this->Request.fit->highest == FitOrder::Crease;
  }

  /// Merges vertices except at creases and samples. Needs fits at all vertices to find creases, and
  /// keeps them.
  CrossingMesh merge(const Execution& execution, ExtractionContext<TSample>& context,
    MarchedTriangles<TSample> marched)
  {
    constexpr double fitsEnd = 0.8; // share of the progress
    CrossingMesh& mesh = marched.mesh;
    std::vector<char> areFixed;
    if (this->hasCreases())
    {
      const std::vector<LocalFit> fits =
        this->fitTo(partOf(execution, 0.0, fitsEnd), context, mesh);
      areFixed = areAtCreases(execution, fits, mesh.triangles);
      const std::vector<std::size_t> atCreases = markedOf(execution, areFixed);
      this->FitsAtCreases = chosenOf(execution, fits, atCreases);
      this->AreAtCreases = areFixed;
      this->CreaseFitIndices = inverseOf(execution, atCreases, fits.size());
    }
    else if (this->Request.caps)
    {
      areFixed = tabulated<char>(execution, this->Edges.size(),
        [this](std::size_t crossing) { return this->Edges[crossing].isSample(); });
    }
    const Execution part = partOf(execution, fitsEnd, 1.0);
    MergeableTriangles exact{ mesh.positions, std::move(mesh.triangles), std::move(mesh.caps),
      std::move(marched.nearerEnds), marched.endCount, std::move(areFixed),
      this->Request.keepsHullSlivers };
    if (exact.caps.empty())
    {
      return mergeVertices(part, std::move(exact));
    }
    CrossingMesh merged = mergeVertices(part, exact);
    restoreInvertedPieces(part, exact, merged);
    return merged;
  }

  const CrossingEdge<TSample>& edgeOf(const CrossingMesh& mesh, std::size_t vertex) const
  {
    return this->Edges[mesh.firstMember(vertex)];
  }

  /// Reuses the fits at creases. The vertices of caps at samples stay there, without fits.
  std::vector<LocalFit> fitTo(
    const Execution& execution, ExtractionContext<TSample>& context, const CrossingMesh& mesh)
  {
    const auto edges = tabulated<CrossingEdge<TSample>>(
      this->Run, mesh.size(), [&](std::size_t vertex) { return this->edgeOf(mesh, vertex); });
    if (this->FitsAtCreases.empty() && mesh.caps.empty())
    {
      return this->Ranks.fitShared(execution, context, *this->Request.fit, edges, mesh.positions);
    }
    const auto isKnown = [&](std::size_t vertex)
    { return !this->FitsAtCreases.empty() && this->AreAtCreases[mesh.firstMember(vertex)] != 0; };
    std::vector<LocalFit> fits(edges.size());
    forEachIndex(execution, fits.size(),
      [&](std::size_t vertex)
      {
        fits[vertex].position = mesh.positions[vertex];
        if (isKnown(vertex))
        {
          fits[vertex] = this->FitsAtCreases[this->CreaseFitIndices[mesh.firstMember(vertex)]];
        }
      });
    const std::vector<std::size_t> unknown = itemsThat(execution, fits.size(),
      [&](std::size_t vertex) { return !isKnown(vertex) && !edges[vertex].isSample(); });
    const std::vector<LocalFit> others =
      this->Ranks.fitShared(execution, context, *this->Request.fit,
        chosenOf(this->Run, edges, unknown), chosenOf(this->Run, mesh.positions, unknown));
    forEachIndex(execution, unknown.size(), [&](std::size_t i) { fits[unknown[i]] = others[i]; });
    return fits;
  }

  /// Moves vertices by their fits unless a triangle turns over.
  TriangleSurface placeVertices(const Execution& execution, ExtractionContext<TSample>& context,
    CrossingMesh mesh, std::vector<LocalFit> fits)
  {
    const bool isMoved = this->Request.fit && this->Request.fit->move;
    if (isMoved && !mesh.caps.empty())
    {
      this->keepRimOnEdges(mesh, fits);
      std::vector<SurfaceTriangle> others = mesh.triangles;
      dropMarked(this->Run, areAmong(this->Run, mesh.triangles, mesh.caps), others);
      keepTrianglesUpright(partOf(execution, 0.0, 0.5), mesh.positions, others, fits);
      keepBodiesOriented(this->Run, mesh.positions, mesh.triangles, mesh.caps, fits);
    }
    else if (isMoved)
    {
      keepTrianglesUpright(partOf(execution, 0.0, 0.5), mesh.positions, mesh.triangles, fits);
    }
    const std::vector<Vector> positions = tabulated<Vector>(this->Run, mesh.size(),
      [&](std::size_t vertex)
      { return fits.empty() ? mesh.positions[vertex] : fits[vertex].position; });
    if (this->Request.regularizes)
    {
      const std::vector<SurfaceTriangle> before =
        this->Request.caps ? mesh.triangles : std::vector<SurfaceTriangle>();
      this->flipEdgesOf(mesh, positions, fits);
      if (this->Request.caps)
      {
        revertInvertingFlips(this->Run, positions, before, mesh.triangles);
      }
    }
    std::vector<std::size_t> order = orderOfEdges(this->Run, mesh.size(),
      [&](std::size_t vertex) -> const SampleEdge& { return this->edgeOf(mesh, vertex); });
    if (this->Request.minimumPieceSize > 0.0 && !mesh.triangles.empty())
    {
      this->dropSmallPieces(mesh, positions);
      const std::vector<char> areUsed = areVerticesOf(this->Run, mesh.triangles, positions.size());
      order =
        chosenThat(this->Run, order, [&](std::size_t vertex) { return areUsed[vertex] != 0; });
    }
    mesh = inOrder(this->Run, mesh, order);
    fits = chosenOf(this->Run, fits, order);
    TriangleSurface surface;
    surface.vertices = placeIsopoints<TSample>(partOf(execution, 0.5, 1.0), context,
      { chosenOf(this->Run, this->Edges, mesh.members), mesh.memberBegins, mesh.positions },
      std::move(fits), isMoved);
    if (this->Request.caps)
    {
      surface.areCaps = areAmong(this->Run, mesh.triangles, mesh.caps);
    }
    surface.triangles = std::move(mesh.triangles);
    if (isMoved && this->hasCreases())
    {
      meshCreases(this->Run, surface.vertices, surface.triangles, this->Request);
    }
    surface.droppedTetrahedra = this->Dropped;
    surface.vertices.coincident = coincidentEnds(this->Run, this->Tree, surface.vertices.leaves);
    return surface;
  }

  /// Vertices of the rim, between isosurface and caps, move along their edges only, so that caps
  /// stay where they are: to the tangent plane of the fit.
  void keepRimOnEdges(const CrossingMesh& mesh, std::vector<LocalFit>& fits) const
  {
    const std::vector<char> areOfCaps = areVerticesOf(this->Run, mesh.caps, fits.size());
    forEachIndex(this->Run, fits.size(),
      [&](std::size_t vertex)
      {
        LocalFit& fit = fits[vertex];
        if (!areOfCaps[vertex] || !fit.order)
        {
          return;
        }
        const CrossingEdge<TSample>& edge = this->edgeOf(mesh, vertex);
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

  /// Leaves vertices without triangles.
  void dropSmallPieces(CrossingMesh& mesh, const std::vector<Vector>& positions) const
  {
    const std::vector<char> areSmall = areOfSmallPieces(
      this->Run, positions, mesh.triangles, this->Request.minimumPieceSize, this->Request.caps);
    const std::vector<char> areCaps = areAmong(this->Run, mesh.triangles, mesh.caps);
    mesh.caps = chosenOf(this->Run, mesh.triangles,
      itemsThat(this->Run, areCaps.size(),
        [&](std::size_t i) { return areCaps[i] != 0 && areSmall[i] == 0; }));
    dropMarked(this->Run, areSmall, mesh.triangles);
  }

  void flipEdgesOf(CrossingMesh& mesh, const std::vector<Vector>& positions,
    const std::vector<LocalFit>& fits) const
  {
    const std::vector<char> areFixed = this->hasCreases()
                                         ? areAtCreases(this->Run, fits, mesh.triangles)
                                         : areVerticesOf(this->Run, mesh.caps, positions.size());
    flipEdges(this->Run, positions, areFixed, mesh.triangles);
  }

  const Execution& Run;
  SampleTree<TSample>& Tree;
  TRanks& Ranks;
  const NeighborhoodCache<Id>& Neighborhoods;
  std::unique_ptr<KeptTetrahedra>& Kept;
  const IsosurfaceRequest& Request;
  LeafValues<TSample> Values;
  // By crossing; the last two only once fits have found creases.
  std::vector<CrossingEdge<TSample>> Edges;
  std::vector<char> AreAtCreases;
  std::vector<std::size_t> CreaseFitIndices; // into FitsAtCreases
  std::vector<LocalFit> FitsAtCreases;       // by that number
  TetrahedraCounts Counts;
  std::size_t Dropped = 0;
};

} // namespace isopoint
