// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Clouds.h"

#include "Core/Triangles/TriangleGeometry.h"

#include <ostream>

/// Shared by the tests of triangles.
namespace topology
{

using isopoint::Vector;
using Triangles = std::vector<isopoint::SurfaceTriangle>;
using Edge = std::pair<std::size_t, std::size_t>;

/// The root of a vertex's tree, of those that unite vertices.
/// @tparam TRoots a list or map
template <class TRoots>
std::size_t rootOf(TRoots& roots, std::size_t vertex)
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
  std::map<std::size_t, std::size_t> roots;
  std::size_t united = 0;
  for (const auto& [a, b] : edges)
  {
    roots.emplace(a, a);
    roots.emplace(b, b);
    const std::size_t first = rootOf(roots, a);
    const std::size_t second = rootOf(roots, b);
    united += first != second ? 1 : 0;
    roots[first] = second;
  }
  return roots.size() - united;
}

/// How many triangles each edge has.
inline std::map<Edge, int> edgesOf(const Triangles& triangles)
{
  std::map<Edge, int> edges;
  for (const auto& [a, b, c] : triangles)
  {
    ++edges[std::minmax(a, b)];
    ++edges[std::minmax(b, c)];
    ++edges[std::minmax(c, a)];
  }
  return edges;
}

/// What regularization keeps of a surface.
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

inline Topology topologyOf(const Triangles& triangles)
{
  std::map<std::size_t, std::set<Edge>> links; // edges opposite to each vertex
  for (const auto& [a, b, c] : triangles)
  {
    links[a].insert(std::minmax(b, c));
    links[b].insert(std::minmax(c, a));
    links[c].insert(std::minmax(a, b));
  }
  std::set<Edge> edges;
  std::set<Edge> border;
  Topology topology;
  for (const auto& [edge, count] : edgesOf(triangles))
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

/// Of a length that is twice the triangle's area.
inline Vector normalOf(const std::vector<Vector>& p, const isopoint::SurfaceTriangle& triangle)
{
  const auto& [a, b, c] = triangle;
  return isopoint::cross(p[b] - p[a], p[c] - p[a]);
}

/// Of radius 0.35, in the middle of the unit cube.
inline double distanceFromSphere(const Vector& p)
{
  return clouds::fromMiddle(p) - 0.35;
}

} // namespace topology
