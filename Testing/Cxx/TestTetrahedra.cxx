// SPDX-License-Identifier: GPL-3.0-or-later
// The crossing tetrahedra that the core finds are those of the full Delaunay tetrahedrization.
#include "TriangleTesting.h"

namespace
{

using clouds::Cloud;
using clouds::Random;
using triangles::expectSameTetrahedra;
using triangles::Found;

double distanceFrom(double x, double y, double z)
{
  return std::sqrt(x * x + y * y + z * z);
}

/// Values become the distance from the middle of the unit cube.
Cloud withSphere(Cloud cloud)
{
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const double* const p = cloud.positions.data() + 3 * i;
    cloud.values[i] = distanceFrom(p[0] - 0.5, p[1] - 0.5, p[2] - 0.5);
  }
  return cloud;
}

/// Values become white noise: a share of the samples is below 0.5.
Cloud withNoise(Cloud cloud, double share, std::uint64_t seed)
{
  Random random(seed);
  for (double& value : cloud.values)
  {
    value = random() < share ? 0.0 : 1.0;
  }
  return cloud;
}

Cloud scaled(Cloud cloud, double x, double y, double z)
{
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    cloud.positions[3 * i] *= x;
    cloud.positions[3 * i + 1] *= y;
    cloud.positions[3 * i + 2] *= z;
  }
  return cloud;
}

Cloud turned(Cloud cloud)
{
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    clouds::turn(cloud.positions.data() + 3 * i);
  }
  return cloud;
}

Cloud without(const Cloud& cloud, std::size_t step)
{
  Cloud rest;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const double* const p = cloud.positions.data() + 3 * i;
    if ((i * 7919) % step != 0)
    {
      rest.add(p[0], p[1], p[2], cloud.values[i]);
    }
  }
  return rest;
}

/// Several spheres of samples about common centers, many on each.
Cloud cospherical(std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  Cloud cloud;
  // Pythagorean quadruples: exactly on the spheres.
  constexpr double quadruples[][3] = { { 2, 3, 6 }, { 6, 2, 3 }, { 3, 6, 2 }, { 7, 0, 0 } };
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto& q = quadruples[static_cast<std::size_t>(4.0 * random())];
    double p[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      p[axis] = (random() < 0.5 ? q[axis] : -q[axis]) * std::ceil(4.0 * random());
    }
    cloud.add(p[0], p[1], p[2], random());
  }
  return cloud;
}

/// The centers of the leaves of an octree that is refined around a sphere.
void addLeaves(Cloud& cloud, double x, double y, double z, double half, int levels)
{
  const double distance = distanceFrom(x - 0.5, y - 0.5, z - 0.5);
  if (levels == 0 || std::abs(distance - 0.31) > 2.0 * half)
  {
    cloud.add(x, y, z, distance);
    return;
  }
  for (int i = 0; i < 8; ++i)
  {
    addLeaves(cloud, x + (i % 2 ? 0.5 : -0.5) * half, y + (i / 2 % 2 ? 0.5 : -0.5) * half,
      z + (i / 4 ? 0.5 : -0.5) * half, 0.5 * half, levels - 1);
  }
}

Cloud octreeLeaves(int levels)
{
  Cloud cloud;
  addLeaves(cloud, 0.5, 0.5, 0.5, 0.5, levels);
  return cloud;
}

} // namespace

TEST(Tetrahedra, OfRandomSamples)
{
  const Found found = expectSameTetrahedra(withSphere(clouds::uniform(40000, 1)), 0.3);
  EXPECT_FALSE(found.counts.isWhole);
  EXPECT_LT(found.counts.size, 15000u);
  expectSameTetrahedra(clouds::uniform(30000, 2), 0.4);
  expectSameTetrahedra(clouds::uniform(30000, 2), -2.0);
}

TEST(Tetrahedra, OfTwentyRandomClouds)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    SCOPED_TRACE(seed);
    const double share = static_cast<double>(seed - 1) / 19.0;
    const auto count = static_cast<std::size_t>(100.0 * std::pow(1000.0, share));
    expectSameTetrahedra<isopoint::FloatSample>(Cloud(
                                                  [&]()
                                                  {
                                                    Cloud cloud = clouds::uniform(count, seed);
                                                    for (double& coordinate : cloud.positions)
                                                    {
                                                      coordinate = static_cast<float>(coordinate);
                                                    }
                                                    for (double& value : cloud.values)
                                                    {
                                                      value = static_cast<float>(value);
                                                    }
                                                    return cloud;
                                                  }()),
      0.5, 2);
  }
}

TEST(Tetrahedra, OfClusters)
{
  expectSameTetrahedra(clouds::clustered(20000, 3), -4.0);
  expectSameTetrahedra(withNoise(clouds::clustered(5000, 4), 0.1, 4), 0.5);
}

TEST(Tetrahedra, OfASlab)
{
  const Cloud slab = scaled(clouds::uniform(20000, 5), 1.0, 1.0, 0.01);
  expectSameTetrahedra(slab, 0.5);
  expectSameTetrahedra(scaled(slab, 1.0, 1.0, 1e-4), 0.5);
}

TEST(Tetrahedra, OfLattices)
{
  const Found found = expectSameTetrahedra(
    withSphere(scaled(clouds::lattice(33, 33, 33), 1.0 / 32.0, 1.0 / 32.0, 1.0 / 32.0)), 0.4);
  EXPECT_FALSE(found.counts.isWhole);
  expectSameTetrahedra(clouds::lattice(25, 20, 30), 0.5);
  expectSameTetrahedra(without(clouds::lattice(25, 20, 30), 7), 0.5);
  expectSameTetrahedra(without(clouds::lattice(25, 20, 30), 2), 0.5);
}

TEST(Tetrahedra, OfTurnedLattices)
{
  expectSameTetrahedra(turned(clouds::lattice(20, 20, 20)), 0.5);
  expectSameTetrahedra(turned(without(clouds::lattice(15, 20, 17), 5)), 0.5);
  expectSameTetrahedra(turned(octreeLeaves(4)), 0.3);
}

TEST(Tetrahedra, OfLinesAndSlices)
{
  expectSameTetrahedra(clouds::lines(3000, 24, 0, 6), 0.3);
  expectSameTetrahedra(clouds::lines(3000, 24, 100, 6), 0.3);
  expectSameTetrahedra(clouds::lines(400, 3, 0, 7), 0.3);
  expectSameTetrahedra(clouds::combs(3000, 12, 8), 0.3);
  expectSameTetrahedra(clouds::curves(600, 9), 0.3);
  expectSameTetrahedra(clouds::layerBeforeOne(3000, 10), 0.5);
}

TEST(Tetrahedra, OfCoincidentSamples)
{
  expectSameTetrahedra(clouds::coincident(clouds::uniform(5000, 11), 0.5), 0.5);
  expectSameTetrahedra(clouds::coarse(20000, 12, 12), 4.5);
  expectSameTetrahedra(clouds::nestedCoincident(2000), 3.0);
}

TEST(Tetrahedra, OfCosphericalSamples)
{
  expectSameTetrahedra(cospherical(500, 13), 0.5);
  expectSameTetrahedra(withNoise(cospherical(3000, 14), 0.05, 14), 0.5);
}

TEST(Tetrahedra, OfLeavesOfAnAdaptiveGrid)
{
  expectSameTetrahedra(octreeLeaves(6), 0.3);
  expectSameTetrahedra(octreeLeaves(5), 0.42);
}

/// Samples of the other side that nobody of the other side's cells touches: surfaces that the band
/// does not see at first.
TEST(Tetrahedra, OfNoise)
{
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
  {
    SCOPED_TRACE(seed);
    expectSameTetrahedra(withNoise(clouds::uniform(3000, seed), 0.02, seed), 0.5);
    expectSameTetrahedra(
      withNoise(scaled(clouds::uniform(3000, seed), 1.0, 0.1, 0.001), 0.02, seed), 0.5);
    expectSameTetrahedra(withNoise(clouds::lines(1500, 12, 0, seed), 0.02, seed), 0.5);
  }
}

/// Samples of one side among those of the other, whose leaves touch none of the other side. A piece
/// of the surface is far from all samples of the first band, and spheres do not find it: in these
/// clouds, found by chance, only the check of sides does.
TEST(Tetrahedra, OfPiecesThatTheBandDoesNotTouch)
{
  const auto coordinate = [](Random& random) { return std::pow(10.0, -6.0 * random()); };
  for (const auto& [count, seed] :
    { std::pair(158, 737), std::pair(158, 1807), std::pair(158, 7091), std::pair(250, 8590) })
  {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed));
    Cloud cloud;
    for (int i = 0; i < count; ++i)
    {
      const double x = coordinate(random);
      const double y = coordinate(random);
      const double z = coordinate(random);
      cloud.add(x, y, z, x < 0.5 || random() < 0.1 ? 0.0 : 1.0);
    }
    EXPECT_FALSE(expectSameTetrahedra(cloud, 0.5).counts.isWhole);
  }
}

/// Where most samples are near the surface, or searches are long, all are tetrahedrized.
TEST(Tetrahedra, OfAllSamplesWhereThatIsQuicker)
{
  EXPECT_TRUE(
    expectSameTetrahedra(withNoise(clouds::uniform(5000, 19), 0.5, 19), 0.5).counts.isWhole);
  Random random(20);
  Cloud shell;
  for (int i = 0; i < 20000; ++i)
  {
    const double x = random() - 0.5;
    const double y = random() - 0.5;
    const double z = random() - 0.5;
    const double scale = (1.0 + 1e-6 * random()) / distanceFrom(x, y, z);
    shell.add(scale * x, scale * y, scale * z, x * scale);
  }
  EXPECT_TRUE(expectSameTetrahedra(shell, 0.1).counts.isWhole);
}

/// Large insertions run on several threads, where they get in each other's way more or less.
TEST(Tetrahedra, AreTheSameFromSeveralThreads)
{
  const Cloud uniform = clouds::uniform(20000, 21);
  Cloud sphere = clouds::uniform(10000, 22);
  for (std::size_t i = 0; i < sphere.size(); ++i)
  {
    double* const p = sphere.positions.data() + 3 * i;
    const double length = distanceFrom(p[0] - 0.5, p[1] - 0.5, p[2] - 0.5);
    std::for_each(p, p + 3, [length](double& coordinate) { coordinate = coordinate / length; });
  }
  for (const std::size_t threads : { 2, 6 })
  {
    SCOPED_TRACE(threads);
    EXPECT_TRUE(expectSameTetrahedra(withNoise(uniform, 0.5, 21), 0.5, threads).counts.isWhole);
    expectSameTetrahedra(withNoise(clouds::lattice(25, 25, 25), 0.5, 22), 0.5, threads);
    expectSameTetrahedra(scaled(withNoise(uniform, 0.5, 23), 1.0, 1e-4, 1.0), 0.5, threads);
    expectSameTetrahedra(scaled(withNoise(uniform, 0.5, 24), 1e300, 1e300, 1e300), 0.5, threads);
    expectSameTetrahedra(withNoise(sphere, 0.5, 25), 0.5, threads);
    expectSameTetrahedra(clouds::coarse(20000, 40, 26), 4.5, threads);
  }
  constexpr std::size_t manyThreads = 300;
  expectSameTetrahedra(withNoise(clouds::uniform(5000, 27), 0.5, 27), 0.5, manyThreads);
}

/// Wherever the band begins, all pieces of the surface are found: samples on the wrong side of what
/// is found so far show that others are missing.
TEST(Tetrahedra, DoNotDependOnTheFirstBand)
{
  const Cloud cloud = clouds::uniform(20000, 17);
  const Cloud noise = withNoise(clouds::uniform(3000, 18), 0.01, 18);
  const Cloud lattice = clouds::lattice(20, 20, 20);
  for (const double share : { 0.01, 0.1, 0.5, 0.9 })
  {
    SCOPED_TRACE(share);
    const Found found = triangles::foundFromPart(cloud, 0.5, share);
    EXPECT_FALSE(found.counts.isWhole);
    EXPECT_TRUE(found.corners == triangles::fullTetrahedra(cloud, 0.5));
    EXPECT_TRUE(
      triangles::foundFromPart(noise, 0.5, share).corners == triangles::fullTetrahedra(noise, 0.5));
    EXPECT_TRUE(triangles::foundFromPart(lattice, 0.5, share).corners ==
                triangles::fullTetrahedra(lattice, 0.5));
  }
}

TEST(Tetrahedra, OfAnyScaleAndPlace)
{
  const Cloud cloud = clouds::uniform(1500, 15);
  for (const double scale : { 1e-308, 1e-300, 1e-150, 1e-60, 1e60, 1e150, 1e300 })
  {
    SCOPED_TRACE(scale);
    expectSameTetrahedra(scaled(cloud, scale, scale, scale), 0.5);
  }
  expectSameTetrahedra(scaled(cloud, 1e100, 1.0, 1e-100), 0.5);
  Cloud far = cloud;
  for (double& coordinate : far.positions)
  {
    coordinate += 1e7;
  }
  expectSameTetrahedra(far, 0.5);
  for (double& coordinate : far.positions)
  {
    coordinate = (coordinate + 1e13) - 1e13; // a coarse lattice, full of coincident samples
  }
  expectSameTetrahedra(far, 0.5);
}

TEST(Tetrahedra, OfDegenerateCloudsAreNone)
{
  EXPECT_TRUE(expectSameTetrahedra(Cloud(), 0.5).corners.empty());
  for (const int dimensions : { 0, 1, 2 })
  {
    const Cloud flat = clouds::flattened(clouds::uniform(300, 16), dimensions);
    EXPECT_TRUE(expectSameTetrahedra(flat, 0.5).corners.empty());
    EXPECT_TRUE(expectSameTetrahedra(turned(flat), 0.5).corners.empty() || dimensions > 0);
  }
  for (std::size_t count = 1; count < 12; ++count)
  {
    expectSameTetrahedra(withNoise(clouds::uniform(count, count), 0.5, count), 0.5);
  }
}

// The band of one isovalue is kept for the next: near ones, others far away, and back.
TEST(Tetrahedra, OfOneIsovalueAfterAnother)
{
  triangles::KeptTetrahedra random(withSphere(clouds::uniform(40000, 3)));
  for (const double isovalue : { 0.3, 0.31, 0.305, 0.2, 0.33, 0.34, 0.35, 0.36, -1.0, 0.36, 0.6 })
  {
    random.expectSame(isovalue);
  }
  for (const double side : { 32.0, 30.0 }) // exact, and rounded
  {
    triangles::KeptTetrahedra lattice(
      withSphere(scaled(clouds::lattice(33, 33, 33), 1.0 / side, 1.0 / side, 1.0 / side)));
    for (const double isovalue : { 0.3, 0.31, 0.32, 0.35, 0.3 })
    {
      lattice.expectSame(isovalue);
    }
  }
  // All samples are tetrahedrized.
  triangles::KeptTetrahedra noise(withNoise(clouds::uniform(3000, 4), 0.5, 5));
  noise.expectSame(0.5);
  noise.expectSame(0.4);
}

TEST(Tetrahedra, KeepsTheBandOfASurface)
{
  triangles::KeptTetrahedra kept(withSphere(clouds::uniform(40000, 3)));
  const Found first = kept.expectSame(0.3);
  EXPECT_EQ(0u, kept.expectSame(0.3).counts.size - first.counts.size);
  EXPECT_LT(kept.expectSame(0.302).counts.size, first.counts.size + first.counts.size / 4);
  EXPECT_LT(kept.expectSame(0.1).counts.size, first.counts.size); // another band
}

TEST(Tetrahedra, KeepTheBandWhereThereIsNoSurface)
{
  triangles::KeptTetrahedra kept(withSphere(clouds::uniform(40000, 3)));
  EXPECT_LT(1u, kept.expectSame(0.3).counts.rounds);
  EXPECT_TRUE(kept.expectSame(1000.0).corners.empty());
  EXPECT_EQ(1u, kept.expectSame(0.3).counts.rounds); // all is known
}

TEST(Tetrahedra, KeepNoBandUnlessItIsWanted)
{
  triangles::KeptTetrahedra kept(withSphere(clouds::uniform(5000, 3)));
  kept.expectSame(0.3);
  EXPECT_TRUE(kept.hasBand());
  kept.expectSame(0.3, false);
  EXPECT_FALSE(kept.hasBand());
}
