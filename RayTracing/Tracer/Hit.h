// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Tracer/Surface.h"
#include "Tracer/Vector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytracing
{

/// Rays meet nothing within this distance of their origin, because of rounding; scenes have size 1.
constexpr float nearestDistance = 1e-5f;

struct Ray
{
  Vector origin;
  Vector direction;
  float nearest = 0.0f;
  float farthest = std::numeric_limits<float>::infinity();

  Vector at(float distance) const { return this->origin + distance * this->direction; }
};

struct Hit
{
  const Surface* surface = nullptr; // null: the ray meets no surface
  float distance = std::numeric_limits<float>::infinity();
  Vector normal; // of unit length, interpolated; on either side of the ray
  /// Offset from the hit to the smooth surface on the ray's side, where shadow rays start.
  Vector lift;
  Color color;
  float opacity = 1.0f; // opacity of the color; multiplies that of the material
};

/// Whether a ray reaches its hit through the inside of a surface.
inline bool comesFromInside(const Hit& hit, const Vector& direction)
{
  return hit.surface->outward * dot(hit.normal, direction) > 0.0f;
}

/// The share of light per color that reaches the origin of a ray from its hit: all outside, and by
/// the law of Beer and Lambert inside a dielectric.
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
