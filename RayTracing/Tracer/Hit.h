// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef raytracing_Hit_h
#define raytracing_Hit_h

#include "Tracer/Surface.h"
#include "Tracer/Vector.h"

#include <limits>

namespace raytracing
{

/// Distance from the place that a ray departs from within which it meets nothing, for errors of
/// rounding; scenes are of unit size.
constexpr float nearestDistance = 1e-5f;

struct Ray
{
  Vector origin;
  Vector direction; // of unit length
  float nearest = 0.0f;
  float farthest = std::numeric_limits<float>::infinity();

  Vector at(float distance) const { return this->origin + distance * this->direction; }
};

/// Where a ray meets a surface.
struct Hit
{
  const Surface* surface = nullptr; // null: the ray meets none
  float distance = std::numeric_limits<float>::infinity();
  Vector normal; // of unit length, interpolated; to either side of the ray
  /// From the place to the smooth surface that the triangle with its normals stands for, on the
  /// ray's side: where shadow rays start.
  Vector lift;
  Color color;
  float opacity = 1.0f; // of the color, besides that of the material
};

} // namespace raytracing

#endif
