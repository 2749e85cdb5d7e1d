// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"

#include <array>
#include <optional>

namespace isopoint
{

/// The axes along which samples extend, the longest first.
struct PrincipalAxes
{
  std::array<Vector, 3> axes; // orthonormal
  Vector shares;              // of the variance along each axis in the greatest; 0 if that is 0
};

/// The principal axes of samples that extend much less along one axis than along another one.
/// @param covariance of the samples, by row
/// @returns nothing if the least variance is more than this share of the greatest
std::optional<PrincipalAxes> thinAxes(const std::array<Vector, 3>& covariance, double share);

} // namespace isopoint
