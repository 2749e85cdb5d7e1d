// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CreaseMesh_h
#define isopoint_CreaseMesh_h

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Fit/LocalFit.h"
#include "Core/Triangles/FacetMesh.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <cstddef>
#include <initializer_list>
#include <vector>

namespace isopoint
{

/// The vertices of a surface that is given creases.
struct CreaseSurface
{
  /// @param vertices with fits
  explicit CreaseSurface(Isosurface& vertices);

  const LocalFit& fitOf(std::size_t vertex) const { return this->surface.fits[vertex]; }
  bool isFitted(std::size_t vertex) const { return this->fitOf(vertex).order.has_value(); }
  bool isCrease(std::size_t vertex) const { return this->fitOf(vertex).order == FitOrder::Crease; }

  /// Whether two vertices may be on one piece, by their normals.
  bool isAlike(std::size_t a, std::size_t b) const
  {
    return dot(this->normals[a], this->normals[b]) >= mostCreaseCosine;
  }

  /// The mean of normals.
  Vector normalOf(std::initializer_list<std::size_t> vertices) const;

  /// A triangle that is to look as its vertices do.
  Facet facetOf(const SurfaceTriangle& corners) const
  {
    return { corners, this->normalOf({ corners[0], corners[1], corners[2] }) };
  }

  /// Appends a vertex, which takes over the edge of another one. @returns its number
  /// @param around vertices whose mean normal it has
  std::size_t addVertex(
    std::size_t like, const Vector& place, std::initializer_list<std::size_t> around);
  std::size_t addVertex(std::size_t like, const Vector& place, const Vector& normal, double slope);

  Isosurface& surface;
  std::vector<Vector> normals; // to decreasing values
  std::vector<bool> isInner;   // whether all triangles around a vertex are facets
};

/// Marks the vertices of triangles beside which fits have found a crease.
/// @param fits of all vertices
/// @throws std::bad_alloc
/// Complexity: O(triangles)
std::vector<char> areAtCreases(
  const std::vector<LocalFit>& fits, const std::vector<SurfaceTriangle>& triangles);

/// Gives a surface the sharp edges and corners that fits with creases have found, in the way of
/// extended marching cubes [KBSS01]: edges between vertices on different pieces get a vertex on the
/// crease, triangles on three pieces one at the corner. Vertices beside creases at which no fit
/// holds are merged with a neighbor, and edges are flipped where triangles look the wrong way; a
/// closed surface stays closed. See docs/triangles.md.
/// @param surface with fits; new vertices are appended, and take over the edge of the first vertex
/// of theirs; vertices without triangles are dropped
/// @param triangles of its vertices, ordered
/// @param request whether vertices are repeated for each piece that they are on, and whether those
/// of short edges are merged
/// @throws std::bad_alloc, Aborted
/// Complexity: O(triangles), and O(n log n) of those beside creases
void meshCreases(const Execution& execution, Isosurface& surface,
  std::vector<SurfaceTriangle>& triangles, const IsosurfaceRequest& request);

/// Gives facets vertices on the creases and at the corners between the pieces that fits have found;
/// vertices of which no piece is known are merged with neighbors. See docs/triangles.md.
/// @param whole whose vertices are appended to
/// @returns the facets, each on one piece and with the normal of that
/// @throws std::bad_alloc, Aborted
/// Complexity: O(n log n)
std::vector<Facet> splitAtCreases(
  const Execution& execution, CreaseSurface& whole, std::vector<Facet> facets);

} // namespace isopoint

#endif
