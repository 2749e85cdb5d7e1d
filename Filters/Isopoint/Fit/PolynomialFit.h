// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_PolynomialFit_h
#define isopoint_PolynomialFit_h

#include "Isopoint/Base/Vector.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace isopoint
{

/// A sample in the frame of a fit, whose lengths and values are near 1.
struct FrameSample
{
  Eigen::Vector3d position;
  double value;
  double weight; // positive
};

/// How many coefficients a polynomial of three variables has.
constexpr std::size_t coefficientCount(int degree)
{
  return static_cast<std::size_t>((degree + 1) * (degree + 2) * (degree + 3) / 6);
}

/// A polynomial of degree one to three. Its coefficients are those of 1; x, y, z; x^2, y^2, z^2, x
/// y, x z, y z; x^3, y^3, z^3, x^2 y, x^2 z, y^2 x, y^2 z, z^2 x, z^2 y, x y z.
struct Polynomial
{
  static constexpr int highestDegree = 3;

  int degree = 1;
  Eigen::Matrix<double, coefficientCount(highestDegree), 1> coefficients =
    Eigen::Matrix<double, coefficientCount(highestDegree), 1>::Zero();

  double value(const Eigen::Vector3d& p) const
  {
    const auto& c = this->coefficients;
    const double x = p.x();
    const double y = p.y();
    const double z = p.z();
    double value = c[0] + c[1] * x + c[2] * y + c[3] * z;
    if (this->degree > 1)
    {
      value += x * (c[4] * x + c[7] * y + c[8] * z) + y * (c[5] * y + c[9] * z) + c[6] * z * z;
    }
    if (this->degree > 2)
    {
      value += x * x * (c[10] * x + c[13] * y + c[14] * z) +
               y * y * (c[11] * y + c[15] * x + c[16] * z) +
               z * z * (c[12] * z + c[17] * x + c[18] * y) + c[19] * x * y * z;
    }
    return value;
  }

  Eigen::Vector3d gradient(const Eigen::Vector3d& p) const;

  Hessian hessian(const Eigen::Vector3d& p) const;
};

/// The least-squares polynomial of a degree, unless the samples do not determine it or leave too
/// few residuals to judge how well it describes them. Complexity: O(samples.size())
std::optional<Polynomial> fitPolynomial(const std::vector<FrameSample>& samples, int degree);

/// The same through those samples alone that have a label.
/// @param labels one of each sample
std::optional<Polynomial> fitPolynomial(const std::vector<FrameSample>& samples,
  const std::vector<std::uint8_t>& labels, std::uint8_t label, int degree);

/// The factor from a mean square of residuals to an estimate of the values' mean square error, for
/// the degrees of freedom that the coefficients take.
inline double residualFreedom(std::size_t sampleCount, std::size_t coefficientCount)
{
  const auto count = static_cast<double>(sampleCount);
  return count / (count - static_cast<double>(coefficientCount));
}

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

/// How alike the residuals of samples close to each other are: Moran's I [M50], the mean product of
/// two, weighted by closeness, over the mean square of one. About 0 or less for noise, more for
/// fields that the polynomial does not describe. Complexity: O(samples.size()^2)
double residualCoherence(const std::vector<FrameSample>& samples, const Polynomial& polynomial);

} // namespace isopoint

#endif
