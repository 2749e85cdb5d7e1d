// SPDX-License-Identifier: GPL-3.0-or-later
// Random clouds and isovalues. The environment variables TETRAHEDRA_FIRST_SEED and TETRAHEDRA_SEEDS
// choose others than the first few hundred. The crossing tetrahedra are those of the full Delaunay
// tetrahedrization.
#include "RandomClouds.h"
#include "TriangleTesting.h"

#include <string>

namespace
{

using clouds::Cloud;
using clouds::Dice;

/// Stretches the axes, turns the cloud, moves it far off, or rounds its coordinates.
void deform(Cloud& cloud, Dice& dice)
{
  double factors[3] = { 1.0, 1.0, 1.0 };
  if (dice(3) == 0)
  {
    for (double& factor : factors)
    {
      factor = std::pow(10.0, -4.0 * dice.real());
    }
  }
  const bool isTurned = dice(4) == 0;
  const double offset = dice(6) == 0 ? std::pow(10.0, 12.0 * dice.real()) : 0.0;
  const double step = dice(5) == 0 ? std::pow(2.0, -static_cast<double>(dice(12))) : 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    double* const p = cloud.positions.data() + 3 * i;
    for (int axis = 0; axis < 3; ++axis)
    {
      p[axis] *= factors[axis];
    }
    if (isTurned)
    {
      clouds::turn(p);
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      p[axis] += offset;
      p[axis] = step > 0.0 ? step * std::round(p[axis] / step) : p[axis];
    }
  }
}

/// Some values become noise: of a few samples, of about half of them, or of all.
void addNoise(Cloud& cloud, double isovalue, Dice& dice)
{
  if (dice(2) == 0)
  {
    return;
  }
  const double share = std::pow(0.5, static_cast<double>(dice(9)));
  const double other = dice(2) == 0 ? isovalue - 1.0 : isovalue;
  const bool isAlone = dice(2) == 0;
  for (double& value : cloud.values)
  {
    value = dice.real() < share ? other : isAlone ? 2.0 * isovalue - other - 0.5 : value;
  }
}

void checkOne(std::uint64_t seed)
{
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  Cloud cloud = clouds::randomCloud(dice, seed);
  const double isovalue = 3.0 * dice.real() - 1.0;
  deform(cloud, dice);
  addNoise(cloud, isovalue, dice);
  triangles::expectSameTetrahedra(cloud, isovalue, 1 + dice(2));
}

} // namespace

TEST(TetrahedraRandom, AreThoseOfTheFullTetrahedrization)
{
  const std::uint64_t first = clouds::numberFrom("TETRAHEDRA_FIRST_SEED", 1);
  const std::uint64_t count = clouds::numberFrom("TETRAHEDRA_SEEDS", 300);
  for (std::uint64_t seed = first; seed < first + count && !HasFailure(); ++seed)
  {
    checkOne(seed);
  }
}
