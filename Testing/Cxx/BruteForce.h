// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Clouds.h"

#include <iterator>

/// The canonical result, written down from docs/algorithm.md alone, independently of the core: the
/// whole tree by sorting, all pairs of cells, all angles. Quadratic. Sections are those of that
/// page; all arithmetic is in double, in the order in which section 1 and the formulas write it.
namespace bruteforce
{

/// An isopoint (section 7): its edge, whose end i has the lower id, and its parameter.
struct Isopoint
{
  std::uint64_t first;  // i
  std::uint64_t second; // j
  double parameter;     // t
};

using Vector = std::array<double, 3>;

/// Section 1.
inline double dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// |a| of section 1.
inline double lengthOf(const Vector& a)
{
  return std::sqrt(dot(a, a));
}

/// p_y - p_x, componentwise.
inline Vector difference(const Vector& y, const Vector& x)
{
  return { y[0] - x[0], y[1] - x[1], y[2] - x[2] };
}

/// Section 3: a closed axis-parallel box.
struct Region
{
  Vector lower;
  Vector upper;

  /// Becomes the bounding box of both.
  void add(const Region& other)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->lower[axis] = std::min(this->lower[axis], other.lower[axis]);
      this->upper[axis] = std::max(this->upper[axis], other.upper[axis]);
    }
  }
};

/// The region of a leaf (section 3), with the position, the value and the id of its sample or, of
/// its coincident samples, those of section 2.
struct Cell
{
  Region region;
  Vector position;
  std::uint64_t id;
  double value;
  std::vector<bool> path; // the turns down from the root: false to lower children
};

/// Section 2: the mean of coincident samples' values, given in ascending order of ids. A sample
/// that coincides with no other one keeps its value as it is.
inline double meanOf(const std::vector<double>& values)
{
  if (values.size() == 1)
  {
    return values[0];
  }
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  return std::clamp(sum / static_cast<double>(values.size()), *lowest, *highest);
}

/// Section 3, step 5: the plane between the coordinates of the last sample of the lower child and
/// of the first one of the upper child.
inline double planeBetween(double c, double d)
{
  const double plane = 0.5 * (c + d);
  return std::isfinite(plane) ? plane : 0.5 * c + 0.5 * d;
}

/// Section 2: the exponent of the power of two by which positions out of scale are divided, else 0.
inline int scaleExponentOf(const clouds::Cloud& cloud)
{
  double greatest = 0.0;
  std::vector<int> exponents;
  for (std::size_t id = 0; id < cloud.size(); ++id)
  {
    const Vector p = cloud.at(id);
    const double largest = std::max({ std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) });
    exponents.push_back(largest > 0.0 ? std::ilogb(largest) : 0);
    greatest = std::max(greatest, largest);
  }
  if (greatest == 0.0 || (greatest >= 0x1p-128 && greatest < 0x1p129))
  {
    return 0;
  }
  std::sort(exponents.begin(), exponents.end());
  const int median = exponents[exponents.size() / 2];
  return greatest > 1.0 ? std::max(median, 0) : median;
}

/// Section 2: positions divided by a power of two, if they are out of scale.
inline clouds::Cloud inScale(const clouds::Cloud& cloud)
{
  const int exponent = scaleExponentOf(cloud);
  return clouds::moved(cloud, [exponent](double* p)
    { std::for_each(p, p + 3, [=](double& c) { c = std::ldexp(c, -exponent); }); });
}

/// Section 3: the tree over all samples, coincident ones counted separately.
class Tree
{
public:
  /// The root has all samples and, as its region, their bounding box.
  explicit Tree(const clouds::Cloud& cloud)
    : Samples(cloud)
  {
    if (cloud.size() == 0)
    {
      return;
    }
    std::vector<std::size_t> ids;
    Region box{ cloud.at(0), cloud.at(0) };
    for (std::size_t id = 0; id < cloud.size(); ++id)
    {
      ids.push_back(id);
      box.add({ cloud.at(id), cloud.at(id) });
    }
    this->build(ids, box, {});
  }

  std::vector<Cell> cells; // of the leaves from left to right, the lower child before the upper one

private:
  /// Section 2: whether all three coordinates are equal; -0 and 0 are.
  bool coincide(std::size_t a, std::size_t b) const
  {
    return this->Samples.at(a) == this->Samples.at(b);
  }

  /// A node whose samples all coincide is a leaf; any other one is split.
  void build(std::vector<std::size_t> ids, const Region& region, const std::vector<bool>& path)
  {
    const auto coincidesWithFirst = [&](std::size_t id) { return this->coincide(id, ids[0]); };
    if (std::all_of(ids.begin(), ids.end(), coincidesWithFirst))
    {
      this->addCell(ids, region, path);
      return;
    }
    const std::size_t axis = longestSideOf(region);
    this->sortAlong(axis, ids);
    const std::size_t lowerCount = this->lowerCountOf(ids);
    const double plane = planeBetween(
      this->Samples.at(ids[lowerCount - 1])[axis], this->Samples.at(ids[lowerCount])[axis]);
    Region lower = region;
    lower.upper[axis] = plane;
    Region upper = region;
    upper.lower[axis] = plane;
    const auto firstOfUpper = ids.begin() + static_cast<std::ptrdiff_t>(lowerCount);
    std::vector<bool> longer = path;
    longer.push_back(false);
    this->build({ ids.begin(), firstOfUpper }, lower, longer);
    longer.back() = true;
    this->build({ firstOfUpper, ids.end() }, upper, longer);
  }

  /// Section 2: coincident samples have the lowest id among them, the coordinates of that sample
  /// and the mean of their values.
  void addCell(std::vector<std::size_t> ids, const Region& region, const std::vector<bool>& path)
  {
    std::sort(ids.begin(), ids.end());
    std::vector<double> values;
    for (const std::size_t id : ids)
    {
      values.push_back(this->Samples.values[id]);
    }
    this->cells.push_back({ region, this->Samples.at(ids[0]), ids[0], meanOf(values), path });
  }

  /// Step 1: the axis of the region's longest side, the lowest among equal ones.
  static std::size_t longestSideOf(const Region& region)
  {
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
    {
      if (region.upper[axis] - region.lower[axis] > region.upper[longest] - region.lower[longest])
      {
        longest = axis;
      }
    }
    return longest;
  }

  /// Step 2: by the coordinates on the axis a, (a + 1) mod 3 and (a + 2) mod 3, then by id.
  void sortAlong(std::size_t a, std::vector<std::size_t>& ids) const
  {
    const auto keyOf = [this, a](std::size_t id)
    {
      const Vector p = this->Samples.at(id);
      return std::make_tuple(p[a], p[(a + 1) % 3], p[(a + 2) % 3], id);
    };
    std::sort(ids.begin(), ids.end(),
      [&](std::size_t one, std::size_t other) { return keyOf(one) < keyOf(other); });
  }

  /// Steps 3 and 4: the first half goes to the lower child, and with it all samples that coincide
  /// with its last one; if that leaves the upper child empty, these go to the upper child instead.
  std::size_t lowerCountOf(const std::vector<std::size_t>& ids) const
  {
    std::size_t count = ids.size() / 2;
    while (count < ids.size() && this->coincide(ids[count - 1], ids[count]))
    {
      ++count;
    }
    if (count == ids.size())
    {
      while (this->coincide(ids[count - 1], ids.back()))
      {
        --count;
      }
    }
    return count;
  }

  const clouds::Cloud& Samples;
};

/// Section 4: whether the regions of two cells share a point.
template <class TRegion>
bool touch(const TRegion& c, const TRegion& other)
{
  bool touch = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    touch = touch && c.lower[axis] <= other.upper[axis] && other.lower[axis] <= c.upper[axis];
  }
  return touch;
}

/// Section 4: the neighborhood of each cell, as indices of all other cells that touch it.
inline std::vector<std::vector<std::size_t>> neighborhoods(const std::vector<Cell>& cells)
{
  std::vector<std::vector<std::size_t>> neighbors(cells.size());
  for (std::size_t a = 0; a < cells.size(); ++a)
  {
    for (std::size_t b = a + 1; b < cells.size(); ++b)
    {
      if (touch(cells[a].region, cells[b].region))
      {
        neighbors[a].push_back(b);
        neighbors[b].push_back(a);
      }
    }
  }
  return neighbors;
}

/// Section 5: whether the neighbor y of x survives at x. It is dropped if any other neighbor z,
/// itself dropped or not, is strictly closer and lies within the angle. At 0 nothing is dropped.
/// @param angle alpha, in degrees, 0 to 180
inline bool survives(const std::vector<Cell>& cells, const std::vector<std::size_t>& neighborsOfX,
  std::size_t x, std::size_t y, double angle)
{
  const double cosine = std::cos(angle * 3.14159265358979323846 / 180.0);
  const Vector u = difference(cells[y].position, cells[x].position);
  const auto drops = [&](std::size_t z)
  {
    const Vector w = difference(cells[z].position, cells[x].position);
    return dot(w, w) < dot(u, u) && dot(u, w) > cosine * (lengthOf(u) * lengthOf(w));
  };
  return angle == 0.0 || std::none_of(neighborsOfX.begin(), neighborsOfX.end(), drops);
}

/// Section 6: whether the end x of the edge {x, y} is dense. It is if among all samples,
/// coincident ones once, at least so many lie in the cone behind x, nearer than the edge's length
/// over the factor.
/// @param cosine of the cone: C, of 54.7356 degrees
inline bool isDense(const std::vector<Cell>& cells, std::size_t x, std::size_t y, double factor,
  std::ptrdiff_t wanted, double cosine = 1.0 / 1.7320508075688772)
{
  const Vector u = difference(cells[y].position, cells[x].position);
  const auto counts = [&](const Cell& z)
  {
    const Vector w = difference(z.position, cells[x].position);
    return factor * lengthOf(w) < lengthOf(u) && -dot(w, u) > cosine * (lengthOf(w) * lengthOf(u));
  };
  return std::count_if(cells.begin(), cells.end(), counts) >= wanted;
}

/// Section 6: the gap criterion drops an edge if both its ends are dense.
inline bool isDroppedByGap(const std::vector<Cell>& cells, std::size_t x, std::size_t y,
  double factor, std::ptrdiff_t wanted)
{
  return isDense(cells, x, y, factor, wanted) && isDense(cells, y, x, factor, wanted);
}

/// Section 6: the edges, pairs of cells, that are not in gaps. An edge is in a gap if it is over
/// the weak criterion and connected, by ends in common with others over it, with one over the
/// strong criterion.
inline std::set<std::pair<std::size_t, std::size_t>> withoutGaps(
  const std::vector<Cell>& cells, const std::set<std::pair<std::size_t, std::size_t>>& edges)
{
  std::set<std::pair<std::size_t, std::size_t>> kept;
  std::set<std::pair<std::size_t, std::size_t>> weak;
  std::set<std::size_t> ends; // of edges in gaps
  for (const auto& edge : edges)
  {
    const auto& [x, y] = edge;
    (isDroppedByGap(cells, x, y, 2.0, 2) ? weak : kept).insert(edge);
    if (isDroppedByGap(cells, x, y, 4.0, 3))
    {
      ends.insert({ x, y });
    }
  }
  for (std::size_t before = 0; before != ends.size();)
  {
    before = ends.size();
    for (const auto& [x, y] : weak)
    {
      if (ends.count(x) + ends.count(y) > 0)
      {
        ends.insert({ x, y });
      }
    }
  }
  std::copy_if(weak.begin(), weak.end(), std::inserter(kept, kept.end()),
    [&](const auto& edge) { return ends.count(edge.first) == 0; });
  return kept;
}

/// Section 7: the parameter of the isopoint on the edge from i, the end of the lower id, to j.
inline double parameterOf(const Cell& i, const Cell& j, double isovalue)
{
  return std::isfinite(j.value - i.value)
           ? (isovalue - i.value) / (j.value - i.value)
           : (0.5 * isovalue - 0.5 * i.value) / (0.5 * j.value - 0.5 * i.value);
}

/// Section 7: the isopoints of one isovalue, one on each edge, ordered by (i, j).
/// @param angle of section 5, in degrees, 0 to 180
/// @param dropsGaps whether edges in gaps are left out, section 6
inline std::vector<Isopoint> extract(
  const clouds::Cloud& cloud, double isovalue, double angle, bool dropsGaps = false)
{
  const Tree tree(inScale(cloud));
  const std::vector<Cell>& cells = tree.cells;
  const auto neighbors = neighborhoods(cells);
  const auto isBelow = [&](std::size_t cell) { return cells[cell].value < isovalue; };
  std::set<std::pair<std::size_t, std::size_t>> edges;
  for (std::size_t x = 0; x < cells.size(); ++x)
  {
    // An edge is kept if y survives at x or x at y: it is visited from both its ends.
    for (const std::size_t y : neighbors[x])
    {
      if (isBelow(x) != isBelow(y) && survives(cells, neighbors[x], x, y, angle))
      {
        edges.insert({ std::min(x, y), std::max(x, y) });
      }
    }
  }
  std::map<std::pair<std::uint64_t, std::uint64_t>, double> parameters;
  for (const auto& [x, y] : dropsGaps ? withoutGaps(cells, edges) : edges)
  {
    const Cell& i = cells[x].id < cells[y].id ? cells[x] : cells[y];
    const Cell& j = cells[x].id < cells[y].id ? cells[y] : cells[x];
    parameters[{ i.id, j.id }] = parameterOf(i, j, isovalue);
  }
  std::vector<Isopoint> isopoints;
  for (const auto& [edge, parameter] : parameters)
  {
    isopoints.push_back({ edge.first, edge.second, parameter });
  }
  return isopoints;
}

} // namespace bruteforce
