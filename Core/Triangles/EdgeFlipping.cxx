// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/EdgeFlipping.h"

#include "Core/Base/Lists.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace isopoint
{
namespace
{

/// Three times the number of a triangle, plus the corner where the side begins, counterclockwise.
using Side = std::size_t;

/// The minimum cosine between the normals of an upright triangle and of its vertices.
constexpr double upright = 0.6;

constexpr Side noSide = std::numeric_limits<Side>::max();

Side nextOf(Side side)
{
  return side % 3 == 2 ? side - 2 : side + 1;
}

Side lastOf(Side side)
{
  return nextOf(nextOf(side));
}

class EdgeFlipper
{
public:
  EdgeFlipper(const Execution& execution, const std::vector<Vector>& positions,
    const std::vector<char>& areKept, std::vector<SurfaceTriangle>& triangles)
    : Exec(execution)
    , Positions(positions)
    , AreKept(areKept)
    , Triangles(triangles)
    , Twins(3 * triangles.size(), noSide)
    , Normals(positions.size())
    , Degrees(positions.size(), 0)
  {
    this->findTwins();
    this->findNormals();
  }

  void flip()
  {
    constexpr int maxRounds = 10;
    std::vector<char> isSuspect(this->Twins.size(), 1);
    bool isAnyFlipped = true;
    for (int round = 0; round < maxRounds && isAnyFlipped; ++round)
    {
      isAnyFlipped = false;
      forEachInOrder(this->Exec, this->Twins.size(),
        [&](Side side)
        {
          const Side twin = this->Twins[side];
          if (!isSuspect[side] || twin == noSide)
          {
            return;
          }
          isSuspect[side] = isSuspect[twin] = 0;
          if (this->isToFlip(side, twin))
          {
            this->flipAt(side, twin);
            this->suspectAround(side, isSuspect);
            this->suspectAround(twin, isSuspect);
            isAnyFlipped = true;
          }
        });
    }
  }

private:
  std::size_t startOf(Side side) const { return this->Triangles[side / 3][side % 3]; }
  std::size_t endOf(Side side) const { return this->startOf(nextOf(side)); }

  std::size_t oppositeOf(Side side) const { return this->startOf(lastOf(side)); }

  Vector edgeOf(std::size_t from, std::size_t to) const
  {
    return this->Positions[to] - this->Positions[from];
  }

  Vector normalOf(std::size_t a, std::size_t b, std::size_t c) const
  {
    return cross(this->edgeOf(a, b), this->edgeOf(a, c));
  }

  /// Pairs the sides of edges with exactly two triangles.
  void findTwins()
  {
    const ItemLists byLowerEnd(this->Exec, this->Positions.size(), this->Twins.size(),
      [this](Side side) { return std::array{ std::min(this->startOf(side), this->endOf(side)) }; });
    forEachIndex(this->Exec, this->Positions.size(),
      [&](std::size_t vertex)
      {
        const IndexSpan<Side> list = byLowerEnd.at(vertex);
        std::vector<Side> sides(list.begin(), list.end());
        const auto upperOf = [this](Side side)
        { return std::max(this->startOf(side), this->endOf(side)); };
        std::sort(sides.begin(), sides.end(),
          [&](Side a, Side b)
          { return upperOf(a) != upperOf(b) ? upperOf(a) < upperOf(b) : a < b; });
        for (auto first = sides.begin(); first != sides.end();)
        {
          const auto last = std::find_if(
            first, sides.end(), [&](Side side) { return upperOf(side) != upperOf(*first); });
          if (last - first == 2 && this->startOf(first[0]) == this->endOf(first[1]))
          {
            this->Twins[first[0]] = first[1];
            this->Twins[first[1]] = first[0];
          }
          first = last;
        }
      });
  }

  /// Sets the area-weighted normals of vertices, and their degrees.
  void findNormals()
  {
    forEachInOrder(this->Exec, this->Triangles.size(),
      [this](std::size_t triangle)
      {
        const auto& [a, b, c] = this->Triangles[triangle];
        const Vector normal = this->normalOf(a, b, c);
        for (const std::size_t vertex : { a, b, c })
        {
          this->Normals[vertex] += normal;
          ++this->Degrees[vertex];
        }
      });
    forEachIndex(this->Exec, this->Normals.size(),
      [this](std::size_t vertex)
      {
        const double length = lengthOf(this->Normals[vertex]);
        this->Normals[vertex] = length > 0.0 ? 1.0 / length * this->Normals[vertex] : Vector{};
      });
  }

  bool isToFlip(Side side, Side twin) const
  {
    const std::size_t a = this->startOf(side);
    const std::size_t b = this->endOf(side);
    const std::size_t c = this->oppositeOf(side);
    const std::size_t d = this->oppositeOf(twin);
    const bool isOfKept =
      this->AreKept[a] && this->AreKept[b] && (this->AreKept[c] || this->AreKept[d]);
    return c != d && !isOfKept && this->isObtuse(a, b, c, d) && !this->isCrease(a, b, c, d) &&
           this->staysUpright(a, b, c, d) && !this->isEdge(side, twin);
  }

  /// Whether the angles at c and d, opposite the edge ab, add up to more than 180 degrees.
  bool isObtuse(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const
  {
    const auto angleAt = [&](std::size_t corner)
    {
      const Vector toA = this->edgeOf(corner, a);
      const Vector toB = this->edgeOf(corner, b);
      return std::array{ dot(toA, toB), lengthOf(cross(toA, toB)) }; // cosine, sine
    };
    const auto [cosC, sinC] = angleAt(c);
    const auto [cosD, sinD] = angleAt(d);
    constexpr double minSine = 0.01; // a smaller excess is not worth a flip
    const double scale =
      std::sqrt(cosC * cosC + sinC * sinC) * std::sqrt(cosD * cosD + sinD * sinD);
    return sinC * cosD + cosC * sinD < -minSine * scale;
  }

  /// The cosine between the normals of a triangle and of its vertices.
  double uprightness(const SurfaceTriangle& triangle) const
  {
    const auto& [a, b, c] = triangle;
    const Vector normal = this->normalOf(a, b, c);
    const Vector around = this->Normals[a] + this->Normals[b] + this->Normals[c];
    const double lengths = lengthOf(normal) * lengthOf(around);
    return lengths > 0.0 ? dot(normal, around) / lengths : -1.0;
  }

  double minUprightness(const SurfaceTriangle& first, const SurfaceTriangle& second) const
  {
    return std::min(this->uprightness(first), this->uprightness(second));
  }

  /// Whether the surface bends by more than 60 degrees at the edge, and no triangle is folded over.
  bool isCrease(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const
  {
    constexpr double minCosine = 0.5;
    const Vector first = this->normalOf(a, b, c);
    const Vector second = this->normalOf(b, a, d);
    return dot(first, second) < minCosine * lengthOf(first) * lengthOf(second) &&
           this->minUprightness({ a, b, c }, { b, a, d }) >= upright;
  }

  /// Whether a flip leaves two triangles that are upright, or at least as upright as before.
  bool staysUpright(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const
  {
    const double after = this->minUprightness({ c, a, d }, { d, b, c });
    return after >= upright ||
           (after > 0.0 && after >= this->minUprightness({ a, b, c }, { b, a, d }));
  }

  /// Whether the opposite corners are, or may be, connected, which forbids a flip.
  bool isEdge(Side side, Side twin) const
  {
    if (this->Degrees[this->oppositeOf(side)] > this->Degrees[this->oppositeOf(twin)])
    {
      std::swap(side, twin); // the corner with fewer triangles
    }
    const std::size_t other = this->oppositeOf(twin);
    const Side start = lastOf(side); // from the opposite corner
    const std::size_t corner = this->startOf(start);
    std::size_t count = 0; // of triangles around that
    bool isFound = false;
    const auto look = [&](Side at)
    {
      ++count;
      isFound = isFound || this->endOf(at) == other || this->oppositeOf(at) == other;
    };
    Side at = start;
    do
    {
      look(at);
      at = this->Twins[lastOf(at)];
    } while (at != noSide && at != start && !isFound);
    if (at == noSide)
    {
      // At a border, also in the other direction.
      for (at = this->Twins[start]; at != noSide && !isFound; at = this->Twins[at])
      {
        at = nextOf(at);
        look(at);
      }
    }
    return isFound || count != this->Degrees[corner]; // several disks may meet there
  }

  /// Replaces the triangles (a, b, c) and (b, a, d) by (c, a, d) and (d, b, c).
  void flipAt(Side side, Side twin)
  {
    const std::size_t a = this->startOf(side);
    const std::size_t b = this->endOf(side);
    const std::size_t c = this->oppositeOf(side);
    const std::size_t d = this->oppositeOf(twin);
    const Side bc = this->Twins[nextOf(side)];
    const Side ca = this->Twins[lastOf(side)];
    const Side ad = this->Twins[nextOf(twin)];
    const Side db = this->Twins[lastOf(twin)];
    const Side first = side / 3 * 3;
    const Side second = twin / 3 * 3;
    this->Triangles[first / 3] = { c, a, d };
    this->Triangles[second / 3] = { d, b, c };
    --this->Degrees[a];
    --this->Degrees[b];
    ++this->Degrees[c];
    ++this->Degrees[d];
    this->join(first, ca);
    this->join(first + 1, ad);
    this->join(second, db);
    this->join(second + 1, bc);
    this->join(first + 2, second + 2);
  }

  void join(Side side, Side twin)
  {
    this->Twins[side] = twin;
    if (twin != noSide)
    {
      this->Twins[twin] = side;
    }
  }

  /// Marks the sides of a triangle for another check, except the new edge.
  void suspectAround(Side side, std::vector<char>& isSuspect) const
  {
    const Side first = side / 3 * 3;
    for (Side each = first; each < first + 2; ++each)
    {
      isSuspect[each] = 1;
      if (this->Twins[each] != noSide)
      {
        isSuspect[this->Twins[each]] = 1;
      }
    }
  }

  const Execution& Exec;
  const std::vector<Vector>& Positions;
  const std::vector<char>& AreKept; // each vertex
  std::vector<SurfaceTriangle>& Triangles;
  std::vector<Side> Twins; // of sides
  std::vector<Vector> Normals;
  std::vector<std::size_t> Degrees; // of vertices
};

} // namespace

void flipEdges(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<char>& areKept, std::vector<SurfaceTriangle>& triangles)
{
  EdgeFlipper(execution, positions, areKept, triangles).flip();
  triangles = ordered(execution, std::move(triangles), positions.size());
}

} // namespace isopoint
