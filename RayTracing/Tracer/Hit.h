// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef raytracing_Hit_h
#define raytracing_Hit_h

#include "Tracer/Surface.h"
#include "Tracer/Vector.h"

#include <algorithm>
#include <cmath>
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

/// Whether a ray that meets a surface has come through its inside.
inline bool comesFromInside(const Hit& hit, const Vector& direction)
{
  return hit.surface->outward * dot(hit.normal, direction) > 0.0f;
}

/// The share of light in each color that is left at the end of a ray that meets a surface: all of
/// it outside, and what Beer and Lambert's law leaves inside a dielectric.
inline Color absorption(const Hit& hit, const Vector& direction)
{
  const Material& material = hit.surface->material;
  if (!material.isPhysical || material.transmission() <= 0.0f || !comesFromInside(hit, direction))
  {
    return { 1.0f, 1.0f, 1.0f };
  }
  const float distances = hit.distance / material.absorptionDistance;
  const auto left = [distances](float color)
  { return std::pow(std::clamp(color, 1e-4f, 1.0f), distances); };
  return { left(hit.color.x), left(hit.color.y), left(hit.color.z) };
}

} // namespace raytracing

#endif
