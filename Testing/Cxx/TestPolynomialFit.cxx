// SPDX-License-Identifier: GPL-3.0-or-later
// What samples determine of a polynomial, and what they do not. TestFitDefinition compares whole
// fits.
#include "FitTesting.h"

#include "Core/Fit/NormalEquations.h"
#include "Core/Fit/PolynomialFit.h"

using namespace fittesting;

namespace
{

double nothing(const Vector&)
{
  return 0.0;
}

} // namespace

TEST(NormalEquations, DetermineWhatTheSamplesDo)
{
  const auto determined = [](std::size_t count, const std::function<Vector(const Vector&)>& moved)
  {
    std::vector<FitSample> samples = samplesOf(nothing, count, 0.0, 3);
    for (FitSample& sample : samples)
    {
      sample.position = moved ? moved(sample.position) : sample.position;
    }
    const FrameCase sampled(samples);
    return NormalEquations<3>(sampled.samples, sampled.weights).determinedDegree();
  };
  for (const auto& [count, degree] : { std::pair(3, 0), std::pair(4, 1), std::pair(9, 1),
         std::pair(10, 2), std::pair(19, 2), std::pair(30, 3) })
  {
    EXPECT_EQ(determined(static_cast<std::size_t>(count), {}), degree);
  }
  EXPECT_EQ(determined(30, [](const Vector& p) { return Vector{ p[0], p[1], 0.3 * p[0] }; }), 0);
  EXPECT_EQ(determined(30, [](const Vector&) { return Vector{ 1.0, 1.0, 1.0 }; }), 0);
  const auto onPlanes = [](double count)
  {
    return [count](const Vector& p) {
      return Vector{ p[0], p[1], std::floor(0.25 * count * (p[2] + 2.0)) };
    };
  };
  for (const int count : { 2, 3, 4 })
  {
    EXPECT_EQ(determined(60, onPlanes(count)), count - 1);
  }
  EXPECT_EQ(determined(60, directionOf), 1);
}

// The limit: a plane of samples with one off it, whose share of z^2 is the pivot of z.
TEST(NormalEquations, APivotDecidesOnWhatIsDetermined)
{
  const auto isDetermined = [](double share)
  {
    FrameCase sampled;
    // The mean of z is 1, its variance that of both signs; twice, since four samples are too few.
    for (int i = 0; i < 8; ++i)
    {
      const double x = i % 2 ? 1.0 : -1.0;
      const double y = i / 2 % 2 ? 1.0 : -1.0;
      sampled.add({ x, y, 1.0 + std::sqrt(share) * x * y }, 0.0, i < 4 ? 0.3 : 0.7);
    }
    return leastSquares(sampled.samples, sampled.weights, 1).has_value();
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
      FrameCase place(samplesOf(nothing, 40, 0.0, 4));
      place.add({ bad, 0.0, 0.0 }, 0.0);
      EXPECT_FALSE(leastSquares(place.samples, place.weights, degree));
      FrameCase weight(samplesOf(nothing, 40, 0.0, 4));
      weight.add({ 0.5, 0.0, 0.0 }, 0.0, bad == 1e200 ? 0.0 / 0.0 : bad);
      EXPECT_FALSE(leastSquares(weight.samples, weight.weights, degree));
    }
  }
}

// Without the only sample off three planes, no cubic is determined; without the only one off two,
// no quadratic.
TEST(PolynomialFit, DoesNotHoldWhereASampleAloneDeterminesACoefficient)
{
  const auto isDetermined = [](double planes, bool areMoreOff, int degree)
  {
    FrameCase sampled;
    sampled.add({ 0.3, 0.2, 0.45 }, 0.45);
    clouds::Random random(11);
    for (int i = 0; i < 60; ++i)
    {
      const Vector p = random.inCube(4.0);
      const double z = std::floor(0.25 * planes * (p[2] + 2.0)) - 0.5;
      sampled.add({ p[0], p[1], z }, z + 0.1 * p[0] * p[1]);
    }
    if (areMoreOff)
    {
      sampled.add({ -0.3, 0.1, 0.4 }, 0.4);
    }
    return fitPolynomial(sampled.samples, sampled.weights, { 0.0, 0.0, 2.0 }, degree).has_value();
  };
  for (const int degree : { 2, 3 })
  {
    EXPECT_FALSE(isDetermined(degree, false, degree));
    EXPECT_TRUE(isDetermined(degree, true, degree));
  }
}
