// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/SurfacePieces.h"

#include "Core/Base/Lists.h"
#include "Core/Base/Region.h"
#include "Core/Triangles/ConnectedVertices.h"

#include <algorithm>

namespace isopoint
{
namespace
{

/// The solid angle of a triangle seen from a position, in full spheres: positive from behind
/// [OS83].
double solidAngle(const Vector& a, const Vector& b, const Vector& c)
{
  constexpr double fullSphere = 12.566370614359172;
  const double lengthA = lengthOf(a);
  const double lengthB = lengthOf(b);
  const double lengthC = lengthOf(c);
  const double divisor =
    lengthA * lengthB * lengthC + dot(a, b) * lengthC + dot(b, c) * lengthA + dot(c, a) * lengthB;
  return 2.0 * std::atan2(dot(a, cross(b, c)), divisor) / fullSphere;
}

class SmallPieces
{
public:
  SmallPieces(const Execution& execution, const std::vector<Vector>& positions,
    const std::vector<SurfaceTriangle>& triangles)
    : Run(execution)
    , Positions(positions)
    , Triangles(triangles)
    , Pieces(piecesOf(execution, triangles, positions.size()))
    , Areas(positions.size(), 0.0)
  {
    forEachInOrder(execution, triangles.size(),
      [this](std::size_t i)
      {
        this->Areas[this->pieceAt(i)] +=
          0.5 * lengthOf(areaNormal(this->Positions, this->Triangles[i]));
      });
  }

  std::vector<char> find(double share, bool areBodies)
  {
    const double largest = *std::max_element(this->Areas.begin(), this->Areas.end());
    std::vector<double> volumes(this->Areas.size(), 0.0);
    if (areBodies)
    {
      volumes = volumesOf(this->Run, this->Pieces, this->Positions, this->Triangles);
    }
    this->AreSmall = tabulated<char>(this->Run, this->Areas.size(),
      [&](std::size_t piece)
      { return this->Areas[piece] < share * largest && volumes[piece] >= 0.0; });
    this->addBubbles(itemsThat(
      this->Run, volumes.size(), [&](std::size_t piece) { return volumes[piece] < 0.0; }));
    return tabulated<char>(this->Run, this->Triangles.size(),
      [this](std::size_t i) { return this->AreSmall[this->pieceAt(i)]; });
  }

private:
  std::size_t pieceAt(std::size_t triangle) const
  {
    return this->Pieces[this->Triangles[triangle][0]];
  }

  /// Adds the bubbles within small pieces.
  void addBubbles(const std::vector<std::size_t>& bubbles)
  {
    if (bubbles.empty())
    {
      return;
    }
    std::vector<Region> boxes(this->Positions.size(), emptyRegion); // by piece
    forEachInOrder(this->Run, this->Triangles.size(),
      [&](std::size_t i)
      {
        for (const std::size_t vertex : this->Triangles[i])
        {
          Region& box = boxes[this->pieceAt(i)];
          box = united(box, { this->Positions[vertex], this->Positions[vertex] });
        }
      });
    std::vector<double> windings(bubbles.size(), 0.0); // around their first vertices
    forEachIndex(this->Run, bubbles.size(),
      [&](std::size_t i)
      {
        const Vector& position = this->Positions[bubbles[i]];
        for (std::size_t k = 0; k < this->Triangles.size(); ++k)
        {
          const std::size_t piece = this->pieceAt(k);
          const Vector gap = gapTo(boxes[piece], position);
          if (this->AreSmall[piece] && dot(gap, gap) == 0.0)
          {
            const auto& [a, b, c] = this->Triangles[k];
            windings[i] += solidAngle(this->Positions[a] - position, this->Positions[b] - position,
              this->Positions[c] - position);
          }
        }
      });
    for (std::size_t i = 0; i < bubbles.size(); ++i)
    {
      this->AreSmall[bubbles[i]] = windings[i] > 0.5 ? 1 : 0;
    }
  }

  const Execution& Run;
  const std::vector<Vector>& Positions;
  const std::vector<SurfaceTriangle>& Triangles;
  const std::vector<std::size_t> Pieces;
  std::vector<double> Areas;  // by piece
  std::vector<char> AreSmall; // likewise
};

} // namespace

std::vector<std::size_t> piecesOf(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, std::size_t vertexCount)
{
  ConnectedVertices connected(execution, vertexCount);
  forEachIndex(execution, triangles.size(),
    [&](std::size_t i)
    {
      connected.unite(triangles[i][0], triangles[i][1]);
      connected.unite(triangles[i][0], triangles[i][2]);
    });
  return connected.roots(execution);
}

std::vector<double> volumesOf(const Execution& execution, const std::vector<std::size_t>& pieces,
  const std::vector<Vector>& positions, const std::vector<SurfaceTriangle>& triangles)
{
  std::vector<double> volumes(positions.size(), 0.0);
  forEachInOrder(execution, triangles.size(),
    [&](std::size_t i)
    {
      const std::size_t first = triangles[i][0];
      const Vector& origin = positions[pieces[first]]; // near, so that no digits are lost
      volumes[pieces[first]] +=
        dot(positions[first] - origin, areaNormal(positions, triangles[i])) / 6.0;
    });
  return volumes;
}

std::vector<char> areOfSmallPieces(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<SurfaceTriangle>& triangles, double share, bool areBodies)
{
  return SmallPieces(execution, positions, triangles).find(share, areBodies);
}

} // namespace isopoint
