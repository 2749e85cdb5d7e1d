// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/SurfaceMesh.h"

#include "Core/Base/Lists.h"

#include <algorithm>

namespace isopoint
{

OutgoingHalfEdges::OutgoingHalfEdges(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, std::size_t vertexCount)
  : First(vertexCount, noHalfEdge)
{
  this->Next.resize(3 * triangles.size());
  forEachInOrder(execution, triangles.size(),
    [&](std::size_t i)
    {
      const std::size_t triangle = triangles.size() - 1 - i;
      for (std::size_t corner = 0; corner < 3; ++corner)
      {
        this->add(triangles[triangle][corner], 3 * triangle + corner);
      }
    });
}

void OutgoingHalfEdges::add(std::size_t vertex, HalfEdge side)
{
  this->Next[side] = std::exchange(this->First[vertex], side);
}

void OutgoingHalfEdges::remove(std::size_t vertex, HalfEdge side)
{
  HalfEdge* link = &this->First[vertex];
  while (*link != side)
  {
    link = &this->Next[*link];
  }
  *link = this->Next[side];
}

SurfaceMesh::SurfaceMesh(
  const Execution& execution, std::vector<SurfaceTriangle> triangles, std::size_t vertexCount)
  : Triangles(std::move(triangles))
  , Outgoing(execution, this->Triangles, vertexCount)
  , AreOpen(vertexCount, 0)
{
  this->Twins.resize(3 * this->Triangles.size());
  this->findTwins(execution);
}

void SurfaceMesh::findTwins(const Execution& execution)
{
  constexpr std::size_t grain = 4096;
  const std::vector<std::size_t> open =
    collected<std::size_t>(execution, { this->vertexCount(), 4 * grain, grain },
      [this](std::size_t begin, std::size_t end, std::vector<std::size_t>& found)
      {
        std::vector<std::pair<std::size_t, HalfEdge>> sides; // by their other ends
        for (std::size_t vertex = begin; vertex < end; ++vertex)
        {
          // Each edge is handled at its lower end.
          sides.clear();
          const auto add = [&](std::size_t other, HalfEdge side)
          {
            if (other > vertex)
            {
              this->Twins[side] = noHalfEdge;
              sides.emplace_back(other, side);
            }
          };
          this->Outgoing.forEachAt(vertex,
            [&](HalfEdge side)
            {
              add(this->endOf(side), side);
              add(this->oppositeOf(side), lastOf(side));
            });
          std::sort(sides.begin(), sides.end());
          for (std::size_t first = 0, last = 0; first < sides.size(); first = last)
          {
            while (last < sides.size() && sides[last].first == sides[first].first)
            {
              ++last;
            }
            const HalfEdge side = sides[first].second;
            if (last - first == 2 && this->startOf(side) == this->endOf(sides[first + 1].second))
            {
              this->setTwins(side, sides[first + 1].second);
            }
            else
            {
              found.insert(found.end(), { vertex, sides[first].first });
            }
          }
        }
      });
  forEachInOrder(execution, open.size(), [&](std::size_t i) { this->AreOpen[open[i]] = 1; });
}

void SurfaceMesh::setTwins(HalfEdge side, HalfEdge twin)
{
  for (const auto& [each, other] : { std::pair(side, twin), std::pair(twin, side) })
  {
    if (each != noHalfEdge)
    {
      this->Twins[each] = other;
    }
  }
}

HalfEdge SurfaceMesh::halfEdgeBetween(std::size_t start, std::size_t end) const
{
  HalfEdge found = noHalfEdge;
  this->Outgoing.anyAt(start,
    [&](HalfEdge side)
    {
      found = this->endOf(side) == end ? side : noHalfEdge;
      return found != noHalfEdge;
    });
  return found;
}

bool SurfaceMesh::hasEdge(std::size_t a, std::size_t b) const
{
  return this->Outgoing.anyAt(
    a, [&](HalfEdge side) { return this->endOf(side) == b || this->oppositeOf(side) == b; });
}

SurfaceMesh::Fan SurfaceMesh::fanAt(std::size_t vertex) const
{
  std::size_t count = 0;
  this->Outgoing.forEachAt(vertex, [&count](HalfEdge) { ++count; });
  if (count == 0)
  {
    return Fan::Branched;
  }
  const HalfEdge start = this->Outgoing.firstAt(vertex);
  std::size_t reached = 0;
  HalfEdge side = start;
  do
  {
    ++reached;
    side = this->Twins[lastOf(side)];
  } while (side != noHalfEdge && side != start);
  if (side == start)
  {
    return reached < count ? Fan::Branched : count < 3 ? Fan::BackToBack : Fan::Closed;
  }
  for (side = this->Twins[start]; side != noHalfEdge; side = this->Twins[nextOf(side)])
  {
    ++reached;
  }
  return reached < count ? Fan::Branched : Fan::Open;
}

std::vector<std::size_t> SurfaceMesh::neighborsOf(std::size_t vertex) const
{
  std::vector<std::size_t> neighbors;
  this->Outgoing.forEachAt(vertex,
    [&](HalfEdge side)
    {
      neighbors.push_back(this->endOf(side));
      neighbors.push_back(this->oppositeOf(side));
    });
  keepUnique(neighbors);
  return neighbors;
}

void SurfaceMesh::put(
  std::size_t triangle, const SurfaceTriangle& corners, const std::array<HalfEdge, 3>& twins)
{
  this->Triangles[triangle] = corners;
  for (std::size_t corner = 0; corner < 3; ++corner)
  {
    this->Outgoing.add(corners[corner], 3 * triangle + corner);
    this->setTwins(3 * triangle + corner, twins[corner]);
  }
}

void SurfaceMesh::remove(std::size_t triangle)
{
  for (std::size_t corner = 0; corner < 3; ++corner)
  {
    this->Outgoing.remove(this->Triangles[triangle][corner], 3 * triangle + corner);
  }
  this->Triangles[triangle].fill(noHalfEdge);
}

void SurfaceMesh::flip(HalfEdge side)
{
  const HalfEdge twin = this->Twins[side];
  const std::size_t a = this->startOf(side);
  const std::size_t b = this->endOf(side);
  const std::size_t c = this->oppositeOf(side);
  const std::size_t d = this->oppositeOf(twin);
  const HalfEdge bc = this->Twins[nextOf(side)];
  const HalfEdge ca = this->Twins[lastOf(side)];
  const HalfEdge ad = this->Twins[nextOf(twin)];
  const HalfEdge db = this->Twins[lastOf(twin)];
  const HalfEdge first = side / 3 * 3;
  const HalfEdge second = twin / 3 * 3;
  this->remove(first / 3);
  this->remove(second / 3);
  this->put(first / 3, { c, a, d }, { ca, ad, second + 2 });
  this->put(second / 3, { d, b, c }, { db, bc, first + 2 });
}

void SurfaceMesh::rotateCorners(std::size_t triangle)
{
  const auto [a, b, c] = this->Triangles[triangle];
  const HalfEdge first = 3 * triangle;
  const std::array<HalfEdge, 3> twins{ this->Twins[first + 1], this->Twins[first + 2],
    this->Twins[first] };
  this->remove(triangle);
  this->put(triangle, { b, c, a }, twins);
}

void SurfaceMesh::collapse(HalfEdge side)
{
  const std::size_t vertex = this->startOf(side);
  const std::size_t onto = this->endOf(side);
  for (const HalfEdge each : { side, this->Twins[side] })
  {
    this->setTwins(this->Twins[nextOf(each)], this->Twins[lastOf(each)]);
    this->remove(each / 3);
  }
  for (HalfEdge each = this->Outgoing.firstAt(vertex); each != noHalfEdge;
       each = this->Outgoing.firstAt(vertex))
  {
    this->Outgoing.remove(vertex, each);
    this->Outgoing.add(onto, each);
    this->Triangles[each / 3][each % 3] = onto;
  }
}

} // namespace isopoint
