// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's tetrahedrization as BandTriangulation.cxx needs it, and alone includes it.
#ifndef isopoint_BandInsertion_h
#define isopoint_BandInsertion_h

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Tetrahedra/BandKernel.h"
#include "Core/Tetrahedra/BandTriangulation.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Spatial_lock_grid_3.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <numeric>
#include <vector>

namespace isopoint::band
{

/// The leaf of a vertex, and the side of its value, in the bits of one number.
class VertexInfo
{
public:
  VertexInfo() = default;
  VertexInfo(std::uint64_t leaf, bool isBelow)
    : Bits(2 * leaf + (isBelow ? 1 : 0))
  {
  }

  std::uint64_t leaf() const { return this->Bits / 2; }
  bool isBelow() const { return this->Bits % 2 != 0; }

private:
  std::uint64_t Bits = 0;
};

/// How many cells this thread can make, at least, before CGAL allocates memory. CGAL keeps lists of
/// free cells, with Concurrency one for each thread.
inline thread_local std::ptrdiff_t freeCells = 0;

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

/// Locks of the cells of a grid. Nobody waits: a thread that does not get one gives back all of its
/// own and goes on elsewhere, so that an exception on another thread, which leaves locks behind,
/// stops none. For the same reason CGAL's own loop is not used: it waits for ever then, and cannot
/// be aborted.
#ifdef CGAL_LINKED_WITH_TBB
using Locks = CGAL::Spatial_lock_grid_3<CGAL::Tag_non_blocking>;
#else
using Locks = CGAL::Spatial_lock_grid_3<>;
#endif

/// Parallel where oneTBB is available.
using Concurrency = CGAL::Parallel_if_available_tag;

using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<VertexInfo, Kernel>;
using CellBase = CGAL::Triangulation_cell_base_with_info_3<CellInfo, Kernel,
  CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel,
  CGAL::Triangulation_data_structure_3<VertexBase, CellBase, Concurrency>, CGAL::Default, Locks>;
using Cell = Triangulation::Cell_handle;
using Vertex = Triangulation::Vertex_handle;

inline Point pointAt(const Vector& position)
{
  return { position[0], position[1], position[2] };
}

/// Makes room for the cells of an insertion, on this thread. CGAL fills holes through a static
/// variable of the thread, which an allocation that fails would leave as no later insertion
/// expects it.
inline void reserveCells(Triangulation& triangulation)
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
    std::size_t begin = 0;
    for (const std::size_t end : this->levels())
    {
      this->insertLevel(begin, end);
      begin = end;
    }
  }

private:
  /// Several threads insert this many samples quicker than one.
  static constexpr std::size_t manySites = 4096;

  /// Of a stream, between two looks at an abort.
  static constexpr std::size_t batchSize = 2048;

  /// Consecutive samples of a level, which one thread at a time inserts.
  struct Stream
  {
    std::size_t next;
    std::size_t end;
    Vertex hint;                   // near the next sample
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
  VertexInfo infoAt(std::size_t place) const
  {
    return { this->siteAt(place).leaf, this->siteAt(place).isBelow };
  }

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
    hint->info() = this->infoAt(place);
    ++this->Done;
  }

  void report() const
  {
    this->Step(static_cast<double>(this->Done) / static_cast<double>(this->Order.size()));
  }

  void insertLevel(std::size_t begin, std::size_t end)
  {
#ifdef CGAL_LINKED_WITH_TBB
    if (this->Run.threads > 1 && end - begin >= manySites && this->Cells.dimension() == 3 &&
        this->makeLocks())
    {
      this->insertTogether(begin, end);
      return;
    }
#endif
    this->insertAlone(begin, end);
  }

#ifdef CGAL_LINKED_WITH_TBB
  /// Makes a grid around all vertices, those to be inserted included. @returns whether it could
  bool makeLocks()
  {
    CGAL::Bbox_3 box;
    for (const Point& point : this->Cells.points())
    {
      box += point.bbox();
    }
    for (const BandSite& site : this->Sites)
    {
      box += pointAt(site.position).bbox();
    }
    constexpr int side = 64;
    this->Grid = std::make_unique<Locks>(box, side);
    this->Cells.set_lock_data_structure(this->Grid.get());
    return std::isfinite(box.x_span() + box.y_span() + box.z_span());
  }
#endif

  /// Inserts samples of a level in streams, a thread in each: mostly far from each other. What they
  /// cannot lock is left for this thread alone, and all of the rest if that is much.
  void insertTogether(std::size_t begin, std::size_t end)
  {
    // The infinite vertex is locked by its position, which has no other meaning.
    this->Cells.infinite_vertex()->set_point(pointAt(this->siteAt(begin).position));
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

  std::vector<Stream> streamsOf(std::size_t begin, std::size_t end) const
  {
    const std::size_t length = (end - begin + this->Run.threads - 1) / this->Run.threads;
    std::vector<Stream> streams;
    for (std::size_t next = begin; next < end; next += length)
    {
      streams.push_back(
        { next, std::min(next + length, end), this->Cells.finite_vertices_begin(), {} });
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
    freeCells = 0;
    const std::size_t end = endOfBatch(stream);
    for (; stream.next < end; ++stream.next)
    {
      if (!this->tryInsert(stream.next, stream.hint))
      {
        stream.left.push_back(stream.next);
      }
    }
    // Retry once: other threads may have released their locks.
    const auto isInserted = [&](std::size_t place) { return this->tryInsert(place, stream.hint); };
    stream.left.erase(
      std::remove_if(stream.left.begin(), stream.left.end(), isInserted), stream.left.end());
  }

  /// Inserts a sample if it gets the locks. @param hint near it; becomes its vertex then
  bool tryInsert(std::size_t place, Vertex& hint)
  {
    reserveCells(this->Cells);
    const Point point = pointAt(this->siteAt(place).position);
    bool hasLocks = this->Cells.try_lock_vertex(hint) && this->Cells.try_lock_point(point);
    if (hasLocks)
    {
      const Vertex vertex = this->Cells.insert(point, hint, &hasLocks);
      if (hasLocks)
      {
        vertex->info() = this->infoAt(place);
        hint = vertex;
      }
    }
    this->Cells.unlock_all_elements();
    return hasLocks;
  }

  const Execution& Run;
  Triangulation& Cells;
  const std::vector<BandSite>& Sites;
  const std::function<void(double share)>& Step;
  std::vector<std::size_t> Order;
  std::size_t Done = 0; // samples that are inserted
  std::unique_ptr<Locks> Grid;
};

} // namespace isopoint::band

#endif
