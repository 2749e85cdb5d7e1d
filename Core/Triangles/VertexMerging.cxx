// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/VertexMerging.h"

#include "Core/Base/SortUnique.h"
#include "Core/Triangles/EdgeFlipping.h"
#include "Core/Triangles/VertexContraction.h"
#include "Core/Triangles/VertexLink.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace isopoint
{
namespace
{

/// An edge is short if it is shorter than this share of the side of an equilateral triangle that is
/// as large as the mean of those around its first end and of those around its second one.
constexpr double shortEdge = 0.55;

/// How often edges are flipped and then short ones merged.
constexpr int shortEdgeRounds = 3;

class VertexMerger
{
public:
  VertexMerger(const Execution& execution, const std::vector<Vector>& crossings,
    std::vector<SurfaceTriangle> triangles)
    : Run(execution)
    , Crossings(crossings)
    , Vertices{ crossings, std::vector<double>(crossings.size(), 1.0) }
  {
    this->Result.triangles = std::move(triangles);
    this->Result.members.resize(crossings.size());
    std::iota(this->Result.members.begin(), this->Result.members.end(), std::size_t{ 0 });
    this->Result.memberBegins.resize(crossings.size() + 1);
    std::iota(this->Result.memberBegins.begin(), this->Result.memberBegins.end(), std::size_t{ 0 });
  }

  MergedTriangles merge(std::vector<std::size_t> nearerEnds, std::size_t endCount)
  {
    this->Branched = branchedVertices(this->Run, this->Result.triangles, this->count());
    this->contract(std::move(nearerEnds), endCount);
    this->Run.progress(0.7);
    for (int round = 0; round < shortEdgeRounds; ++round)
    {
      flipEdges(this->Run, this->Vertices.positions, this->Result.triangles);
      this->contract(this->shortEdges(), this->count());
    }
    this->Result.positions = std::move(this->Vertices.positions);
    forEachIndex(this->Run, this->Result.size(),
      [this](std::size_t vertex) { this->putNearestFirst(vertex); });
    this->Run.progress(1.0);
    return std::move(this->Result);
  }

private:
  std::size_t count() const { return this->Vertices.weights.size(); }

  /// Merges those vertices of each group that can be, and numbers what is left.
  void contract(std::vector<std::size_t> groups, std::size_t groupCount)
  {
    for (const std::size_t vertex : this->Branched)
    {
      groups[vertex] = groupCount++; // alone
    }
    VertexContraction contraction(
      this->Run, this->Vertices, this->Result.triangles, groups, groupCount);
    contraction.contract();
    std::vector<std::size_t> roots;
    for (std::size_t vertex = 0; vertex < this->count(); ++vertex)
    {
      if (contraction.rootOf(vertex) == vertex)
      {
        roots.push_back(vertex);
      }
    }
    for (std::size_t& vertex : this->Branched)
    {
      vertex = static_cast<std::size_t>(
        std::lower_bound(roots.begin(), roots.end(), vertex) - roots.begin());
    }
    std::vector<SurfaceTriangle> triangles = this->trianglesOf(contraction, roots);
    this->keepVertices(contraction, roots);
    this->Result.triangles = std::move(triangles);
  }

  std::vector<SurfaceTriangle> trianglesOf(
    const VertexContraction& contraction, const std::vector<std::size_t>& roots) const
  {
    std::vector<SurfaceTriangle> triangles;
    for (const SurfaceTriangle& triangle : this->Result.triangles)
    {
      const SurfaceTriangle moved{ contraction.rootOf(triangle[0]), contraction.rootOf(triangle[1]),
        contraction.rootOf(triangle[2]) };
      if (moved[0] != moved[1] && moved[1] != moved[2] && moved[2] != moved[0])
      {
        triangles.push_back(moved);
      }
    }
    return renumbered(this->Run, triangles, roots, this->count());
  }

  void keepVertices(const VertexContraction& contraction, const std::vector<std::size_t>& roots)
  {
    WeightedVertices vertices;
    std::vector<std::size_t> members;
    std::vector<std::size_t> begins(1, 0);
    for (const std::size_t root : roots)
    {
      for (const std::size_t former : contraction.membersOf(root))
      {
        const auto begin = this->Result.members.begin();
        members.insert(members.end(),
          begin + static_cast<std::ptrdiff_t>(this->Result.memberBegins[former]),
          begin + static_cast<std::ptrdiff_t>(this->Result.memberBegins[former + 1]));
      }
      vertices.positions.push_back(contraction.positionOf(root));
      vertices.weights.push_back(static_cast<double>(members.size() - begins.back()));
      begins.push_back(members.size());
    }
    this->Vertices = std::move(vertices);
    this->Result.members = std::move(members);
    this->Result.memberBegins = std::move(begins);
  }

  /// The vertices in pairs that short edges connect, the shortest first: the first of each pair, or
  /// a vertex itself.
  std::vector<std::size_t> shortEdges() const
  {
    std::vector<ShortEdge> edges = this->allShortEdges();
    std::sort(edges.begin(), edges.end());
    std::vector<std::size_t> groups(this->count());
    std::iota(groups.begin(), groups.end(), std::size_t{ 0 });
    std::vector<bool> isTaken(this->count(), false);
    for (const ShortEdge& edge : edges)
    {
      if (!isTaken[edge.first] && !isTaken[edge.second])
      {
        isTaken[edge.first] = isTaken[edge.second] = true;
        groups[edge.second] = edge.first;
      }
    }
    return groups;
  }

  struct ShortEdge
  {
    double share; // see shortEdge
    std::size_t first;
    std::size_t second;

    bool operator<(const ShortEdge& other) const
    {
      return this->share != other.share   ? this->share < other.share
             : this->first != other.first ? this->first < other.first
                                          : this->second < other.second;
    }
  };

  std::vector<ShortEdge> allShortEdges() const
  {
    const std::vector<Vector>& positions = this->Vertices.positions;
    const auto edgeOf = [&](std::size_t a, std::size_t b)
    { return difference(positions[b], positions[a]); };
    std::vector<double> areas(this->count(), 0.0); // of the triangles around
    std::vector<double> counts(this->count(), 0.0);
    for (const auto& [a, b, c] : this->Result.triangles)
    {
      const double area = 0.5 * lengthOf(cross(edgeOf(a, b), edgeOf(a, c)));
      for (const std::size_t vertex : { a, b, c })
      {
        areas[vertex] += area;
        counts[vertex] += 1.0;
      }
    }
    constexpr double equilateral = 1.5196713713031851; // side over the root of the area
    std::vector<ShortEdge> edges;
    for (const SurfaceTriangle& triangle : this->Result.triangles)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        const auto [a, b] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
        const double area = (areas[a] + areas[b]) / (counts[a] + counts[b]);
        const double share = lengthOf(edgeOf(a, b)) / (equilateral * std::sqrt(area));
        if (share < shortEdge)
        {
          edges.push_back({ share, a, b });
        }
      }
    }
    return edges;
  }

  void putNearestFirst(std::size_t vertex)
  {
    const auto begin =
      this->Result.members.begin() + static_cast<std::ptrdiff_t>(this->Result.memberBegins[vertex]);
    const auto end = this->Result.members.begin() +
                     static_cast<std::ptrdiff_t>(this->Result.memberBegins[vertex + 1]);
    const auto distanceOf = [&](std::size_t crossing)
    { return lengthOf(difference(this->Crossings[crossing], this->Result.positions[vertex])); };
    const auto nearest = std::min_element(
      begin, end, [&](std::size_t a, std::size_t b) { return distanceOf(a) < distanceOf(b); });
    std::rotate(begin, nearest, nearest + 1);
  }

  const Execution& Run;
  const std::vector<Vector>& Crossings;
  WeightedVertices Vertices;
  std::vector<std::size_t> Branched; // of these, see branchedVertices()
  MergedTriangles Result;            // of these vertices
};

} // namespace

MergedTriangles mergeVertices(const Execution& execution, const std::vector<Vector>& crossings,
  const std::vector<std::size_t>& nearerEnds, std::size_t endCount,
  std::vector<SurfaceTriangle> triangles)
{
  return VertexMerger(execution, crossings, std::move(triangles)).merge(nearerEnds, endCount);
}

} // namespace isopoint
