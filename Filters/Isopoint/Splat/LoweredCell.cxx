// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Splat/LoweredCell.h"

#include "Isopoint/Base/TangentFrame.h"

#include <cmath>

namespace isopoint
{

LoweredCell loweredCell(const SplatCell& cell, const Vector& position, const Vector& normal)
{
  const TangentFrame frame(normal);
  LoweredCell lowered;
  lowered.count = cell.count;
  lowered.isFirstHere = cell.isFirstHere;
  for (std::size_t i = 0; i < cell.count; ++i)
  {
    const auto& [x, y, beyond] = cell.corners[i];
    const double slopeX = cell.curvature.xx * x + cell.curvature.xy * y;
    const double slopeY = cell.curvature.xy * x + cell.curvature.yy * y;
    const double height = 0.5 * (slopeX * x + slopeY * y);
    Vector place = sum(position, cell.unit * x, frame.first);
    place = sum(place, cell.unit * y, frame.second);
    place = sum(place, cell.unit * height, normal);
    const Vector upwards = sum(sum(normal, -slopeX, frame.first), -slopeY, frame.second);
    lowered.corners[i] = { place, directionOf(upwards), cell.unit * std::sqrt(x * x + y * y),
      beyond };
  }
  return lowered;
}

} // namespace isopoint
