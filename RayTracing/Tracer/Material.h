// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Tracer/Vector.h"

namespace raytracing
{

/// The optical properties of a surface. Each hit has its own color.
struct Material
{
  /// Whether reflection and transmission follow Fresnel. Otherwise Phong's model applies, without
  /// reflections of other surfaces, and light passes straight through translucent surfaces.
  bool isPhysical = false;

  float opacity = 1.0f; // 0 to 1: the share of light that is blocked

  // Of Phong's model.
  float ambient = 0.0f;
  float diffuse = 1.0f;
  float specular = 0.0f;
  float specularPower = 1.0f;
  Color specularColor{ 1.0f, 1.0f, 1.0f };

  // Of physical materials.
  float metallic = 0.0f;           // 0 for dielectrics, 1 for metals, which reflect in their color
  float roughness = 0.0f;          // 0 for mirrors; the square root of GGX's alpha
  float refractiveIndex = 1.5f;    // relative to the outside
  float absorptionDistance = 1.0f; // distance inside over which light takes on the surface's color

  float transmission() const
  {
    return this->isPhysical ? (1.0f - this->metallic) * (1.0f - this->opacity)
                            : 1.0f - this->opacity;
  }
};

/// The share of unpolarized light that a dielectric reflects.
/// @param cosine of the angle between ray and normal, 0 to 1
/// @param ratio refractive index behind the surface over that before it
inline float fresnelReflectance(float cosine, float ratio)
{
  const float squaredSine = (1.0f - cosine * cosine) / (ratio * ratio);
  if (squaredSine >= 1.0f)
  {
    return 1.0f;
  }
  const float refracted = std::sqrt(1.0f - squaredSine);
  const float parallel = (ratio * cosine - refracted) / (ratio * cosine + refracted);
  const float orthogonal = (cosine - ratio * refracted) / (cosine + ratio * refracted);
  return 0.5f * (parallel * parallel + orthogonal * orthogonal);
}

/// The reflectance of a metal [Sch94].
inline Color metalReflectance(float cosine, const Color& color)
{
  const float away = 1.0f - cosine;
  return mixed(color, { 1.0f, 1.0f, 1.0f }, away * away * away * away * away);
}

/// Microfacets with the slope distribution of [WMLT07]; the z axis is the normal.
class Microfacets
{
public:
  explicit Microfacets(float roughness)
    : Alpha(roughness * roughness)
  {
  }

  float density(float cosine) const
  {
    const float squared = this->Alpha * this->Alpha;
    const float base = cosine * cosine * (squared - 1.0f) + 1.0f;
    return squared / (3.14159265f * base * base);
  }

  /// The share of facets visible from a direction.
  float visible(float cosine) const
  {
    const float squared = this->Alpha * this->Alpha;
    return 2.0f * cosine / (cosine + std::sqrt(squared + (1.0f - squared) * cosine * cosine));
  }

  /// Samples the normal of a facet visible from above, by two numbers from 0 to 1 [Hei18].
  Vector seenFrom(const Vector& direction, float first, float second) const
  {
    const Vector stretched =
      directionOf({ this->Alpha * direction.x, this->Alpha * direction.y, direction.z });
    const Frame frame(stretched);
    const float radius = std::sqrt(first);
    const float angle = 6.2831853f * second;
    // A point on the projected hemisphere: one half of the disk is shortened along the second axis,
    // the direction in which the hemisphere leans.
    const Vector side = directionOf(cross({ 0.0f, 0.0f, 1.0f }, stretched), frame.first);
    const Vector ahead = cross(stretched, side);
    const float x = radius * std::cos(angle);
    const float share = 0.5f * (1.0f + stretched.z);
    const float y =
      (1.0f - share) * std::sqrt(std::max(1.0f - x * x, 0.0f)) + share * radius * std::sin(angle);
    const float z = std::sqrt(std::max(1.0f - x * x - y * y, 0.0f));
    const Vector normal = x * side + y * ahead + z * stretched;
    return directionOf(
      { this->Alpha * normal.x, this->Alpha * normal.y, std::max(normal.z, 1e-6f) });
  }

private:
  float Alpha;
};

} // namespace raytracing
