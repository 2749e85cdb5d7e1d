// SPDX-License-Identifier: GPL-3.0-or-later
// The C library through its header alone, as programs use it: contracts, errors, threads.
#include "isopoint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#ifndef _WIN32
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace
{

using Surface = std::unique_ptr<isopoint_surface, decltype(&isopoint_destroy_surface)>;

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
      const std::array<double, 3> p{ anywhere(random), anywhere(random), anywhere(random) };
      this->positions.insert(this->positions.end(), p.begin(), p.end());
      this->values.push_back(std::hypot(p[0], p[1], p[2]));
    }
  }

  isopoint_array positionArray() const { return arrayOf(this->positions, ISOPOINT_DOUBLE, 3); }
  isopoint_array valueArray() const { return arrayOf(this->values, ISOPOINT_DOUBLE, 1); }

  isopoint_status load(
    isopoint_extractor* extractor, const std::vector<std::uint8_t>& excluded = {}) const
  {
    const isopoint_array places = this->positionArray();
    const isopoint_array numbers = this->valueArray();
    const isopoint_array flags = arrayOf(excluded, ISOPOINT_UINT8, 1);
    return isopoint_set_samples(extractor, &places, &numbers, excluded.empty() ? nullptr : &flags);
  }
};

/// The default options after a change.
template <class Change>
isopoint_options optionsWith(const Change& change)
{
  isopoint_options options;
  isopoint_initialize_options(&options, sizeof(options));
  change(options);
  return options;
}

const isopoint_options defaults = optionsWith([](isopoint_options&) {});
const isopoint_options withTriangles =
  optionsWith([](isopoint_options& options) { options.triangles = 1; });

class Extractor
{
public:
  Extractor() = default;
  explicit Extractor(const Cloud& cloud) { EXPECT_EQ(cloud.load(this->get()), ISOPOINT_OK); }

  isopoint_extractor* get() const { return this->Handle.get(); }

  Surface extract(const std::vector<double>& isovalues = { 0.7 },
    const isopoint_options& options = defaults) const
  {
    isopoint_surface* surface = nullptr;
    EXPECT_EQ(isopoint_extract(this->get(), isovalues.data(),
                static_cast<std::int64_t>(isovalues.size()), &options, &surface),
      ISOPOINT_OK)
      << isopoint_get_error();
    return { surface, isopoint_destroy_surface };
  }

private:
  std::unique_ptr<isopoint_extractor, decltype(&isopoint_destroy_extractor)> Handle{
    isopoint_create_extractor(), isopoint_destroy_extractor
  };
};

isopoint_array arrayOf(const Surface& surface, std::int32_t id)
{
  isopoint_array array;
  EXPECT_EQ(isopoint_get_array(surface.get(), id, &array), ISOPOINT_OK);
  return array;
}

template <class T>
isopoint_status interpolate(
  const Surface& surface, const isopoint_array& ofSamples, std::vector<T>& result)
{
  return isopoint_interpolate(surface.get(), &ofSamples, result.data(), sizeof(T) * result.size());
}

template <class T>
isopoint_status average(
  const Surface& surface, const isopoint_array& ofPoints, std::vector<T>& result)
{
  return isopoint_average_at_splat_vertices(
    surface.get(), &ofPoints, result.data(), sizeof(T) * result.size());
}

/// Memory for the results of one array.
template <class T>
isopoint_probe_result resultIn(std::vector<T>& values)
{
  return { values.data(), sizeof(T) * values.size(), nullptr, 0 };
}
template <class T>
isopoint_probe_result resultIn(std::vector<T>& values, std::vector<double>& gradients)
{
  return { values.data(), sizeof(T) * values.size(), gradients.data(),
    sizeof(double) * gradients.size() };
}

/// The numbers of an array of a surface.
template <class T>
std::vector<T> numbersOf(const Surface& surface, isopoint_array_id id)
{
  const isopoint_array array = arrayOf(surface, id);
  const T* const data = static_cast<const T*>(array.data);
  return array.data ? std::vector<T>(data, data + array.count * array.components)
                    : std::vector<T>();
}

/// The bytes of all arrays of a surface.
std::string bytesOf(const Surface& surface)
{
  std::string bytes;
  for (std::int32_t id = ISOPOINT_ARRAY_POINTS; id <= ISOPOINT_ARRAY_CAPS; ++id)
  {
    const isopoint_array array = arrayOf(surface, id);
    constexpr std::array<std::size_t, 10> sizes{ 4, 8, 1, 1, 2, 2, 4, 4, 8, 8 };
    const std::size_t size = static_cast<std::size_t>(array.count * array.components) *
                             sizes.at(static_cast<std::size_t>(array.type));
    bytes += std::to_string(size) + ":";
    bytes.append(static_cast<const char*>(array.data), size);
  }
  return bytes;
}

void expectContains(const std::string& text, const std::string& part)
{
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

#ifndef _WIN32
/// Expects that something holds in a forked process, which must not wait for ever.
void expectInFork(const std::function<bool()>& holds)
{
  const pid_t process = fork();
  if (process == 0)
  {
    alarm(60);
    _exit(holds() ? 0 : 1);
  }
  int status = 0;
  waitpid(process, &status, 0);
  EXPECT_EQ(status, 0);
}
#endif

/// Expects an error of a kind that names a word.
void expectInvalid(isopoint_status status, const std::string& word = "",
  isopoint_status kind = ISOPOINT_INVALID_ARGUMENT)
{
  EXPECT_EQ(status, kind) << word;
  EXPECT_STRNE(isopoint_get_error(), "");
  expectContains(isopoint_get_error(), word);
}

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

/// The arrays of isopoints that isopoint_create_surface() takes.
struct KeptSplats
{
  std::vector<double> points;
  std::vector<float> normals;
  std::vector<float> axes;
  std::vector<float> polygons;

  explicit KeptSplats(const Surface& surface)
    : points(numbersOf<double>(surface, ISOPOINT_ARRAY_POINTS))
    , normals(numbersOf<float>(surface, ISOPOINT_ARRAY_NORMALS))
    , axes(numbersOf<float>(surface, ISOPOINT_ARRAY_SPLAT_AXES))
    , polygons(numbersOf<float>(surface, ISOPOINT_ARRAY_SPLAT_POLYGONS))
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

  /// A surface with the mesh of the splats.
  Surface mesh(double scale) const
  {
    isopoint_surface* created = nullptr;
    EXPECT_EQ(this->create(&created), ISOPOINT_OK) << isopoint_get_error();
    EXPECT_EQ(isopoint_make_splat_mesh(created, scale), ISOPOINT_OK) << isopoint_get_error();
    return { created, isopoint_destroy_surface };
  }
};

} // namespace

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
  EXPECT_EQ(codeOf(cloud, greatest), ISOPOINT_MESSAGE_ISOVALUE_OUTSIDE);
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
  expectMessage(cloud, { *greatest, 0.7 }, slicing, "The slice is only where samples are on it",
    ISOPOINT_MESSAGE_ONLY_AT_SAMPLES);
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

TEST(Library, InvalidOptionsAreErrors)
{
  const Extractor extractor((Cloud()));
  const double isovalue = 0.7;
  isopoint_surface* surface = nullptr;
  const auto expectInvalidOptions = [&](const auto& change, const std::string& word)
  {
    const isopoint_options options = optionsWith(change);
    expectInvalid(isopoint_extract(extractor.get(), &isovalue, 1, &options, &surface), word,
      ISOPOINT_INVALID_OPTION);
    EXPECT_EQ(surface, nullptr);
  };
  expectInvalidOptions([](auto& o) { o.angle = 200.0; }, "angle is 200");
  expectInvalidOptions([](auto& o) { o.number_of_neighbors = 2; }, "number_of_neighbors is 2");
  expectInvalidOptions([](auto& o) { o.angle = std::nan(""); }, "angle is nan");
  expectInvalidOptions([](auto& o) { o.projection = 5; }, "projection is 5");
  expectInvalidOptions(
    [](auto& o)
    {
      o.triangles = 1;
      o.minimum_piece_size = 1.5;
    },
    "minimum_piece_size is 1.5");
  constexpr std::uint64_t own = sizeof(isopoint_options);
  for (const std::uint64_t size :
    std::array<std::uint64_t, 9>{ 0, 7, 8, 9, 40, own - 8, own - 1, own + 1, ~std::uint64_t{ 0 } })
  {
    expectInvalidOptions([size](auto& o) { o.size = size; }, "isopoint_initialize_options()");
  }
  for (const std::int32_t value : { -1, 2, std::numeric_limits<std::int32_t>::min() })
  {
    const std::string word = std::to_string(value);
    expectInvalidOptions([value](auto& o) { o.triangles = value; }, "triangles is " + word);
    expectInvalidOptions(
      [value](auto& o) { o.keep_tetrahedra = value; }, "keep_tetrahedra is " + word);
    expectInvalidOptions([value](auto& o) { o.regularize = value; }, "regularize is " + word);
    expectInvalidOptions(
      [value](auto& o) { o.keep_hull_slivers = value; }, "keep_hull_slivers is " + word);
  }
  expectInvalidOptions(
    [](auto& o)
    {
      o.triangles = o.capping = 1;
      o.projection = ISOPOINT_PROJECTION_CREASE;
    },
    "capping has no creases");
  // Also options that have no effect are checked.
  expectInvalidOptions(
    [](auto& o)
    {
      o.triangles = 1;
      o.angle = std::nan("");
    },
    "angle is nan");
  expectInvalidOptions([](auto& o) { o.minimum_piece_size = -1.0; }, "minimum_piece_size is -1");
  // No more is written than the caller has.
  std::array<unsigned char, sizeof(isopoint_options)> bytes;
  bytes.fill(0xff);
  isopoint_initialize_options(
    reinterpret_cast<isopoint_options*>(bytes.data()), offsetof(isopoint_options, angle));
  EXPECT_EQ(bytes[offsetof(isopoint_options, angle)], 0xff);
  EXPECT_EQ(bytes[offsetof(isopoint_options, angle) - 1], 0);
}

TEST(Library, OptionsOfLaterVersionsAreTakenUnlessTheyAreSet)
{
  struct Later
  {
    isopoint_options known;
    std::array<double, 2> added;
  } later;
  std::memset(&later, 0xff, sizeof(later));
  isopoint_initialize_options(&later.known, sizeof(later));
  EXPECT_EQ(later.known.size, sizeof(later));
  EXPECT_EQ(later.added[1], 0.0);
  later.known.triangles = 1;
  const Extractor extractor((Cloud()));
  EXPECT_EQ(bytesOf(extractor.extract({ 0.7 }, later.known)),
    bytesOf(extractor.extract({ 0.7 }, withTriangles)));
  later.added[1] = 1.0;
  const double isovalue = 0.7;
  isopoint_surface* surface = nullptr;
  expectInvalid(isopoint_extract(extractor.get(), &isovalue, 1, &later.known, &surface),
    "does not know", ISOPOINT_INVALID_OPTION);
}

TEST(Library, InvalidCallsAreErrors)
{
  const Cloud cloud;
  const Extractor extractor;
  isopoint_surface* surface = nullptr;
  const double isovalue = 0.7;
  const double invalid = std::nan("");
  const auto extract = [&](const double* value)
  { return isopoint_extract(extractor.get(), value, 1, nullptr, &surface); };
  expectInvalid(extract(&isovalue), "isopoint_set_samples()", ISOPOINT_INVALID_ORDER);
  ASSERT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);
  expectInvalid(extract(&invalid), "not a number");
  expectInvalid(extract(nullptr));
  expectInvalid(isopoint_extract(nullptr, &isovalue, 1, nullptr, &surface), "extractor");
  expectInvalid(isopoint_extract(nullptr, &isovalue, 1, nullptr, nullptr), "extractor");
  expectInvalid(isopoint_extract(extractor.get(), &isovalue, 1, nullptr, nullptr));
  EXPECT_EQ(surface, nullptr);
  expectInvalid(isopoint_set_extractor_threads(extractor.get(), -1));
  isopoint_array array;
  expectInvalid(isopoint_get_array(nullptr, ISOPOINT_ARRAY_POINTS, &array));
  const Surface made = extractor.extract();
  expectInvalid(isopoint_get_array(made.get(), 99, &array));
  expectInvalid(isopoint_make_splat_mesh(made.get(), 0.0));
  const Surface triangles = extractor.extract({ 0.7 }, withTriangles);
  expectInvalid(
    isopoint_make_splat_mesh(triangles.get(), 1.0), "no splats", ISOPOINT_INVALID_ORDER);
  const Surface plain =
    extractor.extract({ 0.7 }, optionsWith([](auto& options) { options.compute_normals = 0; }));
  expectInvalid(
    isopoint_make_splat_mesh(plain.get(), 1.0), "compute_normals", ISOPOINT_INVALID_ORDER);
  const isopoint_array few{ cloud.values.data(), ISOPOINT_DOUBLE, 1, 7, 0, 0 };
  std::vector<double> result(100000);
  expectInvalid(interpolate(made, few, result), "5000", ISOPOINT_INVALID_ARRAY);
}

TEST(Library, InvalidArraysAreErrorsAndKeepTheSamples)
{
  const Cloud cloud;
  const std::vector<std::function<void(isopoint_array&, isopoint_array&)>> changes{
    [](auto& positions, auto&) { positions.type = 77; },
    [](auto& positions, auto&) { positions.type = ISOPOINT_INT32; },
    [](auto& positions, auto&) { positions.components = 2; },
    [](auto& positions, auto&) { positions.count = -1; },
    [](auto& positions, auto&) { positions.data = nullptr; },
    [](auto&, auto& values) { values.count -= 1; },
    [](auto&, auto& values) { values.components = 0; },
    [](auto&, auto& values) { values.type = -1; },
  };
  for (const auto& change : changes)
  {
    const Extractor extractor(cloud);
    isopoint_array positions = cloud.positionArray();
    isopoint_array values = cloud.valueArray();
    expectInvalid(isopoint_set_samples(extractor.get(), nullptr, &values, nullptr), "null",
      ISOPOINT_INVALID_ARRAY);
    expectInvalid(isopoint_set_samples(extractor.get(), &positions, &values, &values), "UINT8",
      ISOPOINT_INVALID_ARRAY);
    ASSERT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);
    change(positions, values);
    expectInvalid(isopoint_set_samples(extractor.get(), &positions, &values, nullptr), "",
      ISOPOINT_INVALID_ARRAY);
    EXPECT_EQ(isopoint_get_sample_count(extractor.get()), 5000);
    extractor.extract();
  }
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

TEST(Library, ProgressAscendsOnTheCallersThread)
{
  const Cloud cloud(100000);
  const Extractor extractor;
  Observed observed;
  ASSERT_EQ(
    isopoint_set_extractor_callbacks(extractor.get(), observe, isCanceled, &observed), ISOPOINT_OK);
  for (int time = 0; time < 2; ++time) // the second time only values are replaced
  {
    observed.fractions.clear();
    ASSERT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);
    ASSERT_FALSE(observed.fractions.empty());
    EXPECT_EQ(observed.fractions.back(), 1.0);
  }
  for (const isopoint_options& options : { defaults, withTriangles })
  {
    observed.fractions.clear();
    extractor.extract({ 0.5, 0.7 }, options);
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
  const Extractor extractor(cloud);
  const std::string expected = bytesOf(extractor.extract());
  Observed observed;
  ASSERT_EQ(
    isopoint_set_extractor_callbacks(extractor.get(), nullptr, isCanceled, &observed), ISOPOINT_OK);
  const auto cancelAfter = [&observed](int questions)
  {
    observed.asked = 0;
    observed.cancelAfter = questions;
  };
  for (const int questions : { 0, 1, 5 })
  {
    cancelAfter(questions);
    isopoint_surface* surface = nullptr;
    const double isovalue = 0.7;
    EXPECT_EQ(
      isopoint_extract(extractor.get(), &isovalue, 1, nullptr, &surface), ISOPOINT_CANCELED);
    EXPECT_EQ(surface, nullptr);
    cancelAfter(-1);
    EXPECT_EQ(bytesOf(extractor.extract()), expected);
  }
  const Surface surface = extractor.extract();
  ASSERT_EQ(isopoint_make_splat_mesh(surface.get(), 1.0), ISOPOINT_OK);
  const std::string mesh = bytesOf(surface);
  ASSERT_EQ(
    isopoint_set_surface_callbacks(surface.get(), nullptr, isCanceled, &observed), ISOPOINT_OK);
  cancelAfter(0);
  EXPECT_EQ(isopoint_make_splat_mesh(surface.get(), 0.5), ISOPOINT_CANCELED);
  EXPECT_EQ(bytesOf(surface), mesh);
  const auto ofPoints = numbersOf<double>(surface, ISOPOINT_ARRAY_ISOVALUES);
  const isopoint_array array = arrayOf(ofPoints, ISOPOINT_DOUBLE, 1);
  std::vector<double> means(
    numbersOf<std::int64_t>(surface, ISOPOINT_ARRAY_SPLAT_VERTEX_POINTS).size());
  EXPECT_EQ(average(surface, array, means), ISOPOINT_OK);
  const isopoint_array values = cloud.valueArray();
  std::vector<double> samples(ofPoints.size());
  EXPECT_EQ(interpolate(surface, values, samples), ISOPOINT_OK);
  cancelAfter(0);
  EXPECT_EQ(average(surface, array, means), ISOPOINT_CANCELED);
  cancelAfter(0);
  EXPECT_EQ(interpolate(surface, values, samples), ISOPOINT_CANCELED);
  cancelAfter(0);
  EXPECT_EQ(cloud.load(extractor.get()), ISOPOINT_CANCELED);
  EXPECT_EQ(isopoint_get_sample_count(extractor.get()), 0);
  EXPECT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);
}

// At each question, also while kept tetrahedra are freed, where a callback may throw as well.
TEST(Library, CanceledTrianglesCanBeRepeated)
{
  const Extractor extractor(Cloud(600));
  ASSERT_EQ(isopoint_set_extractor_threads(extractor.get(), 1), ISOPOINT_OK);
  const isopoint_options dropping = optionsWith(
    [](isopoint_options& options)
    {
      options.triangles = 1;
      options.keep_tetrahedra = 0;
    });
  const std::string expected = bytesOf(extractor.extract({ 0.7 }, withTriangles));
  Observed observed;
  ASSERT_EQ(
    isopoint_set_extractor_callbacks(extractor.get(), nullptr, isCanceled, &observed), ISOPOINT_OK);
  isopoint_status status = ISOPOINT_CANCELED;
  int questions = 0;
  for (; status == ISOPOINT_CANCELED; ++questions)
  {
    observed.cancelAfter = -1;
    ASSERT_EQ(bytesOf(extractor.extract({ 0.7 }, withTriangles)), expected) << questions;
    observed.asked = 0;
    observed.cancelAfter = questions;
    const double isovalue = 0.7;
    isopoint_surface* surface = nullptr;
    status = isopoint_extract(extractor.get(), &isovalue, 1, &dropping, &surface);
    isopoint_destroy_surface(surface);
  }
  EXPECT_EQ(status, ISOPOINT_OK);
  EXPECT_GT(questions, 20);
  const auto throwsAtTheEnd = [](void* user) -> int
  { return isCanceled(user) ? throw std::logic_error("thrown") : 0; };
  for (int back = 2; back < 8; ++back) // questions before the last one
  {
    ASSERT_EQ(
      isopoint_set_extractor_callbacks(extractor.get(), nullptr, nullptr, nullptr), ISOPOINT_OK);
    const Cloud cloud(600);
    ASSERT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);
    ASSERT_EQ(bytesOf(extractor.extract({ 0.7 }, withTriangles)), expected);
    ASSERT_EQ(isopoint_set_extractor_callbacks(extractor.get(), nullptr, throwsAtTheEnd, &observed),
      ISOPOINT_OK);
    observed.asked = 0;
    observed.cancelAfter = questions - back;
    const double isovalue = 0.7;
    isopoint_surface* surface = nullptr;
    EXPECT_EQ(isopoint_extract(extractor.get(), &isovalue, 1, &dropping, &surface),
      ISOPOINT_INTERNAL_ERROR);
  }
}

// Those of the extractor may be gone.
TEST(Library, SurfacesHaveTheirOwnCallbacksAndThreads)
{
  const Extractor extractor(Cloud(20000));
  Observed former;
  ASSERT_EQ(
    isopoint_set_extractor_callbacks(extractor.get(), observe, isCanceled, &former), ISOPOINT_OK);
  const Surface extracted = extractor.extract();
  EXPECT_EQ(former.fractions.back(), 1.0);
  const KeptSplats splats(extracted);
  isopoint_surface* created = nullptr;
  ASSERT_EQ(splats.create(&created), ISOPOINT_OK);
  const Surface kept(created, isopoint_destroy_surface);
  former = Observed();
  for (const Surface* const surface : { &extracted, &kept })
  {
    ASSERT_EQ(isopoint_make_splat_mesh(surface->get(), 1.0), ISOPOINT_OK);
    Observed observed;
    ASSERT_EQ(
      isopoint_set_surface_callbacks(surface->get(), observe, isCanceled, &observed), ISOPOINT_OK);
    ASSERT_EQ(isopoint_set_surface_threads(surface->get(), 1), ISOPOINT_OK);
    ASSERT_EQ(isopoint_make_splat_mesh(surface->get(), 1.0), ISOPOINT_OK);
    EXPECT_EQ(observed.fractions.back(), 1.0);
    EXPECT_GT(observed.asked, 0);
    observed = Observed();
    observed.cancelAfter = 0;
    EXPECT_EQ(isopoint_make_splat_mesh(surface->get(), 1.0), ISOPOINT_CANCELED);
    ASSERT_EQ(
      isopoint_set_surface_callbacks(surface->get(), nullptr, nullptr, nullptr), ISOPOINT_OK);
    observed = Observed();
    ASSERT_EQ(isopoint_make_splat_mesh(surface->get(), 1.0), ISOPOINT_OK);
    EXPECT_EQ(observed.asked + static_cast<int>(observed.fractions.size()), 0);
  }
  EXPECT_EQ(former.asked + static_cast<int>(former.fractions.size()), 0);
  EXPECT_EQ(numbersOf<double>(kept, ISOPOINT_ARRAY_SPLAT_VERTICES),
    numbersOf<double>(extracted, ISOPOINT_ARRAY_SPLAT_VERTICES));
  expectInvalid(isopoint_set_surface_threads(kept.get(), -1), "threads");
  expectInvalid(isopoint_set_surface_callbacks(nullptr, nullptr, nullptr, nullptr));
}

// Programs show a message once while its cause lasts, although its figures change.
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
  expectContains(outside, "No isosurface at 99: ");
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
        const Surface surface = Extractor(cloud).extract({ 0.5, 0.7 });
        ASSERT_EQ(isopoint_make_splat_mesh(surface.get(), 1.0), ISOPOINT_OK);
        own = bytesOf(surface);
      });
  }
  std::for_each(threads.begin(), threads.end(), [](std::thread& thread) { thread.join(); });
  EXPECT_FALSE(bytes[0].empty());
  EXPECT_EQ(bytes[0], bytes[1]);
}

#ifndef _WIN32

TEST(Library, ForkedProcessesMakeTheSameSurfaces)
{
  const Extractor extractor{ Cloud(20000) };
  const Surface surface = extractor.extract();
  ASSERT_EQ(isopoint_make_splat_mesh(surface.get(), 1.0), ISOPOINT_OK);
  const std::string expected = bytesOf(surface);
  expectInFork(
    [&]()
    {
      const Surface again = extractor.extract();
      return isopoint_make_splat_mesh(surface.get(), 1.0) == ISOPOINT_OK &&
             isopoint_make_splat_mesh(again.get(), 1.0) == ISOPOINT_OK &&
             bytesOf(surface) == expected && bytesOf(again) == expected;
    });
}

TEST(Library, CallsFailInProcessesForkedDuringACall)
{
  const Cloud cloud;
  const Extractor extractor(cloud);
  struct
  {
    Extractor bystander{ Cloud() };
    bool hasForked = false;
  } known;
  const auto fork = [](void* user, double)
  {
    auto& ours = *static_cast<decltype(known)*>(user);
    if (!std::exchange(ours.hasForked, true))
    {
      expectInFork(
        [&]()
        {
          const Extractor other;
          return other.get() && Cloud().load(other.get()) == ISOPOINT_FORKED &&
                 std::string(isopoint_get_error()).find("forked") != std::string::npos &&
                 Cloud().load(ours.bystander.get()) == ISOPOINT_FORKED &&
                 isopoint_get_sample_count(ours.bystander.get()) == 5000;
        });
    }
  };
  ASSERT_EQ(isopoint_set_extractor_callbacks(extractor.get(), fork, nullptr, &known), ISOPOINT_OK);
  ASSERT_EQ(cloud.load(extractor.get()), ISOPOINT_OK);
  EXPECT_TRUE(known.hasForked);
  extractor.extract();
}

#endif

TEST(Library, VersionsAreThoseOfTheHeader)
{
  int major = 0;
  int minor = 0;
  int patch = 0;
  ASSERT_EQ(std::sscanf(isopoint_version(), "%d.%d.%d", &major, &minor, &patch), 3);
  EXPECT_STREQ(isopoint_version(), ISOPOINT_VERSION);
  EXPECT_EQ(isopoint_version_number(), 10000 * major + 100 * minor + patch);
  EXPECT_EQ(isopoint_version_number(), ISOPOINT_VERSION_NUMBER);
}

TEST(Library, ErrorsAreThoseOfTheThread)
{
  expectInvalid(isopoint_set_extractor_threads(nullptr, 0));
  std::string elsewhere = "unset";
  std::thread([&]() { elsewhere = isopoint_get_error(); }).join();
  EXPECT_EQ(elsewhere, "");
}

/// Sizes whose bytes no integer counts are told before anything is read.
TEST(Library, ImpossibleSizesAreInvalid)
{
  const double number = 0.0;
  const isopoint_array endless{ &number, ISOPOINT_DOUBLE, 3, std::int64_t{ 1 } << 60, 0, 0 };
  isopoint_surface* created = nullptr;
  expectInvalid(isopoint_create_surface(&endless, &endless, &endless, &endless, &created),
    "no more than memory can hold", ISOPOINT_INVALID_ARRAY);
}

/// A callback that throws stands for any bug.
TEST(Library, ABugLeavesNoSamplesAndItsWholeDescription)
{
  const Extractor extractor(Cloud{});
  ASSERT_EQ(
    isopoint_set_extractor_callbacks(
      extractor.get(), [](void*, double) { throw std::logic_error(std::string(5000, '?')); },
      nullptr, nullptr),
    ISOPOINT_OK);
  const double isovalue = 0.7;
  isopoint_surface* surface = nullptr;
  const auto extract = [&]()
  { return isopoint_extract(extractor.get(), &isovalue, 1, nullptr, &surface); };
  EXPECT_EQ(extract(), ISOPOINT_INTERNAL_ERROR);
  expectContains(isopoint_get_error(), std::string(5000, '?') + "). Report this as a bug");
  EXPECT_EQ(isopoint_get_sample_count(extractor.get()), 0);
  expectInvalid(extract(), "isopoint_set_samples()", ISOPOINT_INVALID_ORDER);
}

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
    { nullptr, 800, nullptr, 0 }, "The memory for values has 0 bytes. Pass 100 times 8 bytes.");
  expectTooSmall({ numbers.data(), 799, nullptr, 0 }, "The memory for values has 799 bytes");
  expectTooSmall(resultIn(numbers, gradients), "The memory for gradients has 2392 bytes");
  std::uint8_t flag = 0;
  expectInvalid(isopoint_probe(extractor.get(), &places, &array, 1, &usual, &result, &flag, 99),
    "The memory for flags has 99 bytes", ISOPOINT_INVALID_ARRAY);
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
  expectInvalid(interpolate(again, none, values), "made by isopoint_create_surface()");
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
