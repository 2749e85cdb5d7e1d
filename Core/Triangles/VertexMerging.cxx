// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/VertexMerging.h"

#include "Core/Base/Lists.h"
#include "Core/Triangles/EdgeFlipping.h"
#include "Core/Triangles/ShortEdges.h"
#include "Core/Triangles/VertexContraction.h"
#include "Core/Triangles/VertexLink.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace isopoint
{
namespace
{

class VertexMerger
{
public:
  VertexMerger(const Execution& execution, const std::vector<Vector>& crossings,
    std::vector<SurfaceTriangle> triangles, std::vector<char> areKept)
    : Exec(execution)
    , Crossings(crossings)
    , Vertices{ crossings, std::vector<double>(crossings.size(), 1.0) }
    , AreKept(std::move(areKept))
  {
    this->AreKept.resize(crossings.size(), 0);
    for (const std::size_t vertex : branchedVertices(execution, triangles, crossings.size()))
    {
      this->AreKept[vertex] = 1;
    }
    this->Result.triangles = std::move(triangles);
    this->Result.members.resize(crossings.size());
    std::iota(this->Result.members.begin(), this->Result.members.end(), std::size_t{ 0 });
    this->Result.memberBegins.resize(crossings.size() + 1);
    std::iota(this->Result.memberBegins.begin(), this->Result.memberBegins.end(), std::size_t{ 0 });
  }

  MergedTriangles merge(std::vector<std::size_t> nearerEnds, std::size_t endCount)
  {
    this->contract(std::move(nearerEnds), endCount);
    this->Exec.progress(0.7);
    for (int round = 0; round < shortEdgeRounds; ++round)
    {
      flipEdges(this->Exec, this->Vertices.positions, this->AreKept, this->Result.triangles);
      this->contract(this->pairsOfShortEdges(), this->count());
    }
    this->Result.positions = std::move(this->Vertices.positions);
    forEachIndex(this->Exec, this->Result.size(),
      [this](std::size_t vertex) { this->putNearestFirst(vertex); });
    this->Exec.progress(1.0);
    return std::move(this->Result);
  }

private:
  std::size_t count() const { return this->Vertices.weights.size(); }

  /// Merges the vertices of each group if possible, and renumbers.
  void contract(std::vector<std::size_t> groups, std::size_t groupCount)
  {
    forEachInOrder(this->Exec, this->count(),
      [&](std::size_t vertex)
      {
        if (this->AreKept[vertex])
        {
          groups[vertex] = groupCount++; // alone
        }
      });
    VertexContraction contraction(
      this->Exec, this->Vertices, this->Result.triangles, groups, groupCount);
    contraction.contract();
    const std::vector<std::size_t> roots = itemsThat(this->Exec, this->count(),
      [&](std::size_t vertex) { return contraction.rootOf(vertex) == vertex; });
    std::vector<char> areKept(roots.size());
    forEachIndex(
      this->Exec, roots.size(), [&](std::size_t i) { areKept[i] = this->AreKept[roots[i]]; });
    this->AreKept = std::move(areKept);
    std::vector<SurfaceTriangle> triangles = this->trianglesOf(contraction, roots);
    this->keepVertices(contraction, roots);
    this->Result.triangles = std::move(triangles);
  }

  std::vector<SurfaceTriangle> trianglesOf(
    const VertexContraction& contraction, const std::vector<std::size_t>& roots) const
  {
    constexpr std::size_t grain = 4096;
    return renumbered(this->Exec,
      collected<SurfaceTriangle>(this->Exec, { this->Result.triangles.size(), 4 * grain, grain },
        [&](std::size_t begin, std::size_t end, std::vector<SurfaceTriangle>& found)
        {
          for (std::size_t i = begin; i < end; ++i)
          {
            const auto& [a, b, c] = this->Result.triangles[i];
            const SurfaceTriangle moved{ contraction.rootOf(a), contraction.rootOf(b),
              contraction.rootOf(c) };
            if (moved[0] != moved[1] && moved[1] != moved[2] && moved[2] != moved[0])
            {
              found.push_back(moved);
            }
          }
        }),
      roots, this->count());
  }

  void keepVertices(const VertexContraction& contraction, const std::vector<std::size_t>& roots)
  {
    WeightedVertices vertices;
    std::vector<std::size_t> members;
    std::vector<std::size_t> begins(1, 0);
    forEachInOrder(this->Exec, roots.size(),
      [&](std::size_t i)
      {
        for (const std::size_t former : contraction.membersOf(roots[i]))
        {
          const auto begin = this->Result.members.begin();
          members.insert(members.end(),
            begin + static_cast<std::ptrdiff_t>(this->Result.memberBegins[former]),
            begin + static_cast<std::ptrdiff_t>(this->Result.memberBegins[former + 1]));
        }
        vertices.positions.push_back(contraction.positionOf(roots[i]));
        vertices.weights.push_back(static_cast<double>(members.size() - begins.back()));
        begins.push_back(members.size());
      });
    this->Vertices = std::move(vertices);
    this->Result.members = std::move(members);
    this->Result.memberBegins = std::move(begins);
  }

  /// Pairs vertices along short edges, shortest first. @returns the first vertex of each one's pair
  std::vector<std::size_t> pairsOfShortEdges() const
  {
    std::vector<std::size_t> groups(this->count());
    std::iota(groups.begin(), groups.end(), std::size_t{ 0 });
    std::vector<bool> isTaken(this->count(), false);
    const std::vector<VertexPair> edges =
      shortEdges(this->Exec, this->Vertices.positions, this->Result.triangles);
    forEachInOrder(this->Exec, edges.size(),
      [&](std::size_t i)
      {
        const auto& [a, b] = edges[i];
        if (!isTaken[a] && !isTaken[b])
        {
          isTaken[a] = isTaken[b] = true;
          groups[b] = a;
        }
      });
    return groups;
  }

  void putNearestFirst(std::size_t vertex)
  {
    const auto begin =
      this->Result.members.begin() + static_cast<std::ptrdiff_t>(this->Result.memberBegins[vertex]);
    const auto end = this->Result.members.begin() +
                     static_cast<std::ptrdiff_t>(this->Result.memberBegins[vertex + 1]);
    const auto distanceOf = [&](std::size_t crossing)
    { return lengthOf(this->Crossings[crossing] - this->Result.positions[vertex]); };
    const auto nearest = std::min_element(
      begin, end, [&](std::size_t a, std::size_t b) { return distanceOf(a) < distanceOf(b); });
    std::rotate(begin, nearest, nearest + 1);
  }

  const Execution& Exec;
  const std::vector<Vector>& Crossings;
  WeightedVertices Vertices;
  std::vector<char> AreKept; // each of these
  MergedTriangles Result;    // of these vertices
};

} // namespace

MergedTriangles mergeVertices(const Execution& execution, const std::vector<Vector>& crossings,
  const std::vector<std::size_t>& nearerEnds, std::size_t endCount,
  std::vector<SurfaceTriangle> triangles, std::vector<char> areKept)
{
  return VertexMerger(execution, crossings, std::move(triangles), std::move(areKept))
    .merge(nearerEnds, endCount);
}

} // namespace isopoint
