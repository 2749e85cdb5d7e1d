// SPDX-License-Identifier: GPL-3.0-or-later
#include "Clouds.h"

#include "Isopoint/SplatGeometry.h"

#include <gtest/gtest.h>

namespace
{

using isopoint::Splat;
using isopoint::Vector;

double dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

std::vector<Splat> splatsOf(const std::vector<Vector>& positions, const std::vector<Vector>& edges)
{
  return isopoint::computeSplats(
    clouds::executionOn(2), positions, edges, isopoint::defaultNeighborCount);
}

/// Random points of the unit sphere, moved and scaled, with edges that fall outwards, askew.
struct Sphere
{
  std::vector<Vector> positions;
  std::vector<Vector> outwards;
  std::vector<Vector> edges;

  Sphere(std::size_t count, double scale, double offset)
  {
    clouds::Random random(3);
    while (this->positions.size() < count)
    {
      const Vector v{ 2.0 * random() - 1.0, 2.0 * random() - 1.0, 2.0 * random() - 1.0 };
      const double length = std::sqrt(dot(v, v));
      if (length > 0.1 && length < 1.0)
      {
        const Vector n{ v[0] / length, v[1] / length, v[2] / length };
        this->outwards.push_back(n);
        this->positions.push_back(
          { offset + scale * n[0], offset + scale * n[1], offset + scale * n[2] });
        const double askew = 1.2 * (random() - 0.5);
        this->edges.push_back(
          { scale * 0.1 * (n[0] + askew), scale * 0.1 * n[1], scale * 0.1 * (n[2] - askew) });
      }
    }
  }
};

} // namespace

TEST(Splats, NormalsOfASphereFallOutwards)
{
  for (const double scale : { 1.0, 1e-20, 1e20 })
  {
    const Sphere sphere(5000, scale, scale);
    const std::vector<Splat> splats = splatsOf(sphere.positions, sphere.edges);
    for (std::size_t i = 0; i < splats.size(); ++i)
    {
      ASSERT_NEAR(dot(splats[i].normal, splats[i].normal), 1.0, 1e-12);
      ASSERT_GT(dot(splats[i].normal, sphere.outwards[i]), 0.98);
    }
  }
}

TEST(Splats, RadiusIsTheDistanceOfTheTwelfthNearest)
{
  const Sphere sphere(800, 1.0, 0.0);
  const std::vector<Splat> splats = splatsOf(sphere.positions, sphere.edges);
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    std::vector<double> distances;
    for (const Vector& other : sphere.positions)
    {
      const Vector d{ other[0] - sphere.positions[i][0], other[1] - sphere.positions[i][1],
        other[2] - sphere.positions[i][2] };
      distances.push_back(std::sqrt(dot(d, d)));
    }
    std::sort(distances.begin(), distances.end());
    ASSERT_NEAR(splats[i].radius, distances[12], 1e-12); // edges are shorter
  }
}

// Samples that have the isovalue exactly put many isopoints at their own position.
TEST(Splats, PointsAtOnePositionCountOnceAmongTheNearest)
{
  const Sphere sphere(800, 1.0, 0.0);
  const std::vector<Splat> expected = splatsOf(sphere.positions, sphere.edges);
  std::vector<Vector> positions;
  std::vector<Vector> edges;
  for (std::size_t i = 0; i < sphere.positions.size(); ++i)
  {
    positions.insert(positions.end(), 30, sphere.positions[i]);
    edges.insert(edges.end(), 30, sphere.edges[i]);
  }
  const std::vector<Splat> splats = splatsOf(positions, edges);
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    ASSERT_NEAR(splats[i].radius, expected[i / 30].radius, 1e-12);
    ASSERT_GT(dot(splats[i].normal, expected[i / 30].normal), 1.0 - 1e-9);
  }
}

TEST(Splats, TooFewOrCollinearPointsTakeTheirEdge)
{
  const Vector edge{ 0.0, 2.0, 0.0 };
  for (const std::vector<Vector>& positions :
    { std::vector<Vector>{ { 1, 1, 1 } }, std::vector<Vector>{ { 1, 1, 1 }, { 1, 1, 1 } },
      std::vector<Vector>{ { 0, 0, 0 }, { 1, 0, 0 } },
      std::vector<Vector>{ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 5, 0, 0 } } })
  {
    for (const Splat& splat : splatsOf(positions, std::vector<Vector>(positions.size(), edge)))
    {
      EXPECT_EQ(splat.normal, (Vector{ 0.0, 1.0, 0.0 }));
      EXPECT_GE(splat.radius, 1.0);
    }
  }
  EXPECT_TRUE(splatsOf({}, {}).empty());
}

// Two sheets that fall to opposite sides, closer to each other than the points of one.
TEST(Splats, SheetsCloseByKeepTheirSides)
{
  clouds::Random random(5);
  std::vector<Vector> positions;
  std::vector<Vector> edges;
  for (int i = 0; i < 4000; ++i)
  {
    const double side = i % 2 ? 1.0 : -1.0;
    positions.push_back({ random(), random(), 0.004 * side });
    edges.push_back({ 0.02 * (random() - 0.5), 0.02 * (random() - 0.5), 0.02 * side });
  }
  const std::vector<Splat> splats = splatsOf(positions, edges);
  int wrong = 0;
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    wrong += dot(splats[i].normal, edges[i]) > 0.0 ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0);
}
