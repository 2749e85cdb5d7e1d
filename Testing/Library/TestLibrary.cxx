// SPDX-License-Identifier: GPL-3.0-or-later
// The C library through its header alone, as programs use it: surfaces and messages.
#include "LibraryTesting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

using namespace librarytesting;

TEST(Library, ExtractsASphere)
{
  const Extractor extractor(Cloud(6000));
  EXPECT_EQ(isopoint_get_sample_count(extractor.get()), 6000);
  for (const isopoint_options& options : { defaults, withTriangles })
  {
    const Surface surface = extractor.extract({ 0.7 }, options);
    const auto points = numbersOf<double>(surface, ISOPOINT_ARRAY_POINTS);
    const auto normals = numbersOf<float>(surface, ISOPOINT_ARRAY_NORMALS);
    ASSERT_GT(points.size(), 1500u);
    ASSERT_EQ(points.size(), normals.size());
    for (std::size_t i = 0; i < points.size(); i += 3)
    {
      EXPECT_NEAR(std::hypot(points[i], points[i + 1], points[i + 2]), 0.7, 0.02);
      double outward = 0.0;
      for (std::size_t k = i; k < i + 3; ++k)
      {
        outward += points[k] * static_cast<double>(normals[k]) / 0.7;
      }
      EXPECT_LT(outward, -0.9); // values decrease inward
    }
    EXPECT_EQ(isopoint_get_message(surface.get(), 0, nullptr), nullptr);
  }
}

// The recipe of isopoint.h.
TEST(Library, SlicesABlock)
{
  Cloud cloud(20000);
  const std::vector<double> distances = cloud.values;
  for (std::size_t i = 0; i < cloud.values.size(); ++i)
  {
    cloud.values[i] = cloud.positions[3 * i];
  }
  const Extractor extractor(cloud);
  const auto sliced = [&](std::int32_t keepsHullSlivers, std::int32_t regularizes = 1)
  {
    isopoint_options options = withTriangles;
    options.projection = ISOPOINT_PROJECTION_NONE;
    options.compute_normals = 0;
    options.keep_hull_slivers = keepsHullSlivers;
    options.regularize = regularizes;
    return extractor.extract({ 0.3 }, options);
  };
  const auto areaOf = [](const Surface& surface)
  {
    const auto points = numbersOf<double>(surface, ISOPOINT_ARRAY_POINTS);
    const auto corners = numbersOf<std::int64_t>(surface, ISOPOINT_ARRAY_TRIANGLES);
    const auto at = [&](std::size_t corner, std::size_t axis)
    { return points[3 * static_cast<std::size_t>(corners[corner]) + axis]; };
    double area = 0.0;
    for (std::size_t i = 0; i < corners.size(); i += 3)
    {
      area += 0.5 * std::abs((at(i + 1, 1) - at(i, 1)) * (at(i + 2, 2) - at(i, 2)) -
                             (at(i + 1, 2) - at(i, 2)) * (at(i + 2, 1) - at(i, 1)));
    }
    return area;
  };
  const Surface slice = sliced(1);
  EXPECT_NEAR(areaOf(slice), 4.0, 0.04);
  EXPECT_NEAR(
    areaOf(slice), areaOf(sliced(1, 0)), 1e-12); // no triangle is turned over, the rim stays
  EXPECT_LT(areaOf(sliced(0)), 3.96);            // the rim is frayed
  const isopoint_array points = arrayOf(slice, ISOPOINT_ARRAY_POINTS);
  const isopoint_array array = arrayOf(distances, ISOPOINT_DOUBLE, 1);
  std::vector<double> fitted(static_cast<std::size_t>(points.count));
  const isopoint_probe_result result = resultIn(fitted);
  isopoint_probe_options options;
  isopoint_initialize_probe_options(&options, sizeof(options));
  options.outside = ISOPOINT_PROBE_OUTSIDE_EXTRAPOLATE;
  ASSERT_EQ(isopoint_probe(extractor.get(), &points, &array, 1, &options, &result, nullptr, 0),
    ISOPOINT_OK);
  const auto places = numbersOf<double>(slice, ISOPOINT_ARRAY_POINTS);
  for (std::size_t i = 0; i < fitted.size(); ++i)
  {
    EXPECT_NEAR(places[3 * i], 0.3, 1e-14);
    const double distance = std::hypot(places[3 * i], places[3 * i + 1], places[3 * i + 2]);
    EXPECT_NEAR(fitted[i], distance, 0.01);
  }
}

TEST(Library, ResultsDependOnNeitherThreadsNorWhatWasExtractedBefore)
{
  const Cloud cloud;
  const Extractor one;
  ASSERT_EQ(isopoint_set_extractor_threads(one.get(), 1), ISOPOINT_OK);
  ASSERT_EQ(cloud.load(one.get()), ISOPOINT_OK);
  const Extractor many(cloud);
  many.extract({ 0.4 });
  many.extract({ 0.45 }, withTriangles);
  for (const isopoint_options& options : { defaults, withTriangles })
  {
    EXPECT_EQ(bytesOf(one.extract({ 0.7, 0.5 }, options)),
      bytesOf(many.extract({ 0.5, 0.7, 0.5 }, options)));
  }
}

TEST(Library, SurfacesOutliveTheirExtractor)
{
  const Cloud cloud;
  auto extractor = std::make_unique<Extractor>(cloud);
  const Surface surface = extractor->extract();
  const std::string bytes = bytesOf(surface);
  extractor.reset();
  EXPECT_EQ(bytesOf(surface), bytes);
  const isopoint_array values = cloud.valueArray();
  std::vector<double> result(numbersOf<double>(surface, ISOPOINT_ARRAY_ISOVALUES).size());
  ASSERT_EQ(interpolate(surface, values, result), ISOPOINT_OK);
  ASSERT_EQ(isopoint_make_splat_mesh(surface.get(), 1.0), ISOPOINT_OK);
}

TEST(Library, StridesMayBeAnyEvenNegative)
{
  const Cloud cloud;
  const std::size_t count = cloud.values.size();
  // The same samples, from the last to the first and in columns.
  std::vector<double> columns(4 * count);
  for (std::size_t i = 0; i < 4 * count; ++i)
  {
    const std::size_t sample = count - 1 - i % count;
    columns[i] = i < 3 * count ? cloud.positions[3 * sample + i / count] : cloud.values[sample];
  }
  constexpr auto size = static_cast<std::int64_t>(sizeof(double));
  const auto tuples = static_cast<std::int64_t>(count);
  const isopoint_array positions{ columns.data() + count - 1, ISOPOINT_DOUBLE, 3, tuples, -size,
    tuples * size };
  const isopoint_array values{ columns.data() + 4 * count - 1, ISOPOINT_DOUBLE, 1, tuples, -size,
    0 };
  const Extractor strided;
  ASSERT_EQ(isopoint_set_samples(strided.get(), &positions, &values, nullptr), ISOPOINT_OK);
  EXPECT_EQ(bytesOf(Extractor(cloud).extract()), bytesOf(strided.extract()));
}

namespace
{

template <class T>
void expectSameAsDouble(isopoint_type type)
{
  SCOPED_TRACE(type);
  Cloud cloud;
  std::vector<T> typed;
  for (double& value : cloud.values)
  {
    typed.push_back(static_cast<T>(60.0 * value));
    value = static_cast<double>(typed.back());
  }
  const isopoint_array positions = cloud.positionArray();
  const isopoint_array values = arrayOf(typed, type, 1);
  const Extractor extractor;
  ASSERT_EQ(isopoint_set_samples(extractor.get(), &positions, &values, nullptr), ISOPOINT_OK);
  double range[2];
  isopoint_get_value_range(extractor.get(), range);
  const auto [least, greatest] = std::minmax_element(cloud.values.begin(), cloud.values.end());
  EXPECT_EQ(range[0], *least);
  EXPECT_EQ(range[1], *greatest);

  const Surface surface = extractor.extract({ 40.5 });
  const auto edges = numbersOf<std::int64_t>(surface, ISOPOINT_ARRAY_EDGES);
  const auto parameters = numbersOf<double>(surface, ISOPOINT_ARRAY_EDGE_PARAMETERS);
  ASSERT_GT(parameters.size(), 500u);
  std::vector<T> result(parameters.size());
  ASSERT_EQ(interpolate(surface, values, result), ISOPOINT_OK);
  for (std::size_t i = 0; i < parameters.size(); ++i)
  {
    const double first = cloud.values[static_cast<std::size_t>(edges[2 * i])];
    const double second = cloud.values[static_cast<std::size_t>(edges[2 * i + 1])];
    EXPECT_NE(first < 40.5, second < 40.5);
    const double value = (1.0 - parameters[i]) * first + parameters[i] * second;
    EXPECT_NEAR(static_cast<double>(result[i]), value, 0.5000001);
  }
}

} // namespace

TEST(Library, ValuesMayBeOfAllTypes)
{
  expectSameAsDouble<float>(ISOPOINT_FLOAT);
  expectSameAsDouble<double>(ISOPOINT_DOUBLE);
  expectSameAsDouble<std::int8_t>(ISOPOINT_INT8);
  expectSameAsDouble<std::uint8_t>(ISOPOINT_UINT8);
  expectSameAsDouble<std::int16_t>(ISOPOINT_INT16);
  expectSameAsDouble<std::uint16_t>(ISOPOINT_UINT16);
  expectSameAsDouble<std::int32_t>(ISOPOINT_INT32);
  expectSameAsDouble<std::uint32_t>(ISOPOINT_UINT32);
  expectSameAsDouble<std::int64_t>(ISOPOINT_INT64);
  expectSameAsDouble<std::uint64_t>(ISOPOINT_UINT64);
}

TEST(Library, ExcludedAndInvalidSamplesTakeNoPart)
{
  Cloud cloud;
  std::vector<std::uint8_t> excluded(cloud.values.size(), 0);
  for (std::size_t i = 0; i < excluded.size(); i += 10)
  {
    excluded[i] = 1;
  }
  cloud.values[5] = std::nan("");
  const Extractor extractor;
  ASSERT_EQ(cloud.load(extractor.get(), excluded), ISOPOINT_OK);
  EXPECT_EQ(isopoint_get_skipped_count(extractor.get()), 501);
  EXPECT_EQ(isopoint_get_sample_count(extractor.get()), 4499);
  const Surface surface = extractor.extract();
  for (const std::int64_t sample : numbersOf<std::int64_t>(surface, ISOPOINT_ARRAY_EDGES))
  {
    EXPECT_TRUE(sample % 10 != 0 && sample != 5) << sample;
  }
  std::int32_t isWarning = -1;
  const char* const message = isopoint_get_message(surface.get(), 0, &isWarning);
  ASSERT_NE(message, nullptr);
  for (const char* const part : { "501 of 5000", "1 not finite", "500 excluded" })
  {
    expectContains(message, part);
  }
  EXPECT_EQ(isWarning, 0);
  EXPECT_EQ(isopoint_get_message_code(surface.get(), 0), ISOPOINT_MESSAGE_SKIPPED_SAMPLES);
  EXPECT_EQ(isopoint_get_message(surface.get(), 1, nullptr), nullptr);
  EXPECT_EQ(isopoint_get_message_code(surface.get(), 1), 0);
}

TEST(Library, AnEmptySurfaceIsExplained)
{
  const Extractor extractor((Cloud()));
  const Surface outside = extractor.extract({ 9.125 });
  EXPECT_TRUE(numbersOf<double>(outside, ISOPOINT_ARRAY_POINTS).empty());
  std::int32_t isWarning = 0;
  expectContains(isopoint_get_message(outside.get(), 0, &isWarning), "9.125");
  EXPECT_EQ(isWarning, 1);
  EXPECT_EQ(isopoint_get_message_code(outside.get(), 0), ISOPOINT_MESSAGE_ISOVALUE_OUTSIDE);

  const Cloud cloud(10);
  ASSERT_EQ(cloud.load(extractor.get(), std::vector<std::uint8_t>(10, 1)), ISOPOINT_OK);
  const Surface none = extractor.extract();
  ASSERT_NE(isopoint_get_message(none.get(), 0, nullptr), nullptr);
  expectContains(isopoint_get_message(none.get(), 0, nullptr), "All samples are excluded");
  EXPECT_EQ(isopoint_get_message_code(none.get(), 0), ISOPOINT_MESSAGE_NO_SAMPLES);
  const isopoint_array values = cloud.valueArray();
  EXPECT_EQ(isopoint_interpolate(none.get(), &values, nullptr, 0), ISOPOINT_OK);
  isopoint_get_value_range(extractor.get(), nullptr);
}

TEST(Library, EachReasonOfAnEmptySurfaceHasACode)
{
  const auto codeOf =
    [](const Cloud& cloud, double isovalue, const isopoint_options& options = withTriangles)
  {
    const Surface surface = Extractor(cloud).extract({ isovalue }, options);
    EXPECT_EQ(arrayOf(surface, ISOPOINT_ARRAY_POINTS).count, 0);
    EXPECT_NE(isopoint_get_message(surface.get(), 0, nullptr), nullptr);
    return isopoint_get_message_code(surface.get(), 0);
  };
  const Cloud few(3);
  EXPECT_EQ(codeOf(few, (few.values[0] + few.values[1]) / 2.0), ISOPOINT_MESSAGE_TOO_FEW_SAMPLES);
  Cloud cloud;
  const double greatest = *std::max_element(cloud.values.begin(), cloud.values.end());
  EXPECT_EQ(codeOf(cloud, greatest), ISOPOINT_MESSAGE_ISOVALUE_AT_END);
  for (std::size_t i = 2; i < cloud.positions.size(); i += 3)
  {
    cloud.positions[i] = 0.0;
  }
  EXPECT_EQ(codeOf(cloud, 0.7), ISOPOINT_MESSAGE_NO_CROSSING);
  std::fill(cloud.values.begin(), cloud.values.end(), 0.7);
  EXPECT_EQ(codeOf(cloud, 0.7), ISOPOINT_MESSAGE_CONSTANT_VALUES);
}

// Known by the options. A slice may be beside the samples if another one is not.
TEST(Library, SlicesAndBodiesHaveTheirOwnMessages)
{
  const auto slicing = optionsWith(
    [](isopoint_options& options)
    {
      options.triangles = options.keep_hull_slivers = 1;
      options.projection = ISOPOINT_PROJECTION_NONE;
    });
  isopoint_options closing = slicing;
  closing.capping = 1;
  closing.keep_hull_slivers = 0;
  const auto expectMessage = [](const Cloud& cloud, const std::vector<double>& isovalues,
                               const isopoint_options& options, const std::string& text,
                               std::int32_t code)
  {
    const Surface surface = Extractor(cloud).extract(isovalues, options);
    const char* const message = isopoint_get_message(surface.get(), 0, nullptr);
    expectContains(message ? message : "", text);
    EXPECT_EQ(isopoint_get_message_code(surface.get(), 0), code);
    EXPECT_EQ(isopoint_get_message(surface.get(), 1, nullptr), nullptr);
  };
  const Cloud cloud;
  const auto [least, greatest] = std::minmax_element(cloud.values.begin(), cloud.values.end());
  expectMessage(cloud, { 0.7, 9.0 }, slicing, "", 0);
  expectMessage(cloud, { 9.0 }, slicing, "No slice: all samples are on one side of it.",
    ISOPOINT_MESSAGE_ISOVALUE_OUTSIDE);
  expectMessage(cloud, { *least }, slicing, "No slice: samples on it count as above it",
    ISOPOINT_MESSAGE_ISOVALUE_OUTSIDE);
  expectMessage(cloud, { *greatest, 0.7 }, slicing, "", 0); // nothing is at the greatest value
  Cloud level; // at and beyond 0.7, with a range that double does not hold
  for (double& value : level.values)
  {
    value = value < 0.7 ? -1e308 : 1e308;
  }
  expectMessage(level, { 1e308 }, slicing, "The slice is only where samples are on it",
    ISOPOINT_MESSAGE_ONLY_AT_SAMPLES);
  expectMessage(level, { 0.0 }, slicing, "", 0);
  expectMessage(
    cloud, {}, slicing, "No slice: there are no offsets.", ISOPOINT_MESSAGE_NO_ISOVALUES);
  expectMessage(cloud, {}, withTriangles, "No isosurface: there are no isovalues. Set one.",
    ISOPOINT_MESSAGE_NO_ISOVALUES);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  expectMessage(Cloud(3), { -infinity }, closing, "No body: there are only 3 samples.",
    ISOPOINT_MESSAGE_TOO_FEW_SAMPLES);
  expectMessage(cloud, { -infinity }, closing, "", 0);
}

TEST(Library, LengthsThatOverflowFloatAreExplained)
{
  const auto messageAt = [](double scale, const isopoint_options& options)
  {
    Cloud cloud;
    for (double& coordinate : cloud.positions)
    {
      coordinate *= scale;
    }
    const Surface surface = Extractor(cloud).extract({ 0.7 }, options);
    EXPECT_GT(arrayOf(surface, ISOPOINT_ARRAY_POINTS).count, 100);
    const char* const message = isopoint_get_message(surface.get(), 0, nullptr);
    EXPECT_EQ(
      isopoint_get_message_code(surface.get(), 0), message ? ISOPOINT_MESSAGE_BEYOND_FLOAT : 0);
    return std::string(message ? message : "");
  };
  const auto single = optionsWith(
    [](isopoint_options& options)
    {
      options.output_points_precision = ISOPOINT_PRECISION_SINGLE;
      options.compute_splats = 0;
    });
  for (const double scale : { 1e-300, 1e300 })
  {
    expectContains(messageAt(scale, defaults), "float cannot hold");
    EXPECT_EQ(messageAt(scale, withTriangles), "");
  }
  expectContains(messageAt(1e300, single), "float cannot hold");
  EXPECT_EQ(messageAt(1e30, defaults), "");
  EXPECT_EQ(messageAt(1e30, single), "");
}

TEST(Library, CloudsWithoutSamplesHaveEmptySurfaces)
{
  const isopoint_array positions{ nullptr, ISOPOINT_FLOAT, 3, 0, 0, 0 };
  const isopoint_array values{ nullptr, ISOPOINT_FLOAT, 1, 0, 0, 0 };
  const Extractor extractor;
  ASSERT_EQ(isopoint_set_samples(extractor.get(), &positions, &values, nullptr), ISOPOINT_OK);
  double range[2];
  isopoint_get_value_range(extractor.get(), range);
  EXPECT_TRUE(std::isnan(range[0]) && std::isnan(range[1]));
  const Surface surface = extractor.extract();
  EXPECT_TRUE(numbersOf<float>(surface, ISOPOINT_ARRAY_POINTS).empty());
  EXPECT_EQ(isopoint_make_splat_mesh(surface.get(), 1.0), ISOPOINT_OK);
  EXPECT_TRUE(numbersOf<std::int64_t>(surface, ISOPOINT_ARRAY_SPLAT_TRIANGLES).empty());
  EXPECT_TRUE(numbersOf<double>(extractor.extract({}), ISOPOINT_ARRAY_ISOVALUES).empty());
}

TEST(Library, MessagesHaveTheKeyOfTheirCause)
{
  Cloud cloud;
  const Extractor extractor(cloud);
  const auto messageAndKey = [&](double isovalue)
  {
    const Surface surface = extractor.extract({ isovalue });
    EXPECT_EQ(isopoint_get_message_cause(surface.get(), 1), nullptr);
    return std::array<std::string, 2>{ isopoint_get_message(surface.get(), 0, nullptr),
      isopoint_get_message_cause(surface.get(), 0) };
  };
  const auto first = messageAndKey(9.0);
  cloud.values[0] = 2.5;
  ASSERT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);
  const auto later = messageAndKey(9.0);
  EXPECT_NE(later[0], first[0]);
  EXPECT_EQ(later[1], first[1]);
  EXPECT_NE(messageAndKey(8.0)[1], first[1]);
  ASSERT_EQ(isopoint_set_value_name(extractor.get(), "density"), ISOPOINT_OK);
  const auto named = messageAndKey(9.0);
  expectContains(named[0], "\"density\" is from");
  EXPECT_NE(named[1], first[1]);
  ASSERT_EQ(isopoint_set_value_name(extractor.get(), nullptr), ISOPOINT_OK);
  EXPECT_EQ(messageAndKey(9.0), later);
  EXPECT_EQ(isopoint_get_message_cause(nullptr, 0), nullptr);
}

// Messages about negated values have the user's numbers, ascending.
TEST(Library, MessagesAboutNegatedValues)
{
  Cloud cloud;
  const auto messageAt = [&](const std::vector<double>& isovalues, const isopoint_options& options)
  {
    const Extractor extractor(cloud);
    EXPECT_EQ(isopoint_set_values_negated(extractor.get(), 1), ISOPOINT_OK);
    const Surface surface = extractor.extract(isovalues, options);
    const char* const text = isopoint_get_message(surface.get(), 0, nullptr);
    return std::string(text ? text : "");
  };
  const isopoint_options withCaps =
    optionsWith([](isopoint_options& options) { options.triangles = options.capping = 1; });
  const std::size_t half = cloud.values.size() / 2;
  std::fill_n(cloud.values.begin(), half, -7.0);
  std::fill_n(cloud.values.rbegin(), half, -2.0);
  const std::string range = "The array is from 2 to 7: no isosurface at ";
  EXPECT_EQ(messageAt({ -9.0, 0.0, 1.0 }, withTriangles),
    range + "-1, 0, 9. Choose isovalues between 2 and 7.");
  EXPECT_EQ(messageAt({ -9.0 }, defaults), range + "9. Choose isovalues between 2 and 7.");
  EXPECT_EQ(messageAt({ -1.0 }, withCaps), range + "1. Choose isovalues greater than 2.");
  cloud.values.assign(cloud.values.size(), -2.0);
  EXPECT_EQ(messageAt({ -1.0 }, withCaps),
    "No isosurface: all values of the array are 2. Choose another array, or a higher isovalue.");
  EXPECT_EQ(isopoint_set_values_negated(nullptr, 1), ISOPOINT_INVALID_ARGUMENT);
}

// Of two blocks one has the first isovalue, the other one has the second, and none has the third.
TEST(Library, MessagesAreJoined)
{
  std::vector<Surface> surfaces;
  for (const double offset : { 0.0, 10.0 })
  {
    Cloud cloud;
    std::for_each(cloud.values.begin(), cloud.values.end(), [&](double& v) { v += offset; });
    cloud.values[0] = std::numeric_limits<double>::quiet_NaN();
    surfaces.push_back(Extractor(cloud).extract({ 0.7, 10.7, 99.0 }));
  }
  const Surface& joined = surfaces[0];
  const std::int64_t dropped =
    isopoint_get_dropped_count(surfaces[0].get()) + isopoint_get_dropped_count(surfaces[1].get());
  ASSERT_EQ(isopoint_join_messages(joined.get(), surfaces[1].get()), ISOPOINT_OK);
  EXPECT_EQ(isopoint_get_dropped_count(joined.get()), dropped);
  const std::string outside = isopoint_get_message(joined.get(), 0, nullptr);
  expectContains(outside, ": no isosurface at 99. ");
  expectContains(isopoint_get_message(joined.get(), 1, nullptr), "Skipped 2 of 10000");
  EXPECT_EQ(isopoint_get_message(joined.get(), 2, nullptr), nullptr);
  const Surface other = Extractor(Cloud()).extract({ 0.5 });
  expectInvalid(isopoint_join_messages(joined.get(), other.get()), "isovalues");
  const Surface empty = Extractor(Cloud(0)).extract({ 0.7, 10.7, 99.0 });
  EXPECT_EQ(isopoint_join_messages(joined.get(), empty.get()), ISOPOINT_OK);
  const Surface ofTriangles = Extractor(Cloud()).extract({ 0.7, 10.7, 99.0 }, withTriangles);
  const Surface ungapped = Extractor(Cloud()).extract(
    { 0.7, 10.7, 99.0 }, optionsWith([](auto& options) { options.drop_gaps = 0; }));
  expectInvalid(isopoint_join_messages(joined.get(), ofTriangles.get()), "same options");
  expectInvalid(isopoint_join_messages(joined.get(), ungapped.get()), "same options");
  expectInvalid(isopoint_join_messages(joined.get(), nullptr), "other surface");
  expectInvalid(isopoint_join_messages(joined.get(), joined.get()), "two surfaces");
}
