// SPDX-License-Identifier: GPL-3.0-or-later
// What must not change the result: threads, the order of extractions, a kept tree, an abort.
#include "RankTesting.h"

#include "Core/Extraction/NarrowBand.h"
#include "Core/Extraction/SingleRank.h"

namespace
{

using namespace isopoint;
using clouds::requestOf;

/// Compares the bytes of everything that leaves the core.
void expectSame(const ExtractedIsosurface& expected, const ExtractedIsosurface& found)
{
  EXPECT_FALSE(expected.surface.edges.empty());
  EXPECT_TRUE(ranks::described(expected) == ranks::described(found));
  EXPECT_TRUE(expected.triangles == found.triangles);
}

IsosurfaceExtractor loaded(const clouds::Cloud& cloud, std::size_t threads = 1)
{
  return clouds::loaded<float, float>(cloud, threads);
}

ExtractedIsosurface extracted(
  const clouds::Cloud& cloud, const ExtractionRequest& request, std::size_t threads = 1)
{
  return clouds::extracted<float, float>(cloud, request, threads);
}

/// Of fits and splats.
ExtractionRequest whole(double isovalue, FitOrder order)
{
  return clouds::withSplats(requestOf(isovalue, order));
}

ExtractionRequest triangles(double isovalue, bool regularizes = false)
{
  return clouds::withTriangles(
    clouds::withSplats(requestOf(isovalue, FitOrder::Cubic, true)), regularizes);
}

} // namespace

// Large enough for nodes that all threads split together.
TEST(SameResult, ForAnyNumberOfThreads)
{
  constexpr std::size_t count = 400000;
  for (const clouds::Cloud& cloud : { clouds::uniform(count, 1),
         clouds::coincident(clouds::clustered(count, 2), 0.1), clouds::lattice(70, 71, 72) })
  {
    const ExtractedIsosurface expected = extracted(cloud, requestOf(0.2));
    for (const std::size_t threads : { 2, 4, 7 })
    {
      SCOPED_TRACE(threads);
      expectSame(expected, extracted(cloud, requestOf(0.2), threads));
    }
  }
}

// On lines and curves fits use representatives of large neighborhoods, which must not depend on
// earlier extractions.
TEST(SameResult, OfEverythingAfterOtherExtractions)
{
  using clouds::lessIfSlow;
  for (const clouds::Cloud& cloud :
    { clouds::coincident(clouds::uniform(lessIfSlow(10000), 9), 0.02),
      clouds::clustered(lessIfSlow(2000), 7), clouds::lattice(12, 12, 12),
      clouds::lines(lessIfSlow(1500), 3, 0, 5), clouds::curves(lessIfSlow(1500), 6) })
  {
    IsosurfaceExtractor kept = loaded(cloud);
    std::size_t points = 0;
    for (const ExtractionRequest& request :
      { whole(0.3, FitOrder::Cubic), whole(0.3, FitOrder::Crease), whole(-0.1, FitOrder::Quadratic),
        triangles(0.3), triangles(0.3, true), requestOf(0.2, std::nullopt, false, 20.0),
        whole(0.3, FitOrder::Cubic) })
    {
      const ExtractedIsosurface expected = extracted(cloud, request);
      expectSame(expected, extracted(cloud, request, 5));
      expectSame(expected, kept.extract(clouds::executionOn(2), request));
      points += expected.surface.size();
    }
    EXPECT_GT(points, lessIfSlow(500));
  }
}

// Large enough for several ranges of its points and vertices.
TEST(SameResult, OfManyPointsForAnyThreads)
{
  const clouds::Cloud cloud = clouds::uniform(70000, 8);
  for (const ExtractionRequest& request :
    { whole(0.3, FitOrder::Cubic), triangles(0.3), triangles(0.3, true) })
  {
    const ExtractedIsosurface expected = extracted(cloud, request);
    EXPECT_GT(expected.surface.size(), 4096u);
    expectSame(expected, extracted(cloud, request, 3));
  }
}

// The left one of two blocks has the same splats whatever positions and values the right one has,
// as long as the plane between the blocks stays.
TEST(SameResult, OfSplatsWhateverIsFarAway)
{
  constexpr std::size_t count = 20000;
  const auto blocks = [](double far)
  {
    clouds::Cloud cloud;
    clouds::Random random(3);
    for (std::size_t i = 0; i < 2 * count; ++i)
    {
      const auto [x, y, z] = random.place();
      const double edge = std::max(x + 0.2 * y, z) - 0.5 + 0.3 * std::max(0.0, y - 0.5) * x;
      i < count ? cloud.add(10.0 * x, 10.0 * y, 10.0 * z, edge)
                : cloud.add(100.0 + 10.0 * std::pow(x, far), 10.0 * y, 10.0 * z,
                    std::sin(far * 9.0 * x) * y - 0.1);
    }
    // The corners of the bounding box, and of the block on the right.
    std::fill_n(cloud.positions.begin() + 1, 2, 0.0);
    std::fill_n(cloud.positions.begin() + 4, 2, 10.0);
    const clouds::Vector corner{ 100.0, 5.0, 5.0 };
    std::copy(corner.begin(), corner.end(), cloud.positions.begin() + 3 * count);
    cloud.values[0] = cloud.values[count] = 1.0;
    return cloud;
  };
  for (const std::optional<FitOrder> order :
    { std::optional<FitOrder>(), { FitOrder::Cubic }, { FitOrder::Crease } })
  {
    ExtractionRequest request = clouds::withSplats(requestOf(0.0));
    request.isosurface.fit = FitRequest{ order, true };
    const auto leftOf = [&](double far)
    {
      const ExtractedIsosurface found = extracted(blocks(far), request, 2);
      ranks::Description points;
      for (std::size_t i = 0; i < found.surface.size(); ++i)
      {
        if (found.surface.edges[i].second < count && found.surface.positions[i][0] < 5.0)
        {
          points.push_back(ranks::described(found, i));
        }
      }
      return points;
    };
    const ranks::Description expected = leftOf(1.0);
    EXPECT_GT(expected.size(), 500u);
    EXPECT_TRUE(leftOf(1.5) == expected);
  }
}

TEST(SameResult, ForNewValuesAtKeptPositions)
{
  const Execution execution = clouds::executionOn(2);
  const clouds::Cloud cloud = clouds::coincident(clouds::uniform(30000, 4), 0.05);
  const clouds::Cloud other =
    clouds::withValuesOf(cloud, [](const clouds::Vector& p) { return p[0] - p[1]; });
  IsosurfaceExtractor kept = loaded(cloud);
  kept.extract(execution, requestOf(0.5));
  ASSERT_TRUE((kept.replaceValues<float, float>(execution, other.size(), clouds::readerOf(other))));
  expectSame(extracted(other, requestOf(0.1), 2), kept.extract(execution, requestOf(0.1)));
}

TEST(SameResult, ValuesAreReplacedOnlyAtEqualPositions)
{
  clouds::Cloud cloud = clouds::uniform(1000, 5);
  const auto read = clouds::readerOf(cloud);
  IsosurfaceExtractor kept = loaded(cloud);
  cloud.positions[1500] += 0.25;
  EXPECT_FALSE((kept.replaceValues<float, float>({}, cloud.size(), read)));
  cloud.positions[1500] -= 0.25;
  EXPECT_FALSE((kept.replaceValues<double, float>({}, cloud.size(), read)));
  EXPECT_FALSE((kept.replaceValues<float, float>({}, cloud.size() - 1, read)));
  cloud.values[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE((kept.replaceValues<float, float>({}, cloud.size(), read)));
}

TEST(SameResult, WithSamplesLeftOut)
{
  const clouds::Cloud cloud = clouds::uniform(200000, 6);
  clouds::Cloud partlyInvalid = cloud;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double bad[3] = { std::numeric_limits<double>::quiet_NaN(), infinity, -infinity };
  std::vector<std::size_t> ids;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    if (i % 5 == 2)
    {
      (i % 2 ? partlyInvalid.values[i] : partlyInvalid.positions[3 * i + i % 3]) = bad[i % 3];
    }
    else
    {
      ids.push_back(i);
    }
  }
  IsosurfaceExtractor extractor = loaded(partlyInvalid, 3);
  EXPECT_EQ(extractor.skippedCount(), cloud.size() - ids.size());
  ExtractedIsosurface expected = extracted(clouds::permuted(cloud, ids), requestOf(0.5));
  for (IsopointEdge& edge : expected.surface.edges)
  {
    edge.first = ids[edge.first];
    edge.second = ids[edge.second];
  }
  expectSame(expected, extractor.extract({}, requestOf(0.5)));
}

// Deeper than the 64 levels that a binary index of one machine word can represent.
TEST(SameResult, ForVeryDeepTrees)
{
  const clouds::Cloud cloud = clouds::nestedCoincident(std::size_t{ 1 } << 21);
  const Execution execution = clouds::executionOn(2);
  auto tree = loadSamples<WideSample>(execution, cloud.size(), clouds::readerOf(cloud));
  SingleRank<WideSample> rank(tree);
  const auto band = NarrowBand<WideSample>(tree, 3.5, execution).refine(rank);
  EXPECT_GT(clouds::largestOf(band, [](BinaryIndex index) { return depthOf(index); }), 64);
  expectSame(extracted(cloud, requestOf(3.5)), extracted(cloud, requestOf(3.5), 3));
}

TEST(SameResult, AfterAnAbortAtAnyTime)
{
  const clouds::Cloud cloud = clouds::uniform(5000, 7);
  for (const ExtractionRequest& request :
    { whole(0.5, FitOrder::Cubic), triangles(0.5), triangles(0.5, true) })
  {
    int asked = 0;
    Execution counting;
    counting.isAborted = [&asked]() { return ++asked < 0; };
    const ExtractedIsosurface expected = loaded(cloud).extract(counting, request);
    ASSERT_GT(asked, 20);
    for (int last = 0; last < asked; last += 1 + asked / 12)
    {
      int left = last;
      Execution aborting;
      aborting.isAborted = [&left]() { return left-- <= 0; };
      IsosurfaceExtractor extractor = loaded(cloud);
      EXPECT_THROW(extractor.extract(aborting, request), Aborted);
      expectSame(expected, extractor.extract(clouds::executionOn(2), request));
    }
  }
}
