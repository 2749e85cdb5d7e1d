// SPDX-License-Identifier: GPL-3.0-or-later
#include "Tracer/Surfaces.h"

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

float orientationOf(const Splats& splats)
{
  // Relative to the mean, so that a surface that is not quite closed has the sign of its own shape.
  double mean[3] = { 0.0, 0.0, 0.0 };
  const auto count = static_cast<double>(splats.discs.size());
  for (const Disc& disc : splats.discs)
  {
    mean[0] += disc.center.x / count;
    mean[1] += disc.center.y / count;
    mean[2] += disc.center.z / count;
  }
  const Vector center{ static_cast<float>(mean[0]), static_cast<float>(mean[1]),
    static_cast<float>(mean[2]) };
  double volume = 0.0;
  for (std::size_t i = 0; i < splats.discs.size(); ++i)
  {
    const double radius = splats.discs[i].radius;
    volume += radius * radius * tripleProduct(splats.discs[i].center - center, splats.normal(i));
  }
  return volume < 0.0 ? -1.0f : 1.0f;
}

float orientationOf(const Triangles& triangles)
{
  // Normals of vertices decide, since they are what rays are refracted at.
  double volume = 0.0;
  for (const auto& triangle : triangles.triangles)
  {
    const Vector& a = triangles.vertices[triangle[0]];
    const Vector& b = triangles.vertices[triangle[1]];
    const Vector& c = triangles.vertices[triangle[2]];
    const Vector area = cross(b - a, c - a);
    const bool isTurned =
      !triangles.normals.empty() && dot(area, triangles.normals[triangle[0]]) < 0.0f;
    volume +=
      (isTurned ? -1.0 : 1.0) *
      tripleProduct((1.0f / 3.0f) * ((a - triangles.vertices[0]) + (b - triangles.vertices[0]) +
                                      (c - triangles.vertices[0])),
        area);
  }
  return volume < 0.0 ? -1.0f : 1.0f;
}

} // namespace raytracing
