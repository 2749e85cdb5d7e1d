// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Triangles/CreaseMesh.h"

#include "Isopoint/Base/SortUnique.h"
#include "Isopoint/Triangles/CreaseSplitting.h"
#include "Isopoint/Triangles/CreaseSurface.h"
#include "Isopoint/Triangles/CreaseUntangling.h"
#include "Isopoint/Triangles/FacetMesh.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

namespace isopoint
{
namespace
{

/// Facets of a vertex whose normals form a smaller cosine, of 20 degrees or more with it, get a
/// copy of it.
constexpr double mostPartedCosine = 0.94;

class CreaseMesher
{
public:
  CreaseMesher(
    const Execution& execution, Isosurface& surface, std::vector<SurfaceTriangle>& triangles)
    : Run(execution)
    , Whole(surface)
    , Triangles(triangles)
  {
  }

  void mesh(bool parts)
  {
    std::vector<Facet> facets = this->takeFacets();
    if (facets.empty())
    {
      return;
    }
    const std::size_t firstOnCrease = this->Whole.surface.size();
    facets = splitAtCreases(this->Run, this->Whole, std::move(facets));
    facets = untangleFacets(this->Run, this->Whole, std::move(facets), firstOnCrease);
    if (parts)
    {
      this->partCreases(facets);
    }
    for (const Facet& facet : facets)
    {
      this->Triangles.push_back(facet.corners);
    }
    this->order();
  }

private:
  /// Takes the triangles beside creases out of the surface, and those around.
  std::vector<Facet> takeFacets()
  {
    std::vector<bool> isNear(this->Whole.surface.size(), false);
    for (std::size_t i = 0; i < isNear.size(); ++i)
    {
      isNear[i] = this->Whole.isCrease(i);
    }
    const auto isAnyNear = [&isNear](const SurfaceTriangle& triangle)
    {
      return std::any_of(
        triangle.begin(), triangle.end(), [&](std::size_t corner) { return isNear[corner]; });
    };
    this->Whole.isInner.assign(isNear.size(), false);
    for (const SurfaceTriangle& triangle : this->Triangles)
    {
      if (isAnyNear(triangle))
      {
        for (const std::size_t corner : triangle)
        {
          this->Whole.isInner[corner] = true;
        }
      }
    }
    isNear = this->Whole.isInner;
    const auto end = std::stable_partition(this->Triangles.begin(), this->Triangles.end(),
      [&](const SurfaceTriangle& triangle) { return !isAnyNear(triangle); });
    std::vector<Facet> facets;
    std::transform(end, this->Triangles.end(), std::back_inserter(facets),
      [this](const SurfaceTriangle& triangle) { return this->Whole.facetOf(triangle); });
    this->Triangles.erase(end, this->Triangles.end());
    return facets;
  }

  /// Repeats the vertices of facets that look to different sides: the copy for a piece has the
  /// normal of the first facet there.
  void partCreases(std::vector<Facet>& facets)
  {
    std::map<std::size_t, std::vector<std::size_t>> copies; // of each vertex
    for (Facet& facet : facets)
    {
      for (std::size_t& corner : facet.corners)
      {
        if (dot(this->Whole.normals[corner], facet.normal) < mostPartedCosine)
        {
          corner = this->copyOf(corner, facet.normal, copies[corner]);
        }
      }
    }
  }

  std::size_t copyOf(std::size_t vertex, const Vector& normal, std::vector<std::size_t>& copies)
  {
    for (const std::size_t copy : copies)
    {
      if (dot(this->Whole.normals[copy], normal) >= mostPartedCosine)
      {
        return copy;
      }
    }
    const Vector place = this->Whole.surface.positions[vertex]; // which adding moves
    copies.push_back(
      this->Whole.addVertex(vertex, place, normal, lengthOf(this->Whole.fitOf(vertex).gradient)));
    return copies.back();
  }

  /// Drops vertices without triangles, and orders the triangles.
  void order()
  {
    constexpr std::size_t unused = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> number(this->Whole.surface.size(), unused);
    for (const SurfaceTriangle& triangle : this->Triangles)
    {
      for (const std::size_t corner : triangle)
      {
        number[corner] = 0;
      }
    }
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < number.size(); ++i)
    {
      if (number[i] != unused)
      {
        number[i] = kept.size();
        kept.push_back(i);
      }
    }
    if (kept.size() < number.size())
    {
      const std::size_t dropped = this->Whole.surface.droppedEdges;
      this->Whole.surface = chosenIsopoints(this->Whole.surface, kept);
      this->Whole.surface.droppedEdges = dropped;
    }
    for (SurfaceTriangle& triangle : this->Triangles)
    {
      triangle = { number[triangle[0]], number[triangle[1]], number[triangle[2]] };
      std::rotate(
        triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    }
    this->Triangles = sortedUnique(this->Run, this->Triangles, kept.size(),
      [](const SurfaceTriangle& triangle) { return static_cast<std::uint64_t>(triangle[0]); });
  }

  const Execution& Run;
  CreaseSurface Whole;
  std::vector<SurfaceTriangle>& Triangles;
};

} // namespace

void meshCreases(const Execution& execution, Isosurface& surface,
  std::vector<SurfaceTriangle>& triangles, bool parts)
{
  CreaseMesher(execution, surface, triangles).mesh(parts);
}

} // namespace isopoint
