// SPDX-License-Identifier: GPL-3.0-or-later
// The ray tracer without VTK: random numbers, materials, where rays meet surfaces, and pictures.
#include "Core/Base/Threads.h"
#include "Tracer/Picture.h"
#include "Tracer/Surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <set>

using namespace raytracing;

namespace
{

/// The triangles of a sphere around the origin, with its normals: rows from pole to pole of twice
/// as many columns.
std::shared_ptr<Surface> tracedSphere(std::uint32_t rows, float radius)
{
  auto sphere = std::make_shared<Surface>();
  const std::uint32_t columns = 2 * rows;
  for (std::uint32_t row = 0; row <= rows; ++row)
  {
    for (std::uint32_t column = 0; column < columns; ++column)
    {
      const float height = 3.14159265f * static_cast<float>(row) / static_cast<float>(rows);
      const float turn = 6.2831853f * static_cast<float>(column) / static_cast<float>(columns);
      const Vector normal{ std::sin(height) * std::cos(turn), std::sin(height) * std::sin(turn),
        std::cos(height) };
      sphere->normals.push_back(normal);
      sphere->vertices.push_back(radius * normal);
      if (row < rows)
      {
        const std::uint32_t first = row * columns;
        const std::uint32_t next = (column + 1) % columns;
        const std::uint32_t below = first + columns;
        sphere->triangles.push_back({ first + column, below + column, below + next });
        sphere->triangles.push_back({ first + column, below + next, first + next });
      }
    }
  }
  return sphere;
}

/// A square around the origin, which faces along z.
std::shared_ptr<Surface> squareOf(float side, float height)
{
  auto square = std::make_shared<Surface>();
  const float half = 0.5f * side;
  square->vertices = { { -half, -half, height }, { half, -half, height }, { half, half, height },
    { -half, half, height } };
  square->triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  return square;
}

Illuminants whiteSurroundings(int maxBounces)
{
  Illuminants illuminants;
  illuminants.environment.bottom = illuminants.environment.top = { 1.0f, 1.0f, 1.0f };
  illuminants.maxBounces = maxBounces;
  return illuminants;
}

Illuminants oneLight(const Vector& diffuse = { 1.0f, 1.0f, 1.0f })
{
  Illuminants illuminants;
  illuminants.lights.emplace_back();
  illuminants.lights[0].diffuse = diffuse;
  return illuminants;
}

/// A camera that looks along -z at a square of this width.
Camera cameraOf(double width)
{
  const auto windowAt = [width](double z) {
    return Window{ { -0.5 * width, -0.5 * width, z }, { width, 0.0, 0.0 }, { 0.0, width, 0.0 } };
  };
  return { windowAt(2.0), windowAt(-2.0) };
}

/// A pixel half of which shows a square in light of this color.
Radiance halfCovered(const Vector& light, std::uint32_t samples)
{
  const Scene scene({ squareOf(0.177f, 0.0f) });
  const Illuminants illuminants = oneLight(light);
  Picture picture(1, 1, samples);
  picture.addSamples({}, cameraOf(0.25), PathTracer(scene, illuminants), samples);
  return picture.pixel(0);
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

TEST(Scene, MeetsTheSphere)
{
  const auto sphere = tracedSphere(100, 0.5f);
  const Scene scene({ sphere });
  for (int i = 0; i < 200; ++i)
  {
    const auto t = static_cast<float>(i);
    const Vector side = directionOf({ std::sin(t), std::cos(1.7f * t), std::sin(2.3f * t + 1.0f) });
    const Hit hit = scene.closest({ 2.0f * side, -side });
    ASSERT_EQ(hit.surface, sphere.get());
    EXPECT_NEAR(hit.distance, 1.5f, 3e-4f);
    EXPECT_GT(dot(hit.normal, side), 1.0f - 1e-6f);
  }
  EXPECT_EQ(scene.closest({ { 2.0f, 0.6f, 0.0f }, { -1.0f, 0.0f, 0.0f } }).surface, nullptr);
}

TEST(Scene, RaysLeaveTheirSurfaceAndMeetItAgain)
{
  const Scene scene({ tracedSphere(100, 0.5f) });
  const Hit first = scene.closest({ { 0.01f, 0.02f, 2.0f }, { 0.0f, 0.0f, -1.0f } });
  const Vector place{ 0.01f, 0.02f, 2.0f - first.distance };
  for (const float slant : { 0.1f, 1.0f, 10.0f })
  {
    const Vector out = directionOf({ 1.0f, 0.3f, slant });
    EXPECT_EQ(scene.closest({ place, out, nearestDistance }).surface, nullptr)
      << "outwards, " << slant;
    const Vector in = directionOf({ 1.0f, 0.3f, -slant });
    const Hit second = scene.closest({ place, in, nearestDistance });
    ASSERT_NE(second.surface, nullptr) << "inwards, " << slant;
    EXPECT_NEAR(second.distance, -2.0f * dot(place, in), 2e-3f) << "inwards, " << slant;
  }
}

TEST(Scene, ColorsOfVerticesAndOfTriangles)
{
  const auto square = squareOf(1.0f, 0.0f);
  square->colors = { { 255, 0, 0, 255 }, { 255, 0, 0, 255 }, { 0, 255, 0, 255 },
    { 0, 255, 0, 255 } };
  const Ray middle{ { 0.2f, 0.0f, 1.0f }, { 0.0f, 0.0f, -1.0f } };
  const Hit interpolated = Scene({ square }).closest(middle);
  EXPECT_NEAR(interpolated.color.x, 0.5f, 1e-6f);
  EXPECT_NEAR(interpolated.color.y, 0.5f, 1e-6f);
  square->colors = { { 255, 0, 0, 255 }, { 0, 0, 255, 51 } };
  square->colorsOfTriangles = true;
  const Hit upper = Scene({ square }).closest({ { -0.2f, 0.2f, 1.0f }, { 0.0f, 0.0f, -1.0f } });
  EXPECT_EQ(upper.color.z, 1.0f);
  EXPECT_NEAR(upper.opacity, 0.2f, 1e-6f);
}

TEST(Scene, LightPassesTransparentSurfaces)
{
  const auto near = squareOf(1.0f, 0.5f);
  near->material.opacity = 0.25f;
  const auto far = squareOf(1.0f, -0.5f);
  far->material.opacity = 0.5f;
  const Ray ray{ { 0.1f, 0.2f, 1.0f }, { 0.0f, 0.0f, -1.0f } };
  EXPECT_NEAR(Scene({ near, far }).transmittance(ray).x, 0.375f, 1e-6f);
  far->material.opacity = 1.0f;
  EXPECT_EQ(Scene({ near, far }).transmittance(ray).x, 0.0f);
}

TEST(Surface, OrientationOfClosedSurfaces)
{
  const auto sphere = tracedSphere(10, 0.3f);
  for (Vector& vertex : sphere->vertices)
  {
    vertex += { 5.0f, 0.0f, 0.0f };
  }
  EXPECT_EQ(orientationOf(*sphere), 1.0f);
  for (Vector& normal : sphere->normals)
  {
    normal = -normal;
  }
  EXPECT_EQ(orientationOf(*sphere), -1.0f);
}

TEST(Absorption, IsThatOfBeerAndLambert)
{
  Surface glass;
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
  const Illuminants illuminants = whiteSurroundings(40);
  for (const float metallic : { 0.0f, 1.0f })
  {
    const auto sphere = tracedSphere(60, 0.5f);
    sphere->material.isPhysical = true;
    sphere->material.metallic = metallic;
    sphere->material.opacity = 0.0f;
    const Scene scene({ sphere });
    Picture picture(16, 16, 64);
    EXPECT_TRUE(picture.addSamples({}, cameraOf(0.6), PathTracer(scene, illuminants), 64));
    for (std::size_t i = 0; i < 256; ++i)
    {
      EXPECT_NEAR(picture.pixel(i).color.y, 1.0f, 0.02f) << "metallic " << metallic;
      EXPECT_EQ(picture.pixel(i).alpha, 1.0f);
    }
  }
}

TEST(PathTracer, NoLightArrivesAfterTheLastBounce)
{
  const auto sphere = tracedSphere(40, 0.5f);
  sphere->material.isPhysical = true;
  sphere->material.metallic = 1.0f;
  const Scene scene({ sphere });
  const Sampler sampler(0, 0, 1);
  const Ray ray{ { 0.0f, 0.0f, 2.0f }, { 0.0f, 0.0f, -1.0f } };
  EXPECT_EQ(PathTracer(scene, whiteSurroundings(0)).along(ray, sampler).color.x, 0.0f);
  EXPECT_NEAR(PathTracer(scene, whiteSurroundings(1)).along(ray, sampler).color.x, 1.0f, 1e-3f);
}

TEST(Picture, NoSampleOutshinesTheOthers)
{
  const Radiance pixel = halfCovered({ 100.0f, 100.0f, 100.0f }, 400); // times white
  EXPECT_NEAR(pixel.color.x, pixel.alpha, 1e-4f);
  EXPECT_NEAR(pixel.alpha, 0.5f, 0.05f);
}

TEST(Picture, APathWithoutAColorSpoilsNoPixel)
{
  const Radiance pixel = halfCovered({ std::nanf(""), 1.0f, 1.0f }, 16);
  EXPECT_TRUE(std::isfinite(pixel.color.x) && std::isfinite(pixel.color.y) &&
              std::isfinite(pixel.color.z) && std::isfinite(pixel.alpha));
}

TEST(Picture, EndsAndGoesOn)
{
  const auto sphere = tracedSphere(40, 0.5f);
  const Scene scene({ sphere });
  const Illuminants illuminants = oneLight();
  const PathTracer tracer(scene, illuminants);
  Picture whole(64, 64, 200);
  EXPECT_TRUE(whole.addSamples({}, cameraOf(1.2), tracer, 200));
  Picture interrupted(64, 64, 200);
  isopoint::Execution execution;
  isopoint::useThreads(execution, 3);
  int calls = 0;
  execution.isAborted = [&calls]() { return ++calls <= 2; };
  while (!interrupted.addSamples(execution, cameraOf(1.2), tracer, 200))
  {
  }
  EXPECT_EQ(interrupted.getSamples(), 200u);
  for (std::size_t i = 0; i < 64 * 64; ++i)
  {
    ASSERT_EQ(whole.pixel(i).color.x, interrupted.pixel(i).color.x);
    ASSERT_EQ(whole.pixel(i).alpha, interrupted.pixel(i).alpha);
  }
}
