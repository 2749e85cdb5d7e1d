// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef raytracing_EmbreeRay_h
#define raytracing_EmbreeRay_h

#include "Tracer/Embree.h"
#include "Tracer/Hit.h"
#include "Tracer/Surface.h"

#include <algorithm>

namespace raytracing::embree
{

/// The surfaces that a ray sees.
namespace masks
{
constexpr unsigned int opaque = 1; // no light passes
constexpr unsigned int transparent = 2;
constexpr unsigned int all = opaque | transparent;
} // namespace masks

inline unsigned int maskOf(const Surface& surface)
{
  const bool isOpaque = surface.material.transmission() <= 0.0f &&
                        std::all_of(surface.colors.begin(), surface.colors.end(),
                          [](const ColorBytes& c) { return c[3] == 255; });
  return surface.isVisible ? (isOpaque ? masks::opaque : masks::transparent) : 0;
}

inline RTCRay rayOf(const Ray& ray, unsigned int mask)
{
  RTCRay result{};
  result.org_x = ray.origin.x;
  result.org_y = ray.origin.y;
  result.org_z = ray.origin.z;
  result.tnear = ray.nearest;
  result.dir_x = ray.direction.x;
  result.dir_y = ray.direction.y;
  result.dir_z = ray.direction.z;
  result.tfar = ray.farthest;
  result.mask = mask;
  return result;
}

} // namespace raytracing::embree

#endif
