// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/VertexContraction.h"

#include "Core/Base/Hash.h"
#include "Core/Base/Lists.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>

namespace isopoint
{
namespace
{

/// An edge from a vertex outside a part, or the vertex it was merged into, to a member of the part.
using Spoke = std::array<std::size_t, 3>; // root, from, to

} // namespace

/// The triangles around a merged part. Reuses memory.
struct VertexContraction::Surroundings
{
  VertexLink link;
  std::vector<Spoke> spokes;
  std::vector<std::size_t> vanished; // outer ends of triangles that became edges

  void clear()
  {
    this->link.clear();
    this->spokes.clear();
    this->vanished.clear();
  }

  /// Whether vanished triangles connect the spokes of each vertex of the link without a cycle (one
  /// spoke more than triangles), and no spoke leads elsewhere.
  bool haveTrees()
  {
    keepUnique(this->spokes);
    std::sort(this->vanished.begin(), this->vanished.end());
    std::size_t count = 0;
    for (auto first = this->spokes.begin(); first != this->spokes.end(); ++count)
    {
      const std::size_t root = first->front();
      const auto last = std::find_if(
        first, this->spokes.end(), [root](const Spoke& spoke) { return spoke.front() != root; });
      const auto [begin, end] =
        std::equal_range(this->vanished.begin(), this->vanished.end(), root);
      if (!this->link.hasVertex(root) || last - first != end - begin + 1)
      {
        return false;
      }
      first = last;
    }
    return count == this->link.vertexCount();
  }
};

VertexContraction::VertexContraction(const Execution& execution, const WeightedVertices& vertices,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<std::size_t>& groups,
  std::size_t groupCount)
  : Exec(execution)
  , Vertices(vertices)
  , Triangles(triangles)
  , Parts(execution, triangles, groups, groupCount)
  , IsMerged(this->Parts.size(), 0)
  , IsAtBorder(groups.size(), 0)
  , Roots(groups.size())
  , Positions(vertices.positions)
{
  std::iota(this->Roots.begin(), this->Roots.end(), std::size_t{ 0 });
  this->findBorder();
}

void VertexContraction::findBorder()
{
  // At inner vertices, each neighbor is once a successor and once a predecessor.
  std::vector<std::uint64_t> balances(this->IsAtBorder.size(), 0);
  forEachInOrder(this->Exec, this->Triangles.size(),
    [&](std::size_t triangle)
    {
      const auto& [a, b, c] = this->Triangles[triangle];
      balances[a] += mixBits(b + 1) - mixBits(c + 1);
      balances[b] += mixBits(c + 1) - mixBits(a + 1);
      balances[c] += mixBits(a + 1) - mixBits(b + 1);
    });
  forEachIndex(this->Exec, balances.size(),
    [&](std::size_t vertex) { this->IsAtBorder[vertex] = balances[vertex] != 0 ? 1 : 0; });
}

void VertexContraction::contract()
{
  forEachIndex(this->Exec, this->Parts.size(),
    [this](std::size_t part)
    {
      if (this->Parts.isSimple(part))
      {
        this->IsMerged[part] = 1;
        this->merge(part);
      }
    });
  std::vector<std::size_t> suspects = markedOf(this->Exec, this->IsMerged);
  while (!suspects.empty())
  {
    constexpr std::size_t grain = 1024;
    std::vector<std::size_t> failed = collected<std::size_t>(this->Exec,
      { suspects.size(), 4 * grain, grain },
      [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& found)
      {
        Surroundings around;
        std::copy_if(suspects.begin() + static_cast<std::ptrdiff_t>(begin),
          suspects.begin() + static_cast<std::ptrdiff_t>(end), std::back_inserter(found),
          [&](std::size_t part) { return this->IsMerged[part] && !this->isSurface(part, around); });
      });
    const std::vector<std::size_t> separated = this->lowestAmongNeighbors(failed);
    suspects = std::move(failed);
    forEachInOrder(this->Exec, separated.size(),
      [&](std::size_t i)
      {
        this->separate(separated[i]);
        this->forPartsAround(separated[i], [&](std::size_t other) { suspects.push_back(other); });
      });
    suspects = sortedUnique(this->Exec, suspects, this->Parts.size());
  }
}

/// Calls visit(other) for all parts that share a triangle with a part, often repeatedly.
template <class Visit>
void VertexContraction::forPartsAround(std::size_t part, const Visit& visit) const
{
  for (const std::size_t triangle : this->Parts.trianglesAround(part))
  {
    const auto partAt = [&](std::size_t corner)
    { return this->Parts.partOf(this->Triangles[triangle][corner]); };
    for (const std::size_t other : { partAt(0), partAt(1), partAt(2) })
    {
      if (other != part && other != VertexParts::none)
      {
        visit(other);
      }
    }
  }
}

/// Of the failed parts, those with the lowest hash among their failed neighbors.
std::vector<std::size_t> VertexContraction::lowestAmongNeighbors(
  const std::vector<std::size_t>& failed) const
{
  const auto keyOf = [](std::size_t part) { return std::pair(mixBits(part + 1), part); };
  std::vector<std::size_t> first = itemsThat(this->Exec, failed.size(),
    [&](std::size_t i)
    {
      bool isFirst = true;
      this->forPartsAround(failed[i],
        [&](std::size_t other)
        {
          isFirst = isFirst && (!std::binary_search(failed.begin(), failed.end(), other) ||
                                 keyOf(failed[i]) < keyOf(other));
        });
      return isFirst;
    });
  std::transform(
    first.begin(), first.end(), first.begin(), [&](std::size_t i) { return failed[i]; });
  return first;
}

void VertexContraction::merge(std::size_t part)
{
  const IndexSpan<std::size_t> vertices = this->Parts.verticesOf(part);
  const std::size_t root = vertices[0];
  for (const std::size_t vertex : vertices)
  {
    this->Roots[vertex] = root;
  }
  this->Positions[root] = this->meanOf(this->placingMembers(part));
}

/// The weighted mean of vertices, clamped to their bounds.
Vector VertexContraction::meanOf(const std::vector<std::size_t>& vertices) const
{
  const auto positionOf = [this](std::size_t vertex) -> const Vector&
  { return this->Vertices.positions[vertex]; };
  double weight = 0.0;
  for (const std::size_t vertex : vertices)
  {
    weight += this->Vertices.weights[vertex];
  }
  const Vector& origin = positionOf(vertices.front());
  Vector mean = origin;
  Vector least = origin;
  Vector most = origin;
  for (const std::size_t vertex : vertices)
  {
    const Vector& position = positionOf(vertex);
    mean = mean + this->Vertices.weights[vertex] / weight * (position - origin);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      least[axis] = std::min(least[axis], position[axis]);
      most[axis] = std::max(most[axis], position[axis]);
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    mean[axis] = std::clamp(mean[axis], least[axis], most[axis]);
  }
  return mean;
}

void VertexContraction::separate(std::size_t part)
{
  this->IsMerged[part] = 0;
  for (const std::size_t vertex : this->Parts.verticesOf(part))
  {
    this->Roots[vertex] = vertex;
    this->Positions[vertex] = this->Vertices.positions[vertex];
  }
}

/// The vertices that place a merged part: its border corner, else its border vertices, else all.
std::vector<std::size_t> VertexContraction::placingMembers(std::size_t part) const
{
  const IndexSpan<std::size_t> vertices = this->Parts.verticesOf(part);
  std::vector<std::size_t> atBorder;
  std::copy_if(vertices.begin(), vertices.end(), std::back_inserter(atBorder),
    [this](std::size_t vertex) { return this->IsAtBorder[vertex] != 0; });
  if (atBorder.empty())
  {
    return { vertices.begin(), vertices.end() };
  }
  const std::size_t corner = this->cornerOf(part, atBorder);
  return corner != VertexParts::none ? std::vector<std::size_t>(1, corner) : atBorder;
}

/// The vertex of a part at a corner of the border, far from the line between the two border
/// vertices next to the part. `none` if there is no corner.
std::size_t VertexContraction::cornerOf(
  std::size_t part, const std::vector<std::size_t>& atBorder) const
{
  constexpr double cornerShare = 0.25; // share of the length of that line
  std::vector<DirectedEdge> edges;
  const auto isInside = [&](std::size_t vertex) { return this->Parts.partOf(vertex) == part; };
  for (const std::size_t triangle : this->Parts.trianglesAround(part))
  {
    const SurfaceTriangle& corners = this->Triangles[triangle];
    for (std::size_t i = 0; i < 3; ++i)
    {
      const DirectedEdge edge(corners[i], corners[(i + 1) % 3]);
      if (isInside(edge.first) || isInside(edge.second))
      {
        edges.push_back(edge);
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::size_t> outside;
  for (const auto& [from, to] : edges)
  {
    if (!std::binary_search(edges.begin(), edges.end(), DirectedEdge(to, from)) &&
        isInside(from) != isInside(to))
    {
      outside.push_back(isInside(from) ? to : from);
    }
  }
  if (outside.size() != 2)
  {
    return VertexParts::none;
  }
  const Vector& start = this->Vertices.positions[outside[0]];
  const Vector along = this->Vertices.positions[outside[1]] - start;
  const Vector direction = directionOf(along);
  std::size_t farthest = VertexParts::none;
  double most = cornerShare * lengthOf(along);
  for (const std::size_t vertex : atBorder)
  {
    const double offset = lengthOf(cross(this->Vertices.positions[vertex] - start, direction));
    if (offset > most)
    {
      most = offset;
      farthest = vertex;
    }
  }
  return farthest;
}

std::vector<std::size_t> VertexContraction::membersOf(std::size_t root) const
{
  const std::size_t part = this->Parts.partOf(root);
  return part != VertexParts::none && this->IsMerged[part] ? this->placingMembers(part)
                                                           : std::vector<std::size_t>(1, root);
}

/// Whether the triangles around a merged part, and around vertices next to it, form a (half) disk.
bool VertexContraction::isSurface(std::size_t part, Surroundings& around) const
{
  around.clear();
  const auto addSpoke = [&](std::size_t from, std::size_t to) {
    around.spokes.push_back({ this->Roots[from], from, to });
  };
  for (const std::size_t triangle : this->Parts.trianglesAround(part))
  {
    const SurfaceTriangle& corners = this->Triangles[triangle];
    const auto isInside = [&](std::size_t corner)
    { return this->Parts.partOf(corners[corner]) == part; };
    const std::array<bool, 3> inside{ isInside(0), isInside(1), isInside(2) };
    const auto count = std::count(inside.begin(), inside.end(), true);
    if (count == 3)
    {
      continue;
    }
    const auto single = static_cast<std::size_t>(
      std::find(inside.begin(), inside.end(), count == 1) - inside.begin());
    const std::size_t next = corners[(single + 1) % 3];
    const std::size_t last = corners[(single + 2) % 3];
    if (count == 2)
    {
      addSpoke(corners[single], next);
      addSpoke(corners[single], last);
      around.vanished.push_back(this->Roots[corners[single]]);
      continue;
    }
    addSpoke(next, corners[single]);
    addSpoke(last, corners[single]);
    if (this->Roots[next] != this->Roots[last])
    {
      around.link.add(this->Roots[next], this->Roots[last]);
    }
    else
    {
      around.vanished.push_back(this->Roots[next]);
    }
  }
  return around.link.isCycleOrPath() && around.haveTrees();
}

} // namespace isopoint
