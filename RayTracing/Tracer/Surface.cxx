// SPDX-License-Identifier: GPL-3.0-or-later
#include "Tracer/Surface.h"

namespace raytracing
{

namespace
{

double tripleProduct(const Vector& a, const Vector& b)
{
  return static_cast<double>(a.x) * b.x + static_cast<double>(a.y) * b.y +
         static_cast<double>(a.z) * b.z;
}

} // namespace

float orientationOf(const Surface& surface)
{
  // Vertex normals decide, because they determine refraction.
  double volume = 0.0;
  for (const auto& triangle : surface.triangles)
  {
    const Vector& a = surface.vertices[triangle[0]];
    const Vector& b = surface.vertices[triangle[1]];
    const Vector& c = surface.vertices[triangle[2]];
    const Vector area = cross(b - a, c - a);
    const bool isTurned =
      !surface.normals.empty() && dot(area, surface.normals[triangle[0]]) < 0.0f;
    volume += (isTurned ? -1.0 : 1.0) *
              tripleProduct((1.0f / 3.0f) * ((a - surface.vertices[0]) + (b - surface.vertices[0]) +
                                              (c - surface.vertices[0])),
                area);
  }
  return volume < 0.0 ? -1.0f : 1.0f;
}

} // namespace raytracing
