// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Splat/NearestPositions.h"

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>
#include <boost/iterator/counting_iterator.hpp>

#include <algorithm>
#include <numeric>
#include <optional>

namespace isopoint
{
namespace
{

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;

/// CGAL's view of indices as points.
struct PointOfIndex
{
  using key_type = std::size_t;
  using value_type = Point;
  using reference = const Point&;
  using category = boost::lvalue_property_map_tag;

  const Point* points = nullptr;

  const Point& operator[](std::size_t index) const { return this->points[index]; }
  friend const Point& get(const PointOfIndex& map, std::size_t index) { return map[index]; }
};

using Traits =
  CGAL::Search_traits_adapter<std::size_t, PointOfIndex, CGAL::Search_traits_3<Kernel>>;
using KdSearch = CGAL::Orthogonal_k_neighbor_search<Traits>;

} // namespace

struct NearestPositions::Search
{
  std::vector<Point> distinct;
  std::vector<std::size_t> firstPoint; // for each distinct position, the first point at it
  std::vector<std::size_t> ofPoint;    // for each point its distinct position
  std::optional<KdSearch::Tree> tree;  // of the distinct positions; CGAL's takes no empty set

  explicit Search(const std::vector<Vector>& positions)
    : ofPoint(positions.size())
  {
    std::vector<std::size_t> order(positions.size());
    std::iota(order.begin(), order.end(), std::size_t{ 0 });
    std::sort(order.begin(), order.end(),
      [&](std::size_t a, std::size_t b)
      { return positions[a] != positions[b] ? positions[a] < positions[b] : a < b; });
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      const Vector& position = positions[order[i]];
      if (i == 0 || position != positions[order[i - 1]])
      {
        this->distinct.emplace_back(position[0], position[1], position[2]);
        this->firstPoint.push_back(order[i]);
      }
      this->ofPoint[order[i]] = this->distinct.size() - 1;
    }
    if (!this->distinct.empty())
    {
      const auto begin = boost::make_counting_iterator(std::size_t{ 0 });
      this->tree
        .emplace(begin, begin + static_cast<std::ptrdiff_t>(this->distinct.size()),
          KdSearch::Tree::Splitter(), Traits(PointOfIndex{ this->distinct.data() }))
        .build();
    }
  }
};

NearestPositions::NearestPositions(const std::vector<Vector>& positions)
  : Tree(std::make_unique<const Search>(positions))
{
}

NearestPositions::~NearestPositions() = default;

void NearestPositions::find(
  std::size_t point, std::size_t count, std::vector<std::size_t>& found) const
{
  const Search& known = *this->Tree;
  const std::size_t self = known.ofPoint[point];
  const KdSearch search(*known.tree, known.distinct[self], static_cast<unsigned>(count + 1), 0.0,
    true, KdSearch::Distance(PointOfIndex{ known.distinct.data() }));
  found.clear();
  for (const auto& [index, squaredDistance] : search)
  {
    if (index != self)
    {
      found.push_back(known.firstPoint[index]);
    }
  }
}

} // namespace isopoint
