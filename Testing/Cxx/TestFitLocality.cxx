// SPDX-License-Identifier: GPL-3.0-or-later
// Fits and splats depend on the samples around them alone (docs/algorithm.md, section 10), not on
// samples elsewhere or on ids.
#include "FitTesting.h"
#include "RingDefinition.h"

using namespace fittesting;

namespace
{

using ringdefinition::Rings;
using Ends = std::pair<std::uint64_t, std::uint64_t>;

/// What an extraction yields for each edge, fits and splats, as numbers; the last is the parameter.
using Numbers = std::map<Ends, std::vector<double>>;

Numbers extracted(const clouds::Cloud& cloud, double isovalue, FitOrder order, bool withSplats)
{
  IsosurfaceExtractor extractor;
  const auto read = [all = clouds::readerOf(cloud)](std::size_t id, auto* position, auto& value)
  { return all(id, position, value) && !std::isnan(value); };
  extractor.load<double, double>({}, cloud.size(), read);
  const ExtractionRequest request = clouds::requestOf(isovalue, order);
  const ExtractedIsosurface found =
    extractor.extract({}, withSplats ? clouds::withSplats(request) : request);
  Numbers all;
  for (std::size_t i = 0; i < found.surface.size(); ++i)
  {
    const IsopointEdge& edge = found.surface.edges[i];
    std::vector<double>& numbers = all[{ edge.first, edge.second }];
    const auto put = [&numbers](const auto&... lists)
    { (numbers.insert(numbers.end(), std::begin(lists), std::end(lists)), ...); };
    const LocalFit& fit = found.surface.fits[i];
    put(std::array{ fit.spacing, fit.isGradientFitted ? 1.0 : 0.0, fit.isSmooth ? 1.0 : 0.0,
          fit.order ? static_cast<double>(*fit.order) : 0.0 },
      fit.position, fit.gradient, fit.hessian);
    for (const CreasePlane& plane : fit.creases)
    {
      put(plane.inward, std::array{ plane.distance, plane.turn });
    }
    if (withSplats)
    {
      const Splat& splat = found.splats[i];
      put(splat.normal, splat.axis, std::array{ splat.radius });
      for (const SplatCorner& corner : splat.corners)
      {
        put(std::array{
          corner.along, corner.across, corner.height, corner.slopeAlong, corner.slopeAcross });
      }
    }
    put(std::array{ edge.parameter });
  }
  return all;
}

bool areSameBits(const std::vector<double>& a, const std::vector<double>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// All that a fit may see: the cells within two rings of an edge, whatever their values, in the
/// order of the tree.
std::vector<std::vector<double>> domainOf(const Rings& rings, const Ends& edge)
{
  std::set<std::size_t> cells{ rings.cellOf(edge.first), rings.cellOf(edge.second) };
  for (int ring = 0; ring < 2; ++ring)
  {
    for (const std::size_t cell : std::vector<std::size_t>(cells.begin(), cells.end()))
    {
      cells.insert(rings.neighborsOf(cell).begin(), rings.neighborsOf(cell).end());
    }
  }
  std::vector<std::vector<double>> domain;
  for (const std::size_t number : cells)
  {
    const ringdefinition::Cell& cell = rings.cells()[number];
    std::vector<double>& seen = domain.emplace_back(1, cell.value);
    for (const Vector& v : { cell.region.lower, cell.region.upper, cell.position })
    {
      seen.insert(seen.end(), v.begin(), v.end());
    }
    seen.insert(seen.end(), cell.path.begin(), cell.path.end());
  }
  return domain;
}

/// Changes one side of a noisy ball.
/// @returns how many isopoints have the same bits, all those where nothing changes within two rings
template <class Change>
std::size_t countUnchanged(std::uint64_t seed, double stretch, const Change& change)
{
  clouds::Random random(seed);
  const clouds::Cloud before = clouds::scaled(
    cloudOf([&](const Vector& p) { return lengthOf(p) + 0.3 * (random() - 0.5); }, 700, 8.9),
    stretch, 1.0, 1.0);
  clouds::Cloud after = before;
  for (std::size_t i = 0; i < after.size(); ++i)
  {
    change(after.positions.data() + 3 * i, after.values[i], random);
  }
  const FitOrder order = seed % 2 == 0 ? FitOrder::Crease : FitOrder::Cubic;
  const Rings ringsBefore(before);
  const Rings ringsAfter(after);
  const Numbers numbersAfter = extracted(after, 3.0, order, false);
  std::size_t same = 0;
  for (const auto& [edge, numbers] : extracted(before, 3.0, order, false))
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

} // namespace

// In one corner values change: noise, steps and isopoints come and go. In another part samples
// move, so that the part of the tree that is refined differs as well; the bounding box stays, and
// the plane of the root, whose longest side is certain.
TEST(FitLocality, SamplesBeyondTwoRingsDoNotCount)
{
  for (const std::uint64_t seed : { 1, 2, 3, 4, 5, 6 })
  {
    SCOPED_TRACE(seed);
    const double border = 2.0 + 0.3 * static_cast<double>(seed);
    const auto changeValue = [border](const double* p, double& value, clouds::Random& random)
    { value = p[0] > border ? 6.0 * random() : value; };
    const auto move = [](double* p, double& value, clouds::Random& random)
    {
      if (p[0] > 1.0 && p[0] < 6.0 && std::abs(p[1]) < 4.0 && std::abs(p[2]) < 4.0)
      {
        std::for_each(p, p + 3, [&](double& c) { c += 0.4 * (random() - 0.5); });
        value += random() - 0.5;
      }
    };
    EXPECT_GT(countUnchanged(seed, 1.0, changeValue), 20u);
    EXPECT_GT(countUnchanged(seed, 1.5, move), 10u);
  }
}

// Ids keep their order: samples in between take no part.
TEST(FitLocality, GapsInTheIdsDoNotCount)
{
  clouds::Random random(7);
  const clouds::Cloud cloud =
    cloudOf([&](const Vector& p) { return lengthOf(p) + 0.3 * (random() - 0.5); }, 1500, 11.4);
  clouds::Cloud spread;
  std::vector<std::uint64_t> ids;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    while (random() < 0.5)
    {
      spread.add(random.place(), std::numeric_limits<double>::quiet_NaN());
    }
    ids.push_back(spread.size());
    spread.add(cloud.at(i), cloud.values[i]);
  }
  const Numbers expected = extracted(cloud, 4.0, FitOrder::Crease, true);
  const Numbers found = extracted(spread, 4.0, FitOrder::Crease, true);
  ASSERT_GT(expected.size(), 300u);
  ASSERT_EQ(expected.size(), found.size());
  for (const auto& [edge, numbers] : expected)
  {
    const auto same = found.find({ ids[edge.first], ids[edge.second] });
    ASSERT_TRUE(same != found.end() && areSameBits(numbers, same->second));
  }
}

// Which end of an edge has the lower id decides on the last bits of the isopoint on it. Where that
// stays, nothing changes; elsewhere the parameter counts from the other end, and the fit moves by
// rounding.
TEST(FitLocality, PermutedIdsGiveTheSameFits)
{
  const clouds::Cloud cloud =
    cloudOf([](const Vector& p) { return lengthOf(p) + 0.3 * std::sin(2.0 * p[0]); }, 3000, 14.4);
  const std::vector<std::size_t> order = clouds::randomOrder(cloud.size(), 8);
  const Numbers expected = extracted(cloud, 5.0, FitOrder::Cubic, false);
  const Numbers found = extracted(clouds::permuted(cloud, order), 5.0, FitOrder::Cubic, false);
  ASSERT_EQ(expected.size(), found.size());
  std::size_t kept = 0;
  for (const auto& [edge, numbers] : found)
  {
    const Ends ends{ order[edge.first], order[edge.second] };
    const auto same = expected.find(std::minmax(ends.first, ends.second));
    ASSERT_TRUE(same != expected.end());
    if (ends.first < ends.second)
    {
      EXPECT_TRUE(areSameBits(same->second, numbers));
      ++kept;
      continue;
    }
    ASSERT_EQ(same->second.size(), numbers.size());
    for (std::size_t i = 0; i + 1 < numbers.size(); ++i)
    {
      EXPECT_NEAR(same->second[i], numbers[i], 1e-6);
    }
    EXPECT_NEAR(1.0 - same->second.back(), numbers.back(), 1e-12);
  }
  EXPECT_GT(kept, 200u);
  EXPECT_GT(found.size() - kept, 200u);
}
