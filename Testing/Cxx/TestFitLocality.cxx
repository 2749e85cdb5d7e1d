// SPDX-License-Identifier: GPL-3.0-or-later
// What fits and splats depend on: the samples around them alone (docs/algorithm.md, section 10),
// not on samples elsewhere, or on ids.
#include "FitTesting.h"
#include "RingDefinition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>
#include <vector>

using namespace fittesting;

namespace
{

using ringdefinition::Rings;

constexpr double missing = std::numeric_limits<double>::quiet_NaN(); // such samples take no part

/// Everything of an isopoint that a fit decides, as numbers.
std::vector<double> numbersOf(const LocalFit& fit)
{
  std::vector<double> numbers{ fit.spacing, fit.isGradientFitted ? 1.0 : 0.0,
    fit.isSmooth ? 1.0 : 0.0, fit.order ? static_cast<double>(*fit.order) : 0.0 };
  numbers.insert(numbers.end(), fit.position.begin(), fit.position.end());
  numbers.insert(numbers.end(), fit.gradient.begin(), fit.gradient.end());
  numbers.insert(numbers.end(), fit.hessian.begin(), fit.hessian.end());
  for (const isopoint::CreasePlane& plane : fit.creases)
  {
    numbers.insert(numbers.end(), plane.inward.begin(), plane.inward.end());
    numbers.insert(numbers.end(), { plane.distance, plane.turn });
  }
  return numbers;
}

std::vector<double> numbersOf(const isopoint::Splat& splat)
{
  std::vector<double> numbers{ splat.radius };
  numbers.insert(numbers.end(), splat.normal.begin(), splat.normal.end());
  numbers.insert(numbers.end(), splat.axis.begin(), splat.axis.end());
  for (const isopoint::SplatCorner& corner : splat.corners)
  {
    numbers.insert(numbers.end(),
      { corner.along, corner.across, corner.height, corner.slopeAlong, corner.slopeAcross });
  }
  return numbers;
}

bool areSameBits(const std::vector<double>& a, const std::vector<double>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

using Ends = std::pair<std::uint64_t, std::uint64_t>;

/// What an extraction yields for each edge, fits and splats.
using Numbers = std::map<Ends, std::vector<double>>;

Numbers extracted(const clouds::Cloud& cloud, double isovalue, FitOrder order, bool withSplats)
{
  const isopoint::Execution execution;
  isopoint::IsosurfaceExtractor extractor;
  const auto read = [all = clouds::readerOf(cloud)](std::size_t id, auto* position, auto& value)
  { return all(id, position, value) && !std::isnan(value); };
  extractor.load<double, double>(execution, cloud.size(), read);
  isopoint::ExtractionRequest request;
  request.isosurface.isovalue = isovalue;
  request.isosurface.fit = FitRequest{ order, true };
  if (withSplats)
  {
    request.splats = isopoint::SplatOptions();
  }
  const isopoint::ExtractedIsosurface found = extractor.extract(execution, request);
  Numbers all;
  for (std::size_t i = 0; i < found.surface.size(); ++i)
  {
    std::vector<double> numbers = numbersOf(found.surface.fits[i]);
    numbers.push_back(found.surface.edges[i].parameter);
    if (withSplats)
    {
      const std::vector<double> ofSplat = numbersOf(found.splats[i]);
      numbers.insert(numbers.end(), ofSplat.begin(), ofSplat.end());
    }
    all[{ found.surface.edges[i].first, found.surface.edges[i].second }] = numbers;
  }
  return all;
}

/// A cell with all that a fit may see of it.
using SeenCell = std::vector<double>;

SeenCell seenOf(const ringdefinition::Cell& cell)
{
  SeenCell seen{ cell.value };
  for (const Vector& v : { cell.region.lower, cell.region.upper, cell.position })
  {
    seen.insert(seen.end(), v.begin(), v.end());
  }
  seen.insert(seen.end(), cell.path.begin(), cell.path.end());
  return seen;
}

/// All cells within two rings of an edge, whatever their values, in the order of the tree.
std::vector<SeenCell> domainOf(const Rings& rings, const Ends& edge)
{
  std::set<std::size_t> cells{ rings.cellOf(edge.first), rings.cellOf(edge.second) };
  for (int ring = 0; ring < 2; ++ring)
  {
    const std::set<std::size_t> inner = cells;
    for (const std::size_t cell : inner)
    {
      cells.insert(rings.neighborsOf(cell).begin(), rings.neighborsOf(cell).end());
    }
  }
  std::vector<SeenCell> domain;
  for (const std::size_t cell : cells)
  {
    domain.push_back(seenOf(rings.cells()[cell]));
  }
  return domain;
}

/// Expects the same bits wherever nothing has changed within two rings.
/// @returns how many isopoints that are
std::size_t expectSameWhereNothingChanged(
  const clouds::Cloud& before, const clouds::Cloud& after, double isovalue, FitOrder order)
{
  const Rings ringsBefore(before);
  const Rings ringsAfter(after);
  const Numbers numbersBefore = extracted(before, isovalue, order, false);
  const Numbers numbersAfter = extracted(after, isovalue, order, false);
  std::size_t same = 0;
  for (const auto& [edge, numbers] : numbersBefore)
  {
    const auto found = numbersAfter.find(edge);
    if (found != numbersAfter.end() && domainOf(ringsBefore, edge) == domainOf(ringsAfter, edge))
    {
      EXPECT_TRUE(areSameBits(numbers, found->second)) << edge.first << ' ' << edge.second;
      ++same;
    }
  }
  return same;
}

double noisyDistance(const Vector& p, clouds::Random& random)
{
  return lengthOf(p) + 0.3 * (random() - 0.5);
}

} // namespace

// Values change in one corner, where noise, steps and isopoints come and go.
TEST(FitLocality, ValuesBeyondTwoRingsDoNotCount)
{
  for (const std::uint64_t seed : { 1, 2, 3, 4, 5, 6 })
  {
    SCOPED_TRACE(seed);
    clouds::Random random(seed);
    const clouds::Cloud before =
      cloudOf([&](const Vector& p) { return noisyDistance(p, random); }, 700, 8.9);
    clouds::Cloud after = before;
    for (std::size_t i = 0; i < after.size(); ++i)
    {
      if (after.positions[3 * i] > 2.0 + 0.3 * static_cast<double>(seed))
      {
        after.values[i] = 6.0 * random();
      }
    }
    const FitOrder order = seed % 2 == 0 ? FitOrder::Crease : FitOrder::Cubic;
    EXPECT_GT(expectSameWhereNothingChanged(before, after, 3.0, order), 20u);
  }
}

// The part of the tree that is refined differs as well.
TEST(FitLocality, SamplesBeyondTwoRingsDoNotCount)
{
  for (const std::uint64_t seed : { 1, 2, 3, 4, 5, 6 })
  {
    SCOPED_TRACE(seed);
    clouds::Random random(seed);
    clouds::Cloud before =
      cloudOf([&](const Vector& p) { return noisyDistance(p, random); }, 700, 8.9);
    for (std::size_t i = 0; i < before.size(); ++i)
    {
      before.positions[3 * i] *= 1.5; // so that the longest side is certain
    }
    clouds::Cloud after = before;
    for (std::size_t i = 0; i < after.size(); ++i)
    {
      double* const p = after.positions.data() + 3 * i;
      const bool isInside = p[0] < 6.0 && std::abs(p[1]) < 4.0 && std::abs(p[2]) < 4.0;
      if (p[0] > 1.0 && isInside) // the bounding box stays, and the plane of the root
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          p[axis] += 0.4 * (random() - 0.5);
        }
        after.values[i] += random() - 0.5;
      }
    }
    const FitOrder order = seed % 2 == 0 ? FitOrder::Crease : FitOrder::Cubic;
    EXPECT_GT(expectSameWhereNothingChanged(before, after, 3.0, order), 10u);
  }
}

// The ids that samples have, where they keep their order: others in between take no part.
TEST(FitLocality, GapsInTheIdsDoNotCount)
{
  clouds::Random random(7);
  const clouds::Cloud cloud =
    cloudOf([&](const Vector& p) { return noisyDistance(p, random); }, 1500, 11.4);
  clouds::Cloud spread;
  std::map<std::uint64_t, std::uint64_t> ids;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    while (random() < 0.5)
    {
      spread.add(random(), random(), random(), missing);
    }
    ids[i] = spread.size();
    spread.add(cloud.positions[3 * i], cloud.positions[3 * i + 1], cloud.positions[3 * i + 2],
      cloud.values[i]);
  }
  const Numbers expected = extracted(cloud, 4.0, FitOrder::Crease, true);
  const Numbers found = extracted(spread, 4.0, FitOrder::Crease, true);
  ASSERT_GT(expected.size(), 300u);
  ASSERT_EQ(expected.size(), found.size());
  for (const auto& [edge, numbers] : expected)
  {
    const auto same = found.find({ ids.at(edge.first), ids.at(edge.second) });
    ASSERT_TRUE(same != found.end() && areSameBits(numbers, same->second));
  }
}

// Which end of an edge has the lower id decides on the last bits of the isopoint on it. Where that
// stays, nothing changes; elsewhere the fit moves by rounding.
TEST(FitLocality, PermutedIdsGiveTheSameFits)
{
  clouds::Random random(8);
  const clouds::Cloud cloud =
    cloudOf([](const Vector& p) { return lengthOf(p) + 0.3 * std::sin(2.0 * p[0]); }, 3000, 14.4);
  std::vector<std::size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  for (std::size_t i = order.size() - 1; i > 0; --i)
  {
    std::swap(order[i], order[static_cast<std::size_t>(random() * static_cast<double>(i + 1))]);
  }
  clouds::Cloud permuted;
  for (const std::size_t id : order)
  {
    permuted.add(cloud.positions[3 * id], cloud.positions[3 * id + 1], cloud.positions[3 * id + 2],
      cloud.values[id]);
  }
  const Numbers expected = extracted(cloud, 5.0, FitOrder::Cubic, false);
  const Numbers found = extracted(permuted, 5.0, FitOrder::Cubic, false);
  ASSERT_EQ(expected.size(), found.size());
  std::size_t kept = 0;
  for (const auto& [edge, numbers] : found)
  {
    const Ends ends{ order[edge.first], order[edge.second] };
    const bool isKept = ends.first < ends.second;
    const auto same = expected.find(isKept ? ends : Ends{ ends.second, ends.first });
    ASSERT_TRUE(same != expected.end());
    if (isKept)
    {
      EXPECT_TRUE(areSameBits(same->second, numbers));
      ++kept;
    }
    else
    {
      ASSERT_EQ(same->second.size(), numbers.size());
      for (std::size_t i = 0; i + 1 < numbers.size(); ++i) // the last is the parameter
      {
        EXPECT_NEAR(same->second[i], numbers[i], 1e-6);
      }
    }
  }
  EXPECT_GT(kept, 200u);
  EXPECT_GT(found.size() - kept, 200u);
}
