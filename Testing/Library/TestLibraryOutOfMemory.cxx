// SPDX-License-Identifier: GPL-3.0-or-later
// Each allocation of a call is made to fail: the call says so without any memory, and its extractor
// stays usable.
#include "Library/isopoint.h"
#include "Testing/Cxx/FailingAllocator.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <random>
#include <vector>

namespace
{

constexpr std::size_t count = 50; // few: each allocation fails once

/// An extractor of samples, and what it gives.
struct Extraction
{
  std::vector<double> positions;
  std::vector<double> values;
  std::vector<double> probed;
  isopoint_options options;
  std::unique_ptr<isopoint_extractor, decltype(&isopoint_destroy_extractor)> extractor{
    isopoint_create_extractor(), isopoint_destroy_extractor
  };

  Extraction()
    : positions(3 * count)
    , values(count)
    , probed(count)
  {
    std::mt19937 random(1);
    for (std::size_t i = 0; i < this->positions.size(); ++i)
    {
      this->positions[i] = std::uniform_real_distribution<double>(-1.0, 1.0)(random);
      this->values[i / 3] += this->positions[i] * this->positions[i];
    }
    isopoint_initialize_options(&this->options, sizeof(this->options));
    EXPECT_EQ(isopoint_set_extractor_threads(this->extractor.get(), 1), ISOPOINT_OK);
  }

  isopoint_status load()
  {
    const isopoint_array places{ this->positions.data(), ISOPOINT_DOUBLE, 3, count, 0, 0 };
    const isopoint_array numbers{ this->values.data(), ISOPOINT_DOUBLE, 1, count, 0, 0 };
    return isopoint_set_samples(this->extractor.get(), &places, &numbers, nullptr);
  }

  isopoint_status extract(std::vector<double>* isovalues = nullptr)
  {
    const double isovalue = 0.6;
    isopoint_surface* surface = nullptr;
    const isopoint_status status =
      isopoint_extract(this->extractor.get(), &isovalue, 1, &this->options, &surface);
    isopoint_array points;
    if (surface && isovalues && isopoint_get_array(surface, 0, &points) == ISOPOINT_OK)
    {
      const auto* const numbers = static_cast<const double*>(points.data);
      isovalues->assign(numbers, numbers + 3 * points.count);
    }
    isopoint_destroy_surface(surface);
    return status;
  }

  isopoint_status probe()
  {
    const isopoint_array places{ this->positions.data(), ISOPOINT_DOUBLE, 3, count, 0, 0 };
    const isopoint_array numbers{ this->values.data(), ISOPOINT_DOUBLE, 1, count, 0, 0 };
    const isopoint_probe_result result{ this->probed.data(), 8 * count, nullptr, 0 };
    return isopoint_probe(
      this->extractor.get(), &places, &numbers, 1, nullptr, &result, nullptr, 0);
  }

  /// What a loaded extractor gives.
  std::vector<double> results()
  {
    std::vector<double> all;
    EXPECT_EQ(this->extract(&all), ISOPOINT_OK);
    EXPECT_EQ(this->probe(), ISOPOINT_OK);
    all.insert(all.end(), this->probed.begin(), this->probed.end());
    return all;
  }
};

/// Makes the n-th allocation of a call on a new extractor fail, for each n.
/// @param prepare what comes before the call
void failEach(bool triangles, const std::function<isopoint_status(Extraction&)>& prepare,
  const std::function<isopoint_status(Extraction&)>& call)
{
  std::vector<double> expected;
  int failures = 0;
  bool failed = true;
  for (long n = 0; failed; ++n) // 0: none
  {
    SCOPED_TRACE(testing::Message() << "allocation " << n);
    Extraction extraction;
    extraction.options.triangles = triangles ? 1 : 0;
    ASSERT_EQ(prepare(extraction), ISOPOINT_OK);
    failingallocator::failAt(n, n % 2 == 0, 1);
    const isopoint_status status = call(extraction);
    failed = failingallocator::stop() >= n;
    if (status != ISOPOINT_OK)
    {
      ++failures;
      ASSERT_EQ(status, ISOPOINT_OUT_OF_MEMORY);
      ASSERT_STREQ(isopoint_get_error(),
        "Out of memory. Free memory, or reduce the number of samples or of places.");
    }
    ASSERT_EQ(extraction.load(), ISOPOINT_OK);
    const std::vector<double> results = extraction.results();
    expected = expected.empty() ? results : expected;
    ASSERT_EQ(results, expected);
  }
  EXPECT_GT(expected.size(), count);
  EXPECT_GT(failures, 5);
}

isopoint_status nothing(Extraction&)
{
  return ISOPOINT_OK;
}

isopoint_status load(Extraction& extraction)
{
  return extraction.load();
}

isopoint_status extract(Extraction& extraction)
{
  return extraction.extract();
}

} // namespace

TEST(LibraryOutOfMemory, OfSamples)
{
  failEach(false, nothing, load);
}

TEST(LibraryOutOfMemory, OfSurfaces)
{
  failEach(false, load, extract);
  failEach(true, load, extract);
}

TEST(LibraryOutOfMemory, OfPlaces)
{
  failEach(false, load, [](Extraction& extraction) { return extraction.probe(); });
}
