// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_PolynomialFit_h
#define isopoint_PolynomialFit_h

#include <Eigen/Core>

#include <vector>

namespace isopoint
{

/// A sample in a frame of its own: around the origin, at a size and with values near 1.
struct FrameSample
{
  Eigen::Vector3d position;
  double value;
  double weight; // positive
};

using QuadraticBasis = Eigen::Matrix<double, 10, 1>;

/// 1, x, y, z, x^2, y^2, z^2, x y, x z, y z
inline QuadraticBasis quadraticBasis(const Eigen::Vector3d& p)
{
  QuadraticBasis basis;
  basis << 1.0, p.x(), p.y(), p.z(), p.x() * p.x(), p.y() * p.y(), p.z() * p.z(), p.x() * p.y(),
    p.x() * p.z(), p.y() * p.z();
  return basis;
}

/// A polynomial of degree two, or one where the last six coefficients are 0.
struct Polynomial
{
  QuadraticBasis coefficients = QuadraticBasis::Zero();

  double value(const Eigen::Vector3d& p) const { return this->coefficients.dot(quadraticBasis(p)); }
  Eigen::Vector3d gradient(const Eigen::Vector3d& p) const;
};

/// The least-squares polynomials of degree one and two through the same samples.
struct PolynomialFits
{
  bool linearHolds = false; // whether the samples determine it
  bool quadraticHolds = false;
  Polynomial linear;
  Polynomial quadratic;
};

PolynomialFits fitPolynomials(const std::vector<FrameSample>& samples, bool quadraticWanted);

/// The weighted mean of squared residuals.
template <class Function>
double meanSquaredResidual(const std::vector<FrameSample>& samples, const Function& function)
{
  double sum = 0.0;
  double weights = 0.0;
  for (const FrameSample& sample : samples)
  {
    const double residual = sample.value - function(sample.position);
    sum += sample.weight * residual * residual;
    weights += sample.weight;
  }
  return sum / weights;
}

} // namespace isopoint

#endif
