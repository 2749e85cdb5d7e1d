// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CreaseSurface_h
#define isopoint_CreaseSurface_h

#include "Isopoint/Base/Vector.h"
#include "Isopoint/Extraction/Isosurface.h"
#include "Isopoint/Fit/LocalFit.h"
#include "Isopoint/Triangles/FacetMesh.h"
#include "Isopoint/Triangles/SurfaceTriangle.h"

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

} // namespace isopoint

#endif
