// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef AccuracyMeasure_h
#define AccuracyMeasure_h

#include "AnalyticSurface.h"

#include <cstddef>
#include <vector>

class vtkPolyData;

namespace accuracy
{

/// How far points, normals and splats are from the true surface. Lengths are in mean spacings of
/// the samples, angles in degrees; what there is nothing to measure of is below 0.
struct Measurement
{
  std::size_t points = 0; // extracted, measured or not
  double largestDistance = -1.0;
  double quantileDistance = -1.0; // 99.9 % of the points are no farther
  double meanDistance = -1.0;
  double largestAngle = -1.0; // between a normal and the true one at the nearest true point
  double meanAngle = -1.0;
  double uncovered = -1.0;   // share of the true surface's points that no splat covers
  double rimDistance = -1.0; // of 99.9 % of the ends of the splats' axes from the true surface
};

/// Measures a surface as Contestant::extract returns it: what lies where there are samples on all
/// sides, within a cube around the origin.
/// A splat covers a true point that, seen along its normal, lies within its disk or ellipse, and
/// is no farther from its plane than half a mean spacing or, where that is more, half its radius.
/// @param truePoints random points of the true surface within that cube
/// @param halfSide of the cube
Measurement measureAccuracy(vtkPolyData* extracted, const analytic::Surface& surface,
  const std::vector<analytic::Vector>& truePoints, double halfSide, double meanSpacing);

} // namespace accuracy

#endif
