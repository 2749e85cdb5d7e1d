// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/SplatMesh/MeetingVertices.h"
#include "Core/SplatMesh/SplatFan.h"

#include <array>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

namespace isopoint
{

/// The triangles of all splats, in the order of their points. Splats do not share vertices, but
/// vertices that coincide have exactly the same position.
struct SplatMesh
{
  std::vector<SplatVertex> vertices;
  std::vector<std::size_t> pointOfVertex;
  std::vector<std::array<std::size_t, 3>> triangles; // counterclockwise around their normals
  std::vector<std::size_t> meetsAt;                  // see meetingVertices()
  ItemLists meeting; // the vertices of each group, at its first vertex

  std::size_t pointOfTriangle(std::size_t triangle) const
  {
    return this->pointOfVertex[this->triangles[triangle][0]];
  }

  /// The first point whose splat has a vertex that coincides with this one.
  std::size_t firstPointAt(std::size_t vertex) const
  {
    return this->pointOfVertex[this->meetsAt[vertex]];
  }

  /// The mean of numbers over the points whose splats meet at a vertex, to double precision.
  /// @param numberOf(point)
  template <class NumberOf>
  double meanAt(std::size_t vertex, const NumberOf& numberOf) const
  {
    const IndexSpan<std::size_t> met = this->meeting.at(this->meetsAt[vertex]);
    if (met.count == 1)
    {
      return numberOf(this->pointOfVertex[vertex]);
    }
    double sum = 0.0;
    for (const std::size_t other : met)
    {
      sum += numberOf(this->pointOfVertex[other]);
    }
    return sum / static_cast<double>(met.count);
  }
};

/// @param fanAt(point) called from any thread, twice per point
/// @throws Aborted, std::bad_alloc, and what fanAt throws
/// Complexity: that of meetingVertices()
SplatMesh buildSplatMesh(const Execution& execution, std::size_t points,
  const std::function<SplatFan(std::size_t point)>& fanAt);

/// Averages values of points at the vertices, so that colors interpolate as on a mesh: meanAt().
/// @param components of each value
/// @param numberOf(point, component) called from any thread
/// @param means output: components of each vertex
/// @throws Aborted
template <class T, class NumberOf>
void meansAtVertices(const Execution& execution, const SplatMesh& mesh, std::size_t components,
  const NumberOf& numberOf, T* means)
{
  static_assert(std::is_floating_point<T>::value, "others have no mean");
  forEachIndex(execution, mesh.vertices.size(),
    [&](std::size_t vertex)
    {
      for (std::size_t i = 0; i < components; ++i)
      {
        means[components * vertex + i] = static_cast<T>(
          mesh.meanAt(vertex, [&](std::size_t point) { return numberOf(point, i); }));
      }
    });
}

} // namespace isopoint
