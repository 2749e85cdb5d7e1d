// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/VertexMerging.h"

#include "Core/Base/Lists.h"
#include "Core/Triangles/CapRim.h"
#include "Core/Triangles/EdgeFlipping.h"
#include "Core/Triangles/ShortEdges.h"
#include "Core/Triangles/SurfaceMesh.h"
#include "Core/Triangles/VertexParts.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace isopoint
{
namespace
{

/// Where the vertices of merged parts are placed.
class Placement
{
public:
  /// @param positions of the vertices
  /// @param memberBegins by vertex, offsets of the crossings that it is the mean of
  Placement(const SurfaceMesh& mesh, const CapRim& rim, const VertexParts& parts,
    const std::vector<Vector>& positions, const std::vector<std::size_t>& memberBegins)
    : Mesh(mesh)
    , Rim(rim)
    , Parts(parts)
    , Positions(positions)
    , MemberBegins(memberBegins)
  {
  }

  /// The vertices whose mean a part becomes, ascending: the one at the rim of caps, else the border
  /// corner, else all border vertices, else all vertices.
  /// @param memory overwritten; may hold them
  IndexSpan<std::size_t> membersOf(std::size_t part, std::vector<std::size_t>& memory) const
  {
    const IndexSpan<std::size_t> vertices = this->Parts.verticesOf(part);
    memory.clear();
    const std::size_t atRim = this->Rim.vertexOf(this->Parts, part);
    if (atRim != VertexParts::none)
    {
      memory.assign(1, atRim);
      return { memory.data(), memory.size() };
    }
    std::copy_if(vertices.begin(), vertices.end(), std::back_inserter(memory),
      [this](std::size_t vertex) { return this->Mesh.isOpen(vertex); });
    if (memory.empty())
    {
      return vertices;
    }
    const std::size_t corner = this->cornerOf(part, memory);
    if (corner != VertexParts::none)
    {
      memory.assign(1, corner);
    }
    return { memory.data(), memory.size() };
  }

  /// The weighted mean of vertices, clamped to their bounds.
  Vector meanOf(const IndexSpan<std::size_t>& vertices) const
  {
    const auto positionOf = [this](std::size_t vertex) -> const Vector&
    { return this->Positions[vertex]; };
    double weight = 0.0;
    for (const std::size_t vertex : vertices)
    {
      weight += this->weightOf(vertex);
    }
    const Vector& origin = positionOf(vertices[0]);
    Vector mean = origin;
    Vector least = origin;
    Vector most = origin;
    for (const std::size_t vertex : vertices)
    {
      const Vector& position = positionOf(vertex);
      mean = mean + this->weightOf(vertex) / weight * (position - origin);
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

private:
  /// The vertex of a part at a corner of the border, far from the line between the two border
  /// vertices next to the part. `none` if there is no corner.
  std::size_t cornerOf(std::size_t part, const std::vector<std::size_t>& atBorder) const
  {
    constexpr double cornerShare = 0.25; // share of the length of that line
    using Edge = std::array<std::size_t, 2>;
    std::vector<std::pair<Edge, std::size_t>> leaving; // border edges, with their ends outside
    for (const std::size_t vertex : atBorder)
    {
      this->Mesh.outgoing().forEachAt(vertex,
        [&](HalfEdge side)
        {
          const std::size_t next = this->Mesh.endOf(side);
          const std::size_t last = this->Mesh.oppositeOf(side);
          if (this->Mesh.twinOf(side) == noHalfEdge && !this->Parts.isInside(next, part))
          {
            leaving.push_back({ { vertex, next }, next });
          }
          if (this->Mesh.twinOf(lastOf(side)) == noHalfEdge && !this->Parts.isInside(last, part))
          {
            leaving.push_back({ { last, vertex }, last });
          }
        });
    }
    std::sort(leaving.begin(), leaving.end());
    if (leaving.size() != 2)
    {
      return VertexParts::none;
    }
    const Vector& start = this->Positions[leaving[0].second];
    const Vector along = this->Positions[leaving[1].second] - start;
    const Vector direction = directionOf(along);
    std::size_t farthest = VertexParts::none;
    double most = cornerShare * lengthOf(along);
    for (const std::size_t vertex : atBorder)
    {
      const double offset = lengthOf(cross(this->Positions[vertex] - start, direction));
      if (offset > most)
      {
        most = offset;
        farthest = vertex;
      }
    }
    return farthest;
  }

  double weightOf(std::size_t vertex) const
  {
    return static_cast<double>(this->MemberBegins[vertex + 1] - this->MemberBegins[vertex]);
  }

  const SurfaceMesh& Mesh;
  const CapRim& Rim;
  const VertexParts& Parts;
  const std::vector<Vector>& Positions;
  const std::vector<std::size_t>& MemberBegins;
};

class VertexMerger
{
public:
  VertexMerger(const Execution& execution, MergeableTriangles triangles)
    : Run(execution)
    , Crossings(triangles.crossings)
    , KeepsRim(triangles.keepsRim)
    , HasCaps(!triangles.caps.empty())
    , NearerEnds(std::move(triangles.nearerEnds))
    , EndCount(triangles.endCount)
    , AreFixed(std::move(triangles.areFixed))
  {
    const std::size_t count = this->Crossings.size();
    this->AreFixed.resize(count, 0);
    this->Result.triangles = std::move(triangles.triangles);
    this->Result.caps = std::move(triangles.caps);
    this->Result.members = iota(count);
    this->Result.memberBegins = iota(count + 1);
  }

  CrossingMesh merge()
  {
    this->mergeAtEnds();
    this->Run.progress(0.7);
    for (int round = 0; round < shortEdgeRounds; ++round)
    {
      flipEdges(this->Run, this->Result.positions,
        this->HasCaps ? areVerticesOf(this->Run, this->Result.caps, this->count()) : this->AreFixed,
        this->Result.triangles);
      const SurfaceMesh mesh = this->takeMesh();
      this->contract(mesh, this->pairsOfShortEdges(mesh), this->Result.positions);
    }
    forEachIndex(this->Run, this->Result.size(),
      [this](std::size_t vertex) { this->putNearestFirst(vertex); });
    this->Run.progress(1.0);
    return std::move(this->Result);
  }

private:
  std::size_t count() const { return this->Result.memberBegins.size() - 1; }

  SurfaceMesh takeMesh() { return { this->Run, std::move(this->Result.triangles), this->count() }; }

  /// Keeps branched vertices, and perhaps the rim, from now on, and merges the others at each
  /// sample.
  void mergeAtEnds()
  {
    const SurfaceMesh mesh = this->takeMesh();
    forEachIndex(this->Run, this->count(),
      [&](std::size_t vertex)
      {
        const SurfaceMesh::Fan fan = mesh.fanAt(vertex);
        if (fan == SurfaceMesh::Fan::Branched || fan == SurfaceMesh::Fan::BackToBack ||
            (this->KeepsRim && mesh.isOpen(vertex)))
        {
          this->AreFixed[vertex] = 1;
        }
      });
    const std::vector<std::size_t> kept = markedOf(this->Run, this->AreFixed);
    std::vector<std::size_t> groups = std::move(this->NearerEnds);
    forEachIndex(this->Run, kept.size(),
      [&](std::size_t i) { groups[kept[i]] = this->EndCount + i; }); // alone
    this->contract(
      mesh, partsOfGroups(this->Run, mesh, groups, this->EndCount + kept.size()), this->Crossings);
  }

  /// Merges the vertices of each part if possible, and renumbers.
  /// @param former positions
  void contract(
    const SurfaceMesh& mesh, const VertexParts& parts, const std::vector<Vector>& former)
  {
    const CapRim rim(this->Run, mesh, this->Result.caps, former);
    const Placement placement(mesh, rim, parts, former, this->Result.memberBegins);
    std::vector<char> areMerged = tabulated<char>(
      this->Run, parts.size(), [&](std::size_t part) { return rim.isMergeable(parts, part); });
    do
    {
      areMerged = contractibleParts(this->Run, mesh, parts, std::move(areMerged));
    } while ((this->KeepsRim || this->HasCaps) &&
             this->unmergeInverting(mesh, parts, rim, placement, former, areMerged));
    const auto isMerged = [&](std::size_t vertex) { return parts.isMarked(vertex, areMerged); };
    const auto rootOf = [&](std::size_t vertex) { return parts.rootOf(vertex, areMerged); };
    const std::vector<std::size_t> roots = itemsThat(
      this->Run, this->count(), [&](std::size_t vertex) { return rootOf(vertex) == vertex; });
    // The vertices whose mean a new one is.
    const auto sourcesOf = [&](std::size_t i, std::vector<std::size_t>& memory)
    {
      return isMerged(roots[i]) ? placement.membersOf(parts.partOf[roots[i]], memory)
                                : IndexSpan<std::size_t>{ &roots[i], 1 };
    };
    const std::vector<std::size_t> numbers = inverseOf(this->Run, roots, this->count());
    const std::vector<std::size_t> number = tabulated<std::size_t>(
      this->Run, this->count(), [&](std::size_t vertex) { return numbers[rootOf(vertex)]; });
    this->Result.triangles = renumbered(this->Run, mesh.triangles(), number, roots.size());
    this->Result.caps = renumbered(this->Run, this->Result.caps, number, roots.size());
    this->AreFixed = chosenOf(this->Run, this->AreFixed, roots);
    std::vector<Vector> positions = tabulated<Vector>(this->Run, roots.size(),
      [&](std::size_t i)
      {
        std::vector<std::size_t> memory;
        return isMerged(roots[i]) ? placement.meanOf(sourcesOf(i, memory)) : former[roots[i]];
      });
    this->keepMembers(roots.size(), sourcesOf);
    this->Result.positions = std::move(positions);
  }

  /// Unmerges parts whose merging would invert a triangle. If the rim stays, all triangles count,
  /// otherwise only caps, which are flat. @returns whether any was unmerged: the others then have
  /// to be tested again
  bool unmergeInverting(const SurfaceMesh& mesh, const VertexParts& parts, const CapRim& rim,
    const Placement& placement, const std::vector<Vector>& former,
    std::vector<char>& areMerged) const
  {
    const std::vector<Vector> means = tabulated<Vector>(this->Run, parts.size(),
      [&](std::size_t part)
      {
        std::vector<std::size_t> memory;
        return placement.meanOf(placement.membersOf(part, memory));
      });
    const auto isInverted = [&](std::size_t triangle)
    {
      if (!this->KeepsRim && !rim.isCap(triangle))
      {
        return false;
      }
      std::array<Vector, 3> before;
      std::array<Vector, 3> after;
      std::array<std::size_t, 3> roots{}; // equal ones become one vertex
      for (std::size_t i = 0; i < 3; ++i)
      {
        const std::size_t vertex = mesh.triangles()[triangle][i];
        roots[i] = parts.rootOf(vertex, areMerged);
        before[i] = former[vertex];
        after[i] = parts.isMarked(vertex, areMerged) ? means[parts.partOf[vertex]] : before[i];
      }
      const bool vanishes = roots[0] == roots[1] || roots[1] == roots[2] || roots[2] == roots[0];
      return !vanishes && dot(cross(before[1] - before[0], before[2] - before[0]),
                            cross(after[1] - after[0], after[2] - after[0])) < 0.0;
    };
    for (bool isAny = false;; isAny = true)
    {
      const std::vector<std::size_t> inverted =
        itemsThat(this->Run, mesh.triangles().size(), isInverted);
      if (inverted.empty())
      {
        return isAny;
      }
      for (const std::size_t triangle : inverted)
      {
        std::size_t farthest = VertexParts::none;
        double most = -1.0;
        for (const std::size_t vertex : mesh.triangles()[triangle])
        {
          const std::size_t part = parts.partOf[vertex];
          if (parts.isMarked(vertex, areMerged) && lengthOf(means[part] - former[vertex]) > most)
          {
            most = lengthOf(means[part] - former[vertex]);
            farthest = part;
          }
        }
        if (farthest != VertexParts::none)
        {
          areMerged[farthest] = 0;
        }
      }
    }
  }

  /// @param sourcesOf(i, memory) the former vertices whose mean a new one is
  template <class SourcesOf>
  void keepMembers(std::size_t count, const SourcesOf& sourcesOf)
  {
    const std::vector<std::size_t>& former = this->Result.members;
    const std::vector<std::size_t>& formerBegins = this->Result.memberBegins;
    std::vector<std::size_t> begins = offsetsFromSizes(this->Run, count,
      [&](std::size_t i)
      {
        std::size_t size = 0;
        std::vector<std::size_t> memory;
        for (const std::size_t vertex : sourcesOf(i, memory))
        {
          size += formerBegins[vertex + 1] - formerBegins[vertex];
        }
        return size;
      });
    std::vector<std::size_t> members(begins.back());
    forEachIndex(this->Run, count,
      [&](std::size_t i)
      {
        std::size_t* end = members.data() + begins[i];
        std::vector<std::size_t> memory;
        for (const std::size_t vertex : sourcesOf(i, memory))
        {
          end = std::copy(
            former.data() + formerBegins[vertex], former.data() + formerBegins[vertex + 1], end);
        }
      });
    this->Result.members = std::move(members);
    this->Result.memberBegins = std::move(begins);
  }

  /// Pairs vertices along short edges, shortest first.
  VertexParts pairsOfShortEdges(const SurfaceMesh& mesh) const
  {
    std::vector<std::size_t> seconds(this->count(), 0); // of pairs; never the first vertex
    std::vector<bool> isTaken(this->count(), false);
    const std::vector<VertexPair> edges = shortEdges(this->Run, this->Result.positions, mesh);
    forEachInOrder(this->Run, edges.size(),
      [&](std::size_t i)
      {
        const auto& [a, b] = edges[i];
        if (!isTaken[a] && !isTaken[b])
        {
          isTaken[a] = isTaken[b] = true;
          seconds[a] = this->AreFixed[a] || this->AreFixed[b] ? 0 : b;
        }
      });
    const std::vector<std::size_t> firsts = markedOf(this->Run, seconds);
    return { this->Run,
      tabulated<std::size_t>(this->Run, 2 * firsts.size(),
        [&](std::size_t i) { return i % 2 == 0 ? firsts[i / 2] : seconds[firsts[i / 2]]; }),
      tabulated<VertexParts::Part>(this->Run, firsts.size(),
        [](std::size_t i) -> VertexParts::Part {
          return { 2 * i, 2 * i + 2 };
        }),
      this->count() };
  }

  void putNearestFirst(std::size_t vertex)
  {
    std::size_t* const begin = this->Result.members.data() + this->Result.memberBegins[vertex];
    std::size_t* const end = this->Result.members.data() + this->Result.memberBegins[vertex + 1];
    const auto distanceOf = [&](std::size_t crossing)
    { return lengthOf(this->Crossings[crossing] - this->Result.positions[vertex]); };
    std::size_t* const nearest = std::min_element(
      begin, end, [&](std::size_t a, std::size_t b) { return distanceOf(a) < distanceOf(b); });
    std::rotate(begin, nearest, nearest + 1);
  }

  const Execution& Run;
  const std::vector<Vector>& Crossings;
  const bool KeepsRim;
  const bool HasCaps;
  std::vector<std::size_t> NearerEnds; // until they are merged
  const std::size_t EndCount;
  std::vector<char> AreFixed; // each of these
  CrossingMesh Result;        // of these vertices
};

} // namespace

CrossingMesh mergeVertices(const Execution& execution, MergeableTriangles triangles)
{
  return VertexMerger(execution, std::move(triangles)).merge();
}

CrossingMesh inOrder(
  const Execution& execution, const CrossingMesh& mesh, const std::vector<std::size_t>& order)
{
  CrossingMesh result;
  std::vector<std::size_t> members;
  result.memberBegins = chosenLists(execution, mesh.memberBegins, order, members);
  result.members = chosenOf(execution, mesh.members, mesh.memberBegins.empty() ? order : members);
  result.positions = chosenOf(execution, mesh.positions, order);
  const std::vector<std::size_t> numbers = inverseOf(execution, order, mesh.size());
  result.triangles = renumbered(execution, mesh.triangles, numbers, order.size());
  result.caps = renumbered(execution, mesh.caps, numbers, order.size());
  return result;
}

} // namespace isopoint
