// SPDX-License-Identifier: GPL-3.0-or-later
#include "Tracer/Scene.h"

#include "Tracer/Embree.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace raytracing
{

namespace
{

Scene::Mask maskOf(const Surface& surface)
{
  const bool isOpaque = surface.material.transmission() <= 0.0f &&
                        std::all_of(surface.colors.begin(), surface.colors.end(),
                          [](const ColorBytes& c) { return c[3] == 255; });
  return isOpaque ? Scene::Opaque : Scene::Transparent;
}

RTCRay rayOf(const Ray& ray, Scene::Mask mask)
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

} // namespace

struct Scene::Parts
{
  explicit Parts(std::vector<std::shared_ptr<const Surface>> given)
    : device(rtcNewDevice(nullptr))
    , scene(rtcNewScene(device.get()))
  {
    rtcSetSceneFlags(this->scene.get(), RTC_SCENE_FLAG_ROBUST);
    for (std::shared_ptr<const Surface>& surface : given)
    {
      if (surface->triangles.empty())
      {
        continue;
      }
      const embree::Geometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
      // Embree's own buffer has the padding that its 16-byte reads need.
      auto* const vertices = static_cast<Vector*>(rtcSetNewGeometryBuffer(geometry.get(),
        RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vector), surface->vertices.size()));
      embree::check(device.get());
      std::copy(surface->vertices.begin(), surface->vertices.end(), vertices);
      rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
        surface->triangles.data(), 0, 3 * sizeof(std::uint32_t), surface->triangles.size());
      const Scene::Mask mask = maskOf(*surface);
      this->hasTransparent |= mask == Scene::Transparent;
      rtcSetGeometryMask(geometry.get(), mask);
      rtcCommitGeometry(geometry.get());
      rtcAttachGeometryByID(
        this->scene.get(), geometry.get(), static_cast<unsigned int>(this->surfaces.size()));
      this->surfaces.push_back(std::move(surface));
    }
    rtcCommitScene(this->scene.get());
    embree::check(device.get());
  }

  embree::Device device;
  embree::SceneOwner scene;
  std::vector<std::shared_ptr<const Surface>> surfaces; // by Embree's ids
  bool hasTransparent = false;
};

namespace
{

/// Interpolates an attribute of the three vertices in a triangle.
template <class T, class Convert>
auto interpolated(const std::vector<T>& ofVertices, const std::array<std::uint32_t, 3>& triangle,
  float u, float v, const Convert& convert)
{
  return (1.0f - u - v) * convert(ofVertices[triangle[0]]) + u * convert(ofVertices[triangle[1]]) +
         v * convert(ofVertices[triangle[2]]);
}

void setColor(Hit& hit, const Surface& surface, const RTCHit& place)
{
  const auto& corners = surface.triangles[place.primID];
  hit.color = surface.color;
  if (surface.colorsOfTriangles)
  {
    const ColorBytes& bytes = surface.colors[place.primID];
    hit.color = colorOf(bytes);
    hit.opacity = opacityOf(bytes);
  }
  else if (!surface.colors.empty())
  {
    hit.color = interpolated(surface.colors, corners, place.u, place.v, colorOf);
    hit.opacity = interpolated(surface.colors, corners, place.u, place.v, opacityOf);
  }
}

/// Shading with interpolated normals makes triangles cast shadows on each other in grazing light.
/// The smooth surface is assumed to pass through the mean of the position's projections onto the
/// vertices' tangent planes, weighted like normals, if they are in front of the triangle (J.
/// Hanika, Hacking the Shadow Terminator, Ray Tracing Gems II).
Vector liftOf(const Surface& surface, const RTCHit& place, const Vector& position, float side)
{
  const auto& corners = surface.triangles[place.primID];
  const float weights[3] = { 1.0f - place.u - place.v, place.u, place.v };
  Vector lift;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const Vector normal = side * directionOf(surface.normals[corners[i]]);
    const float height = dot(surface.vertices[corners[i]] - position, normal);
    lift += weights[i] * std::max(height, 0.0f) * normal;
  }
  return lift;
}

/// The share of light that passes through a surface.
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

Scene::Scene(std::vector<std::shared_ptr<const Surface>> surfaces)
  : Content(std::make_unique<Parts>(std::move(surfaces)))
{
}

Scene::~Scene() = default;

Hit Scene::closest(const Ray& ray, Mask mask) const
{
  embree::Context context;
  embree::initialize(context);
  RTCRayHit embree{};
  embree.ray = rayOf(ray, mask);
  embree.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  embree::intersect(this->Content->scene.get(), context, embree);
  Hit hit;
  if (embree.hit.geomID == RTC_INVALID_GEOMETRY_ID)
  {
    return hit;
  }
  const Surface& surface = *this->Content->surfaces[embree.hit.geomID];
  hit.surface = &surface;
  hit.distance = embree.ray.tfar;
  const Vector geometric{ embree.hit.Ng_x, embree.hit.Ng_y, embree.hit.Ng_z };
  hit.normal = directionOf(geometric, -ray.direction);
  if (!surface.normals.empty())
  {
    const auto same = [](const Vector& normal) { return normal; };
    hit.normal = directionOf(interpolated(surface.normals, surface.triangles[embree.hit.primID],
                               embree.hit.u, embree.hit.v, same),
      hit.normal);
    const float side = dot(hit.normal, ray.direction) > 0.0f ? -1.0f : 1.0f;
    hit.lift = liftOf(surface, embree.hit, ray.at(hit.distance), side);
  }
  setColor(hit, surface, embree.hit);
  return hit;
}

bool Scene::isOccluded(const Ray& ray) const
{
  embree::Context context;
  embree::initialize(context);
  RTCRay embree = rayOf(ray, Scene::Opaque);
  embree::occlude(this->Content->scene.get(), context, embree);
  return embree.tfar < 0.0f;
}

Color Scene::transmittance(const Ray& ray) const
{
  if (this->isOccluded(ray))
  {
    return {};
  }
  Color passed{ 1.0f, 1.0f, 1.0f };
  constexpr int maxSurfaces = 32;
  constexpr float least = 1.0f / 512.0f; // half of a color step
  Ray rest = ray;
  for (int i = 0; this->Content->hasTransparent && i < maxSurfaces && largestOf(passed) > least;
       ++i)
  {
    const Hit hit = this->closest(rest, Scene::Transparent);
    if (!hit.surface)
    {
      break;
    }
    passed = passed * absorption(hit, rest.direction) * passing(hit, rest);
    rest.origin = rest.at(hit.distance);
    rest.farthest -= hit.distance;
    rest.nearest = nearestDistance;
  }
  return passed;
}

} // namespace raytracing
