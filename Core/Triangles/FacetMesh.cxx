// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/FacetMesh.h"

#include "Core/Base/Lists.h"
#include "Core/Base/Sorting.h"
#include "Core/Fit/LocalFit.h"

#include <algorithm>
#include <iterator>

namespace isopoint
{

FacetMesh::FacetMesh(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<bool>& isInner, const std::vector<Facet>& facets)
  : Run(execution)
  , Positions(positions)
  , IsInner(isInner)
  , Mesh(execution,
      tabulated<SurfaceTriangle>(
        execution, facets.size(), [&](std::size_t i) { return facets[i].corners; }),
      positions.size())
  , Normals(
      tabulated<Vector>(execution, facets.size(), [&](std::size_t i) { return facets[i].normal; }))
{
}

double FacetMesh::signedArea(const Facet& facet) const
{
  return dot(facet.normal, areaNormal(this->Positions, facet.corners));
}

double FacetMesh::invertedArea(
  const SurfaceTriangle& a, const SurfaceTriangle& b, const Vector& normal) const
{
  return std::max(0.0, -this->signedArea({ a, normal })) +
         std::max(0.0, -this->signedArea({ b, normal }));
}

std::vector<std::size_t> FacetMesh::invertedFacets() const
{
  return itemsThat(
    this->Run, this->Normals.size(), [this](std::size_t i) { return this->isInverted(i); });
}

void FacetMesh::untangle()
{
  constexpr int maxRounds = 20;
  std::vector<std::size_t> inverted = this->invertedFacets();
  for (int round = 0; round < maxRounds && !inverted.empty(); ++round)
  {
    std::vector<std::size_t> changed;
    bool isAnyFlipped = false;
    forEachInOrder(this->Run, inverted.size(),
      [&](std::size_t i)
      {
        const std::size_t facet = inverted[i];
        if (this->isInverted(facet))
        {
          changed.push_back(facet);
          if (const std::optional<std::size_t> other = this->flipBest(facet))
          {
            changed.push_back(*other);
            isAnyFlipped = true;
          }
        }
      });
    inverted = isAnyFlipped ? sortedUnique(this->Run, changed, this->Normals.size())
                            : std::vector<std::size_t>();
  }
}

std::optional<std::size_t> FacetMesh::flipBest(std::size_t facet)
{
  double most = 0.0;
  HalfEdge chosen = noHalfEdge;
  Vector chosenNormal{};
  for (HalfEdge side = 3 * facet; side < 3 * facet + 3; ++side)
  {
    const HalfEdge twin = this->Mesh.twinOf(side);
    const std::size_t a = this->Mesh.startOf(side);
    const std::size_t b = this->Mesh.endOf(side);
    const std::size_t c = this->Mesh.oppositeOf(side);
    if (twin == noHalfEdge || !this->IsInner[a] || !this->IsInner[b] || !this->IsInner[c] ||
        dot(this->Normals[facet], this->Normals[twin / 3]) < maxCreaseCosine)
    {
      continue;
    }
    const std::size_t d = this->Mesh.oppositeOf(twin);
    if (d == c || !this->IsInner[d] || this->Mesh.hasEdge(c, d)) // d == c: back to back
    {
      continue;
    }
    const Vector normal = directionOf(this->Normals[facet] + this->Normals[twin / 3]);
    const std::vector<SurfaceTriangle>& former = this->Mesh.triangles();
    const double gain = this->invertedArea(former[facet], former[twin / 3], normal) -
                        this->invertedArea({ a, d, c }, { d, b, c }, normal);
    if (gain > most)
    {
      most = gain;
      chosen = side;
      chosenNormal = normal;
    }
  }
  if (chosen == noHalfEdge)
  {
    return std::nullopt;
  }
  const std::size_t other = this->Mesh.twinOf(chosen) / 3;
  this->Mesh.flip(chosen);
  this->Mesh.rotateCorners(facet);
  this->Normals[facet] = this->Normals[other] = chosenNormal;
  return other;
}

HalfEdge FacetMesh::sideToCollapse(std::size_t vertex, std::size_t neighbor) const
{
  const HalfEdge side = this->Mesh.halfEdgeBetween(vertex, neighbor);
  if (!this->IsInner[vertex] || !this->IsInner[neighbor] || side == noHalfEdge ||
      this->Mesh.twinOf(side) == noHalfEdge)
  {
    return noHalfEdge;
  }
  const std::vector<std::size_t> own = this->Mesh.neighborsOf(vertex);
  const std::vector<std::size_t> others = this->Mesh.neighborsOf(neighbor);
  std::vector<std::size_t> common;
  std::set_intersection(
    own.begin(), own.end(), others.begin(), others.end(), std::back_inserter(common));
  return common.size() == 2 && own.size() >= 4 && !this->Mesh.isOpen(vertex) ? side : noHalfEdge;
}

double FacetMesh::invertedAreaAround(std::size_t vertex) const
{
  double area = 0.0;
  this->Mesh.outgoing().forEachAt(vertex,
    [&](HalfEdge side) { area += std::max(0.0, -this->signedArea(this->facet(side / 3))); });
  return area;
}

std::vector<Facet> FacetMesh::facets() const
{
  const std::vector<std::size_t> left = itemsThat(
    this->Run, this->Normals.size(), [this](std::size_t i) { return !this->Mesh.isRemoved(i); });
  return tabulated<Facet>(
    this->Run, left.size(), [&](std::size_t i) { return this->facet(left[i]); });
}

} // namespace isopoint
