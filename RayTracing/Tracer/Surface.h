// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Tracer/Material.h"
#include "Tracer/Vector.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace raytracing
{

/// Red, green, blue and opacity, 0 to 255.
using ColorBytes = std::array<std::uint8_t, 4>;

inline Color colorOf(const ColorBytes& bytes)
{
  constexpr float unit = 1.0f / 255.0f;
  return { unit * static_cast<float>(bytes[0]), unit * static_cast<float>(bytes[1]),
    unit * static_cast<float>(bytes[2]) };
}

inline float opacityOf(const ColorBytes& bytes)
{
  return static_cast<float>(bytes[3]) / 255.0f;
}

/// Triangles with shared vertices.
struct Surface
{
  Material material;
  Color color{ 1.0f, 1.0f, 1.0f };
  /// -1 for a closed surface with inward normals, otherwise 1; see orientationOf().
  float outward = 1.0f;

  std::vector<Vector> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Vector> normals;    // of vertices; if empty, triangles are flat
  std::vector<ColorBytes> colors; // of vertices or triangles; if empty, the material's color
  bool colorsOfTriangles = false;
};

/// The orientation of a closed surface's normals, by the sign of its volume.
/// @returns 1 for outward normals and surfaces without volume, -1 for inward ones
float orientationOf(const Surface& surface);

} // namespace raytracing
