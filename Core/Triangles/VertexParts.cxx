// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/VertexParts.h"

#include "Core/Base/Hash.h"
#include "Core/Base/Sorting.h"
#include "Core/Triangles/ConnectedVertices.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace isopoint
{
namespace
{

/// The vertices that are connected within their groups.
ConnectedVertices connectedWithin(
  const Execution& execution, const SurfaceMesh& mesh, const std::vector<std::size_t>& groups)
{
  ConnectedVertices connected(execution, groups.size());
  forEachIndex(execution, 3 * mesh.triangles().size(),
    [&](HalfEdge side)
    {
      if (mesh.isFirst(side) && groups[mesh.startOf(side)] == groups[mesh.endOf(side)])
      {
        connected.unite(mesh.startOf(side), mesh.endOf(side));
      }
    });
  return connected;
}

/// Merges all simply connected parts, and separates some again until the others can be merged.
class VertexContraction
{
public:
  VertexContraction(const Execution& execution, const SurfaceMesh& mesh, const VertexParts& parts,
    std::vector<char> areWanted)
    : Run(execution)
    , Mesh(mesh)
    , Parts(parts)
    , AreMerged(std::move(areWanted))
  {
    forEachIndex(execution, parts.size(),
      [this](std::size_t part)
      { this->AreMerged[part] = this->AreMerged[part] && this->isSimple(part) ? 1 : 0; });
  }

  std::vector<char> contract()
  {
    std::vector<std::size_t> suspects = markedOf(this->Run, this->AreMerged);
    while (!suspects.empty())
    {
      const std::vector<std::size_t> failed = this->failedOf(suspects);
      const std::vector<std::size_t> separated = this->lowestAmongNeighbors(failed);
      suspects = failed;
      forEachInOrder(this->Run, separated.size(),
        [&](std::size_t i)
        {
          this->AreMerged[separated[i]] = 0;
          this->forPartsAround(separated[i], [&](std::size_t other) { suspects.push_back(other); });
        });
      suspects = sortedUnique(this->Run, suspects, this->Parts.size());
    }
    return std::move(this->AreMerged);
  }

private:
  /// Whether a part is simply connected: vertices - edges + triangles = 1.
  bool isSimple(std::size_t part) const
  {
    std::size_t edges = 0;
    std::size_t others = 0;
    for (const std::size_t vertex : this->Parts.verticesOf(part))
    {
      ++others;
      this->Mesh.outgoing().forEachAt(vertex,
        [&](HalfEdge side)
        {
          const std::size_t next = this->Mesh.endOf(side);
          const std::size_t last = this->Mesh.oppositeOf(side);
          if (this->Parts.isInside(next, part))
          {
            edges += vertex < next || this->Mesh.twinOf(side) == noHalfEdge ? 1 : 0;
            others += vertex < std::min(next, last) && this->Parts.isInside(last, part) ? 1 : 0;
          }
        });
    }
    return others == edges + 1;
  }

  std::vector<std::size_t> failedOf(const std::vector<std::size_t>& suspects) const
  {
    constexpr std::size_t grain = 1024;
    return collected<std::size_t>(this->Run, { suspects.size(), 4 * grain, grain },
      [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& found)
      {
        std::vector<std::size_t> ring;
        std::copy_if(suspects.data() + begin, suspects.data() + end, std::back_inserter(found),
          [&](std::size_t part) { return this->AreMerged[part] && !this->isSurface(part, ring); });
      });
  }

  /// Calls visit(other) for all parts that share a triangle with a part, often repeatedly.
  template <class Visit>
  void forPartsAround(std::size_t part, const Visit& visit) const
  {
    for (const std::size_t vertex : this->Parts.verticesOf(part))
    {
      this->Mesh.outgoing().forEachAt(vertex,
        [&](HalfEdge side)
        {
          for (const std::size_t neighbor : { this->Mesh.endOf(side), this->Mesh.oppositeOf(side) })
          {
            const std::size_t other = this->Parts.partOf[neighbor];
            if (other != part && other != VertexParts::none)
            {
              visit(other);
            }
          }
        });
    }
  }

  /// Of the failed parts, those with the lowest hash among their failed neighbors.
  std::vector<std::size_t> lowestAmongNeighbors(const std::vector<std::size_t>& failed) const
  {
    const auto keyOf = [](std::size_t part) { return std::pair(mixBits(part + 1), part); };
    return chosenThat(this->Run, failed,
      [&](std::size_t part)
      {
        bool isFirst = true;
        this->forPartsAround(part,
          [&](std::size_t other)
          {
            isFirst = isFirst && (!std::binary_search(failed.begin(), failed.end(), other) ||
                                   keyOf(part) < keyOf(other));
          });
        return isFirst;
      });
  }

  /// Whether the triangles around a merged part form a disk or half a disk: its neighbors are one
  /// cycle of at least three vertices or, at a border, one path, and each occurs once.
  /// @param ring reused memory
  bool isSurface(std::size_t part, std::vector<std::size_t>& ring) const
  {
    // Outgoing that leave the part, and those of them at a border, where a path begins.
    HalfEdge start = noHalfEdge;
    std::size_t pathCount = 0;
    for (const std::size_t vertex : this->Parts.verticesOf(part))
    {
      this->Mesh.outgoing().forEachAt(vertex,
        [&](HalfEdge side)
        {
          if (!this->Parts.isInside(this->Mesh.endOf(side), part))
          {
            const bool isAtBorder = this->Mesh.twinOf(side) == noHalfEdge;
            pathCount += isAtBorder ? 1 : 0;
            start = isAtBorder || pathCount == 0 ? side : start;
          }
        });
    }
    ring.clear();
    const auto meet = [&](std::size_t vertex)
    {
      const std::size_t merged = this->Parts.rootOf(vertex, this->AreMerged);
      if (ring.empty() || ring.back() != merged)
      {
        ring.push_back(merged);
      }
    };
    // Counterclockwise around the part, from one side that leaves it to the next.
    HalfEdge side = pathCount > 1 ? noHalfEdge : start;
    while (side != noHalfEdge)
    {
      meet(this->Mesh.endOf(side));
      const std::size_t last = this->Mesh.oppositeOf(side);
      const bool isLastInside = this->Parts.isInside(last, part);
      if (!isLastInside)
      {
        meet(last);
      }
      side = this->Mesh.twinOf(isLastInside ? nextOf(side) : lastOf(side));
      side = side == start ? noHalfEdge : side;
    }
    const bool isCycle = pathCount == 0;
    if (isCycle && ring.size() > 1 && ring.front() == ring.back())
    {
      ring.pop_back();
    }
    const std::size_t least = isCycle ? 3 : 2;
    std::sort(ring.begin(), ring.end());
    return ring.size() >= least && std::adjacent_find(ring.begin(), ring.end()) == ring.end();
  }

  const Execution& Run;
  const SurfaceMesh& Mesh;
  const VertexParts& Parts;
  std::vector<char> AreMerged;
};

} // namespace

VertexParts::VertexParts(const Execution& execution, std::vector<std::size_t> allVertices,
  std::vector<Part> allParts, std::size_t vertexCount)
  : vertices(std::move(allVertices))
  , parts(std::move(allParts))
  , partOf(vertexCount, none)
{
  forEachIndex(execution, this->size(),
    [this](std::size_t part)
    {
      for (const std::size_t vertex : this->verticesOf(part))
      {
        this->partOf[vertex] = part;
      }
    });
}

VertexParts partsOfGroups(const Execution& execution, const SurfaceMesh& mesh,
  const std::vector<std::size_t>& groups, std::size_t groupCount)
{
  ConnectedVertices connected = connectedWithin(execution, mesh, groups);
  const std::vector<std::size_t> roots = connected.roots(execution);
  ItemLists members(execution, roots.size(), roots.size(),
    [&roots](std::size_t vertex) { return std::array{ roots[vertex] }; });
  const std::vector<std::size_t> firsts = itemsThat(
    execution, roots.size(), [&](std::size_t vertex) { return members.at(vertex).count > 1; });
  const std::vector<std::size_t> ordered = orderByKeys(
    execution, firsts.size(), groupCount, [&](std::size_t i) { return groups[firsts[i]]; },
    [](std::size_t group) { return group; });
  std::vector<VertexParts::Part> parts = tabulated<VertexParts::Part>(execution, ordered.size(),
    [&](std::size_t part) -> VertexParts::Part
    {
      const IndexSpan<std::size_t> own = members.at(firsts[ordered[part]]);
      const auto begin = static_cast<std::size_t>(own.first - members.at(0).first);
      return { begin, begin + own.count };
    });
  return { execution, std::move(members).all(), std::move(parts), groups.size() };
}

std::vector<char> contractibleParts(const Execution& execution, const SurfaceMesh& mesh,
  const VertexParts& parts, std::vector<char> areWanted)
{
  return VertexContraction(execution, mesh, parts, std::move(areWanted)).contract();
}

} // namespace isopoint
