// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef raytracing_Surfaces_h
#define raytracing_Surfaces_h

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

/// A circle around a point.
struct Disc
{
  Vector center;
  float radius = 0.0f; // of an ellipse: of the smallest circle around it
};

/// The ellipse of a splat: vectors in its plane whose products with an offset from the center are
/// coordinates in half-axes, within the unit circle inside it.
struct Ellipse
{
  Vector first;
  Vector second;
};

/// The plane at which a splat ends.
struct Clip
{
  Vector normal;         // divided by the splat's radius; zeros: the splat is not clipped
  float distance = 0.0f; // of the center from the plane, in radii
  float turn = 1.0f;     // 1: the face across the crease is on the normal's side, -1: on the other
};

/// What all surfaces have.
struct Surface
{
  Material material;
  Color color{ 1.0f, 1.0f, 1.0f };
  bool isVisible = true;
  /// -1 where the normals of a closed surface point inwards, else 1; see orientationOf().
  float outward = 1.0f;
};

/// Overlapping splats that together are one surface. Arrays have one element for each splat, or are
/// empty where the comment says so.
struct Splats : Surface
{
  std::vector<Disc> discs;
  std::vector<Vector> planes;     // unit normals of the splats' planes
  std::vector<Vector> normals;    // unit normals to be blended; empty: those of the planes
  std::vector<Ellipse> ellipses;  // empty: the splats are discs
  std::vector<float> depths;      // within which others are blended behind each; empty: blendDepth
  std::vector<Clip> clips;        // empty: none is clipped
  std::vector<ColorBytes> colors; // empty: the surface's color
  float blendDepth = 1.0f;        // in radii of the discs

  const Vector& normal(std::size_t index) const
  {
    return this->normals.empty() ? this->planes[index] : this->normals[index];
  }
  float depth(std::size_t index) const
  {
    return this->blendDepth *
           (this->depths.empty() ? this->discs[index].radius : this->depths[index]);
  }
};

/// Triangles of shared vertices.
struct Triangles : Surface
{
  std::vector<Vector> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Vector> normals;    // of the vertices; empty: the triangles are flat
  std::vector<ColorBytes> colors; // of vertices or of triangles; empty: the surface's color
  bool colorsOfTriangles = false;
};

/// Which way the normals of a closed surface point: the sign of its volume.
/// @returns 1 for outwards and for surfaces without volume, -1 for inwards
float orientationOf(const Splats& splats);
float orientationOf(const Triangles& triangles);

} // namespace raytracing

#endif
