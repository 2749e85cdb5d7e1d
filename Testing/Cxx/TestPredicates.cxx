// SPDX-License-Identifier: GPL-3.0-or-later
// Predicates in doubles agree with CGAL's exact ones, where coordinates have a common unit.
#include "Clouds.h"

#include "Core/Tetrahedra/CoordinateUnit.h"
#include "Core/Tetrahedra/TriangulationKernel.h"

#include <gtest/gtest.h>

namespace
{

using namespace isopoint;
using cgal::Kernel;
using cgal::Point;
using clouds::Random;
using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;

double unitOf(const std::vector<Vector>& positions, double least = 0.0)
{
  CoordinateUnit unit(least);
  for (const Vector& position : positions)
  {
    unit.add(position);
  }
  return unit.value();
}

/// Expects the same of five points as from CGAL.
void expectSameAnswers(const CoordinateUnit& unit, const std::array<Vector, 5>& positions)
{
  const auto at = [&](std::size_t i)
  { return Point(positions[i][0], positions[i][1], positions[i][2]); };
  const Kernel kernel(&unit);
  EXPECT_EQ(kernel.orientation_3_object()(at(0), at(1), at(2), at(3)),
    Exact::Orientation_3()(at(0), at(1), at(2), at(3)));
  EXPECT_EQ(kernel.side_of_oriented_sphere_3_object()(at(0), at(1), at(2), at(3), at(4)),
    Exact::Side_of_oriented_sphere_3()(at(0), at(1), at(2), at(3), at(4)));
}

/// Random positions of integers below a number, times a unit, plus an offset.
void expectSameInLattice(double below, double step, double offset, std::uint64_t seed)
{
  Random random(seed);
  for (int round = 0; round < 5000; ++round)
  {
    std::array<Vector, 5> positions;
    CoordinateUnit unit;
    for (Vector& position : positions)
    {
      position = random.place();
      std::for_each(position.begin(), position.end(),
        [=](double& coordinate) { coordinate = step * std::floor(below * coordinate) + offset; });
      unit.add(position);
    }
    ASSERT_LE(step, unit.value());
    expectSameAnswers(unit, positions);
  }
}

} // namespace

TEST(CoordinateUnit, IsTheLargestPowerOfTwoThatDividesAll)
{
  EXPECT_EQ(0.25, unitOf({ { 0.75, 12.0, -3.5 } }));
  EXPECT_EQ(4.0, unitOf({ { 4.0, 12.0, 0.0 }, { -1024.0, 8.0, 20.0 } }));
  EXPECT_EQ(1.0, unitOf({ { 3.0, 5.0, 7.0 } }));
  EXPECT_EQ(0x1p-52, unitOf({ { 1.0 + 0x1p-52, 1.0, 1.0 } }));
  EXPECT_EQ(0x1p-30, unitOf({ { 0x1p40, 0.0, 0x1p-30 } })); // more than 64 bits in all
  EXPECT_EQ(0x1p-30, unitOf({ { 0x1p-30, 0.0, 0x1p40 } }));
  EXPECT_LT(1e20, unitOf({ { 0.0, -0.0, 0.0 } }));
}

TEST(CoordinateUnit, IsNoneWhereItIsOfNoUse)
{
  EXPECT_EQ(0.0, unitOf({ { 1.0, 0.5, 1.0 } }, 1.0));
  EXPECT_EQ(1.0, unitOf({ { 1.0, 3.0, 1.0 } }, 1.0));
  EXPECT_EQ(0.0, unitOf({ { 1e-300, 1.0, 1.0 } }));
  EXPECT_EQ(0.0, unitOf({ { 1e-308, 1e-310, 0.0 } }));
  EXPECT_EQ(0.0, unitOf({ { 1.0, std::numeric_limits<double>::infinity(), 1.0 } }));
  EXPECT_EQ(0.0, unitOf({ { 0x1p-560, 0x1p-560, 0.0 } }, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(0.0, unitOf({ { 1.0, std::numeric_limits<double>::denorm_min(), 1.0 } }));
  CoordinateUnit unit;
  unit.add({ 0.5, 0.5, 0.5 });
  CoordinateUnit other;
  other.add({ 8.0, 8.0, 8.0 });
  unit.add(other);
  EXPECT_EQ(0.5, unit.value());
}

// Of few places many are coplanar or on one sphere. With more bits the doubles just suffice, or no
// longer do.
TEST(Predicates, AreThoseOfCgalInLattices)
{
  expectSameInLattice(3.0, 1.0, 0.0, 1);
  expectSameInLattice(6.0, 0.125, 1000.0, 2);
  expectSameInLattice(20.0, 0x1p-60, 0.0, 3);
  expectSameInLattice(20.0, 0x1p60, 0.0, 4);
  for (const int bits : { 8, 9, 10, 12, 16, 17, 20, 26 })
  {
    expectSameInLattice(std::ldexp(1.0, bits) + 1.0, 1.0, 0.0, static_cast<std::uint64_t>(bits));
  }
}

// The fifth place is on the sphere of radius 105 through the others, or one unit off it.
TEST(Predicates, SeeOneUnitOnLargeSpheres)
{
  for (const double x : { -105.0, -104.0, -106.0 })
  {
    CoordinateUnit unit;
    unit.add({ 1.0, 1.0, 1.0 });
    expectSameAnswers(unit, { { { 105.0, 0.0, 0.0 }, { 30.0, 45.0, 90.0 }, { 0.0, 105.0, 0.0 },
                              { -90.0, 30.0, 45.0 }, { x, 0.0, 0.0 } } });
  }
}

TEST(Predicates, DoWithoutAUnit)
{
  Random random(5);
  CoordinateUnit unit(1.0);
  unit.add({ 0.1, 0.1, 0.1 });
  ASSERT_EQ(0.0, unit.value());
  for (int round = 0; round < 1000; ++round)
  {
    expectSameAnswers(
      unit, { random.place(), random.place(), random.place(), random.place(), random.place() });
  }
}
