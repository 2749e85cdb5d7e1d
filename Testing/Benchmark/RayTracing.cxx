// SPDX-License-Identifier: GPL-3.0-or-later
// Rays per second of one thread to the splats of a sphere, blended, and to the same discs with
// Embree alone, the nearest of which is taken: RayTracingBenchmark [SPLATS...]
#include "SplatSphere.h"

#include "Tracer/EmbreeRay.h"
#include "Tracer/Sampler.h"
#include "Tracer/SplatScene.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

using namespace raytracing;

namespace
{

constexpr std::uint32_t rays = 1000000;

/// Rays by rows of a window, or between random places around the sphere.
std::vector<Ray> raysOf(bool isCoherent)
{
  std::vector<Ray> result;
  for (std::uint32_t i = 0; i < rays; ++i)
  {
    if (isCoherent)
    {
      const float x = static_cast<float>(i % 1000) / 1000.0f - 0.5f;
      const float y = static_cast<float>(i / 1000) / 1000.0f - 0.5f;
      const Vector origin{ 0.0f, 0.0f, 2.0f };
      result.push_back({ origin, directionOf(Vector{ 1.1f * x, 1.1f * y, 0.0f } - origin) });
      continue;
    }
    const auto place = [i](std::uint32_t dimension)
    {
      const Pair pair = Sampler(1, i, rays).pair(dimension);
      const float z = 2.0f * pair.first - 1.0f;
      const float across = std::sqrt(1.0f - z * z);
      const float angle = 6.2831853f * pair.second;
      return Vector{ across * std::cos(angle), across * std::sin(angle), z };
    };
    const Vector origin = place(0);
    result.push_back({ origin, directionOf(0.4f * place(1) - origin) });
  }
  return result;
}

double seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

template <class Trace>
double pace(const std::vector<Ray>& all, const Trace& trace)
{
  std::size_t hits = 0;
  const double begin = seconds();
  for (const Ray& ray : all)
  {
    hits += trace(ray) ? 1 : 0;
  }
  const double end = seconds();
  if (hits < all.size() / 2)
  {
    std::fputs("too few rays meet the sphere\n", stderr);
    std::exit(EXIT_FAILURE);
  }
  return static_cast<double>(all.size()) / (end - begin) * 1e-6;
}

void measure(std::size_t count)
{
  const embree::Device device(rtcNewDevice(nullptr));
  const auto splats = splatSphere(count, 0.5f);
  const SplatScene blended(device.get(), { splats });

  const embree::SceneOwner plain(rtcNewScene(device.get()));
  const embree::Geometry geometry(
    rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT));
  auto* const discs = static_cast<Disc*>(rtcSetNewGeometryBuffer(
    geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sizeof(Disc), count));
  auto* const normals = static_cast<Vector*>(rtcSetNewGeometryBuffer(
    geometry.get(), RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3, sizeof(Vector), count));
  std::copy(splats->discs.begin(), splats->discs.end(), discs);
  std::copy(splats->planes.begin(), splats->planes.end(), normals);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(plain.get(), geometry.get());
  rtcCommitScene(plain.get());
  const auto nearest = [&plain](const Ray& ray)
  {
    embree::Context context;
    embree::initialize(context);
    RTCRayHit hit{};
    hit.ray = embree::rayOf(ray, embree::masks::all);
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    embree::intersect(plain.get(), context, hit);
    return hit.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  };
  const auto blend = [&blended](const Ray& ray)
  { return blended.closest(ray, Departure(), embree::masks::all).surface != nullptr; };

  for (const bool isCoherent : { true, false })
  {
    const std::vector<Ray> all = raysOf(isCoherent);
    double ratios[3];
    double paces[2] = { 0.0, 0.0 };
    for (double& ratio : ratios)
    {
      const double ofEmbree = pace(all, nearest);
      const double ofBlending = pace(all, blend);
      ratio = ofBlending / ofEmbree;
      paces[0] = std::max(paces[0], ofEmbree);
      paces[1] = std::max(paces[1], ofBlending);
    }
    std::sort(ratios, ratios + 3);
    std::printf("%zu splats, %s rays: Embree's discs %.2f million a second, blended %.2f, "
                "ratio %.2f (%.2f to %.2f)\n",
      count, isCoherent ? "coherent" : "random", paces[0], paces[1], ratios[1], ratios[0],
      ratios[2]);
  }
}

} // namespace

int main(int argc, char** argv)
{
  std::vector<std::size_t> counts = { 20000, 200000, 2000000 };
  if (argc > 1)
  {
    counts.clear();
    for (int i = 1; i < argc; ++i)
    {
      counts.push_back(static_cast<std::size_t>(std::strtoull(argv[i], nullptr, 10)));
    }
  }
  for (const std::size_t count : counts)
  {
    measure(count);
  }
  return EXIT_SUCCESS;
}
