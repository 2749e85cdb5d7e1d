// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "GapDefinition.h"

/// The closed surface of a body by the definition of docs/triangles.md, from CGAL's
/// tetrahedralization of all samples.
namespace body
{

using clouds::Vector;
using Cell = triangles::Delaunay::Cell_handle;
using Vertex = triangles::Delaunay::Vertex_handle;

/// The edge of a vertex, by ids, ascending; both the same for a sample.
using Edge = std::pair<std::uint64_t, std::uint64_t>;
using Triangle = std::array<Edge, 3>;
/// A vertex: its edge, and a number that differs between those of one edge.
using Fan = std::pair<Edge, std::size_t>;

/// Sides of triangles: 3 t + k begins at the corner k of the triangle t.
inline std::size_t nextOf(std::size_t side)
{
  return side % 3 == 2 ? side - 2 : side + 1;
}

struct Surface
{
  std::vector<Triangle> triangles; // the lowest edge first
  std::vector<char> areCaps;       // by triangle
  std::vector<std::size_t> twins;  // by side
  std::vector<Fan> fans;           // by corner
};

class Definition
{
public:
  Definition(const clouds::Cloud& cloud, double isovalue, bool dropsGaps)
    : Isovalue(isovalue)
    , Full(cloud)
  {
    for (const bruteforce::Cell& sample : bruteforce::Tree(cloud).cells)
    {
      this->Samples.emplace(sample.id, sample);
    }
    const auto all = gaps::tetrahedraOf(cloud, this->Full, isovalue, gaps::Kind::Body);
    const std::vector<bool> areInGaps = gaps::areInGaps(all);
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      if (!dropsGaps || !areInGaps[i])
      {
        this->Body.insert(all[i].cell);
      }
    }
  }

  Surface surface()
  {
    for (const Cell cell : this->Body)
    {
      this->addIsosurface(cell);
    }
    const std::size_t capsBegin = this->Triangles.size();
    for (const Cell cell : this->Body)
    {
      for (int corner = 0; corner < 4; ++corner)
      {
        this->addCap(cell, corner);
      }
    }
    this->pairSides();
    this->mergeAtSamples();
    this->collapse(capsBegin);
    do
    {
      this->findFans();
    } while (this->exchangeTwins());
    return this->Result;
  }

  /// The volume of the clipped tetrahedra.
  double volume() const
  {
    long double sum = 0.0;
    for (const Cell cell : this->Body)
    {
      const auto v =
        this->oriented({ cell->vertex(0), cell->vertex(1), cell->vertex(2), cell->vertex(3) });
      const auto edge = [&](std::size_t i)
      { return this->sampleOf(v[i]).position - this->sampleOf(v[0]).position; };
      sum += isopoint::dot(isopoint::cross(edge(1), edge(2)), edge(3)) / 6.0 * this->shareAbove(v);
    }
    return static_cast<double>(sum);
  }

  /// Whether a sample of the body exceeds the isovalue, so that there is a volume.
  bool hasVolume() const
  {
    return std::any_of(this->Body.begin(), this->Body.end(),
      [this](Cell cell)
      { return this->Full.hasAbove(cell, std::nextafter(this->Isovalue, HUGE_VAL)); });
  }

  /// The position of a vertex, perhaps from the other end.
  Vector place(const Edge& edge, bool isReversed = false) const
  {
    const bruteforce::Cell& i = this->Samples.at(isReversed ? edge.second : edge.first);
    const bruteforce::Cell& j = this->Samples.at(isReversed ? edge.first : edge.second);
    const double t = i.id == j.id ? 0.0 : bruteforce::parameterOf(i, j, this->Isovalue);
    return isopoint::interpolate(i.position, j.position, t);
  }

private:
  using Corners = std::array<Vertex, 4>;
  using FacetSide = std::tuple<Cell, int, Edge>; // a facet by the corner opposite to it, an edge

  const bruteforce::Cell& sampleOf(Vertex vertex) const
  {
    return this->Samples.at(this->Full.idOf(vertex));
  }

  bool isBelow(Vertex vertex) const { return this->Full.isBelow(vertex, this->Isovalue); }

  Edge edgeOf(Vertex a, Vertex b) const
  {
    return std::minmax(this->Full.idOf(a), this->Full.idOf(b));
  }

  /// Corners in an order of positive orientation, those below first.
  Corners oriented(Corners v) const
  {
    std::stable_partition(v.begin(), v.end(), [this](Vertex w) { return this->isBelow(w); });
    if (CGAL::orientation(v[0]->point(), v[1]->point(), v[2]->point(), v[3]->point()) !=
        CGAL::POSITIVE)
    {
      this->isBelow(v[1]) ? std::swap(v[0], v[1]) : std::swap(v[2], v[3]);
    }
    return v;
  }

  void addIsosurface(Cell cell)
  {
    const auto [a, b, c, d] =
      this->oriented({ cell->vertex(0), cell->vertex(1), cell->vertex(2), cell->vertex(3) });
    if (!this->isBelow(a) || this->isBelow(d))
    {
      return;
    }
    if (!this->isBelow(b))
    {
      this->addPolygon({ this->edgeOf(a, b), this->edgeOf(a, d), this->edgeOf(a, c) });
    }
    else if (this->isBelow(c))
    {
      this->addPolygon({ this->edgeOf(d, a), this->edgeOf(d, c), this->edgeOf(d, b) });
    }
    else
    {
      this->addPolygon(
        { this->edgeOf(a, c), this->edgeOf(b, c), this->edgeOf(b, d), this->edgeOf(a, d) });
    }
  }

  void addCap(Cell cell, int corner)
  {
    if (!this->Full.hasAbove(cell, this->Isovalue, corner) ||
        this->Body.count(cell->neighbor(corner)) > 0)
    {
      return;
    }
    std::vector<Edge> polygon; // counterclockwise seen from outside
    for (int i = 3; i > 0; --i)
    {
      const auto vertex = [&](int k)
      { return cell->vertex(triangles::Delaunay::vertex_triple_index(corner, k % 3)); };
      if (!this->isBelow(vertex(i)))
      {
        polygon.push_back(this->edgeOf(vertex(i), vertex(i)));
      }
      if (this->isBelow(vertex(i)) != this->isBelow(vertex(i - 1)))
      {
        polygon.push_back(this->edgeOf(vertex(i), vertex(i - 1)));
      }
    }
    std::size_t side = 3 * this->Triangles.size();
    this->addPolygon(polygon);
    for (; side < 3 * this->Triangles.size(); ++side)
    {
      const Edge from = this->edgeAt(side);
      const Edge to = this->edgeAt(nextOf(side));
      const std::set<std::uint64_t> ids{ from.first, from.second, to.first, to.second };
      if (ids.size() == 2)
      {
        this->SideAt[{ cell, corner, { *ids.begin(), *ids.rbegin() } }] = side;
      }
    }
  }

  /// Cuts quadrilaterals along the shorter diagonal or, of equal ones, that with the lowest edge.
  void addPolygon(std::vector<Edge> polygon)
  {
    if (polygon.size() == 4)
    {
      const auto lengthBetween = [&](std::size_t a, std::size_t b)
      { return isopoint::lengthOf(this->place(polygon[b]) - this->place(polygon[a])); };
      const double first = lengthBetween(0, 2);
      const double second = lengthBetween(1, 3);
      const auto lowest = std::min_element(polygon.begin(), polygon.end()) - polygon.begin();
      if (second < first || (second == first && lowest % 2 == 1))
      {
        std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
      }
      this->Triangles.push_back({ polygon[2], polygon[3], polygon[0] });
    }
    this->Triangles.push_back({ polygon[0], polygon[1], polygon[2] });
  }

  const Edge& edgeAt(std::size_t side) const { return this->Triangles[side / 3][side % 3]; }

  /// Sides of caps on an edge of the tetrahedralization bound the same wedge of the body as their
  /// twins. The others are the only two between their ends.
  void pairSides()
  {
    const std::size_t none = 3 * this->Triangles.size();
    this->Twins.assign(none, none);
    for (const auto& [facetSide, side] : this->SideAt)
    {
      this->Twins[side] = this->SideAt.at(this->partnerOf(facetSide));
    }
    std::map<std::pair<Edge, Edge>, std::vector<std::size_t>> sidesBetween;
    for (std::size_t side = 0; side < none; ++side)
    {
      if (this->Twins[side] == none)
      {
        sidesBetween[std::minmax(this->edgeAt(side), this->edgeAt(nextOf(side)))].push_back(side);
      }
    }
    pairTwos(sidesBetween, this->Twins);
  }

  template <class Key>
  static void pairTwos(
    const std::map<Key, std::vector<std::size_t>>& sides, std::vector<std::size_t>& twins)
  {
    for (const auto& [key, two] : sides)
    {
      ASSERT_EQ(two.size(), 2u);
      twins[two[0]] = two[1];
      twins[two[1]] = two[0];
    }
  }

  /// The other end of the wedge of body tetrahedra around an edge.
  FacetSide partnerOf(const FacetSide& side) const
  {
    auto [cell, from, edge] = side;
    for (;;)
    {
      int across = 0;
      while (across == from || this->Full.idOf(cell->vertex(across)) == edge.first ||
             this->Full.idOf(cell->vertex(across)) == edge.second)
      {
        ++across;
      }
      const Cell next = cell->neighbor(across);
      if (this->Body.count(next) == 0)
      {
        return { cell, across, edge };
      }
      from = next->index(cell);
      cell = next;
    }
  }

  /// Crossings at a sample, and the sample itself, become one vertex.
  void mergeAtSamples()
  {
    std::map<Vector, std::vector<Edge*>> edgesAt; // by the position of the sample
    for (Triangle& triangle : this->Triangles)
    {
      for (Edge& edge : triangle)
      {
        for (const std::uint64_t id : { edge.first, edge.second })
        {
          const Vector& end = this->Samples.at(id).position;
          if (this->place(edge) == end || this->place(edge, true) == end)
          {
            edgesAt[end].push_back(&edge);
            break;
          }
        }
      }
    }
    for (const auto& [position, edges] : edgesAt)
    {
      const Edge first = **std::min_element(edges.begin(), edges.end(),
        [](const Edge* a, const Edge* b) {
          return std::make_pair(a->first != a->second, *a) <
                 std::make_pair(b->first != b->second, *b);
        });
      std::for_each(edges.begin(), edges.end(), [&](Edge* edge) { *edge = first; });
    }
  }

  /// Leaves out triangles with two corners at one place. Chains of their sides end at twins.
  void collapse(std::size_t capsBegin)
  {
    gaps::Unions chains(this->Twins.size());
    std::vector<std::pair<Triangle, std::size_t>> kept; // with the first side
    for (std::size_t side = 0; side < this->Twins.size(); ++side)
    {
      const Triangle corners{ this->edgeAt(side), this->edgeAt(nextOf(side)),
        this->edgeAt(nextOf(nextOf(side))) };
      chains.unite(side, this->Twins[side]);
      if (corners[0] == corners[1])
      {
        chains.unite(nextOf(side), nextOf(nextOf(side)));
      }
      if (corners[0] < std::min(corners[1], corners[2]) && corners[1] != corners[2])
      {
        kept.emplace_back(corners, side);
      }
    }
    std::sort(kept.begin(), kept.end());
    std::map<std::size_t, std::vector<std::size_t>> ends; // of chains
    for (auto [corners, side] : kept)
    {
      this->Result.triangles.push_back(corners);
      this->Result.areCaps.push_back(side / 3 >= capsBegin ? 1 : 0);
      for (std::size_t k = 0; k < 3; ++k, side = nextOf(side))
      {
        ends[chains[side]].push_back(this->Result.twins.size());
        this->Result.twins.push_back(0);
      }
    }
    pairTwos(ends, this->Result.twins);
  }

  /// Corners that paired sides connect are a fan, numbered by the first of them.
  void findFans()
  {
    gaps::Unions corners(this->Result.twins.size());
    for (std::size_t side = 0; side < this->Result.twins.size(); ++side)
    {
      corners.unite(side, nextOf(this->Result.twins[side]));
    }
    std::map<std::size_t, Fan> fans;
    this->Result.fans.clear();
    for (std::size_t side = 0; side < this->Result.twins.size(); ++side)
    {
      const Fan fan{ this->Result.triangles[side / 3][side % 3], side };
      this->Result.fans.push_back(fans.emplace(corners[side], fan).first->second);
    }
  }

  /// Pairs sides between the same two vertices anew. @returns whether there were any
  bool exchangeTwins()
  {
    std::set<std::tuple<Fan, Fan, std::size_t>> edges;
    for (std::size_t side = 0; side < this->Result.fans.size(); ++side)
    {
      if (this->Result.fans[side] < this->Result.fans[nextOf(side)])
      {
        edges.emplace(this->Result.fans[side], this->Result.fans[nextOf(side)], side);
      }
    }
    std::set<Fan> changed;
    for (auto edge = edges.begin(); edge != edges.end(); ++edge)
    {
      const auto& [start, end, side] = *edge;
      const auto next = std::next(edge);
      if (next != edges.end() &&
          std::tie(start, end) == std::tie(std::get<0>(*next), std::get<1>(*next)) &&
          changed.count(start) + changed.count(end) == 0)
      {
        changed.insert({ start, end });
        std::vector<std::size_t>& twins = this->Result.twins;
        std::swap(twins[side], twins[std::get<2>(*next)]);
        twins[twins[side]] = side;
        twins[twins[std::get<2>(*next)]] = std::get<2>(*next);
      }
    }
    return !changed.empty();
  }

  double shareAbove(const Corners& corners) const
  {
    const auto from = [&](std::size_t i, std::size_t j)
    {
      return bruteforce::parameterOf(
        this->sampleOf(corners[i]), this->sampleOf(corners[j]), this->Isovalue);
    };
    switch (clouds::countOf(corners, [this](Vertex v) { return this->isBelow(v); }))
    {
      case 0:
        return 1.0;
      case 1:
        return 1.0 - from(0, 1) * from(0, 2) * from(0, 3);
      case 2:
        return from(2, 0) * from(2, 1) + from(2, 0) * (1.0 - from(2, 1)) * from(3, 1) +
               (1.0 - from(2, 0)) * from(3, 0) * from(3, 1);
      default:
        return from(3, 0) * from(3, 1) * from(3, 2);
    }
  }

  const double Isovalue;
  triangles::FullTetrahedralization Full;
  std::map<std::uint64_t, bruteforce::Cell> Samples; // by id
  std::set<Cell> Body;
  std::vector<Triangle> Triangles;         // before merging
  std::vector<std::size_t> Twins;          // of their sides
  std::map<FacetSide, std::size_t> SideAt; // on edges of the tetrahedralization, of caps
  Surface Result;
};

} // namespace body
