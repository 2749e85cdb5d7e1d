// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/SurfacePieces.h"

#include "Core/Triangles/SurfaceMesh.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace isopoint
{
namespace
{

/// Sets of vertices that are connected, each named by one of its vertices.
class ConnectedVertices
{
public:
  explicit ConnectedVertices(std::size_t count)
    : Parents(count)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), std::size_t{ 0 });
  }

  std::size_t rootOf(std::size_t vertex)
  {
    while (this->Parents[vertex] != vertex)
    {
      this->Parents[vertex] = this->Parents[this->Parents[vertex]];
      vertex = this->Parents[vertex];
    }
    return vertex;
  }

  void unite(std::size_t a, std::size_t b)
  {
    const auto [low, high] = std::minmax({ this->rootOf(a), this->rootOf(b) });
    this->Parents[high] = low;
  }

private:
  std::vector<std::size_t> Parents; // itself for roots
};

struct Piece
{
  double area = 0.0;
  double volume = 0.0; // enclosed, if closed
  bool isClosed = true;
};

} // namespace

std::vector<char> areOfSmallPieces(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<SurfaceTriangle>& triangles, double share)
{
  const SurfaceMesh mesh(execution, triangles, positions.size());
  ConnectedVertices connected(positions.size());
  forEachInOrder(execution, triangles.size(),
    [&](std::size_t i)
    {
      connected.unite(triangles[i][0], triangles[i][1]);
      connected.unite(triangles[i][0], triangles[i][2]);
    });
  std::vector<Piece> pieces(positions.size()); // by root
  forEachInOrder(execution, triangles.size(),
    [&](std::size_t i)
    {
      const auto& [a, b, c] = triangles[i];
      const std::size_t root = connected.rootOf(a);
      const Vector& origin = positions[root]; // near, so that no digits are lost
      const Vector normal = cross(positions[b] - positions[a], positions[c] - positions[a]);
      pieces[root].area += 0.5 * lengthOf(normal);
      pieces[root].volume += dot(positions[a] - origin, normal) / 6.0;
      for (std::size_t side = 3 * i; side < 3 * i + 3; ++side)
      {
        pieces[root].isClosed = pieces[root].isClosed && mesh.twinOf(side) != noHalfEdge;
      }
    });
  const double largest = std::max_element(pieces.begin(), pieces.end(),
    [](const Piece& a, const Piece& b) {
      return a.area < b.area;
    })->area;
  std::vector<char> marks(triangles.size(), 0);
  forEachInOrder(execution, triangles.size(),
    [&](std::size_t i)
    {
      const Piece& own = pieces[connected.rootOf(triangles[i][0])];
      const bool isBubble = own.isClosed && own.volume < 0.0;
      marks[i] = own.area < share * largest && !isBubble ? 1 : 0;
    });
  return marks;
}

} // namespace isopoint
