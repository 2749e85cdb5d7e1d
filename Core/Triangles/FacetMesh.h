// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Triangles/SurfaceMesh.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// A triangle with the normal that it should have.
struct Facet
{
  SurfaceTriangle corners;
  Vector normal;
};

/// A mesh of facets whose edges are flipped and collapsed next to creases. A closed surface stays
/// closed. Results depend only on the facets and their order.
class FacetMesh
{
public:
  /// @param execution, positions of all vertices, isInner owned by the caller
  /// @param isInner for each vertex, whether all triangles around it are facets
  /// @throws std::bad_alloc, Aborted
  FacetMesh(const Execution& execution, const std::vector<Vector>& positions,
    const std::vector<bool>& isInner, const std::vector<Facet>& facets);

  const SurfaceMesh& connectivity() const { return this->Mesh; }

  /// Flips edges between facets with similar normals while this reduces the inverted area.
  /// Complexity: O(facets), mostly
  /// @throws std::bad_alloc, Aborted
  void untangle();

  /// Moves a vertex onto a neighbor across an inner edge of two facets, and drops the facets
  /// between them.
  /// @param isAllowed(facet) for each facet that changes, with its new corners
  /// @returns whether it did
  template <class IsAllowed>
  bool collapse(std::size_t vertex, std::size_t neighbor, const IsAllowed& isAllowed)
  {
    const HalfEdge side = this->sideToCollapse(vertex, neighbor);
    const bool isForbidden =
      side == noHalfEdge || this->Mesh.outgoing().anyAt(vertex,
                              [&](HalfEdge each)
                              {
                                Facet moved = this->facet(each / 3);
                                const bool isDropped =
                                  each == side || lastOf(each) == this->Mesh.twinOf(side);
                                moved.corners[each % 3] = neighbor;
                                return !isDropped && !isAllowed(moved);
                              });
    if (!isForbidden)
    {
      this->Mesh.collapse(side);
    }
    return !isForbidden;
  }

  /// Ascending. @throws std::bad_alloc, Aborted
  std::vector<std::size_t> invertedFacets() const;

  Facet facet(std::size_t index) const
  {
    return { this->Mesh.triangles()[index], this->Normals[index] };
  }

  /// Whether a facet still exists and is inverted.
  bool isInverted(std::size_t index) const
  {
    return !this->Mesh.isRemoved(index) && this->signedArea(this->facet(index)) < 0.0;
  }

  /// Twice the area of a facet, negative if it is inverted.
  double signedArea(const Facet& facet) const;

  /// Twice the area of the inverted facets around a vertex.
  double invertedAreaAround(std::size_t vertex) const;

  /// The remaining facets. @throws std::bad_alloc, Aborted
  std::vector<Facet> facets() const;

private:
  /// Flips the edge of a facet that leaves the least inverted area, if that is less than before.
  /// @returns the other facet
  std::optional<std::size_t> flipBest(std::size_t facet);

  double invertedArea(
    const SurfaceTriangle& a, const SurfaceTriangle& b, const Vector& normal) const;

  /// The side from a vertex to a neighbor if the mesh stays manifold when it collapses, or
  /// noHalfEdge.
  HalfEdge sideToCollapse(std::size_t vertex, std::size_t neighbor) const;

  const Execution& Run;
  const std::vector<Vector>& Positions;
  const std::vector<bool>& IsInner;
  SurfaceMesh Mesh;
  std::vector<Vector> Normals; // of facets
};

} // namespace isopoint
