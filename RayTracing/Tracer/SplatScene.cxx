// SPDX-License-Identifier: GPL-3.0-or-later
#include "Tracer/SplatScene.h"

#include "Tracer/EmbreeRay.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

namespace raytracing
{

namespace
{

// Splats end this far beyond their planes, in radii, so that there is no slit where the planes of
// two faces at a crease differ slightly.
constexpr float slit = 0.005f;
// The weights of splats beyond their planes, and of those hidden by the face across the crease.
constexpr float weightBeyond = 1e-3f;
constexpr float weightBehind = 1e-6f;

struct Candidate
{
  float distance;
  float squaredRadius; // of the place in the splat, 0 at its center and 1 at its rim
  unsigned int splat;
  unsigned int surface;
  bool isBeyond; // the splat's clipping plane

  bool operator<(const Candidate& other) const
  {
    return std::tie(this->distance, this->surface, this->splat) <
           std::tie(other.distance, other.surface, other.splat);
  }
};

/**
 * The weighted fit of an affine function to the normals of splats, around the place where the ray
 * meets them. A mean alone is that of another place where the splats' centers lie to one side, by
 * which reflections would ripple.
 */
class NormalFit
{
public:
  /// @param frame of the surface
  /// @param unit of lengths: a splat's radius
  NormalFit(const Frame& frame, float unit)
    : Tangents(frame)
    , Scale(1.0f / unit)
  {
  }

  /// @param offset of the splat's center from where the ray meets it
  void add(float weight, const Vector& offset, const Vector& normal)
  {
    const float x = this->Scale * dot(offset, this->Tangents.first);
    const float y = this->Scale * dot(offset, this->Tangents.second);
    this->Weight += weight;
    this->X += weight * x;
    this->Y += weight * y;
    this->XX += weight * x * x;
    this->XY += weight * x * y;
    this->YY += weight * y * y;
    this->Normal += weight * normal;
    this->NormalX += weight * x * normal;
    this->NormalY += weight * y * normal;
  }

  /// The normal where the ray meets the splats, not of unit length.
  Vector normal() const
  {
    // Added to the variances, so that few splats, or those in a line, have the mean of their
    // normals.
    constexpr float ridge = 0.005f;
    const float unit = 1.0f / this->Weight;
    const float x = unit * this->X;
    const float y = unit * this->Y;
    const float xx = unit * this->XX - x * x + ridge;
    const float yy = unit * this->YY - y * y + ridge;
    const float xy = unit * this->XY - x * y;
    const Vector mean = unit * this->Normal;
    const Vector withX = unit * this->NormalX - x * mean;
    const Vector withY = unit * this->NormalY - y * mean;
    const float factor = 1.0f / (xx * yy - xy * xy);
    const Vector alongX = factor * (yy * withX - xy * withY);
    const Vector alongY = factor * (xx * withY - xy * withX);
    return mean - x * alongX - y * alongY;
  }

private:
  Frame Tangents;
  float Scale;
  float Weight = 0.0f;
  float X = 0.0f;
  float Y = 0.0f;
  float XX = 0.0f;
  float XY = 0.0f;
  float YY = 0.0f;
  Vector Normal;
  Vector NormalX;
  Vector NormalY;
};

/// Weighted sums over the splats that are blended.
struct Blend
{
  Blend(const Splats& splats, const Candidate& nearest)
    : fit(Frame(splats.normal(nearest.splat)), splats.discs[nearest.splat].radius)
  {
  }

  NormalFit fit;
  float weight = 0.0f;
  float distance = 0.0f;
  float radius = 0.0f;
  float opacity = 0.0f;
  bool hasFront = false; // splats that face the ray, and that do not
  bool hasBack = false;
  Color color;

  void add(const Splats& splats, const Candidate& item, const Ray& ray)
  {
    const Vector& direction = ray.direction;
    const Vector& itsNormal = splats.normal(item.splat);
    const bool isFront = dot(itsNormal, direction) < 0.0f;
    this->hasFront = this->hasFront || isFront;
    this->hasBack = this->hasBack || !isFront;
    const float inner = 1.0f - item.squaredRadius;
    float itsWeight = inner * inner + 1e-4f;
    if (!splats.clips.empty())
    {
      const Clip& clip = splats.clips[item.splat];
      const bool turnsTowardsRay = isFront == (clip.turn > 0.0f);
      const bool isBehind = turnsTowardsRay && dot(clip.normal, direction) > 0.0f;
      itsWeight *= (item.isBeyond ? weightBeyond : 1.0f) * (isBehind ? weightBehind : 1.0f);
    }
    this->weight += itsWeight;
    this->distance += itsWeight * item.distance;
    this->radius = std::max(this->radius, splats.discs[item.splat].radius);
    this->fit.add(itsWeight, splats.discs[item.splat].center - ray.at(item.distance), itsNormal);
    if (!splats.colors.empty())
    {
      const ColorBytes& bytes = splats.colors[item.splat];
      this->color += itsWeight * colorOf(bytes);
      this->opacity += itsWeight * opacityOf(bytes);
    }
  }

  Hit hit(const Splats& splats, const Vector& direction) const
  {
    Hit hit;
    hit.surface = &splats;
    hit.distance = this->distance / this->weight;
    hit.normal = directionOf(this->fit.normal(), -direction);
    const float away = splats.outward * dot(hit.normal, direction);
    // Splats extend beyond the horizon of a closed surface. There its outside is what is seen,
    // though their normals may point away.
    constexpr float grazing = 0.1f; // cosine
    constexpr float slant = 0.01f;
    if (away > 0.0f && (away < grazing || (this->hasFront && this->hasBack)))
    {
      hit.normal = directionOf(hit.normal - splats.outward * (away + slant) * direction);
    }
    hit.radius = this->radius;
    hit.color = splats.colors.empty() ? splats.color : (1.0f / this->weight) * this->color;
    hit.opacity = splats.colors.empty() ? 1.0f : this->opacity / this->weight;
    return hit;
  }
};

} // namespace

struct SplatScene::Attached
{
  std::shared_ptr<const Splats> splats;
  unsigned int index;
};

/// The nearest candidates, in whatever order they are found.
struct SplatScene::Candidates
{
  const SplatScene* scene;
  std::array<Candidate, 64> items;
  std::size_t count = 0;

  void add(const Candidate& candidate)
  {
    if (this->count < this->items.size())
    {
      this->items[this->count++] = candidate;
      return;
    }
    Candidate& farthest = *std::max_element(this->items.begin(), this->items.end());
    if (candidate < farthest)
    {
      farthest = candidate;
    }
  }
};

/// What Embree hands to the filters.
struct SplatScene::Query
{
  embree::Context context; // the first member: Embree knows its address alone
  const Departure* departure = nullptr;
  Candidates* candidates = nullptr;
  float limit = std::numeric_limits<float>::infinity(); // beyond which nothing is blended
  float squaredRadius = 0.0f;                           // of the splat last covered
  float clip = 0.0f;                                    // its distance from its clipping plane
};

//------------------------------------------------------------------------------
SplatScene::SplatScene(RTCDevice device, std::vector<std::shared_ptr<const Splats>> surfaces)
  : Scene(rtcNewScene(device))
{
  rtcSetSceneFlags(this->Scene.get(), RTC_SCENE_FLAG_ROBUST);
  for (std::shared_ptr<const Splats>& splats : surfaces)
  {
    const std::size_t count = splats->discs.size();
    if (count == 0)
    {
      continue;
    }
    const embree::Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT));
    static_assert(sizeof(Disc) == 4 * sizeof(float), "Embree reads center and radius");
    // Embree reads 16 bytes at a time: its own buffer of normals is padded, as ours is not.
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
      splats->discs.data(), 0, sizeof(Disc), count);
    auto* const normals = static_cast<Vector*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3, sizeof(Vector), count));
    embree::check(device);
    std::copy(splats->planes.begin(), splats->planes.end(), normals);
    for (std::size_t i = 0; surfaces.size() > 1 && i < count; ++i)
    {
      this->LargestDepth = std::max(this->LargestDepth, splats->depth(i));
    }
    auto attached = std::make_unique<Attached>();
    attached->index = static_cast<unsigned int>(this->Geometries.size());
    attached->splats = std::move(splats);
    rtcSetGeometryMask(geometry.get(), embree::maskOf(*attached->splats, attached->splats->colors));
    rtcSetGeometryUserData(geometry.get(), attached.get());
    rtcSetGeometryIntersectFilterFunction(geometry.get(), &SplatScene::gather);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), &SplatScene::occlude);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(this->Scene.get(), geometry.get(), attached->index);
    this->Geometries.push_back(std::move(attached));
  }
  rtcCommitScene(this->Scene.get());
  embree::check(device);
}

//------------------------------------------------------------------------------
SplatScene::~SplatScene() = default;

//------------------------------------------------------------------------------
bool SplatScene::covers(
  const Attached& attached, unsigned int splat, Query& query, const RTCRay& ray)
{
  const Splats& splats = *attached.splats;
  const Vector direction{ ray.dir_x, ray.dir_y, ray.dir_z };
  if (query.departure->surface == attached.splats.get() &&
      query.departure->ignores(direction, ray.tfar, splats.normal(splat)))
  {
    return false;
  }
  const Disc& disc = splats.discs[splat];
  const Vector offset =
    Vector{ ray.org_x, ray.org_y, ray.org_z } + ray.tfar * direction - disc.center;
  query.squaredRadius = dot(offset, offset) / (disc.radius * disc.radius);
  if (!splats.ellipses.empty())
  {
    const float first = dot(offset, splats.ellipses[splat].first);
    const float second = dot(offset, splats.ellipses[splat].second);
    query.squaredRadius = first * first + second * second;
  }
  query.clip = 0.0f;
  if (!splats.clips.empty())
  {
    const Clip& clip = splats.clips[splat];
    query.clip = clip.distance + dot(clip.normal, offset);
  }
  return query.squaredRadius <= 1.0f && query.clip >= -slit;
}

//------------------------------------------------------------------------------
void SplatScene::gather(const RTCFilterFunctionNArguments* arguments)
{
  auto& query = *reinterpret_cast<Query*>(arguments->context);
  const auto& attached = *static_cast<const Attached*>(arguments->geometryUserPtr);
  auto& ray = *reinterpret_cast<RTCRay*>(arguments->ray);
  const unsigned int splat = reinterpret_cast<const RTCHit*>(arguments->hit)->primID;
  if (!covers(attached, splat, query, ray))
  {
    arguments->valid[0] = 0;
    return;
  }
  query.candidates->add(
    { ray.tfar, query.squaredRadius, splat, attached.index, query.clip < 0.0f });
  query.limit = std::min(
    query.limit, ray.tfar + attached.splats->depth(splat) + query.candidates->scene->LargestDepth);
  // Embree goes on with what is nearer than this.
  ray.tfar = query.limit;
}

//------------------------------------------------------------------------------
void SplatScene::occlude(const RTCFilterFunctionNArguments* arguments)
{
  auto& query = *reinterpret_cast<Query*>(arguments->context);
  const auto& attached = *static_cast<const Attached*>(arguments->geometryUserPtr);
  const auto& ray = *reinterpret_cast<const RTCRay*>(arguments->ray);
  const unsigned int splat = reinterpret_cast<const RTCHit*>(arguments->hit)->primID;
  if (!covers(attached, splat, query, ray))
  {
    arguments->valid[0] = 0;
  }
}

//------------------------------------------------------------------------------
Hit SplatScene::closest(const Ray& ray, const Departure& departure, unsigned int mask) const
{
  Candidates candidates;
  candidates.scene = this;
  Query query;
  embree::initialize(query.context);
  query.departure = &departure;
  query.candidates = &candidates;
  // Beyond the end of the ray there may be splats that are blended with those before it.
  query.limit = ray.farthest + this->LargestDepth;
  RTCRayHit embree{};
  embree.ray = embree::rayOf(ray, mask);
  embree.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  embree::intersect(this->Scene.get(), query.context, embree);
  const auto end = candidates.items.begin() + static_cast<std::ptrdiff_t>(candidates.count);
  std::sort(candidates.items.begin(), end);
  return blended(candidates, ray);
}

//------------------------------------------------------------------------------
bool SplatScene::isOccluded(const Ray& ray, const Departure& departure, unsigned int mask) const
{
  Query query;
  embree::initialize(query.context);
  query.departure = &departure;
  RTCRay embree = embree::rayOf(ray, mask);
  embree::occlude(this->Scene.get(), query.context, embree);
  return embree.tfar < 0.0f;
}

//------------------------------------------------------------------------------
Hit SplatScene::blended(const Candidates& candidates, const Ray& ray)
{
  const Candidate* const items = candidates.items.data();
  const Candidate* const end = items + candidates.count;
  Hit nearest;
  for (unsigned int index = 0; index < candidates.scene->Geometries.size(); ++index)
  {
    const Splats& splats = *candidates.scene->Geometries[index]->splats;
    const auto isOfSurface = [index](const Candidate& item) { return item.surface == index; };
    const Candidate* const first = std::find_if(items, end, isOfSurface);
    float limit = std::numeric_limits<float>::infinity();
    for (const Candidate* item = first; item != end; ++item)
    {
      limit =
        isOfSurface(*item) ? std::min(limit, item->distance + splats.depth(item->splat)) : limit;
    }
    if (first == end)
    {
      continue;
    }
    Blend blend(splats, *first);
    for (const Candidate* item = first; item != end && item->distance <= limit; ++item)
    {
      if (isOfSurface(*item) && dot(splats.normal(item->splat), splats.normal(first->splat)) > 0.0f)
      {
        blend.add(splats, *item, ray);
      }
    }
    if (blend.weight > 0.0f && blend.distance / blend.weight < nearest.distance)
    {
      nearest = blend.hit(splats, ray.direction);
    }
  }
  return nearest;
}

} // namespace raytracing
