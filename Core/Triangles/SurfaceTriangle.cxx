// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/SurfaceTriangle.h"

#include "Core/Base/Lists.h"
#include "Core/Base/Sorting.h"

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace isopoint
{

std::vector<std::size_t> verticesOf(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, std::size_t vertexCount)
{
  return markedOf(execution, areVerticesOf(execution, triangles, vertexCount));
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
  std::vector<std::atomic<bool>> marks(vertexCount);
  forEachIndex(execution, triangles.size(),
    [&](std::size_t i)
    {
      for (const std::size_t vertex : triangles[i])
      {
        marks[vertex].store(true, std::memory_order_relaxed);
      }
    });
  return { marks.begin(), marks.end() };
}

std::vector<char> areAmong(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<SurfaceTriangle>& some)
{
  return tabulated<char>(execution, triangles.size(),
    [&](std::size_t i) { return std::binary_search(some.begin(), some.end(), triangles[i]); });
}

std::vector<SurfaceTriangle> renumbered(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<std::size_t>& numbers,
  std::size_t count)
{
  return ordered(execution,
    collectedFromEach<SurfaceTriangle>(execution, triangles.size(),
      [&](std::size_t i, std::vector<SurfaceTriangle>& found)
      {
        const std::size_t a = numbers[triangles[i][0]];
        const std::size_t b = numbers[triangles[i][1]];
        const std::size_t c = numbers[triangles[i][2]];
        if (a != b && b != c && c != a)
        {
          found.push_back({ a, b, c });
        }
      }),
    count);
}

} // namespace isopoint
