// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef raytracing_Material_h
#define raytracing_Material_h

#include "Tracer/Vector.h"

namespace raytracing
{

/// How a surface answers to light. Its own color comes with each hit.
struct Material
{
  /// Whether reflection and transmission are those of Fresnel; else those of Phong's model, without
  /// reflections of other surfaces, and what is not opaque lets light pass straight.
  bool isPhysical = false;

  float opacity = 1.0f; // 0 to 1: the share of light that is not let through

  // Of Phong's model.
  float ambient = 0.0f;
  float diffuse = 1.0f;
  float specular = 0.0f;
  float specularPower = 1.0f;
  Color specularColor{ 1.0f, 1.0f, 1.0f };

  // Of physical materials.
  float metallic = 0.0f;           // 0 for dielectrics, 1 for metals, which reflect in their color
  float roughness = 0.0f;          // 0 for mirrors; the square root of GGX's alpha
  float refractiveIndex = 1.5f;    // over that of the outside
  float absorptionDistance = 1.0f; // within which light takes on the surface's color inside it

  float transmission() const
  {
    return this->isPhysical ? (1.0f - this->metallic) * (1.0f - this->opacity)
                            : 1.0f - this->opacity;
  }
};

/// The share of unpolarized light that a dielectric reflects.
/// @param cosine of the angle between ray and normal, 0 to 1
/// @param ratio of the refractive indices behind and before the surface
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

/// The color in which a metal reflects [Sch94].
inline Color metalReflectance(float cosine, const Color& color)
{
  const float away = 1.0f - cosine;
  return mixed(color, { 1.0f, 1.0f, 1.0f }, away * away * away * away * away);
}

/// Microfacets whose slopes are distributed as in [WMLT07], in a frame whose z axis is the normal.
class Microfacets
{
public:
  explicit Microfacets(float roughness)
    : Alpha(roughness * roughness)
  {
  }

  /// The density of the facets' normals.
  float density(float cosine) const
  {
    const float squared = this->Alpha * this->Alpha;
    const float base = cosine * cosine * (squared - 1.0f) + 1.0f;
    return squared / (3.14159265f * base * base);
  }

  /// The share of the facets that are seen from a direction.
  float visible(float cosine) const
  {
    const float squared = this->Alpha * this->Alpha;
    return 2.0f * cosine / (cosine + std::sqrt(squared + (1.0f - squared) * cosine * cosine));
  }

  /// The normal of a facet seen from a direction above the surface, for two numbers from 0 to 1
  /// [Hei18].
  Vector seenFrom(const Vector& direction, float first, float second) const
  {
    const Vector stretched =
      directionOf({ this->Alpha * direction.x, this->Alpha * direction.y, direction.z });
    const Frame frame(stretched);
    const float radius = std::sqrt(first);
    const float angle = 6.2831853f * second;
    // A point on the projection of a hemisphere: one half of its disk is shortened. It is shortened
    // along the direction in which the hemisphere leans, which is chosen as the second axis here.
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

#endif
