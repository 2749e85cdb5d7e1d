// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/FacetMesh.h"

#include "Core/Base/Lists.h"
#include "Core/Fit/LocalFit.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace isopoint
{

FacetMesh::FacetMesh(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<bool>& isInner, std::vector<Facet> facets)
  : Exec(execution)
  , Positions(positions)
  , IsInner(isInner)
  , Facets(std::move(facets))
  , IsRemoved(this->Facets.size(), false)
{
  forEachInOrder(this->Exec, this->Facets.size(), [this](std::size_t i) { this->connect(i); });
}

void FacetMesh::replace(SurfaceTriangle& corners, std::size_t vertex, std::size_t by)
{
  std::replace(corners.begin(), corners.end(), vertex, by);
}

void FacetMesh::connect(std::size_t facet)
{
  const SurfaceTriangle& corners = this->Facets[facet].corners;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto [found, isNew] =
      this->Edges.insert({ { corners[i], corners[(i + 1) % 3] }, { facet, true } });
    found->second.isOne = isNew;
    this->FacetsAround[corners[i]].push_back(facet);
  }
}

void FacetMesh::disconnect(std::size_t facet)
{
  const SurfaceTriangle& corners = this->Facets[facet].corners;
  for (std::size_t i = 0; i < 3; ++i)
  {
    // Nonmanifold edges are neither flipped nor collapsed.
    const auto found = this->Edges.find({ corners[i], corners[(i + 1) % 3] });
    if (found->second.isOne)
    {
      this->Edges.erase(found);
    }
    std::vector<std::size_t>& around = this->FacetsAround[corners[i]];
    around.erase(std::find(around.begin(), around.end(), facet));
  }
}

std::optional<std::size_t> FacetMesh::facetAt(std::size_t a, std::size_t b) const
{
  const auto found = this->Edges.find({ a, b });
  return found != this->Edges.end() && found->second.isOne ? std::optional(found->second.facet)
                                                           : std::nullopt;
}

bool FacetMesh::hasEdge(std::size_t a, std::size_t b) const
{
  return this->Edges.count({ a, b }) > 0 || this->Edges.count({ b, a }) > 0;
}

Vector FacetMesh::areaNormal(const SurfaceTriangle& triangle) const
{
  const auto& [a, b, c] = triangle;
  return cross(this->Positions[b] - this->Positions[a], this->Positions[c] - this->Positions[a]);
}

double FacetMesh::signedArea(const Facet& facet) const
{
  return dot(facet.normal, this->areaNormal(facet.corners));
}

double FacetMesh::invertedArea(const Facet& a, const Facet& b) const
{
  return std::max(0.0, -this->signedArea(a)) + std::max(0.0, -this->signedArea(b));
}

std::vector<std::size_t> FacetMesh::invertedFacets() const
{
  return itemsThat(
    this->Exec, this->Facets.size(), [this](std::size_t i) { return this->isInverted(i); });
}

void FacetMesh::untangle()
{
  constexpr int maxRounds = 20;
  std::vector<std::size_t> inverted = this->invertedFacets();
  for (int round = 0; round < maxRounds && !inverted.empty(); ++round)
  {
    std::vector<std::size_t> changed;
    bool isAnyFlipped = false;
    forEachInOrder(this->Exec, inverted.size(),
      [&](std::size_t i)
      {
        const std::size_t facet = inverted[i];
        if (this->signedArea(this->Facets[facet]) < 0.0)
        {
          changed.push_back(facet);
          if (const std::optional<std::size_t> other = this->flipBest(facet))
          {
            changed.push_back(*other);
            isAnyFlipped = true;
          }
        }
      });
    inverted = isAnyFlipped ? sortedUnique(this->Exec, changed, this->Facets.size())
                            : std::vector<std::size_t>();
  }
}

std::optional<std::size_t> FacetMesh::flipBest(std::size_t facet)
{
  const Facet own = this->Facets[facet];
  double most = 0.0;
  std::optional<std::size_t> chosen;
  Facet first{};
  Facet second{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::size_t a = own.corners[i];
    const std::size_t b = own.corners[(i + 1) % 3];
    const std::size_t c = own.corners[(i + 2) % 3];
    const std::optional<std::size_t> other = this->facetAt(b, a);
    if (!other || !this->facetAt(a, b) || !this->IsInner[a] || !this->IsInner[b] ||
        !this->IsInner[c] || dot(own.normal, this->Facets[*other].normal) < maxCreaseCosine)
    {
      continue;
    }
    const SurfaceTriangle& corners = this->Facets[*other].corners;
    const std::size_t d = *std::find_if(corners.begin(), corners.end(),
      [a, b](std::size_t corner) { return corner != a && corner != b; });
    if (d == c || !this->IsInner[d] || this->hasEdge(c, d)) // d == c: back to back
    {
      continue;
    }
    const Vector normal = directionOf(own.normal + this->Facets[*other].normal);
    const Facet former[2] = { { own.corners, normal }, { corners, normal } };
    const Facet flipped[2] = { { { a, d, c }, normal }, { { d, b, c }, normal } };
    const double gain =
      this->invertedArea(former[0], former[1]) - this->invertedArea(flipped[0], flipped[1]);
    if (gain > most)
    {
      most = gain;
      chosen = other;
      first = flipped[0];
      second = flipped[1];
    }
  }
  if (chosen)
  {
    this->disconnect(facet);
    this->disconnect(*chosen);
    this->Facets[facet] = first;
    this->Facets[*chosen] = second;
    this->connect(facet);
    this->connect(*chosen);
  }
  return chosen;
}

std::vector<std::size_t> FacetMesh::neighborsOf(std::size_t vertex) const
{
  std::vector<std::size_t> neighbors;
  const auto around = this->FacetsAround.find(vertex);
  if (around == this->FacetsAround.end())
  {
    return neighbors;
  }
  for (const std::size_t facet : around->second)
  {
    for (const std::size_t corner : this->Facets[facet].corners)
    {
      if (corner != vertex)
      {
        neighbors.push_back(corner);
      }
    }
  }
  keepUnique(neighbors);
  return neighbors;
}

/// The facets that remain when the edge from a vertex to a neighbor collapses; nothing if the mesh
/// would not stay manifold.
std::optional<std::vector<std::size_t>> FacetMesh::facetsToMove(
  std::size_t vertex, std::size_t neighbor) const
{
  if (!this->IsInner[vertex] || !this->IsInner[neighbor] || !this->facetAt(vertex, neighbor) ||
      !this->facetAt(neighbor, vertex))
  {
    return std::nullopt;
  }
  const std::vector<std::size_t> own = this->neighborsOf(vertex);
  const std::vector<std::size_t> others = this->neighborsOf(neighbor);
  std::vector<std::size_t> common;
  std::set_intersection(
    own.begin(), own.end(), others.begin(), others.end(), std::back_inserter(common));
  const bool isClosed = std::all_of(own.begin(), own.end(),
    [&](std::size_t each) { return this->facetAt(vertex, each) && this->facetAt(each, vertex); });
  if (common.size() != 2 || own.size() < 4 || !isClosed)
  {
    return std::nullopt;
  }
  std::vector<std::size_t> kept;
  for (const std::size_t facet : this->FacetsAround.at(vertex))
  {
    const SurfaceTriangle& corners = this->Facets[facet].corners;
    if (std::find(corners.begin(), corners.end(), neighbor) == corners.end())
    {
      kept.push_back(facet);
    }
  }
  return kept;
}

void FacetMesh::move(std::size_t vertex, std::size_t neighbor, const std::vector<std::size_t>& kept)
{
  const std::vector<std::size_t> around = this->FacetsAround.at(vertex);
  for (const std::size_t facet : around)
  {
    this->disconnect(facet);
    this->IsRemoved[facet] = std::find(kept.begin(), kept.end(), facet) == kept.end();
  }
  for (const std::size_t facet : kept)
  {
    replace(this->Facets[facet].corners, vertex, neighbor);
    this->connect(facet);
  }
}

double FacetMesh::invertedAreaAround(std::size_t vertex) const
{
  double area = 0.0;
  const auto around = this->FacetsAround.find(vertex);
  if (around != this->FacetsAround.end())
  {
    for (const std::size_t facet : around->second)
    {
      area += std::max(0.0, -this->signedArea(this->Facets[facet]));
    }
  }
  return area;
}

std::vector<Facet> FacetMesh::facets() const
{
  std::vector<Facet> left;
  forEachInOrder(this->Exec, this->Facets.size(),
    [&](std::size_t i)
    {
      if (!this->IsRemoved[i])
      {
        left.push_back(this->Facets[i]);
      }
    });
  return left;
}

} // namespace isopoint
