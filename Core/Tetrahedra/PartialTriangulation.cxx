// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Tetrahedra/PartialTriangulation.h"

#include "Core/Base/Lists.h"
#include "Core/Base/Sorting.h"
#include "Core/Tetrahedra/ParallelInsertion.h"

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/scalable_allocator.h>
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <functional>
#include <utility>

namespace isopoint
{
namespace
{

using cgal::Cell;
using cgal::Point;
using cgal::pointAt;
using cgal::Triangulation;
using cgal::Vertex;
using cgal::VertexInfo;

/// An even permutation of the corners with those below the isovalue first.
LeafTetrahedron bySides(Cell cell)
{
  std::array<VertexInfo, 4> corners{ cell->vertex(0)->info(), cell->vertex(1)->info(),
    cell->vertex(2)->info(), cell->vertex(3)->info() };
  const auto isBelow = [](const VertexInfo& corner) { return corner.isBelow(); };
  LeafTetrahedron result{};
  result.belowCount =
    static_cast<std::uint8_t>(std::count_if(corners.begin(), corners.end(), isBelow));
  bool isOdd = false;
  for (std::size_t i = 0; i < result.belowCount; ++i)
  {
    VertexInfo* const below = std::find_if(corners.data() + i, corners.data() + 4, isBelow);
    isOdd = isOdd != (below != &corners[i]);
    std::swap(corners[i], *below);
  }
  if (isOdd)
  {
    // Swaps two corners on one side to restore the orientation.
    const std::size_t first = result.belowCount >= 3 ? 0 : 2;
    std::swap(corners[first], corners[first + 1]);
  }
  std::transform(corners.begin(), corners.end(), result.corners.begin(),
    [](const VertexInfo& corner) { return corner.leaf(); });
  return result;
}

/// The corners of the facet opposite to each corner of a tetrahedron, counterclockwise seen from
/// outside.
constexpr int outwardFacets[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } };

Vector positionOf(const Point& point)
{
  return { point.x(), point.y(), point.z() };
}

CellHandle handleOf(Cell cell)
{
  return reinterpret_cast<CellHandle>(&*cell);
}

Cell cellOf(CellHandle handle)
{
  return Triangulation::Triangulation_data_structure::Cell_range::s_iterator_to(
    *reinterpret_cast<Cell::value_type*>(handle));
}

} // namespace

class PartialTriangulation::Internals
{
public:
  explicit Internals(const CoordinateUnit& unit)
    : Unit(unit)
    , Cells(cgal::Kernel(&this->Unit))
  {
  }

  CoordinateUnit Unit;
  Triangulation Cells;
  std::vector<CellHandle> All; // including cells beyond the hull; empty after insertions
  bool IsOutsideBelow = false;

  /// A cell and the index of a corner: the cell across the facet opposite to it.
  using Target = std::pair<Cell, int>;
  std::vector<Target> Targets;
  std::vector<Cell> Explored; // by number

  bool isInfinite(Cell cell) const { return this->Cells.is_infinite(cell); }

  /// The number of an explored tetrahedron. Others may have any number in their info.
  std::size_t numberOf(Cell cell) const
  {
    const auto number = static_cast<std::size_t>(cell->info().number());
    return number < this->Explored.size() && this->Explored[number] == cell
             ? number
             : PartialTriangulation::unexplored;
  }

  void explore(Cell cell)
  {
    cell->info().setNumber(this->Explored.size());
    this->Explored.push_back(cell);
  }

  /// Orders the explored tetrahedra from number `first` on by the tree indices of their corners.
  void orderExplored(const Execution& execution, std::size_t first,
    const std::function<std::uint64_t(std::uint64_t leaf)>& treeIndexOf)
  {
    using TreeIndices = std::array<std::uint64_t, 4>; // ascending
    const std::vector<Cell> cells(
      this->Explored.data() + first, this->Explored.data() + this->Explored.size());
    const std::vector<TreeIndices> indices = tabulated<TreeIndices>(execution, cells.size(),
      [&](std::size_t i)
      {
        TreeIndices ofCorners{};
        for (int corner = 0; corner < 4; ++corner)
        {
          ofCorners[static_cast<std::size_t>(corner)] =
            treeIndexOf(cells[i]->vertex(corner)->info().leaf());
        }
        std::sort(ofCorners.begin(), ofCorners.end());
        return ofCorners;
      });
    std::uint64_t most = 0;
    forEachInOrder(
      execution, indices.size(), [&](std::size_t i) { most = std::max(most, indices[i][0]); });
    const std::vector<std::size_t> order = orderByKeys(
      execution, cells.size(), most + 1, [&](std::size_t i) { return indices[i]; },
      [](const TreeIndices& ofCorners) { return ofCorners[0]; });
    forEachIndex(execution, order.size(),
      [&](std::size_t i)
      {
        this->Explored[first + i] = cells[order[i]];
        cells[order[i]]->info().setNumber(first + i);
      });
  }

  /// The crossing cells that pass a test, if the dimension is 3.
  template <class Test>
  std::vector<CellHandle> crossingCells(const Execution& execution, const Test& test)
  {
    if (this->Cells.dimension() < 3)
    {
      return {};
    }
    if (this->All.empty())
    {
      std::vector<CellHandle> all(this->Cells.tds().cells().size());
      auto next = this->Cells.all_cells_begin();
      forEachInOrder(execution, all.size(), [&](std::size_t i) { all[i] = handleOf(next++); });
      this->All = std::move(all);
    }
    return chosenThat(execution, this->All,
      [&](CellHandle cell) { return test(cellOf(cell)) && this->isCrossing(cellOf(cell)); });
  }

  bool isCrossing(Cell cell) const
  {
    bool hasBelow = false;
    bool hasOther = false;
    for (int i = 0; i < 4; ++i)
    {
      const Vertex vertex = cell->vertex(i);
      if (vertex != this->Cells.infinite_vertex())
      {
        (vertex->info().isBelow() ? hasBelow : hasOther) = true;
      }
      else
      {
        hasBelow = hasBelow || this->IsOutsideBelow;
      }
    }
    return hasBelow && hasOther;
  }

  /// Whether a crossing facet of a tetrahedron lies on the hull.
  bool isCrossingAtHull(Cell cell) const
  {
    for (int i = 0; i < 4; ++i)
    {
      const Cell neighbor = cell->neighbor(i);
      if (this->Cells.is_infinite(neighbor) && this->isCrossing(neighbor))
      {
        return true;
      }
    }
    return false;
  }

  /// The index of the infinite vertex, or -1.
  int infiniteIndexOf(Cell cell) const
  {
    int index = 0;
    return cell->has_vertex(this->Cells.infinite_vertex(), index) ? index : -1;
  }
};

PartialTriangulation::PartialTriangulation(const CoordinateUnit& unit)
  : Inside(std::make_unique<Internals>(unit))
{
}

PartialTriangulation::~PartialTriangulation()
{
  this->Inside.reset();
#ifdef CGAL_LINKED_WITH_TBB
  // oneTBB would keep the memory of CGAL's cells. Memory in use elsewhere is not affected.
  scalable_allocation_command(TBBMALLOC_CLEAN_ALL_BUFFERS, nullptr);
#endif
}

void PartialTriangulation::clear(const Execution& execution)
{
  this->Inside->All = std::vector<CellHandle>();
  this->Inside->Targets.clear();
  this->Inside->Explored.clear();
  bool isAborted = false;
  std::exception_ptr failure; // destructors ask, which must not throw
  const std::function<void()> ask = [&]()
  {
    try
    {
      isAborted = isAborted || execution.isAborted();
    }
    catch (...)
    {
      failure = std::current_exception();
      isAborted = true;
    }
  };
  cgal::freesCells = &ask;
  this->Inside->Cells.tds().vertices().clear();
  ask();
  this->Inside->Cells.clear();
  cgal::freesCells = nullptr;
  if (failure)
  {
    std::rethrow_exception(failure);
  }
  if (isAborted || execution.isAborted())
  {
    throw Aborted();
  }
}

bool PartialTriangulation::insert(const Execution& execution, const std::vector<Site>& sites,
  const std::function<void(double share)>& step, std::size_t most)
{
  this->Inside->All = std::vector<CellHandle>();
  forEachInOrder(
    execution, sites.size(), [&](std::size_t i) { this->Inside->Unit.add(sites[i].position); });
  return cgal::Insertion(execution, this->Inside->Cells, sites, step, most).run();
}

void PartialTriangulation::setSides(
  const Execution& execution, const std::function<bool(std::uint64_t leaf)>& isBelow)
{
  auto next = this->Inside->Cells.finite_vertices_begin();
  forEachInOrder(execution, this->size(),
    [&](std::size_t)
    {
      VertexInfo& info = next++->info();
      info = VertexInfo(info.leaf(), isBelow(info.leaf()));
    });
}

void PartialTriangulation::setOutsideBelow(bool isBelow)
{
  this->Inside->IsOutsideBelow = isBelow;
}

std::size_t PartialTriangulation::size() const
{
  return this->Inside->Cells.number_of_vertices();
}

std::size_t PartialTriangulation::cellCount() const
{
  return this->Inside->Cells.tds().cells().size();
}

int PartialTriangulation::dimension() const
{
  return this->Inside->Cells.dimension();
}

bool PartialTriangulation::raisesDimension(const Vector& position) const
{
  const Triangulation& cells = this->Inside->Cells;
  const Point point = pointAt(position);
  switch (cells.dimension())
  {
    case -1:
      return true;
    case 0:
      return cells.finite_vertices_begin()->point() != point;
    case 1:
    {
      // At this dimension, a cell's corners are its first vertices.
      const Cell edge = cells.finite_edges_begin()->first;
      return !CGAL::collinear(edge->vertex(0)->point(), edge->vertex(1)->point(), point);
    }
    case 2:
    {
      const Cell facet = cells.finite_facets_begin()->first;
      return !CGAL::coplanar(
        facet->vertex(0)->point(), facet->vertex(1)->point(), facet->vertex(2)->point(), point);
    }
    default:
      return false;
  }
}

std::vector<CellHandle> PartialTriangulation::openCells(const Execution& execution)
{
  return this->Inside->crossingCells(
    execution, [](Cell cell) { return !cell->info().isCertified; });
}

std::vector<LeafTetrahedron> PartialTriangulation::crossingTetrahedra(const Execution& execution)
{
  const std::vector<CellHandle> cells = this->Inside->crossingCells(
    execution, [this](Cell cell) { return !this->Inside->isInfinite(cell); });
  this->Inside->All = std::vector<CellHandle>(); // free the memory
  return tabulated<LeafTetrahedron>(execution, cells.size(),
    [&](std::size_t i)
    {
      LeafTetrahedron result = bySides(cellOf(cells[i]));
      result.isAtHull = this->Inside->isCrossingAtHull(cellOf(cells[i]));
      return result;
    });
}

bool PartialTriangulation::isBeyondHull(CellHandle cell) const
{
  return this->Inside->isInfinite(cellOf(cell));
}

TetrahedronCorners PartialTriangulation::tetrahedronOf(CellHandle handle) const
{
  const Cell cell = cellOf(handle);
  return { positionOf(cell->vertex(0)->point()), positionOf(cell->vertex(1)->point()),
    positionOf(cell->vertex(2)->point()), positionOf(cell->vertex(3)->point()) };
}

HullFacetCorners PartialTriangulation::hullFacetOf(CellHandle handle) const
{
  // For a hull facet, the position would replace the infinite vertex in the orientation.
  constexpr int facets[4][3] = { { 2, 1, 3 }, { 0, 2, 3 }, { 1, 0, 3 }, { 0, 1, 2 } };
  const Cell cell = cellOf(handle);
  const int* const facet = facets[this->Inside->infiniteIndexOf(cell)];
  return { positionOf(cell->vertex(facet[0])->point()), positionOf(cell->vertex(facet[1])->point()),
    positionOf(cell->vertex(facet[2])->point()) };
}

bool PartialTriangulation::isInside(CellHandle cell, const Vector& position) const
{
  constexpr bool decidesTies = true;
  return this->Inside->Cells.side_of_sphere(cellOf(cell), pointAt(position), decidesTies) ==
         CGAL::ON_BOUNDED_SIDE;
}

void PartialTriangulation::certify(CellHandle cell)
{
  cellOf(cell)->info().isCertified = true;
}

std::vector<bool> PartialTriangulation::areBelow(const std::vector<Vector>& positions) const
{
  const Triangulation& cells = this->Inside->Cells;
  std::vector<bool> below;
  below.reserve(positions.size());
  Cell hint;
  for (const Vector& position : positions)
  {
    hint = cells.locate(pointAt(position), hint);
    const int corner = this->Inside->infiniteIndexOf(hint) == 0 ? 1 : 0;
    below.push_back(hint->vertex(corner)->info().isBelow());
  }
  return below;
}

std::size_t PartialTriangulation::beginExploring(
  const Execution& execution, const std::function<std::uint64_t(std::uint64_t leaf)>& treeIndexOf)
{
  Internals& inside = *this->Inside;
  inside.Explored.clear();
  inside.Targets.clear();
  const std::vector<CellHandle> crossing =
    inside.crossingCells(execution, [](Cell) { return true; });
  forEachInOrder(execution, crossing.size(),
    [&](std::size_t i)
    {
      const Cell cell = cellOf(crossing[i]);
      const int infinite = inside.infiniteIndexOf(cell);
      if (infinite < 0)
      {
        inside.explore(cell);
      }
      else
      {
        inside.Targets.emplace_back(cell, infinite);
      }
    });
  inside.orderExplored(execution, 0, treeIndexOf);
  return inside.Explored.size();
}

void PartialTriangulation::targetAcross(const std::vector<ExploredFacet>& facets)
{
  this->Inside->Targets.clear();
  for (const ExploredFacet& facet : facets)
  {
    this->Inside->Targets.emplace_back(this->Inside->Explored[facet.tetrahedron], facet.corner);
  }
}

std::vector<CellHandle> PartialTriangulation::openTargets() const
{
  std::vector<CellHandle> open;
  for (const auto& [cell, corner] : this->Inside->Targets)
  {
    const Cell target = cell->neighbor(corner);
    if (!target->info().isCertified && !this->Inside->isInfinite(target))
    {
      open.push_back(handleOf(target));
    }
  }
  keepUnique(open);
  return open;
}

std::size_t PartialTriangulation::exploreTargets(
  const Execution& execution, const std::function<std::uint64_t(std::uint64_t leaf)>& treeIndexOf)
{
  Internals& inside = *this->Inside;
  const std::size_t first = inside.Explored.size();
  for (const auto& [cell, corner] : inside.Targets)
  {
    const Cell target = cell->neighbor(corner);
    if (!inside.isInfinite(target) && inside.numberOf(target) == unexplored)
    {
      inside.explore(target);
    }
  }
  inside.Targets.clear();
  inside.orderExplored(execution, first, treeIndexOf);
  return inside.Explored.size();
}

std::size_t PartialTriangulation::across(const ExploredFacet& facet) const
{
  const Cell cell = this->Inside->Explored[facet.tetrahedron]->neighbor(facet.corner);
  return this->Inside->isInfinite(cell) ? outside : this->Inside->numberOf(cell);
}

FacetCorners PartialTriangulation::cornersOf(const ExploredFacet& facet) const
{
  FacetCorners result{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    const VertexInfo& info =
      this->Inside->Explored[facet.tetrahedron]->vertex(outwardFacets[facet.corner][i])->info();
    result.corners[i] = info.leaf();
    result.areBelow[i] = info.isBelow();
  }
  return result;
}

LeafTetrahedron PartialTriangulation::exploredTetrahedron(std::size_t tetrahedron) const
{
  return bySides(this->Inside->Explored[tetrahedron]);
}

ExploredFacet PartialTriangulation::nextBorderFacet(
  const ExploredFacet& facet, std::size_t side, const std::vector<char>& areInGap) const
{
  const auto isInBody = [&](Cell cell)
  {
    const std::size_t number = this->Inside->numberOf(cell);
    return !this->Inside->isInfinite(cell) && (number == unexplored || !areInGap[number]);
  };
  Cell cell = this->Inside->Explored[facet.tetrahedron];
  // The wedge lies between the facet just passed, opposite to `passed`, and that opposite to
  // `next`.
  Vertex passed = cell->vertex(facet.corner);
  Vertex next = cell->vertex(outwardFacets[facet.corner][(side + 2) % 3]);
  while (isInBody(cell->neighbor(cell->index(next))))
  {
    const Cell last = cell;
    cell = cell->neighbor(cell->index(next));
    next = std::exchange(passed, this->Inside->Cells.mirror_vertex(last, last->index(next)));
  }
  return { this->Inside->numberOf(cell), cell->index(next) };
}

} // namespace isopoint
