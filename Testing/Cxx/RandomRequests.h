// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "RandomClouds.h"

#include "Core/ExtractionRequest.h"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace clouds
{

/// Points with options by chance.
inline isopoint::ExtractionRequest randomRequest(Dice& dice)
{
  using isopoint::FitOrder;
  constexpr double angles[] = { 54.7, 54.7, 54.7, 0.0, 30.0, 120.0, 180.0 };
  isopoint::ExtractionRequest request;
  request.isosurface.isovalue = 3.0 * dice.real() - 1.0;
  request.isosurface.angle = angles[dice(7)];
  request.isosurface.dropsGaps = dice(2) == 0;
  const std::size_t order = dice(7);
  if (order > 0)
  {
    request.isosurface.fit = isopoint::FitRequest{ std::nullopt, false };
  }
  if (order > 1)
  {
    request.isosurface.fit =
      isopoint::FitRequest{ static_cast<FitOrder>(std::min<std::size_t>(order - 1, 4)),
        dice(3) > 0 };
    request.minimumSpacing = dice(3) == 0 ? dice.real() : 0.0;
  }
  if (dice(4) > 0)
  {
    request.splats =
      isopoint::SplatOptions{ 3 + static_cast<int>(dice(12)), dice(5) > 0, dice(5) > 0 };
  }
  return request;
}

} // namespace clouds
