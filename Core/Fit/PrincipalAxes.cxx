// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Fit/PrincipalAxes.h"

#include <Eigen/Eigenvalues>

namespace isopoint
{

std::optional<PrincipalAxes> thinAxes(const std::array<Vector, 3>& covariance, double share)
{
  Eigen::Matrix3d matrix;
  for (Eigen::Index row = 0; row < 3; ++row)
  {
    const Vector& numbers = covariance[static_cast<std::size_t>(row)];
    matrix.row(row) << numbers[0], numbers[1], numbers[2];
  }
  // The determinant is the product of the eigenvalues and the trace their sum, so that most samples
  // need no eigenvalues.
  const double sum = matrix.trace();
  if (matrix.determinant() > 4.0 / 27.0 * share * sum * sum * sum)
  {
    return std::nullopt;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  const Eigen::Vector3d& values = solver.eigenvalues(); // ascending
  if (values[0] > share * values[2])
  {
    return std::nullopt;
  }
  PrincipalAxes result{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Eigen::Index column = 2 - static_cast<Eigen::Index>(axis);
    const Eigen::Vector3d direction = solver.eigenvectors().col(column);
    result.axes[axis] = { direction[0], direction[1], direction[2] };
    result.shares[axis] = values[2] > 0.0 ? values[column] / values[2] : 0.0;
  }
  return result;
}

} // namespace isopoint
