// SPDX-License-Identifier: GPL-3.0-or-later
#include "Tracer/PathTracer.h"

#include <algorithm>
#include <cmath>

namespace raytracing
{

namespace
{

constexpr float pi = 3.14159265f;

/// The dimensions of random numbers at one hit.
enum Decision : std::uint32_t
{
  AmbientDirection,
  FacetNormal,
  ReflectOrRefract,
  FirstLight // and one for each further light
};

/// Smoother surfaces have highlights of this roughness: in mirrors, lights have no extent.
constexpr float minRoughnessOfHighlights = 0.12f;

/// Additional blur of highlights seen via a rough surface: narrow ones would appear as specks.
constexpr float roughnessBehindRough = 0.25f;

/// Paths that contribute less than half a color step end.
constexpr float minImportance = 1.0f / 512.0f;

/// Up to this bounce, both reflection and refraction are followed; beyond it, one at random.
constexpr int branchingBounces = 2;

Vector reflectedAt(const Vector& normal, const Vector& direction)
{
  return direction - 2.0f * dot(normal, direction) * normal;
}

} // namespace

/// A ray with its history.
struct PathTracer::Path
{
  Ray ray;
  const Sampler* sampler;
  std::uint32_t name = 1; // number of the path within its sample; selects its random numbers
  int bounces = 0;
  bool isStraight = true; // from the camera
  float roughness = 0.0f; // the highest roughness that it was reflected at
  float importance = 1.0f;

  Pair pair(std::uint32_t decision) const
  {
    return this->sampler->pair(hashOf(this->name, decision));
  }

  Path after(
    const Hit& hit, const Vector& direction, float itsImportance, std::uint32_t branch) const
  {
    Path next = *this;
    next.ray.origin = this->ray.at(hit.distance);
    next.ray.direction = direction;
    next.ray.nearest = nearestDistance;
    next.name = hashOf(this->name, 1000u + branch);
    next.bounces = this->bounces + 1;
    next.importance = this->importance * itsImportance;
    next.roughness = std::max(
      this->roughness, hit.surface->material.isPhysical ? hit.surface->material.roughness : 0.0f);
    return next;
  }
};

struct PathTracer::Shading
{
  const Path& path;
  const Hit& hit;
  const Material& material;
  Vector position;
  Vector normal;  // on the ray's side
  Vector towards; // opposite to the ray
};

Radiance PathTracer::along(const Ray& ray, const Sampler& sampler) const
{
  Path path;
  path.ray = ray;
  path.sampler = &sampler;
  return this->follow(path);
}

Radiance PathTracer::follow(const Path& path) const
{
  if (path.bounces > this->Light.maxBounces || path.importance < minImportance)
  {
    return {};
  }
  const Hit hit = this->Surfaces.closest(path.ray);
  if (!hit.surface)
  {
    return { path.isStraight ? Color{} : this->Light.environment.towards(path.ray.direction),
      path.isStraight ? 0.0f : 1.0f };
  }
  Radiance radiance = this->shade(path, hit);
  radiance.color = absorption(hit, path.ray.direction) * radiance.color;
  return radiance;
}

Radiance PathTracer::shade(const Path& path, const Hit& hit) const
{
  const Material& material = hit.surface->material;
  const Vector& direction = path.ray.direction;
  const bool isBack = dot(hit.normal, direction) > 0.0f;
  const Shading shading{ path, hit, material, path.ray.at(hit.distance),
    isBack ? -hit.normal : hit.normal, -direction };
  if (material.isPhysical)
  {
    return { this->shadePhysical(shading), 1.0f };
  }
  const float opacity = material.opacity * hit.opacity;
  Radiance result;
  result.alpha = opacity;
  if (opacity > 0.0f)
  {
    result.color = opacity * this->shadePhong(shading);
  }
  if (opacity < 1.0f)
  {
    const Radiance behind = this->follow(path.after(hit, direction, 1.0f - opacity, 0));
    result.color += (1.0f - opacity) * behind.color;
    result.alpha += (1.0f - opacity) * behind.alpha;
  }
  return result;
}

template <class Reflect>
Color PathTracer::direct(const Shading& shading, const Reflect& reflect) const
{
  Color sum;
  std::uint32_t decision = FirstLight;
  for (const raytracing::Light& light : this->Light.lights)
  {
    const Illumination arriving =
      illuminationOf(light, shading.position, shading.path.pair(decision++));
    const float cosine = dot(shading.normal, arriving.towards);
    if (cosine <= 0.0f || arriving.strength <= 0.0f)
    {
      continue;
    }
    Color passed{ 1.0f, 1.0f, 1.0f };
    if (this->Light.hasShadows)
    {
      const Ray ray{ shading.position + shading.hit.lift, arriving.towards, nearestDistance,
        arriving.distance };
      passed = this->Surfaces.transmittance(ray);
    }
    sum += arriving.strength * passed * reflect(light, arriving.towards, cosine);
  }
  return sum;
}

Color PathTracer::ambient(const Shading& shading) const
{
  const AmbientLight& light = this->Light.ambient;
  const Material& material = shading.material;
  const Color color = material.isPhysical ? light.color
                                          : material.diffuse * light.color +
                                              material.ambient * Color{ 1.0f, 1.0f, 1.0f };
  if (largestOf(color) <= 0.0f)
  {
    return {};
  }
  if (light.distance <= 0.0f)
  {
    return color * shading.hit.color;
  }
  const Pair place = shading.path.pair(AmbientDirection);
  const float radius = std::sqrt(place.first);
  const float angle = 2.0f * pi * place.second;
  const Vector direction = Frame(shading.normal)
                             .toWorld({ radius * std::cos(angle), radius * std::sin(angle),
                               std::sqrt(1.0f - place.first) });
  const Ray ray{ shading.position + shading.hit.lift, direction, nearestDistance, light.distance };
  return this->Surfaces.transmittance(ray) * color * shading.hit.color;
}

Color PathTracer::shadePhong(const Shading& shading) const
{
  const Material& material = shading.material;
  const auto reflect = [&](const raytracing::Light& light, const Vector& towards, float cosine)
  {
    Color sum = material.diffuse * cosine * light.diffuse * shading.hit.color;
    if (material.specular > 0.0f)
    {
      const float along =
        std::max(dot(reflectedAt(shading.normal, -towards), shading.towards), 0.0f);
      sum += material.specular * std::pow(along, material.specularPower) * light.specular *
             material.specularColor;
    }
    return sum;
  };
  return this->direct(shading, reflect) + this->ambient(shading);
}

Color PathTracer::shadePhysical(const Shading& shading) const
{
  const Material& material = shading.material;
  const Hit& hit = shading.hit;
  const bool isInside = comesFromInside(hit, -shading.towards);
  const float ratio = isInside && material.transmission() > 0.0f ? 1.0f / material.refractiveIndex
                                                                 : material.refractiveIndex;
  const auto reflectance = [&](float cosine)
  {
    const float share = fresnelReflectance(cosine, ratio);
    return mixed({ share, share, share }, metalReflectance(cosine, hit.color), material.metallic);
  };

  const float before = shading.path.roughness;
  const Microfacets highlights(
    std::min(1.0f, std::max({ material.roughness, minRoughnessOfHighlights,
                     before > 0.0f ? before + roughnessBehindRough : 0.0f })));
  const float opaque = (1.0f - material.metallic) * material.opacity * hit.opacity;
  const float seen = std::max(dot(shading.normal, shading.towards), 1e-4f);
  const auto reflect = [&](const raytracing::Light& light, const Vector& towards, float cosine)
  {
    const Vector half = directionOf(towards + shading.towards, shading.normal);
    const Color specular = reflectance(std::clamp(dot(half, towards), 0.0f, 1.0f));
    const float strength = pi * highlights.density(dot(half, shading.normal)) *
                           highlights.visible(cosine) * highlights.visible(seen) / (4.0f * seen);
    return opaque * cosine * light.diffuse * (Color{ 1.0f, 1.0f, 1.0f } - specular) * hit.color +
           strength * light.specular * specular;
  };
  Color sum = this->direct(shading, reflect);
  if (opaque > 0.0f)
  {
    sum += opaque * this->ambient(shading);
  }
  this->addSurroundings(shading, ratio, reflectance, sum);
  return sum;
}

template <class Reflectance>
void PathTracer::addSurroundings(
  const Shading& shading, float ratio, const Reflectance& reflectance, Color& sum) const
{
  const Material& material = shading.material;
  const Hit& hit = shading.hit;
  Vector facet = shading.normal;
  float visible = 1.0f;
  const Frame frame(shading.normal);
  if (material.roughness > 0.0f)
  {
    const Pair place = shading.path.pair(FacetNormal);
    const Microfacets facets(material.roughness);
    facet =
      frame.toWorld(facets.seenFrom(frame.toLocal(shading.towards), place.first, place.second));
    visible =
      facets.visible(std::max(dot(reflectedAt(facet, -shading.towards), shading.normal), 0.0f));
  }
  const Color reflected =
    visible * reflectance(std::clamp(dot(facet, shading.towards), 0.0f, 1.0f));
  const float transmitted =
    material.transmission() > 0.0f
      ? (1.0f - material.metallic) * (1.0f - material.opacity * hit.opacity) *
          (1.0f - fresnelReflectance(std::clamp(dot(facet, shading.towards), 0.0f, 1.0f), ratio))
      : 0.0f;
  float reflectShare = 1.0f;
  float refractShare = 1.0f;
  if (transmitted > 0.0f && shading.path.bounces >= branchingBounces)
  {
    const float chance = largestOf(reflected) / (largestOf(reflected) + transmitted);
    const bool reflects = shading.path.pair(ReflectOrRefract).first < chance;
    reflectShare = reflects ? 1.0f / chance : 0.0f;
    refractShare = reflects ? 0.0f : 1.0f / (1.0f - chance);
  }
  if (reflectShare > 0.0f && visible > 0.0f)
  {
    Path next = shading.path.after(
      hit, reflectedAt(facet, -shading.towards), reflectShare * largestOf(reflected), 0);
    next.isStraight = false;
    sum += reflectShare * reflected * this->follow(next).color;
  }
  if (refractShare * transmitted > 0.0f)
  {
    const float share = refractShare * transmitted;
    sum += share * this->refracted(shading, facet, ratio, share);
  }
}

Color PathTracer::refracted(
  const Shading& shading, const Vector& facet, float ratio, float importance) const
{
  const float cosine = dot(facet, shading.towards);
  const float squaredSine = (1.0f - cosine * cosine) / (ratio * ratio);
  const float inner = std::sqrt(std::max(1.0f - squaredSine, 0.0f));
  const Vector direction =
    directionOf((-1.0f / ratio) * shading.towards + (cosine / ratio - inner) * facet);
  Path next = shading.path.after(shading.hit, direction, importance, 1);
  next.isStraight = false;
  return this->follow(next).color;
}

} // namespace raytracing
