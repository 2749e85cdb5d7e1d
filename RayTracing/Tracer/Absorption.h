// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef raytracing_Absorption_h
#define raytracing_Absorption_h

#include "Tracer/Hit.h"

#include <algorithm>
#include <cmath>

namespace raytracing
{

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
