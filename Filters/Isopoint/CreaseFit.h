// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CreaseFit_h
#define isopoint_CreaseFit_h

#include "PolynomialFit.h"

#include <Eigen/Core>

#include <vector>

namespace isopoint
{

/// The largest (`sense` 1) or the smallest (`sense` -1) of affine functions: a field with a crease
/// where two of them are equal, or a corner where three are.
struct CreaseFit
{
  double sense = 1.0;
  std::vector<Eigen::Vector4d> pieces; // value at the origin, gradient
  double meanSquare = 0.0;             // of the residuals, weighted

  double pieceValue(std::size_t piece, const Eigen::Vector3d& p) const
  {
    return this->pieces[piece][0] + this->pieces[piece].tail<3>().dot(p);
  }
  double value(const Eigen::Vector3d& p) const;

  /// The root of the mean square of the residuals, over the gentlest gradient.
  double relativeResidual() const;

  /// Whether a point on the zero plane of a piece is one of the whole function's, up to a tolerance
  bool isOnSurface(std::size_t piece, const Eigen::Vector3d& p, double tolerance) const;
};

/// Fits two, and three, affine functions by alternating between which sample belongs to which and
/// least squares (Magnani, Boyd, "Convex piecewise-linear fitting", Optimization and Engineering
/// 10, 2009). The pieces of the start are halves of a single fit's samples, cut across the
/// direction in which its residuals bend most.
/// @param mostRelativeResidual of those wanted
/// @param rivalMeanSquare of the residuals of a smooth fit: where halves are far worse there is no
/// crease
/// @returns those of smallest residuals, of two and of three pieces; without those in which a piece
/// has too few samples
std::vector<CreaseFit> fitCreases(
  const std::vector<FrameSample>& samples, double mostRelativeResidual, double rivalMeanSquare);

} // namespace isopoint

#endif
