// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Tetrahedra/BandTriangulation.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <iterator>
#include <numeric>

namespace isopoint
{
namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

/// The leaf of a vertex, and the side of its value, in the bits of one number.
class VertexInfo
{
public:
  VertexInfo() = default;
  explicit VertexInfo(const BandSite& site)
    : Bits(2 * site.leaf + (site.isBelow ? 1 : 0))
  {
  }

  std::uint64_t leaf() const { return this->Bits / 2; }
  bool isBelow() const { return this->Bits % 2 != 0; }

private:
  std::uint64_t Bits = 0;
};

struct CellInfo
{
  bool isCertified = false;
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<VertexInfo, Kernel>;
using CellBase = CGAL::Triangulation_cell_base_with_info_3<CellInfo, Kernel,
  CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel,
  CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Cell = Triangulation::Cell_handle;
using Vertex = Triangulation::Vertex_handle;

Point pointAt(const Vector& position)
{
  return { position[0], position[1], position[2] };
}

/// Permutes corners evenly, so that those below come first.
CrossingTetrahedron<std::uint64_t> bySides(std::array<VertexInfo, 4> corners)
{
  const auto isBelow = [](const VertexInfo& corner) { return corner.isBelow(); };
  CrossingTetrahedron<std::uint64_t> result{};
  result.belowCount =
    static_cast<std::uint8_t>(std::count_if(corners.begin(), corners.end(), isBelow));
  bool isOdd = false;
  for (std::size_t place = 0; place < result.belowCount; ++place)
  {
    const std::size_t from = static_cast<std::size_t>(
      std::find_if(corners.begin() + static_cast<std::ptrdiff_t>(place), corners.end(), isBelow) -
      corners.begin());
    std::swap(corners[place], corners[from]);
    isOdd = isOdd != (place != from);
  }
  if (isOdd)
  {
    // Two corners of one side.
    const std::size_t first = result.belowCount == 3 ? 0 : 2;
    std::swap(corners[first], corners[first + 1]);
  }
  std::transform(corners.begin(), corners.end(), result.corners.begin(),
    [](const VertexInfo& corner) { return corner.leaf(); });
  return result;
}

Vector positionOf(const Point& point)
{
  return { point.x(), point.y(), point.z() };
}

} // namespace

class BandTriangulation::Internals
{
public:
  Triangulation Cells;
  std::vector<Cell> Open; // the listed ones

  /// Whether a cell has corners on both sides.
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
    }
    return hasBelow && hasOther;
  }

  /// Makes room for the cells of an insertion. An allocation that fails in the middle of one would
  /// leave a static variable of CGAL as no later insertion expects it.
  void reserveCells()
  {
    constexpr std::size_t mostAtOnce = 256; // larger holes are filled in another way
    auto& cells = this->Cells.tds().cells();
    if (cells.capacity() - cells.size() < mostAtOnce)
    {
      constexpr std::size_t leastBlock = 1024;
      constexpr std::size_t shareOfBlock = 64;
      cells.reserve(cells.capacity() + leastBlock + cells.size() / shareOfBlock);
    }
  }

  /// The index of the infinite vertex, or -1.
  int infiniteIndexOf(Cell cell) const
  {
    int index = 0;
    return cell->has_vertex(this->Cells.infinite_vertex(), index) ? index : -1;
  }
};

BandTriangulation::BandTriangulation()
  : Inside(std::make_unique<Internals>())
{
}

BandTriangulation::~BandTriangulation() = default;

void BandTriangulation::insert(
  const std::vector<BandSite>& sites, const std::function<void(double share)>& step)
{
  this->Inside->Open = {};
  std::vector<Point> points;
  points.reserve(sites.size());
  std::transform(sites.begin(), sites.end(), std::back_inserter(points),
    [](const BandSite& site) { return pointAt(site.position); });
  std::vector<std::size_t> order(sites.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  // As CGAL does for a range of points: each is close to the one before.
  const auto pointOf = CGAL::make_property_map(points);
  CGAL::spatial_sort(order.begin(), order.end(),
    CGAL::Spatial_sort_traits_adapter_3<Kernel, decltype(pointOf)>(pointOf));
  constexpr std::size_t stepSize = 512;
  Cell hint;
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    this->Inside->reserveCells();
    const Vertex vertex = this->Inside->Cells.insert(points[order[i]], hint);
    vertex->info() = VertexInfo(sites[order[i]]);
    hint = vertex->cell();
    if (i % stepSize == 0)
    {
      step(static_cast<double>(i) / static_cast<double>(order.size()));
    }
  }
}

std::size_t BandTriangulation::size() const
{
  return this->Inside->Cells.number_of_vertices();
}

std::size_t BandTriangulation::cellCount() const
{
  return this->Inside->Cells.tds().cells().size();
}

int BandTriangulation::dimension() const
{
  return this->Inside->Cells.dimension();
}

bool BandTriangulation::raisesDimension(const Vector& position) const
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
      // In a triangulation of this dimension the corners of a cell are its first vertices.
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

std::size_t BandTriangulation::listOpenCells()
{
  const Triangulation& cells = this->Inside->Cells;
  std::vector<Cell>& open = this->Inside->Open;
  open.clear();
  if (cells.dimension() == 3)
  {
    for (const Cell cell : cells.all_cell_handles())
    {
      if (!cell->info().isCertified && this->Inside->isCrossing(cell))
      {
        open.push_back(cell);
      }
    }
  }
  return open.size();
}

bool BandTriangulation::isBeyondHull(std::size_t openCell) const
{
  return this->Inside->infiniteIndexOf(this->Inside->Open[openCell]) >= 0;
}

TetrahedronCorners BandTriangulation::tetrahedronAt(std::size_t openCell) const
{
  const Cell cell = this->Inside->Open[openCell];
  return { positionOf(cell->vertex(0)->point()), positionOf(cell->vertex(1)->point()),
    positionOf(cell->vertex(2)->point()), positionOf(cell->vertex(3)->point()) };
}

HullFacetCorners BandTriangulation::hullFacetAt(std::size_t openCell) const
{
  // A place beyond the hull would take the infinite vertex' place in the orientation.
  constexpr int facets[4][3] = { { 2, 1, 3 }, { 0, 2, 3 }, { 1, 0, 3 }, { 0, 1, 2 } };
  const Cell cell = this->Inside->Open[openCell];
  const int* const facet = facets[this->Inside->infiniteIndexOf(cell)];
  return { positionOf(cell->vertex(facet[0])->point()), positionOf(cell->vertex(facet[1])->point()),
    positionOf(cell->vertex(facet[2])->point()) };
}

bool BandTriangulation::isInside(std::size_t openCell, const Vector& position) const
{
  constexpr bool decidesTies = true;
  return this->Inside->Cells.side_of_sphere(
           this->Inside->Open[openCell], pointAt(position), decidesTies) == CGAL::ON_BOUNDED_SIDE;
}

void BandTriangulation::certify(std::size_t openCell)
{
  this->Inside->Open[openCell]->info().isCertified = true;
}

std::vector<bool> BandTriangulation::areBelow(const std::vector<Vector>& positions) const
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

void BandTriangulation::visitCrossing(
  const std::function<void(const CrossingTetrahedron<std::uint64_t>&)>& visit) const
{
  const Triangulation& cells = this->Inside->Cells;
  if (cells.dimension() < 3)
  {
    return;
  }
  for (const Cell cell : cells.finite_cell_handles())
  {
    if (this->Inside->isCrossing(cell))
    {
      visit(bySides({ cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(),
        cell->vertex(3)->info() }));
    }
  }
}

} // namespace isopoint
