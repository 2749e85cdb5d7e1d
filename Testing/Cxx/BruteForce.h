// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef BruteForce_h
#define BruteForce_h

#include "Clouds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <vector>

/// The definition of the canonical result, written down as plainly as possible and independently
/// of the core: the whole tree by sorting, all pairs of cells, all angles. Quadratic.
namespace bruteforce
{

struct Point
{
  std::uint64_t first;
  std::uint64_t second;
  double parameter;
};

struct Cell
{
  std::array<double, 3> lower;
  std::array<double, 3> upper;
  std::array<double, 3> position;
  std::uint64_t id;
  double value;
};

inline double halfway(double a, double b)
{
  return std::isfinite(a + b) ? 0.5 * (a + b) : 0.5 * a + 0.5 * b;
}

/// Where on the edge the isovalue lies; halves where the values' difference overflows.
inline double parameterOf(const Cell& i, const Cell& j, double isovalue)
{
  return std::isfinite(j.value - i.value)
           ? (isovalue - i.value) / (j.value - i.value)
           : (0.5 * isovalue - 0.5 * i.value) / (0.5 * j.value - 0.5 * i.value);
}

class Tree
{
public:
  explicit Tree(const clouds::Cloud& cloud)
    : Samples(cloud)
  {
    if (cloud.size() == 0)
    {
      return;
    }
    std::vector<std::size_t> ids(cloud.size());
    std::iota(ids.begin(), ids.end(), std::size_t{ 0 });
    Cell box;
    box.lower = box.upper = this->positionOf(0);
    for (const std::size_t id : ids)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        box.lower[axis] = std::min(box.lower[axis], this->positionOf(id)[axis]);
        box.upper[axis] = std::max(box.upper[axis], this->positionOf(id)[axis]);
      }
    }
    this->split(ids, box);
  }

  std::vector<Cell> cells;

private:
  std::array<double, 3> positionOf(std::size_t id) const
  {
    return { this->Samples.positions[3 * id], this->Samples.positions[3 * id + 1],
      this->Samples.positions[3 * id + 2] };
  }

  void addCell(std::vector<std::size_t> ids, Cell cell)
  {
    std::sort(ids.begin(), ids.end());
    cell.position = this->positionOf(ids[0]);
    cell.id = ids[0];
    double sum = 0.0;
    double minimum = this->Samples.values[ids[0]];
    double maximum = minimum;
    for (const std::size_t id : ids)
    {
      sum += this->Samples.values[id];
      minimum = std::min(minimum, this->Samples.values[id]);
      maximum = std::max(maximum, this->Samples.values[id]);
    }
    cell.value = ids.size() == 1
                   ? minimum
                   : std::clamp(sum / static_cast<double>(ids.size()), minimum, maximum);
    this->cells.push_back(cell);
  }

  void split(std::vector<std::size_t> ids, const Cell& region)
  {
    const auto samePosition = [&](std::size_t a, std::size_t b)
    { return this->positionOf(a) == this->positionOf(b); };
    if (std::all_of(
          ids.begin(), ids.end(), [&](std::size_t id) { return samePosition(id, ids[0]); }))
    {
      this->addCell(ids, region);
      return;
    }
    int axis = 0;
    for (int other = 1; other < 3; ++other)
    {
      if (region.upper[other] - region.lower[other] > region.upper[axis] - region.lower[axis])
      {
        axis = other;
      }
    }
    std::sort(ids.begin(), ids.end(),
      [&](std::size_t a, std::size_t b)
      {
        const auto p = this->positionOf(a);
        const auto q = this->positionOf(b);
        return std::make_tuple(p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3], a) <
               std::make_tuple(q[axis], q[(axis + 1) % 3], q[(axis + 2) % 3], b);
      });
    std::size_t middle = ids.size() / 2;
    while (middle < ids.size() && samePosition(ids[middle - 1], ids[middle]))
    {
      ++middle;
    }
    if (middle == ids.size())
    {
      while (samePosition(ids[middle - 1], ids.back()))
      {
        --middle;
      }
    }
    const double plane =
      halfway(this->positionOf(ids[middle - 1])[axis], this->positionOf(ids[middle])[axis]);
    Cell lower = region;
    lower.upper[axis] = plane;
    Cell upper = region;
    upper.lower[axis] = plane;
    const auto cut = ids.begin() + static_cast<std::ptrdiff_t>(middle);
    this->split({ ids.begin(), cut }, lower);
    this->split({ cut, ids.end() }, upper);
  }

  const clouds::Cloud& Samples;
};

inline bool touch(const Cell& a, const Cell& b)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (a.lower[axis] > b.upper[axis] || b.lower[axis] > a.upper[axis])
    {
      return false;
    }
  }
  return true;
}

/// All neighbourhoods: for each cell the indices of those that touch it.
inline std::vector<std::vector<std::size_t>> neighborhoods(const std::vector<Cell>& cells)
{
  std::vector<std::vector<std::size_t>> neighbors(cells.size());
  for (std::size_t a = 0; a < cells.size(); ++a)
  {
    for (std::size_t b = a + 1; b < cells.size(); ++b)
    {
      if (touch(cells[a], cells[b]))
      {
        neighbors[a].push_back(b);
        neighbors[b].push_back(a);
      }
    }
  }
  return neighbors;
}

inline double product(const Cell& from, const Cell& a, const Cell& b)
{
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    sum += (a.position[axis] - from.position[axis]) * (b.position[axis] - from.position[axis]);
  }
  return sum;
}

inline bool survives(const std::vector<Cell>& cells, const std::vector<std::size_t>& neighbors,
  std::size_t x, std::size_t y, double angle)
{
  const double cosine = std::cos(angle * 3.14159265358979323846 / 180.0);
  const double yy = product(cells[x], cells[y], cells[y]);
  return std::none_of(neighbors.begin(), neighbors.end(),
    [&](std::size_t z)
    {
      const double zz = product(cells[x], cells[z], cells[z]);
      return angle > 0.0 && zz < yy &&
             product(cells[x], cells[y], cells[z]) > cosine * (std::sqrt(yy) * std::sqrt(zz));
    });
}

/// The distance from the end x of an edge {x, y} to the 2nd nearest cell's position in the cone of
/// 54.7356 degrees behind it, infinite where there are fewer.
inline double spacingBehind(const std::vector<Cell>& cells, std::size_t x, std::size_t y)
{
  const double cosine = 1.0 / std::sqrt(3.0);
  const double length = std::sqrt(product(cells[x], cells[y], cells[y]));
  std::vector<double> distances(2, std::numeric_limits<double>::infinity());
  for (const Cell& z : cells)
  {
    const double distance = std::sqrt(product(cells[x], z, z));
    if (-product(cells[x], z, cells[y]) > cosine * (distance * length))
    {
      distances.push_back(distance);
    }
  }
  std::sort(distances.begin(), distances.end());
  return distances[1];
}

inline bool spansGap(const std::vector<Cell>& cells, std::size_t x, std::size_t y, double gapFactor)
{
  return gapFactor > 0.0 &&
         std::sqrt(product(cells[x], cells[y], cells[y])) >
           gapFactor * std::max(spacingBehind(cells, x, y), spacingBehind(cells, y, x));
}

/// @param gapFactor 0, or how many times the larger spacing behind its ends an edge may be long
inline std::vector<Point> extract(
  const clouds::Cloud& cloud, double isovalue, double angle, double gapFactor = 0.0)
{
  const Tree tree(cloud);
  const std::vector<Cell>& cells = tree.cells;
  const auto neighbors = neighborhoods(cells);
  std::map<std::pair<std::uint64_t, std::uint64_t>, double> points;
  for (std::size_t x = 0; x < cells.size(); ++x)
  {
    for (const std::size_t y : neighbors[x])
    {
      if ((cells[x].value < isovalue) != (cells[y].value < isovalue) &&
          survives(cells, neighbors[x], x, y, angle) && !spansGap(cells, x, y, gapFactor))
      {
        const Cell& i = cells[x].id < cells[y].id ? cells[x] : cells[y];
        const Cell& j = cells[x].id < cells[y].id ? cells[y] : cells[x];
        points[{ i.id, j.id }] = parameterOf(i, j, isovalue);
      }
    }
  }
  std::vector<Point> result;
  for (const auto& [edge, parameter] : points)
  {
    result.push_back({ edge.first, edge.second, parameter });
  }
  return result;
}

} // namespace bruteforce

#endif
