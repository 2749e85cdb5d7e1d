// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RankTesting_h
#define RankTesting_h

#include "Clouds.h"
#include "ThreadRanks.h"

#include "Core/Base/Team.h"
#include "Core/IsosurfaceExtractor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

namespace ranks
{

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

/// How a cloud is dealt out. Ids count through the ranks: the cloud of one process is that of all
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

constexpr Deal allDeals[] = { Deal::Even, Deal::RoundRobin, Deal::First, Deal::Last, Deal::Skewed,
  Deal::Spatial };

inline std::size_t rankOf(
  const clouds::Cloud& cloud, std::size_t sample, std::size_t size, Deal deal)
{
  const std::size_t count = cloud.size();
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
    {
      std::size_t rank = 0;
      for (std::size_t left = count / 2; sample > left && rank + 1 < size;
           left += (count - left) / 2)
      {
        ++rank;
      }
      return rank;
    }
    default:
    {
      const double x = 4.0 * cloud.positions[3 * sample];
      const auto slab = static_cast<std::size_t>(std::abs(std::floor(std::clamp(x, -1e6, 1e6))));
      return slab % size;
    }
  }
}

inline std::vector<clouds::Cloud> dealOut(const clouds::Cloud& cloud, std::size_t size, Deal deal)
{
  std::vector<clouds::Cloud> pieces(size);
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const double* const position = cloud.positions.data() + 3 * i;
    pieces[rankOf(cloud, i, size, deal)].add(
      position[0], position[1], position[2], cloud.values[i]);
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

/// All that is known of one isopoint, as text to compare: every number by its bits.
inline std::string described(const isopoint::ExtractedIsosurface& extracted, std::size_t i)
{
  std::string text;
  const auto put = [&text](const auto& value)
  { text.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  const isopoint::Isosurface& surface = extracted.surface;
  for (std::size_t edge = surface.edgeBegin(i); edge < surface.edgeBegin(i + 1); ++edge)
  {
    put(surface.edges[edge].first);
    put(surface.edges[edge].second);
    put(surface.edges[edge].parameter);
  }
  put(surface.positions[i]);
  put(surface.decreasingEdges[i]);
  const auto putPlane = [&](const isopoint::CreasePlane& plane)
  {
    put(plane.inward);
    put(plane.distance);
    put(plane.turn);
  };
  if (!surface.fits.empty())
  {
    const isopoint::LocalFit& fit = surface.fits[i];
    put(fit.position);
    put(fit.gradient);
    put(fit.isGradientFitted);
    put(fit.hessian);
    put(fit.isSmooth);
    put(fit.spacing);
    put(fit.order ? static_cast<int>(*fit.order) : 0);
    std::for_each(fit.creases.begin(), fit.creases.end(), putPlane);
  }
  if (!extracted.splats.empty())
  {
    const isopoint::Splat& splat = extracted.splats[i];
    put(splat.normal);
    put(splat.radius);
    put(splat.axis);
    put(splat.corners);
  }
  if (!extracted.normals.empty())
  {
    put(extracted.normals[i]);
  }
  for (std::size_t end = 2 * surface.edgeBegin(i); end < 2 * surface.edgeBegin(i + 1); ++end)
  {
    const isopoint::IsopointEdge& edge = surface.edges[end / 2];
    const std::uint64_t id = end % 2 == 0 ? edge.first : edge.second;
    if (const isopoint::CoincidentSamples* const group = surface.coincidentAt(id))
    {
      text.append("coincident");
      for (const std::uint64_t other : group->ids)
      {
        put(other);
      }
    }
  }
  return text;
}

using Description = std::vector<std::string>;

inline Description described(const isopoint::ExtractedIsosurface& extracted)
{
  Description all;
  for (std::size_t i = 0; i < extracted.surface.size(); ++i)
  {
    all.push_back(described(extracted, i));
  }
  return all;
}

/// Whether the values are there from the beginning, or replace others after an extraction.
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

/// Does work on ranks that are threads: work(team) on each of them.
template <class Work>
void onRanks(std::size_t size, const Work& work)
{
  ThreadRanks threads(static_cast<int>(size));
  threads.run(
    [&](isopoint::Communicator& communicator)
    {
      isopoint::Team team(communicator);
      team.together([&]() { work(team); });
    });
}

/// Extracts, one after the other, on ranks that are threads. @returns the points of all ranks, by
/// request
template <class TCoordinate = double, class TValue = double>
std::vector<Description> extractOnRanks(const std::vector<clouds::Cloud>& pieces,
  const std::vector<isopoint::ExtractionRequest>& requests, std::size_t threads = 1,
  Values values = Values::Loaded)
{
  std::vector<Description> all(requests.size());
  std::mutex mutex;
  onRanks(pieces.size(),
    [&](isopoint::Team& team)
    {
      const clouds::Cloud& piece = pieces[static_cast<std::size_t>(team.rank())];
      const isopoint::Execution execution = clouds::executionOn(threads);
      isopoint::IsosurfaceExtractor extractor;
      const clouds::Cloud first = values == Values::Loaded ? piece : withOtherValues(piece);
      extractor.load<TCoordinate, TValue>(execution, team, first.size(), clouds::readerOf(first));
      if (values == Values::Replaced)
      {
        extractor.extract(execution, requests.front());
        const bool isReplaced = extractor.replaceValues<TCoordinate, TValue>(
          execution, piece.size(), clouds::readerOf(piece));
        EXPECT_TRUE(isReplaced || concatenated(pieces).size() == 0);
      }
      for (std::size_t i = 0; i < requests.size(); ++i)
      {
        const isopoint::ExtractedIsosurface extracted = extractor.extract(execution, requests[i]);
        // Vertices on creases of triangles follow behind all others.
        EXPECT_TRUE(requests[i].triangles ||
                    std::is_sorted(extracted.surface.edges.begin(), extracted.surface.edges.end()));
        const Description own = described(extracted);
        const std::lock_guard<std::mutex> lock(mutex);
        all[i].insert(all[i].end(), own.begin(), own.end());
      }
    });
  return all;
}

/// What one rank has, and its ghosts.
struct RankPoints
{
  isopoint::ExtractedIsosurface own;
  isopoint::ExtractedIsosurface ghosts;
};

/// Extracts with ghosts, on ranks that are threads. @returns what each rank has
inline std::vector<RankPoints> extractWithGhosts(
  const std::vector<clouds::Cloud>& pieces, const isopoint::ExtractionRequest& request)
{
  std::vector<RankPoints> all(pieces.size());
  onRanks(pieces.size(),
    [&](isopoint::Team& team)
    {
      const auto rank = static_cast<std::size_t>(team.rank());
      isopoint::IsosurfaceExtractor extractor;
      extractor.load<double, double>(
        isopoint::Execution(), team, pieces[rank].size(), clouds::readerOf(pieces[rank]));
      all[rank].own = extractor.extract(isopoint::Execution(), request, &all[rank].ghosts);
    });
  return all;
}

template <class TCoordinate = double, class TValue = double>
void expectSameAsOneProcess(const clouds::Cloud& cloud, int size, Deal deal,
  const std::vector<isopoint::ExtractionRequest>& requests, std::size_t threads = 1,
  Values values = Values::Loaded)
{
  const std::vector<clouds::Cloud> pieces = dealOut(cloud, static_cast<std::size_t>(size), deal);
  const clouds::Cloud all = concatenated(pieces);
  isopoint::IsosurfaceExtractor extractor;
  extractor.load<TCoordinate, TValue>(isopoint::Execution(), all.size(), clouds::readerOf(all));
  std::vector<Description> found =
    extractOnRanks<TCoordinate, TValue>(pieces, requests, threads, values);
  for (std::size_t i = 0; i < requests.size(); ++i)
  {
    Description expected = described(extractor.extract(isopoint::Execution(), requests[i]));
    std::sort(expected.begin(), expected.end());
    std::sort(found[i].begin(), found[i].end());
    ASSERT_EQ(expected.size(), found[i].size()) << "request " << i;
    std::size_t differing = 0;
    for (std::size_t point = 0; point < expected.size(); ++point)
    {
      differing += expected[point] != found[i][point] ? 1 : 0;
    }
    ASSERT_EQ(0u, differing) << "of " << expected.size() << ", request " << i;
  }
}

} // namespace ranks

#endif
