// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Fit/SurfacePiece.h"

#include <Eigen/LU>

#include <cstddef>

namespace isopoint
{

SurfacePiece::SurfacePiece(const LocalFit& fit)
  : place(fit.position)
  , slope(directionOf(fit.gradient))
  , bend(fit.hessian)
{
  for (double& each : this->bend)
  {
    each /= lengthOf(fit.gradient);
  }
}

SurfacePiece::SurfacePiece(const Vector& isopoint, const CreasePlane& plane)
  : place(isopoint - plane.distance * plane.inward)
  , slope(plane.inward)
  , bend{}
{
}

double SurfacePiece::valueAt(const Vector& position) const
{
  const Vector offset = position - this->place;
  return 0.5 * dot(this->slope + this->slopeAt(position), offset);
}

Vector SurfacePiece::slopeAt(const Vector& position) const
{
  const Vector o = position - this->place;
  const Hessian& h = this->bend;
  return { this->slope[0] + h[0] * o[0] + h[3] * o[1] + h[4] * o[2],
    this->slope[1] + h[3] * o[0] + h[1] * o[1] + h[5] * o[2],
    this->slope[2] + h[4] * o[0] + h[5] * o[1] + h[2] * o[2] };
}

Vector meetingOf(const std::vector<SurfacePiece>& pieces, const Vector& from)
{
  constexpr int steps = 4;
  constexpr int most = 3;
  using Slopes = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, most, 3>;
  using Products = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;
  const auto count = static_cast<Eigen::Index>(pieces.size());
  Slopes slopes(count, 3);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1> values(count);
  Eigen::Vector3d place(from[0], from[1], from[2]);
  for (int step = 0; step < steps; ++step)
  {
    for (Eigen::Index i = 0; i < count; ++i)
    {
      const Vector position{ place[0], place[1], place[2] };
      const SurfacePiece& piece = pieces[static_cast<std::size_t>(i)];
      const Vector slope = piece.slopeAt(position);
      slopes.row(i) << slope[0], slope[1], slope[2];
      values[i] = piece.valueAt(position);
    }
    const Products products = slopes * slopes.transpose();
    place -= slopes.transpose() * products.partialPivLu().solve(values);
  }
  return { place[0], place[1], place[2] };
}

} // namespace isopoint
