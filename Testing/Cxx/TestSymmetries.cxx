// SPDX-License-Identifier: GPL-3.0-or-later
// How transformations of the input change the result, on random clouds in general position.
// Coordinates are multiples of 2^-20, so that translations and rotations are exact.
#include "Clouds.h"

#include "Core/Neighbors/AngleCriterion.h"

#include <gtest/gtest.h>

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
    clouds::Vector p = random.place();
    std::for_each(p.begin(), p.end(), [](double& c) { c = std::floor(0x1p20 * c) * 0x1p-20; });
    // Three different sides of the bounding box, so that the longest one is unique.
    cloud.add(p[0], 0.875 * p[1], 0.75 * p[2], clouds::waves(p[0], p[1], p[2]));
  }
  return cloud;
}

Cloud withValuesTimes(Cloud cloud, double factor)
{
  std::for_each(
    cloud.values.begin(), cloud.values.end(), [factor](double& value) { value *= factor; });
  return cloud;
}

std::vector<IsopointEdge> edgesOf(const Cloud& cloud, double isovalue = 0.3)
{
  return clouds::extract(cloud, isovalue).edges;
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

const Cloud testClouds[] = { dyadicCloud(1), dyadicCloud(2), dyadicCloud(3), dyadicCloud(4),
  dyadicCloud(5) };

} // namespace

TEST(Symmetries, Translation)
{
  for (const Cloud& cloud : testClouds)
  {
    for (const double shift : { 1.0, -3.0, 1024.0, 0x1p30 })
    {
      const auto translate = [shift](double* p)
      {
        p[0] += shift;
        p[1] -= 2.0 * shift;
        p[2] += 0.5 * shift;
      };
      expectSame(edgesOf(cloud), edgesOf(clouds::moved(cloud, translate)));
    }
  }
}

TEST(Symmetries, RotationByNinetyDegreesAndReflection)
{
  for (const Cloud& cloud : testClouds)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto quarterTurn = [axis](double* p)
      {
        std::swap(p[(axis + 1) % 3], p[(axis + 2) % 3]);
        p[(axis + 1) % 3] *= -1.0;
      };
      Cloud turned = cloud;
      for (int turn = 0; turn < 4; ++turn)
      {
        turned = clouds::moved(turned, quarterTurn);
        expectSame(edgesOf(cloud), edgesOf(turned));
      }
      const auto reflect = [axis](double* p) { p[axis] *= -1.0; };
      expectSame(edgesOf(cloud), edgesOf(clouds::moved(cloud, reflect)));
    }
  }
}

TEST(Symmetries, ScalingByPowersOfTwo)
{
  for (const Cloud& cloud : testClouds)
  {
    for (const double scale : { 0x1p-400, 0x1p-30, 4.0, 0x1p100, 0x1p400 })
    {
      expectSame(edgesOf(cloud), edgesOf(clouds::scaled(cloud, scale, scale, scale)));
      expectSame(edgesOf(cloud), edgesOf(withValuesTimes(cloud, scale), scale * 0.3));
    }
  }
}

TEST(Symmetries, NegationOfFieldAndIsovalue)
{
  for (const Cloud& cloud : testClouds)
  {
    expectSame(edgesOf(cloud), edgesOf(withValuesTimes(cloud, -1.0), -0.3));
  }
}

// Edges stay; parameters are computed from the other end where the lower id is now there.
TEST(Symmetries, PermutationOfIds)
{
  std::uint64_t seed = 101;
  for (const Cloud& cloud : testClouds)
  {
    const std::vector<std::size_t> order = clouds::randomOrder(sampleCount, seed++);
    std::map<std::pair<std::uint64_t, std::uint64_t>, double> expected;
    for (const IsopointEdge& edge : edgesOf(cloud))
    {
      expected[{ edge.first, edge.second }] = edge.parameter;
    }
    const std::vector<IsopointEdge> found = edgesOf(clouds::permuted(cloud, order));
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
