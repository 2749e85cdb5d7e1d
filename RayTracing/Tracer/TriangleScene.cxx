// SPDX-License-Identifier: GPL-3.0-or-later
#include "Tracer/TriangleScene.h"

#include "Tracer/EmbreeRay.h"

#include <cstddef>
#include <utility>

namespace raytracing
{

namespace
{

/// Attributes of the three vertices, at a place in the triangle.
template <class T, class Convert>
auto interpolated(const std::vector<T>& ofVertices, const std::array<std::uint32_t, 3>& triangle,
  float u, float v, const Convert& convert)
{
  return (1.0f - u - v) * convert(ofVertices[triangle[0]]) + u * convert(ofVertices[triangle[1]]) +
         v * convert(ofVertices[triangle[2]]);
}

void setColor(Hit& hit, const Triangles& triangles, const RTCHit& place)
{
  const auto& corners = triangles.triangles[place.primID];
  hit.color = triangles.color;
  if (triangles.colorsOfTriangles)
  {
    const ColorBytes& bytes = triangles.colors[place.primID];
    hit.color = colorOf(bytes);
    hit.opacity = opacityOf(bytes);
  }
  else if (!triangles.colors.empty())
  {
    hit.color = interpolated(triangles.colors, corners, place.u, place.v, colorOf);
    hit.opacity = interpolated(triangles.colors, corners, place.u, place.v, opacityOf);
  }
}

} // namespace

//------------------------------------------------------------------------------
TriangleScene::TriangleScene(
  RTCDevice device, std::vector<std::shared_ptr<const Triangles>> surfaces)
  : Scene(rtcNewScene(device))
{
  rtcSetSceneFlags(this->Scene.get(), RTC_SCENE_FLAG_ROBUST);
  for (std::shared_ptr<const Triangles>& surface : surfaces)
  {
    if (surface->triangles.empty())
    {
      continue;
    }
    const embree::Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    // Embree reads 16 bytes at a time: its own buffers are padded, as ours are not.
    auto* const vertices = static_cast<Vector*>(rtcSetNewGeometryBuffer(geometry.get(),
      RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vector), surface->vertices.size()));
    embree::check(device);
    std::copy(surface->vertices.begin(), surface->vertices.end(), vertices);
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
      surface->triangles.data(), 0, 3 * sizeof(std::uint32_t), surface->triangles.size());
    rtcSetGeometryMask(geometry.get(), embree::maskOf(*surface, surface->colors));
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(
      this->Scene.get(), geometry.get(), static_cast<unsigned int>(this->Surfaces.size()));
    this->Surfaces.push_back(std::move(surface));
  }
  rtcCommitScene(this->Scene.get());
  embree::check(device);
}

//------------------------------------------------------------------------------
Hit TriangleScene::closest(const Ray& ray, unsigned int mask) const
{
  embree::Context context;
  embree::initialize(context);
  RTCRayHit embree{};
  embree.ray = embree::rayOf(ray, mask);
  embree.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  embree::intersect(this->Scene.get(), context, embree);
  Hit hit;
  if (embree.hit.geomID == RTC_INVALID_GEOMETRY_ID)
  {
    return hit;
  }
  const Triangles& triangles = *this->Surfaces[embree.hit.geomID];
  hit.surface = &triangles;
  hit.distance = embree.ray.tfar;
  const Vector geometric{ embree.hit.Ng_x, embree.hit.Ng_y, embree.hit.Ng_z };
  hit.normal = directionOf(geometric, -ray.direction);
  if (!triangles.normals.empty())
  {
    const auto same = [](const Vector& normal) { return normal; };
    hit.normal = directionOf(interpolated(triangles.normals, triangles.triangles[embree.hit.primID],
                               embree.hit.u, embree.hit.v, same),
      hit.normal);
  }
  setColor(hit, triangles, embree.hit);
  return hit;
}

//------------------------------------------------------------------------------
bool TriangleScene::isOccluded(const Ray& ray, unsigned int mask) const
{
  embree::Context context;
  embree::initialize(context);
  RTCRay embree = embree::rayOf(ray, mask);
  embree::occlude(this->Scene.get(), context, embree);
  return embree.tfar < 0.0f;
}

} // namespace raytracing
