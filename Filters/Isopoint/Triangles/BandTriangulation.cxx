// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Triangles/BandTriangulation.h"

#include "Isopoint/Base/LockGrid.h"
#include "Isopoint/Base/Region.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <type_traits>

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

/// How many cells this thread can make, at least, before CGAL allocates memory. CGAL keeps lists of
/// free cells, with Concurrency one for each thread.
thread_local std::ptrdiff_t freeCells = 0;

/// Of a cell; counts how many there are.
class CellInfo
{
public:
  CellInfo() { --freeCells; }
  CellInfo(const CellInfo& other)
    : isCertified(other.isCertified)
  {
    --freeCells;
  }
  CellInfo& operator=(const CellInfo&) = default;
  ~CellInfo() { ++freeCells; }

  bool isCertified = false;
};

/// A grid of locks as CGAL calls it, a SurjectiveLockDataStructure. Vertices are locked by their
/// positions; who locks is `holder`.
class VertexLocks
{
public:
  static thread_local LockGrid::Holder* holder;

  explicit VertexLocks(const Region& region)
    : Grid(region)
    , Bounds(region.lower[0], region.lower[1], region.lower[2], region.upper[0], region.upper[1],
        region.upper[2])
  {
  }

  template <class TPoint>
  bool try_lock(const TPoint& point, int = 0)
  {
    return this->Grid.tryLock({ point.x(), point.y(), point.z() }, *holder);
  }
  template <bool, class TPoint>
  bool try_lock(const TPoint& point, int = 0)
  {
    return this->try_lock(point);
  }
  template <class TPoint>
  bool is_locked_by_this_thread(const TPoint& point) const
  {
    return this->Grid.isLocked({ point.x(), point.y(), point.z() }, *holder);
  }
  void unlock_all_points_locked_by_this_thread() { this->Grid.unlockAll(*holder); }
  const CGAL::Bbox_3& get_bbox() const { return this->Bounds; }

private:
  LockGrid Grid;
  CGAL::Bbox_3 Bounds;
};

thread_local LockGrid::Holder* VertexLocks::holder = nullptr;

#ifdef CGAL_LINKED_WITH_TBB
using Concurrency = CGAL::Parallel_tag;
#else
using Concurrency = CGAL::Sequential_tag;
#endif

using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<VertexInfo, Kernel>;
using CellBase = CGAL::Triangulation_cell_base_with_info_3<CellInfo, Kernel,
  CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel,
  CGAL::Triangulation_data_structure_3<VertexBase, CellBase, Concurrency>, CGAL::Default,
  VertexLocks>;
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

/// Makes room for the cells of an insertion, on this thread. CGAL fills holes through a static
/// variable of the thread, which an allocation that fails would leave as no later insertion
/// expects it.
void reserveCells(Triangulation& triangulation)
{
  constexpr std::ptrdiff_t mostAtOnce = 256; // larger holes are filled in another way
  if (freeCells >= mostAtOnce)
  {
    return;
  }
  constexpr std::size_t count = 1024;
  auto& cells = triangulation.tds().cells();
  std::array<Cell, count> reserved;
  std::generate(reserved.begin(), reserved.end(), [&cells]() { return cells.emplace(); });
  std::for_each(reserved.begin(), reserved.end(), [&cells](Cell cell) { cells.erase(cell); });
  freeCells = static_cast<std::ptrdiff_t>(count);
}

/// Inserts samples in the order that CGAL has for a range of points: in levels, each of seven times
/// as many as all before it, and in each level along a curve through space.
class Insertion
{
public:
  Insertion(const Execution& execution, Triangulation& cells, const std::vector<BandSite>& sites,
    const std::function<void(double share)>& step)
    : Run(execution)
    , Cells(cells)
    , Sites(sites)
    , Step(step)
    , Order(sites.size())
  {
  }
  Insertion(const Insertion&) = delete;
  Insertion& operator=(const Insertion&) = delete;
  ~Insertion() { this->Cells.set_lock_data_structure(nullptr); }

  void run()
  {
    this->sort();
    const bool hasThreads =
      std::is_same_v<Concurrency, CGAL::Parallel_tag> && this->Run.threads > 1;
    std::size_t begin = 0;
    for (const std::size_t end : this->levels())
    {
      if (hasThreads && end - begin >= manySites && this->Cells.dimension() == 3)
      {
        this->insertTogether(begin, end);
      }
      else
      {
        this->insertAlone(begin, end);
      }
      begin = end;
    }
  }

private:
  /// Several threads insert so many samples quicker than one.
  static constexpr std::size_t manySites = 4096;

  /// Of a stream, between two looks at an abort.
  static constexpr std::size_t batchSize = 2048;

  /// Consecutive samples of a level, which one thread at a time inserts.
  struct Stream
  {
    std::size_t next;
    std::size_t end;
    Vertex hint; // near the next sample
    LockGrid::Holder locks;
    std::vector<std::size_t> left; // samples where others had locks
  };

  void sort()
  {
    std::vector<Point> points;
    points.reserve(this->Sites.size());
    std::transform(this->Sites.begin(), this->Sites.end(), std::back_inserter(points),
      [](const BandSite& site) { return pointAt(site.position); });
    std::iota(this->Order.begin(), this->Order.end(), std::size_t{ 0 });
    const auto pointOf = CGAL::make_property_map(points);
    CGAL::spatial_sort(this->Order.begin(), this->Order.end(),
      CGAL::Spatial_sort_traits_adapter_3<Kernel, decltype(pointOf)>(pointOf));
  }

  /// The ends of the levels, those of few samples taken together.
  std::vector<std::size_t> levels() const
  {
    constexpr std::size_t ratio = 8; // CGAL's default
    std::vector<std::size_t> ends{ this->Order.size() };
    while (ends.back() >= manySites)
    {
      ends.push_back(ends.back() / ratio);
    }
    std::reverse(ends.begin(), ends.end());
    return ends;
  }

  const BandSite& siteAt(std::size_t place) const { return this->Sites[this->Order[place]]; }

  void insertAlone(std::size_t begin, std::size_t end)
  {
    constexpr std::size_t stepSize = 512;
    Vertex hint;
    freeCells = 0;
    for (std::size_t place = begin; place < end; ++place)
    {
      if ((place - begin) % stepSize == 0)
      {
        this->report();
      }
      this->insert(place, hint);
    }
  }

  /// @param hint near the sample, or null; becomes its vertex
  void insert(std::size_t place, Vertex& hint)
  {
    reserveCells(this->Cells);
    hint = this->Cells.insert(pointAt(this->siteAt(place).position), hint);
    hint->info() = VertexInfo(this->siteAt(place));
    ++this->Done;
  }

  void report() const
  {
    this->Step(static_cast<double>(this->Done) / static_cast<double>(this->Order.size()));
  }

  /// Inserts samples of a level in streams, a thread in each: mostly far from each other. What they
  /// cannot lock is left for this thread alone, and all of the rest if that is much.
  void insertTogether(std::size_t begin, std::size_t end)
  {
    this->Locks = std::make_unique<VertexLocks>(this->region());
    // The infinite vertex is locked by its position, which has no other meaning.
    this->Cells.infinite_vertex()->set_point(pointAt(this->siteAt(begin).position));
    this->Cells.set_lock_data_structure(this->Locks.get());
    std::vector<Stream> streams = this->streamsOf(begin, end);
    const std::size_t doneBefore = this->Done;
    bool isCrowded = false;
    while (this->Done - doneBefore < end - begin && !isCrowded)
    {
      this->report();
      isCrowded = !this->advance(streams);
    }
    for (const Stream& stream : streams)
    {
      this->insertAlone(stream.next, stream.end);
    }
  }

  Region region() const
  {
    Region region{ this->Sites.front().position, this->Sites.front().position };
    for (const BandSite& site : this->Sites)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        region.lower[axis] = std::min(region.lower[axis], site.position[axis]);
        region.upper[axis] = std::max(region.upper[axis], site.position[axis]);
      }
    }
    return region;
  }

  std::vector<Stream> streamsOf(std::size_t begin, std::size_t end) const
  {
    const std::size_t count = std::min(this->Run.threads, LockGrid::mostHolders);
    const std::size_t length = (end - begin + count - 1) / count;
    std::vector<Stream> streams;
    for (std::size_t next = begin; next < end; next += length)
    {
      streams.push_back({ next, std::min(next + length, end), this->Cells.finite_vertices_begin(),
        LockGrid::Holder(streams.size()), {} });
      streams.back().left.reserve(batchSize);
    }
    return streams;
  }

  /// Inserts a batch of each stream.
  /// @returns whether few samples had to be left for this thread alone
  bool advance(std::vector<Stream>& streams)
  {
    std::size_t count = 0;
    std::size_t leftCount = 0;
    for (const Stream& stream : streams)
    {
      count += endOfBatch(stream) - stream.next;
    }
    forRanges(this->Run, streams.size(), 1,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t i = first; i < last; ++i)
        {
          this->advance(streams[i]);
        }
      });
    freeCells = 0;
    this->Done += count;
    for (Stream& stream : streams)
    {
      this->Done -= stream.left.size();
      leftCount += stream.left.size();
      for (const std::size_t place : stream.left)
      {
        this->insert(place, stream.hint);
      }
      stream.left.clear();
    }
    constexpr std::size_t manyParts = 4;
    return manyParts * leftCount < count;
  }

  static std::size_t endOfBatch(const Stream& stream)
  {
    return std::min(stream.next + batchSize, stream.end);
  }

  /// The same of one stream, on any thread.
  void advance(Stream& stream)
  {
    VertexLocks::holder = &stream.locks;
    freeCells = 0;
    const std::size_t end = endOfBatch(stream);
    for (; stream.next < end; ++stream.next)
    {
      if (!this->tryInsert(stream.next, stream.hint))
      {
        stream.left.push_back(stream.next);
      }
    }
    // By now others have moved on.
    const auto isInserted = [&](std::size_t place) { return this->tryInsert(place, stream.hint); };
    stream.left.erase(
      std::remove_if(stream.left.begin(), stream.left.end(), isInserted), stream.left.end());
  }

  /// Inserts a sample if it gets the locks. @param hint near it; becomes its vertex then
  bool tryInsert(std::size_t place, Vertex& hint)
  {
    reserveCells(this->Cells);
    const Point point = pointAt(this->siteAt(place).position);
    bool hasLocks = this->Locks->try_lock(hint->point()) && this->Locks->try_lock(point);
    if (hasLocks)
    {
      const Vertex vertex = this->Cells.insert(point, hint, &hasLocks);
      if (hasLocks)
      {
        vertex->info() = VertexInfo(this->siteAt(place));
        hint = vertex;
      }
    }
    this->Locks->unlock_all_points_locked_by_this_thread();
    return hasLocks;
  }

  const Execution& Run;
  Triangulation& Cells;
  const std::vector<BandSite>& Sites;
  const std::function<void(double share)>& Step;
  std::vector<std::size_t> Order;
  std::size_t Done = 0; // samples that are inserted
  std::unique_ptr<VertexLocks> Locks;
};

} // namespace

class BandTriangulation::Internals
{
public:
  explicit Internals(const Execution& execution)
    : Run(execution)
  {
  }

  const Execution& Run;
  std::unique_ptr<VertexLocks> Locks; // of the last insertion on several threads
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

  /// The index of the infinite vertex, or -1.
  int infiniteIndexOf(Cell cell) const
  {
    int index = 0;
    return cell->has_vertex(this->Cells.infinite_vertex(), index) ? index : -1;
  }
};

BandTriangulation::BandTriangulation(const Execution& execution)
  : Inside(std::make_unique<Internals>(execution))
{
}

BandTriangulation::~BandTriangulation() = default;

void BandTriangulation::insert(
  const std::vector<BandSite>& sites, const std::function<void(double share)>& step)
{
  this->Inside->Open = {};
  Insertion(this->Inside->Run, this->Inside->Cells, sites, step).run();
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
