// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_PolynomialZero_h
#define isopoint_PolynomialZero_h

#include "Isopoint/Fit/PolynomialFit.h"

#include <Eigen/Core>

#include <optional>

namespace isopoint
{

/// The zero of a polynomial that Newton's method along gradients leads to from a position, unless
/// it strays farther from the origin than `farthest`, or does not converge.
std::optional<Eigen::Vector3d> zeroNear(const Polynomial& polynomial, double farthest,
  const Eigen::Vector3d& start = Eigen::Vector3d::Zero());

/// The same of two polynomials at once: each step is the shortest to the line where the tangents of
/// both are zero.
std::optional<Eigen::Vector3d> commonZeroNear(
  const Polynomial& first, const Polynomial& second, double farthest);

} // namespace isopoint

#endif
