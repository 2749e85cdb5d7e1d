// SPDX-License-Identifier: GPL-3.0-or-later
// The crossing tetrahedra that the core finds are those of the full Delaunay tetrahedralization.
#include "RandomClouds.h"
#include "TriangleTesting.h"

namespace
{

using clouds::Cloud;
using clouds::Dice;
using clouds::Random;
using clouds::scaled;
using triangles::expectSameTetrahedra;
using triangles::Found;
using triangles::TetrahedraSearch;

/// Values become the distance from the middle of the unit cube.
Cloud withSphere(const Cloud& cloud)
{
  return clouds::withValuesOf(cloud, clouds::fromMiddle);
}

Cloud latticeWithSphere(double side = 32.0)
{
  return withSphere(scaled(clouds::lattice(33, 33, 33), 1.0 / side, 1.0 / side, 1.0 / side));
}

/// Values become white noise: a share of the samples is below 0.5.
Cloud withNoise(Cloud cloud, double share, std::uint64_t seed)
{
  Random random(seed);
  std::generate(
    cloud.values.begin(), cloud.values.end(), [&]() { return random() < share ? 0.0 : 1.0; });
  return cloud;
}

Cloud turned(const Cloud& cloud)
{
  return clouds::moved(cloud, clouds::turn);
}

Cloud without(const Cloud& cloud, std::size_t step)
{
  return clouds::filtered(
    cloud, [i = std::size_t{ 0 }, step](const auto&) mutable { return (i++ * 7919) % step != 0; });
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
    clouds::Vector p;
    const auto& q = quadruples[static_cast<std::size_t>(4.0 * random())];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      p[axis] = (random() < 0.5 ? q[axis] : -q[axis]) * std::ceil(4.0 * random());
    }
    cloud.add(p, random());
  }
  return cloud;
}

/// Adds the centers of the leaves of an octree that is refined around a sphere.
void addLeaves(Cloud& cloud, const clouds::Vector& center, double half, int levels)
{
  const double distance = clouds::fromMiddle(center);
  if (levels == 0 || std::abs(distance - 0.31) > 2.0 * half)
  {
    cloud.add(center, distance);
    return;
  }
  for (int i = 0; i < 8; ++i)
  {
    const auto child = [&](int axis)
    {
      const double side = (i >> axis) % 2 ? 0.5 : -0.5;
      return center[static_cast<std::size_t>(axis)] + side * half;
    };
    addLeaves(cloud, { child(0), child(1), child(2) }, 0.5 * half, levels - 1);
  }
}

Cloud octreeLeaves(int levels)
{
  Cloud cloud;
  addLeaves(cloud, { 0.5, 0.5, 0.5 }, 0.5, levels);
  return cloud;
}

/// Stretches the axes, turns the cloud, moves it far off, or rounds its coordinates.
Cloud deformed(const Cloud& cloud, Dice& dice)
{
  double factors[3] = { 1.0, 1.0, 1.0 };
  if (dice(3) == 0)
  {
    std::generate_n(factors, 3, [&]() { return std::pow(10.0, -4.0 * dice.real()); });
  }
  const bool isTurned = dice(4) == 0;
  const double offset = dice(6) == 0 ? std::pow(10.0, 12.0 * dice.real()) : 0.0;
  const double step = dice(5) == 0 ? std::pow(2.0, -static_cast<double>(dice(12))) : 0.0;
  const Cloud stretched = scaled(cloud, factors[0], factors[1], factors[2]);
  return clouds::moved(isTurned ? turned(stretched) : stretched,
    [=](double* p)
    {
      std::transform(p, p + 3, p,
        [=](double c) { return step > 0.0 ? step * std::round((c + offset) / step) : c + offset; });
    });
}

/// Some values become noise: of a few samples, of about half of them, or of all.
void addNoise(Cloud& cloud, double isovalue, Dice& dice)
{
  if (dice(2) > 0)
  {
    const double share = std::pow(0.5, static_cast<double>(dice(9)));
    const double other = dice(2) == 0 ? isovalue - 1.0 : isovalue;
    const bool isAlone = dice(2) == 0;
    for (double& value : cloud.values)
    {
      value = dice.real() < share ? other : isAlone ? 2.0 * isovalue - other - 0.5 : value;
    }
  }
}

} // namespace

TEST(Tetrahedra, OfCloudsOfEveryKind)
{
  const Cloud slab = scaled(clouds::uniform(20000, 5), 1.0, 1.0, 0.01);
  const Cloud lattice = clouds::lattice(25, 20, 30);
  const std::vector<std::pair<Cloud, double>> cases{
    { clouds::uniform(30000, 2), 0.4 },
    { clouds::uniform(30000, 2), -2.0 },
    { clouds::clustered(20000, 3), -4.0 },
    { withNoise(clouds::clustered(5000, 4), 0.1, 4), 0.5 },
    { slab, 0.5 },
    { scaled(slab, 1.0, 1.0, 1e-4), 0.5 },
    { lattice, 0.5 },
    { without(lattice, 7), 0.5 },
    { without(lattice, 2), 0.5 },
    { turned(clouds::lattice(20, 20, 20)), 0.5 },
    { turned(without(clouds::lattice(15, 20, 17), 5)), 0.5 },
    { turned(octreeLeaves(4)), 0.3 },
    { octreeLeaves(6), 0.3 },
    { octreeLeaves(5), 0.42 },
    { clouds::lines(3000, 24, 0, 6), 0.3 },
    { clouds::lines(3000, 24, 100, 6), 0.3 },
    { clouds::lines(400, 3, 0, 7), 0.3 },
    { clouds::combs(3000, 12, 8), 0.3 },
    { clouds::curves(600, 9), 0.3 },
    { clouds::layerBeforeOne(3000, 10), 0.5 },
    { clouds::coincident(clouds::uniform(5000, 11), 0.5), 0.5 },
    { clouds::coarse(20000, 12, 12), 4.5 },
    { clouds::nestedCoincident(2000), 3.0 },
    { cospherical(500, 13), 0.5 },
    { withNoise(cospherical(3000, 14), 0.05, 14), 0.5 },
    { Cloud(), 0.5 },
  };
  for (std::size_t i = 0; i < cases.size(); ++i)
  {
    SCOPED_TRACE(i);
    expectSameTetrahedra(cases[i].first, cases[i].second);
  }
}

TEST(Tetrahedra, OfFewOfTheSamplesNearTheSurface)
{
  const Found found = expectSameTetrahedra(withSphere(clouds::uniform(40000, 1)), 0.3);
  EXPECT_FALSE(found.counts.isWhole);
  EXPECT_LT(found.counts.size, 15000u);
  EXPECT_FALSE(expectSameTetrahedra(latticeWithSphere(), 0.4).counts.isWhole);
}

TEST(Tetrahedra, OfFloats)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    SCOPED_TRACE(seed);
    const double share = static_cast<double>(seed - 1) / 19.0;
    const auto count = static_cast<std::size_t>(100.0 * std::pow(1000.0, share));
    expectSameTetrahedra<isopoint::FloatSample>(
      clouds::roundedToFloat(clouds::uniform(count, seed)), 0.5, 2);
  }
}

/// The environment variables TETRAHEDRA_FIRST_SEED and TETRAHEDRA_SEEDS choose other clouds and
/// isovalues than the first few hundred.
TEST(Tetrahedra, OfRandomCloudsOfEveryKind)
{
  const std::uint64_t first = clouds::numberFrom("TETRAHEDRA_FIRST_SEED", 1);
  const std::uint64_t count = clouds::numberFrom("TETRAHEDRA_SEEDS", 300);
  for (std::uint64_t seed = first; seed < first + count && !HasFailure(); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Dice dice(seed);
    const Cloud random = clouds::randomCloud(dice, seed);
    const double isovalue = 3.0 * dice.real() - 1.0;
    Cloud cloud = deformed(random, dice);
    addNoise(cloud, isovalue, dice);
    expectSameTetrahedra(cloud, isovalue, 1 + dice(2));
  }
}

/// A piece of the surface is far from all samples of the first band, and spheres do not find it: in
/// these clouds, found by chance, only the check of sides does.
TEST(Tetrahedra, OfPiecesThatTheBandDoesNotTouch)
{
  for (const auto& [count, seed] :
    { std::pair(158, 737), std::pair(158, 1807), std::pair(158, 7091), std::pair(250, 8590) })
  {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed));
    const auto coordinate = [&]() { return std::pow(10.0, -6.0 * random()); };
    Cloud cloud;
    for (int i = 0; i < count; ++i)
    {
      const clouds::Vector p{ coordinate(), coordinate(), coordinate() };
      cloud.add(p, p[0] < 0.5 || random() < 0.1 ? 0.0 : 1.0);
    }
    EXPECT_FALSE(expectSameTetrahedra(cloud, 0.5).counts.isWhole);
  }
}

/// Where most samples are near the surface, or searches are long, all are in the
/// tetrahedralization.
TEST(Tetrahedra, OfAllSamplesWhereThatIsQuicker)
{
  EXPECT_TRUE(
    expectSameTetrahedra(withNoise(clouds::uniform(5000, 19), 0.5, 19), 0.5).counts.isWhole);
  Random random(20);
  Cloud shell;
  for (int i = 0; i < 20000; ++i)
  {
    const clouds::Vector p = random.inCube(1.0);
    const double scale = (1.0 + 1e-6 * random()) / isopoint::lengthOf(p);
    shell.add(scale * p, p[0] * scale);
  }
  EXPECT_TRUE(expectSameTetrahedra(shell, 0.1).counts.isWhole);
}

/// Large insertions run on several threads, which conflict more or less often.
TEST(Tetrahedra, AreTheSameFromSeveralThreads)
{
  const Cloud uniform = clouds::uniform(20000, 21);
  const Cloud sphere = clouds::moved(clouds::uniform(10000, 22),
    [](double* p)
    {
      const double length = clouds::fromMiddle({ p[0], p[1], p[2] });
      std::for_each(p, p + 3, [length](double& coordinate) { coordinate = coordinate / length; });
    });
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
  expectSameTetrahedra(withNoise(clouds::uniform(5000, 27), 0.5, 27), 0.5, 300);
}

TEST(Tetrahedra, AreInsertedTogetherByManyThreads)
{
  constexpr std::size_t threads = 3;
  std::size_t batches = 0;
  isopoint::Execution execution;
  execution.threads = threads;
  execution.parallelFor = [&](std::size_t count, std::size_t grain, const isopoint::RangeTask& task)
  {
    batches += count == threads && grain == 1 ? 1 : 0; // a stream of samples for each thread
    task(0, count);
  };
  std::vector<isopoint::Site> sites;
  Random random(28);
  isopoint::CoordinateUnit unit;
  for (std::uint64_t leaf = 0; leaf < 20000; ++leaf)
  {
    sites.push_back({ random.place(), leaf, false });
    unit.add(sites.back().position);
  }
  isopoint::PartialTriangulation triangulation(unit);
  triangulation.insert(execution, sites, [](double) {});
  EXPECT_EQ(sites.size(), triangulation.size());
#ifdef CGAL_LINKED_WITH_TBB
  EXPECT_LE(3u, batches);
#else
  EXPECT_EQ(0u, batches);
#endif
}

/// Samples on the wrong side of the tetrahedra found so far show that others are missing.
TEST(Tetrahedra, DoNotDependOnTheFirstBand)
{
  for (const double share : { 0.01, 0.1, 0.5, 0.9 })
  {
    SCOPED_TRACE(share);
    TetrahedraSearch<> uniform(clouds::uniform(20000, 17));
    EXPECT_FALSE(uniform.expectSameFromPart(0.5, share).counts.isWhole);
    TetrahedraSearch<> noise(withNoise(clouds::uniform(3000, 18), 0.01, 18));
    noise.expectSameFromPart(0.5, share);
    TetrahedraSearch<> lattice(clouds::lattice(20, 20, 20));
    lattice.expectSameFromPart(0.5, share);
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
  const auto rounded = [](const Cloud& all, double above, double below)
  {
    return clouds::moved(all,
      [=](double* p) { std::for_each(p, p + 3, [=](double& c) { c = (c + above) - below; }); });
  };
  const Cloud far = rounded(cloud, 1e7, 0.0);
  expectSameTetrahedra(far, 0.5);
  // A coarse lattice, full of coincident samples.
  expectSameTetrahedra(rounded(far, 1e13, 1e13), 0.5);
}

// The band of one isovalue is kept for the next: near ones, others far away, and back.
TEST(Tetrahedra, OfOneIsovalueAfterAnother)
{
  const auto expectSame = [](const Cloud& cloud, const std::vector<double>& isovalues)
  {
    TetrahedraSearch<> kept(cloud);
    std::for_each(
      isovalues.begin(), isovalues.end(), [&](double isovalue) { kept.expectSame(isovalue); });
  };
  expectSame(withSphere(clouds::uniform(40000, 3)),
    { 0.3, 0.31, 0.305, 0.2, 0.33, 0.34, 0.35, 0.36, -1.0, 0.36, 0.6 });
  for (const double side : { 32.0, 30.0 }) // exact, and rounded
  {
    expectSame(latticeWithSphere(side), { 0.3, 0.31, 0.32, 0.35, 0.3 });
  }
  // All samples are in the tetrahedralization.
  expectSame(withNoise(clouds::uniform(3000, 4), 0.5, 5), { 0.5, 0.4 });
}

TEST(Tetrahedra, KeepTheBand)
{
  TetrahedraSearch<> kept(withSphere(clouds::uniform(40000, 3)));
  const Found first = kept.expectSame(0.3);
  EXPECT_LT(1u, first.counts.rounds);
  EXPECT_EQ(kept.expectSame(0.3).counts.size, first.counts.size);
  EXPECT_TRUE(kept.expectSame(1000.0).corners.empty());
  EXPECT_EQ(1u, kept.expectSame(0.3).counts.rounds); // all is known
  EXPECT_LT(kept.expectSame(0.302).counts.size, first.counts.size + first.counts.size / 4);
  EXPECT_LT(kept.expectSame(0.1).counts.size, first.counts.size); // another band
  EXPECT_TRUE(kept.hasBand());
  kept.expectSame(0.3, false);
  EXPECT_FALSE(kept.hasBand());
}
