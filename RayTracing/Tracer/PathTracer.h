// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef raytracing_PathTracer_h
#define raytracing_PathTracer_h

#include "Tracer/Lighting.h"
#include "Tracer/Sampler.h"
#include "Tracer/Scene.h"

#include <cstdint>
#include <vector>

namespace raytracing
{

/// Everything around the surfaces that decides a picture's colors.
struct Illuminants
{
  std::vector<Light> lights;
  Environment environment;
  AmbientLight ambient;
  bool hasShadows = true;
  int mostBounces = 8; // reflections and refractions of a path
};

/// Light that arrives along a ray.
struct Radiance
{
  Color color;        // of the surfaces, times their coverage
  float alpha = 1.0f; // coverage: what is left shows the background
};

/**
 * Light along rays [Whi80]: direct light with shadows, ambient light, reflections and refractions.
 * Matte surfaces do not light each other.
 */
class PathTracer
{
public:
  PathTracer(const Scene& scene, const Illuminants& illuminants)
    : Surfaces(scene)
    , Light(illuminants)
  {
  }

  /// Light along a ray from the camera; from any thread.
  Radiance along(const Ray& ray, const Sampler& sampler) const;

private:
  struct Path;
  struct Shading;

  Radiance follow(const Path& path) const;
  Radiance shade(const Path& path, const Hit& hit) const;
  Color shadePhong(const Shading& shading) const;
  Color shadePhysical(const Shading& shading) const;
  Color refracted(const Shading& shading, const Vector& facet, float ratio, float importance) const;
  Color ambient(const Shading& shading) const;
  template <class Reflect>
  Color direct(const Shading& shading, const Reflect& reflect) const;

  const Scene& Surfaces;
  const Illuminants& Light;
};

} // namespace raytracing

#endif
