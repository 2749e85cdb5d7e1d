// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's tetrahedralization as PartialTriangulation.cxx needs it, and alone includes it.
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Tetrahedra/PartialTriangulation.h"
#include "Core/Tetrahedra/TriangulationKernel.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Spatial_lock_grid_3.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/spatial_sort.h>
#include <CGAL/tags.h>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace isopoint::cgal
{

/// The leaf of a vertex and the side of its value, packed into one integer.
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

/// The positions of sites, by number, as CGAL's sort reads them: many times, in one thread. Looks
/// for an abort meanwhile.
class ReadPoints
{
public:
  using key_type = std::size_t;
  using value_type = Point;
  using reference = const Point&;
  using category = boost::readable_property_map_tag;

  ReadPoints(const Execution& execution, const std::vector<Point>& points, std::size_t& reads)
    : Run(&execution)
    , Points(&points)
    , Reads(&reads)
  {
  }

  friend const Point& get(const ReadPoints& points, std::size_t site)
  {
    constexpr std::size_t batch = 1 << 16;
    if (++*points.Reads % batch == 0)
    {
      throwIfAborted(*points.Run);
    }
    return (*points.Points)[site];
  }

private:
  const Execution* Run;
  const std::vector<Point>* Points;
  std::size_t* Reads; // counted by all copies
};

/// A lower bound on the cells that this thread can make before CGAL allocates memory. CGAL reuses
/// freed cells; in parallel insertions each thread has its own.
inline thread_local std::ptrdiff_t freeCells = 0;

/// Called by this thread after every few thousand cells that it frees; must not throw.
inline thread_local const std::function<void()>* freesCells = nullptr;

/// Info of a cell; counts free cells.
class CellInfo
{
public:
  CellInfo() { --freeCells; }
  CellInfo(const CellInfo& other)
    : isCertified(other.isCertified)
    , Number(other.Number)
  {
    --freeCells;
  }
  CellInfo& operator=(const CellInfo&) = default;
  ~CellInfo()
  {
    constexpr std::ptrdiff_t batch = 4096;
    if (++freeCells % batch == 0 && freesCells)
    {
      (*freesCells)();
    }
  }

  /// A number below 2^48; 0 at first.
  std::uint64_t number() const
  {
    std::uint64_t number = 0;
    for (std::size_t i = this->Number.size(); i > 0; --i)
    {
      number = number << 8 | this->Number[i - 1];
    }
    return number;
  }
  void setNumber(std::uint64_t number)
  {
    for (unsigned char& byte : this->Number)
    {
      byte = static_cast<unsigned char>(number);
      number >>= 8;
    }
  }

  bool isCertified = false;

private:
  // Bytes, because CGAL's cell has just enough of them left.
  std::array<unsigned char, 6> Number{};
};

/// Nonblocking locks on grid cells. A thread that fails to get a lock releases all of its own and
/// continues elsewhere, so that locks left behind by an exception on another thread stop no one.
/// CGAL's own insertion loop would wait forever then, and cannot be aborted.
#ifdef CGAL_LINKED_WITH_TBB
using Locks = CGAL::Spatial_lock_grid_3<CGAL::Tag_non_blocking>;
#else
using Locks = CGAL::Spatial_lock_grid_3<>;
#endif

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

/// Reserves cells for an insertion on this thread. CGAL fills holes through a static variable of
/// the thread, which a failed allocation would leave in an invalid state.
inline void reserveCells(Triangulation& triangulation)
{
  constexpr std::ptrdiff_t maxAtOnce = 256; // CGAL fills larger holes in another way
  if (freeCells >= maxAtOnce)
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

/// Inserts samples in CGAL's order for ranges of points: in levels, each with seven times as many
/// samples as all before it, and within each level along a space-filling curve.
class Insertion
{
public:
  Insertion(const Execution& execution, Triangulation& cells, const std::vector<Site>& sites,
    const std::function<void(double share)>& step, std::size_t most)
    : Run(execution)
    , Cells(cells)
    , Sites(sites)
    , Step(step)
    , Most(most)
    , Order(sites.size())
  {
  }
  Insertion(const Insertion&) = delete;
  Insertion& operator=(const Insertion&) = delete;
  ~Insertion() { this->Cells.set_lock_data_structure(nullptr); }

  /// @returns whether all samples were inserted, without more cells
  bool run()
  {
    this->sort();
    std::size_t begin = 0;
    for (const std::size_t end : this->levels())
    {
      this->insertLevel(begin, end);
      begin = end;
    }
    return !this->isFull();
  }

private:
  /// From this many samples on, several threads are faster than one.
  static constexpr std::size_t manySites = 4096;

  /// Samples of a stream between two checks for an abort.
  static constexpr std::size_t batchSize = 2048;

  /// Consecutive samples of a level, inserted by one thread at a time.
  struct Stream
  {
    std::size_t next;
    std::size_t end;
    Vertex hint;                   // close to the next sample
    std::vector<std::size_t> left; // samples skipped because of others' locks
  };

  void sort()
  {
    std::vector<Point> points(this->Sites.size());
    forEachIndex(this->Run, points.size(),
      [&](std::size_t site)
      {
        points[site] = pointAt(this->Sites[site].position);
        this->Order[site] = site;
      });
    std::size_t reads = 0;
    CGAL::spatial_sort(this->Order.begin(), this->Order.end(),
      CGAL::Spatial_sort_traits_adapter_3<Kernel, ReadPoints>(
        ReadPoints(this->Run, points, reads)));
  }

  /// The ends of the levels; levels with few samples are combined.
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

  const Site& siteAt(std::size_t i) const { return this->Sites[this->Order[i]]; }
  VertexInfo infoAt(std::size_t i) const
  {
    return { this->siteAt(i).leaf, this->siteAt(i).isBelow };
  }

  void insertAlone(std::size_t begin, std::size_t end)
  {
    constexpr std::size_t stepSize = 512;
    Vertex hint;
    freeCells = 0;
    constexpr std::size_t fewSites = 64; // on curves they add thousands of cells each
    for (std::size_t i = begin; i < end; ++i)
    {
      if ((i - begin) % fewSites == 0 && this->isFull())
      {
        return;
      }
      if ((i - begin) % stepSize == 0)
      {
        this->report();
      }
      this->insert(i, hint);
    }
  }

  /// @param hint close to the sample, or null; set to its vertex
  void insert(std::size_t i, Vertex& hint)
  {
    reserveCells(this->Cells);
    hint = this->Cells.insert(pointAt(this->siteAt(i).position), hint);
    hint->info() = this->infoAt(i);
    ++this->Done;
  }

  void report() const
  {
    this->Step(static_cast<double>(this->Done) / static_cast<double>(this->Order.size()));
  }

  /// Whether there are more cells than wanted.
  bool isFull() const { return this->Cells.tds().cells().size() > this->Most; }

  /// Whether there may be too many cells after a few thousand more samples.
  bool mayGetFull() const
  {
    constexpr std::size_t manyForSample = 20;
    return this->Cells.tds().cells().size() > manyForSample * this->Cells.number_of_vertices();
  }

  void insertLevel(std::size_t begin, std::size_t end)
  {
#ifdef CGAL_LINKED_WITH_TBB
    if (this->Run.threads > 1 && end - begin >= manySites && this->Cells.dimension() == 3 &&
        !this->mayGetFull() && this->makeLocks())
    {
      this->insertTogether(begin, end);
      return;
    }
#endif
    this->insertAlone(begin, end);
  }

#ifdef CGAL_LINKED_WITH_TBB
  /// Makes a grid of locks around all samples, inserted or not. @returns whether it could
  bool makeLocks()
  {
    CGAL::Bbox_3 box;
    for (const Point& point : this->Cells.points())
    {
      box += point.bbox();
    }
    for (const Site& site : this->Sites)
    {
      box += pointAt(site.position).bbox();
    }
    constexpr int side = 64;
    this->Grid = std::make_unique<Locks>(box, side);
    this->Cells.set_lock_data_structure(this->Grid.get());
    return std::isfinite(box.x_span() + box.y_span() + box.z_span());
  }
#endif

  /// Inserts a level in streams, which are mostly far apart, one thread each. This thread inserts
  /// the samples that could not be locked, or all the rest if there are many.
  void insertTogether(std::size_t begin, std::size_t end)
  {
    // The infinite vertex is locked by its position, which has no other meaning.
    this->Cells.infinite_vertex()->set_point(pointAt(this->siteAt(begin).position));
    std::vector<Stream> streams = this->streamsOf(begin, end);
    const std::size_t doneBefore = this->Done;
    bool isDense = false;
    while (this->Done - doneBefore < end - begin && !isDense)
    {
      this->report();
      isDense = !this->advance(streams) || this->mayGetFull();
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
  /// @returns whether only few samples had to be skipped
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
      for (const std::size_t i : stream.left)
      {
        this->insert(i, stream.hint);
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

  /// Inserts a batch of one stream, on any thread.
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
    // A retry often succeeds because other threads have released their locks.
    const auto isInserted = [&](std::size_t i) { return this->tryInsert(i, stream.hint); };
    stream.left.erase(
      std::remove_if(stream.left.begin(), stream.left.end(), isInserted), stream.left.end());
  }

  /// Inserts a sample if it gets the locks. @param hint close to it; set to its vertex
  bool tryInsert(std::size_t i, Vertex& hint)
  {
    reserveCells(this->Cells);
    const Point point = pointAt(this->siteAt(i).position);
    bool hasLocks = this->Cells.try_lock_vertex(hint) && this->Cells.try_lock_point(point);
    if (hasLocks)
    {
      const Vertex vertex = this->Cells.insert(point, hint, &hasLocks);
      if (hasLocks)
      {
        vertex->info() = this->infoAt(i);
        hint = vertex;
      }
    }
    this->Cells.unlock_all_elements();
    return hasLocks;
  }

  const Execution& Run;
  Triangulation& Cells;
  const std::vector<Site>& Sites;
  const std::function<void(double share)>& Step;
  const std::size_t Most; // cells
  std::vector<std::size_t> Order;
  std::size_t Done = 0; // samples inserted
  std::unique_ptr<Locks> Grid;
};

} // namespace isopoint::cgal
