// SPDX-License-Identifier: GPL-3.0-or-later
// The C library through its header alone, as programs use it: contracts, errors, threads.
#include "isopoint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace
{

using Extractor = std::unique_ptr<isopoint_extractor, decltype(&isopoint_destroy_extractor)>;
using Surface = std::unique_ptr<isopoint_surface, decltype(&isopoint_destroy_surface)>;

Extractor makeExtractor()
{
  return { isopoint_create_extractor(), isopoint_destroy_extractor };
}

template <class T>
isopoint_array arrayOf(const std::vector<T>& numbers, isopoint_type type, int components)
{
  const auto count = static_cast<std::int64_t>(numbers.size()) / components;
  return { numbers.data(), type, components, count, 0, 0 };
}

/// Random samples of the distance from the center of a cube.
struct Cloud
{
  std::vector<double> positions;
  std::vector<double> values;

  explicit Cloud(std::size_t count = 5000)
  {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
    for (std::size_t i = 0; i < count; ++i)
    {
      double square = 0.0;
      for (int axis = 0; axis < 3; ++axis)
      {
        this->positions.push_back(anywhere(random));
        square += this->positions.back() * this->positions.back();
      }
      this->values.push_back(std::sqrt(square));
    }
  }

  isopoint_array positionArray() const { return arrayOf(this->positions, ISOPOINT_DOUBLE, 3); }
  isopoint_array valueArray() const { return arrayOf(this->values, ISOPOINT_DOUBLE, 1); }

  isopoint_status load(isopoint_extractor* extractor) const
  {
    const isopoint_array places = this->positionArray();
    const isopoint_array numbers = this->valueArray();
    return isopoint_set_samples(extractor, &places, &numbers, nullptr);
  }
};

isopoint_options defaults()
{
  isopoint_options options;
  isopoint_initialize_options(&options, sizeof(options));
  return options;
}

isopoint_options withTriangles()
{
  isopoint_options options = defaults();
  options.triangles = 1;
  return options;
}

Surface extract(isopoint_extractor* extractor, const std::vector<double>& isovalues,
  const isopoint_options& options = defaults())
{
  isopoint_surface* surface = nullptr;
  EXPECT_EQ(isopoint_extract(extractor, isovalues.data(),
              static_cast<std::int64_t>(isovalues.size()), &options, &surface),
    ISOPOINT_OK)
    << isopoint_get_error();
  return { surface, isopoint_destroy_surface };
}

/// The numbers of an array of a surface.
template <class T>
std::vector<T> numbersOf(isopoint_surface* surface, isopoint_array_id id)
{
  isopoint_array array;
  EXPECT_EQ(isopoint_get_array(surface, id, &array), ISOPOINT_OK);
  const T* const data = static_cast<const T*>(array.data);
  return array.data ? std::vector<T>(data, data + array.count * array.components)
                    : std::vector<T>();
}

/// The bytes of all arrays of a surface.
std::string bytesOf(isopoint_surface* surface)
{
  std::string bytes;
  for (std::int32_t id = ISOPOINT_POINTS; id <= ISOPOINT_SPLAT_TRIANGLES; ++id)
  {
    isopoint_array array;
    EXPECT_EQ(isopoint_get_array(surface, id, &array), ISOPOINT_OK);
    constexpr std::array<std::size_t, 10> sizes{ 4, 8, 1, 1, 2, 2, 4, 4, 8, 8 };
    const std::size_t size = static_cast<std::size_t>(array.count * array.components) *
                             sizes.at(static_cast<std::size_t>(array.type));
    bytes += std::to_string(size) + ":";
    bytes.append(static_cast<const char*>(array.data), size);
  }
  return bytes;
}

std::string errorOf(isopoint_status expected, isopoint_status status)
{
  EXPECT_EQ(status, expected);
  return isopoint_get_error();
}

void expectContains(const std::string& text, const std::string& part)
{
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

} // namespace

TEST(Library, ExtractsASphere)
{
  const Extractor extractor = makeExtractor();
  ASSERT_EQ(Cloud(6000).load(extractor.get()), ISOPOINT_OK);
  EXPECT_EQ(isopoint_get_sample_count(extractor.get()), 6000);
  for (const isopoint_options& options : { defaults(), withTriangles() })
  {
    const Surface surface = extract(extractor.get(), { 0.7 }, options);
    const auto points = numbersOf<double>(surface.get(), ISOPOINT_POINTS);
    const auto normals = numbersOf<float>(surface.get(), ISOPOINT_NORMALS);
    ASSERT_GT(points.size(), 1500u);
    ASSERT_EQ(points.size(), normals.size());
    for (std::size_t i = 0; i < points.size(); i += 3)
    {
      EXPECT_NEAR(std::hypot(points[i], points[i + 1], points[i + 2]), 0.7, 0.02);
      double along = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        along -= points[i + axis] * static_cast<double>(normals[i + axis]) / 0.7;
      }
      EXPECT_GT(along, 0.9); // values decrease inward
    }
    EXPECT_EQ(isopoint_get_message(surface.get(), 0, nullptr), nullptr);
  }
}

TEST(Library, ResultsDependOnNeitherThreadsNorWhatWasExtractedBefore)
{
  const Cloud cloud;
  const Extractor one = makeExtractor();
  ASSERT_EQ(isopoint_set_threads(one.get(), 1), ISOPOINT_OK);
  ASSERT_EQ(cloud.load(one.get()), ISOPOINT_OK);
  const Extractor many = makeExtractor();
  ASSERT_EQ(cloud.load(many.get()), ISOPOINT_OK);
  extract(many.get(), { 0.4 });
  extract(many.get(), { 0.45 }, withTriangles());
  for (const isopoint_options& options : { defaults(), withTriangles() })
  {
    EXPECT_EQ(bytesOf(extract(one.get(), { 0.7, 0.5 }, options).get()),
      bytesOf(extract(many.get(), { 0.5, 0.7, 0.5 }, options).get()));
  }
}

TEST(Library, RegularizedTrianglesAreFewer)
{
  const Extractor extractor = makeExtractor();
  ASSERT_EQ(Cloud().load(extractor.get()), ISOPOINT_OK);
  isopoint_options options = withTriangles();
  EXPECT_EQ(options.regularize, 1);
  const auto countTriangles = [&]()
  {
    const Surface surface = extract(extractor.get(), { 0.7 }, options);
    return numbersOf<std::int64_t>(surface.get(), ISOPOINT_TRIANGLES).size() / 3;
  };
  const std::size_t few = countTriangles();
  options.regularize = 0;
  EXPECT_LT(few, countTriangles() / 2);
}

TEST(Library, NewValuesAtTheSamePositionsReplaceTheFormerOnes)
{
  Cloud cloud;
  const Extractor extractor = makeExtractor();
  ASSERT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);
  extract(extractor.get(), { 0.7 });
  std::transform(cloud.values.begin(), cloud.values.end(), cloud.values.begin(),
    [](double value) { return 2.0 * value * value; });
  ASSERT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);
  const Extractor fresh = makeExtractor();
  ASSERT_EQ(cloud.load(fresh.get()), ISOPOINT_OK);
  EXPECT_EQ(
    bytesOf(extract(extractor.get(), { 0.7 }).get()), bytesOf(extract(fresh.get(), { 0.7 }).get()));
}

TEST(Library, StridesMayBeAnyEvenNegative)
{
  const Cloud cloud;
  const std::size_t count = cloud.values.size();
  const Extractor packed = makeExtractor();
  ASSERT_EQ(cloud.load(packed.get()), ISOPOINT_OK);
  // The same samples, from the last to the first and in columns.
  std::vector<double> columns(4 * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      columns[axis * count + count - 1 - i] = cloud.positions[3 * i + axis];
    }
    columns[3 * count + count - 1 - i] = cloud.values[i];
  }
  constexpr auto size = static_cast<std::int64_t>(sizeof(double));
  const auto tuples = static_cast<std::int64_t>(count);
  const isopoint_array positions{ columns.data() + count - 1, ISOPOINT_DOUBLE, 3, tuples, -size,
    tuples * size };
  const isopoint_array values{ columns.data() + 4 * count - 1, ISOPOINT_DOUBLE, 1, tuples, -size,
    0 };
  const Extractor strided = makeExtractor();
  ASSERT_EQ(isopoint_set_samples(strided.get(), &positions, &values, nullptr), ISOPOINT_OK);
  EXPECT_EQ(
    bytesOf(extract(packed.get(), { 0.7 }).get()), bytesOf(extract(strided.get(), { 0.7 }).get()));
}

namespace
{

template <class T>
void expectSameAsDouble(isopoint_type type)
{
  SCOPED_TRACE(type);
  const Cloud cloud;
  std::vector<T> integers;
  std::vector<double> doubles;
  for (const double value : cloud.values)
  {
    integers.push_back(static_cast<T>(60.0 * value));
    doubles.push_back(static_cast<double>(integers.back()));
  }
  const isopoint_array positions = cloud.positionArray();
  const isopoint_array values = arrayOf(integers, type, 1);
  const Extractor extractor = makeExtractor();
  ASSERT_EQ(isopoint_set_samples(extractor.get(), &positions, &values, nullptr), ISOPOINT_OK);
  double range[2];
  isopoint_get_value_range(extractor.get(), range);
  EXPECT_EQ(range[0], *std::min_element(doubles.begin(), doubles.end()));
  EXPECT_EQ(range[1], *std::max_element(doubles.begin(), doubles.end()));

  const Surface surface = extract(extractor.get(), { 40.5 });
  const auto edges = numbersOf<std::int64_t>(surface.get(), ISOPOINT_EDGES);
  const auto parameters = numbersOf<double>(surface.get(), ISOPOINT_EDGE_PARAMETERS);
  ASSERT_GT(parameters.size(), 500u);
  std::vector<T> result(parameters.size());
  ASSERT_EQ(isopoint_interpolate(surface.get(), &values, result.data()), ISOPOINT_OK);
  for (std::size_t i = 0; i < parameters.size(); ++i)
  {
    const double first = doubles[static_cast<std::size_t>(edges[2 * i])];
    const double second = doubles[static_cast<std::size_t>(edges[2 * i + 1])];
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
  cloud.values[5] = std::numeric_limits<double>::quiet_NaN();
  const isopoint_array positions = cloud.positionArray();
  const isopoint_array values = cloud.valueArray();
  const isopoint_array flags = arrayOf(excluded, ISOPOINT_UINT8, 1);
  const Extractor extractor = makeExtractor();
  ASSERT_EQ(isopoint_set_samples(extractor.get(), &positions, &values, &flags), ISOPOINT_OK);
  EXPECT_EQ(isopoint_get_skipped_count(extractor.get()), 501);
  EXPECT_EQ(isopoint_get_sample_count(extractor.get()), 4499);
  const Surface surface = extract(extractor.get(), { 0.7 });
  for (const std::int64_t sample : numbersOf<std::int64_t>(surface.get(), ISOPOINT_EDGES))
  {
    EXPECT_NE(sample % 10, 0);
    EXPECT_NE(sample, 5);
  }
  std::int32_t isWarning = -1;
  const char* const message = isopoint_get_message(surface.get(), 0, &isWarning);
  ASSERT_NE(message, nullptr);
  expectContains(message, "Skipped 501 of 5000 samples: 1 not finite, 500 excluded");
  EXPECT_EQ(isWarning, 0);
  EXPECT_EQ(isopoint_get_message(surface.get(), 1, nullptr), nullptr);
}

TEST(Library, AnIsovalueOutsideTheRangeIsAWarning)
{
  const Extractor extractor = makeExtractor();
  ASSERT_EQ(Cloud().load(extractor.get()), ISOPOINT_OK);
  const Surface surface = extract(extractor.get(), { 9.0 });
  EXPECT_TRUE(numbersOf<double>(surface.get(), ISOPOINT_POINTS).empty());
  std::int32_t isWarning = 0;
  expectContains(isopoint_get_message(surface.get(), 0, &isWarning), "No isosurface at 9");
  EXPECT_EQ(isWarning, 1);
}

TEST(Library, ErrorsNameCauseAndRemedy)
{
  const Cloud cloud;
  const Extractor extractor = makeExtractor();
  isopoint_surface* surface = nullptr;
  const double isovalue = 0.7;
  isopoint_options options = defaults();
  const auto errorOfExtract = [&]()
  {
    return errorOf(ISOPOINT_INVALID_ARGUMENT,
      isopoint_extract(extractor.get(), &isovalue, 1, &options, &surface));
  };
  expectContains(errorOfExtract(), "isopoint_set_samples()");
  ASSERT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);

  options.minimum_spacing = 2.0;
  expectContains(errorOfExtract(), "minimum_spacing is 2, which is out of range");
  options = defaults();
  options.number_of_neighbors = 2;
  expectContains(errorOfExtract(), "number_of_neighbors is 2");
  options = defaults();
  options.angle = std::nan("");
  expectContains(errorOfExtract(), "angle is nan");
  options = defaults();
  options.projection = 5;
  expectContains(errorOfExtract(), "projection is 5");
  options = defaults();
  options.size += 8;
  expectContains(errorOfExtract(), "isopoint_initialize_options()");
  options.size = 0;
  expectContains(errorOfExtract(), "isopoint_initialize_options()");
  EXPECT_EQ(surface, nullptr);

  const double invalid = std::nan("");
  expectContains(errorOf(ISOPOINT_INVALID_ARGUMENT,
                   isopoint_extract(extractor.get(), &invalid, 1, nullptr, &surface)),
    "not a number");
  for (isopoint_surface** const place : { &surface, static_cast<isopoint_surface**>(nullptr) })
  {
    expectContains(
      errorOf(ISOPOINT_INVALID_ARGUMENT, isopoint_extract(nullptr, &isovalue, 1, nullptr, place)),
      "extractor is null");
  }
  errorOf(
    ISOPOINT_INVALID_ARGUMENT, isopoint_extract(extractor.get(), &isovalue, 1, nullptr, nullptr));
  errorOf(
    ISOPOINT_INVALID_ARGUMENT, isopoint_extract(extractor.get(), nullptr, 1, nullptr, &surface));
  errorOf(ISOPOINT_INVALID_ARGUMENT, isopoint_set_threads(extractor.get(), -1));
  isopoint_array array;
  errorOf(ISOPOINT_INVALID_ARGUMENT, isopoint_get_array(nullptr, ISOPOINT_POINTS, &array));
  const Surface made = extract(extractor.get(), { 0.7 });
  errorOf(ISOPOINT_INVALID_ARGUMENT, isopoint_get_array(made.get(), 99, &array));
  errorOf(ISOPOINT_INVALID_ARGUMENT, isopoint_make_splat_mesh(made.get(), 0.0));
  options = withTriangles();
  const Surface triangles = extract(extractor.get(), { 0.7 }, options);
  expectContains(errorOf(ISOPOINT_INVALID_ARGUMENT, isopoint_make_splat_mesh(triangles.get(), 1.0)),
    "no splats");
  const isopoint_array few{ cloud.values.data(), ISOPOINT_DOUBLE, 1, 7, 0, 0 };
  std::vector<double> result(made ? 100000 : 0);
  expectContains(
    errorOf(ISOPOINT_INVALID_ARGUMENT, isopoint_interpolate(made.get(), &few, result.data())),
    "5000");
}

TEST(Library, InvalidArraysAreErrorsAndLeaveNoSamples)
{
  const Cloud cloud;
  const isopoint_array positions = cloud.positionArray();
  const isopoint_array values = cloud.valueArray();
  const auto changed = [](isopoint_array array, const auto& change)
  {
    change(array);
    return array;
  };
  const std::vector<std::pair<isopoint_array, isopoint_array>> pairs{
    { changed(positions, [](auto& a) { a.type = 77; }), values },
    { changed(positions, [](auto& a) { a.type = ISOPOINT_INT32; }), values },
    { changed(positions, [](auto& a) { a.components = 2; }), values },
    { changed(positions, [](auto& a) { a.count = -1; }), values },
    { changed(positions, [](auto& a) { a.data = nullptr; }), values },
    { positions, changed(values, [](auto& a) { a.count -= 1; }) },
    { positions, changed(values, [](auto& a) { a.components = 0; }) },
    { positions, changed(values, [](auto& a) { a.type = -1; }) },
  };
  const Extractor extractor = makeExtractor();
  for (const auto& [places, numbers] : pairs)
  {
    ASSERT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);
    EXPECT_FALSE(errorOf(
      ISOPOINT_INVALID_ARGUMENT, isopoint_set_samples(extractor.get(), &places, &numbers, nullptr))
                   .empty());
    EXPECT_EQ(isopoint_get_sample_count(extractor.get()), 0);
  }
  errorOf(
    ISOPOINT_INVALID_ARGUMENT, isopoint_set_samples(extractor.get(), nullptr, &values, nullptr));
  errorOf(
    ISOPOINT_INVALID_ARGUMENT, isopoint_set_samples(extractor.get(), &positions, &values, &values));
}

TEST(Library, OptionsAreOfThisVersionAndSwitchesOnOrOff)
{
  const Extractor extractor = makeExtractor();
  ASSERT_EQ(Cloud().load(extractor.get()), ISOPOINT_OK);
  const double isovalue = 0.7;
  isopoint_surface* surface = nullptr;
  const auto expectInvalid = [&](const auto& change)
  {
    isopoint_options options = defaults();
    change(options);
    errorOf(ISOPOINT_INVALID_ARGUMENT,
      isopoint_extract(extractor.get(), &isovalue, 1, &options, &surface));
  };
  for (const std::uint64_t size : { 0, 7, 8, 9, 40, 71, 73, 1000 })
  {
    expectInvalid([size](isopoint_options& options) { options.size = size; });
  }
  for (const std::int32_t value : { -1, 2, std::numeric_limits<std::int32_t>::min() })
  {
    expectInvalid([value](isopoint_options& options) { options.triangles = value; });
    expectInvalid([value](isopoint_options& options) { options.keep_tetrahedra = value; });
    expectInvalid([value](isopoint_options& options) { options.regularize = value; });
  }
  // No more is written than the caller has.
  std::array<unsigned char, sizeof(isopoint_options)> bytes;
  bytes.fill(0xff);
  isopoint_initialize_options(
    reinterpret_cast<isopoint_options*>(bytes.data()), offsetof(isopoint_options, angle));
  EXPECT_EQ(bytes[offsetof(isopoint_options, angle)], 0xff);
  EXPECT_EQ(bytes[offsetof(isopoint_options, angle) - 1], 0);
}

TEST(Library, SplatMeshesNeedNormalsToo)
{
  const Extractor extractor = makeExtractor();
  ASSERT_EQ(Cloud().load(extractor.get()), ISOPOINT_OK);
  isopoint_options options = defaults();
  options.compute_normals = 0;
  const Surface surface = extract(extractor.get(), { 0.7 }, options);
  expectContains(errorOf(ISOPOINT_INVALID_ARGUMENT, isopoint_make_splat_mesh(surface.get(), 1.0)),
    "compute_normals");
}

TEST(Library, NoSampleThatTakesPartIsExplained)
{
  const Cloud cloud(10);
  const std::vector<std::uint8_t> excluded(10, 1);
  const isopoint_array positions = cloud.positionArray();
  const isopoint_array values = cloud.valueArray();
  const isopoint_array flags = arrayOf(excluded, ISOPOINT_UINT8, 1);
  const Extractor extractor = makeExtractor();
  ASSERT_EQ(isopoint_set_samples(extractor.get(), &positions, &values, &flags), ISOPOINT_OK);
  const Surface surface = extract(extractor.get(), { 0.7 });
  ASSERT_NE(isopoint_get_message(surface.get(), 0, nullptr), nullptr);
  expectContains(isopoint_get_message(surface.get(), 0, nullptr), "no sample takes part");
  EXPECT_EQ(isopoint_interpolate(surface.get(), &values, nullptr), ISOPOINT_OK);
  isopoint_get_value_range(extractor.get(), nullptr);
}

TEST(Library, CloudsWithoutSamplesHaveEmptySurfaces)
{
  const isopoint_array positions{ nullptr, ISOPOINT_FLOAT, 3, 0, 0, 0 };
  const isopoint_array values{ nullptr, ISOPOINT_FLOAT, 1, 0, 0, 0 };
  const Extractor extractor = makeExtractor();
  ASSERT_EQ(isopoint_set_samples(extractor.get(), &positions, &values, nullptr), ISOPOINT_OK);
  double range[2];
  isopoint_get_value_range(extractor.get(), range);
  EXPECT_TRUE(std::isnan(range[0]) && std::isnan(range[1]));
  const Surface surface = extract(extractor.get(), { 0.7 });
  EXPECT_TRUE(numbersOf<float>(surface.get(), ISOPOINT_POINTS).empty());
  EXPECT_EQ(isopoint_make_splat_mesh(surface.get(), 1.0), ISOPOINT_OK);
  EXPECT_TRUE(numbersOf<std::int64_t>(surface.get(), ISOPOINT_SPLAT_TRIANGLES).empty());
  EXPECT_TRUE(numbersOf<double>(extract(extractor.get(), {}).get(), ISOPOINT_ISOVALUES).empty());
}

namespace
{

struct Observed
{
  std::thread::id caller = std::this_thread::get_id();
  std::vector<double> fractions;
  int cancelAfter = -1;
  int asked = 0;
  bool isOnCaller = true;
};

void observe(void* user, double fraction)
{
  auto* const observed = static_cast<Observed*>(user);
  observed->fractions.push_back(fraction);
  observed->isOnCaller &= std::this_thread::get_id() == observed->caller;
}

int isCanceled(void* user)
{
  auto* const observed = static_cast<Observed*>(user);
  observed->isOnCaller &= std::this_thread::get_id() == observed->caller;
  return observed->asked++ == observed->cancelAfter ? 1 : 0;
}

} // namespace

TEST(Library, ProgressAscendsOnTheCallersThread)
{
  const Cloud cloud(100000);
  const Extractor extractor = makeExtractor();
  Observed observed;
  ASSERT_EQ(isopoint_set_callbacks(extractor.get(), observe, isCanceled, &observed), ISOPOINT_OK);
  for (int time = 0; time < 2; ++time) // the second time only values are replaced
  {
    observed.fractions.clear();
    ASSERT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);
    ASSERT_FALSE(observed.fractions.empty());
    EXPECT_EQ(observed.fractions.back(), 1.0);
  }
  for (const isopoint_options& options : { defaults(), withTriangles() })
  {
    observed.fractions.clear();
    const Surface surface = extract(extractor.get(), { 0.5, 0.7 }, options);
    ASSERT_GT(observed.fractions.size(), 10u);
    EXPECT_TRUE(std::is_sorted(observed.fractions.begin(), observed.fractions.end()));
    EXPECT_GE(observed.fractions.front(), 0.0);
    EXPECT_EQ(observed.fractions.back(), 1.0);
  }
  EXPECT_TRUE(observed.isOnCaller);
}

TEST(Library, ACanceledCallCanBeRepeated)
{
  const Cloud cloud(20000);
  const Extractor extractor = makeExtractor();
  ASSERT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);
  const std::string expected = bytesOf(extract(extractor.get(), { 0.7 }).get());
  Observed observed;
  ASSERT_EQ(isopoint_set_callbacks(extractor.get(), nullptr, isCanceled, &observed), ISOPOINT_OK);
  for (const int after : { 0, 1, 5 })
  {
    observed.asked = 0;
    observed.cancelAfter = after;
    isopoint_surface* surface = nullptr;
    const double isovalue = 0.7;
    EXPECT_EQ(
      isopoint_extract(extractor.get(), &isovalue, 1, nullptr, &surface), ISOPOINT_CANCELED);
    EXPECT_EQ(surface, nullptr);
    observed.cancelAfter = -1;
    EXPECT_EQ(bytesOf(extract(extractor.get(), { 0.7 }).get()), expected);
  }
  const Surface surface = extract(extractor.get(), { 0.7 });
  ASSERT_EQ(isopoint_make_splat_mesh(surface.get(), 1.0), ISOPOINT_OK);
  const std::string mesh = bytesOf(surface.get());
  observed.asked = 0;
  observed.cancelAfter = 0;
  EXPECT_EQ(isopoint_make_splat_mesh(surface.get(), 0.5), ISOPOINT_CANCELED);
  EXPECT_EQ(bytesOf(surface.get()), mesh);
  const std::vector<double> ofPoints(numbersOf<double>(surface.get(), ISOPOINT_ISOVALUES).size());
  const isopoint_array array = arrayOf(ofPoints, ISOPOINT_DOUBLE, 1);
  std::vector<double> means(
    numbersOf<std::int64_t>(surface.get(), ISOPOINT_SPLAT_VERTEX_POINTS).size());
  EXPECT_EQ(isopoint_average_at_splat_vertices(surface.get(), &array, means.data()), ISOPOINT_OK);
  observed.asked = 0;
  EXPECT_EQ(cloud.load(extractor.get()), ISOPOINT_CANCELED);
  EXPECT_EQ(isopoint_get_sample_count(extractor.get()), 0);
  EXPECT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);
}

TEST(Library, TwoExtractorsWorkOnTwoThreads)
{
  const Cloud cloud(20000);
  std::array<std::string, 2> bytes;
  std::vector<std::thread> threads;
  for (std::string& own : bytes)
  {
    threads.emplace_back(
      [&cloud, &own]()
      {
        const Extractor extractor = makeExtractor();
        ASSERT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);
        const Surface surface = extract(extractor.get(), { 0.5, 0.7 });
        ASSERT_EQ(isopoint_make_splat_mesh(surface.get(), 1.0), ISOPOINT_OK);
        own = bytesOf(surface.get());
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_FALSE(bytes[0].empty());
  EXPECT_EQ(bytes[0], bytes[1]);
}

TEST(Library, ErrorsAreThoseOfTheThread)
{
  errorOf(ISOPOINT_INVALID_ARGUMENT, isopoint_set_threads(nullptr, 0));
  std::string elsewhere = "unset";
  std::thread([&]() { elsewhere = isopoint_get_error(); }).join();
  EXPECT_EQ(elsewhere, "");
}

TEST(Library, SurfacesOutliveTheirExtractor)
{
  const Cloud cloud;
  Extractor extractor = makeExtractor();
  ASSERT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);
  const Surface surface = extract(extractor.get(), { 0.7 });
  const std::string bytes = bytesOf(surface.get());
  extractor.reset();
  EXPECT_EQ(bytesOf(surface.get()), bytes);
  const isopoint_array values = cloud.valueArray();
  std::vector<double> result(numbersOf<double>(surface.get(), ISOPOINT_ISOVALUES).size());
  ASSERT_EQ(isopoint_interpolate(surface.get(), &values, result.data()), ISOPOINT_OK);
  ASSERT_EQ(isopoint_make_splat_mesh(surface.get(), 1.0), ISOPOINT_OK);
}

TEST(Library, SplatMeshesAreTheSurface)
{
  const Extractor extractor = makeExtractor();
  ASSERT_EQ(Cloud().load(extractor.get()), ISOPOINT_OK);
  const Surface surface = extract(extractor.get(), { 0.7 });
  ASSERT_EQ(isopoint_make_splat_mesh(surface.get(), 1.0), ISOPOINT_OK);
  const auto vertices = numbersOf<double>(surface.get(), ISOPOINT_SPLAT_VERTICES);
  const auto triangles = numbersOf<std::int64_t>(surface.get(), ISOPOINT_SPLAT_TRIANGLES);
  const auto points = numbersOf<std::int64_t>(surface.get(), ISOPOINT_SPLAT_VERTEX_POINTS);
  double area = 0.0;
  for (std::size_t i = 0; i < triangles.size(); i += 3)
  {
    std::array<std::array<double, 3>, 2> sides;
    const auto at = [&](std::size_t corner, std::size_t axis)
    { return vertices[3 * static_cast<std::size_t>(triangles[i + corner]) + axis]; };
    for (std::size_t side = 0; side < 2; ++side)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        sides[side][axis] = at(side + 1, axis) - at(0, axis);
      }
    }
    const auto& [a, b] = sides;
    area += 0.5 * std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                    a[0] * b[1] - a[1] * b[0]);
  }
  // Splats overlap where they do not meet.
  EXPECT_NEAR(area, 4.0 * 3.14159265358979 * 0.49, 0.03 * 6.16);

  // A field that is the same at all points is the same at all vertices; one that differs lies
  // between those of its points.
  std::vector<float> numbers(2 * numbersOf<double>(surface.get(), ISOPOINT_ISOVALUES).size());
  for (std::size_t i = 0; i < numbers.size(); i += 2)
  {
    numbers[i] = 3.5f;
    numbers[i + 1] = static_cast<float>(i);
  }
  const isopoint_array ofPoints = arrayOf(numbers, ISOPOINT_FLOAT, 2);
  std::vector<float> means(2 * points.size());
  ASSERT_EQ(
    isopoint_average_at_splat_vertices(surface.get(), &ofPoints, means.data()), ISOPOINT_OK);
  std::size_t mixed = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_EQ(means[2 * i], 3.5f);
    mixed += means[2 * i + 1] != static_cast<float>(2 * points[i]) ? 1 : 0;
  }
  EXPECT_GT(mixed, points.size() / 4);
}

namespace
{

/// The arrays of isopoints that isopoint_create_surface() takes.
struct KeptSplats
{
  std::vector<double> points;
  std::vector<float> normals;
  std::vector<float> axes;
  std::vector<float> polygons;

  explicit KeptSplats(isopoint_surface* surface)
    : points(numbersOf<double>(surface, ISOPOINT_POINTS))
    , normals(numbersOf<float>(surface, ISOPOINT_NORMALS))
    , axes(numbersOf<float>(surface, ISOPOINT_SPLAT_AXES))
    , polygons(numbersOf<float>(surface, ISOPOINT_SPLAT_POLYGONS))
  {
  }

  isopoint_status create(isopoint_surface** surface, int components = 3) const
  {
    const isopoint_array places = arrayOf(this->points, ISOPOINT_DOUBLE, 3);
    const isopoint_array directions = arrayOf(this->normals, ISOPOINT_FLOAT, components);
    const isopoint_array along = arrayOf(this->axes, ISOPOINT_FLOAT, 3);
    const isopoint_array shapes = arrayOf(this->polygons, ISOPOINT_FLOAT, 40);
    return isopoint_create_surface(&places, &directions, &along, &shapes, surface);
  }
};

} // namespace

TEST(Library, KeptSplatsYieldTheSameMesh)
{
  const Cloud cloud;
  const Extractor extractor = makeExtractor();
  ASSERT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);
  const Surface surface = extract(extractor.get(), { 0.7 });
  ASSERT_EQ(isopoint_make_splat_mesh(surface.get(), 0.9), ISOPOINT_OK);
  KeptSplats kept(surface.get());

  isopoint_surface* created = nullptr;
  ASSERT_EQ(kept.create(&created), ISOPOINT_OK) << isopoint_get_error();
  const Surface again{ created, isopoint_destroy_surface };
  ASSERT_EQ(isopoint_make_splat_mesh(again.get(), 0.9), ISOPOINT_OK) << isopoint_get_error();
  EXPECT_EQ(numbersOf<double>(again.get(), ISOPOINT_SPLAT_VERTICES),
    numbersOf<double>(surface.get(), ISOPOINT_SPLAT_VERTICES));
  const auto triangles = numbersOf<std::int64_t>(again.get(), ISOPOINT_SPLAT_TRIANGLES);
  EXPECT_EQ(triangles, numbersOf<std::int64_t>(surface.get(), ISOPOINT_SPLAT_TRIANGLES));
  ASSERT_FALSE(triangles.empty());
  std::vector<float> means(
    3 * numbersOf<std::int64_t>(again.get(), ISOPOINT_SPLAT_VERTEX_POINTS).size());
  const isopoint_array normals = arrayOf(kept.normals, ISOPOINT_FLOAT, 3);
  EXPECT_EQ(isopoint_average_at_splat_vertices(again.get(), &normals, means.data()), ISOPOINT_OK);

  expectContains(errorOf(ISOPOINT_INVALID_ARGUMENT, kept.create(&created, 1)), "the normals");
  errorOf(ISOPOINT_INVALID_ARGUMENT, kept.create(nullptr));
  kept.axes.resize(kept.axes.size() - 3);
  expectContains(errorOf(ISOPOINT_INVALID_ARGUMENT, kept.create(&created)), "the splat axes");
}

TEST(Library, KeptSplatsThatAreNotFiniteAreNotDrawn)
{
  const Cloud cloud;
  const Extractor extractor = makeExtractor();
  ASSERT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);
  KeptSplats kept(extract(extractor.get(), { 0.7 }).get());
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  kept.points[0] = nan;
  kept.points[4] = infinity;
  kept.normals[6] = static_cast<float>(nan);
  kept.axes[9] = static_cast<float>(infinity);
  kept.polygons[160] = static_cast<float>(nan);
  isopoint_surface* created = nullptr;
  ASSERT_EQ(kept.create(&created), ISOPOINT_OK);
  const Surface again{ created, isopoint_destroy_surface };
  ASSERT_EQ(isopoint_make_splat_mesh(again.get(), 1.0), ISOPOINT_OK);
  const auto drawn = numbersOf<std::int64_t>(again.get(), ISOPOINT_SPLAT_VERTEX_POINTS);
  ASSERT_FALSE(drawn.empty());
  EXPECT_EQ(*std::min_element(drawn.begin(), drawn.end()), 5);
}
