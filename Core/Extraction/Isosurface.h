// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Base/Sorting.h"
#include "Core/Base/Vector.h"
#include "Core/Extraction/TetrahedraLimit.h"
#include "Core/Fit/LocalFit.h"
#include "Core/Neighbors/AngleCriterion.h"
#include "Core/Tree/CoincidentSamples.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace isopoint
{

/// An edge between two samples. Edges are sorted by (first, second).
struct SampleEdge
{
  std::uint64_t first;  // the lower id
  std::uint64_t second; // the higher id

  /// Whether both ends are one sample: a vertex of a cap.
  bool isSample() const { return this->first == this->second; }

  bool operator==(const SampleEdge& other) const
  {
    return this->first == other.first && this->second == other.second;
  }
  bool operator<(const SampleEdge& other) const
  {
    return this->first != other.first ? this->first < other.first : this->second < other.second;
  }
};

/// An edge between the samples of two leaves on opposite sides of the isovalue.
template <class TSample>
struct CrossingEdge : SampleEdge
{
  double crossing; // parameter of the isovalue by linear interpolation: 0 at `first`, 1 at `second`
  typename TSample::Id firstLeaf; // node indices
  typename TSample::Id secondLeaf;
};

/// The leaves at the ends of edges, sorted, each once. @throws std::bad_alloc, Aborted
/// @param nodeCount of the tree
template <class TSample>
std::vector<std::size_t> leavesOf(const Execution& execution,
  const std::vector<CrossingEdge<TSample>>& edges, std::size_t nodeCount)
{
  std::vector<std::size_t> leaves(2 * edges.size());
  forEachIndex(execution, edges.size(),
    [&](std::size_t i)
    {
      leaves[2 * i] = edges[i].firstLeaf;
      leaves[2 * i + 1] = edges[i].secondLeaf;
    });
  return sortedUnique(execution, leaves, nodeCount);
}

/// The isovalue, the criteria of edges, and the fits.
struct IsosurfaceRequest
{
  double isovalue;             // any; the surface separates samples below it from the others
  double angle = defaultAngle; // of the angle criterion, in degrees, from 0 to 180
  bool dropsGaps = false;      // whether to drop parts in gaps of the cloud
  std::optional<FitRequest> fit = std::nullopt;
  /// Triangles only: whether to keep the tetrahedralization near the surface for the next
  /// extraction, unless it is large (see KeptTetrahedra).
  bool keepsTetrahedra = true;
  /// Triangles only: beyond it extraction ends. Tests lower it.
  TetrahedraLimit tetrahedraLimit{};
  /// Triangles with creases only: whether vertices are repeated on each side, for separate normals.
  bool duplicatesCreaseVertices = false;
  /// Triangles only: whether to merge vertices and flip edges for good shapes (docs/triangles.md).
  bool regularizes = false;
  /// Triangles only, for slices: whether gaps begin only at edges that span a void, not at slivers
  /// on the convex hull, and merging keeps the vertices of the rim. The rim is then that of the
  /// body (docs/triangles.md).
  bool keepsHullSlivers = false;
  /// Triangles only: whether the surface is that of the body of the samples at or above the
  /// isovalue, closed by caps where the samples end (docs/triangles.md). Not with creases.
  bool caps = false;
  /// Triangles only: connected components with less than this share of the largest one's area are
  /// dropped, except for bubbles in bodies (see areOfSmallPieces()). From 0, for none, to 1.
  double minimumPieceSize = 0.0;
};

/// The edge of an isopoint, between samples on opposite sides of the isovalue.
struct IsopointEdge : SampleEdge
{
  /// The point on the edge nearest to the isopoint, for its attributes: 0 at `first`, 1 at
  /// `second`.
  double parameter;
};

/// The node indices of an edge's two leaves.
struct EdgeLeaves
{
  std::size_t first;
  std::size_t second;
};

/// The lower tree index of the edge's leaves. The rank that owns it owns the isopoint.
template <class TSample>
std::size_t lowerTreeIndex(const SampleTree<TSample>& tree, const EdgeLeaves& leaves)
{
  return static_cast<std::size_t>(
    std::min(tree.nodes[leaves.first].begin, tree.nodes[leaves.second].begin));
}

/// The isopoints of one isovalue, sorted by their edges (first, second). Each edge occurs once,
/// except in surfaces with caps: there several vertices can have the same edge, and vertices at
/// samples have both ends of their edge there.
struct Isosurface
{
  double isovalue = 0.0;

  /// One edge per isopoint; several for a merged vertex, whose attributes are means over them.
  std::vector<IsopointEdge> edges;
  std::vector<EdgeLeaves> leaves; // of the same edges; only for use inside the core
  /// The offsets of the isopoints' edges, and the end of the last ones; empty if each has one edge.
  std::vector<std::size_t> edgeBegins;

  // One entry per isopoint:
  std::vector<Vector> positions;       // at the zero of the fit, if requested
  std::vector<Vector> decreasingEdges; // from the end not below the isovalue to the other

  std::vector<LocalFit> fits; // or empty if none were requested

  std::vector<CoincidentSamples> coincident; // groups at the ends of edges, by lowest id

  std::size_t droppedEdges = 0; // crossing edges in gaps

  std::size_t size() const
  {
    return this->edgeBegins.empty() ? this->edges.size() : this->edgeBegins.size() - 1;
  }

  /// The offset of an isopoint's edges; for size(), the end.
  std::size_t edgeBegin(std::size_t isopoint) const
  {
    return this->edgeBegins.empty() ? isopoint : this->edgeBegins[isopoint];
  }

  /// The edge of an isopoint; of a merged vertex, the edge that is crossed nearest to it.
  const IsopointEdge& edgeOf(std::size_t isopoint) const
  {
    return this->edges[this->edgeBegin(isopoint)];
  }

  /// The samples that coincide with that of this id, or null. O(log coincident.size())
  const CoincidentSamples* coincidentAt(std::uint64_t id) const
  {
    const auto found = std::lower_bound(this->coincident.begin(), this->coincident.end(), id,
      [](const CoincidentSamples& group, std::uint64_t wanted)
      { return group.ids.front() < wanted; });
    return found != this->coincident.end() && found->ids.front() == id ? &*found : nullptr;
  }
};

/// The isopoints of some indices, in their order, without coincident samples.
/// @throws std::bad_alloc, Aborted
inline Isosurface chosenIsopoints(
  const Execution& execution, const Isosurface& surface, const std::vector<std::size_t>& indices)
{
  Isosurface few;
  few.isovalue = surface.isovalue;
  std::vector<std::size_t> edges;
  few.edgeBegins = chosenLists(execution, surface.edgeBegins, indices, edges);
  few.edges = chosenOf(execution, surface.edges, few.edgeBegins.empty() ? indices : edges);
  few.leaves = chosenOf(execution, surface.leaves, few.edgeBegins.empty() ? indices : edges);
  few.positions = chosenOf(execution, surface.positions, indices);
  few.decreasingEdges = chosenOf(execution, surface.decreasingEdges, indices);
  few.fits = chosenOf(execution, surface.fits, indices);
  return few;
}

/// The coincident samples at ends of edges, by lowest id. @throws std::bad_alloc, Aborted
template <class TSample>
std::vector<CoincidentSamples> coincidentEnds(
  const Execution& execution, const SampleTree<TSample>& tree, const std::vector<EdgeLeaves>& edges)
{
  std::vector<std::size_t> leaves = collectedFromEach<std::size_t>(execution, edges.size(),
    [&](std::size_t i, std::vector<std::size_t>& found)
    {
      for (const std::size_t leaf : { edges[i].first, edges[i].second })
      {
        if (tree.nodes[leaf].count() > 1)
        {
          found.push_back(leaf);
        }
      }
    });
  leaves = sortedUnique(execution, leaves, tree.nodes.size());
  std::vector<CoincidentSamples> result(leaves.size());
  forEachIndex(execution, leaves.size(),
    [&](std::size_t group)
    {
      const Node<TSample>& leaf = tree.nodes[leaves[group]];
      for (std::size_t i = leaf.begin; i < leaf.end; ++i)
      {
        result[group].ids.push_back(tree.samples[i].id);
      }
      result[group].haveOneValue = leaf.minimum == leaf.maximum;
    });
  std::sort(result.begin(), result.end(),
    [](const CoincidentSamples& a, const CoincidentSamples& b)
    { return a.ids.front() < b.ids.front(); });
  return result;
}

/// An attribute of samples at the ends of edges; the mean for coincident ones, computed once.
template <class AttributeAt>
class CoincidentAttribute
{
public:
  /// @param attributeAt(id) the attribute of one sample, as a double
  CoincidentAttribute(const Isosurface& surface, const AttributeAt& attributeAt)
    : Surface(surface)
    , AttributeOf(attributeAt)
  {
    this->Means.reserve(surface.coincident.size());
    for (const CoincidentSamples& group : surface.coincident)
    {
      this->Means.push_back(meanOf(group.ids.size(),
        [&](std::size_t i) { return static_cast<double>(this->AttributeOf(group.ids[i])); }));
    }
  }

  /// O(log coincident samples)
  double operator()(std::uint64_t id) const
  {
    const CoincidentSamples* const group = this->Surface.coincidentAt(id);
    return group ? this->Means[static_cast<std::size_t>(group - this->Surface.coincident.data())]
                 : this->AttributeOf(id);
  }

private:
  const Isosurface& Surface;
  AttributeAt AttributeOf;
  std::vector<double> Means; // of the surface's groups
};

} // namespace isopoint
