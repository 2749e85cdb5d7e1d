// SPDX-License-Identifier: GPL-3.0-or-later
// The C library: the meshes of splats.
#include "LibraryTesting.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

using namespace librarytesting;

// A field that is the same at all points is the same at all vertices; one that differs lies between
// those of its points.
TEST(Library, FieldsAreAveragedAtTheVerticesOfSplats)
{
  const Surface surface = Extractor(Cloud()).extract();
  ASSERT_EQ(isopoint_make_splat_mesh(surface.get(), 1.0), ISOPOINT_OK);
  const auto points = numbersOf<std::int64_t>(surface, ISOPOINT_ARRAY_SPLAT_VERTEX_POINTS);
  ASSERT_FALSE(points.empty());
  std::vector<float> numbers(2 * numbersOf<double>(surface, ISOPOINT_ARRAY_ISOVALUES).size());
  for (std::size_t i = 0; i < numbers.size(); i += 2)
  {
    numbers[i] = 3.5f;
    numbers[i + 1] = static_cast<float>(i);
  }
  const isopoint_array ofPoints = arrayOf(numbers, ISOPOINT_FLOAT, 2);
  std::vector<float> means(2 * points.size());
  ASSERT_EQ(average(surface, ofPoints, means), ISOPOINT_OK);
  std::size_t mixed = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_EQ(means[2 * i], 3.5f);
    mixed += means[2 * i + 1] != static_cast<float>(2 * points[i]) ? 1 : 0;
  }
  EXPECT_GT(mixed, points.size() / 4);
}

TEST(Library, KeptSplatsYieldTheSameMesh)
{
  const Surface surface = Extractor(Cloud()).extract();
  ASSERT_EQ(isopoint_make_splat_mesh(surface.get(), 0.9), ISOPOINT_OK);
  KeptSplats kept(surface);
  const Surface again = kept.mesh(0.9);
  EXPECT_EQ(numbersOf<double>(again, ISOPOINT_ARRAY_SPLAT_VERTICES),
    numbersOf<double>(surface, ISOPOINT_ARRAY_SPLAT_VERTICES));
  const auto triangles = numbersOf<std::int64_t>(again, ISOPOINT_ARRAY_SPLAT_TRIANGLES);
  EXPECT_EQ(triangles, numbersOf<std::int64_t>(surface, ISOPOINT_ARRAY_SPLAT_TRIANGLES));
  ASSERT_FALSE(triangles.empty());
  std::vector<float> means(
    3 * numbersOf<std::int64_t>(again, ISOPOINT_ARRAY_SPLAT_VERTEX_POINTS).size());
  const isopoint_array normals = arrayOf(kept.normals, ISOPOINT_FLOAT, 3);
  EXPECT_EQ(average(again, normals, means), ISOPOINT_OK);

  isopoint_surface* created = nullptr;
  expectInvalid(average(again, normals, means = { 0.0f }),
    "The memory for the result has 4 bytes. Pass ", ISOPOINT_INVALID_ARRAY);
  std::vector<double> values;
  const isopoint_array none = arrayOf(values, ISOPOINT_DOUBLE, 1);
  expectInvalid(
    interpolate(again, none, values), "made by isopoint_create_surface()", ISOPOINT_INVALID_ORDER);
  expectInvalid(isopoint_join_messages(again.get(), surface.get()), "isopoint_extract()");
  const std::vector<std::int32_t> integers{ 0, 0, 0 };
  const isopoint_array rounded = arrayOf(integers, ISOPOINT_INT32, 3);
  expectInvalid(isopoint_create_surface(&rounded, &normals, &normals, &normals, &created),
    "Pass float or double", ISOPOINT_INVALID_ARRAY);
  expectInvalid(kept.create(&created, 1), "normals", ISOPOINT_INVALID_ARRAY);
  expectInvalid(kept.create(nullptr));
  kept.axes.resize(kept.axes.size() - 3);
  expectInvalid(kept.create(&created), "splat axes", ISOPOINT_INVALID_ARRAY);
}

TEST(Library, KeptSplatsThatAreNotFiniteAreNotDrawn)
{
  KeptSplats kept(Extractor(Cloud()).extract());
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  kept.points[0] = nan;
  kept.points[4] = infinity;
  kept.normals[6] = static_cast<float>(nan);
  kept.axes[9] = static_cast<float>(infinity);
  kept.polygons[160] = static_cast<float>(nan);
  const auto drawn = numbersOf<std::int64_t>(kept.mesh(1.0), ISOPOINT_ARRAY_SPLAT_VERTEX_POINTS);
  ASSERT_FALSE(drawn.empty());
  EXPECT_EQ(*std::min_element(drawn.begin(), drawn.end()), 5);
}
