// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/CreaseMesh.h"

#include "Core/Base/Lists.h"
#include "Core/Triangles/FacetMesh.h"
#include "Core/Triangles/ShortEdges.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace isopoint
{

CreaseSurface::CreaseSurface(const Execution& execution, Isosurface& vertices)
  : surface(vertices)
  , normals(tabulated<Vector>(execution, vertices.fits.size(),
      [&](std::size_t vertex) { return -directionOf(vertices.fits[vertex].gradient); }))
{
}

Vector CreaseSurface::normalOf(std::initializer_list<std::size_t> vertices) const
{
  Vector all{};
  for (const std::size_t vertex : vertices)
  {
    all += this->normals[vertex];
  }
  return directionOf(all);
}

std::size_t CreaseSurface::addVertex(
  std::size_t like, const Vector& position, std::initializer_list<std::size_t> around)
{
  double slope = 0.0;
  for (const std::size_t each : around)
  {
    slope += lengthOf(this->fitOf(each).gradient) / static_cast<double>(around.size());
  }
  return this->addVertex(like, position, this->normalOf(around), slope);
}

std::size_t CreaseSurface::addVertex(
  std::size_t like, const Vector& position, const Vector& normal, double slope)
{
  const std::size_t vertex = this->surface.size();
  LocalFit fit = this->surface.fits[like];
  fit.position = position;
  fit.gradient = -slope * normal;
  fit.hessian = {};
  fit.isSmooth = false;
  fit.order = FitOrder::Crease;
  fit.creases.clear();
  const std::size_t edge = this->surface.edgeBegin(like);
  this->surface.edges.emplace_back(this->surface.edges[edge]);
  this->surface.leaves.emplace_back(this->surface.leaves[edge]);
  if (!this->surface.edgeBegins.empty())
  {
    this->surface.edgeBegins.push_back(this->surface.edges.size());
  }
  this->surface.positions.push_back(position);
  this->surface.decreasingEdges.emplace_back(this->surface.decreasingEdges[like]);
  this->surface.fits.push_back(std::move(fit));
  this->normals.push_back(normal);
  this->isInner.push_back(true);
  return vertex;
}

namespace
{

/// Facets at a vertex get a copy of it per piece if the normals differ by more than 20 degrees.
constexpr double maxPartedCosine = 0.94;

/// Merges two vertices of an inverted facet if no facet around stays inverted, except for much
/// smaller ones. Vertices on creases stay there. @returns whether it did
bool mergeAt(FacetMesh& mesh, std::size_t inverted, std::size_t firstOnCrease)
{
  const Facet facet = mesh.facet(inverted);
  constexpr double share = 0.1;
  const double least = share * mesh.signedArea(facet);
  for (std::size_t i = 0; i < 6; ++i)
  {
    const std::size_t vertex = facet.corners[i % 3];
    const std::size_t neighbor = facet.corners[(i % 3 + 1 + i / 3) % 3];
    const bool staysOnCrease = vertex < firstOnCrease || neighbor >= firstOnCrease;
    if (staysOnCrease && mesh.collapse(vertex, neighbor,
                           [&](const Facet& moved) { return mesh.signedArea(moved) >= least; }))
    {
      return true;
    }
  }
  return false;
}

/// Moves a vertex of an inverted facet to the middle between its neighbors along the crease, if
/// this reduces the inverted area around it. @returns whether it did
bool slideAt(
  CreaseSurface& whole, const FacetMesh& mesh, std::size_t inverted, std::size_t firstOnCrease)
{
  for (const std::size_t vertex : mesh.facet(inverted).corners)
  {
    std::vector<std::size_t> along = mesh.connectivity().neighborsOf(vertex);
    along.erase(std::remove_if(along.begin(), along.end(),
                  [firstOnCrease](std::size_t neighbor) { return neighbor < firstOnCrease; }),
      along.end());
    if (vertex < firstOnCrease || along.size() != 2)
    {
      continue;
    }
    Vector& position = whole.surface.positions[vertex];
    const Vector former = position;
    const double formerArea = mesh.invertedAreaAround(vertex);
    position = 0.5 * (whole.surface.positions[along[0]] + whole.surface.positions[along[1]]);
    if (mesh.invertedAreaAround(vertex) < formerArea)
    {
      whole.surface.fits[vertex].position = position;
      return true;
    }
    position = former;
  }
  return false;
}

/// Turns inverted facets by edge flips or, if necessary, by merging or moving vertices. A few may
/// remain.
/// @param whole whose vertices on creases may move along them
/// @param firstOnCrease the first vertex on a crease; all following vertices are on creases
/// @throws std::bad_alloc, Aborted
std::vector<Facet> untangleFacets(const Execution& execution, CreaseSurface& whole,
  const std::vector<Facet>& facets, std::size_t firstOnCrease)
{
  FacetMesh mesh(execution, whole.surface.positions, whole.isInner, facets);
  constexpr int maxRounds = 5;
  bool isAnyMerged = true;
  mesh.untangle();
  for (int round = 0; round < maxRounds && isAnyMerged; ++round)
  {
    isAnyMerged = false;
    for (const std::size_t facet : mesh.invertedFacets())
    {
      throwIfAborted(execution);
      if (mesh.isInverted(facet)) // an earlier fix may have turned it
      {
        isAnyMerged = mergeAt(mesh, facet, firstOnCrease) ||
                      slideAt(whole, mesh, facet, firstOnCrease) || isAnyMerged;
      }
    }
    mesh.untangle();
  }
  return mesh.facets();
}

/// Whether a vertex is on all the pieces of another vertex.
bool isOnPiecesOf(const FacetMesh& mesh, std::size_t vertex, std::size_t other)
{
  const auto isOffAll = [&](HalfEdge ofOther)
  {
    const auto isOnPiece = [&](HalfEdge side)
    { return dot(mesh.facet(side / 3).normal, mesh.facet(ofOther / 3).normal) >= maxCreaseCosine; };
    return !mesh.connectivity().outgoing().anyAt(vertex, isOnPiece);
  };
  return !mesh.connectivity().outgoing().anyAt(other, isOffAll);
}

/// Collapses short edges, shortest first, if the facets stay on their pieces.
/// @throws std::bad_alloc, Aborted
std::vector<Facet> withoutShortEdges(
  const Execution& execution, const CreaseSurface& whole, std::vector<Facet> facets)
{
  for (int round = 0; round < shortEdgeRounds; ++round)
  {
    FacetMesh mesh(execution, whole.surface.positions, whole.isInner, facets);
    const auto staysOnPiece = [&](const Facet& moved)
    {
      constexpr double minCosine = 0.95;
      return mesh.signedArea(moved) >=
             minCosine * lengthOf(areaNormal(whole.surface.positions, moved.corners));
    };
    for (const auto& [a, b] : shortEdges(execution, whole.surface.positions, mesh.connectivity()))
    {
      throwIfAborted(execution);
      for (const auto& [from, to] : { std::pair(b, a), std::pair(a, b) })
      {
        if (mesh.connectivity().halfEdgeBetween(from, to) != noHalfEdge &&
            isOnPiecesOf(mesh, to, from) && mesh.collapse(from, to, staysOnPiece))
        {
          break;
        }
      }
    }
    facets = mesh.facets();
  }
  return facets;
}

class CreaseMesher
{
public:
  CreaseMesher(
    const Execution& execution, Isosurface& surface, std::vector<SurfaceTriangle>& triangles)
    : Run(execution)
    , Whole(execution, surface)
    , Triangles(triangles)
  {
  }

  void mesh(const IsosurfaceRequest& request)
  {
    std::vector<Facet> facets = this->takeFacets();
    if (facets.empty())
    {
      return;
    }
    const std::size_t firstOnCrease = this->Whole.surface.size();
    facets = splitAtCreases(this->Run, this->Whole, facets);
    facets = untangleFacets(this->Run, this->Whole, facets, firstOnCrease);
    if (request.regularizes)
    {
      facets = withoutShortEdges(this->Run, this->Whole, std::move(facets));
    }
    if (request.duplicatesCreaseVertices)
    {
      this->partCreases(facets);
    }
    forEachInOrder(this->Run, facets.size(),
      [&](std::size_t i) { this->Triangles.push_back(facets[i].corners); });
    this->order();
  }

private:
  /// Removes the triangles next to creases, and those around them, from the surface.
  std::vector<Facet> takeFacets()
  {
    const std::vector<char> areNear =
      areAtCreases(this->Run, this->Whole.surface.fits, this->Triangles);
    this->Whole.isInner.assign(areNear.begin(), areNear.end());
    const auto isTaken = [&](const SurfaceTriangle& triangle)
    { return areNear[triangle[0]] || areNear[triangle[1]] || areNear[triangle[2]]; };
    const std::vector<SurfaceTriangle> taken = chosenThat(this->Run, this->Triangles, isTaken);
    this->Triangles = chosenThat(this->Run, this->Triangles,
      [&](const SurfaceTriangle& triangle) { return !isTaken(triangle); });
    return tabulated<Facet>(
      this->Run, taken.size(), [&](std::size_t i) { return this->Whole.facetOf(taken[i]); });
  }

  /// Duplicates vertices between pieces. A piece's copy has the normal of its first facet.
  void partCreases(std::vector<Facet>& facets)
  {
    std::map<std::size_t, std::vector<std::size_t>> copies; // of each vertex
    forEachInOrder(this->Run, facets.size(),
      [&](std::size_t i)
      {
        Facet& facet = facets[i];
        for (std::size_t& corner : facet.corners)
        {
          if (dot(this->Whole.normals[corner], facet.normal) < maxPartedCosine)
          {
            corner = this->copyOf(corner, facet.normal, copies[corner]);
          }
        }
      });
  }

  std::size_t copyOf(std::size_t vertex, const Vector& normal, std::vector<std::size_t>& copies)
  {
    for (const std::size_t copy : copies)
    {
      if (dot(this->Whole.normals[copy], normal) >= maxPartedCosine)
      {
        return copy;
      }
    }
    const Vector position = this->Whole.surface.positions[vertex]; // adding reallocates
    copies.push_back(this->Whole.addVertex(
      vertex, position, normal, lengthOf(this->Whole.fitOf(vertex).gradient)));
    return copies.back();
  }

  /// Drops unused vertices, and orders the triangles.
  void order()
  {
    Isosurface& surface = this->Whole.surface;
    const std::vector<std::size_t> kept = verticesOf(this->Run, this->Triangles, surface.size());
    this->Triangles = renumbered(
      this->Run, this->Triangles, inverseOf(this->Run, kept, surface.size()), kept.size());
    if (kept.size() < surface.size())
    {
      surface = chosenIsopoints(this->Run, surface, kept);
    }
  }

  const Execution& Run;
  CreaseSurface Whole;
  std::vector<SurfaceTriangle>& Triangles;
};

} // namespace

std::vector<char> areAtCreases(const Execution& execution, const std::vector<LocalFit>& fits,
  const std::vector<SurfaceTriangle>& triangles)
{
  const auto isAtCrease = [&](const SurfaceTriangle& triangle)
  {
    return std::any_of(triangle.begin(), triangle.end(),
      [&](std::size_t corner) { return fits[corner].order == FitOrder::Crease; });
  };
  return areVerticesOf(execution, chosenThat(execution, triangles, isAtCrease), fits.size());
}

void meshCreases(const Execution& execution, Isosurface& surface,
  std::vector<SurfaceTriangle>& triangles, const IsosurfaceRequest& request)
{
  CreaseMesher(execution, surface, triangles).mesh(request);
}

} // namespace isopoint
