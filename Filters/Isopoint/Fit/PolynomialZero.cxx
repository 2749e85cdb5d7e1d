// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Fit/PolynomialZero.h"

#include <Eigen/LU>

namespace isopoint
{
namespace
{

/// Steps from a position until they vanish. @returns where, unless that is too far
template <class Step>
std::optional<Eigen::Vector3d> follow(
  const Step& stepAt, double farthest, Eigen::Vector3d position = Eigen::Vector3d::Zero())
{
  constexpr int mostSteps = 8;
  constexpr double accuracy = 1e-12;
  for (int i = 0; i < mostSteps; ++i)
  {
    const Eigen::Vector3d step = stepAt(position);
    position += step;
    if (!(position.norm() <= farthest)) // nor is it a number, where the gradient vanishes
    {
      return std::nullopt;
    }
    if (step.norm() <= accuracy)
    {
      return position;
    }
  }
  return std::nullopt;
}

} // namespace

std::optional<Eigen::Vector3d> zeroNear(
  const Polynomial& polynomial, double farthest, const Eigen::Vector3d& start)
{
  return follow(
    [&](const Eigen::Vector3d& p) -> Eigen::Vector3d
    {
      const Eigen::Vector3d gradient = polynomial.gradient(p);
      return -polynomial.value(p) / gradient.squaredNorm() * gradient;
    },
    farthest, start);
}

std::optional<Eigen::Vector3d> commonZeroNear(
  const Polynomial& first, const Polynomial& second, double farthest)
{
  return follow(
    [&](const Eigen::Vector3d& p) -> Eigen::Vector3d
    {
      Eigen::Matrix<double, 2, 3> gradients;
      gradients << first.gradient(p).transpose(), second.gradient(p).transpose();
      const Eigen::Matrix2d products = gradients * gradients.transpose();
      const Eigen::Vector2d values(first.value(p), second.value(p));
      return -gradients.transpose() * (products.inverse() * values);
    },
    farthest);
}

} // namespace isopoint
