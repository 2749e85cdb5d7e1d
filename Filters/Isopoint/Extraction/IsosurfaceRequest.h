// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_IsosurfaceRequest_h
#define isopoint_IsosurfaceRequest_h

#include "Isopoint/Fit/LocalFit.h"
#include "Isopoint/Neighbors/AngleCriterion.h"

#include <optional>

namespace isopoint
{

/// The isovalue, the criteria by which edges are chosen, and what is fitted around them.
struct IsosurfaceRequest
{
  double isovalue;             // any; there are isopoints where samples lie on either side of it
  double angle = defaultAngle; // of the angle criterion, in degrees, 0 up to 180
  bool dropsGaps = false;      // whether what lies in gaps of the cloud is left out
  std::optional<FitRequest> fit = std::nullopt;
  /// Of triangles with creases: whether vertices are repeated on each side of a crease, so that
  /// each has one normal.
  bool partsCreases = false;
};

} // namespace isopoint

#endif
