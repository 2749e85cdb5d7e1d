// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef Topology_h
#define Topology_h

#include "Core/Triangles/TriangleGeometry.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <ostream>
#include <set>
#include <utility>
#include <vector>

namespace topology
{

using Edge = std::pair<std::size_t, std::size_t>;

inline std::size_t rootOf(std::vector<std::size_t>& roots, std::size_t vertex)
{
  while (roots[vertex] != vertex)
  {
    vertex = roots[vertex] = roots[roots[vertex]];
  }
  return vertex;
}

/// The components that edges connect vertices to.
inline std::size_t componentsOf(const std::set<Edge>& edges)
{
  std::map<std::size_t, std::size_t> numbers;
  for (const auto& [a, b] : edges)
  {
    numbers.emplace(a, numbers.size());
    numbers.emplace(b, numbers.size());
  }
  std::vector<std::size_t> roots(numbers.size());
  std::iota(roots.begin(), roots.end(), std::size_t{ 0 });
  std::size_t count = roots.size();
  for (const auto& [a, b] : edges)
  {
    const std::size_t first = rootOf(roots, numbers[a]);
    const std::size_t second = rootOf(roots, numbers[b]);
    count -= first != second ? 1 : 0;
    roots[first] = second;
  }
  return count;
}

/// What stays of a surface, however its triangles are.
struct Topology
{
  long eulerCharacteristic = 0;
  std::size_t components = 0;
  std::size_t borders = 0; // components of the border
  bool isManifold = true;

  bool operator==(const Topology& other) const
  {
    return this->eulerCharacteristic == other.eulerCharacteristic &&
           this->components == other.components && this->borders == other.borders &&
           this->isManifold == other.isManifold;
  }
};

inline std::ostream& operator<<(std::ostream& out, const Topology& topology)
{
  return out << "Euler characteristic " << topology.eulerCharacteristic << ", components "
             << topology.components << ", borders " << topology.borders << ", manifold "
             << topology.isManifold;
}

inline Topology topologyOf(const std::vector<isopoint::SurfaceTriangle>& triangles)
{
  std::map<Edge, int> counts;
  std::map<std::size_t, std::set<Edge>> links; // edges opposite to each vertex
  for (const isopoint::SurfaceTriangle& triangle : triangles)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t next = triangle[(i + 1) % 3];
      ++counts[std::minmax(triangle[i], next)];
      links[triangle[i]].insert(std::minmax(next, triangle[(i + 2) % 3]));
    }
  }
  std::set<Edge> edges;
  std::set<Edge> border;
  Topology topology;
  for (const auto& [edge, count] : counts)
  {
    edges.insert(edge);
    if (count == 1)
    {
      border.insert(edge);
    }
    topology.isManifold = topology.isManifold && count <= 2;
  }
  for (const auto& [vertex, link] : links)
  {
    topology.isManifold = topology.isManifold && componentsOf(link) == 1;
  }
  topology.eulerCharacteristic = static_cast<long>(links.size()) - static_cast<long>(edges.size()) +
                                 static_cast<long>(triangles.size());
  topology.components = componentsOf(edges);
  topology.borders = componentsOf(border);
  return topology;
}

} // namespace topology

#endif
