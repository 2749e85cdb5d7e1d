// SPDX-License-Identifier: GPL-3.0-or-later
// The C library: options, invalid calls, callbacks, threads, forks.
#include "LibraryTesting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace librarytesting;

TEST(Library, CurvesHaveTooManyTetrahedra)
{
  Cloud curve(0);
  constexpr int count = 3000;
  for (int i = 0; i < count; ++i)
  {
    const double t = static_cast<double>(i) / count;
    curve.positions.insert(curve.positions.end(), { t, t * t, t * t * t });
    curve.values.push_back(t);
  }
  const Extractor extractor(curve);
  const double isovalue = 0.5;
  isopoint_surface* surface = nullptr;
  expectInvalid(
    isopoint_extract(extractor.get(), &isovalue, 1, &withTriangles, &surface), "on curves");
  for (const char* const remedy : { "points", "probe", "average", "radial basis functions" })
  {
    expectContains(isopoint_get_error(), remedy);
  }
  EXPECT_EQ(surface, nullptr);
  EXPECT_EQ(isopoint_extract(extractor.get(), &isovalue, 1, &defaults, &surface), ISOPOINT_OK);
  isopoint_destroy_surface(surface);
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
  for (const double scale : { 0.0, HUGE_VAL })
  {
    expectInvalid(isopoint_make_splat_mesh(made.get(), scale), "Pass a finite number");
  }
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
  const std::vector<std::pair<std::function<void(isopoint_array&, isopoint_array&)>, const char*>>
    changes{
      { [](auto& positions, auto&) { positions.type = 77; }, "positions has the unknown type 77" },
      { [](auto& positions, auto&) { positions.type = ISOPOINT_INT32; }, "positions" },
      { [](auto& positions, auto&) { positions.components = 2; }, "positions" },
      { [](auto& positions, auto&) { positions.count = -1; }, "positions" },
      { [](auto& positions, auto&) { positions.data = nullptr; }, "positions" },
      { [](auto&, auto& values) { values.count -= 1; }, "values" },
      { [](auto&, auto& values) { values.components = 0; }, "values" },
      { [](auto&, auto& values) { values.type = -1; }, "values has the unknown type -1" },
    };
  for (const auto& [change, words] : changes)
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
    expectInvalid(isopoint_set_samples(extractor.get(), &positions, &values, nullptr), words,
      ISOPOINT_INVALID_ARRAY);
    EXPECT_EQ(isopoint_get_sample_count(extractor.get()), 5000);
    extractor.extract();
  }
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
                 std::string(isopoint_get_error()).find("Python") == std::string::npos &&
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
