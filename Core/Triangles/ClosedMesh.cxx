// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/ClosedMesh.h"

#include "Core/Base/Lists.h"

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
    const std::vector<HalfEdge>& twins, const std::vector<std::size_t>& placeOf,
    std::size_t placeCount)
    : Exec(execution)
    , PlaceCount(placeCount)
  {
    this->mergePlaces(triangles, placeOf, twins);
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
  std::size_t placeAt(HalfEdge side) const { return this->Triangles[side / 3][side % 3]; }
  std::size_t fanAt(HalfEdge side) const { return this->Fans[side]; }

  /// Keeps the triangles at three places, ordered. Their twins are across the vanished ones.
  void mergePlaces(const std::vector<SurfaceTriangle>& all, const std::vector<std::size_t>& placeOf,
    const std::vector<HalfEdge>& twins)
  {
    const auto placeOfSide = [&](HalfEdge side) { return placeOf[all[side / 3][side % 3]]; };
    const auto isAtPoint = [&](HalfEdge side)
    { return placeOfSide(side) == placeOfSide(nextOf(side)); };
    const auto isKept = [&](std::size_t triangle)
    {
      return !isAtPoint(3 * triangle) && !isAtPoint(3 * triangle + 1) &&
             !isAtPoint(3 * triangle + 2);
    };
    this->Sources = itemsThat(this->Exec, all.size(), isKept);
    this->orderSources(all, placeOf);
    std::vector<HalfEdge> newSides(3 * all.size(), noHalfEdge);
    this->Triangles.resize(this->Sources.size());
    std::vector<HalfEdge> formerSides(3 * this->Sources.size());
    forEachIndex(this->Exec, this->Sources.size(),
      [&](std::size_t i)
      {
        HalfEdge side = this->firstSide(all, placeOf, this->Sources[i]);
        for (std::size_t corner = 0; corner < 3; ++corner, side = nextOf(side))
        {
          this->Triangles[i][corner] = placeOfSide(side);
          newSides[side] = 3 * i + corner;
          formerSides[3 * i + corner] = side;
        }
      });
    this->Twins = tabulated<HalfEdge>(this->Exec, formerSides.size(),
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

  /// The side of a triangle that begins at the lowest place.
  static HalfEdge firstSide(const std::vector<SurfaceTriangle>& all,
    const std::vector<std::size_t>& placeOf, std::size_t triangle)
  {
    const std::array<std::size_t, 3> places{ placeOf[all[triangle][0]], placeOf[all[triangle][1]],
      placeOf[all[triangle][2]] };
    return 3 * triangle + static_cast<std::size_t>(
                            std::min_element(places.begin(), places.end()) - places.begin());
  }

  void orderSources(
    const std::vector<SurfaceTriangle>& all, const std::vector<std::size_t>& placeOf)
  {
    const auto placesOf = [&](std::size_t i) -> SurfaceTriangle
    {
      const HalfEdge side = firstSide(all, placeOf, this->Sources[i]);
      const auto at = [&](HalfEdge corner) { return placeOf[all[corner / 3][corner % 3]]; };
      return { at(side), at(nextOf(side)), at(lastOf(side)) };
    };
    this->Sources = chosenOf(this->Exec, this->Sources,
      orderByKeys(this->Exec, this->Sources.size(), this->PlaceCount, placesOf, firstOf));
  }

  static std::size_t firstOf(const SurfaceTriangle& triangle) { return triangle[0]; }

  /// Numbers the fans by place, then by their first triangle.
  void numberFans()
  {
    this->Fans.assign(this->Twins.size(), noHalfEdge);
    std::vector<std::size_t> places; // of the fans in the order of their first triangles
    forEachInOrder(this->Exec, this->Twins.size(),
      [&](HalfEdge first)
      {
        if (this->Fans[first] == noHalfEdge)
        {
          HalfEdge side = first;
          do
          {
            this->Fans[side] = places.size();
            side = this->Twins[lastOf(side)];
          } while (side != first);
          places.push_back(this->placeAt(first));
        }
      });
    const std::vector<std::size_t> order = orderByKeys(
      this->Exec, places.size(), this->PlaceCount, [&](std::size_t fan) { return places[fan]; },
      [](std::size_t place) { return place; });
    this->Places = chosenOf(this->Exec, places, order);
    this->Fans = chosenOf(this->Exec, placesIn(this->Exec, order, order.size()), this->Fans);
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
    const std::vector<HalfEdge> rising = itemsThat(this->Exec, this->Fans.size(),
      [&](HalfEdge side) { return this->fanAt(side) < this->fanAt(nextOf(side)); });
    const std::vector<HalfEdge> sides = chosenOf(this->Exec, rising,
      orderByKeys(
        this->Exec, rising.size(), this->Places.size(),
        [&](std::size_t i) { return edgeOf(rising[i]); },
        [](const Edge& edge) { return edge[0]; }));
    bool isAny = false;
    std::vector<char> areChanged(this->Places.size(), 0);
    forEachInOrder(this->Exec, sides.empty() ? 0 : sides.size() - 1,
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
    // The fan at the lowest place is the lowest one.
    const std::vector<SurfaceTriangle> all =
      tabulated<SurfaceTriangle>(this->Exec, this->Triangles.size(),
        [this](std::size_t i) -> SurfaceTriangle {
          return { this->Fans[3 * i], this->Fans[3 * i + 1], this->Fans[3 * i + 2] };
        });
    const std::vector<std::size_t> order = orderByKeys(
      this->Exec, all.size(), this->Places.size(), [&](std::size_t i) { return all[i]; }, firstOf);
    return { this->Places, chosenOf(this->Exec, all, order),
      chosenOf(this->Exec, this->Sources, order) };
  }

  const Execution& Exec;
  const std::size_t PlaceCount;
  std::vector<std::size_t> Sources;       // of the triangles
  std::vector<SurfaceTriangle> Triangles; // of places
  std::vector<HalfEdge> Twins;
  std::vector<std::size_t> Fans;   // by side, that of its start
  std::vector<std::size_t> Places; // by fan
};

} // namespace

ClosedTriangles closedTriangles(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<HalfEdge>& twins,
  const std::vector<std::size_t>& placeOf, std::size_t placeCount)
{
  return FanSeparation(execution, triangles, twins, placeOf, placeCount).closed();
}

} // namespace isopoint
