// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Topology.h"
#include "TriangleTesting.h"

/// The tetrahedra in gaps by the definition of docs/triangles.md: a search of CGAL's
/// tetrahedralization of all samples.
namespace gaps
{

using clouds::Vector;

enum class Kind
{
  Surface, // the open isosurface: crossing tetrahedra
  Slice,   // the same, with edges that span a void
  Body     // all tetrahedra with a sample that is not below
};

struct Tetrahedron
{
  triangles::Delaunay::Cell_handle cell;
  std::vector<std::size_t> neighbors;
  bool isWeak = false;
  bool isSeed = false;
  bool isTouching = true; // the surface or, of bodies, the outside
};

/// The criteria for edges, by brute force; each edge is judged once.
class EdgeCriteria
{
public:
  EdgeCriteria(const clouds::Cloud& cloud, bool spansVoids)
    : Cells(bruteforce::Tree(cloud).cells)
    , SpansVoids(spansVoids)
  {
    for (std::size_t i = 0; i < this->Cells.size(); ++i)
    {
      this->CellOf[this->Cells[i].id] = i;
    }
  }

  /// Whether an edge is weak, and whether it is strong.
  std::pair<bool, bool> judge(std::uint64_t first, std::uint64_t second)
  {
    const auto [found, isNew] = this->Judged.try_emplace(std::minmax(first, second));
    if (isNew)
    {
      const std::size_t x = this->CellOf.at(first);
      const std::size_t y = this->CellOf.at(second);
      const bool isWeak = this->isWeak(x, y);
      const bool isStrong = bruteforce::isDroppedByGap(this->Cells, x, y, 4.0, 3);
      const bool isOfRims = this->SpansVoids && this->isAtRim(x, y) && this->isAtRim(y, x);
      const bool mayCount = isWeak || isStrong || isOfRims;
      const double bare = this->SpansVoids && mayCount ? this->bareShare(x, y) : 0.0;
      const auto spansVoid = [&](double factor)
      { return !this->SpansVoids || this->isDenseAround(x, y, factor / bare); };
      const bool isFromRimToRim = isOfRims && spansVoid(2.0);
      found->second = { (isWeak && spansVoid(0.7)) || isFromRimToRim,
        (isStrong && spansVoid(1.0)) || isFromRimToRim };
    }
    return found->second;
  }

private:
  bool isWeak(std::size_t x, std::size_t y) const
  {
    return bruteforce::isDroppedByGap(this->Cells, x, y, 2.0, 2) || this->leavesBody(x, y) ||
           this->leavesBody(y, x);
  }

  /// Whether the edge {x, y} leaves the body at x.
  bool leavesBody(std::size_t x, std::size_t y) const
  {
    return bruteforce::isDense(this->Cells, y, x, 2.0, 2) &&
           bruteforce::isDense(this->Cells, x, y, 4.0, 3, 0.0) && this->isEmptyBehind(x, y);
  }

  /// Whether nothing is behind x, and the samples around x extend along the edge.
  bool isAtRim(std::size_t x, std::size_t y) const
  {
    const Vector& origin = this->Cells[x].position;
    const Vector edge = this->Cells[y].position - origin;
    std::vector<std::pair<double, double>> others; // distance, and along the edge
    for (const bruteforce::Cell& cell : this->Cells)
    {
      const Vector offset = cell.position - origin;
      others.emplace_back(isopoint::lengthOf(offset), std::abs(isopoint::dot(offset, edge)));
    }
    std::sort(others.begin(), others.end()); // x is the first
    const double spacing =
      others.size() > 10 ? others[10].first : std::numeric_limits<double>::infinity();
    return this->isEmptyBehind(x, y) &&
           std::any_of(others.begin() + 1, others.end(),
             [&](const auto& other) {
               return other.first <= spacing &&
                      other.second >= others[1].first * isopoint::lengthOf(edge);
             });
  }

  bool isEmptyBehind(std::size_t x, std::size_t y) const
  {
    return !bruteforce::isDense(this->Cells, x, y, 0.5, 2);
  }

  /// Whether the edge is longer than a factor times the distance to the tenth nearest position,
  /// from either end.
  bool isDenseAround(std::size_t x, std::size_t y, double factor) const
  {
    return bruteforce::isDense(this->Cells, x, y, factor, 10, -2.0) &&
           bruteforce::isDense(this->Cells, y, x, factor, 10, -2.0);
  }

  /// The radius of the largest empty ball around one of seven points, as a share of the length.
  double bareShare(std::size_t x, std::size_t y) const
  {
    const Vector& a = this->Cells[x].position;
    const Vector& b = this->Cells[y].position;
    double largest = 0.0;
    for (int i = 1; i < 8; ++i)
    {
      const Vector place = (1.0 - 0.125 * i) * a + 0.125 * i * b;
      double nearest = std::numeric_limits<double>::infinity();
      for (const bruteforce::Cell& cell : this->Cells)
      {
        nearest = std::min(nearest, isopoint::lengthOf(cell.position - place));
      }
      largest = std::max(largest, nearest);
    }
    return largest / isopoint::lengthOf(b - a);
  }

  std::vector<bruteforce::Cell> Cells;
  std::map<std::uint64_t, std::size_t> CellOf; // by id
  bool SpansVoids;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::pair<bool, bool>> Judged;
};

/// The tetrahedra that the rule looks at.
inline std::vector<Tetrahedron> tetrahedraOf(const clouds::Cloud& cloud,
  const triangles::FullTetrahedralization& full, double isovalue, Kind kind)
{
  const auto counts = [&](triangles::Delaunay::Cell_handle cell, int without = -1)
  {
    return kind == Kind::Body ? full.hasAbove(cell, isovalue, without)
                              : full.isCrossing(cell, isovalue, without);
  };
  EdgeCriteria criteria(cloud, kind != Kind::Surface);
  std::vector<Tetrahedron> result;
  std::map<triangles::Delaunay::Cell_handle, std::size_t> numberOf;
  if (full.cells.dimension() == 3)
  {
    for (const auto cell : full.cells.finite_cell_handles())
    {
      if (counts(cell))
      {
        numberOf.emplace(cell, result.size());
        result.push_back({ cell, {} });
      }
    }
  }
  for (Tetrahedron& tetrahedron : result)
  {
    const auto cell = tetrahedron.cell;
    tetrahedron.isTouching = full.isCrossing(cell, isovalue);
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        const auto [isWeak, isStrong] =
          criteria.judge(full.idOf(cell->vertex(i)), full.idOf(cell->vertex(j)));
        tetrahedron.isWeak |= isWeak;
        tetrahedron.isSeed |= isStrong;
      }
      if (!counts(cell, i))
      {
        continue;
      }
      const bool isAtHull = full.cells.is_infinite(cell->neighbor(i));
      tetrahedron.isSeed |= isAtHull && kind == Kind::Surface;
      tetrahedron.isTouching |= isAtHull;
      if (!isAtHull)
      {
        tetrahedron.neighbors.push_back(numberOf.at(cell->neighbor(i)));
      }
    }
  }
  return result;
}

/// Numbers that are united: those with the same value are.
class Unions
{
public:
  explicit Unions(std::size_t count)
    : Roots(count)
  {
    std::iota(this->Roots.begin(), this->Roots.end(), std::size_t{ 0 });
  }

  std::size_t operator[](std::size_t i) { return topology::rootOf(this->Roots, i); }

  void unite(std::size_t a, std::size_t b) { this->Roots[(*this)[a]] = (*this)[b]; }

private:
  std::vector<std::size_t> Roots;
};

/// The pieces of tetrahedra: connected ones for which a condition holds.
template <class Condition>
Unions piecesOf(const std::vector<Tetrahedron>& all, const Condition& isOfKind)
{
  Unions pieces(all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    for (const std::size_t neighbor : all[i].neighbors)
    {
      if (isOfKind(i) && isOfKind(neighbor))
      {
        pieces.unite(i, neighbor);
      }
    }
  }
  return pieces;
}

/// Whether each tetrahedron is in a gap: the rule, piece by piece.
inline std::vector<bool> areInGaps(const std::vector<Tetrahedron>& all)
{
  Unions weak = piecesOf(all, [&](std::size_t i) { return all[i].isWeak; });
  std::set<std::size_t> seeded; // pieces
  std::set<std::size_t> touching;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (all[i].isWeak && all[i].isSeed)
    {
      seeded.insert(weak[i]);
    }
    if (all[i].isWeak && all[i].isTouching)
    {
      touching.insert(weak[i]);
    }
  }
  const auto isInGap = [&](std::size_t i)
  { return seeded.count(weak[i]) > 0 && touching.count(weak[i]) > 0; };
  Unions kept = piecesOf(all, [&](std::size_t i) { return !isInGap(i); });
  std::map<std::size_t, std::size_t> sizes;
  std::map<std::size_t, bool> bordersOnGap;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    ++sizes[kept[i]];
    for (const std::size_t neighbor : all[i].neighbors)
    {
      bordersOnGap[kept[i]] |= isInGap(neighbor);
    }
  }
  std::vector<bool> result;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    result.push_back(isInGap(i) || (bordersOnGap[kept[i]] && sizes[kept[i]] < 8));
  }
  return result;
}

} // namespace gaps
