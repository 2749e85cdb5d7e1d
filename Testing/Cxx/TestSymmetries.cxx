// SPDX-License-Identifier: GPL-3.0-or-later
// How transformations of the input change the result, on random clouds in general position.
// Coordinates are multiples of 2^-20, so that translations and rotations are exact. TestFitLocality
// permutes ids.
#include "IsopointTesting.h"

namespace
{

using clouds::Cloud;

// A power of two, so that both halves of each split are of equal size. Of an odd number the lower
// half has one sample less, so that a reflected cloud would be split elsewhere.
constexpr std::size_t sampleCount = 2048;

Cloud dyadicCloud(std::uint64_t seed)
{
  // Three different sides of the bounding box, so that the longest one is unique.
  const double sides[] = { 1.0, 0.875, 0.75 };
  Cloud cloud = clouds::uniform(sampleCount, seed);
  for (std::size_t i = 0; i < cloud.positions.size(); ++i)
  {
    cloud.positions[i] = sides[i % 3] * std::floor(0x1p20 * cloud.positions[i]) * 0x1p-20;
  }
  return cloud;
}

/// Expects the same edges and parameters after positions move, and values and isovalue are scaled.
template <class Move>
void expectTheSameOf(const Move& move, double factor = 1.0)
{
  constexpr double isovalue = 0.3;
  for (const std::uint64_t seed : { 1, 2, 3, 4, 5 })
  {
    const Cloud cloud = dyadicCloud(seed);
    Cloud changed = clouds::moved(cloud, move);
    for (double& value : changed.values)
    {
      value *= factor;
    }
    const auto expected = clouds::extract(cloud, isovalue).edges;
    ASSERT_GT(expected.size(), 200u);
    isopointtesting::expectSameIsopoints(
      expected, clouds::extract(changed, factor * isovalue).edges);
  }
}

} // namespace

TEST(Symmetries, Translation)
{
  for (const double shift : { 1.0, -3.0, 1024.0, 0x1p30 })
  {
    expectTheSameOf(
      [shift](double* p)
      {
        p[0] += shift;
        p[1] -= 2.0 * shift;
        p[2] += 0.5 * shift;
      });
  }
}

TEST(Symmetries, RotationByNinetyDegreesAndReflection)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int turns = 1; turns <= 4; ++turns)
    {
      expectTheSameOf(
        [=](double* p)
        {
          for (int i = 0; i < turns; ++i)
          {
            std::swap(p[(axis + 1) % 3], p[(axis + 2) % 3]);
            p[(axis + 1) % 3] *= -1.0;
          }
        });
    }
    expectTheSameOf([axis](double* p) { p[axis] *= -1.0; });
  }
}

TEST(Symmetries, ScalingByPowersOfTwoAndNegation)
{
  for (const double scale : { 0x1p-1000, 0x1p-400, 0x1p-30, 4.0, 0x1p100, 0x1p400, 0x1p1000 })
  {
    expectTheSameOf(
      [scale](double* p) { std::for_each(p, p + 3, [=](double& c) { c *= scale; }); });
    expectTheSameOf([](double*) {}, scale);
  }
  expectTheSameOf([](double*) {}, -1.0);
}
