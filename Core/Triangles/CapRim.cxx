// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/CapRim.h"

#include "Core/Base/Lists.h"

#include <algorithm>

namespace isopoint
{

CapRim::CapRim(const Execution& execution, const SurfaceMesh& mesh,
  const std::vector<SurfaceTriangle>& caps, const std::vector<Vector>& positions)
  : Mesh(mesh)
  , Positions(positions)
{
  if (!caps.empty())
  {
    this->AreCaps = areAmong(execution, mesh.triangles(), caps);
    this->Kinds = tabulated<Kind>(
      execution, positions.size(), [this](std::size_t vertex) { return this->kindAt(vertex); });
  }
}

bool CapRim::isMergeable(const VertexParts& parts, std::size_t part) const
{
  if (this->Kinds.empty())
  {
    return true;
  }
  std::size_t rimCount = 0;
  std::size_t cornerCount = 0;
  std::size_t leavingCount = 0;
  for (const std::size_t vertex : parts.verticesOf(part))
  {
    rimCount += this->Kinds[vertex] != Kind::Off ? 1 : 0;
    cornerCount += this->Kinds[vertex] == Kind::Corner ? 1 : 0;
    this->Mesh.outgoing().forEachAt(vertex,
      [&](HalfEdge side) {
        leavingCount += this->isAt(side) && !parts.isInside(this->Mesh.endOf(side), part) ? 1 : 0;
      });
  }
  return rimCount == 0 || (leavingCount == 2 && cornerCount <= 1);
}

std::size_t CapRim::vertexOf(const VertexParts& parts, std::size_t part) const
{
  if (this->Kinds.empty())
  {
    return VertexParts::none;
  }
  const IndexSpan<std::size_t> vertices = parts.verticesOf(part);
  double count = 0.0;
  Vector mean{};
  for (const std::size_t vertex : vertices)
  {
    if (this->Kinds[vertex] == Kind::Corner)
    {
      return vertex;
    }
    if (this->Kinds[vertex] == Kind::Smooth)
    {
      count += 1.0;
      mean = mean + 1.0 / count * (this->Positions[vertex] - mean);
    }
  }
  std::size_t nearest = VertexParts::none;
  double least = 0.0;
  for (const std::size_t vertex : vertices)
  {
    const double distance = lengthOf(this->Positions[vertex] - mean);
    if (this->Kinds[vertex] == Kind::Smooth && (nearest == VertexParts::none || distance < least))
    {
      nearest = vertex;
      least = distance;
    }
  }
  return nearest;
}

/// Whether a side is between a cap and the isosurface.
bool CapRim::isAt(HalfEdge side) const
{
  const HalfEdge twin = this->Mesh.twinOf(side);
  return twin != noHalfEdge && this->AreCaps[side / 3] != this->AreCaps[twin / 3];
}

CapRim::Kind CapRim::kindAt(std::size_t vertex) const
{
  std::size_t count = 0;
  this->Mesh.outgoing().forEachAt(
    vertex, [&](HalfEdge side) { count += this->isAt(side) ? 1 : 0; });
  return count == 0 ? Kind::Off : count != 2 || this->isSharp(vertex) ? Kind::Corner : Kind::Smooth;
}

/// Whether caps at a vertex differ in direction.
bool CapRim::isSharp(std::size_t vertex) const
{
  constexpr double smoothRim = 0.866; // cosine of 30 degrees
  std::vector<Vector> normals;
  this->Mesh.outgoing().forEachAt(vertex,
    [&](HalfEdge side)
    {
      const Vector normal = areaNormal(this->Positions, this->Mesh.triangles()[side / 3]);
      if (this->AreCaps[side / 3] && lengthOf(normal) > 0.0)
      {
        normals.push_back(directionOf(normal));
      }
    });
  return std::any_of(normals.begin(), normals.end(),
    [&](const Vector& first)
    {
      return std::any_of(normals.begin(), normals.end(),
        [&](const Vector& second) { return dot(first, second) < smoothRim; });
    });
}

} // namespace isopoint
