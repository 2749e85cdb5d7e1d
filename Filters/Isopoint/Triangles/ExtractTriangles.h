// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_ExtractTriangles_h
#define isopoint_ExtractTriangles_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Base/Interpolation.h"
#include "Isopoint/Extraction/ExpectedWork.h"
#include "Isopoint/Extraction/ExtractIsosurface.h"
#include "Isopoint/Extraction/ExtractionContext.h"
#include "Isopoint/Extraction/Isosurface.h"
#include "Isopoint/Extraction/IsosurfaceRequest.h"
#include "Isopoint/Extraction/NarrowBand.h"
#include "Isopoint/Extraction/NeighborhoodFits.h"
#include "Isopoint/Neighbors/GapCriterion.h"
#include "Isopoint/Triangles/CrossingTetrahedra.h"
#include "Isopoint/Triangles/MarchingTetrahedra.h"
#include "Isopoint/Triangles/TreeRefinement.h"
#include "Isopoint/Triangles/TriangleGeometry.h"

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace isopoint
{

/// The isosurface of one isovalue as triangles.
struct TriangleSurface
{
  Isosurface vertices; // of crossing Delaunay edges
  std::vector<SurfaceTriangle> triangles;
};

/// Extracts triangles; see docs/triangles.md. For one isovalue.
template <class TSample>
class TriangleExtraction
{
public:
  using Id = typename TSample::Id;

  /// @param tree will be refined
  /// @param neighborhoods of the tree's leaves that are known
  TriangleExtraction(const Execution& execution, SampleTree<TSample>& tree,
    const NeighborhoodCache<Id>& neighborhoods, const IsosurfaceRequest& request)
    : Run(execution)
    , Tree(tree)
    , Neighborhoods(neighborhoods)
    , Request(request)
    , Means(tree)
  {
  }

  /// @param progress divided among the parts
  /// @param laterWork that follows for each vertex
  /// @throws Aborted, std::bad_alloc, or std::length_error (see NarrowBand); the tree can be used
  /// again afterwards
  TriangleSurface extract(WorkProgress& progress, double laterWork)
  {
    if (this->Tree.isEmpty())
    {
      return {};
    }
    const double fitting = this->Request.fit ? work::fitting : 0.0;
    EdgeTriangles<TSample> mesh = this->march(progress, fitting + laterWork);
    TriangleSurface surface;
    const auto count = static_cast<double>(mesh.edges.size());
    std::vector<std::size_t> ends = this->leavesOf(mesh.edges);
    if (this->Request.fit)
    {
      this->splitAround(ends);
    }
    ExtractionContext<TSample> context(this->Tree, this->Neighborhoods, this->Request.isovalue);
    std::vector<LocalFit> fits;
    const bool isMoved = this->Request.fit && this->Request.fit->move;
    if (this->Request.fit)
    {
      fits = fitNeighborhoods(
        progress.part(count * fitting, count * laterWork), context, *this->Request.fit, mesh.edges);
    }
    if (isMoved)
    {
      keepTrianglesUpright(this->Run, this->positionsOnEdges(mesh.edges), mesh.triangles, fits);
    }
    surface.vertices = placeIsopoints(progress.part(count * work::placing, count * laterWork),
      context, mesh.edges, std::move(fits), isMoved);
    surface.triangles = std::move(mesh.triangles);
    const auto isSingle = [this](std::size_t leaf) { return this->Tree.nodes[leaf].count() == 1; };
    ends.erase(std::remove_if(ends.begin(), ends.end(), isSingle), ends.end());
    surface.vertices.coincident = coincidentSamplesOf(this->Tree, std::move(ends));
    return surface;
  }

  /// The crossing tetrahedra of the Delaunay tetrahedrisation of all samples.
  std::vector<CrossingTetrahedron<Id>> tetrahedra(WorkProgress& progress, double laterWork)
  {
    if (this->Tree.isEmpty())
    {
      return {};
    }
    const std::vector<BinaryIndex> nodes = NarrowBand<TSample>(
      this->Tree, this->Request.isovalue, this->Run, progress, work::tetrahedrising + laterWork)
                                             .refine();
    const double count = work::isopointsForNode * static_cast<double>(nodes.size());
    const Execution part = progress.part(count * work::tetrahedrising, count * laterWork);
    CrossingTetrahedraFinder<TSample> finder(part, this->Tree, this->Means, this->Request.isovalue);
    std::vector<CrossingTetrahedron<Id>> found = finder.find(nodes);
    this->Counts = finder.counts();
    return found;
  }

  const TetrahedraCounts& counts() const { return this->Counts; }

private:
  /// The triangles of all tetrahedra but those across gaps.
  EdgeTriangles<TSample> march(WorkProgress& progress, double laterWork)
  {
    std::vector<CrossingTetrahedron<Id>> found = this->tetrahedra(progress, laterWork);
    this->dropGaps(found);
    return MarchingTetrahedra<TSample>(
      this->Run, this->Tree, this->Means, this->Request.isovalue, found)
      .march();
  }

  /// Drops tetrahedra with an edge that the gap criterion drops.
  void dropGaps(std::vector<CrossingTetrahedron<Id>>& found)
  {
    if (!(this->Request.gapFactor > 0.0))
    {
      return;
    }
    const GapCriterion criterion(this->Request.gapFactor);
    const auto isAcrossGap = [&](const CrossingTetrahedron<Id>& tetrahedron)
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
    };
    std::vector<char> isDropped(found.size(), 0);
    constexpr std::size_t grain = 256;
    forBatches(this->Run, found.size(), 8 * grain, grain,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          isDropped[i] = isAcrossGap(found[i]) ? 1 : 0;
        }
      });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      if (!isDropped[i])
      {
        found[kept++] = found[i];
      }
    }
    found.resize(kept);
  }

  const TSample& sampleOf(std::size_t leaf) const
  {
    return this->Tree.samples[this->Tree.nodes[leaf].begin];
  }

  /// The leaves at the ends of edges, each once.
  static std::vector<std::size_t> leavesOf(const std::vector<CrossingEdge<TSample>>& edges)
  {
    std::vector<std::size_t> leaves;
    leaves.reserve(2 * edges.size());
    for (const CrossingEdge<TSample>& edge : edges)
    {
      leaves.push_back(static_cast<std::size_t>(edge.firstLeaf));
      leaves.push_back(static_cast<std::size_t>(edge.secondLeaf));
    }
    std::sort(leaves.begin(), leaves.end());
    leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
    return leaves;
  }

  /// Splits what touches leaves down to leaves, for fits: the band has done so around leaves that
  /// touch the other side, and ends of Delaunay edges may not be of these.
  void splitAround(const std::vector<std::size_t>& leaves)
  {
    std::vector<std::size_t> missing;
    do
    {
      missing.clear();
      std::mutex mutex;
      constexpr std::size_t grain = 1024;
      forBatches(this->Run, leaves.size(), 8 * grain, grain,
        [&](std::size_t begin, std::size_t end)
        {
          std::vector<std::size_t> found;
          for (std::size_t i = begin; i < end; ++i)
          {
            visitTouching(this->Tree, pathToLeaf(this->Tree, leaves[i]), maximumDepth,
              [&](std::size_t node)
              {
                if (!this->Tree.nodes[node].isLeaf)
                {
                  found.push_back(node);
                }
                return false;
              });
          }
          const std::lock_guard<std::mutex> lock(mutex);
          missing.insert(missing.end(), found.begin(), found.end());
        });
      splitFurther(this->Run, this->Tree, missing);
    } while (!missing.empty());
  }

  std::vector<Vector> positionsOnEdges(const std::vector<CrossingEdge<TSample>>& edges) const
  {
    std::vector<Vector> positions;
    positions.reserve(edges.size());
    for (const CrossingEdge<TSample>& edge : edges)
    {
      positions.push_back(
        interpolate(positionOf(this->sampleOf(static_cast<std::size_t>(edge.firstLeaf))),
          positionOf(this->sampleOf(static_cast<std::size_t>(edge.secondLeaf))), edge.crossing));
    }
    return positions;
  }

  const Execution& Run;
  SampleTree<TSample>& Tree;
  const NeighborhoodCache<Id>& Neighborhoods;
  const IsosurfaceRequest& Request;
  SharedLeafMeans<TSample> Means;
  TetrahedraCounts Counts;
};

} // namespace isopoint

#endif
