// SPDX-License-Identifier: GPL-3.0-or-later
// What samples determine of a polynomial, and what they do not. TestFitDefinition compares whole
// fits.
#include "Random.h"

#include "Core/Fit/FrameSamples.h"
#include "Core/Fit/NormalEquations.h"
#include "Core/Fit/PolynomialFit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace
{

using isopoint::FrameSamples;
using isopoint::FrameWeights;
using isopoint::Vector;

/// Samples and weights, as the core takes them.
struct Case
{
  FrameSamples samples;
  FrameWeights weights;

  void add(const Vector& place, double value, double weight)
  {
    this->samples.add(place, value);
    this->weights[this->samples.count() - 1] = weight;
    endWeights(this->samples, this->weights);
  }
};

/// Random places in a cube of side 4.
std::vector<Vector> randomPlaces(std::size_t count, std::uint64_t seed)
{
  clouds::Random random(seed);
  std::vector<Vector> places;
  for (std::size_t i = 0; i < count; ++i)
  {
    places.push_back({ 4.0 * random() - 2.0, 4.0 * random() - 2.0, 4.0 * random() - 2.0 });
  }
  return places;
}

/// Samples at random places, of the value 0 and the weight 1.
Case randomCase(std::size_t count, std::uint64_t seed)
{
  Case result;
  for (const Vector& place : randomPlaces(count, seed))
  {
    result.add(place, 0.0, 1.0);
  }
  return result;
}

} // namespace

TEST(NormalEquations, DetermineWhatTheSamplesDo)
{
  const auto determined = [](std::size_t count, const std::function<Vector(const Vector&)>& moved)
  {
    Case sampled;
    for (const Vector& place : randomPlaces(count, 3))
    {
      sampled.add(moved(place), 0.0, 1.0);
    }
    return isopoint::NormalEquations<3>(sampled.samples, sampled.weights).determinedDegree();
  };
  const auto stay = [](const Vector& p) { return p; };
  EXPECT_EQ(determined(3, stay), 0);
  EXPECT_EQ(determined(4, stay), 1);
  EXPECT_EQ(determined(9, stay), 1);
  EXPECT_EQ(determined(10, stay), 2);
  EXPECT_EQ(determined(19, stay), 2);
  EXPECT_EQ(determined(30, stay), 3);
  EXPECT_EQ(determined(30, [](const Vector& p) { return Vector{ p[0], p[1], 0.3 * p[0] }; }), 0);
  EXPECT_EQ(determined(30, [](const Vector&) { return Vector{ 1.0, 1.0, 1.0 }; }), 0);
  const auto onPlanes = [](double count)
  {
    return [count](const Vector& p) {
      return Vector{ p[0], p[1], std::floor(0.25 * count * (p[2] + 2.0)) };
    };
  };
  EXPECT_EQ(determined(60, onPlanes(2.0)), 1);
  EXPECT_EQ(determined(60, onPlanes(3.0)), 2);
  EXPECT_EQ(determined(60, onPlanes(4.0)), 3);
  const auto onSphere = [](const Vector& p) { return isopoint::directionOf(p); };
  EXPECT_EQ(determined(60, onSphere), 1);
}

// The limit: a plane of samples with one off it, whose share of z^2 is the pivot of z.
TEST(NormalEquations, APivotDecidesOnWhatIsDetermined)
{
  const auto isDetermined = [](double share)
  {
    Case sampled;
    const double z = 1.0;
    for (const double x : { -1.0, 1.0 })
    {
      for (const double y : { -1.0, 1.0 })
      {
        // The mean of z is z, its variance that of both signs.
        for (const double weight : { 0.3, 0.7 }) // twice, since four samples are too few
        {
          sampled.add({ x, y, z + std::sqrt(share) * x * y }, 0.0, weight);
        }
      }
    }
    return isopoint::leastSquares(sampled.samples, sampled.weights, 1).has_value();
  };
  EXPECT_FALSE(isDetermined(0.9e-7));
  EXPECT_TRUE(isDetermined(1.1e-7));
}

TEST(NormalEquations, NumbersOfNoUseDetermineNothing)
{
  for (const double bad :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e200 })
  {
    for (int degree = 1; degree <= 3; ++degree)
    {
      Case place = randomCase(40, 4);
      place.add({ bad, 0.0, 0.0 }, 0.0, 1.0);
      EXPECT_FALSE(isopoint::leastSquares(place.samples, place.weights, degree));
      Case weight = randomCase(40, 4);
      weight.add({ 0.5, 0.0, 0.0 }, 0.0, bad == 1e200 ? 0.0 / 0.0 : bad);
      EXPECT_FALSE(isopoint::leastSquares(weight.samples, weight.weights, degree));
    }
  }
}

// Without the only sample off three planes, no cubic is determined; without the only one off two,
// no quadratic.
TEST(PolynomialFit, DoesNotHoldWhereASampleAloneDeterminesACoefficient)
{
  const auto isDetermined = [](double planes, bool areMoreOff, int degree)
  {
    Case sampled;
    sampled.add({ 0.3, 0.2, 0.45 }, 0.45, 1.0);
    for (const Vector& p : randomPlaces(60, 11))
    {
      const double z = std::floor(0.25 * planes * (p[2] + 2.0)) - 0.5;
      sampled.add({ p[0], p[1], z }, z + 0.1 * p[0] * p[1], 1.0);
    }
    if (areMoreOff)
    {
      sampled.add({ -0.3, 0.1, 0.4 }, 0.4, 1.0);
    }
    return isopoint::fitPolynomial(sampled.samples, sampled.weights, { 0.0, 0.0, 2.0 }, degree)
      .has_value();
  };
  EXPECT_FALSE(isDetermined(3.0, false, 3));
  EXPECT_TRUE(isDetermined(3.0, true, 3));
  EXPECT_FALSE(isDetermined(2.0, false, 2));
  EXPECT_TRUE(isDetermined(2.0, true, 2));
}
