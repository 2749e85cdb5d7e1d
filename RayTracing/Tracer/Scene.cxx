// SPDX-License-Identifier: GPL-3.0-or-later
#include "Tracer/Scene.h"

#include "Tracer/Absorption.h"
#include "Tracer/EmbreeRay.h"
#include "Tracer/SplatScene.h"
#include "Tracer/TriangleScene.h"

#include <algorithm>
#include <utility>

namespace raytracing
{

struct Scene::Parts
{
  Parts(std::vector<std::shared_ptr<const Splats>> splats,
    std::vector<std::shared_ptr<const Triangles>> triangles)
    : device(rtcNewDevice(nullptr))
    , splatScene(device.get(), std::move(splats))
    , triangleScene(device.get(), std::move(triangles))
  {
  }

  embree::Device device;
  SplatScene splatScene;
  TriangleScene triangleScene;
  bool hasTransparent = false;
};

namespace
{

template <class TSurface>
bool isAnyTransparent(const std::vector<std::shared_ptr<const TSurface>>& surfaces)
{
  return std::any_of(surfaces.begin(), surfaces.end(),
    [](const auto& surface)
    { return embree::maskOf(*surface, surface->colors) == embree::masks::transparent; });
}

/// What a surface lets through to the light behind it.
Color passing(const Hit& hit, const Ray& ray)
{
  const Material& material = hit.surface->material;
  if (!material.isPhysical)
  {
    const float share = 1.0f - material.opacity * hit.opacity;
    return { share, share, share };
  }
  const float cosine = std::abs(dot(hit.normal, ray.direction));
  const float reflected = fresnelReflectance(cosine, material.refractiveIndex);
  const float share =
    (1.0f - material.metallic) * (1.0f - material.opacity * hit.opacity) * (1.0f - reflected);
  return { share, share, share };
}

} // namespace

//------------------------------------------------------------------------------
Scene::Scene(std::vector<std::shared_ptr<const Splats>> splats,
  std::vector<std::shared_ptr<const Triangles>> triangles)
{
  const bool hasTransparent = isAnyTransparent(splats) || isAnyTransparent(triangles);
  this->Content = std::make_unique<Parts>(std::move(splats), std::move(triangles));
  this->Content->hasTransparent = hasTransparent;
}

Scene::~Scene() = default;

//------------------------------------------------------------------------------
Hit Scene::closest(const Ray& ray, const Departure& departure) const
{
  return this->closest(ray, departure, embree::masks::all);
}

//------------------------------------------------------------------------------
Hit Scene::closest(const Ray& ray, const Departure& departure, unsigned int mask) const
{
  const Parts& parts = *this->Content;
  Hit hit;
  if (!parts.splatScene.isEmpty())
  {
    hit = parts.splatScene.closest(ray, departure, mask);
  }
  if (!parts.triangleScene.isEmpty())
  {
    Ray rest = ray;
    rest.farthest = std::min(rest.farthest, hit.distance);
    const Hit triangle = parts.triangleScene.closest(rest, mask);
    hit = triangle.surface ? triangle : hit;
  }
  if (hit.distance > ray.farthest)
  {
    return {};
  }
  return hit;
}

//------------------------------------------------------------------------------
Color Scene::transmittance(const Ray& ray, const Departure& departure) const
{
  const Parts& parts = *this->Content;
  if ((!parts.triangleScene.isEmpty() &&
        parts.triangleScene.isOccluded(ray, embree::masks::opaque)) ||
      (!parts.splatScene.isEmpty() &&
        parts.splatScene.isOccluded(ray, departure, embree::masks::opaque)))
  {
    return {};
  }
  Color passed{ 1.0f, 1.0f, 1.0f };
  constexpr int mostSurfaces = 32;
  constexpr float least = 1.0f / 512.0f; // half of a step of the picture
  Ray rest = ray;
  Departure from = departure;
  for (int i = 0; parts.hasTransparent && i < mostSurfaces && largestOf(passed) > least; ++i)
  {
    const Hit hit = this->closest(rest, from, embree::masks::transparent);
    if (!hit.surface)
    {
      break;
    }
    passed = passed * absorption(hit, rest.direction) * passing(hit, rest);
    rest.origin = rest.at(hit.distance);
    rest.farthest -= hit.distance;
    rest.nearest = nearestDistance;
    from = Departure(hit);
  }
  return passed;
}

} // namespace raytracing
