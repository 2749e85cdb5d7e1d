// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

namespace isopoint
{

/// A triangle with the normal that it should have.
struct Facet
{
  SurfaceTriangle corners;
  Vector normal;
};

/// Triangles whose edges can be flipped and collapsed. A closed surface stays closed. Results
/// depend only on the facets and their order.
class FacetMesh
{
public:
  /// @param execution, positions of all vertices, isInner owned by the caller
  /// @param isInner for each vertex, whether all triangles around it are facets
  /// @throws std::bad_alloc, Aborted
  FacetMesh(const Execution& execution, const std::vector<Vector>& positions,
    const std::vector<bool>& isInner, std::vector<Facet> facets);

  /// Flips edges between facets with similar normals while this reduces the inverted area.
  /// Complexity: O(facets), mostly
  /// @throws std::bad_alloc, Aborted
  void untangle();

  /// Moves a vertex onto a neighbor across an inner, manifold edge, and drops the facets between
  /// them.
  /// @param isAllowed(facet) for each facet that changes, with its new corners
  /// @returns whether it did
  template <class IsAllowed>
  bool collapse(std::size_t vertex, std::size_t neighbor, const IsAllowed& isAllowed)
  {
    const std::optional<std::vector<std::size_t>> kept = this->facetsToMove(vertex, neighbor);
    if (!kept)
    {
      return false;
    }
    for (const std::size_t facet : *kept)
    {
      Facet moved = this->Facets[facet];
      replace(moved.corners, vertex, neighbor);
      if (!isAllowed(moved))
      {
        return false;
      }
    }
    this->move(vertex, neighbor, *kept);
    return true;
  }

  /// In ascending order.
  std::vector<std::size_t> neighborsOf(std::size_t vertex) const;

  /// Ascending. @throws std::bad_alloc, Aborted
  std::vector<std::size_t> invertedFacets() const;

  /// The facet with a directed edge, if there is exactly one.
  std::optional<std::size_t> facetAt(std::size_t a, std::size_t b) const;

  const std::vector<std::size_t>& facetsAround(std::size_t vertex) const
  {
    return this->FacetsAround.at(vertex);
  }

  const Facet& facet(std::size_t index) const { return this->Facets[index]; }

  /// Whether a facet still exists and is inverted.
  bool isInverted(std::size_t index) const
  {
    return !this->IsRemoved[index] && this->signedArea(this->Facets[index]) < 0.0;
  }

  /// The normal of a triangle, as long as twice its area.
  Vector areaNormal(const SurfaceTriangle& triangle) const;

  /// Twice the area of a facet, negative if it is inverted.
  double signedArea(const Facet& facet) const;

  /// Twice the area of the inverted facets around a vertex.
  double invertedAreaAround(std::size_t vertex) const;

  /// The remaining facets. @throws std::bad_alloc, Aborted
  std::vector<Facet> facets() const;

private:
  using Edge = std::array<std::size_t, 2>; // directed counterclockwise in its facet

  struct EdgeFacet
  {
    std::size_t facet;
    bool isOne; // whether exactly one facet has it
  };

  static void replace(SurfaceTriangle& corners, std::size_t vertex, std::size_t by);

  void connect(std::size_t facet);
  void disconnect(std::size_t facet);

  bool hasEdge(std::size_t a, std::size_t b) const;

  /// Flips the edge of a facet that leaves the least inverted area, if that is less than before.
  /// @returns the other facet
  std::optional<std::size_t> flipBest(std::size_t facet);

  std::optional<std::vector<std::size_t>> facetsToMove(
    std::size_t vertex, std::size_t neighbor) const;
  void move(std::size_t vertex, std::size_t neighbor, const std::vector<std::size_t>& kept);

  double invertedArea(const Facet& a, const Facet& b) const;

  const Execution& Exec;
  const std::vector<Vector>& Positions;
  const std::vector<bool>& IsInner;
  std::vector<Facet> Facets;
  std::vector<bool> IsRemoved;
  std::map<Edge, EdgeFacet> Edges;
  std::unordered_map<std::size_t, std::vector<std::size_t>> FacetsAround; // vertices
};

} // namespace isopoint
