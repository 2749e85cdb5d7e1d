// SPDX-License-Identifier: GPL-3.0-or-later
// Normal equations, zeros and errors of polynomials against dense least squares and refits.
#include "FitDefinition.h"
#include "Random.h"

#include "Isopoint/Fit/FrameSamples.h"
#include "Isopoint/Fit/NormalEquations.h"
#include "Isopoint/Fit/PolynomialFit.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace
{

using isopoint::FitSample;
using isopoint::FrameSamples;
using isopoint::FrameWeights;
using isopoint::laneCount;
using isopoint::Lanes;
using isopoint::Vector;

/// Samples and weights, as lists and as the core takes them.
struct Case
{
  std::vector<FitSample> list;
  fitdefinition::Weights weightList;
  FrameSamples samples;
  FrameWeights weights;

  void add(const Vector& place, double value, double weight)
  {
    this->list.push_back({ place, value });
    this->weightList.push_back(weight);
    this->samples.add(place, value);
    FrameSamples::at(this->weights, this->list.size() - 1) = weight;
    endWeights(this->samples, this->weights);
  }
};

/// Random samples and weights, the values those of a bent field that increases along z, and noise.
Case randomCase(std::size_t count, std::uint64_t seed, double noise = 0.3)
{
  clouds::Random random(seed);
  Case result;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vector p{ 4.0 * random() - 2.0, 4.0 * random() - 2.0, 4.0 * random() - 2.0 };
    result.add(
      p, 2.0 * p[2] + std::sin(p[0] + 0.5 * p[1]) + noise * (random() - 0.5), 0.01 + random());
  }
  return result;
}

const Vector upwards{ 0.0, 0.0, 2.0 };

/// The values of a polynomial with random coefficients on the samples of a case.
Case caseOfPolynomial(std::size_t count, std::uint64_t seed, Eigen::VectorXd coefficients)
{
  const fitdefinition::Polynomial polynomial{ std::move(coefficients) };
  const Case places = randomCase(count, seed);
  Case result;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vector& place = places.list[i].position;
    result.add(place, polynomial.valueAt(place), places.weightList[i]);
  }
  return result;
}

Eigen::VectorXd randomCoefficients(int degree, std::uint64_t seed)
{
  clouds::Random random(seed);
  Eigen::VectorXd coefficients(static_cast<Eigen::Index>(fitdefinition::countOf(degree)));
  for (double& coefficient : coefficients)
  {
    coefficient = random() - 0.5;
  }
  return coefficients;
}

template <int Degree>
void expectTheFactorsOfTheDesign(const Case& fitted)
{
  const isopoint::NormalEquations<Degree> equations(fitted.samples, fitted.weights);
  ASSERT_EQ(equations.determinedDegree(), Degree);
  for (int degree = 1; degree <= Degree; ++degree)
  {
    const Eigen::MatrixXd design = fitdefinition::designOf(fitted.list, fitted.weightList, degree);
    const Eigen::MatrixXd inverse = (design.transpose() * design).inverse();
    const auto expected =
      fitdefinition::leastSquares(fitted.list, fitted.weightList, degree).value();
    const isopoint::Polynomial found = equations.solution(degree);
    EXPECT_EQ(found.degree, degree);
    const std::size_t size = fitdefinition::countOf(degree);
    for (std::size_t i = 0; i < found.coefficients.size(); ++i)
    {
      if (i < size)
      {
        EXPECT_NEAR(
          found.coefficients[i], expected.coefficients[static_cast<Eigen::Index>(i)], 1e-10);
      }
      else
      {
        EXPECT_EQ(found.coefficients[i], 0.0);
      }
    }
    // Products of reduced vectors are those with the inverse of the normal equations.
    Lanes places[3];
    for (std::size_t lane = 0; lane < laneCount; ++lane)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        places[axis][static_cast<Eigen::Index>(lane)] = fitted.list[lane].position[axis];
      }
    }
    auto reduced = equations.products(places[0], places[1], places[2]);
    equations.reduce(degree, reduced);
    for (std::size_t lane = 0; lane < laneCount; ++lane)
    {
      const Eigen::VectorXd row =
        fitdefinition::designOf({ fitted.list[lane] }, { 1.0 }, degree).row(0).transpose();
      double leverage = 0.0;
      for (std::size_t i = 0; i < size; ++i)
      {
        const double number = reduced[i][static_cast<Eigen::Index>(lane)];
        leverage += number * number;
      }
      EXPECT_NEAR(leverage, row.dot(inverse * row), 1e-9);
      for (std::size_t coefficient = 0; coefficient < 4; ++coefficient)
      {
        std::array<double, isopoint::NormalEquations<Degree>::size> unit{};
        unit[coefficient] = 1.0;
        equations.reduce(degree, unit);
        double effect = 0.0;
        for (std::size_t i = 0; i < size; ++i)
        {
          effect += unit[i] * reduced[i][static_cast<Eigen::Index>(lane)];
        }
        EXPECT_NEAR(effect, (inverse * row)[static_cast<Eigen::Index>(coefficient)], 1e-9);
      }
    }
  }
}

/// The polynomial of the highest degree that holds.
std::optional<isopoint::PolynomialFit> fitHolding(const Case& sampled, int highest)
{
  for (int degree = highest; degree > 1; --degree)
  {
    const auto found = isopoint::fitPolynomial(sampled.samples, sampled.weights, upwards, degree);
    if (found && found->zero)
    {
      return found;
    }
  }
  return std::nullopt;
}

/// The slope of a fitted polynomial at the origin times the errors that are over it, of the case's
/// samples one by one.
void expectErrorsOfRefits(const Case& fitted, int highest)
{
  const auto found = fitHolding(fitted, highest);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->polynomial.degree, highest);
  const fitdefinition::Errors errors =
    fitdefinition::errorsOf(fitted.list, fitted.weightList, highest).value();
  const double slope = isopoint::lengthOf(found->polynomial.gradientAt({}));
  EXPECT_NEAR(found->relativeResidual, errors.sigma / slope, 1e-9 * errors.sigma / slope);
  const double zeroError = errors.sigma * errors.value / slope;
  EXPECT_NEAR(found->zeroError, zeroError, 1e-9 * zeroError);
  const double directionError = errors.sigma * errors.slope / slope;
  EXPECT_NEAR(found->directionError, directionError, 1e-9 * directionError);
}

} // namespace

TEST(NormalEquations, MomentsAreSumsOfProducts)
{
  const Case sampled = randomCase(30, 1);
  const isopoint::Moments<6> moments(sampled.samples, sampled.weights);
  for (int a = 0; a <= 6; ++a)
  {
    for (int b = 0; a + b <= 6; ++b)
    {
      for (int c = 0; a + b + c <= 6; ++c)
      {
        double sum = 0.0;
        double size = 0.0;
        for (std::size_t i = 0; i < sampled.list.size(); ++i)
        {
          const Vector& p = sampled.list[i].position;
          const double term =
            sampled.weightList[i] * std::pow(p[0], a) * std::pow(p[1], b) * std::pow(p[2], c);
          sum += term;
          size += std::abs(term);
        }
        EXPECT_NEAR(moments.at(a, b, c), sum, 1e-14 * size) << a << b << c;
      }
    }
  }
}

// Four lanes, each in order (docs/algorithm.md, section 10).
TEST(NormalEquations, SumsAreTakenInTheDefinedOrder)
{
  for (const std::size_t count : { 13, 30, 31, 32, 33 })
  {
    const Case sampled = randomCase(count, 2);
    const isopoint::Moments<2> moments(sampled.samples, sampled.weights);
    std::array<double, 4> lanes{};
    for (std::size_t i = 0; i < count; ++i)
    {
      const Vector& p = sampled.list[i].position;
      lanes[i % 4] += sampled.weightList[i] * p[1] * p[2];
    }
    EXPECT_EQ(moments.at(0, 1, 1), (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]));
  }
}

TEST(NormalEquations, AgreeWithDenseLeastSquares)
{
  for (const std::uint64_t seed : { 1, 2, 3, 4, 5 })
  {
    for (const std::size_t count : { 30, 61, 256 })
    {
      expectTheFactorsOfTheDesign<1>(randomCase(count, seed));
      expectTheFactorsOfTheDesign<2>(randomCase(count, seed));
      expectTheFactorsOfTheDesign<3>(randomCase(count, seed));
    }
  }
}

TEST(NormalEquations, ReproducePolynomials)
{
  for (const std::uint64_t seed : { 1, 2, 3, 4, 5 })
  {
    for (int degree = 1; degree <= 3; ++degree)
    {
      const Eigen::VectorXd expected = randomCoefficients(degree, seed);
      const Case sampled = caseOfPolynomial(60, seed, expected);
      for (int fitted = degree; fitted <= 3; ++fitted)
      {
        const auto found = isopoint::leastSquares(sampled.samples, sampled.weights, fitted);
        ASSERT_TRUE(found);
        for (std::size_t i = 0; i < found->coefficients.size(); ++i)
        {
          const auto index = static_cast<Eigen::Index>(i);
          EXPECT_NEAR(
            found->coefficients[i], index < expected.size() ? expected[index] : 0.0, 1e-11);
        }
      }
    }
  }
}

TEST(NormalEquations, DetermineWhatTheSamplesDo)
{
  const auto determined = [](std::size_t count, const std::function<Vector(const Vector&)>& moved)
  {
    Case sampled;
    for (const FitSample& sample : randomCase(count, 3).list)
    {
      sampled.add(moved(sample.position), sample.value, 1.0);
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

TEST(PolynomialFit, ErrorsAreThoseOfRefits)
{
  for (const std::uint64_t seed : { 1, 2, 3, 4, 5 })
  {
    for (const std::size_t count : { 30, 47, 256 })
    {
      expectErrorsOfRefits(randomCase(count, seed), 2);
      expectErrorsOfRefits(randomCase(count, seed), 3);
    }
    expectErrorsOfRefits(randomCase(14, seed, 0.01), 2); // fewer than the 16 that are looked at
  }
}

// What the errors mean: their sizes over many draws of noise.
TEST(PolynomialFit, ErrorsAreThoseOfManyDraws)
{
  constexpr int draws = 2000;
  constexpr double deviation = 0.02;
  clouds::Random random(5);
  const Case places = randomCase(40, 6);
  double squaredZero = 0.0;
  double squaredError = 0.0;
  double squaredTurn = 0.0;
  double squaredDirectionError = 0.0;
  for (int draw = 0; draw < draws; ++draw)
  {
    Case sampled;
    for (const FitSample& sample : places.list)
    {
      const double uniform = std::sqrt(12.0) * (random() - 0.5); // of deviation 1
      // Weights under which the 16 first samples decide.
      const double weight = sampled.list.size() < FrameSamples::nearest ? 1.0 : 1e-3;
      sampled.add(sample.position, sample.position[2] + deviation * uniform, weight);
    }
    const auto found = fitHolding(sampled, 2);
    ASSERT_TRUE(found);
    squaredZero += (*found->zero)[2] * (*found->zero)[2];
    squaredError += found->zeroError * found->zeroError;
    const Vector g = found->polynomial.gradientAt(*found->zero);
    squaredTurn += (g[0] * g[0] + g[1] * g[1]) / (g[2] * g[2]);
    squaredDirectionError += found->directionError * found->directionError;
  }
  // Residuals of samples left out contain the error of the prediction: estimates are cautious.
  EXPECT_GT(squaredError, squaredZero);
  EXPECT_LT(squaredError, 25.0 * squaredZero);
  EXPECT_GT(squaredDirectionError, squaredTurn);
  EXPECT_LT(squaredDirectionError, 50.0 * squaredTurn);
}

TEST(PolynomialFit, HoldsWhereItsZeroIsNear)
{
  const auto zeroOf = [](double offset, double curvature)
  {
    Case sampled;
    for (const FitSample& sample : randomCase(40, 7).list)
    {
      const Vector& p = sample.position;
      sampled.add(p, p[2] - offset + curvature * p[2] * p[2], 1.0);
    }
    const auto found = fitHolding(sampled, 2);
    return found ? found->zero : std::nullopt;
  };
  ASSERT_TRUE(zeroOf(0.99, 0.0));
  EXPECT_NEAR(zeroOf(0.99, 0.0).value()[2], 0.99, 1e-12);
  EXPECT_FALSE(zeroOf(1.01, 0.0)); // farther than half the edge
  ASSERT_TRUE(zeroOf(0.5, -0.4));
  EXPECT_NEAR(zeroOf(0.5, -0.4).value()[2], (1.0 - std::sqrt(0.2)) / 0.8, 1e-9);
  EXPECT_FALSE(zeroOf(0.7, -0.4)); // it has no zero
}

TEST(PolynomialFit, DoesNotHoldAgainstTheEdge)
{
  const auto holds = [](double degrees)
  {
    Case sampled;
    const double angle = degrees * 3.14159265358979 / 180.0;
    for (const FitSample& sample : randomCase(40, 8).list)
    {
      const Vector& p = sample.position;
      sampled.add(p, std::sin(angle) * p[0] + std::cos(angle) * p[2], 1.0);
    }
    return fitHolding(sampled, 2).has_value();
  };
  EXPECT_TRUE(holds(0.0));
  EXPECT_TRUE(holds(101.0)); // the arccosine of -0.2 is 101.5 degrees
  EXPECT_FALSE(holds(102.0));
  EXPECT_FALSE(holds(180.0));
}

TEST(PolynomialFit, TakesThirteenSamplesForAQuadraticAndTwentyFiveForACubic)
{
  const auto degreeOf = [](std::size_t count) -> std::optional<int>
  {
    const Case sampled = randomCase(count, 9, 0.0);
    const auto found = fitHolding(sampled, 3);
    return found ? std::optional<int>(found->polynomial.degree) : std::nullopt;
  };
  EXPECT_EQ(degreeOf(12), std::nullopt);
  EXPECT_EQ(degreeOf(13), 2);
  EXPECT_EQ(degreeOf(24), 2);
  EXPECT_EQ(degreeOf(25), 3);
  EXPECT_TRUE(isopoint::areEnough(5, 1));
  EXPECT_FALSE(isopoint::areEnough(4, 1));
}

// Where the cubic contradicts the edge or has no zero close by.
TEST(PolynomialFit, IsTheQuadraticWhereTheCubicDoesNotHold)
{
  int quadratics = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
  {
    const Case sampled = randomCase(30, seed, 8.0);
    const auto cubic = fitdefinition::leastSquares(sampled.list, sampled.weightList, 3);
    const auto quadratic = fitdefinition::leastSquares(sampled.list, sampled.weightList, 2);
    const auto found = fitHolding(sampled, 3);
    const auto zeroOfCubic = fitdefinition::zeroOf(*cubic, upwards);
    const auto zeroOfQuadratic = fitdefinition::zeroOf(*quadratic, upwards);
    ASSERT_EQ(found.has_value(), zeroOfCubic || zeroOfQuadratic) << seed;
    if (found)
    {
      const auto expected = zeroOfCubic ? zeroOfCubic : zeroOfQuadratic;
      EXPECT_EQ(found->polynomial.degree, zeroOfCubic ? 3 : 2);
      EXPECT_NEAR(isopoint::lengthOf(isopoint::difference(*found->zero, *expected)), 0.0, 1e-9);
      quadratics += zeroOfCubic ? 0 : 1;
    }
  }
  EXPECT_GT(quadratics, 3);
}

// Without the only sample off three planes, no cubic is determined; without the only one off two,
// no quadratic.
TEST(PolynomialFit, DoesNotHoldWhereASampleAloneDeterminesACoefficient)
{
  const auto degreeOf = [](double planes, bool areMoreOff) -> std::optional<int>
  {
    Case sampled;
    sampled.add({ 0.3, 0.2, 0.45 }, 0.45, 1.0);
    for (const FitSample& sample : randomCase(60, 11).list)
    {
      const Vector& p = sample.position;
      const double z = std::floor(0.25 * planes * (p[2] + 2.0)) - 0.5;
      sampled.add({ p[0], p[1], z }, z + 0.1 * p[0] * p[1], 1.0);
    }
    if (areMoreOff)
    {
      sampled.add({ -0.3, 0.1, 0.4 }, 0.4, 1.0);
    }
    const auto found = fitHolding(sampled, 3);
    return found ? std::optional<int>(found->polynomial.degree) : std::nullopt;
  };
  EXPECT_EQ(degreeOf(3.0, false), 2);
  EXPECT_EQ(degreeOf(3.0, true), 3);
  EXPECT_EQ(degreeOf(2.0, false), std::nullopt);
  EXPECT_EQ(degreeOf(2.0, true), 2);
}

TEST(FrameSamples, WeightsAreThoseOfTheDefinition)
{
  const Case sampled = randomCase(30, 10);
  FrameWeights steep;
  FrameWeights mild;
  isopoint::weigh<3>(sampled.samples, 1.5, 0.1, steep);
  isopoint::weigh<1>(sampled.samples, 1.5, 1.0, mild);
  for (std::size_t i = 0; i < 32; ++i)
  {
    const double d = i < 30 ? isopoint::lengthOf(sampled.list[i].position) / 1.5 : 0.0;
    const double expected = i < 30 ? std::pow(0.1 + d * d, -3) : 0.0;
    EXPECT_NEAR(FrameSamples::at(steep, i), expected, 1e-13 * expected);
    const double expectedMild = i < 30 ? 1.0 / (1.0 + d * d) : 0.0;
    EXPECT_NEAR(FrameSamples::at(mild, i), expectedMild, 1e-15);
  }
}
