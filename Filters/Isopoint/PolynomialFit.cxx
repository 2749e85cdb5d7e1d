// SPDX-License-Identifier: GPL-3.0-or-later
#include "PolynomialFit.h"

#include <Eigen/Cholesky>

#include <cstddef>

namespace isopoint
{
namespace
{

using NormalMatrix = Eigen::Matrix<double, 10, 10>;

/// The reciprocal condition number of normal equations below which samples are taken not to
/// determine a polynomial: coefficients keep about six digits of double's sixteen there.
constexpr double leastCondition = 1e-9;

/// Solves the leading N normal equations. @returns whether they determine the coefficients
template <int N>
bool solve(const NormalMatrix& matrix, const QuadraticBasis& rightSide, Polynomial& polynomial)
{
  const Eigen::Matrix<double, N, N> block = matrix.topLeftCorner<N, N>();
  const Eigen::LDLT<Eigen::Matrix<double, N, N>> factors(block);
  // The estimate of the condition passes over pivots of 0.
  if (factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > 0.0) ||
      !(factors.rcond() > leastCondition))
  {
    return false;
  }
  polynomial.coefficients.setZero();
  polynomial.coefficients.head<N>() = factors.solve(rightSide.head<N>());
  return polynomial.coefficients.allFinite();
}

} // namespace

Eigen::Vector3d Polynomial::gradient(const Eigen::Vector3d& p) const
{
  const QuadraticBasis& c = this->coefficients;
  return { c[1] + 2.0 * c[4] * p.x() + c[7] * p.y() + c[8] * p.z(),
    c[2] + 2.0 * c[5] * p.y() + c[7] * p.x() + c[9] * p.z(),
    c[3] + 2.0 * c[6] * p.z() + c[8] * p.x() + c[9] * p.y() };
}

PolynomialFits fitPolynomials(const std::vector<FrameSample>& samples, bool quadraticWanted)
{
  NormalMatrix matrix = NormalMatrix::Zero();
  QuadraticBasis rightSide = QuadraticBasis::Zero();
  for (const FrameSample& sample : samples)
  {
    const QuadraticBasis basis = quadraticBasis(sample.position);
    const QuadraticBasis weighted = sample.weight * basis;
    matrix.noalias() += weighted * basis.transpose();
    rightSide += sample.value * weighted;
  }
  // One residual at least is to remain, or nothing tells whether the fit describes the samples.
  PolynomialFits fits;
  fits.linearHolds = samples.size() > 4 && solve<4>(matrix, rightSide, fits.linear);
  fits.quadraticHolds = quadraticWanted && fits.linearHolds && samples.size() > 12 &&
                        solve<10>(matrix, rightSide, fits.quadratic);
  return fits;
}

} // namespace isopoint
