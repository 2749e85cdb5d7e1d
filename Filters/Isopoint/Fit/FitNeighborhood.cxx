// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Fit/FitNeighborhood.h"

#include "Isopoint/Fit/PolynomialZero.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace isopoint
{
namespace
{

/// How far an isopoint may move, in lengths of its edge.
constexpr double mostMove = 0.5;

/// The largest residual that a fit with mild weights may leave, as the root of their mean square,
/// in units of how much it rises over the samples' mean distance.
constexpr double mostResidual = 0.6;

/// If the polynomial of degree two leaves more than this share of the values' variance, the samples
/// hold noise alone: a crease leaves less than a fifth, since it bends one way.
constexpr double noiseShare = 0.3;

/// The least coherence of residuals that noise alone does not explain. Measured false-positive
/// rate: 10 % on pure noise; false-negative rate beside creases: 2 %.
constexpr double leastCoherence = 0.05;

/// If an affine function leaves more than this share of the variance, as where sheets are close by,
/// its gradient is a worse normal than the plane through the isopoints around.
constexpr double mostUnexplained = 0.2;

/// The largest residual of a fit with a crease: creases can be distinguished from smooth fields
/// only where there is little noise.
constexpr double mostCreaseResidual = 0.03;

/// The same of one that a polynomial competes with, since its pieces may bend.
constexpr double mostBentCreaseResidual = 0.2;

/// Edges longer than this many spacings of the samples at their ends may cross gaps.
constexpr double gapSpacings = 2.0;

/// The corrected Akaike criterion of a least-squares fit.
double akaikeCriterion(std::size_t sampleCount, std::size_t coefficientCount, double meanSquare)
{
  const auto n = static_cast<double>(sampleCount);
  const double k = static_cast<double>(coefficientCount) + 1.0; // and the residuals' variance
  if (n <= k + 1.0)
  {
    return std::numeric_limits<double>::infinity();
  }
  // Residuals of rounding alone are as good as none.
  constexpr double rounding = 1e-28;
  return n * std::log(std::max(meanSquare, rounding)) + 2.0 * k +
         2.0 * k * (k + 1.0) / (n - k - 1.0);
}

Eigen::Vector3d toEigen(const Vector& v)
{
  return { v[0], v[1], v[2] };
}

/// The tangent planes of all pieces but one, each where Newton's method leads to from a position on
/// that one, by the distance of the creases along it.
std::vector<CreasePlane> creasesOf(
  const CreaseFit& fit, std::size_t piece, const Eigen::Vector3d& position)
{
  const Eigen::Vector3d normal = fit.pieces[piece].gradient(position).normalized();
  std::vector<std::pair<double, CreasePlane>> found;
  for (std::size_t other = 0; other < fit.pieces.size(); ++other)
  {
    const Polynomial& polynomial = fit.pieces[other];
    const std::optional<Eigen::Vector3d> zero =
      zeroNear(polynomial, std::numeric_limits<double>::max(), position);
    if (other == piece || !zero)
    {
      continue;
    }
    const Eigen::Vector3d inward = -fit.sense * polynomial.gradient(*zero).normalized();
    const double distance = std::max(0.0, inward.dot(position - *zero));
    const double alongPiece = distance / inward.cross(normal).norm();
    if (std::isfinite(alongPiece)) // or else the pieces are parallel
    {
      found.push_back({ alongPiece, { { inward[0], inward[1], inward[2] }, distance, fit.sense } });
    }
  }
  std::sort(
    found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<CreasePlane> creases;
  for (const auto& [alongPiece, crease] : found)
  {
    creases.push_back(crease);
  }
  return creases;
}

} // namespace

FitNeighborhood::FitNeighborhood(
  const FitEdge& edge, double isovalue, const std::vector<FitSample>& samples, double spacing)
  : Scale(spacing)
  , Increasing(toEigen(edge.increasing) / spacing)
  , EndSpacing(edge.spacing / spacing)
{
  for (const FitSample& sample : samples)
  {
    this->ValueScale = std::max(this->ValueScale, std::abs(sample.value - isovalue));
  }
  this->Samples.reserve(samples.size());
  for (const FitSample& sample : samples)
  {
    const Eigen::Vector3d offset =
      toEigen(difference(sample.position, edge.position)) / this->Scale;
    const double weight = mildWeight(offset.squaredNorm());
    this->Samples.push_back({ offset, (sample.value - isovalue) / this->ValueScale, weight });
  }
}

bool FitNeighborhood::mayCrossGap() const
{
  return this->Increasing.norm() > gapSpacings * this->EndSpacing;
}

bool FitNeighborhood::isUsable() const
{
  return std::isfinite(this->ValueScale) && this->ValueScale > 0.0 &&
         this->Increasing.allFinite() && std::isfinite(1.0 / this->Scale);
}

CandidateFit FitNeighborhood::smooth(int degree)
{
  if (!this->isUsable())
  {
    return {};
  }
  this->weigh(
    [](double squaredDistance)
    {
      const double root = 0.1 + squaredDistance;
      return 1.0 / (root * root * root);
    });
  const std::optional<Polynomial> polynomial = fitPolynomial(this->Samples, degree);
  this->weigh(mildWeight); // residuals of far samples indicate creases
  return polynomial ? this->tryPolynomial(*polynomial) : CandidateFit();
}

bool FitNeighborhood::indicatesNoise() const
{
  const std::optional<Polynomial> quadratic = fitPolynomial(this->Samples, 2);
  return quadratic && this->unexplainedShare(*quadratic) > noiseShare;
}

bool FitNeighborhood::leavesPattern() const
{
  std::optional<Polynomial> polynomial = fitPolynomial(this->Samples, 2);
  if (!polynomial)
  {
    polynomial = fitPolynomial(this->Samples, 1);
  }
  return polynomial && residualCoherence(this->Samples, *polynomial) > leastCoherence;
}

std::optional<int> FitNeighborhood::bestDegree() const
{
  double least = std::numeric_limits<double>::infinity();
  int best = 1;
  double quadraticMeanSquare = 0.0;
  for (int degree = 1; degree <= 3; ++degree)
  {
    const std::optional<Polynomial> polynomial = fitPolynomial(this->Samples, degree);
    if (!polynomial)
    {
      return std::nullopt;
    }
    const double meanSquare = this->meanSquareOf(*polynomial);
    quadraticMeanSquare = degree == 2 ? meanSquare : quadraticMeanSquare;
    const double criterion = this->criterionOf(degree, meanSquare);
    if (criterion < least)
    {
      least = criterion;
      best = degree;
    }
  }
  if (best == 1)
  {
    return std::nullopt;
  }
  const std::vector<CreaseFit> creases = fitCreases(this->Samples,
    { mostBentCreaseResidual, 6.0 * mostBentCreaseResidual, quadraticMeanSquare, false });
  const bool isCrease = std::any_of(creases.begin(), creases.end(),
    [&](const CreaseFit& crease) { return this->criterionOf(crease) < least; });
  return isCrease ? std::nullopt : std::optional<int>(best);
}

CandidateFit FitNeighborhood::best(FitOrder highest) const
{
  if (!this->isUsable())
  {
    return {};
  }
  CandidateFit chosen;
  const auto consider = [&chosen](const CandidateFit& candidate)
  {
    if (candidate.holds() && candidate.criterion < chosen.criterion &&
        candidate.residual <= mostResidual)
    {
      chosen = candidate;
    }
  };
  std::optional<Polynomial> rival;
  const int highestDegree = std::min(static_cast<int>(highest), Polynomial::highestDegree);
  for (int degree = 1; degree <= highestDegree; ++degree)
  {
    const std::optional<Polynomial> polynomial = fitPolynomial(this->Samples, degree);
    if (polynomial)
    {
      consider(this->tryPolynomial(*polynomial));
      rival = degree <= 2 ? polynomial : rival;
    }
  }
  if (highest == FitOrder::Crease && rival)
  {
    // Two pieces may be far worse than a quadratic where there are three.
    const double mostMeanSquareOfTwo = 4.0 * this->meanSquareOf(*rival);
    for (const CreaseFit& crease : fitCreases(this->Samples,
           { mostCreaseResidual, 15.0 * mostCreaseResidual, mostMeanSquareOfTwo, true }))
    {
      consider(this->tryCrease(crease));
    }
  }
  return chosen;
}

std::optional<Vector> FitNeighborhood::affineGradient() const
{
  const std::optional<Polynomial> affine = fitPolynomial(this->Samples, 1);
  if (!affine)
  {
    return std::nullopt;
  }
  const Eigen::Vector3d gradient = affine->gradient(Eigen::Vector3d::Zero());
  if (!(this->unexplainedShare(*affine) <= mostUnexplained) || !this->increasesAlong(gradient))
  {
    return std::nullopt;
  }
  const double slopeScale = this->ValueScale / this->Scale;
  return Vector{ slopeScale * gradient[0], slopeScale * gradient[1], slopeScale * gradient[2] };
}

bool FitNeighborhood::apply(const CandidateFit& candidate, LocalFit& fit) const
{
  Vector position = fit.position;
  for (int axis = 0; axis < 3; ++axis)
  {
    position[axis] += this->Scale * candidate.position[axis];
  }
  const bool isFinite =
    std::all_of(position.begin(), position.end(), [](double x) { return std::isfinite(x); });
  if (!candidate.holds() || !isFinite)
  {
    return false;
  }
  fit.position = position;
  const double slopeScale = this->ValueScale / this->Scale;
  for (int axis = 0; axis < 3; ++axis)
  {
    fit.gradient[axis] = slopeScale * candidate.gradient[axis];
  }
  for (std::size_t i = 0; i < fit.hessian.size(); ++i)
  {
    fit.hessian[i] = slopeScale / this->Scale * candidate.hessian[i];
  }
  fit.creases = candidate.creases;
  for (CreasePlane& crease : fit.creases)
  {
    crease.distance *= this->Scale;
  }
  fit.order = candidate.order;
  fit.isGradientFitted = true;
  return true;
}

template <class Weight>
void FitNeighborhood::weigh(const Weight& weightOf)
{
  for (FrameSample& sample : this->Samples)
  {
    sample.weight = weightOf(sample.position.squaredNorm());
  }
}

/// The share of the values' variance that a polynomial does not explain.
double FitNeighborhood::unexplainedShare(const Polynomial& polynomial) const
{
  double mean = 0.0;
  double weights = 0.0;
  for (const FrameSample& sample : this->Samples)
  {
    mean += sample.weight * sample.value;
    weights += sample.weight;
  }
  mean /= weights;
  const double variance =
    meanSquaredResidual(this->Samples, [mean](const Eigen::Vector3d&) { return mean; });
  return residualFreedom(this->Samples.size(), coefficientCount(polynomial.degree)) *
         this->meanSquareOf(polynomial) / variance;
}

double FitNeighborhood::meanSquareOf(const Polynomial& polynomial) const
{
  return meanSquaredResidual(
    this->Samples, [&polynomial](const Eigen::Vector3d& p) { return polynomial.value(p); });
}

double FitNeighborhood::criterionOf(int degree, double meanSquare) const
{
  return akaikeCriterion(this->Samples.size(), coefficientCount(degree), meanSquare);
}

double FitNeighborhood::criterionOf(const CreaseFit& crease) const
{
  return akaikeCriterion(this->Samples.size(), crease.coefficients(), crease.meanSquare);
}

/// Whether a gradient does not contradict the edge, which may run along a surface that bends.
bool FitNeighborhood::increasesAlong(const Eigen::Vector3d& gradient) const
{
  constexpr double leastCosine = -0.2;
  return gradient.dot(this->Increasing) > leastCosine * gradient.norm() * this->Increasing.norm();
}

double FitNeighborhood::farthestMove() const
{
  return mostMove * this->Increasing.norm();
}

CandidateFit FitNeighborhood::tryPolynomial(const Polynomial& polynomial) const
{
  CandidateFit candidate;
  candidate.isDetermined = true;
  const double meanSquare = this->meanSquareOf(polynomial);
  Eigen::Vector3d gradient = polynomial.gradient(Eigen::Vector3d::Zero());
  const double freedom = residualFreedom(this->Samples.size(), coefficientCount(polynomial.degree));
  candidate.residual = std::sqrt(freedom * meanSquare) / gradient.norm();
  if (!std::isfinite(candidate.residual) || !this->increasesAlong(gradient))
  {
    return candidate;
  }
  const std::optional<Eigen::Vector3d> position = zeroNear(polynomial, this->farthestMove());
  if (!position)
  {
    return candidate;
  }
  gradient = polynomial.gradient(*position);
  if (!this->increasesAlong(gradient))
  {
    return candidate;
  }
  candidate.order = static_cast<FitOrder>(polynomial.degree);
  candidate.criterion = this->criterionOf(polynomial.degree, meanSquare);
  candidate.position = *position;
  candidate.gradient = gradient;
  candidate.hessian = polynomial.hessian(*position);
  return candidate;
}

CandidateFit FitNeighborhood::tryCrease(const CreaseFit& fit) const
{
  CandidateFit candidate;
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  for (std::size_t piece = 0; piece < fit.pieces.size(); ++piece)
  {
    const Eigen::Vector3d gradient = fit.pieces[piece].gradient(origin);
    for (std::size_t other = 0; other < piece; ++other)
    {
      const Eigen::Vector3d otherGradient = fit.pieces[other].gradient(origin);
      if (gradient.dot(otherGradient) > mostCreaseCosine * gradient.norm() * otherGradient.norm())
      {
        return candidate;
      }
    }
  }
  this->moveToNearestSheet(fit, candidate);
  candidate.criterion = this->criterionOf(fit);
  candidate.residual = fit.relativeResidual();
  return candidate;
}

/// Moves to the nearest point of the zero surface of one piece that belongs to the surface, or else
/// to the crease between two.
void FitNeighborhood::moveToNearestSheet(const CreaseFit& fit, CandidateFit& candidate) const
{
  double nearest = std::numeric_limits<double>::infinity();
  const auto consider = [&](std::size_t piece, const std::optional<Eigen::Vector3d>& position)
  {
    constexpr double tolerance = 1e-9;
    if (position && position->norm() < nearest && fit.isOnSurface(piece, *position, tolerance))
    {
      nearest = position->norm();
      candidate.order = FitOrder::Crease;
      candidate.position = *position;
      candidate.gradient = fit.pieces[piece].gradient(*position);
      candidate.hessian = fit.pieces[piece].hessian(*position);
      candidate.creases = creasesOf(fit, piece, *position);
    }
  };
  for (std::size_t piece = 0; piece < fit.pieces.size(); ++piece)
  {
    consider(piece, zeroNear(fit.pieces[piece], this->farthestMove()));
  }
  for (std::size_t piece = 0; piece < fit.pieces.size() && !candidate.holds(); ++piece)
  {
    for (std::size_t other = 0; other < piece; ++other)
    {
      consider(piece, commonZeroNear(fit.pieces[piece], fit.pieces[other], this->farthestMove()));
    }
  }
}

} // namespace isopoint
