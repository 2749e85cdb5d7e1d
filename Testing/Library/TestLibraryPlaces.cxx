// SPDX-License-Identifier: GPL-3.0-or-later
// The C library: values at places.
#include "LibraryTesting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

using namespace librarytesting;

namespace
{

isopoint_probe_options probeOptions(
  std::int32_t method, std::int32_t outside = ISOPOINT_PROBE_OUTSIDE_NUMBER, double number = NAN)
{
  isopoint_probe_options options;
  isopoint_initialize_probe_options(&options, sizeof(options));
  EXPECT_EQ(options.method, ISOPOINT_PROBE_BLEND);
  EXPECT_TRUE(std::isnan(options.outside_number));
  options.method = method;
  options.outside = outside;
  options.outside_number = number;
  return options;
}

/// The positions of a cloud without values.
void loadPositions(const Extractor& extractor, const Cloud& cloud)
{
  const isopoint_array positions = cloud.positionArray();
  EXPECT_EQ(isopoint_set_samples(extractor.get(), &positions, nullptr, nullptr), ISOPOINT_OK);
}

} // namespace

TEST(Library, ArraysAreInterpolatedAtPlacesAndAgainFromNeighborhoods)
{
  const Cloud cloud;
  const Extractor extractor;
  loadPositions(extractor, cloud);
  const std::vector<float> at{ 0.5f, 0.25f, 0.5f, -0.25f, 0.5f, 0.125f, 9.0f, 9.0f, 9.0f };
  isopoint_array places = arrayOf(at, ISOPOINT_FLOAT, 3);
  std::vector<float> vectors;
  for (std::size_t i = 0; i < cloud.values.size(); ++i)
  {
    const auto value = static_cast<float>(cloud.values[i]);
    vectors.insert(vectors.end(), { value, -2.0f * value });
  }
  const std::array<isopoint_array, 2> arrays{ cloud.valueArray(),
    arrayOf(vectors, ISOPOINT_FLOAT, 2) };
  for (const std::int32_t method : { ISOPOINT_PROBE_BLEND, ISOPOINT_PROBE_CUBIC })
  {
    const isopoint_probe_options options = probeOptions(method);
    std::vector<double> values(3);
    std::vector<double> gradients(9);
    std::vector<double> components(6);
    std::array<std::uint8_t, 3> flags{};
    const std::array<isopoint_probe_result, 2> results{ resultIn(values, gradients),
      resultIn(components) };
    ASSERT_EQ(isopoint_probe(extractor.get(), &places, arrays.data(), 2, &options, results.data(),
                flags.data(), flags.size()),
      ISOPOINT_OK)
      << isopoint_get_error();
    EXPECT_NEAR(values[0], 0.75, 1e-3);
    EXPECT_NEAR(gradients[0], 0.5 / 0.75, 1e-2);
    EXPECT_NEAR(components[1], -1.5, 2e-3);
    EXPECT_TRUE(std::isnan(values[2]) && std::isnan(gradients[6]) && std::isnan(components[5]));
    EXPECT_EQ(flags, (std::array<std::uint8_t, 3>{ 0, 0, ISOPOINT_PLACE_OUTSIDE }));

    isopoint_neighborhoods* neighborhoods = nullptr;
    Observed former; // may be gone when neighborhoods are probed
    ASSERT_EQ(
      isopoint_set_extractor_callbacks(extractor.get(), observe, isCanceled, &former), ISOPOINT_OK);
    ASSERT_EQ(
      isopoint_find_neighborhoods(extractor.get(), &places, &options, &neighborhoods), ISOPOINT_OK);
    isopoint_set_extractor_callbacks(extractor.get(), nullptr, nullptr, nullptr);
    const int asked = former.asked;
    EXPECT_GT(asked, 0);
    std::vector<double> again(3);
    const isopoint_probe_result result = resultIn(again);
    ASSERT_EQ(isopoint_probe_neighborhoods(neighborhoods, arrays.data(), 1, &result, nullptr, 0),
      ISOPOINT_OK);
    EXPECT_EQ(former.asked, asked);
    EXPECT_EQ(again[0], values[0]);
    EXPECT_EQ(again[1], values[1]);
    Observed observed;
    observed.cancelAfter = 0;
    EXPECT_EQ(isopoint_set_neighborhoods_callbacks(neighborhoods, observe, isCanceled, &observed),
      ISOPOINT_OK);
    EXPECT_EQ(isopoint_set_neighborhoods_threads(neighborhoods, 1), ISOPOINT_OK);
    EXPECT_EQ(isopoint_probe_neighborhoods(neighborhoods, arrays.data(), 1, &result, nullptr, 0),
      ISOPOINT_CANCELED);
    expectInvalid(isopoint_set_neighborhoods_threads(neighborhoods, -1), "threads");
    EXPECT_EQ(
      isopoint_set_neighborhoods_callbacks(neighborhoods, nullptr, nullptr, nullptr), ISOPOINT_OK);
    EXPECT_EQ(isopoint_probe_neighborhoods(neighborhoods, arrays.data(), 1, &result, nullptr, 0),
      ISOPOINT_OK);
    isopoint_weights weights;
    if (method == ISOPOINT_PROBE_BLEND)
    {
      expectInvalid(
        isopoint_get_weights(neighborhoods, &weights), "not linear", ISOPOINT_INVALID_OPTION);
    }
    else
    {
      ASSERT_EQ(isopoint_get_weights(neighborhoods, &weights), ISOPOINT_OK);
      ASSERT_EQ(weights.row_count, 3);
      EXPECT_EQ(weights.row_begins[3], weights.row_begins[2]);
      for (std::size_t row = 0; row < 2; ++row)
      {
        double value = 0.0;
        double slope = 0.0;
        for (std::int64_t i = weights.row_begins[row]; i < weights.row_begins[row + 1]; ++i)
        {
          const double number = cloud.values[static_cast<std::size_t>(weights.samples[i])];
          value += weights.values[i] * number;
          slope += weights.gradients[3 * i] * number;
        }
        EXPECT_NEAR(value, values[row], 1e-12);
        EXPECT_NEAR(slope, gradients[3 * row], 1e-10);
      }
    }
    isopoint_destroy_neighborhoods(neighborhoods);
  }
}

// As of isosurfaces, also where lengths to a small power overflow or underflow.
TEST(Library, ValuesAtPlacesAreTheSameAtAllScales)
{
  const std::vector<double> at{ 0.5, 0.25, 0.5, -0.25, 0.5, 0.125, 9.0, 9.0, 9.0 };
  for (const std::int32_t method : { ISOPOINT_PROBE_BLEND, ISOPOINT_PROBE_CUBIC })
  {
    const isopoint_probe_options options = probeOptions(method);
    std::vector<double> expected;
    for (const int exponent : { 0, 900, -900 })
    {
      SCOPED_TRACE(exponent);
      Cloud cloud;
      const isopoint_array array = cloud.valueArray();
      std::vector<double> where = at;
      for (std::vector<double>* const lengths : { &cloud.positions, &where })
      {
        std::for_each(lengths->begin(), lengths->end(),
          [exponent](double& length) { length = std::ldexp(length, exponent); });
      }
      const Extractor extractor;
      loadPositions(extractor, cloud);
      const isopoint_array places = arrayOf(where, ISOPOINT_DOUBLE, 3);
      std::vector<double> found(3);
      std::vector<double> gradients(9);
      const isopoint_probe_result result = resultIn(found, gradients);
      ASSERT_EQ(isopoint_probe(extractor.get(), &places, &array, 1, &options, &result, nullptr, 0),
        ISOPOINT_OK);
      for (std::size_t i = 0; i < 6; ++i)
      {
        found.push_back(std::ldexp(gradients[i], exponent));
      }
      found.erase(found.begin() + 2); // outside
      expected = expected.empty() ? found : expected;
      EXPECT_EQ(found, expected);
      isopoint_neighborhoods* neighborhoods = nullptr;
      ASSERT_EQ(isopoint_find_neighborhoods(extractor.get(), &places, &options, &neighborhoods),
        ISOPOINT_OK);
      std::vector<double> again(9);
      const isopoint_probe_result repeated = resultIn(found, again);
      ASSERT_EQ(
        isopoint_probe_neighborhoods(neighborhoods, &array, 1, &repeated, nullptr, 0), ISOPOINT_OK);
      EXPECT_TRUE(std::equal(again.begin(), again.begin() + 6, gradients.begin()));
      isopoint_destroy_neighborhoods(neighborhoods);
    }
  }
}

TEST(Library, TheNearestSampleKeepsItsType)
{
  const Cloud cloud;
  const Extractor extractor;
  loadPositions(extractor, cloud);
  std::vector<std::int64_t> numbers;
  for (std::size_t i = 0; i < cloud.values.size(); ++i)
  {
    numbers.push_back((std::int64_t{ 1 } << 60) + static_cast<std::int64_t>(i));
  }
  const std::vector<double> at{ cloud.positions[21], cloud.positions[22], cloud.positions[23], 9.0,
    9.0, 9.0 };
  const isopoint_array places = arrayOf(at, ISOPOINT_DOUBLE, 3);
  const isopoint_array array = arrayOf(numbers, ISOPOINT_INT64, 1);
  const auto found = [&](std::int32_t outside, double number)
  {
    std::vector<std::int64_t> values(2, -1);
    const isopoint_probe_options options = probeOptions(ISOPOINT_PROBE_NEAREST, outside, number);
    const isopoint_probe_result result = resultIn(values);
    EXPECT_EQ(isopoint_probe(extractor.get(), &places, &array, 1, &options, &result, nullptr, 0),
      ISOPOINT_OK);
    EXPECT_EQ(values[0], numbers[7]);
    return values[1];
  };
  EXPECT_EQ(found(ISOPOINT_PROBE_OUTSIDE_NUMBER, NAN), 0);
  EXPECT_EQ(found(ISOPOINT_PROBE_OUTSIDE_NUMBER, -5.0), -5);
  EXPECT_EQ(found(ISOPOINT_PROBE_OUTSIDE_NUMBER, 1e30), 0);
  EXPECT_GE(found(ISOPOINT_PROBE_OUTSIDE_NEAREST, NAN), numbers[0]);
  EXPECT_GE(found(ISOPOINT_PROBE_OUTSIDE_EXTRAPOLATE, NAN), numbers[0]);
}

/// Also where the same numbers leave it as double, and from neighborhoods. Samples that are
/// excluded, or without a finite position, do not widen it.
TEST(Library, IntegersStayWithinTheRangeOfTheirSamples)
{
  Cloud cloud;
  std::vector<std::int32_t> numbers;
  std::vector<double> reals;
  std::vector<std::uint8_t> excluded;
  for (std::size_t i = 0; i < cloud.values.size(); ++i)
  {
    const double x = cloud.positions[3 * i];
    numbers.push_back(x < 0.0 ? -100 : 100);
    reals.push_back(numbers.back());
    excluded.push_back(i % 7 == 0 ? 1 : 0);
    if (i % 7 == 1)
    {
      cloud.positions[3 * i] = NAN;
    }
    if (i % 7 < 2)
    {
      numbers.back() = 1000000;
    }
  }
  const Extractor extractor;
  const isopoint_array positions = cloud.positionArray();
  const isopoint_array areExcluded = arrayOf(excluded, ISOPOINT_UINT8, 1);
  ASSERT_EQ(isopoint_set_samples(extractor.get(), &positions, nullptr, &areExcluded), ISOPOINT_OK);
  std::vector<double> at;
  for (int i = 0; i < 60; ++i)
  {
    at.insert(at.end(), { -0.3 + 0.01 * i, 0.05, 0.02 });
  }
  const isopoint_array places = arrayOf(at, ISOPOINT_DOUBLE, 3);
  const std::array<isopoint_array, 2> arrays{ arrayOf(numbers, ISOPOINT_INT32, 1),
    arrayOf(reals, ISOPOINT_DOUBLE, 1) };
  const isopoint_probe_options options = probeOptions(ISOPOINT_PROBE_CUBIC);
  std::vector<double> integers(60);
  std::vector<double> doubles(60);
  const std::array<isopoint_probe_result, 2> results{ resultIn(integers), resultIn(doubles) };
  ASSERT_EQ(isopoint_probe(
              extractor.get(), &places, arrays.data(), 2, &options, results.data(), nullptr, 0),
    ISOPOINT_OK);
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < integers.size(); ++i)
  {
    EXPECT_EQ(integers[i], std::clamp(doubles[i], -100.0, 100.0));
    beyond += std::abs(doubles[i]) > 100.0 ? 1 : 0;
  }
  EXPECT_GT(beyond, 0u);
  isopoint_neighborhoods* neighborhoods = nullptr;
  ASSERT_EQ(
    isopoint_find_neighborhoods(extractor.get(), &places, &options, &neighborhoods), ISOPOINT_OK);
  std::vector<double> again(60);
  const isopoint_probe_result result = resultIn(again);
  ASSERT_EQ(isopoint_probe_neighborhoods(neighborhoods, arrays.data(), 1, &result, nullptr, 0),
    ISOPOINT_OK);
  EXPECT_EQ(again, integers);
  isopoint_destroy_neighborhoods(neighborhoods);
}

TEST(Library, InvalidProbesAreErrors)
{
  const Cloud cloud(100);
  const Extractor extractor;
  const isopoint_array array = cloud.valueArray();
  const isopoint_array places = cloud.positionArray();
  std::vector<double> numbers(300);
  const isopoint_probe_result result = resultIn(numbers);
  const auto probe = [&](const isopoint_array& of, const isopoint_array& where,
                       const isopoint_probe_result& to, const isopoint_probe_options& options)
  { return isopoint_probe(extractor.get(), &where, &of, 1, &options, &to, nullptr, 0); };
  const isopoint_probe_options usual = probeOptions(ISOPOINT_PROBE_BLEND);
  expectInvalid(probe(array, places, result, usual), "no samples", ISOPOINT_INVALID_ORDER);
  loadPositions(extractor, cloud);
  EXPECT_EQ(probe(array, places, result, usual), ISOPOINT_OK);
  expectInvalid(probe(places, array, result, usual), "places", ISOPOINT_INVALID_ARRAY);
  isopoint_array few = array;
  few.count = 99;
  expectInvalid(probe(few, places, result, usual), "Pass 100 of 1", ISOPOINT_INVALID_ARRAY);
  const auto expectTooSmall = [&](const isopoint_probe_result& to, const std::string& text)
  { expectInvalid(probe(array, places, to, usual), text, ISOPOINT_INVALID_ARRAY); };
  std::vector<double> gradients(299);
  expectTooSmall(
    { nullptr, 800, nullptr, 0 }, "The memory for values is null. Pass 100 times 8 bytes.");
  expectTooSmall({ numbers.data(), 799, nullptr, 0 }, "The memory for values has 799 bytes");
  expectTooSmall(resultIn(numbers, gradients), "The memory for gradients has 2392 bytes");
  std::uint8_t flag = 0;
  isopoint_neighborhoods* neighborhoods = nullptr;
  ASSERT_EQ(
    isopoint_find_neighborhoods(extractor.get(), &places, &usual, &neighborhoods), ISOPOINT_OK);
  numbers.assign(300, -1.0);
  for (const isopoint_status status :
    { isopoint_probe(extractor.get(), &places, &array, 1, &usual, &result, &flag, 99),
      isopoint_probe_neighborhoods(neighborhoods, &array, 1, &result, &flag, 99) })
  {
    expectInvalid(status, "The memory for flags has 99 bytes", ISOPOINT_INVALID_ARRAY);
    EXPECT_EQ(numbers, std::vector<double>(300, -1.0));
  }
  isopoint_destroy_neighborhoods(neighborhoods);
  const isopoint_array nowhere{ nullptr, ISOPOINT_DOUBLE, 3, 0, 0, 0 };
  EXPECT_EQ(probe(array, nowhere, { nullptr, 0, nullptr, 0 }, usual), ISOPOINT_OK);
  expectInvalid(probe(array, places, result, probeOptions(5)), "method", ISOPOINT_INVALID_OPTION);
  expectInvalid(
    probe(array, places, result, probeOptions(0, 3)), "outside", ISOPOINT_INVALID_OPTION);
  expectInvalid(
    probe(array, places, resultIn(numbers, numbers), probeOptions(ISOPOINT_PROBE_NEAREST)),
    "NEAREST", ISOPOINT_INVALID_OPTION);
  isopoint_probe_options unset = usual;
  unset.size = 1;
  expectInvalid(probe(array, places, result, unset), "isopoint_initialize_probe_options",
    ISOPOINT_INVALID_OPTION);
  expectInvalid(
    isopoint_probe(extractor.get(), &places, nullptr, 1, nullptr, &result, nullptr, 0), "arrays");
  expectInvalid(isopoint_probe(extractor.get(), &places, &array, -1, nullptr, &result, nullptr, 0),
    "The number of arrays is -1");
  isopoint_surface* surface = nullptr;
  const double isovalue = 0.5;
  expectInvalid(isopoint_extract(extractor.get(), &isovalue, 1, nullptr, &surface),
    "have no values", ISOPOINT_INVALID_ORDER);
  Observed observed;
  observed.cancelAfter = 0;
  isopoint_set_extractor_callbacks(extractor.get(), observe, isCanceled, &observed);
  EXPECT_EQ(probe(array, places, result, usual), ISOPOINT_CANCELED);
  EXPECT_EQ(probe(array, places, result, usual), ISOPOINT_OK);
  EXPECT_TRUE(std::is_sorted(observed.fractions.begin(), observed.fractions.end()));
  EXPECT_EQ(observed.fractions.back(), 1.0);
}
