// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/SplatMesh/MeetingVertices.h"

#include "Core/Base/Hash.h"
#include "Core/Base/Lists.h"
#include "Core/Base/Sorting.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>

namespace isopoint
{

namespace
{

bool coincide(const SplatVertex& a, const SplatVertex& b)
{
  constexpr float turn = 1e-3f;
  const double tolerance = std::min(a.tolerance, b.tolerance);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (std::abs(a.position[axis] - b.position[axis]) > tolerance ||
        std::abs(a.normal[axis] - b.normal[axis]) > turn)
    {
      return false;
    }
  }
  return true;
}

/// Integers that may exceed the range of integer types.
using Cell = std::array<double, 3>;

/// The grid cell of a position that is moved by an offset along all axes.
/// @param cells per unit of length
Cell cellOf(const Vector& position, double offset, double cells)
{
  Cell cell;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    cell[axis] = std::floor((position[axis] + offset) * cells);
  }
  return cell;
}

/// Whether other vertices may coincide with a vertex.
bool mayMeet(const SplatVertex& vertex)
{
  return vertex.tolerance > 0.0f && std::isfinite(vertex.tolerance);
}

/// The grid of a vertex, as the binary logarithm of its spacing: at least four times the tolerance,
/// but small compared with a splat. Spacings differ by factors of 16, so there are few grids.
int gridOf(const SplatVertex& vertex)
{
  constexpr int powers = 4;
  const double power = std::floor(std::ilogb(vertex.tolerance) / static_cast<double>(powers));
  return powers * (static_cast<int>(power) + 1) + 2;
}

/// A vertex in a cell of its own grid or of a coarser one.
using Entry = std::pair<std::uint64_t, std::size_t>; // the cell's hash, and the vertex

/// Entries of finer grids have odd hashes, the cell's even hash plus one, and so come last.
bool isOfFinerGrid(const Entry& entry)
{
  return (entry.first & 1) != 0;
}

/// A number of the entry's cell, in its own grid or the coarser one.
std::uint64_t cellNumber(const Entry& entry)
{
  return entry.first >> 1;
}

/// Calls visit(cell) for all cells of a grid within a vertex's tolerance.
template <class Visit>
void forCells(const SplatVertex& vertex, int grid, const Visit& visit)
{
  const double cells = std::ldexp(1.0, -grid);
  const Cell low = cellOf(vertex.position, -vertex.tolerance, cells);
  const Cell high = cellOf(vertex.position, vertex.tolerance, cells);
  const auto cellsAlong = [&](std::size_t axis) { return high[axis] > low[axis] ? 2 : 1; };
  for (int x = 0; x < cellsAlong(0); ++x)
  {
    for (int y = 0; y < cellsAlong(1); ++y)
    {
      for (int z = 0; z < cellsAlong(2); ++z)
      {
        visit(Cell{ (x ? high : low)[0], (y ? high : low)[1], (z ? high : low)[2] });
      }
    }
  }
}

/// An entry for each vertex and each cell that contains it, in its own grid and in coarser ones,
/// sorted by cell. Coincident vertices share a cell of the own grid of at least one of them.
std::vector<Entry> verticesByCell(
  const Execution& execution, const std::vector<SplatVertex>& vertices)
{
  std::set<int> grids;
  forEachInOrder(execution, vertices.size(),
    [&](std::size_t i)
    {
      if (mayMeet(vertices[i]))
      {
        grids.insert(gridOf(vertices[i]));
      }
    });
  const std::vector<Entry> entries = collectedFromEach<Entry>(execution, vertices.size(),
    [&](std::size_t i, std::vector<Entry>& found)
    {
      const auto own = mayMeet(vertices[i]) ? grids.find(gridOf(vertices[i])) : grids.end();
      for (auto grid = own; grid != grids.end(); ++grid)
      {
        const std::uint64_t isFiner = grid == own ? 0 : 1;
        forCells(vertices[i], *grid,
          [&](const Cell& cell) { found.emplace_back(hashOfCell(*grid, cell) << 1 | isFiner, i); });
      }
    });
  return sortedUnique(execution, entries, std::uint64_t{ 1 } << 63, cellNumber);
}

} // namespace

std::vector<std::size_t> meetingVertices(
  const Execution& execution, const std::vector<SplatVertex>& vertices)
{
  std::vector<std::size_t> meetsAt = iota(vertices.size());
  const auto firstOf = [&meetsAt](std::size_t vertex)
  {
    while (meetsAt[vertex] != vertex)
    {
      vertex = meetsAt[vertex] = meetsAt[meetsAt[vertex]];
    }
    return vertex;
  };
  const std::vector<Entry> entries = verticesByCell(execution, vertices);
  std::size_t begin = 0; // of the entries with this own grid in the current cell
  std::size_t end = 0;
  for (std::size_t i = 0; i < entries.size(); ++i)
  {
    constexpr std::size_t batch = 1 << 14;
    if (i % batch == 0)
    {
      throwIfAborted(execution);
      execution.progress(static_cast<double>(i) / static_cast<double>(entries.size()));
    }
    const Entry& entry = entries[i];
    if (cellNumber(entries[begin]) != cellNumber(entry))
    {
      begin = end = i;
    }
    const Entry* const last = entries.data() + end;
    const Entry* const other = std::find_if(entries.data() + begin, last,
      [&](const Entry& earlier)
      { return coincide(vertices[earlier.second], vertices[entry.second]); });
    if (other != last)
    {
      const auto [first, second] = std::minmax({ firstOf(other->second), firstOf(entry.second) });
      meetsAt[second] = first;
    }
    end = isOfFinerGrid(entry) ? end : i + 1;
  }
  forEachInOrder(execution, meetsAt.size(),
    [&](std::size_t vertex)
    {
      meetsAt[vertex] = meetsAt[meetsAt[vertex]]; // has a lower number, so it is final
    });
  return meetsAt;
}

} // namespace isopoint
