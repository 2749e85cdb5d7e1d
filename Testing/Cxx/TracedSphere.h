// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TracedSphere_h
#define TracedSphere_h

#include "Tracer/Surface.h"

#include <cmath>
#include <cstdint>
#include <memory>

/// The triangles of a sphere around the origin, with its normals: rows from pole to pole of twice
/// as many columns.
inline std::shared_ptr<raytracing::Surface> tracedSphere(std::uint32_t rows, float radius)
{
  auto sphere = std::make_shared<raytracing::Surface>();
  const std::uint32_t columns = 2 * rows;
  for (std::uint32_t row = 0; row <= rows; ++row)
  {
    for (std::uint32_t column = 0; column < columns; ++column)
    {
      const float height = 3.14159265f * static_cast<float>(row) / static_cast<float>(rows);
      const float turn = 6.2831853f * static_cast<float>(column) / static_cast<float>(columns);
      const raytracing::Vector normal{ std::sin(height) * std::cos(turn),
        std::sin(height) * std::sin(turn), std::cos(height) };
      sphere->normals.push_back(normal);
      sphere->vertices.push_back(radius * normal);
      if (row < rows)
      {
        const std::uint32_t first = row * columns;
        const std::uint32_t next = (column + 1) % columns;
        const std::uint32_t below = first + columns;
        sphere->triangles.push_back({ first + column, below + column, below + next });
        sphere->triangles.push_back({ first + column, below + next, first + next });
      }
    }
  }
  return sphere;
}

#endif
