// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Tracer/Lighting.h"
#include "Tracer/Sampler.h"
#include "Tracer/Scene.h"

#include <cstdint>
#include <vector>

namespace raytracing
{

/// Everything except surfaces that affects a picture's colors.
struct Illuminants
{
  std::vector<Light> lights;
  Environment environment;
  AmbientLight ambient;
  bool hasShadows = true;
  int maxBounces = 8; // maximum number of reflections and refractions of a path
};

/// The light that arrives along a ray.
struct Radiance
{
  Color color;        // of the surfaces, times alpha
  float alpha = 1.0f; // coverage; the background shows through the rest
};

/// Computes light along rays [Whi80]: direct light with shadows, ambient light, reflections and
/// refractions. Matte surfaces do not illuminate each other.
class PathTracer
{
public:
  PathTracer(const Scene& scene, const Illuminants& illuminants)
    : Surfaces(scene)
    , Light(illuminants)
  {
  }

  /// The light along a ray from the camera. From any thread.
  Radiance along(const Ray& ray, const Sampler& sampler) const;

private:
  struct Path;
  struct Shading;

  Radiance follow(const Path& path) const;
  Radiance shade(const Path& path, const Hit& hit) const;
  Color shadePhong(const Shading& shading) const;
  Color shadePhysical(const Shading& shading) const;
  /// Adds reflection and refraction of the surroundings.
  /// @param ratio of refractive indices
  /// @param reflectance(cosine) the reflected share by color
  template <class Reflectance>
  void addSurroundings(
    const Shading& shading, float ratio, const Reflectance& reflectance, Color& sum) const;
  Color refracted(const Shading& shading, const Vector& facet, float ratio, float importance) const;
  Color ambient(const Shading& shading) const;
  template <class Reflect>
  Color direct(const Shading& shading, const Reflect& reflect) const;

  const Scene& Surfaces;
  const Illuminants& Light;
};

} // namespace raytracing
