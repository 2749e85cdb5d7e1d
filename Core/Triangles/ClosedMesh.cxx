// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/ClosedMesh.h"

#include "Core/Base/Lists.h"
#include "Core/Base/Sorting.h"

#include <algorithm>
#include <array>

namespace isopoint
{
namespace
{

class FanSeparation
{
public:
  FanSeparation(const Execution& execution, const std::vector<SurfaceTriangle>& triangles,
    const std::vector<HalfEdge>& twins, const std::vector<std::size_t>& pointOf,
    std::size_t pointCount)
    : Run(execution)
    , PointCount(pointCount)
  {
    this->mergePoints(triangles, pointOf, twins);
  }

  ClosedTriangles closed()
  {
    do
    {
      this->numberFans();
    } while (this->pairAnew());
    return this->ordered();
  }

private:
  std::size_t pointAt(HalfEdge side) const { return this->Triangles[side / 3][side % 3]; }
  std::size_t fanAt(HalfEdge side) const { return this->Fans[side]; }

  /// Keeps the triangles at three points, ordered. Their twins are across the vanished ones.
  void mergePoints(const std::vector<SurfaceTriangle>& all, const std::vector<std::size_t>& pointOf,
    const std::vector<HalfEdge>& twins)
  {
    const auto startOf = [&](HalfEdge side) { return pointOf[all[side / 3][side % 3]]; };
    const auto isAtPoint = [&](HalfEdge side) { return startOf(side) == startOf(nextOf(side)); };
    const auto isKept = [&](std::size_t triangle)
    {
      return !isAtPoint(3 * triangle) && !isAtPoint(3 * triangle + 1) &&
             !isAtPoint(3 * triangle + 2);
    };
    this->Sources = itemsThat(this->Run, all.size(), isKept);
    this->orderSources(all, pointOf);
    std::vector<HalfEdge> newSides(3 * all.size(), noHalfEdge);
    this->Triangles.resize(this->Sources.size());
    std::vector<HalfEdge> formerSides(3 * this->Sources.size());
    forEachIndex(this->Run, this->Sources.size(),
      [&](std::size_t i)
      {
        HalfEdge side = this->firstSide(all, pointOf, this->Sources[i]);
        for (std::size_t corner = 0; corner < 3; ++corner, side = nextOf(side))
        {
          this->Triangles[i][corner] = startOf(side);
          newSides[side] = 3 * i + corner;
          formerSides[3 * i + corner] = side;
        }
      });
    this->Twins = tabulated<HalfEdge>(this->Run, formerSides.size(),
      [&](HalfEdge side)
      {
        HalfEdge twin = twins[formerSides[side]];
        while (newSides[twin] == noHalfEdge)
        {
          // One of the other two sides is at a point.
          twin = twins[isAtPoint(nextOf(twin)) ? lastOf(twin) : nextOf(twin)];
        }
        return newSides[twin];
      });
  }

  /// The side of a triangle that begins at the lowest point.
  static HalfEdge firstSide(const std::vector<SurfaceTriangle>& all,
    const std::vector<std::size_t>& pointOf, std::size_t triangle)
  {
    const std::array<std::size_t, 3> points{ pointOf[all[triangle][0]], pointOf[all[triangle][1]],
      pointOf[all[triangle][2]] };
    return 3 * triangle + static_cast<std::size_t>(
                            std::min_element(points.begin(), points.end()) - points.begin());
  }

  void orderSources(
    const std::vector<SurfaceTriangle>& all, const std::vector<std::size_t>& pointOf)
  {
    const auto pointsOf = [&](std::size_t i) -> SurfaceTriangle
    {
      const HalfEdge side = firstSide(all, pointOf, this->Sources[i]);
      const auto at = [&](HalfEdge corner) { return pointOf[all[corner / 3][corner % 3]]; };
      return { at(side), at(nextOf(side)), at(lastOf(side)) };
    };
    this->Sources = chosenOf(this->Run, this->Sources,
      orderByKeys(this->Run, this->Sources.size(), this->PointCount, pointsOf, firstOf));
  }

  static std::size_t firstOf(const SurfaceTriangle& triangle) { return triangle[0]; }

  /// Numbers the fans by point, then by their first triangle.
  void numberFans()
  {
    this->Fans.assign(this->Twins.size(), noHalfEdge);
    std::vector<std::size_t> points; // of the fans in the order of their first triangles
    forEachInOrder(this->Run, this->Twins.size(),
      [&](HalfEdge first)
      {
        if (this->Fans[first] == noHalfEdge)
        {
          HalfEdge side = first;
          do
          {
            this->Fans[side] = points.size();
            side = this->Twins[lastOf(side)];
          } while (side != first);
          points.push_back(this->pointAt(first));
        }
      });
    const std::vector<std::size_t> order = orderByKeys(
      this->Run, points.size(), this->PointCount, [&](std::size_t fan) { return points[fan]; },
      [](std::size_t point) { return point; });
    this->Points = chosenOf(this->Run, points, order);
    this->Fans = chosenOf(this->Run, inverseOf(this->Run, order, order.size()), this->Fans);
  }

  /// Exchanges the twins of two edges with the same two vertices, which separates a fan at each.
  /// Only one exchange at a vertex: another one could join its fans again.
  /// @returns whether there were any
  bool pairAnew()
  {
    using Edge = std::array<std::size_t, 2>; // vertices
    const auto edgeOf = [this](HalfEdge side) -> Edge {
      return { this->fanAt(side), this->fanAt(nextOf(side)) };
    };
    const std::vector<HalfEdge> rising = itemsThat(this->Run, this->Fans.size(),
      [&](HalfEdge side) { return this->fanAt(side) < this->fanAt(nextOf(side)); });
    const std::vector<HalfEdge> sides = chosenOf(this->Run, rising,
      orderByKeys(
        this->Run, rising.size(), this->Points.size(),
        [&](std::size_t i) { return edgeOf(rising[i]); },
        [](const Edge& edge) { return edge[0]; }));
    bool isAny = false;
    std::vector<char> areChanged(this->Points.size(), 0);
    forEachInOrder(this->Run, sides.empty() ? 0 : sides.size() - 1,
      [&](std::size_t i)
      {
        const auto [start, end] = edgeOf(sides[i]);
        if (edgeOf(sides[i + 1]) == Edge{ start, end } && !areChanged[start] && !areChanged[end])
        {
          areChanged[start] = 1;
          areChanged[end] = 1;
          const HalfEdge last = this->Twins[sides[i + 1]];
          this->pair(sides[i + 1], this->Twins[sides[i]]);
          this->pair(sides[i], last);
          isAny = true;
        }
      });
    return isAny;
  }

  void pair(HalfEdge side, HalfEdge twin)
  {
    this->Twins[side] = twin;
    this->Twins[twin] = side;
  }

  ClosedTriangles ordered() const
  {
    // The fan at the lowest point is the lowest one.
    const std::vector<SurfaceTriangle> all =
      tabulated<SurfaceTriangle>(this->Run, this->Triangles.size(),
        [this](std::size_t i) -> SurfaceTriangle {
          return { this->Fans[3 * i], this->Fans[3 * i + 1], this->Fans[3 * i + 2] };
        });
    const std::vector<std::size_t> order = orderByKeys(
      this->Run, all.size(), this->Points.size(), [&](std::size_t i) { return all[i]; }, firstOf);
    return { this->Points, chosenOf(this->Run, all, order),
      chosenOf(this->Run, this->Sources, order) };
  }

  const Execution& Run;
  const std::size_t PointCount;
  std::vector<std::size_t> Sources;       // of the triangles
  std::vector<SurfaceTriangle> Triangles; // of points
  std::vector<HalfEdge> Twins;
  std::vector<std::size_t> Fans;   // by side, that of its start
  std::vector<std::size_t> Points; // by fan
};

} // namespace

ClosedTriangles closedTriangles(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<HalfEdge>& twins,
  const std::vector<std::size_t>& pointOf, std::size_t pointCount)
{
  return FanSeparation(execution, triangles, twins, pointOf, pointCount).closed();
}

} // namespace isopoint
