// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatMesh.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <set>
#include <utility>

namespace
{

std::size_t indexOf(vtkIdType id)
{
  return static_cast<std::size_t>(id);
}

/// Calls of(i) for i from 0 to count - 1, on several threads.
template <class Function>
void forIndices(std::size_t count, const Function& of)
{
  vtkSMPTools::For(0, static_cast<vtkIdType>(count),
    [&of](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        of(indexOf(i));
      }
    });
}

/// The same in batches.
/// @param step called after each batch with the share of them that is done; false: no more batches
/// @returns whether all batches were done
template <class Function>
bool forBatches(vtkIdType count, const vtkIsopointStep& step, const Function& of)
{
  constexpr vtkIdType batch = 1 << 17;
  for (vtkIdType done = 0; done < count;)
  {
    const vtkIdType next = std::min(done + batch, count);
    forIndices(
      indexOf(next - done), [&of, done](std::size_t i) { of(done + static_cast<vtkIdType>(i)); });
    done = next;
    if (!step(static_cast<double>(done) / static_cast<double>(count)))
    {
      return false;
    }
  }
  return true;
}

/// Whether two corners are one, up to rounding: along each axis they are no farther apart than both
/// of their tolerances, and their normals differ by less than 0.06 degrees.
bool areOne(const vtkIsopointCorner& a, const vtkIsopointCorner& b)
{
  constexpr float turn = 1e-3f;
  const double tolerance = std::min(a.Tolerance, b.Tolerance);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (std::abs(a.Place[axis] - b.Place[axis]) > tolerance ||
        std::abs(a.Normal[axis] - b.Normal[axis]) > turn)
    {
      return false;
    }
  }
  return true;
}

/// Whole numbers, which may be beyond those of integer types.
using Cell = std::array<double, 3>;

/// The cell of a grid that a place, moved by an offset along all axes, is in.
/// @param cells how many there are per unit of length
Cell cellOf(const vtkVector3d& place, double offset, double cells)
{
  Cell cell;
  for (int axis = 0; axis < 3; ++axis)
  {
    cell[indexOf(axis)] = std::floor((place[axis] + offset) * cells) + 0.0; // -0 becomes 0
  }
  return cell;
}

std::uint64_t hashOf(int grid, const Cell& cell)
{
  constexpr std::uint64_t factor = 0x9E3779B97F4A7C15u;
  auto hash = static_cast<std::uint64_t>(grid);
  for (const double number : cell)
  {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof(bits));
    hash = (hash ^ bits) * factor;
    hash ^= hash >> 32;
  }
  return hash;
}

/// Whether a corner may be one with others.
bool mayMeet(const vtkIsopointCorner& corner)
{
  return corner.Tolerance > 0.0f && std::isfinite(corner.Tolerance);
}

/// The grid of a corner, by the binary logarithm of its spacing: at least four times the corner's
/// tolerance, and still small against a splat. There are few grids, since their spacings differ by
/// a factor of 16 or more.
int gridOf(const vtkIsopointCorner& corner)
{
  constexpr int powers = 4;
  const double power = std::floor(std::ilogb(corner.Tolerance) / static_cast<double>(powers));
  return powers * (static_cast<int>(power) + 1) + 2;
}

/// A corner in a cell of its own grid or of a coarser one.
struct Entry
{
  std::uint64_t Cell; // a hash
  std::size_t Corner;

  /// The corners of the cell's own grid come first.
  bool operator<(const Entry& other) const
  {
    return this->Cell != other.Cell ? this->Cell < other.Cell : this->Corner < other.Corner;
  }
};

/// Entries of finer grids have odd hashes, one more than others in the same cell.
bool isOfFinerGrid(const Entry& entry)
{
  return (entry.Cell & 1) != 0;
}

bool areInOneCell(const Entry& a, const Entry& b)
{
  return a.Cell >> 1 == b.Cell >> 1;
}

/// Calls visit(cell) for the cells of a grid that a corner is in, up to its tolerance.
template <class Visit>
void forCells(const vtkIsopointCorner& corner, int grid, const Visit& visit)
{
  const double cells = std::ldexp(1.0, -grid);
  const Cell low = cellOf(corner.Place, -corner.Tolerance, cells);
  const Cell high = cellOf(corner.Place, corner.Tolerance, cells);
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

/// All corners in all cells that they are in, of their own grids and of coarser ones, sorted by
/// cell. Corners that are one have a cell in common, in the own grid of at least one of them.
std::vector<Entry> cornersByCell(const std::vector<vtkIsopointCorner>& corners)
{
  std::set<int> grids;
  for (const vtkIsopointCorner& corner : corners)
  {
    if (mayMeet(corner))
    {
      grids.insert(gridOf(corner));
    }
  }
  // Calls visit(cell) for the cells of a corner, as entries have them.
  const auto forCellsOf = [&](const vtkIsopointCorner& corner, const auto& visit)
  {
    const auto own = mayMeet(corner) ? grids.find(gridOf(corner)) : grids.end();
    for (auto grid = own; grid != grids.end(); ++grid)
    {
      const std::uint64_t isFiner = grid == own ? 0 : 1;
      forCells(corner, *grid, [&](const Cell& cell) { visit(hashOf(*grid, cell) << 1 | isFiner); });
    }
  };
  // Threads of VTK must not throw. They count first, and then fill the allocated memory.
  std::vector<std::size_t> begins(corners.size() + 1, 0);
  forIndices(corners.size(),
    [&](std::size_t i) { forCellsOf(corners[i], [&](std::uint64_t) { ++begins[i + 1]; }); });
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  std::vector<Entry> entries(begins.back());
  forIndices(corners.size(),
    [&](std::size_t i)
    {
      auto next = entries.begin() + static_cast<std::ptrdiff_t>(begins[i]);
      forCellsOf(corners[i], [&](std::uint64_t cell) { *next++ = { cell, i }; });
    });
  vtkSMPTools::Sort(entries.begin(), entries.end());
  return entries;
}

/// Which corners are one, directly or through others. O(n log n), unless tolerances are large
/// against the distances between corners that are not one.
/// @returns for each corner the first one of its group, perhaps itself; nothing if `step` ended the
/// search
std::vector<vtkIdType> meetingCorners(
  const std::vector<vtkIsopointCorner>& corners, const vtkIsopointStep& step)
{
  std::vector<vtkIdType> meetsAt(corners.size());
  std::iota(meetsAt.begin(), meetsAt.end(), 0);
  const auto firstOf = [&meetsAt](std::size_t i)
  {
    auto corner = static_cast<vtkIdType>(i);
    while (meetsAt[indexOf(corner)] != corner)
    {
      corner = meetsAt[indexOf(corner)] = meetsAt[indexOf(meetsAt[indexOf(corner)])];
    }
    return corner;
  };
  const std::vector<Entry> entries = cornersByCell(corners);
  auto begin = entries.begin(); // of the corners in a cell of their own grid
  auto end = begin;
  for (auto entry = begin; entry != entries.end(); ++entry)
  {
    constexpr std::ptrdiff_t batch = 1 << 17;
    const std::ptrdiff_t done = entry - entries.begin();
    if (done % batch == 0 && !step(static_cast<double>(done) / static_cast<double>(entries.size())))
    {
      return {};
    }
    if (!areInOneCell(*begin, *entry))
    {
      begin = end = entry;
    }
    const auto other = std::find_if(begin, end,
      [&](const Entry& earlier)
      { return areOne(corners[earlier.Corner], corners[entry->Corner]); });
    if (other != end)
    {
      const auto [first, second] = std::minmax({ firstOf(other->Corner), firstOf(entry->Corner) });
      meetsAt[indexOf(second)] = first;
    }
    end = isOfFinerGrid(*entry) ? end : entry + 1;
  }
  for (vtkIdType& corner : meetsAt)
  {
    corner = meetsAt[indexOf(corner)]; // of a lower number, which is done
  }
  return meetsAt;
}

} // namespace

//------------------------------------------------------------------------------
bool vtkIsopointSplatMesh::Build(
  const vtkIsopointSplatShapes& shapes, vtkIdType points, const vtkIsopointStep& step)
{
  this->FirstVertices.assign(indexOf(points) + 1, 0);
  this->FirstTriangles.assign(indexOf(points) + 1, 0);
  constexpr double third = 1.0 / 3.0;
  const auto stepOf = [&step](double done)
  { return [&step, done](double share) { return step(third * (done + share)); }; };
  const bool isCounted = forBatches(points, stepOf(0.0),
    [&](vtkIdType point)
    {
      const vtkIsopointSplatFan fan = shapes.Fan(point);
      this->FirstVertices[indexOf(point) + 1] = fan.Vertices;
      this->FirstTriangles[indexOf(point) + 1] = fan.Triangles;
    });
  if (!isCounted)
  {
    return false;
  }
  std::partial_sum(
    this->FirstVertices.begin(), this->FirstVertices.end(), this->FirstVertices.begin());
  std::partial_sum(
    this->FirstTriangles.begin(), this->FirstTriangles.end(), this->FirstTriangles.begin());

  this->Vertices.resize(indexOf(this->NumberOfVertices()));
  this->Corners.resize(indexOf(3 * this->NumberOfTriangles()));
  std::vector<vtkIdType> pointOfVertex(this->Vertices.size());
  const bool isFilled = forBatches(points, stepOf(1.0),
    [&](vtkIdType point)
    {
      const vtkIsopointSplatFan fan = shapes.Fan(point);
      const vtkIdType first = this->FirstVertices[indexOf(point)];
      for (int i = 0; i < fan.Vertices; ++i)
      {
        const vtkVector3d& normal = fan.Normals[indexOf(i)];
        this->Vertices[indexOf(first + i)] = { fan.Places[indexOf(i)],
          { static_cast<float>(normal[0]), static_cast<float>(normal[1]),
            static_cast<float>(normal[2]) },
          fan.Tolerance };
        pointOfVertex[indexOf(first + i)] = point;
      }
      for (int i = 0; i < fan.Triangles; ++i)
      {
        std::array<int, 3> corners;
        for (int k = 0; k < 3; ++k)
        {
          corners[indexOf(k)] = vtkIsopointSplatCorner(fan, i, k);
        }
        // Where two corners of a splat have passed each other, it would face away and be dark.
        const vtkVector3d& a = fan.Places[indexOf(corners[0])];
        const vtkVector3d side = fan.Places[indexOf(corners[1])] - a;
        const vtkVector3d other = fan.Places[indexOf(corners[2])] - a;
        if (side.Cross(other).Dot(fan.Normals[indexOf(corners[0])]) < 0.0)
        {
          std::swap(corners[1], corners[2]);
        }
        for (int k = 0; k < 3; ++k)
        {
          this->Corners[indexOf(3 * (this->FirstTriangles[indexOf(point)] + i) + k)] =
            first + corners[indexOf(k)];
        }
      }
    });

  if (!isFilled)
  {
    return false;
  }

  // A counting sort of points by the place of their vertices.
  this->MeetsAt = meetingCorners(this->Vertices, stepOf(2.0));
  if (this->MeetsAt.size() < this->Vertices.size())
  {
    return false;
  }
  this->FirstMeeting.assign(this->MeetsAt.size() + 1, 0);
  for (const vtkIdType vertex : this->MeetsAt)
  {
    ++this->FirstMeeting[indexOf(vertex) + 1];
  }
  std::partial_sum(
    this->FirstMeeting.begin(), this->FirstMeeting.end(), this->FirstMeeting.begin());
  this->MeetingPoints.resize(this->MeetsAt.size());
  std::vector<vtkIdType> next(this->FirstMeeting.begin(), this->FirstMeeting.end() - 1);
  for (std::size_t i = 0; i < this->MeetsAt.size(); ++i)
  {
    this->MeetingPoints[indexOf(next[indexOf(this->MeetsAt[i])]++)] = pointOfVertex[i];
  }
  return true;
}
