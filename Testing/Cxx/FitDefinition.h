// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FitDefinition_h
#define FitDefinition_h

#include "Core/Fit/LocalFit.h"

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

/// Fits as docs/algorithm.md defines them in 10.2 to 10.4, written down plainly and independently
/// of the core: least squares by Householder's QR of the whole design, residuals of samples left
/// out and effects of values by fitting again. Equal to the core's except for rounding, since sums
/// are taken in other orders.
namespace fitdefinition
{

using Eigen::Index;
using isopoint::FitEdge;
using isopoint::FitOrder;
using isopoint::FitSample;
using isopoint::Hessian;
using isopoint::Vector;

using Weights = std::vector<double>;

/// The powers of x, y, z that coefficients belong to, in the order of 10.3.
inline const std::array<std::array<int, 3>, 20>& powers()
{
  static const std::array<std::array<int, 3>, 20> all{ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 },
    { 0, 0, 1 }, { 2, 0, 0 }, { 0, 2, 0 }, { 0, 0, 2 }, { 1, 1, 0 }, { 1, 0, 1 }, { 0, 1, 1 },
    { 3, 0, 0 }, { 0, 3, 0 }, { 0, 0, 3 }, { 2, 1, 0 }, { 2, 0, 1 }, { 1, 2, 0 }, { 0, 2, 1 },
    { 1, 0, 2 }, { 0, 1, 2 }, { 1, 1, 1 } } };
  return all;
}

inline std::size_t countOf(int degree)
{
  return degree == 1 ? 4 : degree == 2 ? 10 : 20;
}

/// A derivative of x^a y^b z^c: of the orders given for each axis.
inline double derivative(
  const std::array<int, 3>& power, const Vector& place, const std::array<int, 3>& orders)
{
  double result = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    int left = power[axis];
    for (int i = 0; i < orders[axis]; ++i)
    {
      result *= left;
      --left;
    }
    result *= left > 0 ? std::pow(place[axis], left) : 1.0;
  }
  return result;
}

struct Polynomial
{
  Eigen::VectorXd coefficients;

  double derivativeAt(const Vector& place, const std::array<int, 3>& orders) const
  {
    double total = 0.0;
    for (Index i = 0; i < this->coefficients.size(); ++i)
    {
      total +=
        this->coefficients[i] * derivative(powers()[static_cast<std::size_t>(i)], place, orders);
    }
    return total;
  }

  double valueAt(const Vector& place) const { return this->derivativeAt(place, { 0, 0, 0 }); }

  Vector gradientAt(const Vector& place) const
  {
    return { this->derivativeAt(place, { 1, 0, 0 }), this->derivativeAt(place, { 0, 1, 0 }),
      this->derivativeAt(place, { 0, 0, 1 }) };
  }

  Hessian hessianAt(const Vector& place) const
  {
    return { this->derivativeAt(place, { 2, 0, 0 }), this->derivativeAt(place, { 0, 2, 0 }),
      this->derivativeAt(place, { 0, 0, 2 }), this->derivativeAt(place, { 1, 1, 0 }),
      this->derivativeAt(place, { 1, 0, 1 }), this->derivativeAt(place, { 0, 1, 1 }) };
  }
};

/// Rows of weighted products, one for each sample.
inline Eigen::MatrixXd designOf(
  const std::vector<FitSample>& samples, const Weights& weights, int degree)
{
  Eigen::MatrixXd design(static_cast<Index>(samples.size()), static_cast<Index>(countOf(degree)));
  for (Index row = 0; row < design.rows(); ++row)
  {
    const auto i = static_cast<std::size_t>(row);
    for (Index column = 0; column < design.cols(); ++column)
    {
      design(row, column) =
        std::sqrt(weights[i]) *
        derivative(powers()[static_cast<std::size_t>(column)], samples[i].position, { 0, 0, 0 });
    }
  }
  return design;
}

/// Weighted least squares (10.3); nothing if a pivot of the normal equations is at most 1e-7 of its
/// diagonal element: pivots are the squares of the diagonal of R.
inline std::optional<Polynomial> leastSquares(
  const std::vector<FitSample>& samples, const Weights& weights, int degree)
{
  if (samples.size() < countOf(degree))
  {
    return std::nullopt;
  }
  const Eigen::MatrixXd design = designOf(samples, weights, degree);
  Eigen::VectorXd values(design.rows());
  for (Index i = 0; i < values.size(); ++i)
  {
    const auto sample = static_cast<std::size_t>(i);
    values[i] = std::sqrt(weights[sample]) * samples[sample].value;
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> decomposition(design);
  for (Index i = 0; i < design.cols(); ++i)
  {
    const double root = decomposition.matrixQR()(i, i);
    if (!(root * root > 1e-7 * design.col(i).squaredNorm()))
    {
      return std::nullopt;
    }
  }
  return Polynomial{ decomposition.solve(values) };
}

/// At least 5 K / 4 samples are required.
inline bool areEnough(std::size_t samples, int degree)
{
  return 4 * samples >= 5 * countOf(degree);
}

/// sigma, and the roots of the sums of l^2 and of |l'|^2 (10.3), over the first samples.
struct Errors
{
  double sigma;
  double value;
  double slope;
};

/// By fitting again: without each of the first samples, and to a value of 1 there alone. Nothing if
/// one of them alone determines a coefficient.
/// @param counted how many samples, the first ones, are looked at
inline std::optional<Errors> errorsOf(const std::vector<FitSample>& samples, const Weights& weights,
  int degree, std::size_t counted = 16)
{
  double squares = 0.0;
  double weightSquares = 0.0;
  double value = 0.0;
  double slope = 0.0;
  const Eigen::MatrixXd whole = designOf(samples, weights, degree);
  const Eigen::MatrixXd orthogonal =
    whole.householderQr().householderQ() * Eigen::MatrixXd::Identity(whole.rows(), whole.cols());
  for (std::size_t i = 0; i < std::min(counted, samples.size()); ++i)
  {
    if (1.0 - orthogonal.row(static_cast<Index>(i)).squaredNorm() <= 1e-7)
    {
      return std::nullopt;
    }
    Weights others = weights;
    others[i] = 0.0;
    const Eigen::MatrixXd design = designOf(samples, others, degree);
    Eigen::VectorXd values(design.rows());
    for (Index row = 0; row < values.size(); ++row)
    {
      const auto sample = static_cast<std::size_t>(row);
      values[row] = std::sqrt(others[sample]) * samples[sample].value;
    }
    const Polynomial without{ design.householderQr().solve(values) };
    const double residual = samples[i].value - without.valueAt(samples[i].position);
    squares += weights[i] * residual * weights[i] * residual;
    weightSquares += weights[i] * weights[i];
    std::vector<FitSample> unit = samples;
    for (FitSample& sample : unit)
    {
      sample.value = &sample == &unit[i] ? 1.0 : 0.0;
    }
    const Polynomial effect = leastSquares(unit, weights, degree).value();
    value += effect.coefficients[0] * effect.coefficients[0];
    slope += effect.coefficients.segment(1, 3).squaredNorm();
  }
  return Errors{ std::sqrt(squares / weightSquares), std::sqrt(value), std::sqrt(slope) };
}

inline double lengthOf(const Vector& a)
{
  return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

/// The samples of both rings in the frame of an edge (10.2): those of the first ring by distance,
/// so that the nearest come first, those that the second one adds in their order; but if the first
/// ring has fewer than 16, the nearest of the second one come next.
struct Frame
{
  Vector increasing; // r
  std::vector<FitSample> samples;
  double h;

  /// @param more what the second ring adds to the first
  Frame(const FitEdge& edge, double isovalue, const std::vector<FitSample>& first,
    const std::vector<FitSample>& more = {})
  {
    this->Length = unitOf(lengthOf(edge.increasing));
    this->Value = unitOf(edge.increase);
    this->ValueError = edge.valueError / this->Value;
    this->increasing = this->placeOf(edge.increasing, {});
    this->samples = nearestOf(this->placed(first, edge.position, isovalue), 256, true);
    const std::vector<FitSample> added = nearestOf(this->placed(more, edge.position, isovalue),
      256 - this->samples.size(), this->samples.size() < 16);
    this->samples.insert(this->samples.end(), added.begin(), added.end());
    this->h = 0.0;
    for (const FitSample& sample : this->samples)
    {
      this->h += lengthOf(sample.position) / static_cast<double>(this->samples.size());
    }
  }

  /// sigma, which is no less than the error of values.
  double residualOf(const Errors& errors) const { return std::max(errors.sigma, this->ValueError); }

  Weights steep() const { return this->weights(0.1, -3); }
  Weights mild() const { return this->weights(1.0, -1); }

  double lengthUnit() const { return this->Length; }
  double valueUnit() const { return this->Value; }

private:
  static double unitOf(double number) { return std::exp2(std::floor(std::log2(number))); }

  Vector placeOf(const Vector& position, const Vector& origin) const
  {
    return { (position[0] - origin[0]) / this->Length, (position[1] - origin[1]) / this->Length,
      (position[2] - origin[2]) / this->Length };
  }

  std::vector<FitSample> placed(
    const std::vector<FitSample>& ring, const Vector& origin, double isovalue) const
  {
    std::vector<FitSample> result;
    for (const FitSample& sample : ring)
    {
      result.push_back(
        { this->placeOf(sample.position, origin), (sample.value - isovalue) / this->Value });
    }
    return result;
  }

  /// The nearest samples: as they are if they are no more, or by their distance.
  static std::vector<FitSample> nearestOf(
    std::vector<FitSample> all, std::size_t count, bool areSorted)
  {
    if (areSorted || all.size() > count)
    {
      std::stable_sort(all.begin(), all.end(),
        [](const FitSample& a, const FitSample& b)
        { return lengthOf(a.position) < lengthOf(b.position); });
    }
    all.resize(std::min(all.size(), count));
    return all;
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

  double Length;
  double Value;
  double ValueError;
};

inline bool contradicts(const Vector& gradient, const Vector& r)
{
  const double product = gradient[0] * r[0] + gradient[1] * r[1] + gradient[2] * r[2];
  return product <= -0.2 * lengthOf(gradient) * lengthOf(r);
}

/// Where a polynomial holds (10.3).
inline std::optional<Vector> zeroOf(const Polynomial& polynomial, const Vector& r)
{
  if (contradicts(polynomial.gradientAt({}), r))
  {
    return std::nullopt;
  }
  Vector place{};
  for (int i = 0; i < 8; ++i)
  {
    const Vector gradient = polynomial.gradientAt(place);
    const double slope = lengthOf(gradient);
    const double factor = -polynomial.valueAt(place) / (slope * slope);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      place[axis] += factor * gradient[axis];
    }
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

/// A polynomial that holds, with its errors (10.3), which are over the slope at p.
struct Candidate
{
  Polynomial polynomial;
  int degree;
  Vector zero;
  Vector gradient;
  double move; // m
  double s;
  double a;
};

/// The cubic or, if it does not hold, the quadratic (10.4, step 3).
inline std::optional<Candidate> candidateOf(const Frame& frame, const Weights& weights, int highest)
{
  for (int degree = highest; degree > 1; --degree)
  {
    const auto polynomial = areEnough(frame.samples.size(), degree)
                              ? leastSquares(frame.samples, weights, degree)
                              : std::nullopt;
    const auto zero = polynomial ? zeroOf(*polynomial, frame.increasing) : std::nullopt;
    const auto errors = zero ? errorsOf(frame.samples, weights, degree) : std::nullopt;
    if (errors)
    {
      const Vector gradient = polynomial->gradientAt(*zero);
      const double relative = frame.residualOf(*errors) / lengthOf(polynomial->gradientAt({}));
      return Candidate{ *polynomial, degree, *zero, gradient, lengthOf(*zero),
        relative * errors->value, relative * errors->slope };
    }
  }
  return std::nullopt;
}

/// Robust weights (10.4, step 2).
inline Weights robustWeights(const Frame& frame)
{
  const Weights steep = frame.steep();
  Weights weights = steep;
  if (!areEnough(frame.samples.size(), 1))
  {
    return weights;
  }
  for (int round = 0; round < 2; ++round)
  {
    const auto affine = leastSquares(frame.samples, weights, 1);
    if (!affine)
    {
      return weights;
    }
    std::vector<double> residuals;
    for (const FitSample& sample : frame.samples)
    {
      residuals.push_back(std::abs(sample.value - affine->valueAt(sample.position)));
    }
    std::vector<double> sorted = residuals;
    std::sort(sorted.begin(), sorted.end());
    const double c = sorted[sorted.size() / 2];
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
  const auto polynomial = areEnough(frame.samples.size(), degree)
                            ? leastSquares(frame.samples, frame.mild(), degree)
                            : std::nullopt;
  return polynomial && !contradicts(polynomial->gradientAt({}), frame.increasing) ? polynomial
                                                                                  : std::nullopt;
}

/// What the rule yields, in the units of positions and values.
struct Result
{
  Vector position;
  Vector gradient;
  bool isGradientFitted = false;
  Hessian hessian{};
  bool isSmooth = false;
  std::optional<FitOrder> order;
};

namespace detail
{

inline Vector positionAt(const Frame& frame, const FitEdge& edge, const Vector& place, double share)
{
  Vector position = edge.position;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    position[axis] += frame.lengthUnit() * share * place[axis];
  }
  return position;
}

inline void setGradient(const Frame& frame, const Vector& gradient, Result& result)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    result.gradient[axis] = gradient[axis] * frame.valueUnit() / frame.lengthUnit();
  }
  result.isGradientFitted = true;
}

inline void setHessian(const Frame& frame, const Hessian& hessian, Result& result)
{
  for (std::size_t i = 0; i < hessian.size(); ++i)
  {
    result.hessian[i] = hessian[i] * frame.valueUnit() / frame.lengthUnit() / frame.lengthUnit();
  }
  result.isSmooth = true;
}

inline Result stay(const Frame& frame, const FitEdge& edge)
{
  Result result;
  result.position = edge.position;
  const double length = lengthOf(edge.increasing);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    result.gradient[axis] = edge.increase / length * edge.increasing[axis] / length;
  }
  if (const auto affine = mildPolynomial(frame, 1))
  {
    setGradient(frame, affine->gradientAt({}), result);
  }
  return result;
}

inline double angleBetween(const Vector& a, const Vector& b)
{
  double squares = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double d = a[axis] / lengthOf(a) - b[axis] / lengthOf(b);
    squares += d * d;
  }
  return std::sqrt(squares); // the chord
}

/// The share of the way to its zero that a point moves.
inline double shareOf(double m, double s)
{
  return m > 0.0 ? m * m / (m * m + 0.1 * s * s) : 1.0;
}

/// Step 1: the result, if it is a clear case.
inline std::optional<Result> clearCase(const Frame& frame, const FitEdge& edge)
{
  const auto quadratic = areEnough(frame.samples.size(), 2)
                           ? leastSquares(frame.samples, frame.steep(), 2)
                           : std::nullopt;
  const auto errors = quadratic ? errorsOf(frame.samples, frame.steep(), 2) : std::nullopt;
  if (!errors)
  {
    return std::nullopt;
  }
  const double relative = frame.residualOf(*errors) / lengthOf(quadratic->gradientAt({}));
  if (relative <= 0.0002 * frame.h)
  {
    const auto zero = zeroOf(*quadratic, frame.increasing);
    if (!zero)
    {
      return std::nullopt;
    }
    Result result;
    result.position =
      positionAt(frame, edge, *zero, shareOf(lengthOf(*zero), relative * errors->value));
    setGradient(frame, quadratic->gradientAt(*zero), result);
    setHessian(frame, quadratic->hessianAt(*zero), result);
    result.order = FitOrder::Quadratic;
    return result;
  }
  return relative * errors->slope > 1.0 ? std::optional<Result>(stay(frame, edge)) : std::nullopt;
}

} // namespace detail

/// The polynomial of step 3 of the rule, if one holds.
inline std::optional<Candidate> takenIn(const Frame& frame, FitOrder highest)
{
  const int degree = highest == FitOrder::Quadratic ? 2 : 3;
  const auto robust = candidateOf(frame, robustWeights(frame), degree);
  return robust ? robust : candidateOf(frame, frame.steep(), degree);
}

/// The rule (10.4) for the orders 2 and 3.
/// @param more what the second ring adds to the first
inline Result fit(const FitEdge& edge, double isovalue, const std::vector<FitSample>& first,
  const std::vector<FitSample>& more, FitOrder highest)
{
  if (const auto clear = detail::clearCase(Frame(edge, isovalue, first), edge))
  {
    return *clear;
  }
  const Frame frame(edge, isovalue, first, more);
  const std::optional<Candidate> taken = takenIn(frame, highest);
  if (!taken)
  {
    return detail::stay(frame, edge);
  }
  Result result;
  result.position =
    detail::positionAt(frame, edge, taken->zero, detail::shareOf(taken->move, taken->s));
  result.order = static_cast<FitOrder>(taken->degree);
  for (const int degree : { 1, 2 })
  {
    const auto mild = mildPolynomial(frame, degree);
    if (mild && detail::angleBetween(mild->gradientAt({}), taken->gradient) < 2.0 * taken->a)
    {
      detail::setGradient(frame, mild->gradientAt({}), result);
      detail::setHessian(frame, mild->hessianAt({}), result);
      result.isSmooth = degree > 1;
      return result;
    }
  }
  detail::setGradient(frame, taken->gradient, result);
  detail::setHessian(frame, taken->polynomial.hessianAt(taken->zero), result);
  return result;
}

} // namespace fitdefinition

#endif
