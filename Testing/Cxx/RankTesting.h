// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Descriptions.h"
#include "RandomClouds.h"
#include "ThreadRanks.h"

#include <gtest/gtest.h>

namespace ranks
{

using Request = isopoint::ExtractionRequest;

/// Clouds of every kind, of up to a few thousand samples.
inline std::vector<clouds::Cloud> variousClouds()
{
  return { clouds::uniform(3000, 1), clouds::clustered(2000, 2), clouds::lattice(14, 13, 12),
    clouds::coarse(1500, 6, 3), clouds::coincident(clouds::uniform(1200, 4), 0.4),
    clouds::lines(600, 5, 0, 5), clouds::lines(900, 7, 40, 6), clouds::combs(700, 9, 7),
    clouds::curves(900, 8), clouds::flattened(clouds::uniform(900, 9), 2),
    clouds::flattened(clouds::uniform(300, 10), 1), clouds::nestedCoincident(400),
    clouds::layerBeforeOne(900, 11) };
}

/// A request for points with random options.
inline Request randomRequest(clouds::Dice& dice)
{
  using isopoint::FitOrder;
  constexpr double angles[] = { 54.7, 54.7, 54.7, 0.0, 30.0, 120.0, 180.0 };
  Request request;
  request.isosurface.isovalue = 3.0 * dice.real() - 1.0;
  request.isosurface.angle = angles[dice(7)];
  request.isosurface.dropsGaps = dice(2) == 0;
  const std::size_t order = dice(7);
  if (order > 0)
  {
    request.isosurface.fit = isopoint::FitRequest{ std::nullopt, false };
  }
  if (order > 1)
  {
    request.isosurface.fit =
      isopoint::FitRequest{ static_cast<FitOrder>(std::min<std::size_t>(order - 1, 4)),
        dice(3) > 0 };
  }
  if (dice(4) > 0)
  {
    request.splats =
      isopoint::SplatOptions{ 3 + static_cast<int>(dice(12)), dice(5) > 0, dice(5) > 0 };
  }
  return request;
}

/// How a cloud is dealt out. Ids count through the ranks: the cloud of one rank is that of all
/// ranks in their order.
enum class Deal
{
  Even,       // consecutive samples, as many to each rank
  RoundRobin, // one to each in turn
  First,      // all to the first rank
  Last,       // all to the last one
  Skewed,     // half of what is left to each
  Spatial     // by x
};

const std::vector<Deal> allDeals{ Deal::Even, Deal::RoundRobin, Deal::First, Deal::Last,
  Deal::Skewed, Deal::Spatial };

inline std::size_t rankOf(
  const clouds::Cloud& cloud, std::size_t sample, std::size_t size, Deal deal)
{
  const std::size_t count = cloud.size();
  std::size_t rank = 0;
  switch (deal)
  {
    case Deal::Even:
      return sample * size / count;
    case Deal::RoundRobin:
      return sample % size;
    case Deal::First:
      return 0;
    case Deal::Last:
      return size - 1;
    case Deal::Skewed:
      for (std::size_t left = count / 2; sample > left && rank + 1 < size;
           left += (count - left) / 2)
      {
        ++rank;
      }
      return rank;
    default:
      const double slab = std::floor(std::clamp(4.0 * cloud.at(sample)[0], -1e6, 1e6));
      return static_cast<std::size_t>(std::abs(slab)) % size;
  }
}

inline std::vector<clouds::Cloud> dealOut(const clouds::Cloud& cloud, std::size_t size, Deal deal)
{
  std::vector<clouds::Cloud> pieces(size);
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    pieces[rankOf(cloud, i, size, deal)].add(cloud.at(i), cloud.values[i]);
  }
  return pieces;
}

inline clouds::Cloud concatenated(const std::vector<clouds::Cloud>& pieces)
{
  clouds::Cloud all;
  for (const clouds::Cloud& piece : pieces)
  {
    all.positions.insert(all.positions.end(), piece.positions.begin(), piece.positions.end());
    all.values.insert(all.values.end(), piece.values.begin(), piece.values.end());
  }
  return all;
}

/// The number of samples on lower ranks.
inline std::size_t firstOf(const std::vector<clouds::Cloud>& pieces, std::size_t rank)
{
  const auto end = pieces.begin() + static_cast<std::ptrdiff_t>(rank);
  return std::accumulate(pieces.begin(), end, std::size_t{ 0 },
    [](std::size_t sum, const clouds::Cloud& piece) { return sum + piece.size(); });
}

/// The points that are counted, and the triangles, of several ranks: each kind ordered.
inline std::pair<Description, Description> contentsOf(const std::vector<Extracted>& ranks)
{
  Description points;
  Description triangles;
  for (const Extracted& rank : ranks)
  {
    for (std::size_t i = 0; i < rank.surface.size(); ++i)
    {
      if (rank.areGhosts.empty() || !rank.areGhosts[i])
      {
        points.push_back(described(rank, i));
      }
    }
    const Description own = describedTriangles(rank);
    triangles.insert(triangles.end(), own.begin(), own.end());
  }
  std::sort(points.begin(), points.end());
  std::sort(triangles.begin(), triangles.end());
  return { points, triangles };
}

/// Does work on ranks that are threads: work(processes) on each of them.
template <class Work>
void onRanks(std::size_t size, const Work& work)
{
  ThreadRanks threads(static_cast<int>(size));
  threads.run(
    [&](isopoint::Communicator& communicator)
    {
      isopoint::ProcessGroup processes(communicator);
      processes.runCollectively(
        [&]() { work(processes, static_cast<std::size_t>(processes.rank())); });
    });
}

/// Whether values are loaded with the positions, or replace others after an extraction.
enum class Values
{
  Loaded,
  Replaced
};

/// The same positions with other values.
inline clouds::Cloud withOtherValues(clouds::Cloud cloud)
{
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    cloud.values[i] = 0.4 - 0.7 * cloud.values[i] + 0.3 * std::sin(5.0 * cloud.positions[3 * i]);
  }
  return cloud;
}

/// Extracts one request after the other on ranks that are threads.
/// @returns by request what each rank has
template <class TCoordinate = double, class TValue = double>
std::vector<std::vector<Extracted>> extractOnRanks(const std::vector<clouds::Cloud>& pieces,
  const std::vector<Request>& requests, std::size_t threads = 1, Values values = Values::Loaded)
{
  std::vector<std::vector<Extracted>> all(requests.size(), std::vector<Extracted>(pieces.size()));
  onRanks(pieces.size(),
    [&](isopoint::ProcessGroup& processes, std::size_t rank)
    {
      const clouds::Cloud& piece = pieces[rank];
      const isopoint::Execution execution = clouds::executionOn(threads);
      isopoint::IsosurfaceExtractor extractor;
      const clouds::Cloud first = values == Values::Loaded ? piece : withOtherValues(piece);
      extractor.load<TCoordinate, TValue>(
        execution, processes, first.size(), clouds::readerOf(first));
      if (values == Values::Replaced)
      {
        extractor.extract(execution, requests.front());
        const bool isReplaced = extractor.replaceValues<TCoordinate, TValue>(
          execution, piece.size(), clouds::readerOf(piece));
        EXPECT_TRUE(isReplaced || concatenated(pieces).size() == 0);
      }
      for (std::size_t i = 0; i < requests.size(); ++i)
      {
        all[i][rank] = extractor.extract(execution, requests[i]);
      }
    });
  return all;
}

/// Expects the points and triangles of one rank on several, each once and in order.
template <class TCoordinate = double, class TValue = double>
void expectSameAsOneRank(const clouds::Cloud& cloud, std::size_t size, Deal deal,
  const std::vector<Request>& requests, std::size_t threads = 1, Values values = Values::Loaded)
{
  const std::vector<clouds::Cloud> pieces = dealOut(cloud, size, deal);
  auto extractor = clouds::loaded<TCoordinate, TValue>(concatenated(pieces));
  const auto found = extractOnRanks<TCoordinate, TValue>(pieces, requests, threads, values);
  for (std::size_t i = 0; i < requests.size(); ++i)
  {
    SCOPED_TRACE(
      testing::Message() << size << " ranks, deal " << static_cast<int>(deal) << ", request " << i);
    const auto [expectedPoints, expectedTriangles] =
      contentsOf({ extractor.extract({}, requests[i]) });
    const auto [points, triangles] = contentsOf(found[i]);
    ASSERT_EQ(points.size(), expectedPoints.size());
    ASSERT_TRUE(points == expectedPoints);
    ASSERT_EQ(triangles.size(), expectedTriangles.size());
    ASSERT_TRUE(triangles == expectedTriangles);
    for (const Extracted& rank : found[i])
    {
      EXPECT_TRUE(std::is_sorted(rank.triangles.begin(), rank.triangles.end()));
      EXPECT_EQ(rank.ghostTriangles, 0u);
      EXPECT_EQ(rank.areGhosts.size(), requests[i].triangles ? rank.surface.size() : 0u);
      // Vertices on creases of triangles follow behind all others.
      EXPECT_TRUE(requests[i].triangles ||
                  std::is_sorted(rank.surface.edges.begin(), rank.surface.edges.end()));
    }
  }
}

} // namespace ranks
