// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Clouds.h"

#include "Core/Fit/LocalFit.h"

#include <Eigen/Dense>

/// The definition of fits, which docs/algorithm.md outlines in 10.2 to 10.4, independent of the
/// core: least squares by Householder's QR of the whole design, residuals of samples left out and
/// effects of values by fitting again. Equal to the core's except for rounding, since sums are
/// taken in other orders.
namespace fitdefinition
{

using namespace isopoint;
using Eigen::Index;
using Samples = std::vector<FitSample>;
using Weights = std::vector<double>;
using Powers = std::array<int, 3>; // of x, y, z

/// The powers that coefficients belong to, in the core's order.
constexpr std::array<Powers, 20> allPowers{ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 },
  { 2, 0, 0 }, { 0, 2, 0 }, { 0, 0, 2 }, { 1, 1, 0 }, { 1, 0, 1 }, { 0, 1, 1 }, { 3, 0, 0 },
  { 0, 3, 0 }, { 0, 0, 3 }, { 2, 1, 0 }, { 2, 0, 1 }, { 1, 2, 0 }, { 0, 2, 1 }, { 1, 0, 2 },
  { 0, 1, 2 }, { 1, 1, 1 } } };

inline std::size_t countOf(int degree)
{
  return degree == 1 ? 4 : degree == 2 ? 10 : 20;
}

/// A derivative of x^a y^b z^c, of the orders given for each axis.
inline double derivative(const Powers& powers, const Vector& place, const Powers& orders)
{
  double result = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < orders[axis]; ++i)
    {
      result *= powers[axis] - i;
    }
    const int left = powers[axis] - orders[axis];
    result *= left > 0 ? std::pow(place[axis], left) : 1.0;
  }
  return result;
}

struct Polynomial
{
  Eigen::VectorXd coefficients;

  double at(const Vector& place, const Powers& orders = { 0, 0, 0 }) const
  {
    double total = 0.0;
    for (Index i = 0; i < this->coefficients.size(); ++i)
    {
      total +=
        this->coefficients[i] * derivative(allPowers[static_cast<std::size_t>(i)], place, orders);
    }
    return total;
  }

  Vector gradientAt(const Vector& place) const { return this->derivativesAt<1, 3>(place); }
  Hessian hessianAt(const Vector& place) const { return this->derivativesAt<4, 6>(place); }

private:
  /// The derivatives of the orders `allPowers` from a first one on.
  template <std::size_t first, std::size_t count>
  std::array<double, count> derivativesAt(const Vector& place) const
  {
    std::array<double, count> all;
    for (std::size_t i = 0; i < count; ++i)
    {
      all[i] = this->at(place, allPowers[first + i]);
    }
    return all;
  }
};

/// Rows of weighted products, one for each sample.
inline Eigen::MatrixXd designOf(const Samples& samples, const Weights& weights, int degree)
{
  Eigen::MatrixXd design(samples.size(), countOf(degree));
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    for (std::size_t k = 0; k < countOf(degree); ++k)
    {
      design(static_cast<Index>(i), static_cast<Index>(k)) =
        std::sqrt(weights[i]) * derivative(allPowers[k], samples[i].position, { 0, 0, 0 });
    }
  }
  return design;
}

inline Polynomial solved(const Samples& samples, const Weights& weights, int degree)
{
  Eigen::VectorXd values(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    values[static_cast<Index>(i)] = std::sqrt(weights[i]) * samples[i].value;
  }
  return { designOf(samples, weights, degree).householderQr().solve(values) };
}

/// Weighted least squares (10.3); nothing if a pivot of the normal equations is at most 1e-7 of its
/// diagonal element: pivots are the squares of the diagonal of R.
inline std::optional<Polynomial> leastSquares(
  const Samples& samples, const Weights& weights, int degree)
{
  if (4 * samples.size() < 5 * countOf(degree))
  {
    return std::nullopt;
  }
  const Eigen::MatrixXd design = designOf(samples, weights, degree);
  const Eigen::HouseholderQR<Eigen::MatrixXd> decomposition(design);
  for (Index i = 0; i < design.cols(); ++i)
  {
    const double root = decomposition.matrixQR()(i, i);
    if (!(root * root > 1e-7 * design.col(i).squaredNorm()))
    {
      return std::nullopt;
    }
  }
  return solved(samples, weights, degree);
}

/// The samples of both rings in the frame of an edge (10.2): those of the first ring by distance,
/// so that the nearest come first, those that the second one adds in their order; but if the first
/// ring has fewer than 16, the nearest of the second one come next.
struct Frame
{
  double length; // units
  double value;
  double valueError;
  Vector increasing; // r
  Samples samples;
  double h = 0.0;

  /// @param more the samples that the second ring adds to the first
  Frame(const FitEdge& edge, double isovalue, const Samples& first, const Samples& more = {})
    : length(unitOf(lengthOf(edge.increasing)))
    , value(unitOf(edge.increase))
    , valueError(edge.valueError / this->value)
    , increasing(1.0 / this->length * edge.increasing)
  {
    this->addNearest(first, edge.position, isovalue, true);
    this->addNearest(more, edge.position, isovalue, this->samples.size() < 16);
    for (const FitSample& sample : this->samples)
    {
      this->h += lengthOf(sample.position) / static_cast<double>(this->samples.size());
    }
  }

  Weights steep() const { return this->weights(0.1, -3); }
  Weights mild() const { return this->weights(1.0, -1); }

private:
  static double unitOf(double number) { return std::exp2(std::floor(std::log2(number))); }

  /// Adds the nearest samples up to 256 in all: as they are if all are added, or by distance.
  void addNearest(const Samples& ring, const Vector& origin, double isovalue, bool areSorted)
  {
    Samples all;
    for (const FitSample& sample : ring)
    {
      all.push_back({ 1.0 / this->length * (sample.position - origin),
        (sample.value - isovalue) / this->value });
    }
    const std::size_t count = std::min(all.size(), 256 - this->samples.size());
    if (areSorted || all.size() > count)
    {
      std::stable_sort(all.begin(), all.end(),
        [](const FitSample& a, const FitSample& b)
        { return lengthOf(a.position) < lengthOf(b.position); });
    }
    this->samples.insert(
      this->samples.end(), all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
  }

  Weights weights(double offset, int power) const
  {
    Weights all;
    for (const FitSample& sample : this->samples)
    {
      const double d = lengthOf(sample.position);
      all.push_back(std::pow(offset + d * d / (this->h * this->h), power));
    }
    return all;
  }
};

inline bool contradicts(const Vector& gradient, const Vector& r)
{
  return dot(gradient, r) <= -0.2 * lengthOf(gradient) * lengthOf(r);
}

/// The zero of a polynomial that holds (10.3).
inline std::optional<Vector> zeroOf(const Polynomial& polynomial, const Vector& r)
{
  Vector place{};
  for (int i = 0; i < 8 && !contradicts(polynomial.gradientAt({}), r); ++i)
  {
    const Vector gradient = polynomial.gradientAt(place);
    const double slope = lengthOf(gradient);
    const double factor = -polynomial.at(place) / (slope * slope);
    place += factor * gradient;
    if (!(lengthOf(place) <= 0.5 * lengthOf(r)))
    {
      return std::nullopt;
    }
    if (std::abs(factor) * slope <= 1e-6)
    {
      return contradicts(polynomial.gradientAt(place), r) ? std::nullopt
                                                          : std::optional<Vector>(place);
    }
  }
  return std::nullopt;
}

/// A polynomial with its errors (10.3), which are over its slope at p.
struct Candidate
{
  Polynomial polynomial;
  int degree;
  std::optional<Vector> zero; // if it holds
  double sigma;
  double s;
  double a;
};

/// Errors by fitting again: without each of the first 16 samples, and to a value of 1 there alone.
/// Nothing if the samples do not determine it, or one of these alone determines a coefficient.
inline std::optional<Candidate> candidateOf(const Frame& frame, const Weights& weights, int degree)
{
  const Samples& samples = frame.samples;
  const auto polynomial = leastSquares(samples, weights, degree);
  if (!polynomial)
  {
    return std::nullopt;
  }
  double squares = 0.0;
  double weightSquares = 0.0;
  double value = 0.0;
  double slope = 0.0;
  const Eigen::MatrixXd whole = designOf(samples, weights, degree);
  const Eigen::HouseholderQR<Eigen::MatrixXd> decomposition(whole);
  const Eigen::MatrixXd orthogonal =
    decomposition.householderQ() * Eigen::MatrixXd::Identity(whole.rows(), whole.cols());
  for (std::size_t i = 0; i < std::min<std::size_t>(16, samples.size()); ++i)
  {
    if (1.0 - orthogonal.row(static_cast<Index>(i)).squaredNorm() <= 1e-7)
    {
      return std::nullopt;
    }
    Weights others = weights;
    others[i] = 0.0;
    const double residual =
      samples[i].value - solved(samples, others, degree).at(samples[i].position);
    squares += weights[i] * residual * weights[i] * residual;
    weightSquares += weights[i] * weights[i];
    const Eigen::VectorXd effect = decomposition.solve(
      std::sqrt(weights[i]) * Eigen::VectorXd::Unit(whole.rows(), static_cast<Index>(i)));
    value += effect[0] * effect[0];
    slope += effect.segment(1, 3).squaredNorm();
  }
  const double sigma = std::max(std::sqrt(squares / weightSquares), frame.valueError) /
                       lengthOf(polynomial->gradientAt({}));
  return Candidate{ *polynomial, degree, zeroOf(*polynomial, frame.increasing), sigma,
    sigma * std::sqrt(value), sigma * std::sqrt(slope) };
}

/// Robust weights (10.4, step 2).
inline Weights robustWeights(const Frame& frame)
{
  const Weights steep = frame.steep();
  Weights weights = steep;
  for (int round = 0; round < 2; ++round)
  {
    const auto affine = leastSquares(frame.samples, weights, 1);
    std::vector<double> residuals;
    for (const FitSample& sample : affine ? frame.samples : Samples())
    {
      residuals.push_back(std::abs(sample.value - affine->at(sample.position)));
    }
    std::vector<double> sorted = residuals;
    std::sort(sorted.begin(), sorted.end());
    const double c = sorted.empty() ? 0.0 : sorted[sorted.size() / 2];
    if (c == 0.0)
    {
      return weights;
    }
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
      const double e = residuals[i] / c;
      weights[i] = steep[i] / ((1.0 + e * e) * (1.0 + e * e));
    }
  }
  return weights;
}

/// The polynomial with mild weights of 10.4, step 4, unless it contradicts the edge.
inline std::optional<Polynomial> mildPolynomial(const Frame& frame, int degree)
{
  const auto polynomial = leastSquares(frame.samples, frame.mild(), degree);
  return polynomial && !contradicts(polynomial->gradientAt({}), frame.increasing) ? polynomial
                                                                                  : std::nullopt;
}

/// In the units of positions and values.
struct Result
{
  Vector position;
  Vector gradient;
  bool isGradientFitted = false;
  Hessian hessian{};
  bool isSmooth = false;
  std::optional<FitOrder> order;

  void setDerivatives(const Frame& frame, const Polynomial& polynomial, const Vector& place)
  {
    this->gradient = frame.value / frame.length * polynomial.gradientAt(place);
    this->isGradientFitted = true;
    this->hessian = polynomial.hessianAt(place);
    for (double& derivative : this->hessian)
    {
      derivative *= frame.value / frame.length / frame.length;
    }
  }

  /// Step 4, after step 3.
  /// @param a the error of the gradient's direction
  void simplify(const Frame& frame, double a)
  {
    for (const int degree : { 1, 2 })
    {
      const auto mild = mildPolynomial(frame, degree);
      if (mild && lengthOf(directionOf(mild->gradientAt({})) - directionOf(this->gradient)) <
                    2.0 * a) // the chord
      {
        this->setDerivatives(frame, *mild, {});
        this->isSmooth = degree > 1;
        return;
      }
    }
  }

  /// Moves by a share of the way to a zero, whose error is s.
  void move(const Frame& frame, const Vector& zero, double s)
  {
    const double m = lengthOf(zero);
    const double share = m > 0.0 ? m * m / (m * m + 0.1 * s * s) : 1.0;
    this->position += frame.length * share * zero;
  }
};

/// The result of a point that stays.
inline Result stay(const Frame& frame, const FitEdge& edge)
{
  Result result;
  result.position = edge.position;
  const double length = lengthOf(edge.increasing);
  result.gradient = edge.increase / length / length * edge.increasing;
  if (const auto affine = mildPolynomial(frame, 1))
  {
    result.setDerivatives(frame, *affine, {});
  }
  return result;
}

/// The result of a polynomial that holds.
inline Result take(const Frame& frame, const FitEdge& edge, const Candidate& candidate)
{
  Result result;
  result.position = edge.position;
  result.move(frame, *candidate.zero, candidate.s);
  result.setDerivatives(frame, candidate.polynomial, *candidate.zero);
  result.isSmooth = true;
  result.order = static_cast<FitOrder>(candidate.degree);
  return result;
}

/// Step 1: the result, if it is a clear case.
inline std::optional<Result> clearCase(const Frame& frame, const FitEdge& edge)
{
  const auto quadratic = candidateOf(frame, frame.steep(), 2);
  if (quadratic && quadratic->sigma > 0.0002 * frame.h)
  {
    return quadratic->a > 1.0 ? std::optional(stay(frame, edge)) : std::nullopt;
  }
  return quadratic && quadratic->zero ? std::optional(take(frame, edge, *quadratic)) : std::nullopt;
}

/// The rule (10.4) for the orders 1 to 3.
/// @param more the samples that the second ring adds to the first
inline Result fit(
  const FitEdge& edge, double isovalue, const Samples& first, const Samples& more, FitOrder highest)
{
  const Frame frame(edge, isovalue, first, more);
  if (highest == FitOrder::Linear)
  {
    Result result = stay(frame, edge);
    const auto affine = leastSquares(frame.samples, frame.mild(), 1);
    if (const auto zero = affine ? zeroOf(*affine, frame.increasing) : std::nullopt)
    {
      result.move(frame, *zero, 0.0);
      result.order = FitOrder::Linear;
    }
    return result;
  }
  if (const auto clear = clearCase(Frame(edge, isovalue, first), edge))
  {
    return *clear;
  }
  for (const Weights& weights : { robustWeights(frame), frame.steep() })
  {
    for (int degree = highest == FitOrder::Quadratic ? 2 : 3; degree > 1; --degree)
    {
      const auto candidate = candidateOf(frame, weights, degree);
      if (candidate && candidate->zero)
      {
        Result result = take(frame, edge, *candidate);
        result.simplify(frame, candidate->a);
        return result;
      }
    }
  }
  return stay(frame, edge);
}

} // namespace fitdefinition
