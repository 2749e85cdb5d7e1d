// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Fit/PolynomialFit.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace isopoint
{
namespace
{

/// The reciprocal condition number of normal equations below which samples are taken not to
/// determine a polynomial: coefficients keep about six digits of double's sixteen there.
constexpr double leastCondition = 1e-9;

/// The products of coordinates that coefficients belong to.
template <int Degree>
Eigen::Matrix<double, coefficientCount(Degree), 1> basisAt(const Eigen::Vector3d& p)
{
  Eigen::Matrix<double, coefficientCount(Degree), 1> basis;
  const double x = p.x();
  const double y = p.y();
  const double z = p.z();
  basis.template head<4>() << 1.0, x, y, z;
  if constexpr (Degree > 1)
  {
    basis.template segment<6>(4) << x * x, y * y, z * z, x * y, x * z, y * z;
  }
  if constexpr (Degree > 2)
  {
    basis.template tail<10>() << x * x * x, y * y * y, z * z * z, x * x * y, x * x * z, y * y * x,
      y * y * z, z * z * x, z * z * y, x * y * z;
  }
  return basis;
}

/// See fitPolynomial().
/// @param isTaken of the number of a sample, whether to fit to it
template <int Degree, class IsTaken>
std::optional<Polynomial> fit(const std::vector<FrameSample>& samples, const IsTaken& isTaken)
{
  constexpr int count = coefficientCount(Degree);
  // Without residuals nothing shows whether the fit describes the samples.
  constexpr std::size_t fewestSamples = count + 1 + count / 5;
  std::size_t taken = 0;
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    taken += isTaken(i) ? 1 : 0;
  }
  if (taken < fewestSamples)
  {
    return std::nullopt;
  }
  using Matrix = Eigen::Matrix<double, count, count>;
  using Vector = Eigen::Matrix<double, count, 1>;
  Matrix matrix = Matrix::Zero();
  Vector rightSide = Vector::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    if (isTaken(i))
    {
      const Vector basis = basisAt<Degree>(samples[i].position);
      const Vector weighted = samples[i].weight * basis;
      matrix.noalias() += weighted * basis.transpose();
      rightSide += samples[i].value * weighted;
    }
  }
  const Eigen::LDLT<Matrix> factors(matrix);
  // The estimate of the condition passes over pivots of 0.
  if (factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > 0.0) ||
      !(factors.rcond() > leastCondition))
  {
    return std::nullopt;
  }
  Polynomial polynomial;
  polynomial.degree = Degree;
  polynomial.coefficients.template head<count>() = factors.solve(rightSide);
  return polynomial.coefficients.allFinite() ? std::optional<Polynomial>(polynomial) : std::nullopt;
}

template <class IsTaken>
std::optional<Polynomial> fit(
  const std::vector<FrameSample>& samples, int degree, const IsTaken& isTaken)
{
  switch (degree)
  {
    case 1:
      return fit<1>(samples, isTaken);
    case 2:
      return fit<2>(samples, isTaken);
    default:
      return fit<3>(samples, isTaken);
  }
}

} // namespace

Eigen::Vector3d Polynomial::gradient(const Eigen::Vector3d& p) const
{
  const auto& c = this->coefficients;
  const double x = p.x();
  const double y = p.y();
  const double z = p.z();
  Eigen::Vector3d gradient(c[1] + 2.0 * c[4] * x + c[7] * y + c[8] * z,
    c[2] + 2.0 * c[5] * y + c[7] * x + c[9] * z, c[3] + 2.0 * c[6] * z + c[8] * x + c[9] * y);
  if (this->degree > 2)
  {
    gradient += Eigen::Vector3d(3.0 * c[10] * x * x + 2.0 * x * (c[13] * y + c[14] * z) +
                                  c[15] * y * y + c[17] * z * z + c[19] * y * z,
      3.0 * c[11] * y * y + 2.0 * y * (c[15] * x + c[16] * z) + c[13] * x * x + c[18] * z * z +
        c[19] * x * z,
      3.0 * c[12] * z * z + 2.0 * z * (c[17] * x + c[18] * y) + c[14] * x * x + c[16] * y * y +
        c[19] * x * y);
  }
  return gradient;
}

Hessian Polynomial::hessian(const Eigen::Vector3d& p) const
{
  const auto& c = this->coefficients;
  const double x = p.x();
  const double y = p.y();
  const double z = p.z();
  return { 2.0 * (c[4] + 3.0 * c[10] * x + c[13] * y + c[14] * z),
    2.0 * (c[5] + 3.0 * c[11] * y + c[15] * x + c[16] * z),
    2.0 * (c[6] + 3.0 * c[12] * z + c[17] * x + c[18] * y),
    c[7] + 2.0 * (c[13] * x + c[15] * y) + c[19] * z,
    c[8] + 2.0 * (c[14] * x + c[17] * z) + c[19] * y,
    c[9] + 2.0 * (c[16] * y + c[18] * z) + c[19] * x };
}

std::optional<Polynomial> fitPolynomial(const std::vector<FrameSample>& samples, int degree)
{
  return fit(samples, degree, [](std::size_t) { return true; });
}

std::optional<Polynomial> fitPolynomial(const std::vector<FrameSample>& samples,
  const std::vector<std::uint8_t>& labels, std::uint8_t label, int degree)
{
  return fit(samples, degree, [&](std::size_t i) { return labels[i] == label; });
}

double residualCoherence(const std::vector<FrameSample>& samples, const Polynomial& polynomial)
{
  constexpr double squaredReach = 0.6;
  std::vector<double> residuals; // by the roots of their weights
  double squares = 0.0;
  double weights = 0.0;
  double products = 0.0;
  double productWeights = 0.0;
  for (const FrameSample& sample : samples)
  {
    const double weight = std::sqrt(sample.weight);
    const double residual = weight * (sample.value - polynomial.value(sample.position));
    for (std::size_t i = 0; i < residuals.size(); ++i)
    {
      const double closeness =
        std::max(0.0, squaredReach - (sample.position - samples[i].position).squaredNorm());
      products += closeness * residual * residuals[i];
      productWeights += closeness * weight * std::sqrt(samples[i].weight);
    }
    residuals.push_back(residual);
    squares += residual * residual;
    weights += sample.weight;
  }
  return products / productWeights / (squares / weights);
}

} // namespace isopoint
