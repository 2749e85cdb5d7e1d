// SPDX-License-Identifier: GPL-3.0-or-later
// Fits near the edges and corners of bodies whose sides are known.
#include "FitTesting.h"

#include "Core/Fit/CreaseFit.h"

using namespace fittesting;

namespace
{

constexpr double degree = 3.14159265358979 / 180.0;

/// The gradient of a field, by forward differences.
Vector gradientOf(const Field& field, const Vector& p)
{
  constexpr double step = 1e-5;
  const double value = field(p);
  return 1.0 / step *
         Vector{ field({ p[0] + step, p[1], p[2] }) - value,
           field({ p[0], p[1] + step, p[2] }) - value, field({ p[0], p[1], p[2] + step }) - value };
}

/// A body bounded by several sides: the intersection of the half-spaces where these are negative,
/// or their union. There is one sample per unit of volume, in a cube of side 46.4.
struct Body
{
  std::vector<Field> sides;
  bool isIntersection;

  double value(const Vector& p) const
  {
    double result = this->sides.front()(p);
    for (const Field& side : this->sides)
    {
      result = this->isIntersection ? std::max(result, side(p)) : std::min(result, side(p));
    }
    return result;
  }

  /// The least angle between a gradient and those of the sides that the place is on, in degrees.
  double angleToSides(const Vector& p, const Vector& gradient) const
  {
    double least = 180.0 * degree;
    for (const Field& side : this->sides)
    {
      if (std::abs(side(p) - this->value(p)) < 0.3)
      {
        const Vector own = gradientOf(side, p);
        least = std::min(least, std::atan2(lengthOf(cross(own, gradient)), dot(own, gradient)));
      }
    }
    return least / degree;
  }
};

/// @param misplaced so many isopoints of a thousand may have an error of more than 0.1
/// @param turned so many may have a normal that is off by more than 5 degrees
void expectFewErrors(const Body& body, double misplaced, double turned)
{
  const Field field = [&](const Vector& p) { return body.value(p); };
  const Isosurface surface =
    extractFitted(cloudOf(field, 100000, 46.4), 0.0, true, 2, FitOrder::Crease);
  EXPECT_GT(surface.fits.size(), 500u);
  const auto perThousand = [&](const auto& condition)
  {
    return 1000.0 * static_cast<double>(clouds::countOf(surface.fits, condition)) /
           static_cast<double>(surface.fits.size());
  };
  EXPECT_LT(perThousand([&](const LocalFit& fit) { return std::abs(field(fit.position)) > 0.1; }),
    misplaced);
  EXPECT_LT(perThousand([&](const LocalFit& fit)
              { return body.angleToSides(fit.position, fit.gradient) > 5.0; }),
    turned);
}

Field ball(const Vector& center, double radius)
{
  return [=](const Vector& p) { return lengthOf(p - center) - radius; };
}

/// Axes that are rotated against the samples' cube.
const Vector faces[3] = { { 0.8, -0.6, 0.0 }, { 0.48, 0.64, -0.6 }, { 0.36, 0.48, 0.8 } };

Body box(double x, double y, double z)
{
  Body body{ {}, true };
  const double halves[] = { x, y, z };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const double sense : { 1.0, -1.0 })
    {
      body.sides.push_back([sense, axis, half = halves[axis]](const Vector& p)
        { return sense * dot(p, faces[axis]) - half; });
    }
  }
  return body;
}

/// Expects a crease at no more than 1 in `share` points, of at least `least`.
void expectFewCreases(
  const clouds::Cloud& cloud, double isovalue, std::size_t share, std::size_t least)
{
  const std::vector<LocalFit> fits = extractFitted(cloud, isovalue, true, 2, FitOrder::Crease).fits;
  ASSERT_GT(fits.size(), least);
  const auto isAtCrease = [](const LocalFit& fit) { return fit.order == FitOrder::Crease; };
  EXPECT_LT(clouds::countOf(fits, isAtCrease), fits.size() / share);
}

/// The largest of the distances from the first planes through places close to the origin.
double cornerValue(std::size_t planes, const Vector& p)
{
  double value = dot(faces[0], p) - 0.1;
  for (std::size_t i = 1; i < planes; ++i)
  {
    value = std::max(value, dot(faces[i], p) - 0.1 * static_cast<double>(i));
  }
  return value;
}

} // namespace

TEST(CreaseFit, FindsThePlanesOfEdgesAndCorners)
{
  for (const std::size_t planes : { 2, 3 })
  {
    for (const double sense : { 1.0, -1.0 })
    {
      int found = 0;
      for (std::uint64_t seed = 1; seed <= 10; ++seed)
      {
        const auto field = [&](const Vector& p) { return sense * cornerValue(planes, p); };
        const FrameCase fitted(samplesOf(field, 120, 0.0, seed));
        const auto crease = fitCrease(fitted.samples, fitted.weights);
        ASSERT_TRUE(crease);
        if (crease->residual > 1e-9) // another local optimum
        {
          continue;
        }
        ++found;
        EXPECT_EQ(crease->sense, sense);
        EXPECT_TRUE(crease->isSharp());
        EXPECT_NEAR(crease->minSlope(), 1.0, 1e-9);
        for (const auto& [place, value] : samplesOf(field, 50))
        {
          EXPECT_NEAR(crease->pieces[crease->pieceAt(place)].valueAt(place), value, 1e-8);
        }
        ASSERT_EQ(crease->pieces.size(), planes);
        for (std::size_t i = 0; i < planes; ++i)
        {
          EXPECT_TRUE(std::any_of(crease->pieces.begin(), crease->pieces.end(),
            [&](const Polynomial& piece)
            { return lengthOf(piece.gradientAt({}) - sense * faces[i]) < 1e-8; }));
        }
      }
      EXPECT_GE(found, planes == 2 ? 10 : 8);
    }
  }
}

// The residual: the root of the mean square, as by generalized cross-validation.
TEST(CreaseFit, ResidualsAreCorrectedForTheCoefficients)
{
  clouds::Random random(4);
  const auto field = [&](const Vector& p) { return cornerValue(2, p) + 0.1 * (random() - 0.5); };
  const FrameCase fitted(samplesOf(field, 120, 0.0, 1));
  const auto crease = fitCrease(fitted.samples, fitted.weights);
  ASSERT_TRUE(crease);
  double squares = 0.0;
  const double coefficients = clouds::sumOf(
    crease->pieces, [](const Polynomial& piece) { return piece.degree == 1 ? 4.0 : 10.0; });
  for (std::size_t i = 0; i < 120; ++i)
  {
    const Vector p{ fitted.samples.x[i], fitted.samples.y[i], fitted.samples.z[i] };
    const double value = clouds::largestOf(
      crease->pieces, [&](const Polynomial& piece) { return crease->sense * piece.valueAt(p); });
    const double residual = fitted.samples.value[i] - crease->sense * value;
    squares += residual * residual;
  }
  EXPECT_NEAR(crease->residual, 120.0 / (120.0 - coefficients) * std::sqrt(squares / 120.0), 1e-9);
}

TEST(CreaseFit, SidesMeetAtTwentyFiveDegreesOrMore)
{
  for (const double degrees : { 24.9, 25.1, 150.0 })
  {
    CreaseFit fit;
    fit.pieces.resize(2);
    fit.pieces[0].coefficients[3] = 2.0;
    fit.pieces[1].coefficients[1] = std::sin(degrees * degree);
    fit.pieces[1].coefficients[3] = std::cos(degrees * degree);
    EXPECT_EQ(fit.isSharp(), degrees > 25.0);
  }
}

TEST(CreaseFit, CreasesAtOneDistanceAreInTheOrderOfThePieces)
{
  CreaseFit fit;
  fit.pieces.resize(4);
  fit.pieces[0].coefficients[1] = 1.0;
  for (const auto& [piece, axis, side] :
    { std::tuple(1u, 3u, 1.0), { 2u, 2u, -1.0 }, { 3u, 2u, 1.0 } })
  {
    fit.pieces[piece].coefficients[0] = -0.25;
    fit.pieces[piece].coefficients[axis] = side;
  }
  const auto found = zeroNear(fit, 2.0);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->creases.size(), 3u);
  EXPECT_EQ(found->creases[0].inward, (Vector{ 0.0, 0.0, -1.0 }));
  EXPECT_EQ(found->creases[1].inward, (Vector{ 0.0, 1.0, 0.0 }));
  EXPECT_EQ(found->creases[2].inward, (Vector{ 0.0, -1.0, 0.0 }));
}

// The nearest zero of a single piece may lie beyond the crease: then that of another piece counts,
// or the crease itself.
TEST(CreaseFit, ZerosBelongToTheWholeSurface)
{
  CreaseFit fit; // a ridge along y: of z and x + z / 2, moved
  fit.pieces.resize(2);
  const auto setPiece = [&](std::size_t piece, double offset, double x, double z)
  {
    fit.pieces[piece].coefficients[0] = offset;
    fit.pieces[piece].coefficients[1] = x;
    fit.pieces[piece].coefficients[3] = z;
  };
  clouds::Random random(5);
  int onOne = 0;
  int onBoth = 0;
  for (int i = 0; i < 300; ++i)
  {
    fit.sense = i % 2 == 0 ? 1.0 : -1.0;
    setPiece(0, random() - 0.5, 2.0 * random() - 1.0, 1.0);
    setPiece(1, random() - 0.5, 1.0, 2.0 * random() - 1.0);
    const auto found = zeroNear(fit, 2.0);
    if (!found)
    {
      continue;
    }
    const double one = fit.pieces[0].valueAt(found->zero);
    const double other = fit.pieces[1].valueAt(found->zero);
    EXPECT_NEAR(std::max(fit.sense * one, fit.sense * other), 0.0, 2e-6);
    const bool isOnBoth = std::abs(one) < 1e-5 && std::abs(other) < 1e-5;
    onOne += isOnBoth ? 0 : 1;
    onBoth += isOnBoth ? 1 : 0;
    // The gradient is that of a piece that is zero there.
    const Polynomial& own =
      fit.pieces[std::abs(one) <= 1e-6 && found->gradient == fit.pieces[0].gradientAt(found->zero)
                   ? 0
                   : 1];
    EXPECT_EQ(found->gradient, own.gradientAt(found->zero));
    EXPECT_NEAR(own.valueAt(found->zero), 0.0, 1e-5);
    // The plane of the other piece, that the surface turns to.
    ASSERT_EQ(found->creases.size(), 1u);
    const Polynomial& beyond = &own == &fit.pieces[0] ? fit.pieces[1] : fit.pieces[0];
    const Vector normal = directionOf(beyond.gradientAt({}));
    EXPECT_EQ(found->creases[0].turn, fit.sense);
    EXPECT_LT(lengthOf(found->creases[0].inward - -fit.sense * normal), 1e-12);
    const double distance =
      -fit.sense * beyond.valueAt(found->zero) / lengthOf(beyond.gradientAt({}));
    EXPECT_NEAR(found->creases[0].distance, std::max(0.0, distance), 1e-5);
  }
  EXPECT_GT(onOne, 100);
  EXPECT_GT(onBoth, 10);
}

TEST(Creases, TheNearestSideIsFound)
{
  const Field field = [](const Vector& p) { return std::max(p[2], p[0]) - 0.1; };
  const LocalFit found = fitAll(samplesOf(field, 80), upwards(), FitOrder::Crease);
  ASSERT_EQ(found.order, FitOrder::Crease);
  EXPECT_TRUE(found.isSmooth);
  EXPECT_TRUE(found.isGradientFitted);
  EXPECT_NEAR(field(found.position), 0.0, 1e-9);
  EXPECT_NEAR(std::max(std::abs(found.gradient[0]), std::abs(found.gradient[2])), 1.0, 1e-9);
}

// Among many samples, those of another piece are too few to determine it. Next to the edge they
// suffice.
TEST(Creases, SamplesNextToTheEdgeAreTriedByThemselves)
{
  const auto blurred = [](const Vector& p)
  { return lengthOf(p) < 1.6 ? std::max(p[2], p[0]) - 0.1 : p[2] + std::sin(9.0 * p[1]); };
  std::vector<FitSample> samples = samplesOf(blurred, 200);
  const auto isNear = [](const FitSample& sample) { return lengthOf(sample.position) < 1.6; };
  const auto middle = std::stable_partition(samples.begin(), samples.end(), isNear);
  const auto nearCount = static_cast<std::size_t>(middle - samples.begin());
  ASSERT_GT(nearCount, 30u);
  EXPECT_NE(fitAll(samples, upwards(), FitOrder::Crease).order, FitOrder::Crease);
  const LocalFit found = fitAll(samples, upwards(), FitOrder::Crease, 0.0, nearCount);
  ASSERT_EQ(found.order, FitOrder::Crease);
  EXPECT_NEAR(blurred(found.position), 0.0, 1e-9);
}

TEST(Creases, AreNotLookedForWhereTheFieldIsSmooth)
{
  const Field field = [](const Vector& p) { return p[2] + 0.02 * p[0] * p[0] * p[1] - 0.1; };
  const LocalFit found = fitAll(samplesOf(field, 80), upwards(), FitOrder::Crease);
  const LocalFit cubic = fitAll(samplesOf(field, 80), upwards(), FitOrder::Cubic);
  EXPECT_EQ(found.order, FitOrder::Cubic);
  EXPECT_EQ(found.position, cubic.position);
}

// Neighborhoods extend through the plate: near its rim they hold samples of three sides or more.
TEST(Creases, PointsLieOnTheSidesOfBodies)
{
  expectFewErrors(box(12.0, 12.0, 12.0), 1.0, 5.0);
  expectFewErrors(box(12.0, 12.0, 1.5), 5.0, 50.0);
  const std::vector<Field> balls{ ball({ 7.0, 1.0, 0.5 }, 11.5), ball({ -7.0, -1.0, 0.2 }, 10.5) };
  const Field outside = [&](const Vector& p) { return -balls[1](p); };
  for (const Body& body :
    { Body{ balls, true }, Body{ balls, false }, Body{ { balls[0], outside }, true } })
  {
    expectFewErrors(body, 4.0, 15.0);
  }
}

// A single quadratic through samples of both sides would round a curved edge off.
TEST(Creases, CurvedSidesKeepTheirCurvature)
{
  const Field field = [](const Vector& p)
  {
    return std::max(p[2] + 0.1 * p[0] * p[0] + 0.05 * p[1] * p[1], p[0] - 0.5 - 0.08 * p[2] * p[2]);
  };
  const LocalFit found = fitAll(samplesOf(field, 120), upwards(), FitOrder::Crease);
  ASSERT_EQ(found.order, FitOrder::Crease);
  EXPECT_NEAR(field(found.position), 0.0, 1e-9);
  EXPECT_NEAR(found.hessian[0], 0.2, 1e-8);
  EXPECT_NEAR(found.hessian[1], 0.1, 1e-8);
  EXPECT_NEAR(found.hessian[2], 0.0, 1e-8);
}

TEST(Creases, AreRarelyFoundInNoiseOrUnderResolvedFields)
{
  clouds::Random random(5);
  const Field noise = [&](const Vector& p) { return lengthOf(p) - 12.0 + 0.2 * (random() - 0.5); };
  expectFewCreases(cloudOf(noise, 50000, 36.8), 0.0, 100, 2000);
  expectFewCreases(cloudOf(gyroid(0.6), 20000, 27.0), 0.3, 500, 5000);
}
