// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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

/// A surface while it is given creases.
struct CreaseSurface
{
  /// @param vertices with fits
  /// @throws std::bad_alloc, Aborted
  CreaseSurface(const Execution& execution, Isosurface& vertices);

  const LocalFit& fitOf(std::size_t vertex) const { return this->surface.fits[vertex]; }
  bool isFitted(std::size_t vertex) const { return this->fitOf(vertex).order.has_value(); }
  bool isCrease(std::size_t vertex) const { return this->fitOf(vertex).order == FitOrder::Crease; }

  /// Whether the normals of two vertices allow them to be on the same piece.
  bool isAlike(std::size_t a, std::size_t b) const
  {
    return dot(this->normals[a], this->normals[b]) >= maxCreaseCosine;
  }

  Vector normalOf(std::initializer_list<std::size_t> vertices) const;

  /// A triangle oriented like its vertices.
  Facet facetOf(const SurfaceTriangle& corners) const
  {
    return { corners, this->normalOf({ corners[0], corners[1], corners[2] }) };
  }

  /// Appends a vertex and copies an edge to it. @returns its number
  /// @param like the vertex whose edge is copied
  /// @param around vertices whose mean normal it gets
  std::size_t addVertex(
    std::size_t like, const Vector& position, std::initializer_list<std::size_t> around);
  std::size_t addVertex(
    std::size_t like, const Vector& position, const Vector& normal, double slope);

  Isosurface& surface;
  std::vector<Vector> normals; // to decreasing values
  std::vector<bool> isInner;   // whether all triangles around a vertex are facets
};

/// Marks the vertices of triangles at which fits found a crease. O(triangles)
/// @param fits of all vertices
/// @throws std::bad_alloc, Aborted
std::vector<char> areAtCreases(const Execution& execution, const std::vector<LocalFit>& fits,
  const std::vector<SurfaceTriangle>& triangles);

/// Adds the sharp edges and corners that fits with creases found, as extended marching cubes does
/// [KBSS01]: edges between different pieces get a vertex on the crease, triangles on three pieces
/// get one at the corner. Vertices near creases without a fit are merged with a neighbor, and edges
/// of inverted triangles are flipped. A closed surface stays closed. See docs/triangles.md.
/// @param surface with fits; new vertices are appended with a copied edge, unused ones dropped
/// @param triangles of its vertices, ordered
/// @param request whether to duplicate vertices for each piece, and whether to collapse short edges
/// @throws std::bad_alloc, Aborted
/// Complexity: O(triangles), and O(n log n) for those near creases
void meshCreases(const Execution& execution, Isosurface& surface,
  std::vector<SurfaceTriangle>& triangles, const IsosurfaceRequest& request);

/// Splits facets at the creases and corners between the pieces that fits found. Vertices on no
/// known piece are merged with neighbors. See docs/triangles.md. O(n log n)
/// @param whole new vertices are appended
/// @returns the facets, each on one piece and with its normal
/// @throws std::bad_alloc, Aborted
std::vector<Facet> splitAtCreases(
  const Execution& execution, CreaseSurface& whole, const std::vector<Facet>& facets);

} // namespace isopoint
