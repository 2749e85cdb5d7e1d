// SPDX-License-Identifier: GPL-3.0-or-later
// Each allocation of a call is made to fail: the call says so without any memory, and its extractor
// stays usable.
#include "Library/isopoint.h"
#include "Testing/Cxx/FailingAllocator.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <memory>
#include <random>
#include <vector>

namespace
{

constexpr std::size_t count = 50; // few: each allocation fails once

/// An extractor of samples, and what it gives. Its calls allocate nothing themselves.
struct Extraction
{
  std::array<double, 3 * count> positions{};
  std::array<double, count> values{};
  std::array<double, count> probed{};
  isopoint_array places{ positions.data(), ISOPOINT_DOUBLE, 3, count, 0, 0 };
  isopoint_array numbers{ values.data(), ISOPOINT_DOUBLE, 1, count, 0, 0 };
  isopoint_options options{};
  std::unique_ptr<isopoint_extractor, decltype(&isopoint_destroy_extractor)> extractor{
    isopoint_create_extractor(), isopoint_destroy_extractor
  };
  std::unique_ptr<isopoint_surface, decltype(&isopoint_destroy_surface)> surface{ nullptr,
    isopoint_destroy_surface };

  explicit Extraction(bool triangles)
  {
    std::mt19937 random(1);
    for (std::size_t i = 0; i < this->positions.size(); ++i)
    {
      this->positions[i] = std::uniform_real_distribution<double>(-1.0, 1.0)(random);
      this->values[i / 3] += this->positions[i] * this->positions[i];
    }
    isopoint_initialize_options(&this->options, sizeof(this->options));
    this->options.triangles = triangles ? 1 : 0;
    EXPECT_EQ(isopoint_set_extractor_threads(this->extractor.get(), 1), ISOPOINT_OK);
  }

  isopoint_status load()
  {
    return isopoint_set_samples(this->extractor.get(), &this->places, &this->numbers, nullptr);
  }

  isopoint_status extract()
  {
    const double isovalue = 0.6;
    isopoint_surface* made = nullptr;
    const isopoint_status status =
      isopoint_extract(this->extractor.get(), &isovalue, 1, &this->options, &made);
    this->surface.reset(made);
    return status;
  }

  isopoint_status probe()
  {
    const isopoint_probe_result result{ this->probed.data(), sizeof(this->probed), nullptr, 0 };
    return isopoint_probe(
      this->extractor.get(), &this->places, &this->numbers, 1, nullptr, &result, nullptr, 0);
  }

  /// What the extractor gives after another start.
  std::vector<double> results()
  {
    isopoint_array points{};
    EXPECT_EQ(this->load(), ISOPOINT_OK);
    EXPECT_EQ(this->probe(), ISOPOINT_OK);
    EXPECT_EQ(this->extract(), ISOPOINT_OK);
    EXPECT_EQ(isopoint_get_array(this->surface.get(), ISOPOINT_ARRAY_POINTS, &points), ISOPOINT_OK);
    const auto* const coordinates = static_cast<const double*>(points.data);
    std::vector<double> all(coordinates, coordinates + 3 * points.count);
    all.insert(all.end(), this->probed.begin(), this->probed.end());
    return all;
  }
};

/// Makes the n-th allocation of a call fail, for each n, and with each second n all later ones.
void failEach(bool triangles, bool isLoaded, isopoint_status (Extraction::*call)())
{
  const std::vector<double> expected = Extraction(triangles).results();
  EXPECT_GT(expected.size(), count + 30);
  int failures = 0;
  bool failed = true;
  for (long n = 1; failed; ++n)
  {
    SCOPED_TRACE(testing::Message() << "allocation " << n);
    Extraction extraction(triangles);
    ASSERT_TRUE(!isLoaded || extraction.load() == ISOPOINT_OK);
    failingallocator::failAt(n, n % 2 == 0, 1);
    const isopoint_status status = (extraction.*call)();
    failed = failingallocator::stop() >= n;
    if (status != ISOPOINT_OK)
    {
      ++failures;
      ASSERT_EQ(status, ISOPOINT_OUT_OF_MEMORY);
      ASSERT_STREQ(isopoint_get_error(),
        "Out of memory. Free memory, or reduce the number of samples or of places.");
    }
    ASSERT_EQ(extraction.results(), expected);
  }
  EXPECT_GT(failures, 5);
}

} // namespace

TEST(LibraryOutOfMemory, OfSamples)
{
  failEach(false, false, &Extraction::load);
}

TEST(LibraryOutOfMemory, OfSurfaces)
{
  failEach(false, true, &Extraction::extract);
  failEach(true, true, &Extraction::extract);
}

TEST(LibraryOutOfMemory, OfPlaces)
{
  failEach(false, true, &Extraction::probe);
}
