// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/SurfaceTriangle.h"

#include "Core/Base/Lists.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <utility>

namespace isopoint
{

namespace
{

std::vector<std::atomic<bool>> marksOfVertices(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, std::size_t vertexCount)
{
  std::vector<std::atomic<bool>> marks(vertexCount);
  forEachIndex(execution, triangles.size(),
    [&](std::size_t i)
    {
      for (const std::size_t vertex : triangles[i])
      {
        marks[vertex].store(true, std::memory_order_relaxed);
      }
    });
  return marks;
}

} // namespace

std::vector<std::size_t> verticesOf(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, std::size_t vertexCount)
{
  return markedOf(execution, marksOfVertices(execution, triangles, vertexCount));
}

std::vector<SurfaceTriangle> ordered(
  const Execution& execution, std::vector<SurfaceTriangle> triangles, std::size_t vertexCount)
{
  forEachIndex(execution, triangles.size(),
    [&triangles](std::size_t i)
    {
      SurfaceTriangle& corners = triangles[i];
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    });
  return sortedUnique(execution, triangles, vertexCount,
    [](const SurfaceTriangle& triangle) { return static_cast<std::uint64_t>(triangle[0]); });
}

std::vector<char> areVerticesOf(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, std::size_t vertexCount)
{
  const std::vector<std::atomic<bool>> marks = marksOfVertices(execution, triangles, vertexCount);
  return { marks.begin(), marks.end() };
}

std::vector<char> areAmong(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<SurfaceTriangle>& some)
{
  std::vector<char> marks(triangles.size(), 0);
  forEachIndex(execution, marks.size(),
    [&](std::size_t i)
    { marks[i] = std::binary_search(some.begin(), some.end(), triangles[i]) ? 1 : 0; });
  return marks;
}

std::vector<SurfaceTriangle> renumbered(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<std::size_t>& order,
  std::size_t vertexCount)
{
  if (triangles.empty())
  {
    return {};
  }
  std::vector<std::size_t> number(vertexCount);
  forEachIndex(execution, order.size(), [&](std::size_t place) { number[order[place]] = place; });
  std::vector<SurfaceTriangle> result(triangles.size());
  forEachIndex(execution, triangles.size(),
    [&](std::size_t i)
    {
      const auto& [a, b, c] = triangles[i];
      result[i] = { number[a], number[b], number[c] };
    });
  return ordered(execution, std::move(result), order.size());
}

} // namespace isopoint
