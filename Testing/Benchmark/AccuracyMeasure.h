// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef AccuracyMeasure_h
#define AccuracyMeasure_h

#include "AnalyticSurface.h"

#include <cstddef>
#include <vector>

class vtkPolyData;

namespace accuracy
{

/// Errors of points, normals and splats. Lengths are in mean spacings of the samples, angles in
/// degrees; numbers below 0 could not be measured.
struct Measurement
{
  std::size_t points = 0; // extracted, measured or not
  double largestDistance = -1.0;
  double quantileDistance = -1.0; // of 99.9 % of the points
  double meanDistance = -1.0;
  double largestAngle = -1.0; // between a normal and the true one at the nearest true point
  double meanAngle = -1.0;
  double uncovered = -1.0;   // share of the true surface's points that no splat covers
  double rimDistance = -1.0; // of 99.9 % of the ends of the splats' axes
};

/// Measures a surface as Contestant::extract returns it, within a cube around the origin inside
/// which there are samples on all sides. A splat covers a true point whose projection along its
/// normal lies within its polygon, if the distance from its plane is at most half a mean
/// spacing or half its radius, whichever is more.
/// @param truePoints random points of the true surface within that cube
/// @param halfSide half the side of the cube
Measurement measureAccuracy(vtkPolyData* extracted, const analytic::Surface& surface,
  const std::vector<analytic::Vector>& truePoints, double halfSide, double meanSpacing);

} // namespace accuracy

#endif
