// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/ClosedMesh.h"

#include "Core/Base/Lists.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace isopoint
{
namespace
{

/// A triangle with its number, which decides among triangles with the same corners.
struct NumberedTriangle
{
  SurfaceTriangle corners;
  std::size_t number;

  bool operator<(const NumberedTriangle& other) const
  {
    return std::tie(this->corners, this->number) < std::tie(other.corners, other.number);
  }
  bool operator==(const NumberedTriangle& other) const { return this->number == other.number; }
};

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
    std::vector<std::size_t> turns(this->Sources.size());
    forEachIndex(this->Exec, this->Sources.size(),
      [&](std::size_t i)
      {
        const std::size_t first = this->firstSide(all, placeOf, this->Sources[i]);
        HalfEdge side = first;
        for (std::size_t corner = 0; corner < 3; ++corner, side = nextOf(side))
        {
          this->Triangles[i][corner] = placeOfSide(side);
          newSides[side] = 3 * i + corner;
        }
        turns[i] = first;
      });
    this->Twins.resize(3 * this->Triangles.size());
    forEachIndex(this->Exec, this->Triangles.size(),
      [&](std::size_t i)
      {
        HalfEdge side = turns[i];
        for (std::size_t corner = 0; corner < 3; ++corner, side = nextOf(side))
        {
          HalfEdge twin = twins[side];
          while (newSides[twin] == noHalfEdge)
          {
            // One of the other two sides is at a point.
            const HalfEdge other = isAtPoint(nextOf(twin)) ? lastOf(twin) : nextOf(twin);
            twin = twins[other];
          }
          this->Twins[3 * i + corner] = newSides[twin];
        }
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
    std::vector<NumberedTriangle> placed(this->Sources.size());
    forEachIndex(this->Exec, placed.size(),
      [&](std::size_t i)
      {
        const HalfEdge side = firstSide(all, placeOf, this->Sources[i]);
        const auto at = [&](HalfEdge corner) { return placeOf[all[corner / 3][corner % 3]]; };
        placed[i] = { { at(side), at(nextOf(side)), at(lastOf(side)) }, this->Sources[i] };
      });
    placed = sortedUnique(this->Exec, placed, this->PlaceCount,
      [](const NumberedTriangle& each) { return each.corners[0]; });
    forEachIndex(
      this->Exec, placed.size(), [&](std::size_t i) { this->Sources[i] = placed[i].number; });
  }

  /// Numbers the fans by place, then by their first triangle.
  void numberFans()
  {
    this->Fans.assign(this->Twins.size(), noHalfEdge);
    std::vector<std::pair<std::size_t, HalfEdge>> firsts; // by place
    forEachInOrder(this->Exec, this->Twins.size(),
      [&](HalfEdge first)
      {
        if (this->Fans[first] == noHalfEdge)
        {
          HalfEdge side = first;
          do
          {
            this->Fans[side] = firsts.size();
            side = this->Twins[lastOf(side)];
          } while (side != first);
          firsts.emplace_back(this->placeAt(first), firsts.size());
        }
      });
    firsts =
      sortedUnique(this->Exec, firsts, this->PlaceCount, [](const auto& fan) { return fan.first; });
    std::vector<std::size_t> numbers(firsts.size());
    this->Places.resize(firsts.size());
    forEachIndex(this->Exec, firsts.size(),
      [&](std::size_t number)
      {
        numbers[firsts[number].second] = number;
        this->Places[number] = firsts[number].first;
      });
    forEachIndex(this->Exec, this->Fans.size(),
      [&](HalfEdge side) { this->Fans[side] = numbers[this->Fans[side]]; });
  }

  /// Exchanges the twins of two edges with the same two vertices, which separates a fan at each.
  /// Only one exchange at a vertex: another one could join its fans again.
  /// @returns whether there were any
  bool pairAnew()
  {
    struct Edge
    {
      std::size_t start; // the lower vertex
      std::size_t end;
      HalfEdge side; // from start to end
      bool operator<(const Edge& other) const
      {
        return std::tie(this->start, this->end, this->side) <
               std::tie(other.start, other.end, other.side);
      }
      bool operator==(const Edge& other) const { return this->side == other.side; }
    };
    std::vector<Edge> edges;
    edges.reserve(this->Fans.size() / 2);
    forEachInOrder(this->Exec, this->Fans.size(),
      [&](HalfEdge side)
      {
        if (this->fanAt(side) < this->fanAt(nextOf(side)))
        {
          edges.push_back({ this->fanAt(side), this->fanAt(nextOf(side)), side });
        }
      });
    edges = sortedUnique(
      this->Exec, edges, this->Places.size(), [](const Edge& edge) { return edge.start; });
    bool isAny = false;
    std::vector<char> areChanged(this->Places.size(), 0);
    forEachInOrder(this->Exec, edges.empty() ? 0 : edges.size() - 1,
      [&](std::size_t i)
      {
        const Edge& a = edges[i];
        const Edge& b = edges[i + 1];
        if (a.start == b.start && a.end == b.end && !areChanged[a.start] && !areChanged[a.end])
        {
          areChanged[a.start] = 1;
          areChanged[a.end] = 1;
          const HalfEdge last = this->Twins[b.side];
          this->pair(b.side, this->Twins[a.side]);
          this->pair(a.side, last);
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
    std::vector<NumberedTriangle> all(this->Triangles.size());
    forEachIndex(this->Exec, all.size(),
      [&](std::size_t i)
      {
        // The fan at the lowest place is the lowest one.
        all[i] = { { this->Fans[3 * i], this->Fans[3 * i + 1], this->Fans[3 * i + 2] }, i };
      });
    all = sortedUnique(this->Exec, all, this->Places.size(),
      [](const NumberedTriangle& each) { return each.corners[0]; });
    ClosedTriangles result;
    result.places = this->Places;
    result.triangles.resize(all.size());
    result.sources.resize(all.size());
    forEachIndex(this->Exec, all.size(),
      [&](std::size_t i)
      {
        result.triangles[i] = all[i].corners;
        result.sources[i] = this->Sources[all[i].number];
      });
    return result;
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
