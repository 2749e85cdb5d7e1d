// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef raytracing_Hit_h
#define raytracing_Hit_h

#include "Tracer/Surfaces.h"
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
  Vector normal; // of unit length, blended or interpolated; to either side of the ray
  Color color;
  float opacity = 1.0f; // of the color, besides that of the material
  float radius = 0.0f;  // of the splats that are met, 0 of triangles
};

/**
 * Where a ray departs from a surface of splats. Planes of splats around the point may stand out of
 * the surface: the ray ignores them as far as they belong to the sheet that it departs from.
 */
struct Departure
{
  const Surface* surface = nullptr;
  Vector normal;
  float radius = 0.0f;

  Departure() = default;
  explicit Departure(const Hit& hit)
    : surface(hit.surface)
    , normal(hit.normal)
    , radius(hit.radius)
  {
  }

  /// Whether a ray of this direction ignores a splat of the same surface with this normal.
  bool ignores(const Vector& direction, float distance, const Vector& splatNormal) const
  {
    constexpr float sameSheet = 0.7f; // cosine between normals
    constexpr float sameSide = 4.0f;  // radii within which a splat is not passed from behind
    return dot(splatNormal, this->normal) > sameSheet &&
           (distance < this->radius ||
             (distance < sameSide * this->radius &&
               dot(direction, splatNormal) * dot(direction, this->normal) > 0.0f));
  }
};

} // namespace raytracing

#endif
