// SPDX-License-Identifier: GPL-3.0-or-later
// The ray tracer without VTK: random numbers, materials, where rays meet splats, and pictures.
#include "SplatSphere.h"

#include "Tracer/Absorption.h"
#include "Tracer/Picture.h"

#include <gtest/gtest.h>

#include <set>

using namespace raytracing;

namespace
{

Scene sceneOf(const std::shared_ptr<const Splats>& splats)
{
  return Scene({ splats }, {});
}

/// A camera that looks along -z at a square of this width.
Camera cameraOf(double width)
{
  Camera camera;
  camera.nearCorner = { -0.5 * width, -0.5 * width, 2.0 };
  camera.farCorner = { -0.5 * width, -0.5 * width, -2.0 };
  camera.nearRight = camera.farRight = { width, 0.0, 0.0 };
  camera.nearUp = camera.farUp = { 0.0, width, 0.0 };
  return camera;
}

} // namespace

TEST(Sampler, CoversEachStratumOnce)
{
  for (const std::uint32_t count : { 1u, 2u, 7u, 64u, 100u })
  {
    for (std::uint32_t dimension = 0; dimension < 5; ++dimension)
    {
      std::set<std::uint32_t> strata;
      float shift = 0.0f;
      for (std::uint32_t sample = 0; sample < count; ++sample)
      {
        const Pair pair = Sampler(17, sample, count).pair(dimension);
        EXPECT_GE(pair.first, 0.0f);
        EXPECT_LT(pair.first, 1.0f);
        EXPECT_GE(pair.second, 0.0f);
        EXPECT_LT(pair.second, 1.0f);
        const auto scaled = static_cast<float>(count) * pair.first;
        shift = sample == 0 ? scaled - std::floor(scaled) - 0.5f : shift;
        strata.insert(
          static_cast<std::uint32_t>(std::floor(scaled - shift + static_cast<float>(count))) %
          count);
      }
      EXPECT_EQ(strata.size(), count) << "dimension " << dimension;
    }
  }
}

TEST(Material, FresnelsEquations)
{
  EXPECT_NEAR(fresnelReflectance(1.0f, 1.5f), 0.04f, 1e-6f);
  EXPECT_NEAR(fresnelReflectance(1.0f, 1.0f / 1.5f), 0.04f, 1e-6f);
  EXPECT_NEAR(fresnelReflectance(0.0f, 1.5f), 1.0f, 1e-6f);
  EXPECT_EQ(fresnelReflectance(0.5f, 1.0f / 1.5f), 1.0f); // total reflection
  EXPECT_NEAR(fresnelReflectance(0.3f, 1.0f), 0.0f, 1e-6f);
}

TEST(Material, FacetsAreSeenAsTheirDensitySays)
{
  // The mean of a facet's height over facets seen from above, and the same by integration.
  for (const float roughness : { 0.3f, 0.7f, 1.0f })
  {
    const Microfacets facets(roughness);
    double mean = 0.0;
    constexpr std::uint32_t samples = 20000;
    for (std::uint32_t i = 0; i < samples; ++i)
    {
      const Pair pair = Sampler(3, i, samples).pair(1);
      mean += facets.seenFrom({ 0.0f, 0.0f, 1.0f }, pair.first, pair.second).z / samples;
    }
    double expected = 0.0;
    constexpr int steps = 20000;
    for (int i = 0; i < steps; ++i)
    {
      const double cosine = (i + 0.5) / steps;
      expected +=
        2.0 * 3.14159265 * cosine * cosine * facets.density(static_cast<float>(cosine)) / steps;
    }
    EXPECT_NEAR(mean, expected, 2e-3) << "roughness " << roughness;
  }
}

TEST(SplatScene, MeetsTheSphere)
{
  const auto splats = splatSphere(20000, 0.5f);
  const Scene scene = sceneOf(splats);
  for (int i = 0; i < 200; ++i)
  {
    const auto t = static_cast<float>(i);
    const Vector side = directionOf({ std::sin(t), std::cos(1.7f * t), std::sin(2.3f * t + 1.0f) });
    const Ray ray{ 2.0f * side, -side };
    const Hit hit = scene.closest(ray, Departure());
    ASSERT_EQ(hit.surface, splats.get());
    EXPECT_NEAR(hit.distance, 1.5f, 3e-4f);
    EXPECT_GT(dot(hit.normal, side), 1.0f - 1e-6f);
  }
  EXPECT_EQ(
    scene.closest({ { 2.0f, 0.6f, 0.0f }, { -1.0f, 0.0f, 0.0f } }, Departure()).surface, nullptr);
}

TEST(SplatScene, RaysLeaveTheirSurfaceAndMeetItAgain)
{
  const auto splats = splatSphere(20000, 0.5f);
  const Scene scene = sceneOf(splats);
  const Hit first = scene.closest({ { 0.0f, 0.0f, 2.0f }, { 0.0f, 0.0f, -1.0f } }, Departure());
  const Vector place{ 0.0f, 0.0f, 2.0f - first.distance };
  for (const float slant : { 0.001f, 0.1f, 1.0f, 10.0f })
  {
    const Vector out = directionOf({ 1.0f, 0.3f, slant });
    EXPECT_EQ(scene.closest({ place, out, nearestDistance }, Departure(first)).surface, nullptr)
      << "outwards, " << slant;
  }
  for (const float slant : { 0.1f, 1.0f, 10.0f })
  {
    const Vector in = directionOf({ 1.0f, 0.3f, -slant });
    const Hit second = scene.closest({ place, in, nearestDistance }, Departure(first));
    ASSERT_NE(second.surface, nullptr) << "inwards, " << slant;
    EXPECT_NEAR(second.distance, -2.0f * 0.5f * in.z, 2e-3f) << "inwards, " << slant;
  }
}

TEST(SplatScene, ShowsItsOutsideBeyondTheHorizon)
{
  const auto splats = splatSphere(20000, 0.5f);
  const Scene scene = sceneOf(splats);
  int met = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const auto turn = static_cast<float>(i);
    const float height = 0.4997f + 0.0003f * static_cast<float>(i) / 1000.0f;
    const Ray ray{ { height * std::cos(turn), height * std::sin(turn), 2.0f },
      { 0.0f, 0.0f, -1.0f } };
    const Hit hit = scene.closest(ray, Departure());
    met += hit.surface && height > 0.5f ? 1 : 0;
    EXPECT_LE(hit.surface ? dot(hit.normal, ray.direction) : 0.0f, 0.0f) << "height " << height;
  }
  EXPECT_GT(met, 100); // where rims of splats stand out
}

TEST(SplatScene, KeepsTheSidesOfAThinWallApart)
{
  const auto splats = std::make_shared<Splats>();
  splats->discs = { { { 0.0f, 0.0f, 0.005f }, 0.1f }, { { 0.0f, 0.0f, -0.005f }, 0.1f } };
  splats->planes = { { 0.0f, 0.0f, 1.0f }, { 0.0f, 0.0f, -1.0f } };
  const Hit hit =
    sceneOf(splats).closest({ { 0.0f, 0.0f, 1.0f }, { 0.0f, 0.0f, -1.0f } }, Departure());
  EXPECT_NEAR(hit.distance, 0.995f, 1e-6f);
  EXPECT_NEAR(hit.normal.z, 1.0f, 1e-6f);
}

TEST(SplatScene, BlendsSplatsWithinTheBlendDepth)
{
  const auto splats = std::make_shared<Splats>();
  splats->discs = { { { 0.0f, 0.0f, 0.0f }, 0.1f }, { { 0.0f, 0.0f, -0.05f }, 0.1f },
    { { 0.0f, 0.0f, -0.15f }, 0.1f } };
  splats->planes.assign(3, { 0.0f, 0.0f, 1.0f });
  splats->colors = { { 255, 0, 0, 255 }, { 0, 255, 0, 255 }, { 0, 0, 255, 255 } };
  const Hit hit =
    sceneOf(splats).closest({ { 0.0f, 0.0f, 1.0f }, { 0.0f, 0.0f, -1.0f } }, Departure());
  EXPECT_NEAR(hit.distance, 1.025f, 1e-6f);
  EXPECT_NEAR(hit.color.x, 0.5f, 1e-6f);
  EXPECT_NEAR(hit.color.y, 0.5f, 1e-6f);
  EXPECT_EQ(hit.color.z, 0.0f);
}

TEST(Surfaces, OrientationOfClosedSurfaces)
{
  auto splats = splatSphere(100, 0.3f);
  for (Disc& disc : splats->discs)
  {
    disc.center += { 5.0f, 0.0f, 0.0f };
  }
  EXPECT_EQ(orientationOf(*splats), 1.0f);
  for (Vector& plane : splats->planes)
  {
    plane = -plane;
  }
  EXPECT_EQ(orientationOf(*splats), -1.0f);
}

TEST(Absorption, IsThatOfBeerAndLambert)
{
  Splats glass;
  glass.material.isPhysical = true;
  glass.material.opacity = 0.0f;
  glass.material.absorptionDistance = 2.0f;
  Hit hit;
  hit.surface = &glass;
  hit.color = { 0.25f, 1.0f, 0.5f };
  hit.normal = { 0.0f, 0.0f, 1.0f };
  hit.distance = 1.0f;
  EXPECT_NEAR(absorption(hit, { 0.0f, 0.0f, 1.0f }).x, 0.5f, 1e-6f);
  EXPECT_NEAR(absorption(hit, { 0.0f, 0.0f, 1.0f }).y, 1.0f, 1e-6f);
  EXPECT_EQ(absorption(hit, { 0.0f, 0.0f, -1.0f }).x, 1.0f);
}

TEST(PathTracer, WhiteSurroundingsStayWhite)
{
  // What glass and mirrors reflect and refract adds up to all light.
  Illuminants illuminants;
  illuminants.environment.bottom = illuminants.environment.top = { 1.0f, 1.0f, 1.0f };
  illuminants.mostBounces = 40;
  for (const float metallic : { 0.0f, 1.0f })
  {
    const auto splats = splatSphere(5000, 0.5f);
    splats->material.isPhysical = true;
    splats->material.metallic = metallic;
    splats->material.opacity = 0.0f;
    const Scene scene = sceneOf(splats);
    Picture picture(16, 16, 64);
    EXPECT_TRUE(picture.addSamples(
      cameraOf(0.6), PathTracer(scene, illuminants), 64, 2, [](double) { return true; }));
    for (std::size_t i = 0; i < 256; ++i)
    {
      EXPECT_NEAR(picture.pixel(i).color.y, 1.0f, 0.02f) << "metallic " << metallic;
      EXPECT_EQ(picture.pixel(i).alpha, 1.0f);
    }
  }
}

TEST(PathTracer, NoLightArrivesAfterTheLastBounce)
{
  Illuminants illuminants;
  illuminants.environment.bottom = illuminants.environment.top = { 1.0f, 1.0f, 1.0f };
  illuminants.mostBounces = 0;
  const auto splats = splatSphere(2000, 0.5f);
  splats->material.isPhysical = true;
  splats->material.metallic = 1.0f;
  const Scene scene = sceneOf(splats);
  const Sampler sampler(0, 0, 1);
  const Ray ray{ { 0.0f, 0.0f, 2.0f }, { 0.0f, 0.0f, -1.0f } };
  EXPECT_EQ(PathTracer(scene, illuminants).along(ray, sampler).color.x, 0.0f);
  illuminants.mostBounces = 1;
  EXPECT_NEAR(PathTracer(scene, illuminants).along(ray, sampler).color.x, 1.0f, 1e-3f);
}

TEST(Picture, NoSampleOutshinesTheOthers)
{
  // Half of the pixel shows a surface a hundred times as bright as white.
  const auto splats = std::make_shared<Splats>();
  splats->discs = { { { 0.0f, 0.0f, 0.0f }, 0.1f } };
  splats->planes = { { 0.0f, 0.0f, 1.0f } };
  const Scene scene = sceneOf(splats);
  Illuminants illuminants;
  illuminants.lights.emplace_back();
  illuminants.lights[0].diffuse = { 100.0f, 100.0f, 100.0f };
  Picture picture(1, 1, 400);
  picture.addSamples(
    cameraOf(0.25), PathTracer(scene, illuminants), 400, 1, [](double) { return true; });
  EXPECT_NEAR(picture.pixel(0).color.x, picture.pixel(0).alpha, 1e-4f);
  EXPECT_NEAR(picture.pixel(0).alpha, 0.5f, 0.05f);
}

TEST(Picture, EndsAndGoesOn)
{
  const auto splats = splatSphere(2000, 0.5f);
  const Scene scene = sceneOf(splats);
  Illuminants illuminants;
  illuminants.lights.emplace_back();
  const PathTracer tracer(scene, illuminants);
  Picture whole(64, 64, 200);
  EXPECT_TRUE(whole.addSamples(cameraOf(1.2), tracer, 200, 1, [](double) { return true; }));
  Picture interrupted(64, 64, 200);
  int calls = 0;
  while (!interrupted.addSamples(
    cameraOf(1.2), tracer, 200, 3, [&calls](double) { return ++calls > 2; }))
  {
  }
  EXPECT_EQ(interrupted.getSamples(), 200u);
  for (std::size_t i = 0; i < 64 * 64; ++i)
  {
    ASSERT_EQ(whole.pixel(i).color.x, interrupted.pixel(i).color.x);
    ASSERT_EQ(whole.pixel(i).alpha, interrupted.pixel(i).alpha);
  }
}
