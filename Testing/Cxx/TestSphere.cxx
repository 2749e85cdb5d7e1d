// SPDX-License-Identifier: GPL-3.0-or-later
// The sphere of [RL06], section 9, with fewer samples, against the analytic surface.
#include "Clouds.h"

#include "Core/Base/Vector.h"

#include <gtest/gtest.h>

#include <array>

namespace
{

struct TableRow
{
  double angle;
  double deviation; // the largest one, for 8 million samples ([RL06], Table 2)
};

constexpr double radius = 70.0;
constexpr std::size_t sampleCount = 250000;

clouds::Cloud sphereCloud()
{
  clouds::Random random(1);
  clouds::Cloud cloud;
  for (std::size_t i = 0; i < sampleCount; ++i)
  {
    const double x = 200.0 * random() - 100.0;
    const double y = 200.0 * random() - 100.0;
    const double z = 200.0 * random() - 100.0;
    cloud.add(x, y, z, std::sqrt(x * x + y * y + z * z));
  }
  return cloud;
}

double largestDeviation(const clouds::Cloud& cloud, const isopoint::Isosurface& surface)
{
  double largest = 0.0;
  for (const isopoint::IsopointEdge& edge : surface.edges)
  {
    double squared = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double coordinate = isopoint::interpolate(cloud.positions[3 * edge.first + axis],
        cloud.positions[3 * edge.second + axis], edge.parameter);
      squared += coordinate * coordinate;
    }
    largest = std::max(largest, std::abs(std::sqrt(squared) - radius));
  }
  return largest;
}

} // namespace

// Deviations are proportional to the square of the sample spacing.
TEST(Sphere, DeviatesNoMoreThanInTheTableOfRL06)
{
  const clouds::Cloud cloud = sphereCloud();
  const double coarser = std::pow(8e6 / static_cast<double>(sampleCount), 2.0 / 3.0);
  std::size_t fewer = cloud.size();
  for (const TableRow& row : std::array<TableRow, 4>{
         { { 15.0, 0.0425 }, { 35.0, 0.0355 }, { 55.0, 0.0320 }, { 80.0, 0.0182 } } })
  {
    const isopoint::Isosurface surface = clouds::extract(cloud, radius, row.angle, 2);
    EXPECT_LE(largestDeviation(cloud, surface), coarser * row.deviation) << row.angle;
    EXPECT_LT(surface.edges.size(), fewer) << row.angle;
    fewer = surface.edges.size();
  }
  EXPECT_GT(fewer, 3000u);
}
