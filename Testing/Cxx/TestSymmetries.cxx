// SPDX-License-Identifier: GPL-3.0-or-later
// How transformations of the input change the result, on random clouds in general position.
// Coordinates are multiples of 2^-20, so that translations and rotations are exact.
#include "Clouds.h"

#include "Core/Neighbors/AngleCriterion.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <utility>

namespace
{

using clouds::Cloud;
using isopoint::IsopointEdge;

// A power of two, so that both halves of each split are of equal size. Of an odd number the lower
// half has one sample less, so that a reflected cloud would be split elsewhere.
constexpr std::size_t sampleCount = 2048;

Cloud dyadicCloud(std::uint64_t seed)
{
  clouds::Random random(seed);
  Cloud cloud;
  for (std::size_t i = 0; i < sampleCount; ++i)
  {
    double p[3];
    for (double& coordinate : p)
    {
      coordinate = std::floor(0x1p20 * random()) * 0x1p-20;
    }
    // Three different sides of the bounding box, so that the longest one is unique.
    cloud.add(p[0], 0.875 * p[1], 0.75 * p[2], clouds::waves(p[0], p[1], p[2]));
  }
  return cloud;
}

Cloud moved(Cloud cloud, const std::function<void(double*)>& move)
{
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    move(cloud.positions.data() + 3 * i);
  }
  return cloud;
}

std::vector<IsopointEdge> edgesOf(const Cloud& cloud, double isovalue = 0.3)
{
  return clouds::extract(cloud, isovalue, isopoint::defaultAngle).edges;
}

void expectSame(const std::vector<IsopointEdge>& expected, const std::vector<IsopointEdge>& found)
{
  ASSERT_GT(expected.size(), 200u);
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    ASSERT_TRUE(expected[i] == found[i]) << i;
    ASSERT_EQ(expected[i].parameter, found[i].parameter) << i;
  }
}

const std::uint64_t seeds[] = { 1, 2, 3, 4, 5 };

} // namespace

TEST(Symmetries, Translation)
{
  for (const std::uint64_t seed : seeds)
  {
    const Cloud cloud = dyadicCloud(seed);
    for (const double shift : { 1.0, -3.0, 1024.0, 0x1p30 })
    {
      expectSame(edgesOf(cloud), edgesOf(moved(cloud,
                                   [shift](double* p)
                                   {
                                     p[0] += shift;
                                     p[1] -= 2.0 * shift;
                                     p[2] += 0.5 * shift;
                                   })));
    }
  }
}

TEST(Symmetries, RotationByNinetyDegreesAndReflection)
{
  const auto quarterTurn = [](int axis)
  {
    return [axis](double* p)
    {
      std::swap(p[(axis + 1) % 3], p[(axis + 2) % 3]);
      p[(axis + 1) % 3] *= -1.0;
    };
  };
  for (const std::uint64_t seed : seeds)
  {
    const Cloud cloud = dyadicCloud(seed);
    for (int axis = 0; axis < 3; ++axis)
    {
      Cloud turned = cloud;
      for (int turn = 0; turn < 4; ++turn)
      {
        turned = moved(turned, quarterTurn(axis));
        expectSame(edgesOf(cloud), edgesOf(turned));
      }
      expectSame(edgesOf(cloud), edgesOf(moved(cloud, [axis](double* p) { p[axis] *= -1.0; })));
    }
  }
}

TEST(Symmetries, ScalingByPowersOfTwo)
{
  for (const std::uint64_t seed : seeds)
  {
    const Cloud cloud = dyadicCloud(seed);
    for (const double scale : { 0x1p-400, 0x1p-30, 4.0, 0x1p100, 0x1p400 })
    {
      const auto scaling = [scale](double* p)
      { std::transform(p, p + 3, p, [scale](double c) { return scale * c; }); };
      expectSame(edgesOf(cloud), edgesOf(moved(cloud, scaling)));
      Cloud steeper = cloud;
      std::transform(steeper.values.begin(), steeper.values.end(), steeper.values.begin(),
        [scale](double value) { return scale * value; });
      expectSame(edgesOf(cloud), edgesOf(steeper, scale * 0.3));
    }
  }
}

TEST(Symmetries, NegationOfFieldAndIsovalue)
{
  for (const std::uint64_t seed : seeds)
  {
    const Cloud cloud = dyadicCloud(seed);
    Cloud negated = cloud;
    std::transform(
      negated.values.begin(), negated.values.end(), negated.values.begin(), std::negate<double>());
    expectSame(edgesOf(cloud), edgesOf(negated, -0.3));
  }
}

// Edges stay; parameters are computed from the other end where the lower id is now there.
TEST(Symmetries, PermutationOfIds)
{
  for (const std::uint64_t seed : seeds)
  {
    const Cloud cloud = dyadicCloud(seed);
    std::vector<std::size_t> order(sampleCount);
    std::iota(order.begin(), order.end(), std::size_t{ 0 });
    clouds::Random random(seed + 100);
    for (std::size_t i = sampleCount - 1; i > 0; --i)
    {
      std::swap(order[i], order[static_cast<std::size_t>(random() * static_cast<double>(i + 1))]);
    }
    Cloud permuted;
    for (const std::size_t id : order)
    {
      const double* const p = cloud.positions.data() + 3 * id;
      permuted.add(p[0], p[1], p[2], cloud.values[id]);
    }
    std::map<std::pair<std::uint64_t, std::uint64_t>, double> expected;
    for (const IsopointEdge& edge : edgesOf(cloud))
    {
      expected[{ edge.first, edge.second }] = edge.parameter;
    }
    const std::vector<IsopointEdge> found = edgesOf(permuted);
    ASSERT_GT(found.size(), 200u);
    ASSERT_EQ(found.size(), expected.size());
    for (const IsopointEdge& edge : found)
    {
      const std::uint64_t first = order[edge.first];
      const std::uint64_t second = order[edge.second];
      const auto same = expected.find(std::minmax(first, second));
      ASSERT_TRUE(same != expected.end());
      ASSERT_NEAR(first < second ? edge.parameter : 1.0 - edge.parameter, same->second, 1e-12);
    }
  }
}
