// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Isosurface_h
#define isopoint_Isosurface_h

#include "Core/Base/Collected.h"
#include "Core/Base/Execution.h"
#include "Core/Base/SortUnique.h"
#include "Core/Base/Vector.h"
#include "Core/Fit/LocalFit.h"
#include "Core/Neighbors/AngleCriterion.h"
#include "Core/Tree/CoincidentSamples.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace isopoint
{

/// An edge between two samples, by which edges are ordered.
struct SampleEdge
{
  std::uint64_t first;  // the id of one sample
  std::uint64_t second; // the id of the other, first < second

  bool operator==(const SampleEdge& other) const
  {
    return this->first == other.first && this->second == other.second;
  }
  bool operator<(const SampleEdge& other) const
  {
    return this->first != other.first ? this->first < other.first : this->second < other.second;
  }
};

/// An edge between the samples of two leaves on either side of the isovalue.
template <class TSample>
struct CrossingEdge : SampleEdge
{
  double crossing; // where linear interpolation has the isovalue: 0 at `first`, 1 at `second`
  typename TSample::Id firstLeaf; // node indices
  typename TSample::Id secondLeaf;
};

/// The leaves at the ends of edges, ordered, each once.
template <class TSample>
std::vector<std::size_t> leavesOf(const std::vector<CrossingEdge<TSample>>& edges)
{
  std::vector<std::size_t> leaves;
  leaves.reserve(2 * edges.size());
  for (const CrossingEdge<TSample>& edge : edges)
  {
    leaves.push_back(static_cast<std::size_t>(edge.firstLeaf));
    leaves.push_back(static_cast<std::size_t>(edge.secondLeaf));
  }
  keepUnique(leaves);
  return leaves;
}

/// The isovalue, the criteria by which edges are chosen, and what is fitted around them.
struct IsosurfaceRequest
{
  double isovalue;             // any; there are isopoints where samples lie on either side of it
  double angle = defaultAngle; // of the angle criterion, in degrees, 0 up to 180
  bool dropsGaps = false;      // whether what lies in gaps of the cloud is left out
  std::optional<FitRequest> fit = std::nullopt;
  /// Of triangles: whether the samples near the surface stay tetrahedrized for the next extraction,
  /// unless they are many (see Band).
  bool keepsBand = true;
  /// Of triangles with creases: whether vertices are repeated on each side of a crease, so that
  /// each has one normal.
  bool partsCreases = false;
  /// Of triangles: whether vertices are merged, and edges flipped, to well-shaped triangles; see
  /// docs/triangles.md.
  bool regularizes = false;
};

/// The edge of an isopoint, between two samples on either side of the isovalue.
struct IsopointEdge : SampleEdge
{
  /// The place on the edge that is nearest to the isopoint: 0 at `first`, 1 at `second`. All
  /// attributes are interpolated there.
  double parameter;
};

/// The node indices of the two leaves that an edge connects.
struct EdgeLeaves
{
  std::size_t first;
  std::size_t second;
};

/// The place in the order of the tree of the leaf that comes first there: the rank that has it is
/// the one to which the isopoint of the edge belongs.
template <class TSample>
std::size_t firstPlaceOf(const SampleTree<TSample>& tree, const EdgeLeaves& leaves)
{
  return static_cast<std::size_t>(
    std::min(tree.nodes[leaves.first].begin, tree.nodes[leaves.second].begin));
}

/// The isopoints of one isovalue, ordered by the ends (first, second) of their edges, each edge
/// once.
struct Isosurface
{
  double isovalue = 0.0;

  /// One edge of each isopoint; of a vertex that several have become, all of theirs, one list after
  /// the other. All attributes are means over these edges.
  std::vector<IsopointEdge> edges;
  std::vector<EdgeLeaves> leaves; // of the same edges; do not leave the core
  /// Where the edges of each isopoint begin, and the end of the last ones; empty where each has
  /// one.
  std::vector<std::size_t> edgeBegins;

  // One entry for each isopoint.
  std::vector<Vector> positions;       // moved to the zero of the fit, where that was requested
  std::vector<Vector> decreasingEdges; // from the end not below the isovalue to the one that is

  std::vector<LocalFit> fits; // one for each isopoint, or empty if none were requested

  std::vector<CoincidentSamples> coincident; // all at ends of the edges, and others; by lowest id

  std::size_t droppedEdges = 0; // crossing ones that lie in gaps

  std::size_t size() const
  {
    return this->edgeBegins.empty() ? this->edges.size() : this->edgeBegins.size() - 1;
  }

  /// Where the edges of an isopoint begin. That of the isopoint behind the last one is the end.
  std::size_t edgeBegin(std::size_t isopoint) const
  {
    return this->edgeBegins.empty() ? isopoint : this->edgeBegins[isopoint];
  }

  /// The edge of an isopoint; of several, the one that is crossed nearest to it.
  const IsopointEdge& edgeOf(std::size_t isopoint) const
  {
    return this->edges[this->edgeBegin(isopoint)];
  }

  /// The samples that coincide with the one of this id, or null if it is alone.
  /// O(log coincident.size())
  const CoincidentSamples* coincidentAt(std::uint64_t id) const
  {
    const auto found = std::lower_bound(this->coincident.begin(), this->coincident.end(), id,
      [](const CoincidentSamples& group, std::uint64_t wanted)
      { return group.ids.front() < wanted; });
    return found != this->coincident.end() && found->ids.front() == id ? &*found : nullptr;
  }
};

/// The elements of some indices, in their order. @throws std::bad_alloc
/// @param all if it is empty, so is the result, whatever the indices
template <class T>
std::vector<T> chosenOf(
  const Execution& execution, const std::vector<T>& all, const std::vector<std::size_t>& indices)
{
  if (all.empty())
  {
    return {};
  }
  std::vector<T> chosen(indices.size());
  forEachIndex(execution, indices.size(), [&](std::size_t i) { chosen[i] = all[indices[i]]; });
  return chosen;
}

/// Chooses lists that follow each other, by their indices.
/// @param begins of all lists, and the end of the last one; if it is empty, so is the result
/// @param elements set to the elements of the chosen lists
/// @returns where the chosen lists begin, and the end of the last one
inline std::vector<std::size_t> chosenLists(const std::vector<std::size_t>& begins,
  const std::vector<std::size_t>& indices, std::vector<std::size_t>& elements)
{
  if (begins.empty())
  {
    return {};
  }
  std::vector<std::size_t> chosen(1, 0);
  chosen.reserve(indices.size() + 1);
  for (const std::size_t index : indices)
  {
    for (std::size_t element = begins[index]; element < begins[index + 1]; ++element)
    {
      elements.push_back(element);
    }
    chosen.push_back(elements.size());
  }
  return chosen;
}

/// The isopoints of some indices of a surface, in their order, without coincident samples.
inline Isosurface chosenIsopoints(
  const Execution& execution, const Isosurface& surface, const std::vector<std::size_t>& indices)
{
  Isosurface few;
  few.isovalue = surface.isovalue;
  std::vector<std::size_t> edges;
  few.edgeBegins = chosenLists(surface.edgeBegins, indices, edges);
  few.edges = chosenOf(execution, surface.edges, few.edgeBegins.empty() ? indices : edges);
  few.leaves = chosenOf(execution, surface.leaves, few.edgeBegins.empty() ? indices : edges);
  few.positions = chosenOf(execution, surface.positions, indices);
  few.decreasingEdges = chosenOf(execution, surface.decreasingEdges, indices);
  few.fits = chosenOf(execution, surface.fits, indices);
  return few;
}

/// The coincident samples among the ends of edges, by lowest id. @throws std::bad_alloc, Aborted
template <class TSample>
std::vector<CoincidentSamples> coincidentEnds(
  const Execution& execution, const SampleTree<TSample>& tree, const std::vector<EdgeLeaves>& edges)
{
  constexpr std::size_t grain = 4096;
  std::vector<std::size_t> leaves =
    collected<std::size_t>(execution, { edges.size(), 64 * grain, grain },
      [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& found)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          for (const std::size_t leaf : { edges[i].first, edges[i].second })
          {
            if (tree.nodes[leaf].count() > 1)
            {
              found.push_back(leaf);
            }
          }
        }
      });
  keepUnique(leaves);
  std::vector<CoincidentSamples> result;
  for (const std::size_t leaf : leaves)
  {
    CoincidentSamples group;
    for (std::size_t i = tree.nodes[leaf].begin; i < tree.nodes[leaf].end; ++i)
    {
      group.ids.push_back(tree.samples[i].id);
    }
    result.push_back(std::move(group));
  }
  std::sort(result.begin(), result.end(),
    [](const CoincidentSamples& a, const CoincidentSamples& b)
    { return a.ids.front() < b.ids.front(); });
  return result;
}

/// An attribute of the samples at the ends of a surface's edges: their own or, of coincident
/// samples, the mean, computed once for each surface.
template <class AttributeAt>
class CoincidentAttribute
{
public:
  /// @param attributeAt(id) the attribute of one sample, as a double
  CoincidentAttribute(const Isosurface& surface, const AttributeAt& attributeAt)
    : Surface(surface)
    , Own(attributeAt)
  {
    this->Means.reserve(surface.coincident.size());
    for (const CoincidentSamples& group : surface.coincident)
    {
      this->Means.push_back(meanOf(group.ids.size(),
        [&](std::size_t i) { return static_cast<double>(this->Own(group.ids[i])); }));
    }
  }

  /// O(log coincident samples)
  double operator()(std::uint64_t id) const
  {
    const CoincidentSamples* const group = this->Surface.coincidentAt(id);
    return group ? this->Means[static_cast<std::size_t>(group - this->Surface.coincident.data())]
                 : this->Own(id);
  }

private:
  const Isosurface& Surface;
  AttributeAt Own;
  std::vector<double> Means; // of the surface's groups
};

} // namespace isopoint

#endif
