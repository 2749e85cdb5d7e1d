// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef AccuracySamples_h
#define AccuracySamples_h

#include "AnalyticSurface.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

/// The samples of analytic fields over the cube [-1, 1]^3 that accuracy is measured on, with the
/// values in the array "value", in double.
namespace accuracy
{

/// The ways to place samples, in the order of a report.
inline const std::array<std::string, 4> samplings{ "uniform", "clustered", "jittered", "lines" };

/// The mean distance of so many samples in the cube: the side of the cube that each has to itself.
double meanSpacing(std::size_t count);

/// About `count` positions.
/// - uniform: random, all places equally likely;
/// - clustered: three tenths so, the others around twelve random places, at a normal distance with
///   the standard deviation 0.15 on each axis;
/// - jittered: one sample in each cell of a lattice, within 0.4 cells of its middle on each axis;
/// - lines: parallels to the z axis at random places, samples on each four times closer than
///   lines are.
/// @throws std::invalid_argument for another name
std::vector<analytic::Vector> positionsOf(const std::string& sampling, std::size_t count);

/// The standard deviation of the field over the cube, which noise is relative to.
double deviationOf(const analytic::Surface& surface);

/// The field's values at positions, and normal noise of that standard deviation added.
vtkSmartPointer<vtkPolyData> sampled(const analytic::Surface& surface,
  const std::vector<analytic::Vector>& positions, double noiseDeviation);

/// The positions of a grid of about `count` nodes over the cube, x fastest.
std::vector<analytic::Vector> gridPositions(std::size_t count);

} // namespace accuracy

#endif
